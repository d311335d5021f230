//! Parts of a render, made apart, add up to the bits of one run; parts that do not belong together are refused; damaged ones
//! do no harm.

use lumbre::core::film::Crop;
use lumbre::fingerprint::{Fingerprint, SceneHash};
use lumbre::io::{Limits, write_exr};
use lumbre::merge::{MergeError, Part, add_sums, merge, read_part};
use lumbre::output::to_exr;
use lumbre::prelude::*;
use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// A lit scene, ready to be drawn.
struct Studio {
    backend: Box<dyn Backend>,
    scene: SceneHash,
    view: View,
}

const SIZE: [u32; 2] = [24, 18];

impl Studio {
    fn new(seed: u32) -> Self {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/scenes/cornell.glb");
        let loaded = lumbre::load_scene(path, &LoadOptions::default()).unwrap();
        let compiled = lumbre::compile(&loaded.scene).unwrap().scene;
        let aspect = SIZE[0] as f32 / SIZE[1] as f32;
        let found = lumbre::find_camera(&loaded.scene, &compiled, &CameraOptions::default(), aspect).unwrap();
        let settings = RenderSettings { seed, ..RenderSettings::default() };
        let scene = SceneHash::new(&compiled);
        let backend = lumbre::prepare(compiled, Device::Cpu).unwrap();
        Studio { backend, scene, view: View { camera: found.camera, settings, frame: 0 } }
    }

    fn film(&self, samples: Range<u32>, crop: Crop, threads: usize) -> Film {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let mut film = Film::window(SIZE, crop);
        pool.install(|| self.backend.render(&self.view, samples, &mut film, &())).unwrap();
        film
    }

    /// Writes a part and returns its path.
    fn part(&self, dir: &Path, samples: Range<u32>, threads: usize) -> PathBuf {
        self.cropped(dir, samples, WHOLE, threads)
    }

    fn cropped(&self, dir: &Path, samples: Range<u32>, crop: Crop, threads: usize) -> PathBuf {
        let seed = self.view.settings.seed;
        let path = dir.join(format!("{seed}-{}-{}-{}.exr", samples.start, samples.end, crop.origin[0]));
        let film = self.film(samples.clone(), crop, threads);
        let made = ("seed".to_string(), seed.to_string());
        let mut image = to_exr(&film, false, vec![made]);
        let fingerprint = Fingerprint::new(self.scene, &self.view, SIZE, crop);
        assert_eq!(add_sums(&mut image, &film, fingerprint, samples.start), Some(samples));
        write_exr(&path, image).unwrap();
        path
    }
}

const WHOLE: Crop = Crop { origin: [0, 0], size: SIZE };

fn limits() -> Limits {
    Limits::default()
}

/// The file that a part makes.
fn written(part: &Part, path: &Path) -> Vec<u8> {
    let mut image = to_exr(&part.film, false, part.metadata.clone());
    add_sums(&mut image, &part.film, part.fingerprint, part.samples.start).unwrap();
    write_exr(path, image).unwrap();
    fs::read(path).unwrap()
}

#[test]
fn eight_parts_in_any_order_are_one_run() {
    let dir = tempfile::tempdir().unwrap();
    let studio = Studio::new(3);
    let one = studio.part(dir.path(), 0..21, 2);
    let whole = read_part(&one, &limits()).unwrap();
    assert_eq!(whole.film, studio.film(0..21, WHOLE, 1), "a part is its film to the bit");
    // Parts of different lengths; two made by other numbers of threads.
    let ends = [0, 1, 2, 5, 9, 10, 14, 20, 21];
    let threads = [1, 1, 3, 1, 1, 2, 1, 1];
    let parts: Vec<PathBuf> =
        (0..8).map(|i| studio.part(dir.path(), ends[i]..ends[i + 1], threads[i])).collect();
    for order in [[7, 2, 5, 0, 3, 6, 1, 4], [0, 1, 2, 3, 4, 5, 6, 7], [4, 3, 7, 1, 0, 6, 2, 5]] {
        let paths = order.map(|i| &parts[i]);
        let sum = merge(&paths, &limits()).unwrap();
        assert_eq!(sum, whole, "{order:?}");
        assert!(written(&sum, &dir.path().join("sum.exr")) == fs::read(&one).unwrap(), "{order:?}");
    }
    // Sums of parts are parts.
    let halves = [&parts[..3], &parts[3..]].map(|half| {
        let sum = merge(half, &limits()).unwrap();
        let path = dir.path().join(format!("half-{}.exr", sum.samples.start));
        written(&sum, &path);
        path
    });
    assert_eq!(merge(&halves, &limits()).unwrap(), whole);
}

