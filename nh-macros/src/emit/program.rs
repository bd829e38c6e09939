//! Straight-line programs as statements: a `let` for every value that is used several times, has a
//! name, or would make an expression too long; everything else nested where it is used.

use std::collections::{BTreeMap, BTreeSet};

use nonholonomic_core::algebra::Function;
use nonholonomic_core::id::{SymbolId, Table};
use nonholonomic_core::program::{Program, Step, Value};
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{ToTokens, quote};

use super::infix::{Expression, element};
use super::intermediate_names::{Names, unknowns};
use super::literal;
use super::setting::Context;
use super::symbols::{Argument, Scope};

/// The operations in one expression at most.
const LONGEST: usize = 10;

/// The statements of a program.
pub(super) struct Body {
    /// `let`s in order.
    pub(super) statements: TokenStream,
    /// The values of the outputs.
    pub(super) outputs: Vec<TokenStream>,
    /// The arguments that are read.
    pub(super) used: BTreeSet<Argument>,
    /// The names that are taken.
    pub(super) names: Names,
}

/// Turns a program into statements.
pub(super) fn body(context: &Context, scope: &Scope, program: &Program) -> Body {
    written(context, scope, program, None).0
}

/// Statements of a program whose outputs come in groups: what the first group takes; then, for each of the others, what
/// it takes beside that, to stand where the former are known. Sines and cosines are taken from angles at hand, and there
/// are so many of these.
pub(super) fn body_in_branches(
    context: &Context,
    scope: &Scope,
    program: &Program,
    (groups, angles): (&[usize], &Ident),
) -> (Body, Vec<Body>, usize) {
    let program = &*program.with_known_numbers();
    let mut outputs = program.outputs.as_slice();
    let mut next = |count: usize| {
        let (group, rest) = outputs.split_at(count.min(outputs.len()));
        outputs = rest;
        group
    };
    let (first, others) = groups.split_first().unwrap_or((&0, &[]));
    let mut writer = Writer::new(context, scope, program, Some(angles));
    let always = writer.write(next(*first));
    let mut most = writer.angles;
    let mut branch = |count: &usize| {
        let mut writer = writer.clone();
        let body = writer.write(next(*count));
        most = most.max(writer.angles);
        body
    };
    let branches = others.iter().map(&mut branch).collect();
    (always, branches, most)
}

/// The same with every sine and cosine taken from angles at hand, and the number of these.
pub(super) fn body_near_angles(
    context: &Context,
    scope: &Scope,
    program: &Program,
    angles: &Ident,
) -> (Body, usize) {
    written(context, scope, program, Some(angles))
}

/// Statements that write every output to its place as soon as it is computed, so that none occupies a register until all are
/// known; the outputs are what stands in these places before: arguments and numbers, and `t` where something is written later.
pub(super) fn body_in_place(
    context: &Context,
    scope: &Scope,
    program: &Program,
    places: &[TokenStream],
) -> Body {
    let program = &*program.with_known_numbers();
    let mut writer = Writer::new(context, scope, program, None);
    let mut before = Vec::with_capacity(places.len());
    for (value, place) in program.outputs.iter().zip(places) {
        let step = &program.steps[*value];
        before.push(if step.is_leaf() {
            writer.uses[*value] -= 1;
            writer.step(*value, step).tokens
        } else {
            writer.places.entry(*value).or_default().push(place.clone());
            // it is overwritten: a constant would be stored all the same
            writer.used.insert(Argument::Time);
            context.locals.t.to_token_stream()
        });
    }
    Body { outputs: before, ..writer.write(&program.outputs) }
}

fn written(context: &Context, scope: &Scope, program: &Program, at_hand: Option<&Ident>) -> (Body, usize) {
    let program = &*program.with_known_numbers();
    let mut writer = Writer::new(context, scope, program, at_hand);
    let body = writer.write(&program.outputs);
    (body, writer.angles)
}

