//! What fuzzers and the replay of their corpus feed with arbitrary bytes: one [`Target`] for each format that is read.
//!
//! `fuzz/` holds the fuzz targets (`cargo fuzz`), each a line that calls [`Target::run`]; `tests/corpus.rs` replays the inputs kept in
//! `fuzz/corpus`. Whatever the bytes, a target returns; a panic, a hang or memory beyond the limits is a fault of the reader.

use lumbre::edits::Edits;
use lumbre_io::{Limits, LoadOptions, load_scene, read_environment, read_exr, read_linear_image};
use lumbre_scene::{Material, Node, Scene};
use std::cell::RefCell;
use std::path::{Path, PathBuf};

/// Separates the OBJ from its MTL in an input of [`Target::Obj`].
pub const MTL_MARK: &[u8] = b"#=mtl\n";

/// A format that is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// glTF as JSON text.
    Gltf,
    /// Binary glTF.
    Glb,
    /// Wavefront OBJ; after [`MTL_MARK`] the file `a.mtl` that it may name.
    Obj,
    /// Stanford PLY.
    Ply,
    /// STL.
    Stl,
    /// Radiance HDR.
    Hdr,
    /// OpenEXR.
    Exr,
    /// PNG.
    Png,
    /// JPEG.
    Jpeg,
    /// WebP.
    WebP,
    /// KTX2 textures, inside a glTF.
    Ktx2,
    /// Truevision TGA.
    Tga,
    /// Windows bitmap.
    Bmp,
    /// What was changed of a scene.
    Edits,
}

impl Target {
    /// Every target.
    pub const ALL: [Target; 14] = [
        Target::Gltf,
        Target::Glb,
        Target::Obj,
        Target::Ply,
        Target::Stl,
        Target::Hdr,
        Target::Exr,
        Target::Png,
        Target::Jpeg,
        Target::WebP,
        Target::Ktx2,
        Target::Tga,
        Target::Bmp,
        Target::Edits,
    ];

    /// Its name: that of the fuzz target, of the folder of its corpus, and the extension of its files.
    pub fn name(self) -> &'static str {
        match self {
            Target::Gltf => "gltf",
            Target::Glb => "glb",
            Target::Obj => "obj",
            Target::Ply => "ply",
            Target::Stl => "stl",
            Target::Hdr => "hdr",
            Target::Exr => "exr",
            Target::Png => "png",
            Target::Jpeg => "jpeg",
            Target::WebP => "webp",
            Target::Ktx2 => "ktx2",
            Target::Tga => "tga",
            Target::Bmp => "bmp",
            Target::Edits => "edits",
        }
    }

    /// Reads `data` as this format; scenes are compiled too. True if it was accepted.
    pub fn run(self, data: &[u8]) -> bool {
        thread_local! {
            static FOLDER: RefCell<PathBuf> = RefCell::new(folder());
        }
        FOLDER.with_borrow(|folder| self.run_in(folder, data))
    }

    fn run_in(self, folder: &Path, data: &[u8]) -> bool {
        let path = folder.join("a").with_extension(self.name());
        let write = |path: &Path, bytes: &[u8]| std::fs::write(path, bytes).expect("the folder is writable");
        match self {
            Target::Gltf | Target::Glb | Target::Ply | Target::Stl => {
                write(&path, data);
                loads(&path)
            }
            Target::Obj => {
                let mark = data.windows(MTL_MARK.len()).position(|w| w == MTL_MARK);
                let (obj, mtl) = match mark {
                    Some(at) => (&data[..at], &data[at + MTL_MARK.len()..]),
                    None => (data, &[][..]),
                };
                write(&path, obj);
                write(&folder.join("a.mtl"), mtl);
                loads(&path)
            }
            Target::Hdr => {
                write(&path, data);
                read_environment(&path, &limits()).is_ok()
            }
            Target::Exr => {
                write(&path, data);
                let layers = read_exr(&path, &limits()).is_ok();
                let part = lumbre::merge::read_part(&path, &limits()).is_ok();
                assert!(layers || !part, "a part is an EXR");
                read_environment(&path, &limits()).is_ok() || layers
            }
            Target::Png | Target::Jpeg | Target::WebP | Target::Tga | Target::Bmp => {
                write(&path, data);
                read_linear_image(&path, None, &limits()).is_ok()
            }
            Target::Edits => {
                write(&path, data);
                edits(&path)
            }
            Target::Ktx2 => {
                write(&path, data);
                let scene = folder.join("ktx2.gltf");
                write(&scene, KTX2_SCENE.as_bytes());
                loads(&scene)
            }
        }
    }
}

/// A folder of this thread, in memory where there is such a place; it is left to the system to clear.
fn folder() -> PathBuf {
    let shared = Path::new("/dev/shm");
    let base = if shared.is_dir() { shared.to_path_buf() } else { std::env::temp_dir() };
    let folder = base.join(format!("lumbre-fuzz-{}-{:?}", std::process::id(), std::thread::current().id()));
    std::fs::create_dir_all(&folder).expect("a folder for inputs");
    folder
}

/// Tight enough that what a small file may rightly ask for is quickly done.
fn limits() -> Limits {
    Limits {
        max_image_bytes: 16 << 20,
        max_total_image_bytes: 32 << 20,
        max_triangles: 1 << 18,
        max_vertices: 1 << 18,
        max_zero_filled: 1 << 16,
        ..Limits::default()
    }
}

fn loads(path: &Path) -> bool {
    let options = LoadOptions { limits: limits(), ..LoadOptions::default() };
    // What loads must compile or say why not.
    load_scene(path, &options).is_ok_and(|loaded| lumbre_scene::compile(&loaded.scene).is_ok())
}

/// What is read is written so that it is read again, and changes a scene or says why not.
fn edits(path: &Path) -> bool {
    let Ok(edits) = Edits::read(path) else { return false };
    let text = edits.to_text();
    assert_eq!(Edits::parse(&text).as_ref().map(Edits::to_text), Ok(text));
    let mut scene = Scene::default();
    scene.add_material(Material { name: "a".into(), ..Material::default() });
    scene.add_root(Node { name: "a".into(), ..Node::default() });
    edits.apply(&scene).is_ok_and(|scene| lumbre_scene::compile(&scene).is_ok())
}

/// A triangle with one texture, `a.ktx2`.
const KTX2_SCENE: &str = r#"{"asset":{"version":"2.0"},
"extensionsUsed":["KHR_texture_basisu"],"extensionsRequired":["KHR_texture_basisu"],
"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
"bufferViews":[{"buffer":0,"byteLength":36}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
"images":[{"uri":"a.ktx2","mimeType":"image/ktx2"}],
"textures":[{"extensions":{"KHR_texture_basisu":{"source":0}}}],
"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],
"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],"scene":0}"#;
