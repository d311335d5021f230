//! The scene as rays see it: acceleration structures, and hits in terms of the compiled scene.
//!
//! Meshes that stand in the world once are merged into one structure in world space (one for each kind of any-hit work, so that
//! the leaves of a tree do not make its trunk ask for alpha), so that a scene of a hundred parts does
//! not send each ray through a hundred trees with a transform each (what Embree's users do by putting all shapes into one scene).
//! Meshes used more than once keep one structure each, shared by their instances.
//!
//! Where a scene is to be edited ([`CpuOptions::merge`]), each mesh keeps structures of its own (`apart.rs`): moving it, hiding it or
//! changing its materials leaves them as they are.

mod apart;

use crate::bvh::{Blas, Hit, InstanceDesc, SimdLevel, Tlas};
use apart::Part;
use glam::{Affine3A, Vec3};
use lumbre_core::Ray;
use lumbre_scene::compiled::geometry::{InstanceRecord, MeshRecord};
use lumbre_scene::compiled::material::MaterialRecord;
use lumbre_scene::{CompiledScene, SceneChanges};
use rayon::prelude::*;
use std::sync::Arc;

/// How a scene is put into acceleration structures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CpuOptions {
    /// Meshes that stand in the world once share structures. Rays are then faster, and what [`Accel::update`] has to do for a mesh that
    /// moves is to build all anew.
    pub merge: bool,
}

impl Default for CpuOptions {
    fn default() -> Self {
        CpuOptions { merge: true }
    }
}

/// Acceleration structures of a scene.
#[derive(Debug)]
pub struct Accel {
    options: CpuOptions,
    tlas: Tlas,
    /// The same, asked about every hit where back faces are invisible to the camera; `None` if there are none.
    camera_tlas: Option<Tlas>,
    /// Where the hits of each instance of `tlas` lie in the scene.
    origins: Vec<Origin>,
    /// The structures, where meshes are not merged.
    parts: Vec<Part>,
}

/// Instances of the top level while they are collected.
#[derive(Default)]
struct Instances {
    descs: Vec<InstanceDesc>,
    classes: Vec<Class>,
    origins: Vec<Origin>,
}

/// Where the triangles of one instance of the acceleration structure come from.
#[derive(Debug)]
enum Origin {
    /// An instance of the scene.
    Instance(u32),
    /// Some triangles of an instance of the scene.
    Part(u32, Arc<[u32]>),
    /// Many: instance and triangle of each.
    Merged(Vec<[u32; 2]>),
}

impl Origin {
    #[inline]
    fn restore(&self, hit: &Hit) -> Hit {
        match self {
            Origin::Instance(instance) => Hit { instance: *instance, ..*hit },
            Origin::Part(instance, triangles) => {
                Hit { instance: *instance, triangle: triangles[hit.triangle as usize], ..*hit }
            }
            Origin::Merged(triangles) => {
                let [instance, triangle] = triangles[hit.triangle as usize];
                Hit { instance, triangle, ..*hit }
            }
        }
    }
}

/// What any-hit work an instance needs: merged geometry must agree on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Class {
    opaque: bool,
    culls: bool,
}

impl Class {
    const ALL: [Class; 4] = [
        Class { opaque: true, culls: false },
        Class { opaque: true, culls: true },
        Class { opaque: false, culls: false },
        Class { opaque: false, culls: true },
    ];

    fn of_mesh(mesh: &MeshRecord) -> Self {
        Class { opaque: mesh.opaque == 1, culls: mesh.culls == 1 }
    }

    fn of_material(material: &MaterialRecord) -> Self {
        Class { opaque: material.is_opaque(), culls: material.culls_back_faces() }
    }

    fn of_triangle(scene: &CompiledScene, triangle: usize) -> Self {
        Class::of_material(&scene.materials[scene.triangle_materials[triangle] as usize])
    }
}

impl Accel {
    /// Builds the structures.
    pub fn new(scene: &CompiledScene) -> Self {
        Accel::with_options(scene, CpuOptions::default())
    }

    /// Builds the structures as `options` ask.
    pub fn with_options(scene: &CompiledScene, options: CpuOptions) -> Self {
        if options.merge {
            let (instances, blas) = merged(scene);
            return Accel::over(instances, blas, options);
        }
        Accel::apart(scene, apart::parts(scene, &[]), options)
    }

    /// Structures of parts, and the top level over them.
    fn apart(scene: &CompiledScene, parts: Vec<Part>, options: CpuOptions) -> Self {
        let (instances, blas) =
            (apart::instances(scene, &parts), parts.iter().map(|p| p.blas.clone()).collect());
        Accel { parts, ..Accel::over(instances, blas, options) }
    }

