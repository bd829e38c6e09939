//! Functions on an embedded base that depend on some of its coordinates alone: rows of a rotation matrix,
//! the height on a sphere.
//!
//! The coordinates that are left project the base; what does not change along the fibres is a function of them,
//! which is written as a polynomial where it is one, modulo the identities of the base.

use super::manifold::Manifold;
use crate::algebra::{Echelon, FieldPoint, Graph, Matrix, Node, Rational, Residue, Substitution};
use crate::id::{ExprId, Id, SymbolId};

/// Polynomials of a higher degree are not tried.
const DEGREE: usize = 4;
/// More monomials are not tried.
const MONOMIALS: usize = 60;
/// Expressions with more parts are not taken apart.
const PARTS: usize = 200;

/// The projection of a base to the coordinates that are left, as far as these are embedded together with some
/// that are not.
#[derive(Clone, Debug)]
pub struct Fibres<'a> {
    base: &'a Manifold,
    /// The embedded coordinates that are left, with their images.
    left: Vec<(SymbolId, ExprId)>,
    /// What parametrises the base.
    parameters: Vec<SymbolId>,
}

impl<'a> Fibres<'a> {
    /// Without the coordinates of `group`; `None` where these are embedded on their own.
    pub fn of(graph: &Graph, base: &'a Manifold, group: &[SymbolId]) -> Option<Self> {
        let (inside, left): (Vec<_>, Vec<_>) =
            base.images.iter().copied().partition(|(symbol, _)| group.contains(symbol));
        let images: Vec<ExprId> = inside.iter().map(|(_, image)| *image).collect();
        let shared = graph.symbols_in(&images);
        let left: Vec<(SymbolId, ExprId)> =
            left.into_iter().filter(|(_, image)| graph.depends_on(*image, &shared)).collect();
        let all: Vec<ExprId> = images.into_iter().chain(left.iter().map(|(_, image)| *image)).collect();
        let parameters = graph.symbols_in(&all);
        let in_chart = parameters.iter().all(|symbol| base.chart.contains(symbol));
        (!inside.is_empty() && !left.is_empty() && in_chart).then_some(Self { base, left, parameters })
    }

    /// Whether a function does not change along the fibres: its differential is a combination of those of the
    /// coordinates that are left, at random points. Coordinates of `group` may be free as well.
    pub fn is_constant(&self, graph: &mut Graph, function: ExprId, group: &[SymbolId]) -> bool {
        let free = group.iter().copied().filter(|symbol| self.base.is_free(*symbol));
        let along: Vec<SymbolId> = self.parameters.iter().copied().chain(free).collect();
        let mut rows: Matrix = Vec::with_capacity(self.left.len() + 1);
        let function = self.base.restrict(graph, function);
        for image in self.left.iter().map(|(_, image)| *image).chain([function]) {
            rows.push(along.iter().map(|symbol| graph.partial(image, *symbol)).collect());
        }
        match (graph.generic_rank(&rows[..self.left.len()]), graph.generic_rank(&rows)) {
            (Ok(projection), Ok(with_function)) => projection == with_function,
            _ => false,
        }
    }

    /// The function by the coordinates that are left; `None` where no such expression was found.
    pub fn expressed(&self, graph: &mut Graph, function: ExprId, group: &[SymbolId]) -> Option<ExprId> {
        let mut parts = PARTS;
        let found = self.part(graph, function, group, &mut parts)?;
        let difference = graph.formula(function - found);
        self.base.zero_test(graph, difference).is_zero().then_some(found)
    }

