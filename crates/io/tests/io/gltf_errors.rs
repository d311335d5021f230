//! Wrong and hostile glTFs: each ends in one line that names the file, the place and the reason.

use crate::common::{Gltf, png};
use lumbre_io::{ErrorKind, Limits, LoadOptions, SCENE_FORMATS, load_scene};
use serde_json::{Value, json};
use std::path::Path;

/// Changes the value at a JSON pointer of the triangle; returns the message.
fn broken(pointer: &str, value: Value) -> String {
    let mut g = Gltf::triangle();
    let (parent, key) = pointer.rsplit_once('/').unwrap();
    let parent = g.doc.pointer_mut(parent).unwrap();
    match parent {
        Value::Array(list) => list[key.parse::<usize>().unwrap()] = value,
        object => object[key] = value,
    }
    g.error()
}

#[test]
fn indices_out_of_range() {
    for (pointer, value, message) in [
        ("/scene", json!(1), "/scene: refers to scene 1, but there are 1"),
        ("/scenes/0/nodes", json!([9]), "/scenes/0/nodes: refers to node 9, but there are 1"),
        ("/nodes/0/mesh", json!(1), "/nodes/0/mesh: refers to mesh 1, but there are 1"),
        ("/nodes/0/camera", json!(0), "/nodes/0/camera: refers to camera 0, but there are 0"),
        ("/nodes/0/children", json!([7]), "/nodes/0/children: refers to node 7, but there are 1"),
        (
            "/meshes/0/primitives/0/indices",
            json!(5),
            "/meshes/0/primitives/0: refers to accessor 5, but there are 2",
        ),
        (
            "/meshes/0/primitives/0/attributes/POSITION",
            json!(4_294_967_295u32),
            "/meshes/0/primitives/0: refers to accessor 4294967295, but there are 2",
        ),
        (
            "/meshes/0/primitives/0/attributes/NORMAL",
            json!(3),
            "/meshes/0/primitives/0/attributes: refers to accessor 3, but there are 2",
        ),
        (
            "/meshes/0/primitives/0/material",
            json!(0),
            "/meshes/0/primitives/0/material: refers to material 0, but there are 0",
        ),
        (
            "/accessors/0/bufferView",
            json!(2),
            "/accessors/0/bufferView: refers to buffer view 2, but there are 2",
        ),
        ("/bufferViews/0/buffer", json!(1), "/bufferViews/0: refers to buffer 1, but there are 1"),
    ] {
        assert_eq!(broken(pointer, value), format!("scene.gltf: {message}"));
    }
}

#[test]
fn accessors_that_their_bytes_do_not_bear_out() {
    let huge = u64::MAX;
    for (pointer, value, message) in [
        ("/accessors/0/count", json!(4), "attributes/POSITION"),
        (
            "/accessors/0/byteOffset",
            json!(4),
            "/accessors/0: 3 elements of 12 bytes, 12 bytes apart from byte 4",
        ),
        ("/accessors/0/byteOffset", json!(huge), "/accessors/0: 3 elements"),
        ("/accessors/1/count", json!(huge), "/meshes/0/primitives/0: number of triangles"),
        (
            "/accessors/1/count",
            json!(400),
            "/accessors/1: 400 elements of 2 bytes, 2 bytes apart from byte 0",
        ),
        (
            "/accessors/0/componentType",
            json!(5124),
            "/accessors/0/componentType: is none of glTF's component types",
        ),
        ("/accessors/0/type", json!("VEC2"), "/accessors/0/type: has a type that does not fit its use"),
        ("/accessors/0/type", json!("MAT4"), "/accessors/0/type: has a type that does not fit its use"),
        ("/accessors/1/componentType", json!(5126), "/accessors/1/componentType: indices must be unsigned"),
        (
            "/bufferViews/0/byteLength",
            json!(huge),
            "/bufferViews/0: takes 18446744073709551615 bytes from byte 0",
        ),
        (
            "/bufferViews/0/byteOffset",
            json!(huge),
            "/bufferViews/0: takes 36 bytes from byte 18446744073709551615",
        ),
        ("/bufferViews/0/byteLength", json!(35), "/accessors/0: 3 elements of 12 bytes"),
        ("/bufferViews/0/byteStride", json!(8), "/accessors/0: elements of 12 bytes lie 8 bytes apart"),
        ("/bufferViews/0/byteStride", json!(huge), "/accessors/0: 3 elements of 12 bytes"),
    ] {
        let message = if pointer == "/accessors/0/count" {
            // All three vertices are used, so that the count matters.
            "/accessors/0: 4 elements of 12 bytes"
        } else {
            message
        };
        let said = broken(pointer, value);
        assert!(said.starts_with(&format!("scene.gltf: {message}")), "{pointer}: {said}");
    }
}

