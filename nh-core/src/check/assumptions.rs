//! Facts about parameters, and contradictions among them.

use super::evidence::listed;
use crate::algebra::{Bounded, Contradiction, Demand, Facts, Graph, Range, Residue, sample};
use crate::id::{ExprId, SymbolId};
use crate::model::{Assumption, Model, Relation};
use crate::violation::{Law, Violation};

/// The facts that the declaration assumes.
///
/// # Errors
/// Assumptions about more than parameters, and assumptions that contradict others or the numbers.
pub fn facts(model: &mut Model) -> Result<Facts, Vec<Violation>> {
    let mut facts = Facts::default();
    let mut violations = Vec::new();
    let mut accepted: Vec<(Assumption, (ExprId, Demand))> = Vec::new();
    for assumption in model.assumptions.clone() {
        if let Some(violation) = stranger(model, &assumption) {
            violations.push(violation);
            continue;
        }
        let demand = demand(&mut model.graph, &assumption);
        accepted.push((assumption.clone(), demand));
        let demands: Vec<(ExprId, Demand)> = accepted.iter().map(|(_, demand)| *demand).collect();
        let contradiction = model.graph.contradiction(&demands);
        if contradiction.is_some() || !assume(&mut model.graph, &mut facts, &assumption) {
            accepted.pop();
            violations.push(Violation {
                law: Law::Assumption,
                origin: assumption.origin,
                what: format!("the assumption `{}` is contradictory", assumption.text),
                evidence: reason(&accepted, &assumption, contradiction.as_ref()),
                way_out: "correct or leave out one of them".into(),
            });
        }
    }
    let demands: Vec<(ExprId, Demand)> = accepted.into_iter().map(|(_, demand)| demand).collect();
    for (symbol, range) in model.graph.consequences(&demands).symbols {
        let known = facts.symbols.get(&symbol).copied().unwrap_or(Range::ALL);
        facts.symbols.insert(symbol, known.intersection(range));
    }
    if violations.is_empty() { Ok(facts) } else { Err(violations) }
}

/// What holds at every point of the base: what is assumed of parameters, and the identities of embedded coordinates.
pub fn on_the_base(model: &mut Model) -> Vec<(ExprId, Demand)> {
    let assumptions = model.assumptions.clone();
    let assumed =
        assumptions.iter().map(|assumption| demand(&mut model.graph, assumption)).collect::<Vec<_>>();
    let identities = model.identities.iter().map(|identity| (identity.value, Demand::Zero));
    assumed.into_iter().chain(identities).collect()
}

/// What [`on_the_base`] says, in words behind "no real values satisfy this".
pub(super) fn as_on_the_base(model: &Model) -> &'static str {
    match (model.assumptions.is_empty(), model.identities.is_empty()) {
        (true, true) => "",
        (false, true) => " for parameters as they are assumed",
        (true, false) => " on the embedded base",
        (false, false) => " on the embedded base, for parameters as they are assumed",
    }
}

/// Whether no parameters are known that satisfy all assumptions, although nothing contradicts these: what is assumed
/// is then accepted undecided.
#[must_use]
pub fn undecided(model: &Model, facts: &Facts) -> bool {
    !model.assumptions.is_empty() && !are_met_by_a_machine(&model.graph, facts, &model.assumptions)
}

/// Whether a further fact about the parameters follows from what is assumed of them; `None` where neither a proof was
/// found nor parameters that satisfy the assumptions and not it.
pub fn follows(model: &mut Model, facts: &Facts, fact: &Assumption) -> Option<bool> {
    let opposite = match fact.relation {
        Relation::Greater => Some(Relation::LessOrEqual),
        Relation::GreaterOrEqual => Some(Relation::Less),
        Relation::Less => Some(Relation::GreaterOrEqual),
        Relation::LessOrEqual => Some(Relation::Greater),
        Relation::NotEqual => None,
    };
    let opposite = opposite.map(|relation| Assumption { relation, ..fact.clone() });
    let assumed = model.assumptions.clone();
    let graph = &mut model.graph;
    let mut demands: Vec<(ExprId, Demand)> =
        assumed.iter().map(|assumption| demand(graph, assumption)).collect();
    demands.push(match &opposite {
        Some(opposite) => demand(graph, opposite),
        None => (graph.formula(fact.left - fact.right), Demand::Zero),
    });
    if graph.contradiction(&demands).is_some() {
        return Some(true);
    }
    let all: Vec<Assumption> = assumed.into_iter().chain(opposite).collect();
    let is_broken = fact.relation != Relation::NotEqual && are_met_by_a_machine(graph, facts, &all);
    is_broken.then_some(false)
}

