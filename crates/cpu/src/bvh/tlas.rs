//! The upper level: instances of meshes in world space, and the queries.

use super::Hit;
use super::binary::{BinaryTree, BuildParams, Prim};
use super::blas::Blas;
use super::bounds::Bounds;
use super::instance::{Instance, InstanceDesc, place};
use super::query::{Any, Closest, Query};
use super::ray::TravRay;
use super::simd::portable::Portable;
use super::simd::{Simd, SimdLevel};
use super::traverse::{Leaf, walk};
use super::wide::{Child, WideNode, collapse};
use glam::Vec3;
use lumbre_core::Ray;
use std::marker::PhantomData;
use std::sync::Arc;

const PARAMS: BuildParams = BuildParams { block: 1, max_leaf_blocks: 1, block_cost: 4.0 };

/// The tree over all instances of a scene: what rays are traced against.
#[derive(Clone, Debug)]
pub struct Tlas {
    nodes: Vec<WideNode>,
    root: Option<Child>,
    bounds: Bounds,
    instances: Vec<Instance>,
    blas: Vec<Arc<Blas>>,
    /// Margin of the boxes per metre of distance, for rays from far outside; see `instance`.
    far_margin: f32,
    /// Distance of an origin from zero beyond which that margin counts.
    far_from: f32,
    level: SimdLevel,
}

impl Tlas {
    /// Builds the tree over `instances`, which index `blas`; a hit names an instance by its place in `instances`.
    ///
    /// Instances that cannot be hit are left out: those of empty meshes, with a transform that is singular or not finite.
    /// The traversal uses the best SIMD level of the processor; see [`Tlas::with_level`].
    ///
    /// # Panics
    /// If an instance names no mesh in `blas`.
    pub fn build(instances: &[InstanceDesc], blas: Vec<Arc<Blas>>) -> Tlas {
        let placed = place(instances, &blas);
        let prims =
            placed.boxes.iter().map(|&(id, b)| Prim::new(b.lo.truncate(), b.hi.truncate(), id)).collect();
        let (nodes, root, bounds) = match BinaryTree::build(prims, PARAMS) {
            None => (Vec::new(), None, Bounds::EMPTY),
            Some(tree) => {
                let (nodes, root) =
                    collapse(&tree, |first, _| Child::instance(tree.prims[first as usize].id()));
                let top = &tree.nodes[0];
                let bounds = Bounds::new(Vec3::from_array(top.lo), Vec3::from_array(top.hi));
                (nodes, Some(root), bounds)
            }
        };
        Tlas {
            nodes,
            root,
            bounds,
            instances: placed.instances,
            blas,
            far_margin: placed.far_margin,
            far_from: placed.far_from,
            level: SimdLevel::best(),
        }
    }

    /// The same scene with instances moved, added or removed, over the same meshes.
    pub fn update(&mut self, instances: &[InstanceDesc]) {
        *self = Tlas::build(instances, std::mem::take(&mut self.blas)).with_level(self.level);
    }

    /// Traverses with `level` from now on.
    ///
    /// # Panics
    /// If the processor does not support it.
    pub fn with_level(mut self, level: SimdLevel) -> Tlas {
        assert!(level.is_supported(), "this processor does not support {}", level.name());
        self.level = level;
        self
    }

    /// The SIMD level in use.
    pub fn level(&self) -> SimdLevel {
        self.level
    }

    /// The world box around all instances that can be hit, slightly enlarged; `None` if there are none.
    pub fn bounds(&self) -> Option<(Vec3, Vec3)> {
        self.root.map(|_| (self.bounds.lo.truncate(), self.bounds.hi.truncate()))
    }

    /// Memory held, in bytes, without that of the meshes, which other trees may share.
    pub fn memory(&self) -> usize {
        size_of_val(&self.nodes[..]) + size_of_val(&self.instances[..])
    }

    /// The meshes.
    pub fn blas(&self) -> &[Arc<Blas>] {
        &self.blas
    }

