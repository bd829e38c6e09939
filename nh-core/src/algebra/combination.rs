//! Multiples of inequalities that add up to a contradiction, with the help of squares and of products.

use super::bounded_terms::Bounding;
use super::graph::Graph;
use super::inequalities::{Contradiction, Demand, Known};
use super::node::Node;
use super::number::Rational;
use super::polynomial_terms::{Monomial, Terms, multiplied, product_of, squares_inside};
use super::simplex::{Inequality, contradiction};
use crate::id::ExprId;
use std::collections::BTreeSet;

/// Variables of which the squares of sums and differences are used.
const VARIABLES: usize = 6;
/// Terms of a polynomial that is completed to squares.
const COMPLETED: usize = 20;

/// Where a polynomial that is not negative comes from.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Source {
    /// The demand of this index.
    Demand(usize),
    /// A square of a polynomial.
    Square,
    /// What holds of functions, or a product of others.
    Other,
}

impl Source {
    fn is_demand(self) -> bool {
        matches!(self, Self::Demand(_))
    }
}

/// A polynomial that is not negative, or positive, with the sign that it has in what it comes from.
type Row = (Source, Rational, Terms, bool);

impl Graph {
    /// Multiples of the demands that add up to a contradiction.
    pub(super) fn combination(
        &self,
        demands: &[(ExprId, Demand)],
        intervals: &Known,
    ) -> Option<Contradiction> {
        let declared: Option<Vec<Terms>> = demands.iter().map(|(id, _)| self.polynomial_terms(*id)).collect();
        let declared = declared?;
        let polynomials: Option<Vec<Terms>> =
            declared.iter().map(|polynomial| self.without_denominators(polynomial.clone())).collect();
        let polynomials = polynomials?;
        // all monomials are 0 where symbols are
        let has_symbol = |monomial: &Monomial| {
            monomial.is_empty()
                || monomial.iter().any(|(part, e)| !e.is_negative() && self.as_symbol(*part).is_some())
        };
        let met = |(polynomial, (_, demand)): (&Terms, &(ExprId, Demand))| {
            is_met_by_constant(polynomial, *demand) && polynomial.keys().all(has_symbol)
        };
        if polynomials.iter().zip(demands).all(met)
            || self.are_met_at_a_corner(&polynomials, demands)
            || self.are_met_at_a_regular_point(demands)
        {
            return None;
        }
        let demanded: Vec<Demand> = demands.iter().map(|(_, demand)| *demand).collect();
        if let Some(found) = self.refuted_polynomials(&polynomials, &demanded, intervals) {
            return Some(if polynomials == declared { found } else { Contradiction::Together });
        }
        let solved = self.with_equations_solved(&polynomials, demanded.iter().copied(), intervals)?;
        let (polynomials, demanded): (Vec<Terms>, Vec<Demand>) = solved.into_iter().unzip();
        self.refuted_polynomials(&polynomials, &demanded, intervals).map(|_| Contradiction::Together)
    }

