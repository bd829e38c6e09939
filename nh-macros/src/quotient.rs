//! `quotient!`: the declaration of the full system is fetched, that of its quotient derived.

use nonholonomic_core::limits::within_limits;
use nonholonomic_core::reduction::{Refusal, quotient as derive};
use proc_macro2::{TokenStream, TokenTree};
use quote::quote;

use crate::emit::{self, Layout, Written, alias};
use crate::report::{Diagnostic, compile_errors};
use crate::resolve::{Unrelated, resolve_quotient};
use crate::syntax::ast::Scalar;
use crate::syntax::map_syntax::handed_over;
use crate::syntax::quotient_syntax::{QuotientDecl, quotient as parse};
use crate::syntax::{self};

/// The expansion of the macro, in each of its two calls.
pub(crate) fn quotient(input: TokenStream) -> TokenStream {
    let mut tokens: Vec<TokenTree> = input.into_iter().collect();
    let full = handed_over(&mut tokens);
    let written: TokenStream = tokens.into_iter().collect();
    let declaration = match parse(written.clone()) {
        Ok(declaration) => declaration,
        Err(errors) => return compile_errors(&errors),
    };
    let runtime = declaration.runtime.as_ref().map_or_else(|| quote!(::nonholonomic), |s| s.body.clone());
    let Some((attribute, item)) = full else {
        let mut name = alias(&declaration.source.name.to_string().replace("r#", ""));
        name.set_span(declaration.source.name.span());
        let hand_on = declaration.source.beside(&name);
        return quote!(#hand_on! { #runtime::__private::quotient, { #written } });
    };
    match derived(&declaration, &attribute, item, runtime) {
        Ok(items) => items,
        // as is said where the full system is declared
        Err(Unrelated::IllPosed) => TokenStream::new(),
        Err(Unrelated::Errors(errors)) => compile_errors(&errors),
    }
}

/// The derived declaration and the map to it.
fn derived(
    declaration: &QuotientDecl,
    attribute: &TokenStream,
    item: TokenStream,
    runtime: TokenStream,
) -> Result<TokenStream, Unrelated> {
    let full = syntax::parse(attribute.clone(), item).map_err(|_| Unrelated::IllPosed)?;
    let mut layout = Layout::of_struct(&full.structure, attribute.clone());
    let generics = layout.generics.params.len();
    if generics > usize::from(matches!(layout.scalar, Scalar::Parameter(_))) {
        let what = format!("`{}` has generics beside its scalar", declaration.source.name);
        let error =
            Diagnostic::new(declaration.extent, what).way_out("declare both systems, and use `morphism!`");
        return Err(Unrelated::Errors(vec![error]));
    }
    let resolved = resolve_quotient(declaration, &full, &mut layout)?;
    let origins = resolved.origins;
    let quotient = match within_limits(|| derive(resolved.source, &resolved.declared)) {
        Ok(Ok(quotient)) => quotient,
        Ok(Err(Refusal::IllPosed)) => return Err(Unrelated::IllPosed),
        Ok(Err(Refusal::Broken(violations))) => {
            let errors = violations.into_iter().map(|violation| origins.diagnostic(violation));
            return Err(Unrelated::Errors(errors.collect()));
        }
        Err(too_large) => {
            return Err(Unrelated::Errors(vec![declaration.extent.too_large(too_large)]));
        }
    };
    if !emit::can_be_written(&quotient) {
        let error =
            Diagnostic::new(declaration.extent, "the quotient is too long to be written as a declaration")
                .evidence("it is written without `let`, each expression in full".to_owned())
                .way_out("declare both systems, and use `morphism!`");
        return Err(Unrelated::Errors(vec![error]));
    }
    Ok(emit::quotient(&Written {
        quotient: &quotient,
        declaration,
        layout: &layout,
        coordinates: &resolved.coordinates,
        renamed: &resolved.declared.renamed,
        velocities: resolved.velocities.as_deref(),
        runtime,
    }))
}
