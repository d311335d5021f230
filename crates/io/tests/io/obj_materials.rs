//! What an MTL's materials mean.

use crate::common::png;
use crate::common::texts::{Folder, material, material_with, obj, scene_with};
use lumbre_core::Rgb;
use lumbre_scene::{AlphaMode, ImageId, Material, Wrap};

/// The material after `newmtl m` with these lines, without warnings.
fn made(lines: &str) -> Material {
    let (m, warnings) = material(&format!("newmtl m\n{lines}\n"));
    assert_eq!(warnings, Vec::<String>::new(), "{lines}");
    m
}

#[test]
fn illum_chooses_the_model() {
    let body = "Kd 0.1 0.2 0.3\nKs 0.4 0.5 0.6\nNs 32\nNi 1.4\n";
    let with = |illum: u32| made(&format!("{body}illum {illum}\n"));
    for illum in [0, 1] {
        let m = with(illum);
        assert_eq!((m.base_color, m.phong, m.specular), (Rgb::new(0.1, 0.2, 0.3), None, 0.0), "{illum}");
        assert!(m.double_sided && m.transmission == 0.0 && m.metallic == 0.0);
    }
    for illum in [2, 3, 5, 8] {
        let m = with(illum);
        let p = m.phong.unwrap();
        assert_eq!((p.specular, m.base_color), (Rgb::new(0.4, 0.5, 0.6), Rgb::new(0.1, 0.2, 0.3)));
        assert_eq!(p.exponent, if illum == 2 { 32.0 } else { f32::INFINITY });
        assert_eq!(p.fresnel, illum == 5);
    }
    for illum in [4, 9] {
        let m = with(illum);
        assert_eq!((m.transmission, m.volume, m.ior, m.phong), (1.0, None, 1.4, None), "a thin pane");
        assert_eq!((m.base_color, m.specular, m.roughness), (Rgb::WHITE, 1.0, 0.0));
    }
    for illum in [6, 7] {
        let m = with(illum);
        assert!(m.volume.is_some_and(|v| v.thickness > 0.0), "a solid");
        assert_eq!((m.transmission, m.ior, m.base_color, m.roughness), (1.0, 1.4, Rgb::WHITE, 0.0));
    }
    let m = with(10);
    assert!(m.shadow_catcher && m.phong.is_none());
    let (m, warnings) = material(&format!("newmtl m\n{body}illum 11\n"));
    assert!(m.phong.is_some());
    assert_eq!(warnings, ["scene.mtl: line 1: illum 11 is none of the models 0 to 10"]);
}

#[test]
fn without_illum_what_is_written_decides() {
    assert_eq!(made("Kd 0.5 0.5 0.5").phong, None);
    assert_eq!(made("Kd 0.5 0.5 0.5\nKs 0 0 0\nNs 10").phong, None);
    assert_eq!(made("Kd 0.5 0.5 0.5\nKs 0.2 0.2 0.2\nNs 10").phong.unwrap().exponent, 10.0);
    assert_eq!(made("").base_color, Rgb::splat(0.6));
    assert_eq!(made("Ke 5 4 3").base_color, Rgb::BLACK);
    // illum 2 without any Ks is plain.
    assert_eq!(made("Kd 1 0 0\nKs 0 0 0\nillum 2").phong, None);
    assert_eq!(made("illum 3\nKd 0 0 0").phong.unwrap().specular, Rgb::WHITE);
}

#[test]
fn emission_is_radiance_as_it_stands() {
    let m = made("Kd 0.78 0.78 0.78\nKe 17 12 4\nillum 2");
    assert_eq!((m.emission, m.base_color), (Rgb::new(17.0, 12.0, 4.0), Rgb::splat(0.78)));
}

#[test]
fn the_filter_is_what_passes_a_body() {
    let m = made("illum 7\nNi 2.5\nTf 0.25 1 0.0625");
    assert_eq!(m.base_color * m.base_color, Rgb::new(0.25, 1.0, 0.0625));
    // A pane is crossed once.
    assert_eq!(made("illum 9\nTf 0.25 1 0.0625").base_color, Rgb::new(0.25, 1.0, 0.0625));
}

