//! How rough a picture must be so that it comes soon.

/// Seconds that a frame may take while something moves: with what cancelling and showing take, less than a tenth of a second.
const MOVING: f64 = 0.045;
/// Pixels of the view for one of the frame, along each axis, from fine to rough.
const SCALES: [u32; 8] = [1, 2, 3, 4, 6, 8, 12, 16];

/// Speed of a device, as measured.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pace {
    /// Camera samples a second.
    speed: f64,
}

impl Pace {
    /// Before anything is known.
    pub(super) fn new(gpu: bool) -> Self {
        Pace { speed: if gpu { 2e6 } else { 3e5 } }
    }

    /// Learns from a frame of so many samples.
    pub(super) fn learn(&mut self, samples: u64, seconds: f64) {
        let speed = samples as f64 / seconds.max(1e-5);
        // One slow frame says little where others share the machine.
        self.speed =
            if speed > self.speed { 0.5 * (self.speed + speed) } else { 0.7 * self.speed + 0.3 * speed };
    }

    /// Of a view of this size while something moves.
    pub(super) fn scale(&self, size: [u32; 2]) -> u32 {
        let fits = |scale: &u32| {
            let [w, h] = scaled(size, *scale).map(f64::from);
            w * h <= self.speed * MOVING
        };
        SCALES.into_iter().find(fits).unwrap_or(SCALES[SCALES.len() - 1])
    }
}

/// The next finer scale once nothing moves.
pub(super) fn finer(scale: u32) -> u32 {
    (scale / 2).max(1)
}

/// Size of a frame.
pub(super) fn scaled(size: [u32; 2], scale: u32) -> [u32; 2] {
    size.map(|n| n.div_ceil(scale).max(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rough_enough_and_not_rougher() {
        let mut pace = Pace::new(false);
        for _ in 0..50 {
            pace.learn(500_000, 1.0);
        }
        let scale = pace.scale([1280, 720]);
        let pixels = |s| scaled([1280, 720], s).iter().map(|&n| u64::from(n)).product::<u64>() as f64;
        assert!(pixels(scale) <= 500_000.0 * MOVING && pixels(scale - 2) > 500_000.0 * MOVING, "{scale}");
        pace.learn(100_000_000, 1.0);
        assert_eq!(pace.scale([1280, 720]), 1);
        pace.learn(1, 10.0);
        (0..99).for_each(|_| pace.learn(1, 10.0));
        assert_eq!(pace.scale([1280, 720]), 16);
        assert_eq!((finer(16), finer(3), finer(1)), (8, 1, 1));
        assert_eq!(scaled([5, 1], 16), [1, 1]);
    }
}
