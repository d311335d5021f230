//! Edits of scenes in memory: what is set is seen, comes back from text, and leaves nothing behind when it is taken back.

mod files;
mod random;

use super::*;
use glam::{Mat4, Quat, Vec3};
use lumbre_core::camera::Camera;
use lumbre_core::{Rgb, film::Film};
use lumbre_scene::{
    AlphaMode, Anisotropy, Background, Clearcoat, DiffuseTransmission, EnvironmentMap, Iridescence, Light,
    LightId, LightKind, Material, MaterialId, Node, NodeId, Phong, Scene, Sheen, Sun, TextureId, TextureRef,
    Volume,
};

/// A material with everything on, so that all of its parameters show.
fn rich() -> Material {
    let texture = Some(TextureRef::from(TextureId(0)));
    Material {
        name: "rich".into(),
        base_color: Rgb::new(0.5, 0.25, 0.75),
        normal_texture: texture,
        emission: Rgb::new(1.0, 4.0, 2.0),
        alpha_mode: AlphaMode::Mask { cutoff: 0.25 },
        transmission: 0.5,
        volume: Some(Volume {
            thickness: 0.5,
            attenuation_color: Rgb::splat(0.5),
            attenuation_distance: 2.0,
        }),
        diffuse_transmission: Some(DiffuseTransmission {
            factor: 0.5,
            texture: None,
            color: Rgb::WHITE,
            color_texture: None,
        }),
        anisotropy: Some(Anisotropy { strength: 0.5, rotation: 1.0, texture: None }),
        iridescence: Some(Iridescence {
            factor: 1.0,
            texture: None,
            ior: 1.5,
            thickness_min_nm: 200.0,
            thickness_max_nm: 300.0,
            thickness_texture: texture,
        }),
        sheen: Some(Sheen {
            color: Rgb::WHITE,
            color_texture: None,
            roughness: 0.5,
            roughness_texture: None,
        }),
        clearcoat: Some(Clearcoat {
            factor: 1.0,
            texture: None,
            roughness: 0.5,
            roughness_texture: None,
            normal_texture: texture,
            normal_scale: 0.5,
        }),
        phong: Some(Phong { specular: Rgb::WHITE, specular_texture: None, exponent: 7.0, fresnel: false }),
        ..Material::default()
    }
}

/// Materials, nodes above one another, lights that share and do not, a sun and a map.
pub(super) fn scene() -> Scene {
    let mut scene = Scene::default();
    scene.add_material(rich());
    for name in ["plain", "twin", "twin", ""] {
        scene.add_material(Material { name: name.into(), ..Material::default() });
    }
    let light = |name: &str, kind| Light { name: name.into(), kind, intensity: Rgb::new(10.0, 20.0, 5.0) };
    scene.lights = vec![
        light("bulb", LightKind::Point),
        light("beam", LightKind::Spot { inner_angle: 0.25, outer_angle: 0.5 }),
        light("shared", LightKind::Directional),
    ];
    let node = |name: &str, light: Option<u32>| Node {
        name: name.into(),
        light: light.map(LightId),
        transform: Mat4::from_scale_rotation_translation(
            Vec3::new(1.0, 2.0, 1.0),
            Quat::from_rotation_y(0.5),
            Vec3::new(1.0, 2.0, 3.0),
        ),
        ..Node::default()
    };
    let root = scene.add_root(node("root", None));
    for (name, light) in
        [("", Some(0)), ("spot", Some(1)), ("one", Some(2)), ("two", Some(2)), ("chair", None)]
    {
        let id = NodeId(scene.nodes.len() as u32);
        scene.nodes.push(node(name, light));
        scene.nodes[root.index()].children.push(id);
    }
    scene.add_root(node("lamp", Some(1)));
    scene.lights.push(light("lamp", LightKind::Spot { inner_angle: 0.0, outer_angle: 1.0 }));
    scene.nodes[6].light = Some(LightId(3));
    scene.environment.sun = Some(Sun::daylight(30.0, 40.0, 50.0));
    let pixels = vec![Rgb::WHITE, Rgb::BLACK].into();
    scene.environment.background = Background::Map(EnvironmentMap { width: 2, height: 1, pixels });
    scene.environment.rotation = 0.5;
    scene
}

