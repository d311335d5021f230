//! Completions and manual pages: each shell gets its own, and the copies in `docs` are those of this program. After a change of the
//! flags `LUMBRE_BLESS=1 cargo test -p lumbre-cli --test cli generated` makes them anew.

use crate::common::*;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Checks that a folder of `docs` holds exactly these files, or writes them.
fn current(folder: &str, files: &BTreeMap<String, String>) {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs").join(folder);
    if std::env::var_os("LUMBRE_BLESS").is_some() {
        let _ = fs::remove_dir_all(&docs);
        fs::create_dir_all(&docs).unwrap();
        files.iter().for_each(|(name, text)| fs::write(docs.join(name), text).unwrap());
    }
    let there: BTreeMap<String, String> = texts(&docs);
    let names = |m: &BTreeMap<String, String>| m.keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(&there), names(files), "docs/{folder}");
    for (name, text) in files {
        assert!(there[name] == *text, "docs/{folder}/{name} is of other flags; LUMBRE_BLESS=1 makes it anew");
    }
}

fn texts(folder: &Path) -> BTreeMap<String, String> {
    let read = |path: PathBuf| {
        (path.file_name().unwrap().to_string_lossy().into_owned(), fs::read_to_string(path).unwrap())
    };
    fs::read_dir(folder).map(|d| d.map(|e| read(e.unwrap().path())).collect()).unwrap_or_default()
}

#[test]
fn completions_are_current() {
    let shells = [
        ("bash", "lumbre.bash"),
        ("zsh", "_lumbre"),
        ("fish", "lumbre.fish"),
        ("powershell", "_lumbre.ps1"),
        ("elvish", "lumbre.elv"),
    ];
    let made = shells
        .map(|(shell, file)| (file.to_string(), lumbre(&format!("completions {shell}")).exits(0).stdout));
    assert!(made.iter().all(|(_, text)| text.contains("target-error")));
    current("completions", &made.into());
    lumbre("completions tcsh").exits(2).says("possible values: bash");
}

#[test]
fn manual_pages_are_current() {
    let dir = folder();
    lumbre(&format!("man {}", dir.path().display())).exits(0).says("lumbre-render.1");
    let pages = texts(dir.path());
    assert!(
        pages["lumbre-render.1"].contains(r"\-\-target\-error")
            && pages["lumbre-render.1"].contains("Exit codes")
    );
    assert_eq!(lumbre("man").exits(0).stdout.trim_end(), pages["lumbre.1"].trim_end());
    current("man", &pages);
    lumbre(&format!("man {}/none", dir.path().display())).exits(74).says("cannot write");
}

#[test]
fn every_command_has_examples_and_says_its_exit_codes() {
    for command in ["render", "info", "compare", "merge", "devices", "bench", "completions", "man"] {
        let help = lumbre(&format!("{command} --help")).exits(0).stdout;
        assert!(help.contains("Examples:") && help.contains("Exit codes:"), "{command}");
    }
}
