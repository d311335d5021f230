//! The extensions that add a lobe to a material: clearcoat, sheen, anisotropy, iridescence, dispersion and diffuse
//! transmission (Khronos Group 2020 to 2024). Defaults are those of their schemas.

use super::Loader;
use crate::IoError;
use lumbre_core::Rgb;
use lumbre_scene::{Anisotropy, Clearcoat, DiffuseTransmission, Iridescence, Material, Sheen};

impl Loader<'_, '_> {
    /// Reads all of them.
    pub(super) fn lobes(&mut self, m: &mut Material) -> Result<(), IoError> {
        m.clearcoat = self.clearcoat()?;
        m.sheen = self.sheen()?;
        m.anisotropy = self.anisotropy()?;
        m.iridescence = self.iridescence()?;
        m.diffuse_transmission = self.diffuse_transmission()?;
        if let Some(e) = self.extension("KHR_materials_dispersion")? {
            m.dispersion = self.at_least(e.number("dispersion", 0.0)?, 0.0, e.place());
        }
        Ok(())
    }

    fn clearcoat(&mut self) -> Result<Option<Clearcoat>, IoError> {
        let Some(e) = self.extension("KHR_materials_clearcoat")? else { return Ok(None) };
        let normal = e.object("clearcoatNormalTexture")?;
        Ok(Some(Clearcoat {
            factor: self.unit(e.number("clearcoatFactor", 0.0)?, e.place()),
            texture: self.extension_texture(&e, "clearcoatTexture")?,
            roughness: self.unit(e.number("clearcoatRoughnessFactor", 0.0)?, e.place()),
            roughness_texture: self.extension_texture(&e, "clearcoatRoughnessTexture")?,
            normal_texture: self.extension_texture(&e, "clearcoatNormalTexture")?,
            normal_scale: normal.map_or(Ok(1.0), |n| n.number("scale", 1.0))?,
        }))
    }

    fn sheen(&mut self) -> Result<Option<Sheen>, IoError> {
        let Some(e) = self.extension("KHR_materials_sheen")? else { return Ok(None) };
        Ok(Some(Sheen {
            color: self.unit_color(e.color("sheenColorFactor", Rgb::BLACK)?, e.place()),
            color_texture: self.extension_texture(&e, "sheenColorTexture")?,
            roughness: self.unit(e.number("sheenRoughnessFactor", 0.0)?, e.place()),
            roughness_texture: self.extension_texture(&e, "sheenRoughnessTexture")?,
        }))
    }

    fn anisotropy(&mut self) -> Result<Option<Anisotropy>, IoError> {
        let Some(e) = self.extension("KHR_materials_anisotropy")? else { return Ok(None) };
        Ok(Some(Anisotropy {
            strength: self.unit(e.number("anisotropyStrength", 0.0)?, e.place()),
            rotation: e.number("anisotropyRotation", 0.0)?,
            texture: self.extension_texture(&e, "anisotropyTexture")?,
        }))
    }

    fn iridescence(&mut self) -> Result<Option<Iridescence>, IoError> {
        let Some(e) = self.extension("KHR_materials_iridescence")? else { return Ok(None) };
        Ok(Some(Iridescence {
            factor: self.unit(e.number("iridescenceFactor", 0.0)?, e.place()),
            texture: self.extension_texture(&e, "iridescenceTexture")?,
            ior: self.at_least(e.number("iridescenceIor", 1.3)?, 1.0, e.place()),
            thickness_min_nm: self.at_least(e.number("iridescenceThicknessMinimum", 100.0)?, 0.0, e.place()),
            thickness_max_nm: self.at_least(e.number("iridescenceThicknessMaximum", 400.0)?, 0.0, e.place()),
            thickness_texture: self.extension_texture(&e, "iridescenceThicknessTexture")?,
        }))
    }

    fn diffuse_transmission(&mut self) -> Result<Option<DiffuseTransmission>, IoError> {
        let Some(e) = self.extension("KHR_materials_diffuse_transmission")? else { return Ok(None) };
        Ok(Some(DiffuseTransmission {
            factor: self.unit(e.number("diffuseTransmissionFactor", 0.0)?, e.place()),
            texture: self.extension_texture(&e, "diffuseTransmissionTexture")?,
            color: self.unit_color(e.color("diffuseTransmissionColorFactor", Rgb::WHITE)?, e.place()),
            color_texture: self.extension_texture(&e, "diffuseTransmissionColorTexture")?,
        }))
    }

    fn at_least(&mut self, value: f32, least: f32, place: &str) -> f32 {
        if value < least {
            self.warnings.add(place, "factors below their range are clamped");
        }
        value.max(least)
    }
}