pub(super) fn camera() -> Camera {
    Camera::look_at(Vec3::new(1.0, 2.0, 3.0), Vec3::ZERO, Vec3::Y, 1.0, 1.5)
}

/// Everything in the scene that has parameters, and a light and a bookmark that are added here.
pub(super) fn items(edits: &mut Edits) -> Vec<Item> {
    let (bookmark, added) = (edits.add_bookmark("", Changes::default()), edits.add_light(""));
    let materials = (0..5).map(|i| Item::Material(MaterialId(i)));
    let nodes = (0..7).map(|i| Item::Node(NodeId(i)));
    let lights = [1, 2, 3, 4, 6].map(|i| Item::Light(NodeId(i)));
    let others = [Item::Camera, Item::Sun, Item::Sky, Item::Settings, Item::Look, bookmark, added];
    others.into_iter().chain(materials).chain(nodes).chain(lights).collect()
}

/// Values that a parameter may hold.
pub(super) fn values(kind: &Kind) -> Vec<Value> {
    let mut all: Vec<Value> = kind.words().iter().map(|w| Value::Word(w)).collect();
    match *kind {
        Kind::Number { range: [a, b], slider: [c, d], .. } => {
            all.extend([a, b, c, d, 0.3 * c + 0.7 * d].map(Value::Number));
        }
        Kind::Whole { range: [a, b], .. } => all.extend([a, b, 7].map(Value::Whole)),
        Kind::Color { most } => {
            all.extend([Rgb::new(0.1, 0.2, 0.3), Rgb::BLACK, Rgb::splat(most)].map(Value::Color));
        }
        Kind::Vector { range: [a, b], .. } => {
            all.extend([Vec3::new(0.1, -2.0, 3.0), Vec3::new(a, b, 1.0), Vec3::ZERO].map(Value::Vector));
        }
        Kind::Flag => all.extend([true, false].map(Value::Flag)),
        Kind::Choice(_) => {}
        Kind::Aperture => all.extend([Value::FNumber(2.8), Value::Number(0.0125)]),
        Kind::Camera => all.extend(["beam me", "3"].map(|t| Value::Text(t.into()))),
        Kind::File => all.push(Value::Text("a \"quoted\" ünicode.hdr".into())),
    }
    all
}

/// All that edits decide.
fn seen(edits: &Edits, base: &Scene) -> impl PartialEq + std::fmt::Debug {
    let map = EnvironmentMap { width: 1, height: 1, pixels: vec![Rgb::splat(9.0)].into() };
    let scene = edits.apply_with(base, Some(&map)).unwrap();
    let bookmarks: Vec<_> = edits.bookmarks.iter().map(|b| b.changes.camera_options()).collect();
    let settings = edits.settings(RenderSettings::default());
    (scene, edits.camera_options(), bookmarks, settings, edits.look(LookEdits::default()))
}

#[test]
fn every_parameter_is_seen_where_it_applies() {
    let base = scene();
    let mut edits = Edits::default();
    let items = items(&mut edits);
    // What must be so that others show.
    edits.set(&base, Item::Added(0), "kind", Value::Word("spot")).unwrap();
    edits.set(&base, Item::Light(NodeId(1)), "kind", Value::Word("spot")).unwrap();
    edits.set(&base, Item::Sky, "file", Value::Text("a.hdr".into())).unwrap();
    let mut count = 0;
    for item in items {
        for row in edits.rows(&base, &camera(), item).unwrap() {
            for value in values(&row.kind).into_iter().filter(|v| *v != row.value) {
                let mut changed = edits.clone();
                changed.set(&base, item, row.name, value.clone()).unwrap();
                if (item, row.name, &value) == (Item::Sky, "kind", &Value::Word("map")) {
                    continue;
                }
                let now = changed.rows(&base, &camera(), item).unwrap();
                let now = now.iter().find(|r| r.name == row.name).unwrap();
                assert_eq!(now.value, value, "{item:?} {}", row.name);
                let text = changed.to_text();
                assert_eq!(Edits::parse(&text).unwrap(), changed, "{text}");
                if now.applies {
                    assert_ne!(seen(&changed, &base), seen(&edits, &base), "{item:?} {} {value}", row.name);
                    count += 1;
                }
                // Back again.
                if row.changed {
                    changed.set(&base, item, row.name, row.value.clone()).unwrap();
                } else {
                    changed.unset(&base, item, row.name).unwrap();
                }
                assert_eq!(changed, edits, "{item:?} {}", row.name);
            }
        }
    }
    assert!(count > 500, "{count}");
}

