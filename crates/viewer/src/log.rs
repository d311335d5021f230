//! What happened, for people: the last lines, with the time since the window opened.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

/// Lines that are kept.
const LENGTH: usize = 500;

/// How grave a line is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grade {
    /// It went as it should.
    Note,
    /// Something may surprise.
    Warning,
    /// Something could not be done.
    Error,
}

/// A line.
#[derive(Clone, Debug)]
pub struct Line {
    /// Since the window opened.
    pub at: Duration,
    /// How grave.
    pub grade: Grade,
    /// What happened.
    pub text: String,
}

/// The lines.
#[derive(Clone, Debug)]
pub struct Log {
    began: Instant,
    lines: VecDeque<Line>,
    /// Lines that there were so far.
    count: usize,
    /// The last error, until it is put away.
    pending: Option<String>,
}

impl Default for Log {
    fn default() -> Self {
        Log { began: Instant::now(), lines: VecDeque::new(), count: 0, pending: None }
    }
}

impl Log {
    /// Adds a line. An error also stays in view until [`Log::put_away`].
    pub fn add(&mut self, grade: Grade, text: impl Into<String>) {
        let text = text.into();
        if grade == Grade::Error {
            self.pending = Some(text.clone());
        }
        if self.lines.len() == LENGTH {
            self.lines.pop_front();
        }
        self.lines.push_back(Line { at: self.began.elapsed(), grade, text });
        self.count += 1;
    }

    /// Adds a note.
    pub fn note(&mut self, text: impl Into<String>) {
        self.add(Grade::Note, text);
    }

    /// Adds an error.
    pub fn error(&mut self, text: impl Into<String>) {
        self.add(Grade::Error, text);
    }

    /// The lines, the oldest first.
    pub fn lines(&self) -> &VecDeque<Line> {
        &self.lines
    }

    /// Lines that there were so far.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The lines that came when there were `count`, as far as they are kept.
    pub fn since(&self, count: usize) -> impl Iterator<Item = &Line> {
        self.lines.iter().skip(self.lines.len().saturating_sub(self.count.saturating_sub(count)))
    }

    /// The last line.
    pub fn last(&self) -> Option<&Line> {
        self.lines.back()
    }

    /// The error that nobody has put away.
    pub fn pending(&self) -> Option<&str> {
        self.pending.as_deref()
    }

    /// Puts the error away.
    pub fn put_away(&mut self) {
        self.pending = None;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_lines_are_kept_and_an_error_stays_in_view() {
        let mut log = Log::default();
        log.error("a");
        (0..2 * LENGTH).for_each(|i| log.note(i.to_string()));
        assert_eq!(log.lines().len(), LENGTH);
        assert_eq!(log.since(log.count() - 2).map(|l| &*l.text).collect::<Vec<_>>(), ["998", "999"]);
        assert_eq!((log.since(0).count(), log.since(log.count()).count()), (LENGTH, 0));
        assert_eq!(log.last().unwrap().text, (2 * LENGTH - 1).to_string());
        assert_eq!(log.pending(), Some("a"));
        log.put_away();
        assert_eq!(log.pending(), None);
    }
}
