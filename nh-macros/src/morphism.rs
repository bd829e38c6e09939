//! `morphism!`: the two declarations are fetched one after the other, then the map is proved.
//!
//! A macro sees only its own tokens. Beside every declared struct stands a macro that hands the
//! declaration to another one: `morphism!` calls that of the source and is called back with its
//! declaration, calls that of the target likewise, and has everything in the third call.

use nonholonomic_core::limits::within_limits;
use nonholonomic_core::reduction::{Refusal, Related, reduce};
use proc_macro2::{TokenStream, TokenTree};
use quote::quote;

use crate::emit::{self, Layout, alias};
use crate::report::compile_errors;
use crate::resolve::{Unrelated, resolve_morphism};
use crate::syntax::map_syntax::{MorphismDecl, SystemPath, handed_over, morphism as parse};
use crate::syntax::{self};

/// The expansion of the macro, in each of its three calls.
pub(crate) fn morphism(input: TokenStream) -> TokenStream {
    let mut tokens: Vec<TokenTree> = input.into_iter().collect();
    let mut declarations = Vec::new();
    while let Some(declaration) = handed_over(&mut tokens) {
        declarations.push(declaration);
    }
    let map: TokenStream = tokens.into_iter().collect();
    let declaration = match parse(map.clone()) {
        Ok(declaration) => declaration,
        Err(errors) => return compile_errors(&errors),
    };
    match declarations.as_slice() {
        [] => fetch(&declaration, &declaration.source, &[], &map),
        [source] => fetch(&declaration, &declaration.target, std::slice::from_ref(source), &map),
        // the one fetched last comes first
        [target, source, ..] => prove(&declaration, source, target),
    }
}

/// Calls the macro that hands a declaration on.
fn fetch(
    declaration: &MorphismDecl,
    system: &SystemPath,
    known: &[(TokenStream, TokenStream)],
    map: &TokenStream,
) -> TokenStream {
    let mut name = alias(&system.name.to_string().replace("r#", ""));
    name.set_span(system.name.span());
    let hand_on = system.beside(&name);
    let runtime = runtime(declaration);
    let known = known.iter().map(|(attribute, item)| quote!(declaration { { #attribute } { #item } }));
    quote! {
        #hand_on! { #runtime::__private::morphism, { #(#known)* #map } }
    }
}

/// The path of the runtime.
fn runtime(declaration: &MorphismDecl) -> TokenStream {
    declaration.runtime.as_ref().map_or_else(|| quote!(::nonholonomic), |section| section.body.clone())
}

/// The map with both declarations. What is wrong with a declaration is reported where it stands, so
/// that nothing is said of it here.
fn prove(
    declaration: &MorphismDecl,
    (source_attribute, source_item): &(TokenStream, TokenStream),
    (target_attribute, target_item): &(TokenStream, TokenStream),
) -> TokenStream {
    let read = |attribute: &TokenStream, item: &TokenStream| {
        let declared = syntax::parse(attribute.clone(), item.clone()).ok()?;
        let layout = Layout::of_struct(&declared.structure, attribute.clone());
        Some((declared, layout))
    };
    let source = read(source_attribute, source_item);
    let (Some((source, mut source_layout)), Some((target, mut target_layout))) =
        (source, read(target_attribute, target_item))
    else {
        return TokenStream::new();
    };
    let resolved =
        resolve_morphism(declaration, (&source, &mut source_layout), (&target, &mut target_layout));
    source_layout.runtime = runtime(declaration);
    let proved = resolved.and_then(|resolved| {
        let origins = resolved.origins;
        let derived = within_limits(|| {
            let related = reduce(resolved.source, resolved.target, &resolved.declared)?;
            Ok(match related {
                Related::Reduction(reduction) => {
                    emit::morphism(&reduction, declaration, &source_layout, &target_layout)
                }
                Related::Inclusion(inclusion) => {
                    emit::inclusion(&inclusion, declaration, &source_layout, &target_layout)
                }
            })
        });
        match derived {
            Ok(Ok(written)) => written.map_err(|error| Unrelated::Errors(vec![error])),
            Ok(Err(Refusal::IllPosed)) => Err(Unrelated::IllPosed),
            Ok(Err(Refusal::Broken(violations))) => {
                let errors = violations.into_iter().map(|violation| origins.diagnostic(violation));
                Err(Unrelated::Errors(errors.collect()))
            }
            Err(too_large) => Err(Unrelated::Errors(vec![declaration.extent().too_large(too_large)])),
        }
    });
    let errors = match proved {
        Ok(items) => return items,
        Err(Unrelated::IllPosed) => TokenStream::new(),
        Err(Unrelated::Errors(errors)) => compile_errors(&errors),
    };
    let stub = emit::morphism_stub(declaration, &source_layout, &target_layout);
    quote!(#errors #stub)
}
