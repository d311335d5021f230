//! Why a picture might be black or not as meant, as far as the scene tells without tracing a ray.

use super::{GeometryInfo, lobes};
use crate::light::light_kinds;
use glam::Vec3;
use lumbre_scene::{AlphaMode, Material, Primitive, Scene};

/// A reason why a picture might not be as meant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hint {
    /// Which reason.
    pub kind: HintKind,
    /// What was found, in one line; names stand in it as the file has them.
    pub message: String,
}

/// Kinds of hints, the gravest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum HintKind {
    /// No triangle is placed in the world.
    NothingDrawn,
    /// A camera sees none of the scene.
    NothingInView,
    /// A camera sees only back faces of single-sided surfaces, which are invisible to it.
    BackFacesOnly,
    /// A camera stands inside a closed mesh.
    CameraInside,
    /// Nothing gives light.
    NoLight,
    /// There is light, but all that a camera sees is black.
    AllBlack,
    /// A lamp stands inside a closed opaque mesh.
    LightInside,
    /// The only light comes from surfaces that barely light what is in view.
    FaintEmission,
    /// A material lets every ray pass.
    InvisibleMaterial,
    /// Textures on a mesh without coordinates for them.
    MissingTexCoords,
    /// Vertices that are no points.
    NonFinite,
    /// Many triangles without area.
    Degenerate,
    /// A size that suggests another unit than the metre.
    Units,
    /// So far from the origin that numbers are too coarse for the scene.
    FarFromOrigin,
}

impl HintKind {
    /// A name for programs, in lower case with hyphens.
    pub fn name(self) -> &'static str {
        match self {
            HintKind::NothingDrawn => "nothing-drawn",
            HintKind::NothingInView => "nothing-in-view",
            HintKind::BackFacesOnly => "back-faces-only",
            HintKind::CameraInside => "camera-inside",
            HintKind::NoLight => "no-light",
            HintKind::AllBlack => "all-black",
            HintKind::LightInside => "light-inside",
            HintKind::FaintEmission => "faint-emission",
            HintKind::InvisibleMaterial => "invisible-material",
            HintKind::MissingTexCoords => "missing-tex-coords",
            HintKind::NonFinite => "non-finite",
            HintKind::Degenerate => "degenerate",
            HintKind::Units => "units",
            HintKind::FarFromOrigin => "far-from-origin",
        }
    }

    pub(super) fn says(self, message: impl Into<String>) -> Hint {
        Hint { kind: self, message: message.into() }
    }
}

/// The hints that need no ray; `bounds` are those of what is drawn.
pub(super) fn of_scene(scene: &Scene, geometry: &GeometryInfo, bounds: Option<[Vec3; 2]>) -> Vec<Hint> {
    let mut hints = Vec::new();
    if geometry.drawn_triangles == 0 {
        hints.push(HintKind::NothingDrawn.says(nothing_drawn(geometry)));
    } else if !light_kinds(scene).any() && !all_unlit(scene) {
        hints.push(HintKind::NoLight.says("nothing in the scene gives light"));
    }
    if 2 * geometry.degenerate_triangles > geometry.triangles {
        let (flat, all) = (geometry.degenerate_triangles, geometry.triangles);
        hints.push(HintKind::Degenerate.says(format!("{flat} of {all} triangles have no area")));
    }
    hints.extend(non_finite(scene));
    hints.extend(bounds.into_iter().flat_map(|b| [units(b), far(b)]).flatten());
    hints.extend(invisible(scene));
    hints.extend(missing_tex_coords(scene));
    hints
}

/// Whether all that is drawn shows itself without light.
fn all_unlit(scene: &Scene) -> bool {
    let unlit =
        |p: &Primitive| p.material.and_then(|m| scene.materials.get(m.index())).is_some_and(|m| m.unlit);
    drawn_primitives(scene).all(|(_, p)| unlit(p))
}

fn nothing_drawn(geometry: &GeometryInfo) -> &'static str {
    match geometry {
        GeometryInfo { triangles: 0, .. } => "there are no triangles",
        GeometryInfo { instances: 0, .. } => "there are meshes, but no node of the scene places one",
        _ => "the meshes that are placed have no triangles",
    }
}

/// Widest and narrowest scene, metres, that is taken for meant: beyond them another unit is likelier.
const LIKELY_SIZES: [f32; 2] = [0.005, 20_000.0];

