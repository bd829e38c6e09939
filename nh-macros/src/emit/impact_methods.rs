//! Impacts: `impact_floor`, `event_floor`, the impulses, and what the runtime asks of an impact.

use nonholonomic_core::id::SymbolId;
use nonholonomic_core::mechanics::Procedure;
use nonholonomic_core::system::{ImpactForm, System};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use super::infix::element;
use super::inherent_method::Part;
use super::layout::{Family, local};
use super::program::body;
use super::record::{Field, Record};
use super::setting::Context;
use super::symbols::{Argument, Scope, parameter_places};
use crate::resolve::OutlinedImpact;

/// What is generated for each impact; nothing without them.
pub(super) fn emit(context: &Context, scope: &Scope, system: &System) -> Part {
    let outlines: Vec<OutlinedImpact> = system.impacts.iter().map(OutlinedImpact::from).collect();
    let Some(record) = impulses(context, &outlines) else { return Part::default() };
    let mut part = Part { items: record.emit(context), ..Part::default() };
    for (impact, outline) in system.impacts.iter().zip(&outlines) {
        let jump = context.lowering.program(&system.model, &impact.jump);
        part.programs.push(("impact", jump));
        part.methods.extend(jump_method(context, &record, outline, &strike(context, &record, outline)));
        if outline.positions > 0 {
            part.methods.extend(event_method(context, outline, &gaps(context, scope, system, impact)));
        }
        part.items.extend(implementation(context, system, impact, outline));
    }
    part
}

