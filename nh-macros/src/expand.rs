//! The stages in order, and what is emitted when one of them fails.

use std::collections::BTreeSet;

use proc_macro2::TokenStream;
use quote::quote;

use nonholonomic_core::limits::{Subject, about, within_limits};
use nonholonomic_core::violation::{Law, Violation};

use crate::derived_outline::outlined;
use crate::emit::{Layout, collision, emit, stubs};
use crate::report::{Diagnostic, compile_errors};
use crate::resolve::{Outline, Resolved, resolve, told_of_lengths};
use crate::syntax::{self, Malformed};

/// The expansion of the attribute. On error: the errors, and the items that there would have been
/// without them, as far as they are known.
pub(crate) fn nonholonomic(attribute: TokenStream, item: TokenStream) -> TokenStream {
    let mut declaration = match syntax::parse(attribute.clone(), item.clone()) {
        Ok(declaration) => declaration,
        Err(Malformed { errors, rest: Some(rest) }) => {
            // what is wrong besides may follow from these errors: nothing is said of it
            let mut layout = Layout::of_struct(&rest.structure, attribute);
            let model = match resolve(&rest, &mut layout) {
                Ok(resolved) => resolved.model,
                Err(unresolved) => *unresolved.model,
            };
            return with_errors(&errors, &stubs(&layout, &outlined(model)));
        }
        Err(Malformed { errors, rest: None }) => {
            return with_errors(&errors, &syntax::without_own_attributes(item));
        }
    };
    let mut layout = Layout::of_struct(&declaration.structure, attribute);
    let resolved = match resolve(&declaration, &mut layout) {
        Ok(resolved) => resolved,
        Err(unresolved) => {
            let unresolved = told_of_lengths(&mut declaration, unresolved);
            return with_errors(&unresolved.errors, &stubs(&layout, &outlined(*unresolved.model)));
        }
    };
    let declared = resolved.model.clone();
    let Resolved { model, origins } = resolved;
    let derived: Result<Result<TokenStream, Vec<Violation>>, _> = within_limits(|| {
        let system = nonholonomic_core::compile::compile(model)?;
        about(Subject::Code);
        emit(&system, &layout)
    });
    let (errors, outline): (Vec<_>, Outline) = match derived {
        Ok(Ok(items)) => match collision(&items) {
            None => return items,
            // the names would meet again in stubs: the struct stands alone
            Some(error) => return with_errors(&[error], &syntax::without_own_attributes(item)),
        },
        Ok(Err(violations)) => {
            // where a derivation is too large, so is another one
            let is_large = violations.iter().any(|violation| violation.law == Law::Size);
            let outline = if is_large { Outline::of(&declared) } else { outlined(declared) };
            (told_once(violations.into_iter().map(|violation| origins.diagnostic(violation))), outline)
        }
        Err(too_large) => (vec![declaration.too_large(too_large)], Outline::of(&declared)),
    };
    with_errors(&errors, &stubs(&layout, &outline))
}

/// The errors without those that say of another entry what was said of a line already: a line of a `for` is written once.
fn told_once(errors: impl Iterator<Item = Diagnostic>) -> Vec<Diagnostic> {
    let mut told = BTreeSet::new();
    errors.filter(|error| told.insert(error.of_any_entry())).collect()
}

