//! `lumbre compare`.

use crate::common::*;
use lumbre::core::Rgb;
use lumbre::io::{ExrImage, ExrLayer, Limits, read_linear_image, write_exr, write_png};
use std::path::{Path, PathBuf};

const W: u32 = 16;
const H: u32 = 12;

fn pixels(f: impl Fn(u32, u32) -> Rgb) -> Vec<Rgb> {
    (0..W * H).map(|i| f(i % W, i / W)).collect()
}

/// A ramp to radiance 4 plus something everywhere.
fn ramp(more: f32) -> Vec<Rgb> {
    pixels(|x, y| Rgb::new(x as f32 / 4.0, 0.5, y as f32 / H as f32) + Rgb::splat(more))
}

fn hdr(dir: &Path, name: &str, pixels: Vec<Rgb>) -> String {
    let layers = vec![
        ExrLayer::rgb("", pixels.clone().into_iter(), false),
        ExrLayer::rgb("albedo", pixels.iter().map(|_| Rgb::splat(0.5)), false),
    ];
    let path = dir.join(name);
    write_exr(&path, ExrImage { width: W, height: H, layers, ..ExrImage::default() }).unwrap();
    path.display().to_string()
}

fn ldr(dir: &Path, name: &str, code: u8) -> String {
    let path = dir.join(name);
    write_png(&path, W, H, &vec![code; (W * H * 3) as usize]).unwrap();
    path.display().to_string()
}

#[test]
fn a_file_equals_itself() {
    let dir = folder();
    let a = hdr(dir.path(), "a.exr", ramp(0.0));
    let run = lumbre(&format!("compare {a} {a} --json --fail-above rmse=0 --fail-above hdr-flip=0")).exits(0);
    let json = run.last_json();
    for key in ["rmse", "relmse", "ldr_flip", "hdr_flip"] {
        assert_eq!(json[key], 0.0, "{key}");
    }
    assert!(json["psnr"].is_null(), "infinite");
}

#[test]
fn another_differs_by_what_it_differs() {
    let dir = folder();
    let (a, b) = (hdr(dir.path(), "a.exr", ramp(0.0)), hdr(dir.path(), "b.exr", ramp(0.25)));
    let run = lumbre(&format!("compare {a} {b} --json")).exits(0);
    let json = run.last_json();
    assert!((json["rmse"].as_f64().unwrap() - 0.25).abs() < 1e-6, "{json}");
    for key in ["relmse", "psnr", "ldr_flip", "hdr_flip"] {
        assert!(json[key].as_f64().is_some_and(|v| v > 0.0), "{key}: {json}");
    }
    let text = lumbre(&format!("compare {a} {b}")).exits(0);
    assert_eq!(text.line("rmse"), "rmse      0.250000");
    assert!(text.line("psnr").ends_with(" dB") && text.stdout.lines().count() == 6);
    // The reference comes first: relMSE divides by it.
    let back = lumbre(&format!("compare {b} {a} --json")).exits(0).last_json();
    assert!(back["relmse"].as_f64() < json["relmse"].as_f64());
    lumbre(&format!("compare {a} {b} --layer albedo --fail-above rmse=0")).exits(0);
    lumbre(&format!("compare {a} {b} --layer none")).exits(65).says("none");
}

#[test]
fn bounds_fail_with_1_and_say_which() {
    let dir = folder();
    let (a, b) = (hdr(dir.path(), "a.exr", ramp(0.0)), hdr(dir.path(), "b.exr", ramp(0.25)));
    lumbre(&format!("compare {a} {b} --fail-above rmse=0.26")).exits(0).does_not_say("error");
    for metric in ["rmse", "relmse", "ldr-flip", "hdr-flip"] {
        let words = format!("compare {a} {b} --fail-above {metric}=0.0001 --fail-above rmse=9");
        let run = lumbre(&words).exits(1).says(&format!("error: {metric} is "));
        assert_eq!(run.stderr.matches("above").count(), 1, "{}", run.stderr);
    }
    lumbre(&format!("compare {a} {b} --fail-above psnr=20")).exits(2).says("more is better");
    lumbre(&format!("compare {a} {b} --fail-above speed=1")).exits(2).says("no metric");
}

