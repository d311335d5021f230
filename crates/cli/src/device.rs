//! Opens what renders, and the threads beside it.

use crate::console;
use crate::exit::{Code, Failure};
use crate::flags::device::DeviceArgs;
use lumbre::rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};
use lumbre::scene::CompiledScene;
use lumbre::{Backend, OpenDevice};

/// Opens the device that is asked for, and says what there is to say of it.
pub(crate) fn open(args: &DeviceArgs) -> Result<OpenDevice, Failure> {
    let open = args.device.open(&args.options())?;
    open.notes().iter().for_each(console::warning);
    if args.validation && !open.is_gpu() {
        console::warning("--validation: there is nothing to validate without a GPU");
    }
    Ok(open)
}

/// Brings a scene to the device, and says in one line where it went and why.
pub(crate) fn prepare(open: OpenDevice, scene: CompiledScene) -> Result<Box<dyn Backend>, Failure> {
    let why = open.why().to_owned();
    let prepared = open.prepare(scene)?;
    let why = match prepared.note {
        Some(note) => {
            console::warning(&note);
            "auto: the GPU failed".into()
        }
        None => why,
    };
    said(&*prepared.backend, &why);
    Ok(prepared.backend)
}

/// The line that says what renders.
pub(crate) fn said(backend: &dyn Backend, why: &str) {
    console::note(format_args!("device: {} ({why})", backend.device()));
}

/// The threads that work.
pub(crate) fn pool(args: &DeviceArgs) -> Result<ThreadPool, Failure> {
    threads(args).build().map_err(no_threads)
}

/// The same for all of the program, where others start the work: threads that stand back for a window.
pub(crate) fn common_pool(args: &DeviceArgs) -> Result<(), Failure> {
    threads(args).start_handler(|_| stand_back()).build_global().map_err(no_threads)
}

/// The thread gets the processor when nobody else asks for it. Without that, a window on a machine whose processors all render waits for its
/// turn. Linux alone has this for threads; where it is refused, all goes as before.
fn stand_back() {
    #[cfg(all(target_os = "linux", feature = "viewer"))]
    let _ = rustix::process::setpriority_process(Some(rustix::thread::gettid()), NICE);
}

/// As `nice` counts: a tenth of the share of others.
#[cfg(all(target_os = "linux", feature = "viewer"))]
const NICE: i32 = 10;

fn threads(args: &DeviceArgs) -> ThreadPoolBuilder {
    // 0: rayon counts the processors.
    ThreadPoolBuilder::new().num_threads(args.threads.map_or(0, usize::from))
}

fn no_threads(e: ThreadPoolBuildError) -> Failure {
    Failure::new(Code::Memory, format!("cannot start the threads: {e}"))
}

/// Does a piece of work again on another device where the first one fails and there is another.
pub(crate) fn surely<T>(
    backend: &dyn Backend,
    work: impl Fn() -> Result<T, lumbre::RenderError>,
) -> Result<T, Failure> {
    loop {
        match work() {
            Ok(done) => return Ok(done),
            Err(e) => console::warning(backend.recover(e)?),
        }
    }
}

/// Says what a validation layer found, if one was asked for.
pub(crate) fn validation(backend: &dyn Backend) {
    let Some(complaints) = backend.complaints() else { return };
    complaints.iter().for_each(|c| console::warning(format_args!("validation: {}", c.replace('\n', " "))));
    if complaints.is_empty() {
        console::note("validation: no complaints");
    }
}
