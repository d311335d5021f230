//! What an OBJ's geometry means: each feature on a file of a few lines.

mod common;

use common::texts::{Folder, obj, primitives};
use glam::{Vec2, Vec3, Vec4};
use lumbre_core::Rgb;
use lumbre_core::color::srgb_decode;

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

#[test]
fn indices_from_the_front_and_from_the_back_name_the_same() {
    let corners = ["f 1/1/1 2/2/1 3/3/1 4/4/1", "f -4/-4/-1 -3/-3/-1 -2/-2/-1 -1/-1/-1"];
    let scenes = corners.map(|f| {
        let text = format!("{SQUARE}vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 3\n{f}\n");
        let (scene, warnings) = obj(&text);
        assert_eq!(warnings, Vec::<String>::new());
        scene
    });
    assert_eq!(scenes[0], scenes[1]);
    let p = primitives(&scenes[0])[0];
    assert_eq!(p.indices, [0, 1, 2, 0, 2, 3]);
    assert_eq!(p.positions, [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y]);
    assert_eq!(p.normals, [Vec3::Z; 4]);
    // v points down.
    assert_eq!(p.uv0, [Vec2::new(0.0, 1.0), Vec2::ONE, Vec2::new(1.0, 0.0), Vec2::ZERO]);
}

#[test]
fn a_vertex_may_come_after_its_face() {
    let (scene, _) = obj("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n");
    assert_eq!(primitives(&scene)[0].positions.len(), 3);
}

#[test]
fn faces_without_normals_are_flat_and_mixed_ones_are_told_apart() {
    let text = format!("{SQUARE}vn 0 0 1\nf 1//1 2//1 3//1\nf 1 3 4\nf 1//1 3 4//1\n");
    let (scene, warnings) = obj(&text);
    assert_eq!(warnings, Vec::<String>::new());
    let p = primitives(&scene);
    assert_eq!((p.len(), p[0].normals.len(), p[1].normals.len()), (2, 3, 0));
    assert_eq!((p[0].indices.len(), p[1].indices.len()), (3, 6));
}

/// A roof of two slopes over the ridge 3 - 4.
const ROOF: &str = "v 0 0 0\nv 0 0 2\nv 1 1 0\nv 1 1 2\nv 2 0 0\nv 2 0 2\n";

#[test]
fn smoothing_groups_share_normals_within_and_not_across() {
    let normals = |faces: &str| {
        let (scene, _) = obj(&format!("{ROOF}{faces}"));
        primitives(&scene).iter().map(|p| (p.positions.clone(), p.normals.clone())).collect::<Vec<_>>()
    };
    let left = Vec3::new(-1.0, 1.0, 0.0).normalize();
    let right = Vec3::new(1.0, 1.0, 0.0).normalize();
    let of = |list: &[(Vec<Vec3>, Vec<Vec3>)], at: Vec3| {
        let (positions, normals) = &list[0];
        positions.iter().zip(normals).filter(|(p, _)| **p == at).map(|(_, n)| *n).collect::<Vec<_>>()
    };
    let close = |a: Vec3, b: Vec3| assert!((a - b).length() < 1e-6, "{a} {b}");
    // One group: along the ridge the mean, at the eaves the slope's own.
    let one = normals("s 1\nf 1 2 4 3\nf 3 4 6 5\n");
    close(of(&one, Vec3::new(1.0, 1.0, 0.0))[0], Vec3::Y);
    assert_eq!(of(&one, Vec3::new(1.0, 1.0, 0.0)).len(), 1);
    close(of(&one, Vec3::ZERO)[0], left);
    // Two groups, even with the same vertices: a crease.
    let two = normals("s 1\nf 1 2 4 3\ns 2\nf 3 4 6 5\n");
    let ridge = of(&two, Vec3::new(1.0, 1.0, 0.0));
    close(ridge[0], left);
    close(ridge[1], right);
    // Off, and nothing said: flat.
    for flat in ["f 1 2 4 3\nf 3 4 6 5\n", "s off\nf 1 2 4 3\nf 3 4 6 5\n", "s 0\nf 1 2 4 3\nf 3 4 6 5\n"] {
        assert!(normals(flat)[0].1.is_empty());
    }
    // Across materials a group goes on.
    let (scene, _) = obj(&format!("{ROOF}s 1\nusemtl a\nf 1 2 4 3\nusemtl b\nf 3 4 6 5\n"));
    for p in primitives(&scene) {
        let at = p.positions.iter().position(|&v| v == Vec3::new(1.0, 1.0, 2.0)).unwrap();
        close(p.normals[at], Vec3::Y);
    }
}

