//! Planar velocities of points in a Lagrangian, and the motions that move them.

use super::velocity_forms::VelocityForms;
use crate::algebra::{Derivation, Graph, Rational};
use crate::id::{ExprId, SymbolId};

/// Components that are moved by more different sections do not belong to one point.
pub(super) const NEIGHBOURS: usize = 2;

/// Two velocity forms that are the components of one planar velocity.
#[derive(Clone, Debug)]
pub(super) struct Point {
    /// Their positions among the forms.
    pub(super) forms: [usize; 2],
    /// Their coefficients on the sections.
    pub(super) coefficients: [Vec<ExprId>; 2],
    /// The sections on which they are (1, 0) and (0, 1).
    pub(super) axes: [usize; 2],
}

impl Point {
    /// Whether a section moves the point, its axes left aside.
    pub(super) fn is_moved(&self, graph: &Graph, section: usize) -> bool {
        !self.axes.contains(&section)
            && self.coefficients.iter().any(|row| !graph.is_literal_zero(row[section]))
    }
}

/// A form that enters a Lagrangian as μ u²/2: its position among the forms, μ, and its coefficients.
pub(super) type Square = (usize, ExprId, Vec<ExprId>);

/// The forms that enter a Lagrangian as μ u²/2.
pub(super) fn squares(graph: &mut Graph, velocities: &[SymbolId], of: &VelocityForms) -> Vec<Square> {
    let VelocityForms { function, forms } = of;
    let symbols: Vec<SymbolId> = forms.iter().map(|(symbol, _)| *symbol).collect();
    let mut squares: Vec<Square> = Vec::new();
    let mut partials: Vec<Derivation> =
        velocities.iter().map(|velocity| Derivation::partial(graph, *velocity)).collect();
    for (k, (symbol, form)) in forms.iter().enumerate() {
        if velocities.contains(symbol) {
            continue;
        }
        let slope = graph.partial(*function, *symbol);
        let inertia = graph.partial(slope, *symbol);
        let u = graph.symbol(*symbol);
        let rest = graph.formula(slope - inertia * u);
        if !graph.depends_on(inertia, &symbols) && graph.vanishes_by_identity(rest) {
            let coefficients = partials.iter_mut().map(|partial| partial.apply(graph, *form)).collect();
            squares.push((k, inertia, coefficients));
        }
    }
    squares
}

/// The planar velocities in a Lagrangian: pairs of forms that enter it as μ/2 (u₁² + u₂²), with axes.
pub(super) fn points(graph: &Graph, squares: &[Square]) -> Vec<Point> {
    // pairs with the same μ, those that are moved by the most similar velocities first
    let mut pairs: Vec<(usize, [usize; 2], [usize; 2])> = Vec::new();
    for (k, (_, mu, first)) in squares.iter().enumerate() {
        for (l, (_, other, second)) in squares.iter().enumerate().skip(k + 1) {
            if let Some((unlike, axes)) = axes(graph, first, second).filter(|_| mu == other) {
                pairs.push((unlike, [k, l], axes));
            }
        }
    }
    pairs.sort_by_key(|(unlike, ..)| *unlike);
    let mut points: Vec<Point> = Vec::new();
    let mut taken = vec![false; squares.len()];
    for (_, pair, axes) in pairs {
        if pair.iter().all(|k| !taken[*k]) {
            taken[pair[0]] = true;
            taken[pair[1]] = true;
            let forms = pair.map(|k| squares[k].0);
            points.push(Point { forms, coefficients: pair.map(|k| squares[k].2.clone()), axes });
        }
    }
    points.sort_by_key(|point| point.forms);
    points
}

