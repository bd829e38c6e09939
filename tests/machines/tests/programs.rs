//! Every program that lowering finds for a function of a random machine computes it, the ones that are not emitted, too.
//!
//! `MACHINES=400 cargo test --release -p nh-machines --test programs` looks at more than the few that every run looks at.

use nh_machines::{Emitted, LEVELS, Machine};
use nonholonomic_core::choose::prove_program;
use nonholonomic_core::id::SymbolId;
use nonholonomic_core::program::{Scheduled, schedules};

/// The seed, and as many machines of each kind.
const SEED: u64 = 2;
const MACHINES: u64 = 9;

#[test]
fn none_is_refuted() {
    let count = std::env::var("MACHINES").ok().and_then(|text| text.parse().ok()).unwrap_or(MACHINES);
    let mut proved = 0;
    for member in 0..count {
        let level = LEVELS[usize::try_from(member % 3).unwrap_or(0)];
        for machine in [Machine::of(SEED, member), Machine::closed(SEED, member)] {
            let Ok(Emitted { system, .. }) = Emitted::of(&machine, level) else { continue };
            let graph = &system.model.graph;
            let parameters: Vec<SymbolId> = system.model.parameters.iter().map(|p| p.symbol).collect();
            let functions = system.functions.iter().map(|f| (f.signature.name, &f.procedure));
            for (name, procedure) in functions.chain([("derivative", &system.derivative)]) {
                for Scheduled { program, .. } in schedules(graph, procedure, &parameters) {
                    let verdict = prove_program(graph, procedure, &program);
                    assert!(
                        verdict.is_ok(),
                        "{name} of machine {member}, {}, {level}: {verdict:?}\n{}",
                        machine.family,
                        program.text(graph)
                    );
                    proved += 1;
                }
            }
        }
    }
    assert!(proved > 100, "{proved}");
}
