//! What a traversal is after: the closest hit or any hit.

use super::Hit;

/// Takes the hits found with `t_min < t <= t_best`, in any order.
pub(super) trait Query {
    /// Takes one hit; may lower `t_best`. Returns true to end the traversal.
    fn offer(&mut self, hit: Hit, opaque: bool, t_best: &mut f32) -> bool;
}

/// Keeps the closest hit. Until there is one, `best.t` is `t_max` and the ids are the smallest, which no tie can beat: so
/// `t_max` itself stays excluded.
pub(super) struct Closest<F> {
    best: Hit,
    found: bool,
    filter: F,
}

impl<F> Closest<F> {
    #[inline(always)]
    pub(super) fn new(t_max: f32, filter: F) -> Self {
        let best = Hit { t: t_max, instance: 0, triangle: 0, b1: 0.0, b2: 0.0 };
        Closest { best, found: false, filter }
    }

    #[inline(always)]
    pub(super) fn into_hit(self) -> Option<Hit> {
        self.found.then_some(self.best)
    }
}

impl<F: FnMut(&Hit) -> bool> Query for Closest<F> {
    #[inline(always)]
    fn offer(&mut self, hit: Hit, opaque: bool, t_best: &mut f32) -> bool {
        let best = &self.best;
        let closer = hit.t < best.t
            || hit.t == best.t && (hit.instance, hit.triangle) < (best.instance, best.triangle);
        if closer && (opaque || (self.filter)(&hit)) {
            self.best = hit;
            self.found = true;
            *t_best = hit.t;
        }
        false
    }
}

/// Stops at the first hit.
pub(super) struct Any<F> {
    pub(super) t_max: f32,
    pub(super) found: bool,
    pub(super) filter: F,
}

impl<F: FnMut(&Hit) -> bool> Query for Any<F> {
    #[inline(always)]
    fn offer(&mut self, hit: Hit, opaque: bool, _: &mut f32) -> bool {
        self.found = hit.t < self.t_max && (opaque || (self.filter)(&hit));
        self.found
    }
}