/// The same for a declaration in error, where nothing jumps.
pub(super) fn stub(context: &Context, outlines: &[OutlinedImpact]) -> Part {
    let Some(record) = impulses(context, outlines) else { return Part::default() };
    let mut part = Part { items: record.emit(context), ..Part::default() };
    let (runtime, scalar) = (&context.runtime, &context.scalar);
    let (t, state) = (&context.locals.t, &context.locals.state);
    let zero = quote!(<#scalar as #runtime::Scalar>::ZERO);
    for outline in outlines {
        let same = quote! {
            _ = (self, #t);
            ::core::result::Result::Ok((*#state, ::core::default::Default::default()))
        };
        part.methods.extend(jump_method(context, &record, outline, &same));
        if outline.positions > 0 {
            let count = Literal::usize_unsuffixed(outline.positions);
            let gaps = if outline.positions == 1 { zero.clone() } else { quote!([#zero; #count]) };
            part.methods.extend(event_method(context, outline, &quote!(_ = (self, #t, #state); #gaps)));
        }
    }
    part
}

impl From<&ImpactForm> for OutlinedImpact {
    fn from(impact: &ImpactForm) -> Self {
        let positions = impact.places.iter().flatten().count();
        Self { label: impact.label.clone(), rows: impact.names.len(), positions }
    }
}

/// The impulses of all impacts, by label.
fn impulses(context: &Context, outlines: &[OutlinedImpact]) -> Option<Record> {
    let layout = context.layout;
    let fields = outlines.iter().map(|outline| {
        let count = u32::try_from(outline.rows).unwrap_or(u32::MAX);
        let ident = syn::parse_str(&outline.label).unwrap_or_else(|_| format_ident!("r#{}", outline.label));
        let lengths = if outline.rows == 1 { Vec::new() } else { vec![count] };
        let family = Family { ident, lengths, docs: TokenStream::new(), units: Vec::new() };
        let rows = if outline.rows == 1 { "" } else { ", row by row" };
        Field::of(&family, "").described(&format!(" The impulse of `{}`{rows}.", outline.label))
    });
    let fields: Vec<Field> = fields.collect();
    (!fields.is_empty()).then(|| Record {
        name: layout.types.impulses.clone(),
        doc: format!("The impulses of the impacts of [`{}`]; 0 for those that did not happen.", layout.name),
        fields,
    })
}

/// `SleighFloorImpact`
fn type_name(context: &Context, label: &str) -> Ident {
    let words = label.split('_').map(|word| {
        let mut letters = word.chars();
        letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
    });
    format_ident!("{}{}Impact", context.layout.name, words.collect::<String>())
}

/// `impact_floor`.
fn jump_method(
    context: &Context,
    record: &Record,
    outline: &OutlinedImpact,
    body: &TokenStream,
) -> TokenStream {
    let Context { runtime, visibility, scalar, .. } = context;
    let (t, state, state_type) = (&context.locals.t, &context.locals.state, context.type_of(&context.state));
    let name = format_ident!("impact_{}", outline.label);
    let impulses = context.type_of(record);
    let doc = format!(" The state after the impact `{}`, and its impulses.", outline.label);
    let bound = context.parameter().map(|parameter| quote!(where #parameter: #runtime::Real));
    quote! {
        #[doc = #doc]
        ///
        /// A gap is closed where it is not above 0 by more than rounding. A state in which all gaps are open, or
        /// separate, comes back unchanged with zero impulses.
        ///
        /// # Errors
        /// If rows are dependent at the state, the coefficient of restitution is outside 0 … 1, or closed rows do not
        /// come to an end: with the row, by name.
        #visibility fn #name(
            &self, #t: #scalar, #state: &#state_type
        ) -> ::core::result::Result<(#state_type, #impulses), #runtime::impacts::ImpactError> #bound { #body }
    }
}

/// The body of `impact_floor`.
fn strike(context: &Context, record: &Record, outline: &OutlinedImpact) -> TokenStream {
    let Context { runtime, scalar, .. } = context;
    let (t, state, struck) = (&context.locals.t, &context.locals.state, local("struck"));
    let impact = type_name(context, &outline.label);
    let zero = quote!(<#scalar as #runtime::Scalar>::ZERO);
    let names: Vec<Ident> = (0..outline.rows).map(|row| local(&format!("mu{row}"))).collect();
    let mut components = Vec::new();
    for field in &record.fields {
        if super::layout::plain(&field.ident) == outline.label {
            components.extend(names.iter().map(|name| quote!(#name)));
        } else {
            components.extend(std::iter::repeat_n(zero.clone(), field.len()));
        }
    }
    let name = &record.name;
    let impulses = record.construct(&quote!(#name), &components);
    quote! {
        let #struck = #runtime::impacts::strike(self, &#impact, #t, #state, #zero)?;
        let [#(#names),*] = #struck.impulses;
        ::core::result::Result::Ok((#struck.after, #impulses))
    }
}

/// `event_floor`.
fn event_method(context: &Context, outline: &OutlinedImpact, body: &TokenStream) -> TokenStream {
    let Context { visibility, scalar, .. } = context;
    let (t, state, state_type) = (&context.locals.t, &context.locals.state, context.type_of(&context.state));
    let name = format_ident!("event_{}", outline.label);
    let count = Literal::usize_unsuffixed(outline.positions);
    let result = if outline.positions == 1 { quote!(#scalar) } else { quote!([#scalar; #count]) };
    let what = if outline.positions == 1 { "gap" } else { "gaps" };
    let doc =
        format!(" The {what} of the impact `{}`, for events in the direction `Closing`.", outline.label);
    quote! {
        #[doc = #doc]
        #[must_use]
        #[inline]
        #visibility fn #name(&self, #t: #scalar, #state: &#state_type) -> #result { #body }
    }
}

/// The body of `event_floor`.
fn gaps(context: &Context, scope: &Scope, system: &System, impact: &ImpactForm) -> TokenStream {
    let (t, state) = (&context.locals.t, &context.locals.state);
    let body = body(context, scope, &context.lowering.program(&system.model, &impact.gaps));
    let statements = &body.statements;
    let value = match body.outputs.as_slice() {
        [only] => only.clone(),
        several => {
            let several = several.iter().map(element);
            quote!([#(#several),*])
        }
    };
    let this = (!body.used.contains(&Argument::This)).then(|| quote!(_ = self;));
    quote!(#this _ = (#t, #state); #statements #value)
}

/// The type of the impact, and what the runtime asks of it.
fn implementation(
    context: &Context,
    system: &System,
    impact: &ImpactForm,
    outline: &OutlinedImpact,
) -> TokenStream {
    let Context { runtime, visibility, scalar, lints, layout, .. } = context;
    let (t, state, state_type) = (&context.locals.t, &context.locals.state, context.type_of(&context.state));
    let this = local("system");
    let name = type_name(context, &outline.label);
    let doc = format!(
        " The impact `{}` of [`{}`], for [`advance_with_impacts`]({}::impacts::advance_with_impacts).",
        outline.label,
        layout.name,
        layout.runtime.to_string().replace(' ', "").trim_start_matches("::"),
    );
    let rows = Literal::usize_unsuffixed(outline.rows);
    let names = &impact.names;
    let of_system = &scope_of(context, system, &this);
    let run =
        |procedure: &Procedure| body(context, of_system, &context.lowering.program(&system.model, procedure));
    let restitution = run(&impact.restitution);
    let (e_statements, e) = (&restitution.statements, &restitution.outputs);
    let bounces = impact.places.iter().map(Option::is_some);
    let is_homogeneous = impact.is_homogeneous;
    let (gaps, sizes) =
        (closed(context, impact, outline, &this), sizes(context, impact, &run(&impact.terms)));
    let jump = run(&impact.jump);
    let (statements, outputs) = (&jump.statements, jump.outputs.iter().map(element).collect::<Vec<_>>());
    let width = system.state_velocities.len();
    let (approach, rest) = outputs.split_at(outline.rows.min(outputs.len()));
    let (responses, mobility) = rest.split_at((outline.rows * width).min(rest.len()));
    let zero = quote!(<#scalar as #runtime::Scalar>::ZERO);
    let before = std::iter::repeat_n(zero.clone(), system.state_coordinates.len());
    let after = std::iter::repeat_n(zero, system.state_auxiliary.len());
    let responses = responses.chunks(width.max(1)).map(|row| {
        let entries = before.clone().chain(row.iter().cloned()).chain(after.clone());
        quote!([#(#entries),*])
    });
    let mobility = mobility.chunks(outline.rows.max(1)).map(|row| quote!([#(#row),*]));
    let (impl_generics, ty_generics, where_clause) = context.generics.split_for_impl();
    let system_type = &layout.name;
    quote! {
        #[doc = #doc]
        #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug, ::core::default::Default)]
        #lints
        #visibility struct #name;

        #lints
        #[automatically_derived]
        impl #impl_generics #runtime::impacts::Impact<#system_type #ty_generics, #rows> for #name #where_clause {
            fn names(&self) -> [&'static ::core::primitive::str; #rows] { [#(#names),*] }
            fn restitution(&self, #this: &#system_type #ty_generics) -> #scalar {
                _ = #this;
                #e_statements
                #(#e)*
            }
            fn bounces(&self) -> [::core::primitive::bool; #rows] { [#(#bounces),*] }
            fn is_homogeneous(&self) -> ::core::primitive::bool { #is_homogeneous }
            #sizes
            #gaps
            fn rows(
                &self, #this: &#system_type #ty_generics, #t: #scalar, #state: &#state_type
            ) -> #runtime::impacts::Rows<#scalar, #runtime::VecOf<#system_type #ty_generics>, #rows> {
                _ = (#this, #t, #state);
                #statements
                #runtime::impacts::Rows {
                    approach: [#(#approach),*],
                    response: [#(#responses),*],
                    mobility: [#(#mobility),*],
                }
            }
        }
    }
}

/// The scope of a function whose system is an argument.
fn scope_of<'a>(context: &Context, system: &'a System, this: &Ident) -> Scope<'a> {
    let parameters: Vec<SymbolId> =
        system.model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let places = parameter_places(context).into_iter().map(|place| {
        // `self.m` with the name of the argument for `self`
        let rest = place.into_iter().skip(1);
        quote!(#this #(#rest)*)
    });
    let places = places.collect();
    Scope::new(context, &system.model, &system.state()).with_places(Argument::This, &parameters, places)
}

/// `gaps`: those of unilateral rows.
fn closed(context: &Context, impact: &ImpactForm, outline: &OutlinedImpact, this: &Ident) -> TokenStream {
    let Context { scalar, layout, .. } = context;
    let (t, state, state_type) = (&context.locals.t, &context.locals.state, context.type_of(&context.state));
    let (system_type, rows) = (&layout.name, Literal::usize_unsuffixed(outline.rows));
    let (_, ty_generics, _) = context.generics.split_for_impl();
    let gaps: Vec<Ident> = (0..outline.positions).map(|place| local(&format!("gap{place}"))).collect();
    let event = format_ident!("event_{}", outline.label);
    let read = match gaps.as_slice() {
        [] => quote!(_ = (#this, #t, #state);),
        [only] => quote!(let #only = #this.#event(#t, #state);),
        several => quote!(let [#(#several),*] = #this.#event(#t, #state);),
    };
    let entries = impact.places.iter().zip(&impact.unilateral).map(|(place, is_unilateral)| {
        let gap = place.and_then(|place| gaps.get(place)).filter(|_| *is_unilateral);
        gap.map_or_else(
            || quote!(::core::option::Option::None),
            |gap| quote!(::core::option::Option::Some(#gap)),
        )
    });
    let idle = impact.places.iter().zip(&impact.unilateral).filter(|(_, is_unilateral)| !**is_unilateral);
    let idle =
        idle.filter_map(|(place, _)| place.and_then(|place| gaps.get(place))).map(|gap| quote!(_ = #gap;));
    quote! {
        fn gaps(
            &self, #this: &#system_type #ty_generics, #t: #scalar, #state: &#state_type
        ) -> [::core::option::Option<#scalar>; #rows] {
            #read
            #(#idle)*
            [#(#entries),*]
        }
    }
}

/// `sizes`: the sums of what gaps are made of.
fn sizes(context: &Context, impact: &ImpactForm, terms: &super::program::Body) -> TokenStream {
    let Context { runtime, scalar, layout, .. } = context;
    let (t, state, state_type) = (&context.locals.t, &context.locals.state, context.type_of(&context.state));
    let (system_type, this) = (&layout.name, local("system"));
    let rows = Literal::usize_unsuffixed(impact.places.len());
    let (_, ty_generics, _) = context.generics.split_for_impl();
    let zero = quote!(<#scalar as #runtime::Scalar>::ZERO);
    let positions = impact.places.iter().flatten().count();
    let width = terms.outputs.len() / positions.max(1);
    let is_zero = |term: &TokenStream| term.to_string() == zero.to_string() || term.to_string() == "0.0";
    let entries = impact.places.iter().map(|place| {
        let own = place.and_then(|place| terms.outputs.get(place * width..(place + 1) * width));
        let own = own.unwrap_or_default().iter().filter(|term| !is_zero(term));
        let sum = own.map(|term| quote!(<#scalar as #runtime::Scalar>::abs(#term)));
        sum.reduce(|sum, term| quote!(#sum + #term)).unwrap_or_else(|| zero.clone())
    });
    let entries: Vec<TokenStream> = entries.collect();
    let statements = &terms.statements;
    quote! {
        fn sizes(
            &self, #this: &#system_type #ty_generics, #t: #scalar, #state: &#state_type
        ) -> [#scalar; #rows] {
            _ = (#this, #t, #state);
            #statements
            [#(#entries),*]
        }
    }
}
