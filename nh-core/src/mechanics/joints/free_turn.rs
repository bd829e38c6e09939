//! Attitudes that turn freely: their angular velocities are velocities of the state.

use super::sheet::{Square, Vector};
use crate::algebra::{Derivation, Graph, Rational, Substitution};
use crate::geometry::Algebroid;
use crate::id::{ExprId, Id, SectionId, SymbolId};

/// An attitude E, by a quaternion, a matrix or angles, of which some sections turn it about its own axes, or about those of
/// what carries it: Eᵀ ρ(e_α)E = n̂_α, or ρ(e_α)E Eᵀ = n̂_α, with numbers n_α.
///
/// Where E = 1 both say the same; which of them holds is told by the brackets, as n is a morphism onto so(3):
/// n[e_α, e_β] = ± n_α × n_β, with + for its own axes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct FreeTurn {
    /// E, from its own axes to those of what carries it.
    pub(super) matrix: Square,
    /// The sections that turn it, with n_α.
    pub(super) rates: Vec<(usize, Vector)>,
    pub(super) axes: Axes,
    /// Where E = 1.
    level: Vec<(SymbolId, ExprId)>,
    /// How the symbols of E move there as it turns about each of its axes.
    tangents: [Vec<(SymbolId, ExprId)>; 3],
}

/// Whose axes those of a rotation are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Axes {
    /// Of what turns.
    Own,
    /// Of what carries it.
    Carrier,
}

impl FreeTurn {
    /// `None` where no three sections turn the attitude, each about one axis.
    pub(super) fn of(graph: &mut Graph, matrix: &[ExprId], algebroid: &Algebroid) -> Option<Self> {
        let anchor = &algebroid.anchor;
        let occurring = graph.symbols_in(matrix);
        let moving: Vec<usize> =
            (0..anchor.coordinates.len()).filter(|k| occurring.contains(&anchor.coordinates[*k])).collect();
        let symbols: Vec<SymbolId> = moving.iter().map(|k| anchor.coordinates[*k]).collect();
        let level = where_attitude_is_one(graph, matrix, &symbols)
            .or_else(|| where_angles_are_zero(graph, matrix, &symbols))?;
        let mut at_level = Substitution::new(level.iter().copied());
        let mut value_at_level = |graph: &mut Graph, value: ExprId| {
            let value = at_level.apply(graph, value);
            graph.simplify(value)
        };
        let slopes: Vec<Vec<ExprId>> = symbols
            .iter()
            .map(|symbol| {
                let slopes = Derivation::partial(graph, *symbol).apply_all(graph, matrix);
                slopes.into_iter().map(|slope| value_at_level(graph, slope)).collect()
            })
            .collect();
        // a chart that is singular there has no numbers for what moves its coordinates
        let mut rates: Vec<(usize, Vector)> = Vec::new();
        let mut shifts: Vec<Vec<ExprId>> = Vec::new();
        for alpha in algebroid.sections() {
            let own = moving.iter().map(|i| value_at_level(graph, anchor.entries[*i][alpha.index()]));
            let own: Vec<ExprId> = own.collect();
            let moved = (0..matrix.len()).map(|k| {
                let slopes: Vec<ExprId> = slopes.iter().map(|slopes| slopes[k]).collect();
                graph.inner_product(&slopes, &own)
            });
            let moved: Vec<ExprId> = moved.collect();
            let rate = vee(graph, &moved)?;
            if rate.iter().any(|entry| !graph.is_literal_zero(*entry)) {
                rates.push((alpha.index(), rate));
                shifts.push(own);
            }
        }
        let tangents = (0..3).map(|k| {
            let is_alone = |(_, rate): &(usize, Vector)| {
                (0..3).all(|other| graph.is_literal_zero(rate[other]) != (other == k))
            };
            let place = rates.iter().position(is_alone)?;
            let speed = rates[place].1[k];
            let shifts = symbols.iter().zip(&shifts[place]);
            Some(shifts.map(|(symbol, shift)| (*symbol, graph.formula(shift / speed))).collect::<Vec<_>>())
        });
        let tangents: [Vec<_>; 3] = tangents.collect::<Option<Vec<_>>>()?.try_into().ok()?;
        let axes = axes(graph, algebroid, &rates)?;
        let matrix = std::array::from_fn(|i| std::array::from_fn(|j| matrix[3 * i + j]));
        Some(Self { matrix, rates, axes, level, tangents })
    }

    /// Whether the sections turn the attitude in this way at all places, which is proved.
    pub(super) fn is_everywhere(&self, graph: &mut Graph, algebroid: &Algebroid) -> bool {
        algebroid.sections().all(|alpha| {
            let mut along = algebroid.anchor.along(alpha);
            let moved: Square = self.matrix.map(|row| row.map(|entry| along.apply(graph, entry)));
            let known = self.rates.iter().find(|(other, _)| *other == alpha.index());
            let rate = known.map_or([graph.zero(); 3], |(_, rate)| *rate);
            (0..3).all(|k| {
                let (i, j) = ((k + 1) % 3, (k + 2) % 3);
                let factors: [[ExprId; 2]; 3] = std::array::from_fn(|l| match self.axes {
                    Axes::Own => [self.matrix[l][j], moved[l][i]],
                    Axes::Carrier => [moved[j][l], self.matrix[i][l]],
                });
                let [one, other] = [0, 1].map(|side| factors.map(|pair| pair[side]));
                let found = graph.inner_product(&one, &other);
                let difference = graph.formula(found - rate[k]);
                graph.zero_test(difference).is_zero()
            })
        })
    }

