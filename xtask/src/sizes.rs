//! Keeps files, functions and parameters within what a reader takes in at once.

use std::path::Path;

use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{Attribute, Block, FnArg, ImplItemFn, ItemFn, ItemMod, Signature, TraitItemFn, Type};

use crate::scripts::functions::functions;
use crate::scripts::{Script, scripts};
use crate::shell::Outcome;
use crate::sources::{files_of, folders, is_for_tests, parse, read, seen_from_root};

/// Lines of a file, at most.
const FILE: usize = 500;
/// Lines of a function, at most, from its first word to its last brace.
const FUNCTION: usize = 75;
/// Values of a tuple that is a parameter, at most.
const TUPLE: usize = 2;

/// What users take into their project as one file may be longer.
const TAKEN_ALONE: [&str; 1] = ["crates/carom-c/csharp/CaromWorld.cs"];

/// Refuses files and functions that are too long, and parameters packed into tuples.
pub fn check() -> Outcome {
    let mut faults = Vec::new();
    for folder in folders()? {
        for file in files_of(&folder)? {
            let place = seen_from_root(&file).display();
            let lines = read(&file)?.lines().count();
            if lines > FILE {
                faults.push(format!("  {place}: {lines} lines, more than {FILE}"));
            }
            let found = faults_of(&file)?;
            faults.extend(found.into_iter().map(|fault| format!("  {place}:{fault}")));
        }
    }
    faults.extend(scripts()?.iter().flat_map(faults_of_script));
    if faults.is_empty() { Ok(()) } else { Err(format!("sizes:\n{}", faults.join("\n"))) }
}

/// What is too long of a script; functions of tests may be, as those of Rust may.
fn faults_of_script(script: &Script) -> Vec<String> {
    let place = script.file.display();
    let mut faults = Vec::new();
    let lines = script.text.lines().count();
    if lines > FILE && !TAKEN_ALONE.iter().any(|it| script.file.ends_with(it)) {
        faults.push(format!("  {place}: {lines} lines, more than {FILE}"));
    }
    let long = functions(script).into_iter().filter(|it| it.lines > FUNCTION);
    for function in long.filter(|_| !script.is_test()) {
        let (name, first, lines) = (function.name, function.line, function.lines);
        faults.push(format!("  {place}:{first}: {name} has {lines} lines, more than {FUNCTION}"));
    }
    faults
}

fn faults_of(file: &Path) -> Outcome<Vec<String>> {
    let mut sizes = Sizes::default();
    sizes.visit_file(&parse(file)?);
    Ok(sizes.faults)
}

/// What is too large in a file.
#[derive(Default)]
struct Sizes {
    faults: Vec<String>,
}

impl Sizes {
    fn look_at(&mut self, signature: &Signature, block: Option<&Block>) {
        let (name, first) = (&signature.ident, signature.span().start().line);
        let lines = block.map_or(0, |block| block.span().end().line + 1 - first);
        if lines > FUNCTION {
            self.faults.push(format!("{first}: {name} has {lines} lines, more than {FUNCTION}"));
        }
        for parameter in &signature.inputs {
            if let FnArg::Typed(parameter) = parameter
                && packs_parameters(&parameter.ty)
            {
                let line = parameter.span().start().line;
                self.faults.push(format!("{line}: a parameter of {name} is a tuple of too much"));
            }
        }
    }
}

impl<'ast> Visit<'ast> for Sizes {
    fn visit_item_mod(&mut self, item: &'ast ItemMod) {
        if !is_for_tests(&item.attrs) {
            visit::visit_item_mod(self, item);
        }
    }

    fn visit_item_fn(&mut self, function: &'ast ItemFn) {
        if !is_for_tests(&function.attrs) {
            self.look_at(&function.sig, Some(&function.block));
            visit::visit_item_fn(self, function);
        }
    }

    fn visit_impl_item_fn(&mut self, function: &'ast ImplItemFn) {
        self.look_at(&function.sig, Some(&function.block));
        visit::visit_impl_item_fn(self, function);
    }

    fn visit_trait_item_fn(&mut self, function: &'ast TraitItemFn) {
        self.look_at(&function.sig, function.default.as_ref());
        visit::visit_trait_item_fn(self, function);
    }

    fn visit_attribute(&mut self, _: &'ast Attribute) {}
}

/// Whether a parameter of this type stands for several: a tuple of many values, or of tuples; also
/// behind a reference.
fn packs_parameters(parameter: &Type) -> bool {
    match parameter {
        Type::Reference(reference) => packs_parameters(&reference.elem),
        Type::Paren(inner) => packs_parameters(&inner.elem),
        Type::Tuple(tuple) => tuple.elems.len() > TUPLE || tuple.elems.iter().any(is_tuple),
        _ => false,
    }
}

fn is_tuple(value: &Type) -> bool {
    match value {
        Type::Reference(reference) => is_tuple(&reference.elem),
        Type::Tuple(_) => true,
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::{Sizes, faults_of_script, packs_parameters};
    use crate::scripts::Script;
    use syn::visit::Visit;

    #[test]
    fn tuples_that_stand_for_several_parameters_are_found() {
        let refused = ["(f64, f64, f64)", "&(A, B, &mut C)", "(A, (B, C))", "(A, &(B, C))"];
        for text in refused {
            assert!(packs_parameters(&syn::parse_str(text).unwrap()), "{text}");
        }
        for text in ["(A, B)", "&[(A, B, C)]", "impl Fn((A, B, C))", "f64", "()"] {
            assert!(!packs_parameters(&syn::parse_str(text).unwrap()), "{text}");
        }
    }

    #[test]
    fn long_functions_are_found_wherever_they_stand() {
        let body = "\n".repeat(80);
        let code = format!(
            "fn a() {{{body}}}\nimpl B {{ fn b() {{{body}}} fn c() {{}} }}\n\
             trait D {{ fn d() {{{body}}} }}\n#[cfg(test)] mod tests {{ fn e() {{{body}}} }}"
        );
        let mut sizes = Sizes::default();
        sizes.visit_file(&syn::parse_file(&code).unwrap());
        assert_eq!(sizes.faults.len(), 3, "{:?}", sizes.faults);
    }

    #[test]
    fn long_scripts_are_found_and_long_functions_but_those_of_tests() {
        let body = "    a()\n".repeat(80);
        let long = format!("def f():\n{body}");
        assert_eq!(faults_of_script(&Script::of_test("python/carom/a.py", &long)).len(), 1);
        assert_eq!(faults_of_script(&Script::of_test("python/tests/a.py", &long)).len(), 0);
        let documented = format!("def f():\n    \"\"\"Doc.\n{body}    \"\"\"\n");
        assert_eq!(faults_of_script(&Script::of_test("python/carom/a.py", &documented)).len(), 0);
        let many = "a();\n".repeat(501);
        assert_eq!(faults_of_script(&Script::of_test("web/tests/a.js", &many)).len(), 1);
    }
}
