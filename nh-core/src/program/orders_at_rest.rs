//! How steps of a program vanish with lengths: at most as a product of some of them, over a product of others.
//!
//! Every length r is the root of a sum of squares of some steps, each of which is at most r. A product of such a step and of
//! `1/r` is bounded where r vanishes; where another factor vanishes as well, it tends to 0.

use super::step::{Program, Step, Value};
use crate::algebra::{Function, Function2};
use crate::id::Table;
use std::collections::BTreeMap;

/// A set of lengths, of at most 64.
pub(super) type Lengths = u64;

/// More factors that vanish than so many are not counted.
const COUNTED: usize = 8;

/// A length, and where it stands in a program.
pub(super) struct Length {
    /// r.
    pub(super) root: Value,
    /// What r² is a sum of squares of.
    pub(super) small: Vec<Value>,
    /// What is divided by, with the power of r in it.
    pub(super) divisors: BTreeMap<Value, usize>,
}

/// What is known of the size of a value.
#[derive(Clone, Default)]
struct Order {
    /// A factor for each entry: it is at most a number times any of these lengths.
    factors: Vec<Lengths>,
    /// The lengths that are divided by.
    over: Vec<usize>,
    /// The lengths on which it depends that the value does not go on continuously to where these vanish, or has another one
    /// there if `1/r` has.
    open: Lengths,
    /// Whether even that is not known.
    is_unknown: bool,
}

impl Order {
    fn unknown(by: Lengths) -> Self {
        Self { open: by, is_unknown: true, ..Self::default() }
    }

    /// The lengths with which it vanishes.
    fn vanishes_with(&self) -> Lengths {
        self.factors.iter().fold(0, |all, lengths| all | lengths)
    }

    fn is_plain(&self) -> bool {
        self.open == 0 && !self.is_unknown
    }

    /// What divides is set against factors that are smaller. What is left of these makes the product 0 where their
    /// lengths vanish, whatever `1/r` is there.
    fn settled(mut self) -> Self {
        let mut left = Vec::new();
        for length in std::mem::take(&mut self.over) {
            self.open |= 1 << length;
            let fits = |(_, lengths): &(usize, &Lengths)| **lengths >> length & 1 == 1;
            let factors = self.factors.iter().enumerate();
            match factors.filter(fits).min_by_key(|(_, lengths)| lengths.count_ones()) {
                Some((place, _)) => _ = self.factors.swap_remove(place),
                None => left.push(length),
            }
        }
        self.over = left;
        if self.over.is_empty() && !self.is_unknown {
            self.open &= !self.vanishes_with();
        }
        self
    }

    fn times(&self, other: &Self) -> Self {
        let mut factors = [self.factors.as_slice(), &other.factors].concat();
        factors.truncate(COUNTED);
        let over = [self.over.as_slice(), &other.over].concat();
        let is_unknown = self.is_unknown || other.is_unknown;
        Self { factors, over, open: self.open | other.open, is_unknown }.settled()
    }

    fn plus(&self, other: &Self) -> Self {
        let mut left = other.factors.clone();
        let mut factors = Vec::new();
        for lengths in &self.factors {
            let common = left.iter().map(|other| lengths & other).enumerate();
            if let Some((place, common)) = common.max_by_key(|(_, common)| common.count_ones())
                && common != 0
            {
                left.swap_remove(place);
                factors.push(common);
            }
        }
        let mut over = self.over.clone();
        let mut counted = self.over.clone();
        for length in &other.over {
            match counted.iter().position(|known| known == length) {
                Some(place) => _ = counted.swap_remove(place),
                None => over.push(*length),
            }
        }
        let is_unknown = self.is_unknown || other.is_unknown;
        Self { factors, over, open: self.open | other.open, is_unknown }
    }
}

/// What is known of the results where lengths vanish.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limits {
    /// Nothing: that they go on continuously is to be proved.
    Open,
    /// Terms with 1/r tend to 0, all together: each of them is to be 0 there.
    WithoutQuotients,
}

