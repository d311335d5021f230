//! A Rust file as the rules see it: text, tokens, syntax tree, and which lines are test code.

use super::Finding;
use proc_macro2::{Delimiter, TokenStream, TokenTree};
use std::collections::HashSet;
use std::ops::RangeInclusive;
use syn::spanned::Spanned;
use syn::visit::{self, Visit};

/// One Rust file.
pub(super) struct Source {
    /// Relative to the workspace root, with `/`.
    pub(super) path: String,
    pub(super) text: String,
    pub(super) syntax: syn::File,
    /// All tokens in order, the delimiters of groups among them, also those inside macros.
    pub(super) tokens: Vec<Token>,
    /// The whole file is test code.
    pub(super) all_test: bool,
    test_lines: Vec<RangeInclusive<usize>>,
    /// Files of `#[cfg(test)] mod name;` declarations: `folder/name.rs` or everything in `folder/name/`.
    test_modules: Vec<String>,
}

/// A token and the line it begins on, from 1.
pub(super) struct Token {
    pub(super) text: String,
    pub(super) line: usize,
}

/// Parses all files and finds out which of them are test code.
///
/// # Errors
/// The first file that is not Rust.
pub(super) fn read_all(files: Vec<(String, String)>) -> Result<Vec<Source>, String> {
    let parsed: Result<Vec<Source>, String> = files.into_iter().map(|(p, t)| Source::parse(&p, t)).collect();
    let mut sources = parsed?;
    let modules: HashSet<String> = sources.iter().flat_map(|s| s.test_modules.clone()).collect();
    for source in &mut sources {
        let stem = source.path.strip_suffix(".rs").unwrap_or(&source.path);
        source.all_test |= modules.iter().any(|m| stem == m || stem.starts_with(&format!("{m}/")));
    }
    Ok(sources)
}

impl Source {
    /// Parses one file. Files in `tests/`, `benches/` and `examples/` of a crate are test code:
    /// nothing in them reaches a user.
    ///
    /// # Errors
    /// Where it is not Rust.
    pub(super) fn parse(path: &str, text: String) -> Result<Source, String> {
        let syntax = syn::parse_file(&text).map_err(|e| format!("{path}: {e}"))?;
        let stream: TokenStream = text.parse().map_err(|e| format!("{path}: {e}"))?;
        let mut tokens = Vec::new();
        flatten(stream, &mut tokens);
        let mut tests = TestCode { folder: module_folder(path), lines: Vec::new(), modules: Vec::new() };
        tests.visit_file(&syntax);
        let inside = path.splitn(3, '/').nth(2).unwrap_or_default();
        let all_test = ["tests/", "benches/", "examples/"].iter().any(|folder| inside.starts_with(folder));
        let path = path.to_owned();
        Ok(Source {
            path,
            text,
            syntax,
            tokens,
            all_test,
            test_lines: tests.lines,
            test_modules: tests.modules,
        })
    }

    /// The folder of the crate, `core` for `crates/core/src/lib.rs`.
    pub(super) fn krate(&self) -> &str {
        let path = self.path.strip_prefix("crates/").unwrap_or(&self.path);
        path.split('/').next().unwrap_or_default()
    }

    /// Is this line test code?
    pub(super) fn is_test(&self, line: usize) -> bool {
        self.all_test || self.test_lines.iter().any(|range| range.contains(&line))
    }

    /// Token indices at which `pattern` begins; `*` stands for any token.
    pub(super) fn find<'a>(&'a self, pattern: &'a [&str]) -> impl Iterator<Item = usize> + 'a {
        self.tokens.windows(pattern.len()).enumerate().filter_map(move |(i, window)| {
            let fits = window.iter().zip(pattern).all(|(t, p)| *p == "*" || t.text == *p);
            fits.then_some(i)
        })
    }

    /// A finding in this file.
    pub(super) fn finding(&self, line: usize, message: impl Into<String>) -> Finding {
        Finding { path: self.path.clone(), line, message: message.into() }
    }
}

/// The folder of the modules that a file declares: `a/b` for `a/b.rs`, `a` for `a/mod.rs`, `a/lib.rs` and `a/main.rs`.
fn module_folder(path: &str) -> String {
    let stem = path.strip_suffix(".rs").unwrap_or(path);
    let parent = ["/mod", "/lib", "/main"].iter().find_map(|name| stem.strip_suffix(name));
    parent.unwrap_or(stem).to_owned()
}

