//! EXR files as another program reads them: the OpenEXR package of PyPI, in the Python that `LUMBRE_PYTHON` names (and must then
//! have the package), else in `python3` if that has it.

use crate::common::*;
use lumbre::io::{ExrImage, Limits, read_exr};
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

/// Prints windows, attributes and names with types; writes the values of all channels, in order of their names.
const SCRIPT: &str = r#"
import sys, OpenEXR
picture, values = sys.argv[1:]
file = OpenEXR.File(picture, separate_channels=True)
header = file.header()
print("parts", len(file.parts))
for window in ("dataWindow", "displayWindow"):
    low, high = header[window]
    print(window, *low, *high)
print("software", header["software"])
print("seed", header.get("lumbre.seed"))
print("chromaticities", *(round(c, 4) for c in header["chromaticities"]))
print("compression", header["compression"].name)
with open(values, "wb") as out:
    for name, channel in sorted(file.channels().items()):
        print("channel", name, channel.type().name, channel.pixels.shape)
        out.write(channel.pixels.astype("<" + channel.pixels.dtype.str[1:]).tobytes())
"#;

/// What it says about a file, line by line, and the bytes of all values; `None`, with a word, where it is not there.
fn read_by_openexr(dir: &Path, picture: &Path) -> Option<(Vec<String>, Vec<u8>)> {
    let named = std::env::var_os("LUMBRE_PYTHON");
    let python = named.clone().unwrap_or("python3".into());
    let there = Command::new(&python).args(["-c", "import OpenEXR; OpenEXR.File"]).output();
    if !there.as_ref().is_ok_and(|o| o.status.success()) {
        assert!(named.is_none(), "LUMBRE_PYTHON has no OpenEXR: {there:?}");
        println!("skipped: no Python with OpenEXR (set LUMBRE_PYTHON)");
        return None;
    }
    let values = dir.join("values");
    let output = Command::new(python).args(["-c", SCRIPT]).arg(picture).arg(&values).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let lines = String::from_utf8(output.stdout).unwrap().lines().map(String::from).collect();
    Some((lines, std::fs::read(values).unwrap()))
}

/// All channels by their full names: type, and values as bytes.
fn channels(image: &ExrImage) -> BTreeMap<String, (&'static str, Vec<u8>)> {
    let floats = image.layers.iter().flat_map(|layer| {
        layer.channels.iter().map(|(name, values)| {
            let full = if layer.name.is_empty() { name.clone() } else { format!("{}.{name}", layer.name) };
            (full, ("FLOAT", values.iter().flat_map(|v| v.to_le_bytes()).collect()))
        })
    });
    let whole = image.whole.iter().map(|(name, values)| {
        (name.clone(), ("UINT", values.iter().flat_map(|v| v.to_le_bytes()).collect()))
    });
    floats.chain(whole).collect()
}

#[test]
fn another_program_reads_the_same_names_types_and_values() {
    let dir = folder();
    let words = "--size 24x18 --crop 4,5,15,10 --spp 3 --seed 7 --background transparent --keep-sums";
    let (_, image) = exr(dir.path(), &format!("{CORNELL} {words}"));
    let Some((lines, values)) = read_by_openexr(dir.path(), &dir.path().join("test.exr")) else { return };
    let expected = [
        "parts 1",
        "dataWindow 4 5 18 14",
        "displayWindow 0 0 23 17",
        "software Lumbre",
        "seed 7",
        "chromaticities 0.64 0.33 0.3 0.6 0.15 0.06 0.3127 0.329",
        "compression ZIP_COMPRESSION",
    ];
    assert_eq!(lines[..expected.len()], expected);
    let ours = channels(&image);
    let names: Vec<String> =
        ours.iter().map(|(name, (kind, _))| format!("channel {name} {kind} (10, 15)")).collect();
    assert_eq!(lines[expected.len()..], names);
    let bytes: Vec<u8> = ours.values().flat_map(|(_, bytes)| bytes.clone()).collect();
    assert!(bytes == values, "the values differ");
    // What Blender, Nuke and tev go by.
    for name in ["R", "G", "B", "A", "albedo.R", "normal.X", "position.Z", "depth.Z", "error.Y", "samples.Y"]
    {
        assert!(ours.contains_key(name), "{name}");
    }
    // Blender refuses files with 24 channels in a layer.
    let mut layers = BTreeMap::new();
    for name in ours.keys() {
        *layers.entry(name.rsplit_once('.').map_or("", |(layer, _)| layer)).or_insert(0) += 1;
    }
    assert!(layers.values().all(|n| *n < 24), "{layers:?}");
    // The comparison can fail: another seed has the same names and other values.
    let (_, other) = exr(dir.path(), &format!("{CORNELL} {}", words.replace("--seed 7", "--seed 8")));
    let other: Vec<u8> = channels(&other).into_values().flat_map(|(_, bytes)| bytes).collect();
    assert!(other.len() == values.len() && other != values);
}

#[test]
fn compare_reads_every_layer() {
    let dir = folder();
    let (_, image) = exr(dir.path(), &format!("{CORNELL} --size 24x18 --spp 3 --keep-sums"));
    let again = read_exr(dir.path().join("test.exr"), &Limits::default()).unwrap();
    assert_eq!(image, again);
    let path = dir.path().join("test.exr").display().to_string();
    for layer in ["albedo", "normal", "position", "depth", "error", "samples"] {
        lumbre(&format!("compare {path} {path} --layer {layer} --fail-above rmse=0")).exits(0);
    }
}