#[derive(Clone)]
struct Writer<'a> {
    context: &'a Context<'a>,
    scope: &'a Scope<'a>,
    program: &'a Program,
    names: Names,
    /// How often each value is used.
    uses: Table<Value, usize>,
    /// Where values are written as soon as they are known.
    places: BTreeMap<Value, Vec<TokenStream>>,
    /// Which values are known already.
    known: Table<Value, bool>,
    expressions: Table<Value, Expression>,
    /// The variables of each sine and cosine.
    pairs: BTreeMap<Value, (Ident, Ident)>,
    /// The variables of each linear system; none where a component is not needed.
    systems: BTreeMap<Value, Vec<Option<Ident>>>,
    statements: TokenStream,
    used: BTreeSet<Argument>,
    /// The array of angles at hand, where sines and cosines are taken from these.
    at_hand: Option<&'a Ident>,
    /// How many there are.
    angles: usize,
}

impl<'a> Writer<'a> {
    fn new(
        context: &'a Context<'a>,
        scope: &'a Scope<'a>,
        program: &'a Program,
        at_hand: Option<&'a Ident>,
    ) -> Self {
        let nothing = Expression::atom(TokenStream::new(), 0);
        Self {
            context,
            scope,
            program,
            names: Names::new(),
            uses: program.uses(),
            places: BTreeMap::new(),
            known: program.steps.iter().map(|_| false).collect(),
            expressions: program.steps.iter().map(|_| nothing.clone()).collect(),
            pairs: BTreeMap::new(),
            systems: BTreeMap::new(),
            statements: TokenStream::new(),
            used: BTreeSet::new(),
            at_hand,
            angles: 0,
        }
    }

