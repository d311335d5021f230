//! Materials in glTF's terms, written step by step.

use serde_json::{Map, Value, json};

/// A texture of a document; one repetition covers `size` in texture coordinates, which most meshes have in metres.
#[derive(Clone, Copy)]
pub(crate) struct Texture {
    pub(crate) index: usize,
    pub(crate) size: [f64; 2],
}

impl Texture {
    /// The same texture, stretched to another size.
    pub(crate) fn of_size(self, size: [f64; 2]) -> Texture {
        Texture { size, ..self }
    }

    fn reference(self) -> Value {
        let mut reference = json!({ "index": self.index });
        if self.size != [1.0; 2] {
            let scale = self.size.map(|s| 1.0 / s);
            reference["extensions"] = json!({ "KHR_texture_transform": { "scale": scale } });
        }
        reference
    }
}

/// A material under construction: a rough grey dielectric until told otherwise. Colours are linear.
#[derive(Clone)]
pub(crate) struct Material {
    json: Value,
    pbr: Map<String, Value>,
    extensions: Map<String, Value>,
}

impl Material {
    /// A dielectric of one colour and perceptual roughness.
    pub(crate) fn new(name: &str, [r, g, b]: [f64; 3], roughness: f64) -> Self {
        let mut pbr = Map::new();
        pbr.insert("baseColorFactor".into(), json!([r, g, b, 1.0]));
        pbr.insert("metallicFactor".into(), json!(0.0));
        pbr.insert("roughnessFactor".into(), json!(roughness));
        Material { json: json!({ "name": name }), pbr, extensions: Map::new() }
    }

    /// A metal.
    pub(crate) fn metal(name: &str, rgb: [f64; 3], roughness: f64) -> Self {
        let mut material = Self::new(name, rgb, roughness);
        material.pbr.insert("metallicFactor".into(), json!(1.0));
        material
    }

    fn set(mut self, key: &str, value: Value) -> Self {
        self.json[key] = value;
        self
    }

    /// The texture that multiplies the colour, and its alpha.
    pub(crate) fn color_texture(mut self, texture: Texture) -> Self {
        self.pbr.insert("baseColorTexture".into(), texture.reference());
        self
    }

    /// The texture whose green multiplies the roughness (and blue the metallic factor, which is 0 or 1 here).
    pub(crate) fn roughness_texture(mut self, texture: Texture) -> Self {
        self.pbr.insert("metallicRoughnessTexture".into(), texture.reference());
        self
    }

    /// The normal map and the factor on its slopes.
    pub(crate) fn normal_texture(self, texture: Texture, scale: f64) -> Self {
        let mut reference = texture.reference();
        reference["scale"] = json!(scale);
        self.set("normalTexture", reference)
    }

    /// Seen from both sides.
    pub(crate) fn double_sided(self) -> Self {
        self.set("doubleSided", json!(true))
    }

    /// There where alpha is at least `cutoff`.
    pub(crate) fn mask(self, cutoff: f64) -> Self {
        self.set("alphaMode", json!("MASK")).set("alphaCutoff", json!(cutoff))
    }

    /// There for the share alpha of the rays; `alpha` multiplies the texture's.
    pub(crate) fn blend(mut self, alpha: f64) -> Self {
        self.pbr["baseColorFactor"][3] = json!(alpha);
        self.set("alphaMode", json!("BLEND"))
    }

    /// Emits `color` (at most 1) times `strength` nits.
    pub(crate) fn emissive(self, color: [f64; 3], strength: f64) -> Self {
        let strong = json!({ "emissiveStrength": strength });
        self.set("emissiveFactor", json!(color)).extension("KHR_materials_emissive_strength", strong)
    }

    /// Transmits; a thin pane unless [`Material::volume`] gives it an inside.
    pub(crate) fn transmissive(self, ior: f64) -> Self {
        self.extension("KHR_materials_transmission", json!({ "transmissionFactor": 1.0 }))
            .extension("KHR_materials_ior", json!({ "ior": ior }))
    }

    /// A solid inside: white light has `color` after `distance` metres.
    pub(crate) fn volume(self, color: [f64; 3], distance: f64) -> Self {
        let volume =
            json!({ "thicknessFactor": 1.0, "attenuationColor": color, "attenuationDistance": distance });
        self.extension("KHR_materials_volume", volume)
    }

    /// A clear varnish.
    pub(crate) fn clearcoat(self, strength: f64, roughness: f64) -> Self {
        let coat = json!({ "clearcoatFactor": strength, "clearcoatRoughnessFactor": roughness });
        self.extension("KHR_materials_clearcoat", coat)
    }

    /// Strength of the dielectric reflection.
    pub(crate) fn specular(self, strength: f64) -> Self {
        self.extension("KHR_materials_specular", json!({ "specularFactor": strength }))
    }

    /// Any extension, by value.
    pub(crate) fn extension(mut self, name: &str, value: Value) -> Self {
        self.extensions.insert(name.into(), value);
        self
    }
}

impl From<Material> for Value {
    fn from(material: Material) -> Value {
        let mut json = material.json;
        json["pbrMetallicRoughness"] = Value::Object(material.pbr);
        if !material.extensions.is_empty() {
            json["extensions"] = Value::Object(material.extensions);
        }
        json
    }
}