    /// Multiples of polynomials that add up to a contradiction.
    fn refuted_polynomials(
        &self,
        polynomials: &[Terms],
        demands: &[Demand],
        intervals: &Known,
    ) -> Option<Contradiction> {
        let known = self.known_of_functions(polynomials);
        let own = polynomials.iter().zip(demands.iter().copied());
        let all = known.iter().map(|(polynomial, demand)| (polynomial, *demand)).chain(own);
        if all.into_iter().all(|(polynomial, demand)| is_met_by_constant(polynomial, demand)) {
            return None;
        }
        let mut rows: Vec<Row> = Vec::new();
        for (index, (polynomial, demand)) in polynomials.iter().zip(demands).enumerate() {
            match demand {
                Demand::Positive => {
                    rows.push((Source::Demand(index), Rational::ONE, polynomial.clone(), true));
                }
                Demand::NotNegative => {
                    rows.push((Source::Demand(index), Rational::ONE, polynomial.clone(), false));
                }
                Demand::Zero => {
                    rows.push((Source::Demand(index), Rational::ONE, polynomial.clone(), false));
                    rows.push((Source::Demand(index), Rational::MINUS_ONE, negative(polynomial), false));
                }
                Demand::Nonzero => {}
            }
        }
        for (polynomial, demand) in &known {
            rows.push((Source::Other, Rational::ONE, polynomial.clone(), *demand == Demand::Positive));
            if *demand == Demand::Zero {
                rows.push((Source::Other, Rational::ONE, negative(polynomial), false));
            }
        }
        let with_known: Vec<Terms> =
            polynomials.iter().chain(known.iter().map(|(polynomial, _)| polynomial)).cloned().collect();
        let as_rows = |squares: Vec<Terms>| -> Vec<Row> {
            squares.into_iter().map(|square| (Source::Square, Rational::ONE, square, false)).collect()
        };
        rows.extend(as_rows(squares(&with_known)));
        let by_products = |rows: &[Row]| refuted(rows).or_else(|| refuted(&with_products(rows)));
        let completed = || {
            let short = polynomials.iter().filter(|polynomial| polynomial.len() <= COMPLETED);
            let completed = as_rows(short.flat_map(squares_inside).collect());
            if completed.is_empty() { None } else { by_products(&[rows.clone(), completed].concat()) }
        };
        let found = by_products(&rows).or_else(completed).or_else(|| {
            // what is between 0 and 0 is 0
            let unequal = demands.iter().enumerate().filter(|(_, demand)| **demand == Demand::Nonzero);
            unequal.into_iter().find_map(|(index, _)| {
                let with = |polynomial: Terms| {
                    let mut rows = rows.clone();
                    rows.push((Source::Demand(index), Rational::ONE, polynomial, true));
                    refuted(&rows)
                };
                with(polynomials[index].clone()).and(with(negative(&polynomials[index])))?;
                Some(Contradiction::Together)
            })
        });
        found.or_else(|| self.refuted_by_bounds(polynomials, demands, intervals))
    }

    /// The same of what demands say where functions have their extreme values.
    fn refuted_by_bounds(
        &self,
        polynomials: &[Terms],
        demands: &[Demand],
        known: &Known,
    ) -> Option<Contradiction> {
        let demanded: Vec<(&Terms, Demand)> = polynomials.iter().zip(demands.iter().copied()).collect();
        let bounding = Bounding { graph: self, known, demands: &demanded };
        let consequences = bounding.consequences();
        if consequences.is_empty() {
            return None;
        }
        let is_function = |part: &ExprId| matches!(self.node(*part), Node::Apply(..));
        let has_functions =
            |polynomial: &Terms| polynomial.keys().flatten().any(|(part, _)| is_function(part));
        let as_they_are =
            demanded.iter().enumerate().filter(|(_, (polynomial, _))| !has_functions(polynomial));
        let as_they_are =
            as_they_are.map(|(index, (polynomial, demand))| (index, (*polynomial).clone(), *demand));
        let mut rows: Vec<Row> = Vec::new();
        for (index, polynomial, demand) in as_they_are.chain(consequences) {
            let is_strict = demand == Demand::Positive;
            let is_known =
                rows.iter().any(|(_, _, known, strict)| *known == polynomial && *strict == is_strict);
            if demand == Demand::Nonzero || is_known {
                continue;
            }
            if demand == Demand::Zero {
                rows.push((Source::Demand(index), Rational::MINUS_ONE, negative(&polynomial), false));
            }
            rows.push((Source::Demand(index), Rational::ONE, polynomial, is_strict));
        }
        let all: Vec<Terms> = rows.iter().map(|(_, _, polynomial, _)| polynomial.clone()).collect();
        rows.extend(squares(&all).into_iter().map(|square| (Source::Square, Rational::ONE, square, false)));
        refuted(&rows).or_else(|| refuted(&with_products(&rows))).map(|_| Contradiction::Together)
    }
}

