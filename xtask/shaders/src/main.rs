//! `cargo xtask shaders [--check]`: compiles each shader below `crates/shaders/glsl` to `crates/shaders/spirv`, or compares.
#![forbid(unsafe_code)]

#[path = "../../../crates/shaders/src/sources.rs"]
mod sources;

use glslang::include::{IncludeHandler, IncludeResult, IncludeType};
use glslang::{
    Compiler, CompilerOptions, ShaderInput, ShaderSource, ShaderStage, SourceLanguage, SpirvVersion, Target,
    VulkanVersion,
};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

fn main() -> ExitCode {
    let check = match std::env::args().skip(1).collect::<Vec<_>>().as_slice() {
        [] => false,
        [flag] if flag == "--check" => true,
        _ => {
            eprintln!("cargo xtask shaders [--check]");
            return ExitCode::FAILURE;
        }
    };
    match run(check) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{}", message.trim_end());
            ExitCode::FAILURE
        }
    }
}

fn run(check: bool) -> Result<(), String> {
    let crate_ = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../crates/shaders");
    let (glsl, spirv) = (crate_.join("glsl"), crate_.join("spirv"));
    let entries = sources::entries(&glsl).map_err(|e| e.to_string())?;
    let mut lines = String::new();
    let mut failed = Vec::new();
    for entry in &entries {
        lines += &(sources::manifest_line(&glsl, entry).map_err(|e| e.to_string())? + "\n");
        match compile(&glsl, entry) {
            Ok(words) => {
                let bytes: Vec<u8> = words.iter().flat_map(|w| w.to_le_bytes()).collect();
                put(&spirv.join(format!("{entry}.spv")), &bytes, check, &mut failed)?;
            }
            Err(message) => {
                eprintln!("{entry}:\n{message}");
                failed.push(entry.clone());
            }
        }
    }
    put(&spirv.join("sources.txt"), lines.as_bytes(), check, &mut failed)?;
    remove_orphans(&spirv, &entries, check, &mut failed)?;
    if failed.is_empty() { Ok(()) } else { Err(format!("shaders: {}", failed.join(", "))) }
}

/// Writes a file that differs, or notes that it does.
fn put(path: &Path, bytes: &[u8], check: bool, failed: &mut Vec<String>) -> Result<(), String> {
    if std::fs::read(path).is_ok_and(|old| old == bytes) {
        return Ok(());
    }
    if check {
        failed.push(format!("{} is stale", path.display()));
        return Ok(());
    }
    let at = |e: std::io::Error| format!("{}: {e}", path.display());
    std::fs::create_dir_all(path.parent().expect("a file has a folder")).map_err(at)?;
    std::fs::write(path, bytes).map_err(at)
}

/// SPIR-V whose source is gone.
fn remove_orphans(
    spirv: &Path,
    entries: &[String],
    check: bool,
    failed: &mut Vec<String>,
) -> Result<(), String> {
    let mut folders = vec![spirv.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).map_err(|e| e.to_string())? {
            let path = entry.map_err(|e| e.to_string())?.path();
            let wanted = |e: &String| path == spirv.join(format!("{e}.spv"));
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "spv") && !entries.iter().any(wanted) {
                if check {
                    failed.push(format!("{} has no source", path.display()));
                } else {
                    std::fs::remove_file(&path).map_err(|e| e.to_string())?;
                }
            }
        }
    }
    Ok(())
}

/// Finds included files below the root, whoever includes them.
struct Includes(PathBuf);

impl IncludeHandler for Includes {
    fn include(&mut self, _: IncludeType, name: &str, _: &str, _: usize) -> Option<IncludeResult> {
        let data = std::fs::read_to_string(self.0.join(name)).ok()?;
        Some(IncludeResult { name: name.to_owned(), data })
    }
}

fn compile(glsl: &Path, entry: &str) -> Result<Vec<u32>, String> {
    let stage = match entry.rsplit('.').next().unwrap_or_default() {
        "rgen" => ShaderStage::RayGeneration,
        "rchit" => ShaderStage::ClosestHit,
        "rahit" => ShaderStage::AnyHit,
        "rmiss" => ShaderStage::Miss,
        "comp" => ShaderStage::Compute,
        "vert" => ShaderStage::Vertex,
        "frag" => ShaderStage::Fragment,
        other => return Err(format!("no such stage: {other}")),
    };
    let text = std::fs::read_to_string(glsl.join(entry)).map_err(|e| e.to_string())?;
    let compiler = Compiler::acquire().ok_or("glslang does not start")?;
    let source = ShaderSource::from(text);
    let options = CompilerOptions {
        source_language: SourceLanguage::GLSL,
        target: Target::Vulkan { version: VulkanVersion::Vulkan1_2, spirv_version: SpirvVersion::SPIRV1_5 },
        ..CompilerOptions::default()
    };
    let mut includes = Includes(glsl.to_owned());
    let input =
        ShaderInput::new(&source, stage, &options, None, Some(&mut includes)).map_err(|e| e.to_string())?;
    let shader = compiler.create_shader(input).map_err(|e| e.to_string())?;
    shader.compile().map_err(|e| e.to_string())
}
