//! Warnings of a load: each kind once, with a count and the first place, so that a scene of a thousand odd materials
//! does not print a thousand lines.

use crate::error::one_line;

/// Collects warnings in the order in which their kinds first appear.
#[derive(Debug, Default)]
pub(crate) struct Warnings {
    kinds: Vec<(String, String, usize)>,
}

impl Warnings {
    /// Notes `what` at `place` (may be empty).
    pub(crate) fn add(&mut self, place: impl ToString, what: impl ToString) {
        let what = one_line(&what.to_string());
        match self.kinds.iter_mut().find(|(w, ..)| *w == what) {
            Some((.., count)) => *count += 1,
            None => self.kinds.push((what, place.to_string(), 1)),
        }
    }

    /// Takes over the warnings of a part.
    pub(crate) fn append(&mut self, other: Warnings) {
        for (what, place, count) in other.kinds {
            match self.kinds.iter_mut().find(|(w, ..)| *w == what) {
                Some((.., n)) => *n += count,
                None => self.kinds.push((what, place, count)),
            }
        }
    }

    /// One line each.
    pub(crate) fn into_lines(self) -> Vec<String> {
        let line = |(what, place, count): (String, String, usize)| {
            let more = if count > 1 { format!(" (and {} more)", count - 1) } else { String::new() };
            if place.is_empty() { format!("{what}{more}") } else { format!("{place}: {what}{more}") }
        };
        self.kinds.into_iter().map(line).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_are_counted() {
        let mut a = Warnings::default();
        a.add("/materials/1", "x");
        a.add("", "y");
        let mut b = Warnings::default();
        b.add("/materials/2", "x");
        b.add("/materials/3", "x");
        a.append(b);
        assert_eq!(a.into_lines(), ["/materials/1: x (and 2 more)", "y"]);
    }
}
