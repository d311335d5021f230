//! The media that a path begins in, as shaders hold them: which solids and their indices; what they absorb is looked up by material.
//! Twin: `MediumStack` of `glsl/medium.glsl`.

use bytemuck::{Pod, Zeroable};
use lumbre_core::medium::{DEPTH, Medium, MediumStack};

/// A stack of media, the innermost first; `Medium::VACUUM` from where there is none.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct MediumStackRecord {
    /// The materials that bound them.
    pub material: [u32; DEPTH],
    /// Indices of refraction.
    pub ior: [f32; DEPTH],
}

impl From<&MediumStack> for MediumStackRecord {
    fn from(stack: &MediumStack) -> Self {
        let media = stack.as_slice();
        let at = |i: usize| media.len().checked_sub(i + 1).map_or(Medium::VACUUM, |i| media[i]);
        MediumStackRecord {
            material: core::array::from_fn(|i| at(i).material),
            ior: core::array::from_fn(|i| at(i).ior),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_innermost_comes_first() {
        let medium = |material| Medium { material, ior: material as f32, ..Medium::VACUUM };
        let mut stack = MediumStack::default();
        stack.enter(medium(3));
        stack.enter(medium(5));
        let record = MediumStackRecord::from(&stack);
        assert_eq!(record.material, [5, 3, u32::MAX, u32::MAX]);
        assert_eq!(record.ior, [5.0, 3.0, 1.0, 1.0]);
    }
}