/// Whether one of some machines is as assumed: parameters over some decades, within the ranges that are known.
fn are_met_by_a_machine(graph: &Graph, facts: &Facts, assumptions: &[Assumption]) -> bool {
    /// Machines that are tried, and the decades over which their parameters are spread.
    const MACHINES: u64 = 400;
    const DECADES: u64 = 9;
    let sides: Vec<ExprId> = assumptions.iter().flat_map(|fact| [fact.left, fact.right]).collect();
    let symbols = graph.symbols_in(&sides);
    let parameter = |machine: u64, index: usize, symbol: SymbolId| -> f64 {
        let number = sample(machine, index);
        let decade = Residue::mixed(machine, 1000 + index as u64).word() % DECADES;
        let number = if machine < MACHINES / 2 {
            number
        } else {
            number * 10.0_f64.powi(i32::try_from(decade).unwrap_or(0) - 4)
        };
        let range = facts.symbols.get(&symbol).copied().unwrap_or(Range::ALL);
        match (range.low.is_finite(), range.high.is_finite()) {
            (true, true) => range.low + (range.high - range.low) * (number.abs() / (1.0 + number.abs())),
            (true, false) => range.low + number.abs(),
            (false, true) => range.high - number.abs(),
            (false, false) => number,
        }
    };
    (0..MACHINES).any(|machine| {
        let value = |symbol: SymbolId| {
            let index = symbols.iter().position(|known| *known == symbol).unwrap_or_default();
            parameter(machine, index, symbol)
        };
        let values = graph.evaluate(&sides, value);
        let broken = |(fact, pair): (&Assumption, &[Bounded])| {
            let (left, right) = (pair[0].value, pair[1].value);
            !match fact.relation {
                Relation::Greater => left > right,
                Relation::GreaterOrEqual => left >= right,
                Relation::Less => left < right,
                Relation::LessOrEqual => left <= right,
                Relation::NotEqual => (left - right).abs() > 0.0,
            }
        };
        !assumptions.iter().zip(values.chunks(2)).any(broken)
    })
}

/// An assumption as a demand on one expression.
pub(super) fn demand(graph: &mut Graph, assumption: &Assumption) -> (ExprId, Demand) {
    let (left, right) = (assumption.left, assumption.right);
    match assumption.relation {
        Relation::Greater => (graph.formula(left - right), Demand::Positive),
        Relation::GreaterOrEqual => (graph.formula(left - right), Demand::NotNegative),
        Relation::Less => (graph.formula(right - left), Demand::Positive),
        Relation::LessOrEqual => (graph.formula(right - left), Demand::NotNegative),
        Relation::NotEqual => (graph.formula(left - right), Demand::Nonzero),
    }
}

/// Why an assumption contradicts those before it.
fn reason(
    before: &[(Assumption, (ExprId, Demand))],
    last: &Assumption,
    contradiction: Option<&Contradiction>,
) -> String {
    let alone = "no values of the parameters satisfy it";
    let together = if before.is_empty() {
        alone.to_owned()
    } else {
        format!("{alone} together with the assumptions before it")
    };
    let used = match contradiction {
        Some(Contradiction::Combination(used)) => used,
        Some(Contradiction::NegativeSquares(index)) if *index == before.len() => {
            return format!("{alone}: it is the negative of a sum of squares");
        }
        _ => return together,
    };
    let mut names: Vec<String> = Vec::new();
    for (index, multiplier) in used {
        let text = before.get(*index).map_or(last.text.as_str(), |(assumption, _)| assumption.text.as_str());
        let name = format!("`{text}`");
        if !multiplier.is_zero() && !names.contains(&name) {
            names.push(name);
        }
    }
    match names.as_slice() {
        [] | [_] => together,
        several => format!("{}, each times some positive number, add up to a contradiction", listed(several)),
    }
}

