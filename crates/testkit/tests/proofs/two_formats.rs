//! The Cornell room as glTF and as OBJ with MTL, made from one model: the same random numbers give nearly the same picture, within what
//! it means that positions which a node moves in glTF are rounded before they are traced in OBJ. A lamp of OBJ has a back that shines too.

use lumbre::LoadOptions;
use lumbre_core::Rgb;
use lumbre_cpu::CpuBackend;
use lumbre_scene::{Material, Scene};
use lumbre_testkit::ready::{Ready, asset, open};

const SIZE: [u32; 2] = [48, 36];
const SPP: u32 = 32;

fn of_glb() -> Ready {
    open(&asset("cornell.glb"), 4.0 / 3.0)
}

fn material<'a>(scene: &'a mut Scene, name: &str) -> &'a mut Material {
    scene.materials.iter_mut().find(|m| m.name == name).expect("a material of that name")
}

/// The lamp shines from its front only, as it does in glTF.
fn one_sided(scene: &mut Scene) {
    material(scene, "lamp").double_sided = false;
}

/// The room as OBJ, changed by `change`, from where the other one is seen.
fn of_obj(change: impl FnOnce(&mut Scene)) -> Ready {
    let mut loaded =
        lumbre::load_scene(asset("cornell.obj"), &LoadOptions::default()).unwrap_or_else(|e| panic!("{e}"));
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
    change(&mut loaded.scene);
    let scene = lumbre::compile(&loaded.scene).expect("the scene compiles").scene;
    Ready { backend: CpuBackend::new(scene), view: of_glb().view }
}

/// The relative difference of the means over both pictures, and the share of pixels that agree within 2 %.
fn difference(obj: &Ready) -> (f64, f64) {
    let pixels = |ready: &Ready| ready.film(SIZE, 0..SPP).radiance();
    let (a, b) = (pixels(&of_glb()), pixels(obj));
    let sum = |colors: &[Rgb]| colors.iter().map(|c| f64::from(c.average())).sum::<f64>();
    let close = |(a, b): &(&Rgb, &Rgb)| (a.average() - b.average()).abs() <= 0.02 * a.average();
    let share = a.iter().zip(&b).filter(close).count() as f64 / a.len() as f64;
    ((sum(&b) / sum(&a) - 1.0).abs(), share)
}

#[test]
fn the_cornell_room_is_the_same_in_both_formats() {
    let (means, close) = difference(&of_obj(one_sided));
    println!("means differ by {means:.5}, {:.2} % of the pixels agree", 100.0 * close);
    assert!(means < 1e-4 && close > 0.999, "{means} {close}");
    // What the lamp's back sends through the gap of a millimetre above it.
    let (means, close) = difference(&of_obj(|_| ()));
    println!("with the lamp's back by {means:.5}, {:.2} %", 100.0 * close);
    assert!((0.001..0.008).contains(&means) && close > 0.97, "{means} {close}");
}

#[test]
fn a_wall_of_another_colour_is_noticed() {
    let (means, close) = difference(&of_obj(|scene| {
        one_sided(scene);
        let wall = material(scene, "back_wall");
        wall.base_color *= 0.97;
    }));
    println!("means differ by {means:.5}, {:.2} % of the pixels agree", 100.0 * close);
    assert!(means > 0.001 && close < 0.9, "{means} {close}");
}
