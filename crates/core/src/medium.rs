//! Homogeneous absorption and the small stack of media that a path is inside of.

use crate::math::{exp, ln};
use crate::rgb::Spectrum;

/// The inside of a transmissive solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Medium {
    /// Index of refraction.
    pub ior: f32,
    /// Absorption coefficient, m⁻¹.
    pub absorption: Spectrum,
    /// Identity: the material that bounds it.
    pub material: u32,
}

impl Medium {
    /// Empty space.
    pub const VACUUM: Medium = Medium { ior: 1.0, absorption: Spectrum::BLACK, material: u32::MAX };

    /// Beer-Lambert transmittance over `distance` metres.
    #[inline]
    pub fn transmittance(&self, distance: f32) -> Spectrum {
        if self.absorption.is_black() {
            return Spectrum::WHITE;
        }
        // A ray that leaves the scene inside an absorbing medium: 0 · ∞ must not become NaN.
        self.absorption.map(|a| if a == 0.0 { 1.0 } else { exp(-a * distance) })
    }
}

/// Absorption coefficient, m⁻¹, of a medium that turns white light to `color` over `distance` metres
/// (`KHR_materials_volume`). A component of 0 absorbs as strongly as `f32` can carry.
pub fn absorption_from_color(color: Spectrum, distance: f32) -> Spectrum {
    if !(distance > 0.0 && distance.is_finite()) {
        return Spectrum::BLACK;
    }
    color.map(|c| -ln(c.clamp(f32::MIN_POSITIVE, 1.0)) / distance)
}

/// Deepest nesting of media that is followed; further ones are entered without effect.
pub const DEPTH: usize = 4;

/// The media around a point, innermost last.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MediumStack {
    media: [Medium; DEPTH],
    len: usize,
}

impl Default for MediumStack {
    fn default() -> Self {
        MediumStack { media: [Medium::VACUUM; DEPTH], len: 0 }
    }
}

impl MediumStack {
    /// The innermost medium.
    #[inline]
    pub fn current(&self) -> &Medium {
        if self.len == 0 { &Medium::VACUUM } else { &self.media[self.len - 1] }
    }

    /// The media on both sides of the boundary of the solid `inside`, met on its front or its back: where the path is, and where it
    /// would be beyond. Both are read from the stack, so that indices of refraction telescope along a path also where solids overlap.
    #[inline]
    pub fn sides(&self, inside: Medium, front: bool) -> (Medium, Medium) {
        if front {
            return (*self.current(), inside);
        }
        match self.media[..self.len].iter().rposition(|m| m.material == inside.material) {
            Some(at) if at + 1 == self.len => {
                (inside, if at == 0 { Medium::VACUUM } else { self.media[at - 1] })
            }
            // Another medium lies further in, on both sides.
            Some(_) => (*self.current(), *self.current()),
            // The path began inside without knowing.
            None => (inside, *self.current()),
        }
    }

    /// All of them, innermost last.
    pub fn as_slice(&self) -> &[Medium] {
        &self.media[..self.len]
    }

    /// All of them, to be changed in place.
    #[inline]
    pub fn iter_mut(&mut self) -> impl Iterator<Item = &mut Medium> {
        self.media[..self.len].iter_mut()
    }

    /// Enters a solid.
    #[inline]
    pub fn enter(&mut self, medium: Medium) {
        if self.len < DEPTH {
            self.media[self.len] = medium;
            self.len += 1;
        }
    }

    /// Crosses the boundary of the solid of `material`: from its front side into `beyond`, or out of it.
    #[inline]
    pub fn cross(&mut self, beyond: Medium, material: u32, front: bool) {
        if front { self.enter(beyond) } else { self.leave(material) }
    }

    /// Leaves the innermost solid of this material, if the path is inside one.
    #[inline]
    pub fn leave(&mut self, material: u32) {
        if let Some(at) = self.media[..self.len].iter().rposition(|m| m.material == material) {
            self.media.copy_within(at + 1..self.len, at);
            self.len -= 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ANALYTIC row 36.
    #[test]
    fn beer_lambert() {
        for (tau, t) in [(0.1, 0.9048), (1.0, 0.3679), (3.0, 0.0498)] {
            let m = Medium { absorption: Spectrum::splat(tau / 2.0), ..Medium::VACUUM };
            assert!((m.transmittance(2.0).g - t).abs() < 5e-5);
        }
        let a = absorption_from_color(Spectrum::new(0.5, 1.0, 0.0), 3.0);
        let t = Medium { absorption: a, ..Medium::VACUUM }.transmittance(3.0);
        assert!((t.r - 0.5).abs() < 1e-6 && t.g == 1.0 && t.b < 1e-30);
        assert!(Medium { absorption: a, ..Medium::VACUUM }.transmittance(f32::INFINITY).is_finite());
        assert!(absorption_from_color(Spectrum::splat(0.5), f32::INFINITY).is_black());
    }

    #[test]
    fn stack_leaves_the_right_medium() {
        let m = |material| Medium { material, ior: 1.0 + material as f32, ..Medium::VACUUM };
        let mut s = MediumStack::default();
        s.enter(m(1));
        s.enter(m(2));
        assert_eq!(s.current().material, 2);
        let materials = |(a, b): (Medium, Medium)| [a.material, b.material];
        assert_eq!(materials(s.sides(m(2), false)), [2, 1]);
        assert_eq!(materials(s.sides(m(1), false)), [2, 2], "the water stays around");
        assert_eq!(materials(s.sides(m(3), true)), [2, 3]);
        assert_eq!(materials(s.sides(m(3), false)), [3, 2]);
        s.leave(1);
        assert_eq!(s.current().material, 2);
        s.leave(7);
        s.leave(2);
        assert_eq!(s.current(), &Medium::VACUUM);
        for i in 0..10 {
            s.enter(m(i));
        }
        assert_eq!(s.current().material, 3);
    }
}
