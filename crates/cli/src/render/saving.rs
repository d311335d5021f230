//! `--save-every`: the outputs with what there is so far, written by a thread of their own from a copy of the film, so that the
//! render goes on meanwhile.

use crate::console;
use crate::exit::{Code, Failure};
use lumbre::SoFar;
use lumbre::core::Film;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread::Scope;
use std::time::{Duration, Instant};

/// Sees each pass of a render.
pub(super) trait Save: Sync {
    fn passed(&self, film: &Film, so_far: &SoFar);
}

/// Saves at intervals. A save that takes longer than its interval delays the next one, never the render.
pub(super) struct Saver<'scope, 'env, F> {
    every: Duration,
    due: Mutex<Instant>,
    scope: &'scope Scope<'scope, 'env>,
    /// One is being written.
    busy: &'scope AtomicBool,
    write: &'scope F,
}

impl<'scope, 'env, F> Saver<'scope, 'env, F>
where
    F: Fn(&Film, &SoFar) -> Result<(), Failure> + Sync,
{
    /// Saves by `write`, in threads of `scope`.
    pub(super) fn new(
        every: Duration,
        scope: &'scope Scope<'scope, 'env>,
        busy: &'scope AtomicBool,
        write: &'scope F,
    ) -> Self {
        Saver { every, due: Mutex::new(Instant::now() + every), scope, busy, write }
    }
}

impl<F> Save for Saver<'_, '_, F>
where
    F: Fn(&Film, &SoFar) -> Result<(), Failure> + Sync,
{
    fn passed(&self, film: &Film, so_far: &SoFar) {
        let mut due = self.due.lock().unwrap_or_else(PoisonError::into_inner);
        if Instant::now() < *due || self.busy.swap(true, Ordering::AcqRel) {
            return;
        }
        *due = Instant::now() + self.every;
        let (film, so_far, busy, write) = (film.clone(), *so_far, self.busy, self.write);
        self.scope.spawn(move || {
            // One thread beside those of the render, which would serve it only once they are idle; outside of any pool it would
            // take as many as there are processors.
            let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build();
            let alone = alone.map_err(|e| Failure::new(Code::Memory, format!("cannot start a thread: {e}")));
            if let Err(e) = alone.and_then(|pool| pool.install(|| write(&film, &so_far))) {
                console::warning(format_args!("not saved on the way: {}", e.message));
            }
            busy.store(false, Ordering::Release);
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::AtomicU32;

    #[test]
    fn it_saves_when_due_one_at_a_time_and_lives_with_failures() {
        let (busy, writes) = (AtomicBool::new(false), AtomicU32::new(0));
        let gate = Mutex::new(());
        let write = |film: &Film, so_far: &SoFar| {
            drop(gate.lock());
            assert_eq!((film.width(), so_far.spp), (3, 5));
            writes.fetch_add(1, Ordering::Relaxed);
            Err(Failure::new(Code::CannotWrite, "full"))
        };
        let (film, so_far) = (Film::new(3, 2), SoFar { spp: 5, ..SoFar::default() });
        std::thread::scope(|scope| {
            let never = Saver::new(Duration::from_secs(3600), scope, &busy, &write);
            never.passed(&film, &so_far);
            let saver = Saver::new(Duration::ZERO, scope, &busy, &write);
            let held = gate.lock().unwrap();
            // The first is being written, the second has to wait and is left out.
            saver.passed(&film, &so_far);
            saver.passed(&film, &so_far);
            drop(held);
            while busy.load(Ordering::Acquire) {
                std::thread::yield_now();
            }
            saver.passed(&film, &so_far);
        });
        assert_eq!(writes.into_inner(), 2);
    }
}
