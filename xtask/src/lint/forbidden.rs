//! Rules on things that are not written here: unfinished code, float functions that differ between machines, and file
//! access outside the crates for it.

use super::{Finding, source::Source};

/// Nothing is left for later: no `todo!`, no `unimplemented!`, no ignored test.
pub(super) fn unfinished(source: &Source) -> Vec<Finding> {
    let macros = ["todo", "unimplemented"].into_iter().flat_map(|name| {
        let uses: Vec<usize> = source.find(&[name, "!"]).collect();
        uses.into_iter().map(move |i| (i, format!("{name}!")))
    });
    let ignored = source.find(&["#", "[", "ignore"]).map(|i| (i, "#[ignore]".to_owned()));
    macros.chain(ignored).map(|(i, what)| source.finding(source.tokens[i].line, what)).collect()
}

/// Crates whose arithmetic shapes the picture.
const EXACT_CRATES: &[&str] = &["core", "scene", "cpu"];

/// The one file that wraps the float functions of the `libm` crate.
const MATH: &str = "crates/core/src/math.rs";

/// Functions of f32 and f64 whose last bits the standard library leaves to the platform.
const PLATFORM_FUNCTIONS: &[&str] = &[
    "acos", "acosh", "asin", "asinh", "atan", "atan2", "atanh", "cbrt", "cos", "cosh", "exp", "exp2",
    "exp_m1", "hypot", "ln", "ln_1p", "log", "log10", "log2", "powf", "powi", "sin", "sin_cos", "sinh",
    "tan", "tanh",
];

/// Sines, powers and the like come from `core::math`, so that all machines draw the same bits.
pub(super) fn platform_float_functions(source: &Source) -> Vec<Finding> {
    if !EXACT_CRATES.contains(&source.krate()) || source.path == MATH {
        return Vec::new();
    }
    let methods = source.find(&[".", "*", "("]).map(|i| i + 1);
    let paths = ["f32", "f64"].into_iter().flat_map(|float| {
        let found: Vec<usize> = source.find(&[float, ":", ":", "*"]).map(|i| i + 3).collect();
        found
    });
    let mut findings = Vec::new();
    for token in methods.chain(paths).map(|i| &source.tokens[i]) {
        if PLATFORM_FUNCTIONS.contains(&token.text.as_str()) && !source.is_test(token.line) {
            findings.push(
                source.finding(token.line, format!("std's `{}`: take the one in core::math", token.text)),
            );
        }
    }
    findings
}

/// Crates that may open files.
const FILE_CRATES: &[&str] = &["io", "cli", "testkit", "xtask"];

/// Files elsewhere that may, too: the cache of pipelines, what the compiler of shaders and a test share, with the feature
/// `shader-reload` for those who change shaders what is read again when it changes, and of the window its file dialog, its list of
/// recent files and its look at a file's time.
const FILE_PLACES: &[&str] = &[
    "crates/vulkan/src/cache.rs",
    "crates/vulkan/src/path/code.rs",
    "crates/shaders/src/sources.rs",
    "crates/viewer/src/folder.rs",
    "crates/viewer/src/recent.rs",
    "crates/viewer/src/watch.rs",
];

/// Files are opened in `io`, and by programs and tests.
pub(super) fn file_access(source: &Source) -> Vec<Finding> {
    if FILE_CRATES.contains(&source.krate()) || FILE_PLACES.contains(&source.path.as_str()) {
        return Vec::new();
    }
    let mut lines: Vec<usize> =
        source.find(&["std", ":", ":", "fs"]).map(|i| source.tokens[i].line).collect();
    // `use std::{fs, ...}`: `fs` up to the closing brace of the list.
    for i in source.find(&["std", ":", ":", "{"]) {
        let mut depth = 0;
        for (j, token) in source.tokens.iter().enumerate().skip(i + 3) {
            match token.text.as_str() {
                "{" => depth += 1,
                "}" if depth == 1 => break,
                "}" => depth -= 1,
                "fs" if depth == 1 && source.tokens[j - 1].text != ":" => lines.push(token.line),
                _ => {}
            }
        }
    }
    lines.retain(|line| !source.is_test(*line));
    lines.into_iter().map(|line| source.finding(line, "std::fs: only io opens files")).collect()
}