    fn part(
        &self,
        graph: &mut Graph,
        function: ExprId,
        group: &[SymbolId],
        parts: &mut usize,
    ) -> Option<ExprId> {
        if !graph.depends_on(function, group) {
            return Some(function);
        }
        *parts = parts.checked_sub(1)?;
        if !self.is_constant(graph, function, group) {
            return None;
        }
        if let Some(polynomial) = self.polynomial(graph, function, group) {
            return Some(polynomial);
        }
        match graph.node(function).clone() {
            Node::Apply(outer, argument) => {
                let argument = self.part(graph, argument, group, parts)?;
                Some(graph.apply(outer, argument))
            }
            Node::Product { coefficient, factors } => {
                let mut found = Vec::new();
                for (base, exponent) in factors.iter() {
                    found.push((self.part(graph, *base, group, parts)?, exponent.clone()));
                }
                let product = graph.product(&found);
                Some(graph.scale(coefficient, product))
            }
            Node::Sum { .. } => {
                // what is invariant term by term, and the rest together
                let (constant, terms) = graph.as_linear(function);
                let constant = graph.number(constant);
                let (mut found, mut rest) = (vec![(Rational::ONE, constant)], Vec::new());
                for (term, coefficient) in terms {
                    match self.part(graph, term, group, parts) {
                        Some(part) => found.push((coefficient, part)),
                        None => rest.push((coefficient, term)),
                    }
                }
                if !rest.is_empty() {
                    let rest = graph.linear_combination(&rest);
                    found.push((Rational::ONE, self.polynomial(graph, rest, group)?));
                }
                Some(graph.linear_combination(&found))
            }
            _ => None,
        }
    }

    /// As a polynomial of least degree, with coefficients that do not depend on the embedded coordinates: these
    /// follow from values at places of the base, and the result is proved.
    fn polynomial(&self, graph: &mut Graph, function: ExprId, group: &[SymbolId]) -> Option<ExprId> {
        for degree in 0..=DEGREE {
            let (monomials, places) = self.monomials(graph, degree, group)?;
            let matrix: Matrix = places
                .iter()
                .map(|place| monomials.iter().map(|monomial| at(graph, place, *monomial)).collect())
                .collect();
            let values: Matrix = places.iter().map(|place| vec![at(graph, place, function)]).collect();
            if values.iter().flatten().any(|value| graph.is_undefined(*value)) {
                return None;
            }
            let Some(solution) = graph.solve_linear(&matrix, &values) else { continue };
            let mut terms = Vec::new();
            for (row, monomial) in solution.values.iter().zip(&monomials) {
                let coefficient = graph.simplify(row[0]);
                terms.push(graph.formula(coefficient * monomial));
            }
            let found = graph.sum(&terms);
            let found = graph.simplify(found);
            let difference = graph.formula(function - found);
            if self.base.zero_test(graph, difference).is_zero() {
                return Some(found);
            }
        }
        None
    }

    /// Monomials that are independent on the base, and as many places there at which they are.
    fn monomials(
        &self,
        graph: &mut Graph,
        degree: usize,
        group: &[SymbolId],
    ) -> Option<(Vec<ExprId>, Vec<Substitution>)> {
        let all = products(graph, &self.symbols(), degree);
        if all.len() > MONOMIALS {
            return None;
        }
        let images = self.base.restrict_matrix(graph, std::slice::from_ref(&all)).concat();
        let independent = independent_functions(graph, &images)?;
        let monomials: Vec<ExprId> = independent.into_iter().map(|index| all[index]).collect();
        // places with rational coordinates
        let mut places: Vec<Substitution> = Vec::new();
        let mut rows: Vec<Vec<Residue>> = Vec::new();
        for number in 0..(8 * monomials.len() as u64 + 8) {
            let place = self.place(graph, number, group);
            let row: Vec<ExprId> = monomials.iter().map(|monomial| at(graph, &place, *monomial)).collect();
            let Ok(row) = graph.evaluate_in_field(&row, &FieldPoint::random(1)) else { continue };
            rows.push(row);
            if Echelon::of(rows.clone()).rank() == rows.len() {
                places.push(place);
            } else {
                rows.pop();
            }
            if places.len() == monomials.len() {
                return Some((monomials, places));
            }
        }
        None
    }

    /// The embedded coordinates that are left.
    #[must_use]
    pub fn symbols(&self) -> Vec<SymbolId> {
        self.left.iter().map(|(symbol, _)| *symbol).collect()
    }