/// What rows with multipliers say of the demands that they come from.
fn explained(rows: &[Row], multipliers: &[Rational]) -> Contradiction {
    let used = || rows.iter().zip(multipliers).filter(|(_, multiplier)| !multiplier.is_zero());
    let demanded = used().filter_map(|((source, sign, ..), multiplier)| match source {
        Source::Demand(index) => Some((*index, sign.clone() * multiplier.clone())),
        _ => None,
    });
    let demanded: Vec<(usize, Rational)> = demanded.collect();
    let has = |wanted: Source| used().any(|((source, ..), _)| *source == wanted);
    match (demanded.as_slice(), has(Source::Square), has(Source::Other)) {
        (_, false, false) => Contradiction::Combination(demanded),
        ([(index, _)], true, false) => Contradiction::NegativeSquares(*index),
        _ => Contradiction::Together,
    }
}

impl Graph {
    /// Whether polynomials in symbols are as demanded where one of these is 1 and the others are 0, or where those are 1
    /// that stand on the diagonal of a square: what spheres and rotations are met by.
    fn are_met_at_a_corner(&self, polynomials: &[Terms], demands: &[(ExprId, Demand)]) -> bool {
        let parts: BTreeSet<ExprId> =
            polynomials.iter().flat_map(|p| p.keys().flatten().map(|(part, _)| *part)).collect();
        let parts: Vec<ExprId> = parts.into_iter().collect();
        let exponents = || polynomials.iter().flat_map(|p| p.keys().flatten().map(|(_, exponent)| exponent));
        if parts.iter().any(|part| self.as_symbol(*part).is_none()) || exponents().any(Rational::is_negative)
        {
            return false;
        }
        let size = parts.len().isqrt();
        let diagonal =
            (size * size == parts.len()).then(|| parts.iter().step_by(size + 1).copied().collect());
        let corners = parts.iter().map(|part| vec![*part]).chain(diagonal);
        corners.into_iter().any(|ones: Vec<ExprId>| {
            polynomials.iter().zip(demands).all(|(polynomial, (_, demand))| {
                let stays = |monomial: &Monomial| monomial.iter().all(|(part, _)| ones.contains(part));
                let kept = polynomial.iter().filter(|(monomial, _)| stays(monomial));
                let value = kept.fold(Rational::ZERO, |sum, (_, coefficient)| sum + coefficient.clone());
                is_met_by_constant(&Terms::from([(Monomial::new(), value)]), *demand)
            })
        })
    }
}

/// Whether a demand is met where all monomials but the constant are 0: where all are, squares and products do not
/// add up to a contradiction.
fn is_met_by_constant(polynomial: &Terms, demand: Demand) -> bool {
    let constant = polynomial.get(&Monomial::new()).cloned().unwrap_or(Rational::ZERO);
    match demand {
        Demand::Positive => !constant.is_zero() && !constant.is_negative(),
        Demand::NotNegative => !constant.is_negative(),
        Demand::Zero => constant.is_zero(),
        Demand::Nonzero => !constant.is_zero(),
    }
}

/// The negative of a polynomial.
pub(super) fn negative(polynomial: &Terms) -> Terms {
    polynomial.iter().map(|(monomial, c)| (monomial.clone(), -c.clone())).collect()
}

