//! What the tests share: small glTFs made in memory, and where the large scenes lie.
#![allow(dead_code, unreachable_pub, reason = "each test binary uses a part of it")]

pub mod texts;

use base64::Engine;
use lumbre_io::{IoError, LoadOptions, Loaded, load_scene};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// The folder of third-party scenes, if this machine has it.
pub fn scenes_folder() -> Option<PathBuf> {
    let folder = std::env::var_os("LUMBRE_SCENES")
        .map(PathBuf::from)
        .unwrap_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/scenes"));
    if folder.is_dir() {
        return Some(folder);
    }
    eprintln!("skipped: no scenes at {} (set LUMBRE_SCENES)", folder.display());
    None
}

/// A glTF with one triangle, to be changed and loaded.
pub struct Gltf {
    /// The JSON, without the buffer.
    pub doc: Value,
    /// The buffer.
    pub bytes: Vec<u8>,
}

impl Gltf {
    /// One node, one mesh, one indexed triangle: accessor 0 is POSITION, 1 the indices.
    pub fn triangle() -> Gltf {
        let mut g = Gltf {
            doc: json!({
                "asset": {"version": "2.0"},
                "scene": 0,
                "scenes": [{"nodes": [0]}],
                "nodes": [{"mesh": 0}],
                "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
                "bufferViews": [], "accessors": [],
            }),
            bytes: Vec::new(),
        };
        g.f32s("VEC3", &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
        g.u16s(&[0, 1, 2]);
        g
    }

    /// Adds an accessor with a view of its own.
    pub fn raw(&mut self, component: u32, kind: &str, count: usize, bytes: &[u8]) -> usize {
        while !self.bytes.len().is_multiple_of(4) {
            self.bytes.push(0);
        }
        let view = json!({"buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len()});
        self.bytes.extend(bytes);
        let views = self.doc["bufferViews"].as_array_mut().unwrap();
        views.push(view);
        let view = views.len() - 1;
        let accessors = self.doc["accessors"].as_array_mut().unwrap();
        accessors.push(json!({"bufferView": view, "componentType": component, "count": count, "type": kind}));
        accessors.len() - 1
    }

    /// Adds a view of these bytes.
    pub fn view(&mut self, bytes: &[u8]) -> usize {
        let accessor = self.raw(5121, "SCALAR", bytes.len(), bytes);
        let accessors = self.doc["accessors"].as_array_mut().unwrap();
        accessors.pop();
        assert_eq!(accessors.len(), accessor);
        self.doc["bufferViews"].as_array().unwrap().len() - 1
    }

    /// Adds an accessor of floats.
    pub fn f32s(&mut self, kind: &str, values: &[f32]) -> usize {
        let lanes = match kind {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            _ => 4,
        };
        let bytes: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
        self.raw(5126, kind, values.len() / lanes, &bytes)
    }

    /// Adds an accessor of 16-bit indices.
    pub fn u16s(&mut self, values: &[u16]) -> usize {
        let bytes: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
        self.raw(5123, "SCALAR", values.len(), &bytes)
    }

    /// The first primitive.
    pub fn primitive(&mut self) -> &mut Value {
        &mut self.doc["meshes"][0]["primitives"][0]
    }

    /// Adds a material from its JSON and gives it to the triangle.
    pub fn material(mut self, material: Value) -> Gltf {
        self.doc["materials"] = json!([material]);
        self.primitive()["material"] = json!(0);
        self
    }

    /// Adds an image from its encoded bytes, and a texture of it.
    pub fn image(&mut self, mime: &str, bytes: &[u8]) {
        let uri = format!("data:{mime};base64,{}", base64(bytes));
        let image = json!({"uri": uri});
        match self.doc.get_mut("images").and_then(Value::as_array_mut) {
            Some(list) => list.push(image),
            None => self.doc["images"] = json!([image]),
        }
        let source = self.doc["images"].as_array().unwrap().len() - 1;
        match self.doc.get_mut("textures").and_then(Value::as_array_mut) {
            Some(list) => list.push(json!({"source": source})),
            None => self.doc["textures"] = json!([{"source": source}]),
        }
    }

    /// The whole file as text.
    pub fn text(&self) -> String {
        let mut doc = self.doc.clone();
        if doc.get("buffers").is_none() {
            let uri = format!("data:application/octet-stream;base64,{}", base64(&self.bytes));
            doc["buffers"] = json!([{"byteLength": self.bytes.len(), "uri": uri}]);
        }
        doc.to_string()
    }

    /// The whole file as a .glb.
    pub fn glb(&self) -> Vec<u8> {
        let mut doc = self.doc.clone();
        doc["buffers"] = json!([{"byteLength": self.bytes.len()}]);
        Self::wrap(doc.to_string().as_bytes(), &self.bytes)
    }

    /// A .glb of this text and these bytes.
    pub fn wrap(text: &[u8], bytes: &[u8]) -> Vec<u8> {
        let mut text = text.to_vec();
        text.resize(text.len().next_multiple_of(4), b' ');
        let mut bin = bytes.to_vec();
        bin.resize(bin.len().next_multiple_of(4), 0);
        let mut out = b"glTF\x02\0\0\0".to_vec();
        out.extend((12 + 8 + text.len() as u32 + 8 + bin.len() as u32).to_le_bytes());
        out.extend((text.len() as u32).to_le_bytes());
        out.extend(b"JSON");
        out.extend(text);
        out.extend((bin.len() as u32).to_le_bytes());
        out.extend(b"BIN\0");
        out.extend(bin);
        out
    }

    /// Writes it into a folder and loads it.
    pub fn load_in(&self, folder: &Path) -> Result<Loaded, IoError> {
        let path = folder.join("scene.gltf");
        std::fs::write(&path, self.text()).unwrap();
        load_scene(&path, &LoadOptions::default())
    }

    /// Loads it.
    pub fn load(&self) -> Result<Loaded, IoError> {
        self.load_in(tempfile::tempdir().unwrap().path())
    }

    /// Loads it and expects success.
    pub fn scene(&self) -> lumbre_scene::Scene {
        self.load().unwrap().scene
    }

    /// Loads it and returns the message of the error, without the folder.
    pub fn error(&self) -> String {
        let folder = tempfile::tempdir().unwrap();
        let message = self.load_in(folder.path()).expect_err("it should not load").to_string();
        message.strip_prefix(&format!("{}/", folder.path().display())).unwrap().to_string()
    }
}

/// Bytes to base64.
pub fn base64(bytes: &[u8]) -> String {
    base64::engine::general_purpose::STANDARD.encode(bytes)
}

/// Base64 to bytes.
pub fn unbase64(text: &Value) -> Vec<u8> {
    base64::engine::general_purpose::STANDARD.decode(text.as_str().unwrap()).unwrap()
}

/// A scene of one Draco primitive: a case of `data/draco.json`, with this stream.
pub fn draco_scene(case: &Value, stream: &[u8]) -> Gltf {
    let mut g = Gltf::triangle();
    let view = g.view(stream);
    let (mut accessors, mut attributes) = (Vec::new(), json!({}));
    let forms = [
        ("POSITION", "VEC3", 5126),
        ("NORMAL", "VEC3", 5126),
        ("TEXCOORD_0", "VEC2", 5126),
        ("COLOR_0", "VEC4", 5121),
    ];
    for (name, kind, component) in forms {
        attributes[name] = json!(accessors.len());
        accessors.push(json!({"componentType": component, "type": kind, "count": case["points"],
            "normalized": component == 5121}));
    }
    let corners = case["faces"].as_array().unwrap().len();
    accessors.push(json!({"componentType": 5125, "type": "SCALAR", "count": corners}));
    g.doc["accessors"] = json!(accessors);
    *g.primitive() = json!({"attributes": attributes, "indices": 4,
        "extensions": {"KHR_draco_mesh_compression": {"bufferView": view, "attributes": case["ids"]}}});
    g.doc["extensionsUsed"] = json!(["KHR_draco_mesh_compression"]);
    g.doc["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]);
    g
}

/// A triangle, and beside it a compressed view: a case of `data/meshopt.json`, with this stream.
pub fn meshopt_scene(case: &Value, stream: &[u8]) -> Gltf {
    let mut g = Gltf::triangle();
    let raw = g.view(stream);
    let offset = g.doc["bufferViews"][raw]["byteOffset"].clone();
    g.doc["bufferViews"][raw] = json!({"buffer": 0, "byteLength": unbase64(&case["decoded"]).len(),
        "byteStride": case["stride"], "extensions": {"EXT_meshopt_compression": {
            "buffer": 0, "byteOffset": offset, "byteLength": stream.len(), "byteStride": case["stride"],
            "mode": case["mode"], "filter": case["filter"], "count": case["count"]}}});
    g
}

/// A PNG of RGBA texels.
pub fn png(width: u32, height: u32, rgba: &[u8]) -> Vec<u8> {
    let mut out = std::io::Cursor::new(Vec::new());
    image::write_buffer_with_format(
        &mut out,
        rgba,
        width,
        height,
        image::ExtendedColorType::Rgba8,
        image::ImageFormat::Png,
    )
    .unwrap();
    out.into_inner()
}

/// The file name of a path, for messages.
pub fn file_name(path: &Path) -> String {
    path.file_name().unwrap().to_string_lossy().into_owned()
}
