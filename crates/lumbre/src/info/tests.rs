//! Each hint on a scene made for it, and its absence on the scene without the fault.

use super::{HintKind, SceneInfo, info};
use glam::{Mat4, Quat, Vec2, Vec3};
use lumbre_core::Rgb;
use lumbre_scene::{
    AlphaMode, Background, Camera, CameraId, Image, Light, LightId, LightKind, Material, MaterialId, Mesh,
    Node, Primitive, Scene, Texture, TextureId,
};
use std::sync::Arc;

/// The first part of a mesh.
fn primitive(scene: &mut Scene, mesh: usize) -> &mut Primitive {
    &mut Arc::make_mut(&mut scene.meshes)[mesh].primitives[0]
}

/// A box with corners at ±1 whose faces point outwards; 12 triangles.
fn cube() -> Primitive {
    let corner = |i: u32| Vec3::from([0, 1, 2].map(|axis| if i >> axis & 1 == 1 { 1.0 } else { -1.0 }));
    let quads = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    Primitive {
        positions: (0..8).map(corner).collect(),
        indices: quads.iter().flat_map(|[a, b, c, d]| [*a, *b, *c, *a, *c, *d]).collect(),
        ..Primitive::default()
    }
}

/// A square of side 2 in the plane of z = 0 that faces +z.
fn square() -> Primitive {
    let positions = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    Primitive {
        positions: positions.map(|(x, y)| Vec3::new(x, y, 0.0)).to_vec(),
        indices: vec![0, 1, 2, 0, 2, 3],
        ..Primitive::default()
    }
}

fn grey() -> Material {
    Material { base_color: Rgb::splat(0.5), ..Material::default() }
}

/// Places a primitive of a material.
fn add(scene: &mut Scene, mut primitive: Primitive, material: Material, transform: Mat4) {
    let name = material.name.clone();
    primitive.material = Some(scene.add_material(material));
    let mesh = scene.add_mesh(Mesh { name: String::new(), primitives: vec![primitive] });
    scene.add_root(Node { name, mesh: Some(mesh), transform, ..Node::default() });
}

/// A place from which a camera sees `target` in the middle.
fn looking(eye: Vec3, target: Vec3) -> Mat4 {
    let c = lumbre_core::Camera::look_at(eye, target, Vec3::Y, 1.0, 1.0);
    Mat4::from_cols(c.right.extend(0.0), c.up.extend(0.0), -c.forward.extend(0.0), eye.extend(1.0))
}

fn camera(scene: &mut Scene, eye: Vec3, target: Vec3) {
    let id = CameraId(scene.cameras.len() as u32);
    scene.cameras.push(Camera::perspective(0.8));
    let transform = looking(eye, target);
    scene.add_root(Node { camera: Some(id), transform, ..Node::default() });
}

fn lamp(scene: &mut Scene, at: Vec3) {
    let id = LightId(scene.lights.len() as u32);
    scene.lights.push(Light { name: String::new(), kind: LightKind::Point, intensity: Rgb::WHITE });
    scene.add_root(Node { light: Some(id), transform: Mat4::from_translation(at), ..Node::default() });
}

/// A grey square seen from the front and lit from there: nothing is wrong.
fn good() -> Scene {
    let mut scene = Scene::default();
    add(&mut scene, square(), grey(), Mat4::IDENTITY);
    camera(&mut scene, Vec3::new(0.0, 0.0, 4.0), Vec3::ZERO);
    lamp(&mut scene, Vec3::new(1.0, 1.0, 2.0));
    scene
}

fn kinds(scene: &Scene) -> Vec<HintKind> {
    info(scene).unwrap().hints.into_iter().map(|h| h.kind).collect()
}

#[track_caller]
fn says(scene: &Scene, kind: HintKind, part: &str) {
    let hints = info(scene).unwrap().hints;
    assert_eq!(hints.iter().map(|h| h.kind).collect::<Vec<_>>(), [kind]);
    assert!(hints[0].message.contains(part), "{}", hints[0].message);
}

#[test]
fn a_good_scene_has_no_hints() {
    assert_eq!(kinds(&good()), []);
}

#[test]
fn what_a_scene_holds_is_counted() {
    let mut scene = good();
    add(&mut scene, cube(), Material::emitter(Rgb::WHITE, false), Mat4::from_translation(Vec3::X * 9.0));
    let again = scene.nodes.last().unwrap().clone();
    scene.add_root(Node { transform: Mat4::from_translation(Vec3::X * 12.0), ..again });
    scene.add_material(Material::glass(1.5, 0.0));
    scene.environment.background = Background::Gradient;
    let SceneInfo { geometry: g, lights: l, bounds, materials, cameras, memory, .. } = info(&scene).unwrap();
    assert_eq!((g.meshes, g.primitives, g.instances), (2, 2, 3));
    assert_eq!((g.triangles, g.drawn_triangles, g.vertices), (14, 26, 12));
    assert_eq!((g.degenerate_triangles, g.flat_primitives), (0, 2));
    assert_eq!((l.point, l.spot, l.directional, l.sun, l.background), (1, 0, 0, false, "gradient"));
    assert_eq!((l.emissive_materials, l.emissive_triangles), (1, 24));
    assert_eq!(bounds, Some([Vec3::new(-1.0, -1.0, -1.0), Vec3::new(13.0, 1.0, 1.0)]));
    let lobes: Vec<_> = materials.iter().map(|m| (m.used, m.lobes.join(" "))).collect();
    let expected = [(true, "diffuse specular"), (true, "emission"), (false, "specular solid transmission")];
    assert_eq!(lobes, expected.map(|(used, lobes)| (used, lobes.to_string())));
    assert_eq!((cameras.len(), cameras[0].position), (1, Vec3::new(0.0, 0.0, 4.0)));
    assert!(memory.scene > 0 && memory.acceleration > 0 && memory.opening > 0);
}

