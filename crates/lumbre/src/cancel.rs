//! Stopping a render from outside, and hearing of it on the way.

use crate::render::Watch;
use lumbre_core::control::{Control, Progress};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Tells a render to stop. Clones are the same token; any thread may hold one.
#[derive(Clone, Debug, Default)]
pub struct CancelToken(Arc<AtomicBool>);

impl CancelToken {
    /// A token that nobody has cancelled.
    pub fn new() -> Self {
        Self::default()
    }
    /// Asks for the end: tiles that have not begun are left out. There is no way back.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }
    /// Whether the end was asked for.
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// A [`Watch`] made of a token and a function that hears of progress. The function is called from any thread of the pool,
/// after each tile, and calls may overtake each other.
#[derive(Debug)]
pub struct Watched<F> {
    cancel: CancelToken,
    on_progress: F,
}

impl<F: Fn(Progress) + Sync> Watched<F> {
    /// Stops with `cancel`, reports to `on_progress`.
    pub fn new(cancel: &CancelToken, on_progress: F) -> Self {
        Watched { cancel: cancel.clone(), on_progress }
    }
}

impl<F: Fn(Progress) + Sync> Control for Watched<F> {
    fn cancelled(&self) -> bool {
        self.cancel.is_cancelled()
    }
    fn progress(&self, so_far: Progress) {
        (self.on_progress)(so_far);
    }
}

impl<F: Fn(Progress) + Sync> Watch for Watched<F> {}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::AtomicU64;

    #[test]
    fn clones_are_one_token_and_progress_arrives() {
        let token = CancelToken::new();
        let heard = AtomicU64::new(0);
        let watched = Watched::new(&token, |p: Progress| heard.store(p.samples, Ordering::Relaxed));
        assert!(!watched.cancelled());
        watched.progress(Progress { samples: 7, rays: 9 });
        token.clone().cancel();
        assert!(watched.cancelled() && heard.into_inner() == 7);
    }
}
