//! Rule on lints switched off: each `#[allow]` and `#[expect]` says why.

use super::{Finding, source::Source};

/// `#[allow(...)]` carries `reason = "..."`.
pub(super) fn without_reason(source: &Source) -> Vec<Finding> {
    let mut findings = Vec::new();
    for (i, token) in source.tokens.iter().enumerate() {
        let opens = |offset: usize, text: &str| source.tokens.get(i + offset).is_some_and(|t| t.text == text);
        let is_lint_switch = (token.text == "allow" || token.text == "expect") && opens(1, "(");
        if !is_lint_switch || !in_attribute(source, i) {
            continue;
        }
        // Lint names hold no parentheses, so the first one closes the list.
        let list = source.tokens[i + 2..].iter().take_while(|t| t.text != ")");
        if !list.map(|t| t.text.as_str()).any(|t| t == "reason") {
            findings.push(source.finding(token.line, format!("#[{}] without reason = \"...\"", token.text)));
        }
    }
    findings
}

/// Is token `i` the first of an attribute, or listed in a `cfg_attr`?
fn in_attribute(source: &Source, i: usize) -> bool {
    let text = |back: usize| i.checked_sub(back).map_or("", |j| source.tokens[j].text.as_str());
    match text(1) {
        "[" => text(2) == "#" || (text(2) == "!" && text(3) == "#"),
        "," => source.tokens[..i]
            .iter()
            .rev()
            .find(|t| t.text == "[" || t.text == "cfg_attr")
            .is_some_and(|t| t.text == "cfg_attr"),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::super::source::source;
    use super::*;

    fn found(text: &str) -> usize {
        without_reason(&source("crates/core/src/a.rs", text)).len()
    }

    #[test]
    fn an_allow_without_reason_is_found() {
        assert_eq!(found("#![allow(dead_code)]"), 1);
        assert_eq!(found("#[allow(clippy::a, b)]\nfn f() {}"), 1);
        assert_eq!(found("#[expect(dead_code)]\nfn f() {}"), 1);
        assert_eq!(found("#[cfg_attr(test, allow(dead_code))]\nfn f() {}"), 1);
    }

    #[test]
    fn an_allow_with_reason_and_methods_of_that_name_pass() {
        assert_eq!(found("#[allow(dead_code, reason = \"used on Windows\")]\nfn f() {}"), 0);
        assert_eq!(found("fn f() { x.expect(\"a\"); allow(b); g(a, expect(b)) }"), 0);
    }
}