    /// The top level over structures.
    fn over(
        Instances { descs, classes, origins }: Instances,
        blas: Vec<Arc<Blas>>,
        options: CpuOptions,
    ) -> Self {
        let tlas = |opaque: fn(&Class) -> bool| {
            let with = |(d, c): (&InstanceDesc, &Class)| InstanceDesc { opaque: opaque(c), ..*d };
            Tlas::build(&descs.iter().zip(&classes).map(with).collect::<Vec<_>>(), blas.clone())
        };
        let culls = classes.iter().any(|c| c.culls);
        Accel {
            options,
            tlas: tlas(|c| c.opaque),
            camera_tlas: culls.then(|| tlas(|c| c.opaque && !c.culls)),
            origins,
            parts: Vec::new(),
        }
    }

    /// Brings the structures of `before` up to date with `after`, which differs in `changes`: they are then those that would be built of
    /// it. Where meshes are not merged, those that move or are hidden cost the top level only, and so do those that become opaque or
    /// cease to be, unless other parts of them do not.
    pub fn update(&mut self, before: &CompiledScene, after: &CompiledScene, changes: SceneChanges) {
        let options = self.options;
        let reclassed = classes(before).ne(classes(after));
        let made = if changes.geometry() || ranges(before).ne(ranges(after)) {
            Accel::with_options(after, options)
        } else if !reclassed && !moved(before, after, changes) {
            return;
        } else if options.merge {
            Accel::with_options(after, options)
        } else {
            let earlier = std::mem::take(&mut self.parts);
            let parts = if reclassed { apart::parts(after, &earlier) } else { earlier };
            Accel::apart(after, parts, options)
        };
        *self = made.with_level(self.level());
    }

    /// Traverses with `level` from now on; hits stay the same.
    ///
    /// # Panics
    /// If the processor does not support it.
    pub fn with_level(self, level: SimdLevel) -> Self {
        Accel {
            tlas: self.tlas.with_level(level),
            camera_tlas: self.camera_tlas.map(|t| t.with_level(level)),
            ..self
        }
    }

    /// Memory held, in bytes.
    pub fn memory(&self) -> usize {
        let merged = |o: &Origin| match o {
            Origin::Instance(_) => 0,
            // Shared by the instances of a mesh.
            Origin::Part(..) => 0,
            Origin::Merged(triangles) => size_of_val(&triangles[..]),
        };
        let meshes: usize = self.tlas.blas().iter().map(|b| b.memory()).sum();
        let trunks = self.tlas.memory() + self.camera_tlas.as_ref().map_or(0, Tlas::memory);
        let origins = size_of_val(&self.origins[..]) + self.origins.iter().map(merged).sum::<usize>();
        let parts: usize =
            self.parts.iter().filter_map(|p| p.triangles.as_ref()).map(|t| size_of_val(&t[..])).sum();
        meshes + trunks + origins + parts
    }

    /// The structures under the top level.
    pub fn structures(&self) -> &[Arc<Blas>] {
        self.tlas.blas()
    }

    /// The SIMD level in use.
    pub fn level(&self) -> SimdLevel {
        self.tlas.level()
    }

    /// The closest hit that `filter` accepts; it is asked about surfaces that are not opaque.
    #[inline]
    pub fn closest_hit(&self, ray: &Ray, filter: impl FnMut(&Hit) -> bool) -> Option<Hit> {
        self.closest(&self.tlas, ray, filter)
    }

    /// The same for camera rays: `filter` is also asked about surfaces whose back faces may be invisible.
    #[inline]
    pub fn closest_hit_camera(&self, ray: &Ray, filter: impl FnMut(&Hit) -> bool) -> Option<Hit> {
        self.closest(self.camera_tlas.as_ref().unwrap_or(&self.tlas), ray, filter)
    }

    #[inline]
    fn closest(&self, tlas: &Tlas, ray: &Ray, mut filter: impl FnMut(&Hit) -> bool) -> Option<Hit> {
        let restore = |hit: &Hit| self.origins[hit.instance as usize].restore(hit);
        tlas.closest_hit(ray, |hit| filter(&restore(hit))).map(|hit| restore(&hit))
    }

    /// Whether there is any hit that `filter` accepts; it is asked about surfaces that are not opaque.
    #[inline]
    pub fn any_hit(&self, ray: &Ray, mut filter: impl FnMut(&Hit) -> bool) -> bool {
        self.tlas.any_hit(ray, |hit| filter(&self.origins[hit.instance as usize].restore(hit)))
    }
}

/// Where the triangles and vertices of each mesh lie.
fn ranges(scene: &CompiledScene) -> impl Iterator<Item = [u32; 4]> {
    scene.meshes.iter().map(|m| [m.first_triangle, m.triangle_count, m.first_vertex, m.vertex_count])
}

