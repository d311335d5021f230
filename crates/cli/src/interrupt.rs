//! Ctrl-C (and a polite request to terminate). While a picture is being rendered the first one ends the render at the next
//! tile, so that what there is gets written; another one, or one at any other time before, ends the program at once. While the
//! finished picture is being written the first one is ignored: the file is a moment away.

use crate::console;
use crate::exit::{Code, Failure};
use lumbre::CancelToken;
use std::sync::atomic::{AtomicU8, Ordering};

/// What the program is at, as far as an interrupt is concerned.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Phase {
    /// Nothing to save.
    Preparing = 0,
    /// A picture is growing.
    Rendering = 1,
    /// It is being written.
    Writing = 2,
}

static PHASE: AtomicU8 = AtomicU8::new(Phase::Preparing as u8);

/// Says what the program is at from now on.
pub(crate) fn enter(phase: Phase) {
    PHASE.store(phase as u8, Ordering::SeqCst);
}

/// What an interrupt does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Action {
    Stop,
    Ignore,
    Kill,
}

fn action(phase: u8, earlier: u32) -> Action {
    match (phase, earlier) {
        (p, 0) if p == Phase::Rendering as u8 => Action::Stop,
        (p, 0) if p == Phase::Writing as u8 => Action::Ignore,
        _ => Action::Kill,
    }
}

/// Installs the handler; the token is cancelled by the first interrupt of a render.
pub(crate) fn install() -> Result<CancelToken, Failure> {
    let token = CancelToken::new();
    let cancel = token.clone();
    let mut earlier = 0;
    ctrlc::set_handler(move || {
        match action(PHASE.load(Ordering::SeqCst), earlier) {
            Action::Stop => {
                cancel.cancel();
                console::note("interrupted: stopping at the next tile (again to end at once)");
            }
            Action::Ignore => {
                console::note("interrupted: the picture is being written (again to end at once)")
            }
            Action::Kill => {
                console::set_bar(None);
                std::process::exit(Code::Killed as i32);
            }
        }
        earlier += 1;
    })
    .map_err(|e| Failure::new(Code::Bug, format!("cannot listen for interrupts: {e}")))?;
    Ok(token)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_saves_what_there_is_and_the_second_kills() {
        assert_eq!(action(Phase::Preparing as u8, 0), Action::Kill);
        assert_eq!(action(Phase::Rendering as u8, 0), Action::Stop);
        assert_eq!(action(Phase::Rendering as u8, 1), Action::Kill);
        assert_eq!(action(Phase::Writing as u8, 0), Action::Ignore);
        assert_eq!(action(Phase::Writing as u8, 1), Action::Kill);
    }
}