#[test]
fn dissolving_is_coverage_except_in_solid_glass() {
    let alpha = |m: &Material| (m.alpha_mode, m.alpha);
    assert_eq!(alpha(&made("d 0.25")), (AlphaMode::Blend, 0.25));
    assert_eq!(alpha(&made("d -halo 0.25")), (AlphaMode::Blend, 0.25));
    assert_eq!(alpha(&made("Tr 0.25")), (AlphaMode::Blend, 0.75));
    assert_eq!(alpha(&made("d 1\nTr 1")), (AlphaMode::Opaque, 1.0));
    assert_eq!(alpha(&made("d 0")), (AlphaMode::Blend, 0.0));
    // The tradition of illum 4 and 9 with a dissolve: glass that is partly there and does not bend light.
    for illum in [4, 9] {
        let m = made(&format!("d 0.5\nKd 0.5 0.4 0.3\nKs 1 1 1\nNs 16\nillum {illum}"));
        assert_eq!((alpha(&m), m.transmission), ((AlphaMode::Blend, 0.5), 0.0));
        assert_eq!(m.phong.unwrap().exponent, 16.0);
    }
    let m = made("d 0.5\nillum 6\nNi 1.5");
    assert_eq!((m.alpha_mode, m.transmission), (AlphaMode::Opaque, 1.0));
    let (m, warnings) = material("newmtl m\nTr 1\n");
    assert_eq!(alpha(&m), (AlphaMode::Opaque, 1.0));
    assert_eq!(warnings, ["scene.mtl: line 1: Tr 1 would make it invisible; it is taken as opaque"]);
}

#[test]
fn names_say_the_index_that_the_file_does_not() {
    let load = |name: &str, body: &str| {
        let text = format!("mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl {name}\nf 1 2 3\n");
        let mtl = format!("newmtl {name}\n{body}\n");
        let folder = Folder::new(&[("a.obj", text.as_bytes()), ("m.mtl", mtl.as_bytes())]);
        folder.load("a.obj").0.materials.remove(0)
    };
    let index = |m: &Material| m.volume.map(|_| m.ior);
    assert_eq!(index(&load("water_surface", "Kd 0 0 1")), Some(1.333));
    assert_eq!(index(&load("Glass 2", "Kd 0 0 1\nNi 0")), Some(1.517));
    assert_eq!(index(&load("glass", "Kd 0 0 1\nNi 1.7\nillum 7")), Some(1.7));
    assert_eq!(index(&load("glass", "Kd 0 0 1\nNi 1.7\nillum 2")), None);
    assert_eq!(index(&load("old glass", "Kd 0 0 1")), None);
    assert_eq!(index(&load("glass_lamp", "Kd 0 0 1\nKe 5 5 5")), None);
    // Zero and the like are no index.
    assert_eq!(index(&load("x", "Ni 0\nillum 7")), Some(1.5));
}

#[test]
fn keys_for_physically_based_shading() {
    let m = made("Kd 0.5 0.4 0.3\nPr 0.25\nPm 0.75\nNi 1.4");
    assert_eq!((m.roughness, m.metallic, m.specular, m.ior), (0.25, 0.75, 1.0, 1.4));
    assert_eq!((m.phong, m.diffuse_roughness), (None, 0.0));
    // Blender writes all of them.
    let m = made("Ks 0.5 0.5 0.5\nPr 0.25\nPm 0\nPs 0\nPc 0\nPcr 0.03\naniso 0\nanisor 0\nillum 2");
    assert_eq!((m.roughness, m.metallic, m.specular), (0.25, 0.0, 1.0));
    assert_eq!((m.clearcoat, m.sheen, m.anisotropy), (None, None, None));
    // Rough and nothing specular: Oren-Nayar.
    for lines in ["Kd 1 0 0\nPr 0.5\nKs 0 0 0", "Kd 1 0 0\nPr 0.5\nillum 1"] {
        let m = made(lines);
        assert_eq!((m.diffuse_roughness, m.specular, m.metallic), (0.5, 0.0, 0.0), "{lines}");
    }
    let m = made("Pr 0.5\nPc 0.8\nPcr 0.1\nPs 0.3\naniso 0.6\nanisor 0.25\nPm 1");
    let coat = m.clearcoat.unwrap();
    assert_eq!((coat.factor, coat.roughness, m.sheen.unwrap().color), (0.8, 0.1, Rgb::splat(0.3)));
    let stretch = m.anisotropy.unwrap();
    assert!(stretch.strength == 0.6 && (stretch.rotation - std::f32::consts::FRAC_PI_2).abs() < 1e-6);
    assert_eq!(made("illum 7\nPr 0.3").roughness, 0.3);
}

