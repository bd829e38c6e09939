//! What the target assumes of its parameters: asked of those that the map gives it, since what is proved of its motions
//! is proved of these.

use super::bundle_map::BundleMap;
use super::side::Side;
use crate::check::evidence::shown;
use crate::check::follows;
use crate::model::Assumption;
use crate::violation::{Law, Violation};

/// The assumptions of the target that do not follow from those of the source, and a line for each of which that was not
/// decided.
pub(super) fn assumed(source: &mut Side, target: &Side, map: &BundleMap) -> (Vec<Violation>, Vec<String>) {
    let (mut broken, mut undecided) = (Vec::new(), Vec::new());
    let (from, to) = (source.name(), target.name());
    for assumption in &target.proved.model.assumptions {
        let mut pull_back = map.pull_back(target);
        let graph = source.graph();
        let [left, right] = [assumption.left, assumption.right].map(|side| pull_back.apply(graph, side));
        let text = &assumption.text;
        let there = Assumption { left, right, ..assumption.clone() };
        let facts = source.proved.facts.clone();
        match follows(&mut source.proved.model, &facts, &there) {
            Some(true) => {}
            Some(false) => {
                let graph = &mut source.proved.model.graph;
                let difference = graph.formula(left - right);
                let difference = graph.simplify(difference);
                let relation = assumption.relation.sign();
                broken.push(Violation {
                    law: Law::Morphism,
                    origin: map.origin,
                    what: format!("`{to}` assumes `{text}`, which `{from}` does not"),
                    evidence: format!(
                        "after the map it says {} {relation} 0, and there are parameters that are as `{from}` \
                         assumes and do not satisfy it: `validate` refuses what they are mapped to",
                        shown(graph, difference)
                    ),
                    way_out: format!("assume it in `{from}` as well, or leave it out of `{to}`"),
                });
            }
            None => undecided.push(format!(
                "{to} assumes `{text}`: that this follows from what {from} assumes was not decided, and `validate` of \
                 the image asks it."
            )),
        }
    }
    (broken, undecided)
}
