//! PLY and STL: what each form of them means, and that damaged ones are refused with their place.

use crate::common::texts::{Folder, primitives};
use glam::{Vec2, Vec3};
use lumbre_core::Rgb;
use lumbre_core::color::srgb_decode;
use lumbre_io::{Limits, LoadOptions, load_scene};
use lumbre_scene::Scene;

fn load(name: &str, bytes: &[u8]) -> (Scene, Vec<String>) {
    Folder::new(&[(name, bytes)]).load(name)
}

fn error(name: &str, bytes: &[u8]) -> String {
    Folder::new(&[(name, bytes)]).error(name)
}

const TEXT: &str = "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty float x\nproperty float y\n\
    property float z\nproperty float nx\nproperty float ny\nproperty float nz\nproperty float s\nproperty float t\n\
    property uchar red\nproperty uchar green\nproperty uchar blue\nproperty int what\nelement face 2\n\
    property uchar flags\nproperty list uchar int vertex_indices\nelement edge 1\nproperty list uchar float odd\nend_header\n\
    0 0 0 0 0 2 0 0 255 0 0 -7\n1 0 0 0 0 1 1 0 0 255 0 -7\n1 1 0 0 0 1 1 1 0 0 255 -7\n0 1 0 0 0 1 0 1 128 128 128 -7\n\
    9 3 0 1 2\n9 4 0 1 2 3\n2 0.5 0.25\n";

#[test]
fn all_that_a_ply_may_say_of_a_vertex() {
    let (scene, warnings) = load("a.ply", TEXT.as_bytes());
    assert_eq!(warnings, Vec::<String>::new());
    let p = primitives(&scene)[0];
    assert_eq!(p.positions, [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y]);
    assert_eq!(p.normals, [Vec3::Z; 4]);
    assert_eq!(p.uv0[1], Vec2::ONE);
    assert_eq!(p.indices, [0, 1, 2, 0, 1, 2, 0, 2, 3]);
    assert_eq!(p.colors[0].truncate(), Vec3::X);
    assert!((p.colors[3].x - srgb_decode(128.0 / 255.0)).abs() < 1e-6);
    assert_eq!(scene.materials[0].base_color, Rgb::WHITE);
    assert_eq!((scene.meshes[0].name.as_str(), scene.name.as_str(), scene.roots.len()), ("a", "a.ply", 1));
    // CR LF, and a name that does not say what it is.
    let windows = TEXT.replace('\n', "\r\n");
    assert_eq!(primitives(&load("b.mesh", windows.as_bytes()).0)[0], p);
}

/// The same square in either byte order, with a list of shorts and doubles in between.
fn binary(big: bool) -> Vec<u8> {
    let order = if big { "big" } else { "little" };
    let mut out = format!(
        "ply\nformat binary_{order}_endian 1.0\nelement vertex 4\nproperty double x\nproperty float y\n\
         property list uchar short extra\nproperty short z\nproperty float red\nproperty float green\n\
         property float blue\nelement face 1\nproperty list int ushort vertex_index\nend_header\n"
    )
    .into_bytes();
    let mut put = |bytes: &[u8]| {
        let mut bytes = bytes.to_vec();
        if big {
            bytes.reverse();
        }
        out.extend(bytes);
    };
    for (x, y) in [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)] {
        put(&f64::to_le_bytes(x));
        put(&f32::to_le_bytes(y));
        put(&[2]);
        put(&i16::to_le_bytes(-5));
        put(&i16::to_le_bytes(6));
        put(&i16::to_le_bytes(-3));
        (0..3).for_each(|_| put(&f32::to_le_bytes(0.5)));
    }
    put(&i32::to_le_bytes(4));
    (0..4u16).for_each(|i| put(&i.to_le_bytes()));
    out
}

#[test]
fn both_byte_orders() {
    let scenes = [false, true].map(|big| {
        let (scene, warnings) = load("a.ply", &binary(big));
        assert_eq!(warnings, Vec::<String>::new());
        scene
    });
    assert_eq!(scenes[0], scenes[1]);
    let p = primitives(&scenes[0])[0];
    assert_eq!(p.positions[2], Vec3::new(1.0, 1.0, -3.0));
    assert_eq!(p.indices, [0, 1, 2, 0, 2, 3]);
    assert!(p.normals.is_empty() && (p.colors[0].x - srgb_decode(0.5)).abs() < 1e-6);
}

