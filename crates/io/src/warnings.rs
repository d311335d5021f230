//! Warnings of a load: each kind once, with a count and the first place, so that a scene of a thousand odd materials
//! does not print a thousand lines; and no more kinds than someone may read.

use crate::error::one_line;
use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash, Hasher};

/// Most kinds that are told; of the others only the number is.
const MOST_KINDS: usize = 50;

/// Collects warnings in the order in which their kinds first appear.
#[derive(Debug, Default)]
pub(crate) struct Warnings {
    kinds: Vec<Kind>,
    /// By the hash of its text, where each kind stands in `kinds`; `None`: it came when that was full. Hashes, since a
    /// file may bring millions of kinds.
    slots: HashMap<u64, Option<usize>>,
}

#[derive(Debug)]
struct Kind {
    what: String,
    first_place: String,
    count: usize,
}

impl Warnings {
    /// Notes `what` at `place` (may be empty).
    pub(crate) fn add(&mut self, place: impl ToString, what: impl ToString) {
        self.add_many(place, what, 1);
    }

    /// Notes `what`, which was met `count` times, first at `place`.
    pub(crate) fn add_many(&mut self, place: impl ToString, what: impl ToString, count: usize) {
        self.add_kind(Kind { what: one_line(&what.to_string()), first_place: place.to_string(), count });
    }

    fn add_kind(&mut self, kind: Kind) {
        let free = (self.kinds.len() < MOST_KINDS).then_some(self.kinds.len());
        match *self.slots.entry(hash(&kind.what)).or_insert(free) {
            Some(i) if i < self.kinds.len() => self.kinds[i].count += kind.count,
            Some(_) => self.kinds.push(kind),
            None => {}
        }
    }

    /// Takes over the warnings of a part.
    pub(crate) fn append(&mut self, other: Warnings) {
        other.kinds.into_iter().for_each(|k| self.add_kind(k));
        for (hash, _) in other.slots.into_iter().filter(|(_, slot)| slot.is_none()) {
            self.slots.entry(hash).or_insert(None);
        }
    }

    /// One line each, and one on those for which there was no room.
    pub(crate) fn into_lines(self) -> Vec<String> {
        let line = |Kind { what, first_place, count }: Kind| {
            let more = if count > 1 { format!(" (and {} more)", count - 1) } else { String::new() };
            if first_place.is_empty() {
                format!("{what}{more}")
            } else {
                format!("{first_place}: {what}{more}")
            }
        };
        let untold = self.slots.len() - self.kinds.len();
        let rest = (untold > 0).then(|| {
            let plural = if untold == 1 { "" } else { "s" };
            format!("and {untold} more kind{plural} of warnings")
        });
        self.kinds.into_iter().map(line).chain(rest).collect()
    }
}

fn hash(what: &str) -> u64 {
    let mut hasher = DefaultHasher::new();
    what.hash(&mut hasher);
    hasher.finish()
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

    #[test]
    fn kinds_beyond_the_most_are_counted_once_each() {
        let of = |range: std::ops::Range<usize>| {
            let mut w = Warnings::default();
            range.clone().chain(range).for_each(|i| w.add("", format!("kind {i}")));
            w
        };
        assert_eq!(of(0..50).into_lines().len(), 50);
        let lines = of(0..51).into_lines();
        assert_eq!(lines[49..], ["kind 49 (and 1 more)", "and 1 more kind of warnings"]);
        let mut parts = of(10..100);
        parts.append(of(0..80));
        parts.append(of(90..110));
        let lines = parts.into_lines();
        assert_eq!((lines.len(), lines[0].as_str()), (51, "kind 10 (and 3 more)"));
        assert_eq!(lines[50], "and 60 more kinds of warnings");
        // A part that was full may name what another part had room for.
        let mut parts = of(60..61);
        parts.append(of(0..70));
        assert_eq!(parts.into_lines()[50], "and 20 more kinds of warnings");
    }
}
