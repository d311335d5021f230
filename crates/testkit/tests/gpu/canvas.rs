//! Pictures that grow on the device: the same sums as those of a render, developed as the host develops them.

use crate::common::compile;
use crate::scenes::{lamps, lamps_view};
use lumbre::look::Look;
use lumbre::session::{Event, Frame, FrameSink, Layer, Session, ViewLook, Wanted};
use lumbre::{Backend, Device, GpuChoice, GpuOptions, output};
use lumbre_core::Film;
use lumbre_core::color::Exposure;
use lumbre_testkit::gpu;
use lumbre_vulkan::{SceneOptions, VulkanBackend};
use std::sync::mpsc::{Sender, channel};
use std::sync::{Arc, Mutex};
use std::time::Duration;

/// Largest difference of colours, and whether the picture is opaque.
fn differ(rgba: &[u8], rgb: &[u8]) -> u8 {
    assert_eq!(rgba.len() / 4, rgb.len() / 3);
    assert!(rgba.iter().skip(3).step_by(4).all(|a| *a == 255));
    let pairs = rgba.chunks_exact(4).zip(rgb.chunks_exact(3));
    pairs.flat_map(|(a, b)| (0..3).map(|i| a[i].abs_diff(b[i])).collect::<Vec<_>>()).max().unwrap()
}

#[test]
fn a_canvas_holds_what_a_render_brings() {
    let Some(gpu) = gpu() else { return };
    let vulkan = VulkanBackend::new(&gpu, &compile(&lamps()), SceneOptions::default()).unwrap();
    let backend: &dyn Backend = &vulkan;
    let mut canvas = backend.canvas().unwrap();
    // Rough, fine, rough again.
    for size in [[12, 9], [48, 36], [24, 18]] {
        let view = lamps_view(4.0 / 3.0);
        canvas.clear(size).unwrap();
        canvas.add(&view, 0..2, &()).unwrap();
        canvas.add(&view, 2..3, &()).unwrap();
        let mut film = Film::new(size[0], size[1]);
        backend.render(&view, 0..3, &mut film, &()).unwrap();
        assert!(*canvas.film().unwrap() == film, "{size:?}");
        let look = Look { vignette: 0.3, ..Look::default() };
        let shown = canvas.develop(&look, 1.0, 1.0).unwrap().expect("the device develops");
        assert!(differ(&shown.rgba, &output::develop(&film, &look).bytes) <= 1);
        // An offset of an automatic exposure, and half of the way to it.
        let brighter = canvas.develop(&look, 4.0, 0.5).unwrap().unwrap();
        assert!((brighter.factor / shown.factor - 2.0).abs() < 1e-3, "{} {}", brighter.factor, shown.factor);
        let look = Look { exposure: Exposure::Ev(brighter.factor.log2()), ..look };
        assert!(differ(&brighter.rgba, &output::develop(&film, &look).bytes) <= 1);
    }
}

/// Passes frames on, and what is to be said.
struct Pipe(Mutex<Sender<Result<Frame, String>>>);

impl FrameSink for Pipe {
    fn frame(&self, frame: Frame) {
        let _ = self.0.lock().unwrap().send(Ok(frame));
    }
    fn event(&self, event: Event) {
        assert!(!matches!(event, Event::Failed(_) | Event::Refused { .. }), "{event:?}");
        if let Event::Notice(text) = event {
            let _ = self.0.lock().unwrap().send(Err(text));
        }
    }
}

const SIZE: [u32; 2] = [64, 48];

/// The lamps, seen by a GPU of this number.
fn wanted(gpu: usize, limit: u32) -> Wanted {
    let view = lamps_view(4.0 / 3.0);
    let look = Look { exposure: Exposure::Ev(-1.0), ..Look::default() };
    Wanted {
        scene: Arc::new(lamps()),
        camera: view.camera,
        size: SIZE,
        settings: view.settings,
        samples_per_frame: 2,
        limit,
        paused: false,
        restarts: 0,
        moving: false,
        look: ViewLook { look, ..ViewLook::default() },
        layer: Layer::Picture,
        device: Device::Gpu(GpuChoice::Index(gpu)),
    }
}

/// All that a session sends until it rests.
fn sent(wanted: Wanted) -> Vec<Result<Frame, String>> {
    let (to, from) = channel();
    let _session = Session::start(wanted, GpuOptions::default(), Arc::new(Pipe(Mutex::new(to))));
    let mut all = Vec::new();
    while !all.last().is_some_and(|s: &Result<Frame, String>| s.as_ref().is_ok_and(|f| f.stats.done)) {
        all.push(from.recv_timeout(Duration::from_secs(300)).expect("frames come"));
    }
    all
}

#[test]
fn a_session_on_a_gpu_draws_what_render_draws() {
    let Some(gpu) = gpu() else { return };
    let wanted = wanted(gpu.adapter().index, 5);
    let view = lamps_view(4.0 / 3.0);
    let Some(Ok(done)) = sent(wanted.clone()).pop() else { panic!("no frame") };
    assert_eq!((done.size, done.stats.spp, &done.stats.device), (SIZE, 5, &gpu.adapter().name));
    assert!(!done.stats.passes.is_empty());
    let vulkan = VulkanBackend::new(&gpu, &compile(&lamps()), SceneOptions::default()).unwrap();
    let mut film = Film::new(SIZE[0], SIZE[1]);
    vulkan.render(&view, 0..5, &mut film, &()).unwrap();
    assert!(differ(&done.rgba, &output::develop(&film, &wanted.look.look).bytes) <= 1);
}

/// In a process of its own, whose device is lost at a submission in the middle of the picture.
#[test]
fn a_session_whose_device_is_lost_goes_on_with_the_cpu() {
    const OF_CHILD: &str = "LUMBRE_TEST_SESSION_GPU";
    let Ok(index) = std::env::var(OF_CHILD) else {
        let Some(gpu) = gpu() else { return };
        let name = "canvas::a_session_whose_device_is_lost_goes_on_with_the_cpu";
        let mut child = std::process::Command::new(std::env::current_exe().unwrap());
        child.args([name, "--exact", "--nocapture"]);
        child.env(OF_CHILD, gpu.adapter().index.to_string()).env("LUMBRE_TEST_LOSE_DEVICE", "60");
        let done = child.output().unwrap();
        let said = String::from_utf8_lossy(&done.stdout) + String::from_utf8_lossy(&done.stderr);
        assert!(done.status.success() && said.contains("1 passed"), "{said}");
        return;
    };
    let wanted = wanted(index.parse().unwrap(), 200);
    let all = sent(wanted.clone());
    let lost = all.iter().position(Result::is_err).expect("a line about the device");
    assert!(
        all[lost].as_ref().is_err_and(|text| text.contains("lost") && text.contains("CPU")),
        "{:?}",
        all[lost]
    );
    let drawn_by =
        |sent: &Result<Frame, String>| sent.as_ref().map(|f| f.stats.device.clone()).unwrap_or_default();
    assert!(lost > 0 && !drawn_by(&all[0]).starts_with("CPU"), "it began on the GPU");
    let done = all.last().unwrap();
    assert!(drawn_by(done).starts_with("CPU"));
    // Not a mixture of both.
    let cpu = lumbre_cpu::CpuBackend::new(compile(&lamps()));
    let mut film = Film::new(SIZE[0], SIZE[1]);
    cpu.render(&lamps_view(4.0 / 3.0), 0..200, &mut film, &());
    assert_eq!(differ(&done.as_ref().unwrap().rgba, &output::develop(&film, &wanted.look.look).bytes), 0);
}
