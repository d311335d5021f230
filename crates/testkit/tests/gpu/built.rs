//! The paired test on what files do not reach: every kind of light, solids in solids, and each of the settings.

use crate::common::{Both, Shot, assert_none, compile, on_cpu, shared};
use crate::scenes::{lamps, lamps_view, look, media, media_view, samples, samples_view, sky};
use glam::Vec3;
use lumbre_core::bsdf::DiffuseSampling;
use lumbre_core::camera::Projection;
use lumbre_core::film::{Crop, PixelSums};
use lumbre_core::filter::FilterKind;
use lumbre_core::sampler::SamplerKind;
use lumbre_core::settings::{RenderSettings, TransmissiveShadows, View};
use lumbre_core::{Film, Rgb};
use lumbre_io::Limits;
use lumbre_scene::{Background, Environment, Material, Phong, Scene};
use lumbre_testkit::measure::grey;
use lumbre_testkit::shapes::{add, rectangle, smooth_icosphere};

const SHOT: Shot = Shot::PLAIN;

/// Every kind of light. Views that differ in what is no constant of the pipeline share one.
#[test]
fn lights_and_cameras() {
    let Some(both) = Both::new(compile(&lamps())) else { return };
    let base = lamps_view(SHOT.aspect());
    let settings = |settings: RenderSettings| View { settings, ..base.clone() };
    let mut faults = both.faults("lights", &base, &SHOT);
    for filter in [FilterKind::Box, FilterKind::Tent, FilterKind::Gaussian, FilterKind::Point] {
        let view = settings(RenderSettings { filter, ..base.settings });
        faults.extend(both.faults(&format!("{filter:?}"), &view, &SHOT));
    }
    let mut view = base.clone();
    (view.camera.lens_radius, view.camera.focus_distance) = (0.2, 4.0);
    faults.extend(both.faults("lens", &view, &SHOT));
    view.camera.projection = Projection::Orthographic { half_height: 1.6 };
    faults.extend(both.faults("orthographic, lens", &view, &SHOT));
    let view = View { frame: 7, ..settings(RenderSettings { seed: 12_345, ..base.settings }) };
    faults.extend(both.faults("frame 7, seed 12345", &view, &SHOT));
    let deep = RenderSettings { max_depth: None, roulette: Some(1), ..base.settings };
    faults.extend(both.faults("roulette from the first event", &settings(deep), &SHOT));
    let shallow = RenderSettings { max_depth: Some(1), roulette: None, ..base.settings };
    faults.extend(both.faults("depth 1", &settings(shallow), &SHOT));
    for rough_bounces in [Some(0), Some(1)] {
        let view = settings(RenderSettings { rough_bounces, ..base.settings });
        faults.extend(both.faults(&format!("rough bounces: {rough_bounces:?}"), &view, &SHOT));
    }
    let window = Film::window([300, 225], Crop { origin: [171, 90], size: SHOT.size });
    faults.extend(both.faults_in("a window", &base, &window, &SHOT));
    assert_none(&faults);
}

/// Settings that are constants of the pipeline, several at a time.
#[test]
fn settings() {
    type Change = fn(&mut RenderSettings);
    let changes: [&[(&str, Change)]; 2] = [
        &[
            ("independent samples", |s| s.sampler = SamplerKind::Independent),
            ("clamp", |s| s.clamp = Some(0.1)),
            ("transparent background", |s| s.transparent_background = true),
        ],
        &[
            ("no light sampling", |s| s.light_sampling = false),
            ("uniform hemisphere", |s| s.diffuse_sampling = DiffuseSampling::Uniform),
            ("back faces", |s| s.shade_back_faces = true),
        ],
    ];
    let Some(both) = Both::new(compile(&lamps())) else { return };
    let base = lamps_view(SHOT.aspect());
    let empty = Film::new(SHOT.size[0], SHOT.size[1]);
    let as_it_is = on_cpu(&both.cpu, &base, &empty, SHOT.spp);
    let mut faults = Vec::new();
    for together in changes {
        let mut all = base.clone();
        for (name, change) in together {
            let mut view = base.clone();
            change(&mut view.settings);
            change(&mut all.settings);
            assert!(on_cpu(&both.cpu, &view, &empty, SHOT.spp) != as_it_is, "{name} does nothing here");
        }
        let names: Vec<&str> = together.iter().map(|(name, _)| *name).collect();
        faults.extend(both.faults(&names.join(", "), &all, &SHOT));
    }
    assert_none(&faults);
}

