//! Parts of a manifold that no chart reaches: of `x u = y z`, `y v = x w`, solved by divisions by x, the part where
//! x = y = 0 is as large as the rest, and what holds on the rest need not hold there.
//!
//! In floating point, points of the manifold are looked for where a divisor is 0, and points of it beside these: that charts
//! divide by 0 there as well is no accident. The equations are then solved anew with the divisor as one more.

use super::manifold::{Manifold, OpenPart};
use crate::algebra::{Demand, Graph, Node, Point, real_points_beside, sample};
use crate::id::{ExprId, SymbolId};
use crate::limits::attempt;

/// What is so small beside its size elsewhere is taken for zero: a zero of second order is found to half of the digits.
const SMALL: f64 = 1e-6;
/// What symbols may be beside their images at a point of a part.
const NEAR: f64 = 1e-5;
/// Divisors that are looked at.
const DIVISORS: usize = 8;
/// The work that the search for points beside the zeros of one may take.
const WORK: u64 = 8_000_000;

impl Manifold {
    /// Adds parts as large as the first one where charts of all others divide by 0. `demands` hold where the manifold is
    /// meant, with the functions that vanish there among them, and `solve` finds where these and a further one vanish.
    pub(crate) fn add_unreached_parts(
        &mut self,
        graph: &mut Graph,
        demands: &[(ExprId, Demand)],
        moving: &[SymbolId],
        solve: impl Fn(&mut Graph, ExprId) -> Option<Self>,
    ) {
        if self.parts().any(|part| part.divisors(graph, moving).is_empty()) {
            return;
        }
        for divisor in self.divisors(graph, moving).into_iter().take(DIVISORS) {
            let points = attempt(WORK, || real_points_beside(graph, demands, divisor)).unwrap_or_default();
            let unreached = points.into_iter().find(|point| self.divides_by_zero_at(graph, point, moving));
            let Some(point) = unreached else { continue };
            let solved = solve(graph, divisor);
            let is_new = |part: &&Self| part.images.len() == self.images.len() && part.has(graph, &point);
            let new: Vec<Self> =
                solved.iter().flat_map(Self::parts).filter(is_new).map(Self::alone).collect();
            if new.is_empty() {
                self.open.push(OpenPart { images: Vec::new(), functions: vec![divisor] });
            }
            for part in &new {
                self.add_parts(part);
            }
            self.note_parts_apart(graph, demands, divisor);
        }
    }

    /// Takes note that what holds on the first part need not hold on the others, by an equation with what is 0 there.
    fn note_parts_apart(&mut self, graph: &Graph, demands: &[(ExprId, Demand)], divisor: ExprId) {
        let inside = graph.symbols_in(&[divisor]);
        let is_there = |(function, demand): &&(ExprId, Demand)| {
            *demand == Demand::Zero && graph.depends_on(*function, &inside)
        };
        let Some((function, _)) = demands.iter().find(is_there) else { return };
        let vanishing: Vec<ExprId> = demands
            .iter()
            .filter(|(_, demand)| *demand == Demand::Zero)
            .map(|(function, _)| *function)
            .collect();
        let all = graph.symbols_in(&vanishing);
        let (_, symbols) = self.by_part.get_or_insert_with(|| (*function, Vec::new()));
        symbols.extend(all);
    }

    /// Whether every part divides by 0 at a point.
    fn divides_by_zero_at(&self, graph: &Graph, point: &Point, moving: &[SymbolId]) -> bool {
        self.parts().all(|part| {
            part.divisors(graph, moving).into_iter().any(|divisor| {
                let there = graph.evaluate(&[divisor], |symbol| value_of(point, symbol))[0].value;
                there.abs() <= SMALL * size_of(graph, divisor)
            })
        })
    }

    /// What images divide by, where that moves, and is no function of the parameters of a chart.
    fn divisors(&self, graph: &Graph, moving: &[SymbolId]) -> Vec<ExprId> {
        let images: Vec<ExprId> = self.images.iter().map(|(_, image)| *image).collect();
        let mut divisors = Vec::new();
        for id in graph.reachable(&images) {
            let Node::Product { factors, .. } = graph.node(id) else { continue };
            divisors.extend(factors.iter().filter(|(_, power)| power.is_negative()).map(|(base, _)| *base));
        }
        divisors.sort_unstable();
        divisors.dedup();
        divisors
            .retain(|divisor| graph.depends_on(*divisor, moving) && !graph.depends_on(*divisor, &self.chart));
        divisors
    }

    /// Whether a point is on this part, as far as that is seen: where roots are taken either sign may be meant.
    fn has(&self, graph: &Graph, point: &Point) -> bool {
        !self.radicands.is_empty()
            || !self.chart.is_empty()
            || self.images.iter().all(|(symbol, image)| {
                let image = graph.evaluate(&[*image], |symbol| value_of(point, symbol))[0].value;
                (image - value_of(point, *symbol)).abs() <= NEAR * (1.0 + image.abs())
            })
    }
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
