//! The functions of a proved map between two systems.

use std::collections::BTreeSet;

use nonholonomic_core::choose::{DEFECT, REFUTED};
use nonholonomic_core::mechanics::Procedure;
use nonholonomic_core::reduction::Reduction;
use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::layout::Layout;
use super::lint::inherited;
use super::literal::beyond;
use super::program::{Body, body};
use super::record::{Field, Record};
use super::setting::Context;
use super::symbols::{Argument, Scope};
use crate::report::Diagnostic;
use crate::syntax::ast::Scalar;
use crate::syntax::map_syntax::MorphismDecl;

/// `impl Reduction<Reduced> for Full`, and the way back.
///
/// # Errors
/// Structs whose scalars or generics do not go together.
pub(crate) fn morphism(
    reduction: &Reduction,
    declaration: &MorphismDecl,
    source: &Layout,
    target: &Layout,
) -> Result<TokenStream, Diagnostic> {
    let (source, target) = one_scalar(declaration, source, target)?;
    let sections: Vec<_> = reduction.source.sections.iter().map(|section| section.symbol).collect();
    // the generated structs are reached through the traits alone
    let visibility = quote!(pub);
    let context = Context { visibility, ..Context::new(&source, &reduction.state, &sections) };
    let target_context = Context::new(&target, &reduction.target_state, &[]);
    let map = Map {
        reduction,
        context: &context,
        target: &target_context,
        types: Types::of(declaration, &source, &target),
    };
    let functions = map.reduction();
    let back = reduction.reconstruction.as_ref().map(|back| map.reconstruction(back));
    if context.lowering.is_refuted() {
        return Err(Diagnostic::new(declaration.extent(), REFUTED).way_out(DEFECT.to_owned()));
    }
    if let Some((what, way_out)) = beyond(&context) {
        return Err(Diagnostic::new(declaration.extent(), what).way_out(way_out.to_owned()));
    }
    // one list has tokens of two declarations, on far lines
    let (of_source, of_target) = (&context.lints, &target_context.lints);
    Ok(quote! {
        #of_source #of_target
        #[allow(non_local_definitions, unused_qualifications, clippy::possible_missing_comma)]
        const _: () = { #functions #back };
    })
}

/// What stands beside errors, so that uses of the reduction are not errors too.
pub(crate) fn morphism_stub(
    declaration: &MorphismDecl,
    source: &Layout,
    target: &Layout,
) -> Option<TokenStream> {
    let (source, target) = one_scalar(declaration, source, target).ok()?;
    let context = Context::new(&source, &[], &[]);
    let Context { runtime, scalar, lints, .. } = &context;
    let types = Types::of(declaration, &source, &target);
    let of_target = inherited(&target.attributes);
    let target = &types.target;
    let dynamics = quote!(#runtime::Dynamics);
    let items = quote! {
        const REPORT: &'static ::core::primitive::str = "";
        fn reduced(&self) -> #target { loop {} }
        fn reduce(&self, _: #scalar, _: &<Self as #dynamics>::State) -> <#target as #dynamics>::State {
            loop {}
        }
        fn reduce_input(
            &self, _: #scalar, _: &<Self as #dynamics>::State, _: &<Self as #dynamics>::Input
        ) -> <#target as #dynamics>::Input {
            loop {}
        }
    };
    let implementation = implement(&context, &types, &quote!(#runtime::Reduction<#target>), &items);
    Some(quote!(#lints #of_target #[allow(unused_qualifications)] const _: () = { #implementation };))
}

/// `impl … for Full`.
pub(super) fn implement(
    context: &Context,
    types: &Types,
    of: &TokenStream,
    items: &TokenStream,
) -> TokenStream {
    let source = &types.source;
    let (impl_generics, _, where_clause) = context.generics.split_for_impl();
    quote! {
        #[automatically_derived]
        impl #impl_generics #of for #source #where_clause { #items }
    }
}

/// The two structs as types, with the scalar that they share.
pub(super) struct Types {
    pub(super) source: TokenStream,
    pub(super) target: TokenStream,
    /// The target as it is constructed.
    pub(super) target_path: TokenStream,
}

impl Types {
    pub(super) fn of(declaration: &MorphismDecl, source: &Layout, target: &Layout) -> Self {
        let (_, source_generics, _) = source.generics.split_for_impl();
        let path = &declaration.source.path;
        let target_path = declaration.target.path.clone();
        let scalar = source.scalar_type();
        let target = if target.generics.params.is_empty() {
            target_path.clone()
        } else {
            quote!(#target_path<#scalar>)
        };
        let source = match (source.generics.params.is_empty(), source.is_fixed) {
            (_, true) => quote!(#path<#scalar>),
            (true, false) => path.clone(),
            (false, false) => quote!(#path #source_generics),
        };
        Self { source, target, target_path }
    }
}

/// The layouts with one scalar: a parameter meets a type by becoming it.
pub(super) fn one_scalar(
    declaration: &MorphismDecl,
    source: &Layout,
    target: &Layout,
) -> Result<(Layout, Layout), Diagnostic> {
    let (mut source, target) = (source.clone(), target.clone());
    let refused =
        |what: String, way_out: &str| Err(Diagnostic::new(declaration.extent(), what).way_out(way_out));
    if target.generics.params.len() > 1 || (target.generics.params.len() == 1 && !is_generic(&target)) {
        return refused(
            format!("`{}` has generics beside its scalar", declaration.target.name),
            "map to a struct with no other generics than its scalar",
        );
    }
    if target.skipped > 0 {
        return refused(
            format!(
                "`{}` has a field that is no parameter, so that it cannot be made of parameters",
                declaration.target.name
            ),
            "map to a struct without `#[nh(skip)]`",
        );
    }
    match (&source.scalar, &target.scalar) {
        (Scalar::Parameter(_), Scalar::F64 | Scalar::F32) if source.generics.params.len() == 1 => {
            source.scalar = target.scalar.clone();
            source.generics = syn::Generics::default();
            source.is_fixed = true;
        }
        (Scalar::F64, Scalar::F32)
        | (Scalar::F32, Scalar::F64)
        | (Scalar::Parameter(_), Scalar::F64 | Scalar::F32) => {
            return refused(
                format!(
                    "`{}` and `{}` have different scalars",
                    declaration.source.name, declaration.target.name
                ),
                "use the same scalar type in both, or a type parameter",
            );
        }
        _ => {}
    }
    Ok((source, target))
}

fn is_generic(layout: &Layout) -> bool {
    matches!(layout.scalar, Scalar::Parameter(_))
}

/// What the functions are made of.
pub(super) struct Map<'a> {
    pub(super) reduction: &'a Reduction,
    pub(super) context: &'a Context<'a>,
    pub(super) target: &'a Context<'a>,
    pub(super) types: Types,
}

impl Map<'_> {
    pub(super) fn body(&self, scope: &Scope, procedure: &Procedure) -> Body {
        body(self.context, scope, &self.context.lowering.program(&self.reduction.source, procedure))
    }

    pub(super) fn implement(&self, of: &TokenStream, items: &TokenStream) -> TokenStream {
        implement(self.context, &self.types, of, items)
    }

    /// `impl Reduction`.
    fn reduction(&self) -> TokenStream {
        let Context { runtime, scalar, .. } = self.context;
        let (t, state, input) =
            (&self.context.locals.t, &self.context.locals.state, &self.context.locals.input);
        let model = &self.reduction.source;
        let scope = &Scope::new(self.context, model, &self.reduction.state);
        let (target, report) = (&self.types.target, &self.reduction.report);
        let dynamics = quote!(#runtime::Dynamics);
        let of_target = quote!(<#target as #dynamics>);
        // 1. parameters
        let parameters = self.body(scope, &self.reduction.parameters);
        let record = Record {
            name: self.target.state.name.clone(),
            doc: String::new(),
            fields: self
                .target
                .layout
                .parameters
                .iter()
                .map(|family| Field::of(family, "parameter"))
                .collect(),
        };
        let path = &self.types.target_path;
        let made = record.construct(path, &parameters.outputs);
        let (drop_self, statements) =
            (dropped(&parameters.used, &[(Argument::This, quote!(self))]), &parameters.statements);
        let reduced = quote! {
            fn reduced(&self) -> #target { #drop_self #statements #made }
        };
        // 2. the state
        let arguments =
            [(Argument::This, quote!(self)), (Argument::Time, quote!(#t)), (Argument::State, quote!(#state))];
        let map = self.body(scope, &self.reduction.reduced);
        let (drops, statements, outputs) = (dropped(&map.used, &arguments), &map.statements, &map.outputs);
        let reduce = quote! {
            #[inline]
            fn reduce(&self, #t: #scalar, #state: &<Self as #dynamics>::State) -> #of_target::State {
                #drops #statements
                #runtime::State::from_array([#(#outputs),*])
            }
        };
        // 3. the inputs
        let map = self.body(scope, &self.reduction.inputs);
        let (statements, outputs) = (&map.statements, &map.outputs);
        let all = [arguments.as_slice(), &[(Argument::Input, quote!(#input))]].concat();
        let drops = dropped(&map.used, &all);
        let made = if self.target.layout.inputs.is_empty() {
            TokenStream::new()
        } else {
            let length = Literal::usize_unsuffixed(outputs.len());
            quote!(<#of_target::Input as ::core::convert::From<[#scalar; #length]>>::from([#(#outputs),*]))
        };
        let reduce_input = quote! {
            #[inline]
            fn reduce_input(
                &self, #t: #scalar, #state: &<Self as #dynamics>::State, #input: &<Self as #dynamics>::Input
            ) -> #of_target::Input {
                #drops #statements #made
            }
        };
        self.implement(
            &quote!(#runtime::Reduction<#target>),
            &quote! {
                const REPORT: &'static ::core::primitive::str = #report;
                #reduced #reduce #reduce_input
            },
        )
    }
}

/// `_ = t;` for every argument that is not used.
pub(super) fn dropped(used: &BTreeSet<Argument>, arguments: &[(Argument, TokenStream)]) -> TokenStream {
    let unused = arguments.iter().filter(|(argument, _)| !used.contains(argument));
    unused.map(|(_, place)| quote!(_ = #place;)).collect()
}