/// That the comparison above can fail: another sample, another seed, one bit.
#[test]
fn other_samples_are_another_sum() {
    let dir = tempfile::tempdir().unwrap();
    let (a, b) = (Studio::new(3), Studio::new(4));
    let film = a.film(0..4, WHOLE, 1);
    assert_ne!(film, a.film(1..5, WHOLE, 1));
    assert_ne!(film, b.film(0..4, WHOLE, 1));
    let path = a.part(dir.path(), 0..4, 1);
    let mut part = read_part(&path, &limits()).unwrap();
    let mut state = lumbre::core::film::state::FilmState {
        picture: SIZE,
        crop: WHOLE,
        pixels: part.film.pixels().to_vec(),
        non_finite_count: 0,
        non_finite: vec![],
    };
    let mut words = state.pixels[77].to_words();
    words[0] ^= 1;
    state.pixels[77] = lumbre::core::film::PixelSums::from_words(&words);
    part.film = Film::restore(state).unwrap();
    assert_ne!(part, read_part(&path, &limits()).unwrap());
    assert!(written(&part, &dir.path().join("b.exr")) != fs::read(path).unwrap());
}

#[test]
fn a_part_of_a_picture_merges_with_its_like() {
    let dir = tempfile::tempdir().unwrap();
    let studio = Studio::new(0);
    let crop = Crop { origin: [5, 2], size: [7, 9] };
    let parts = [4..8, 0..4].map(|s| studio.cropped(dir.path(), s, crop, 1));
    assert_eq!(merge(&parts, &limits()).unwrap().film, studio.film(0..8, crop, 1));
    let other = studio.cropped(dir.path(), 8..9, Crop { origin: [6, 2], size: [7, 9] }, 1);
    assert!(matches!(merge(&[&parts[0], &other], &limits()), Err(MergeError::Foreign { .. })));
}

#[test]
fn what_does_not_belong_together_is_refused() {
    let dir = tempfile::tempdir().unwrap();
    let (studio, other) = (Studio::new(3), Studio::new(4));
    let part = |samples| studio.part(dir.path(), samples, 1);
    let (a, b, c) = (part(0..4), part(4..6), part(3..5));
    let d = part(7..8);
    let foreign = other.part(dir.path(), 4..6, 1);
    let says = |paths: &[&PathBuf], text: &str| {
        let e = merge(paths, &limits()).unwrap_err();
        let shown = e.to_string().replace(&format!("{}/", dir.path().display()), "");
        assert_eq!(shown, text);
        assert!(!shown.contains('\n'));
    };
    says(&[&a, &c], "3-0-4-0.exr (samples 0 to 3) and 3-3-5-0.exr (samples 3 to 4) have samples in common");
    says(
        &[&b, &a, &b],
        "3-4-6-0.exr (samples 4 to 5) and 3-4-6-0.exr (samples 4 to 5) have samples in common",
    );
    says(
        &[&d, &a, &b],
        "sample 6 is missing between 3-4-6-0.exr (samples 4 to 5) and 3-7-8-0.exr (sample 7)",
    );
    says(
        &[&a, &foreign],
        "4-4-6-0.exr: is not of the same render as 3-0-4-0.exr: seed is \"3\" there and \"4\" here",
    );
    says(&[], "there are no parts");
    let plain = dir.path().join("plain.exr");
    write_exr(&plain, to_exr(&studio.film(0..1, WHOLE, 1), false, vec![])).unwrap();
    says(&[&a, &plain], "plain.exr: carries no exact sums");
    // Each of them merges with what it fits to.
    merge(&[&a, &b], &limits()).unwrap();
    merge(&[&c], &limits()).unwrap();
}