#[test]
fn unbacked_counts_take_no_memory() {
    let mut g = Gltf::triangle();
    g.doc["accessors"][0] = json!({"componentType": 5126, "type": "VEC3", "count": 400_000_000u64});
    g.primitive().as_object_mut().unwrap().remove("indices");
    assert_eq!(
        g.error(),
        "scene.gltf: /accessors/0/count: number of elements without data 400000000 exceeds the limit of 1048576"
    );
}

#[test]
fn vertices_and_attributes_must_agree() {
    let mut g = Gltf::triangle();
    let normal = g.f32s("VEC3", &[0.0; 6]);
    g.primitive()["attributes"]["NORMAL"] = json!(normal);
    assert_eq!(
        g.error(),
        "scene.gltf: /meshes/0/primitives/0/attributes/NORMAL: has 2 elements, but POSITION has 3"
    );
    let mut g = Gltf::triangle();
    let index = g.u16s(&[0, 1, 3]);
    g.primitive()["indices"] = json!(index);
    assert_eq!(g.error(), "scene.gltf: /accessors/2: element 2 is 3, but there are 3 vertices");
    let mut g = Gltf::triangle();
    g.bytes[16..20].copy_from_slice(&f32::NAN.to_le_bytes());
    assert!(g.error().starts_with("scene.gltf: /accessors/0: element 1 is"));
}

#[test]
fn sparse_parts_are_checked() {
    let sparse = |count: Value, index: u16| {
        let mut g = Gltf::triangle();
        let at = g.u16s(&[index]);
        let with = g.f32s("VEC3", &[7.0, 8.0, 9.0]);
        let view = |a: usize| g.doc["accessors"][a]["bufferView"].clone();
        let (at, with) = (view(at), view(with));
        g.doc["accessors"][0]["sparse"] = json!({
            "count": count,
            "indices": {"bufferView": at, "componentType": 5123},
            "values": {"bufferView": with}
        });
        g
    };
    assert!(sparse(json!(1), 2).load().is_ok());
    let message = sparse(json!(1), 3).error();
    assert_eq!(message, "scene.gltf: /accessors/0/sparse/indices: index 3, but there are 3 elements");
    assert!(sparse(json!(2), 0).error().starts_with("scene.gltf: /accessors/0/sparse/indices: 2 elements"));
    assert!(
        sparse(json!(u64::MAX), 0).error().starts_with("scene.gltf: /accessors/0/sparse/count: replaces")
    );
}

#[test]
fn nodes_must_form_trees() {
    let nodes = |nodes: Value| {
        let mut g = Gltf::triangle();
        g.doc["nodes"] = nodes;
        g.error()
    };
    let own = nodes(json!([{"children": [0]}]));
    assert_eq!(own, "scene.gltf: /nodes/0: is its own ancestor; nodes must form trees");
    let ring = nodes(json!([{"mesh": 0}, {"children": [2]}, {"children": [3]}, {"children": [1]}]));
    assert_eq!(ring, "scene.gltf: /nodes/1: is its own ancestor; nodes must form trees");
    let two = nodes(json!([{"children": [2]}, {"children": [2]}, {}]));
    assert_eq!(two, "scene.gltf: /nodes/2: has two parents, nodes 0 and 1; nodes must form trees");
    let twice = nodes(json!([{"children": [1, 1]}, {}]));
    assert_eq!(twice, "scene.gltf: /nodes/1: has two parents, nodes 0 and 0; nodes must form trees");
    let wide = nodes(json!([{"translation": [1e60, 0, 0]}]));
    assert_eq!(wide, "scene.gltf: /nodes/0: its transform is not finite");
}

#[test]
fn a_long_chain_of_nodes_is_no_trouble() {
    let mut g = Gltf::triangle();
    let count = 200_000;
    let chain: Vec<Value> = (0..count)
        .map(|i| if i + 1 < count { json!({"children": [i + 1]}) } else { json!({"mesh": 0}) })
        .collect();
    g.doc["nodes"] = json!(chain);
    assert_eq!(g.scene().world_nodes().len(), count);
}

