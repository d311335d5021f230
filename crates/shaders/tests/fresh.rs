//! SPIR-V belongs to the sources that lie beside it.

#[path = "../src/sources.rs"]
mod sources;

use std::path::Path;

#[test]
fn spirv_is_as_new_as_its_sources() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let glsl = root.join("glsl");
    let lines: Vec<String> = sources::entries(&glsl)
        .unwrap()
        .iter()
        .map(|entry| sources::manifest_line(&glsl, entry).unwrap())
        .collect();
    let kept = std::fs::read_to_string(root.join("spirv/sources.txt")).unwrap();
    assert!(kept.lines().eq(lines.iter()), "stale: run `cargo xtask shaders`\n{kept}\n{lines:#?}");
    for entry in sources::entries(&glsl).unwrap() {
        assert!(root.join(format!("spirv/{entry}.spv")).exists(), "{entry} has no SPIR-V");
    }
}

/// Another word in an included file is another hash.
#[test]
fn a_changed_include_is_noticed() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write("a.comp", "#include \"b.glsl\"\nvoid main() {}\n");
    write("b.glsl", "#include \"c.glsl\"\n");
    write("c.glsl", "const int X = 1;\n");
    let before = sources::manifest_line(folder.path(), "a.comp").unwrap();
    assert_eq!(before, sources::manifest_line(folder.path(), "a.comp").unwrap());
    write("c.glsl", "const int X = 2;\n");
    assert_ne!(before, sources::manifest_line(folder.path(), "a.comp").unwrap());
    assert_eq!(sources::entries(folder.path()).unwrap(), ["a.comp"]);
    assert!(sources::closure(folder.path(), "none.comp").is_err());
}
