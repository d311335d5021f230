//! A picture without any file: a scene made of vectors, rendered on threads of its own, stopped by a token, read as floats.
//!
//! `cargo run --release -p lumbre --example embed`

use lumbre::core::math::{Mat4, Vec3};
use lumbre::prelude::*;
use lumbre::scene::{Background, Camera as SceneCamera, CameraId, Material, Mesh, Node, Primitive};
use lumbre::{Ended, Targets, Watched};
use std::time::Duration;

fn main() -> Result<(), Box<dyn std::error::Error + Send + Sync>> {
    // What is to be seen.
    let scene = scene();
    let compiled = lumbre::compile(&scene)?.scene;
    let (width, height) = (320, 200);
    let found = lumbre::find_camera(&scene, &compiled, &CameraOptions::default(), 320.0 / 200.0)?;
    let view = View { camera: found.camera, settings: RenderSettings::default(), frame: 0 };

    // Threads of its own. Without them rendering uses the global pool of rayon.
    let pool = lumbre::rayon::ThreadPoolBuilder::new().num_threads(2).build()?;

    // Clones are one token: keep one where the wish to stop may arise, here in the callback itself.
    let cancel = CancelToken::new();
    let budget_of_rays = 200_000_000;
    let watch = Watched::new(&cancel, |so_far| {
        if so_far.rays > budget_of_rays {
            cancel.cancel();
        }
    });

    let mut film = Film::new(width, height);
    let outcome = pool.install(|| -> Result<_, Box<dyn std::error::Error + Send + Sync>> {
        let backend = lumbre::prepare(compiled, Device::Auto)?;
        let targets = Targets::error(0.005).or_spp(256).or_time(Duration::from_secs(20));
        Ok(lumbre::render(&*backend, &view, targets, &mut film, &watch)?)
    })?;

    // Linear radiance: red, green, blue of each pixel, the top row first.
    let radiance = film.radiance();
    let floats: &[f32] = Rgb::as_floats(&radiance);
    assert_eq!(floats.len(), (width * height * 3) as usize);
    let mean = floats.iter().sum::<f32>() / floats.len() as f32;
    match outcome.ended {
        Ended::Cancelled => println!("stopped by the callback"),
        ended => println!("ended by {ended:?} after {} samples per pixel", outcome.spp),
    }
    println!(
        "{width} x {height}, mean radiance {mean:.3}, estimated relMSE {:.5}",
        outcome.error.unwrap_or(f64::NAN)
    );
    Ok(())
}

/// A glass and a copper tetrahedron on a grey floor under a blue sky and a lamp.
fn scene() -> Scene {
    let mut scene = Scene::default();
    let grey = scene.add_material(Material::diffuse(Rgb::splat(0.5)));
    let glass = scene.add_material(Material::glass(1.5, 0.0));
    let copper = scene.add_material(Material::metal(Rgb::new(0.93, 0.45, 0.33), 0.25));
    let glow = scene.add_material(Material::emitter(Rgb::new(12.0, 10.0, 8.0), true));

    let floor = scene.add_mesh(Mesh { name: "floor".into(), primitives: vec![square(Some(grey))] });
    let lamp = scene.add_mesh(Mesh { name: "lamp".into(), primitives: vec![square(Some(glow))] });
    let clear = scene.add_mesh(Mesh { name: "clear".into(), primitives: vec![tetrahedron(Some(glass))] });
    let metal = scene.add_mesh(Mesh { name: "metal".into(), primitives: vec![tetrahedron(Some(copper))] });

    let place = |at: Vec3, size: f32| Mat4::from_translation(at) * Mat4::from_scale(Vec3::splat(size));
    for (mesh, transform) in [
        (floor, place(Vec3::ZERO, 6.0)),
        (lamp, place(Vec3::new(0.0, 4.0, 0.0), 0.5)),
        (clear, place(Vec3::new(-1.1, 0.001, 0.0), 1.0)),
        (metal, place(Vec3::new(1.1, 0.001, -0.5), 1.0)),
    ] {
        scene.add_root(Node { mesh: Some(mesh), transform, ..Node::default() });
    }
    scene.environment.background = Background::Constant(Rgb::new(0.2, 0.3, 0.5));

    scene.cameras.push(SceneCamera::perspective(40f32.to_radians()));
    let transform = SceneCamera::looking(Vec3::new(0.0, 1.8, 6.0), Vec3::new(0.0, 0.6, 0.0));
    scene.add_root(Node { camera: Some(CameraId(0)), transform, ..Node::default() });
    scene
}

/// From -1 to 1 in x and z, facing up.
fn square(material: Option<lumbre::scene::MaterialId>) -> Primitive {
    let positions = [[-1.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 0.0, -1.0], [-1.0, 0.0, -1.0]];
    Primitive {
        positions: positions.map(Vec3::from).into(),
        indices: vec![0, 1, 2, 0, 2, 3],
        material,
        ..Primitive::default()
    }
}

/// It stands on y = 0, its faces wind counter-clockwise seen from outside.
fn tetrahedron(material: Option<lumbre::scene::MaterialId>) -> Primitive {
    let positions = [[0.0, 1.5, 0.0], [0.0, 0.0, 1.0], [0.9, 0.0, -0.5], [-0.9, 0.0, -0.5]];
    Primitive {
        positions: positions.map(Vec3::from).into(),
        indices: vec![0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2],
        material,
        ..Primitive::default()
    }
}