/// Of each table every parameter shows somewhere in the scene above, so that the test above has seen it.
#[test]
fn every_parameter_applies_to_something() {
    let base = scene();
    let mut edits = Edits::default();
    let items = items(&mut edits);
    edits.set(&base, Item::Sky, "kind", Value::Word("file")).unwrap();
    edits.set(&base, Item::Camera, "aperture", Value::FNumber(4.0)).unwrap();
    let rows = |item: &Item| edits.rows(&base, &camera(), *item).unwrap();
    let mut all: Vec<Row> = items.iter().flat_map(rows).collect();
    let projection = lumbre_core::camera::Projection::Orthographic { half_height: 1.0 };
    all.extend(edits.rows(&base, &Camera { projection, ..camera() }, Item::Camera).unwrap());
    for row in &all {
        let shows = all.iter().any(|r| r.name == row.name && r.label == row.label && r.applies);
        assert!(shows || row.name == "color" && row.label == "Colour", "{}", row.name);
    }
    // Names and labels are all there, and no table has a name twice.
    for item in &items {
        let rows = rows(item);
        for (i, row) in rows.iter().enumerate() {
            assert!(!row.name.is_empty() && !row.label.is_empty());
            assert!(rows[..i].iter().all(|r| r.name != row.name), "{} twice", row.name);
            let groups: Vec<&str> = rows.iter().map(|r| r.group).collect();
            let first = groups.iter().position(|g| *g == row.group).unwrap();
            assert!(groups[first..=i].iter().all(|g| *g == row.group), "{} is torn apart", row.group);
        }
    }
}

#[test]
fn what_is_set_back_leaves_nothing() {
    let base = scene();
    let mut fresh = Edits::default();
    for item in items(&mut Edits::default()) {
        if matches!(item, Item::Camera | Item::Bookmark(_) | Item::Added(_)) {
            continue;
        }
        for row in fresh.rows(&base, &camera(), item).unwrap() {
            for value in values(&row.kind) {
                fresh.set(&base, item, row.name, value).unwrap();
            }
            if row.name != "file" {
                fresh.set(&base, item, row.name, row.value.clone()).unwrap();
            }
            fresh.unset(&base, item, "file").unwrap();
            assert_eq!(fresh, Edits::default(), "{item:?} {}", row.name);
        }
    }
}

#[test]
fn an_empty_document_is_the_scene() {
    let base = scene();
    let edits = Edits::default();
    assert!(edits.is_empty());
    assert_eq!(edits.apply(&base).unwrap(), base);
    assert_eq!(edits.settings(RenderSettings::default()), RenderSettings::default());
    assert_eq!(edits.camera_options(), crate::CameraOptions::default());
    assert_eq!(edits.to_text(), "{\n  \"lumbreEdits\": 1\n}\n");
    assert_eq!(Edits { scene: "a".into(), ..edits.clone() }.to_text().lines().count(), 4);
}

