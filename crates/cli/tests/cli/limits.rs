//! The flags that widen what a file may ask for: each refuses a small scene when it is narrow, and is named then.

use crate::common::*;
use serde_json::json;
use std::fs;

/// A PNG of 2 x 1 white pixels.
const PNG: &str = "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAAC0lEQVR4nGP4DwYAFPIF+6QNfF4AAAAASUVORK5CYII=";

/// A scene with something of everything that is limited.
fn everything(dir: &std::path::Path) -> String {
    let path = scene(dir, &[(square(0.0, 1.0), GREY)]);
    let mut doc: serde_json::Value = serde_json::from_str(&fs::read_to_string(&path).unwrap()).unwrap();
    doc["images"] = json!([{ "uri": PNG }]);
    doc["textures"] = json!([{ "source": 0 }]);
    doc["materials"][0]["emissiveTexture"] = json!({ "index": 0 });
    doc["materials"][0]["emissiveFactor"] = json!([1, 1, 1]);
    // Texture coordinates without data: six zeros.
    doc["accessors"].as_array_mut().unwrap().push(json!({"componentType": 5126, "count": 6, "type": "VEC2"}));
    doc["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = json!(1);
    fs::write(&path, doc.to_string()).unwrap();
    path
}

#[test]
fn every_limit_has_a_flag_and_its_error_names_it() {
    let dir = folder();
    let scene = everything(dir.path());
    lumbre(&format!("info {scene}")).exits(0);
    // The flag, a value that is too narrow, and one that is just enough.
    let cases = [
        ("--max-file-bytes", "100", "1M"),
        ("--max-json-bytes", "100", "1MiB"),
        ("--max-json-objects", "3", "100"),
        ("--max-json-depth", "3", "9"),
        ("--max-buffer-bytes", "71", "1k"),
        ("--max-image-side", "1", "2"),
        ("--max-image-bytes", "7", "8"),
        ("--max-total-image-bytes", "7", "8"),
        ("--max-triangles", "1", "2"),
        ("--max-vertices", "5", "6"),
        ("--max-zero-filled", "5", "6"),
        ("--max-instances", "0", "1"),
        ("--max-node-depth", "0", "1"),
    ];
    for (flag, narrow, wide) in cases {
        let said = format!("; {flag} widens it");
        lumbre(&format!("info {scene} {flag} {narrow}")).exits(65).says("exceeds the limit of").says(&said);
        lumbre(&format!("info {scene} {flag} {wide}")).exits(0);
    }
    let out = dir.path().join("a.png");
    let render = format!("render {scene} --size 4x4 --spp 1 -o {}", out.display());
    lumbre(&format!("{render} --max-triangles 1")).exits(65).says("; --max-triangles widens it");
    lumbre(&render).exits(0);
}

#[test]
fn limits_are_numbers_and_sizes() {
    for (flag, value) in [
        ("--max-file-bytes", "much"),
        ("--max-triangles", "1G"),
        ("--max-json-depth", "128"),
        ("--max-json-depth", "0"),
        ("--max-image-side", "-1"),
    ] {
        lumbre(&format!("info {SMOOTH} {flag} {value}")).exits(2).says(flag);
    }
    // They are in the long help only.
    let long = lumbre("render --help").exits(0).stdout;
    assert!(long.contains("Limits on what a file may ask for:") && long.contains("--max-total-image-bytes"));
    assert!(!lumbre("render -h").exits(0).stdout.contains("--max-file-bytes"));
}