#[test]
fn a_render_that_was_interrupted_is_no_part() {
    let studio = Studio::new(3);
    let mut film = studio.film(0..2, WHOLE, 1);
    film.add([3, 3], 2, &Default::default());
    let mut image = to_exr(&film, false, vec![]);
    let plain = image.clone();
    let fingerprint = Fingerprint::new(studio.scene, &studio.view, SIZE, WHOLE);
    assert_eq!(add_sums(&mut image, &film, fingerprint, 0), None);
    assert_eq!(add_sums(&mut image, &Film::new(24, 18), fingerprint, 0), None);
    assert_eq!(add_sums(&mut image, &studio.film(0..2, WHOLE, 1), fingerprint, u32::MAX), None);
    assert_eq!(image, plain, "nothing is added");
}

#[test]
fn samples_that_are_not_finite_come_through() {
    let dir = tempfile::tempdir().unwrap();
    let studio = Studio::new(3);
    let fingerprint = Fingerprint::new(studio.scene, &studio.view, SIZE, WHOLE);
    let with_bad = |samples: Range<u32>, bad: &[[u32; 2]]| {
        let mut film = Film::new(SIZE[0], SIZE[1]);
        for i in 0..SIZE[0] * SIZE[1] {
            for s in samples.clone() {
                let at = [i % SIZE[0], i / SIZE[0]];
                let value = if s == samples.start && bad.contains(&at) { f32::NAN } else { 0.5 };
                let sample = lumbre::core::film::FilmSample {
                    radiance: Rgb::splat(value),
                    first_hit: None,
                    alpha: 1.0,
                };
                film.add(at, s, &sample);
            }
        }
        let path = dir.path().join(format!("{}.exr", samples.start));
        let mut image = to_exr(&film, false, vec![]);
        add_sums(&mut image, &film, fingerprint, samples.start).unwrap();
        write_exr(&path, image).unwrap();
        path
    };
    let row: Vec<[u32; 2]> = (0..20).map(|x| [x, 4]).collect();
    let parts = [with_bad(0..2, &row), with_bad(2..4, &[[3, 3], [23, 17]])];
    let sum = merge(&parts, &limits()).unwrap().film;
    assert_eq!(sum.non_finite_count(), 22);
    assert_eq!(sum.non_finite().len(), 16);
    assert_eq!(sum.non_finite()[0].row_column, [3, 3]);
    assert_eq!(sum.non_finite()[0].sample, 2);
}

/// SplitMix64 (Steele et al. 2014).
struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % n as u64) as usize
    }
}

