//! Which part of a glTF is shown, and how often: scenes, variants, instances of a mesh.

use crate::common::Gltf;
use glam::{Mat4, Quat, Vec3};
use lumbre_io::{ErrorKind, IoError, Limits, LoadOptions, Loaded, SceneChoice, load_scene};
use lumbre_scene::{MaterialId, MeshId, NodeId, Scene};
use serde_json::{Value, json};

fn load(g: &Gltf, options: &LoadOptions) -> Result<Loaded, IoError> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.gltf");
    std::fs::write(&path, g.text()).unwrap();
    load_scene(&path, options)
}

#[test]
fn hidden_nodes_hide_what_hangs_from_them() {
    let mut g = Gltf::triangle();
    g.doc["extensionsRequired"] = json!(["KHR_node_visibility"]);
    let says = |visible: Value| json!({"KHR_node_visibility": visible});
    g.doc["nodes"] = json!([
        {"children": [1, 2], "extensions": says(json!({"visible": false}))},
        {"mesh": 0, "extensions": says(json!({"visible": true}))}, {"mesh": 0},
        {"mesh": 0, "extensions": says(json!({}))}, {"mesh": 0}
    ]);
    g.doc["scenes"] = json!([{"nodes": [0, 3, 4]}]);
    let scene = g.scene();
    let own: Vec<bool> = scene.nodes.iter().map(|n| n.visible).collect();
    assert_eq!(own, [false, true, true, true, true]);
    let seen: Vec<(u32, bool)> = scene.placed_nodes().iter().map(|n| (n.id.0, n.visible)).collect();
    assert_eq!(seen, [(0, false), (1, false), (2, false), (3, true), (4, true)]);
    g.doc["nodes"][3]["extensions"] = says(json!({"visible": 0}));
    let place = "scene.gltf: /nodes/3/extensions/KHR_node_visibility/visible";
    assert_eq!(g.error(), format!("{place}: should be true or false"));
}

/// The message of an error, without the folder.
fn refused(g: &Gltf, options: &LoadOptions) -> String {
    let message = load(g, options).unwrap_err().to_string();
    message.split_once("scene.gltf: ").unwrap().1.to_string()
}

