//! The runs of one motion, measured.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use nonholonomic::ScalarOf;
use nonholonomic::prelude::*;

use crate::variant::Variant;
use crate::{instructions, lists_of_runs, picture};

/// One motion, over a span of time, in any number of variants and methods.
pub struct Study {
    name: String,
    from: f64,
    to: f64,
    cases: Vec<Case>,
    reference: BTreeMap<&'static str, f64>,
}

/// A variant with a method and a setting.
pub(crate) struct Case {
    pub(crate) variant: String,
    pub(crate) method: &'static str,
    /// The relative tolerance, or the length of the step.
    pub(crate) setting: f64,
    /// The names of the components.
    pub(crate) names: Vec<&'static str>,
    pub(crate) run: Box<dyn Fn() -> Option<Ended>>,
}

/// A run that has got to its end.
pub(crate) struct Ended {
    pub(crate) end: Vec<f64>,
    pub(crate) statistics: Statistics,
}

/// What a run costs, and what it is worth.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The variant's name.
    pub variant: String,
    /// The method's name.
    pub method: &'static str,
    /// The relative tolerance of an adaptive method, the length of the step of another.
    pub setting: f64,
    /// The largest error of a component at the end, relative to the component where that is above 1.
    pub error: f64,
    /// Steps taken.
    pub steps: u64,
    /// Evaluations of the derivative; expansions of the Taylor method.
    pub evaluations: u64,
    /// The shortest of several runs, in seconds.
    pub seconds: f64,
    /// Instructions, where valgrind is installed.
    pub instructions: Option<u64>,
}

impl Study {
    /// The motion `name` from one time to another.
    #[must_use]
    pub fn new(name: &str, from: f64, to: f64) -> Self {
        Self { name: name.to_owned(), from, to, cases: Vec::new(), reference: BTreeMap::new() }
    }

    /// The name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Gives the end, by names of components, instead of having it computed: for what is known to more
    /// digits than double precision finds.
    pub fn reference(&mut self, end: impl IntoIterator<Item = (&'static str, f64)>) {
        self.reference = end.into_iter().collect();
    }

    /// Adds a form of the system with its start; methods are added to what this returns.
    pub fn variant<S>(&mut self, name: &str, system: S, start: S::State) -> Variant<'_, S>
    where
        S: Dynamics + Clone + 'static,
        ScalarOf<S>: Real,
    {
        Variant::new(self, name, system, start)
    }

    /// Adds a run by other means, another library's for instance: it gives the end of the motion.
    pub fn other(
        &mut self,
        variant: &str,
        method: &'static str,
        setting: f64,
        names: &[&'static str],
        run: impl Fn() -> Option<Vec<f64>> + 'static,
    ) {
        let run = move || run().map(|end| Ended { end, statistics: Statistics::default() });
        let (variant, names) = (variant.to_owned(), names.to_vec());
        self.add(Case { variant, method, setting, names, run: Box::new(run) });
    }

    pub(crate) fn span(&self) -> (f64, f64) {
        (self.from, self.to)
    }

    pub(crate) fn add(&mut self, case: Case) {
        self.cases.push(case);
    }

    /// Measures all runs, prints the table and the cheapest choices, and draws the picture
    /// `target/work_precision/<name>.svg`.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn finish(self) -> std::io::Result<()> {
        let (name, from, to) = (self.name.clone(), self.from, self.to);
        let Some((outcomes, converged)) = self.measure() else { return Ok(()) };
        println!("{}", lists_of_runs::head(&name, from, to, converged));
        println!("{}", lists_of_runs::runs(&outcomes));
        println!("{}", lists_of_runs::cheapest(&outcomes));
        let path = std::path::Path::new("target/work_precision").join(format!("{name}.svg"));
        std::fs::create_dir_all("target/work_precision")?;
        std::fs::write(&path, picture::draw(&name, &outcomes)?)?;
        println!("picture: {}", path.display());
        Ok(())
    }

    /// What all runs cost, and the size of the difference between the two most accurate computations of
    /// the end, below which errors mean nothing; zero if the end was given. `None` in the process that
    /// callgrind watches, which has done its work by then.
    #[must_use]
    pub fn measure(mut self) -> Option<(Vec<Outcome>, f64)> {
        if let Some(study) = instructions::counted() {
            if study == self.name {
                instructions::run_counted(self.cases.iter().map(|case| &*case.run));
            }
            return None;
        }
        let converged = if self.reference.is_empty() { self.converge() } else { 0.0 };
        let counts = instructions::count(&self.name, self.cases.len());
        let mut outcomes = Vec::new();
        for (index, case) in self.cases.iter().enumerate() {
            let Some(ended) = (case.run)() else { continue };
            outcomes.push(Outcome {
                variant: case.variant.clone(),
                method: case.method,
                setting: case.setting,
                error: self.error(&case.names, &ended.end),
                steps: ended.statistics.steps,
                evaluations: ended.statistics.evaluations,
                seconds: shortest(&case.run),
                instructions: counts.get(index).copied().flatten(),
            });
        }
        Some((outcomes, converged))
    }

    /// Takes the end from the two most accurate methods, at the finest settings at which they agree best.
    fn converge(&mut self) -> f64 {
        let mut finest: Vec<(&Case, Vec<f64>)> = Vec::new();
        for case in &self.cases {
            // double precision and high order, at tolerances near round-off
            let candidate = ["Taylor", "Vern9", "Dop853"].contains(&case.method) && case.setting < 1e-12;
            if let Some(ended) = candidate.then(|| (case.run)()).flatten() {
                finest.push((case, ended.end));
            }
        }
        let distance =
            |a: &[f64], b: &[f64]| a.iter().zip(b).fold(0.0, |worst, (a, b)| larger(worst, *a, *b));
        let mut best: Option<(f64, usize)> = None;
        for (i, (case, end)) in finest.iter().enumerate() {
            for (other, reached) in &finest[..i] {
                if other.method != case.method && other.names == case.names {
                    let apart = distance(end, reached);
                    if best.is_none_or(|(least, _)| apart < least) {
                        best = Some((apart, i));
                    }
                }
            }
        }
        let Some((apart, index)) = best else { return f64::NAN };
        let (case, end) = &finest[index];
        self.reference = case.names.iter().copied().zip(end.iter().copied()).collect();
        apart
    }

    /// The largest error of a component that the reference has.
    fn error(&self, names: &[&'static str], end: &[f64]) -> f64 {
        let mut worst = 0.0_f64;
        for (name, x) in names.iter().zip(end) {
            if let Some(reference) = self.reference.get(name) {
                worst = larger(worst, *x, *reference);
            }
        }
        worst
    }
}

/// The larger of what was found so far and the error of a number; a run that has left the numbers is
/// infinitely wrong.
fn larger(so_far: f64, x: f64, reference: f64) -> f64 {
    let off = (x - reference).abs() / reference.abs().max(1.0);
    if off.is_nan() { f64::INFINITY } else { so_far.max(off) }
}

/// The shortest of many runs, for at most a twentieth of a second.
fn shortest(run: &dyn Fn() -> Option<Ended>) -> f64 {
    let begin = Instant::now();
    let mut least = Duration::MAX;
    while begin.elapsed() < Duration::from_millis(50) {
        let start = Instant::now();
        std::hint::black_box(run());
        least = least.min(start.elapsed());
    }
    least.as_secs_f64()
}
