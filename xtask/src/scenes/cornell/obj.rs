//! The Cornell room as Wavefront OBJ with its MTL, made from the finished `.glb`, so that both hold the same triangles, normals and
//! colours. Positions that a node moves are moved in `f64` and rounded once; numbers are written so that they read back as they were.
//! OBJ knows no camera, and its surfaces have no back.

use glam::{DQuat, DVec3, Quat, Vec3};
use serde_json::Value;
use std::fmt::Write;

/// A `.glb` taken apart.
struct Glb {
    json: Value,
    binary: Vec<u8>,
}

/// Names of the library and of the picture beside it.
pub(super) const LIBRARY: &str = "cornell.mtl";
pub(super) const PICTURE: &str = "cornell_tile.png";

impl Glb {
    fn new(file: &[u8]) -> Self {
        let length = u32::from_le_bytes(file[12..16].try_into().expect("four bytes")) as usize;
        let json = serde_json::from_slice(&file[20..20 + length]).expect("our own JSON");
        Glb { json, binary: file[28 + length..].to_vec() }
    }

    /// The bytes of a buffer view.
    fn view(&self, index: &Value) -> &[u8] {
        let view = &self.json["bufferViews"][id(index)];
        &self.binary[id(&view["byteOffset"])..][..id(&view["byteLength"])]
    }

    /// The numbers of an accessor of floats, row by row.
    fn floats(&self, accessor: &Value) -> Vec<f32> {
        let bytes = self.view(&self.json["accessors"][id(accessor)]["bufferView"]);
        bytes.chunks_exact(4).map(|b| f32::from_le_bytes(b.try_into().expect("four bytes"))).collect()
    }

    /// Indices of triangles.
    fn indices(&self, accessor: &Value) -> Vec<usize> {
        let bytes = self.view(&self.json["accessors"][id(accessor)]["bufferView"]);
        bytes.chunks_exact(2).map(|b| usize::from(u16::from_le_bytes([b[0], b[1]]))).collect()
    }
}

fn id(value: &Value) -> usize {
    value.as_u64().expect("an index") as usize
}

fn numbers<const N: usize>(value: &Value, otherwise: [f64; N]) -> [f64; N] {
    std::array::from_fn(|i| value[i].as_f64().unwrap_or(otherwise[i]))
}

/// The mesh as `.obj`.
pub(super) fn obj(glb: &[u8]) -> Vec<u8> {
    let glb = Glb::new(glb);
    let mut text = format!("# The Cornell room of cornell.glb\nmtllib {LIBRARY}\n");
    let mut counts = [1; 3];
    for node in glb.json["nodes"].as_array().expect("there are nodes") {
        if node["mesh"].is_u64() {
            object(&mut text, &glb, node, &mut counts);
        }
    }
    text.into_bytes()
}

/// Writes one node; `counts` are the next indices of positions, texture coordinates and normals.
fn object(text: &mut String, glb: &Glb, node: &Value, counts: &mut [usize; 3]) {
    let primitive = &glb.json["meshes"][id(&node["mesh"])]["primitives"][0];
    let attributes = &primitive["attributes"];
    let rotation = DQuat::from_array(numbers(&node["rotation"], [0.0, 0.0, 0.0, 1.0]));
    let (scale, shift) = (
        DVec3::from(numbers(&node["scale"], [1.0; 3])),
        DVec3::from(numbers(&node["translation"], [0.0; 3])),
    );
    let turned = rotation.as_quat() != Quat::IDENTITY;
    let material = &glb.json["materials"][id(&primitive["material"])];
    let name = |v: &Value| v["name"].as_str().expect("everything has a name").replace(' ', "_");
    let line = |text: &mut String, line: std::fmt::Arguments| {
        text.write_fmt(line).expect("a string can grow");
        text.push('\n');
    };
    line(text, format_args!("o {}\nusemtl {}", name(node), name(material)));
    let positions = glb.floats(&attributes["POSITION"]);
    for p in positions.chunks_exact(3) {
        let p = DVec3::new(p[0].into(), p[1].into(), p[2].into()) * scale;
        let [x, y, z] = (if turned { rotation * p } else { p } + shift).as_vec3().to_array();
        line(text, format_args!("v {x} {y} {z}"));
    }
    let uvs =
        if attributes["TEXCOORD_0"].is_u64() { glb.floats(&attributes["TEXCOORD_0"]) } else { Vec::new() };
    for uv in uvs.chunks_exact(2) {
        line(text, format_args!("vt {} {}", uv[0], 1.0 - uv[1]));
    }
    for n in glb.floats(&attributes["NORMAL"]).chunks_exact(3) {
        let n = Vec3::from_slice(n);
        let [x, y, z] = if turned { (rotation * n.as_dvec3()).as_vec3() } else { n }.to_array();
        line(text, format_args!("vn {x} {y} {z}"));
    }
    for t in glb.indices(&primitive["indices"]).chunks_exact(3) {
        text.push('f');
        for &i in t {
            let [v, vt, vn] = counts.map(|c| c + i);
            let corner = if uvs.is_empty() { format!(" {v}//{vn}") } else { format!(" {v}/{vt}/{vn}") };
            text.push_str(&corner);
        }
        text.push('\n');
    }
    let vertices = positions.len() / 3;
    *counts = [counts[0] + vertices, counts[1] + uvs.len() / 2, counts[2] + vertices];
}

/// The materials as `.mtl`, in the keys of physically based shading where the format's own would mean something else.
pub(super) fn mtl(glb: &[u8]) -> Vec<u8> {
    let glb = Glb::new(glb);
    let mut text = String::from("# The materials of cornell.glb\n");
    for material in glb.json["materials"].as_array().expect("there are materials") {
        let name = material["name"].as_str().expect("materials have names").replace(' ', "_");
        let (pbr, extensions) = (&material["pbrMetallicRoughness"], &material["extensions"]);
        let list = |v: [f64; 3]| v.map(|x| (x as f32).to_string()).join(" ");
        let [r, g, b, _] = numbers(&pbr["baseColorFactor"], [1.0; 4]);
        let number = |v: &Value| v.as_f64().unwrap_or(1.0) as f32;
        let body = if extensions["KHR_materials_transmission"].is_object() {
            format!(
                "illum 7\nKd 0 0 0\nNi {}\nPr {}",
                number(&extensions["KHR_materials_ior"]["ior"]),
                number(&pbr["roughnessFactor"])
            )
        } else if material["emissiveFactor"].is_array() {
            let strength =
                f64::from(number(&extensions["KHR_materials_emissive_strength"]["emissiveStrength"]));
            let nits = numbers(&material["emissiveFactor"], [0.0; 3]).map(|x| x * strength);
            format!("illum 1\nKd {}\nKe {}", list([r, g, b]), list(nits))
        } else {
            format!(
                "illum 2\nKd {}\nPm {}\nPr {}",
                list([r, g, b]),
                number(&pbr["metallicFactor"]),
                number(&pbr["roughnessFactor"])
            )
        };
        let map =
            if pbr["baseColorTexture"].is_object() { format!("\nmap_Kd {PICTURE}") } else { String::new() };
        text.push_str(&format!("\nnewmtl {name}\n{body}{map}\n"));
    }
    text.into_bytes()
}

/// The picture of the floor.
pub(super) fn picture(glb: &[u8]) -> Vec<u8> {
    let glb = Glb::new(glb);
    let view = glb.json["images"][0]["bufferView"].clone();
    glb.view(&view).to_vec()
}
