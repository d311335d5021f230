//! Textures: what shaders read from images, and alpha from memory, is what the CPU reads.

use lumbre_core::hash::{hash_combine, to_unit};
use lumbre_scene::compiled::CompiledScene;
use lumbre_scene::compiled::material::TextureUse;
use lumbre_scene::compiled::texture::Encoding;
use lumbre_scene::{AlphaMode, Filter, Image, ImageId, Material, Scene, Texture, TextureId, Wrap, compile};
use lumbre_shaders::replay::{TextureAnswer, TextureQuery};
use lumbre_vulkan::SceneOptions;

/// Every way to wrap and filter, over two images; the large one goes up in more than one piece. Half of them decide alpha.
fn scene() -> CompiledScene {
    let mut scene = Scene::default();
    for [width, height] in [[7u32, 5], [3001, 2999]] {
        let texel = |i: u32| hash_combine(width, i).to_le_bytes();
        let rgba8 = (0..width * height).flat_map(texel).collect();
        scene.add_image(Image { name: String::new(), width, height, rgba8 });
    }
    let modes = [Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge];
    for image in [0, 1].map(ImageId) {
        for (i, &wrap_s) in modes.iter().enumerate() {
            for filter in [Filter::Linear, Filter::Nearest] {
                scene.textures.push(Texture { image, wrap_s, wrap_t: modes[(i + 1) % 3], filter });
            }
        }
    }
    for texture in 0..scene.textures.len() as u32 {
        let alpha_mode = if texture % 2 == 0 { AlphaMode::Blend } else { AlphaMode::Opaque };
        let base_color_texture = Some(TextureId(texture).into());
        scene.add_material(Material { alpha_mode, base_color_texture, ..Material::default() });
    }
    compile(&scene).expect("the scene compiles").scene
}

fn queries(textures: u32) -> Vec<TextureQuery> {
    let query = |i: u32| {
        let u = |k| 6.0 * to_unit(hash_combine(i, k)) - 3.0;
        TextureQuery { texture: i % textures, srgb: i / textures % 2, uv: [u(0), u(1)] }
    };
    (0..20_000).map(query).collect()
}

/// Answers that differ, and how many of them have alpha from memory. `shift` is added to the CPU's coordinates.
fn differences(scene: &CompiledScene, q: &[TextureQuery], a: &[TextureAnswer], shift: f32) -> (usize, usize) {
    let (mut different, mut with_alpha) = (0, 0);
    for (q, a) in q.iter().zip(a) {
        let used = TextureUse { texture: q.texture, ..TextureUse::default() };
        let encoding = if q.srgb == 1 { Encoding::Srgb } else { Encoding::Linear };
        let cpu = scene.texture(&used, &[q.uv.map(|x| x + shift), [0.0; 2]], encoding);
        let rgba = [cpu.rgb.r, cpu.rgb.g, cpu.rgb.b, cpu.a];
        // A coordinate is rounded in units of texels, by which the weights of texels differ.
        let weights = 2e-6 + 3e-7 * scene.textures[q.texture as usize].width as f32;
        let mut same = (0..4).all(|i| (rgba[i] - a.value[i]).abs() < weights);
        if a.alpha >= 0.0 {
            with_alpha += 1;
            same &= (a.alpha - cpu.a).abs() < weights;
        }
        different += usize::from(!same);
    }
    (different, with_alpha)
}

#[test]
fn textures_hold_the_same() {
    let Some(gpu) = lumbre_testkit::gpu() else { return };
    let scene = scene();
    let on_gpu = gpu.scene(&scene, SceneOptions::default()).unwrap();
    let queries = queries(scene.textures.len() as u32);
    let answers = on_gpu.look_up(&queries).unwrap();
    // The nearest texel may be the other one where a coordinate lies on the border.
    let (different, with_alpha) = differences(&scene, &queries, &answers, 0.0);
    println!("{different} of {} differ", queries.len());
    assert!(different <= 20, "{different}");
    // Textures of surfaces that are there in part have their texels in memory, the others have not.
    assert_eq!(with_alpha, queries.iter().filter(|q| q.texture % 2 == 0).count());
    let (different, _) = differences(&scene, &queries, &answers, 0.02);
    assert!(different > 10_000, "{different}");
}
