//! Runs of many: each its own, in order, whether one after the other or on all cores.

use nonholonomic::ensemble::{self, Member};
use nonholonomic::prelude::*;

use crate::systems::{Pendulum, Plane, Torque};

type Swing = Member<Pendulum<f64>, Dopri5<f64>>;

/// Pendulums of many lengths; every seventh has a parameter that is refused, every eleventh may take few steps.
fn members() -> Vec<Swing> {
    let member = |i: u32| {
        let g = if i % 7 == 3 { -1.0 } else { 1.5_f64.powi(i32::try_from(i % 20).unwrap()) };
        let start = Plane { q: 0.01 * f64::from(i), p: 0.0 };
        let limit = if i % 11 == 5 { 3 } else { 1_000_000 };
        Member::new(Integrator::new(Pendulum { g }, Dopri5::new().rtol(1e-8), 0.0, start).max_steps(limit))
    };
    (0..200).map(member).collect()
}

/// What there is to compare of a member, bit for bit.
type Seen = (f64, Plane<f64>, Statistics, Result<(), IntegrationError>);

fn seen(members: &[Swing]) -> Vec<Seen> {
    members.iter().map(|m| (m.sim.time(), *m.state(), m.sim.statistics(), m.outcome)).collect()
}

#[test]
fn a_member_runs_as_if_it_were_alone() {
    let mut all = members();
    let mut copies = all.clone();
    let arrived = ensemble::advance_to(&mut all, 2.0);
    assert_eq!((ensemble::advance_to(&mut copies, 2.0), seen(&copies)), (arrived, seen(&all)));
    let mut alone = members();
    for member in &mut alone {
        member.outcome = member.sim.advance_to(2.0);
    }
    assert_eq!(seen(&all), seen(&alone));
    assert_eq!(arrived, all.iter().filter(|member| member.outcome.is_ok()).count());
    assert!(arrived > 100 && arrived < 180, "{arrived}");
}

#[test]
fn who_has_failed_waits_until_it_is_mended() {
    let mut all = members();
    ensemble::advance_to(&mut all, 1.0);
    let before = seen(&all);
    assert!(matches!(before[3].3, Err(IntegrationError::Parameter(_))));
    all[3].sim.system_mut().g = 2.0;
    ensemble::advance_to(&mut all, 2.0);
    assert_eq!(seen(&all)[3], before[3]);
    all[3].outcome = Ok(());
    ensemble::advance_to(&mut all, 2.0);
    assert_eq!((all[3].outcome, all[3].sim.time()), (Ok(()), 2.0));
    // a limit is met anew at every call
    assert!(all[5].outcome.is_err() && all[5].sim.time() > 0.0);
}

#[test]
fn runs_may_be_anything() {
    let mut all = members();
    let well = ensemble::each(&mut all, |sim| {
        sim.set_input(Torque { torque: 0.5 });
        sim.advance_to(0.5)?;
        sim.set_input(Torque { torque: -0.5 });
        sim.advance_to(1.0)
    });
    assert!(well > 100);
    assert!(all.iter().all(|member| member.outcome.is_err() || member.sim.time() == 1.0));
}

#[cfg(feature = "rayon")]
#[test]
fn on_all_cores_the_bits_are_the_same() {
    let (mut one_by_one, mut on_all) = (members(), members());
    let arrived = ensemble::advance_to(&mut one_by_one, 3.0);
    assert_eq!(ensemble::par_advance_to(&mut on_all, 3.0), arrived);
    assert_eq!(seen(&one_by_one), seen(&on_all));
}