fn units([min, max]: [Vec3; 2]) -> Option<Hint> {
    let size = (max - min).length();
    let [least, most] = LIKELY_SIZES;
    let guess = if size < least {
        format!("if it was made in metres times 1000, it is {}", length(size * 1000.0))
    } else if size > most {
        format!("if its unit was the centimetre, it is {}", length(size / 100.0))
    } else {
        return None;
    };
    Some(HintKind::Units.says(format!("the scene is {} across: {guess}", length(size))))
}

/// A length for people.
pub(super) fn length(metres: f32) -> String {
    match metres {
        m if m < 0.01 => format!("{:.3} mm", m * 1000.0),
        m if m < 1000.0 => format!("{m:.2} m"),
        m => format!("{:.1} km", m / 1000.0),
    }
}

/// Steps of `f32` at the far corner, as a share of the scene's size, from which they show.
const COARSE: f32 = 1e-4;

fn far([min, max]: [Vec3; 2]) -> Option<Hint> {
    let size = (max - min).length();
    let step = min.abs().max(max.abs()).max_element() * f32::EPSILON;
    (step > COARSE * size).then(|| {
        let (middle, step) = (0.5 * (min + max), length(step));
        let (x, y, z) = (middle.x, middle.y, middle.z);
        let what = format!(
            "the scene stands around ({x:.0}, {y:.0}, {z:.0}), where positions come in steps of {step}"
        );
        HintKind::FarFromOrigin.says(what)
    })
}

fn non_finite(scene: &Scene) -> Option<Hint> {
    let broken = |p: &&Primitive| p.positions.iter().any(|v| !v.is_finite());
    let count = scene.meshes.iter().flat_map(|m| &m.primitives).filter(broken).count();
    let what = || format!("{count} parts of meshes have vertices that are not finite");
    (count > 0).then(|| HintKind::NonFinite.says(what()))
}

/// `material 3 "Wood"`.
fn material_name(id: usize, m: &Material) -> String {
    named("material", id, &m.name)
}

/// `camera 3 "Front"`; the name is left out where there is none.
pub(super) fn named(what: &str, id: usize, name: &str) -> String {
    if name.is_empty() { format!("{what} {id}") } else { format!("{what} {id} {name:?}") }
}

fn invisible(scene: &Scene) -> Option<Hint> {
    let passes = |m: &Material| match m.alpha_mode {
        AlphaMode::Opaque => false,
        AlphaMode::Mask { cutoff } => m.alpha < cutoff,
        AlphaMode::Blend => m.alpha <= 0.0,
    };
    let found = drawn_primitives(scene).filter_map(|(_, p)| p.material).map(|m| m.index());
    let mut ids: Vec<usize> = found.filter(|&id| scene.materials.get(id).is_some_and(passes)).collect();
    ids.sort_unstable();
    ids.dedup();
    let first = material_name(*ids.first()?, &scene.materials[ids[0]]);
    let what = format!("{first}{} has an alpha that lets every ray pass", more(ids.len()));
    Some(HintKind::InvisibleMaterial.says(what))
}

fn missing_tex_coords(scene: &Scene) -> Option<Hint> {
    let lacking = |(_, p): &(usize, &Primitive)| {
        let material = p.material.and_then(|m| scene.materials.get(m.index()));
        let mut uses = material.into_iter().flat_map(lobes::textures);
        uses.any(|t| if t.uv_set == 1 { p.uv1.is_empty() } else { p.uv0.is_empty() })
    };
    let lacking: Vec<(usize, &Primitive)> = drawn_primitives(scene).filter(lacking).collect();
    let (mesh, primitive) = *lacking.first()?;
    let id = primitive.material?.index();
    let material = material_name(id, &scene.materials[id]);
    let mesh = named("mesh", mesh, &scene.meshes[mesh].name);
    let what = format!(
        "{mesh}{} has no texture coordinates for the textures of {material}: each shows one texel",
        more(lacking.len())
    );
    Some(HintKind::MissingTexCoords.says(what))
}

fn more(count: usize) -> String {
    if count > 1 { format!(" (and {} more)", count - 1) } else { String::new() }
}

/// The parts of meshes that nodes place, with the mesh they belong to, each once.
fn drawn_primitives(scene: &Scene) -> impl Iterator<Item = (usize, &Primitive)> {
    let mut placed = vec![false; scene.meshes.len()];
    for (node, _) in scene.world_nodes() {
        if let Some(placed) = scene.nodes[node.index()].mesh.and_then(|m| placed.get_mut(m.index())) {
            *placed = true;
        }
    }
    let meshes = scene.meshes.iter().enumerate().zip(placed).filter(|(_, placed)| *placed);
    meshes.flat_map(|((id, mesh), _)| mesh.primitives.iter().map(move |p| (id, p)))
}
