//! `linearize` and `trim`, and the variables that a trim can hold.

use nonholonomic_core::functions::{self, OUTPUTS, RESIDUAL};
use nonholonomic_core::id::SymbolId;
use nonholonomic_core::mechanics::Procedure;
use nonholonomic_core::program::Program;
use nonholonomic_core::system::{Linearization, System};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::assembly::by_name;
use super::infix::element;
use super::inherent_method::Part;
use super::layout::{Layout, local};
use super::program::body;
use super::record::Record;
use super::results::Results;
use super::setting::Context;
use super::symbols::{Argument, Scope, parameter_places};
use crate::syntax::ast;

/// The two methods, the enum, and what both stand on; nothing where no linearisation is declared.
pub(super) fn emit(context: &Context, system: &System, derivative: &Program) -> Part {
    let Some(Linearization { kept, residuals }) = &system.linearization else { return Part::default() };
    let texts = system.embedding.as_ref().map_or(&[][..], |embedding| &embedding.texts);
    let results = Results::of(context, system);
    let of_constraints = results
        .get(context, functions::Record::Residual)
        .filter(|_| system.functions.get(&RESIDUAL).is_some_and(|residual| !residual.outputs.is_empty()));
    let names: Vec<&String> = of_constraints.into_iter().flat_map(Record::names).chain(texts).collect();
    let linearize = linearize(context, &names, kept);
    let trim = trim(context, &names, (kept, system.state_coordinates.len()));
    let mut items = variables(context);
    items.extend(first_order(context, system, (derivative, residuals)));
    Part { methods: methods(context, kept.len(), &linearize, &trim), items, ..Part::default() }
}

