//! Bodies that are carried by others: velocities by those of neighbours.

use super::gauss::Acceleration;
use super::rates::Rates;
use super::turning_axes::Turns;
use super::written::in_numbers;
use crate::algebra::{Derivation, Function, Graph, Matrix, Node, Rational, Substitution};
use crate::id::{ExprId, SymbolId};
use crate::limits;
use crate::mechanics::{LagrangianSystem, Procedure};

/// Sums of coordinates that sines and cosines are taken of, and turn at a rate Σ c_α y^α in numbers c_α.
pub(super) struct Angles {
    sums: Vec<(ExprId, SymbolId)>,
    /// c, a row for each.
    pub(super) rates: Vec<Vec<(usize, Rational)>>,
}

impl Angles {
    pub(super) fn of(graph: &mut Graph, system: &LagrangianSystem, rows: &Matrix) -> Self {
        let algebroid = &system.algebroid;
        let velocity = algebroid.velocity(graph);
        let mut along = algebroid.along(graph, &velocity, &system.clock);
        let mut found = Self { sums: Vec::new(), rates: Vec::new() };
        for id in graph.reachable(&rows.concat()) {
            let Node::Apply(Function::Sin | Function::Cos, x) = *graph.node(id) else { continue };
            let is_known = found.sums.iter().any(|(sum, _)| *sum == x);
            if is_known || !matches!(graph.node(x), Node::Sum { .. }) {
                continue;
            }
            let rate = along.apply(graph, x);
            let Ok(form) = graph.linear_form(rate, &algebroid.velocities) else { continue };
            let numbers = in_numbers(graph, &form.coefficients);
            if let Some(numbers) = numbers.filter(|_| graph.is_literal_zero(form.rest)) {
                let symbol = graph.new_symbol("angle");
                found.sums.push((x, symbol));
                found.rates.push(numbers);
            }
        }
        found
    }

    /// The derivation along the motion, by the rates of the sums.
    pub(super) fn along(
        &self,
        graph: &mut Graph,
        system: &LagrangianSystem,
        velocity: &[ExprId],
        unknowns: &[ExprId],
        rates: &Rates,
    ) -> Along {
        let mut derivation = system.algebroid.along(graph, velocity, &system.clock);
        let (mut named, mut summed) = (Substitution::new([]), Substitution::new([]));
        for ((sum, symbol), row) in self.sums.iter().zip(&self.rates) {
            let name = graph.symbol(*symbol);
            named.insert_node(*sum, name);
            summed.insert(*symbol, *sum);
            let (zero, mut full) = (graph.zero(), Vec::new());
            full.resize(velocity.len(), zero);
            for (section, number) in row {
                full[*section] = graph.number(number.clone());
            }
            let turning = rates.changed(graph, &full);
            let rate = graph.inner_product(&turning, unknowns);
            derivation.insert(*symbol, rate);
        }
        Along { named, derivation, summed }
    }

    /// The same, with the rates of all coordinates by the unknowns.
    pub(super) fn along_by_unknowns(
        &self,
        graph: &mut Graph,
        system: &LagrangianSystem,
        (velocity, unknowns): (&[ExprId], &[ExprId]),
        rates: &Rates,
    ) -> Along {
        let mut along = self.along(graph, system, velocity, unknowns, rates);
        let algebroid = &system.algebroid;
        let symbols = algebroid.velocity(graph);
        let coordinates = algebroid.rates(graph, &symbols);
        for (coordinate, rate) in algebroid.anchor.coordinates.iter().zip(coordinates) {
            let Ok(form) = graph.linear_form(rate, &algebroid.velocities) else { continue };
            if in_numbers(graph, &form.coefficients).is_some() && graph.is_literal_zero(form.rest) {
                let turning = rates.changed(graph, &form.coefficients);
                let rate = graph.inner_product(&turning, unknowns);
                along.derivation.insert(*coordinate, rate);
            }
        }
        along
    }
}

/// d/dt along the motion at constant velocities of the state.
pub(super) struct Along {
    named: Substitution,
    derivation: Derivation,
    summed: Substitution,
}

impl Along {
    pub(super) fn apply(&mut self, graph: &mut Graph, expression: ExprId) -> ExprId {
        let expression = self.named.apply(graph, expression);
        let change = self.derivation.apply(graph, expression);
        self.summed.apply(graph, change)
    }
}

/// What a velocity belongs to, in the order in which it is carried by the same unknown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    /// A point between two bodies, which all unknowns move but the last one of what it carries.
    Joint,
    Unknown,
    /// What the Lagrangian is written in.
    Body,
}

