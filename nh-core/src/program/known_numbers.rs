//! What a program computes from numbers alone, where rounding errors would be left of it.
//!
//! `exp(π √163) − 262537412640768744` is −7.5·10⁻¹³, and 0 in double precision. No derivation is at fault, and no
//! order of the operations helps: such a value is known before the program runs, to any number of digits, and stands in
//! what is emitted as a number.

use std::borrow::Cow;
use std::collections::BTreeMap;

use super::fuse::constants;
use super::interpret::{Arithmetic, interpret_in};
use super::step::{Program, Step, Value};
use crate::algebra::{Bounded, Function, Function2, Rational, RealNumber};
use crate::id::Id;

/// Programs in which more steps than this are made of numbers are left as they are, and they are known to more digits
/// where they are at most so many.
const LONGEST: usize = 100;
const SHORT: usize = 20;

/// The relative rounding error that is left alone: what a few operations without cancellation have.
const HARMLESS: f64 = 64.0 * f64::EPSILON;

impl Program {
    /// The steps from numbers alone whose results may have lost digits, with their values.
    #[must_use]
    pub fn known_numbers(&self) -> BTreeMap<Value, Rational> {
        let is_constant = constants(self);
        let are_computed = self.steps.iter_ids().filter(|(value, step)| {
            let is_number = !matches!(step, Step::SinCos(_) | Step::Solve { .. } | Step::Component(..));
            is_constant[value.index()] && is_number && !step.is_leaf()
        });
        let outputs: Vec<Value> = are_computed.map(|(value, _)| value).collect();
        if outputs.is_empty() {
            return BTreeMap::new();
        }
        let mut computed = Self { outputs, ..self.clone() };
        let bounds = interpret_in(&computed, |_| Bounded::number(&Rational::ZERO));
        let bounds: Vec<_> = computed.outputs.iter().copied().zip(bounds).collect();
        let loses = |bounded: &Bounded| {
            let permitted = HARMLESS * bounded.value.abs();
            bounded.error.is_nan() || bounded.error > permitted
        };
        let lossy = bounds.iter().filter(|(_, bounded)| loses(bounded));
        computed.outputs = lossy.map(|(value, _)| *value).collect();
        let mut known = computed.to_digits::<256>(LONGEST);
        computed.outputs.retain(|value| !known.contains_key(value));
        known.extend(computed.to_digits::<2048>(SHORT));
        known
    }

    /// The outputs that are known to some digits, where they take few steps.
    fn to_digits<const BITS: u64>(&self, most: usize) -> BTreeMap<Value, Rational> {
        let steps = self.needed_by(&self.outputs).iter().filter(|is_needed| **is_needed).count();
        if self.outputs.is_empty() || steps > most {
            return BTreeMap::new();
        }
        let numbers = interpret_in(&self.giving(&self.outputs), |_| RealNumber::<BITS>::UNKNOWN);
        let values = numbers.iter().map(RealNumber::value);
        self.outputs.iter().zip(values).filter_map(|(value, number)| Some((*value, number?))).collect()
    }

    /// The same program with these numbers in the place of the steps, which keep their places; other steps may no longer be
    /// needed.
    #[must_use]
    pub fn with_known_numbers(&self) -> Cow<'_, Self> {
        let known = self.known_numbers();
        if known.is_empty() {
            return Cow::Borrowed(self);
        }
        let mut program = self.clone();
        for (value, number) in known {
            program.steps[value] = Step::Constant(number);
            program.names.remove(&value);
        }
        Cow::Owned(program)
    }
}

impl<const BITS: u64> Arithmetic for RealNumber<BITS> {
    fn number(value: &Rational) -> Self {
        Self::of(value)
    }
    fn pi() -> Self {
        Self::pi()
    }
    fn add(&self, other: &Self) -> Self {
        self.plus(other)
    }
    fn sub(&self, other: &Self) -> Self {
        self.minus(other)
    }
    fn mul(&self, other: &Self) -> Self {
        self.times(other)
    }
    fn div(&self, other: &Self) -> Self {
        self.over(other)
    }
    fn sqrt(&self) -> Self {
        self.power(&Rational::new(1, 2))
    }
    fn cbrt(&self) -> Self {
        self.cube_root()
    }
    fn pow(&self, exponent: &Rational) -> Self {
        self.power(exponent)
    }
    fn apply(&self, function: Function) -> Self {
        self.function(function)
    }
    fn apply2(&self, function: Function2, other: &Self) -> Self {
        self.function2(function, other)
    }
    fn magnitude(&self) -> f64 {
        f64::NAN
    }
}