    /// The nearest hit with `t_min < t < t_max` that `filter` accepts. `t_min` below zero counts as zero.
    ///
    /// Of several at the same `t`, the one with the smallest (instance, triangle). `filter` is asked on instances that are
    /// not opaque only; it may see hits in any order, and some twice, and must always answer the same about the same hit.
    /// A ray that is not finite, or whose direction is zero, hits nothing.
    #[inline]
    pub fn closest_hit(&self, ray: &Ray, filter: impl FnMut(&Hit) -> bool) -> Option<Hit> {
        self.closest_hit_masked(ray, u32::MAX, filter)
    }

    /// As [`Tlas::closest_hit`], of instances only whose mask shares a bit with `mask`.
    #[inline]
    pub fn closest_hit_masked(&self, ray: &Ray, mask: u32, filter: impl FnMut(&Hit) -> bool) -> Option<Hit> {
        // SAFETY: `level` is supported, as `with_level` and `best` see to.
        unsafe {
            match self.level {
                SimdLevel::Portable => self.closest::<Portable>(ray, mask, filter),
                #[cfg(target_arch = "x86_64")]
                SimdLevel::Avx2 => self.closest_avx2(ray, mask, filter),
                #[cfg(target_arch = "x86_64")]
                SimdLevel::Avx512 => self.closest_avx512(ray, mask, filter),
                #[cfg(not(target_arch = "x86_64"))]
                _ => self.closest::<Portable>(ray, mask, filter),
            }
        }
    }

    /// Whether there is any hit with `t_min < t < t_max` that `filter` accepts, as for [`Tlas::closest_hit`].
    #[inline]
    pub fn any_hit(&self, ray: &Ray, filter: impl FnMut(&Hit) -> bool) -> bool {
        self.any_hit_masked(ray, u32::MAX, filter)
    }

    /// As [`Tlas::any_hit`], of instances only whose mask shares a bit with `mask`.
    #[inline]
    pub fn any_hit_masked(&self, ray: &Ray, mask: u32, filter: impl FnMut(&Hit) -> bool) -> bool {
        // SAFETY: `level` is supported, as `with_level` and `best` see to.
        unsafe {
            match self.level {
                SimdLevel::Portable => self.any::<Portable>(ray, mask, filter),
                #[cfg(target_arch = "x86_64")]
                SimdLevel::Avx2 => self.any_avx2(ray, mask, filter),
                #[cfg(target_arch = "x86_64")]
                SimdLevel::Avx512 => self.any_avx512(ray, mask, filter),
                #[cfg(not(target_arch = "x86_64"))]
                _ => self.any::<Portable>(ray, mask, filter),
            }
        }
    }