/// Bytes of parts are changed, most of them in the header, where claims are made.
#[test]
fn damaged_parts_are_refused_or_read_and_nothing_else() {
    let dir = tempfile::tempdir().unwrap();
    let studio = Studio::new(3);
    let crop = Crop { origin: [3, 4], size: [6, 5] };
    let good = studio.cropped(dir.path(), 0..2, crop, 1);
    let original = fs::read(&good).unwrap();
    let path = dir.path().join("bad.exr");
    // Messages of foreign decoders that give up would fill the screen.
    let silent = |info: &std::panic::PanicHookInfo<'_>| {
        if !lumbre::io::decoder_is_running() {
            eprintln!("{info}");
        }
    };
    std::panic::set_hook(Box::new(silent));
    let mut random = Random(20);
    let (mut refused, mut read) = (0, 0);
    for _ in 0..1500 {
        let mut bytes = original.clone();
        let within = if random.below(4) == 0 { bytes.len() } else { 4000.min(bytes.len()) };
        for _ in 0..=random.below(2) {
            let at = random.below(within);
            match random.below(4) {
                0 => bytes[at] ^= 1 << random.below(8),
                1 => bytes[at] = [0, 1, 0x7f, 0x80, 0xff, b'0', b'9', b'.'][random.below(8)],
                2 => {
                    if let Some(digit) = bytes[at..].iter_mut().find(|b| b.is_ascii_digit()) {
                        *digit = b'0' + random.below(10) as u8;
                    }
                }
                _ => {
                    let end = bytes.len().min(at + random.below(5));
                    bytes[at..end].fill(0xff);
                }
            }
        }
        fs::write(&path, &bytes).unwrap();
        let outcome = merge(&[&path, &good], &Limits { max_image_bytes: 1 << 24, ..limits() });
        match read_part(&path, &limits()) {
            Ok(part) => {
                read += 1;
                assert_eq!(part.film.even_samples().map(|n| n as usize), Some(part.samples.len()));
                assert!(outcome.is_err() || part.samples != (0..2), "{:?} merged twice", part.samples);
            }
            Err(e) => {
                refused += 1;
                assert!(e.to_string().contains("bad.exr") && !e.to_string().contains('\n'), "{e}");
            }
        }
    }
    let _ = std::panic::take_hook();
    assert!(refused > 300 && read > 50, "{refused} refused, {read} read");
}

/// Sums that are sound as a file and can be those of no film.
#[test]
fn false_claims_are_named() {
    let dir = tempfile::tempdir().unwrap();
    let studio = Studio::new(3);
    let good = studio.part(dir.path(), 2..4, 1);
    let image = lumbre::io::read_exr(&good, &limits()).unwrap();
    let path = dir.path().join("bad.exr");
    let says = |change: &dyn Fn(&mut lumbre::io::ExrImage), why: &str| {
        let mut bad = image.clone();
        change(&mut bad);
        write_exr(&path, bad).unwrap();
        let e = read_part(&path, &limits()).unwrap_err().to_string();
        assert!(e.ends_with(why), "{e}");
    };
    let set = |name: &'static str, value: &'static str| {
        move |i: &mut lumbre::io::ExrImage| {
            let entry = i.metadata.iter_mut().find(|(n, _)| n == name).unwrap();
            entry.1 = value.into();
        }
    };
    for wrong in ["4..2", "2..2", "2..5000000000", "-1..2", "2", ""] {
        says(&set("lumbre.part.samples", wrong), "their range of samples");
    }
    says(&set("lumbre.part.samples", "2..5"), "a pixel has another number of samples");
    says(&set("lumbre.part.fingerprint", "12"), "a fingerprint is 32 digits to base 16");
    for wrong in ["0", "x:", "1: 1,2", "1: 1,2,3,4", "-1:"] {
        says(&set("lumbre.part.nonFinite", wrong), "the list of samples that are not finite");
    }
    says(&set("lumbre.part.nonFinite", "1: 1,2,9"), "is not in their range");
    says(&set("lumbre.part.nonFinite", "1: 99,2,3"), "no film can have them");
    says(&set("lumbre.part.nonFinite", "99999999: 1,2,3"), "no film can have them");
    says(&|i| drop(i.whole.pop()), "channels are missing");
    says(
        &|i| i.whole.iter_mut().find(|(n, _)| n == "sums.counts.H").unwrap().1[0] = 9,
        "no film can have them",
    );
    let window = |origin, picture| Some(lumbre::io::ExrWindow { origin, picture });
    says(&|i| i.window = window([-1, 0], [40, 40]), "they lie outside of the picture");
    says(&|i| i.window = window([1, 0], [24, 18]), "no film can have them");
    says(&|i| i.metadata.retain(|(n, _)| !n.ends_with("samples")), "carries no exact sums");
}