#[test]
fn a_light_of_the_file_moves_turns_and_changes_by_itself() {
    let base = scene();
    let mut edits = Edits::default();
    let (one, spot) = (Item::Light(NodeId(3)), Item::Light(NodeId(2)));
    edits.set(&base, one, "intensity", Value::Number(3.0)).unwrap();
    edits.set(&base, spot, "position", Value::Vector(Vec3::new(5.0, 6.0, 7.0))).unwrap();
    edits.set(&base, spot, "direction", Value::Vector(Vec3::new(0.0, 0.0, 8.0))).unwrap();
    let scene = edits.apply(&base).unwrap();
    let own = scene.nodes[3].light.unwrap();
    assert_eq!((own, scene.nodes[4].light), (LightId(4), Some(LightId(2))), "the other one keeps the light");
    assert_eq!(scene.lights[4].intensity, Rgb::new(1.5, 3.0, 0.75));
    assert_eq!(scene.lights[2], base.lights[2]);
    let world = scene.world_nodes().into_iter().find(|(id, _)| *id == NodeId(2)).unwrap().1;
    assert!((world.w_axis.truncate() - Vec3::new(5.0, 6.0, 7.0)).length() < 1e-5, "{world}");
    assert!((-world.z_axis.truncate().normalize() - Vec3::Z).length() < 1e-5, "{world}");
    // A light at a root stands exactly where it is put.
    edits.set(&base, Item::Light(NodeId(6)), "position", Value::Vector(Vec3::new(0.1, 0.2, 0.3))).unwrap();
    let scene = edits.apply(&base).unwrap();
    assert_eq!(scene.nodes[6].transform.w_axis.truncate(), Vec3::new(0.1, 0.2, 0.3));
    assert_eq!(scene.nodes[6].transform.matrix3(), base.nodes[6].transform.matrix3());
    edits.remove_light(&base, spot).unwrap();
    assert_eq!(edits.apply(&base).unwrap().nodes[2].light, None);
    assert!(edits.remove_light(&base, Item::Light(NodeId(0))).is_err());
}

trait Matrix3 {
    fn matrix3(&self) -> glam::Mat3;
}

impl Matrix3 for Mat4 {
    fn matrix3(&self) -> glam::Mat3 {
        glam::Mat3::from_mat4(*self)
    }
}

#[test]
fn lights_are_added_and_removed() {
    let base = scene();
    let mut edits = Edits::default();
    let items = ["fill", "fill", ""].map(|name| edits.add_light(name));
    assert_eq!(items, [0, 1, 2].map(Item::Added));
    let names: Vec<&str> = edits.added_lights().iter().map(|l| &*l.name).collect();
    assert_eq!(names, ["fill", "fill 2", "light"]);
    edits.set(&base, items[1], "position", Value::Vector(Vec3::X)).unwrap();
    edits.set(&base, items[1], "kind", Value::Word("spot")).unwrap();
    edits.set(&base, items[1], "innerAngle", Value::Number(45.0)).unwrap();
    edits.set(&base, items[2], "on", Value::Flag(false)).unwrap();
    let scene = edits.apply(&base).unwrap();
    assert_eq!((scene.lights.len(), scene.nodes.len(), scene.roots.len()), (6, 9, 4));
    // The inside of a cone is not wider than its outside.
    let angle = 30f32.to_radians();
    let kind = LightKind::Spot { inner_angle: angle, outer_angle: angle };
    assert_eq!(scene.lights[5], Light { name: "fill 2".into(), kind, intensity: Rgb::splat(100.0) });
    let node = &scene.nodes[8];
    assert_eq!((node.transform.w_axis.truncate(), node.light), (Vec3::X, Some(LightId(5))));
    assert!((-node.transform.z_axis.truncate() - Vec3::NEG_Y).length() < 1e-6);
    edits.remove_light(&base, items[0]).unwrap();
    assert_eq!(edits.added_lights().len(), 2);
    assert!(edits.remove_light(&base, Item::Added(2)).is_err());
    assert_eq!(Edits::parse(&edits.to_text()).unwrap(), edits);
}

