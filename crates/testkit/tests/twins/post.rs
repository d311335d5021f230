//! The passes of `glsl/post` against `lumbre::output`: the same film, developed on both sides.

use super::columns::Numbers;
use bytemuck::pod_read_unaligned;
use lumbre::output::{Look, develop};
use lumbre_core::color::{Exposure, exposure_eased};
use lumbre_core::film::{Crop, Film, FilmSample};
use lumbre_core::rgb::Rgb;
use lumbre_core::tone::ToneCurve;
use lumbre_shaders::post::PostLook;
use lumbre_testkit::TestGpu;
use lumbre_vulkan::{Buffer, Post, Purpose, Upload};

/// Largest relative difference of exposure factors: sums of up to a thousand luminances, and a logarithm.
const FACTOR_TOLERANCE: f32 = 5e-6;

const PLAIN: Look = Look {
    exposure: Exposure::Auto,
    tone: ToneCurve::Srgb,
    vignette: 0.0,
    aberration: 0.0,
    transparent: false,
};

/// A picture of soft shapes, some noise, a black part and a few very bright pixels; three samples a pixel.
fn film(picture: [u32; 2], crop: Crop, scale: f32) -> Film {
    let mut film = Film::window(picture, crop);
    for y in 0..crop.size[1] {
        for x in 0..crop.size[0] {
            let n = &mut Numbers::new(y * 10_000 + x);
            let wave = |k: f32| 0.5 + 0.5 * (k * x as f32 + 0.07 * y as f32).sin();
            let lit = if x < crop.size[0] / 8 { 0.0 } else { scale };
            let spark = if n.below(500) == 0 { 1e4 } else { 1.0 };
            for index in 0..3 {
                let color = Rgb::new(wave(0.05), wave(0.11), 0.2 * wave(0.31)) * (lit * spark * n.unit());
                let alpha = (1.5 * wave(0.02) - 0.25).clamp(0.0, 1.0);
                film.add([x, y], index, &FilmSample { radiance: color * alpha, first_hit: None, alpha });
            }
        }
    }
    film
}

/// What the GPU makes of films of one size that follow one another: pictures and exposure factors.
fn developed(gpu: &TestGpu, films: &[&Film], look: &Look, ease: f32) -> Vec<(Vec<u8>, f32)> {
    let size = films[0].crop().size;
    let post = Post::new(gpu, size).unwrap();
    let bytes = 4 * u64::from(size[0]) * u64::from(size[1]);
    let (picture, factor) = (
        Buffer::new(gpu, "picture", bytes, Purpose::Readback).unwrap(),
        Buffer::new(gpu, "factor", 8, Purpose::Readback).unwrap(),
    );
    let look = PostLook {
        exposure: look.exposure,
        offset: 1.0,
        ease,
        tone: look.tone,
        vignette: look.vignette,
        aberration: look.aberration,
        transparent: look.transparent,
    };
    let develop = |film: &&Film| {
        let mut upload = Upload::new(gpu);
        let sums = Buffer::with_content(&mut upload, "film", bytemuck::cast_slice(film.pixels())).unwrap();
        upload.finish().unwrap();
        gpu.run("developing", |commands| {
            post.record(commands, sums.address(), film.picture_size(), film.crop(), &look);
            commands.copy((post.display(), 0), (&picture, 0), bytes);
            commands.copy((post.exposure(), 0), (&factor, 0), 8);
            Ok(())
        })
        .unwrap();
        (picture.read().to_vec(), pod_read_unaligned(&factor.read()[..4]))
    };
    films.iter().map(develop).collect()
}

/// The host's picture as four bytes a pixel.
fn expected(film: &Film, look: &Look) -> Vec<u8> {
    let image = develop(film, look);
    let full = |p: &[u8]| [p[0], p[1], p[2], if image.has_alpha { p[3] } else { 255 }];
    image.bytes.chunks_exact(if image.has_alpha { 4 } else { 3 }).flat_map(full).collect()
}

/// How many bytes differ, and the largest difference.
fn differing(a: &[u8], b: &[u8]) -> (usize, u8) {
    assert_eq!(a.len(), b.len());
    let differences = a.iter().zip(b).map(|(a, b)| a.abs_diff(*b));
    differences.fold((0, 0), |(n, most), d| (n + usize::from(d > 0), most.max(d)))
}

