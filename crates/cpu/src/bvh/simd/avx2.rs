//! The level with AVX2 and FMA. The box test fuses its products (the margin of `ray` allows for either rounding); the
//! triangle test does not, so that its bits are those of the portable level.

use super::{Near, Simd};
use crate::bvh::ray::TravRay;
use crate::bvh::triangle::{Packet, Sheared};
use crate::bvh::wide::WideNode;
use std::arch::x86_64::*;

pub(in crate::bvh) struct Avx2;

pub(in crate::bvh) struct RayAvx2 {
    rdir: [__m256; 3],
    near: [__m256; 3],
    far: [__m256; 3],
    t_min: __m256,
    /// Byte offsets of the near planes; those of the far ones differ in the bit of 32.
    near_at: [usize; 3],
    pub(super) triangle: TriangleRay,
}

/// The part of the ray that the triangle filter uses, axes in sheared order.
pub(in crate::bvh) struct TriangleRay {
    origin: [__m256; 3],
    shear: [__m256; 3],
    t_min: __m256,
    /// Byte offsets of the axes in a vertex.
    axes_at: [usize; 3],
}

impl Simd for Avx2 {
    type Ray = RayAvx2;

    #[inline(always)]
    unsafe fn ray(ray: &TravRay) -> RayAvx2 {
        // SAFETY: the caller vouches for AVX2.
        unsafe {
            RayAvx2 {
                rdir: splat(ray.rdir),
                near: splat(ray.near),
                far: splat(ray.far),
                t_min: _mm256_set1_ps(ray.t_min),
                near_at: [32 * ray.near_row[0], 32 * ray.near_row[1], 32 * ray.near_row[2]],
                triangle: triangle_ray(ray),
            }
        }
    }

    #[inline(always)]
    unsafe fn boxes(node: &WideNode, ray: &RayAvx2, t_best: f32, near: &mut Near) -> u32 {
        // SAFETY: the caller vouches for AVX2; `near_at` holds offsets of rows, and flipping the bit leads to their twins.
        unsafe {
            let [nx, ny, nz] = ray.near_at;
            let [fx, fy, fz] = [nx ^ 32, ny ^ 32, nz ^ 32];
            let [rx, ry, rz] = ray.rdir;
            let enter_x = _mm256_fmsub_ps(row(node, nx), rx, ray.near[0]);
            let enter_y = _mm256_fmsub_ps(row(node, ny), ry, ray.near[1]);
            let enter_z = _mm256_fmsub_ps(row(node, nz), rz, ray.near[2]);
            let leave_x = _mm256_fmsub_ps(row(node, fx), rx, ray.far[0]);
            let leave_y = _mm256_fmsub_ps(row(node, fy), ry, ray.far[1]);
            let leave_z = _mm256_fmsub_ps(row(node, fz), rz, ray.far[2]);
            let t0 = _mm256_max_ps(_mm256_max_ps(enter_x, enter_y), _mm256_max_ps(enter_z, ray.t_min));
            let t1 = _mm256_min_ps(
                _mm256_min_ps(leave_x, leave_y),
                _mm256_min_ps(leave_z, _mm256_set1_ps(t_best)),
            );
            _mm256_store_ps(near.0.as_mut_ptr(), t0);
            _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(t0, t1)) as u32
        }
    }

    #[inline(always)]
    unsafe fn triangles(packet: &Packet, ray: &RayAvx2, t_best: f32, sheared: &mut Sheared) -> u32 {
        // SAFETY: the caller vouches for AVX2.
        unsafe { triangles(packet, &ray.triangle, t_best, sheared) }
    }
}

/// # Safety
/// As [`Simd::ray`]; so for all below.
#[inline(always)]
pub(super) unsafe fn splat(v: [f32; 3]) -> [__m256; 3] {
    // SAFETY: the caller vouches for AVX2.
    unsafe { [_mm256_set1_ps(v[0]), _mm256_set1_ps(v[1]), _mm256_set1_ps(v[2])] }
}

/// # Safety
/// See [`splat`]; `at` is the byte offset of a row.
#[inline(always)]
pub(super) unsafe fn row(node: &WideNode, at: usize) -> __m256 {
    debug_assert!(at < 192 && at.is_multiple_of(32));
    // SAFETY: the caller vouches for AVX2 and `at`; rows are 32 bytes long in a node aligned to 64.
    unsafe { _mm256_load_ps(node.planes.as_ptr().byte_add(at).cast()) }
}