#[test]
fn buffers_and_images() {
    let mut g = Gltf::triangle();
    g.doc["buffers"] = json!([{"byteLength": 40}]);
    assert_eq!(g.error(), "scene.gltf: /buffers/0: has neither a uri nor a binary chunk to hold its bytes");
    g.doc["buffers"] = json!([{"byteLength": 40, "uri": "data:;base64,AAAA"}]);
    assert_eq!(g.error(), "scene.gltf: /buffers/0: byteLength is 40, but there are 3 bytes");
    g.doc["buffers"] = json!([{"byteLength": 40, "uri": "gone.bin"}]);
    assert_eq!(g.error(), "scene.gltf: /buffers/0/uri: gone.bin: cannot open: no such file");
    assert_eq!(g.load().unwrap_err().kind(), ErrorKind::CannotOpen);

    let image = |image: Value| {
        let mut g = Gltf::triangle();
        g.doc["images"] = json!([image]);
        g.doc["textures"] = json!([{"source": 0}]);
        g.material(json!({"emissiveTexture": {"index": 0}})).error()
    };
    assert_eq!(image(json!({})), "scene.gltf: /images/0: has neither a uri nor a bufferView");
    assert_eq!(
        image(json!({"uri": "data:image/gif;base64,R0lGODlh"})),
        "scene.gltf: /images/0: not supported: GIF images; PNG, JPEG, WebP, KTX2, BMP and TGA are read"
    );
    assert_eq!(
        image(json!({"uri": "data:,hello"})),
        "scene.gltf: /images/0: not an image of a known kind; PNG, JPEG, WebP, KTX2, BMP and TGA are read"
    );
    let cut = &png(8, 8, &[7; 256])[..40];
    let uri = format!("data:;base64,{}", crate::common::base64(cut));
    assert!(image(json!({"uri": uri})).starts_with("scene.gltf: /images/0: "));
}

#[test]
fn textures() {
    let texture = |textures: Value, extra: Value| {
        let mut g = Gltf::triangle();
        g.doc["textures"] = textures;
        g.doc["samplers"] = extra;
        g.doc["images"] = json!([{"uri": "x.png"}]);
        g.material(json!({"emissiveTexture": {"index": 0}})).error()
    };
    assert_eq!(
        texture(json!([]), json!([])),
        "scene.gltf: /materials/0/emissiveTexture/index: refers to texture 0, but there are 0"
    );
    assert_eq!(
        texture(json!([{"source": 1}]), json!([])),
        "scene.gltf: /textures/0/source: refers to image 1, but there are 1"
    );
    assert_eq!(texture(json!([{}]), json!([])), "scene.gltf: /textures/0: has no source");
    assert_eq!(
        texture(json!([{"extensions": {"MSFT_texture_dds": {"source": 0}}}]), json!([])),
        "scene.gltf: /textures/0: not supported: the extension MSFT_texture_dds"
    );
    assert_eq!(
        texture(json!([{"source": 0, "sampler": 3}]), json!([])),
        "scene.gltf: /textures/0/sampler: refers to sampler 3, but there are 0"
    );
    assert_eq!(
        texture(json!([{"source": 0, "sampler": 0}]), json!([{"wrapS": 1}])),
        "scene.gltf: /samplers/0: its wrapping mode is none of glTF's"
    );
}