#[test]
fn angles_weigh_and_not_the_number_of_triangles() {
    // A corner of a cube, one of its three squares cut into two triangles at the corner.
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1 1 0\nv 0 1 1\nv 1 0 1\ns 1\n\
        f 1 3 5\nf 1 5 2\nf 1 2 7 4\nf 1 4 6 3\n";
    let (scene, _) = obj(text);
    let p = primitives(&scene)[0];
    let at = p.positions.iter().position(|&v| v == Vec3::ZERO).unwrap();
    let want = Vec3::splat(-1.0).normalize();
    assert!((p.normals[at] - want).length() < 1e-6, "{}", p.normals[at]);
}

#[test]
fn concave_faces_stay_inside_themselves() {
    let (scene, warnings) = obj("v 0 0 0\nv 4 0 0\nv 4 3 0\nv 2 1 0\nv 0 3 0\nf 1 2 3 4 5\n");
    assert_eq!(warnings, Vec::<String>::new());
    let p = primitives(&scene)[0];
    let areas = p.indices.chunks(3).map(|t| {
        let [a, b, c] = [0, 1, 2].map(|k| p.positions[t[k] as usize]);
        0.5 * (b - a).cross(c - a).z
    });
    let areas: Vec<f32> = areas.collect();
    assert!(areas.iter().all(|&a| a > 0.0), "{areas:?}");
    assert!((areas.iter().sum::<f32>() - 8.0).abs() < 1e-5);
}

#[test]
fn objects_groups_and_materials_make_meshes_and_primitives() {
    let faces = "f 1 2 3\n";
    let (scene, warnings) = obj(&format!(
        "{SQUARE}o Haus ñ 1\ng ignored\nusemtl red\n{faces}usemtl blue\n{faces}o Tür\n{faces}o Haus ñ 1\nusemtl red\n{faces}"
    ));
    assert_eq!(warnings, ["it names materials but no library of them; they are grey"]);
    let names: Vec<_> = scene.meshes.iter().map(|m| (m.name.as_str(), m.primitives.len())).collect();
    assert_eq!(names, [("Haus ñ 1", 2), ("Tür", 1)]);
    assert_eq!(scene.meshes[0].primitives[0].indices.len(), 6);
    let materials: Vec<_> = scene.materials.iter().map(|m| m.name.as_str()).collect();
    assert_eq!(materials, ["red", "blue"]);
    assert!(scene.materials.iter().all(|m| m.base_color == Rgb::splat(0.6) && m.double_sided));
    assert_eq!(scene.roots.len(), 2);
    // Without objects, groups name the meshes; without either the file does.
    let (scene, _) = obj(&format!("{SQUARE}{faces}g a b\n{faces}g\n{faces}"));
    let names: Vec<_> =
        scene.meshes.iter().map(|m| (m.name.as_str(), m.primitives[0].indices.len())).collect();
    assert_eq!(names, [("scene", 6), ("a b", 3)]);
}