    /// Of angles, with symbols for their sines and cosines in their place.
    pub(super) fn by_sines(
        mut self,
        (zero, one): (ExprId, ExprId),
        sine_and_cosine: impl Fn(SymbolId) -> Option<[SymbolId; 2]>,
    ) -> Option<Self> {
        let mut level = Vec::new();
        for (symbol, _) in &self.level {
            let [sine, cosine] = sine_and_cosine(*symbol)?;
            level.extend([(sine, zero), (cosine, one)]);
        }
        self.level = level;
        for (symbol, _) in self.tangents.iter_mut().flatten() {
            [*symbol, _] = sine_and_cosine(*symbol)?;
        }
        Some(self)
    }

    /// The symbols that the attitude depends on, with their values where it is 1.
    pub(super) fn level(&self) -> &[(SymbolId, ExprId)] {
        &self.level
    }

    /// How the symbols move as the attitude turns about an axis there.
    pub(super) fn tangent(&self, axis: usize) -> impl Iterator<Item = (SymbolId, ExprId)> + '_ {
        self.tangents[axis].iter().copied()
    }
}

/// Where an attitude that depends on these symbols is 1: a matrix of coordinates there, a quaternion at one of four points;
/// `None` of others.
pub fn where_attitude_is_one(
    graph: &mut Graph,
    matrix: &[ExprId],
    symbols: &[SymbolId],
) -> Option<Vec<(SymbolId, ExprId)>> {
    let (zero, one) = (graph.zero(), graph.one());
    let entries: Option<Vec<SymbolId>> = matrix.iter().map(|entry| graph.as_symbol(*entry)).collect();
    let mut levels: Vec<Vec<(SymbolId, ExprId)>> = Vec::new();
    let unit = |number: bool| if number { one } else { zero };
    if let Some(entries) = entries {
        levels.push(
            entries.iter().enumerate().map(|(k, symbol)| (*symbol, unit(k.is_multiple_of(4)))).collect(),
        );
    } else if symbols.len() == 4 {
        levels.extend((0..4).map(|real| {
            symbols.iter().enumerate().map(|(k, symbol)| (*symbol, unit(k == real))).collect::<Vec<_>>()
        }));
    }
    levels.into_iter().find(|level| is_one(graph, matrix, level))
}

/// The same of angles, which are 0.
fn where_angles_are_zero(
    graph: &mut Graph,
    matrix: &[ExprId],
    symbols: &[SymbolId],
) -> Option<Vec<(SymbolId, ExprId)>> {
    let zero = graph.zero();
    let level: Vec<(SymbolId, ExprId)> = symbols.iter().map(|symbol| (*symbol, zero)).collect();
    is_one(graph, matrix, &level).then_some(level)
}

fn is_one(graph: &mut Graph, matrix: &[ExprId], level: &[(SymbolId, ExprId)]) -> bool {
    let mut at_level = Substitution::new(level.iter().copied());
    matrix.iter().enumerate().all(|(k, entry)| {
        let value = at_level.apply(graph, *entry);
        let value = graph.simplify(value);
        let wanted = if k.is_multiple_of(4) { Rational::ONE } else { Rational::ZERO };
        graph.as_number(value) == Some(&wanted)
    })
}

/// ω of a matrix ω̂ of numbers.
fn vee(graph: &mut Graph, matrix: &[ExprId]) -> Option<Vector> {
    let number = |i: usize, j: usize| graph.as_number(matrix[3 * i + j]).cloned();
    let mut rate: Vec<Rational> = Vec::with_capacity(3);
    for k in 0..3 {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        let (own, other) = (number(j, i)?, number(i, j)?);
        if !number(k, k)?.is_zero() || own != -other {
            return None;
        }
        rate.push(own);
    }
    let rate: [Rational; 3] = rate.try_into().ok()?;
    Some(rate.map(|entry| graph.number(entry)))
}

/// n[e_α, e_β] = ± n_α × n_β, as numbers: of two that turn the attitude, and 0 of others.
fn axes(graph: &mut Graph, algebroid: &Algebroid, rates: &[(usize, Vector)]) -> Option<Axes> {
    let rate_of = |section: SectionId| rates.iter().find(|(other, _)| *other == section.index());
    let none = [graph.zero(); 3];
    let mut brackets: Vec<([usize; 2], Vector)> = Vec::new();
    for (first, (alpha, _)) in rates.iter().enumerate() {
        brackets.extend(rates[first + 1..].iter().map(|(beta, _)| ([*alpha, *beta], none)));
    }
    for (alpha, beta, gamma, component) in algebroid.structure.terms() {
        let Some((_, rate)) = rate_of(gamma) else { continue };
        let pair = [alpha.index(), beta.index()];
        let place = brackets.iter().position(|(known, _)| *known == pair).unwrap_or_else(|| {
            brackets.push((pair, none));
            brackets.len() - 1
        });
        let sum = &mut brackets[place].1;
        for (sum, entry) in sum.iter_mut().zip(rate) {
            *sum = graph.formula(*sum + component * *entry);
        }
    }
    let (mut own, mut carrier) = (true, true);
    for (pair, bracket) in brackets {
        let [n, m] =
            pair.map(|section| rate_of(SectionId::from_index(section)).map_or(none, |(_, rate)| *rate));
        for (k, entry) in bracket.into_iter().enumerate() {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            let product = graph.formula(n[i] * m[j] - n[j] * m[i]);
            own &= entry == product;
            carrier &= entry == graph.formula(-product);
        }
    }
    match (own, carrier) {
        (true, _) => Some(Axes::Own),
        (false, true) => Some(Axes::Carrier),
        (false, false) => None,
    }
}