/// `impl FirstOrder for Sleigh`: the programs of motion, outputs and constraints, over numbers with partial derivatives.
fn first_order(
    context: &Context,
    system: &System,
    (derivative, residuals): (&Program, &Procedure),
) -> TokenStream {
    let Context { runtime, scalar, locals, .. } = context;
    let [n, m, p] = sizes(context);
    let layout = &Layout { scalar: ast::Scalar::Parameter(local("Number")), ..context.layout.clone() };
    let in_state = system.state();
    let jets = &context.with_jets(layout, &in_state);
    let (of_state, of_input) = (local("of_state"), local("of_input"));
    let (model, t) = (&system.model, &locals.t);
    let constant = |place: &TokenStream| quote!(#runtime::Jet::constant(#place));
    let places = parameter_places(context).iter().map(constant).collect();
    let names = (&of_state, &of_input);
    let scope =
        &with_variables(Scope::new(jets, model, &in_state), system, names, places, constant(&quote!(#t)));
    let plain = Scope::new(context, model, &in_state);
    let plain = &with_variables(plain, system, names, parameter_places(context), quote!(#t));
    let residuals = context.lowering.program(model, residuals);
    let values = {
        let body = body(context, plain, &residuals);
        let (statements, values) = (&body.statements, body.outputs.iter().map(element));
        quote!(#statements [#(#values),*])
    };
    let outputs = system.functions.get(&OUTPUTS).cloned().unwrap_or_default();
    let outputs = context.lowering.program(model, &outputs);
    let [residuals, rates, outputs] = [&residuals, derivative, &outputs].map(|program| {
        let body = body(jets, scope, program);
        let (statements, values) = (&body.statements, body.outputs.iter().map(element));
        quote!({ #statements [#(#values),*] })
    });
    let count =
        Literal::usize_unsuffixed(system.linearization.as_ref().map_or(0, |l| l.residuals.outputs.len()));
    let [n, m, p] = [n, m, p].map(Literal::usize_unsuffixed);
    let (state, input) = (&locals.state, &locals.input);
    let (state_type, input_type) = (context.type_of(&context.state), context.input_type());
    let given =
        if model.inputs.is_empty() { quote!([]) } else { quote!(::core::convert::From::from(*#input)) };
    let body = quote! {
        type Residuals = [#scalar; #count];
        type Parts = #runtime::Parts<#runtime::Jet<#scalar, #n, #m>, #n, #count, #p>;
        fn first_order(&self, #t: #scalar, #state: &#state_type, #input: &#input_type) -> Self::Parts {
            _ = (#t, #input);
            #runtime::to_first_order(#runtime::State::to_array(#state), #given, |#of_state, #of_input| {
                _ = (#of_state, #of_input);
                #runtime::Parts { residuals: #residuals, rates: #rates, outputs: #outputs }
            })
        }
        fn residuals(&self, #t: #scalar, #state: &#state_type, #input: &#input_type) -> Self::Residuals {
            _ = (#t, #input);
            let (#of_state, #of_input): (_, [#scalar; #m]) = (#runtime::State::to_array(#state), #given);
            _ = (#of_state, #of_input);
            #values
        }
    };
    context.implement(&quote!(#runtime::FirstOrder), &body)
}

/// What parameters and the time stand for, and components of the state and inputs in arrays.
fn with_variables<'a>(
    scope: Scope<'a>,
    system: &'a System,
    (of_state, of_input): (&Ident, &Ident),
    parameters: Vec<TokenStream>,
    time: TokenStream,
) -> Scope<'a> {
    let model = &system.model;
    let of_parameters: Vec<SymbolId> = model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let inputs: Vec<SymbolId> = model.inputs.iter().map(|input| input.symbol).collect();
    scope
        .with_places(Argument::This, &of_parameters, parameters)
        .with_places(Argument::Time, &[model.time], vec![time])
        .with_array(Argument::State, of_state, &system.state())
        .with_array(Argument::Input, of_input, &inputs)
}

/// The same for a declaration in error, where nothing is found.
pub(super) fn stub(context: &Context, kept: usize) -> Part {
    let Context { runtime, .. } = context;
    let (t, state, input) = (&context.locals.t, &context.locals.state, &context.locals.input);
    let (guess, held) = (local("guess"), local("hold"));
    let linearize = quote! {
        _ = (self, #t, #state, #input);
        ::core::result::Result::Err(#runtime::LinearizationError::NotFinite)
    };
    let trim = quote! {
        _ = (self, #t, #guess, #input, #held);
        ::core::result::Result::Err(#runtime::TrimError::NotFinite)
    };
    Part { methods: methods(context, kept, &linearize, &trim), items: variables(context), ..Part::default() }
}

/// The numbers of state variables, of inputs, and of outputs.
fn sizes(context: &Context) -> [usize; 3] {
    let count = |record: &Option<Record>| record.as_ref().map_or(0, Record::len);
    [context.state.len(), count(&context.input), count(&context.outputs)]
}

/// The names of the components of a record.
fn component_names(record: Option<&Record>) -> Vec<&String> {
    record.into_iter().flat_map(Record::names).collect()
}

/// The variables of the state, then the inputs.
fn variables(context: &Context) -> TokenStream {
    let layout = context.layout;
    let doc = format!(
        " The variables of the state of [`{}`] and its inputs, by their names in the declaration.",
        layout.name
    );
    let state = context.state.fields.iter().map(|field| ("variable", field));
    let inputs = context.input.iter().flat_map(|record| &record.fields).map(|field| ("input", field));
    let (name, coordinates) = (&layout.types.variable, &layout.types.coordinate);
    let all = by_name(context, name, &doc, state.chain(inputs));
    let visibility = &context.visibility;
    let doc = format!(" The base coordinates of [`{}`] by name: they are among its variables.", layout.name);
    quote! {
        #all
        #[doc = #doc]
        #[allow(dead_code)]
        #visibility type #coordinates = #name;
    }
}

/// The body of `linearize`.
fn linearize(context: &Context, names: &[&String], kept: &[usize]) -> TokenStream {
    let Context { runtime, .. } = context;
    let (t, state, input) = (&context.locals.t, &context.locals.state, &context.locals.input);
    let (all, present) = (local("all"), local("present"));
    let states = component_names(Some(&context.state));
    let inputs = component_names(context.input.as_ref());
    let outputs = component_names(context.outputs.as_ref());
    let state_type = context.type_of(&context.state);
    let kept = kept.iter().map(|place| Literal::usize_unsuffixed(*place));
    quote! {
        #runtime::linearize(
            (
                &#runtime::Names { states: [#(#states),*], inputs: [#(#inputs),*], outputs: [#(#outputs),*] },
                &[#(#names),*],
            ),
            &[#(#kept),*],
            &#runtime::State::to_array(#state),
            |#all| {
                let #present = <#state_type as #runtime::State>::from_array(*#all);
                #runtime::FirstOrder::first_order(self, #t, &#present, #input)
            },
            |#all| {
                let #present = <#state_type as #runtime::State>::from_array(*#all);
                #runtime::FirstOrder::residuals(self, #t, &#present, #input)
            },
        )
    }
}

/// The body of `trim`.
fn trim(context: &Context, names: &[&String], (kept, coordinates): (&[usize], usize)) -> TokenStream {
    let Context { runtime, scalar, .. } = context;
    let (t, input) = (&context.locals.t, &context.locals.input);
    let (state, given) = (local("present"), local("given"));
    let (guess, hold, held) = (local("guess"), local("hold"), local("held"));
    let (variable, place, all, apart) = (local("variable"), local("place"), local("all"), local("apart"));
    let [n, m, _] = sizes(context);
    let states = component_names(Some(&context.state));
    let inputs = component_names(context.input.as_ref());
    let variables = states.iter().chain(&inputs);
    let rates = states.iter().map(|name| format!("the rate of `{name}`"));
    let equations = names.iter().map(|name| format!("`{name}`")).chain(rates);
    let is_kept = (0..n).map(|place| kept.contains(&place));
    let width = Literal::usize_unsuffixed(n + m);
    let coordinates = Literal::usize_unsuffixed(coordinates);
    let (state_type, input_type) = (context.type_of(&context.state), context.input_type());
    let of_state: Vec<_> = (0..n).map(|index| local(&format!("x{index}"))).collect();
    let of_input: Vec<_> = (0..m).map(|index| local(&format!("u{index}"))).collect();
    let (from_input, to_input) = if m == 0 {
        (quote!(_ = #input;), quote!(()))
    } else {
        let m = Literal::usize_unsuffixed(m);
        (
            quote!(let [#(#of_input),*]: [#scalar; #m] = ::core::convert::From::from(*#input);),
            quote!(<#input_type as ::core::convert::From<[#scalar; #m]>>::from([#(#of_input),*])),
        )
    };
    quote! {
        let mut #held = [false; #width];
        for #variable in #hold {
            if let ::core::option::Option::Some(#place) = #held.get_mut(*#variable as ::core::primitive::usize) {
                *#place = true;
            }
        }
        let #apart = |#all: &[#scalar; #width]| -> (#state_type, #input_type) {
            let [#(#of_state,)* #(#of_input),*] = *#all;
            (<#state_type as #runtime::State>::from_array([#(#of_state),*]), #to_input)
        };
        let [#(#of_state),*] = #runtime::State::to_array(#guess);
        #from_input
        let #all = #runtime::trim(
            &[#(#of_state,)* #(#of_input),*],
            &#held,
            &#runtime::Steady {
                variables: [#(#variables),*],
                equations: [#(#equations),*],
                kept: [#(#is_kept),*],
                coordinates: #coordinates,
            },
            |#all| {
                let (#state, #given) = #apart(#all);
                #runtime::equations(&#runtime::FirstOrder::first_order(self, #t, &#state, &#given))
            },
        )?;
        ::core::result::Result::Ok(#apart(&#all))
    }
}

/// The two inherent methods with these bodies.
fn methods(context: &Context, kept: usize, linearize: &TokenStream, trim: &TokenStream) -> TokenStream {
    let Context { runtime, visibility, scalar, layout, .. } = context;
    let (t, state, input) = (&context.locals.t, &context.locals.state, &context.locals.input);
    let (state_type, input_type) = (context.type_of(&context.state), context.input_type());
    let (guess, hold, variable) = (local("guess"), local("hold"), &layout.types.variable);
    let [_, m, p] = sizes(context).map(Literal::usize_unsuffixed);
    let kept = Literal::usize_unsuffixed(kept);
    let bound = context
        .parameter()
        .map(|parameter| quote!(where #parameter: #runtime::Real + #runtime::nalgebra::Scalar));
    let bound_of_trim = context.parameter().map(|parameter| quote!(where #parameter: #runtime::Real));
    quote! {
        /// The motion to first order in the variables that `linearization` keeps, on the constraint manifold, about a
        /// state that satisfies all constraints; the other variables and the time are held.
        ///
        /// # Errors
        /// If the state does not satisfy the constraints, a kept variable follows from the others that are kept, or its rate changes with one that is not.
        #visibility fn linearize(
            &self, #t: #scalar, #state: &#state_type, #input: &#input_type
        ) -> ::core::result::Result<
            #runtime::Linearization<#scalar, #kept, #m, #p>, #runtime::LinearizationError
        > #bound { #linearize }

        /// A steady motion near a guess, with the inputs that it takes: the constraints hold, and the coordinates that
        /// `linearization` keeps, all velocities and all auxiliary states do not change.
        ///
        /// The variables and inputs in `hold` keep their values; other coordinates run on from those of the guess, which
        /// are changed only where constraints demand it.
        ///
        /// # Errors
        /// If nothing near the guess is steady, or a variable that is not held can have any value: by name.
        #visibility fn trim(
            &self, #t: #scalar, #guess: &#state_type, #input: &#input_type, #hold: &[#variable]
        ) -> ::core::result::Result<(#state_type, #input_type), #runtime::TrimError> #bound_of_trim { #trim }
    }
}
