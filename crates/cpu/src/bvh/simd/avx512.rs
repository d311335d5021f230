//! The level with AVX-512 on 256-bit vectors (VL): comparisons into mask registers and twice as many registers.

use super::avx2::{self, TriangleRay};
use super::{Near, Simd};
use crate::bvh::ray::TravRay;
use crate::bvh::triangle::{Packet, Sheared};
use crate::bvh::wide::WideNode;
use std::arch::x86_64::*;

pub(in crate::bvh) struct Avx512;

pub(in crate::bvh) struct RayAvx512 {
    rdir: [__m256; 3],
    near: [__m256; 3],
    far: [__m256; 3],
    t_min: __m256,
    /// Byte offsets of the near planes; those of the far ones differ in the bit of 32.
    near_at: [usize; 3],
    triangle: TriangleRay,
}

impl Simd for Avx512 {
    type Ray = RayAvx512;

    #[inline(always)]
    unsafe fn ray(ray: &TravRay) -> RayAvx512 {
        // SAFETY: the caller vouches for AVX-512.
        unsafe {
            RayAvx512 {
                rdir: avx2::splat(ray.rdir),
                near: avx2::splat(ray.near),
                far: avx2::splat(ray.far),
                t_min: _mm256_set1_ps(ray.t_min),
                near_at: [32 * ray.near_row[0], 32 * ray.near_row[1], 32 * ray.near_row[2]],
                triangle: avx2::triangle_ray(ray),
            }
        }
    }

    #[inline(always)]
    unsafe fn boxes(node: &WideNode, ray: &RayAvx512, t_best: f32, near: &mut Near) -> u32 {
        // SAFETY: the caller vouches for AVX-512; `near_at` holds offsets of rows, and flipping the bit leads to their twins.
        unsafe {
            let [nx, ny, nz] = ray.near_at;
            let [fx, fy, fz] = [nx ^ 32, ny ^ 32, nz ^ 32];
            let [rx, ry, rz] = ray.rdir;
            let enter_x = _mm256_fmsub_ps(avx2::row(node, nx), rx, ray.near[0]);
            let enter_y = _mm256_fmsub_ps(avx2::row(node, ny), ry, ray.near[1]);
            let enter_z = _mm256_fmsub_ps(avx2::row(node, nz), rz, ray.near[2]);
            let leave_x = _mm256_fmsub_ps(avx2::row(node, fx), rx, ray.far[0]);
            let leave_y = _mm256_fmsub_ps(avx2::row(node, fy), ry, ray.far[1]);
            let leave_z = _mm256_fmsub_ps(avx2::row(node, fz), rz, ray.far[2]);
            let t0 = _mm256_max_ps(_mm256_max_ps(enter_x, enter_y), _mm256_max_ps(enter_z, ray.t_min));
            let t1 = _mm256_min_ps(
                _mm256_min_ps(leave_x, leave_y),
                _mm256_min_ps(leave_z, _mm256_set1_ps(t_best)),
            );
            _mm256_store_ps(near.0.as_mut_ptr(), t0);
            u32::from(_mm256_cmp_ps_mask::<_CMP_LE_OQ>(t0, t1))
        }
    }

    #[inline(always)]
    unsafe fn triangles(packet: &Packet, ray: &RayAvx512, t_best: f32, sheared: &mut Sheared) -> u32 {
        // SAFETY: AVX-512 includes AVX2.
        unsafe { avx2::triangles(packet, &ray.triangle, t_best, sheared) }
    }
}
