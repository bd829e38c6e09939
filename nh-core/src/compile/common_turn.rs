//! Motions that stay what they are when all angles turn together, as those of linkages and arms do without gravity:
//! every angle is counted from one of them, which leaves a sine and a cosine less, and products with them.

use crate::algebra::{Bounded, Function, Graph, Node, Substitution};
use crate::choose::{Contender, Decision, Fate, ranking, rate};
use crate::id::{ExprId, SymbolId};
use crate::mechanics::{Definition, Procedure};
use rustc_hash::FxHashMap;
use std::collections::BTreeSet;

/// An angle by which the others turn where it is looked whether something changes.
const TURN: f64 = 0.7;
/// The share of a value, and of what it is the sum of, that rounding may take there.
const ROUNDING: f64 = 1e-9;

/// A motion that stays what it is when all angles turn together, as it was before they were counted from one of them.
/// Its derivatives stay what they are, too. An angle that others are counted from enters nothing but the few places that it
/// was declared in; by the differences it would enter with all others, with terms that cancel.
pub(crate) struct BeforeCounting {
    pub(super) motion: Procedure,
    angles: Vec<SymbolId>,
    from: SymbolId,
}

impl BeforeCounting {
    /// A function that does not change either, with its angles counted.
    pub(super) fn counted(&self, graph: &mut Graph, function: &Procedure) -> Procedure {
        let is_turned = vec![true; function.outputs.len()];
        counted(graph, function, (&self.angles, self.from), &is_turned)
    }
}

/// The motion with its angles counted from the one that leaves the fewest sines, if that is proved and cheaper than the
/// procedure as it stands. `admit` says whether a procedure is the motion; what it was is left in `before`, where all of it
/// does not change.
pub(super) fn counted_from_an_angle(
    graph: &mut Graph,
    procedure: &Procedure,
    coordinates: &[SymbolId],
    (admit, decisions): (impl Fn(&mut Graph, &Procedure) -> Fate, &mut Vec<Decision>),
    before: &mut Option<BeforeCounting>,
) -> Option<Procedure> {
    let is_formula = |definition: &Definition| matches!(definition, Definition::Value { .. });
    if !procedure.definitions.iter().all(is_formula) {
        return None;
    }
    let arguments = arguments(graph, procedure);
    let is_argument =
        |symbol: &&SymbolId| arguments.iter().any(|angle| graph.depends_on(*angle, &[**symbol]));
    let angles: Vec<SymbolId> = coordinates.iter().filter(is_argument).copied().collect();
    if angles.len() < 2 {
        return None;
    }
    let is_turned = turned_outputs(graph, procedure, &angles)?;
    let from = angles.iter().copied().min_by_key(|from| sines_left(graph, &arguments, (&angles, *from)))?;
    let counted = counted(graph, procedure, (&angles, from), &is_turned);
    if self::arguments(graph, &counted).len() >= arguments.len() {
        return None;
    }
    let mut forms = [procedure.clone(), counted];
    let ratings = rate(graph, &forms);
    let best = ranking(&ratings).first().copied().filter(|best| *best > 0)?;
    let fate = admit(graph, &forms[best]);
    let is_admitted = matches!(fate, Fate::Chosen(_));
    let form = "counted from one of them";
    let contenders: Vec<Contender> = vec![
        ratings[best].contender(form, fate),
        ratings[0].contender("as they are declared", ratings[0].loss()),
    ];
    decisions.push(Decision { site: "angles", contenders, limits: Vec::new() });
    if !is_admitted {
        return None;
    }
    if is_turned.iter().all(|is_turned| *is_turned) {
        *before = Some(BeforeCounting { motion: procedure.clone(), angles, from });
    }
    Some(std::mem::take(&mut forms[best]))
}

/// Every angle less one of them.
fn differences(graph: &mut Graph, (angles, from): (&[SymbolId], SymbolId)) -> Substitution {
    let first = graph.symbol(from);
    let mut images = Substitution::new([]);
    for angle in angles {
        let own = graph.symbol(*angle);
        let image = graph.formula(own - first);
        images.insert(*angle, image);
    }
    images
}