#[test]
fn strips_keep_their_winding() {
    let text = "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n\
        element tristrips 1\nproperty list int int vertex_indices\nend_header\n\
        0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n9 0 1 2 3 -1 2 3 4 -1\n";
    let (scene, _) = load("a.ply", text.as_bytes());
    assert_eq!(primitives(&scene)[0].indices, [0, 1, 2, 2, 1, 3, 2, 3, 4]);
}

#[test]
fn odd_plys() {
    let text = TEXT.replace("0 0 0 0 0 2", "0 0 0 0 0 0").replace("9 3 0 1 2", "9 2 0 1");
    let (scene, warnings) = load("a.ply", text.as_bytes());
    assert_eq!(primitives(&scene)[0].normals, [Vec3::Z; 4]);
    assert_eq!(
        warnings,
        [
            "a face of fewer than three corners is skipped",
            "a normal without a direction is replaced by that of the triangles around"
        ]
    );
    let text = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n1 2 3\n";
    let (scene, warnings) = load("a.ply", text.as_bytes());
    assert!(scene.meshes.is_empty());
    assert_eq!(warnings, ["it has no faces: there is nothing to draw"]);
}

#[test]
fn damaged_plys_are_refused_with_their_place() {
    let change = |from: &str, to: &str| {
        assert!(TEXT.contains(from), "{from}");
        error("a.ply", TEXT.replacen(from, to, 1).as_bytes())
    };
    for (from, to, message) in [
        ("ascii 1.0", "ascii 2.0", "line 2: \"format ascii 2.0\" is no line of a PLY header"),
        ("ascii", "text", "line 2: \"format text 1.0\" is no line of a PLY header"),
        ("format ascii 1.0\n", "", "the header names no format"),
        ("property float x", "property half x", "line 5: \"property half x\" is no line of a PLY header"),
        (
            "list uchar int",
            "list float int",
            "line 19: \"property list float int vertex_indices\" is no line",
        ),
        ("element vertex 4\n", "", "line 4: a property stands before any element"),
        ("property float y\n", "", "its vertices have no x, y and z"),
        ("element vertex 4", "element vertex 4000000000", "the header promises at least"),
        ("element vertex 4", "element vertex 18446744073709551615", "the header promises at least"),
        ("element vertex 4", "element vertex -1", "line 4: \"element vertex -1\" is no line of a PLY header"),
        ("end_header\n", "", "line 22: \"0 0 0 0 0 2 0 0 255 0 0 -7\" is no line of a PLY header"),
        ("1 1 0 0 0 1 1 1", "1 x 0 0 0 1 1 1", "line 25: \"x\" is no such number"),
        ("1 1 0 0 0 1 1 1", "1 inf 0 0 0 1 1 1", "line 25: [1, inf, 0] is no position"),
        ("9 3 0 1 2", "9 3 0 1 4", "triangle 0: refers to vertex 4, but there are 4"),
        ("9 3 0 1 2", "9 3 0 1 -2", "line 27: -2 is no index of a vertex"),
        ("9 4 0 1 2 3", "9 40000 0 1 2 3", "line 28: a list of 40000 values cannot be held by the rest"),
        ("9 4 0 1 2 3", "9 -4 0 1 2 3", "line 28: a list of -4 values cannot be held by the rest"),
        ("2 0.5 0.25", "2 0.5", "line 29: the file ends within it"),
    ] {
        let said = change(from, to);
        assert!(said.starts_with(&format!("a.ply: {message}")), "{from} -> {to}: {said}");
    }
    assert_eq!(error("a.ply", b"solid"), "a.ply: line 1: the header does not end");
    assert_eq!(error("a.ply", b"plx\n"), "a.ply: line 1: not a PLY: it does not begin with `ply`");
    let whole = binary(false);
    assert!(error("a.ply", &whole[..whole.len() - 1]).starts_with("a.ply: face 0: a list of 4 values"));
}

fn facet(x: f32) -> String {
    format!(
        "facet normal 0 0 1\n  outer loop\n vertex {x} 0 0\n VERTEX 1 0 0\n vertex 0 1e0 0\n endloop\nendfacet\n"
    )
}

