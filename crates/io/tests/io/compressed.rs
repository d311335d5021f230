//! Compressed meshes: streams of the formats' own encoders (`data/draco.json` by draco3d 1.5.9 and `data/meshopt.json` by
//! meshoptimizer 1.3, each with what its own decoder makes of them), and scenes beside their uncompressed twins.

use crate::common::{Gltf, scenes_folder, unbase64};
use glam::{Mat3, Vec2, Vec3};
use lumbre_io::{LoadOptions, load_scene};
use lumbre_scene::{Primitive, Scene};
use serde_json::{Value, json};
use std::collections::HashMap;
use std::path::Path;

/// Where `crate::common::meshopt_scene` puts the compressed view.
const VIEW: usize = 2;

fn floats(list: &Value) -> Vec<f32> {
    list.as_array().unwrap().iter().map(|v| v.as_f64().unwrap() as f32).collect()
}

fn draco_cases() -> Vec<Value> {
    serde_json::from_str(include_str!("data/draco.json")).unwrap()
}

fn draco_scene(case: &Value) -> Gltf {
    crate::common::draco_scene(case, &unbase64(&case["stream"]))
}

#[test]
fn draco_streams_hold_what_their_own_decoder_says() {
    for case in draco_cases() {
        let loaded = draco_scene(&case).load().unwrap_or_else(|e| panic!("{}: {e}", case["name"]));
        assert_eq!(loaded.warnings, Vec::<String>::new());
        let p = &loaded.scene.meshes[0].primitives[0];
        let faces: Vec<u32> =
            case["faces"].as_array().unwrap().iter().map(|v| v.as_u64().unwrap() as u32).collect();
        assert_eq!(p.indices, faces, "{}", case["name"]);
        let lanes = |name: &str| floats(&case["attributes"][name]);
        let same = |have: Vec<f32>, want: Vec<f32>, scale: f32, what: &str| {
            assert_eq!(have.len(), want.len(), "{}: {what}", case["name"]);
            for (h, w) in have.into_iter().zip(want) {
                assert!((h - w * scale).abs() < 1e-6, "{}: {what}: {h}, not {}", case["name"], w * scale);
            }
        };
        same(p.positions.iter().flat_map(|v| v.to_array()).collect(), lanes("POSITION"), 1.0, "positions");
        same(p.normals.iter().flat_map(|v| v.to_array()).collect(), lanes("NORMAL"), 1.0, "normals");
        same(p.uv0.iter().flat_map(|v| v.to_array()).collect(), lanes("TEXCOORD_0"), 1.0, "coordinates");
        same(p.colors.iter().flat_map(|v| v.to_array()).collect(), lanes("COLOR_0"), 1.0 / 255.0, "colours");
    }
}

