//! The law of units: no number with a dimension stands in numerical code.
//!
//! A motion x(t) of ẋ = F(t, x), measured in other units, is σ x(t/τ), a motion of
//!
//! F̃(t, x) = (σ/τ) F(t/τ, x/σ)                                             mathematics (29)
//!
//! With start, steps, limits, tolerances, covariances and weights in these units, a method has to take the same
//! decisions (steps, rejections, evaluations) and to give the same numbers in them, bit for bit, where σ and τ
//! are powers of two:
//!
//! - under τ, and under one σ for all components: every method, filter, solver and event finder;
//! - under a σ for each component: methods that treat components apart. Pivoted solves, Euclidean norms and
//!   inner products do not.
//!
//! Exempt are tolerances that are not given (`atol` is then `rtol`, in the unit of the state), numbers that leave
//! the range of their type, and a first step where nothing at all tells of a scale.
//!
//! What is exported and not tried here makes [`coverage`] fail.

// bits are meant
#![allow(clippy::float_cmp)]

mod blocks;
mod blocks_by_component;
mod coverage;
mod events;
mod far_away;
mod methods;
mod motions;
mod not_yet;
mod plans;
mod problems;
mod quotients;
mod record;
mod scaled;
mod series;
mod structure;

use std::collections::{BTreeMap, BTreeSet};

use not_yet::NOT_YET;

/// The part of the law that a change of units belongs to.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) enum Part {
    Time,
    OneUnit,
    EachComponent,
}

impl std::fmt::Display for Part {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Time => "the unit of time",
            Self::OneUnit => "one unit of all components",
            Self::EachComponent => "units of components",
        })
    }
}

/// A change of units by powers of two.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Change {
    pub(crate) part: Part,
    /// log₂ τ.
    pub(crate) time: i32,
    /// log₂ σ of the first components, and so on.
    pub(crate) state: [i32; 4],
    /// log₂ of the unit of whatever else there is: energies, residuals, momenta, event functions.
    pub(crate) other: i32,
}

/// The changes of units that every method is tried with; odd powers show roots of what has a dimension.
pub(crate) fn changes(far: bool) -> Vec<Change> {
    let powers: &[i32] = if far { &[-600, -31, 101, 600] } else { &[-21, -7, 2, 21] };
    let mut all = Vec::new();
    for &power in powers {
        all.push(Change { part: Part::Time, time: power, state: [0; 4], other: 0 });
        all.push(Change { part: Part::OneUnit, time: 0, state: [power; 4], other: -power / 2 });
        let apart = [power / 2, -power, 3, power / 3];
        all.push(Change { part: Part::EachComponent, time: -power, state: apart, other: 1 });
    }
    let both = if far { (31, -57) } else { (5, -9) };
    all.push(Change { part: Part::OneUnit, time: both.0, state: [both.1; 4], other: both.0 });
    all
}

/// What has been tried, and what went wrong first with each.
#[derive(Default)]
pub(crate) struct Verdict {
    tried: BTreeSet<String>,
    wrong: BTreeMap<String, String>,
}

impl Verdict {
    /// Takes note of a trial that the law demands.
    pub(crate) fn note(&mut self, who: &str, part: Part, detail: Option<String>) {
        let key = format!("{who}: {part}");
        self.tried.insert(key.clone());
        if let Some(detail) = detail {
            self.wrong.entry(key).or_insert(detail);
        }
    }

    /// Compares with the list of what does not obey yet.
    pub(crate) fn judge(self) {
        let listed: BTreeSet<&str> = NOT_YET.iter().copied().collect();
        let broken = self.wrong.iter().filter(|(key, _)| !listed.contains(key.as_str()));
        let broken = broken.map(|(key, detail)| format!("\n\"{key}\", // does not obey: {detail}"));
        let kept = self.tried.iter().filter(|key| !self.wrong.contains_key(*key));
        let kept = kept.filter(|key| listed.contains(key.as_str()));
        let kept = kept.map(|key| format!("\n\"{key}\" obeys: take it off the list"));
        let report: String = broken.chain(kept).collect();
        assert!(report.is_empty(), "{report}\n");
    }
}
