//! The bar on a terminal.

use super::{Moment, plain};
use crate::console;
use indicatif::{ProgressBar, ProgressStyle};

/// Steps of a whole bar.
const STEPS: u64 = 1000;

/// A bar on stderr, below the messages.
#[derive(Debug)]
pub(super) struct Bar(ProgressBar);

impl Bar {
    pub(super) fn new() -> Self {
        let bar = ProgressBar::new(STEPS);
        let style = ProgressStyle::with_template("{bar:24} {percent:>3} %  {msg}");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()).progress_chars("█▉▊▋▌▍▎▏ "));
        console::set_bar(Some(bar.clone()));
        Bar(bar)
    }

    /// Redrawn a few times a second, however often this is called.
    pub(super) fn show(&self, moment: &Moment) {
        self.0.set_message(plain::figures(moment));
        self.0.set_position((STEPS as f64 * moment.fraction().unwrap_or(0.0)) as u64);
    }
}
