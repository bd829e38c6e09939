//! Linear equations over ℚ, taken up one after the other.

use std::collections::BTreeMap;

use super::form::{Form, Unknown};
use crate::algebra::Rational;

/// How often each equation enters a combination of them.
type Combination = BTreeMap<usize, Rational>;

/// What an equation says beside those before it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Taken {
    /// Something new.
    New,
    /// What they say.
    Known,
    /// The opposite: of these equations, itself among them, none can be left out.
    Contradiction(Vec<usize>),
}

/// An equation solved for an unknown: `form = 1`, with exponent 1 at its pivot.
#[derive(Clone, Debug)]
struct Row {
    form: Form,
    combination: Combination,
}

/// Independent equations, each solved for an unknown that no other contains.
#[derive(Clone, Debug, Default)]
pub(super) struct Elimination {
    rows: BTreeMap<Unknown, Row>,
}

impl Elimination {
    /// Takes up the equation `form = 1`. One that contradicts those before it is left out.
    pub(super) fn take(&mut self, number: usize, form: Form) -> Taken {
        let (form, mut combination) = self.reduced_with(form, [(number, Rational::ONE)].into());
        let Some((pivot, exponent)) = form.unknowns.iter().next() else {
            // left sides of independent equations and this one: a circuit, which holds no smaller one
            return if form.known.is_none() {
                Taken::Known
            } else {
                Taken::Contradiction(combination.into_keys().collect())
            };
        };
        let (pivot, inverse) = (pivot.clone(), exponent.recip().unwrap_or(Rational::ONE));
        let form = Form::none().times(&form, &inverse);
        for weight in combination.values_mut() {
            *weight = weight.clone() * inverse.clone();
        }
        for row in self.rows.values_mut() {
            if let Some(exponent) = row.form.unknowns.get(&pivot).cloned() {
                row.form = std::mem::take(&mut row.form).times(&form, &-exponent.clone());
                subtract(&mut row.combination, &combination, &exponent);
            }
        }
        self.rows.insert(pivot, Row { form, combination });
        Taken::New
    }

    /// A dimension in terms of as few unknowns as the equations allow.
    pub(super) fn reduced(&self, form: &Form) -> Form {
        self.reduced_with(form.clone(), Combination::new()).0
    }

    fn reduced_with(&self, mut form: Form, mut combination: Combination) -> (Form, Combination) {
        let solved: Vec<(&Row, Rational)> = form
            .unknowns
            .iter()
            .filter_map(|(unknown, exponent)| Some((self.rows.get(unknown)?, exponent.clone())))
            .collect();
        // no row contains the pivot of another
        for (row, exponent) in solved {
            form = form.times(&row.form, &-exponent.clone());
            subtract(&mut combination, &row.combination, &exponent);
        }
        (form, combination)
    }
}

/// `from − factor · other`
fn subtract(from: &mut Combination, other: &Combination, factor: &Rational) {
    for (number, weight) in other {
        let left = from.get(number).cloned().unwrap_or(Rational::ZERO) - weight.clone() * factor.clone();
        if left.is_zero() {
            from.remove(number);
        } else {
            from.insert(*number, left);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::id::{Id, SymbolId};
    use crate::units::Dimension;

    fn x(k: usize) -> Form {
        Form::of(Unknown::Symbol(SymbolId::from_index(k)))
    }

    fn unit(name: &str) -> Form {
        Form::known(Dimension::named(name).unwrap())
    }

    #[test]
    fn what_follows_is_known_and_what_cannot_be_is_shown() {
        let mut equations = Elimination::default();
        assert_eq!(equations.take(0, x(0).over(&unit("m"))), Taken::New);
        assert_eq!(equations.take(1, x(1).over(&x(0))), Taken::New);
        // nothing of this enters the contradiction
        assert_eq!(equations.take(2, x(5).over(&x(6))), Taken::New);
        assert_eq!(equations.take(3, x(2).by(&x(1)).over(&unit("J"))), Taken::New);
        assert_eq!(equations.take(4, x(2).over(&unit("N"))), Taken::Known);
        assert_eq!(equations.reduced(&x(2)).value(), Some(&Dimension::named("N").unwrap()));
        assert_eq!(equations.take(5, x(2).over(&unit("Pa"))), Taken::Contradiction(vec![0, 1, 3, 5]));
        assert_eq!(equations.reduced(&x(6)).value(), None);
    }

    #[test]
    fn leaving_one_out_removes_the_contradiction() {
        let all = [
            x(0).by(&x(1)).over(&unit("J")),
            x(1).by(&x(2)).over(&unit("N")),
            x(0).over(&x(2)).over(&unit("s")),
            x(3).over(&x(0)),
        ];
        let contradiction = |left_out: usize| {
            let mut equations = Elimination::default();
            let taken: Vec<_> = (0..all.len())
                .filter(|k| *k != left_out)
                .map(|k| equations.take(k, all[k].clone()))
                .collect();
            taken.into_iter().find(|taken| matches!(taken, Taken::Contradiction(_)))
        };
        assert_eq!(contradiction(usize::MAX), Some(Taken::Contradiction(vec![0, 1, 2])));
        assert!((0..3).all(|k| contradiction(k).is_none()));
        assert_eq!(contradiction(3), Some(Taken::Contradiction(vec![0, 1, 2])));
    }
}
