//! The loop over the orders: each rule as a statement.

use std::collections::BTreeMap;

use nonholonomic_core::algebra::Rational;
use nonholonomic_core::id::SymbolId;
use nonholonomic_core::program::{Factor, Inner, Recurrences, Rule, Step, Value};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::super::infix::element;
use super::super::intermediate_names::{Names, unknowns};
use super::super::layout::local;
use super::super::literal;
use super::super::setting::Context;
use super::super::symbols::Scope;

/// Writes the loop.
pub(super) struct Writer<'a> {
    context: &'a Context<'a>,
    scope: &'a Scope<'a>,
    recurrences: &'a Recurrences,
    names: Names,
    /// The variables of the loop itself.
    pub(super) own: Own,
    /// The coefficients of order 0 that the rules name.
    pub(super) values: BTreeMap<Value, TokenStream>,
    /// The coefficients of order k of the state's variables.
    pub(super) places: BTreeMap<SymbolId, TokenStream>,
    /// The coefficients of order k.
    coefficients: BTreeMap<Value, TokenStream>,
    /// The same times k.
    weighted: BTreeMap<Value, TokenStream>,
    /// What stands before the loop: inverse matrices.
    before: TokenStream,
    /// What stands in it.
    statements: TokenStream,
    /// Whether the time is needed.
    has_time: bool,
}

/// The variables of the loop itself.
pub(super) struct Own {
    /// The order, as a number.
    k: Ident,
    /// The coefficients of order k of the state.
    pub(super) series_k: Ident,
    /// The coefficient of order k of the time.
    time_k: Ident,
    /// The rates at order k − 1.
    rates: Ident,
    /// The inner sums of products.
    sums: Ident,
    /// The inner sums of squares.
    squared: Ident,
}

impl<'a> Writer<'a> {
    pub(super) fn new(
        context: &'a Context,
        scope: &'a Scope,
        recurrences: &'a Recurrences,
        mut names: Names,
    ) -> Self {
        let own = Own {
            k: names.unique("k"),
            series_k: names.unique("state_k"),
            time_k: names.unique("t_k"),
            rates: names.unique("rates"),
            sums: names.unique("sums"),
            squared: names.unique("squared"),
        };
        Self {
            context,
            scope,
            recurrences,
            names,
            own,
            values: BTreeMap::new(),
            places: BTreeMap::new(),
            coefficients: BTreeMap::new(),
            weighted: BTreeMap::new(),
            before: TokenStream::new(),
            statements: TokenStream::new(),
            has_time: false,
        }
    }