#[test]
fn sun_and_sky_are_those_of_the_command_line() {
    let base = Scene::default();
    let mut edits = Edits::default();
    let mut set = |item, name, value| edits.set(&base, item, name, value).unwrap();
    set(Item::Sun, "elevation", Value::Number(50.0));
    set(Item::Sun, "azimuth", Value::Number(-120.0));
    set(Item::Sun, "strength", Value::Number(20.0));
    set(Item::Sky, "kind", Value::Word("gradient"));
    assert_eq!(edits.apply(&base).unwrap().environment.sun, None, "it is off");
    let idle = edits.idle(&base).unwrap();
    assert_eq!(idle.len(), 3);
    assert_eq!(idle[0], "/sun/elevation: does not show, as things are");
    edits.set(&base, Item::Sun, "on", Value::Flag(true)).unwrap();
    assert_eq!(edits.idle(&base).unwrap(), [""; 0]);
    let environment = edits.apply(&base).unwrap().environment;
    assert_eq!(environment.sun, Some(Sun::daylight(50.0, -120.0, 20.0)));
    assert_eq!(environment.background, Background::Gradient);
}

#[test]
fn a_sky_in_a_file_waits_for_its_map() {
    let base = scene();
    let mut edits = Edits::default();
    edits.set(&base, Item::Sky, "rotation", Value::Number(90.0)).unwrap();
    assert_eq!(edits.sky_file(), None);
    assert_eq!(edits.apply(&base).unwrap().environment.rotation, 90f32.to_radians());
    edits.unset(&base, Item::Sky, "rotation").unwrap();
    edits.set(&base, Item::Sky, "kind", Value::Word("file")).unwrap();
    assert_eq!(edits.apply(&base).unwrap_err().to_string(), "/sky/kind: no file is named: `file` is missing");
    edits.set(&base, Item::Sky, "file", Value::Text("day.hdr".into())).unwrap();
    assert_eq!(edits.sky_file(), Some("day.hdr".into()));
    assert_eq!(edits.apply(&base).unwrap_err().to_string(), "/sky/file: the file was not read");
    let map = EnvironmentMap { width: 1, height: 1, pixels: vec![Rgb::WHITE].into() };
    let environment = edits.apply_with(&base, Some(&map)).unwrap().environment;
    assert_eq!((environment.background, environment.rotation), (Background::Map(map), 0.0));
    // The scene's own map only where it has one.
    edits.set(&base, Item::Sky, "kind", Value::Word("map")).unwrap();
    assert_eq!(edits.apply(&base).unwrap(), base);
    let edits = Edits::parse(r#"{"lumbreEdits": 1, "sky": {"kind": "map"}}"#).unwrap();
    assert!(edits.apply(&Scene::default()).unwrap_err().to_string().contains("brings no map"));
}

#[test]
fn rotations_are_about_x_then_y_then_z() {
    let base = scene();
    let mut edits = Edits::default();
    let chair = Item::Node(NodeId(5));
    edits.set(&base, chair, "scale", Value::Vector(Vec3::ONE)).unwrap();
    let turned = |edits: &Edits, v: Vec3| edits.apply(&base).unwrap().nodes[5].transform.transform_vector3(v);
    let mut turn = |x, y, z| {
        edits.set(&base, chair, "rotation", Value::Vector(Vec3::new(x, y, z))).unwrap();
        edits.clone()
    };
    let close = |a: Vec3, b: Vec3| assert!((a - b).length() < 1e-6, "{a} {b}");
    close(turned(&turn(90.0, 0.0, 0.0), Vec3::Y), Vec3::Z);
    close(turned(&turn(0.0, 90.0, 0.0), Vec3::Z), Vec3::X);
    close(turned(&turn(0.0, 0.0, 90.0), Vec3::X), Vec3::Y);
    close(turned(&turn(90.0, 90.0, 0.0), Vec3::Y), Vec3::X);
    close(turned(&turn(90.0, 90.0, 90.0), Vec3::Y), Vec3::Y);
    // What is read off is what was set.
    for angles in [Vec3::new(10.0, 20.0, 30.0), Vec3::new(-170.0, 80.0, 5.0)] {
        let q = edits_rotation(angles);
        assert!((place::degrees(q) - angles).length() < 1e-3, "{}", place::degrees(q));
    }
}

fn edits_rotation(angles: Vec3) -> Quat {
    let [x, y, z] = angles.to_array().map(f32::to_radians);
    Quat::from_rotation_z(z) * Quat::from_rotation_y(y) * Quat::from_rotation_x(x)
}

#[test]
fn the_camera_is_the_command_line_s() {
    let base = Scene::default();
    let mut edits = Edits::default();
    let point = |x, y, z| Value::Vector(Vec3::new(x, y, z));
    for (name, value) in [
        ("camera", Value::Text("2".into())),
        ("eye", point(1.0, 2.0, 3.0)),
        ("target", point(0.0, 1.0, 0.0)),
        ("up", point(1.0, 0.0, 0.0)),
        ("fov", Value::Number(35.0)),
        ("height", Value::Number(3.0)),
        ("aperture", Value::FNumber(2.8)),
        ("focus", Value::Number(4.0)),
    ] {
        edits.set(&base, Item::Camera, name, value).unwrap();
    }
    use crate::camera::*;
    let options = CameraOptions {
        choice: CameraChoice::Index(2),
        look_from: Some(Vec3::new(1.0, 2.0, 3.0)),
        look_at: Some(Vec3::Y),
        up: Some(Vec3::X),
        fov: Some(35f32.to_radians()),
        height: Some(3.0),
        aperture: Some(Aperture::FNumber(2.8)),
        focus: Focus::Distance(4.0),
    };
    assert_eq!(edits.camera_options(), options);
    let item = edits.add_bookmark("door", edits.camera.clone());
    assert_eq!(edits.bookmark("door").unwrap().changes.camera_options(), options);
    edits.set(&base, item, "aperture", Value::Word("off")).unwrap();
    edits.set(&base, item, "focus", Value::Word("auto")).unwrap();
    let options = edits.bookmarks[0].changes.camera_options();
    assert_eq!((options.aperture, options.focus), (Some(Aperture::Diameter(0.0)), Focus::Auto));
    // Rows of what is not set come from the camera that is shown.
    let rows = Edits::default().rows(&base, &camera(), Item::Camera).unwrap();
    let of = |name: &str| rows.iter().find(|r| r.name == name).unwrap().value.clone();
    assert_eq!(of("eye"), point(1.0, 2.0, 3.0));
    let Value::Number(fov) = of("fov") else { panic!() };
    assert!((fov.to_radians() - 1.0).abs() < 1e-6);
}

#[test]
fn what_a_parameter_may_not_hold_is_refused() {
    let base = scene();
    let mut edits = Edits::default();
    let material = Item::Material(MaterialId(0));
    for (item, name, value, says) in [
        (material, "roughness", Value::Number(1.5), "/roughness: expected a number from 0 to 1, not 1.5"),
        (
            material,
            "roughness",
            Value::Number(f32::NAN),
            "/roughness: expected a number from 0 to 1, not NaN",
        ),
        (material, "roughness", Value::Flag(true), "/roughness: expected a number from 0 to 1, not true"),
        (
            material,
            "baseColor",
            Value::Color(Rgb::splat(-0.5)),
            "expected a colour [r, g, b], each from 0 to 1",
        ),
        (material, "emissionStrength", Value::Number(f32::INFINITY), "from 0 to 1e12 nit"),
        (material, "alphaMode", Value::Word("glass"), "expected one of \"opaque\", \"mask\", \"blend\""),
        (
            material,
            "roughnes",
            Value::Number(0.5),
            "there is no such key here; there are baseColor, metallic",
        ),
        (Item::Sky, "file", Value::Text(String::new()), "expected the path of a file"),
        (Item::Camera, "aperture", Value::FNumber(0.0), "expected \"f/2.8\" or the like"),
        (Item::Node(NodeId(5)), "translation", Value::Vector(Vec3::NAN), "each from -1e12 to 1e12 m"),
        (Item::Node(NodeId(99)), "visible", Value::Flag(false), "there is no node 99"),
        (Item::Light(NodeId(5)), "on", Value::Flag(false), "there is no light 5"),
        (Item::Material(MaterialId(9)), "unlit", Value::Flag(true), "there is no material 9"),
        (Item::Bookmark(0), "fov", Value::Number(40.0), "there is no bookmark 0"),
        (Item::Settings, "maxDepth", Value::Whole(70_000), "a whole number from 0 to 65536 or \"unlimited\""),
    ] {
        let e = edits.set(&base, item, name, value).unwrap_err().to_string();
        assert!(e.contains(says), "{e}");
    }
    assert_eq!(edits, Edits::default());
}

/// What is drawn of edits is what is drawn of the same scene made by hand.
#[test]
fn the_picture_is_that_of_a_scene_edited_by_hand() {
    let mut base = Scene::default();
    let grey = base.add_material(Material { name: "grey".into(), ..Material::diffuse(Rgb::splat(0.5)) });
    let mut primitive = lumbre_scene::Primitive { material: Some(grey), ..Default::default() };
    primitive.positions =
        vec![Vec3::new(-2.0, 0.0, 2.0), Vec3::new(2.0, 0.0, 2.0), Vec3::new(0.0, 0.0, -2.0)];
    primitive.indices = vec![0, 1, 2];
    let mesh = base.add_mesh(lumbre_scene::Mesh { name: "floor".into(), primitives: vec![primitive] });
    base.add_root(Node { name: "floor".into(), mesh: Some(mesh), ..Node::default() });
    let edits = Edits::parse(
        r#"{"lumbreEdits": 1, "materials": {"grey": {"baseColor": [0.8, 0.2, 0.1], "roughness": 0.3}},
        "nodes": {"floor": {"translation": [0, 0.5, 0]}}, "sky": {"kind": "gradient"},
        "addedLights": {"lamp": {"position": [0, 2, 0], "intensity": 30}}}"#,
    );
    let edited = edits.unwrap().apply(&base).unwrap();
    base.materials[0].base_color = Rgb::new(0.8, 0.2, 0.1);
    base.materials[0].roughness = 0.3;
    base.nodes[0].transform = Mat4::from_translation(Vec3::new(0.0, 0.5, 0.0));
    base.environment.background = Background::Gradient;
    let light = Some(LightId(0));
    base.lights.push(Light { name: "lamp".into(), kind: LightKind::Point, intensity: Rgb::splat(30.0) });
    let transform = Mat4::from_translation(Vec3::new(0.0, 2.0, 0.0));
    base.add_root(Node { name: "lamp".into(), transform, light, ..Node::default() });
    let film = |scene: &Scene| {
        let compiled = crate::compile(scene).unwrap().scene;
        let camera = Camera::look_at(Vec3::new(0.0, 3.0, 4.0), Vec3::ZERO, Vec3::Y, 1.0, 1.0);
        let view = crate::core::settings::View { camera, settings: RenderSettings::default(), frame: 0 };
        let backend = crate::prepare_cpu(compiled).unwrap();
        let mut film = Film::new(8, 8);
        crate::render(&backend, &view, crate::Targets::spp(4), &mut film, &()).unwrap();
        film.radiance()
    };
    let (by_edits, by_hand) = (film(&edited), film(&base));
    assert!(by_hand.iter().any(|c| !c.is_black()));
    assert_eq!(by_edits, by_hand);
    base.materials[0].base_color.g = 0.21;
    assert_ne!(by_edits, film(&base));
}

#[test]
fn what_has_no_size_is_edited_all_the_same() {
    let base = scene();
    let mut edits = Edits::default();
    edits.set(&base, Item::Node(NodeId(0)), "scale", Value::Vector(Vec3::ZERO)).unwrap();
    edits.set(&base, Item::Light(NodeId(2)), "position", Value::Vector(Vec3::ONE)).unwrap();
    let flat = edits.apply(&base).unwrap();
    assert_eq!(flat.nodes[2], base.nodes[2]);
    let mut again = Edits::default();
    again.set(&flat, Item::Node(NodeId(0)), "scale", Value::Vector(Vec3::ONE)).unwrap();
    let up = again.apply(&flat).unwrap();
    assert_eq!(up.nodes[0].transform, Mat4::from_translation(Vec3::new(1.0, 2.0, 3.0)));
}