/// (x ± y)² and (x ± 1)² for the variables of products and squares, and for what fourth powers are squares of.
fn squares(polynomials: &[Terms]) -> Vec<Terms> {
    let is_square = |m: &&Monomial| {
        m.len() == 2 || m.iter().any(|(_, e)| *e == Rational::from(2) || *e == Rational::from(3))
    };
    let monomials = || polynomials.iter().flat_map(|polynomial| polynomial.keys());
    let variables: BTreeSet<ExprId> =
        monomials().filter(is_square).flatten().map(|(base, _)| *base).collect();
    let half = Rational::new(1, 2);
    let root = |monomial: &Monomial| -> Option<Monomial> {
        let root = monomial.iter().map(|(base, exponent)| (*base, exponent.clone() * half.clone()));
        let root: Monomial = root.collect();
        let is_higher = root.len() > 1 || root.iter().any(|(_, exponent)| !exponent.is_one());
        let is_whole = root.iter().all(|(_, exponent)| exponent.is_integer() && !exponent.is_negative());
        (is_higher && is_whole && !root.is_empty()).then_some(root)
    };
    let mut higher: BTreeSet<Monomial> = monomials().filter_map(root).collect();
    let mixed = higher.iter().flat_map(|a| higher.iter().filter_map(|b| root(&product_of(a, b))));
    higher = mixed.chain(higher.iter().cloned()).collect();
    let one = Monomial::new();
    let variables = variables.into_iter().map(|x| vec![(x, Rational::ONE)]);
    let mut linear: Vec<Monomial> = variables.chain(higher).take(VARIABLES).collect();
    if linear.is_empty() {
        return Vec::new();
    }
    linear.push(one);
    let mut found = Vec::new();
    for (index, x) in linear.iter().enumerate() {
        for y in &linear[..index] {
            for sign in [2, -2] {
                let mut square =
                    Terms::from([(product_of(x, x), Rational::ONE), (product_of(y, y), Rational::ONE)]);
                square.insert(product_of(x, y), sign.into());
                found.push(square);
            }
        }
        if index + 1 < linear.len() {
            found.push(Terms::from([(product_of(x, x), Rational::ONE)]));
        }
    }
    found
}

/// The same with the products of two of them, and of each with squares, as far as these are few.
fn with_products(rows: &[Row]) -> Vec<Row> {
    const FACTORS: usize = 8;
    /// Demands and squares that are multiplied with each other.
    const SQUARED: usize = 3;
    const SQUARES: usize = 24;
    let mut all = rows.to_vec();
    let squares: Vec<&Row> = rows.iter().filter(|(source, ..)| !source.is_demand()).collect();
    let squared = rows.iter().filter(|(source, ..)| source.is_demand());
    if squared.clone().count() <= SQUARED && squares.len() <= SQUARES {
        for ((_, _, one, _), (_, _, square, _)) in
            squared.flat_map(|row| squares.iter().map(move |s| (row, *s)))
        {
            all.extend(multiplied(one, square).map(|product| (Source::Other, Rational::ONE, product, false)));
        }
    }
    let factors: Vec<&Row> = rows.iter().filter(|(source, ..)| source.is_demand()).collect();
    if factors.len() <= FACTORS {
        for (place, (_, _, one, strict)) in factors.iter().enumerate() {
            for (_, _, other, as_strict) in &factors[..=place] {
                let product = multiplied(one, other);
                all.extend(
                    product.map(|product| (Source::Other, Rational::ONE, product, *strict && *as_strict)),
                );
            }
        }
    }
    all
}

/// Why rows refute each other, if multiples of them do.
fn refuted(rows: &[Row]) -> Option<Contradiction> {
    const MONOMIALS: usize = 60;
    let constant = Monomial::new();
    let monomials: BTreeSet<&Monomial> =
        rows.iter().flat_map(|(_, _, polynomial, _)| polynomial.keys()).filter(|m| !m.is_empty()).collect();
    if monomials.len() > MONOMIALS {
        return None;
    }
    let value =
        |polynomial: &Terms, monomial: &Monomial| polynomial.get(monomial).cloned().unwrap_or(Rational::ZERO);
    let inequalities: Vec<Inequality> = rows
        .iter()
        .map(|(_, _, polynomial, strict)| Inequality {
            coefficients: monomials.iter().map(|monomial| value(polynomial, monomial)).collect(),
            constant: value(polynomial, &constant),
            strict: *strict,
        })
        .collect();
    contradiction(&inequalities).map(|multipliers| explained(rows, &multipliers))
}
