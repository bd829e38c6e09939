//! Which form is emitted: the cheapest of those that are proved, among those whose rounding error the level of
//! accuracy allows.

use super::conditions::Regular;
use super::ledger::{Contender, Decision, Fate, Proof};
use super::proof::{Claim, Defect, prove};
use super::reference::Reference;
use crate::algebra::{Accuracy, Graph};
use crate::id::ExprId;
use crate::mechanics::Procedure;
use crate::program::{
    Cost, Program, error_growth, error_growth_apart, error_growth_apart_in_runs, error_growth_in_runs, order,
    schedule_roughly,
};

/// What a procedure is compared by.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rating {
    /// Whether its rounding error is allowed beside the others.
    sound: bool,
    order: (usize, usize),
    cost: usize,
    growth: f64,
}

impl Rating {
    /// Why something so rated is not chosen.
    pub(crate) fn loss(&self) -> Fate {
        Fate::Lost(if self.sound {
            "it is no cheaper"
        } else {
            "its rounding errors are larger than the level allows"
        })
    }

    pub(crate) fn contender(&self, form: &'static str, fate: Fate) -> Contender {
        Contender { form, cost: Some(self.cost as u64), rounding: Some(self.growth), fate }
    }
}

/// The ratings of procedures of the same value: by bounds on their rounding errors.
pub(crate) fn rate(graph: &Graph, procedures: &[Procedure]) -> Vec<Rating> {
    rate_by(graph, procedures, false)
}

/// The ratings of derivatives of a function, which are long: what bounds find fault with is run, under `balanced`.
pub(crate) fn rate_derivatives(graph: &Graph, procedures: &[Procedure]) -> Vec<Rating> {
    rate_by(graph, procedures, graph.accuracy() == Accuracy::Balanced)
}

fn rate_by(graph: &Graph, procedures: &[Procedure], is_run: bool) -> Vec<Rating> {
    let programs: Vec<Program> =
        procedures.iter().map(|procedure| schedule_roughly(graph, procedure)).collect();
    let growth = error_growth(graph, &programs).into_iter();
    let mut growth: Vec<f64> = match graph.accuracy() {
        Accuracy::Fast => growth.map(|growth| if growth.is_finite() { 1.0 } else { growth }).collect(),
        Accuracy::Balanced | Accuracy::Careful => growth.collect(),
    };
    let least = growth.iter().copied().fold(f64::INFINITY, f64::min);
    let allowed = graph.accuracy().growth().max(least);
    if is_run {
        let programs: Vec<&Program> = programs.iter().collect();
        acquit(&programs, allowed, &mut growth, |asked, best| error_growth_in_runs(graph, asked, best));
    }
    let mut sound: Vec<bool> = growth.iter().map(|growth| *growth <= allowed).collect();
    keep_digits_apart(graph, &programs, is_run, &mut sound);
    let rated = programs.iter().zip(growth).zip(sound).map(|((program, growth), sound)| Rating {
        sound,
        order: order(program),
        cost: Cost::of(program).weighted(),
        growth,
    });
    rated.collect()
}

/// What bounds find fault with is run beside the best, and judged by the errors that are seen then.
fn acquit(
    programs: &[&Program],
    allowed: f64,
    growth: &mut [f64],
    seen: impl Fn(&[&Program], &Program) -> Vec<f64>,
) {
    let best = (0..programs.len()).min_by(|a, b| growth[*a].total_cmp(&growth[*b]));
    let is_large = |index: &usize| growth[*index] > allowed && growth[*index].is_finite();
    let accused: Vec<usize> = (0..programs.len()).filter(is_large).collect();
    let Some(best) = best.filter(|_| !accused.is_empty()) else { return };
    let candidates: Vec<&Program> = accused.iter().map(|index| programs[*index]).collect();
    for (index, seen) in accused.into_iter().zip(seen(&candidates, programs[best])) {
        growth[index] = growth[index].min(seen);
    }
}

