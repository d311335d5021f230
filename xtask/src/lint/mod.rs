//! `cargo xtask lint`: the rules of this project that neither rustc nor clippy knows. One file per family of rules, each
//! with tests that show it fires.

mod allow;
mod dependencies;
mod files;
mod forbidden;
mod functions;
mod source;
mod unsafety;

use crate::{command, tree};
use source::Source;

/// One broken rule.
#[derive(Debug, PartialEq)]
struct Finding {
    path: String,
    /// 0 when the whole file is meant.
    line: usize,
    message: String,
}

impl std::fmt::Display for Finding {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        match self.line {
            0 => write!(f, "{}: {}", self.path, self.message),
            line => write!(f, "{}:{line}: {}", self.path, self.message),
        }
    }
}

/// The rules that look at one file at a time.
const RULES: &[fn(&Source) -> Vec<Finding>] = &[
    files::length,
    files::head,
    functions::sizes,
    unsafety::outside_its_places,
    unsafety::not_forbidden_by_crate_root,
    allow::without_reason,
    forbidden::unfinished,
    forbidden::platform_float_functions,
    forbidden::file_access,
    forbidden::loud_libraries,
];

/// Checks the whole workspace.
///
/// # Errors
/// One line per finding.
pub(crate) fn run() -> Result<(), String> {
    let mut findings = dependencies::check(&command::metadata(false)?);
    for source in source::read_all(tree::text_files(&["rs"])?)? {
        findings.extend(RULES.iter().flat_map(|rule| rule(&source)));
    }
    if findings.is_empty() {
        return Ok(());
    }
    Err(findings.iter().map(Finding::to_string).collect::<Vec<_>>().join("\n"))
}