#[test]
fn a_file_without_its_library_is_grey() {
    let text = "mtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n";
    let (scene, warnings) = obj(text);
    assert_eq!(warnings, ["line 1: mtllib none.mtl: cannot open: no such file; its materials are grey"]);
    assert_eq!((scene.materials[0].base_color, scene.materials[0].name.as_str()), (Rgb::splat(0.6), "m"));
    let folder = Folder::new(&[("a.obj", text.as_bytes()), ("none.mtl", b"newmtl other\n")]);
    assert_eq!(folder.load("a.obj").1, ["no library has the material \"m\"; it is grey"]);
}

#[test]
fn a_library_of_one_material_is_for_all_faces_of_a_file_that_chooses_none() {
    let text = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let one: &[u8] = b"newmtl only\nKd 1 0 0\n";
    let folder = Folder::new(&[("a.obj", text.as_bytes()), ("m.mtl", one)]);
    let (scene, warnings) = folder.load("a.obj");
    assert_eq!(scene.materials[0].base_color, Rgb::new(1.0, 0.0, 0.0));
    assert_eq!(warnings, ["no material is chosen; all faces get the library's only one, \"only\""]);
    // Of two, none is meant.
    folder.write("m.mtl", b"newmtl a\nKd 1 0 0\nnewmtl b\n");
    let (scene, _) = folder.load("a.obj");
    assert_eq!(scene.materials[0].base_color, Rgb::splat(0.6));
}

#[test]
fn several_libraries_with_blanks_in_their_names() {
    let text = "mtllib my room.mtl  b.mtl\nmtllib c.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\nusemtl b\n\
        f 1 2 3\nusemtl c #1\nf 1 2 3\n";
    let folder = Folder::new(&[
        ("a.obj", text.as_bytes()),
        ("my room.mtl", b"newmtl a\nKd 1 0 0\n"),
        ("b.mtl", b"newmtl b\nKd 0 1 0\n"),
        ("c.mtl", b"newmtl c #1\nKd 0 0 1\nnewmtl a\nKd 0 0 0\n"),
    ]);
    let (scene, warnings) = folder.load("a.obj");
    assert_eq!(warnings, Vec::<String>::new());
    let colors: Vec<Rgb> = scene.materials.iter().map(|m| m.base_color).collect();
    assert_eq!(colors, [Rgb::new(1.0, 0.0, 0.0), Rgb::new(0.0, 1.0, 0.0), Rgb::new(0.0, 0.0, 1.0)]);
}

/// Two texels, one half there.
fn half() -> Vec<u8> {
    png(2, 1, &[255, 0, 0, 255, 0, 255, 0, 128])
}

fn grey_png(levels: &[u8]) -> Vec<u8> {
    let texels: Vec<u8> = levels.iter().flat_map(|&v| [v, v, v, 255]).collect();
    png(levels.len() as u32, 1, &texels)
}

