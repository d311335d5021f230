//! Acceleration structures: rays on the GPU hit what they hit on the CPU, for every class of surface, mirrored or not, merged or shared.

use glam::{Mat4, Vec3};
use lumbre_core::Ray;
use lumbre_core::hash::{hash_combine, to_unit};
use lumbre_cpu::accel::Accel;
use lumbre_cpu::bvh::Hit;
use lumbre_cpu::interaction::{geometric_normal, material_of};
use lumbre_scene::compiled::CompiledScene;
use lumbre_scene::{AlphaMode, Material, MaterialId, Mesh, Node, Primitive, Scene, compile};
use lumbre_shaders::replay::{ReplayHit, ReplayRay, kind};
use lumbre_testkit::shapes;
use lumbre_vulkan::{PipelineCache, Replay, SceneOptions};

/// Surfaces of every class: opaque, letting light through, there in part; with and without backs.
fn materials(scene: &mut Scene) -> Vec<MaterialId> {
    let blend = AlphaMode::Blend;
    let of = |double_sided, alpha_mode, transmission| Material {
        double_sided,
        alpha_mode,
        transmission,
        ..Material::default()
    };
    [
        of(false, AlphaMode::Opaque, 0.0),
        of(true, AlphaMode::Opaque, 0.0),
        of(true, AlphaMode::Opaque, 1.0),
        of(false, AlphaMode::Opaque, 0.5),
        of(false, blend, 0.0),
        of(true, blend, 0.0),
    ]
    .map(|m| scene.add_material(m))
    .to_vec()
}

/// Open and closed bodies; a mesh of all materials placed three times, once mirrored, and meshes placed once, of one material or of
/// several, mirrored or not.
fn scene() -> CompiledScene {
    let mut scene = Scene::default();
    let materials = materials(&mut scene);
    let at =
        |i: usize| Vec3::new(1.3 * (i % 3) as f32 - 1.3, 1.3 * (i / 3) as f32 - 0.6, 0.3 * i as f32 - 0.7);
    let shapes = |level| -> Vec<Primitive> {
        let shape = |(i, &m): (usize, &MaterialId)| {
            let shape = match i % 3 {
                0 => shapes::disc(at(i), Vec3::new(0.3, 0.2, 1.0).normalize(), 0.6, 40),
                1 => shapes::bumpy_icosphere(at(i), 0.5, level),
                _ => shapes::quad(at(i), Vec3::new(0.7, 0.1, 0.0), Vec3::new(0.0, 0.8, 0.3)),
            };
            Primitive { material: Some(m), ..shape }
        };
        materials.iter().enumerate().map(shape).collect()
    };
    let mirror = Mat4::from_scale(Vec3::new(-1.0, 1.2, 0.9));
    let mesh = |primitives| Mesh { name: String::new(), primitives };
    let mut place = |mesh, places: &[Mat4]| {
        let mesh = Some(scene.add_mesh(mesh));
        places.iter().for_each(|&transform| _ = scene.add_root(Node { mesh, transform, ..Node::default() }));
    };
    let turned = |x: f32, angle: f32| {
        Mat4::from_translation(Vec3::new(x, 0.4 * x, -2.0)) * Mat4::from_rotation_y(angle)
    };
    place(mesh(shapes(1)), &[turned(-2.0, 0.3), turned(2.0, 2.0), turned(0.5, 4.0) * mirror]);
    place(mesh(shapes(2)), &[turned(1.0, 1.0) * mirror]);
    place(mesh(shapes(0)), &[turned(-1.0, 5.0)]);
    for (i, shape) in shapes(1).into_iter().enumerate() {
        let turn = Mat4::from_rotation_x(i as f32);
        place(mesh(vec![shape]), &[if i % 2 == 0 { turn } else { turn * mirror }]);
    }
    let scene = compile(&scene).expect("the scene compiles").scene;
    assert_eq!(scene.instances.len(), 11);
    scene
}