fn stranger(model: &Model, assumption: &Assumption) -> Option<Violation> {
    let parameters: Vec<SymbolId> = model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let graph = &model.graph;
    let symbols = graph.symbols_in(&[assumption.left, assumption.right]);
    let stranger = symbols.into_iter().find(|symbol| !parameters.contains(symbol))?;
    let name = &graph.symbols()[stranger];
    Some(Violation {
        law: Law::Assumption,
        origin: assumption.origin,
        what: format!("the assumption `{}` is about `{name}`, which is not a parameter", assumption.text),
        evidence: "assumptions are checked once, by `validate()`, and hold for the whole motion".into(),
        way_out: "assume facts about the fields of the struct only".into(),
    })
}

/// What `difference relation 0` says of the difference.
fn demanded(relation: Relation) -> Range {
    match relation {
        Relation::Greater => Range::POSITIVE,
        Relation::Less => Range { low: f64::NEG_INFINITY, high: 0.0, nonzero: true },
        Relation::GreaterOrEqual => Range { low: 0.0, ..Range::ALL },
        Relation::LessOrEqual => Range { high: 0.0, ..Range::ALL },
        Relation::NotEqual => Range { nonzero: true, ..Range::ALL },
    }
}

/// Adds a fact; false if nothing satisfies it together with those known.
fn assume(graph: &mut Graph, facts: &mut Facts, assumption: &Assumption) -> bool {
    let difference = graph.formula(assumption.left - assumption.right);
    let difference = graph.simplify(difference);
    let demanded = demanded(assumption.relation);
    let known = graph.range(difference, facts);
    if known.intersection(demanded).is_empty() {
        return false;
    }
    // a number satisfies the relation or does not; nothing is learned
    if graph.value_of(difference).is_some() {
        return true;
    }
    learn(graph, facts, difference, demanded);
    // c·x + d: a fact about x itself
    let numbers = graph.in_numbers(difference);
    let (constant, terms) = graph.as_linear(numbers);
    if let [(term, coefficient)] = terms.as_slice() {
        let (inner, rest) = graph.split_coefficient(*term);
        let slope = (coefficient.clone() * inner).to_f64();
        let shifted = demanded.shifted(-constant.to_f64()).scaled(1.0 / slope);
        learn(graph, facts, rest, shifted);
    }
    true
}

/// Records a range of an expression, of its negative, and of the form it has among factors.
fn learn(graph: &mut Graph, facts: &mut Facts, expression: ExprId, range: Range) {
    let content = graph.content(expression);
    let mut record = |graph: &Graph, expression: ExprId, range: Range| {
        let joined = graph.range(expression, facts).intersection(range);
        match graph.as_symbol(expression) {
            Some(symbol) => facts.symbols.insert(symbol, joined),
            None => facts.expressions.insert(expression, joined),
        };
    };
    record(graph, expression, range);
    let negative = graph.formula(-expression);
    record(graph, negative, range.scaled(-1.0));
    if let Some(inverse) = content.recip() {
        let primitive = graph.scale(inverse.clone(), expression);
        record(graph, primitive, range.scaled(inverse.to_f64()));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::id::{Id, Origin};

    fn assumption(left: ExprId, relation: Relation, right: ExprId) -> Assumption {
        Assumption { left, relation, right, text: String::new(), origin: Origin::from_index(0) }
    }

    #[test]
    fn facts_combine_and_contradict() {
        let mut g = Graph::new();
        let (m, a) = (g.new_symbol("m"), g.new_symbol("a"));
        let (em, ea) = (g.symbol(m), g.symbol(a));
        let (zero, one) = (g.zero(), g.one());
        let mut facts = Facts::default();
        assert!(assume(&mut g, &mut facts, &assumption(em, Relation::Greater, zero)));
        assert!(assume(&mut g, &mut facts, &assumption(ea, Relation::Less, em)));
        assert!(g.vanishes_nowhere(em, &facts));
        let gap = g.formula(em - ea);
        assert!(g.vanishes_nowhere(gap, &facts));
        assert!(!assume(&mut g, &mut facts, &assumption(em, Relation::Less, zero)));
        assert!(!assume(&mut g, &mut facts, &assumption(one, Relation::Less, zero)));
        let twice = g.scale(2.into(), em);
        assert!(assume(&mut g, &mut facts, &assumption(twice, Relation::LessOrEqual, one)));
        let two = g.number(2);
        assert!(!assume(&mut g, &mut facts, &assumption(em, Relation::Greater, two)));
    }
}
