//! Rendering a picture to a number of samples.

use crate::backend::Backend;
use lumbre_core::Film;
use lumbre_core::control::{Control, Progress};
use lumbre_core::settings::View;
use std::ops::Range;

/// Most samples of one pass over the picture: between passes every pixel has had its share.
const LONGEST_PASS: u32 = 16;

/// Adds the samples of a range to a film in passes over the whole picture, short ones first, so that a cancelled render leaves
/// an even picture. Returns what was done; `control` hears of it on the way.
pub fn render(
    backend: &dyn Backend,
    view: &View,
    samples: Range<u32>,
    film: &mut Film,
    control: &dyn Control,
) -> Progress {
    let mut done = Progress::default();
    for pass in passes(samples) {
        if control.cancelled() {
            break;
        }
        let so_far = SoFar { done, control };
        let pass = backend.render(view, pass, film, &so_far);
        done = sum(done, pass);
    }
    done
}

/// Splits a range into passes of 1, 1, 2, 4, … samples.
fn passes(samples: Range<u32>) -> impl Iterator<Item = Range<u32>> {
    let mut next = samples.start;
    std::iter::from_fn(move || {
        let taken = next - samples.start;
        let length = taken.clamp(1, LONGEST_PASS).min(samples.end.saturating_sub(next));
        (length > 0).then(|| {
            next += length;
            next - length..next
        })
    })
}

fn sum(a: Progress, b: Progress) -> Progress {
    Progress { samples: a.samples + b.samples, rays: a.rays + b.rays }
}

/// Adds the passes before this one to what the backend reports.
struct SoFar<'a> {
    done: Progress,
    control: &'a dyn Control,
}

impl Control for SoFar<'_> {
    fn cancelled(&self) -> bool {
        self.control.cancelled()
    }
    fn progress(&self, so_far: Progress) {
        self.control.progress(sum(self.done, so_far));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn passes_cover_the_range_once() {
        for range in [0..0, 5..6, 0..64, 7..1000] {
            let all: Vec<u32> = passes(range.clone()).flatten().collect();
            assert_eq!(all, range.collect::<Vec<_>>());
        }
        assert_eq!(passes(0..64).next(), Some(0..1));
    }
}
