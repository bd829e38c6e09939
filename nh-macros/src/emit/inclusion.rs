//! The functions of a proved inclusion of a mode.

use nonholonomic_core::choose::{DEFECT, REFUTED};
use nonholonomic_core::id::SymbolId;
use nonholonomic_core::reduction::Inclusion;
use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::layout::{Layout, local};
use super::map_functions::{Types, dropped, implement, one_scalar};
use super::program::body;
use super::record::{Field, Record};
use super::setting::Context;
use super::symbols::{Argument, Scope};
use crate::report::Diagnostic;
use crate::syntax::map_syntax::MorphismDecl;

/// `impl Inclusion<Flying> for Rolling`.
///
/// # Errors
/// Structs whose scalars or generics do not go together.
pub(crate) fn inclusion(
    inclusion: &Inclusion,
    declaration: &MorphismDecl,
    source: &Layout,
    target: &Layout,
) -> Result<TokenStream, Diagnostic> {
    let (source, target) = one_scalar(declaration, source, target)?;
    let sections: Vec<_> = inclusion.source.sections.iter().map(|section| section.symbol).collect();
    let visibility = quote!(pub);
    let context = Context { visibility, ..Context::new(&source, &inclusion.state, &sections) };
    let target_context = Context::new(&target, &inclusion.target_state, &[]);
    let types = Types::of(declaration, &source, &target);
    let functions = functions(inclusion, &context, &target_context, &types);
    if context.lowering.is_refuted() {
        return Err(Diagnostic::new(declaration.extent(), REFUTED).way_out(DEFECT.to_owned()));
    }
    let (of_source, of_target) = (&context.lints, &target_context.lints);
    Ok(quote! {
        #of_source #of_target
        #[allow(non_local_definitions, unused_qualifications, clippy::possible_missing_comma)]
        const _: () = { #functions };
    })
}

fn functions(inclusion: &Inclusion, context: &Context, target: &Context, types: &Types) -> TokenStream {
    let Context { runtime, scalar, .. } = context;
    let (t, state) = (&context.locals.t, &context.locals.state);
    let model = &inclusion.source;
    let scope = &Scope::new(context, model, &inclusion.state);
    let run = |procedure| body(context, scope, &context.lowering.program(model, procedure));
    let (whole_type, report) = (&types.target, &inclusion.report);
    let dynamics = quote!(#runtime::Dynamics);
    // 1. parameters
    let parameters = run(&inclusion.parameters);
    let record = Record {
        name: target.state.name.clone(),
        doc: String::new(),
        fields: target.layout.parameters.iter().map(|family| Field::of(family, "parameter")).collect(),
    };
    let made = record.construct(&types.target_path, &parameters.outputs);
    let (drop_self, statements) =
        (dropped(&parameters.used, &[(Argument::This, quote!(self))]), &parameters.statements);
    let whole = quote!(fn whole(&self) -> #whole_type { #drop_self #statements #made });
    // 2. the state of the target
    let map = run(&inclusion.included);
    let arguments =
        [(Argument::This, quote!(self)), (Argument::Time, quote!(#t)), (Argument::State, quote!(#state))];
    let (drops, statements, outputs) = (dropped(&map.used, &arguments), &map.statements, &map.outputs);
    let include = quote! {
        #[inline]
        fn include(
            &self, #t: #scalar, #state: &<Self as #dynamics>::State
        ) -> <#whole_type as #dynamics>::State {
            #drops #statements
            #runtime::State::from_array([#(#outputs),*])
        }
    };
    // 3. and back
    let (all, own) = (local("all"), local("own"));
    let places = inclusion.places.iter().map(|place| Literal::usize_unsuffixed(*place));
    let count_of = |known: &[SymbolId]| inclusion.target_state.iter().filter(|s| known.contains(s)).count();
    let coordinates = count_of(&target.layout.coordinate_symbols);
    let others = coordinates + count_of(&target.layout.auxiliary_symbols);
    let velocities = inclusion.target_state.len().saturating_sub(others);
    let [coordinates, velocities] = [coordinates, velocities].map(Literal::usize_unsuffixed);
    let bound = context.parameter().map(|parameter| quote!(where #parameter: #runtime::Real));
    let returned = inclusion.has_equations.then(|| quote!(let #own = #runtime::returned(self, #t, #own);));
    let restrict = quote! {
        fn restrict(
            &self, #t: #scalar, #state: &<#whole_type as #dynamics>::State
        ) -> ::core::result::Result<
            <Self as #dynamics>::State, #runtime::NotInMode<<#whole_type as #dynamics>::State>
        > #bound {
            let #all = #runtime::State::to_array(#state);
            let #own = <<Self as #dynamics>::State as #runtime::State>::from_array([#(#all[#places]),*]);
            #returned
            let #all = <Self as #runtime::Inclusion<#whole_type>>::include(self, #t, &#own);
            #runtime::restricted(#own, &#all, #state, [#coordinates, #velocities])
        }
    };
    implement(
        context,
        types,
        &quote!(#runtime::Inclusion<#whole_type>),
        &quote! {
            const REPORT: &'static ::core::primitive::str = #report;
            #whole #include #restrict
        },
    )
}
