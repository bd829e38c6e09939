//! Planar velocities in the frames of the wheels that carry them.
//!
//! Let a point's velocity have components u₁ = θ¹(y), u₂ = θ²(y) that enter the Lagrangian as
//! μ/2 (u₁² + u₂²). Turned by an angle a(t, x),
//!
//! `s + i r = e^{−ia} (u₁ + i u₂)`,
//!
//! they enter it in the same way. A constraint on the velocity across a wheel, −sin a u₁ + cos a u₂ + … = 0,
//! suggests the angle: then r vanishes on D, or depends on little. Points are related to their
//! neighbours, u = u′ + δ with a δ of few velocities, so that
//!
//! `s + i r = e^{i(a′ − a)} (s′ + i r′) + e^{−ia} (δ₁ + i δ₂)`,
//!
//! and a chain of bodies is a recursion in which only differences of neighbouring angles occur.

use super::planar_points::{Motion, NEIGHBOURS, Point, filtered, motions, points, squares, together};
use super::procedure::Procedure;
use super::velocity_forms::VelocityForms;
use crate::algebra::{Function, Graph, Node, Rational, Substitution};
use crate::geometry::ConstraintDistribution;
use crate::id::{ExprId, Id, SymbolId};

/// A planar velocity on D in turned axes.
#[derive(Clone, Debug)]
pub(super) struct TurnedPoint {
    /// The positions of its components among the velocity forms.
    pub(super) forms: [usize; 2],
    /// The sections on which these are (1, 0) and (0, 1).
    pub(super) axes: [usize; 2],
    /// a.
    pub(super) angle: ExprId,
    /// s and r.
    pub(super) components: [ExprId; 2],
}

/// What a point's velocity is measured from: a turned point, or the axes themselves.
#[derive(Clone, Debug)]
struct Neighbour {
    angle: ExprId,
    components: [ExprId; 2],
    /// δ.
    difference: Vec<Motion<2>>,
}

/// The velocities on D solved for along the chain of points, and the turned points.
pub(super) struct WheelFrames {
    /// The components of turned points, in order.
    pub(super) definitions: Procedure,
    /// y on D in terms of them and of v.
    pub(super) velocity: Vec<ExprId>,
    pub(super) points: Vec<TurnedPoint>,
}

impl WheelFrames {
    /// Turns pairs of the forms that are in axes of their own. `None` if no point is carried by a wheel.
    pub(super) fn of(
        graph: &mut Graph,
        velocities: &[SymbolId],
        distribution: &ConstraintDistribution,
        residuals: &[ExprId],
        forms: &mut VelocityForms,
    ) -> Option<Self> {
        if distribution.dependent.is_empty() {
            return None;
        }
        let mut squares = squares(graph, velocities, forms);
        forms.turn_back(graph, velocities, &mut squares);
        let points = points(graph, &squares);
        if points.is_empty() {
            return None;
        }
        let independent = |symbol: &SymbolId| distribution.independent.contains(symbol);
        let values =
            velocities.iter().map(|symbol| independent(symbol).then(|| graph.symbol(*symbol))).collect();
        let search = Search {
            velocities,
            distribution,
            points,
            values,
            definitions: Procedure::default(),
            turned: Vec::new(),
            names_turning: true,
            levers: Vec::new(),
        };
        // the powers of a length that bodies share are common factors, if its quotients stay in place
        let mut found = search.clone().run(graph, residuals);
        let levers = &found.levers;
        if (1..levers.len()).any(|k| levers[..k].contains(&levers[k])) {
            found = Search { names_turning: false, ..search }.run(graph, residuals);
        }
        let Search { values, turned, definitions, .. } = found;
        let velocity: Vec<ExprId> = values.into_iter().collect::<Option<_>>()?;
        (!turned.is_empty()).then_some(Self { definitions, velocity, points: turned })
    }
}

#[derive(Clone)]
struct Search<'a> {
    velocities: &'a [SymbolId],
    distribution: &'a ConstraintDistribution,
    /// The points that are not turned yet.
    points: Vec<Point>,
    /// The velocities that are known on D.
    values: Vec<Option<ExprId>>,
    definitions: Procedure,
    turned: Vec<TurnedPoint>,
    /// Whether what is solved for from wheel to wheel is an intermediate result.
    names_turning: bool,
    /// What it was divided by.
    levers: Vec<ExprId>,
}