#[test]
fn a_scene_without_light() {
    let mut scene = good();
    scene.lights[0].intensity = Rgb::BLACK;
    says(&scene, HintKind::NoLight, "nothing in the scene gives light");
    // Unlit surfaces need none.
    scene.materials[0].unlit = true;
    assert_eq!(kinds(&scene), []);
}

#[test]
fn nothing_to_draw() {
    says(&Scene::default(), HintKind::NothingDrawn, "no triangles");
    let mut scene = good();
    scene.nodes[0].mesh = None;
    says(&scene, HintKind::NothingDrawn, "no node of the scene places one");
}

#[test]
fn cameras_that_see_nothing() {
    let seen_from = |eye: Vec3, target: Vec3| {
        let mut scene = good();
        scene.nodes[1].transform = looking(eye, target);
        scene
    };
    let front = Vec3::new(0.0, 0.0, 4.0);
    says(&seen_from(front, front * 2.0), HintKind::NothingInView, "camera 0 looks away");
    says(&seen_from(front, Vec3::new(9.0, 0.0, 3.0)), HintKind::NothingInView, "looks away");
    let far = Vec3::new(0.3, 0.2, 9000.0);
    says(
        &seen_from(far, far - Vec3::new(9.0, 2.0, 3000.0)),
        HintKind::NothingInView,
        "is a speck: 2.83 m across",
    );
    says(&seen_from(-front, Vec3::ZERO), HintKind::BackFacesOnly, "camera 0 sees only the back");
    // One camera that sees the scene does not speak for another, and two that do not are one hint.
    let mut scene = seen_from(-front, Vec3::ZERO);
    camera(&mut scene, front, Vec3::ZERO);
    camera(&mut scene, -front * 1.5, Vec3::ZERO);
    says(&scene, HintKind::BackFacesOnly, "camera 0 (and 1 more) sees only the back");
    // What is drawn from both sides is seen.
    scene.materials[0].double_sided = true;
    scene.environment.background = Background::Gradient;
    assert_eq!(kinds(&scene), []);
}

#[test]
fn a_camera_inside_of_a_mesh() {
    let mut scene = good();
    let around = Mat4::from_translation(Vec3::new(0.0, 0.0, 4.0)) * Mat4::from_scale(Vec3::splat(0.2));
    add(&mut scene, cube(), Material { name: "Box".into(), ..grey() }, around);
    says(&scene, HintKind::CameraInside, "camera 0 stands inside mesh 1 (node 3 \"Box\")");
    // A box that faces inwards is a room.
    let Primitive { indices, .. } = primitive(&mut scene, 1);
    indices.chunks_exact_mut(3).for_each(|t| t.swap(0, 1));
    assert!(!kinds(&scene).contains(&HintKind::CameraInside));
    // So is one that is the whole scene, if its walls can be seen.
    let mut scene = good();
    *primitive(&mut scene, 0) = Primitive { material: Some(MaterialId(0)), ..cube() };
    scene.nodes[0].transform = Mat4::from_scale(Vec3::splat(6.0));
    scene.materials[0].double_sided = true;
    assert_eq!(kinds(&scene), []);
    scene.materials[0].double_sided = false;
    let hints = info(&scene).unwrap().hints;
    assert_eq!(
        hints.iter().map(|h| h.kind).collect::<Vec<_>>(),
        [HintKind::BackFacesOnly, HintKind::CameraInside]
    );
}

#[test]
fn light_that_does_not_arrive() {
    // Behind the square.
    let mut scene = good();
    scene.nodes[2].transform = Mat4::from_translation(Vec3::new(0.0, 0.0, -2.0));
    says(&scene, HintKind::AllBlack, "all that camera 0 sees is black");
    // In a closed box.
    let mut scene = good();
    lamp(&mut scene, Vec3::new(-1.0, 2.0, 2.0));
    let around = Mat4::from_translation(Vec3::new(1.0, 1.0, 2.0)) * Mat4::from_scale(Vec3::splat(0.1));
    add(&mut scene, cube(), grey(), around);
    says(
        &scene,
        HintKind::LightInside,
        "the point light at (1.00, 1.00, 2.00) stands inside mesh 1 (node 4)",
    );
    scene.materials[1] = Material::glass(1.5, 0.0);
    assert_eq!(kinds(&scene), []);
}

