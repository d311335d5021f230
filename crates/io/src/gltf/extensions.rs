//! Which extensions are read.

use super::document::Document;
use crate::IoError;
use crate::warnings::Warnings;

/// All that this loader reads.
pub(super) const SUPPORTED: &[&str] = &[
    "EXT_meshopt_compression",
    "EXT_texture_webp",
    "KHR_draco_mesh_compression",
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_meshopt_compression",
    "KHR_texture_basisu",
    "KHR_texture_transform",
];

/// Refuses scenes that require an extension that is not read; warns of those that merely use one.
pub(super) fn check(doc: &Document, warnings: &mut Warnings) -> Result<(), IoError> {
    let known = |name: &String| SUPPORTED.contains(&name.as_str());
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