/// Crates that programs of others are built with.
const LIBRARIES: &[&str] = &["core", "scene", "io", "cpu", "lumbre"];

/// A library neither prints nor ends the process nor takes over its panics.
pub(super) fn loud_libraries(source: &Source) -> Vec<Finding> {
    if !LIBRARIES.contains(&source.krate()) || !source.path.contains("/src/") {
        return Vec::new();
    }
    let macros = ["print", "println", "eprint", "eprintln", "dbg"].into_iter().flat_map(|name| {
        let uses: Vec<usize> = source.find(&[name, "!"]).collect();
        uses.into_iter().map(move |i| (i, format!("{name}!")))
    });
    let calls = ["exit", "abort", "set_hook"].into_iter().flat_map(|name| {
        let uses: Vec<usize> = source.find(&[":", name, "("]).collect();
        uses.into_iter().map(move |i| (i, format!("{name}()")))
    });
    let found = macros.chain(calls).map(|(i, what)| (source.tokens[i].line, what));
    found
        .filter(|(line, _)| !source.is_test(*line))
        .map(|(line, what)| source.finding(line, format!("{what} in a library")))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::source::source;
    use super::*;

    const PATH: &str = "crates/core/src/a.rs";

    #[test]
    fn unfinished_code_is_found() {
        for text in
            ["fn f() { todo!() }", "fn f() { unimplemented!(\"x\") }", "#[ignore = \"slow\"]\nfn f() {}"]
        {
            assert_eq!(unfinished(&source(PATH, text)).len(), 1, "{text}");
        }
        assert!(unfinished(&source(PATH, "// todo!()\nfn ignore(todo: T) { todo.f() }")).is_empty());
    }

    #[test]
    fn platform_floats_are_found_where_they_shape_pictures() {
        for text in [
            "fn f() { x.sin(); }",
            "fn f() { f32::powf(x, y); }",
            "fn f() { v.map(f32::exp); }",
            "m!(x.ln());",
        ] {
            assert_eq!(platform_float_functions(&source(PATH, text)).len(), 1, "{text}");
            assert!(platform_float_functions(&source(MATH, text)).is_empty());
            assert!(platform_float_functions(&source("crates/io/src/a.rs", text)).is_empty());
            let test = format!("#[cfg(test)] mod tests {{ {text} }}");
            assert!(platform_float_functions(&source(PATH, &test)).is_empty());
        }
        let harmless = "fn f() { math::sin(x); x.sqrt(); x.mul_add(y, z); let sin = s.cos; }";
        assert!(platform_float_functions(&source(PATH, harmless)).is_empty());
    }

    #[test]
    fn loud_libraries_are_found() {
        for text in ["fn f() { println!(); }", "fn f() { std::process::exit(1) }", "fn f() { dbg!(x); }"] {
            assert_eq!(loud_libraries(&source(PATH, text)).len(), 1, "{text}");
            assert!(loud_libraries(&source("crates/cli/src/a.rs", text)).is_empty());
            assert!(loud_libraries(&source("crates/lumbre/examples/a.rs", text)).is_empty());
        }
        assert!(loud_libraries(&source(PATH, "fn exit() { self.exit(); writeln!(f) }")).is_empty());
    }

    #[test]
    fn file_access_is_found() {
        for text in [
            "use std::fs::File;",
            "fn f() { std::fs::read(p) }",
            "use std::{io, fs};",
            "use std::{fs::{self}};",
        ] {
            assert_eq!(file_access(&source("crates/lumbre/src/a.rs", text)).len(), 1, "{text}");
            assert!(file_access(&source("crates/io/src/a.rs", text)).is_empty());
            assert!(file_access(&source("crates/vulkan/src/cache.rs", text)).is_empty());
            assert_eq!(file_access(&source("crates/vulkan/src/gpu.rs", text)).len(), 1, "{text}");
        }
        assert!(file_access(&source(PATH, "use std::{io, fmt::{self}}; fn fs() {}")).is_empty());
    }
}
