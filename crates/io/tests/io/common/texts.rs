//! Scenes written as text in tests: a folder of files, and what loading one says.

use lumbre_io::{IoError, LoadOptions, Loaded, load_scene};
use lumbre_scene::{Material, Primitive, Scene};
use std::path::{Path, PathBuf};

/// A folder that is deleted with it.
pub struct Folder(pub tempfile::TempDir);

impl Folder {
    /// With these files, by name; folders in names are made.
    pub fn new(files: &[(&str, &[u8])]) -> Self {
        let folder = Folder(tempfile::tempdir().unwrap());
        files.iter().for_each(|(name, bytes)| folder.write(name, bytes));
        folder
    }
    /// Writes a file.
    pub fn write(&self, name: &str, bytes: &[u8]) {
        let path = self.path(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, bytes).unwrap();
    }
    /// The path of a file in it.
    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }
    /// Loads one of its files.
    pub fn try_load(&self, name: &str) -> Result<Loaded, IoError> {
        load_scene(self.path(name), &LoadOptions::default())
    }
    /// Loads one of its files; the scene and the warnings, which must compile.
    pub fn load(&self, name: &str) -> (Scene, Vec<String>) {
        let loaded = self.try_load(name).unwrap_or_else(|e| panic!("{e}"));
        lumbre_scene::compile(&loaded.scene).unwrap();
        (loaded.scene, loaded.warnings)
    }
    /// The message of a file that does not load, without the folder.
    pub fn error(&self, name: &str) -> String {
        let message = self.try_load(name).expect_err("it should not load").to_string();
        message.replace(&format!("{}/", self.0.path().display()), "")
    }
}

/// Loads an OBJ from its text.
pub fn obj(text: &str) -> (Scene, Vec<String>) {
    Folder::new(&[("scene.obj", text.as_bytes())]).load("scene.obj")
}

/// A triangle in the only material of this library, and the warnings.
pub fn material(mtl: &str) -> (Material, Vec<String>) {
    material_with(mtl, &[])
}

/// The same with pictures beside it.
pub fn material_with(mtl: &str, files: &[(&str, &[u8])]) -> (Material, Vec<String>) {
    let (scene, warnings) = scene_with(mtl, files);
    (scene.materials[0].clone(), warnings)
}

/// The whole scene of that triangle.
pub fn scene_with(mtl: &str, files: &[(&str, &[u8])]) -> (Scene, Vec<String>) {
    let text =
        "mtllib scene.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n";
    let folder = Folder::new(&[("scene.obj", text.as_bytes()), ("scene.mtl", mtl.as_bytes())]);
    files.iter().for_each(|(name, bytes)| folder.write(name, bytes));
    folder.load("scene.obj")
}

/// All primitives of a scene.
pub fn primitives(scene: &Scene) -> Vec<&Primitive> {
    scene.meshes.iter().flat_map(|m| &m.primitives).collect()
}

/// The path of a folder, for a message.
pub fn shown(path: &Path) -> String {
    path.display().to_string()
}
