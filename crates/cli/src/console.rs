//! Words to the user: messages on stderr, results on stdout. Both may be closed or full: a message that cannot be delivered is
//! dropped, a result that cannot is a failure.

use crate::exit::{Code, Failure};
use indicatif::ProgressBar;
use std::fmt::Display;
use std::io::Write;
use std::sync::{Mutex, PoisonError};

/// The progress bar on the terminal, which steps aside for messages.
static BAR: Mutex<Option<ProgressBar>> = Mutex::new(None);

/// Puts a bar below the messages, or takes it away.
pub(crate) fn set_bar(bar: Option<ProgressBar>) {
    let old = std::mem::replace(&mut *BAR.lock().unwrap_or_else(PoisonError::into_inner), bar);
    old.iter().for_each(ProgressBar::finish_and_clear);
}

fn line(text: &str) {
    let print = || {
        let _ = writeln!(std::io::stderr(), "{text}");
    };
    // Never waits: the thread that panics may be the one that holds the bar.
    match BAR.try_lock().as_deref() {
        Ok(Some(bar)) => bar.suspend(print),
        _ => print(),
    }
}

/// What was chosen or found.
pub(crate) fn note(what: impl Display) {
    line(&what.to_string());
}

/// What may not be as the user wants it.
pub(crate) fn warning(what: impl Display) {
    line(&format!("warning: {what}"));
}

/// Why the command fails.
pub(crate) fn error(what: impl Display) {
    line(&format!("error: {what}"));
}

/// A line of the result, on stdout.
pub(crate) fn result(text: impl Display) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    let written = writeln!(out, "{text}").and_then(|()| out.flush());
    written.map_err(|e| Failure::new(Code::CannotWrite, format!("standard output: {e}")))
}
