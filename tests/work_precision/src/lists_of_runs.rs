//! The tables.

use std::fmt::Write;

use crate::study::Outcome;

/// The accuracies for which the cheapest run is sought.
const ACCURACIES: [f64; 6] = [1e-2, 1e-3, 1e-5, 1e-7, 1e-9, 1e-11];

/// What the study is, and how far its reference can be trusted.
pub(crate) fn head(name: &str, from: f64, to: f64, converged: f64) -> String {
    let mut text = format!("{name}, t = {from} … {to}");
    if converged > 0.0 {
        let _ = write!(text, "; two methods agree on the end to {converged:.0e}");
    } else if converged.is_nan() {
        text.push_str("; no two methods of high order to take the end from: errors are not known");
    }
    text
}

/// Every run, a line each.
pub(crate) fn runs(outcomes: &[Outcome]) -> String {
    let mut text = format!(
        "{:<18} {:<15} {:>9} {:>9} {:>8} {:>8} {:>11} {:>13}\n",
        "variant", "method", "setting", "error", "steps", "evals", "time/us", "instructions"
    );
    for outcome in outcomes {
        let count = outcome.instructions.map_or_else(|| "-".to_owned(), |count| count.to_string());
        let _ = writeln!(
            text,
            "{:<18} {:<15} {:>9.1e} {:>9.1e} {:>8} {:>8} {:>11.2} {count:>13}",
            outcome.variant,
            outcome.method,
            outcome.setting,
            outcome.error,
            outcome.steps,
            outcome.evaluations,
            outcome.seconds * 1e6,
        );
    }
    text
}

/// The cheapest run for each accuracy: by instructions, or by time where they are not counted.
pub(crate) fn cheapest(outcomes: &[Outcome]) -> String {
    let mut text = String::from("the cheapest for an error at the end of at most\n");
    for accuracy in ACCURACIES {
        let enough = outcomes.iter().filter(|outcome| outcome.error <= accuracy);
        match enough.min_by(|a, b| price(a).total_cmp(&price(b))) {
            None => _ = writeln!(text, "  {accuracy:.0e}  none"),
            Some(best) => {
                let Outcome { variant, method, setting, error, seconds, evaluations, .. } = best;
                let count =
                    best.instructions.map_or_else(String::new, |count| format!(", {count} instructions"));
                let _ = writeln!(
                    text,
                    "  {accuracy:.0e}  {method}, {setting:.1e} ({variant}): error {error:.1e}, \
                     {evaluations} evaluations, {:.1} us{count}",
                    seconds * 1e6
                );
            }
        }
    }
    text
}

/// What runs are compared by.
#[allow(clippy::cast_precision_loss)] // counts below 2^53
fn price(outcome: &Outcome) -> f64 {
    outcome.instructions.map_or(outcome.seconds, |count| count as f64)
}
