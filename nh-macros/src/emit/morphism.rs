//! The functions of a proved map between two systems.

use std::collections::BTreeSet;

use nh_core::mechanics::Procedure;
use nh_core::reduction::{Reconstruction, Reduction};
use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::context::Context;
use super::function::program;
use super::layout::{Layout, local};
use super::program::{Body, body};
use super::record::{Field, Record};
use super::scope::{Argument, Scope};
use crate::report::Diagnostic;
use crate::syntax::ast::Scalar;
use crate::syntax::morphism::MorphismDecl;

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
    let context = Context::new(&source, &reduction.state, &sections);
    let target_context = Context::new(&target, &reduction.target_state, &[]);
    let map = Map {
        reduction,
        context: &context,
        target: &target_context,
        types: Types::of(declaration, &source, &target),
    };
    let functions = map.reduction();
    let back = reduction.reconstruction.as_ref().map(|back| map.reconstruction(back));
    Ok(quote! {
        #[allow(non_local_definitions)]
        const _: () = { #functions #back };
    })
}

/// The two structs as types, with the scalar that they share.
struct Types {
    source: TokenStream,
    target: TokenStream,
    /// The target as it is constructed.
    target_path: TokenStream,
}

impl Types {
    fn of(declaration: &MorphismDecl, source: &Layout, target: &Layout) -> Self {
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
fn one_scalar(
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
struct Map<'a> {
    reduction: &'a Reduction,
    context: &'a Context<'a>,
    target: &'a Context<'a>,
    types: Types,
}

impl Map<'_> {
    fn body(&self, scope: &Scope, procedure: &Procedure) -> Body {
        body(self.context, scope, &program(&self.reduction.source, procedure))
    }

    fn implement(&self, of: &TokenStream, items: &TokenStream) -> TokenStream {
        let source = &self.types.source;
        let (impl_generics, _, where_clause) = self.context.generics.split_for_impl();
        quote! {
            #[automatically_derived]
            impl #impl_generics #of for #source #where_clause { #items }
        }
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

    /// The dropped coordinates as a struct, the joint state, and `impl Reconstruction`.
    fn reconstruction(&self, back: &Reconstruction) -> TokenStream {
        let Context { runtime, scalar, .. } = self.context;
        let (t, state) = (&self.context.locals.t, &self.context.locals.state);
        let (target, joint) = (&self.types.target, local("joint"));
        let dynamics = quote!(#runtime::Dynamics);
        let group = self.group(back);
        let group_type = self.context.type_of(&group);
        let group_record = group.emit(self.context);
        let joint_type = self.joint(&group);
        let (joint_struct, joint_type) = joint_type;
        let model = &self.reduction.source;
        let in_state = Scope::new(self.context, model, &self.reduction.state);
        let in_joint = Scope::new(self.context, model, &[])
            .with_places(Argument::State, &back.reduced, self.target.state.places(&quote!(#joint.reduced)))
            .with_places(Argument::State, &back.dropped, group.places(&quote!(#joint.group)));
        let made = |outputs: &[TokenStream]| {
            let length = Literal::usize_unsuffixed(outputs.len());
            quote!(<#group_type as ::core::convert::From<[#scalar; #length]>>::from([#(#outputs),*]))
        };
        // the dropped coordinates are in the state as they are
        let places: Vec<TokenStream> = back
            .dropped
            .iter()
            .filter_map(|symbol| in_state.place(*symbol))
            .map(|(_, place)| place.clone())
            .collect();
        let group_of_state = made(&places);
        let arguments =
            [(Argument::This, quote!(self)), (Argument::Time, quote!(#t)), (Argument::State, quote!(#joint))];
        let rates = self.body(&in_joint, &back.rates);
        let (drop_rates, rate_statements, rates) =
            (dropped(&rates.used, &arguments), &rates.statements, made(&rates.outputs));
        let full = self.body(&in_joint, &back.state);
        let (drop_full, full_statements, full) =
            (dropped(&full.used, &arguments), &full.statements, &full.outputs);
        let reduced_rate = local("reduced_rate");
        let implementation = self.implement(
            &quote!(#runtime::Reconstruction<#target>),
            &quote! {
                type Joint = #joint_type;
                fn join(&self, #t: #scalar, #state: &<Self as #dynamics>::State) -> #joint_type {
                    Joint {
                        reduced: <Self as #runtime::Reduction<#target>>::reduce(self, #t, #state),
                        group: #group_of_state,
                    }
                }
                #[inline]
                fn reduced_part(#joint: &#joint_type) -> <#target as #dynamics>::State {
                    #joint.reduced
                }
                #[inline]
                fn joint_rate(
                    &self, #t: #scalar, #joint: &#joint_type, #reduced_rate: &<#target as #dynamics>::State
                ) -> #joint_type {
                    #drop_rates #rate_statements
                    Joint { reduced: *#reduced_rate, group: #rates }
                }
                fn reconstruct(&self, #t: #scalar, #joint: &#joint_type) -> <Self as #dynamics>::State {
                    #drop_full #full_statements
                    #runtime::State::from_array([#(#full),*])
                }
            },
        );
        quote!(#group_record #joint_struct #implementation)
    }

    /// The struct of the dropped coordinates.
    fn group(&self, back: &Reconstruction) -> Record {
        let layout = self.context.layout;
        let all = Context::new(layout, &back.dropped, &[]);
        Record {
            name: quote::format_ident!("Group"),
            doc: "The coordinates that the reduction drops.".into(),
            fields: all.state.fields,
        }
    }

    /// The joint state, and its type.
    fn joint(&self, group: &Record) -> (TokenStream, TokenStream) {
        let Context { runtime, scalar, .. } = self.context;
        let target = &self.types.target;
        let (impl_generics, generics) =
            (self.context.record_impl_generics(), self.context.parameter().map(|p| quote!(<#p>)));
        let group_type = self.context.type_of(group);
        let reduced = quote!(<#target as #runtime::Dynamics>::State);
        let (first, second) = (self.target.state.len(), group.len());
        let length = Literal::usize_unsuffixed(first + second);
        let [n, m] = [first, second].map(Literal::usize_unsuffixed);
        let indices = |count: usize| (0..count).map(Literal::usize_unsuffixed).collect::<Vec<_>>();
        let (of_reduced, of_group) = (indices(first), indices(second));
        let (r, g, names) = (local("reduced"), local("group"), group.names());
        let components: Vec<_> = (0..first + second).map(|index| local(&format!("c{index}"))).collect();
        let (front, rest) = components.split_at(first);
        let (unused_r, unused_g) =
            ((first == 0).then(|| quote!(_ = #r;)), (second == 0).then(|| quote!(_ = #g;)));
        let tokens = quote! {
            /// The reduced state, and the coordinates that the reduction drops.
            #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug)]
            pub struct Joint #impl_generics {
                /// The reduced state.
                pub reduced: #reduced,
                /// The dropped coordinates.
                pub group: #group_type,
            }
            #[automatically_derived]
            impl #impl_generics #runtime::State for Joint #generics {
                type Scalar = #scalar;
                type Dim = #runtime::D<#length>;
                fn to_array(&self) -> [#scalar; #length] {
                    let #r: [#scalar; #n] = #runtime::State::to_array(&self.reduced);
                    let #g: [#scalar; #m] = ::core::convert::From::from(self.group);
                    #unused_r #unused_g
                    [#(#r[#of_reduced],)* #(#g[#of_group],)*]
                }
                fn from_array([#(#components),*]: [#scalar; #length]) -> Self {
                    Self {
                        reduced: #runtime::State::from_array([#(#front),*]),
                        group: ::core::convert::From::<[#scalar; #m]>::from([#(#rest),*]),
                    }
                }
                fn names() -> [&'static ::core::primitive::str; #length] {
                    let #r: [&'static ::core::primitive::str; #n] = <#reduced as #runtime::State>::names();
                    #unused_r
                    [#(#r[#of_reduced],)* #(#names),*]
                }
            }
        };
        (tokens, quote!(Joint #generics))
    }
}

/// `_ = t;` for every argument that is not used.
fn dropped(used: &BTreeSet<Argument>, arguments: &[(Argument, TokenStream)]) -> TokenStream {
    let unused = arguments.iter().filter(|(argument, _)| !used.contains(argument));
    unused.map(|(_, place)| quote!(_ = #place;)).collect()
}