/// Of how many angles sines and cosines are taken, where they were taken of `arguments`, if all are counted from one.
fn sines_left(graph: &mut Graph, arguments: &BTreeSet<ExprId>, counted: (&[SymbolId], SymbolId)) -> usize {
    let mut images = differences(graph, counted);
    let mut left = BTreeSet::new();
    for argument in arguments {
        let image = images.apply(graph, *argument);
        // that of an angle is that of its negative
        let cosine = graph.cos(image);
        if graph.as_number(cosine).is_none() {
            left.insert(cosine);
        }
    }
    left.len()
}

/// What sines and cosines are taken of.
fn arguments(graph: &Graph, procedure: &Procedure) -> BTreeSet<ExprId> {
    let nodes = graph.reachable(&procedure.expressions()).into_iter();
    let argument = |id| match graph.node(id) {
        Node::Apply(Function::Sin | Function::Cos, angle) => Some(*angle),
        _ => None,
    };
    nodes.filter_map(argument).collect()
}

/// Which outputs do not change, in numbers, when the angles turn together; `None` where an output does that is made of
/// intermediate results. Others, as the rates of a place on the plane, can stay as they are.
fn turned_outputs(graph: &Graph, procedure: &Procedure, angles: &[SymbolId]) -> Option<Vec<bool>> {
    let [before, after, rounded] = [(0.0, 0.0), (TURN, 0.0), (0.0, ROUNDING)]
        .map(|(turn, rounding)| values(graph, procedure, (angles, turn), rounding));
    let named: Vec<SymbolId> = procedure
        .definitions
        .iter()
        .filter_map(|definition| match definition {
            Definition::Value { symbol, .. } => Some(*symbol),
            _ => None,
        })
        .collect();
    let pairs = procedure.outputs.iter().zip(before.into_iter().zip(after).zip(rounded));
    let is_turned = pairs.map(|(output, ((before, after), rounded))| {
        let own = ROUNDING * (size(before) + size(after));
        let of_intermediate = (rounded.value - before.value).abs();
        let is_same = (before.value - after.value).abs() <= own + of_intermediate;
        (is_same || !graph.depends_on(*output, &named)).then_some(is_same)
    });
    is_turned.collect()
}

/// How large the terms of a value are: what was rounded on the way is as large as the bound on it says.
fn size(value: Bounded) -> f64 {
    value.error / f64::EPSILON
}

/// The outputs at some place, with the angles turned, and with intermediate results that are off by a share of their size.
fn values(
    graph: &Graph,
    procedure: &Procedure,
    (angles, turn): (&[SymbolId], f64),
    rounding: f64,
) -> Vec<Bounded> {
    let mut known: FxHashMap<SymbolId, f64> = FxHashMap::default();
    let at = |known: &FxHashMap<SymbolId, f64>, symbol: SymbolId| {
        // numbers between 1/2 and 3/2 without a pattern
        let spread = |index: u32| 0.5 + (f64::from(index) * 0.618_033_988_749_894_9).fract();
        let own = spread(u32::try_from(crate::id::Id::index(symbol)).unwrap_or_default());
        let value = known.get(&symbol).copied().unwrap_or(own);
        if angles.contains(&symbol) { value + turn } else { value }
    };
    for definition in &procedure.definitions {
        if let Definition::Value { symbol, value } = definition {
            let value = graph.evaluate(&[*value], |symbol| at(&known, symbol));
            let off = rounding * at(&FxHashMap::default(), *symbol);
            known.extend(value.first().map(|bounded| (*symbol, bounded.value + off * size(*bounded))));
        }
    }
    graph.evaluate(&procedure.outputs, |symbol| at(&known, symbol))
}

