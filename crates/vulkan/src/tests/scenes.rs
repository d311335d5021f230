//! Scenes: coming and going, too large, on a device that is lost or hangs.

use super::{gpu, silent};
use crate::replay::Replay;
use crate::{Buffer, Gpu, Options, PipelineCache, Purpose, SceneOptions, VulkanError, Wanted};
use glam::Vec3;
use lumbre_scene::compiled::CompiledScene;
use lumbre_scene::{
    Filter, Image, ImageId, Material, MaterialId, Mesh, Node, Primitive, Scene, Texture, Wrap, compile,
};
use lumbre_shaders::replay::{ReplayRay, kind};

/// `count` meshes of one triangle, each a metre behind the one before, and a texture.
fn scene(count: u32) -> CompiledScene {
    let mut scene = Scene::default();
    scene.add_image(Image { name: String::new(), width: 64, height: 64, rgba8: vec![7; 4 * 64 * 64] });
    let (wrap, filter) = (Wrap::default(), Filter::default());
    scene.textures.push(Texture { image: ImageId(0), wrap_s: wrap, wrap_t: wrap, filter });
    let texture = Some(lumbre_scene::TextureId(0).into());
    let material: MaterialId =
        scene.add_material(Material { base_color_texture: texture, ..Material::default() });
    for i in 0..count {
        let z = -(i as f32);
        let positions = vec![Vec3::new(-1.0, -1.0, z), Vec3::new(1.0, -1.0, z), Vec3::new(0.0, 1.0, z)];
        let triangle =
            Primitive { positions, indices: vec![0, 1, 2], material: Some(material), ..Primitive::default() };
        let mesh = Some(scene.add_mesh(Mesh { name: String::new(), primitives: vec![triangle] }));
        scene.add_root(Node { mesh, ..Node::default() });
    }
    compile(&scene).unwrap().scene
}

/// The distance at which a ray from `z` down the axis hits something, if it does.
fn distance(gpu: &Gpu, scene: &CompiledScene, z: f32) -> Result<Option<f32>, VulkanError> {
    let on_gpu = gpu.scene(scene, SceneOptions::default())?;
    let ray = ReplayRay {
        origin: [0.0, 0.0, z],
        t_min: 0.0,
        dir: [0.0, 0.0, -1.0],
        t_max: 1e30,
        kind: kind::PATH,
        key: 0,
    };
    let (hits, _) = Replay::new(&on_gpu, false, &PipelineCache::open_in(gpu, None))?.run(&[ray])?;
    Ok((hits[0].t >= 0.0).then_some(hits[0].t))
}

#[test]
fn a_scene_may_be_empty() {
    let Some(gpu) = gpu() else { return };
    assert_eq!(distance(&gpu, &CompiledScene::default(), 5.0), Ok(None));
    assert_eq!(distance(&gpu, &scene(0), 5.0), Ok(None));
    assert_eq!(distance(&gpu, &scene(3), 5.0), Ok(Some(5.0)));
    assert_eq!(distance(&gpu, &scene(3), -0.5), Ok(Some(0.5)));
    silent(&gpu);
}

#[test]
fn twenty_scenes_leave_nothing() {
    let Some(gpu) = gpu() else { return };
    let scene = scene(50);
    let before = gpu.memory();
    for _ in 0..20 {
        assert_eq!(distance(&gpu, &scene, 2.0), Ok(Some(2.0)));
    }
    let after = gpu.memory();
    assert_eq!((after.pieces, after.allocated), (before.pieces, before.allocated));
    // Blocks of memory are kept for what comes, but do not add up.
    assert!(after.reserved <= before.reserved + (64 << 20), "{before:?} {after:?}");
    silent(&gpu);
}

/// Wherever memory runs out on the way to the device, it is an error, and the scene fits when there is room again.
#[test]
fn a_scene_that_does_not_fit_is_an_error() {
    let Some(gpu) = gpu() else { return };
    let scene = scene(50);
    let mut refused = 0;
    for kib in [0, 1, 16, 64, 256, 1024, 4096, 16_384] {
        gpu.limit_memory(kib << 10);
        match distance(&gpu, &scene, 2.0) {
            Ok(found) => assert_eq!(found, Some(2.0)),
            Err(VulkanError::OutOfMemory { needed, available, .. }) => {
                assert!(needed > available);
                refused += 1;
            }
            Err(error) => panic!("{error}"),
        }
        assert_eq!(gpu.memory().pieces, 0);
    }
    assert!(refused >= 2, "{refused}");
    gpu.limit_memory(u64::MAX);
    assert_eq!(distance(&gpu, &scene, 2.0), Ok(Some(2.0)));
    silent(&gpu);
}

/// Lost at any submission, the way ends with that error and everything is given back.
#[test]
fn a_scene_on_a_device_that_is_lost_is_an_error() {
    for submission in [1, 2, 5, 10, 15] {
        let Some(gpu) = gpu() else { return };
        let scene = scene(5);
        gpu.lose_after(submission);
        assert_eq!(distance(&gpu, &scene, 2.0), Err(VulkanError::DeviceLost), "{submission}");
        assert_eq!(gpu.memory().pieces, 0);
        silent(&gpu);
    }
}

/// What is dropped while the device uses it is freed later.
#[test]
fn things_may_be_dropped_while_they_are_used() {
    let Some(gpu) = gpu() else { return };
    let size = 64 << 20;
    let from = Buffer::new(&gpu, "from", size, Purpose::Data).unwrap();
    let to = Buffer::new(&gpu, "to", size, Purpose::Data).unwrap();
    let copy = |c: &crate::Commands<'_>| {
        c.fill(&from, 1);
        c.barrier();
        c.copy((&from, 0), (&to, 0), size);
        Ok(())
    };
    let first = gpu.submit("a copy", copy).unwrap();
    let second = gpu.submit("another", copy).unwrap();
    drop((from, to));
    assert_eq!(gpu.memory().pieces, 2);
    first.wait().unwrap();
    assert_eq!(gpu.memory().pieces, 2);
    drop(second);
    assert_eq!(gpu.memory().pieces, 0);
    silent(&gpu);
}

/// A device that does not answer in time is given up, without waiting for it again.
#[test]
fn a_hang_is_an_error() {
    if gpu().is_none() {
        return;
    }
    let options = Options { patience: std::time::Duration::ZERO, ..Options::default() };
    let gpu = Gpu::open(&Wanted::Best, options).unwrap();
    // No device does this at once.
    let buffer = Buffer::new(&gpu, "filled", 64 << 20, Purpose::Data).unwrap();
    let fill = || {
        gpu.run("filling", |c| {
            for word in 0..20 {
                c.fill(&buffer, word);
                c.barrier();
            }
            Ok(())
        })
    };
    let error = fill().unwrap_err();
    assert_eq!(error, VulkanError::Hang { what: "filling", seconds: 0 });
    assert!(error.is_lost());
    assert_eq!(fill().unwrap_err(), VulkanError::DeviceLost);
}
