//! Linear RGB with Rec. 709 primaries and D65 white.

use bytemuck::{Pod, Zeroable};
use core::ops::{Add, AddAssign, Div, Index, Mul, MulAssign, Sub};

/// A linear Rec. 709 colour: a texture value, a film value, and (today) a spectrum.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Rgb {
    /// Red.
    pub r: f32,
    /// Green.
    pub g: f32,
    /// Blue.
    pub b: f32,
}

/// Radiance, throughput, emission and BSDF weights. Today three bands; spectral rendering will replace the alias.
pub type Spectrum = Rgb;

impl Rgb {
    /// No light.
    pub const BLACK: Rgb = Rgb::splat(0.0);
    /// One in every band.
    pub const WHITE: Rgb = Rgb::splat(1.0);

    /// From three components.
    #[inline]
    pub const fn new(r: f32, g: f32, b: f32) -> Self {
        Rgb { r, g, b }
    }
    /// The same value in every band.
    #[inline]
    pub const fn splat(v: f32) -> Self {
        Rgb { r: v, g: v, b: v }
    }
    /// From an array.
    #[inline]
    pub const fn from_array(a: [f32; 3]) -> Self {
        Rgb { r: a[0], g: a[1], b: a[2] }
    }
    /// To an array.
    #[inline]
    pub const fn to_array(self) -> [f32; 3] {
        [self.r, self.g, self.b]
    }
    /// Colours as a list of numbers: red, green and blue of each.
    #[inline]
    pub fn as_floats(colors: &[Rgb]) -> &[f32] {
        bytemuck::cast_slice(colors)
    }
    /// Relative luminance Y, Rec. 709 weights.
    #[inline]
    pub fn luminance(self) -> f32 {
        0.2126 * self.r + 0.7152 * self.g + 0.0722 * self.b
    }
    /// The largest component.
    #[inline]
    pub fn max_component(self) -> f32 {
        self.r.max(self.g).max(self.b)
    }
    /// Mean of the three components.
    #[inline]
    pub fn average(self) -> f32 {
        (self.r + self.g + self.b) * (1.0 / 3.0)
    }
    /// True when every component is exactly zero.
    #[inline]
    pub fn is_black(self) -> bool {
        self.r == 0.0 && self.g == 0.0 && self.b == 0.0
    }
    /// True when no component is NaN or infinite.
    #[inline]
    pub fn is_finite(self) -> bool {
        self.r.is_finite() && self.g.is_finite() && self.b.is_finite()
    }
    /// Applies `f` to each component.
    #[inline]
    pub fn map(self, f: impl Fn(f32) -> f32) -> Self {
        Rgb::new(f(self.r), f(self.g), f(self.b))
    }
    /// Component-wise minimum with a scalar.
    #[inline]
    pub fn min(self, v: f32) -> Self {
        self.map(|x| x.min(v))
    }
    /// Component-wise maximum with a scalar.
    #[inline]
    pub fn max(self, v: f32) -> Self {
        self.map(|x| x.max(v))
    }
    /// Linear interpolation.
    #[inline]
    pub fn lerp(self, other: Self, t: f32) -> Self {
        self + (other - self) * t
    }
}

macro_rules! binary {
    ($trait:ident, $fn:ident, $op:tt) => {
        impl $trait for Rgb {
            type Output = Rgb;
            #[inline]
            fn $fn(self, o: Rgb) -> Rgb {
                Rgb::new(self.r $op o.r, self.g $op o.g, self.b $op o.b)
            }
        }
    };
}
binary!(Add, add, +);
binary!(Sub, sub, -);
binary!(Mul, mul, *);
binary!(Div, div, /);

impl Mul<f32> for Rgb {
    type Output = Rgb;
    #[inline]
    fn mul(self, s: f32) -> Rgb {
        Rgb::new(self.r * s, self.g * s, self.b * s)
    }
}
impl Mul<Rgb> for f32 {
    type Output = Rgb;
    #[inline]
    fn mul(self, c: Rgb) -> Rgb {
        c * self
    }
}
impl Div<f32> for Rgb {
    type Output = Rgb;
    #[inline]
    fn div(self, s: f32) -> Rgb {
        self * (1.0 / s)
    }
}
impl AddAssign for Rgb {
    #[inline]
    fn add_assign(&mut self, o: Rgb) {
        *self = *self + o;
    }
}
impl MulAssign for Rgb {
    #[inline]
    fn mul_assign(&mut self, o: Rgb) {
        *self = *self * o;
    }
}
impl MulAssign<f32> for Rgb {
    #[inline]
    fn mul_assign(&mut self, s: f32) {
        *self = *self * s;
    }
}
impl Index<usize> for Rgb {
    type Output = f32;
    #[inline]
    fn index(&self, i: usize) -> &f32 {
        match i {
            0 => &self.r,
            1 => &self.g,
            2 => &self.b,
            _ => panic!("Rgb has 3 components, asked for {i}"),
        }
    }
}