#[test]
fn colour_maps_are_used_as_they_are() {
    let mtl = "newmtl m\nKd 0.5 0.5 0.5\nKs 0 0 0\nKe 0 0 0\nNs 7\nillum 2\nmap_Kd Old Wood.png\nmap_Ks a.png\nmap_Ke a.png\n";
    let plain = grey_png(&[10, 20]);
    let (scene, warnings) = scene_with(mtl, &[("Old Wood.png", &plain), ("a.png", &plain)]);
    assert_eq!(warnings, Vec::<String>::new());
    let m = &scene.materials[0];
    assert_eq!((m.base_color, m.alpha_mode), (Rgb::splat(0.5), AlphaMode::Opaque));
    // A map beside black stands for itself.
    assert_eq!((m.emission, m.phong.unwrap().specular), (Rgb::WHITE, Rgb::WHITE));
    assert!(m.emissive_texture.is_some());
    assert_eq!(m.emissive_texture, m.phong.unwrap().specular_texture);
    assert_eq!(scene.images.len(), 2);
    assert_eq!(scene.images[0].name, "a.png");
}

#[test]
fn alpha_of_the_colour_map_and_map_d_cover_together() {
    let rgba = |mtl: &str| {
        let mask = grey_png(&[51, 255]);
        let (scene, warnings) = scene_with(mtl, &[("c.png", &half()), ("m.png", &mask)]);
        assert_eq!(warnings, Vec::<String>::new());
        let m = &scene.materials[0];
        assert_eq!(m.alpha_mode, AlphaMode::Blend);
        assert_eq!((m.base_color_texture.map(|t| t.texture.0), scene.images.len()), (Some(0), 1));
        scene.images[0].rgba8.clone()
    };
    assert_eq!(rgba("newmtl m\nKd 1 1 1\nmap_Kd c.png\n"), [255, 0, 0, 255, 0, 255, 0, 128]);
    assert_eq!(rgba("newmtl m\nKd 1 1 1\nmap_Kd c.png\nmap_d m.png\n"), [255, 0, 0, 51, 0, 255, 0, 128]);
    assert_eq!(rgba("newmtl m\nKd 1 1 1\nmap_d m.png\n"), [255, 255, 255, 51, 255, 255, 255, 255]);
    assert_eq!(rgba("newmtl m\nmap_Kd c.png\nmap_d c.png\n"), [255, 0, 0, 255, 0, 255, 0, 128]);
    assert_eq!(rgba("newmtl m\nmap_d -imfchan g c.png\n"), [255, 255, 255, 0, 255, 255, 255, 255]);
}

#[test]
fn roughness_and_metallic_share_a_texture() {
    let files: &[(&str, &[u8])] = &[("r.png", &grey_png(&[40, 80])), ("m.png", &grey_png(&[0, 255]))];
    let (scene, warnings) = scene_with("newmtl m\nPm 0\nPr 0.5\nmap_Pr r.png\nmap_Pm m.png\n", files);
    assert_eq!(warnings, Vec::<String>::new());
    let m = &scene.materials[0];
    assert_eq!((m.roughness, m.metallic), (0.5, 1.0));
    assert_eq!(scene.images[0].rgba8, [255, 40, 0, 255, 255, 80, 255, 255]);
    // A rough diffuse surface takes only the roughness.
    let (scene, _) = scene_with("newmtl m\nKs 0 0 0\nmap_Pr r.png\n", files);
    let m = &scene.materials[0];
    assert_eq!((m.diffuse_roughness, m.specular), (1.0, 0.0));
    assert_eq!(scene.images[0].rgba8, [255, 40, 255, 255, 255, 80, 255, 255]);
}

#[test]
fn bump_maps_become_normal_maps_unless_they_are() {
    let normal = png(1, 1, &[128, 128, 255, 255]);
    let heights = grey_png(&[0, 85, 170, 255]);
    let files: &[(&str, &[u8])] = &[("n.png", &normal), ("h.png", &heights)];
    for (line, scale, blue) in [
        ("norm n.png", 1.0, 255),
        ("norm -bm 0.5 n.png", 0.5, 255),
        ("map_Bump -bm 2 n.png", 2.0, 255),
        ("bump h.png -bm 3", 3.0, 254),
    ] {
        let (scene, warnings) = scene_with(&format!("newmtl m\nKd 1 1 1\n{line}\n"), files);
        assert_eq!(warnings, Vec::<String>::new());
        let m = &scene.materials[0];
        assert_eq!(m.normal_scale, scale, "{line}");
        assert!(m.normal_texture.is_some());
        assert!(scene.images[0].rgba8[6 % scene.images[0].rgba8.len()] >= blue, "{line}");
    }
    let (scene, _) = scene_with("newmtl m\nbump h.png\n", files);
    // It rises to the right in the middle: the normal leans to the left.
    assert!(scene.images[0].rgba8[4] < 128);
}

