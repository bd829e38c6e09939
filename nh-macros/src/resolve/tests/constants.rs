//! Constants in place of fields: the same motion for at most the same work, on every reference system.

use nonholonomic_core::algebra::Bounded;
use nonholonomic_core::id::SymbolId;
use nonholonomic_core::program::{Cost, Program, interpret_in, schedule_grouping};
use nonholonomic_core::system::System;
use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};
use quote::quote;

use super::super::{Resolved, resolve};
use super::catalogue::all;
use super::{messages, model, of_name};
use crate::emit::Layout;
use crate::syntax;

/// A declaration.
pub(super) type Declaration = (TokenStream, TokenStream);

/// The values of fields.
type Values = fn(&str) -> f64;

/// The declaration with `constants` for the fields, of these values.
fn with_constants((attribute, item): &Declaration, value: Values) -> Declaration {
    let parsed = syntax::parse(attribute.clone(), item.clone()).expect("well-formed");
    let mut constants = TokenStream::new();
    for field in &parsed.structure.parameters {
        let (ident, name) = (&field.name.ident, &field.name.text);
        let entry = |entry: String| format!("{:.2}", value(&entry)).parse::<TokenStream>().expect("a number");
        let row = |name: String, length: u32| {
            let entries = (0..length).map(|k| entry(format!("{name}[{k}]")));
            quote!([#(#entries),*])
        };
        let value = match *field.lengths {
            [] => entry(name.clone()),
            [length] => row(name.clone(), length),
            [rows, columns, ..] => {
                let rows = (0..rows).map(|k| row(format!("{name}[{k}]"), columns));
                quote!([#(#rows),*])
            }
        };
        constants.extend(quote!(#ident = #value;));
    }
    let names: Vec<&str> = parsed.structure.parameters.iter().map(|field| field.name.text.as_str()).collect();
    (quote!(constants { #constants } #attribute), without_fields(item.clone(), &names))
}

/// The struct without some fields.
fn without_fields(item: TokenStream, names: &[&str]) -> TokenStream {
    let is_named = |token: &TokenTree| matches!(token, TokenTree::Ident(ident) if names.contains(&ident.to_string().as_str()));
    let is_comma = |token: &TokenTree| matches!(token, TokenTree::Punct(punct) if punct.as_char() == ',');
    let rest = item.into_iter().map(|token| match token {
        TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => {
            let fields: Vec<TokenTree> = group.stream().into_iter().collect();
            let kept = fields.split(is_comma).filter(|field| !field.iter().any(is_named));
            let kept = kept.map(|field| field.iter().cloned().collect::<TokenStream>());
            TokenTree::Group(Group::new(Delimiter::Brace, quote!(#(#kept),*)))
        }
        other => other,
    });
    rest.collect()
}

/// The system, or nothing where the values contradict its assumptions.
pub(super) fn compiled((attribute, item): &Declaration) -> Option<System> {
    let declaration = syntax::parse(attribute.clone(), item.clone()).expect("well-formed");
    let mut layout = Layout::of_struct(&declaration.structure, attribute.clone());
    let Resolved { mut model, .. } = resolve(&declaration, &mut layout).expect("resolved");
    model.requests.clear();
    nonholonomic_core::compile::compile(model).ok()
}

pub(super) fn derivative(system: &System) -> Program {
    let parameters: Vec<SymbolId> = system.model.parameters.iter().map(|p| p.symbol).collect();
    schedule_grouping(&system.model.graph, &system.derivative, &parameters)
}

/// The rates at a point where every name has the value that its hash gives, parameters those of the fields.
fn rates(system: &System, program: &Program, value: Values) -> Vec<Bounded> {
    let is_parameter = |symbol| system.model.parameters.iter().any(|parameter| parameter.symbol == symbol);
    interpret_in(program, |symbol| {
        let name = &system.model.graph.symbols()[symbol];
        let value = if is_parameter(symbol) { rounded(name, value) } else { of_name(name) - 0.5 };
        // constants are exact
        Bounded { value, error: f64::EPSILON * value.abs() }
    })
}

/// A value as it is written.
fn rounded(name: &str, value: Values) -> f64 {
    format!("{:.2}", value(name)).parse().expect("a number")
}

#[test]
fn cost_no_more_than_fields() {
    let sets: [Values; 2] =
        [|name| of_name(name) - 0.5, |name| if name.starts_with('m') { 2.0 } else { 0.5 }];
    let (mut compared, mut cheaper) = (0, 0);
    for declaration in all() {
        let fields = compiled(&declaration).expect("a reference system");
        let program = derivative(&fields);
        let cost = Cost::of(&program);
        for value in sets {
            // equal values may contradict what is assumed
            let Some(system) = compiled(&with_constants(&declaration, value)) else { continue };
            let name = &system.model.name;
            let with_constants = derivative(&system);
            let found = Cost::of(&with_constants);
            assert!(found.weighted() <= cost.weighted(), "{name}: {found}; with fields {cost}");
            assert!(found.operations() <= cost.operations(), "{name}: {found}; with fields {cost}");
            compared += 1;
            cheaper += usize::from(found.weighted() < cost.weighted());
            let (expected, found) = (rates(&fields, &program, value), rates(&system, &with_constants, value));
            assert_eq!(expected.len(), found.len(), "{name}");
            for (expected, found) in expected.iter().zip(found) {
                let allowed = expected.error + found.error;
                assert!((expected.value - found.value).abs() <= allowed, "{name}: {found:?}, {expected:?}");
            }
        }
    }
    assert!(compared == 0 || (compared > 80 && 10 * cheaper > 9 * compared), "{cheaper} of {compared}");
}

/// A tractor with trailers, as text.
pub(super) fn tractor(trailers: usize) -> Declaration {
    let bodies = trailers + 1;
    let attribute = format!(
        "base {{ x, y, th, rel[{trailers}] }}
         basis {{ v, side, omega, rd[{trailers}] }}
         anchor {{
             der(x) = v * cos(th) - side * sin(th);
             der(y) = v * sin(th) + side * cos(th);
             der(th) = omega;
             for i in 0..{trailers} {{ der(rel[i]) = rd[i]; }}
         }}
         lagrangian {{
             let ang[i in 0..{trailers}] = sum(j in 0..i+1: rel[j]);
             let w[i in 0..{trailers}] = omega + sum(j in 0..i+1: rd[j]);
             let px[i in 0..{trailers}] = v + sum(j in 0..i+1: d[j] * sin(ang[j]) * w[j]);
             let py[i in 0..{trailers}] = side - sum(j in 0..i+1: d[j] * cos(ang[j]) * w[j]);
             m[0] / 2 * (v^2 + (side + a * omega)^2) + J[0] / 2 * omega^2
                 + sum(i in 0..{trailers}: J[i+1] / 2 * w[i]^2 + m[i+1] / 2 * (px[i]^2 + py[i]^2))
         }}
         constraints {{
             let ang[i in 0..{trailers}] = sum(j in 0..i+1: rel[j]);
             let w[i in 0..{trailers}] = omega + sum(j in 0..i+1: rd[j]);
             let px[i in 0..{trailers}] = v + sum(j in 0..i+1: d[j] * sin(ang[j]) * w[j]);
             let py[i in 0..{trailers}] = side - sum(j in 0..i+1: d[j] * cos(ang[j]) * w[j]);
             side = 0;
             for i in 0..{trailers} {{ cos(ang[i]) * py[i] = sin(ang[i]) * px[i]; }}
         }}
         inputs {{ push, steer }}
         forces {{ v: push; omega: steer; }}"
    );
    let item =
        format!("struct Tractor {{ m: [f64; {bodies}], J: [f64; {bodies}], d: [f64; {trailers}], a: f64 }}");
    (attribute.parse().expect("tokens"), item.parse().expect("tokens"))
}

#[test]
fn chains_of_bodies_keep_what_they_have_in_common() {
    let mut costs = Vec::new();
    for trailers in [3, 6, 7] {
        let declaration = tractor(trailers);
        let fields = Cost::of(&derivative(&compiled(&declaration).expect("regular")));
        for value in [(|name| of_name(name) - 0.5) as Values, |_| 1.0] {
            let system = compiled(&with_constants(&declaration, value)).expect("regular");
            let constants = Cost::of(&derivative(&system));
            assert!(constants.operations() < fields.operations(), "{constants}; with fields {fields}");
            costs.push(constants.operations());
        }
    }
    // what one trailer more costs does not depend on how many there are
    assert!(costs[4] - costs[2] <= (costs[2] - costs[0]).div_ceil(3) + 3, "{costs:?}");
}

#[test]
fn are_numbers_where_numbers_are_asked_for() {
    let system = |attribute: &str| {
        let declaration = (attribute.parse().expect("tokens"), "struct S {}".parse().expect("tokens"));
        compiled(&declaration)
    };
    // bounds, indices, exponents; the radius of a sphere
    let text = "constants { n = 2; m = [2, 3]; p = 3; } base { q[2] }
        lagrangian { sum(i in 0..n: m[i] / 2 * der(q[i])^2) - q[n-1]^p / m[n-1] }";
    let found = system(text).expect("regular");
    assert!(rates(&found, &derivative(&found), |_| 0.0)[2].value.abs() < f64::MIN_POSITIVE);
    let text = "constants { r = 3/5; m = 2; } base { x, y, z } on { x^2 + y^2 + z^2 = r^2; }
        basis { wx, wy, wz }
        anchor { der(x) = wz * y - wy * z; der(y) = wx * z - wz * x; der(z) = wy * x - wx * y; }
        brackets so(3) { wx, wy, wz } lagrangian { m / 2 * (wx^2 + wy^2 + wz^2) - m * z }";
    assert!(system(text).is_some());
    // two bodies' worth of inertia that cancels for these values alone leaves nothing to compute
    let top = |inertia: &str| {
        let text = format!(
            "constants {{ I = {inertia}; }} basis {{ w1, w2, w3 }} brackets so(3) {{ w1, w2, w3 }}
             lagrangian {{ (I[0] * w1^2 + I[1] * w2^2 + I[2] * w3^2) / 2 }}"
        );
        Cost::of(&derivative(&system(&text).expect("regular"))).operations()
    };
    assert!(top("[2, 2, 3]") < top("[2, 5/2, 3]"));
    assert_eq!(top("[2, 2, 2]"), 0);
    // a mass matrix that is singular for these values alone
    let cart = |inertia: &str| {
        system(&format!(
            "constants {{ m = 2; a = 2/5; J = {inertia}; }} base {{ x, th }}
             lagrangian {{ m / 2 * der(x)^2 + m * a * der(x) * der(th) + J / 2 * der(th)^2 }}"
        ))
    };
    assert!(cart("8/25").is_none() && cart("m * a^2").is_none() && cart("9/25").is_some());
    // facts that compare a parameter with a constant
    let text = "constants { c = 2; } base { x } lagrangian { m / 2 * der(x)^2 } assume { m > c; m < 1; }";
    assert!(messages(text, "struct S { m: f64 }").is_empty());
    let contradicted = model(text, "struct S { m: f64 }");
    assert!(nonholonomic_core::compile::compile(contradicted).is_err());
}
