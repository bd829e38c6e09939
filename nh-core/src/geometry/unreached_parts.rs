//! Parts of a manifold that no chart reaches: of `x u = y z`, `y v = x w`, solved by divisions by x, the part where
//! x = y = 0 is as large as the rest, and what holds on the rest need not hold there.
//!
//! In floating point, points of the manifold are looked for where a divisor is 0, and points of it beside these: that it is
//! 0 there as well is no accident. The equations are then solved anew with the divisor as one more, and so are those with
//! the divisors of that part. What is found only adds parts: that there are no others is not proved.

use super::manifold::{Manifold, OpenPart};
use crate::algebra::{Demand, Graph, Point, real_points_beside, sample};
use crate::id::{ExprId, SymbolId};
use crate::limits::attempt;
use std::collections::{BTreeSet, VecDeque};

/// What is so small beside its size elsewhere is taken for zero: a zero of second order is found to half of the digits.
const SMALL: f64 = 1e-6;
/// What symbols may be beside their images at a point of a part.
const NEAR: f64 = 1e-5;
/// Divisors that are looked at, those of further parts after all those of the first.
const DIVISORS: usize = 16;
/// The work that the search for points beside the zeros of one may take.
const WORK: u64 = 8_000_000;

impl Manifold {
    /// Adds parts as large as the first one that no other reaches. `demands` hold where the manifold is meant, with the
    /// functions that vanish there among them, and `solve` finds where these and further ones vanish.
    pub(crate) fn add_unreached_parts(
        &mut self,
        graph: &mut Graph,
        demands: &[(ExprId, Demand)],
        moving: &[SymbolId],
        solve: impl Fn(&mut Graph, &[ExprId]) -> Option<Self>,
    ) {
        let is_meant = |graph: &Graph, part: &Self| {
            let mut images = part.images.iter();
            // parts that fix parameters are none of a machine whose parameters have any values
            images.all(|(symbol, image)| moving.contains(symbol) || graph.depends_on(*image, moving))
        };
        let first: Vec<Self> = self.parts().map(Self::alone).collect();
        let mut begun = VecDeque::from([(Vec::new(), first)]);
        let mut left = DIVISORS;
        while let Some((vanishing, parts)) = begun.pop_front() {
            let divisors: BTreeSet<ExprId> =
                parts.iter().flat_map(|part| part.moving_divisors(graph, moving)).collect();
            for divisor in divisors {
                let Some(fewer) = left.checked_sub(1) else { return };
                left = fewer;
                let vanishing: Vec<ExprId> = vanishing.iter().copied().chain([divisor]).collect();
                let points =
                    attempt(WORK, || real_points_beside(graph, demands, &vanishing)).unwrap_or_default();
                let is_unreached = |point: &Point| {
                    vanishing.iter().all(|function| is_zero_at(graph, *function, point))
                        && !self.parts().any(|part| part.reaches(graph, point, moving))
                };
                let Some(point) = points.into_iter().find(is_unreached) else { continue };
                let solved = solve(graph, &vanishing);
                let is_there =
                    |part: &&Self| part.images.len() == self.images.len() && part.has(graph, &point);
                let mut found: Vec<Self> =
                    solved.iter().flat_map(Self::parts).filter(is_there).map(Self::alone).collect();
                if found.is_empty() {
                    self.open.push(OpenPart { images: Vec::new(), functions: vanishing.clone() });
                } else {
                    found.retain(|part| is_meant(graph, part));
                    if found.is_empty() {
                        continue;
                    }
                }
                for part in &found {
                    self.add_parts(part);
                }
                self.note_parts_apart(graph, demands, divisor);
                begun.push_back((vanishing, found));
            }
        }
    }

    /// Takes note that what holds on the first part need not hold on the others, by an equation with what is 0 there.
    fn note_parts_apart(&mut self, graph: &Graph, demands: &[(ExprId, Demand)], divisor: ExprId) {
        let equations = demands.iter().filter(|(_, demand)| *demand == Demand::Zero);
        let equations: Vec<ExprId> = equations.map(|(function, _)| *function).collect();
        let inside = graph.symbols_in(&[divisor]);
        let with_it = equations.iter().find(|function| graph.depends_on(**function, &inside));
        let Some(function) = with_it.or(equations.first()) else { return };
        let (_, symbols) = self.by_part.get_or_insert_with(|| (*function, Vec::new()));
        symbols.extend(graph.symbols_in(&equations));
    }

    /// What images divide by, where that moves, and is no function of the parameters of a chart.
    fn moving_divisors(&self, graph: &Graph, moving: &[SymbolId]) -> BTreeSet<ExprId> {
        let images: Vec<ExprId> = self.images.iter().map(|(_, image)| *image).collect();
        let mut divisors = graph.divisors(&images);
        divisors
            .retain(|divisor| graph.depends_on(*divisor, moving) && !graph.depends_on(*divisor, &self.chart));
        divisors
    }

    /// Whether a point is on this part, where its chart divides by nothing that is 0.
    fn reaches(&self, graph: &Graph, point: &Point, moving: &[SymbolId]) -> bool {
        let mut divisors = self.moving_divisors(graph, moving).into_iter();
        !divisors.any(|divisor| is_zero_at(graph, divisor, point)) && self.has(graph, point)
    }

    /// Whether a point is on this part, as far as that is seen: where roots are taken either sign may be meant.
    fn has(&self, graph: &Graph, point: &Point) -> bool {
        !self.radicands.is_empty()
            || !self.chart.is_empty()
            || self.images.iter().all(|(symbol, image)| {
                let image = value_at(graph, *image, point);
                (image - value_of(point, *symbol)).abs() <= NEAR * (1.0 + image.abs())
            })
    }
}

/// Whether a function is small at a point beside what it is elsewhere.
fn is_zero_at(graph: &Graph, function: ExprId, point: &Point) -> bool {
    value_at(graph, function, point).abs() <= SMALL * size_of(graph, function)
}

fn value_at(graph: &Graph, function: ExprId, point: &Point) -> f64 {
    graph.evaluate(&[function], |symbol| value_of(point, symbol))[0].value
}

/// How large a function is where symbols have numbers in general position.
fn size_of(graph: &Graph, function: ExprId) -> f64 {
    let symbols = graph.symbols_in(&[function]);
    let place = |symbol| symbols.iter().position(|known| *known == symbol).unwrap_or(0);
    let at =
        |attempt: u64| graph.evaluate(&[function], |symbol| sample(attempt, place(symbol)))[0].value.abs();
    at(0).max(at(2))
}

fn value_of(point: &Point, symbol: SymbolId) -> f64 {
    point.iter().find(|(known, _)| *known == symbol).map_or(f64::NAN, |(_, value)| *value)
}
