//! What a glTF document holds, counted from its JSON.

use serde_json::Value;
use std::collections::BTreeMap;

/// Counts of a document.
#[derive(Debug)]
pub(crate) struct Census {
    /// Triangles, each mesh as often as it is placed.
    pub(crate) triangles: u64,
    /// Meshes that are placed.
    pub(crate) meshes: usize,
    /// Nodes that place a mesh.
    pub(crate) instances: u64,
    /// Materials in use.
    pub(crate) materials: usize,
    /// Of these, those with a texture of colour or roughness.
    pub(crate) textured: usize,
    /// Of these, those with a normal map.
    pub(crate) normal_mapped: usize,
    /// Triangles of each mesh over its instances, by name and index.
    pub(crate) by_mesh: BTreeMap<(String, usize), u64>,
}

impl Census {
    pub(super) fn of(json: &Value) -> Census {
        let list = |key: &str| json[key].as_array().map(Vec::as_slice).unwrap_or_default();
        let (meshes, accessors, materials) = (list("meshes"), list("accessors"), list("materials"));
        let mut used = vec![false; materials.len()];
        let mut by_mesh = BTreeMap::new();
        let mut instances = 0;
        for index in list("nodes").iter().filter_map(|n| n["mesh"].as_u64()) {
            let mesh = &meshes[index as usize];
            instances += 1;
            for primitive in mesh["primitives"].as_array().into_iter().flatten() {
                let indices = primitive["indices"].as_u64().expect("all our primitives are indexed") as usize;
                let triangles = accessors[indices]["count"].as_u64().expect("accessors have a count") / 3;
                let name = mesh["name"].as_str().unwrap_or_default().to_owned();
                *by_mesh.entry((name, index as usize)).or_default() += triangles;
                if let Some(material) = primitive["material"].as_u64() {
                    used[material as usize] = true;
                }
            }
        }
        let used: Vec<&Value> =
            materials.iter().zip(used).filter_map(|(m, used)| used.then_some(m)).collect();
        let textured = |m: &&&Value| {
            let pbr = &m["pbrMetallicRoughness"];
            pbr["baseColorTexture"].is_object() || pbr["metallicRoughnessTexture"].is_object()
        };
        Census {
            triangles: by_mesh.values().sum(),
            meshes: by_mesh.len(),
            instances,
            materials: used.len(),
            textured: used.iter().filter(textured).count(),
            normal_mapped: used.iter().filter(|m| m["normalTexture"].is_object()).count(),
            by_mesh,
        }
    }

    /// The mesh with the most triangles over its instances, and its share of all.
    pub(crate) fn largest(&self) -> (&str, f64) {
        let largest = self.by_mesh.iter().max_by_key(|(_, triangles)| **triangles);
        largest.map_or(("", 0.0), |((name, _), t)| (name, *t as f64 / self.triangles as f64))
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Document, Material, Placement, icosphere};

    #[test]
    fn instances_count_and_unused_materials_do_not() {
        let mut document = Document::default();
        let grey = document.material(Material::new("grey", [0.5; 3], 1.0));
        let texture = document.texture_of("dot", b"", [1.0; 2]);
        document.material(Material::new("unused", [0.5; 3], 1.0).color_texture(texture));
        document.place("ball", &icosphere(1), grey);
        document.scatter("dots", &icosphere(0), grey, &[Placement::xyz(0.0, 0.0, 0.0); 8]);
        let census = document.census();
        assert_eq!((census.triangles, census.meshes, census.instances), (80 + 160, 2, 9));
        assert_eq!((census.materials, census.textured, census.normal_mapped), (1, 0, 0));
        assert_eq!(census.largest(), ("dots", 160.0 / 240.0));
    }
}