#[test]
fn compressed_meshes_are_decoded_where_there_is_no_plain_data() {
    let mut g = Gltf::triangle();
    g.doc["extensionsUsed"] = json!(["KHR_draco_mesh_compression"]);
    g.primitive()["extensions"] = json!({"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {}}});
    assert!(g.load().is_ok(), "the plain data is used where there is some");
    g.doc["accessors"][0].as_object_mut().unwrap().remove("bufferView");
    assert_eq!(
        g.error(),
        "scene.gltf: /meshes/0/primitives/0/extensions/KHR_draco_mesh_compression: its stream is damaged: General \
         error: Invalid magic"
    );
}

#[test]
fn files_that_are_no_scenes() {
    let folder = tempfile::tempdir().unwrap();
    let load = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        let e = load_scene(&path, &LoadOptions::default()).unwrap_err();
        assert_eq!(e.kind(), ErrorKind::BadData, "{e}");
        assert_eq!(e.path(), path);
        e.to_string().split_once(&format!("{name}: ")).unwrap().1.to_string()
    };
    assert!(load("a.gltf", b"{").starts_with("JSON: EOF while parsing"));
    assert!(load("b.gltf", b"{}").starts_with("JSON: missing field `asset`"));
    assert!(load("c.gltf", &[b'['; 100_000]).starts_with("JSON: "));
    let deep = [vec![b'['; 100_000], vec![b']'; 100_000]].concat();
    let nested = [br#"{"asset":{"version":"2.0"},"extensions":{"x":"#, &deep[..], b"}}"].concat();
    assert!(load("d.gltf", &nested).starts_with("JSON: depth of the JSON"));
    let first = br#"{"asset":{"version":"1.0"}}"#;
    assert_eq!(load("e.gltf", first), "/asset/version: not supported: glTF version \"1.0\"");
    assert_eq!(load("f.glb", b"nothing"), "byte 0: not a binary glTF: it does not begin with `glTF`");
    assert_eq!(
        load("g.fbx", b"v 0 0 0"),
        format!("not supported: scenes of the kind .fbx; what opens: {SCENE_FORMATS}")
    );
    assert_eq!(load("h.glb", b"glTF\x01\0\0\0"), "byte 4: not supported: glTF container version 1");
    let e = load_scene(folder.path().join("none.gltf"), &LoadOptions::default()).unwrap_err();
    assert_eq!(e.kind(), ErrorKind::CannotOpen);
    assert!(e.to_string().ends_with("none.gltf: cannot open: no such file"));
    let e = load_scene(folder.path(), &LoadOptions::default()).unwrap_err();
    assert!(e.to_string().ends_with("cannot open: it is a folder"));
}

#[test]
fn an_empty_scene_and_a_byte_order_mark_are_fine() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.gltf");
    std::fs::write(&path, "\u{feff}{\"asset\":{\"version\":\"2.0\"}}").unwrap();
    let loaded = load_scene(&path, &LoadOptions::default()).unwrap();
    assert!(loaded.scene.nodes.is_empty() && loaded.warnings.is_empty());
}

#[test]
fn limits_are_kept() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.gltf");
    let mut g = Gltf::triangle();
    g.image("image/png", &png(4, 2, &[0; 32]));
    let g = g.material(json!({"emissiveTexture": {"index": 0}}));
    std::fs::write(&path, g.text()).unwrap();
    let load = |change: &dyn Fn(&mut Limits)| {
        let mut options = LoadOptions::default();
        change(&mut options.limits);
        load_scene(&path, &options).map(|_| ()).map_err(|e| {
            assert_eq!(e.kind(), ErrorKind::BadData);
            e.to_string().split_once("scene.gltf: ").unwrap().1.to_string()
        })
    };
    assert_eq!(load(&|_| ()), Ok(()));
    let refused = |change: &dyn Fn(&mut Limits), message: &str| {
        let said = load(change).unwrap_err();
        assert!(said.starts_with(message), "{said}");
    };
    refused(&|l| l.max_file_bytes = 10, "file size");
    refused(&|l| l.max_json_bytes = 10, "JSON size");
    refused(&|l| l.max_buffer_bytes = 10, "/buffers/0/uri: size of all buffers");
    refused(&|l| l.max_image_side = 3, "/images/0: ");
    refused(&|l| l.max_image_bytes = 31, "/images/0: decoded image size 32 exceeds the limit of 31");
    refused(&|l| l.max_total_image_bytes = 31, "/images/0: decoded size of all images 32");
    refused(&|l| l.max_triangles = 0, "/meshes/0/primitives/0: number of triangles 1");
    refused(&|l| l.max_vertices = 2, "/meshes/0/primitives/0: number of vertices 3");
    refused(&|l| l.max_json_depth = 3, "JSON: depth of the JSON ");
    refused(&|l| l.max_json_objects = 5, "JSON: number of JSON objects ");
    refused(&|l| l.max_instances = 0, "/nodes: number of instances 1 exceeds the limit of 0");
    refused(&|l| l.max_node_depth = 0, "/nodes/0: depth of the nodes 1 exceeds the limit of 0");
}

#[test]
fn a_small_file_cannot_ask_for_much_by_repeating_itself() {
    let mut g = Gltf::triangle();
    let one = g.primitive().clone();
    g.doc["meshes"][0]["primitives"] = json!(vec![one; 1000]);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.gltf");
    std::fs::write(&path, g.text()).unwrap();
    let mut options = LoadOptions::default();
    options.limits.max_triangles = 999;
    let e = load_scene(&path, &options).unwrap_err().to_string();
    assert!(e.contains("/meshes/0/primitives/999: number of triangles 1000"), "{e}");
}

/// A scene in `folder/inside` whose buffer has this URI.
fn load_uri(folder: &Path, uri: &str) -> Result<(), String> {
    let mut g = Gltf::triangle();
    let inside = folder.join("inside");
    g.doc["buffers"] = json!([{"byteLength": g.bytes.len(), "uri": uri}]);
    g.load_in(&inside).map(|_| ()).map_err(|e| {
        let message = e.to_string();
        assert!(!message.contains('\n'), "{message}");
        message
    })
}