/// A velocity by others.
#[derive(Clone, Debug)]
pub(super) struct Carried {
    /// Its coefficients on the unknowns.
    pub(super) row: Vec<ExprId>,
    /// By whom it is carried, and how.
    pub(super) by: Vec<(usize, ExprId)>,
    /// Its place: after the last unknown that moves it, or between this and those before.
    place: (usize, Kind),
}

/// The unknowns, then other velocities by them.
#[derive(Debug)]
pub(super) struct Bodies {
    pub(super) all: Vec<Carried>,
    pub(super) unknowns: usize,
    /// Which of them the rows are.
    pub(super) rows: Vec<usize>,
}

/// All velocities in an order in which each is given by those before it.
pub(super) struct Order {
    pub(super) accelerations: Vec<Acceleration>,
    pub(super) velocities: Vec<ExprId>,
    /// The places of the unknowns.
    pub(super) of_unknowns: Vec<usize>,
    /// The places of the rows.
    pub(super) of_rows: Vec<usize>,
}

/// A velocity that constraints determine: its acceleration is a combination of those of the unknowns, and a rest.
pub(super) struct Dependent {
    /// The unknown that it is.
    pub(super) unknown: usize,
    pub(super) row: Vec<ExprId>,
    pub(super) bias: ExprId,
}

/// A velocity that more unknowns than this move otherwise than any neighbour belongs to no chain.
pub(super) const ALONE: usize = 3;

impl Bodies {
    /// Of velocities by their coefficients on unknowns; `None` where they are no chains.
    pub(super) fn of(graph: &mut Graph, rows: &Matrix) -> Option<Self> {
        let unknowns = rows.first().map_or(0, Vec::len);
        let (zero, one) = (graph.zero(), graph.one());
        let unit = |index: usize| {
            let mut row = vec![zero; unknowns];
            row[index] = one;
            Carried { row, by: Vec::new(), place: (index, Kind::Unknown) }
        };
        let mut found = Self { all: (0..unknowns).map(unit).collect(), unknowns, rows: vec![0; rows.len()] };
        let moving = |row: &Vec<ExprId>| (0..unknowns).filter(|j| row[*j] != zero).collect::<Vec<usize>>();
        let mut order: Vec<(Vec<usize>, usize)> = rows.iter().map(moving).zip(0..).collect();
        order.sort_by_key(|(moving, k)| (moving.last().copied(), moving.len(), *k));
        let mut is_chain = false;
        for (moving, k) in order {
            let row = &rows[k];
            if let Some(known) = found.all.iter().position(|body| body.row == *row) {
                found.rows[k] = known;
                continue;
            }
            let neighbour = found.neighbour(graph, row, &moving);
            let differing = neighbour.map_or(moving.len(), |(differing, _)| differing);
            if differing > ALONE {
                return None;
            }
            is_chain |= neighbour.is_some();
            found.rows[k] = found.add(graph, row, &moving, neighbour.map(|(_, index)| index));
        }
        (is_chain && unknowns > 2 && found.are_carried_by_earlier_ones()).then_some(found)
    }

    fn are_carried_by_earlier_ones(&self) -> bool {
        let place = |index: usize| (self.all[index].place, index);
        let is_after =
            |(index, body): (usize, &Carried)| body.by.iter().all(|(j, _)| place(*j) < place(index));
        self.all.iter().enumerate().all(is_after)
    }

    /// How many unknowns move it otherwise than what moves most alike, a joint rather than a body, if that saves
    /// anything.
    fn neighbour(&self, graph: &mut Graph, row: &[ExprId], moving: &[usize]) -> Option<(usize, usize)> {
        limits::spend((self.all.len() - self.unknowns) * row.len() / 64);
        let others = self.all.iter().enumerate().skip(self.unknowns);
        let nearest = others.map(|(index, other)| {
            let differing = row.iter().zip(&other.row).filter(|(one, other)| one != other).count();
            (differing, other.place.1 == Kind::Body, index)
        });
        let nearest = nearest.min().filter(|(differing, ..)| moving.len() > 1 && *differing < moving.len());
        let (differing, is_body, index) = nearest?;
        // the joint of a body may be an unknown
        let one = graph.one();
        let joint = moving.iter().find(|j| is_body && row[**j] == one && moving.len() <= differing + 1);
        Some(joint.map_or((differing, index), |joint| (moving.len() - 1, *joint)))
    }

