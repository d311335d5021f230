//! What happens around the picture: a device lost in the middle, parts of two devices added, scenes that come and go.

use crate::common::{Both, compile, on_cpu};
use crate::scenes::{lamps, lamps_view, look, sky};
use glam::Vec3;
use lumbre_core::Film;
use lumbre_core::control::{Control, Progress};
use lumbre_core::film::Crop;
use lumbre_core::settings::View;
use lumbre_cpu::CpuBackend;
use lumbre_scene::{CompiledScene, Material, Scene};
use lumbre_testkit::measure::grey;
use lumbre_testkit::own_gpu;
use lumbre_testkit::paired::{Bounds, Paired};
use lumbre_testkit::shapes::{add, icosphere};
use lumbre_vulkan::{Gpu, SceneOptions, VulkanBackend, VulkanError};
use std::sync::atomic::{AtomicU32, Ordering};

/// A grey ball under a sky, whose pipeline is soon made.
fn ball() -> (CompiledScene, View) {
    let mut scene = Scene { environment: sky(1.0), ..Scene::default() };
    add(&mut scene, icosphere(Vec3::ZERO, 1.0, 2), Material::diffuse(grey(0.5)));
    (compile(&scene), look(Vec3::Z * 5.0, Vec3::ZERO, 0.6, 1.5))
}

/// Loses the device when the first piece of a render is done.
struct Loses<'a> {
    gpu: &'a Gpu,
    pieces: AtomicU32,
}

impl Control for Loses<'_> {
    fn progress(&self, _: Progress) {
        if self.pieces.fetch_add(1, Ordering::Relaxed) == 0 {
            self.gpu.lose_after(1);
        }
    }
}

/// The film is as it was before, the error says what happened, and another backend goes on from there.
#[test]
fn a_device_lost_in_the_middle() {
    let Some(gpu) = own_gpu() else { return };
    let (scene, view) = ball();
    let backend = VulkanBackend::new(&gpu, &scene, SceneOptions::default()).expect("the scene fits");
    let size = [96, 64];
    let mut film = Film::new(size[0], size[1]);
    backend.render(&view, 0..1, &mut film, &()).expect("nothing is lost yet");
    let before = film.clone();
    assert_eq!(before.pixel(0, 0).samples(), 1);
    let loses = Loses { gpu: &gpu, pieces: AtomicU32::new(0) };
    // More pieces than one by far: it is the middle.
    let error = backend.render(&view, 1..4096, &mut film, &loses).expect_err("the device is lost");
    assert!(loses.pieces.load(Ordering::Relaxed) >= 1, "a piece was done");
    assert_eq!(error, VulkanError::DeviceLost);
    assert!(error.to_string().contains("lost"), "{error}");
    assert!(film == before, "what the lost render brought is thrown away whole");
    // It stays lost, for the library too.
    let error = lumbre::Backend::render(&backend, &view, 1..2, &mut film, &()).expect_err("it stays lost");
    assert_eq!(error.device, gpu.adapter().name);
    assert!(error.reason.contains("lost") && film == before, "{error}");
    let cpu = CpuBackend::new(scene);
    cpu.render(&view, 1..4, &mut film, &());
    let mut whole = Film::new(size[0], size[1]);
    cpu.render(&view, 0..4, &mut whole, &());
    assert_agree(whole, film);
}

fn assert_agree(a: Film, b: Film) {
    let counts = |f: &Film| f.pixels().iter().map(|p| p.samples()).collect::<Vec<_>>();
    assert_eq!(counts(&a), counts(&b));
    let paired = Paired::new(&[(a, b)], &Bounds::PLAIN);
    let faults = paired.faults(&Bounds::PLAIN);
    assert!(faults.is_empty(), "{paired}: {}", faults.join("; "));
}

/// Samples of the CPU and samples of the GPU add to the picture of all of them, in any order; twice the same ones do not.
#[test]
fn parts_of_two_devices_add() {
    let Some(both) = Both::new(compile(&lamps())) else { return };
    let (size, view) = ([48, 36], lamps_view(4.0 / 3.0));
    let part = |samples: std::ops::Range<u32>, on_gpu: bool| {
        let mut film = Film::new(size[0], size[1]);
        if on_gpu {
            both.vulkan.render(&view, samples, &mut film, &()).expect("the GPU renders");
        } else {
            both.cpu.render(&view, samples, &mut film, &());
        }
        film
    };
    let sum = |mut a: Film, b: &Film| {
        a.merge(b);
        a
    };
    let whole = part(0..6, false);
    let first = sum(part(0..4, false), &part(4..6, true));
    let second = sum(part(2..6, true), &part(0..2, false));
    assert_agree(whole.clone(), first);
    assert_agree(whole.clone(), second);
    let again = sum(part(0..3, false), &part(0..3, true));
    let paired = Paired::new(&[(whole, again)], &Bounds::PLAIN);
    assert!(!paired.faults(&Bounds::PLAIN).is_empty(), "{paired}");
    // To a film that holds something the GPU adds as well, to the bit.
    let mut film = part(0..2, false);
    both.vulkan.render(&view, 2..6, &mut film, &()).expect("the GPU renders");
    assert!(film == sum(part(0..2, false), &part(2..6, true)));
    assert!(on_cpu(&both.cpu, &view, &Film::new(48, 36), 1)[0] == part(0..1, false));
}

/// Many samples of many pixels at once, of an odd number of rows and columns and in as many pieces as it takes, are to the bit what the
/// samples are one by one, and a part of the picture is that part of it.
#[test]
fn pieces_make_no_difference() {
    let Some(both) = Both::new(compile(&lamps())) else { return };
    let (size, view) = ([51, 37], lamps_view(51.0 / 37.0));
    let at_once = |mut film: Film| {
        both.vulkan.render(&view, 3..10, &mut film, &()).expect("the GPU renders");
        film
    };
    let whole = at_once(Film::new(size[0], size[1]));
    let mut one_by_one = Film::new(size[0], size[1]);
    for sample in (3..10).rev() {
        both.vulkan.render(&view, sample..sample + 1, &mut one_by_one, &()).expect("the GPU renders");
    }
    assert!(whole == one_by_one);
    let crop = Crop { origin: [13, 5], size: [17, 29] };
    let window = at_once(Film::window(size, crop));
    for (i, p) in window.pixels().iter().enumerate() {
        let (x, y) = (i as u32 % crop.size[0], i as u32 / crop.size[0]);
        assert!(p == whole.pixel(crop.origin[0] + x, crop.origin[1] + y), "{x}, {y}");
    }
}

/// A scene comes and goes twenty times, and nothing of it stays. Drivers that compute on the processor take long to make pipelines: there
/// only some of the scenes are drawn.
#[test]
fn scenes_come_and_go() {
    let Some(gpu) = own_gpu() else { return };
    let (scene, view) = ball();
    let before = gpu.memory();
    let mut reserved = Vec::new();
    for turn in 0..20 {
        let backend = VulkanBackend::new(&gpu, &scene, SceneOptions::default()).expect("the scene fits");
        assert!(gpu.memory().pieces > before.pieces && gpu.memory().allocated > before.allocated);
        if gpu.is_real() || turn % 10 == 0 {
            let mut film = Film::new(48, 32);
            backend.render(&view, 0..1, &mut film, &()).expect("the GPU renders");
        }
        drop(backend);
        let after = gpu.memory();
        assert_eq!((after.pieces, after.allocated), (before.pieces, before.allocated), "turn {turn}");
        reserved.push(after.reserved);
    }
    assert!(reserved.iter().all(|r| *r <= reserved[0]), "blocks of memory add up: {reserved:?}");
}
