//! Formats of -o and standard output; the look: --tone, --vignette, --aberration, --quality, --background.

use crate::common::*;
use lumbre::io::{Limits, LinearImage, read_exr, read_linear_image};
use std::fs;
use std::path::Path;

/// The floor and nothing else, lit by a sky of this radiance; half of the picture is sky.
fn horizon(dir: &Path) -> String {
    let scene = scene(dir, &[(square(0.0, 100.0), GREY)]);
    format!("{scene} --look-from 0,1,0 --look-at 0,1,-9 --sky 0.25,0.25,0.25 --exposure 0 --spp 4")
}

fn read(path: &Path) -> LinearImage {
    read_linear_image(path, None, &Limits::default()).unwrap()
}

/// Codes of the red channel of a pixel.
fn red(image: &LinearImage, x: u32, y: u32) -> u8 {
    lumbre::core::color::srgb_encode_u8(image.pixels[(y * image.width + x) as usize].r)
}

fn png(dir: &Path, more: &str) -> LinearImage {
    let path = dir.join("a.png");
    lumbre(&format!("render {} --size 40x30 {more} -o {}", horizon(dir), path.display())).exits(0);
    read(&path)
}

#[test]
fn every_format_shows_the_same_picture() {
    let dir = folder();
    let d = dir.path().display();
    let outputs: Vec<String> = ["png", "jpg", "jpeg", "hdr", "exr"].map(|e| format!("-o {d}/a.{e}")).into();
    let run = lumbre(&format!(
        "render {CORNELL} --size 32x24 --spp 16 --exposure 0 --quality 100 {}",
        outputs.join(" ")
    ));
    run.exits(0).says("a.jpeg").says("a.hdr");
    // RGBE has 8 bits for each band below the largest, which are cut off and not rounded.
    lumbre(&format!("compare {d}/a.exr {d}/a.hdr --fail-above relmse=0.0001")).exits(0);
    lumbre(&format!("compare {d}/a.exr {d}/a.png --exposure 0 --fail-above rmse=0.01")).exits(0);
    lumbre(&format!("compare {d}/a.png {d}/a.jpg --fail-above ldr-flip=0.05")).exits(0);
    assert_eq!(fs::read(dir.path().join("a.jpg")).unwrap(), fs::read(dir.path().join("a.jpeg")).unwrap());
}

#[test]
fn quality_is_that_of_a_jpeg() {
    let dir = folder();
    let size = |quality: &str| {
        let path = dir.path().join("a.jpg");
        let words = format!("render {CORNELL} --size 64x48 --spp 1 {quality} -o {}", path.display());
        lumbre(&words).exits(0);
        fs::metadata(path).unwrap().len()
    };
    let sizes = ["--quality 10", "", "--quality 100"].map(size);
    assert!(sizes.is_sorted_by(|a, b| a < b), "{sizes:?}");
    for wrong in ["0", "101", "-5", "good"] {
        lumbre(&format!("render {CORNELL} --quality {wrong} -o a.jpg")).exits(2);
    }
}

#[test]
fn standard_output_takes_the_picture_and_nothing_else() {
    let dir = folder();
    let path = dir.path().join("a.exr");
    let words = format!("render {SMOOTH} --size 8x6 --spp 2 -o {}", path.display());
    let stdout = |target: &str, more: &str| {
        let mut c = command();
        c.args(words.split_whitespace()).args(["-o", target]).args(more.split_whitespace());
        let output = c.output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        output.stdout
    };
    assert!(stdout("exr:-", "--progress plain") == fs::read(&path).unwrap(), "the same bytes as the file");
    for (target, start) in
        [("-", &b"\x89PNG"[..]), ("png:-", b"\x89PNG"), ("jpg:-", b"\xff\xd8\xff"), ("hdr:-", b"#?RADIANCE")]
    {
        assert!(stdout(target, "--stats").starts_with(start), "{target}");
    }
    lumbre(&format!("{words} -o - --progress json"))
        .exits(2)
        .says("--progress json and the picture cannot both go to standard output");
    lumbre(&format!("{words} -o - -o exr:-")).exits(2).says("standard output takes one picture only");
    lumbre(&format!("{words} -o bmp:-")).exits(2).says("an output is a .png, .jpg, .hdr or .exr");
}

