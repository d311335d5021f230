//! The GPU of this machine, for tests: one device that all tests of a program share, with the validation layer where it is installed.

use lumbre_vulkan::{Gpu, Kind, Options, Validation, VulkanError, Wanted};
use std::cell::Cell;
use std::marker::PhantomData;
use std::ops::Deref;
use std::sync::{Condvar, Mutex, OnceLock, PoisonError};

/// Tests that work with the GPU at a time. Nearly all that they do there is to have pipelines compiled, eight a scene, which drivers do behind
/// locks of their own: on an H100 scenes that take 2 to 5 s alone took over a minute each when 16 threads asked at once.
const AT_ONCE: usize = 4;

/// A device; one message of the validation layer fails the test that holds it.
#[derive(Debug)]
pub struct TestGpu(Gpu, Turn);

/// One of the [`AT_ONCE`]; a thread that has one has all that it asks for.
#[derive(Debug)]
struct Turn {
    /// Given back by the thread that took it.
    _here: PhantomData<*const ()>,
}

static AT_WORK: Mutex<usize> = Mutex::new(0);
static ONE_IS_DONE: Condvar = Condvar::new();

thread_local! {
    /// Turns that this thread has.
    static HELD: Cell<usize> = const { Cell::new(0) };
}

impl Turn {
    fn wait() -> Self {
        if HELD.replace(HELD.get() + 1) == 0 {
            let at_work = AT_WORK.lock().unwrap_or_else(PoisonError::into_inner);
            let free = ONE_IS_DONE.wait_while(at_work, |n| *n >= AT_ONCE);
            *free.unwrap_or_else(PoisonError::into_inner) += 1;
        }
        Turn { _here: PhantomData }
    }
}

impl Drop for Turn {
    fn drop(&mut self) {
        if HELD.replace(HELD.get() - 1) == 1 {
            *AT_WORK.lock().unwrap_or_else(PoisonError::into_inner) -= 1;
            ONE_IS_DONE.notify_one();
        }
    }
}

/// The device that tests use: the one that `LUMBRE_TEST_GPU` selects (`gpu:N` or part of a name), or the best. Drivers that compute on
/// the processor count. `None`, with a line that says so, where there is no Vulkan with ray tracing pipelines. Waits while four other tests
/// hold one.
///
/// # Panics
/// If there is none and `LUMBRE_REQUIRE_GPU` is 1, or if the device does not open for another reason.
pub fn gpu() -> Option<TestGpu> {
    static GPU: OnceLock<Result<Gpu, VulkanError>> = OnceLock::new();
    there(GPU.get_or_init(open).clone())
}

/// The same opened once more, for tests that lose it or count its memory.
///
/// # Panics
/// As [`gpu`].
pub fn own_gpu() -> Option<TestGpu> {
    there(open())
}

fn open() -> Result<Gpu, VulkanError> {
    let wanted = std::env::var("LUMBRE_TEST_GPU").map_or(Wanted::Best, |w| w.parse().unwrap());
    Gpu::open(&wanted, Options { validation: Validation::WhereInstalled, ..Options::default() })
}

fn there(opened: Result<Gpu, VulkanError>) -> Option<TestGpu> {
    match opened {
        Ok(gpu) => Some(TestGpu(gpu, Turn::wait())),
        Err(error @ (VulkanError::NoLoader(_) | VulkanError::NoDevice(_))) => {
            let required = std::env::var("LUMBRE_REQUIRE_GPU").is_ok_and(|v| v == "1");
            assert!(!required, "LUMBRE_REQUIRE_GPU=1, but: {error}");
            println!("skipped: no Vulkan ray tracing device");
            None
        }
        Err(error) => panic!("{error}"),
    }
}

impl TestGpu {
    /// Whether it is one, not a driver that computes on the processor.
    pub fn is_real(&self) -> bool {
        self.0.adapter().kind != Kind::Cpu
    }
}

impl Deref for TestGpu {
    type Target = Gpu;

    fn deref(&self) -> &Gpu {
        &self.0
    }
}

impl Drop for TestGpu {
    fn drop(&mut self) {
        if !std::thread::panicking() {
            let messages = self.0.messages();
            assert!(messages.is_empty(), "the validation layer says:\n{}", messages.join("\n"));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};

    /// No more than four at a time; who has a turn gets another one at once, or tests that need two would wait for each other.
    #[test]
    fn turns_are_bounded_and_nested() {
        let (now, most) = (AtomicUsize::new(0), AtomicUsize::new(0));
        let work = || {
            let (_one, _two) = (Turn::wait(), Turn::wait());
            most.fetch_max(now.fetch_add(1, Ordering::SeqCst) + 1, Ordering::SeqCst);
            std::thread::sleep(std::time::Duration::from_millis(5));
            now.fetch_sub(1, Ordering::SeqCst);
        };
        std::thread::scope(|scope| (0..20).for_each(|_| drop(scope.spawn(work))));
        assert_eq!((most.into_inner(), now.into_inner()), (AT_ONCE, 0));
    }
}
