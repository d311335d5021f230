//! The paired test on scenes of files: the same samples on both devices, path by path.

use crate::common::{Both, Shot, assert_none, load, shared};
use lumbre_testkit::ready::asset;
use std::path::Path;

/// Compares the view of a camera of a file.
fn faults(path: &Path, camera: &str, shot: &Shot) -> Vec<String> {
    let name = path.file_name().expect("a file").to_string_lossy();
    let (scene, view) = load(path, camera, shot.aspect());
    let Some(both) = Both::new(scene) else { return Vec::new() };
    both.faults(&format!("{name} {camera}"), &view, shot)
}

/// Compares all files of a list; the faults of all of them.
fn check(root: &Path, files: &[(&str, &str, Shot)]) {
    let faults: Vec<String> =
        files.iter().flat_map(|(file, camera, shot)| faults(&root.join(file), camera, shot)).collect();
    assert_none(&faults);
}

#[test]
fn our_scenes() {
    check(
        &asset(""),
        &[
            ("smooth.gltf", "", Shot::PLAIN),
            ("prism.gltf", "", Shot::PLAIN),
            ("leaves.gltf", "", Shot::PLAIN),
            ("plates.glb", "", Shot::PLAIN),
            ("cornell.glb", "", Shot::TEXTURED),
            ("cornell.obj", "", Shot::TEXTURED),
            ("lanterns.glb", "", Shot::TEXTURED),
        ],
    );
}

/// Paths that end at their greatest length with a shadow ray through glass under way, and films of odd sizes.
#[test]
fn short_paths_through_glass() {
    let shot = Shot { size: [37, 29], ..Shot::TEXTURED };
    let (scene, mut view) = load(&asset("cornell.glb"), "", shot.aspect());
    let Some(both) = Both::new(scene) else { return };
    let mut faults = Vec::new();
    for depth in 2..=5 {
        view.settings.max_depth = Some(depth);
        view.settings.roulette = None;
        faults.extend(both.faults(&format!("depth {depth}"), &view, &shot));
    }
    assert_none(&faults);
}

/// For the pool. Each of its paths passes several normal maps (tiles, wood, cloth, plaster), of which
/// devices read texels that differ in the last digits; each bounce multiplies what that does to the direction. As measured at 48 x 32
/// pixels without roulette, paths that differ by 1e-3: none at depths 0 and 1, 16 in 1000 at depth 3, 55 (exterior) and 124 (interior)
/// at depth 16, of which one in six and one in seventeen by more than a tenth. Without normal maps it is 13 and 19, without any
/// textures 6 and 26. With several samples of a pixel one fork would spoil what the others have in common.
const FORKING: Shot = Shot { size: [56, 42], spp: 1, ..Shot::TEXTURED };

#[test]
fn our_large_scenes() {
    check(
        &asset(""),
        &[
            ("materials.glb", "all", Shot::TEXTURED),
            ("pool.glb", "exterior", FORKING),
            ("pool.glb", "interior", FORKING),
        ],
    );
}

type List = &'static [(&'static str, &'static str, Shot)];

/// What each exercises is in the README of that folder.
const SHARED: [List; 4] = [
    &[
        ("gltf-sample-assets/TransmissionTest/glTF-Binary/TransmissionTest.glb", "", Shot::TEXTURED),
        ("gltf-sample-assets/AttenuationTest/glTF-Binary/AttenuationTest.glb", "", Shot::TEXTURED),
        ("gltf-sample-assets/AlphaBlendModeTest/glTF-Binary/AlphaBlendModeTest.glb", "", Shot::TEXTURED),
        ("gltf-sample-assets/ToyCar/glTF/ToyCar.gltf", "", Shot::TEXTURED),
    ],
    &[
        ("gltf-sample-assets/ClearCoatTest/glTF/ClearCoatTest.gltf", "", Shot::TEXTURED),
        ("gltf-sample-assets/SheenCloth/glTF/SheenCloth.gltf", "", Shot::TEXTURED),
        (
            "gltf-sample-assets/AnisotropyStrengthTest/glTF-Binary/AnisotropyStrengthTest.glb",
            "",
            Shot::TEXTURED,
        ),
    ],
    &[
        ("gltf-sample-assets/NormalTangentTest/glTF-Binary/NormalTangentTest.glb", "", Shot::TEXTURED),
        ("gltf-sample-assets/NegativeScaleTest/glTF-Binary/NegativeScaleTest.glb", "", Shot::TEXTURED),
        ("gltf-sample-assets/SimpleInstancing/glTF-Binary/SimpleInstancing.glb", "", Shot::TEXTURED),
        ("gltf-sample-assets/EmissiveStrengthTest/glTF-Binary/EmissiveStrengthTest.glb", "", Shot::TEXTURED),
        ("gltf-sample-assets/UnlitTest/glTF-Binary/UnlitTest.glb", "", Shot::PLAIN),
    ],
    &[
        ("cornell-box-gltf/rayferric/cornell-box.gltf", "", Shot::PLAIN),
        ("asmilex-obj/scenes/cornell_box_glossy.obj", "", Shot::PLAIN),
        ("asmilex-obj/scenes/Medieval_building.obj", "", Shot::TEXTURED),
        ("sponza/glTF-Draco-WebP/Sponza.glb", "", Shot::TEXTURED),
    ],
];

fn check_shared(list: List) {
    let files: Vec<&str> = list.iter().map(|(file, ..)| *file).collect();
    if let Some(folder) = shared(&files) {
        check(&folder, list);
    }
}

#[test]
fn shared_transmission() {
    check_shared(SHARED[0]);
}

#[test]
fn shared_lobes() {
    check_shared(SHARED[1]);
}

#[test]
fn shared_geometry() {
    check_shared(SHARED[2]);
}

#[test]
fn shared_rooms() {
    check_shared(SHARED[3]);
}
