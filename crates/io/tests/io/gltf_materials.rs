//! Materials, textures and images of glTF: one tiny scene for each feature.

use crate::common::{Gltf, png};
use lumbre_core::Rgb;
use lumbre_scene::{
    AlphaMode, Filter, ImageId, Material, MaterialId, TextureId, TextureRef, TextureTransform, Volume, Wrap,
};
use serde_json::{Value, json};

fn material(json: Value) -> Material {
    Gltf::triangle().material(json).scene().materials.remove(0)
}

fn extension(name: &str, value: Value) -> Material {
    material(json!({"extensions": {name: value}}))
}

#[test]
fn defaults_are_gltf_s() {
    let scene = Gltf::triangle().material(json!({})).scene();
    assert_eq!(scene.meshes[0].primitives[0].material, Some(MaterialId(0)));
    let want = Material { metallic: 1.0, ..Material::default() };
    assert_eq!(scene.materials[0], want);
    assert_eq!((want.roughness, want.ior, want.volume), (1.0, 1.5, None));
}

#[test]
fn factors() {
    let m = material(json!({
        "name": "m",
        "pbrMetallicRoughness": {
            "baseColorFactor": [0.1, 0.2, 0.3, 0.4], "metallicFactor": 0.5, "roughnessFactor": 0.6
        },
        "emissiveFactor": [0.5, 0.25, 0.0],
        "doubleSided": true,
        "alphaMode": "MASK",
        "alphaCutoff": 0.7,
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 8}}
    }));
    assert_eq!((m.name.as_str(), m.base_color, m.alpha), ("m", Rgb::new(0.1, 0.2, 0.3), 0.4));
    assert_eq!((m.metallic, m.roughness, m.double_sided), (0.5, 0.6, true));
    assert_eq!(m.emission, Rgb::new(4.0, 2.0, 0.0));
    assert_eq!(m.alpha_mode, AlphaMode::Mask { cutoff: 0.7 });
    assert_eq!(material(json!({"alphaMode": "MASK"})).alpha_mode, AlphaMode::Mask { cutoff: 0.5 });
    assert_eq!(material(json!({"alphaMode": "BLEND"})).alpha_mode, AlphaMode::Blend);
    let odd = Gltf::triangle().material(json!({"alphaMode": "FUZZY"}));
    assert_eq!(odd.error(), "scene.gltf: /materials/0/alphaMode: is none of glTF's modes");
}

#[test]
fn factors_out_of_range_are_clamped_with_a_warning() {
    let g = Gltf::triangle().material(json!({
        "pbrMetallicRoughness": {"baseColorFactor": [2, -1, 0.5, 1], "roughnessFactor": 1e38},
        "emissiveFactor": [-1, 0, 0]
    }));
    let loaded = g.load().unwrap();
    let m = &loaded.scene.materials[0];
    assert_eq!((m.base_color, m.roughness), (Rgb::new(1.0, 0.0, 0.5), 1.0));
    assert_eq!(m.emission, Rgb::BLACK);
    assert_eq!(loaded.warnings.len(), 2, "{:?}", loaded.warnings);
}

#[test]
fn transmission_volume_and_ior() {
    let m = extension("KHR_materials_transmission", json!({"transmissionFactor": 0.75}));
    assert_eq!((m.transmission, m.volume), (0.75, None));
    assert_eq!(extension("KHR_materials_ior", json!({"ior": 1.33})).ior, 1.33);
    assert_eq!(extension("KHR_materials_ior", json!({})).ior, 1.5);
    assert_eq!(extension("KHR_materials_ior", json!({"ior": 0})).ior, 0.0);
    assert_eq!(extension("KHR_materials_ior", json!({"ior": 0.5})).ior, 1.0);
    let volume = |json| extension("KHR_materials_volume", json).volume;
    let solid = Volume { thickness: 2.0, attenuation_color: Rgb::WHITE, attenuation_distance: f32::INFINITY };
    assert_eq!(volume(json!({"thicknessFactor": 2.0})), Some(solid));
    let tinted =
        Volume { thickness: 2.0, attenuation_color: Rgb::new(0.5, 0.25, 1.0), attenuation_distance: 0.125 };
    let json = json!({
        "thicknessFactor": 2.0, "attenuationColor": [0.5, 0.25, 1.0], "attenuationDistance": 0.125
    });
    assert_eq!(volume(json), Some(tinted));
    assert_eq!(volume(json!({"attenuationDistance": 1.0})), None);
    assert_eq!(volume(json!({"thicknessFactor": 0.0})), None);
}

