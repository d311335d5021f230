//! A backend of the GPU that was brought up to date draws what a new one draws, bit for bit.

use crate::common::compile;
use lumbre_core::Film;
use lumbre_scene::{Scene, SceneChanges, recompile};
use lumbre_testkit::changing::{DEEP_EDITS, EDITS, Edit, rich, view};
use lumbre_testkit::{gpu, own_gpu};
use lumbre_vulkan::{Gpu, SceneOptions, VulkanBackend};

const APART: SceneOptions = SceneOptions { merge: false, chunk: 1 << 30 };

fn film(backend: &VulkanBackend) -> Film {
    let mut film = Film::new(24, 16);
    backend.render(&view(1.5), 0..2, &mut film, &()).expect("it renders");
    film
}

fn edited(edit: Edit) -> Scene {
    let mut scene = rich();
    edit.1(&mut scene);
    scene
}

fn fresh(gpu: &Gpu, scene: &Scene, options: SceneOptions) -> Film {
    film(&VulkanBackend::new(gpu, &compile(scene), options).expect("the scene fits"))
}

/// What is wrong after each of these edits, and after it was taken back.
fn faults(gpu: &Gpu, options: SceneOptions, edits: &[Edit]) -> Vec<String> {
    let scene = rich();
    let start = compile(&scene);
    let mut backend = VulkanBackend::new(gpu, &start, options).expect("the scene fits");
    let before = film(&backend);
    let mut faults = Vec::new();
    for &(name, edit) in edits {
        let after = edited((name, edit));
        let (made, changes) = recompile(&scene, &start, &after).unwrap();
        backend.update(&made.scene, changes).expect("there is room");
        let (found, expected) = (film(&backend), fresh(gpu, &after, options));
        if found != expected {
            faults.push(format!("{name}, {changes:?}"));
        }
        if expected == before && EDITS.iter().any(|e| e.0 == name) {
            faults.push(format!("{name} changes nothing"));
        }
        backend.update(&start, SceneChanges::between(&made.scene, &start)).expect("there is room");
        if film(&backend) != before {
            faults.push(format!("{name} and back, {changes:?}"));
        }
    }
    faults
}

/// Edits of each kind: making the pipelines of a new backend for every one takes minutes where they run on the processor.
const KINDS: &[&str] = &[
    "a colour",
    "a metal with holes",
    "a box that glows",
    "a lamp that is off",
    "glass to plaster",
    "plastic to glass",
    "one more light",
    "a group moved",
    "a hidden lamp",
    "another sky",
    "no sun",
    "one more texture",
    "an empty mesh",
];

fn named(names: &[&str]) -> Vec<Edit> {
    let found = |name| *EDITS.iter().chain(DEEP_EDITS).find(|e| e.0 == name).expect("an edit");
    names.iter().copied().map(found).collect()
}

#[test]
fn every_kind_of_edit_and_back() {
    let Some(gpu) = gpu() else { return };
    // Where pipelines are soon made, all of them.
    let all: Vec<Edit> = EDITS.iter().chain(DEEP_EDITS).copied().collect();
    let edits = if gpu.is_real() { all } else { named(KINDS) };
    let found = faults(&gpu, APART, &edits);
    assert!(found.is_empty(), "{}", found.join("\n"));
}

/// Where meshes are merged, edits cost more and give the same.
#[test]
fn where_meshes_are_merged() {
    let Some(gpu) = gpu() else { return };
    let edits = named(&["a colour", "a metal with holes", "a box moved", "a hidden group"]);
    let found = faults(&gpu, SceneOptions::default(), &edits);
    assert!(found.is_empty(), "{}", found.join("\n"));
}

/// Edits one upon another, without going back: what they leave behind is not in the way.
#[test]
fn edits_one_upon_another() {
    let Some(gpu) = gpu() else { return };
    let mut scene = rich();
    let mut compiled = compile(&scene);
    let mut backend = VulkanBackend::new(&gpu, &compiled, APART).expect("the scene fits");
    for (i, (name, edit)) in EDITS.iter().chain(DEEP_EDITS).enumerate() {
        let mut after = scene.clone();
        edit(&mut after);
        let (made, changes) = recompile(&scene, &compiled, &after).unwrap();
        backend.update(&made.scene, changes).expect("there is room");
        (scene, compiled) = (after, made.scene);
        if i % 15 == 14 {
            assert!(film(&backend) == fresh(&gpu, &scene, APART), "after {name}");
        }
    }
    assert!(film(&backend) == fresh(&gpu, &scene, APART));
}

#[test]
fn two_hundred_updates_take_no_more_memory() {
    let Some(gpu) = own_gpu() else { return };
    let scene = rich();
    let start = compile(&scene);
    let mut backend = VulkanBackend::new(&gpu, &start, APART).expect("the scene fits");
    // Colours, places, visibility, lights that come and go.
    let edits = named(&[
        "a colour",
        "a box moved",
        "a hidden group",
        "one more light",
        "a box that glows",
        "a weaker sky",
    ]);
    let mut after_some = None;
    for i in 0..200 {
        let (made, changes) = recompile(&scene, &start, &edited(edits[i % edits.len()])).unwrap();
        backend.update(&made.scene, changes).expect("there is room");
        backend.update(&start, SceneChanges::between(&made.scene, &start)).expect("there is room");
        if i % edits.len() == 0 {
            let now = gpu.memory();
            let now = (now.allocated, now.pieces, now.reserved);
            if i >= edits.len() {
                assert_eq!(*after_some.get_or_insert(now), now, "after {i} edits");
            }
        }
    }
    drop(film(&backend));
}

/// The first test would see changes that do not reach the device.
#[test]
fn changes_that_are_not_named_are_seen() {
    let Some(gpu) = gpu() else { return };
    let start = compile(&rich());
    for (name, edit) in named(&["a colour", "a box moved", "a weaker sky"]) {
        let after = edited((name, edit));
        let mut backend = VulkanBackend::new(&gpu, &start, APART).expect("the scene fits");
        let before = film(&backend);
        backend.update(&compile(&after), SceneChanges::none()).expect("nothing is done");
        assert!(film(&backend) == before, "{name}");
        assert!(fresh(&gpu, &after, APART) != before, "{name}");
    }
}
