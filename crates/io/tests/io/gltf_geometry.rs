//! Geometry, nodes, cameras and lights of glTF: one tiny scene for each feature.

use crate::common::Gltf;
use glam::{Mat4, Quat, Vec2, Vec3, Vec4};
use lumbre_core::Rgb;
use lumbre_io::{LoadOptions, load_scene};
use lumbre_scene::{CameraId, LightId, LightKind, MeshId, NodeId, Primitive, Projection};
use serde_json::json;

fn primitive(g: &Gltf) -> Primitive {
    g.scene().meshes[0].primitives[0].clone()
}

#[test]
fn an_indexed_triangle() {
    let p = primitive(&Gltf::triangle());
    assert_eq!(p.positions, [Vec3::ZERO, Vec3::X, Vec3::Y]);
    assert_eq!(p.indices, [0, 1, 2]);
    assert!(p.normals.is_empty() && p.uv0.is_empty() && p.material.is_none());
}

#[test]
fn a_plain_triangle_and_a_glb() {
    let mut g = Gltf::triangle();
    g.primitive().as_object_mut().unwrap().remove("indices");
    assert_eq!(primitive(&g).indices, [0, 1, 2]);
    let folder = tempfile::tempdir().unwrap();
    // The magic decides, not the name.
    for name in ["scene.glb", "scene.bin"] {
        let path = folder.path().join(name);
        std::fs::write(&path, g.glb()).unwrap();
        let loaded = load_scene(&path, &LoadOptions::default()).unwrap();
        assert_eq!(loaded.scene.meshes[0].primitives[0].positions.len(), 3);
        assert_eq!(loaded.scene.name, name);
    }
}

#[test]
fn all_widths_of_indices() {
    for (component, bytes) in [
        (5121, vec![2u8, 0, 1]),
        (5123, vec![2, 0, 0, 0, 1, 0]),
        (5125, vec![2, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0]),
    ] {
        let mut g = Gltf::triangle();
        let index = g.raw(component, "SCALAR", 3, &bytes);
        g.primitive()["indices"] = json!(index);
        assert_eq!(primitive(&g).indices, [2, 0, 1]);
    }
}

#[test]
fn strips_fans_points_and_lines() {
    let square = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0];
    let with_mode = |mode: u32| {
        let mut g = Gltf::triangle();
        let position = g.f32s("VEC3", &square);
        *g.primitive() = json!({"attributes": {"POSITION": position}, "mode": mode});
        g
    };
    assert_eq!(primitive(&with_mode(5)).indices, [0, 1, 2, 1, 3, 2]);
    assert_eq!(primitive(&with_mode(6)).indices, [1, 2, 0, 2, 3, 0]);
    for mode in 0..4 {
        let loaded = with_mode(mode).load().unwrap();
        assert!(loaded.scene.meshes[0].primitives.is_empty());
        assert_eq!(
            loaded.warnings,
            ["/meshes/0/primitives/0: points and lines are not supported and are skipped"]
        );
    }
    assert_eq!(with_mode(7).error(), "scene.gltf: /meshes/0/primitives/0/mode: is none of glTF's modes");
}

#[test]
fn all_attributes() {
    let mut g = Gltf::triangle();
    let normal = g.f32s("VEC3", &[0.0, 0.0, 2.0, 0.0, 0.0, 1.0, 0.0, 3.0, 4.0]);
    let tangent = g.f32s("VEC4", &[1.0, 0.0, 0.0, 1.0, 2.0, 0.0, 0.0, -1.0, 1.0, 0.0, 0.0, 1.0]);
    let uv0 = g.f32s("VEC2", &[0.0, 0.25, 0.5, 0.75, 1.0, 2.0]);
    let uv1 = g.raw(5123, "VEC2", 3, &[0, 0, 255, 255, 0xff, 0x7f, 0, 0, 255, 255, 255, 255]);
    g.doc["accessors"][uv1]["normalized"] = json!(true);
    let color = g.raw(5121, "VEC4", 3, &[255, 0, 51, 255, 0, 0, 0, 0, 255, 255, 255, 102]);
    g.doc["accessors"][color]["normalized"] = json!(true);
    let attributes = &mut g.primitive()["attributes"];
    attributes["NORMAL"] = json!(normal);
    attributes["TANGENT"] = json!(tangent);
    attributes["TEXCOORD_0"] = json!(uv0);
    attributes["TEXCOORD_1"] = json!(uv1);
    attributes["COLOR_0"] = json!(color);
    attributes["_CUSTOM"] = json!(uv0);
    let p = primitive(&g);
    assert_eq!(p.normals, [Vec3::Z, Vec3::Z, Vec3::new(0.0, 0.6, 0.8)]);
    assert_eq!(p.tangents[1], Vec4::new(1.0, 0.0, 0.0, -1.0));
    assert_eq!(p.uv0, [Vec2::new(0.0, 0.25), Vec2::new(0.5, 0.75), Vec2::new(1.0, 2.0)]);
    assert_eq!(p.uv1, [Vec2::new(0.0, 1.0), Vec2::new(32767.0 / 65535.0, 0.0), Vec2::ONE]);
    assert_eq!(p.colors[0], Vec4::new(1.0, 0.0, 0.2, 1.0));
    assert_eq!(p.colors[2], Vec4::new(1.0, 1.0, 1.0, 0.4));
}