fn binary_stl(head: &[u8], count: u32) -> Vec<u8> {
    let mut out = head.to_vec();
    out.resize(80, 0);
    out.extend(count.to_le_bytes());
    for i in 0..count {
        let numbers = [0.0, 0.0, 1.0, 0.0, 0.0, i as f32, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
        out.extend(numbers.iter().flat_map(|v: &f32| v.to_le_bytes()));
        out.extend([0, 0]);
    }
    out
}

#[test]
fn text_and_binary_stl() {
    let text = format!(
        "solid some name\n{}{}endsolid\nsolid b\n{}endsolid b\n",
        facet(0.0),
        facet(0.5),
        facet(0.25)
    );
    let (scene, warnings) = load("a.stl", text.as_bytes());
    assert_eq!(warnings, Vec::<String>::new());
    let p = primitives(&scene)[0];
    assert_eq!((p.indices.len(), p.positions[3], p.positions[5]), (9, Vec3::new(0.5, 0.0, 0.0), Vec3::Y));
    assert!(p.normals.is_empty());
    assert_eq!(scene.materials[0].base_color, Rgb::splat(0.6));
    // A binary one may begin as a text does.
    for head in [&b"exported"[..], b"solid but binary"] {
        let (scene, warnings) = load("a.STL", &binary_stl(head, 3));
        assert_eq!(warnings, Vec::<String>::new());
        let p = primitives(&scene)[0];
        assert_eq!((p.indices.len(), p.positions[6]), (9, Vec3::new(0.0, 0.0, 2.0)));
    }
    let longer = [binary_stl(b"x", 2), vec![1, 2, 3]].concat();
    assert_eq!(load("a.stl", &longer).1, ["bytes after the last triangle are ignored"]);
    assert_eq!(load("a.stl", &binary_stl(b"x", 0)).1, ["it has no triangles: there is nothing to draw"]);
}

#[test]
fn damaged_stls_are_refused_with_their_place() {
    let none = "not an STL: no text that begins with `solid`, and too short for the triangles that a binary one promises";
    let mut short = binary_stl(b"x", 3);
    short.truncate(200);
    let mut wrong = binary_stl(b"x", 3);
    wrong[84 + 50 + 12..84 + 50 + 16].copy_from_slice(&f32::NAN.to_le_bytes());
    let text = |facets: &str| format!("solid a\n{facets}endsolid\n").into_bytes();
    for (bytes, message) in [
        (short, none.to_string()),
        (b"hello".to_vec(), none.to_string()),
        (vec![], none.to_string()),
        (wrong, "triangle 1: [NaN, 0, 1] is no position".into()),
        (text("facet\nvertex 1 2\n"), "line 3: a vertex needs three numbers".into()),
        (text("facet\nvertex 1 2 nan\n"), "line 3: [1, 2, NaN] is no position".into()),
        (text("facet\nvertex 1 2 3\nendloop\n"), "line 4: a facet has three vertices".into()),
        (text("facet\nvertex 1 2 3\n"), "it ends within a facet".into()),
        (text("faces\n"), "line 2: \"faces\" is no word of an STL".into()),
    ] {
        assert_eq!(error("a.stl", &bytes), format!("a.stl: {message}"));
    }
}

#[test]
fn limits_are_kept() {
    let folder = Folder::new(&[
        ("a.ply", TEXT.as_bytes()),
        ("b.stl", &binary_stl(b"x", 9)),
        ("c.stl", format!("solid\n{}{}", facet(0.0), facet(1.0)).as_bytes()),
    ]);
    let load = |name: &str, change: &dyn Fn(&mut Limits)| {
        let mut options = LoadOptions::default();
        change(&mut options.limits);
        load_scene(folder.path(name), &options)
            .unwrap_err()
            .to_string()
            .split_once(name)
            .unwrap()
            .1
            .to_string()
    };
    assert_eq!(load("a.ply", &|l| l.max_vertices = 3), ": number of vertices 4 exceeds the limit of 3");
    assert_eq!(
        load("a.ply", &|l| l.max_triangles = 2),
        ": line 28: number of triangles 3 exceeds the limit of 2"
    );
    assert_eq!(load("b.stl", &|l| l.max_triangles = 8), ": number of triangles 9 exceeds the limit of 8");
    assert_eq!(load("b.stl", &|l| l.max_vertices = 8), ": number of vertices 27 exceeds the limit of 8");
    assert_eq!(
        load("c.stl", &|l| l.max_triangles = 1),
        ": line 15: number of triangles 2 exceeds the limit of 1"
    );
    assert_eq!(load("c.stl", &|l| l.max_vertices = 5), ": number of vertices 6 exceeds the limit of 5");
}
