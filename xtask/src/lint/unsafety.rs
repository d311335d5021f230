//! Rules on `unsafe`: only where listed, and forbidden by every other crate in its root, so that the compiler holds it too.

use super::{Finding, source::Source};

/// Folders in which `unsafe` may appear.
const PLACES: &[&str] = &["crates/cpu/src/bvh/", "crates/vulkan/src/"];

/// `unsafe` appears only in `PLACES`.
pub(super) fn outside_its_places(source: &Source) -> Vec<Finding> {
    if PLACES.iter().any(|place| source.path.starts_with(place)) {
        return Vec::new();
    }
    let found = source.find(&["unsafe"]).map(|i| source.tokens[i].line);
    found.map(|line| source.finding(line, format!("unsafe outside {}", PLACES.join(", ")))).collect()
}

/// The root of a crate without a place says `#![forbid(unsafe_code)]`.
pub(super) fn not_forbidden_by_crate_root(source: &Source) -> Vec<Finding> {
    let Some((folder, file)) = source.path.rsplit_once('/') else { return Vec::new() };
    let is_library_or_main = folder.ends_with("/src") && ["lib.rs", "main.rs"].contains(&file);
    let is_program = folder.ends_with("/src/bin") || (folder.contains("/src/bin/") && file == "main.rs");
    let has_place = PLACES.iter().any(|place| place.starts_with(&format!("{folder}/")));
    let forbids = source.find(&["#", "!", "[", "forbid", "(", "unsafe_code", ")", "]"]).next().is_some();
    if !(is_library_or_main || is_program) || has_place || forbids {
        return Vec::new();
    }
    vec![source.finding(1, "the crate root lacks #![forbid(unsafe_code)]")]
}

#[cfg(test)]
mod tests {
    use super::super::source::source;
    use super::*;

    #[test]
    fn unsafe_is_found_in_all_its_forms() {
        for text in [
            "fn f() {\n unsafe { g() } }",
            "\nunsafe fn f() {}",
            "\nunsafe impl Send for S {}",
            "macro_rules! m { () => {\n unsafe { g() } } }",
            "\n#[unsafe(no_mangle)] fn f() {}",
        ] {
            let found = outside_its_places(&source("crates/core/src/a.rs", text));
            assert_eq!(found.len(), 1, "{text}");
            assert_eq!(found[0].line, 2);
            assert!(outside_its_places(&source("crates/cpu/src/bvh/simd.rs", text)).is_empty());
            assert!(outside_its_places(&source("crates/vulkan/src/gpu.rs", text)).is_empty());
            assert_eq!(outside_its_places(&source("crates/cpu/src/tile.rs", text)).len(), 1);
        }
        let harmless = "//! unsafe\n#![forbid(unsafe_code)]\nfn f() { g(\"unsafe\") }";
        assert!(outside_its_places(&source("crates/core/src/a.rs", harmless)).is_empty());
    }

    #[test]
    fn a_root_that_does_not_forbid_is_found() {
        let found = |path: &str, text: &str| not_forbidden_by_crate_root(&source(path, text)).len();
        assert_eq!(found("crates/core/src/lib.rs", "mod a;"), 1);
        assert_eq!(found("crates/core/src/lib.rs", "#![deny(unsafe_code)]"), 1);
        assert_eq!(found("xtask/src/main.rs", "fn main() {}"), 1);
        assert_eq!(found("crates/testkit/src/bin/tool.rs", "fn main() {}"), 1);
        assert_eq!(found("crates/testkit/src/bin/tool/main.rs", "fn main() {}"), 1);
        assert_eq!(found("crates/testkit/src/bin/tool/part.rs", "fn f() {}"), 0);
        assert_eq!(found("crates/core/src/lib.rs", "#![forbid(unsafe_code)]\nmod a;"), 0);
        assert_eq!(found("crates/core/src/a.rs", "mod a;"), 0);
        assert_eq!(found("crates/vulkan/src/lib.rs", "mod a;"), 0);
        assert_eq!(found("crates/cpu/src/lib.rs", "mod bvh;"), 0);
    }
}