/// # Safety
/// See [`splat`].
#[inline(always)]
pub(super) unsafe fn triangle_ray(ray: &TravRay) -> TriangleRay {
    let [x, y, z] = ray.axes;
    // SAFETY: the caller vouches for AVX2.
    unsafe {
        TriangleRay {
            origin: [
                _mm256_set1_ps(ray.origin[x]),
                _mm256_set1_ps(ray.origin[y]),
                _mm256_set1_ps(ray.origin[z]),
            ],
            shear: [_mm256_set1_ps(ray.shear[0]), _mm256_set1_ps(ray.shear[1]), _mm256_set1_ps(ray.shear[2])],
            t_min: _mm256_set1_ps(ray.t_min),
            axes_at: [32 * x, 32 * y, 32 * z],
        }
    }
}

/// Vertex `v` of a packet in the frame of the ray.
///
/// # Safety
/// See [`splat`]; `v < 3`.
#[inline(always)]
unsafe fn vertex(packet: &Packet, ray: &TriangleRay, v: usize) -> [__m256; 3] {
    // SAFETY: the caller vouches for AVX2 and `v`; rows are 32 bytes long in a packet aligned to 64.
    unsafe {
        let rows = packet.rows.as_ptr().add(3 * v);
        let x = _mm256_sub_ps(_mm256_load_ps(rows.byte_add(ray.axes_at[0]).cast()), ray.origin[0]);
        let y = _mm256_sub_ps(_mm256_load_ps(rows.byte_add(ray.axes_at[1]).cast()), ray.origin[1]);
        let z = _mm256_sub_ps(_mm256_load_ps(rows.byte_add(ray.axes_at[2]).cast()), ray.origin[2]);
        [
            _mm256_sub_ps(x, _mm256_mul_ps(ray.shear[0], z)),
            _mm256_sub_ps(y, _mm256_mul_ps(ray.shear[1], z)),
            _mm256_mul_ps(ray.shear[2], z),
        ]
    }
}

/// # Safety
/// See [`splat`].
#[inline(always)]
unsafe fn edge(p: &[__m256; 3], q: &[__m256; 3]) -> __m256 {
    // SAFETY: the caller vouches for AVX2.
    unsafe { _mm256_sub_ps(_mm256_mul_ps(p[0], q[1]), _mm256_mul_ps(p[1], q[0])) }
}

/// # Safety
/// See [`splat`].
#[inline(always)]
pub(super) unsafe fn triangles(
    packet: &Packet,
    ray: &TriangleRay,
    t_best: f32,
    sheared: &mut Sheared,
) -> u32 {
    // SAFETY: the caller vouches for AVX2; rows of `sheared` are 32 bytes long.
    unsafe {
        let (a, b, c) = (vertex(packet, ray, 0), vertex(packet, ray, 1), vertex(packet, ray, 2));
        let (u, v, w) = (edge(&c, &b), edge(&a, &c), edge(&b, &a));
        let zero = _mm256_setzero_ps();
        let low = _mm256_cmp_ps::<_CMP_LT_OQ>(_mm256_min_ps(_mm256_min_ps(u, v), w), zero);
        let high = _mm256_cmp_ps::<_CMP_GT_OQ>(_mm256_max_ps(_mm256_max_ps(u, v), w), zero);
        let z_min = _mm256_min_ps(_mm256_min_ps(a[2], b[2]), c[2]);
        let z_max = _mm256_max_ps(_mm256_max_ps(a[2], b[2]), c[2]);
        let range = _mm256_and_ps(
            _mm256_cmp_ps::<_CMP_LE_OQ>(z_min, _mm256_set1_ps(t_best)),
            _mm256_cmp_ps::<_CMP_GT_OQ>(z_max, ray.t_min),
        );
        let mask = _mm256_movemask_ps(_mm256_andnot_ps(_mm256_and_ps(low, high), range)) as u32;
        if mask != 0 {
            let rows = [a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2]];
            for (to, value) in sheared.iter_mut().zip(rows) {
                _mm256_storeu_ps(to.as_mut_ptr(), value);
            }
        }
        mask
    }
}
