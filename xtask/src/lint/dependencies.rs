//! Rule on crates: which of the workspace's crates each may use (ARCHITECTURE.md draws the same table).

use super::Finding;
use serde_json::Value;

/// What the public library is made of.
const LIBRARIES: &[&str] = &[
    "lumbre-core",
    "lumbre-scene",
    "lumbre-io",
    "lumbre-cpu",
    "lumbre-shaders",
    "lumbre-denoise",
    "lumbre-vulkan",
];

/// The workspace crates that a crate may use, at run time and in build scripts; `None`: there is no such crate.
fn may_use(krate: &str) -> Option<Vec<&'static str>> {
    Some(match krate {
        "lumbre-core" | "xtask" | "xtask-shaders" => vec![],
        "lumbre-scene" | "lumbre-denoise" => vec!["lumbre-core"],
        "lumbre-io" | "lumbre-cpu" | "lumbre-shaders" => vec!["lumbre-core", "lumbre-scene"],
        "lumbre-vulkan" => vec!["lumbre-core", "lumbre-scene", "lumbre-shaders", "lumbre-denoise"],
        "lumbre" => LIBRARIES.to_vec(),
        "lumbre-viewer" => vec!["lumbre"],
        "lumbre-cli" => vec!["lumbre", "lumbre-viewer"],
        TESTKIT => [LIBRARIES, &["lumbre", "lumbre-viewer"]].concat(),
        _ => return None,
    })
}

/// Any crate may use this one in its tests.
const TESTKIT: &str = "lumbre-testkit";

/// `core` is pure: these are all the crates from elsewhere that it may use.
const CORE_EXTERNAL: &[&str] = &["bytemuck", "glam", "libm"];

/// Checks the packages of `cargo metadata --no-deps`.
pub(super) fn check(metadata: &Value) -> Vec<Finding> {
    let packages = metadata["packages"].as_array().map(Vec::as_slice).unwrap_or_default();
    packages.iter().flat_map(check_package).collect()
}

fn check_package(package: &Value) -> Vec<Finding> {
    let name = package["name"].as_str().unwrap_or_default();
    let finding = |message| Finding { path: format!("{name}/Cargo.toml"), line: 0, message };
    let Some(may_use) = may_use(name) else {
        return vec![finding("not in the table of crates (xtask/src/lint/dependencies.rs)".to_owned())];
    };
    let dependencies = package["dependencies"].as_array().map(Vec::as_slice).unwrap_or_default();
    let refused = dependencies.iter().filter_map(|dependency| {
        let used = dependency["name"].as_str().unwrap_or_default();
        let in_tests = dependency["kind"] == "dev";
        let allowed = if dependency["path"].is_string() {
            may_use.contains(&used) || (in_tests && used == TESTKIT)
        } else {
            name != "lumbre-core" || in_tests || CORE_EXTERNAL.contains(&used)
        };
        (!allowed).then(|| finding(format!("{name} may not use {used}")))
    });
    refused.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn found(name: &str, used: &str, kind: Option<&str>, path: bool) -> Vec<String> {
        let dependency = json!({ "name": used, "kind": kind, "path": path.then_some("/x") });
        let metadata = json!({ "packages": [{ "name": name, "dependencies": [dependency] }] });
        check(&metadata).into_iter().map(|f| f.message).collect()
    }

    #[test]
    fn arrows_that_are_not_drawn_are_found() {
        let refused = ["lumbre-core may not use lumbre-scene"];
        assert_eq!(found("lumbre-core", "lumbre-scene", None, true), refused);
        assert_eq!(found("lumbre-core", "lumbre-scene", Some("build"), true), refused);
        assert_eq!(found("lumbre-core", "lumbre-scene", Some("dev"), true), refused);
        assert_eq!(found("lumbre-cpu", "lumbre-io", None, true).len(), 1);
        assert_eq!(found("lumbre-io", "lumbre-testkit", None, true).len(), 1);
        assert_eq!(found("lumbre-core", "rayon", None, false).len(), 1);
        assert_eq!(found("lumbre-new", "glam", None, false).len(), 1);
    }

    #[test]
    fn drawn_arrows_pass() {
        assert!(found("lumbre-scene", "lumbre-core", None, true).is_empty());
        assert!(found("lumbre-core", "lumbre-testkit", Some("dev"), true).is_empty());
        assert!(found("lumbre-core", "glam", None, false).is_empty());
        assert!(found("lumbre-io", "image", None, false).is_empty());
    }
}
