//! `cargo xtask licences`: every dependency must be usable under at least one licence of an allow-list.

use crate::command::metadata;
use serde_json::Value;
use spdx::{Expression, LicenseReq, ParseMode};

/// Permissive licences, which ask for no more than naming the authors.
const ALLOWED: &[&str] = &[
    "0BSD",
    "Apache-2.0",
    "Apache-2.0 WITH LLVM-exception",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "BSL-1.0",
    "CC0-1.0",
    "ISC",
    "MIT",
    "MIT-0",
    "OFL-1.1",         // the letters of the window: free in programs, under their own name
    "Ubuntu-font-1.0", // likewise
    "Unicode-3.0",
    "Unlicense",
    "Zlib",
];

/// Checks all packages of the lock file, for all platforms.
///
/// # Errors
/// One line per package whose licence is unknown or not allowed.
pub(crate) fn run() -> Result<(), String> {
    let metadata = metadata(true)?;
    let packages = metadata["packages"].as_array().ok_or("cargo metadata names no packages")?;
    let refused: Vec<String> = packages.iter().filter_map(refusal).collect();
    if refused.is_empty() { Ok(()) } else { Err(refused.join("\n")) }
}

/// Why a package is refused.
fn refusal(package: &Value) -> Option<String> {
    let text = |key: &str| package[key].as_str().unwrap_or_default();
    let reason = verdict(text("license")).err()?;
    Some(format!("{} {}: {reason}", text("name"), text("version")))
}

fn verdict(licence: &str) -> Result<(), String> {
    if licence.is_empty() {
        return Err("names no licence".to_owned());
    }
    // Older crates write `MIT/Apache-2.0`, which the lax mode reads as OR.
    let expression = Expression::parse_mode(licence, ParseMode::LAX)
        .map_err(|e| format!("licence \"{licence}\" is not SPDX: {}", e.reason))?;
    let allowed = |req: &LicenseReq| ALLOWED.contains(&req.to_string().as_str());
    if expression.evaluate(allowed) { Ok(()) } else { Err(format!("licence \"{licence}\" is not allowed")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn permissive_licences_pass() {
        for licence in [
            "MIT",
            "MIT OR Apache-2.0",
            "MIT/Apache-2.0",
            "(MIT OR Apache-2.0) AND Unicode-3.0",
            "Apache-2.0 WITH LLVM-exception OR GPL-3.0-only",
        ] {
            assert_eq!(verdict(licence), Ok(()), "{licence}");
        }
    }

    #[test]
    fn all_others_fail() {
        for licence in
            ["", "GPL-3.0-only", "MIT AND LGPL-2.1-only", "My Own Licence", "GPL-2.0 WITH LLVM-exception"]
        {
            assert!(verdict(licence).is_err(), "{licence}");
        }
        let package = serde_json::json!({ "name": "odd", "version": "1.2.3", "license": null });
        assert_eq!(refusal(&package).unwrap(), "odd 1.2.3: names no licence");
    }
}