/// The lengths of some without which all outputs of a program have the values that they tend to where the others vanish,
/// whatever quotients by what vanishes with these are there.
pub(super) fn without_values(
    program: &Program,
    lengths: &[Length],
    (asked, limits): (Lengths, Limits),
) -> Lengths {
    let mut orders: Table<Value, Order> = Table::new();
    for (value, step) in program.steps.iter_ids() {
        let mut order = order(step, lengths, asked, &orders);
        for (place, length) in lengths.iter().enumerate().filter(|(place, _)| asked >> place & 1 == 1) {
            let this = 1 << place;
            if value == length.root && limits == Limits::WithoutQuotients {
                // r over r is 1 and not 0
                order.factors.iter_mut().for_each(|factor| *factor &= !this);
                order.factors.retain(|factor| *factor != 0);
            } else if value == length.root || length.small.contains(&value) {
                match order.factors.first_mut() {
                    Some(first) => *first |= this,
                    None => order.factors.push(this),
                }
            }
        }
        orders.push(order);
    }
    program.outputs.iter().fold(0, |without, output| {
        let order = &orders[*output];
        let open = match limits {
            _ if order.is_unknown && order.open == 0 => asked,
            Limits::WithoutQuotients if !order.is_unknown => {
                order.over.iter().fold(0, |all, length| all | 1 << length)
            }
            _ => order.open,
        };
        without | open
    })
}

fn order(step: &Step, lengths: &[Length], asked: Lengths, orders: &Table<Value, Order>) -> Order {
    let over = |dividend: &Order, divisor: Value| {
        let mut quotient = dividend.clone();
        let mut is_counted = false;
        for (place, length) in lengths.iter().enumerate().filter(|(place, _)| asked >> place & 1 == 1) {
            if let Some(power) = length.divisors.get(&divisor) {
                quotient.over.extend(std::iter::repeat_n(place, *power));
                is_counted = true;
            }
        }
        let by = &orders[divisor];
        if is_counted {
            return quotient.settled();
        }
        if by.is_plain() && by.factors.is_empty() {
            return quotient;
        }
        Order::unknown(dividend.open | by.open | by.vanishes_with())
    };
    match step {
        Step::Constant(_) | Step::Pi | Step::Load(_) => Order::default(),
        Step::Add(a, b) | Step::Sub(a, b) => orders[*a].plus(&orders[*b]),
        Step::Mul(a, b) => orders[*a].times(&orders[*b]),
        Step::MulAdd { a, b, c, .. } => orders[*a].times(&orders[*b]).plus(&orders[*c]),
        Step::Neg(a) | Step::Apply(Function::Abs, a) => orders[*a].clone(),
        Step::Div(a, b) => over(&orders[*a], *b),
        Step::Recip(b) => over(&Order::default(), *b),
        Step::Sqrt(a) if orders[*a].is_plain() => {
            // a square is at most that of either of two factors
            let pairs = orders[*a].factors.chunks_exact(2);
            let factors =
                pairs.filter_map(|pair| Some(pair[0] & pair[1]).filter(|both| *both != 0)).collect();
            Order { factors, ..Order::default() }
        }
        Step::Solve { matrix, right } => {
            let entries = matrix.iter().flatten();
            let not_plain = entries.filter(|entry| !orders[**entry].is_plain());
            if let Some(open) = not_plain.map(|entry| orders[*entry].open).reduce(|a, b| a | b) {
                return Order::unknown(open);
            }
            let sums = right.iter().map(|value| orders[*value].clone());
            sums.reduce(|sum, other| sum.plus(&other)).unwrap_or_default()
        }
        Step::Component(system, _) => orders[*system].clone(),
        _ => {
            // signs and angles jump where their arguments vanish
            let jumps = matches!(step, Step::Apply(Function::Sign, _) | Step::Apply2(Function2::Atan2, ..));
            let mut open = 0;
            let mut is_plain = true;
            step.each_operand(|operand| {
                let order = &orders[operand];
                open |= order.open;
                is_plain &= order.is_plain();
                if jumps {
                    open |= order.vanishes_with();
                    is_plain &= order.factors.is_empty();
                }
            });
            if is_plain { Order::default() } else { Order::unknown(open) }
        }
    }
}