/// Errors, and what stands beside them.
fn with_errors(errors: &[Diagnostic], items: &TokenStream) -> TokenStream {
    let errors = compile_errors(errors);
    quote!(#errors #items)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn expanded(attribute: &str, item: &str) -> String {
        let tokens = nonholonomic(attribute.parse().unwrap(), item.parse().unwrap());
        prettyplease::unparse(&syn::parse2(tokens).unwrap())
    }

    #[test]
    fn the_item_is_emitted_without_our_attributes() {
        let text = expanded(
            "base { x } lagrangian { m / 2 * der(x)^2 }",
            "#[derive(Clone)] struct S { /// mass\n m: f64, #[nh(skip)] tag: u8 }",
        );
        let item = "struct S {\n    /// mass\n    m: f64,\n    tag: u8,\n}\n";
        assert!(text.contains(item), "{text}");
        assert!(text.contains("x_dot: ::core::primitive::f64"), "{text}");
        assert!(!text.contains("compile_error"), "{text}");
    }

    #[test]
    fn every_stage_reports_and_leaves_stubs() {
        for (attribute, error) in [
            ("base { x } lagrangian { m / 2 * der(y)^2 }", "there is no base coordinate `y`"),
            ("base { x } lagrangian { m * x }", "mass matrix"),
        ] {
            let text = expanded(attribute, "struct S { m: f64 }");
            assert!(text.starts_with("::core::compile_error! {"), "{text}");
            assert!(text.contains(error), "{text}");
            assert!(text.contains("struct SState"), "{text}");
        }
    }

    #[test]
    fn a_line_of_a_loop_has_one_error() {
        let text = expanded(
            "base { q[3], x } lagrangian { dot(der(q), der(q)) + der(x)^2 }
             constraints { for i in 0..3 { c: q[i] = 0; } d: x = 0; }",
            "struct S;",
        );
        assert_eq!(text.matches("compile_error!").count(), 2, "{text}");
        assert!(
            text.contains("`c[0]` has no velocities") && text.contains("`d` has no velocities"),
            "{text}"
        );
    }

    #[test]
    fn generated_names_do_not_meet() {
        let plane = "base { x, y } lagrangian { m / 2 * (der(x)^2 + der(y)^2) }";
        for (attribute, error) in [
            (
                format!("{plane} impacts {{ Wall: x >= 0; wall: y >= 0; }}"),
                "two types that are generated are called `SWallImpact`",
            ),
            (
                format!("{plane} impacts {{ a_b: x >= 0; aB: y >= 0; }}"),
                "two types that are generated are called `SABImpact`",
            ),
            (
                "base { q[2], q_0 } holonomic { h: q[0] = q_0; }
                 lagrangian { m / 2 * (der(q[0])^2 + der(q[1])^2 + der(q_0)^2) }"
                    .to_owned(),
                "two fields or variants of `SCoordinate` that are generated are called `q_0`",
            ),
        ] {
            let text = expanded(&attribute, "struct S { m: f64 }");
            assert!(text.contains("compile_error!") && text.contains(error), "{attribute}: {text}");
        }
        let text = expanded(
            "base { q[2], q_0 } lagrangian { m / 2 * (der(q[0])^2 + der(q[1])^2 + der(q_0)^2) }",
            "struct S { m: f64 }",
        );
        assert!(!text.contains("compile_error!"), "{text}");
    }

    #[test]
    fn methods_are_called_by_the_identifiers_of_the_declaration() {
        let text = expanded(
            "base { x } lagrangian { m / 2 * der(x)^2 } forces { x: self.r#loop(der(x)); }
             derivative { r#loop: [self.r#dyn]; } emit { jacobian }",
            "struct S { m: f64 }",
        );
        assert!(text.contains("self.r#loop(state.x_dot)"), "{text}");
        assert!(text.contains("self.r#dyn(state.x_dot)"), "{text}");
    }

    #[test]
    fn errors_come_with_the_item() {
        let text = expanded("base { x } lagrangian { 2x }", "struct S { #[nh(skip)] tag: u8 }");
        assert!(text.starts_with("::core::compile_error! {"), "{text}");
        assert!(text.contains("struct S {\n    tag: u8,\n}\n"), "{text}");
        assert!(text.contains("x_dot: ::core::primitive::f64"), "{text}");
        let text = expanded("base { x }", "enum S { #[nh(skip)] A }");
        assert!(text.ends_with("enum S {\n    A,\n}\n"), "{text}");
    }
}