impl Search<'_> {
    fn run(mut self, graph: &mut Graph, residuals: &[ExprId]) -> Self {
        let mut coefficients: Vec<(TurnedPoint, [Vec<ExprId>; 2])> = Vec::new();
        for (rows, unknowns) in self.distribution.blocks() {
            if let ([row], [unknown]) = (rows.as_slice(), unknowns.as_slice()) {
                let section = self.distribution.dependent[*unknown].index();
                if let Some(found) = self.follow_wheel(graph, *row, section, &coefficients) {
                    self.turned.push(found.0.clone());
                    coefficients.push(found);
                } else {
                    self.values[section] = Some(self.solve(graph, residuals[*row], *row, section));
                }
            } else {
                for unknown in unknowns {
                    let section = self.distribution.dependent[*unknown].index();
                    self.values[section] = Some(self.distribution.velocity[section]);
                }
            }
        }
        // points without a wheel move with their neighbours
        for point in std::mem::take(&mut self.points) {
            let Some(neighbour) = self.neighbour(graph, &point, None, &coefficients) else { continue };
            if graph.is_literal_zero(neighbour.angle) || neighbour.difference.len() > NEIGHBOURS {
                continue;
            }
            let Some(components) = self.turn(graph, &neighbour, neighbour.angle) else { continue };
            let components = self.named(graph, components);
            let turned =
                TurnedPoint { forms: point.forms, axes: point.axes, angle: neighbour.angle, components };
            self.turned.push(turned.clone());
            coefficients.push((turned, point.coefficients));
        }
        self
    }

    /// A constraint solved for a velocity with the known ones put in.
    fn solve(&self, graph: &mut Graph, residual: ExprId, row: usize, section: usize) -> ExprId {
        let zero = graph.zero();
        let known = self.velocities.iter().zip(&self.values).filter_map(|(s, value)| Some((*s, (*value)?)));
        let images: Vec<_> = known.chain([(self.velocities[section], zero)]).collect();
        let changed = images.into_iter().filter(|(symbol, value)| graph.as_symbol(*value) != Some(*symbol));
        let rest = Substitution::new(changed.collect::<Vec<_>>()).apply(graph, residual);
        graph.formula(-(rest / self.distribution.constraints.annihilator[row][section]))
    }

    /// Solves a constraint across a wheel for a velocity, and turns the point on the wheel.
    fn follow_wheel(
        &mut self,
        graph: &mut Graph,
        row: usize,
        section: usize,
        known: &[(TurnedPoint, [Vec<ExprId>; 2])],
    ) -> Option<(TurnedPoint, [Vec<ExprId>; 2])> {
        let constraints = &self.distribution.constraints;
        let (mut phi, drift) = (constraints.annihilator[row].clone(), constraints.drift[row]);
        let rank = self.velocities.len();
        // 1. the point whose velocities are most like those of the constraint
        let unlike = |graph: &Graph, point: &Point| {
            let differs = |s: &usize| {
                !point.axes.contains(s) && graph.is_literal_zero(phi[*s]) == point.is_moved(graph, *s)
            };
            (0..rank).filter(differs).count()
        };
        let distance = |(_, point): &(usize, &Point)| unlike(graph, point);
        let (position, _) = self.points.iter().enumerate().min_by_key(distance)?;
        let point = self.points[position].clone();
        if unlike(graph, &point) > NEIGHBOURS {
            return None;
        }
        // 2. its angle, and r + Σ ε_z y^z + b/κ = 0
        let [first, second] = point.axes;
        let angle = direction(graph, phi[first], phi[second]).or_else(|| {
            for entry in &mut phi {
                *entry = graph.nested_products_to_sums(*entry);
            }
            direction(graph, phi[first], phi[second])
        })?;
        let (sin, cos) = (graph.sin(angle), graph.cos(angle));
        let scale = if graph.is_literal_zero(phi[second]) {
            graph.formula(-(phi[first] / sin))
        } else {
            graph.formula(phi[second] / cos)
        };
        let mut excess: Vec<(usize, [ExprId; 1])> = Vec::new();
        for (s, entry) in phi.iter().enumerate() {
            let scaled = graph.formula(entry / scale);
            let across = across(graph, angle, point.coefficients.each_ref().map(|row| row[s]));
            let difference = graph.formula(scaled - across);
            if !graph.zero_test(difference).is_zero() {
                excess.push((s, [graph.products_to_sums(difference)]));
            }
        }
        if excess.iter().any(|(s, _)| point.axes.contains(s)) {
            return None;
        }
        let excess = motions(graph, excess);
        let drift = graph.formula(drift / scale);
        // 3. the unknown from the neighbour's velocity: with what it moves along, where that is alike
        let neighbour = self.neighbour(graph, &point, Some(section), known)?;
        let together = together(section, &neighbour.difference, &excess);
        let apart = |sections: &[(usize, bool)]| sections != together;
        let others = Neighbour { difference: filtered(&neighbour.difference, apart), ..neighbour.clone() };
        self.values[section] = Some(graph.zero());
        let across = self.turn(graph, &others, angle).map(|[_, across]| across);
        let known_excess = self.total(graph, &filtered(&excess, apart)).map(|[total]| total);
        self.values[section] = None;
        let rest = graph.sum(&[across?, known_excess?, drift]);
        let pivot = graph.formula(phi[section] / scale);
        let quotient = graph.formula(rest / pivot);
        self.levers.push(pivot);
        let quotient =
            if self.names_turning { self.definitions.define(graph, "turning", quotient) } else { quotient };
        let mut value = vec![(Rational::MINUS_ONE, quotient)];
        let is_negative = together.contains(&(section, true));
        for (other, negative) in together.into_iter().filter(|(other, _)| *other != section) {
            let sign = if negative == is_negative { Rational::MINUS_ONE } else { Rational::ONE };
            value.push((sign, self.values[other]?));
        }
        self.values[section] = Some(graph.linear_combination(&value));
        // 4. s, and r from the constraint
        let along = self.turn(graph, &neighbour, angle)?[0];
        let [excess] = self.total(graph, &excess)?;
        let minus = graph.formula(-(excess + drift));
        let components = self.named(graph, [along, minus]);
        let point = self.points.remove(position);
        Some((TurnedPoint { forms: point.forms, axes: point.axes, angle, components }, point.coefficients))
    }

    /// Components as intermediate results: the recursion along a chain is not multiplied out.
    fn named(&mut self, graph: &mut Graph, [s, r]: [ExprId; 2]) -> [ExprId; 2] {
        let along = self.definitions.define(graph, "along_wheel", s);
        [along, self.definitions.define(graph, "across_wheel", r)]
    }

    /// The value of a motion on D.
    fn value(&self, graph: &mut Graph, sections: &[(usize, bool)]) -> Option<ExprId> {
        let signed = |(section, negative): &(usize, bool)| {
            let sign = if *negative { Rational::MINUS_ONE } else { Rational::ONE };
            Some((sign, self.values[*section]?))
        };
        let terms = sections.iter().map(signed).collect::<Option<Vec<_>>>()?;
        Some(graph.linear_combination(&terms))
    }

    /// What motions contribute together.
    fn total<const N: usize>(&self, graph: &mut Graph, motions: &[Motion<N>]) -> Option<[ExprId; N]> {
        let mut terms = vec![Vec::new(); N];
        for motion in motions {
            let value = self.value(graph, &motion.sections)?;
            for (list, effect) in terms.iter_mut().zip(motion.effect) {
                list.push(graph.formula(effect * value));
            }
        }
        Some(std::array::from_fn(|k| graph.sum(&terms[k])))
    }

    /// The turned point, or the axes, from which a point differs by the fewest velocities, all of them
    /// known but for `unknown`.
    fn neighbour(
        &self,
        graph: &mut Graph,
        point: &Point,
        unknown: Option<usize>,
        known: &[(TurnedPoint, [Vec<ExprId>; 2])],
    ) -> Option<Neighbour> {
        let zero = graph.zero();
        let [first, second] = point.axes;
        let rank = self.velocities.len();
        let mut candidates: Vec<(ExprId, [ExprId; 2], [Vec<ExprId>; 2])> = known
            .iter()
            .filter(|(turned, _)| turned.axes == point.axes)
            .map(|(turned, rows)| (turned.angle, turned.components, rows.clone()))
            .collect();
        if let (Some(x), Some(y)) = (self.values[first], self.values[second]) {
            let units = [first, second].map(|axis| graph.unit_vector(rank, axis));
            candidates.push((zero, [x, y], units));
        }
        let mut best: Option<Neighbour> = None;
        for (angle, components, rows) in candidates {
            let effects: Vec<_> = (0..rank)
                .map(|s| (s, [0, 1].map(|k| graph.formula(point.coefficients[k][s] - rows[k][s]))))
                .collect();
            let difference = motions(graph, effects);
            let mut sections = difference.iter().flat_map(|motion| &motion.sections);
            let is_known = sections.all(|(s, _)| self.values[*s].is_some() || Some(*s) == unknown);
            let is_better = best.as_ref().is_none_or(|b| difference.len() < b.difference.len());
            if is_known && is_better {
                best = Some(Neighbour { angle, components, difference });
            }
        }
        best
    }

    /// `e^{i(a′ − a)} (s′ + i r′) + e^{−ia} (δ₁ + i δ₂)`.
    fn turn(&self, graph: &mut Graph, neighbour: &Neighbour, angle: ExprId) -> Option<[ExprId; 2]> {
        let between = graph.formula(angle - neighbour.angle);
        let (sin, cos) = (graph.sin(between), graph.cos(between));
        let [s, r] = neighbour.components;
        let (cs, sr, ss, cr) =
            (graph.formula(cos * s), graph.formula(sin * r), graph.formula(sin * s), graph.formula(cos * r));
        let minus = graph.formula(-ss);
        let moved: Vec<Motion<2>> = neighbour
            .difference
            .iter()
            .map(|motion| {
                let effect = [along(graph, angle, motion.effect), across(graph, angle, motion.effect)];
                Motion { sections: motion.sections.clone(), effect }
            })
            .collect();
        let [x, y] = self.total(graph, &moved)?;
        Some([graph.sum(&[cs, sr, x]), graph.sum(&[minus, cr, y])])
    }
}

