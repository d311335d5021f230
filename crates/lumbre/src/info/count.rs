//! Counting what a scene holds.

use super::{GeometryInfo, ImageInfo, LightInfo, TextureInfo};
use glam::Vec3;
use lumbre_core::Rgb;
use lumbre_scene::compiled::lights::kind;
use lumbre_scene::compiled::material::flag;
use lumbre_scene::{Background, CompiledScene, EnvironmentMap, Primitive, Scene};

/// Counts the meshes.
pub(super) fn geometry(scene: &Scene, compiled: &CompiledScene) -> GeometryInfo {
    let primitives = || scene.meshes.iter().flat_map(|m| &m.primitives);
    let drawn = compiled.instances.iter().map(|i| u64::from(compiled.meshes[i.mesh as usize].triangle_count));
    GeometryInfo {
        meshes: scene.meshes.len(),
        primitives: primitives().count(),
        instances: compiled.instances.len(),
        triangles: primitives().map(|p| p.indices.len() as u64 / 3).sum(),
        drawn_triangles: drawn.sum(),
        vertices: primitives().map(|p| p.positions.len() as u64).sum(),
        degenerate_triangles: primitives().map(degenerate).sum(),
        flat_primitives: primitives().filter(|p| p.normals.is_empty()).count(),
    }
}

/// Triangles without area, in the arithmetic by which the trees leave them out.
fn degenerate(p: &Primitive) -> u64 {
    let flat = |t: &&[u32]| {
        let corner = |i: usize| p.positions.get(t[i] as usize).map_or(Vec3::NAN, |p| *p).as_dvec3();
        let (a, b, c) = (corner(0), corner(1), corner(2));
        (b - a).cross(c - a) == glam::DVec3::ZERO
    };
    p.indices.chunks_exact(3).filter(flat).count() as u64
}

/// Lists the images.
pub(super) fn textures(scene: &Scene) -> TextureInfo {
    let image = |i: &lumbre_scene::Image| ImageInfo {
        name: i.name.clone(),
        size: [i.width, i.height],
        bytes: i.rgba8.len() as u64,
    };
    let images: Vec<ImageInfo> = scene.images.iter().map(image).collect();
    TextureInfo { textures: scene.textures.len(), bytes: images.iter().map(|i| i.bytes).sum(), images }
}

/// Counts the lights.
pub(super) fn lights(scene: &Scene, compiled: &CompiledScene) -> LightInfo {
    let of = |wanted: u32| compiled.lights.iter().filter(|l| l.kind == wanted).count();
    let mut emits = vec![false; compiled.materials.len()];
    for mesh in &compiled.meshes {
        let triangles = mesh.first_triangle as usize..(mesh.first_triangle + mesh.triangle_count) as usize;
        for &material in &compiled.triangle_materials[triangles] {
            emits[material as usize] |= compiled.materials[material as usize].has(flag::EMISSIVE);
        }
    }
    LightInfo {
        point: of(kind::POINT),
        spot: of(kind::SPOT),
        directional: of(kind::DIRECTIONAL),
        emissive_materials: emits.into_iter().filter(|e| *e).count(),
        emissive_triangles: of(kind::TRIANGLE),
        background: match &scene.environment.background {
            Background::Black => "none",
            Background::Constant(_) => "colour",
            Background::Gradient => "gradient",
            Background::Map(_) => "map",
        },
        sun: of(kind::SUN) > 0,
    }
}

/// Bytes of the large parts of an authored scene.
pub(super) fn authored_bytes(scene: &Scene) -> u64 {
    let primitive = |p: &Primitive| {
        size_of_val(&p.positions[..])
            + size_of_val(&p.normals[..])
            + size_of_val(&p.tangents[..])
            + size_of_val(&p.uv0[..])
            + size_of_val(&p.uv1[..])
            + size_of_val(&p.colors[..])
            + size_of_val(&p.indices[..])
    };
    let meshes: usize = scene.meshes.iter().flat_map(|m| &m.primitives).map(primitive).sum();
    let images: usize = scene.images.iter().map(|i| i.rgba8.len()).sum();
    let map = match &scene.environment.background {
        Background::Map(EnvironmentMap { pixels, .. }) => pixels.len() * size_of::<Rgb>(),
        _ => 0,
    };
    (meshes + images + map + size_of_val(&scene.nodes[..])) as u64
}
