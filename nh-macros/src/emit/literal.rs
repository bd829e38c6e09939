//! Exact numbers as literals.

use nonholonomic_core::algebra::Rational;
use nonholonomic_core::id::Origin;
use nonholonomic_core::violation::{Law, Violation};
use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::infix::Expression;
use super::setting::Context;
use crate::syntax::ast;

/// The number nearest to an exact one, as the shortest decimal that reads back as it. One that the type does not have is
/// noted: what is emitted with it is refused.
pub(super) fn literal(context: &Context, value: &Rational) -> Expression {
    let magnitude = value.abs();
    let (digits, is_finite, is_zero) = match context.layout.scalar {
        ast::Scalar::F32 => {
            let nearest = to_f32(&magnitude);
            (format!("{nearest:?}"), nearest.is_finite(), nearest == 0.0)
        }
        ast::Scalar::F64 | ast::Scalar::Parameter(_) => {
            let nearest = magnitude.to_f64();
            (format!("{nearest:?}"), nearest.is_finite(), nearest == 0.0)
        }
    };
    if !is_finite || (is_zero && !value.is_zero()) {
        context.beyond.borrow_mut().insert(order_of_magnitude(&magnitude));
    }
    let negative = value.is_negative();
    let sign = negative.then(|| quote!(-));
    let digits = if is_finite { digits } else { String::from("0.0") };
    match digits.parse::<Literal>() {
        Ok(literal) => Expression::literal(quote!(#sign #literal), negative),
        Err(_) => Expression::literal(quote!(0.0), false),
    }
}

/// The decimal exponent of a positive number, to the nearest.
#[allow(clippy::cast_possible_truncation, clippy::cast_precision_loss, reason = "it is an estimate")]
fn order_of_magnitude(value: &Rational) -> i64 {
    let as_double = value.to_f64();
    if as_double.is_finite() && as_double > 0.0 {
        return as_double.log10().round() as i64;
    }
    let bits = value.numerator().bits() as f64 - value.denominator().bits() as f64;
    (bits * std::f64::consts::LOG10_2).round() as i64
}

/// That a number of the programs is none of the scalar type: what is said of it, and the way out.
pub(super) fn beyond(context: &Context) -> Option<(String, &'static str)> {
    let exponents = context.beyond.borrow();
    let exponent = exponents.first().filter(|exponent| **exponent < 0).or(exponents.last())?;
    let scalar = match context.layout.scalar {
        ast::Scalar::F32 => "f32",
        ast::Scalar::F64 | ast::Scalar::Parameter(_) => "f64",
    };
    let becomes = if *exponent < 0 { "0" } else { "infinite" };
    let what = format!(
        "the equations have a number of the order of 10^{exponent}, which is {becomes} as `{scalar}`"
    );
    Some((what, "choose units in which the numbers of the declaration are of moderate size"))
}

/// The same of the system that is declared at `origin`.
pub(super) fn beyond_range(context: &Context, origin: Origin) -> Option<Violation> {
    let (what, way_out) = beyond(context)?;
    let (law, evidence, way_out) = (Law::Representable, String::new(), way_out.into());
    Some(Violation { law, origin, what, evidence, way_out })
}

/// The nearest `f32`: rounding twice can be off by one, so the neighbours are compared exactly.
#[allow(clippy::cast_possible_truncation, reason = "the rounding is wanted")]
fn to_f32(value: &Rational) -> f32 {
    let guess = value.to_f64() as f32;
    if !guess.is_finite() {
        return guess;
    }
    let exact = |x: f32| exact(f64::from(x));
    let distance = |x: f32| exact(x).map(|x| (x - value.clone()).abs());
    let candidates = [guess.next_down(), guess, guess.next_up()];
    let near = candidates.into_iter().filter_map(|x| Some((distance(x)?, x)));
    // the guess is the right one of two that are equally near: it was rounded to even
    near.reduce(|best, next| {
        let closer = next.0 < best.0 || (next.0 == best.0 && next.1.to_bits() == guess.to_bits());
        if closer { next } else { best }
    })
    .map_or(guess, |(_, x)| x)
}

/// The value of a number of moderate size.
fn exact(x: f64) -> Option<Rational> {
    if !x.is_finite() {
        return None;
    }
    let bits = x.to_bits();
    let exponent = i64::try_from(bits >> 52 & 0x7ff).ok()?;
    let fraction = i64::try_from(bits & ((1 << 52) - 1)).ok()?;
    let (mantissa, exponent) =
        if exponent == 0 { (fraction, -1074) } else { (fraction + (1 << 52), exponent - 1075) };
    let magnitude = Rational::from(mantissa) * Rational::from(2).pow(exponent)?;
    Some(if x < 0.0 { -magnitude } else { magnitude })
}

/// π in the scalar type.
pub(super) fn pi(context: &Context) -> Expression {
    let runtime = &context.runtime;
    match &context.layout.scalar {
        ast::Scalar::F64 => Expression::atom(quote!(::core::f64::consts::PI), 0),
        ast::Scalar::F32 => Expression::atom(quote!(::core::f32::consts::PI), 0),
        ast::Scalar::Parameter(_) => {
            let scalar = &context.scalar;
            Expression::atom(quote!(<#scalar as #runtime::Scalar>::from_f64(::core::f64::consts::PI)), 0)
        }
    }
}

/// A number in the scalar type where that is a parameter.
pub(super) fn converted(context: &Context, value: &Rational) -> TokenStream {
    let (runtime, scalar) = (&context.runtime, &context.scalar);
    if value.is_one() {
        return quote!(<#scalar as #runtime::Scalar>::ONE);
    }
    if value.is_zero() {
        return quote!(<#scalar as #runtime::Scalar>::ZERO);
    }
    let literal = literal(context, value).tokens;
    quote!(<#scalar as #runtime::Scalar>::from_f64(#literal))
}
