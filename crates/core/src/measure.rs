//! What devices report of their own work: one form for all of them, so that reports pass from a backend to those who print them.

use crate::control::Progress;

/// Time that a device spent on one of its passes, by its own clock.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PassTime {
    /// Which pass.
    pub name: &'static str,
    /// How often it ran.
    pub count: u64,
    /// Milliseconds in all.
    pub total_ms: f64,
}

impl PassTime {
    /// Adds a run to the pass of this name in a list.
    pub fn add(all: &mut Vec<PassTime>, name: &'static str, ms: f64) {
        let at = all.iter().position(|t| t.name == name).unwrap_or_else(|| {
            all.push(PassTime { name, ..PassTime::default() });
            all.len() - 1
        });
        all[at].count += 1;
        all[at].total_ms += ms;
    }

    /// Milliseconds of one run, in the mean.
    pub fn mean_ms(&self) -> f64 {
        self.total_ms / self.count.max(1) as f64
    }
}

/// What frames in a row took.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frames {
    /// Seconds of each frame, from the end of the one before (of the first: from the call).
    pub seconds: Vec<f64>,
    /// What was done in all.
    pub progress: Progress,
    /// Rays that go on a path, that of the camera too, but no shadow rays; `None` where they are not counted apart.
    pub path_rays: Option<u64>,
    /// The device's passes, over all frames; empty where it has no clock.
    pub passes: Vec<PassTime>,
}

/// What the rays of a frame take by themselves: traced in the order and the launches of the frame, with nothing shaded. Times are the
/// device's own, milliseconds, medians of some runs; 0 where it has no clock.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Replayed {
    /// Rays that go on a path, that of the camera too.
    pub path_rays: u64,
    /// Rays to lights.
    pub shadow_rays: u64,
    /// What is not replayed: shadow rays that follow light through glass (the way there is), and those of shadow catchers.
    pub left_out: u64,
    /// Time for those of paths, launch after launch.
    pub path_ms: f64,
    /// Time for those to lights, launch after launch.
    pub shadow_ms: f64,
    /// Time for all of them, those launched beside one another that the frame launches so.
    pub ms: f64,
}

/// Acceleration structures of a scene on a device: what they hold, and what making them took by the device's own clock (0 where it has
/// none).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AccelReport {
    /// Bottom-level structures.
    pub structures: usize,
    /// Triangles in them.
    pub triangles: u64,
    /// Instances in the top level.
    pub instances: usize,
    /// Bytes of the bottom level as built.
    pub bytes_built: u64,
    /// Bytes of it after compaction.
    pub bytes: u64,
    /// Bytes of the top level.
    pub top_bytes: u64,
    /// Milliseconds to build the bottom level.
    pub build_ms: f64,
    /// Milliseconds to compact it.
    pub compact_ms: f64,
    /// Milliseconds to build the top level.
    pub top_build_ms: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pass_has_a_mean() {
        let pass = PassTime { name: "trace", count: 4, total_ms: 10.0 };
        assert_eq!(pass.mean_ms(), 2.5);
        assert_eq!(PassTime::default().mean_ms(), 0.0);
    }
}
