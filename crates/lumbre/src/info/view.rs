//! The hints that need rays: what the cameras see, what closes cameras and lamps in, and whether light comes to what is seen.

use super::hints::{Hint, HintKind, length, named};
use super::probe::{enclosing, share};
use crate::camera::{self, CameraChoice, CameraOptions};
use crate::light::light_kinds;
use crate::output::is_black;
use glam::Vec3;
use lumbre_core::camera::Projection;
use lumbre_core::settings::{RenderSettings, View};
use lumbre_core::{Camera, Film};
use lumbre_cpu::CpuBackend;
use lumbre_cpu::interaction::Interaction;
use lumbre_cpu::tracer::{CoverageKey, Tracer};
use lumbre_scene::compiled::lights::kind;
use lumbre_scene::compiled::material::MaterialRecord;
use lumbre_scene::{CompiledScene, Scene};

/// Columns and rows of the picture that is looked at.
const SIZE: [u32; 2] = [48, 27];
/// Samples of each of its pixels.
const SAMPLES: u32 = 4;
/// Most cameras, and most lamps, that are looked at.
const MOST: usize = 16;

/// The hints on a scene that has something to be seen.
pub(super) fn hints(scene: &Scene, backend: &CpuBackend) -> Vec<Hint> {
    let count = camera::camera_names(scene).len();
    let choices = if count == 0 {
        vec![CameraChoice::Default]
    } else {
        (0..count.min(MOST)).map(CameraChoice::Index).collect()
    };
    let mut found = Vec::new();
    for choice in choices {
        let Some((camera, name)) = find(scene, backend.scene(), choice) else { continue };
        let eye = Eye { scene, backend, camera };
        let remarks = [eye.in_view().or_else(|| eye.lit()), eye.inside()];
        found.extend(remarks.into_iter().flatten().map(|remark| (remark, name.clone())));
    }
    let mut hints = merged(found);
    hints.extend(lamps_inside(scene, backend));
    hints
}

/// What is to be said about a camera: `{}` stands for its name.
type Remark = (HintKind, String);

/// One hint for all cameras about which the same is to be said.
fn merged(found: Vec<(Remark, String)>) -> Vec<Hint> {
    let mut groups: Vec<(Remark, String, usize)> = Vec::new();
    for (remark, name) in found {
        match groups.iter_mut().find(|(known, ..)| *known == remark) {
            Some((.., count)) => *count += 1,
            None => groups.push((remark, name, 1)),
        }
    }
    let hint = |((kind, what), name, count): (Remark, String, usize)| {
        let others = if count > 1 { format!(" (and {} more)", count - 1) } else { String::new() };
        kind.says(what.replacen("{}", &format!("{name}{others}"), 1))
    };
    groups.into_iter().map(hint).collect()
}

/// A camera in the shape that it was framed for, and what to call it.
fn find(scene: &Scene, compiled: &CompiledScene, choice: CameraChoice) -> Option<(Camera, String)> {
    let aspect = camera::authored_aspect(scene, &choice).ok()?.unwrap_or(16.0 / 9.0);
    let name = match &choice {
        CameraChoice::Index(i) => named("camera", *i, &camera::infos(scene).get(*i)?.name),
        _ => "the camera that puts the whole scene in view".into(),
    };
    let options = CameraOptions { choice, ..CameraOptions::default() };
    let found = camera::find_camera(scene, compiled, &options, aspect).ok()?;
    Some((found.camera, name))
}

/// A camera that looks at the scene.
struct Eye<'a> {
    scene: &'a Scene,
    backend: &'a CpuBackend,
    camera: Camera,
}

/// What the rays through the middles of the pixels meet.
#[derive(Default)]
struct Seen {
    /// Rays that find a surface.
    surfaces: u32,
    /// Rays that pass the back of single-sided surfaces and find nothing.
    backs: u32,
    /// Rays that pass surfaces by their alpha and find nothing.
    holes: u32,
}

