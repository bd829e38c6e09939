//! Auxiliary states are related: the rate of each is the same function of the motion on both sides.

use super::assuming;
use super::bundle_map::BundleMap;
use super::laws::{Sides, broken};
use super::side::Side;
use crate::violation::Violation;

/// ż = g and ż' = g' are related where the constraints hold: g = g' after the map, for each z' with its z. A source may
/// have auxiliary states that the target has not.
pub(super) fn auxiliary_states(source: &mut Side, target: &Side, map: &BundleMap) -> Vec<Violation> {
    let mut violations = Vec::new();
    let mut pull_back = map.pull_back(target);
    for (state, right) in target.proved.model.auxiliary.iter().zip(&target.rates) {
        let known = source.proved.model.auxiliary.iter().position(|known| known.name == state.name);
        let Some(left) = known.and_then(|place| source.rates.get(place)).copied() else { continue };
        let right = pull_back.apply(source.graph(), *right);
        let right = assuming(source, right);
        let defect = source.graph().sub(left, right);
        let verdict = source.vanishes_on_constraints(defect);
        if verdict.is_zero() {
            continue;
        }
        let (left, right) = (source.restricted(left), source.restricted(right));
        let what = format!("the rates of `{}` are not related", state.name);
        let words =
            [format!("that of `{}` is", source.name()), format!("and that of `{}` becomes", target.name())];
        let way_out = "correct one of them, the map, or the parameters".to_owned();
        violations.push(broken(source, map.origin, what, &Sides { left, right, words }, &verdict, way_out));
    }
    violations
}