#[test]
fn colours_without_alpha_are_opaque() {
    let mut g = Gltf::triangle();
    let color = g.f32s("VEC3", &[0.5, 0.25, 0.125, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0]);
    g.primitive()["attributes"]["COLOR_0"] = json!(color);
    assert_eq!(primitive(&g).colors[0], Vec4::new(0.5, 0.25, 0.125, 1.0));
}

#[test]
fn quantised_positions() {
    let mut g = Gltf::triangle();
    let bytes: Vec<u8> = [-32768i16, 32767, 0, 0, 16384, -100].iter().flat_map(|v| v.to_le_bytes()).collect();
    let position = g.raw(5122, "VEC3", 2, &bytes);
    g.doc["accessors"][position]["normalized"] = json!(true);
    let plain = g.raw(5120, "VEC3", 3, &[1, 2, 0xff, 0, 0, 0, 0x80, 0x7f, 3]);
    g.primitive()["attributes"]["POSITION"] = json!(plain);
    g.doc["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    assert_eq!(primitive(&g).positions[0], Vec3::new(1.0, 2.0, -1.0));
    assert_eq!(primitive(&g).positions[2], Vec3::new(-128.0, 127.0, 3.0));
    *g.primitive() = json!({"attributes": {"POSITION": position}, "mode": 5, "indices": 1});
    let index = g.u16s(&[0, 1, 0]);
    g.primitive()["indices"] = json!(index);
    let p = primitive(&g);
    assert_eq!(p.positions[0], Vec3::new(-1.0, 1.0, 0.0));
}

#[test]
fn interleaved_and_padded_views() {
    let mut g = Gltf::triangle();
    // Position and uv side by side, 24 bytes apart, after 8 bytes of something else.
    let mut bytes = vec![0u8; 8];
    for i in 0..3 {
        let f = i as f32;
        for v in [f, f + 0.5, -f, 10.0 + f, 20.0 + f, f32::NAN] {
            bytes.extend(v.to_le_bytes());
        }
    }
    let position = g.raw(5126, "VEC3", 3, &bytes);
    g.doc["accessors"][position]["byteOffset"] = json!(8);
    let view = g.doc["accessors"][position]["bufferView"].as_u64().unwrap() as usize;
    g.doc["bufferViews"][view]["byteStride"] = json!(24);
    // The last element may end with the view, though a whole stride would not fit.
    g.doc["bufferViews"][view]["byteLength"] = json!(bytes.len() - 4);
    g.doc["accessors"].as_array_mut().unwrap().push(json!({
        "bufferView": view, "byteOffset": 20, "componentType": 5126, "count": 3, "type": "VEC2"
    }));
    let uv = g.doc["accessors"].as_array().unwrap().len() - 1;
    g.primitive()["attributes"] = json!({"POSITION": position, "TEXCOORD_0": uv});
    let p = primitive(&g);
    assert_eq!(p.positions[2], Vec3::new(2.0, 2.5, -2.0));
    assert_eq!(p.uv0[1], Vec2::new(11.0, 21.0));
}

#[test]
fn sparse_accessors() {
    let mut g = Gltf::triangle();
    let at = g.u16s(&[1]);
    let with = g.f32s("VEC3", &[7.0, 8.0, 9.0]);
    let view = |g: &Gltf, a: usize| g.doc["accessors"][a]["bufferView"].clone();
    let sparse = json!({
        "count": 1,
        "indices": {"bufferView": view(&g, at), "componentType": 5123},
        "values": {"bufferView": view(&g, with)}
    });
    g.doc["accessors"][0]["sparse"] = sparse;
    assert_eq!(primitive(&g).positions, [Vec3::ZERO, Vec3::new(7.0, 8.0, 9.0), Vec3::Y]);
    // Without a view of its own all other elements are zero.
    g.doc["accessors"][0].as_object_mut().unwrap().remove("bufferView");
    assert_eq!(primitive(&g).positions, [Vec3::ZERO, Vec3::new(7.0, 8.0, 9.0), Vec3::ZERO]);
}

#[test]
fn vertices_that_a_primitive_does_not_use_are_left_out() {
    let mut g = Gltf::triangle();
    let many: Vec<f32> = (0..300).map(|v| v as f32).collect();
    let position = g.f32s("VEC3", &many);
    let index = g.u16s(&[99, 5, 99, 50, 5, 99]);
    *g.primitive() = json!({"attributes": {"POSITION": position}, "indices": index});
    let p = primitive(&g);
    assert_eq!(p.indices, [0, 1, 0, 2, 1, 0]);
    assert_eq!(p.positions, [297.0, 15.0, 150.0].map(|v| Vec3::new(v, v + 1.0, v + 2.0)));
}

#[test]
fn nodes_share_meshes_and_carry_transforms() {
    let mut g = Gltf::triangle();
    g.doc["nodes"] = json!([
        {"name": "parent ñ", "children": [1, 2], "translation": [1, 2, 3]},
        {"mesh": 0, "matrix": [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1]},
        {"mesh": 0, "translation": [1, 0, 0], "rotation": [0, 5, 0, 5], "scale": [2, -3, 4]}
    ]);
    let scene = g.scene();
    assert_eq!(scene.roots, [NodeId(0)]);
    assert_eq!(scene.nodes[0].name, "parent ñ");
    assert_eq!((scene.nodes[1].mesh, scene.nodes[2].mesh), (Some(MeshId(0)), Some(MeshId(0))));
    assert_eq!(scene.meshes.len(), 1);
    // Columns come first: the x axis goes to +y.
    assert_eq!(scene.nodes[1].transform.transform_point3(Vec3::X), Vec3::new(5.0, 7.0, 7.0));
    let want = Mat4::from_translation(Vec3::X)
        * Mat4::from_quat(Quat::from_rotation_y(std::f32::consts::FRAC_PI_2))
        * Mat4::from_scale(Vec3::new(2.0, -3.0, 4.0));
    assert!(scene.nodes[2].transform.abs_diff_eq(want, 1e-6));
    let world = scene.world_nodes();
    assert_eq!(world.len(), 3);
    assert_eq!(world[1].1.transform_point3(Vec3::ZERO), Vec3::new(6.0, 8.0, 10.0));
}

#[test]
fn the_default_scene_or_the_first_or_all_roots() {
    let mut g = Gltf::triangle();
    g.doc["nodes"] = json!([{"mesh": 0}, {"mesh": 0}, {"mesh": 0, "children": [1]}]);
    g.doc["scenes"] = json!([{"nodes": [0]}, {"nodes": [2, 2]}]);
    g.doc["scene"] = json!(1);
    assert_eq!(g.scene().roots, [NodeId(2)]);
    g.doc.as_object_mut().unwrap().remove("scene");
    assert_eq!(g.scene().roots, [NodeId(0)]);
    g.doc.as_object_mut().unwrap().remove("scenes");
    assert_eq!(g.scene().roots, [NodeId(0), NodeId(2)]);
}

#[test]
fn cameras() {
    let mut g = Gltf::triangle();
    g.doc["cameras"] = json!([
        {"type": "orthographic", "orthographic": {"xmag": 2, "ymag": 1.5, "zfar": 9, "znear": 0}},
        {"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1, "aspectRatio": 1.5}},
        {"type": "perspective", "name": "own", "perspective": {"yfov": 1.0, "znear": 0.1}}
    ]);
    g.doc["nodes"] =
        json!([{"camera": 0}, {"camera": 1, "name": "from the node"}, {"camera": 2, "name": "x"}]);
    g.doc["scenes"] = json!([{"nodes": [0, 1, 2]}]);
    let loaded = g.load().unwrap();
    assert_eq!(loaded.warnings, Vec::<String>::new());
    let scene = loaded.scene;
    let held: Vec<_> = scene.nodes.iter().map(|n| n.camera).collect();
    assert_eq!(held, [0, 1, 2].map(|i| Some(CameraId(i))));
    assert_eq!(scene.cameras[0].projection, Projection::Orthographic { xmag: 2.0, ymag: 1.5 });
    assert_eq!(scene.cameras[1].projection, Projection::Perspective { yfov: 0.5, aspect: Some(1.5) });
    assert_eq!(scene.cameras[2].projection, Projection::Perspective { yfov: 1.0, aspect: None });
    let names: Vec<_> = scene.cameras.iter().map(|c| c.name.as_str()).collect();
    assert_eq!(names, ["", "from the node", "own"]);
    g.doc["cameras"][0]["orthographic"]["xmag"] = json!(-2);
    let mirrored = g.load().unwrap();
    assert_eq!(mirrored.scene.cameras[0].projection, Projection::Orthographic { xmag: 2.0, ymag: 1.5 });
    assert_eq!(mirrored.warnings.len(), 1);
    g.doc["cameras"][0]["orthographic"]["ymag"] = json!(0);
    assert_eq!(g.error(), "scene.gltf: /cameras/0/orthographic: xmag -2 and ymag 0 make no picture");
    g.doc["cameras"][0] = json!({"type": "orthographic"});
    assert!(g.error().starts_with("scene.gltf: /cameras/0: is neither"));
    g.doc["cameras"][0] =
        json!({"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "zfar": 9, "znear": 0}});
    g.doc["cameras"][1]["perspective"]["yfov"] = json!(4.0);
    assert!(g.error().starts_with("scene.gltf: /cameras/1/perspective: yfov 4"));
}

#[test]
fn punctual_lights() {
    let mut g = Gltf::triangle();
    g.doc["extensionsUsed"] = json!(["KHR_lights_punctual"]);
    g.doc["extensions"] = json!({"KHR_lights_punctual": {"lights": [
        {"type": "point", "name": "p", "color": [1, 0.5, 0], "intensity": 20, "range": 5},
        {"type": "spot", "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.4}},
        {"type": "spot", "spot": {}},
        {"type": "directional", "intensity": 3}
    ]}});
    g.doc["nodes"] = json!([{"extensions": {"KHR_lights_punctual": {"light": 3}}, "mesh": 0}]);
    let scene = g.scene();
    assert_eq!(scene.nodes[0].light, Some(LightId(3)));
    assert_eq!((scene.lights[0].kind, scene.lights[0].name.as_str()), (LightKind::Point, "p"));
    assert_eq!(scene.lights[0].intensity, Rgb::new(20.0, 10.0, 0.0));
    assert_eq!(scene.lights[1].kind, LightKind::Spot { inner_angle: 0.1, outer_angle: 0.4 });
    assert_eq!(scene.lights[1].intensity, Rgb::WHITE);
    let outer_angle = std::f32::consts::FRAC_PI_4;
    assert_eq!(scene.lights[2].kind, LightKind::Spot { inner_angle: 0.0, outer_angle });
    assert_eq!((scene.lights[3].kind, scene.lights[3].intensity), (LightKind::Directional, Rgb::splat(3.0)));
    g.doc["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = json!(4);
    assert_eq!(g.error(), "scene.gltf: /nodes/0: refers to light 4, but there are 4");
    g.doc["extensions"]["KHR_lights_punctual"]["lights"][0]["type"] = json!("laser");
    assert!(g.error().ends_with("lights of type \"laser\""));
}

#[test]
fn motion_is_warned_of() {
    let mut g = Gltf::triangle();
    g.doc["skins"] = json!([{"joints": [0]}, {"joints": [0]}]);
    g.doc["animations"] = json!([{"channels": [], "samplers": []}]);
    let warnings = g.load().unwrap().warnings;
    let want =
        ["animations", "skins"].map(|w| format!("/{w}: {w} are not supported; the rest pose is shown"));
    assert_eq!(warnings, want);
}
