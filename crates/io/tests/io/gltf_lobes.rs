//! The lobes that extensions add to glTF's materials, and the older specular-glossiness model.

use crate::common::{Gltf, png};
use lumbre_core::Rgb;
use lumbre_io::{GLTF_EXTENSIONS, Limits, LoadOptions, load_scene};
use lumbre_scene::{
    Anisotropy, Clearcoat, DiffuseTransmission, Iridescence, Material, Sheen, TextureId, TextureRef,
};
use serde_json::{Value, json};

fn extension(name: &str, value: Value) -> Material {
    let loaded = textured().material(json!({"extensions": {name: value}})).load().unwrap();
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
    loaded.scene.materials.into_iter().next().unwrap()
}

/// A triangle and four images of two texels.
fn textured() -> Gltf {
    let mut g = Gltf::triangle();
    for i in 0..4 {
        g.image("image/png", &png(2, 1, &[10 * i, 0, 0, 255, 0, 255, 0, 51]));
    }
    g
}

fn texture(t: u32) -> Option<TextureRef> {
    Some(TextureRef::from(TextureId(t)))
}

#[test]
fn clearcoat() {
    let none = Clearcoat {
        factor: 0.0,
        texture: None,
        roughness: 0.0,
        roughness_texture: None,
        normal_texture: None,
        normal_scale: 1.0,
    };
    assert_eq!(extension("KHR_materials_clearcoat", json!({})).clearcoat, Some(none));
    let json = json!({
        "clearcoatFactor": 0.5, "clearcoatTexture": {"index": 3},
        "clearcoatRoughnessFactor": 0.25, "clearcoatRoughnessTexture": {"index": 2, "texCoord": 1},
        "clearcoatNormalTexture": {"index": 1, "scale": -0.75}
    });
    let all = Clearcoat {
        factor: 0.5,
        texture: texture(0),
        roughness: 0.25,
        roughness_texture: texture(1).map(|t| TextureRef { uv_set: 1, ..t }),
        normal_texture: texture(2),
        normal_scale: -0.75,
    };
    assert_eq!(extension("KHR_materials_clearcoat", json).clearcoat, Some(all));
}

#[test]
fn sheen() {
    let none = Sheen { color: Rgb::BLACK, color_texture: None, roughness: 0.0, roughness_texture: None };
    assert_eq!(extension("KHR_materials_sheen", json!({})).sheen, Some(none));
    let json = json!({
        "sheenColorFactor": [0.1, 0.2, 0.3], "sheenColorTexture": {"index": 1},
        "sheenRoughnessFactor": 0.25, "sheenRoughnessTexture": {"index": 0}
    });
    let all = Sheen {
        color: Rgb::new(0.1, 0.2, 0.3),
        color_texture: texture(0),
        roughness: 0.25,
        roughness_texture: texture(1),
    };
    assert_eq!(extension("KHR_materials_sheen", json).sheen, Some(all));
}

#[test]
fn anisotropy() {
    let none = Anisotropy { strength: 0.0, rotation: 0.0, texture: None };
    assert_eq!(extension("KHR_materials_anisotropy", json!({})).anisotropy, Some(none));
    let json = json!({
        "anisotropyStrength": 0.5, "anisotropyRotation": -7.0, "anisotropyTexture": {"index": 1}
    });
    let all = Anisotropy { strength: 0.5, rotation: -7.0, texture: texture(0) };
    assert_eq!(extension("KHR_materials_anisotropy", json).anisotropy, Some(all));
}

#[test]
fn iridescence() {
    let none = Iridescence {
        factor: 0.0,
        texture: None,
        ior: 1.3,
        thickness_min_nm: 100.0,
        thickness_max_nm: 400.0,
        thickness_texture: None,
    };
    assert_eq!(extension("KHR_materials_iridescence", json!({})).iridescence, Some(none));
    let json = json!({
        "iridescenceFactor": 0.5, "iridescenceTexture": {"index": 1}, "iridescenceIor": 1.8,
        "iridescenceThicknessMinimum": 500, "iridescenceThicknessMaximum": 200,
        "iridescenceThicknessTexture": {"index": 0}
    });
    let all = Iridescence {
        factor: 0.5,
        texture: texture(0),
        ior: 1.8,
        thickness_min_nm: 500.0,
        thickness_max_nm: 200.0,
        thickness_texture: texture(1),
    };
    assert_eq!(extension("KHR_materials_iridescence", json).iridescence, Some(all));
}

#[test]
fn diffuse_transmission_and_dispersion() {
    let none = DiffuseTransmission { factor: 0.0, texture: None, color: Rgb::WHITE, color_texture: None };
    let name = "KHR_materials_diffuse_transmission";
    assert_eq!(extension(name, json!({})).diffuse_transmission, Some(none));
    let json = json!({
        "diffuseTransmissionFactor": 0.5, "diffuseTransmissionTexture": {"index": 2},
        "diffuseTransmissionColorFactor": [0.1, 0.2, 0.3], "diffuseTransmissionColorTexture": {"index": 0}
    });
    let color = Rgb::new(0.1, 0.2, 0.3);
    let all = DiffuseTransmission { factor: 0.5, texture: texture(0), color, color_texture: texture(1) };
    assert_eq!(extension(name, json).diffuse_transmission, Some(all));
    assert_eq!(extension("KHR_materials_dispersion", json!({})).dispersion, 0.0);
    assert_eq!(extension("KHR_materials_dispersion", json!({"dispersion": 0.625})).dispersion, 0.625);
}