#[test]
fn draco_must_hold_what_the_accessors_claim() {
    let case = &draco_cases()[1];
    let place = "scene.gltf: /meshes/0/primitives/0/extensions/KHR_draco_mesh_compression";
    let message = |change: &dyn Fn(&mut Gltf)| {
        let mut g = draco_scene(case);
        change(&mut g);
        g.error()
    };
    let fewer = message(&|g| (0..4).for_each(|i| g.doc["accessors"][i]["count"] = json!(19)));
    assert!(fewer.starts_with(place), "{fewer}");
    let more = message(&|g| (0..4).for_each(|i| g.doc["accessors"][i]["count"] = json!(400_000_000)));
    assert_eq!(
        more,
        format!("{place}: holds 20 vertices and 22 triangles, but the accessors say 400000000 and 22")
    );
    let fewer = message(&|g| g.doc["accessors"][4]["count"] = json!(63));
    assert!(fewer.starts_with(place) && fewer.contains("faces"), "{fewer}");
    let more = message(&|g| g.doc["accessors"][4]["count"] = json!(3000));
    assert!(more.ends_with("22 triangles, but the accessors say 20 and 1000"), "{more}");
    let draco = |key: &'static str, value: Value| {
        message(&move |g| {
            g.primitive()["extensions"]["KHR_draco_mesh_compression"][key] = value.clone();
        })
    };
    assert_eq!(
        draco("bufferView", Value::Null),
        format!("{place}/bufferView: should be a small whole number")
    );
    assert!(draco("bufferView", json!(77)).contains("refers to buffer view 77, but there are"));
    assert_eq!(draco("attributes", json!(3)), format!("{place}/attributes: should be an object"));
    assert_eq!(
        draco("attributes", json!({"POSITION": 9})),
        format!("{place}/attributes/POSITION: the stream has no attribute 9")
    );
    assert_eq!(
        draco("attributes", json!({"POSITION": 2})),
        format!("{place}/attributes/POSITION: the stream has 2 numbers for each vertex")
    );
    assert_eq!(
        draco("attributes", json!({})),
        "scene.gltf: /meshes/0/primitives/0/attributes/POSITION: is not in the compressed data"
    );
    // An optional extension beside plain data: that is read.
    let mut g = Gltf::triangle();
    g.primitive()["extensions"] = json!({"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {}}});
    assert_eq!(g.scene().meshes[0].primitives[0].indices.len(), 3);
}

#[test]
fn a_strip_that_was_compressed_is_a_list() {
    let mut g = draco_scene(&draco_cases()[0]);
    g.primitive()["mode"] = json!(5);
    assert_eq!(g.scene().meshes[0].primitives[0].indices.len(), 66);
}

#[test]
fn truncated_draco_is_an_error() {
    for case in draco_cases() {
        let stream = unbase64(&case["stream"]);
        for n in 0..stream.len() {
            let mut g = draco_scene(&case);
            let view = g.primitive()["extensions"]["KHR_draco_mesh_compression"]["bufferView"].clone();
            g.doc["bufferViews"][view.as_u64().unwrap() as usize]["byteLength"] = json!(n);
            // The last bytes of a stream may mean nothing; of most nothing may be missing.
            assert!(g.load().is_err() || n + 8 > stream.len(), "{}: {n} bytes are enough", case["name"]);
        }
    }
}

/// The triangle of `Gltf::triangle`, its positions in a compressed view of the second buffer.
fn meshopt_scene(case: &Value, extension: &str) -> Gltf {
    let mut g = crate::common::meshopt_scene(case, &unbase64(&case["stream"]));
    let view = g.doc["bufferViews"].as_array_mut().unwrap().last_mut().unwrap();
    view["buffer"] = json!(1);
    let value = view["extensions"].as_object_mut().unwrap().remove("EXT_meshopt_compression").unwrap();
    view["extensions"][extension] = value;
    g.doc["accessors"][0]["bufferView"] = json!(VIEW);
    g
}

fn with_stand_in(g: &Gltf, uri: Option<&str>) -> Gltf {
    let uri0 = format!("data:;base64,{}", crate::common::base64(&g.bytes));
    let mut stand_in =
        json!({"byteLength": 1_000_000, "extensions": {"EXT_meshopt_compression": {"fallback": true}}});
    if let Some(uri) = uri {
        stand_in["uri"] = json!(uri);
    }
    let mut doc = g.doc.clone();
    doc["buffers"] = json!([{"byteLength": g.bytes.len(), "uri": uri0}, stand_in]);
    Gltf { doc, bytes: g.bytes.clone() }
}

fn meshopt_case(name: &str) -> Value {
    let cases: Vec<Value> = serde_json::from_str(include_str!("data/meshopt.json")).unwrap();
    cases.into_iter().find(|c| c["name"] == name).unwrap()
}

#[test]
fn compressed_views_are_read_and_their_stand_in_is_not() {
    for extension in ["EXT_meshopt_compression", "KHR_meshopt_compression"] {
        let case = meshopt_case("floats");
        let mut g = meshopt_scene(&case, extension);
        g.doc["extensionsRequired"] = json!([extension]);
        let want: Vec<f32> = unbase64(&case["decoded"])
            .chunks_exact(4)
            .map(|b| f32::from_le_bytes(b.try_into().unwrap()))
            .collect();
        // No uri; one that leads nowhere; one that must not be followed.
        for uri in [None, Some("nowhere.bin"), Some("../outside.bin")] {
            let scene = with_stand_in(&g, uri).scene();
            let p = &scene.meshes[0].primitives[0];
            let have: Vec<f32> = p.positions.iter().flat_map(|v| v.to_array()).collect();
            assert_eq!(have, want[..9], "{extension}");
        }
    }
}

#[test]
fn wrong_compressed_views_are_refused() {
    let message = |key: &str, value: Value| {
        let mut g = meshopt_scene(&meshopt_case("floats"), "EXT_meshopt_compression");
        g.doc["bufferViews"][VIEW]["extensions"]["EXT_meshopt_compression"][key] = value;
        with_stand_in(&g, None).error()
    };
    let place = "scene.gltf: /bufferViews/2/extensions/EXT_meshopt_compression";
    assert_eq!(
        message("mode", json!("x")),
        format!("{place}/mode: is none of ATTRIBUTES, TRIANGLES and INDICES")
    );
    assert_eq!(message("filter", json!("x")), format!("{place}/filter: is none of the extension's filters"));
    assert_eq!(message("buffer", json!(7)), format!("{place}/buffer: refers to buffer 7, but there are 2"));
    assert!(message("byteLength", json!(1_000_000)).starts_with(&format!("{place}: takes 1000000 bytes")));
    let many = message("count", json!(4_000_000_000u32));
    assert!(many.starts_with(&format!("{place}/count: 4000000000 elements cannot be held by")), "{many}");
    for (key, value) in [
        ("count", json!(100)),
        ("count", json!(80_000)),
        ("byteStride", json!(0)),
        ("byteStride", json!(10)),
        ("byteStride", json!(260)),
        ("byteLength", json!(0)),
        ("byteLength", json!(100)),
        ("mode", json!("TRIANGLES")),
        ("mode", json!("INDICES")),
        ("filter", json!("QUATERNION")),
    ] {
        let e = message(key, value.clone());
        assert!(e.starts_with(&format!("{place}: its stream is damaged: ")), "{key} {value}: {e}");
    }
    let mut g = meshopt_scene(&meshopt_case("indices of words"), "EXT_meshopt_compression");
    g.doc["bufferViews"][VIEW]["extensions"]["EXT_meshopt_compression"]["filter"] = json!("OCTAHEDRAL");
    assert_eq!(with_stand_in(&g, None).error(), format!("{place}/filter: is for attributes only"));
}

/// A triangle in world space, as it is compared.
struct Triangle {
    corners: [Vec3; 3],
    normals: Option<[Vec3; 3]>,
    uvs: Option<[Vec2; 3]>,
}

fn triangles(scene: &Scene) -> Vec<Triangle> {
    let mut out = Vec::new();
    for (id, world) in scene.world_nodes() {
        let Some(mesh) = scene.nodes[id.index()].mesh else { continue };
        let normal_matrix = Mat3::from_mat4(world).inverse().transpose();
        for p in &scene.meshes[mesh.index()].primitives {
            let of = |t: &[u32], p: &Primitive| Triangle {
                corners: [0, 1, 2].map(|k| world.transform_point3(p.positions[t[k] as usize])),
                normals: (!p.normals.is_empty())
                    .then(|| [0, 1, 2].map(|k| (normal_matrix * p.normals[t[k] as usize]).normalize())),
                uvs: (!p.uv0.is_empty()).then(|| [0, 1, 2].map(|k| p.uv0[t[k] as usize])),
            };
            out.extend(p.indices.chunks_exact(3).map(|t| of(t, p)));
        }
    }
    out
}

/// How far a compressed scene may be from its twin.
struct Tolerance {
    /// Of positions, metres.
    position: f32,
    /// Of unit normals, the length of their difference.
    normal: f32,
    /// Of texture coordinates; `None`: the compressed scene was stripped of them.
    uv: Option<f32>,
}

/// Checks that each triangle of `a` is one of `b`, corner by corner in the same winding.
fn each_is_in(a: &[Triangle], b: &[Triangle], tolerance: &Tolerance) -> usize {
    let cell = tolerance.position * 4.0;
    let key =
        |t: &Triangle| (t.corners.iter().sum::<Vec3>() / 3.0 / cell).to_array().map(|c| c.floor() as i64);
    let mut cells: HashMap<[i64; 3], Vec<&Triangle>> = HashMap::new();
    b.iter().for_each(|t| cells.entry(key(t)).or_default().push(t));
    let near = |t: &Triangle| {
        let k = key(t);
        (0..27).any(|i| {
            let k = [k[0] + i % 3 - 1, k[1] + i / 3 % 3 - 1, k[2] + i / 9 - 1];
            cells.get(&k).is_some_and(|list| list.iter().any(|other| equal(t, other, tolerance)))
        })
    };
    a.iter().filter(|t| !near(t)).count()
}

fn equal(a: &Triangle, b: &Triangle, tolerance: &Tolerance) -> bool {
    (0..3).any(|turn| {
        (0..3).all(|k| {
            let j = (k + turn) % 3;
            let close = |a: &Option<[Vec3; 3]>, b: &Option<[Vec3; 3]>| match (a, b) {
                (Some(a), Some(b)) => (a[k] - b[j]).length() <= tolerance.normal,
                (None, None) => true,
                _ => false,
            };
            let uvs = match (&a.uvs, &b.uvs, tolerance.uv) {
                (Some(a), Some(b), Some(uv)) => (a[k] - b[j]).length() <= uv,
                (None, None, _) | (_, _, None) => true,
                _ => false,
            };
            (a.corners[k] - b.corners[j]).length() <= tolerance.position
                && close(&a.normals, &b.normals)
                && uvs
        })
    })
}

fn twins(folder: &Path, compressed: &str, plain: &str, tolerance: &Tolerance) {
    let load = |name: &str| triangles(&load_scene(folder.join(name), &LoadOptions::default()).unwrap().scene);
    let (a, b) = (load(compressed), load(plain));
    assert_eq!(a.len(), b.len(), "{compressed}");
    let missing = (each_is_in(&a, &b, tolerance), each_is_in(&b, &a, tolerance));
    println!("{compressed}: {} triangles, {missing:?} without a twin", a.len());
    assert_eq!(missing, (0, 0), "{compressed}");
    // The comparison can fail: where positions were rounded, a hundredth of the tolerance is too little.
    let strict = Tolerance { position: tolerance.position * 0.01, ..*tolerance };
    if tolerance.position > 1e-5 {
        assert!(each_is_in(&a, &b, &strict) > 0, "{compressed}: positions are closer than they should be");
    }
}

#[test]
fn compressed_scenes_are_their_twins() {
    let Some(folder) = scenes_folder() else { return };
    let samples = "gltf-sample-assets";
    twins(
        &folder,
        &format!("{samples}/Box/glTF-Draco/Box.gltf"),
        &format!("{samples}/Box/glTF/Box.gltf"),
        &Tolerance { position: 1e-6, normal: 0.01, uv: Some(0.0) },
    );
    twins(
        &folder,
        &format!("{samples}/RiggedSimple/glTF-Draco/RiggedSimple.gltf"),
        &format!("{samples}/RiggedSimple/glTF-Binary/RiggedSimple.glb"),
        // 11 bits for 9.15 m: half a step on each axis.
        &Tolerance { position: 3.9e-3, normal: 0.01, uv: Some(0.0) },
    );
    twins(
        &folder,
        "derived/Suzanne-meshopt.glb",
        &format!("{samples}/Suzanne/glTF/Suzanne.gltf"),
        &Tolerance { position: 2e-4, normal: 0.03, uv: None },
    );
}

#[test]
fn sponza_of_draco_and_webp() {
    let Some(folder) = scenes_folder() else { return };
    let load = |name: &str| load_scene(folder.join(name), &LoadOptions::default()).unwrap();
    let (small, plain) = (load("sponza/glTF-Draco-WebP/Sponza.glb"), load("sponza/glTF/Sponza.gltf"));
    assert_eq!(small.warnings, Vec::<String>::new());
    let (a, b) = (triangles(&small.scene), triangles(&plain.scene));
    assert_eq!(a.len(), b.len());
    // The plain one was decoded from this one, so that they are the same.
    let tolerance = Tolerance { position: 1e-4, normal: 1e-3, uv: Some(1e-5) };
    assert_eq!((each_is_in(&a, &b, &tolerance), each_is_in(&b, &a, &tolerance)), (0, 0));
    // Textures hang where they hung: the mean colour of each material's base texture is that of the other scene.
    let mean = |scene: &Scene, material: usize| {
        let texture = scene.materials[material].base_color_texture.as_ref()?.texture;
        let image = &scene.images[scene.textures[texture.index()].image.index()];
        // Of what is seen: under alpha 0, encoders leave any colour.
        let seen = || image.rgba8.chunks_exact(4).filter(|t| t[3] >= 128);
        let sum = seen().fold(Vec3::ZERO, |s, t| s + Vec3::new(t[0].into(), t[1].into(), t[2].into()));
        Some(sum / seen().count() as f32)
    };
    let mut compared = 0;
    for material in 0..plain.scene.materials.len() {
        let (Some(a), Some(b)) = (mean(&plain.scene, material), mean(&small.scene, material)) else {
            continue;
        };
        assert!((a - b).abs().max_element() < 4.0, "material {material}: {a} and {b}");
        compared += 1;
    }
    assert!(compared > 20, "{compared}");
}