    /// Gives a coefficient a name.
    fn bind(&mut self, value: Value, tokens: &TokenStream) {
        let name = self.names.of_coefficient(&self.recurrences.start, value, self.scope);
        self.statements.extend(quote!(let #name = #tokens;));
        self.coefficients.insert(value, quote!(#name));
    }

    fn zero(&self) -> TokenStream {
        let Context { runtime, scalar, .. } = self.context;
        quote!(<#scalar as #runtime::Scalar>::ZERO)
    }

    /// The coefficient of order k, which is zero for a constant.
    fn coefficient(&self, value: Value) -> TokenStream {
        self.coefficients.get(&value).cloned().unwrap_or_else(|| self.zero())
    }

    /// The coefficient of order 0.
    fn value(&self, value: Value) -> TokenStream {
        self.values.get(&value).cloned().unwrap_or_default()
    }

    /// k times the coefficient of order k.
    fn weighted(&mut self, value: Value) -> TokenStream {
        if let Some(known) = self.weighted.get(&value) {
            return known.clone();
        }
        let Some(coefficient) = self.coefficients.get(&value) else { return self.zero() };
        let (name, k) = (self.names.numbered(), &self.own.k);
        self.statements.extend(quote!(let #name = #k * #coefficient;));
        self.weighted.insert(value, quote!(#name));
        quote!(#name)
    }

    fn sum(&self, inner: Inner) -> TokenStream {
        let (sums, index) = (&self.own.sums, Literal::usize_unsuffixed(inner));
        quote!(#sums[#index])
    }

    fn square(&self, inner: usize) -> TokenStream {
        let (squared, index) = (&self.own.squared, Literal::usize_unsuffixed(inner));
        quote!(#squared[#index])
    }

    /// a b + c
    fn fused(&self, a: &TokenStream, b: &TokenStream, c: &TokenStream) -> TokenStream {
        let runtime = &self.context.runtime;
        quote!(#runtime::Scalar::mul_add(#a, #b, #c))
    }

    fn number(&self, value: &Rational) -> TokenStream {
        match self.context.parameter() {
            Some(_) => literal::converted(self.context, value),
            None => literal::literal(self.context, value).tokens,
        }
    }

    /// The statements of a rule.
    pub(super) fn rule(&mut self, value: Value, rule: &Rule) {
        let of = |this: &Self, operand: &Value| this.coefficient(*operand);
        let at = |this: &Self, operand: &Value| this.value(*operand);
        let k = self.own.k.clone();
        let tokens = match rule {
            Rule::Constant | Rule::Seed | Rule::Unknown => return,
            Rule::Variable(symbol) => {
                let place = self.places.get(symbol).cloned().unwrap_or_default();
                self.coefficients.insert(value, place);
                return;
            }
            Rule::Time => {
                self.has_time = true;
                let time_k = &self.own.time_k;
                self.coefficients.insert(value, quote!(#time_k));
                return;
            }
            Rule::Same(a) => {
                let same = of(self, a);
                self.coefficients.insert(value, same);
                return;
            }
            Rule::System { varying } => return self.system(value, varying),
            Rule::Negative(a) => {
                let a = of(self, a);
                quote!(-#a)
            }
            Rule::Sum(a, b) => {
                let (a, b) = (of(self, a), of(self, b));
                quote!(#a + #b)
            }
            Rule::Difference(a, b) => {
                let (a, b) = (of(self, a), of(self, b));
                quote!(#a - #b)
            }
            Rule::Scaled(a, constant) => {
                let (a, constant) = (of(self, a), at(self, constant));
                quote!(#a * #constant)
            }
            Rule::Product(a, b, inner) => {
                let (a0, b0, a, b) = (at(self, a), at(self, b), of(self, a), of(self, b));
                self.fused(&a0, &b, &self.fused(&a, &b0, &self.sum(*inner)))
            }
            Rule::Square(a, inner) => {
                let (a0, a) = (at(self, a), of(self, a));
                self.fused(&quote!((#a0 + #a0)), &a, &self.square(*inner))
            }
            Rule::Quotient { numerator, denominator, over, inner } => {
                let (b, over) = (of(self, denominator), at(self, over));
                let known = self.fused(&b, &at(self, &value), &self.sum(*inner));
                if let Some(a) = numerator {
                    let a = of(self, a);
                    quote!((#a - #known) * #over)
                } else {
                    quote!(-(#known * #over))
                }
            }
            Rule::Root { of: a, over, inner } => {
                let (a, over, inner) = (of(self, a), at(self, over), self.square(*inner));
                quote!((#a - #inner) * #over)
            }
            Rule::Power { of: a, exponent, over, inner: [first, second] } => {
                let (weighted, exponent) = (self.weighted(*a), self.number(exponent));
                let (over, second) = (at(self, over), self.sum(*second));
                let sum = self.fused(&weighted, &at(self, &value), &self.sum(*first));
                quote!((#sum * #exponent - #second) * #over / #k)
            }
            Rule::Integral { of: a, rate, negative, inner } => {
                let weighted = self.weighted(*a);
                let sum = self.fused(&weighted, &at(self, rate), &self.sum(*inner));
                if *negative { quote!(-(#sum / #k)) } else { quote!(#sum / #k) }
            }
            Rule::IntegralOver { of: a, over, negative, inner } => {
                let (weighted, over, inner) = (self.weighted(*a), at(self, over), self.sum(*inner));
                let sign = negative.then(|| quote!(-));
                quote!((#sign #weighted - #inner) * #over / #k)
            }
            Rule::Angle { y, x, over, inner: [first, second, third] } => {
                let (y_weighted, x_weighted) = (self.weighted(*y), self.weighted(*x));
                let forth = self.fused(&y_weighted, &at(self, x), &self.sum(*first));
                let back = self.fused(&x_weighted, &at(self, y), &self.sum(*second));
                let (third, over) = (self.sum(*third), at(self, over));
                quote!((#forth - #back - #third) * #over / #k)
            }
        };
        self.bind(value, &tokens);
    }

    /// The unknowns of a linear system.
    fn system(&mut self, solve: Value, varying: &[Vec<(Value, Value, Inner)>]) {
        let Context { runtime, scalar, .. } = self.context;
        let Step::Solve { matrix, right } = &self.recurrences.start.steps[solve] else { return };
        let rows = matrix.iter().map(|row| {
            let row = row.iter().map(|entry| element(&self.value(*entry)));
            quote!([#(#row),*])
        });
        let rows: Vec<_> = rows.collect();
        let (inverse, length) = (self.names.unique("inverse"), Literal::usize_unsuffixed(right.len()));
        self.before.extend(quote! {
            let #inverse = #runtime::inverse_pivoted::<#scalar, #length>([#(#rows),*]);
        });
        let sides = right.iter().zip(varying).map(|(side, terms)| {
            let mut side = self.coefficient(*side);
            for (entry, unknown, inner) in terms {
                let (entry, unknown) = (self.coefficient(*entry), self.value(*unknown));
                let known = self.fused(&entry, &unknown, &self.sum(*inner));
                side = quote!(#side - #known);
            }
            element(&side)
        });
        let sides: Vec<_> = sides.collect();
        let mut pattern = Vec::with_capacity(right.len());
        for unknown in unknowns(&self.recurrences.start, solve, right.len()) {
            let Some(unknown) = unknown else {
                pattern.push(quote!(_));
                continue;
            };
            let name = self.names.of_coefficient(&self.recurrences.start, unknown, self.scope);
            self.coefficients.insert(unknown, quote!(#name));
            pattern.push(quote!(#name));
        }
        self.statements.extend(quote! {
            let [#(#pattern),*] = #runtime::times(&#inverse, [#(#sides),*]);
        });
    }

    /// The loop, from the rates at order 0; afterwards the coefficients of the state.
    pub(super) fn orders(mut self, first: &[TokenStream]) -> TokenStream {
        let Recurrences { products, squares, start, .. } = self.recurrences;
        let mut sides = [Vec::new(), Vec::new()];
        for pair in products {
            for (side, factor) in sides.iter_mut().zip(pair) {
                side.push(match factor {
                    Factor::Plain(value) => self.coefficient(*value),
                    Factor::Weighted(value) => self.weighted(*value),
                });
            }
        }
        let squared: Vec<TokenStream> = squares.iter().map(|value| self.coefficient(*value)).collect();
        let next: Vec<TokenStream> =
            start.outputs.iter().map(|output| element(&self.coefficient(*output))).collect();
        let Context { runtime, scalar, state, .. } = self.context;
        let (zero, one) = (self.zero(), quote!(<#scalar as #runtime::Scalar>::ONE));
        let [index, end, slot] = ["index", "end", "slot"].map(|name| self.names.unique(name));
        let [unit, series, workspace] = ["unit", "series", "workspace"].map(local);
        let Own { k, series_k, time_k, rates, sums, squared: of_squares } = &self.own;
        let sum = (!products.is_empty()).then(|| quote!(let #sums = #workspace.products();));
        let sum_squares = (!squares.is_empty()).then(|| quote!(let #of_squares = #workspace.squares();));
        let terms = super::terms(self.context);
        let start_state = &self.context.locals.state;
        let length = Literal::usize_unsuffixed(state.len());
        let time = self.has_time.then(|| quote!(let mut #time_k = #unit;));
        let no_time = self.has_time.then(|| quote!(#time_k = #zero;));
        let entries = (0..state.len()).map(|index| {
            let index = Literal::usize_unsuffixed(index);
            quote!(#unit * #rates[#index] / #k)
        });
        let entry = state.construct(&self.context.state_name(), &entries.collect::<Vec<_>>());
        let first: Vec<TokenStream> = first.iter().map(element).collect();
        let (before, statements, [left, right]) = (&self.before, &self.statements, &sides);
        quote! {
            #before
            #workspace.restart();
            if let ::core::option::Option::Some(#slot) = #series.first_mut() {
                *#slot = *#start_state;
            }
            let mut #rates: [#scalar; #length] = [#(#first),*];
            let mut #k = #zero;
            #time
            let #end = if #series.len() < #terms { #series.len() } else { #terms };
            for #index in 1..#end {
                #k += #one;
                let #series_k = #entry;
                if let ::core::option::Option::Some(#slot) = #series.get_mut(#index) {
                    *#slot = #series_k;
                }
                if #index + 1 == #end {
                    break;
                }
                #sum
                #sum_squares
                #statements
                #workspace.add([#(#left),*], [#(#right),*], [#(#squared),*]);
                #no_time
                #rates = [#(#next),*];
            }
        }
    }
}