fn flatten(stream: TokenStream, tokens: &mut Vec<Token>) {
    for tree in stream {
        let line = tree.span().start().line;
        let mut push = |text: String, line| tokens.push(Token { text, line });
        match tree {
            TokenTree::Group(group) => {
                let (open, close) = match group.delimiter() {
                    Delimiter::Parenthesis => ("(", ")"),
                    Delimiter::Brace => ("{", "}"),
                    Delimiter::Bracket => ("[", "]"),
                    Delimiter::None => ("", ""),
                };
                push(open.to_owned(), line);
                flatten(group.stream(), tokens);
                let line = group.span_close().start().line;
                tokens.push(Token { text: close.to_owned(), line });
            }
            other => push(other.to_string(), line),
        }
    }
}

/// Finds items under `#[cfg(test)]` and `#[test]`.
struct TestCode {
    folder: String,
    lines: Vec<RangeInclusive<usize>>,
    modules: Vec<String>,
}

impl TestCode {
    fn note(&mut self, attributes: &[syn::Attribute], item: &impl Spanned) {
        if attributes.iter().any(is_test_attribute) {
            let span = item.span();
            self.lines.push(span.start().line..=span.end().line);
        }
    }
}

impl<'ast> Visit<'ast> for TestCode {
    fn visit_item_mod(&mut self, module: &'ast syn::ItemMod) {
        self.note(&module.attrs, module);
        if module.content.is_none() && module.attrs.iter().any(is_test_attribute) {
            self.modules.push(format!("{}/{}", self.folder, module.ident));
        }
        visit::visit_item_mod(self, module);
    }

    fn visit_item_fn(&mut self, function: &'ast syn::ItemFn) {
        self.note(&function.attrs, function);
        visit::visit_item_fn(self, function);
    }

    fn visit_item_impl(&mut self, block: &'ast syn::ItemImpl) {
        self.note(&block.attrs, block);
        visit::visit_item_impl(self, block);
    }

    fn visit_impl_item_fn(&mut self, function: &'ast syn::ImplItemFn) {
        self.note(&function.attrs, function);
        visit::visit_impl_item_fn(self, function);
    }

    fn visit_item_use(&mut self, item: &'ast syn::ItemUse) {
        self.note(&item.attrs, item);
    }
}

/// `#[test]` or `#[cfg(test)]`, also with more conditions, as in `cfg(all(test, unix))`.
fn is_test_attribute(attribute: &syn::Attribute) -> bool {
    if attribute.path().is_ident("test") {
        return true;
    }
    let syn::Meta::List(list) = &attribute.meta else { return false };
    if !list.path.is_ident("cfg") {
        return false;
    }
    let condition = list.tokens.to_string().replace(' ', "");
    condition == "test" || condition.starts_with("all(test,")
}

/// A file for the tests of the rules.
#[cfg(test)]
pub(super) fn source(path: &str, text: &str) -> Source {
    Source::parse(path, text.to_owned()).unwrap()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn test_code_is_known() {
        let text = "fn a() {}\n#[cfg(test)]\nmod tests {\n    fn b() {}\n}\n#[cfg(not(test))]\nfn c() {}\n";
        let s = source("crates/core/src/a.rs", text);
        let lines: Vec<bool> = (1..=7).map(|line| s.is_test(line)).collect();
        assert_eq!(lines, [false, true, true, true, true, false, false]);
        assert!(source("crates/core/tests/a.rs", text).is_test(1));
        assert!(source("crates/core/examples/a/main.rs", text).is_test(1));
        assert!(!source("crates/core/src/tests_of_it.rs", text).is_test(1));
    }

    #[test]
    fn test_modules_in_files_of_their_own_are_known() {
        let file = |path: &str, text: &str| (path.to_owned(), text.to_owned());
        let all = read_all(vec![
            file("crates/x/src/lib.rs", "#[cfg(test)] mod checks; mod work;"),
            file("crates/x/src/checks.rs", ""),
            file("crates/x/src/checks/more.rs", ""),
            file("crates/x/src/work.rs", "#[cfg(test)] mod tests;"),
            file("crates/x/src/work/tests.rs", ""),
        ]);
        let tests: Vec<bool> = all.unwrap().iter().map(|s| s.all_test).collect();
        assert_eq!(tests, [false, true, true, false, true]);
    }

    #[test]
    fn tokens_are_found_inside_macros_and_not_in_comments() {
        let s = source("crates/x/src/lib.rs", "fn a() {\n    // b.c()\n    m!(\"b.c()\", {\n b.c() });\n}");
        let found: Vec<usize> = s.find(&[".", "c", "("]).map(|i| s.tokens[i].line).collect();
        assert_eq!(found, [4]);
    }
}
