//! Rules on functions: how long, and how many parameters. Test code may be as long as it likes. Closures and functions
//! written inside `macro_rules!` are not looked at.

use super::{Finding, source::Source};
use syn::spanned::Spanned;
use syn::visit::{self, Visit};

/// Lines from `fn` to the closing brace.
const MAX_LINES: usize = 80;

/// Parameters besides `self`; more go into a struct.
const MAX_PARAMETERS: usize = 6;

/// Functions that may be longer: (end of the path, name, lines). The radiance loop names its steps in comments and reads
/// better in one piece.
const LONGER: &[(&str, &str, usize)] = &[("/path.rs", "radiance", 120), ("/path/mod.rs", "radiance", 120)];

/// Functions are short and take few parameters.
pub(super) fn sizes(source: &Source) -> Vec<Finding> {
    let mut functions = Functions { source, findings: Vec::new() };
    functions.visit_file(&source.syntax);
    functions.findings
}

struct Functions<'a> {
    source: &'a Source,
    findings: Vec<Finding>,
}

impl Functions<'_> {
    fn check(&mut self, signature: &syn::Signature, body: Option<&syn::Block>) {
        let name = signature.ident.to_string();
        let first = signature.span().start().line;
        if self.source.is_test(first) {
            return;
        }
        let is_parameter = |a: &&syn::FnArg| matches!(a, syn::FnArg::Typed(_));
        let parameters = signature.inputs.iter().filter(is_parameter).count();
        if parameters > MAX_PARAMETERS {
            let message =
                format!("`{name}` has {parameters} parameters, at most {MAX_PARAMETERS}: make a struct");
            self.findings.push(self.source.finding(first, message));
        }
        let Some(body) = body else { return };
        let lines = body.span().end().line - first + 1;
        let limit = line_limit(&self.source.path, &name);
        if lines > limit {
            let message = format!("`{name}` has {lines} lines, at most {limit}: split it");
            self.findings.push(self.source.finding(first, message));
        }
    }
}

fn line_limit(path: &str, name: &str) -> usize {
    let exception = LONGER.iter().find(|(end, function, _)| path.ends_with(end) && name == *function);
    exception.map_or(MAX_LINES, |(_, _, lines)| *lines)
}

impl<'ast> Visit<'ast> for Functions<'_> {
    fn visit_item_fn(&mut self, function: &'ast syn::ItemFn) {
        self.check(&function.sig, Some(&function.block));
        visit::visit_item_fn(self, function);
    }

    fn visit_impl_item_fn(&mut self, function: &'ast syn::ImplItemFn) {
        self.check(&function.sig, Some(&function.block));
        visit::visit_impl_item_fn(self, function);
    }

    fn visit_trait_item_fn(&mut self, function: &'ast syn::TraitItemFn) {
        self.check(&function.sig, function.default.as_ref());
        visit::visit_trait_item_fn(self, function);
    }
}

#[cfg(test)]
mod tests {
    use super::super::source::source;
    use super::*;

    fn messages(path: &str, text: &str) -> Vec<String> {
        sizes(&source(path, text)).into_iter().map(|f| f.message).collect()
    }

    fn function(name: &str, lines: usize) -> String {
        format!("fn {name}() {{\n{}}}\n", "    a();\n".repeat(lines - 2))
    }

    #[test]
    fn long_functions_are_found_wherever_they_are() {
        let path = "crates/core/src/a.rs";
        assert!(messages(path, &function("f", 80)).is_empty());
        let long = function("f", 81);
        let found = ["`f` has 81 lines, at most 80: split it"];
        assert_eq!(messages(path, &long), found);
        for wrapped in
            [format!("impl S {{ {long} }}"), format!("trait T {{ {long} }}"), format!("mod m {{ {long} }}")]
        {
            assert_eq!(messages(path, &wrapped), found);
        }
        assert_eq!(messages(path, &format!("fn g() {{ {long} }}"))[1], found[0]);
        assert!(messages(path, &format!("#[cfg(test)] mod tests {{ {long} }}")).is_empty());
        assert!(messages("crates/core/tests/a.rs", &long).is_empty());
    }

    #[test]
    fn only_the_radiance_loop_may_be_longer() {
        let path = "crates/cpu/src/path.rs";
        assert!(messages(path, &function("radiance", 120)).is_empty());
        assert_eq!(messages(path, &function("radiance", 121)).len(), 1);
        assert_eq!(messages(path, &function("other", 81)).len(), 1);
        assert_eq!(messages("crates/cpu/src/bvh.rs", &function("radiance", 81)).len(), 1);
    }

    #[test]
    fn seven_parameters_are_found() {
        let path = "crates/core/src/a.rs";
        assert!(messages(path, "impl S { fn f(&self, a: A, b: A, c: A, d: A, e: A, f: A) {} }").is_empty());
        let found = messages(path, "trait T { fn f(a: A, b: A, c: A, d: A, e: A, f: A, g: A); }");
        assert_eq!(found, ["`f` has 7 parameters, at most 6: make a struct"]);
    }
}
