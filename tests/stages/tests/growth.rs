//! What a further body of a chain costs, in operations of the derivative: a constant, by mathematics (39).

use nh_stages::{declarations, families};
use nonholonomic_core::program::{Cost, schedule_grouping};
use nonholonomic_core::system::System;

fn member(family: &str, links: usize) -> System {
    let family = families().find(|known| known.name == family).expect("a family");
    family.member(links).system().unwrap_or_else(|messages| panic!("{}", messages.join("\n")))
}

fn operations(system: &System) -> f64 {
    let parameters: Vec<_> = system.model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let cost = Cost::of(&schedule_grouping(&system.model.graph, &system.derivative, &parameters));
    u32::try_from(cost.operations()).map_or(f64::INFINITY, f64::from)
}

/// From eight links on, one more takes what the last one took, within a twentieth.
#[track_caller]
fn grows_by_a_constant(family: &str, most: usize) {
    let counts: Vec<f64> = (8..=most).map(|links| operations(&member(family, links))).collect();
    let more: Vec<f64> = counts.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let mean = (counts[counts.len() - 1] - counts[0]) / f64::from(u32::try_from(more.len()).expect("few"));
    assert!(more.iter().all(|more| (more - mean).abs() <= mean / 20.0), "{family}: {counts:?}, {more:?}");
}

/// The form that is chosen for the derivative.
fn chosen(system: &System) -> String {
    let decision = system.ledger.at("derivative").expect("a derivative");
    decision.chosen().expect("one is proved").form.to_owned()
}

#[test]
fn arms_grow_by_a_constant() {
    for family in ["arm on two wheels", "arm on a skate", "arm in a vertical plane", "fast arms in pairs"] {
        grows_by_a_constant(family, 14);
    }
}

#[test]
fn pendulums_grow_by_a_constant() {
    for family in ["pendulum, absolute angles", "pendulum, relative angles"] {
        grows_by_a_constant(family, 14);
    }
}

#[test]
fn it_is_the_elimination_from_the_tips_that_does_it() {
    for family in ["arm on two wheels", "arm on a skate", "arm in a vertical plane", "fast arms in pairs"] {
        assert!(chosen(&member(family, 6)).starts_with("from the tips"), "{family}");
    }
}

/// Loops that share a crank with the next one, with multipliers: J W⁻¹ Jᵀ couples neighbours alone.
#[test]
fn chains_of_loops_grow_by_a_constant() {
    let counts: Vec<f64> =
        (5..=10).map(|loops| operations(&member("four-bars side by side", loops))).collect();
    let more: Vec<f64> = counts.windows(2).map(|pair| pair[1] - pair[0]).collect();
    assert!(more.iter().all(|one| (one - more[0]).abs() <= more[0] / 20.0), "{counts:?}, {more:?}");
    assert!(chosen(&member("four-bars side by side", 10)).starts_with("by complement"));
}

/// Blades that nothing couples, with multipliers: each takes what one takes, however many there are.
#[test]
fn blades_apart_take_what_each_takes() {
    let of = |blades: usize| {
        let source = format!(
            "#[nonholonomic(base {{ x[{blades}], y[{blades}], th[{blades}] }} lagrangian {{ sum(i in 0..{blades}: m/2*der(x[i])^2 + M/2*der(y[i])^2 + J/2*der(th[i])^2) }} constraints {{ for i in 0..{blades} {{ cos(th[i])*der(y[i]) = sin(th[i])*der(x[i]); }} }})] struct Blades {{ m: f64, M: f64, J: f64 }}"
        );
        let found = declarations(&source);
        operations(&found.first().expect("a declaration").system().expect("regular"))
    };
    let (one, ten) = (of(1), of(10));
    assert!(ten <= 10.0 * one, "{one}, {ten}");
}

const IN_SPACE: [&str; 4] =
    ["arm in space", "arm in space, skew axes", "fast arm in space, on wheels", "fast arm in space, afloat"];

#[test]
fn arms_in_space_grow_by_a_constant() {
    for family in IN_SPACE {
        grows_by_a_constant(family, 12);
    }
}

#[test]
fn it_is_the_elimination_joint_by_joint_that_does_it_in_space() {
    for family in IN_SPACE {
        assert!(chosen(&member(family, 9)).starts_with("joint by joint"), "{family}");
    }
}