    /// Adds a velocity, and that of the joint through which all but the last unknown move it.
    fn add(
        &mut self,
        graph: &mut Graph,
        row: &[ExprId],
        moving: &[usize],
        neighbour: Option<usize>,
    ) -> usize {
        let (zero, one) = (graph.zero(), graph.one());
        let mut by: Vec<(usize, ExprId)> = neighbour.map(|index| (index, one)).into_iter().collect();
        for (j, entry) in row.iter().enumerate() {
            let known = neighbour.map_or(zero, |index| self.all[index].row[j]);
            let difference = graph.formula(entry - known);
            if difference != zero {
                by.push((j, difference));
            }
        }
        let last = moving.last().copied().unwrap_or_default();
        let (own, outer): (Vec<_>, Vec<_>) = by.iter().copied().partition(|(index, _)| *index == last);
        // a neighbour behind the same joint is no joint
        let is_before = neighbour.is_none_or(|index| self.all[index].place < (last, Kind::Body));
        if !own.is_empty() && outer.len() > 1 && is_before {
            let mut joint = row.to_vec();
            joint[last] = zero;
            let known = self.all.iter().position(|body| body.row == joint);
            let index = known.unwrap_or(self.all.len());
            if known.is_none() {
                self.all.push(Carried { row: joint, by: outer, place: (last, Kind::Joint) });
            }
            by = [vec![(index, one)], own].concat();
        }
        self.all.push(Carried { row: row.to_vec(), by, place: (last, Kind::Body) });
        self.all.len() - 1
    }

    /// The bodies one after the other.
    pub(super) fn ordered(
        &self,
        graph: &mut Graph,
        (along, mut by_unknowns): (&mut Along, Option<Along>),
        (unknowns, dependent): (&[ExprId], &[Dependent]),
        turns: &Turns,
        procedure: &mut Procedure,
    ) -> Order {
        let mut order: Vec<usize> = (0..self.all.len()).collect();
        order.sort_by_key(|index| (self.all[*index].place, *index));
        let mut places = vec![0; self.all.len()];
        for (place, index) in order.iter().enumerate() {
            places[*index] = place;
        }
        let mut velocities: Vec<ExprId> = Vec::with_capacity(order.len());
        for index in &order {
            let value = if *index < self.unknowns {
                unknowns[*index]
            } else {
                let moved =
                    self.all[*index].by.iter().map(|(j, c)| graph.formula(c * velocities[places[*j]]));
                let moved: Vec<ExprId> = moved.collect();
                let velocity = graph.sum(&moved);
                procedure.define(graph, "velocity", velocity)
            };
            velocities.push(value);
        }
        let velocity_of = |index: usize| velocities[places[index]];
        let mut accelerations = Vec::with_capacity(order.len());
        for index in &order {
            if *index < self.unknowns {
                let given = dependent.iter().find(|dependent| dependent.unknown == *index);
                accelerations.push(given.map_or(Acceleration::Free, |Dependent { row, bias, .. }| {
                    let moving = row.iter().enumerate().filter(|(_, entry)| !graph.is_literal_zero(**entry));
                    let by = moving.map(|(j, entry)| (places[j], *entry)).collect();
                    Acceleration::Carried { by, bias: *bias }
                }));
                continue;
            }
            let carried = &self.all[*index].by;
            let turned = turns.terms(graph, *index, self, (unknowns, &velocity_of));
            let bias = |graph: &mut Graph, along: &mut Along| {
                let mut terms = turned.clone();
                for (j, coefficient) in carried {
                    let change = along.apply(graph, *coefficient);
                    terms.push(graph.formula(change * velocity_of(*j)));
                }
                graph.sum(&terms)
            };
            let mut shortest = bias(graph, along);
            if let Some(by_unknowns) = by_unknowns.as_mut().filter(|_| !turned.is_empty()) {
                let met = bias(graph, by_unknowns);
                let met = graph.simplify(met);
                if graph.operation_count(&[met]) < graph.operation_count(&[shortest]) {
                    shortest = met;
                }
            }
            let bias = shortest;
            let by = carried.iter().map(|(j, coefficient)| (places[*j], *coefficient)).collect();
            accelerations.push(Acceleration::Carried { by, bias });
        }
        let place = |index: &usize| places[*index];
        let (of_unknowns, of_rows) =
            (places[..self.unknowns].to_vec(), self.rows.iter().map(place).collect());
        Order { accelerations, velocities, of_unknowns, of_rows }
    }
}
