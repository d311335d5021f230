//! Materials: metallic-roughness (glTF 2.0, 3.9) and the extensions of `extensions.rs`. Occlusion is not read: light
//! transport finds it by itself.

mod glossiness;
mod lobes;

pub(super) use glossiness::Glossy;

use super::document::Document;
use super::json::Object;
use super::textures::{TextureInfo, TextureTable};
use crate::IoError;
use crate::warnings::Warnings;
use gltf::json;
use gltf::json::Value;
use gltf::json::material::AlphaMode as JsonAlpha;
use gltf::json::validation::Checked;
use lumbre_core::Rgb;
use lumbre_scene::{AlphaMode, Material, TextureRef, Volume};

const TRANSFORM: &str = "KHR_texture_transform";

/// Reads every material; material `i` of the file becomes material `i` of the scene.
pub(super) fn load_all(
    doc: &Document,
    table: &mut TextureTable,
    warnings: &mut Warnings,
) -> Result<Vec<Material>, IoError> {
    let mut out = Vec::with_capacity(doc.root.materials.len());
    for (i, json) in doc.root.materials.iter().enumerate() {
        let mut loader = Loader { doc, json, place: format!("/materials/{i}"), table, warnings };
        out.push(loader.load()?);
    }
    Ok(out)
}

struct Loader<'a, 't> {
    doc: &'a Document<'a>,
    json: &'a json::Material,
    place: String,
    table: &'t mut TextureTable,
    warnings: &'t mut Warnings,
}