    /// The statements of some outputs, as far as these are not known.
    fn write(&mut self, outputs: &[Value]) -> Body {
        let needed = self.program.needed_by(outputs);
        for (value, step) in self.program.steps.iter_ids() {
            if !needed[value] || self.known[value] || self.uses[value] == 0 {
                continue;
            }
            let expression = self.step(value, step);
            let shared = self.uses[value] > 1 || self.program.names.contains_key(&value);
            // angles at hand are borrowed one after the other: none inside of another's argument
            let borrows =
                self.at_hand.is_some() && matches!(step, Step::Apply(Function::Sin | Function::Cos, _));
            let expression = if self.is_stored(step) && (shared || borrows || expression.size >= LONGEST) {
                let name = self.names.of(self.program, value, self.scope);
                self.bind(&name, &expression)
            } else {
                expression
            };
            for place in self.places.remove(&value).into_iter().flatten() {
                let tokens = &expression.tokens;
                self.statements.extend(quote!(#place = #tokens;));
            }
            self.expressions[value] = expression;
            self.known[value] = true;
        }
        Body {
            statements: std::mem::take(&mut self.statements),
            outputs: outputs.iter().map(|output| self.expressions[*output].tokens.clone()).collect(),
            used: self.used.clone(),
            names: self.names.clone(),
        }
    }

    /// Whether a step may need a variable: not if it is one already, or as short as one.
    fn is_stored(&self, step: &Step) -> bool {
        match step {
            Step::Load(_)
            | Step::SinCos(_)
            | Step::SinOf(_)
            | Step::CosOf(_)
            | Step::Solve { .. }
            | Step::Component(..) => false,
            // conversions are done once
            Step::Constant(_) | Step::Pi => self.context.parameter().is_some(),
            _ => true,
        }
    }

    fn bind(&mut self, name: &Ident, expression: &Expression) -> Expression {
        let (tokens, scalar) = (&expression.tokens, &self.context.scalar);
        let type_of = expression.literal.then(|| quote!(: #scalar));
        self.statements.extend(quote!(let #name #type_of = #tokens;));
        Expression::atom(quote!(#name), 0)
    }

    fn step(&mut self, value: Value, step: &Step) -> Expression {
        let of = |operand: &Value| &self.expressions[*operand];
        match step {
            Step::Constant(number) if self.context.parameter().is_some() => {
                Expression::atom(literal::converted(self.context, number), 0)
            }
            Step::Constant(number) => literal::literal(self.context, number),
            Step::Pi => literal::pi(self.context),
            Step::Load(symbol) => self.load(*symbol),
            Step::Add(a, b) => of(a).add(of(b)),
            Step::Sub(a, b) => of(a).sub(of(b)),
            Step::Mul(a, b) => of(a).mul(of(b)),
            Step::MulAdd { a, b, c, minus_product, minus_c } => {
                let method = if self.program.is_rest(step) { "mul_add_exact" } else { "mul_add" };
                self.multiply_add(method, [*a, *b], *c, [*minus_product, *minus_c])
            }
            Step::Div(a, b) => of(a).div(of(b)),
            Step::Neg(a) => of(a).neg(),
            Step::Recip(a) if self.context.parameter().is_none() => {
                Expression::literal(quote!(1.0), false).div(of(a))
            }
            Step::Recip(a) => self.call("recip", &[*a]),
            Step::Sqrt(a) => self.call("sqrt", &[*a]),
            Step::Cbrt(a) => self.call("cbrt", &[*a]),
            Step::PowReal(a, exponent) => {
                let exponent = match self.context.parameter() {
                    Some(_) => literal::converted(self.context, exponent),
                    None => literal::literal(self.context, exponent).tokens,
                };
                self.call_with("powf", *a, &[exponent])
            }
            Step::SinCos(angle) => self.sin_cos(value, *angle),
            Step::SinOf(pair) | Step::CosOf(pair) => match self.pairs.get(pair) {
                Some((sin, _)) if matches!(step, Step::SinOf(_)) => Expression::atom(quote!(#sin), 0),
                Some((_, cos)) => Expression::atom(quote!(#cos), 0),
                None => Expression::atom(TokenStream::new(), 0),
            },
            Step::Apply(Function::Sin, a) if self.at_hand.is_some() => {
                let pair = self.pair_of(*a);
                Expression::atom(quote!(#pair.0), 1)
            }
            Step::Apply(Function::Cos, a) if self.at_hand.is_some() => {
                let pair = self.pair_of(*a);
                Expression::atom(quote!(#pair.1), 1)
            }
            Step::Apply(function, a) => self.call(function.name(), &[*a]),
            Step::Apply2(function, a, b) => self.call(function.name(), &[*a, *b]),
            Step::Call { method, arguments } if self.context.differentiates => {
                self.differentiated_call(method, arguments)
            }
            Step::Call { method, arguments } => self.call_of_user(method, arguments),
            Step::Solve { matrix, right } => self.solve(value, matrix, right),
            Step::Component(system, index) => {
                let variable = self.systems.get(system).and_then(|unknowns| unknowns.get(*index)?.as_ref());
                Expression::atom(variable.map_or_else(TokenStream::new, |name| quote!(#name)), 0)
            }
        }
    }

    /// `Scalar::mul_add(a, b, c)`: the runtime fuses it where the target has an instruction for it. Where it is a
    /// rounding error, it is exact on every target.
    fn multiply_add(
        &self,
        method: &str,
        factors: [Value; 2],
        summand: Value,
        [minus_product, minus_summand]: [bool; 2],
    ) -> Expression {
        let Context { runtime, scalar, .. } = self.context;
        let signed = |expression: &Expression, minus: bool| {
            if minus { expression.neg() } else { expression.clone() }
        };
        let [a, b] = factors.map(|factor| &self.expressions[factor]);
        // the receiver determines the type
        let (a, b) = if a.literal { (b, a) } else { (a, b) };
        let (a, c) = (signed(a, minus_product), signed(&self.expressions[summand], minus_summand));
        let method = Ident::new(method, Span::call_site());
        let path = if a.literal {
            quote!(<#scalar as #runtime::Scalar>::#method)
        } else {
            quote!(#runtime::Scalar::#method)
        };
        let size = a.size + b.size + c.size + 2;
        let (a, b, c) = (&a.tokens, &b.tokens, &c.tokens);
        Expression::atom(quote!(#path(#a, #b, #c)), size)
    }

    fn load(&mut self, symbol: SymbolId) -> Expression {
        if let Some((argument, place)) = self.scope.place(symbol) {
            self.used.insert(*argument);
            return Expression::atom(place.clone(), 0);
        }
        let message = format!("`{}` is not known here", self.scope.name(symbol));
        Expression::atom(quote!(::core::compile_error!(#message)), 0)
    }

    /// `self.method(a, b)`.
    fn call_of_user(&mut self, method: &str, arguments: &[Value]) -> Expression {
        self.used.insert(Argument::This);
        let method = self.context.layout.method(method);
        let arguments = arguments.iter().map(|value| &self.expressions[*value].tokens);
        Expression::atom(quote!(self.#method(#(#arguments),*)), 0)
    }

    /// The same with its partial derivatives, which other methods of the user's give.
    fn differentiated_call(&mut self, method: &str, arguments: &[Value]) -> Expression {
        self.used.insert(Argument::This);
        let runtime = &self.context.runtime;
        let names: Vec<Ident> = arguments.iter().map(|_| self.names.numbered()).collect();
        for (name, value) in names.iter().zip(arguments) {
            let tokens = &self.expressions[*value].tokens;
            self.statements.extend(quote!(let #name = #tokens;));
        }
        let derivatives = self.scope.derivatives(method);
        let layout = self.context.layout;
        let partial = derivatives.iter().map(|derivative| layout.method(derivative));
        let method = layout.method(method);
        let values = quote!(#(#names.value),*);
        let partial = partial.map(|derivative| quote!(self.#derivative(#values)));
        // an argument that does not change needs no derivative
        let names = names.iter().take(derivatives.len());
        Expression::atom(
            quote!(#runtime::Jet::of_call(self.#method(#values), [#(#partial),*], [#(#names),*])),
            0,
        )
    }

    /// `Scalar::method(a, b)`.
    fn call(&self, method: &str, operands: &[Value]) -> Expression {
        let rest: Vec<_> = operands[1..].iter().map(|v| self.expressions[*v].tokens.clone()).collect();
        let mut call = self.call_with(method, operands[0], &rest);
        call.size = operands.iter().map(|v| self.expressions[*v].size + 1).sum();
        call
    }

    fn call_with(&self, method: &str, receiver: Value, rest: &[TokenStream]) -> Expression {
        let Context { runtime, scalar, .. } = self.context;
        let receiver = &self.expressions[receiver];
        let tokens = &receiver.tokens;
        let method = Ident::new(method, Span::call_site());
        let path = if receiver.literal {
            quote!(<#scalar as #runtime::Scalar>::#method)
        } else {
            quote!(#runtime::Scalar::#method)
        };
        Expression::atom(quote!(#path(#tokens #(, #rest)*)), receiver.size + 1)
    }

    /// Sine and cosine of an angle, as a pair.
    fn pair_of(&mut self, angle: Value) -> TokenStream {
        let Some(angles) = self.at_hand else { return self.call("sin_cos", &[angle]).tokens };
        let index = Literal::usize_unsuffixed(self.angles);
        self.angles += 1;
        let angle = &self.expressions[angle].tokens;
        quote!(#angles[#index].sin_cos(#angle))
    }

    fn sin_cos(&mut self, pair: Value, angle: Value) -> Expression {
        let call = self.pair_of(angle);
        let mut variable = |function: &Step| {
            let of = self.program.steps.iter_ids().find(|(_, step)| *step == function);
            match of {
                Some((value, _)) => self.names.of(self.program, value, self.scope),
                None => self.names.numbered(),
            }
        };
        let (sin, cos) = (variable(&Step::SinOf(pair)), variable(&Step::CosOf(pair)));
        self.statements.extend(quote!(let (#sin, #cos) = #call;));
        self.pairs.insert(pair, (sin, cos));
        Expression::atom(TokenStream::new(), 0)
    }

    fn solve(&mut self, value: Value, matrix: &[Vec<Value>], right: &[Value]) -> Expression {
        let Context { runtime, scalar, .. } = self.context;
        let list = |values: &[Value]| {
            let tokens = values.iter().map(|v| element(&self.expressions[*v].tokens));
            quote!([#(#tokens),*])
        };
        let rows: Vec<_> = matrix.iter().map(|row| list(row)).collect();
        let right_tokens = list(right);
        let length = Literal::usize_unsuffixed(right.len());
        let variables: Vec<Option<Ident>> = unknowns(self.program, value, right.len())
            .into_iter()
            .map(|unknown| unknown.map(|v| self.names.of(self.program, v, self.scope)))
            .collect();
        let pattern =
            variables.iter().map(|name| name.as_ref().map_or_else(|| quote!(_), |name| quote!(#name)));
        self.statements.extend(quote! {
            let [#(#pattern),*] =
                #runtime::solve_pivoted::<#scalar, #length>([#(#rows),*], #right_tokens);
        });
        self.systems.insert(value, variables);
        Expression::atom(TokenStream::new(), 0)
    }
}