/// The procedure at the place that all angles turn to when one of them is turned to 0.
fn counted(
    graph: &mut Graph,
    procedure: &Procedure,
    turn: (&[SymbolId], SymbolId),
    is_turned: &[bool],
) -> Procedure {
    let mut images = differences(graph, turn);
    let mut result = procedure.clone();
    result.definitions.clear();
    for definition in &procedure.definitions {
        let Definition::Value { symbol, value } = definition else { continue };
        let value = images.apply(graph, *value);
        // what has become a number, or another result, needs no name
        if graph.as_number(value).is_some() || graph.as_symbol(value).is_some() {
            images.insert(*symbol, value);
        } else {
            result.definitions.push(Definition::Value { symbol: *symbol, value });
        }
    }
    for (output, is_turned) in result.outputs.iter_mut().zip(is_turned) {
        if *is_turned {
            *output = images.apply(graph, *output);
        }
    }
    for solved in &mut result.solved {
        solved.replace(|entry| images.apply(graph, entry));
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::choose::{fate, prove_equal};

    /// Angles a, b, c, a velocity v, and what is made of the angles: cosines of differences, written in sums of products
    /// and not.
    struct Links {
        graph: Graph,
        angles: [SymbolId; 3],
        velocity: ExprId,
        procedure: Procedure,
    }

    fn links() -> Links {
        let mut graph = Graph::new();
        let angles = ["a", "b", "c"].map(|name| graph.new_symbol(name));
        let velocity = graph.new_symbol("v");
        let velocity = graph.symbol(velocity);
        let [a, b, c] = angles.map(|angle| graph.symbol(angle));
        let [(sa, ca), (sb, cb)] = [a, b].map(|angle| (graph.sin(angle), graph.cos(angle)));
        let [ac, bc] = [a, b].map(|angle| graph.formula(angle - c));
        let [far, near] = [ac, bc].map(|angle| graph.cos(angle));
        let mut procedure = Procedure::default();
        let apart = graph.formula(ca * cb + sa * sb);
        let apart = procedure.define(&mut graph, "apart", apart);
        procedure.outputs = vec![graph.formula(apart * far + velocity * near)];
        Links { graph, angles, velocity, procedure }
    }

    /// What becomes of the procedure, where it has to compute the same, and how many decisions there were.
    fn counted_of(links: &mut Links) -> (Option<Procedure>, usize) {
        let Links { graph, angles, procedure, .. } = links;
        let mut decisions = Vec::new();
        let admit = |graph: &mut Graph, other: &Procedure| fate(prove_equal(graph, procedure, other));
        let found = counted_from_an_angle(graph, procedure, angles, (admit, &mut decisions), &mut None);
        (found, decisions.len())
    }

    #[test]
    fn angles_are_counted_from_one_of_them() {
        let mut links = links();
        let (found, _) = counted_of(&mut links);
        let found = found.expect("it is cheaper");
        assert_eq!(arguments(&links.graph, &links.procedure).len(), 4);
        assert_eq!(arguments(&links.graph, &found).len(), 2);
        prove_equal(&links.graph, &links.procedure, &found).expect("the same values");
    }

    #[test]
    fn rates_in_the_plane_stay_in_it() {
        let mut links = links();
        let heading = links.graph.symbol(links.angles[0]);
        let heading = links.graph.cos(heading);
        let rate = links.graph.formula(links.velocity * heading);
        links.procedure.outputs.push(rate);
        let (found, _) = counted_of(&mut links);
        let found = found.expect("it is cheaper");
        assert_eq!(found.outputs[1], rate);
        prove_equal(&links.graph, &links.procedure, &found).expect("the same values");
    }

    #[test]
    fn what_changes_with_the_common_turn_stays() {
        let mut links = links();
        let heading = links.graph.symbol(links.angles[0]);
        let weight = links.graph.sin(heading);
        links.procedure.outputs[0] = links.graph.formula(links.procedure.outputs[0] + weight);
        assert!(matches!(counted_of(&mut links), (None, 0)));
    }

    /// In whatever units the values are written.
    #[test]
    fn a_small_weight_is_noticed_in_small_units() {
        for exponent in [-40, -12, 12] {
            let mut links = links();
            let heading = links.graph.symbol(links.angles[0]);
            let unit = links.graph.number(crate::algebra::Rational::from(10).pow(exponent).expect("not 0"));
            let weight = links.graph.sin(heading);
            let output = links.procedure.outputs[0];
            links.procedure.outputs[0] = links.graph.formula(unit * output + unit * weight);
            assert!(matches!(counted_of(&mut links), (None, 0)), "10^{exponent}");
        }
    }

    #[test]
    fn what_is_not_admitted_is_not_taken() {
        let mut links = links();
        let Links { graph, angles, procedure, .. } = &mut links;
        let mut decisions = Vec::new();
        let admit = |_: &mut Graph, _: &Procedure| Fate::NotAdmitted("not proved".into());
        let mut before = None;
        let judged = (admit, &mut decisions);
        assert!(counted_from_an_angle(graph, procedure, angles, judged, &mut before).is_none());
        assert!(before.is_none());
        assert_eq!(decisions.len(), 1);
    }
}