#[cfg(target_os = "linux")]
#[test]
fn standard_output_that_is_full_or_a_terminal() {
    let mut c = command();
    c.args(["render", SMOOTH, "--size", "8x6", "--spp", "1", "-o", "-"]);
    c.stdout(fs::File::options().write(true).open("/dev/full").unwrap());
    Run::from(c.output().unwrap()).exits(74).says("error: standard output: cannot write: No space left");
    let program = env!("CARGO_BIN_EXE_lumbre");
    let words = format!("render {SMOOTH} --size 8x6 --spp 1 -o -");
    let Ok(output) = std::process::Command::new("script")
        .args(["-qec", &format!("'{program}' {words}"), "/dev/null"])
        .output()
    else {
        println!("skipped: no `script` on this machine");
        return;
    };
    let run = Run::from(output).exits(2);
    assert!(run.stdout.contains("standard output is a terminal"), "{}", run.stdout);
}

#[test]
fn the_tone_curve_is_chosen_by_name() {
    let dir = folder();
    // Codes of a sky of radiance 0.25 by each curve's formula.
    let codes = [
        ("", 137),
        ("--tone srgb", 137),
        ("--tone linear", 136),
        ("--tone reinhard", 124),
        ("--tone aces", 114),
        ("--tone agx", 142),
        ("--tone neutral", 126),
    ];
    for (words, code) in codes {
        assert_eq!(red(&png(dir.path(), words), 20, 2), code, "{words}");
    }
    lumbre(&format!("render {SMOOTH} --tone filmic -o a.png"))
        .exits(2)
        .says("the curves are linear, srgb, reinhard, aces, agx, neutral");
}

#[test]
fn vignette_and_aberration_are_off_unless_asked_for() {
    let dir = folder();
    let plain = png(dir.path(), "");
    assert_eq!(png(dir.path(), "--vignette 0 --aberration 0"), plain);
    let dark = png(dir.path(), "--vignette 0.5");
    // The corner's centre lies at 0.968 of the half diagonal.
    let corner = lumbre::core::color::srgb_encode_u8(0.25 * (1.0 - 0.5 * 0.968 * 0.968));
    assert!(red(&dark, 0, 0).abs_diff(corner) <= 1 && red(&dark, 20, 2) > red(&dark, 0, 0));
    assert_ne!(png(dir.path(), "--aberration 20"), plain);
    for wrong in ["--vignette 1.5", "--vignette -1", "--aberration 60", "--aberration x"] {
        lumbre(&format!("render {SMOOTH} {wrong} -o a.png")).exits(2);
    }
}

#[test]
fn a_transparent_background_has_alpha_where_the_format_has_it() {
    let dir = folder();
    let d = dir.path().display();
    let words = format!("render {} --size 40x30 --background transparent", horizon(dir.path()));
    lumbre(&format!("{words} -o {d}/a.png -o {d}/a.jpg -o {d}/a.exr -o {d}/a.hdr")).exits(0);
    let decoder = fs::read(dir.path().join("a.png")).unwrap();
    // Colour type 6 of the header: RGB with alpha.
    assert_eq!(decoder[25], 6);
    let file = read_exr(dir.path().join("a.exr"), &Limits::default()).unwrap();
    let alpha = file.layers[0].channel("A").expect("an alpha");
    assert_eq!((alpha[20], alpha[20 + 29 * 40]), (0.0, 1.0), "sky, floor");
    let red_of_sky = file.layers[0].channel("R").unwrap()[20];
    assert_eq!(red_of_sky, 0.0, "premultiplied");
    assert!(file.metadata.contains(&("lumbre.background".into(), "transparent".into())));
    for black in ["a.jpg", "a.hdr"] {
        let image = read(&dir.path().join(black));
        assert!(image.pixels[20].max_component() < 1e-3, "{black}: before black");
        assert!(image.pixels[20 + 29 * 40].r > 0.05, "{black}: the floor is lit all the same");
    }
    lumbre(&format!("{words} --background scene -o {d}/b.png")).exits(2);
    let (_, plain) = exr(dir.path(), &format!("{} --size 40x30", horizon(dir.path())));
    assert_eq!(plain.layers[0].channel("A"), None);
}

#[test]
fn a_crop_says_where_it_lies_and_keeps_the_lens() {
    let dir = folder();
    let (_, part) = exr(dir.path(), &format!("{CORNELL} --size 32x24 --spp 1 --crop 5,6,10,8"));
    let window = part.window.expect("a window");
    assert_eq!((window.picture, window.origin, part.width, part.height), ([32, 24], [5, 6], 10, 8));
    let shown = |more: &str| png(dir.path(), &format!("--vignette 0.9 {more}"));
    let (whole, part) = (shown(""), shown("--crop 0,0,9,7"));
    for y in 0..7 {
        for x in 0..9 {
            assert_eq!(red(&part, x, y), red(&whole, x, y), "{x} {y}");
        }
    }
}