#[test]
fn specular_and_unlit() {
    let m = extension(
        "KHR_materials_specular",
        json!({"specularFactor": 0.25, "specularColorFactor": [1.0, 2.0, 0.5]}),
    );
    assert_eq!((m.specular, m.specular_color), (0.25, Rgb::new(1.0, 2.0, 0.5)));
    assert!(!m.unlit);
    assert!(extension("KHR_materials_unlit", json!({})).unlit);
}

#[test]
fn extensions_of_the_wrong_form_are_errors() {
    for (value, message) in [
        (json!(3), "/materials/0/extensions/KHR_materials_ior: should be an object"),
        (json!({"ior": "x"}), "/materials/0/extensions/KHR_materials_ior/ior: should be a finite number"),
        (json!({"ior": 1e60}), "/materials/0/extensions/KHR_materials_ior/ior: should be a finite number"),
    ] {
        let g = Gltf::triangle().material(json!({"extensions": {"KHR_materials_ior": value}}));
        assert_eq!(g.error(), format!("scene.gltf: {message}"));
    }
    let g = Gltf::triangle()
        .material(json!({"extensions": {"KHR_materials_volume": {"attenuationColor": [1, 1]}}}));
    assert!(g.error().ends_with("/attenuationColor: should be a list of 3 numbers"));
}

#[test]
fn required_extensions_are_refused_and_others_warned_of() {
    let mut g = Gltf::triangle();
    g.doc["extensionsUsed"] = json!(["KHR_materials_ior", "EXT_nonsense"]);
    assert_eq!(
        g.load().unwrap().warnings,
        ["/extensionsUsed: the extension EXT_nonsense is not supported and is ignored"]
    );
    g.doc["extensionsRequired"] = json!(["KHR_materials_ior", "EXT_nonsense", "EXT_more"]);
    assert_eq!(
        g.error(),
        "scene.gltf: /extensionsRequired: not supported: the required extensions EXT_nonsense, EXT_more"
    );
}

fn textured() -> Gltf {
    let mut g = Gltf::triangle();
    g.image("image/png", &png(2, 1, &[255, 0, 0, 255, 0, 255, 0, 128]));
    g
}

#[test]
fn every_texture_of_a_material() {
    let mut g = textured();
    for _ in 0..6 {
        g.image("image/png", &png(1, 1, &[1, 2, 3, 4]));
    }
    g.doc["samplers"] = json!([{"wrapS": 33071, "wrapT": 33648, "magFilter": 9728}]);
    g.doc["textures"][1]["sampler"] = json!(0);
    let g = g.material(json!({
        "pbrMetallicRoughness": {
            "baseColorTexture": {"index": 6},
            "metallicRoughnessTexture": {"index": 1, "texCoord": 1}
        },
        "normalTexture": {"index": 2, "scale": 0.5},
        "emissiveTexture": {"index": 3},
        "occlusionTexture": {"index": 999},
        "extensions": {
            "KHR_materials_specular": {
                "specularTexture": {"index": 4},
                "specularColorTexture": {"index": 5, "texCoord": 1}
            },
            "KHR_materials_transmission": {"transmissionTexture": {"index": 0}}
        }
    }));
    let scene = g.scene();
    let m = &scene.materials[0];
    let texture = |t: u32| Some(TextureRef::from(TextureId(t)));
    // In the order in which they are first used.
    assert_eq!(m.base_color_texture, texture(0));
    assert_eq!(
        m.metallic_roughness_texture,
        Some(TextureRef { uv_set: 1, ..TextureRef::from(TextureId(1)) })
    );
    assert_eq!((m.normal_texture, m.normal_scale), (texture(2), 0.5));
    assert_eq!(m.emissive_texture, texture(3));
    assert_eq!(m.specular_texture, texture(4));
    assert_eq!(m.specular_color_texture.unwrap().uv_set, 1);
    assert_eq!(m.transmission_texture, texture(6));
    let t = scene.textures[1];
    assert_eq!((t.wrap_s, t.wrap_t, t.filter), (Wrap::ClampToEdge, Wrap::MirroredRepeat, Filter::Nearest));
    let t = scene.textures[0];
    assert_eq!(
        (t.wrap_s, t.wrap_t, t.filter, t.image),
        (Wrap::Repeat, Wrap::Repeat, Filter::Linear, ImageId(0))
    );
    let last = &scene.images[scene.textures[6].image.index()];
    assert_eq!((last.width, last.height), (2, 1));
    assert_eq!(last.rgba8, [255, 0, 0, 255, 0, 255, 0, 128]);
}

