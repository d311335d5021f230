//! try
use lumbre::prelude::*;
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let t = std::time::Instant::now();
    let mut loaded = lumbre::load_scene(&a[1], &LoadOptions::default()).unwrap();
    for w in &loaded.warnings {
        eprintln!("warn {w}");
    }
    let (w, h, spp, depth): (u32, u32, u32, u32) =
        (a[3].parse().unwrap(), a[4].parse().unwrap(), a[5].parse().unwrap(), a[6].parse().unwrap());
    let black = a.get(7).is_some_and(|s| s == "black");
    if !black {
        loaded.scene.environment.background = lumbre::scene::Background::Gradient;
        if a.get(7).is_some_and(|s| s == "sun") {
            loaded.scene.environment.sun = Some(lumbre::scene::Sun {
                elevation: 1.0,
                azimuth: 0.6,
                irradiance: Rgb::new(12.0, 11.0, 9.5),
                angular_radius: 0.00465,
            });
        }
    }
    let c = lumbre::compile(&loaded.scene).unwrap();
    for n in c.notes {
        eprintln!("note {n}");
    }
    let opt = CameraOptions {
        look_from: a.get(8).map(|s| {
            let v: Vec<f32> = s.split(',').map(|x| x.parse().unwrap()).collect();
            glam::Vec3::new(v[0], v[1], v[2])
        }),
        look_at: a.get(9).map(|s| {
            let v: Vec<f32> = s.split(',').map(|x| x.parse().unwrap()).collect();
            glam::Vec3::new(v[0], v[1], v[2])
        }),
        ..Default::default()
    };
    let f = lumbre::find_camera(&loaded.scene, &c.scene, &opt, w as f32 / h as f32).unwrap();
    eprintln!("load {:?} bounds {:?}", t.elapsed(), c.scene.bounds);
    let t = std::time::Instant::now();
    let b = lumbre::prepare(c.scene, Device::Auto);
    eprintln!("build {:?} {}", t.elapsed(), b.device());
    let settings = RenderSettings {
        max_depth: Some(depth),
        roulette: if black { None } else { Some(4) },
        filter: if black { lumbre::core::filter::FilterKind::Box } else { Default::default() },
        ..Default::default()
    };
    let view = View { camera: f.camera, settings, frame: 0 };
    let mut film = Film::new(w, h);
    let t = std::time::Instant::now();
    let p = lumbre::render(&*b, &view, 0..spp, &mut film, &());
    let s = t.elapsed().as_secs_f64();
    eprintln!(
        "render {s:.2}s {:.3} Msamples/s {:.2} Mrays/s nonfinite {}",
        p.samples as f64 / s / 1e6,
        p.rays as f64 / s / 1e6,
        film.non_finite_count()
    );
    lumbre::io::write_png(format!("{}.png", a[2]), w, h, &lumbre::output::to_srgb8(&film, Exposure::Auto))
        .unwrap();
    lumbre::io::write_exr(format!("{}.exr", a[2]), lumbre::output::to_exr(&film, vec![])).unwrap();
}