/// What shadow rays do at glass, and a camera inside of it.
#[test]
fn media_and_shadows() {
    let Some(both) = Both::new(compile(&media())) else { return };
    let base = media_view(SHOT.aspect());
    let mut faults = Vec::new();
    for transmissive_shadows in
        [TransmissiveShadows::Auto, TransmissiveShadows::Physical, TransmissiveShadows::Straight]
    {
        let settings = RenderSettings { transmissive_shadows, ..base.settings };
        let view = View { settings, ..base.clone() };
        faults.extend(both.faults(&format!("{transmissive_shadows:?} shadows"), &view, &SHOT));
    }
    // In the glass beside the water, then in the water.
    for x in [-0.35, -0.8] {
        let eye = Vec3::new(x, 0.75, 0.05);
        let camera = lumbre_core::Camera::look_at(eye, Vec3::Y * 0.6, Vec3::Y, 1.0, SHOT.aspect());
        let inside = View { camera, ..base.clone() };
        faults.extend(both.faults(&format!("inside at {x}"), &inside, &SHOT));
    }
    assert_none(&faults);
}

/// Shadow catchers, unlit surfaces, MTL's gloss as a mirror, a pane before a transparent background.
#[test]
fn odd_surfaces() {
    let mirror =
        Phong { specular: grey(0.5), specular_texture: None, exponent: f32::INFINITY, fresnel: true };
    let pane = Material { transmission: 0.8, roughness: 0.0, double_sided: true, ..Material::default() };
    let mut scene = samples(&[
        (false, Material { unlit: true, ..Material::diffuse(Rgb::new(0.2, 0.5, 0.9)) }),
        (false, Material { phong: Some(mirror), ..Material::diffuse(grey(0.4)) }),
        (true, pane),
    ]);
    let caught = Material { shadow_catcher: true, ..Material::diffuse(grey(0.5)) };
    add(&mut scene, rectangle(Vec3::Y * -0.2, Vec3::Z * 2.0, Vec3::X * 2.0), caught);
    let Some(both) = Both::new(compile(&scene)) else { return };
    let base = samples_view(SHOT.aspect());
    let camera =
        lumbre_core::Camera::look_at(Vec3::new(0.0, 1.5, 6.0), Vec3::Y * 0.2, Vec3::Y, 0.4, SHOT.aspect());
    let view = View { camera, ..base };
    let mut faults = both.faults("catcher, unlit, Phong mirror", &view, &SHOT);
    let settings = RenderSettings { transparent_background: true, ..view.settings };
    faults.extend(both.faults("the same, transparent", &View { settings, ..view }, &SHOT));
    assert_none(&faults);
}

/// One colour from everywhere, the plain sky, and a measured one with a bright sun, of the shared folder; no lights beside them.
#[test]
fn skies() {
    let measured = shared(&["hdri/sky.hdr"]).map(|folder| {
        let read = lumbre_io::read_environment(folder.join("hdri/sky.hdr"), &Limits::default());
        ("measured sky", Background::Map(read.expect("a picture").map))
    });
    let plain = [
        ("constant sky", Background::Constant(Rgb::new(0.3, 0.5, 0.9))),
        ("gradient sky", Background::Gradient),
    ];
    let mut faults = Vec::new();
    for (name, background) in plain.into_iter().chain(measured) {
        let environment = Environment { background, ..sky(0.8) };
        let mut scene = Scene { environment, ..Scene::default() };
        add(&mut scene, smooth_icosphere(Vec3::ZERO, 1.0, 2), Material::default());
        let view = look(Vec3::Z * 5.0, Vec3::ZERO, 0.6, SHOT.aspect());
        let Some(both) = Both::new(compile(&scene)) else { return };
        faults.extend(both.faults(name, &view, &SHOT));
    }
    assert_none(&faults);
}

/// Colours of objects in place of the albedo: those of the CPU, some of them.
#[test]
fn objects_have_colours() {
    let Some(both) = Both::new(compile(&lamps())) else { return };
    let base = lamps_view(SHOT.aspect());
    let settings = RenderSettings { object_colors: true, ..base.settings };
    let view = View { settings, ..base.clone() };
    assert_none(&both.faults("object colours", &view, &SHOT));
    let film = &on_cpu(&both.cpu, &view, &Film::new(SHOT.size[0], SHOT.size[1]), 1)[0];
    let plain = &on_cpu(&both.cpu, &base, &Film::new(SHOT.size[0], SHOT.size[1]), 1)[0];
    let colors: std::collections::BTreeSet<_> =
        film.pixels().iter().map(|p| p.albedo().to_array().map(f32::to_bits)).collect();
    assert!((3..20).contains(&colors.len()), "{} colours", colors.len());
    let same = |(a, b): (&PixelSums, &PixelSums)| a.radiance() == b.radiance();
    assert!(film.pixels().iter().zip(plain.pixels()).all(same), "the picture is as it was");
}