#[test]
fn texture_transforms_and_their_own_uv_set() {
    let with = |transform: Value| {
        let g = textured().material(json!({"pbrMetallicRoughness": {"baseColorTexture": {
            "index": 0, "extensions": {"KHR_texture_transform": transform}
        }}}));
        g.load().unwrap()
    };
    let used = |t: Value| with(t).scene.materials[0].base_color_texture.unwrap();
    let all = used(json!({"offset": [0.1, 0.2], "rotation": 0.5, "scale": [2, 3], "texCoord": 1}));
    assert_eq!(all.transform, TextureTransform { offset: [0.1, 0.2], rotation: 0.5, scale: [2.0, 3.0] });
    assert_eq!(all.uv_set, 1);
    assert_eq!(used(json!({})).transform, TextureTransform::default());
    let third = with(json!({"texCoord": 2}));
    assert_eq!(third.scene.materials[0].base_color_texture.unwrap().uv_set, 0);
    assert_eq!(third.warnings.len(), 1);
}

#[test]
fn images_from_views_files_and_data_uris() {
    let folder = tempfile::tempdir().unwrap();
    let texels = [9, 8, 7, 255];
    std::fs::create_dir(folder.path().join("my textures")).unwrap();
    std::fs::write(folder.path().join("my textures/ñ 1.png"), png(1, 1, &texels)).unwrap();
    let mut g = textured();
    let view = g.raw(5121, "SCALAR", 1, &png(1, 1, &texels));
    let view = g.doc["accessors"][view]["bufferView"].clone();
    g.doc["images"] = json!([
        {"bufferView": view, "mimeType": "image/jpeg", "name": "in the buffer"},
        {"uri": "my%20textures/%C3%B1%201.png"},
        {"uri": "my textures/ñ 1.png"}
    ]);
    g.doc["textures"] = json!([{"source": 0}, {"source": 1}, {"source": 2}, {"source": 1}]);
    let g = g.material(json!({
        "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 1}},
        "normalTexture": {"index": 2}, "emissiveTexture": {"index": 3}
    }));
    let scene = g.load_in(folder.path()).unwrap().scene;
    let names: Vec<_> = scene.images.iter().map(|i| i.name.as_str()).collect();
    assert_eq!(names, ["in the buffer", "ñ 1.png", "ñ 1.png"]);
    assert!(scene.images.iter().all(|i| i.rgba8 == texels));
    // Two textures share one image.
    assert_eq!(scene.textures[3].image, scene.textures[1].image);
}

#[test]
fn images_that_no_material_uses_are_not_read() {
    let mut g = textured();
    g.doc["images"] = json!([{"uri": "missing.png"}]);
    let g = g.material(json!({"occlusionTexture": {"index": 0}}));
    assert!(g.scene().images.is_empty());
}

#[test]
fn grey_and_sixteen_bit_images_become_rgba8() {
    use image::{ExtendedColorType as Color, ImageFormat, write_buffer_with_format};
    let encode = |bytes: &[u8], color, format| {
        let mut out = std::io::Cursor::new(Vec::new());
        write_buffer_with_format(&mut out, bytes, 1, 1, color, format).unwrap();
        out.into_inner()
    };
    let wide: Vec<u8> = [0x1234u16, 0x8000, 0xffff].iter().flat_map(|v| v.to_ne_bytes()).collect();
    for (bytes, want) in [
        (encode(&[77], Color::L8, ImageFormat::Png), [77, 77, 77, 255]),
        (encode(&[77, 33], Color::La8, ImageFormat::Png), [77, 77, 77, 33]),
        (encode(&[1, 2, 3], Color::Rgb8, ImageFormat::Png), [1, 2, 3, 255]),
        (encode(&wide, Color::Rgb16, ImageFormat::Png), [0x12, 0x80, 0xff, 255]),
        (encode(&[128, 128, 128], Color::Rgb8, ImageFormat::Jpeg), [128, 128, 128, 255]),
    ] {
        let mut g = Gltf::triangle();
        g.image("image/anything", &bytes);
        let g = g.material(json!({"emissiveTexture": {"index": 0}}));
        assert_eq!(g.scene().images[0].rgba8, want);
    }
}