    /// A point of the base: small rational numbers for the parameters and free coordinates of the group.
    fn place(&self, graph: &mut Graph, number: u64, group: &[SymbolId]) -> Substitution {
        let mut parameters = Substitution::new([]);
        for symbol in &self.parameters {
            let word = Residue::mixed(31_000 + number, symbol.index() as u64).word();
            let (n, d) =
                (i64::try_from(word % 7).unwrap_or(0) - 3, i64::try_from(word / 7 % 2).unwrap_or(0) + 1);
            let value = graph.number(Rational::new(n, d));
            parameters.insert(*symbol, value);
        }
        let mut images: Vec<(SymbolId, ExprId)> = Vec::new();
        for (symbol, image) in self.base.images.clone() {
            let image = parameters.apply(graph, image);
            images.push((symbol, graph.simplify(image)));
        }
        let zero = graph.zero();
        images
            .extend(group.iter().filter(|symbol| self.base.is_free(**symbol)).map(|symbol| (*symbol, zero)));
        Substitution::new(images)
    }

    /// The identities between the coordinates that are left, of degree two: all that there are, if the
    /// dimension of what they describe says so.
    pub fn identities(&self, graph: &mut Graph) -> Option<Vec<ExprId>> {
        let symbols = self.symbols();
        let all = products(graph, &symbols, 2);
        let images = self.base.restrict_matrix(graph, std::slice::from_ref(&all)).concat();
        let independent = independent_functions(graph, &images)?;
        let mut identities = Vec::new();
        for (index, monomial) in all.iter().enumerate().filter(|(index, _)| !independent.contains(index)) {
            let matrix: Vec<usize> = independent.iter().copied().chain([index]).collect();
            let weights = dependence(graph, &matrix.iter().map(|k| images[*k]).collect::<Vec<_>>())?;
            let terms: Vec<(Rational, ExprId)> = weights
                .into_iter()
                .zip(&independent)
                .map(|(weight, k)| (-weight, all[*k]))
                .chain([(Rational::ONE, *monomial)])
                .collect();
            let identity = graph.linear_combination(&terms);
            if !self.base.zero_test(graph, identity).is_zero() {
                return None;
            }
            identities.push(identity);
        }
        let mut slopes = Matrix::new();
        for identity in &identities {
            slopes.push(symbols.iter().map(|symbol| graph.partial(*identity, *symbol)).collect());
        }
        let slopes = self.base.restrict_matrix(graph, &slopes);
        let dimension = self.base.dimension_of(graph, &symbols).ok()?;
        let described = symbols.len() - graph.generic_rank(&slopes).ok()?;
        (described == dimension).then_some(identities)
    }
}

/// A function at a place, simplified.
fn at(graph: &mut Graph, place: &Substitution, function: ExprId) -> ExprId {
    let value = place.clone().apply(graph, function);
    graph.simplify(value)
}

/// Products of at most `degree` of the symbols.
fn products(graph: &mut Graph, symbols: &[SymbolId], degree: usize) -> Vec<ExprId> {
    let mut found = vec![(graph.one(), 0)];
    let mut last = found.clone();
    for _ in 0..degree {
        let mut next = Vec::new();
        for (product, first) in last {
            for (index, symbol) in symbols.iter().enumerate().skip(first) {
                let symbol = graph.symbol(*symbol);
                next.push((graph.formula(product * symbol), index));
            }
        }
        found.extend(next.iter().copied());
        last = next;
    }
    found.into_iter().map(|(product, _)| product).collect()
}

/// Values of functions at random points of the field, a row for each point.
fn sampled(graph: &Graph, functions: &[ExprId], start: u64) -> Option<Vec<Vec<Residue>>> {
    let mut rows = Vec::new();
    let mut seed = start;
    while rows.len() < functions.len() + 3 {
        seed += 1;
        if seed > start + 4 * functions.len() as u64 + 40 {
            return None;
        }
        rows.extend(graph.evaluate_in_field(functions, &FieldPoint::random(seed)).ok());
    }
    Some(rows)
}

/// The first functions of which the others are combinations with constant coefficients.
fn independent_functions(graph: &Graph, functions: &[ExprId]) -> Option<Vec<usize>> {
    Some(Echelon::of(sampled(graph, functions, 32_000)?).pivots)
}

/// The constant coefficients of the last function in the others, where they are rational numbers.
fn dependence(graph: &Graph, functions: &[ExprId]) -> Option<Vec<Rational>> {
    let rows = sampled(graph, functions, 33_000)?;
    let solution = Echelon::of(rows).solution(functions.len() - 1)?;
    solution.into_iter().map(Residue::recognised).collect()
}
