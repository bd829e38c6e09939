//! Where a declaration has no value: divisors that may vanish, roots and logarithms of what may be negative.

use super::assumptions::on_the_base;
use super::at_rest::has_slopes_at_rest;
use super::declared::differentiated;
use super::evidence::shown;
use crate::algebra::{Demand, Facts, Function, Function2, Graph, Node, Rational};
use crate::id::{ExprId, SymbolId};
use crate::model::Model;

/// What an expression of coordinates, velocities, inputs or time must be for the declaration to have a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Condition {
    /// It is divided by.
    Nonzero(ExprId),
    /// Its logarithm or a negative fractional power of it is taken.
    Positive(ExprId),
    /// A root of it is taken.
    NotNegative(ExprId),
    /// Its inverse sine or cosine is taken.
    InUnitInterval(ExprId),
    /// The derivative of its inverse sine or cosine is taken.
    InsideUnitInterval(ExprId),
    /// The angle of the point (second, first) is taken.
    NotBothZero(ExprId, ExprId),
}

impl Condition {
    /// As an inequality.
    #[must_use]
    pub fn stated(self, graph: &Graph) -> String {
        match self {
            Self::Nonzero(e) => format!("{} != 0", shown(graph, e)),
            Self::Positive(e) => format!("{} > 0", shown(graph, e)),
            Self::NotNegative(e) => format!("{} >= 0", shown(graph, e)),
            Self::InUnitInterval(e) => format!("|{}| <= 1", shown(graph, e)),
            Self::InsideUnitInterval(e) => format!("|{}| < 1", shown(graph, e)),
            Self::NotBothZero(y, x) => {
                format!("not both {} = 0 and {} = 0", shown(graph, y), shown(graph, x))
            }
        }
    }
}

/// Of more conditions it is not asked whether they hold everywhere all the same.
const ASKED: usize = 8;

/// The conditions under which anchor, brackets, Lagrangian, constraints, forces and rates of auxiliary states have
/// values, as far as these do not hold everywhere by the facts. That an expression of parameters alone is not 0 is not
/// among them, since `validate` checks it.
#[must_use]
pub fn domain(model: &mut Model, facts: &Facts) -> Vec<Condition> {
    let open = not_by_ranges(model, facts, 0);
    not_proved(model, open)
}

/// The conditions under which the derivatives of the equations have values, as far as the equations do not have them: a root
/// of what vanishes has a value and no derivative.
#[must_use]
pub fn domain_of_derivatives(model: &mut Model, facts: &Facts, of_equations: &[Condition]) -> Vec<Condition> {
    let open = not_by_ranges(model, facts, 1);
    beyond(model, open, of_equations)
}

/// Of such conditions, those without which the derivatives do not tend to values.
#[must_use]
pub fn without_slopes_at_rest(model: &mut Model, facts: &Facts, conditions: &[Condition]) -> Vec<Condition> {
    let mut left = conditions.to_vec();
    left.retain(|condition| match condition {
        Condition::Positive(base) => !has_slopes_at_rest(model, facts, *base),
        _ => true,
    });
    left
}

/// The conditions under which further expressions have values, as far as the equations do not have them.
#[must_use]
pub fn domain_of(
    model: &mut Model,
    facts: &Facts,
    (values, derivatives): (&[ExprId], u32),
    of_equations: &[Condition],
) -> Vec<Condition> {
    let mut open = Vec::new();
    add_open(model, facts, values, derivatives, &mut open);
    beyond(model, open, of_equations)
}

/// Those of some conditions that may fail where the equations have values.
fn beyond(model: &mut Model, mut open: Vec<Condition>, of_equations: &[Condition]) -> Vec<Condition> {
    open.extend(of_equations);
    let mut open = without_implied(&open);
    open.retain(|condition| !of_equations.contains(condition));
    not_proved(model, open)
}

/// Those of some conditions that may fail somewhere on the base.
fn not_proved(model: &mut Model, open: Vec<Condition>) -> Vec<Condition> {
    if open.is_empty() || open.len() > ASKED {
        return open;
    }
    let holding = on_the_base(model);
    open.into_iter().filter(|condition| !is_proved(&mut model.graph, *condition, &holding)).collect()
}

/// The factors of some divisors that may vanish somewhere on the base.
#[must_use]
pub fn with_zeros(model: &mut Model, divisors: &[ExprId]) -> Vec<ExprId> {
    let mut left: Vec<ExprId> = Vec::new();
    for divisor in divisors {
        let factors = model.graph.factors(*divisor).into_iter();
        let bases = factors.filter(|(_, exponent)| !exponent.is_negative()).map(|(base, _)| base);
        let new = bases.filter(|base| model.graph.value_of(*base).is_none() && !left.contains(base));
        let new: Vec<ExprId> = new.collect();
        left.extend(new);
    }
    if left.is_empty() || left.len() > ASKED {
        return left;
    }
    let holding = on_the_base(model);
    left.retain(|divisor| !is_proved(&mut model.graph, Condition::Nonzero(*divisor), &holding));
    left
}

/// Those that ranges alone do not prove, of what differentiates the equations so many times.
fn not_by_ranges(model: &Model, facts: &Facts, times: u32) -> Vec<Condition> {
    let mut found: Vec<Condition> = Vec::new();
    let mut look_at =
        |roots: &[ExprId], derivatives: u32| add_open(model, facts, roots, derivatives + times, &mut found);
    // the equations differentiate L twice, what else moves once, and forces and rates of auxiliary states not at all
    look_at(&[model.lagrangian.value], 2);
    let mut rest: Vec<ExprId> = differentiated(model).into_iter().map(|(_, value, _)| value).collect();
    rest.extend(&model.shortened);
    look_at(&rest, 1);
    let forces = model.forces.iter().map(|force| force.value);
    let given: Vec<ExprId> = forces.chain(model.auxiliary.iter().map(|state| state.value)).collect();
    look_at(&given, 0);
    without_implied(&found)
}

