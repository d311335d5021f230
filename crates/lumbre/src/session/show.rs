//! The thread that develops frames of devices without a display of their own, so that exposure and tone curve answer at once, also while
//! the next samples take their time.

use super::sink::{Frame, FrameSink, FrameStats};
use super::wanted::ViewLook;
use crate::look::{Look, Negative};
use lumbre_core::color::{Exposure, ease_share, exposure_eased};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// Time in which an eased exposure comes within 1/e of where it goes, seconds.
const EYE: f32 = 0.4;
/// An exposure that is this near, in EV, has arrived.
const ARRIVED: f32 = 0.02;
/// Between two frames of an exposure on its way, while no samples come.
pub(super) const STEP: Duration = Duration::from_millis(33);

/// Samples to be developed.
pub(super) struct Shot {
    pub(super) negative: Negative,
    pub(super) number: u64,
    pub(super) stats: FrameStats,
}

#[derive(Default)]
struct Slot {
    look: ViewLook,
    shot: Option<Arc<Shot>>,
    /// Something in the slot has not been shown.
    fresh: bool,
    ended: bool,
}

/// The thread. It ends when this is dropped.
pub(super) struct Show {
    slot: Arc<(Mutex<Slot>, Condvar)>,
    thread: Option<JoinHandle<()>>,
}

fn locked(slot: &Mutex<Slot>) -> MutexGuard<'_, Slot> {
    slot.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Show {
    pub(super) fn start(sink: Arc<dyn FrameSink>) -> Self {
        let slot = Arc::new((Mutex::new(Slot::default()), Condvar::new()));
        let shared = slot.clone();
        let thread =
            std::thread::Builder::new().name("develop".into()).spawn(move || develop(&shared, &*sink));
        Show { slot, thread: Some(thread.expect("the system has room for a thread")) }
    }

    fn change(&self, with: impl FnOnce(&mut Slot)) {
        let mut slot = locked(&self.slot.0);
        with(&mut slot);
        slot.fresh = true;
        self.slot.1.notify_one();
    }

    /// Shows these samples next.
    pub(super) fn shot(&self, shot: Shot) {
        self.change(|slot| slot.shot = Some(Arc::new(shot)));
    }

    /// Shows the last samples in another way.
    pub(super) fn look(&self, look: ViewLook) {
        self.change(|slot| slot.look = look);
    }

    /// Forgets the last samples: others are shown elsewhere.
    pub(super) fn blank(&self) {
        self.change(|slot| slot.shot = None);
    }
}

impl Drop for Show {
    fn drop(&mut self) {
        self.change(|slot| slot.ended = true);
        self.thread.take().map(JoinHandle::join);
    }
}

/// How much of the way to its target an exposure goes that was shown last at this time: all of it if it is not eased.
pub(super) fn share(look: &ViewLook, last: Option<Instant>) -> f32 {
    match last {
        Some(at) if look.eased && is_automatic(&look.look) => ease_share(at.elapsed().as_secs_f32(), EYE),
        _ => 1.0,
    }
}

/// Whether an exposure that this share of the way changed by a factor has arrived.
pub(super) fn arrived(factor: f32, share: f32) -> bool {
    factor.log2().abs() <= ARRIVED * share
}

/// Whether the exposure follows the picture.
fn is_automatic(look: &Look) -> bool {
    !matches!(look.exposure, Exposure::Ev(_))
}

/// The factor that an automatic exposure is offset by.
pub(super) fn offset(look: &ViewLook) -> f32 {
    if is_automatic(&look.look) { look.offset_ev.exp2() } else { 1.0 }
}

fn develop(shared: &(Mutex<Slot>, Condvar), sink: &dyn FrameSink) {
    // Threads of its own: those of the common pool would take samples first.
    let threads = std::thread::available_parallelism().map_or(1, usize::from).min(4);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).thread_name(|i| format!("develop {i}"));
    let pool = pool.build().expect("the system has room for threads");
    let mut last: Option<(f32, Instant)> = None;
    let mut at_rest = true;
    loop {
        let mut slot = locked(&shared.0);
        while !slot.fresh && !slot.ended {
            if at_rest {
                slot = shared.1.wait(slot).unwrap_or_else(PoisonError::into_inner);
            } else {
                slot = shared.1.wait_timeout(slot, STEP).unwrap_or_else(PoisonError::into_inner).0;
                break;
            }
        }
        if slot.ended {
            return;
        }
        slot.fresh = false;
        let (look, shot) = (slot.look, slot.shot.clone());
        drop(slot);
        let Some(shot) = shot else {
            at_rest = true;
            continue;
        };
        let target = pool.install(|| shot.negative.exposure_factor(&look.look)) * offset(&look);
        let share = share(&look, last.map(|(_, at)| at));
        let before = last.map_or(target, |(factor, _)| factor);
        let eased = exposure_eased(before, target, share);
        at_rest = arrived(target / eased, 1.0);
        let factor = if at_rest { target } else { eased };
        last = Some((factor, Instant::now()));
        let rgba = pool.install(|| shot.negative.develop(&look.look, factor, 4));
        let stats = FrameStats { exposure_ev: factor.log2(), ..shot.stats.clone() };
        sink.frame(Frame { size: shot.negative.size(), rgba, number: shot.number, stats });
    }
}