    /// As [`Tlas::closest_hit`], by asking every triangle of every instance: the plain version to compare with.
    pub fn closest_hit_brute(&self, ray: &Ray, filter: impl FnMut(&Hit) -> bool) -> Option<Hit> {
        let mut query = Closest::new(ray.t_max, filter);
        let mut t_best = ray.t_max;
        for (index, instance) in self.instances.iter().enumerate().filter(|(_, i)| i.hittable && i.mask != 0)
        {
            let blas = &self.blas[instance.blas as usize];
            if let Some(object) = self.object_ray(instance, blas, ray) {
                blas.trace_brute(&object, &mut t_best, (index as u32, instance.opaque), &mut query);
            }
        }
        query.into_hit()
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    fn closest_avx2(&self, ray: &Ray, mask: u32, filter: impl FnMut(&Hit) -> bool) -> Option<Hit> {
        // SAFETY: this function is compiled for the level and called at that level only.
        unsafe { self.closest::<super::simd::avx2::Avx2>(ray, mask, filter) }
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt,avx512f,avx512vl,avx512dq,avx512bw")]
    fn closest_avx512(&self, ray: &Ray, mask: u32, filter: impl FnMut(&Hit) -> bool) -> Option<Hit> {
        // SAFETY: this function is compiled for the level and called at that level only.
        unsafe { self.closest::<super::simd::avx512::Avx512>(ray, mask, filter) }
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    fn any_avx2(&self, ray: &Ray, mask: u32, filter: impl FnMut(&Hit) -> bool) -> bool {
        // SAFETY: this function is compiled for the level and called at that level only.
        unsafe { self.any::<super::simd::avx2::Avx2>(ray, mask, filter) }
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt,avx512f,avx512vl,avx512dq,avx512bw")]
    fn any_avx512(&self, ray: &Ray, mask: u32, filter: impl FnMut(&Hit) -> bool) -> bool {
        // SAFETY: this function is compiled for the level and called at that level only.
        unsafe { self.any::<super::simd::avx512::Avx512>(ray, mask, filter) }
    }

    /// # Safety
    /// The processor must support `S`; so for the functions below.
    #[inline(always)]
    unsafe fn closest<S: Simd>(&self, ray: &Ray, mask: u32, filter: impl FnMut(&Hit) -> bool) -> Option<Hit> {
        let mut query = Closest::new(ray.t_max, filter);
        // SAFETY: the caller vouches for the level.
        unsafe { self.trace::<S, _>(ray, mask, &mut query) };
        query.into_hit()
    }

    /// # Safety
    /// See [`Tlas::closest`].
    #[inline(always)]
    unsafe fn any<S: Simd>(&self, ray: &Ray, mask: u32, filter: impl FnMut(&Hit) -> bool) -> bool {
        let mut query = Any { t_max: ray.t_max, found: false, filter };
        // SAFETY: the caller vouches for the level.
        unsafe { self.trace::<S, _>(ray, mask, &mut query) };
        query.found
    }

    /// # Safety
    /// See [`Tlas::closest`].
    #[inline(always)]
    unsafe fn trace<S: Simd, Q: Query>(&self, ray: &Ray, mask: u32, query: &mut Q) {
        let Some(root) = self.root else { return };
        let mut t_best = ray.t_max;
        let mut leaf = InstanceLeaf::<S, Q> { tlas: self, ray, mask, query, level: PhantomData };
        // SAFETY: the caller vouches for the level, and the tree is as it was built.
        unsafe {
            if root.is_leaf() {
                // A lone instance needs no box test: that of its mesh follows at once.
                leaf.visit(root, &mut t_best);
                return;
            }
            let distance = ray.origin.abs().max_element();
            let margin = if distance > self.far_from { self.far_margin * distance } else { 0.0 };
            let Some(world) = TravRay::new(ray.origin, ray.dir, ray.t_min, &self.bounds, margin) else {
                return;
            };
            walk::<S>(&self.nodes, root, &S::ray(&world), &mut t_best, &mut leaf);
        }
    }

    /// The ray in the space of an instance's mesh.
    #[inline(always)]
    fn object_ray(&self, instance: &Instance, blas: &Blas, ray: &Ray) -> Option<TravRay> {
        let (origin, dir) = instance.to_object(ray.origin, ray.dir);
        TravRay::new(origin, dir, ray.t_min, &blas.bounds, 0.0)
    }
}

/// The instance at a leaf.
struct InstanceLeaf<'a, S, Q> {
    tlas: &'a Tlas,
    ray: &'a Ray,
    mask: u32,
    query: &'a mut Q,
    level: PhantomData<S>,
}

impl<S: Simd, Q: Query> Leaf for InstanceLeaf<'_, S, Q> {
    #[inline(always)]
    fn address(&self, child: Child) -> *const u8 {
        self.tlas.instances.as_ptr().wrapping_add(child.instance_index() as usize).cast()
    }

    #[inline(always)]
    unsafe fn visit(&mut self, child: Child, t_best: &mut f32) -> bool {
        let index = child.instance_index();
        debug_assert!((index as usize) < self.tlas.instances.len());
        // SAFETY: leaves index the instances built with them, of which each names a mesh.
        let (instance, blas) = unsafe {
            let instance = self.tlas.instances.get_unchecked(index as usize);
            (instance, self.tlas.blas.get_unchecked(instance.blas as usize))
        };
        if instance.mask & self.mask == 0 {
            return false;
        }
        let Some(object) = self.tlas.object_ray(instance, blas, self.ray) else { return false };
        // SAFETY: the caller vouches for the level.
        unsafe { blas.trace::<S, Q>(&object, t_best, (index, instance.opaque), self.query) }
    }
}