#[test]
fn no_path_leads_out_of_the_scene_s_folder() {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path();
    let bytes = Gltf::triangle().bytes;
    std::fs::create_dir_all(root.join("inside/sub")).unwrap();
    for name in ["secret.bin", "inside/near.bin", "inside/sub/deep.bin"] {
        std::fs::write(root.join(name), &bytes).unwrap();
    }
    for uri in ["near.bin", "./near.bin", "sub/deep.bin", "sub/%64eep.bin", "%2E/near.bin"] {
        assert_eq!(load_uri(root, uri), Ok(()), "{uri}");
    }
    let absolute = root.join("secret.bin").display().to_string();
    for uri in [
        "../secret.bin",
        "sub/../../secret.bin",
        "./../secret.bin",
        "sub/../near.bin",
        "%2e%2e/secret.bin",
        "..%2Fsecret.bin",
        "%2E%2E%2fsecret.bin",
        "..\\secret.bin",
        "%2e%2e%5csecret.bin",
        "sub\\..\\..\\secret.bin",
        &absolute,
        &format!("/{absolute}"),
        &format!("file://{absolute}"),
        &format!("file:{absolute}"),
        &format!("FiLe://localhost{absolute}"),
        &absolute.replace('/', "%2f"),
        "http://localhost/secret.bin",
        "https://localhost/secret.bin",
        "ftp://localhost/secret.bin",
        "//localhost/secret.bin",
        "\\\\localhost\\secret.bin",
        "C:\\secret.bin",
        "c:/secret.bin",
        "C%3a/secret.bin",
        "near.bin:stream",
        "near.bin%00.png",
        "near.bin\n",
        "%ff.bin",
        "",
        ".",
        "./",
        "sub/",
    ] {
        let said = load_uri(root, uri).expect_err(uri);
        assert!(said.contains("scene.gltf: /buffers/0/uri: "), "{uri}: {said}");
        assert!(uri == "sub/" || said.contains("refused path"), "{uri}: {said}");
    }
}

#[cfg(unix)]
#[test]
fn no_link_leads_out_and_no_pipe_is_opened() {
    use std::os::unix::fs::symlink;
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path();
    let bytes = Gltf::triangle().bytes;
    std::fs::create_dir_all(root.join("inside/sub")).unwrap();
    std::fs::create_dir_all(root.join("outside")).unwrap();
    std::fs::write(root.join("outside/secret.bin"), &bytes).unwrap();
    std::fs::write(root.join("inside/near.bin"), &bytes).unwrap();
    symlink("near.bin", root.join("inside/fair.bin")).unwrap();
    symlink("../outside/secret.bin", root.join("inside/file.bin")).unwrap();
    symlink(root.join("outside"), root.join("inside/folder")).unwrap();
    symlink("loop.bin", root.join("inside/loop.bin")).unwrap();
    symlink("/dev/zero", root.join("inside/device.bin")).unwrap();
    assert_eq!(load_uri(root, "fair.bin"), Ok(()));
    for uri in ["file.bin", "folder/secret.bin", "device.bin"] {
        let said = load_uri(root, uri).expect_err(uri);
        assert!(said.contains("leads out of the scene's folder through a link"), "{uri}: {said}");
    }
    assert!(load_uri(root, "loop.bin").unwrap_err().contains("loop.bin: cannot open"));
    let made = std::process::Command::new("mkfifo").arg(root.join("inside/pipe.bin")).status();
    if made.is_ok_and(|s| s.success()) {
        let said = load_uri(root, "pipe.bin").unwrap_err();
        assert!(said.contains("not a regular file"), "{said}");
    } else {
        eprintln!("skipped: there is no mkfifo here");
    }
    // The folder itself may be reached through a link.
    symlink("inside", root.join("alias")).unwrap();
    load_uri(root, "near.bin").unwrap();
    assert!(load_scene(root.join("alias/scene.gltf"), &LoadOptions::default()).is_ok());
}

#[test]
fn a_flood_of_warnings_is_told_briefly() {
    let mut g = Gltf::triangle();
    g.doc["extensionsUsed"] = (0..20_000).map(|i| json!(format!("EXT_{i}"))).collect();
    let lines = g.load().unwrap().warnings;
    assert_eq!(lines.len(), 51);
    assert!(lines[0].contains("EXT_0 ") && lines[49].contains("EXT_49 "), "{lines:?}");
    assert_eq!(lines[50], "and 19950 more kinds of warnings");
}
