//! The scenes of other people: each opens, and no extension in it is unknown.

use crate::common::{file_name, scenes_folder};
use lumbre_io::{Limits, LoadOptions, load_scene, read_environment};
use lumbre_scene::{AlphaMode, Projection, Scene};
use std::path::{Path, PathBuf};

fn triangles(scene: &Scene) -> usize {
    scene.meshes.iter().flat_map(|m| &m.primitives).map(|p| p.indices.len() / 3).sum()
}

fn find(folder: &Path, out: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            find(&path, out);
        } else if path.extension().is_some_and(|e| e == "gltf" || e == "glb") {
            out.push(path);
        }
    }
}

#[test]
fn every_gltf_opens() {
    let Some(folder) = scenes_folder() else { return };
    let mut paths = Vec::new();
    find(&folder, &mut paths);
    paths.sort();
    assert!(paths.len() >= 48, "only {} scenes in {}", paths.len(), folder.display());
    let mut wrong = Vec::new();
    for path in &paths {
        let name = path.strip_prefix(&folder).unwrap().display();
        let loaded = match load_scene(path, &LoadOptions::default()) {
            Ok(loaded) => loaded,
            Err(e) => {
                wrong.push(e.to_string());
                continue;
            }
        };
        let n = triangles(&loaded.scene);
        println!("{name}: {n} triangles");
        for warning in &loaded.warnings {
            println!("    {warning}");
            if warning.contains("extension") {
                wrong.push(format!("{name}: {warning}"));
            }
        }
        if n == 0 || loaded.scene.world_nodes().is_empty() {
            wrong.push(format!("{name} is empty"));
        }
        if let Err(e) = lumbre_scene::compile(&loaded.scene) {
            wrong.push(format!("{name} does not compile: {e}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The scenes of the second thesis with their triangles, and the most warnings each may give.
const OBJ_SCENES: &[(&str, usize, usize)] = &[
    ("Medieval_building", 16_715, 0),
    ("cornell_box_empty_co", 12, 0),
    ("cornell_box_empty_rg", 12, 0),
    ("cornell_box_empty_white", 12, 0),
    ("cornell_box_glossy", 1_112, 0),
    ("cornell_box_iow", 1_110, 0),
    ("cornell_box_mirror", 36, 0),
    ("cornell_box_original", 36, 0),
    ("cornell_box_saturada", 36, 0),
    ("cornell_box_sphere", 2_188, 0),
    ("cube", 12, 1),
    ("cube_modif", 12, 1),
    ("cube_multi", 12, 0),
    ("cube_no_diffuse", 12, 1),
    ("cubes", 26, 0),
    ("plane", 2, 1),
    ("seahorse", 1_304, 0),
    ("sphere", 8_318, 1),
    ("water", 4_900, 1),
    ("wolf", 956, 0),
    ("wuson", 3_732, 1),
    ("wuson_transparent", 3_732, 1),
];

#[test]
fn every_obj_of_the_second_thesis_opens() {
    let Some(folder) = scenes_folder() else { return };
    let folder = folder.join("asmilex-obj");
    let options = LoadOptions { asset_dirs: vec![folder.join("textures")], ..LoadOptions::default() };
    let mut seen = 0;
    for (name, count, warnings) in OBJ_SCENES {
        let loaded = load_scene(folder.join("scenes").join(format!("{name}.obj")), &options)
            .unwrap_or_else(|e| panic!("{e}"));
        println!("{name}: {} triangles", triangles(&loaded.scene));
        loaded.warnings.iter().for_each(|w| println!("    {w}"));
        assert_eq!(triangles(&loaded.scene), *count, "{name}");
        assert_eq!(loaded.warnings.len(), *warnings, "{name}");
        lumbre_scene::compile(&loaded.scene).unwrap();
        let glows = loaded.scene.materials.iter().any(|m| m.emission.max_component() > 1.0);
        assert_eq!(glows, name.starts_with("cornell"), "{name}");
        seen += 1;
    }
    let all = std::fs::read_dir(folder.join("scenes")).unwrap();
    let all = all.filter(|e| e.as_ref().unwrap().path().extension().is_some_and(|e| e == "obj")).count();
    assert_eq!(seen, all, "scenes that are not in the table");
}

/// Its MTL names the textures by their file names; they lie in a folder of their own.
#[test]
fn textures_of_the_medieval_building_lie_elsewhere() {
    let Some(folder) = scenes_folder() else { return };
    let folder = folder.join("asmilex-obj");
    let path = folder.join("scenes/Medieval_building.obj");
    let loaded = load_scene(&path, &LoadOptions::default()).unwrap();
    assert_eq!((loaded.scene.images.len(), loaded.warnings.len()), (0, 7));
    let options = LoadOptions { asset_dirs: vec![folder.join("textures")], ..LoadOptions::default() };
    let loaded = load_scene(&path, &options).unwrap();
    assert_eq!((loaded.scene.images.len(), loaded.warnings.len()), (7, 0));
}

#[test]
fn sponza_has_all_its_parts() {
    let Some(folder) = scenes_folder() else { return };
    let loaded = load_scene(folder.join("sponza/glTF/Sponza.gltf"), &LoadOptions::default()).unwrap();
    assert_eq!(loaded.warnings, Vec::<String>::new());
    let scene = loaded.scene;
    let masks = scene.materials.iter().filter(|m| matches!(m.alpha_mode, AlphaMode::Mask { .. })).count();
    let primitives: usize = scene.meshes.iter().map(|m| m.primitives.len()).sum();
    assert_eq!(
        (triangles(&scene), primitives, scene.materials.len(), masks, scene.images.len()),
        (262_267, 103, 25, 3, 69)
    );
    assert!(scene.images.iter().all(|i| i.rgba8.len() == 4 * (i.width * i.height) as usize));
    let all = || scene.meshes.iter().flat_map(|m| &m.primitives);
    assert!(all().all(|p| p.material.is_some() && p.normals.len() == p.positions.len()));
    assert!(all().all(|p| p.uv0.len() == p.positions.len()));
    // One primitive comes without tangents.
    assert_eq!(all().filter(|p| p.tangents.len() == p.positions.len()).count(), 102);
    assert!(scene.cameras.is_empty() && scene.lights.is_empty());
}

#[test]
fn the_peers_cornell_boxes() {
    let Some(folder) = scenes_folder() else { return };
    for (name, count) in [("cornell_a.gltf", 38), ("cornell_b.gltf", 40_978)] {
        let path = folder.join("../peers/scenes").join(name);
        if !path.is_file() {
            eprintln!("skipped: {name} is not here");
            continue;
        }
        let loaded = load_scene(&path, &LoadOptions::default()).unwrap();
        assert_eq!(triangles(&loaded.scene), count, "{name}");
        assert_eq!(loaded.warnings, Vec::<String>::new());
        assert_eq!(loaded.scene.cameras.len(), 1);
        let projection = loaded.scene.cameras[0].projection;
        assert!(matches!(projection, Projection::Perspective { yfov, .. } if yfov > 0.0), "{projection:?}");
        assert!(loaded.scene.materials.iter().any(|m| m.emission.max_component() > 1.0), "no lamp");
    }
}

#[test]
fn punctual_lights_of_the_lamp() {
    let Some(folder) = scenes_folder() else { return };
    let path = folder.join("gltf-sample-assets/LightsPunctualLamp/glTF/LightsPunctualLamp.gltf");
    let scene = load_scene(path, &LoadOptions::default()).unwrap().scene;
    assert_eq!(scene.lights.len(), 5);
    assert_eq!(scene.nodes.iter().filter(|n| n.light.is_some()).count(), 5);
    assert!(scene.lights.iter().all(|l| l.intensity.max_component() > 0.0));
}

#[test]
fn every_environment_opens() {
    let Some(folder) = scenes_folder() else { return };
    let mut seen = 0;
    for entry in std::fs::read_dir(folder.join("hdri")).unwrap() {
        let path = entry.unwrap().path();
        if !path.extension().is_some_and(|e| e == "hdr" || e == "exr") {
            continue;
        }
        let name = file_name(&path);
        let env = read_environment(&path, &Limits::default()).unwrap_or_else(|e| panic!("{e}"));
        let peak = env.map.pixels.iter().map(|p| p.max_component()).fold(0.0, f32::max);
        println!("{name}: {} x {}, peak {peak}", env.map.width, env.map.height);
        assert_eq!(env.map.pixels.len(), (env.map.width * env.map.height) as usize);
        assert_eq!(env.map.width, 2 * env.map.height, "{name}");
        // What scenes/README.md says of them.
        match name.as_str() {
            "sky.hdr" => assert!((peak / 22_672.0 - 1.0).abs() < 0.01, "{peak}"),
            "park_zip.exr" => assert!((peak / 11_800.0 - 1.0).abs() < 0.01, "{peak}"),
            _ => assert!(peak > 0.5, "{name}: {peak}"),
        }
        seen += 1;
    }
    assert!(seen >= 8, "only {seen} environments");
}
