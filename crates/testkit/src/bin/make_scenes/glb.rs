//! A glTF 2.0 document under construction, written as one binary `.glb` or as `.gltf` with the buffer in a data URI.

use crate::mesh::Mesh;
use glam::DVec3;
use serde_json::{Map, Value, json};
use std::collections::BTreeSet;

const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// Accessors of one mesh's vertices and indices: several meshes may show the same geometry in different materials.
#[derive(Clone)]
pub(crate) struct Geometry {
    attributes: Value,
    indices: usize,
}

/// Where a node stands: scaled, then turned, then moved.
pub(crate) struct Placement {
    pub(crate) translation: DVec3,
    pub(crate) rotation: glam::DQuat,
    pub(crate) scale: DVec3,
}

impl Placement {
    /// At `translation`, neither turned nor scaled.
    pub(crate) fn at(translation: DVec3) -> Self {
        Self { translation, rotation: glam::DQuat::IDENTITY, scale: DVec3::ONE }
    }

    /// Turned by `degrees` about +y.
    pub(crate) fn turned_y(self, degrees: f64) -> Self {
        // Sine and cosine from libm, not from the platform: the file must not depend on it.
        let (s, c) = libm::sincos(degrees.to_radians() / 2.0);
        Self { rotation: glam::DQuat::from_xyzw(0.0, s, 0.0, c), ..self }
    }

    /// Scaled by `factor` in all directions.
    pub(crate) fn scaled(self, factor: f64) -> Self {
        Self { scale: DVec3::splat(factor), ..self }
    }
}

/// The document: arrays named as in glTF, and the bytes they point into.
#[derive(Default)]
pub(crate) struct Document {
    nodes: Vec<Value>,
    meshes: Vec<Value>,
    materials: Vec<Value>,
    cameras: Vec<Value>,
    textures: Vec<Value>,
    images: Vec<Value>,
    accessors: Vec<Value>,
    buffer_views: Vec<Value>,
    variants: Vec<Value>,
    extensions: BTreeSet<String>,
    bytes: Vec<u8>,
}