fn rays(count: u32) -> Vec<ReplayRay> {
    let point = |i: u32, of: u32, radius: f32| {
        let u = |k| 2.0 * to_unit(hash_combine(hash_combine(i, of), k)) - 1.0;
        Vec3::new(u(0), u(1), u(2)) * radius
    };
    let ray = |i: u32| {
        let origin = point(i, 1, 6.0);
        let dir = (point(i, 2, 2.5) - origin).normalize();
        ReplayRay { origin: origin.into(), t_min: 0.0, dir: dir.into(), t_max: 1e30, kind: i % 3, key: 0 }
    };
    (0..count).map(ray).collect()
}

/// How the CPU decides which hits count.
struct Rules<'a> {
    scene: &'a CompiledScene,
    accel: Accel,
    /// What rays must ask lets them pass.
    all_pass: bool,
    /// The side that camera rays do not see, against the direction of the geometric normal.
    hidden: f32,
}

impl Rules<'_> {
    /// What a ray hits; distance 0 for a shadow ray that is stopped.
    fn hit(&self, r: &ReplayRay) -> Option<Hit> {
        let ray = Ray::new(r.origin.into(), r.dir.into(), 0.0);
        let material = |hit: &Hit| &self.scene.materials[material_of(self.scene, hit) as usize];
        let there = |hit: &Hit| !(self.all_pass && material(hit).has_coverage());
        let seen = |hit: &Hit| {
            let back = geometric_normal(self.scene, hit).dot(ray.dir) * self.hidden >= 0.0;
            !(material(hit).culls_back_faces() && back) && there(hit)
        };
        match r.kind {
            kind::PATH => self.accel.closest_hit(&ray, there),
            kind::CAMERA => self.accel.closest_hit_camera(&ray, seen),
            _ => {
                let stops = |hit: &Hit| !self.all_pass || material(hit).is_opaque();
                let stopped = self.accel.any_hit(&ray, stops);
                stopped.then_some(Hit { t: 0.0, instance: u32::MAX, triangle: u32::MAX, b1: 0.0, b2: 0.0 })
            }
        }
    }
}

/// Rays of each kind that hit something else on the GPU, and how many hit at all.
fn differences(rules: &Rules<'_>, rays: &[ReplayRay], hits: &[ReplayHit]) -> ([usize; 3], usize) {
    let mut different = [0; 3];
    let mut found = 0;
    for (ray, gpu) in rays.iter().zip(hits) {
        let same = match rules.hit(ray) {
            None => gpu.t < 0.0,
            Some(cpu) => {
                found += 1;
                (gpu.instance, gpu.triangle) == (cpu.instance, cpu.triangle)
                    && (gpu.t - cpu.t).abs() <= 1e-4 * (1.0 + cpu.t)
                    && (gpu.b[0] - cpu.b1).abs().max((gpu.b[1] - cpu.b2).abs()) < 1e-2
            }
        };
        different[ray.kind as usize] += usize::from(!same);
    }
    (different, found)
}

#[test]
fn rays_hit_the_same() {
    let Some(gpu) = lumbre_testkit::gpu() else { return };
    let scene = scene();
    let rays = rays(12_000);
    let cache = PipelineCache::open_in(&gpu, None);
    // Merged or not; all in one buffer, or each mesh in its own.
    for (merge, chunk) in [(true, 1 << 30), (false, 1 << 30), (true, 1)] {
        let on_gpu = gpu.scene(&scene, SceneOptions { merge, chunk }).unwrap();
        for all_pass in [false, true] {
            let (hits, _) = Replay::new(&on_gpu, all_pass, &cache).unwrap().run(&rays).unwrap();
            let mut rules = Rules { scene: &scene, accel: Accel::new(&scene), all_pass, hidden: 1.0 };
            // Rays that pass an edge at a rounding's distance may differ.
            let (different, found) = differences(&rules, &rays, &hits);
            println!("merge {merge}, chunk {chunk}, all_pass {all_pass}: {different:?} of {found} differ");
            assert!(found > 2500, "{found}");
            assert!(different.iter().all(|&d| d <= 4), "{different:?}");
            // Were the other side the front, or did surfaces pass that stand, it would show.
            rules.hidden = -1.0;
            assert!(differences(&rules, &rays, &hits).0[kind::CAMERA as usize] > 100);
            rules.all_pass = !all_pass;
            let (different, _) = differences(&rules, &rays, &hits);
            assert!(different.iter().all(|&d| d > 100), "{different:?}");
        }
    }
}
