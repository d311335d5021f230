//! A picture is the same bits whatever the threads, the instructions, the run and the order of its parts.

use lumbre_core::film::{Crop, Film};
use lumbre_cpu::bvh::SimdLevel;
use lumbre_testkit::ready::{Ready, asset, open};
use std::ops::Range;

const SPP: u32 = 8;

/// Our own Cornell box: textures, glass, metal, an area light.
fn cornell() -> Ready {
    open(&asset("cornell.glb"), 4.0 / 3.0)
}

fn render(ready: &Ready, samples: Range<u32>) -> Film {
    ready.film([64, 48], samples)
}

fn render_with_threads(view: &Ready, threads: usize) -> Film {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
    pool.install(|| {
        assert_eq!(rayon::current_num_threads(), threads);
        render(view, 0..SPP)
    })
}

/// Says where two films part, which is more than `assert_eq` of thousands of pixels could.
fn assert_same(a: &Film, b: &Film, what: &str) {
    let differ = a.pixels().iter().zip(b.pixels()).filter(|(a, b)| a != b).count();
    assert!(a == b, "{what}: {differ} of {} pixels differ", a.pixels().len());
}

#[test]
fn threads_and_runs_do_not_matter() {
    let view = cornell();
    let one = render_with_threads(&view, 1);
    assert!(one.radiance().iter().filter(|p| p.max_component() > 0.01).count() > 2000, "a picture");
    for threads in [1, 2, 3] {
        assert_same(&one, &render_with_threads(&view, threads), &format!("{threads} threads"));
    }
    // A scene loaded and built again.
    assert_same(&one, &render_with_threads(&cornell(), 2), "second run");
}

#[test]
fn instructions_do_not_matter() {
    let mut view = cornell();
    let best = render(&view, 0..SPP);
    for level in SimdLevel::ALL {
        if !level.is_supported() {
            println!("skipped: this processor lacks {}", level.name());
            continue;
        }
        view.backend = view.backend.with_level(level);
        assert_same(&best, &render(&view, 0..SPP), level.name());
    }
}

#[test]
fn parts_add_to_the_whole_in_any_order() {
    let view = cornell();
    let whole = render(&view, 0..64);
    let parts: Vec<Film> = [0..5, 5..32, 32..33, 33..64].map(|r| render(&view, r)).into();
    let mut halves = render(&view, 0..32);
    halves.merge(&render(&view, 32..64));
    assert_same(&whole, &halves, "two halves");
    for order in [[0, 1, 2, 3], [3, 1, 0, 2], [2, 3, 1, 0]] {
        let mut sum = Film::new(64, 48);
        order.into_iter().for_each(|i: usize| sum.merge(&parts[i]));
        assert_same(&whole, &sum, &format!("parts in the order {order:?}"));
    }
    // Sums of sums.
    let (mut left, mut right) = (parts[1].clone(), parts[3].clone());
    left.merge(&parts[2]);
    right.merge(&parts[0]);
    right.merge(&left);
    assert_same(&whole, &right, "sums of sums");
}

/// A part of the picture, across tiles and at the edge, is what the whole shows there.
#[test]
fn a_crop_is_cut_from_the_whole() {
    let view = cornell();
    let whole = render(&view, 0..SPP);
    for (origin, size) in [([5, 9], [33, 20]), ([63, 47], [1, 1]), ([0, 30], [64, 18])] {
        let mut part = Film::window([64, 48], Crop { origin, size });
        view.backend.render(&view.view, 0..SPP, &mut part, &());
        for y in 0..size[1] {
            for x in 0..size[0] {
                assert_eq!(part.pixel(x, y), whole.pixel(origin[0] + x, origin[1] + y), "{x}, {y}");
            }
        }
        assert!(part.pixels().iter().all(|p| p.samples() == SPP));
    }
}

/// The same comparison tells films apart that ought to differ: another seed, another frame, other samples, one sample more.
#[test]
fn other_samples_give_other_bits() {
    let view = cornell();
    let film = render(&view, 0..SPP);
    let mut other = cornell();
    other.view.settings.seed += 1;
    assert_ne!(film, render(&other, 0..SPP), "seed");
    let mut other = cornell();
    other.view.frame += 1;
    assert_ne!(film, render(&other, 0..SPP), "frame");
    assert_ne!(film, render(&view, SPP..2 * SPP), "other samples");
    assert_ne!(film, render(&view, 0..SPP + 1), "one sample more");
}