/// `cos a x + sin a y`.
fn along(graph: &mut Graph, angle: ExprId, [x, y]: [ExprId; 2]) -> ExprId {
    let (sin, cos) = (graph.sin(angle), graph.cos(angle));
    combination(graph, [(cos, x), (sin, y)])
}

/// `−sin a x + cos a y`.
fn across(graph: &mut Graph, angle: ExprId, [x, y]: [ExprId; 2]) -> ExprId {
    let (sin, cos) = (graph.sin(angle), graph.cos(angle));
    let minus = graph.formula(-sin);
    combination(graph, [(minus, x), (cos, y)])
}

/// `Σ a b`, multiplied out, in the angles' sums and differences.
fn combination(graph: &mut Graph, products: [(ExprId, ExprId); 2]) -> ExprId {
    let mut summands: Vec<(Rational, ExprId)> = Vec::new();
    for (a, b) in products {
        let (constant, terms) = graph.as_linear(b);
        summands.push((constant, a));
        for (term, coefficient) in terms {
            summands.push((coefficient, graph.formula(a * term)));
        }
    }
    let sum = graph.linear_combination(&summands);
    graph.products_to_sums(sum)
}

/// The angle a, up to a half turn, for which (x, y) is proportional to (−sin a, cos a), where it can
/// be read off.
fn direction(graph: &mut Graph, x: ExprId, y: ExprId) -> Option<ExprId> {
    match (graph.is_literal_zero(x), graph.is_literal_zero(y)) {
        (true, true) => return None,
        (true, false) => return Some(graph.zero()),
        (false, true) => {
            let pi = graph.pi();
            return Some(graph.scale(Rational::new(1, 2), pi));
        }
        (false, false) => {}
    }
    // tan a = −x / y
    let quotient = graph.formula(x / y);
    let Node::Product { coefficient, factors } = graph.node(quotient).clone() else { return None };
    let power = |function: Function, exponent: i64| {
        factors.iter().find_map(|(base, e)| match graph.node(*base) {
            Node::Apply(f, angle) if *f == function && e.to_i64() == Some(exponent) => Some(*angle),
            _ => None,
        })
    };
    let is_unit = coefficient.abs().is_one() && factors.len() == 2;
    let tangent = power(Function::Sin, 1).filter(|angle| power(Function::Cos, -1) == Some(*angle));
    let cotangent = power(Function::Cos, 1).filter(|angle| power(Function::Sin, -1) == Some(*angle));
    let positive = !coefficient.is_negative();
    match (is_unit, tangent, cotangent) {
        (true, Some(angle), _) => Some(if positive { graph.formula(-angle) } else { angle }),
        (true, None, Some(angle)) => {
            let pi = graph.pi();
            let sign = if positive { Rational::ONE } else { Rational::MINUS_ONE };
            let turned = graph.linear_combination(&[(Rational::ONE, angle), (Rational::new(-1, 2), pi)]);
            Some(graph.scale(sign, turned))
        }
        _ => None,
    }
}