/// Those that do not follow from others.
fn without_implied(found: &[Condition]) -> Vec<Condition> {
    // what has to be positive need not be said to be not negative as well
    let implied = |condition: &Condition| match condition {
        Condition::NotNegative(e) | Condition::Nonzero(e) => found.contains(&Condition::Positive(*e)),
        Condition::InUnitInterval(e) => found.contains(&Condition::InsideUnitInterval(*e)),
        Condition::NotBothZero(y, x) => [y, x].into_iter().any(|part| {
            found.contains(&Condition::Positive(*part)) || found.contains(&Condition::Nonzero(*part))
        }),
        Condition::Positive(_) | Condition::InsideUnitInterval(_) => false,
    };
    found.iter().filter(|condition| !implied(condition)).copied().collect()
}

/// Adds the conditions of expressions that are differentiated so many times, where ranges do not prove them.
fn add_open(model: &Model, facts: &Facts, roots: &[ExprId], derivatives: u32, found: &mut Vec<Condition>) {
    let graph = &model.graph;
    let parameters: Vec<SymbolId> = model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let varies = |e: ExprId| graph.symbols_in(&[e]).iter().any(|symbol| !parameters.contains(symbol));
    for id in graph.reachable(roots) {
        // nothing is differentiated by parameters
        let undifferentiated = conditions(graph, id, 0);
        for ((expression, condition), (_, of_value)) in
            conditions(graph, id, derivatives).into_iter().zip(undifferentiated)
        {
            let condition = if varies(expression) { condition } else { of_value };
            let is_asked = varies(expression) || !matches!(condition, Condition::Nonzero(_));
            if is_asked && !holds(graph, condition, facts) && !found.contains(&condition) {
                found.push(condition);
            }
        }
    }
}

/// What one node asks of its operands if its value is differentiated so many times.
pub(super) fn conditions(graph: &Graph, id: ExprId, derivatives: u32) -> Vec<(ExprId, Condition)> {
    match graph.node(id) {
        Node::Product { factors, .. } => factors
            .iter()
            .filter_map(|(base, exponent)| match (exponent.is_integer(), exponent.is_negative()) {
                (true, true) => Some((*base, Condition::Nonzero(*base))),
                (false, true) => Some((*base, Condition::Positive(*base))),
                (false, false) if *exponent < Rational::from(i64::from(derivatives)) => {
                    Some((*base, Condition::Positive(*base)))
                }
                (false, false) => Some((*base, Condition::NotNegative(*base))),
                (true, false) => None,
            })
            .collect(),
        Node::Apply(Function::Ln, x) => vec![(*x, Condition::Positive(*x))],
        Node::Apply(Function::Asin | Function::Acos, x) if derivatives > 0 => {
            vec![(*x, Condition::InsideUnitInterval(*x))]
        }
        Node::Apply(Function::Asin | Function::Acos, x) => vec![(*x, Condition::InUnitInterval(*x))],
        Node::Apply2(Function2::Atan2, y, x) => vec![(id, Condition::NotBothZero(*y, *x))],
        _ => Vec::new(),
    }
}

/// Whether the contrary contradicts what holds at every point of the base.
fn is_proved(graph: &mut Graph, condition: Condition, holding: &[(ExprId, Demand)]) -> bool {
    let one = graph.one();
    if let Condition::InsideUnitInterval(e) = condition {
        let ends = [graph.formula(one - e), graph.formula(one + e)];
        // the arc of what is 1 everywhere by an identity is a number, which has a slope
        if ends.into_iter().any(|end| graph.zero_test(end).is_zero()) {
            return true;
        }
    }
    let ways: Vec<Vec<(ExprId, Demand)>> = match condition {
        Condition::Nonzero(e) => vec![vec![(e, Demand::Zero)]],
        Condition::Positive(e) => vec![vec![(graph.formula(-e), Demand::NotNegative)]],
        Condition::NotNegative(e) => vec![vec![(graph.formula(-e), Demand::Positive)]],
        Condition::InUnitInterval(e) | Condition::InsideUnitInterval(e) => {
            let demand = match condition {
                Condition::InUnitInterval(_) => Demand::Positive,
                _ => Demand::NotNegative,
            };
            [graph.formula(e - one), graph.formula(-e - one)].map(|e| vec![(e, demand)]).to_vec()
        }
        Condition::NotBothZero(y, x) => vec![vec![(y, Demand::Zero), (x, Demand::Zero)]],
    };
    ways.into_iter().all(|contrary| {
        let about: Vec<ExprId> = contrary.iter().map(|(id, _)| *id).collect();
        let demands = [graph.related_demands(holding, &about), contrary].concat();
        graph.contradiction(&demands).is_some()
    })
}

/// Whether ranges prove it, by facts about parameters.
pub(super) fn holds(graph: &Graph, condition: Condition, facts: &Facts) -> bool {
    match condition {
        Condition::Nonzero(e) => graph.vanishes_nowhere(e, facts),
        Condition::Positive(e) => graph.range(e, facts).is_positive(),
        Condition::NotNegative(e) => graph.range(e, facts).is_not_negative(),
        Condition::InUnitInterval(e) => {
            let range = graph.range(e, facts);
            range.low >= -1.0 && range.high <= 1.0
        }
        Condition::InsideUnitInterval(e) => {
            let range = graph.range(e, facts);
            range.low > -1.0 && range.high < 1.0
        }
        Condition::NotBothZero(y, x) => [y, x].into_iter().any(|part| graph.vanishes_nowhere(part, facts)),
    }
}
