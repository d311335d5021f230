//! Pictures against references, by z-tests of blocks of pixels: those of another renderer (two Cornell boxes, where the folder
//! `peers` is found) and our own.

use lumbre_core::Rgb;
use lumbre_core::filter::FilterKind;
use lumbre_core::sampler::SamplerKind;
use lumbre_core::settings::RenderSettings;
use lumbre_testkit::npy;
use lumbre_testkit::ready::{open, peers};
use lumbre_testkit::references::{ALL, Reference};
use lumbre_testkit::z_test::{Outcome, Picture, compare};
use std::path::Path;

/// Samples per pixel of the references of other renderers.
const PEER_SPP: f64 = 32_700.0;
/// Side of a block there, pixels of 256.
const PEER_BLOCK: usize = 8;

fn peer_reference(dir: &Path, name: &str) -> Picture {
    let colors = |file: String| -> Vec<Rgb> {
        let array = npy::read(&dir.join("ref").join(file)).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(array.shape, [256, 256, 3]);
        array.values.chunks_exact(3).map(|c| Rgb::new(c[0], c[1], c[2])).collect()
    };
    Picture::of_colors(256, 256, &colors(format!("{name}.npy")), &colors(format!("{name}_var.npy")))
}

/// A picture of ours as the references are made: box filter, no roulette, independent samples.
fn peer_picture(dir: &Path, name: &str, max_depth: u32) -> (Picture, u32) {
    const SPP: u32 = 64;
    let mut ready = open(&dir.join("scenes").join(format!("{name}.gltf")), 1.0);
    ready.view.settings = RenderSettings {
        max_depth: Some(max_depth),
        roulette: None,
        sampler: SamplerKind::Independent,
        seed: 1,
        filter: FilterKind::Box,
        ..RenderSettings::default()
    };
    (Picture::of_film(&ready.film([256, 256], 0..SPP)), SPP)
}

/// Compares a picture with a reference of `share` times as many samples, from whose variance that of our samples follows: 64
/// samples of a caustic know too little of their own.
fn compare_with(ours: &Picture, reference: &Picture, share: f64, block: usize) -> Outcome {
    compare(&ours.with_variance_of(reference, share), reference, block)
}

/// The picture passes within `relative`; scaled by 1.03, it fails by its mean and by its blocks; brighter by 3 % on its left half
/// alone, it fails.
fn assert_agrees(
    ours: &Picture,
    reference: &Picture,
    (share, block): (f64, usize),
    relative: f64,
    what: &str,
) {
    let test = |picture: &Picture| compare_with(picture, reference, share, block);
    let right = test(ours);
    println!("{what}: {right:?}");
    assert!(right.accept(relative), "{what}: {right:?}");
    assert!(right.mean_square > 0.5, "{what}: variances that are too large would pass anything: {right:?}");
    let bright = test(&ours.scaled(|_, _| 1.03));
    assert!(bright.offset > relative && bright.offset > 4.5 * bright.offset_error, "{what}, 3 %: {bright:?}");
    assert!(!(bright.blocks_agree() && bright.spread_agrees()), "{what}, 3 %: {bright:?}");
    let half = test(&ours.scaled(|x, _| if 2 * x < ours.width { 1.03 } else { 1.0 }));
    assert!(!half.accept(relative), "{what}, 3 % on the left: {half:?}");
}

fn peer_test(name: &str, max_depth: u32, relative: f64) {
    let Some(dir) = peers() else {
        println!("skipped: no folder `peers` beside the shared scenes, so no reference of {name}");
        return;
    };
    let reference = peer_reference(&dir, name);
    let (ours, spp) = peer_picture(&dir, name, max_depth);
    assert_agrees(&ours, &reference, (PEER_SPP / f64::from(spp), PEER_BLOCK), relative, name);
}

/// Diffuse walls and boxes.
#[test]
fn cornell_a_of_another_renderer() {
    peer_test("cornell_a", 7, 0.002);
}

/// Glass and mirror spheres: caustics.
#[test]
fn cornell_b_of_another_renderer() {
    peer_test("cornell_b", 11, 0.002);
}

/// Our own references.
#[test]
fn our_own_references() {
    const SPP: u32 = 256;
    for reference in ALL {
        let blessed = reference.read().unwrap_or_else(|e| panic!("{e}"));
        let ours = Picture::of_film(&reference.open(7).film(reference.size, 0..SPP));
        // Four and a half standard errors of the reference and of this picture.
        let relative = 0.015;
        let share = f64::from(blessed.spp) / f64::from(SPP);
        assert_agrees(&ours, &blessed.picture, (share, reference.block), relative, reference.name);
    }
}

/// A reference that is missing is an error that says how to make it.
#[test]
fn a_missing_reference_fails() {
    let missing = Reference { name: "nowhere", ..ALL[0] };
    assert!(missing.read().is_err_and(|e| e.contains("nowhere.exr") && e.contains("bless")));
}