fn looks() -> Vec<Look> {
    let curves = ToneCurve::ALL.map(|tone| Look { tone, ..PLAIN });
    let mut all = curves.to_vec();
    all.push(Look { exposure: Exposure::Thesis, vignette: 0.7, ..PLAIN });
    all.push(Look { exposure: Exposure::Ev(-1.5), aberration: 2.5, ..PLAIN });
    all.push(Look { aberration: -4.0, vignette: 0.3, transparent: true, tone: ToneCurve::Agx, ..PLAIN });
    all.push(Look { transparent: true, ..PLAIN });
    all
}

/// A whole picture; part of one, higher than wide; one with blocks of a single pixel.
fn films() -> Vec<Film> {
    let whole = |size| Crop { origin: [0, 0], size };
    vec![
        film([203, 117], whole([203, 117]), 3.0),
        film([300, 200], Crop { origin: [190, 20], size: [90, 170] }, 0.01),
        film([37, 9], whole([37, 9]), 1e3),
    ]
}

#[test]
fn pictures_are_the_same() {
    let Some(gpu) = lumbre_testkit::gpu() else { return };
    for film in &films() {
        for look in &looks() {
            let (picture, factor) = developed(&gpu, &[film], look, 1.0).remove(0);
            let want = look.exposure_factor(film);
            assert!((factor / want - 1.0).abs() < FACTOR_TOLERANCE, "{look:?}: {factor} for {want}");
            let (n, most) = differing(&picture, &expected(film, look));
            // Values that lie at the edge between two codes.
            assert!(most <= 1 && n * 500 <= picture.len(), "{look:?}: {n} of {}, by {most}", picture.len());
        }
    }
}

/// A hundredth more light, another curve, lens or alpha: most bytes differ.
#[test]
fn other_pictures_are_found() {
    let Some(gpu) = lumbre_testkit::gpu() else { return };
    let film = &films()[0];
    let (picture, factor) = developed(&gpu, &[film], &PLAIN, 1.0).remove(0);
    let found = |look: Look| differing(&picture, &expected(film, &look)).0;
    let brighter = Exposure::Ev((1.01 * factor).log2());
    assert!((factor / brighter.factor(&[], 1) - 1.0).abs() > 100.0 * FACTOR_TOLERANCE);
    let others = [
        Look { exposure: brighter, ..PLAIN },
        Look { tone: ToneCurve::Linear, ..PLAIN },
        Look { vignette: 0.05, ..PLAIN },
        Look { aberration: 0.2, ..PLAIN },
        Look { transparent: true, ..PLAIN },
    ];
    for look in others {
        assert!(found(look) * 10 > picture.len(), "{look:?}: {} of {}", found(look), picture.len());
    }
}

/// Frame by frame the exposure goes its share of the way, from the first frame's on.
#[test]
fn exposure_eases_from_frame_to_frame() {
    let Some(gpu) = lumbre_testkit::gpu() else { return };
    let crop = Crop { origin: [0, 0], size: [64, 48] };
    let [dark, bright] = [0.1, 20.0].map(|scale| film([64, 48], crop, scale));
    let frames = [&dark, &bright, &bright, &dark];
    let got = developed(&gpu, &frames, &PLAIN, 0.25);
    let mut factor = PLAIN.exposure_factor(&dark);
    let first = factor;
    for (film, (_, got)) in frames.iter().zip(&got) {
        factor = exposure_eased(factor, PLAIN.exposure_factor(film), 0.25);
        assert!((got / factor - 1.0).abs() < 4.0 * FACTOR_TOLERANCE, "{got} for {factor}");
    }
    assert!(factor < 0.5 * first, "it moves: {factor} from {first}");
}

/// Black pictures keep a factor of 1, and nothing of them is no number.
#[test]
fn nothing_lit_is_black() {
    let Some(gpu) = lumbre_testkit::gpu() else { return };
    let crop = Crop { origin: [0, 0], size: [50, 40] };
    let black = [film([50, 40], crop, 0.0), Film::new(50, 40)];
    for film in &black {
        let (picture, factor) = developed(&gpu, &[film], &PLAIN, 1.0).remove(0);
        assert_eq!((factor, PLAIN.exposure_factor(film)), (1.0, 1.0));
        assert_eq!(picture, expected(film, &PLAIN));
    }
}