impl Eye<'_> {
    fn look(&self) -> Seen {
        let settings = RenderSettings::default();
        let (scene, accel) = (self.backend.scene(), self.backend.accel());
        let tracer = Tracer { scene, accel, settings: &settings };
        let mut seen = Seen::default();
        for i in 0..SIZE[0] * SIZE[1] {
            let pixel = [i % SIZE[0], i / SIZE[0]];
            let film = [0, 1].map(|axis| (pixel[axis] as f32 + 0.5) / SIZE[axis] as f32);
            let ray = self.camera.ray(film, [0.5; 2], 0.0);
            if tracer.closest_hit_camera(&ray, CoverageKey::path(i, 0)).is_some() {
                seen.surfaces += 1;
            } else if let Some(hit) = accel.closest_hit(&ray, |_| true) {
                let it = Interaction::new(scene, &ray, &hit);
                let culled = !it.front && scene.materials[it.material as usize].culls_back_faces();
                *(if culled { &mut seen.backs } else { &mut seen.holes }) += 1;
            }
        }
        seen
    }

    /// Why nothing is seen, if so.
    fn in_view(&self) -> Option<Remark> {
        Some(match self.look() {
            Seen { surfaces: 1.., .. } => return None,
            Seen { backs: 0, holes: 0, .. } => (HintKind::NothingInView, format!("{{}} {}", self.misses())),
            Seen { backs, holes, .. } if backs >= holes => {
                let what = "{} sees only the back of single-sided surfaces, which is invisible";
                (HintKind::BackFacesOnly, what.into())
            }
            _ => {
                (HintKind::InvisibleMaterial, "{} sees only surfaces whose alpha lets every ray pass".into())
            }
        })
    }

    /// How it misses the scene.
    fn misses(&self) -> String {
        let [min, max] = self.backend.scene().bounds.map(Vec3::from_array);
        let (middle, radius) = (0.5 * (min + max), self.backend.scene().radius());
        let to = middle - self.camera.origin;
        let distance = to.length();
        // Half the height of what is seen at the distance of the scene, over that distance.
        let half_height = match self.camera.projection {
            Projection::Perspective { tan_half_fov_y } => tan_half_fov_y,
            Projection::Orthographic { half_height } => half_height / distance.max(f32::MIN_POSITIVE),
        };
        let corner = half_height * self.camera.aspect.max(1.0).hypot(1.0);
        // Angles from the direction of the view to the middle of the scene, to the corner of the picture, and of the scene itself.
        let (away, half) = (to.angle_between(self.camera.forward), corner.atan());
        let across = if distance > radius { (radius / distance).asin() } else { std::f32::consts::PI };
        if away > half + across {
            let [x, y, z] = middle.to_array();
            return format!("looks away from the scene, whose middle is ({x:.2}, {y:.2}, {z:.2})");
        }
        if across * (SIZE[1] as f32) < half {
            let (size, distance) = (length(2.0 * radius), length(distance));
            return format!("is so far away that the scene is a speck: {size} across, seen from {distance}");
        }
        "looks past all surfaces".into()
    }

    /// Whether light comes to what is seen.
    fn lit(&self) -> Option<Remark> {
        let kinds = light_kinds(self.scene);
        if !kinds.any() {
            return None;
        }
        let mut film = Film::new(SIZE[0], SIZE[1]);
        let view = View { camera: self.camera, settings: RenderSettings::default(), frame: 0 };
        self.backend.render(&view, 0..SAMPLES, &mut film, &());
        if is_black(&film) {
            let what = "all that {} sees is black: the light does not come there, or is far too faint";
            return Some((HintKind::AllBlack, what.into()));
        }
        let mut blocks = blocks(&film);
        blocks.sort_by(f32::total_cmp);
        let (median, most) = (blocks.get(blocks.len() / 2)?, blocks.last()?);
        (kinds.only_emissive() && *median < FAINT * most).then(|| {
            let what = "surfaces that emit are the only light, and hardly light what {} sees besides them";
            (HintKind::FaintEmission, what.into())
        })
    }

    /// Whether it stands inside a closed mesh that is not the whole scene, or one whose walls it cannot see.
    fn inside(&self) -> Option<Remark> {
        let compiled = self.backend.scene();
        let instance = enclosing(self.backend, self.camera.origin, |_| false)?;
        let mesh = compiled.meshes[compiled.instances[instance as usize].mesh as usize];
        if share(compiled, instance) > WHOLE && mesh.culls == 0 {
            return None;
        }
        let mesh = place(self.scene, compiled, instance);
        Some((HintKind::CameraInside, format!("{{}} stands inside {mesh}")))
    }
}

/// Side of the blocks of pixels that are averaged: single ones are noisy at so few samples.
const BLOCK: u32 = 3;

/// Mean luminances of the blocks of a picture in which surfaces are seen.
fn blocks(film: &Film) -> Vec<f32> {
    let columns = SIZE[0] / BLOCK;
    let mean = |block: u32| {
        let [x, y] = [block % columns * BLOCK, block / columns * BLOCK];
        let pixels = (0..BLOCK * BLOCK).map(|i| film.pixel(x + i % BLOCK, y + i / BLOCK));
        let surfaces = pixels.filter(|p| p.coverage() > 0.0).map(|p| p.radiance().luminance());
        let (sum, count) = surfaces.fold((0.0, 0u32), |(sum, count), y| (sum + y, count + 1));
        (count > 0).then(|| sum / count as f32)
    };
    (0..columns * (SIZE[1] / BLOCK)).filter_map(mean).collect()
}

/// A median below this share of the brightest block is nearly black when that block is not.
const FAINT: f32 = 1e-3;
/// From this share of the size of the scene on, a mesh is a room or a sky rather than a thing in it.
const WHOLE: f32 = 0.8;

/// The mesh of an instance and the node that places it, by name.
fn place(scene: &Scene, compiled: &CompiledScene, instance: u32) -> String {
    let node = compiled.instances[instance as usize].node as usize;
    let Some(authored) = scene.nodes.get(node) else { return "a mesh".into() };
    let mesh = authored.mesh.map_or(0, |m| m.index());
    let name = scene.meshes.get(mesh).map_or("", |m| m.name.as_str());
    format!("{} ({})", named("mesh", mesh, name), named("node", node, &authored.name))
}

/// Lamps that a closed opaque mesh keeps from lighting anything.
fn lamps_inside(scene: &Scene, backend: &CpuBackend) -> Vec<Hint> {
    let compiled = backend.scene();
    let lets_out = |m: &MaterialRecord| !m.is_opaque();
    let lamps = compiled.lights.iter().filter(|l| matches!(l.kind, kind::POINT | kind::SPOT));
    let closed_in = lamps.take(MOST).filter_map(|l| {
        let position = Vec3::from_array(compiled.punctual_lights[l.index as usize].position);
        let instance = enclosing(backend, position, lets_out)?;
        (share(compiled, instance) < WHOLE).then(|| {
            let [x, y, z] = position.to_array();
            let what = if l.kind == kind::POINT { "point" } else { "spot" };
            let closed = place(scene, compiled, instance);
            HintKind::LightInside.says(format!(
                "the {what} light at ({x:.2}, {y:.2}, {z:.2}) stands inside {closed}, which lets no light out"
            ))
        })
    });
    closed_in.collect()
}