#[test]
fn lobes_out_of_range_are_clamped_with_a_warning() {
    for (name, value) in [
        ("KHR_materials_clearcoat", json!({"clearcoatFactor": 1.5})),
        ("KHR_materials_sheen", json!({"sheenColorFactor": [0, 2, 0]})),
        ("KHR_materials_anisotropy", json!({"anisotropyStrength": -1})),
        ("KHR_materials_iridescence", json!({"iridescenceIor": 0.5})),
        ("KHR_materials_iridescence", json!({"iridescenceThicknessMinimum": -5})),
        ("KHR_materials_dispersion", json!({"dispersion": -1})),
        ("KHR_materials_pbrSpecularGlossiness", json!({"specularFactor": [1, 1.5, 1]})),
    ] {
        let loaded = Gltf::triangle().material(json!({"extensions": {name: value}})).load().unwrap();
        assert_eq!(loaded.warnings.len(), 1, "{name} {:?}", loaded.warnings);
        let place = format!("/materials/0/extensions/{name}: factors ");
        assert!(loaded.warnings[0].starts_with(&place), "{:?}", loaded.warnings);
    }
}

const GLOSSY: &str = "KHR_materials_pbrSpecularGlossiness";

#[test]
fn specular_glossiness_without_textures() {
    let m = extension(GLOSSY, json!({}));
    assert_eq!((m.base_color, m.alpha, m.metallic, m.roughness), (Rgb::WHITE, 1.0, 0.0, 0.0));
    // An index of 0 makes the colour itself the reflectance.
    assert_eq!((m.ior, m.specular, m.specular_color), (0.0, 1.0, Rgb::WHITE));
    let json = json!({
        "diffuseFactor": [0.1, 0.2, 0.3, 0.4], "specularFactor": [0.5, 0.6, 0.7], "glossinessFactor": 0.75
    });
    // It comes before the other model and the extensions of the latter.
    let g = Gltf::triangle().material(json!({
        "pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1], "metallicFactor": 1, "roughnessFactor": 0.5},
        "alphaMode": "BLEND",
        "extensions": {GLOSSY: json, "KHR_materials_ior": {"ior": 1.4}}
    }));
    let m = &g.scene().materials[0];
    assert_eq!((m.base_color, m.alpha), (Rgb::new(0.1, 0.2, 0.3), 0.4));
    assert_eq!((m.metallic, m.roughness, m.ior), (0.0, 0.25, 0.0));
    assert_eq!(m.specular_color, Rgb::new(0.5, 0.6, 0.7));
}

#[test]
fn glossiness_of_a_texture_becomes_a_map_of_roughness() {
    let material = |factor: f32| {
        json!({"extensions": {GLOSSY: {
            "diffuseTexture": {"index": 0},
            "specularGlossinessTexture": {"index": 1, "texCoord": 1},
            "glossinessFactor": factor
        }}})
    };
    let mut g = textured();
    g.doc["materials"] = json!([material(0.5), material(1.0), material(0.5), material(0.0)]);
    let scene = g.scene();
    let [half, full, again, none] = &scene.materials[..] else { panic!("four materials") };
    let specular = half.specular_color_texture.unwrap();
    let rough = half.metallic_roughness_texture.unwrap();
    assert_eq!((specular.uv_set, rough.uv_set), (1, 1));
    assert_eq!((half.roughness, half.metallic), (1.0, 0.0));
    let image = |t: TextureRef| &scene.images[scene.textures[t.texture.index()].image.index()];
    assert_eq!(image(specular).rgba8, [10, 0, 0, 255, 0, 255, 0, 51]);
    // 255 - 0.5 · 255 and 255 - 0.5 · 51, rounded.
    let green = |t: TextureRef| [image(t).rgba8[1], image(t).rgba8[5]];
    assert_eq!(green(rough), [128, 230]);
    assert_eq!(green(full.metallic_roughness_texture.unwrap()), [0, 204]);
    assert_eq!(again.metallic_roughness_texture, half.metallic_roughness_texture);
    assert_eq!((none.metallic_roughness_texture, none.roughness), (None, 1.0));
    // Two from the file, two made.
    assert_eq!((scene.images.len(), scene.textures.len()), (4, 4));
}

#[test]
fn made_images_count_towards_the_limit() {
    let g = textured().material(json!({"extensions": {GLOSSY: {"specularGlossinessTexture": {"index": 1}}}}));
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.gltf");
    std::fs::write(&path, g.text()).unwrap();
    let load = |bytes| {
        let limits = Limits { max_total_image_bytes: bytes, ..Limits::default() };
        load_scene(&path, &LoadOptions { limits, ..LoadOptions::default() })
            .map(|_| ())
            .map_err(|e| e.to_string())
    };
    assert_eq!(load(16), Ok(()));
    let message = load(15).unwrap_err();
    assert!(message.ends_with("/images: decoded size of all images 16 exceeds the limit of 15"), "{message}");
}

#[test]
fn extensions_are_listed_once_and_sorted() {
    assert!(GLTF_EXTENSIONS.windows(2).all(|w| w[0].name < w[1].name));
}
