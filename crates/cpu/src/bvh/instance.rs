//! Instances: meshes placed in the world, and the boxes that hold them whatever rounding does.
//!
//! A ray is taken into the space of the mesh, its direction not normalised, so that `t` is the same number in both. Box
//! tests in the world must not miss what the triangle test finds there: with `k = |M| |M^-1|` (largest row sums) of the
//! transform, rounding of the inverse, of origin and direction, and of the test itself moves the ray by less than
//! `32 u k (|o| + R + 2 |T|)` metres in the world (`u`, `R` as in [`super::ray`], `T` the translation). For
//! origins within four times the scene's extent `S` from zero, `|o| + R <= 9 S`, which the boxes are enlarged by; for those
//! beyond, `R <= 1.25 |o|`, and the ray brings a margin of its own, with the largest `k` of the scene.
//!
//! Keyed instances will add more transforms to [`InstanceDesc`], of which the ray's `time` picks one; their box is then
//! the union over the keys.

use super::blas::Blas;
use super::bounds::Bounds;
use super::ray::MAX_COORDINATE;
use glam::{Affine3A, DAffine3, DVec3, Vec3, Vec3A};
use std::sync::Arc;

/// Beyond this `|M| |M^-1|` a transform counts as singular: its inverse would be rounding noise.
const MAX_CONDITION: f64 = (1u64 << 28) as f64;
/// `32 u`.
const ROUNDING: f64 = 1.0 / (1u64 << 19) as f64;
/// See the head of this file.
const NEAR_ORIGINS: f64 = 4.0;

/// One placement of a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InstanceDesc {
    /// Index of the mesh in the list given to [`super::Tlas::build`].
    pub blas: u32,
    /// From the space of the mesh to the world. If singular, the instance is never hit.
    pub object_to_world: Affine3A,
    /// Queries with a mask see the instances that share a bit with it; others see all with any bit set.
    pub mask: u32,
    /// Whether every hit counts, so that queries need not ask their filter.
    pub opaque: bool,
}

impl InstanceDesc {
    /// An opaque instance, visible to all queries.
    pub fn new(blas: u32, object_to_world: Affine3A) -> Self {
        InstanceDesc { blas, object_to_world, mask: u32::MAX, opaque: true }
    }
}

/// An instance as it is traversed.
#[derive(Clone, Debug)]
pub(super) struct Instance {
    world_to_object: Affine3A,
    identity: bool,
    pub(super) hittable: bool,
    pub(super) opaque: bool,
    pub(super) mask: u32,
    pub(super) blas: u32,
}

impl Instance {
    /// A ray in the space of the mesh.
    #[inline(always)]
    pub(super) fn to_object(&self, origin: Vec3, dir: Vec3) -> (Vec3, Vec3) {
        if self.identity {
            return (origin, dir);
        }
        let o = self.world_to_object.transform_point3a(Vec3A::from(origin));
        let d = self.world_to_object.transform_vector3a(Vec3A::from(dir));
        (o.into(), d.into())
    }
}

/// All instances, and the world boxes of those that can be hit.
pub(super) struct Placed {
    pub(super) instances: Vec<Instance>,
    pub(super) boxes: Vec<(u32, Bounds)>,
    pub(super) far_margin: f32,
    pub(super) far_from: f32,
}

struct Transform {
    to_object: Affine3A,
    condition: f64,
    lo: DVec3,
    hi: DVec3,
    translation: f64,
}

/// Places the instances; panics if one names no mesh.
pub(super) fn place(descs: &[InstanceDesc], blas: &[Arc<Blas>]) -> Placed {
    let transforms: Vec<Option<Transform>> = descs
        .iter()
        .enumerate()
        .map(|(i, d)| {
            let count = blas.len();
            let blas = blas.get(d.blas as usize);
            let blas = blas.unwrap_or_else(|| panic!("instance {i}: mesh {} of {count}", d.blas));
            blas.bounds().and_then(|b| transform(&d.object_to_world, b))
        })
        .collect();
    let placed = || transforms.iter().flatten();
    let extent = placed().map(|t| t.lo.abs().max(t.hi.abs()).max_element()).fold(0.0, f64::max);
    let condition = placed().map(|t| t.condition).fold(0.0, f64::max);
    let instances = descs
        .iter()
        .zip(&transforms)
        .map(|(d, t)| Instance {
            world_to_object: t.as_ref().map_or(Affine3A::IDENTITY, |t| t.to_object),
            identity: d.object_to_world == Affine3A::IDENTITY,
            hittable: t.is_some(),
            opaque: d.opaque,
            mask: d.mask,
            blas: d.blas,
        })
        .collect();
    let enlarge = |t: &Transform| {
        let by = ROUNDING * t.condition * ((2.0 * NEAR_ORIGINS + 1.0) * extent + 2.0 * t.translation);
        Bounds::new(round_down(t.lo - by), -round_down(-(t.hi + by)))
    };
    Placed {
        instances,
        boxes: transforms
            .iter()
            .enumerate()
            .filter_map(|(i, t)| t.as_ref().map(|t| (i as u32, enlarge(t))))
            .collect(),
        far_margin: (4.0 * ROUNDING * condition) as f32,
        far_from: (NEAR_ORIGINS * extent) as f32,
    }
}

/// `None` if singular, not finite, or placed beyond the domain.
fn transform(to_world: &Affine3A, (lo, hi): (Vec3, Vec3)) -> Option<Transform> {
    let m = DAffine3::from_cols_array(&to_world.to_cols_array().map(f64::from));
    let determinant = m.matrix3.determinant();
    if !(m.is_finite() && determinant != 0.0) {
        return None;
    }
    let inverse = m.inverse();
    let to_object = Affine3A::from_cols_array(&inverse.to_cols_array().map(|x| x as f32));
    let row_sum = |m: &DAffine3| {
        let m = m.matrix3;
        (m.x_axis.abs() + m.y_axis.abs() + m.z_axis.abs()).max_element()
    };
    let condition = row_sum(&m) * row_sum(&inverse);
    // The box of the transformed box: centre and half extent (Arvo 1990, "Transforming Axis-Aligned Bounding Boxes").
    let (lo, hi) = (lo.as_dvec3(), hi.as_dvec3());
    let (centre, half) = ((lo + hi) * 0.5, (hi - lo) * 0.5);
    let c = m.transform_point3(centre);
    let h =
        m.matrix3.x_axis.abs() * half.x + m.matrix3.y_axis.abs() * half.y + m.matrix3.z_axis.abs() * half.z;
    let inside = c.abs().max_element() + h.max_element() <= f64::from(MAX_COORDINATE) / 16.0;
    // Comparisons with NaN are false.
    (condition <= MAX_CONDITION && to_object.is_finite() && inside).then_some(Transform {
        to_object,
        condition,
        lo: c - h,
        hi: c + h,
        translation: m.translation.abs().max_element(),
    })
}

/// The nearest floats below.
fn round_down(v: DVec3) -> Vec3 {
    Vec3::from_array(v.to_array().map(|x| (x as f32).next_down()))
}
