//! Morph targets in the shape that they have at rest.

use crate::common::Gltf;
use glam::{Vec3, Vec4};
use lumbre_io::{Limits, LoadOptions, load_scene};
use lumbre_scene::MeshId;
use serde_json::json;

/// The triangle with two targets: one lifts all corners by z and leans the normals, the other moves the last one by x.
fn morphed() -> Gltf {
    let mut g = Gltf::triangle();
    let normal = g.f32s("VEC3", &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0]);
    let tangent = g.f32s("VEC4", &[1.0, 0.0, 0.0, -1.0, 1.0, 0.0, 0.0, -1.0, 1.0, 0.0, 0.0, -1.0]);
    let lift = g.f32s("VEC3", &[0.0, 0.0, 1.0, 0.0, 0.0, 2.0, 0.0, 0.0, 4.0]);
    let lean = g.f32s("VEC3", &[3.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let turn = g.f32s("VEC3", &[0.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0]);
    let stretch = g.f32s("VEC3", &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 8.0, 0.0, 0.0]);
    g.primitive()["attributes"]["NORMAL"] = json!(normal);
    g.primitive()["attributes"]["TANGENT"] = json!(tangent);
    g.primitive()["targets"] =
        json!([{"POSITION": lift, "NORMAL": lean, "TANGENT": turn}, {"POSITION": stretch}]);
    g
}

const PLAIN: [Vec3; 3] = [Vec3::ZERO, Vec3::X, Vec3::Y];
const HALF_LIFTED: [Vec3; 3] = [Vec3::new(0.0, 0.0, 0.5), Vec3::new(1.0, 0.0, 1.0), Vec3::new(0.0, 1.0, 2.0)];

#[test]
fn weights_of_the_mesh_move_positions_normals_and_tangents() {
    let mut g = morphed();
    let p = |g: &Gltf| g.scene().meshes[0].primitives[0].clone();
    assert_eq!(p(&g).positions, PLAIN);
    g.doc["meshes"][0]["weights"] = json!([0.5]);
    let half = p(&g);
    assert_eq!(half.positions, HALF_LIFTED);
    assert!(half.normals[0].abs_diff_eq(Vec3::new(1.5, 0.0, 1.0).normalize(), 1e-6));
    assert_eq!(half.normals[1], Vec3::Z);
    let turned = std::f32::consts::FRAC_1_SQRT_2;
    assert!(half.tangents[1].abs_diff_eq(Vec4::new(turned, turned, 0.0, -1.0), 1e-6));
    g.doc["meshes"][0]["weights"] = json!([0.5, -0.25]);
    assert_eq!(p(&g).positions[2], HALF_LIFTED[2] - 2.0 * Vec3::X);
    assert!(g.load().unwrap().warnings.is_empty());
}

#[test]
fn only_the_vertices_in_use_are_moved() {
    let mut g = Gltf::triangle();
    let counted =
        |step: f32| [0.0, 1.0, 2.0, 3.0].map(|i| i * step).into_iter().flat_map(|v| [v; 3]).collect();
    let (base, target): (Vec<f32>, Vec<f32>) = (counted(1.0), counted(10.0));
    let (base, target, index) = (g.f32s("VEC3", &base), g.f32s("VEC3", &target), g.u16s(&[3, 3, 1]));
    *g.primitive() =
        json!({"attributes": {"POSITION": base}, "indices": index, "targets": [{"POSITION": target}]});
    g.doc["meshes"][0]["weights"] = json!([2]);
    let p = g.scene().meshes[0].primitives[0].clone();
    assert_eq!((p.positions, p.indices), (vec![Vec3::splat(63.0), Vec3::splat(21.0)], vec![0, 0, 1]));
}