#[test]
fn a_scene_by_number_and_name() {
    let mut g = Gltf::triangle();
    g.doc["nodes"] = json!([{"mesh": 0}, {"mesh": 0}, {"mesh": 0}]);
    g.doc["scenes"] = json!([
        {"nodes": [0], "name": "one"}, {"nodes": [1], "name": "two"}, {"nodes": [2], "name": "two"},
        {"nodes": [0, 1], "name": "0"}
    ]);
    g.doc["scene"] = json!(2);
    let roots = |scene: SceneChoice| {
        let loaded = load(&g, &LoadOptions { scene, ..LoadOptions::default() }).unwrap();
        (loaded.scene.roots, loaded.warnings.len())
    };
    assert_eq!(roots(SceneChoice::Default), (vec![NodeId(2)], 1));
    assert_eq!(roots(SceneChoice::Index(0)), (vec![NodeId(0)], 0));
    // The first of that name.
    assert_eq!(roots(SceneChoice::Name("two".into())), (vec![NodeId(1)], 0));
    assert_eq!(roots(SceneChoice::Name("0".into())), (vec![NodeId(0), NodeId(1)], 0));
    let wrong = |scene| refused(&g, &LoadOptions { scene, ..LoadOptions::default() });
    assert_eq!(wrong(SceneChoice::Index(4)), r#"no scene 4; there are "one", "two", "two", "0""#);
    let name = SceneChoice::Name("tw\n".into());
    assert_eq!(wrong(name), r#"no scene "tw\n"; there are "one", "two", "two", "0""#);
    g.doc.as_object_mut().unwrap().remove("scenes");
    g.doc.as_object_mut().unwrap().remove("scene");
    let index = LoadOptions { scene: SceneChoice::Index(0), ..LoadOptions::default() };
    assert_eq!(refused(&g, &index), "no scene 0; there are none");
}

const VARIANTS: &str = "KHR_materials_variants";

fn with_variants(mappings: Value) -> Gltf {
    let mut g = Gltf::triangle();
    g.doc["materials"] = json!([{}, {}, {}]);
    g.doc["extensions"] = json!({VARIANTS: {"variants": [{"name": "red"}, {"name": "blue"}]}});
    g.primitive()["material"] = json!(0);
    g.primitive()["extensions"] = json!({VARIANTS: {"mappings": mappings}});
    g
}

fn variant(name: &str) -> LoadOptions {
    LoadOptions { variant: Some(name.into()), ..LoadOptions::default() }
}

#[test]
fn variants_change_materials() {
    let mut g = with_variants(json!([{"material": 2, "variants": [1]}]));
    let material = |g: &Gltf, o: &LoadOptions| load(g, o).unwrap().scene.meshes[0].primitives[0].material;
    assert_eq!(material(&g, &LoadOptions::default()), Some(MaterialId(0)));
    assert_eq!(material(&g, &variant("blue")), Some(MaterialId(2)));
    // What a variant does not mention stays.
    assert_eq!(material(&g, &variant("red")), Some(MaterialId(0)));
    g.primitive().as_object_mut().unwrap().remove("material");
    assert_eq!(material(&g, &variant("red")), None);
    g.primitive().as_object_mut().unwrap().remove("extensions");
    assert_eq!(material(&g, &variant("blue")), None);
}

#[test]
fn wrong_variants_are_errors() {
    let one = with_variants(json!([]));
    assert_eq!(refused(&one, &variant("green")), r#"no variant "green"; there are "red", "blue""#);
    assert_eq!(refused(&Gltf::triangle(), &variant("red")), r#"no variant "red"; there are none"#);
    let place = format!("/meshes/0/primitives/0/extensions/{VARIANTS}/mappings/0");
    for (mapping, why) in [
        (json!({"material": 3, "variants": [1]}), "material: refers to material 3, but there are 3"),
        (json!({"material": 1, "variants": [1, 2]}), "variants: refers to variant 2, but there are 2"),
        (json!({"variants": [1]}), "material: is missing"),
        (json!({"material": 1, "variants": [-1]}), "variants: should be a list of small whole numbers"),
    ] {
        assert_eq!(refused(&with_variants(json!([mapping])), &variant("blue")), format!("{place}/{why}"));
    }
    let mut many = with_variants(json!([]));
    let names: Vec<Value> = (0..1000).map(|i| json!({"name": format!("{i}").repeat(100)})).collect();
    many.doc["extensions"][VARIANTS]["variants"] = json!(names);
    let message = refused(&many, &variant("x"));
    assert!(message.len() < 3000 && message.ends_with(" and 970 more"), "{message}");
}

#[test]
fn other_formats_have_neither_scenes_nor_variants() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.obj");
    std::fs::write(&path, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    let first = LoadOptions { scene: SceneChoice::Index(0), ..LoadOptions::default() };
    for (options, why) in
        [(first, "no scene 0; there are none"), (variant("red"), "no variant \"red\"; there are none")]
    {
        let e = load_scene(&path, &options).unwrap_err();
        assert_eq!((e.to_string(), e.kind()), (format!("{}: {why}", path.display()), ErrorKind::BadChoice));
    }
    assert!(load_scene(&path, &LoadOptions::default()).is_ok());
}

const INSTANCING: &str = "EXT_mesh_gpu_instancing";

/// A node, twice as large as its mesh, with these attributes of its instances.
fn instanced(attributes: impl FnOnce(&mut Gltf) -> Value) -> Gltf {
    let mut g = Gltf::triangle();
    g.doc["extensionsRequired"] = json!([INSTANCING]);
    let attributes = attributes(&mut g);
    g.doc["nodes"] = json!([
        {"mesh": 0, "scale": [2, 2, 2], "children": [1], "extensions": {INSTANCING: {"attributes": attributes}}},
        {"mesh": 0}
    ]);
    g
}

/// The world transforms of all meshes, that of node 1 left out.
fn placed(scene: &Scene) -> Vec<Mat4> {
    let world = scene.world_nodes();
    assert!(scene.nodes.iter().all(|n| n.mesh.is_none_or(|m| m == MeshId(0))));
    let drawn = world.iter().filter(|(id, _)| *id != NodeId(1) && scene.nodes[id.index()].mesh.is_some());
    drawn.map(|(_, m)| *m).collect()
}

#[test]
fn instances_stand_where_their_accessors_say() {
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let g = instanced(|g| {
        let translation = g.f32s("VEC3", &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
        let rotation = g.f32s("VEC4", &[0.0, 0.0, 0.0, 1.0, 0.0, half, 0.0, half]);
        let scale = g.f32s("VEC3", &[1.0, 1.0, 1.0, 1.0, -2.0, 3.0]);
        json!({"TRANSLATION": translation, "ROTATION": rotation, "SCALE": scale, "_COLOR": 0})
    });
    let scene = g.scene();
    assert_eq!(scene.meshes.len(), 1);
    let [a, b] = placed(&scene)[..] else { panic!("two instances") };
    let double = Mat4::from_scale(Vec3::splat(2.0));
    assert!(a.abs_diff_eq(double * Mat4::from_translation(Vec3::new(1.0, 2.0, 3.0)), 1e-6));
    let turned = Quat::from_rotation_y(std::f32::consts::FRAC_PI_2);
    let want =
        Mat4::from_scale_rotation_translation(Vec3::new(1.0, -2.0, 3.0), turned, Vec3::new(4.0, 5.0, 6.0));
    assert!(b.abs_diff_eq(double * want, 1e-5), "{b}");
    // The node's own child is as it was.
    assert_eq!(scene.world_nodes().iter().find(|(id, _)| id.0 == 1).unwrap().1, double);
}

#[test]
fn rotations_of_instances_may_be_small_integers() {
    let quarter: &[i8] = &[0, 0, 127, 127, 0, 0, 0, 127];
    let bytes: Vec<u8> = quarter.iter().map(|&v| v as u8).collect();
    let shorts: Vec<u8> =
        [0i16, 0, 32767, 32767, 0, 0, 0, 32767].iter().flat_map(|v| v.to_le_bytes()).collect();
    for (component, data) in [(5120, bytes), (5122, shorts)] {
        let g = instanced(|g| {
            let rotation = g.raw(component, "VEC4", 2, &data);
            g.doc["accessors"][rotation]["normalized"] = json!(true);
            json!({"ROTATION": rotation})
        });
        let placed = placed(&g.scene());
        assert_eq!(placed.len(), 2);
        let x = placed[0].transform_point3(Vec3::X);
        assert!(x.abs_diff_eq(2.0 * Vec3::Y, 1e-5), "{x}");
        assert!(placed[1].abs_diff_eq(Mat4::from_scale(Vec3::splat(2.0)), 1e-5));
    }
}

#[test]
fn odd_instances_are_warned_of_or_refused() {
    let none = instanced(|_| json!({})).load().unwrap();
    assert_eq!((placed(&none.scene).len(), none.warnings.len()), (1, 1));
    let mut meshless = instanced(|_| json!({"TRANSLATION": 0}));
    meshless.doc["nodes"][0].as_object_mut().unwrap().remove("mesh");
    let loaded = meshless.load().unwrap();
    assert_eq!((placed(&loaded.scene).len(), loaded.warnings.len()), (0, 1));
    let zero = instanced(|g| json!({"ROTATION": g.f32s("VEC4", &[0.0; 4])})).load().unwrap();
    assert_eq!((placed(&zero.scene).len(), zero.warnings.len()), (1, 1));

    let place = format!("scene.gltf: /nodes/0/extensions/{INSTANCING}");
    let uneven =
        instanced(|g| json!({"TRANSLATION": g.f32s("VEC3", &[0.0; 6]), "SCALE": g.f32s("VEC3", &[1.0; 3])}));
    let why = "/attributes/SCALE: has 1 elements, but another attribute has 2";
    assert_eq!(uneven.error(), format!("{place}{why}"));
    let wrong = instanced(|_| json!({"TRANSLATION": 9}));
    assert_eq!(
        wrong.error(),
        format!("{place}/attributes/TRANSLATION: refers to accessor 9, but there are 2")
    );
    let nan = instanced(|g| json!({"TRANSLATION": g.f32s("VEC3", &[0.0, f32::NAN, 0.0])}));
    assert_eq!(nan.error(), format!("{place}/attributes: the transform of instance 0 is not finite"));
    let flat = instanced(|g| json!({"TRANSLATION": g.f32s("VEC2", &[0.0; 2])}));
    assert!(flat.error().starts_with("scene.gltf: /accessors/2/type: has a type that does not fit"));
}

#[test]
fn instances_count_towards_the_limit() {
    let g = instanced(|g| json!({"TRANSLATION": g.f32s("VEC3", &[0.0; 9])}));
    let with = |max_instances| {
        let limits = Limits { max_instances, ..Limits::default() };
        load(&g, &LoadOptions { limits, ..LoadOptions::default() })
    };
    assert!(with(5).is_ok());
    let message = with(4).unwrap_err().to_string();
    assert!(message.ends_with("number of instances 5 exceeds the limit of 4"), "{message}");
    // A claim that no bytes bear out is refused, however small the file.
    let mut huge = instanced(|g| json!({"TRANSLATION": g.f32s("VEC3", &[0.0; 3])}));
    huge.doc["accessors"][2]["count"] = json!(16_000_000);
    assert!(huge.error().contains("do not fit into a buffer view"));
}
