//! Functions that do not change along a group, written without the coordinates along it.

use super::fibres::Fibres;
use super::manifold::Manifold;
use crate::algebra::{Graph, Matrix, Rational, Substitution, Verdict};
use crate::id::{ExprId, SymbolId};

/// A factor of a manifold.
#[derive(Clone, Debug)]
pub struct Factor {
    /// Its symbols that are functions of the parameters.
    pub embedding: Vec<(SymbolId, ExprId)>,
    /// What parametrises it, free symbols among them.
    pub parameters: Vec<SymbolId>,
}

impl Manifold {
    /// The dimension of what some of the symbols run through.
    ///
    /// # Errors
    /// The reason, where it cannot be decided.
    pub fn dimension_of(&self, graph: &mut Graph, symbols: &[SymbolId]) -> Result<usize, String> {
        let (free, bound): (Vec<SymbolId>, Vec<SymbolId>) =
            symbols.iter().copied().partition(|symbol| self.is_free(*symbol));
        let bound: Vec<ExprId> = bound.into_iter().map(|symbol| graph.symbol(symbol)).collect();
        let images: Vec<ExprId> = bound.into_iter().map(|symbol| self.restrict(graph, symbol)).collect();
        let mut parameters = graph.symbols_in(&images);
        parameters.retain(|symbol| !free.contains(symbol));
        let mut slopes = Matrix::new();
        for image in images {
            slopes.push(parameters.iter().map(|symbol| graph.partial(image, *symbol)).collect());
        }
        Ok(free.len() + graph.generic_rank(&slopes)?)
    }

    /// Where some of the symbols run through a factor of the manifold, on which no others depend: their
    /// images, and what parametrises it. `None` where they are free, or are no factor.
    #[must_use]
    pub fn factor(&self, graph: &Graph, symbols: &[SymbolId]) -> Option<Factor> {
        let is_inside = |(symbol, _): &&(SymbolId, ExprId)| symbols.contains(symbol);
        let inside: Vec<(SymbolId, ExprId)> = self.images.iter().filter(is_inside).copied().collect();
        let images: Vec<ExprId> = inside.iter().map(|(_, image)| *image).collect();
        let outside: Vec<ExprId> =
            self.images.iter().filter(|image| !is_inside(image)).map(|(_, image)| *image).collect();
        let mut parameters = graph.symbols_in(&images);
        parameters.retain(|symbol| self.chart.contains(symbol));
        parameters.extend(symbols.iter().filter(|symbol| self.is_free(**symbol)));
        let tangled = graph.symbols_in(&outside).iter().any(|symbol| parameters.contains(symbol));
        (!inside.is_empty() && !tangled).then_some(Factor { embedding: inside, parameters })
    }
}

/// A function that changes along a group.
#[derive(Clone, Debug)]
pub struct Varies {
    /// The coordinate along the group, or a parameter of embedded ones.
    pub along: SymbolId,
    /// How.
    pub change: Change,
}

/// How a function changes along a group.
#[derive(Clone, Debug)]
pub enum Change {
    /// Its derivative is not zero, or could not be decided to be.
    By(ExprId, Verdict),
    /// On an embedded base it changes where the coordinates that are left do not.
    OnFibres,
    /// It does not change, and was not found to be a function of the coordinates that are left.
    NotExpressed,
}

/// Places on the group: at one of them every function of the invariants has a value.
const PLACES: [(i64, i64); 3] = [(0, 1), (1, 1), (2, 5)];

/// The function at one place of the group, if it is the same at all of them over the embedded base.
///
/// # Errors
/// How it changes along the group.
pub fn constant_along(
    graph: &mut Graph,
    base: &Manifold,
    function: ExprId,
    group: &[SymbolId],
) -> Result<ExprId, Varies> {
    if !graph.depends_on(function, group) {
        return Ok(function);
    }
    let mut function = graph.simplify(function);
    let mut along = group.to_vec();
    // embedded together with coordinates that are left: the orbits are the fibres over these
    if base.factor(graph, group).is_none()
        && let Some(fibres) = Fibres::of(graph, base, group)
    {
        let first = group.iter().copied().find(|symbol| graph.depends_on(function, &[*symbol]));
        let varies = |change| Varies { along: first.unwrap_or(group[0]), change };
        if !fibres.is_constant(graph, function, group) {
            return Err(varies(Change::OnFibres));
        }
        return fibres.expressed(graph, function, group).ok_or_else(|| varies(Change::NotExpressed));
    }
    if let Some(factor) = base.factor(graph, group) {
        function = Substitution::new(factor.embedding).apply(graph, function);
        along = factor.parameters;
    }
    for symbol in &along {
        let slope = graph.partial(function, *symbol);
        let verdict = base.zero_test(graph, slope);
        if !verdict.is_zero() {
            return Err(Varies { along: *symbol, change: Change::By(slope, verdict) });
        }
    }
    for (n, d) in PLACES {
        let place = graph.number(Rational::new(n, d));
        let there = Substitution::new(along.iter().map(|symbol| (*symbol, place))).apply(graph, function);
        if !graph.is_undefined(there) {
            return Ok(there);
        }
    }
    Ok(function)
}