#[test]
fn nodes_may_morph_one_mesh_in_their_own_ways() {
    let mut g = morphed();
    g.doc["meshes"][0]["weights"] = json!([0.5, 0.0]);
    g.doc["nodes"] = json!([
        {"mesh": 0, "weights": [0, 0]}, {"mesh": 0}, {"mesh": 0, "weights": [0.0, 0.0]}, {"mesh": 0, "weights": [0.5, 0.0]}
    ]);
    let scene = g.scene();
    let shown: Vec<_> = scene.nodes.iter().map(|n| n.mesh.unwrap()).collect();
    assert_eq!(shown, [0, 1, 0, 1].map(MeshId));
    let positions = |m: usize| scene.meshes[m].primitives[0].positions.clone();
    assert_eq!((scene.meshes.len(), positions(0), positions(1)), (2, PLAIN.to_vec(), HALF_LIFTED.to_vec()));
}

#[test]
fn sparse_targets_without_a_view() {
    let mut g = morphed();
    let (at, with) = (g.u16s(&[1]), g.f32s("VEC3", &[7.0, 8.0, 9.0]));
    let view = |a: usize| g.doc["accessors"][a]["bufferView"].clone();
    let sparse = json!({"count": 1, "indices": {"bufferView": view(at), "componentType": 5123},
        "values": {"bufferView": view(with)}});
    g.doc["accessors"]
        .as_array_mut()
        .unwrap()
        .push(json!({"componentType": 5126, "count": 3, "type": "VEC3", "sparse": sparse}));
    let target = g.doc["accessors"].as_array().unwrap().len() - 1;
    g.primitive()["targets"] = json!([{"POSITION": target}]);
    g.doc["meshes"][0]["weights"] = json!([2.0]);
    let positions = g.scene().meshes[0].primitives[0].positions.clone();
    assert_eq!(positions, [Vec3::ZERO, Vec3::new(15.0, 16.0, 18.0), Vec3::Y]);
}

#[test]
fn wrong_targets_are_errors_where_they_count() {
    let mut g = morphed();
    let short = g.f32s("VEC3", &[0.0; 6]);
    g.primitive()["targets"] = json!([{"POSITION": short}, {"NORMAL": 99}]);
    assert!(g.load().is_ok());
    g.doc["meshes"][0]["weights"] = json!([1, 0]);
    let place = "scene.gltf: /meshes/0/primitives/0";
    assert_eq!(g.error(), format!("{place}/targets/0/POSITION: has 2 elements, but POSITION has 3"));
    g.doc["meshes"][0]["weights"] = json!([0, 1]);
    let count = g.doc["accessors"].as_array().unwrap().len();
    let why = format!("refers to accessor 99, but there are {count}");
    assert_eq!(g.error(), format!("{place}/targets/1/NORMAL: {why}"));
    let mut far = morphed();
    far.doc["meshes"][0]["weights"] = json!([3e38, 0]);
    assert_eq!(far.error(), format!("{place}: its morph targets lead to no positions"));
}

#[test]
fn targets_count_as_vertices() {
    let mut g = morphed();
    // A short list of targets may ask for much work.
    g.primitive()["targets"] = json!(vec![json!({"POSITION": 0}); 1000]);
    g.doc["meshes"][0]["weights"] = json!(vec![1.0; 1000]);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.gltf");
    std::fs::write(&path, g.text()).unwrap();
    let load = |max_vertices| {
        let limits = Limits { max_vertices, ..Limits::default() };
        load_scene(&path, &LoadOptions { limits, ..LoadOptions::default() })
    };
    assert!(load(3003).is_ok());
    let message = load(3002).unwrap_err().to_string();
    assert!(message.ends_with("number of vertices 3003 exceeds the limit of 3002"), "{message}");
}

/// Many nodes may share a mesh with a long list of weights: it is looked at once, and no further than there are targets.
#[test]
fn a_long_list_of_weights_is_read_once() {
    let start = std::time::Instant::now();
    let mut g = morphed();
    g.doc["meshes"][0]["weights"] = json!(vec![0.5; 150_000]);
    let n = 20_000;
    g.doc["nodes"] = json!(vec![json!({"mesh": 0}); n]);
    g.doc["scenes"] = json!([{"nodes": (0..n).collect::<Vec<_>>()}]);
    let scene = g.scene();
    assert_eq!((scene.meshes.len(), scene.roots.len()), (1, n));
    assert!(start.elapsed() < std::time::Duration::from_secs(5), "{:?}", start.elapsed());
}
