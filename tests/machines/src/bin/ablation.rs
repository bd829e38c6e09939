//! What each form of the equations is worth: the cost of the chosen derivative without it, against that with all.
//!
//! ```sh
//! cargo run --release -p nh-machines --bin ablation            # the table
//! cargo run --release -p nh-machines --bin ablation -- --costs # the cost of every machine, with all forms
//! ```
//!
//! The machines are those of the benchmark of record, arms of 2 to 8 links on driven bases, and random ones of a
//! fixed seed, some of them with closed loops. Costs are in the unit of [`Cost::weighted`].

use nh_machines::Machine;
use nh_stages::{Declaration, arms, whole_record};
use nonholonomic_core::compile::compile_with;
use nonholonomic_core::forms::{Form, Registry, Solution};
use nonholonomic_core::model::Model;
use nonholonomic_core::program::{Cost, schedule_grouping};

/// The seed of the random machines, and how many members are drawn.
const SEED: u64 = 15;
const MEMBERS: u64 = 60;
/// As many of those with constraints on positions.
const CLOSED: u64 = 20;

/// A form goes if dropping it costs less than this on the geometric mean …
const MEAN: f64 = 1.01;
/// … and less than this on every machine.
const EVERY: f64 = 1.05;

fn main() {
    let are_costs_asked = std::env::args().any(|argument| argument == "--costs");
    let machines: Vec<(String, Model, usize)> = systems()
        .into_iter()
        .filter_map(|(name, model)| cost(&model, &Registry::standard()).map(|cost| (name, model, cost)))
        .collect();
    if are_costs_asked {
        for (name, _, cost) in &machines {
            println!("{cost:7}  {name}");
        }
        return;
    }
    println!("{} machines\n", machines.len());
    println!("| dropped form | geometric mean | dearer on | worst | on | verdict |");
    println!("|---|--:|--:|--:|---|---|");
    let all = Registry::standard();
    for dropped in all.forms() {
        let others: Vec<&'static dyn Form> =
            all.forms().iter().copied().filter(|form| form.name() != dropped.name()).collect();
        let registry = Registry::of(others).solving(all.solutions().to_vec());
        println!("{}", without(dropped.name(), &registry, &machines));
    }
    for dropped in all.solutions() {
        let others: Vec<&'static dyn Solution> =
            all.solutions().iter().copied().filter(|other| other.name() != dropped.name()).collect();
        println!("{}", without(dropped.name(), &all.clone().solving(others), &machines));
    }
}

/// The row of what is dropped, by the registry that is left.
fn without<'m>(
    dropped: &'static str,
    registry: &Registry,
    machines: &'m [(String, Model, usize)],
) -> Row<'m> {
    let ratios = machines.iter().filter_map(|(name, model, with)| {
        let without = cost(model, registry)?;
        Some((ratio(without, *with), name.as_str()))
    });
    Row::of(dropped, ratios.collect())
}

/// What dropping a form does.
struct Row<'m> {
    form: &'static str,
    mean: f64,
    dearer: usize,
    worst: (f64, &'m str),
}

impl<'m> Row<'m> {
    #[allow(clippy::cast_precision_loss, reason = "machines are counted")]
    fn of(form: &'static str, ratios: Vec<(f64, &'m str)>) -> Self {
        let logarithms: f64 = ratios.iter().map(|(ratio, _)| ratio.ln()).sum();
        let mean = (logarithms / ratios.len().max(1) as f64).exp();
        let dearer = ratios.iter().filter(|(ratio, _)| *ratio > 1.0).count();
        let worst = ratios.into_iter().max_by(|(a, _), (b, _)| a.total_cmp(b)).unwrap_or((1.0, ""));
        Self { form, mean, dearer, worst }
    }
}

impl std::fmt::Display for Row<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { form, mean, dearer, worst: (worst, machine) } = self;
        let verdict =
            if *mean < MEAN && *worst < EVERY { "goes, or says what else it is for" } else { "stays" };
        write!(f, "| {form} | {mean:.4} | {dearer} | {worst:.3} | {machine} | {verdict} |")
    }
}

#[allow(clippy::cast_precision_loss, reason = "costs are small")]
fn ratio(without: usize, with: usize) -> f64 {
    without.max(1) as f64 / with.max(1) as f64
}

/// The models of all machines that are declarations.
fn systems() -> Vec<(String, Model)> {
    let mut found: Vec<(String, Model)> = whole_record()
        .into_iter()
        .chain(arms())
        .filter_map(|(name, declaration)| Some((name, declaration.model().ok()?)))
        .collect();
    let random = (0..MEMBERS).map(|member| Machine::of(SEED, member));
    for machine in random.chain((0..CLOSED).map(|member| Machine::closed(SEED, member))) {
        let tokens = |text: String| text.parse().ok();
        let declaration = tokens(machine.attribute("balanced"))
            .zip(tokens(machine.item()))
            .map(|(attribute, item)| Declaration { name: "Machine".into(), attribute, item });
        if let Some(Ok(model)) = declaration.map(|declaration| declaration.model()) {
            found.push((format!("random {}, {}", machine.member, machine.family), model));
        }
    }
    found
}

/// The cost of the derivative that is chosen; `None` for a machine that is refused.
fn cost(model: &Model, registry: &Registry) -> Option<usize> {
    let system = compile_with(model.clone(), registry).ok()?;
    let parameters: Vec<_> = system.model.parameters.iter().map(|parameter| parameter.symbol).collect();
    Some(Cost::of(&schedule_grouping(&system.model.graph, &system.derivative, &parameters)).weighted())
}
