//! An error of 1 % in any one material, light, camera or filter, on one side only, fails the paired test.
//!
//! The GPU draws each scene as it is; errors are planted into what the CPU draws, so that no pipeline is made for them.

use crate::common::{Both, Shot, compile, on_cpu};
use crate::scenes::{lamps, lamps_view, look, samples, samples_view, solid};
use glam::{Mat4, Vec3};
use lumbre_core::filter::FilterKind;
use lumbre_core::settings::{RenderSettings, View};
use lumbre_core::{Film, Rgb};
use lumbre_cpu::CpuBackend;
use lumbre_scene::compiled::lights::kind;
use lumbre_scene::compiled::material::{LobesRecord, MaterialRecord};
use lumbre_scene::{
    Anisotropy, Clearcoat, CompiledScene, DiffuseTransmission, Iridescence, LightKind, Material, Phong,
    Scene, Sheen,
};
use lumbre_testkit::measure::grey;
use lumbre_testkit::paired::{Bounds, Paired};
use lumbre_testkit::shapes::{add, rectangle};
use std::sync::Arc;

/// Up to six materials' balls in a picture cover some 8 % of it each.
const SHOT: Shot = Shot { size: [36, 24], spp: 2, bounds: Bounds::PLAIN };

const MORE: f32 = 1.01;

/// What is wrong, and what makes it so.
type Plant<'a> = (&'a str, &'a dyn Fn(&mut CompiledScene, &mut View));