/// The sections on which two forms are (1, 0) and (0, 1), and how many others move only one of them.
pub(super) fn axes(graph: &Graph, first: &[ExprId], second: &[ExprId]) -> Option<(usize, [usize; 2])> {
    let is_one = |entry: ExprId| graph.as_number(entry).is_some_and(Rational::is_one);
    let is_zero = |entry: ExprId| graph.is_literal_zero(entry);
    let x = (0..first.len()).find(|s| is_one(first[*s]) && is_zero(second[*s]))?;
    let y = (0..first.len()).find(|s| is_zero(first[*s]) && is_one(second[*s]))?;
    let unlike = |s: &usize| *s != x && *s != y && is_zero(first[*s]) != is_zero(second[*s]);
    let unlike = (0..first.len()).filter(unlike).count();
    (unlike <= NEIGHBOURS).then_some((unlike, [x, y]))
}

/// A combination of velocities that moves points as one does, the turning of a body, say: ± y^α.
#[derive(Clone, Debug)]
pub(super) struct Motion<const N: usize> {
    /// The sections, and whether they are subtracted.
    pub(super) sections: Vec<(usize, bool)>,
    /// What a unit of it contributes.
    pub(super) effect: [ExprId; N],
}

/// Contributions of single sections, those that are equal up to the sign taken together.
pub(super) fn motions<const N: usize>(
    graph: &mut Graph,
    effects: impl IntoIterator<Item = (usize, [ExprId; N])>,
) -> Vec<Motion<N>> {
    let mut motions: Vec<Motion<N>> = Vec::new();
    for (section, effect) in effects {
        if effect.iter().all(|entry| graph.is_literal_zero(*entry)) {
            continue;
        }
        let opposite = effect.map(|entry| graph.formula(-entry));
        match motions.iter_mut().find(|motion| motion.effect == effect || motion.effect == opposite) {
            Some(motion) => motion.sections.push((section, motion.effect == opposite)),
            None => motions.push(Motion { sections: vec![(section, false)], effect }),
        }
    }
    separate(graph, &mut motions);
    motions
}

/// Takes out of each contribution what another one contributes, where less is left: a trailer is moved by
/// the turning of the tractor as by its own, and by the hitch besides.
fn separate<const N: usize>(graph: &mut Graph, motions: &mut [Motion<N>]) {
    for index in 0..motions.len() {
        let effect = motions[index].effect;
        let mut least = graph.operation_count(&effect);
        let mut found = None;
        for other in (0..motions.len()).filter(|other| *other != index) {
            for sign in [Rational::ONE, Rational::MINUS_ONE] {
                let part = motions[other].effect;
                let rest = std::array::from_fn(|k| {
                    graph.linear_combination(&[(Rational::ONE, effect[k]), (-sign.clone(), part[k])])
                });
                let length = graph.operation_count(&rest);
                if length < least {
                    least = length;
                    found = Some((other, rest, sign.is_negative()));
                }
            }
        }
        if let Some((other, rest, opposite)) = found {
            motions[index].effect = rest;
            let also = motions[index].sections.clone();
            motions[other].sections.extend(also.into_iter().map(|(s, negative)| (s, negative != opposite)));
        }
    }
}

/// The motions whose sections fulfil a condition.
pub(super) fn filtered<const N: usize>(
    motions: &[Motion<N>],
    keep: impl Fn(&[(usize, bool)]) -> bool,
) -> Vec<Motion<N>> {
    motions.iter().filter(|motion| keep(&motion.sections)).cloned().collect()
}

/// The motion that a section is part of, in all contributions alike; the section alone, if they differ.
pub(super) fn together(section: usize, first: &[Motion<2>], second: &[Motion<1>]) -> Vec<(usize, bool)> {
    let lists = || {
        let first = first.iter().map(|motion| &motion.sections);
        first.chain(second.iter().map(|motion| &motion.sections))
    };
    let contains = |list: &[(usize, bool)], section: usize| list.iter().any(|(s, _)| *s == section);
    let alone = vec![(section, false)];
    let Some(motion) = lists().find(|list| contains(list, section)) else { return alone };
    let is_once = motion.iter().filter(|(s, _)| *s == section).count() == 1;
    let others_lack_it = lists().all(|list| list == motion || !contains(list, section));
    if is_once && others_lack_it { motion.clone() } else { alone }
}