#[test]
fn surfaces_that_emit_and_light_nothing() {
    let mut scene = good();
    scene.lights[0].intensity = Rgb::BLACK;
    // A small label before the square, which faces the camera.
    let label = Mat4::from_translation(Vec3::new(0.0, 0.0, 0.5)) * Mat4::from_scale(Vec3::splat(0.2));
    add(&mut scene, square(), Material::emitter(Rgb::WHITE, false), label);
    says(&scene, HintKind::FaintEmission, "hardly light what camera 0 sees");
    // Turned round, it lights the square.
    scene.nodes[3].transform = label * Mat4::from_quat(Quat::from_rotation_y(std::f32::consts::PI));
    assert_eq!(kinds(&scene), []);
}

#[test]
fn materials_that_cannot_be_seen() {
    for (alpha_mode, hidden) in
        [(AlphaMode::Blend, true), (AlphaMode::Mask { cutoff: 0.5 }, true), (AlphaMode::Opaque, false)]
    {
        let mut scene = good();
        let pane = Material { name: "Pane".into(), alpha: 0.0, alpha_mode, ..grey() };
        add(&mut scene, square(), pane, Mat4::from_translation(Vec3::new(0.0, 0.0, -1.0)));
        if hidden {
            says(
                &scene,
                HintKind::InvisibleMaterial,
                "material 1 \"Pane\" has an alpha that lets every ray pass",
            );
        } else {
            assert_eq!(kinds(&scene), []);
        }
    }
    // Where there is nothing else, the camera says so too.
    let mut scene = good();
    scene.materials[0] = Material { alpha: 0.0, alpha_mode: AlphaMode::Blend, ..grey() };
    assert_eq!(kinds(&scene), [HintKind::InvisibleMaterial; 2]);
}

#[test]
fn textures_without_coordinates() {
    let mut scene = good();
    scene.add_image(Image { name: "dot".into(), width: 1, height: 1, rgba8: vec![255; 4] });
    let texture = Texture {
        image: lumbre_scene::ImageId(0),
        wrap_s: Default::default(),
        wrap_t: Default::default(),
        filter: Default::default(),
    };
    scene.textures.push(texture);
    scene.materials[0].base_color_texture = Some(TextureId(0).into());
    says(
        &scene,
        HintKind::MissingTexCoords,
        "mesh 0 has no texture coordinates for the textures of material 0",
    );
    let info = info(&scene).unwrap();
    assert_eq!((info.textures.textures, info.textures.images.len(), info.textures.bytes), (1, 1, 4));
    assert_eq!(info.materials[0].textures, 1);
    primitive(&mut scene, 0).uv0 = vec![Vec2::ZERO; 4];
    assert_eq!(kinds(&scene), []);
}

#[test]
fn sizes_and_places_that_surprise() {
    let scaled = |scale: f32, shift: f32| {
        let mut scene = good();
        let matrix = Mat4::from_translation(Vec3::X * shift) * Mat4::from_scale(Vec3::splat(scale));
        scene.nodes.iter_mut().for_each(|n| n.transform = matrix * n.transform);
        scene.lights[0].intensity = Rgb::splat(scale * scale);
        scene
    };
    says(&scaled(1e-3, 0.0), HintKind::Units, "the scene is 2.828 mm across: if it was made in metres");
    says(
        &scaled(1e4, 0.0),
        HintKind::Units,
        "28.3 km across: if its unit was the centimetre, it is 282.84 m",
    );
    says(
        &scaled(1.0, 1e4),
        HintKind::FarFromOrigin,
        "around (10000, 0, 0), where positions come in steps of 1.192 mm",
    );
    for fine in [scaled(0.01, 0.0), scaled(1000.0, 0.0), scaled(1.0, 100.0)] {
        assert_eq!(kinds(&fine), []);
    }
}

#[test]
fn triangles_that_are_none() {
    let mut scene = good();
    primitive(&mut scene, 0).indices.extend([0, 0, 1, 1, 2, 1, 2, 2, 2]);
    says(&scene, HintKind::Degenerate, "3 of 5 triangles have no area");
    primitive(&mut scene, 0).indices.truncate(9);
    assert_eq!(info(&scene).unwrap().geometry.degenerate_triangles, 1);
    assert_eq!(kinds(&scene), []);
    primitive(&mut scene, 0).positions.push(Vec3::NAN);
    says(&scene, HintKind::NonFinite, "1 parts of meshes have vertices that are not finite");
}

#[test]
fn what_is_left_out_is_told() {
    let mut scene = good();
    add(&mut scene, cube(), grey(), Mat4::from_scale(Vec3::new(1.0, 0.0, 1.0)));
    let info = info(&scene).unwrap();
    assert_eq!((info.notes.len(), info.geometry.instances), (1, 1));
    assert!(info.notes[0].contains("/nodes/3"), "{:?}", info.notes);
    scene.nodes[0].mesh = Some(lumbre_scene::MeshId(9));
    assert!(super::info(&scene).is_err());
}