impl Document {
    /// Adds bytes as a buffer view, aligned to four, and returns its index.
    fn view(&mut self, bytes: &[u8], target: Option<u32>) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let mut view = json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        self.bytes.extend(bytes);
        self.buffer_views.push(view);
        self.buffer_views.len() - 1
    }

    /// Adds an accessor over `rows` of floats, with bounds when asked, and returns its index.
    fn float_accessor<const N: usize>(&mut self, rows: &[[f32; N]], bounds: bool) -> usize {
        let bytes: Vec<u8> = rows.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect();
        let view = self.view(&bytes, Some(ARRAY_BUFFER));
        let mut accessor = json!({ "bufferView": view, "componentType": 5126, "count": rows.len(), "type": format!("VEC{N}") });
        if bounds {
            let fold = |pick: fn(f32, f32) -> f32| -> Vec<f32> {
                (0..N)
                    .map(|i| rows.iter().map(|row| row[i]).reduce(pick).expect("a mesh has vertices"))
                    .collect()
            };
            accessor["min"] = json!(fold(f32::min));
            accessor["max"] = json!(fold(f32::max));
        }
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    /// Stores the vertices and indices of a mesh.
    pub(crate) fn geometry(&mut self, mesh: &Mesh) -> Geometry {
        // Adding 0 turns -0 into 0, which reads better and compares equal.
        let rows = |points: &[DVec3]| -> Vec<[f32; 3]> {
            points.iter().map(|p| p.as_vec3().to_array().map(|x| x + 0.0)).collect()
        };
        let mut attributes = json!({
            "POSITION": self.float_accessor(&rows(&mesh.positions), true),
            "NORMAL": self.float_accessor(&rows(&mesh.normals), false),
        });
        if !mesh.uvs.is_empty() {
            let uvs: Vec<[f32; 2]> = mesh.uvs.iter().map(|uv| uv.as_vec2().to_array()).collect();
            attributes["TEXCOORD_0"] = json!(self.float_accessor(&uvs, false));
        }
        let bytes: Vec<u8> = mesh.triangles.as_flattened().iter().flat_map(|i| i.to_le_bytes()).collect();
        let view = self.view(&bytes, Some(ELEMENT_ARRAY_BUFFER));
        self.accessors.push(json!({ "bufferView": view, "componentType": 5123, "count": mesh.triangles.len() * 3, "type": "SCALAR" }));
        Geometry { attributes, indices: self.accessors.len() - 1 }
    }

    /// Adds a material as glTF JSON and returns its index; the extensions it names are declared.
    pub(crate) fn material(&mut self, material: Value) -> usize {
        if let Some(extensions) = material["extensions"].as_object() {
            self.extensions.extend(extensions.keys().cloned());
        }
        self.materials.push(material);
        self.materials.len() - 1
    }

    /// Adds a PNG as a texture that repeats (glTF's default sampler) and returns the texture's index.
    pub(crate) fn texture(&mut self, name: &str, png: &[u8]) -> usize {
        let view = self.view(png, None);
        self.images.push(json!({ "name": name, "bufferView": view, "mimeType": "image/png" }));
        self.textures.push(json!({ "source": self.images.len() - 1 }));
        self.textures.len() - 1
    }

    /// Adds a node that shows `geometry` in `material`.
    pub(crate) fn object(&mut self, name: &str, geometry: &Geometry, material: usize, placement: &Placement) {
        let primitive =
            json!({ "attributes": geometry.attributes, "indices": geometry.indices, "material": material });
        self.meshes.push(json!({ "name": name, "primitives": [primitive] }));
        let mut node = json!({ "name": name, "mesh": self.meshes.len() - 1 });
        placement.write(&mut node);
        self.nodes.push(node);
    }

    /// Declares a variant of the scene (`KHR_materials_variants`).
    pub(crate) fn variant(&mut self, name: &str) {
        self.variants.push(json!({ "name": name }));
        self.extensions.insert("KHR_materials_variants".into());
    }

    /// Adds a node that shows `geometry` in one of `materials` for each variant, in the first by default.
    pub(crate) fn object_of_variants(
        &mut self,
        name: &str,
        geometry: &Geometry,
        materials: &[usize],
        placement: &Placement,
    ) {
        assert_eq!(materials.len(), self.variants.len(), "one material for each variant");
        self.object(name, geometry, materials[0], placement);
        let mappings: Vec<Value> = materials
            .iter()
            .enumerate()
            .map(|(variant, material)| json!({ "material": material, "variants": [variant] }))
            .collect();
        let mesh = self.meshes.last_mut().expect("just added");
        mesh["primitives"][0]["extensions"] = json!({ "KHR_materials_variants": { "mappings": mappings } });
    }

    /// Adds a camera at `eye` that looks at `target`, +y up in the picture; `aspect` is width over height.
    pub(crate) fn camera(&mut self, eye: DVec3, target: DVec3, yfov_deg: f64, aspect: f64) {
        let back = (eye - target).normalize();
        let right = DVec3::Y.cross(back).normalize();
        let rotation = glam::DQuat::from_mat3(&glam::DMat3::from_cols(right, back.cross(right), back));
        let perspective = json!({ "yfov": yfov_deg.to_radians(), "aspectRatio": aspect, "znear": 0.01 });
        self.cameras.push(json!({ "name": "camera", "type": "perspective", "perspective": perspective }));
        let mut node = json!({ "name": "camera", "camera": self.cameras.len() - 1 });
        Placement { rotation, ..Placement::at(eye) }.write(&mut node);
        self.nodes.push(node);
    }

    /// The JSON part. `uri` is that of the only buffer, absent in a `.glb`.
    fn json(&self, uri: Option<String>) -> Value {
        let roots: Vec<usize> = (0..self.nodes.len()).collect();
        let mut buffer = json!({ "byteLength": self.bytes.len() });
        if let Some(uri) = uri {
            buffer["uri"] = json!(uri);
        }
        let mut root = Map::new();
        root.insert(
            "asset".into(),
            json!({ "version": "2.0", "generator": "Lumbre make_scenes", "copyright": "MIT OR Apache-2.0" }),
        );
        root.insert("scene".into(), json!(0));
        root.insert("scenes".into(), json!([{ "nodes": roots }]));
        root.insert("buffers".into(), json!([buffer]));
        let arrays = [
            ("nodes", &self.nodes),
            ("meshes", &self.meshes),
            ("materials", &self.materials),
            ("cameras", &self.cameras),
            ("textures", &self.textures),
            ("images", &self.images),
            ("accessors", &self.accessors),
            ("bufferViews", &self.buffer_views),
        ];
        // glTF forbids empty arrays.
        root.extend(
            arrays
                .into_iter()
                .filter(|(_, array)| !array.is_empty())
                .map(|(name, array)| (name.into(), json!(array))),
        );
        if !self.variants.is_empty() {
            let variants = json!({ "KHR_materials_variants": { "variants": self.variants } });
            root.insert("extensions".into(), variants);
        }
        if !self.extensions.is_empty() {
            root.insert("extensionsUsed".into(), json!(self.extensions));
        }
        Value::Object(root)
    }

    /// The document as a `.glb` file (glTF 2.0, section 4).
    pub(crate) fn to_glb(&self) -> Vec<u8> {
        let mut text = self.json(None).to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let mut binary = self.bytes.clone();
        binary.resize(binary.len().next_multiple_of(4), 0);
        let mut file = b"glTF".to_vec();
        file.extend(2u32.to_le_bytes());
        file.extend(((12 + 8 + text.len() + 8 + binary.len()) as u32).to_le_bytes());
        for (kind, data) in [(b"JSON", &text), (b"BIN\0", &binary)] {
            file.extend((data.len() as u32).to_le_bytes());
            file.extend(kind);
            file.extend(data);
        }
        file
    }

    /// The document as one `.gltf` file.
    pub(crate) fn to_gltf(&self) -> Vec<u8> {
        let uri = format!("data:application/octet-stream;base64,{}", base64(&self.bytes));
        let mut text = serde_json::to_vec_pretty(&self.json(Some(uri))).expect("a JSON value can be written");
        text.push(b'\n');
        text
    }
}

impl Placement {
    /// Writes translation, rotation and scale into a node, leaving out what changes nothing.
    fn write(&self, node: &mut Value) {
        if self.translation != DVec3::ZERO {
            node["translation"] = json!(self.translation.to_array());
        }
        if self.rotation != glam::DQuat::IDENTITY {
            node["rotation"] = json!(self.rotation.to_array());
        }
        if self.scale != DVec3::ONE {
            node["scale"] = json!(self.scale.to_array());
        }
    }
}

/// Base64 with padding (RFC 4648, section 4).
fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::new();
    for three in bytes.chunks(3) {
        let word = (0..3).fold(0u32, |word, i| word << 8 | u32::from(*three.get(i).unwrap_or(&0)));
        for i in 0..4 {
            text.push(if i <= three.len() {
                char::from(DIGITS[(word >> (18 - 6 * i) & 63) as usize])
            } else {
                '='
            });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_of_the_rfc() {
        let cases = [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foob", "Zm9vYg=="),
            ("foobar", "Zm9vYmFy"),
        ];
        for (plain, coded) in cases {
            assert_eq!(base64(plain.as_bytes()), coded);
        }
    }
}
