//! A backend of the CPU that was brought up to date draws what a new one draws, bit for bit.

use lumbre_core::Film;
use lumbre_cpu::{CpuBackend, CpuOptions};
use lumbre_scene::{CompiledScene, Part, Scene, SceneChanges, compile, recompile};
use lumbre_testkit::changing::{DEEP_EDITS, EDITS, rich, view};
use std::sync::Arc;

fn film(backend: &CpuBackend) -> Film {
    let mut film = Film::new(36, 24);
    backend.render(&view(1.5), 0..4, &mut film, &());
    film
}

fn edited(edit: fn(&mut Scene)) -> Scene {
    let mut scene = rich();
    edit(&mut scene);
    scene
}

fn compiled(scene: &Scene) -> CompiledScene {
    compile(scene).expect("it compiles").scene
}

#[test]
fn every_edit_and_back() {
    let scene = rich();
    let start = compiled(&scene);
    for merge in [false, true] {
        let options = CpuOptions { merge };
        let mut backend = CpuBackend::with_options(start.clone(), options);
        let before = film(&backend);
        for (name, edit) in EDITS.iter().chain(DEEP_EDITS) {
            let after = edited(*edit);
            let (made, changes) = recompile(&scene, &start, &after).unwrap();
            backend.update(made.scene.clone(), changes);
            let fresh = film(&CpuBackend::with_options(compiled(&after), options));
            assert!(film(&backend) == fresh, "{name}, merge {merge}");
            if EDITS.iter().any(|(n, _)| n == name) {
                assert!(fresh != before, "{name} changes the picture");
            }
            backend.update(start.clone(), SceneChanges::between(&made.scene, &start));
            assert!(film(&backend) == before, "{name} and back, merge {merge}");
        }
    }
}

/// Where meshes stay apart, no edit of an interactive program builds one again, but for what changes vertices, which meshes there are, or
/// which triangles of a mesh ask for the same work.
#[test]
fn structures_of_meshes_stay() {
    let scene = rich();
    let start = compiled(&scene);
    let mut kept = 0;
    for (name, edit) in EDITS {
        let mut backend = CpuBackend::with_options(start.clone(), CpuOptions { merge: false });
        let before = backend.accel().structures().to_vec();
        let (made, changes) = recompile(&scene, &start, &edited(*edit)).unwrap();
        backend.update(made.scene, changes);
        let after = backend.accel().structures();
        let same = after.iter().all(|a| before.iter().any(|b| Arc::ptr_eq(a, b)));
        // Two parts of a mesh become one.
        let joins = *name == "varnish on both sides";
        assert_eq!(same, !changes.geometry() && !joins, "{name}");
        kept += u32::from(same && changes.any(&[Part::Transforms, Part::Instances, Part::Meshes]));
    }
    assert!(kept > 10, "{kept} edits move, hide or reclass something");
}

/// The first test would see an update that does not know what changed.
#[test]
fn changes_that_are_not_named_are_seen() {
    let scene = rich();
    let start = compiled(&scene);
    for name in ["a box moved", "a ball mirrored"] {
        let (_, edit) = EDITS.iter().find(|(n, _)| *n == name).unwrap();
        let after = compiled(&edited(*edit));
        let mut backend = CpuBackend::with_options(start.clone(), CpuOptions { merge: false });
        backend.update(after.clone(), SceneChanges::none());
        let fresh = CpuBackend::with_options(after, CpuOptions { merge: false });
        assert!(film(&backend) != film(&fresh), "{name}");
    }
}
