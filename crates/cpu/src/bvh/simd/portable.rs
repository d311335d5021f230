//! The level without any particular instructions: loops over lanes that compilers vectorise as far as they can.

use super::{Near, Simd};
use crate::bvh::collapse::WIDTH;
use crate::bvh::ray::TravRay;
use crate::bvh::triangle::{self, Packet, Sheared, max, min};
use crate::bvh::wide::WideNode;

pub(in crate::bvh) struct Portable;

impl Simd for Portable {
    type Ray = TravRay;

    #[inline(always)]
    unsafe fn ray(ray: &TravRay) -> TravRay {
        *ray
    }

    #[inline(always)]
    unsafe fn boxes(node: &WideNode, ray: &TravRay, t_best: f32, near: &mut Near) -> u32 {
        let mut enter = [ray.t_min; WIDTH];
        let mut leave = [t_best; WIDTH];
        for axis in 0..3 {
            let row = ray.near_row[axis];
            let (lo, hi) = (&node.planes[row], &node.planes[row ^ 1]);
            for lane in 0..WIDTH {
                enter[lane] = max(lo[lane] * ray.rdir[axis] - ray.near[axis], enter[lane]);
                leave[lane] = min(hi[lane] * ray.rdir[axis] - ray.far[axis], leave[lane]);
            }
        }
        let mut mask = 0;
        for lane in 0..WIDTH {
            mask |= ((enter[lane] <= leave[lane]) as u32) << lane;
        }
        near.0 = enter;
        mask
    }

    #[inline(always)]
    unsafe fn triangles(packet: &Packet, ray: &TravRay, t_best: f32, sheared: &mut Sheared) -> u32 {
        triangle::filter(packet, ray, t_best, sheared)
    }
}
