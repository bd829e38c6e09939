//! The table.

use nh_counted::callgrind::Counts;

use crate::measured::{LEVELS, Study};
use crate::places::REGIMES;

/// Prints instructions and errors of every system.
pub fn print(systems: &[Box<dyn Study>], counts: &[Counts]) {
    println!("Instructions per evaluation of the derivative:\n");
    println!("| system | {} |", LEVELS.join(" | "));
    println!("|---|--:|--:|--:|");
    for system in systems {
        let count = |counts| system.instructions(counts).map_or("–".into(), |count| format!("{count:.0}"));
        let cells: Vec<String> = counts.iter().map(count).collect();
        println!("| {} | {} |", system.name(), cells.join(" | "));
    }
    for regime in REGIMES {
        println!(
            "\nUnits in the last place of the worst component, median and worst of {} places: {}\n",
            crate::measured::PLACES,
            regime.name()
        );
        println!("| system | {} | inputs explain |", LEVELS.join(" | "));
        println!("|---|--:|--:|--:|--:|");
        for system in systems {
            let errors = system.errors(regime);
            let spreads = errors.levels.into_iter().chain([errors.conditioning]);
            let cells: Vec<String> = spreads
                .map(|spread| format!("{}, {}", digits(spread.median), digits(spread.worst)))
                .collect();
            println!("| {} | {} |", system.name(), cells.join(" | "));
        }
    }
}

/// Two digits that matter.
fn digits(value: f64) -> String {
    match value {
        value if value >= 1e4 => format!("{value:.0e}"),
        value if value >= 10.0 => format!("{value:.0}"),
        value => format!("{value:.1}"),
    }
}
