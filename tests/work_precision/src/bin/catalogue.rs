//! What accuracy costs for every reference system, in both formulations where there are two:
//! `cargo run --release -p nh-work-precision --features catalogue --bin catalogue [name …]`.
//!
//! Each runs from the start of a trajectory of the reference data to its end; systems with inputs get those
//! of the data. A name is that of a declaration in `tests/src/systems`.

use std::rc::Rc;

use nh_tests::catalogue::{Catalogued, Driven, name_of};
use nh_tests::reference::{ParameterSet, System};
use nh_tests::systems;
use nh_work_precision::Study;
use nonholonomic::Dim;
use nonholonomic::prelude::*;

/// Adds a declaration to the study of its motion.
fn vary<S: Catalogued + Clone + 'static>(study: &mut Study, formulation: &str, set: &ParameterSet) {
    let driven = Driven { system: S::parameters(&set.values), values: Rc::new(set.values.clone()) };
    let Some(first) = set.trajectories.first().and_then(|samples| samples.first()) else { return };
    let mut start = <<S::State as State>::Dim as Dim>::vec(0.0);
    for (number, component) in start.as_mut().iter_mut().zip(S::state(&first.state)) {
        *number = component.value;
    }
    study.variant(formulation, driven, S::State::from_array(start)).explicit().implicit();
}

/// The study of a declaration's motion with ordinary parameters.
fn motion<S: Catalogued>() -> Option<(Study, ParameterSet)> {
    let set = System::read(S::REFERENCE).parameter_sets.into_iter().find(|set| {
        let has_motion = set.trajectories.first().is_some_and(|samples| samples.len() > 1);
        !set.extreme && S::covers(&set.values) && has_motion
    })?;
    let samples = set.trajectories.first()?;
    let (from, to) = (samples.first()?.t, samples.last()?.t);
    Some((Study::new(name_of::<S>(), from, to), set))
}

/// A declaration's name, and how its study is made.
type Maker = (&'static str, fn() -> Option<Study>);

/// Every declaration of the catalogue, with its projected twin.
fn all() -> Vec<Maker> {
    macro_rules! studies {
        ($($module:ident { $($declared:ident $(, $projected:ident)?;)* })*) => {
            vec![$($((stringify!($declared), || {
                let (mut study, set) = motion::<systems::$module::$declared>()?;
                vary::<systems::$module::$declared>(&mut study, "as declared", &set);
                $(vary::<systems::$module::$projected>(&mut study, "projected", &set);)?
                Some(study)
            }),)*)*]
        };
    }
    nh_tests::every_system!(studies)
}

fn main() -> std::io::Result<()> {
    let all = all();
    let wanted = nh_work_precision::wanted(&all.iter().map(|(name, _)| *name).collect::<Vec<_>>())?;
    for (name, make) in all {
        if wanted.contains(&name)
            && let Some(study) = make()
        {
            study.finish()?;
        }
    }
    Ok(())
}
