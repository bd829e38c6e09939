//! Exact numbers as literals.

use nonholonomic_core::algebra::Rational;
use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::infix::Expression;
use super::setting::Context;
use crate::syntax::ast;

/// The number nearest to an exact one, as the shortest decimal that reads back as it.
pub(super) fn literal(context: &Context, value: &Rational) -> Expression {
    let magnitude = value.abs();
    let (digits, is_finite) = match context.layout.scalar {
        ast::Scalar::F32 => {
            let nearest = to_f32(&magnitude);
            (format!("{nearest:?}"), nearest.is_finite())
        }
        ast::Scalar::F64 | ast::Scalar::Parameter(_) => {
            let nearest = magnitude.to_f64();
            (format!("{nearest:?}"), nearest.is_finite())
        }
    };
    let negative = value.is_negative();
    let sign = negative.then(|| quote!(-));
    match digits.parse::<Literal>() {
        Ok(literal) if is_finite => Expression::literal(quote!(#sign #literal), negative),
        // beyond the range of the type
        _ => {
            let scalar = match context.layout.scalar {
                ast::Scalar::Parameter(_) => quote!(::core::primitive::f64),
                ast::Scalar::F32 | ast::Scalar::F64 => context.scalar.clone(),
            };
            Expression::literal(quote!(#sign #scalar::INFINITY), negative)
        }
    }
}

/// The nearest `f32`: rounding twice can be off by one, so the neighbours are compared exactly.
#[allow(clippy::cast_possible_truncation, reason = "the rounding is wanted")]
fn to_f32(value: &Rational) -> f32 {
    let guess = value.to_f64() as f32;
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
