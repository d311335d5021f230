//! Frames that are not filtered: the mean of many is what paths draw of which rough surfaces throw light on others once at most.

use super::centred;
use crate::common::{Both, compile, load};
use crate::scenes::{lamps, lamps_view};
use lumbre_core::hybrid::{AntiAliasing, FrameView, HybridSettings};
use lumbre_core::settings::{RenderSettings, View};
use lumbre_core::{Film, Rgb, Spectrum};
use lumbre_testkit::ready::asset;

const SIZE: [u32; 2] = [32, 24];
const FRAMES: u32 = 512;
/// The same for pictures that must differ.
const FEW_FRAMES: u32 = 64;
/// Camera samples of each pixel on the CPU.
const SPP: u32 = 4096;

/// Mean and standard error of each pixel's luminance over frames.
fn mean_of_frames(both: &Both, view: &View, settings: &HybridSettings, frames: u32) -> Vec<(f32, f32)> {
    let mut hybrid = both.vulkan.hybrid().expect("the device draws hybrid frames");
    let mut sums = vec![(0.0f64, 0.0f64); (SIZE[0] * SIZE[1]) as usize];
    for frame in 0..frames {
        let view = View { frame, ..view.clone() };
        hybrid.frame(&FrameView { view: &view, size: SIZE, settings }).expect("the GPU draws");
        for (sum, pixel) in sums.iter_mut().zip(hybrid.film().expect("the device is there").pixels()) {
            let y = f64::from(pixel.radiance().luminance());
            *sum = (sum.0 + y, sum.1 + y * y);
        }
    }
    let n = f64::from(frames);
    let of = |(sum, squares): (f64, f64)| {
        let (mean, square) = (sum / n, squares / n);
        (mean as f32, ((square - mean * mean).max(0.0) / n).sqrt() as f32)
    };
    sums.into_iter().map(of).collect()
}

/// How frames differ from paths.
#[derive(Clone, Copy, Debug)]
struct Differing {
    /// Share of pixels that differ by more than 4.5 standard errors and 1 %.
    far: f64,
    /// Relative difference of the means.
    bias: f64,
    /// The same in standard errors.
    z: f64,
}

fn compare(paths: &Film, frames: &[(f32, f32)]) -> Differing {
    let (mut far, mut sums, mut variance) = (0, [0.0f64; 2], 0.0f64);
    for (a, (mean, error)) in paths.pixels().iter().zip(frames) {
        let x = a.radiance().luminance();
        sums[0] += f64::from(x);
        sums[1] += f64::from(*mean);
        variance += f64::from(a.error()).powi(2) + f64::from(*error).powi(2);
        far += usize::from((x - mean).abs() > 4.5 * a.error().hypot(*error) + 0.01 * x.max(0.02));
    }
    let difference = sums[1] - sums[0];
    Differing {
        far: far as f64 / frames.len() as f64,
        bias: difference / sums[0],
        z: difference / variance.sqrt(),
    }
}

fn check(name: &str, both: &Both, view: &View) {
    let settings =
        RenderSettings { max_depth: Some(8), rough_bounces: Some(1), roulette: None, ..view.settings };
    let view = centred(&View { settings, ..view.clone() });
    let mut paths = Film::new(SIZE[0], SIZE[1]);
    both.cpu.render(&view, 0..SPP, &mut paths, &());
    let dark = HybridSettings {
        depth: 8,
        ambient: Some(Spectrum::BLACK),
        filter: false,
        anti_aliasing: AntiAliasing::None,
        ..HybridSettings::ALL
    };
    let differing = compare(&paths, &mean_of_frames(both, &view, &dark, FRAMES));
    println!("{name}: {differing:?}");
    let Differing { far, bias, z } = differing;
    assert!(far <= 0.01 && bias.abs() <= 0.01 && z.abs() < 4.5, "{name}: {differing:?}");
    // Without light from surface to surface it is another picture; so it is with ambient light.
    let direct = HybridSettings { global_illumination: false, ..dark };
    let lit = HybridSettings { ambient: Some(Rgb::WHITE), ..dark };
    for other in [direct, lit] {
        let differing = compare(&paths, &mean_of_frames(both, &view, &other, FEW_FRAMES));
        assert!(differing.bias.abs() > 0.02, "{name}: not seen: {differing:?}");
    }
}

#[test]
fn a_room_with_a_lamp() {
    let (scene, view) = load(&asset("cornell.glb"), "", SIZE[0] as f32 / SIZE[1] as f32);
    let Some(both) = Both::new(scene) else { return };
    check("cornell.glb", &both, &view);
}

/// Point, spot and directional lights, a sun, a sky, lamps.
#[test]
fn every_kind_of_light() {
    let Some(both) = Both::new(compile(&lamps())) else { return };
    check("lamps", &both, &lamps_view(SIZE[0] as f32 / SIZE[1] as f32));
}