#[test]
fn pixels_that_are_no_numbers_cannot_hide() {
    let dir = folder();
    let a = hdr(dir.path(), "a.exr", ramp(0.0));
    let mut broken = ramp(0.0);
    broken[20] = Rgb::splat(f32::NAN);
    let b = hdr(dir.path(), "b.exr", broken);
    lumbre(&format!("compare {a} {b}")).exits(0).says("0 pixels of the reference and 1 of the other");
    lumbre(&format!("compare {a} {b} --fail-above rmse=1")).exits(1).says("non-finite is 1, above 0");
    lumbre(&format!("compare {a} {b} --fail-above rmse=1 --fail-above non-finite=1")).exits(0);
    lumbre(&format!("compare {b} {a} --fail-above rmse=1")).exits(0).says("1 pixels of the reference");
}

#[test]
fn pictures_for_a_screen_have_no_hdr_flip() {
    let dir = folder();
    let (a, b) = (ldr(dir.path(), "a.png", 118), ldr(dir.path(), "b.png", 188));
    let json = lumbre(&format!("compare {a} {b} --json")).exits(0).last_json();
    // 118 and 188 are the codes of 0.181 and 0.503.
    assert!((json["rmse"].as_f64().unwrap() - 0.322).abs() < 0.001, "{json}");
    assert!(json["hdr_flip"].is_null() && json["exposure_ev"].is_null());
    lumbre(&format!("compare {a} {b} --fail-above hdr-flip=1")).exits(2).says("two HDR pictures");
    lumbre(&format!("compare {a} {b} --layer albedo")).exits(65).says("only EXR files have layers");
}

#[test]
fn an_hdr_picture_is_exposed_beside_one_for_a_screen() {
    let dir = folder();
    let grey = |v: f32| pixels(|_, _| Rgb::splat(v));
    let (a, b) = (hdr(dir.path(), "a.exr", grey(0.02)), ldr(dir.path(), "b.png", 118));
    // Automatic exposure makes it 0.18, whose code is 117.7: what is left is the rounding.
    lumbre(&format!("compare {a} {b} --fail-above rmse=0.002 --fail-above ldr-flip=0.02")).exits(0);
    lumbre(&format!("compare {b} {a} --fail-above rmse=0.002")).exits(0);
    lumbre(&format!("compare {a} {b} --exposure 0 --fail-above rmse=0.1")).exits(1).says("rmse");
    // Five stops up, both are white on the screen.
    let (c, d) = (hdr(dir.path(), "c.exr", grey(2.0)), hdr(dir.path(), "d.exr", grey(3.0)));
    let shown = |ev: &str| lumbre(&format!("compare {c} {d} --exposure {ev} --json")).exits(0).last_json();
    assert_eq!((&shown("5")["ldr_flip"], &shown("5")["rmse"]), (&0.0.into(), &1.0.into()));
    assert!(shown("-2")["ldr_flip"].as_f64() > Some(0.1));
}

#[test]
fn the_difference_picture_is_dark_where_they_are_the_same() {
    let dir = folder();
    let mut other = ramp(0.0);
    other[0] = Rgb::new(9.0, 0.0, 9.0);
    let (a, b) = (hdr(dir.path(), "a.exr", ramp(0.0)), hdr(dir.path(), "b.exr", other));
    let out: PathBuf = dir.path().join("d.png");
    lumbre(&format!("compare {a} {b} -o {}", out.display())).exits(0).says("wrote");
    let map = read_linear_image(&out, None, &Limits::default()).unwrap();
    assert_eq!((map.width, map.height), (W, H));
    assert!(map.pixels[0].luminance() > 0.1 && map.pixels[(W * H - 1) as usize].luminance() < 0.01);
    lumbre(&format!("compare {a} {b} -o d.exr")).exits(2).says("is a .png");
    lumbre(&format!("compare {a} {b} -o {}/none/d.png", dir.path().display())).exits(74);
}

#[test]
fn pictures_that_do_not_fit_or_open_have_their_codes() {
    let dir = folder();
    let a = hdr(dir.path(), "a.exr", ramp(0.0));
    let small = dir.path().join("b.png");
    write_png(&small, 1, 1, &[0; 3]).unwrap();
    lumbre(&format!("compare {a} {}", small.display())).exits(65).says("16x12").says("1x1");
    lumbre(&format!("compare {a} none.exr")).exits(66).says("none.exr");
    lumbre(&format!("compare {a}")).exits(2).says("TEST");
    lumbre(&format!("compare {a} {SMOOTH}")).exits(65).says("smooth.gltf");
}
