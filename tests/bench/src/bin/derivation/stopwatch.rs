//! The stages of the macro, timed.

use std::time::{Duration, Instant};

use nonholonomic_core::program::{Cost, schedule};
use proc_macro2::TokenStream;

use crate::emit::{Layout, emit};
use crate::families::Declaration;
use crate::resolve::resolve;
use crate::syntax;

/// Milliseconds, and the size of what was derived.
pub(crate) struct Times {
    /// From tokens to a model.
    pub(crate) parse: f64,
    /// From the model to the system.
    pub(crate) derive: f64,
    /// From the system to tokens.
    pub(crate) emit: f64,
    /// Operations of the emitted derivative.
    pub(crate) operations: usize,
}

impl Times {
    /// The whole expansion.
    pub(crate) fn whole(&self) -> f64 {
        self.parse + self.derive + self.emit
    }
}

/// The mean of several expansions, as time on the processor where the system tells: other programs
/// do not count.
pub(crate) fn measure(declaration: &Declaration) -> Times {
    const ENOUGH: Duration = Duration::from_millis(500);
    let attribute: TokenStream = declaration.attribute.parse().expect("the attribute is made of tokens");
    let item: TokenStream = declaration.item.parse().expect("the item is made of tokens");
    let warm = once(declaration, attribute.clone(), item.clone());
    let (start, before) = (Instant::now(), on_processor());
    let mut runs = Vec::new();
    while start.elapsed() < ENOUGH {
        runs.push(once(declaration, attribute.clone(), item.clone()));
    }
    let share = match before.zip(on_processor()) {
        Some((before, after)) => after.saturating_sub(before).as_secs_f64() / start.elapsed().as_secs_f64(),
        None => 1.0,
    };
    let mean = |of: fn(&Times) -> f64| share * runs.iter().map(of).sum::<f64>() / runs.len() as f64;
    Times { parse: mean(|t| t.parse), derive: mean(|t| t.derive), emit: mean(|t| t.emit), ..warm }
}

/// The time that this thread has spent on a processor: Linux.
fn on_processor() -> Option<Duration> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    text.split(' ').next()?.parse().ok().map(Duration::from_nanos)
}

fn once(declaration: &Declaration, attribute: TokenStream, item: TokenStream) -> Times {
    let milliseconds = |start: Instant| start.elapsed().as_secs_f64() * 1e3;
    let start = Instant::now();
    let Ok(parsed) = syntax::parse(attribute.clone(), item) else { panic!("{}: syntax", declaration.name) };
    let mut layout = Layout::of_struct(&parsed.structure, attribute);
    let Ok(resolved) = resolve(&parsed, &mut layout) else { panic!("{}: names", declaration.name) };
    let parse = milliseconds(start);
    let start = Instant::now();
    let system = match nonholonomic_core::compile::compile(resolved.model) {
        Ok(system) => system,
        Err(violations) => panic!("{}: {violations:?}", declaration.name),
    };
    let derive = milliseconds(start);
    let start = Instant::now();
    let tokens = emit(&system, &layout);
    let emit = milliseconds(start);
    drop(tokens);
    let operations = Cost::of(&schedule(&system.model.graph, &system.derivative)).weighted();
    Times { parse, derive, emit, operations }
}
