//! Velocities among which the other ones are sparse: absolute rates of turning in place of relative ones.
//!
//! Let ω = Σ c_α y^α have numbers for coefficients: the rate of an angle that a sine is taken of, or a velocity that the
//! Lagrangian is written in. In place of one of the y^α that occur in it, and in no rate before, it is an unknown as
//! good as that: the change of velocities is triangular and has numbers for coefficients.

use crate::algebra::{Graph, Rational};
use crate::id::ExprId;
use crate::limits;
use std::collections::BTreeMap;

/// Σ number · quantity.
pub(super) type Combination = Vec<(usize, Rational)>;

/// An unknown for every quasi-velocity y^α, in an order in which each is given by those before it.
#[derive(Clone, Debug)]
pub(super) struct Rates {
    /// The quasi-velocities in whose place the unknowns stand, in the order of the unknowns.
    pub(super) sections: Vec<usize>,
    /// Each unknown as y^α, and a combination of quasi-velocities and of unknowns before it.
    pub(super) made_of: Vec<Vec<(Quantity, Rational)>>,
    /// y^α by unknowns.
    pub(super) velocities: Vec<Combination>,
}

/// What an unknown is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Quantity {
    /// y^α.
    Velocity(usize),
    /// Another unknown.
    Unknown(usize),
}

impl Rates {
    /// `fixed` velocities come first, and stay as they are. Of the rows in several lists those of the first list are
    /// preferred.
    pub(super) fn of(rank: usize, fixed: &[usize], lists: [Vec<Combination>; 2]) -> Self {
        let mut rates = Self {
            sections: Vec::with_capacity(rank),
            made_of: Vec::with_capacity(rank),
            velocities: vec![Vec::new(); rank],
        };
        for section in fixed {
            rates.keep(*section);
        }
        let mut known: Vec<(usize, Combination)> = Vec::new();
        // those of the fewest velocities first
        let sorted = |mut rows: Vec<Combination>| {
            rows.sort_by_key(Vec::len);
            rows
        };
        for row in lists.into_iter().flat_map(sorted) {
            let new: Vec<usize> =
                row.iter().map(|(section, _)| *section).filter(|s| !rates.sections.contains(s)).collect();
            let Some((last, others)) = new.split_last() else { continue };
            for section in others {
                rates.keep(*section);
            }
            if row.len() == 1 {
                rates.keep(*last);
                continue;
            }
            rates.replace(*last, &row, &known);
            known.push((rates.sections.len() - 1, row));
        }
        for section in 0..rank {
            if !rates.sections.contains(&section) {
                rates.keep(section);
            }
        }
        rates
    }

    fn keep(&mut self, section: usize) {
        self.velocities[section] = vec![(self.sections.len(), Rational::ONE)];
        self.sections.push(section);
        self.made_of.push(vec![(Quantity::Velocity(section), Rational::ONE)]);
    }

    /// An unknown ω in place of a velocity: from the rate before it that is most like it.
    fn replace(&mut self, section: usize, row: &[(usize, Rational)], known: &[(usize, Combination)]) {
        let nearest = known.iter().map(|(unknown, other)| (distance(row, other), *unknown, other)).min();
        let nearest = nearest.filter(|(distance, ..)| distance + 1 < row.len() || *distance == 1);
        let base = nearest.map(|(_, unknown, _)| unknown);
        let rest = nearest.map_or_else(|| row.to_vec(), |(_, _, other)| difference(row, other));
        let mut made_of: Vec<(Quantity, Rational)> =
            base.iter().map(|unknown| (Quantity::Unknown(*unknown), Rational::ONE)).collect();
        made_of.extend(rest.iter().map(|(s, c)| (Quantity::Velocity(*s), c.clone())));
        // y = (ω − base − Σ c y) / c
        let unknown = self.sections.len();
        let mut solved: Combination = vec![(unknown, Rational::ONE)];
        let subtract = |solved: &mut Combination, index: usize, value: Rational| match solved
            .iter_mut()
            .find(|(other, _)| *other == index)
        {
            Some((_, known)) => *known = known.clone() - value,
            None => solved.push((index, -value)),
        };
        if let Some(base) = base {
            subtract(&mut solved, base, Rational::ONE);
        }
        let pivot = rest.iter().find(|(s, _)| *s == section).and_then(|(_, c)| c.recip());
        let Some(inverse) = pivot else { return self.keep(section) };
        for (s, c) in rest.iter().filter(|(s, _)| *s != section) {
            for (index, coefficient) in self.velocities[*s].clone() {
                subtract(&mut solved, index, c.clone() * coefficient);
            }
        }
        solved.retain(|(_, c)| !c.is_zero());
        for (_, coefficient) in &mut solved {
            *coefficient = coefficient.clone() * inverse.clone();
        }
        self.velocities[section] = solved;
        self.sections.push(section);
        self.made_of.push(made_of);
    }

    /// A row of coefficients of velocities as one of coefficients of unknowns.
    pub(super) fn changed(&self, graph: &mut Graph, row: &[ExprId]) -> Vec<ExprId> {
        let mut terms: Vec<Vec<(Rational, ExprId)>> = vec![Vec::new(); self.sections.len()];
        for (section, coefficient) in row.iter().enumerate() {
            if graph.is_literal_zero(*coefficient) {
                continue;
            }
            for (unknown, number) in &self.velocities[section] {
                terms[*unknown].push((number.clone(), *coefficient));
            }
        }
        terms.iter().map(|terms| graph.linear_combination(terms)).collect()
    }
}

/// In how many entries two rows differ; their sections ascend.
fn distance(one: &[(usize, Rational)], other: &[(usize, Rational)]) -> usize {
    limits::spend((one.len() + other.len()) / 16);
    let (mut left, mut right, mut differing) = (one.iter().peekable(), other.iter().peekable(), 0);
    while let (Some((s, c)), Some((t, d))) = (left.peek(), right.peek()) {
        differing += usize::from(s != t || c != d);
        let order = s.cmp(t);
        if order.is_le() {
            left.next();
        }
        if order.is_ge() {
            right.next();
        }
    }
    differing + left.count() + right.count()
}

/// A row less another one.
fn difference(one: &[(usize, Rational)], other: &[(usize, Rational)]) -> Combination {
    let mut rest: BTreeMap<usize, Rational> = one.iter().cloned().collect();
    for (section, number) in other {
        let entry = rest.entry(*section).or_insert(Rational::ZERO);
        *entry = entry.clone() - number.clone();
    }
    rest.into_iter().filter(|(_, number)| !number.is_zero()).collect()
}