impl<'a> Loader<'a, '_> {
    fn load(&mut self) -> Result<Material, IoError> {
        let mut m = Material {
            name: self.json.name.clone().unwrap_or_default(),
            double_sided: self.json.double_sided,
            ..Material::default()
        };
        self.metallic_roughness(&mut m)?;
        self.normal_and_alpha(&mut m)?;
        self.emission(&mut m)?;
        self.dielectric(&mut m)?;
        self.transmission(&mut m)?;
        self.lobes(&mut m)?;
        // Last: a material that has both models means this one.
        self.specular_glossiness(&mut m)?;
        m.unlit = self.extension("KHR_materials_unlit")?.is_some();
        Ok(m)
    }

    fn metallic_roughness(&mut self, m: &mut Material) -> Result<(), IoError> {
        let pbr = &self.json.pbr_metallic_roughness;
        let [r, g, b, a] = pbr.base_color_factor.0;
        let place = format!("{}/pbrMetallicRoughness", self.place);
        m.base_color = self.unit_color(Rgb::new(r, g, b), &place);
        m.alpha = self.unit(a, &place);
        m.metallic = self.unit(pbr.metallic_factor.0, &place);
        m.roughness = self.unit(pbr.roughness_factor.0, &place);
        m.base_color_texture =
            self.core_texture(pbr.base_color_texture.as_ref(), &format!("{place}/baseColorTexture"))?;
        m.metallic_roughness_texture = self.core_texture(
            pbr.metallic_roughness_texture.as_ref(),
            &format!("{place}/metallicRoughnessTexture"),
        )?;
        Ok(())
    }

    fn normal_and_alpha(&mut self, m: &mut Material) -> Result<(), IoError> {
        if let Some(normal) = &self.json.normal_texture {
            let place = format!("{}/normalTexture", self.place);
            let info = TextureInfo {
                index: normal.index.value(),
                tex_coord: normal.tex_coord as usize,
                transform: normal.extensions.as_ref().and_then(|e| e.others.get(TRANSFORM)),
            };
            m.normal_texture = Some(self.table.reference(self.doc, info, &place, self.warnings)?);
            if !normal.scale.is_finite() {
                return Err(self.doc.error(place + "/scale", "is not finite"));
            }
            m.normal_scale = normal.scale;
        }
        m.alpha_mode = match self.json.alpha_mode {
            Checked::Valid(JsonAlpha::Opaque) => AlphaMode::Opaque,
            Checked::Valid(JsonAlpha::Mask) => {
                AlphaMode::Mask { cutoff: self.json.alpha_cutoff.unwrap_or_default().0 }
            }
            Checked::Valid(JsonAlpha::Blend) => AlphaMode::Blend,
            Checked::Invalid => {
                return Err(self.doc.error(format!("{}/alphaMode", self.place), "is none of glTF's modes"));
            }
        };
        Ok(())
    }

    fn emission(&mut self, m: &mut Material) -> Result<(), IoError> {
        let strength = match self.extension("KHR_materials_emissive_strength")? {
            Some(e) => e.number("emissiveStrength", 1.0)?,
            None => 1.0,
        };
        let place = format!("{}/emissiveFactor", self.place);
        m.emission = self.positive(Rgb::from_array(self.json.emissive_factor.0) * strength, &place);
        let place = format!("{}/emissiveTexture", self.place);
        m.emissive_texture = self.core_texture(self.json.emissive_texture.as_ref(), &place)?;
        Ok(())
    }

    /// `KHR_materials_ior` and `KHR_materials_specular`.
    fn dielectric(&mut self, m: &mut Material) -> Result<(), IoError> {
        if let Some(e) = self.extension("KHR_materials_ior")? {
            m.ior = e.number("ior", 1.5)?;
            // 0 stands for an infinite index.
            if m.ior != 0.0 && m.ior < 1.0 {
                self.warnings.add(e.place(), "an index of refraction below 1 is set to 1");
                m.ior = 1.0;
            }
        }
        if let Some(e) = self.extension("KHR_materials_specular")? {
            m.specular = self.unit(e.number("specularFactor", 1.0)?, e.place());
            m.specular_color = self.positive(e.color("specularColorFactor", Rgb::WHITE)?, e.place());
            m.specular_texture = self.extension_texture(&e, "specularTexture")?;
            m.specular_color_texture = self.extension_texture(&e, "specularColorTexture")?;
        }
        Ok(())
    }

    /// `KHR_materials_transmission` and `KHR_materials_volume`.
    fn transmission(&mut self, m: &mut Material) -> Result<(), IoError> {
        if let Some(e) = self.extension("KHR_materials_transmission")? {
            m.transmission = self.unit(e.number("transmissionFactor", 0.0)?, e.place());
            m.transmission_texture = self.extension_texture(&e, "transmissionTexture")?;
        }
        if let Some(e) = self.extension("KHR_materials_volume")? {
            // Rays travel through the mesh itself, so that a thickness only tells whether there is an inside; its texture
            // is of use to rasterisers alone.
            let thickness = e.number("thicknessFactor", 0.0)?;
            let mut attenuation_distance = e.number("attenuationDistance", f32::INFINITY)?;
            if attenuation_distance <= 0.0 {
                self.warnings.add(e.place(), "an attenuation distance that is not positive is ignored");
                attenuation_distance = f32::INFINITY;
            }
            let attenuation_color = self.unit_color(e.color("attenuationColor", Rgb::WHITE)?, e.place());
            m.volume =
                (thickness > 0.0).then_some(Volume { thickness, attenuation_color, attenuation_distance });
        }
        Ok(())
    }

    fn extension(&self, name: &str) -> Result<Option<Object<'a>>, IoError> {
        let value = self.json.extensions.as_ref().and_then(|e| e.others.get(name));
        Object::new(self.doc, value, || format!("{}/extensions/{name}", self.place))
    }

    fn core_texture(
        &mut self,
        info: Option<&json::texture::Info>,
        place: &str,
    ) -> Result<Option<TextureRef>, IoError> {
        let Some(info) = info else { return Ok(None) };
        let info = TextureInfo {
            index: info.index.value(),
            tex_coord: info.tex_coord as usize,
            transform: info.extensions.as_ref().and_then(|e| e.others.get(TRANSFORM)),
        };
        self.table.reference(self.doc, info, place, self.warnings).map(Some)
    }

    fn extension_texture(&mut self, e: &Object<'a>, key: &str) -> Result<Option<TextureRef>, IoError> {
        let Some(json) = e.object(key)? else { return Ok(None) };
        let Some(index) = json.index("index")? else {
            return Err(self.doc.error(json.place(), "has no index"));
        };
        let info = TextureInfo {
            index,
            tex_coord: json.index("texCoord")?.unwrap_or(0),
            transform: json.value("extensions").and_then(|e: &Value| e.get(TRANSFORM)),
        };
        self.table.reference(self.doc, info, json.place(), self.warnings).map(Some)
    }

    fn unit(&mut self, value: f32, place: &str) -> f32 {
        let clamped = value.clamp(0.0, 1.0);
        if clamped != value {
            self.warnings.add(place, "factors out of 0 to 1 are clamped");
        }
        clamped
    }

    fn unit_color(&mut self, color: Rgb, place: &str) -> Rgb {
        Rgb::from_array(color.to_array().map(|c| self.unit(c, place)))
    }

    fn positive(&mut self, color: Rgb, place: &str) -> Rgb {
        let clamped = color.map(|c| c.clamp(0.0, f32::MAX));
        if clamped != color {
            self.warnings.add(place, "negative or infinite factors are clamped");
        }
        clamped
    }
}
