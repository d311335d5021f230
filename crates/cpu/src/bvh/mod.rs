//! The two-level bounding volume hierarchy: a [`Tlas`] over instances, a [`Blas`] per mesh. Fast, exact and deterministic.
//!
//! # What it promises
//! - A hit is a pure function of the scene and the ray: [`Tlas::closest_hit`] returns what asking every triangle of every
//!   instance would, ties in `t` going to the smallest (instance, triangle). Boxes cull conservatively against the rounding of
//!   the triangle test (proof in `ray.rs`), so that neither the order of traversal nor the SIMD level shows.
//! - Meshes are watertight along shared edges and vertices (`triangle.rs`).
//! - Trees do not depend on the number of threads that build them.
//!
//! # What was chosen, and why
//! - **Eight-wide nodes of plain floats**, as Embree's BVH8 and tinybvh's BVH8_CPU: one AVX2 vector per plane. Compressed
//!   nodes (obvhs, Ylitie et al. 2017) save memory that a CPU's caches do not miss as much as it costs to unpack.
//! - **Binned SAH, then an optimal collapse.** Embree opens the child of largest area while it builds; we build
//!   binary, which parallelises cleanly over disjoint slices, and choose the children by dynamic programming,
//!   which also decides how many packets of triangles a leaf holds.
//! - **Packets of eight triangles with their vertices in place**: no indirection, and the original floats, which the
//!   watertight test needs. Embree and tinybvh take four; eight cost the same instructions here, fill just as well (the
//!   heuristic counts packets, not triangles) and halve the nodes: 5 to 10 % faster on all rays, 20 % faster to build.
//! - **One ray at a time**: path tracing sends incoherent rays, for which packets gain nothing (measured on Embree).
//! - **Distance-sorted children** as in Embree, rather than tinybvh's fixed order per octant: fewer nodes visited after
//!   the first bounce.
//! - **Children are prefetched** as they are found: 15 % on diffuse bounces, which wait for memory more than for anything.
//! - **Dispatch at the top** of each query to a copy of the whole traversal compiled for that level.
//!
//! Left out: spatial splits, motion keys (see `instance.rs` for the room left for them), refitting of a [`Blas`].

mod binary;
mod blas;
mod bounds;
mod collapse;
mod instance;
mod query;
mod ray;
mod simd;
#[cfg(test)]
mod tests;
mod tlas;
mod traverse;
mod triangle;
mod wide;

pub use blas::Blas;
pub use instance::InstanceDesc;
pub use simd::{SimdLevel, UnknownSimdLevel};
pub use tlas::Tlas;

/// Where a ray meets a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance in units of the length of the ray's direction.
    pub t: f32,
    /// Index of the instance.
    pub instance: u32,
    /// Index of the triangle in its mesh.
    pub triangle: u32,
    /// Barycentric coordinate of vertex 1; that of vertex 0 is `1 - b1 - b2`.
    pub b1: f32,
    /// Barycentric coordinate of vertex 2.
    pub b2: f32,
}

impl Hit {
    #[inline(always)]
    fn new(instance: u32, triangle: u32, hit: triangle::TriangleHit) -> Hit {
        Hit { t: hit.t, instance, triangle, b1: hit.b1, b2: hit.b2 }
    }
}