/// The scene agrees as it is and with none of the errors.
fn check(name: &str, scene: &Scene, view: &View, plants: &[Plant<'_>]) {
    let scene = compile(scene);
    let Some(both) = Both::new(scene.clone()) else { return };
    let empty = Film::new(SHOT.size[0], SHOT.size[1]);
    let gpu = both.on_gpu(view, &empty, SHOT.spp);
    let compare = |backend: &CpuBackend, view: &View| {
        let cpu = on_cpu(backend, view, &empty, SHOT.spp);
        let pairs: Vec<(Film, Film)> = cpu.into_iter().zip(gpu.clone()).collect();
        let paired = Paired::new(&pairs, &SHOT.bounds);
        (paired, paired.faults(&SHOT.bounds))
    };
    let (paired, mut faults) = compare(&both.cpu, view);
    println!("{name}: {paired}");
    for (what, plant) in plants {
        let (mut scene, mut view) = (scene.clone(), view.clone());
        plant(&mut scene, &mut view);
        let (paired, found) = compare(&CpuBackend::new(scene), &view);
        println!("{name}, {what}: {paired}");
        if found.is_empty() {
            faults.push(format!("{what}: 1 % more is not seen"));
        }
    }
    assert!(faults.is_empty(), "{name}:\n{}", faults.join("\n"));
}

/// A change of a material.
fn material(i: usize, change: impl Fn(&mut MaterialRecord)) -> impl Fn(&mut CompiledScene, &mut View) {
    move |scene, _| change(&mut scene.materials[i])
}

/// A change of its further lobes.
fn lobes(i: usize, change: impl Fn(&mut LobesRecord)) -> impl Fn(&mut CompiledScene, &mut View) {
    move |scene, _| change(&mut scene.lobes[scene.materials[i].lobes as usize])
}

fn plain(color: [f32; 3], metallic: f32, roughness: f32) -> Material {
    Material { base_color: Rgb::from_array(color), metallic, roughness, ..Material::default() }
}

#[test]
fn in_metals_and_plastics() {
    let scene = samples(&[
        (false, Material::diffuse(Rgb::new(0.7, 0.5, 0.3))),
        (false, Material { diffuse_roughness: 0.8, ..Material::diffuse(grey(0.7)) }),
        (false, plain([0.3, 0.4, 0.5], 0.0, 0.4)),
        (false, plain([0.9, 0.7, 0.4], 1.0, 0.4)),
        (false, plain([0.9, 0.8, 0.8], 1.0, 0.0)),
        (false, Material { specular_color: Rgb::new(1.0, 0.6, 0.3), ..plain([0.1; 3], 0.0, 0.1) }),
    ]);
    check(
        "metals and plastics",
        &scene,
        &samples_view(1.5),
        &[
            ("Lambert", &material(1, |m| m.base_color *= MORE)),
            ("Oren-Nayar", &lobes(2, |l| l.diffuse_roughness *= MORE)),
            ("base under a gloss", &material(3, |m| m.base_color *= MORE)),
            ("roughness of a gloss", &material(3, |m| m.roughness *= MORE)),
            ("index of a gloss", &material(3, |m| m.ior *= MORE)),
            ("gloss", &material(6, |m| m.specular_color *= MORE)),
            ("strength of a gloss", &material(6, |m| m.specular *= 0.99)),
            ("metal", &material(4, |m| m.base_color *= MORE)),
            ("roughness of metal", &material(4, |m| m.roughness *= MORE)),
            ("metal or not", &material(4, |m| m.metallic *= 0.99)),
            ("mirror", &material(5, |m| m.base_color *= MORE)),
        ],
    );
}

#[test]
fn in_glass() {
    let pane = Material { transmission: 1.0, double_sided: true, ..plain([0.8, 0.9, 0.7], 0.0, 0.0) };
    let scene = samples(&[
        (false, solid(1.5, 0.0, Rgb::new(0.5, 0.8, 0.6))),
        (false, solid(1.5, 0.3, grey(0.9))),
        // Far more than any glass has: of its colours, each path follows one, and few lie far from the middle.
        (false, Material { dispersion: 12.0, ..solid(1.5, 0.0, grey(0.9)) }),
        (true, pane.clone()),
        (true, Material { roughness: 0.4, ..pane.clone() }),
        (true, Material { transmission: 0.5, ..pane }),
    ]);
    check(
        "glass",
        &scene,
        &samples_view(1.5),
        &[
            ("index of a solid", &material(1, |m| m.ior *= MORE)),
            ("absorption", &material(1, |m| m.absorption *= MORE)),
            ("tint of a solid", &material(1, |m| m.base_color *= 0.99)),
            ("index of a rough solid", &material(2, |m| m.ior *= MORE)),
            ("roughness of a solid", &material(2, |m| m.roughness *= MORE)),
            ("tint of a rough solid", &material(2, |m| m.base_color *= 0.99)),
            ("dispersion", &lobes(3, |l| l.dispersion *= MORE)),
            ("tint of a pane", &material(4, |m| m.base_color *= MORE)),
            ("index of a pane", &material(4, |m| m.ior *= MORE)),
            ("roughness of a pane", &material(5, |m| m.roughness *= MORE)),
            ("tint of a rough pane", &material(5, |m| m.base_color *= MORE)),
            ("share that passes", &material(6, |m| m.transmission *= MORE)),
        ],
    );
}

#[test]
fn in_cloth_and_varnish() {
    let sheen = Sheen {
        color: Rgb::new(0.9, 0.7, 0.8),
        color_texture: None,
        roughness: 0.4,
        roughness_texture: None,
    };
    let coat = Clearcoat {
        factor: 0.8,
        texture: None,
        roughness: 0.2,
        roughness_texture: None,
        normal_texture: None,
        normal_scale: 1.0,
    };
    let leaf = DiffuseTransmission {
        factor: 0.6,
        texture: None,
        color: Rgb::new(0.4, 0.8, 0.3),
        color_texture: None,
    };
    let gloss =
        Phong { specular: Rgb::new(0.4, 0.3, 0.2), specular_texture: None, exponent: 30.0, fresnel: false };
    let scene = samples(&[
        (false, Material { sheen: Some(sheen), ..plain([0.1, 0.1, 0.3], 0.0, 0.9) }),
        (false, Material { clearcoat: Some(coat), ..plain([0.5, 0.1, 0.1], 0.0, 0.8) }),
        (
            false,
            Material { clearcoat: Some(Clearcoat { roughness: 0.0, ..coat }), ..plain([0.5; 3], 1.0, 0.5) },
        ),
        (true, Material { diffuse_transmission: Some(leaf), ..Material::diffuse(grey(0.5)) }),
        (false, Material { phong: Some(gloss), ..Material::diffuse(grey(0.3)) }),
        (false, Material { phong: Some(Phong { fresnel: true, ..gloss }), ..Material::diffuse(grey(0.2)) }),
    ]);
    check(
        "cloth and varnish",
        &scene,
        &samples_view(1.5),
        &[
            ("sheen", &lobes(1, |l| l.sheen_color *= MORE)),
            ("roughness of sheen", &lobes(1, |l| l.sheen_roughness *= MORE)),
            ("coat", &lobes(2, |l| l.coat *= MORE)),
            ("roughness of a coat", &lobes(2, |l| l.coat_roughness *= MORE)),
            ("coat over metal", &lobes(3, |l| l.coat *= MORE)),
            ("diffuse transmission", &lobes(4, |l| l.diffuse_transmission *= MORE)),
            ("its colour", &lobes(4, |l| l.diffuse_transmission_color *= MORE)),
            ("Phong", &lobes(5, |l| l.phong_specular *= MORE)),
            ("Phong exponent", &lobes(5, |l| l.phong_exponent *= MORE)),
            ("Phong with Fresnel", &lobes(6, |l| l.phong_specular *= MORE)),
        ],
    );
}

#[test]
fn in_films_and_brushed_metal() {
    let film = Iridescence {
        factor: 0.8,
        texture: None,
        ior: 1.4,
        thickness_min_nm: 100.0,
        thickness_max_nm: 420.0,
        thickness_texture: None,
    };
    let brushed = Anisotropy { strength: 0.8, rotation: 0.4, texture: None };
    let scene = samples(&[
        (false, Material { iridescence: Some(film), ..plain([0.1; 3], 0.0, 0.2) }),
        (false, Material { iridescence: Some(film), ..plain([0.8, 0.8, 0.7], 1.0, 0.3) }),
        (false, Material { anisotropy: Some(brushed), ..plain([0.9, 0.6, 0.4], 1.0, 0.5) }),
        (false, Material { anisotropy: Some(brushed), ..plain([0.2; 3], 0.0, 0.4) }),
    ]);
    check(
        "films and brushed metal",
        &scene,
        &samples_view(1.5),
        &[
            ("film", &lobes(1, |l| l.iridescence *= MORE)),
            ("its thickness", &lobes(1, |l| l.iridescence_thickness_nm[1] *= MORE)),
            ("its index", &lobes(1, |l| l.iridescence_ior *= MORE)),
            ("film on metal", &lobes(2, |l| l.iridescence_thickness_nm[1] *= MORE)),
            ("anisotropy", &lobes(3, |l| l.anisotropy *= MORE)),
            ("anisotropy of a gloss", &lobes(4, |l| l.anisotropy *= MORE)),
            ("its direction", &lobes(3, |l| l.anisotropy_direction = turned(l.anisotropy_direction))),
        ],
    );
}

/// A direction of the plane turned by 1 % of π/2.
fn turned([x, y]: [f32; 2]) -> [f32; 2] {
    let (s, c) = lumbre_core::math::sin_cos(0.01 * std::f32::consts::FRAC_PI_2);
    [c * x - s * y, s * x + c * y]
}

/// An array of a scene, to be changed.
fn all<T: Clone>(array: &mut Arc<[T]>) -> &mut [T] {
    Arc::make_mut(array)
}

/// A change of all punctual lights of a kind.
fn punctual(of: u32, factor: f32) -> impl Fn(&mut CompiledScene, &mut View) {
    move |scene, _| {
        let found: Vec<u32> = scene.lights.iter().filter(|l| l.kind == of).map(|l| l.index).collect();
        assert!(!found.is_empty());
        found.iter().for_each(|&i| scene.punctual_lights[i as usize].intensity *= factor);
    }
}

#[test]
fn in_lights() {
    check(
        "lights",
        &lamps(),
        &lamps_view(1.5),
        &[
            ("point", &punctual(kind::POINT, MORE)),
            ("spot", &punctual(kind::SPOT, MORE)),
            ("angle of a spot", &|scene, _| {
                let spots = scene.lights.iter().filter(|l| l.kind == kind::SPOT);
                spots.for_each(|l| {
                    let cos = &mut scene.punctual_lights[l.index as usize].cos_outer;
                    *cos = lumbre_core::math::sin_cos(MORE * lumbre_core::math::acos(*cos)).1;
                });
            }),
            ("directional", &punctual(kind::DIRECTIONAL, MORE)),
            ("sun", &|scene, _| scene.sun.radiance *= MORE),
            ("size of the sun", &|scene, _| scene.sun.one_minus_cos *= MORE),
            ("environment", &|scene, _| {
                all(&mut scene.environment_pixels).iter_mut().for_each(|p| *p *= MORE)
            }),
            ("triangles", &|scene, _| {
                all(&mut scene.triangle_lights).iter_mut().for_each(|t| t.radiance *= MORE);
            }),
            ("surfaces that emit", &|scene, _| scene.materials[3].emission *= MORE),
            ("choice of lights", &|scene, _| all(&mut scene.near_light_cdf)[1] *= MORE),
        ],
    );
}

#[test]
fn in_cameras() {
    let mut view = lamps_view(1.5);
    (view.camera.lens_radius, view.camera.focus_distance) = (0.15, 4.5);
    check(
        "cameras",
        &lamps(),
        &view,
        &[
            ("lens", &|_, view| view.camera.lens_radius *= MORE),
            ("focus", &|_, view| view.camera.focus_distance *= MORE),
            ("eye", &|_, view| view.camera.origin *= MORE),
            ("shape of the filter", &|_, view| view.settings.filter = FilterKind::Gaussian),
            ("frame", &|_, view| view.frame = 1),
            ("seed", &|_, view| view.settings.seed = 1),
        ],
    );
}

/// One pixel sees a floor that a lamp lights unevenly: a filter 1 % wider is a picture 1 % larger.
#[test]
fn in_filters() {
    let mut scene = Scene::default();
    add(&mut scene, rectangle(Vec3::NEG_Z, Vec3::X * 9.0, Vec3::Y * 9.0), Material::diffuse(grey(0.8)));
    crate::scenes::lamp(&mut scene, LightKind::Point, grey(1.0), Mat4::IDENTITY);
    let scene = compile(&scene);
    let Some(both) = Both::new(scene) else { return };
    for filter in [FilterKind::Box, FilterKind::Tent, FilterKind::Gaussian, FilterKind::BlackmanHarris] {
        let view = |wider: f32| {
            let mut view = look(Vec3::ZERO, Vec3::NEG_Z, 1.0, 1.0);
            view.camera.projection = view.camera.projection.scaled(2.0 * wider);
            let settings = RenderSettings { filter, max_depth: Some(1), ..view.settings };
            View { settings, ..view }
        };
        let (pixel, spp) = (Film::new(1, 1), 64);
        let gpu = both.on_gpu(&view(1.0), &pixel, spp);
        for (wider, wrong) in [(1.0, false), (MORE, true), (1.0 / MORE, true)] {
            let cpu = on_cpu(&both.cpu, &view(wider), &pixel, spp);
            let pairs: Vec<(Film, Film)> = cpu.into_iter().zip(gpu.clone()).collect();
            let paired = Paired::new(&pairs, &SHOT.bounds);
            println!("{filter:?}, {wider} as wide: {paired}");
            assert_eq!(!paired.faults(&SHOT.bounds).is_empty(), wrong, "{filter:?}, {wider}: {paired}");
        }
    }
}
