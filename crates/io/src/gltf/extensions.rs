//! Which extensions are read.

use super::document::Document;
use crate::IoError;
use crate::warnings::Warnings;

/// An extension of glTF that the loader knows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GltfExtension {
    /// Its name.
    pub name: &'static str,
    /// What it brings, in a few words.
    pub brings: &'static str,
    /// How much of it is read.
    pub support: Support,
}

/// How much of an extension is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Support {
    /// All of it.
    Full,
    /// All but this.
    Without(&'static str),
    /// It says nothing about the picture.
    NotNeeded,
}

const fn full(name: &'static str, brings: &'static str) -> GltfExtension {
    GltfExtension { name, brings, support: Support::Full }
}

const fn without(name: &'static str, brings: &'static str, what: &'static str) -> GltfExtension {
    GltfExtension { name, brings, support: Support::Without(what) }
}

const fn not_needed(name: &'static str, brings: &'static str) -> GltfExtension {
    GltfExtension { name, brings, support: Support::NotNeeded }
}

/// All that this loader knows, by name. Every other extension is an error where a scene requires it, a warning elsewhere.
pub const GLTF_EXTENSIONS: &[GltfExtension] = &[
    full("EXT_mesh_gpu_instancing", "many copies of a mesh"),
    full("EXT_meshopt_compression", "compressed buffers"),
    full("EXT_texture_webp", "WebP textures"),
    full("KHR_draco_mesh_compression", "compressed meshes"),
    full("KHR_lights_punctual", "point, spot and directional lights"),
    full("KHR_materials_anisotropy", "microfacets stretched along one direction"),
    full("KHR_materials_clearcoat", "a clear varnish"),
    full("KHR_materials_diffuse_transmission", "diffuse light through leaves and paper"),
    full("KHR_materials_dispersion", "refraction that depends on the wavelength"),
    full("KHR_materials_emissive_strength", "emission above 1"),
    full("KHR_materials_ior", "the index of refraction"),
    full("KHR_materials_iridescence", "a thin film"),
    full("KHR_materials_pbrSpecularGlossiness", "the older specular-glossiness model"),
    full("KHR_materials_sheen", "cloth"),
    full("KHR_materials_specular", "strength and colour of a dielectric's reflection"),
    full("KHR_materials_transmission", "glass"),
    full("KHR_materials_unlit", "colours without light"),
    full("KHR_materials_variants", "sets of materials to choose from"),
    without(
        "KHR_materials_volume",
        "the inside of glass",
        "the thickness texture, which only rasterisers need",
    ),
    full("KHR_mesh_quantization", "vertices in small integers"),
    full("KHR_meshopt_compression", "compressed buffers"),
    full("KHR_node_visibility", "hidden nodes"),
    full("KHR_texture_basisu", "KTX2 textures"),
    full("KHR_texture_transform", "moved, turned and scaled textures"),
    not_needed("KHR_xmp", "metadata"),
    not_needed("KHR_xmp_json_ld", "metadata"),
];

/// Refuses scenes that require an extension that is not read; warns of those that merely use one.
pub(super) fn check(doc: &Document, warnings: &mut Warnings) -> Result<(), IoError> {
    let known = |name: &String| GLTF_EXTENSIONS.iter().any(|e| e.name == name);
    let missing: Vec<_> =
        doc.root.extensions_required.iter().filter(|n| !known(n)).map(String::as_str).collect();
    if !missing.is_empty() {
        let plural = if missing.len() > 1 { "extensions" } else { "extension" };
        let what = format!("the required {plural} {}", missing.join(", "));
        return Err(doc.unsupported("/extensionsRequired", what));
    }
    for name in doc.root.extensions_used.iter().filter(|n| !known(n)) {
        warnings.add("/extensionsUsed", format!("the extension {name} is not supported and is ignored"));
    }
    Ok(())
}