#[test]
fn maps_are_placed_by_their_options() {
    let (scene, warnings) = scene_with(
        "newmtl m\nmap_Kd -s 2 3 1 -o 0.25 0.5 0 a.png\nmap_Ke -clamp on a.png\n",
        &[("a.png", &grey_png(&[1, 2]))],
    );
    assert_eq!(warnings, Vec::<String>::new());
    let m = &scene.materials[0];
    let t = m.base_color_texture.unwrap().transform;
    // At the file's (u, v) = (1, 1), which is (1, 0) here, its map is looked up at (2.25, 3.5): (2.25, -2.5).
    let [u, v] = [t.scale[0] + t.offset[0], t.offset[1]];
    assert_eq!((u, v, t.scale[1], t.rotation), (2.25, -2.5, 3.0, 0.0));
    let [color, glow] =
        [m.base_color_texture, m.emissive_texture].map(|t| scene.textures[t.unwrap().texture.index()]);
    assert_eq!((color.image, color.wrap_s), (ImageId(0), Wrap::Repeat));
    assert_eq!((glow.image, glow.wrap_t), (ImageId(0), Wrap::ClampToEdge));
    let (_, warnings) =
        material_with("newmtl m\nmap_Kd -s 2 2 a.png\nmap_d a.png\n", &[("a.png", &grey_png(&[1, 2]))]);
    assert_eq!(warnings, ["scene.mtl: line 1: map_d is placed by the options of the map it is joined with"]);
}

#[test]
fn a_picture_that_cannot_be_read_leaves_the_factor() {
    let mtl = "newmtl m\nKd 0.5 0.25 0\nmap_Kd none.png\nmap_Ke broken.png\nmap_Bump none.png\n";
    let (m, warnings) = material_with(mtl, &[("broken.png", b"\x89PNG nothing")]);
    assert_eq!(
        (m.base_color, m.base_color_texture, m.emissive_texture),
        (Rgb::new(0.5, 0.25, 0.0), None, None)
    );
    assert_eq!(m.normal_texture, None);
    assert_eq!(warnings.len(), 2, "{warnings:?}");
    assert_eq!(
        warnings[0],
        "scene.mtl: line 3: none.png: cannot open: no such file; the material goes without it"
    );
    assert!(
        warnings[1].starts_with("scene.mtl: line 4: ") && warnings[1].contains("broken.png: "),
        "{warnings:?}"
    );
}

#[test]
fn pictures_of_materials_that_no_face_has_are_not_read() {
    let mtl = "newmtl m\nnewmtl other\nmap_Kd none.png\n";
    assert_eq!(material(mtl).1, Vec::<String>::new());
}

/// A picture that is not there switches nothing on: factors of 0 stay 0, and the model is that of the other statements.
#[test]
fn a_missing_picture_is_as_if_not_named() {
    let maps = ["map_Ke", "map_Ks", "map_Kd", "map_d"].map(|m| format!("{m} gone.png\n")).concat();
    let (m, warnings) = material(&format!("newmtl m\nKd 0 0 0\nKs 0 0 0\nKe 0 0 0\n{maps}"));
    assert!(m.emission.is_black() && m.base_color.is_black() && m.phong.is_none(), "{m:?}");
    assert_eq!(m.alpha_mode, lumbre_scene::AlphaMode::Opaque);
    assert!(warnings.iter().any(|w| w.contains("gone.png")), "{warnings:?}");
    let (m, _) = material("newmtl m\nKd 0.5 0.5 0.5\nPr 0.25\nPm 0\nmap_Pm gone.png\nmap_Pr gone.png\n");
    assert_eq!((m.metallic, m.roughness), (0.0, 0.25));
}