/// Leaves those of the sound programs that keep their digits also where parameters lie decades apart, as far as any
/// does. Constants are as large as they are.
fn keep_digits_apart(graph: &Graph, programs: &[Program], is_run: bool, sound: &mut [bool]) {
    // what is faster may lose more there, as long as it keeps digits
    let allowed = match graph.accuracy() {
        Accuracy::Fast => return,
        Accuracy::Balanced => 1e12_f64,
        Accuracy::Careful => 1024.0,
    };
    let places: Vec<usize> = (0..programs.len()).filter(|index| sound[*index]).collect();
    if places.len() < 2 || !graph.constants().is_empty() {
        return;
    }
    let candidates: Vec<&Program> = places.iter().map(|index| &programs[*index]).collect();
    let mut growth = error_growth_apart(graph, &candidates);
    let least = growth.iter().copied().fold(f64::INFINITY, f64::min);
    if is_run {
        let seen = |asked: &[&Program], best: &Program| error_growth_apart_in_runs(graph, asked, best);
        acquit(&candidates, allowed.max(least), &mut growth, seen);
    }
    for (index, growth) in places.into_iter().zip(growth) {
        sound[index] = growth <= allowed.max(least);
    }
}

/// The procedures from the best to the worst: those that are accurate enough first, then by cost.
pub(crate) fn ranking(ratings: &[Rating]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..ratings.len()).collect();
    order.sort_by_key(|index| (!ratings[*index].sound, ratings[*index].order));
    order
}

/// The cheapest of several procedures of the same value, among those whose rounding error the level of
/// accuracy allows.
pub(crate) fn cheapest(graph: &Graph, procedures: &[Procedure]) -> usize {
    ranking(&rate(graph, procedures)).first().copied().unwrap_or(0)
}

/// A procedure of a form.
pub(crate) struct Entry {
    pub(crate) form: &'static str,
    pub(crate) procedure: Procedure,
}

/// The best procedure, if it is proved to move the state as declared; `finish` makes of a procedure what will be
/// emitted, which is what is proved. Without `regular` it may add conditions.
///
/// # Errors
/// The form of the best one, where it is not admitted: what it was compared with is to be compared without it.
pub(crate) fn admitted(
    graph: &mut Graph,
    (reference, regular): (&Reference, Option<&Regular>),
    entries: &[Entry],
    finish: impl FnOnce(&mut Graph, &Procedure) -> Procedure,
    decision: &mut Decision,
) -> Result<Procedure, Option<&'static str>> {
    let procedures: Vec<Procedure> = entries.iter().map(|entry| entry.procedure.clone()).collect();
    // a single one needs no comparison
    let ratings = if procedures.len() < 2 { Vec::new() } else { rate(graph, &procedures) };
    let ranking = if ratings.is_empty() { (0..procedures.len()).collect() } else { ranking(&ratings) };
    let contender = |index: usize, fate: Fate| {
        let form = entries[index].form;
        let unrated = Contender { form, cost: None, rounding: None, fate: fate.clone() };
        ratings.get(index).map_or(unrated, |rating| rating.contender(form, fate))
    };
    let Some((best, others)) = ranking.split_first() else { return Err(None) };
    let finished = finish(graph, &procedures[*best]);
    let mut fate = fate(prove(graph, reference, &Claim::Motion(&finished)));
    if let Fate::Chosen(_) = fate
        && let Some(divisor) = regular.and_then(|regular| regular.added(graph, &finished))
    {
        fate = Fate::adds(graph, divisor);
    }
    let is_admitted = matches!(fate, Fate::Chosen(_));
    decision.contenders.push(contender(*best, fate));
    if !is_admitted {
        return Err(Some(entries[*best].form));
    }
    for index in others {
        decision.contenders.push(contender(*index, ratings[*index].loss()));
    }
    Ok(finished)
}

impl Fate {
    /// That a form divides by what may vanish.
    pub(crate) fn adds(graph: &Graph, divisor: ExprId) -> Self {
        let divisor = graph.text(divisor);
        Self::NotAdmitted(format!(
            "it divides by {divisor}, which may vanish where the declared equations are regular"
        ))
    }
}

/// What becomes of the contender of a proof.
pub(crate) fn fate(proof: Result<Proof, Defect>) -> Fate {
    match proof {
        Ok(proof) => Fate::Chosen(proof),
        Err(defect) => Fate::NotAdmitted(defect.to_string()),
    }
}
