//! Runs the built `lumbre` on small pictures, each test in a folder of its own.

use lumbre::core::Rgb;
use lumbre::io::{ExrImage, Limits, LinearImage, read_exr, read_linear_image};
use std::path::Path;
use std::process::{Command, Output};

/// Cornell box of the repository: lit by a lamp, one camera, 4:3.
pub(crate) const CORNELL: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../assets/scenes/cornell.glb");
/// A floor and a lamp out of sight; one camera, 1:1.
pub(crate) const SMOOTH: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../assets/scenes/smooth.gltf");

/// What a run said and made.
#[derive(Debug)]
pub(crate) struct Run {
    pub(crate) code: i32,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

impl Run {
    /// Checks the exit code, and shows what was said if it is another one.
    #[track_caller]
    pub(crate) fn exits(self, code: i32) -> Self {
        assert_eq!(self.code, code, "stdout:\n{}stderr:\n{}", self.stdout, self.stderr);
        self
    }
    /// Checks that stderr holds a text.
    #[track_caller]
    pub(crate) fn says(self, text: &str) -> Self {
        assert!(self.stderr.contains(text), "no {text:?} in stderr:\n{}", self.stderr);
        self
    }
    /// Checks that stderr does not hold a text.
    #[track_caller]
    pub(crate) fn does_not_say(self, text: &str) -> Self {
        assert!(!self.stderr.contains(text), "{text:?} in stderr:\n{}", self.stderr);
        self
    }
    /// The first line of stdout that begins so.
    #[track_caller]
    pub(crate) fn line(&self, begin: &str) -> &str {
        let line = self.stdout.lines().find(|l| l.starts_with(begin));
        line.unwrap_or_else(|| panic!("no {begin:?} in stdout:\n{}", self.stdout))
    }
    /// The last line of stdout as JSON.
    #[track_caller]
    pub(crate) fn last_json(&self) -> serde_json::Value {
        serde_json::from_str(self.stdout.lines().last().unwrap_or_default()).expect("JSON")
    }
}

impl From<Output> for Run {
    fn from(o: Output) -> Self {
        let text = |b: Vec<u8>| String::from_utf8(b).expect("UTF-8");
        Run { code: o.status.code().unwrap_or(-1), stdout: text(o.stdout), stderr: text(o.stderr) }
    }
}

/// The program, without what surrounds the tests, on a machine without a GPU: Vulkan's loader finds no driver.
pub(crate) fn command() -> Command {
    let mut c = with_gpus();
    // The newer and the older name of the variable.
    c.env("VK_DRIVER_FILES", "/nonexistent").env("VK_ICD_FILENAMES", "/nonexistent");
    c
}

/// The program with the GPUs of this machine.
pub(crate) fn with_gpus() -> Command {
    let mut c = Command::new(env!("CARGO_BIN_EXE_lumbre"));
    c.env_remove("LUMBRE_SIMD")
        .env_remove("RAYON_NUM_THREADS")
        .env_remove("LUMBRE_TEST_LOSE_DEVICE")
        .env_remove("LUMBRE_TEST_GPU_MEMORY")
        .env_remove("LUMBRE_TEST_SOFTWARE_GPU");
    c
}

/// Runs the program with these words.
pub(crate) fn lumbre(words: &str) -> Run {
    command().args(words.split_whitespace()).output().expect("the program starts").into()
}

/// A folder for the files of one test.
pub(crate) fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

/// Renders to an EXR and reads it. `words` begin with the scene.
#[track_caller]
pub(crate) fn exr(dir: &Path, words: &str) -> (Run, ExrImage) {
    let path = dir.join("test.exr");
    let run = lumbre(&format!("render {words} -o {}", path.display())).exits(0);
    let image = read_exr(&path, &Limits::default()).expect("a sound EXR");
    (run, image)
}

/// The picture itself of an EXR made of these words.
#[track_caller]
pub(crate) fn picture(dir: &Path, words: &str) -> LinearImage {
    exr(dir, words);
    read_linear_image(dir.join("test.exr"), None, &Limits::default()).expect("a picture")
}

/// The bytes of an EXR made of these words.
#[track_caller]
pub(crate) fn bytes(dir: &Path, words: &str) -> Vec<u8> {
    exr(dir, words);
    std::fs::read(dir.join("test.exr")).expect("a file")
}

/// Mean colour.
pub(crate) fn mean(image: &LinearImage) -> Rgb {
    let sum = image.pixels.iter().fold(Rgb::BLACK, |a, p| a + *p);
    sum * (1.0 / image.pixels.len() as f32)
}

/// Mean over pixels of the squared difference of right neighbours: how noisy a picture is that should be smooth.
pub(crate) fn noise(image: &LinearImage) -> f32 {
    let rows = image.pixels.chunks(image.width as usize);
    let squares = rows.flat_map(|r| r.windows(2)).map(|w| (w[0].luminance() - w[1].luminance()).powi(2));
    squares.sum::<f32>() / image.pixels.len() as f32
}

/// The three numbers in the parentheses that follow `after` in a line.
#[track_caller]
pub(crate) fn triple(line: &str, after: &str) -> [f32; 3] {
    let (_, rest) = line.split_once(after).unwrap_or_else(|| panic!("no {after:?} in {line}"));
    let inside = rest.trim_start().trim_start_matches('(').split(')').next().unwrap_or_default();
    let numbers: Vec<f32> = inside.split(", ").map(|n| n.parse().expect("a number")).collect();
    numbers.try_into().expect("three numbers")
}

/// A square of half side `s` at height `y` that faces up, or down if `s` is negative.
pub(crate) fn square(y: f32, s: f32) -> Vec<f32> {
    let a = s.abs();
    vec![-s, y, a, s, y, a, s, y, -a, -s, y, a, s, y, -a, -s, y, -a]
}

/// A material that reflects half of the light, the same in all directions.
pub(crate) const GREY: &str = r#"{"pbrMetallicRoughness":{"baseColorFactor":[0.5,0.5,0.5,1],"metallicFactor":0},
    "extensions":{"KHR_materials_specular":{"specularFactor":0}}}"#;

