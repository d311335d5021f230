//! A glTF 2.0 document under construction, written as one binary `.glb` or as `.gltf` with the buffer in a data URI.

#[cfg(test)]
use super::Census;
use super::{Mesh, Placement, Texture};
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

/// The document: arrays named as in glTF, and the bytes they point into.
#[derive(Default)]
pub(crate) struct Document {
    nodes: Vec<Value>,
    meshes: Vec<Value>,
    materials: Vec<Value>,
    cameras: Vec<Value>,
    lights: Vec<Value>,
    textures: Vec<Value>,
    images: Vec<Value>,
    accessors: Vec<Value>,
    buffer_views: Vec<Value>,
    variants: Vec<Value>,
    extensions: BTreeSet<String>,
    /// `extras` of the scene: its sky.
    extras: Value,
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
        if !mesh.colors.is_empty() {
            attributes["COLOR_0"] = json!(self.color_accessor(&mesh.colors));
        }
        Geometry { attributes, indices: self.index_accessor(mesh) }
    }

    /// Colours in 8 bits each, padded to four bytes by an alpha of 1.
    fn color_accessor(&mut self, colors: &[DVec3]) -> usize {
        let byte = |x: f64| (x.clamp(0.0, 1.0) * 255.0).round() as u8;
        let bytes: Vec<u8> = colors.iter().flat_map(|c| [byte(c.x), byte(c.y), byte(c.z), 255]).collect();
        let view = self.view(&bytes, Some(ARRAY_BUFFER));
        self.accessors.push(json!({
            "bufferView": view, "componentType": 5121, "normalized": true, "count": colors.len(), "type": "VEC4",
        }));
        self.accessors.len() - 1
    }

    /// Indices of 16 bits, of 32 where there are too many vertices (65535 is the primitive restart value).
    fn index_accessor(&mut self, mesh: &Mesh) -> usize {
        let indices = mesh.triangles.as_flattened();
        let small = mesh.positions.len() <= 65535;
        let bytes: Vec<u8> = if small {
            indices.iter().flat_map(|&i| (i as u16).to_le_bytes()).collect()
        } else {
            indices.iter().flat_map(|i| i.to_le_bytes()).collect()
        };
        let view = self.view(&bytes, Some(ELEMENT_ARRAY_BUFFER));
        let kind = if small { 5123 } else { 5125 };
        self.accessors.push(
            json!({ "bufferView": view, "componentType": kind, "count": indices.len(), "type": "SCALAR" }),
        );
        self.accessors.len() - 1
    }

    /// Adds a material, a [`super::Material`] or glTF JSON, and returns its index; the extensions it names are declared.
    pub(crate) fn material(&mut self, material: impl Into<Value>) -> usize {
        let material = material.into();
        if let Some(extensions) = material["extensions"].as_object() {
            self.extensions.extend(extensions.keys().cloned());
        }
        if material.to_string().contains("KHR_texture_transform") {
            self.extensions.insert("KHR_texture_transform".into());
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

    /// Adds a PNG as a texture of which one repetition covers `width` × `height` metres of texture coordinates in metres.
    pub(crate) fn texture_of(&mut self, name: &str, png: &[u8], size: [f64; 2]) -> Texture {
        Texture { index: self.texture(name, png), size }
    }

    /// Adds a mesh of one primitive for each pair of geometry and material, and returns its index.
    pub(crate) fn mesh(&mut self, name: &str, parts: &[(&Geometry, usize)]) -> usize {
        let primitives: Vec<Value> = parts
            .iter()
            .map(|(g, material)| json!({ "attributes": g.attributes, "indices": g.indices, "material": material }))
            .collect();
        self.meshes.push(json!({ "name": name, "primitives": primitives }));
        self.meshes.len() - 1
    }

    /// Adds a root node that shows a mesh.
    pub(crate) fn instance(&mut self, name: &str, mesh: usize, placement: &Placement) {
        let mut node = json!({ "name": name, "mesh": mesh });
        placement.write(&mut node);
        self.nodes.push(node);
    }

    /// Adds a node that shows `geometry` in `material`, as a mesh of its own.
    pub(crate) fn object(&mut self, name: &str, geometry: &Geometry, material: usize, placement: &Placement) {
        let mesh = self.mesh(name, &[(geometry, material)]);
        self.instance(name, mesh, placement);
    }

    /// Adds a mesh that is already in world coordinates, with its node.
    pub(crate) fn place(&mut self, name: &str, mesh: &Mesh, material: usize) {
        let geometry = self.geometry(mesh);
        self.object(name, &geometry, material, &Placement::at(DVec3::ZERO));
    }

    /// Adds a mesh and a node for each placement, all named alike.
    pub(crate) fn scatter(&mut self, name: &str, mesh: &Mesh, material: usize, placements: &[Placement]) {
        let geometry = self.geometry(mesh);
        let mesh = self.mesh(name, &[(&geometry, material)]);
        placements.iter().for_each(|p| self.instance(name, mesh, p));
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

    /// Adds a camera at `eye` that looks at `target`, +y up in the picture; `aspect` is width over height. The first is the
    /// scene's default.
    pub(crate) fn camera(&mut self, name: &str, [eye, target]: [DVec3; 2], yfov_deg: f64, aspect: f64) {
        let perspective = json!({ "yfov": yfov_deg.to_radians(), "aspectRatio": aspect, "znear": 0.01 });
        self.cameras.push(json!({ "name": name, "type": "perspective", "perspective": perspective }));
        let mut node = json!({ "name": name, "camera": self.cameras.len() - 1 });
        Placement::looking(eye, target).write(&mut node);
        self.nodes.push(node);
    }

    /// Adds a light of `KHR_lights_punctual` (its JSON) that shines along -z of its placement.
    pub(crate) fn light(&mut self, name: &str, light: Value, placement: &Placement) {
        let mut light = light;
        light["name"] = json!(name);
        self.lights.push(light);
        self.extensions.insert("KHR_lights_punctual".into());
        let extension = json!({ "KHR_lights_punctual": { "light": self.lights.len() - 1 } });
        let mut node = json!({ "name": name, "extensions": extension });
        placement.write(&mut node);
        self.nodes.push(node);
    }

    /// Gives the scene the sky that Lumbre reads from its `extras`: `"gradient"` or a linear colour.
    pub(crate) fn sky(&mut self, sky: impl Into<Value>) {
        self.extras = json!({ "lumbre": { "sky": sky.into() } });
    }

    /// What the document holds, counted.
    #[cfg(test)]
    pub(crate) fn census(&self) -> Census {
        Census::of(&self.json(None))
    }

    /// The JSON part. `uri` is that of the only buffer, absent in a `.glb`.
    fn json(&self, uri: Option<String>) -> Value {
        let roots: Vec<usize> = (0..self.nodes.len()).collect();
        let mut buffer = json!({ "byteLength": self.bytes.len() });
        if let Some(uri) = uri {
            buffer["uri"] = json!(uri);
        }
        let mut scene = json!({ "nodes": roots });
        if !self.extras.is_null() {
            scene["extras"] = self.extras.clone();
        }
        let mut root = Map::new();
        root.insert(
            "asset".into(),
            // A name of long standing, which files that did not change keep.
            json!({ "version": "2.0", "generator": "Lumbre make_scenes", "copyright": "MIT OR Apache-2.0" }),
        );
        root.insert("scene".into(), json!(0));
        root.insert("scenes".into(), json!([scene]));
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
        let mut extensions = Map::new();
        if !self.lights.is_empty() {
            extensions.insert("KHR_lights_punctual".into(), json!({ "lights": self.lights }));
        }
        if !self.variants.is_empty() {
            extensions.insert("KHR_materials_variants".into(), json!({ "variants": self.variants }));
        }
        if !extensions.is_empty() {
            root.insert("extensions".into(), Value::Object(extensions));
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
            ("fooba", "Zm9vYmE="),
            ("foobar", "Zm9vYmFy"),
        ];
        for (plain, coded) in cases {
            assert_eq!(base64(plain.as_bytes()), coded);
        }
    }

    #[test]
    fn parts_of_a_glb_are_aligned_and_their_lengths_true() {
        let mut document = Document::default();
        document.place("ball", &super::super::icosphere(1), 0);
        let file = document.to_glb();
        let word = |at: usize| u32::from_le_bytes(file[at..at + 4].try_into().unwrap()) as usize;
        assert_eq!((&file[..4], word(4), word(8)), (&b"glTF"[..], 2, file.len()));
        let binary = 20 + word(12);
        assert_eq!(
            (word(12) % 4, &file[16..20], &file[binary + 4..binary + 8]),
            (0, &b"JSON"[..], &b"BIN\0"[..])
        );
        assert_eq!(binary + 8 + word(binary), file.len());
    }
}