#[test]
fn vertex_colours_replace_grey() {
    let (scene, _) = obj("v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0.5 0.5 0.5\nf 1 2 3\n");
    let p = primitives(&scene)[0];
    assert_eq!(p.colors[0], Vec4::new(1.0, 0.0, 0.0, 1.0));
    assert!((p.colors[2].x - srgb_decode(0.5)).abs() < 1e-6);
    assert_eq!(scene.materials[0].base_color, Rgb::WHITE);
    // The fourth number is a weight, not a colour.
    let (scene, _) = obj("v 0 0 0 1\nv 1 0 0 1\nv 0 1 0 0.5\nf 1 2 3\n");
    assert!(primitives(&scene)[0].colors.is_empty());
}

#[test]
fn lines_continue_and_end_as_on_any_system() {
    let (scene, warnings) =
        obj("\u{feff}# a\r\nv 0 0 \\\r\n0\r\nv 1 0 0 # x\r\n\tv 0 1 0\r\nf 1 \\\n2\\\n 3\r\n");
    assert_eq!(warnings, Vec::<String>::new());
    assert_eq!(primitives(&scene)[0].indices, [0, 1, 2]);
}

#[test]
fn what_is_left_out_is_told_once_with_its_line() {
    let text = format!(
        "{SQUARE}l 1 2\np 1\nf 1 2 3\nf 1 2\ncstype bezier\ncurv 0 1 1 2\ncall x.obj\nlod 3\nwhat now\nwhat\nvt nan 0\n\
         vn 0 0 0\nf 1/1/1 2/9/1 3/1/7\n"
    );
    let (scene, warnings) = obj(&text);
    assert_eq!(primitives(&scene).iter().map(|p| p.indices.len()).sum::<usize>(), 6);
    assert_eq!(
        warnings,
        [
            "line 5: points and lines are not supported and are skipped (and 1 more)",
            "line 8: a face of fewer than three corners is skipped",
            "line 9: free-form curves and surfaces are not supported and are skipped (and 1 more)",
            "line 11: commands to run other files are not followed",
            "line 13: the statement \"what\" is not known and is skipped (and 1 more)",
            "texture coordinates that are no numbers are set to 0",
            "normals without a direction are left out",
            "faces refer to texture coordinates that are not there; they go without",
            "faces refer to normals that are not there; they go without",
        ]
    );
}

#[test]
fn errors_name_the_line() {
    let error = |text: &str| Folder::new(&[("scene.obj", text.as_bytes())]).error("scene.obj");
    for (text, message) in [
        ("v 0 0 0\nv 1 x 0\n", "line 2: \"x\" is no number"),
        ("v 0 0\n", "line 1: has 2 numbers where 3 are needed"),
        ("v 0 0 inf\n", "line 1: [0, 0, inf] is no position"),
        ("v 0 0 1e39\n", "line 1: [0, 0, inf] is no position"),
        ("v 0 0 0\n\nf 1 1 2\n", "line 3: refers to a vertex that is not there; there are 1"),
        ("v 0 0 0\nf 1 1 1\nf 1 1 \\\n -2\n", "line 3: refers to a vertex that is not there; there are 1"),
        ("v 0 0 0\nf 1 1 0\n", "line 2: \"0\" is no corner of a face: vertices are counted from 1"),
        ("v 0 0 0\nf 1 1 a\n", "line 2: \"a\" is no corner of a face"),
        ("v 0 0 0\nf 1 1 1/2/3/4\n", "line 2: \"1/2/3/4\" is no corner of a face"),
        ("v 0 0 0\ns maybe\n", "line 2: \"maybe\" is no smoothing group"),
        ("hello", "not a Wavefront OBJ: it has neither vertices nor faces"),
        ("", "not a Wavefront OBJ: it has neither vertices nor faces"),
    ] {
        assert_eq!(error(text), format!("scene.obj: {message}"), "{text:?}");
    }
    let (scene, warnings) = obj("v 0 0 0\n");
    assert!(scene.meshes.is_empty());
    assert_eq!(warnings, ["it has no faces: there is nothing to draw"]);
}
