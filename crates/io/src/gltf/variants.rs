//! `KHR_materials_variants` (Khronos Group 2020): named sets of materials. The chosen one is written into the primitives of
//! the JSON before they are read, so that nothing else need know of it.

use super::document::Document;
use super::json::Object;
use crate::IoError;
use gltf::json::Index;

const NAME: &str = "KHR_materials_variants";

/// Gives each primitive the material that it has in the variant of this name.
pub(super) fn choose(doc: &mut Document, wanted: &str) -> Result<(), IoError> {
    let names = names(doc)?;
    let Some(variant) = names.iter().position(|name| name == wanted) else {
        return Err(IoError::not_there(doc.path, "variant", format!("{wanted:?}"), &names));
    };
    let mut changes = Vec::new();
    for (m, mesh) in doc.root.meshes.iter().enumerate() {
        for (p, primitive) in mesh.primitives.iter().enumerate() {
            let value = primitive.extensions.as_ref().and_then(|e| e.others.get(NAME));
            let place = || format!("/meshes/{m}/primitives/{p}/extensions/{NAME}");
            let Some(extension) = Object::new(doc, value, place)? else { continue };
            if let Some(material) = mapped(doc, &extension, variant, names.len())? {
                changes.push((m, p, material));
            }
        }
    }
    for (m, p, material) in changes {
        doc.root.meshes[m].primitives[p].material = Some(Index::new(material));
    }
    Ok(())
}

/// The names of the file's variants.
pub(super) fn names(doc: &Document) -> Result<Vec<String>, IoError> {
    let value = doc.root.extensions.as_ref().and_then(|e| e.others.get(NAME));
    let Some(extension) = Object::new(doc, value, || format!("/extensions/{NAME}"))? else {
        return Ok(Vec::new());
    };
    let name = |v: &Object| Ok(v.string("name")?.unwrap_or_default().to_string());
    extension.objects("variants")?.iter().map(name).collect()
}

/// The material that the mappings of a primitive give for a variant.
fn mapped(
    doc: &Document,
    extension: &Object,
    variant: usize,
    variants: usize,
) -> Result<Option<u32>, IoError> {
    for mapping in extension.objects("mappings")? {
        let list = mapping.indices("variants")?;
        if let Some(wrong) = list.iter().find(|v| **v >= variants) {
            let why = format!("refers to variant {wrong}, but there are {variants}");
            return Err(doc.error(format!("{}/variants", mapping.place()), why));
        }
        if !list.contains(&variant) {
            continue;
        }
        let here = || format!("{}/material", mapping.place());
        let Some(material) = mapping.index("material")? else {
            return Err(doc.error(here(), "is missing"));
        };
        doc.item(&doc.root.materials, material, "material", &here)?;
        return Ok(Some(material as u32));
    }
    Ok(None)
}