/// Whether instances stand elsewhere, or rays see others of them.
fn moved(before: &CompiledScene, after: &CompiledScene, changes: SceneChanges) -> bool {
    let place = |i: &InstanceRecord| [i.mesh, i.first_transform, i.transform_count, i.mask];
    changes.has(lumbre_scene::Part::Transforms)
        || before.instances.iter().map(place).ne(after.instances.iter().map(place))
}

/// Classes of all materials.
fn classes(scene: &CompiledScene) -> impl Iterator<Item = Class> {
    scene.materials.iter().map(Class::of_material)
}

/// Structures for the meshes that stand in the world once, together, and one for each of the others.
fn merged(scene: &CompiledScene) -> (Instances, Vec<Arc<Blas>>) {
    let mut uses = vec![0u32; scene.meshes.len()];
    scene.instances.iter().for_each(|i| uses[i.mesh as usize] += 1);
    let merges =
        |i: &InstanceRecord| uses[i.mesh as usize] == 1 && i.transform_count == 1 && i.mask == u32::MAX;
    let (once, others): (Vec<u32>, Vec<u32>) =
        (0..scene.instances.len() as u32).partition(|&i| merges(&scene.instances[i as usize]));

    let (mut blas, mut instances) = (Vec::new(), Instances::default());
    for class in Class::ALL {
        let (merged, triangles) = merge(scene, &once, class);
        if !triangles.is_empty() {
            instances.descs.push(InstanceDesc::new(blas.len() as u32, Affine3A::IDENTITY));
            instances.classes.push(class);
            instances.origins.push(Origin::Merged(triangles));
            blas.push(Arc::new(merged));
        }
    }

    let first = blas.len() as u32;
    let mut shared: Vec<u32> = others.iter().map(|&i| scene.instances[i as usize].mesh).collect();
    shared.sort_unstable();
    shared.dedup();
    blas.par_extend(shared.par_iter().map(|&m| {
        let mesh = &scene.meshes[m as usize];
        Arc::new(build_mesh(scene, mesh, 0..mesh.triangle_count))
    }));
    for id in others {
        let mesh = scene.instances[id as usize].mesh;
        let place = shared.binary_search(&mesh).expect("it is one of them");
        instances.add(scene, id, first + place as u32);
    }
    (instances, blas)
}

impl Instances {
    /// Adds an instance of the scene, over a structure of its mesh.
    fn add(&mut self, scene: &CompiledScene, id: u32, blas: u32) {
        let i = &scene.instances[id as usize];
        let object_to_world = scene.transforms[i.first_transform as usize].object_to_world();
        self.descs.push(InstanceDesc { mask: i.mask, ..InstanceDesc::new(blas, object_to_world) });
        self.classes.push(Class::of_mesh(&scene.meshes[i.mesh as usize]));
        self.origins.push(Origin::Instance(id));
    }
}

/// A structure over some triangles of a mesh.
fn build_mesh(scene: &CompiledScene, m: &MeshRecord, triangles: impl Iterator<Item = u32>) -> Blas {
    let v = m.first_vertex as usize;
    let positions = &scene.positions[v..v + m.vertex_count as usize];
    let triangle = |t: u32| scene.triangles[(m.first_triangle + t) as usize].map(|i| i - m.first_vertex);
    let local: Vec<[u32; 3]> = triangles.map(triangle).collect();
    Blas::build(bytemuck::cast_slice(positions), &local)
}

/// One structure in world space over the triangles of a class of several instances, and where they come from.
fn merge(scene: &CompiledScene, members: &[u32], class: Class) -> (Blas, Vec<[u32; 2]>) {
    let (mut positions, mut triangles, mut from) = (Vec::<Vec3>::new(), Vec::new(), Vec::new());
    for &id in members {
        let instance = &scene.instances[id as usize];
        let m = &scene.meshes[instance.mesh as usize];
        let to_world = scene.transforms[instance.first_transform as usize].object_to_world();
        let (v, t) = (m.first_vertex as usize, m.first_triangle as usize);
        let first = positions.len() as u32;
        let vertices = &scene.positions[v..v + m.vertex_count as usize];
        positions.extend(vertices.iter().map(|p| to_world.transform_point3(Vec3::from_array(*p))));
        let before = from.len();
        let of_class = |&i: &u32| Class::of_triangle(scene, t + i as usize) == class;
        for i in (0..m.triangle_count).filter(of_class) {
            triangles.push(scene.triangles[t + i as usize].map(|v| v - m.first_vertex + first));
            from.push([id, i]);
        }
        if from.len() == before {
            positions.truncate(first as usize);
        }
    }
    (Blas::build(&positions, &triangles), from)
}