/// Writes a glTF of triangles (nine numbers each, counter-clockwise seen from the front), each part with the JSON of its
/// material, and returns its path. There is no camera and no light.
pub(crate) fn scene(dir: &Path, parts: &[(Vec<f32>, &str)]) -> String {
    let (mut buffer, mut views, mut accessors, mut primitives) = (Vec::new(), vec![], vec![], vec![]);
    for (i, (positions, _)) in parts.iter().enumerate() {
        let start = buffer.len();
        buffer.extend(positions.iter().flat_map(|v| v.to_le_bytes()));
        let corner = |pick: fn(f32, f32) -> f32, from: f32| {
            [0, 1, 2].map(|axis| positions.iter().skip(axis).step_by(3).fold(from, |m, v| pick(m, *v)))
        };
        let (min, max) = (corner(f32::min, f32::INFINITY), corner(f32::max, f32::NEG_INFINITY));
        let length = buffer.len() - start;
        views.push(serde_json::json!({ "buffer": 0, "byteOffset": start, "byteLength": length }));
        accessors
            .push(serde_json::json!({ "bufferView": i, "componentType": 5126, "count": positions.len() / 3,
            "type": "VEC3", "min": min, "max": max }));
        primitives.push(serde_json::json!({ "attributes": { "POSITION": i }, "material": i }));
    }
    let materials: Vec<serde_json::Value> =
        parts.iter().map(|(_, m)| serde_json::from_str(m).expect("the material is JSON")).collect();
    let json = serde_json::json!({
        "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": [0] }], "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": primitives }], "materials": materials, "accessors": accessors,
        "bufferViews": views, "buffers": [{ "uri": "scene.bin", "byteLength": buffer.len() }],
    });
    std::fs::write(dir.join("scene.bin"), buffer).expect("the folder takes files");
    let path = dir.join("scene.gltf");
    std::fs::write(&path, json.to_string()).expect("the folder takes files");
    path.display().to_string()
}
