//! What a further link of an arm costs: a table of the operations of the derivative of arms and pendulums.

use nh_stages::families;
use nonholonomic_core::program::{Cost, schedule_grouping};

/// The operations of the derivative of a member of a family.
fn operations(family: &str, links: usize) -> Result<usize, String> {
    let known = families().find(|known| known.name == family).ok_or("no such family")?;
    let system = known.member(links).system().map_err(|messages| messages.join("\n"))?;
    let parameters: Vec<_> = system.model.parameters.iter().map(|parameter| parameter.symbol).collect();
    Ok(Cost::of(&schedule_grouping(&system.model.graph, &system.derivative, &parameters)).operations())
}

/// The families, in the order of the columns.
const FAMILIES: [&str; 6] = [
    "arm on two wheels",
    "arm on a skate",
    "arm in a vertical plane",
    "fast arms in pairs",
    "pendulum, absolute angles",
    "pendulum, relative angles",
];

fn main() -> Result<(), String> {
    println!(
        "| links | {} |\n|--:|{}",
        FAMILIES.join(" | more | ") + " | more",
        "--:|--:|".repeat(FAMILIES.len())
    );
    let mut before = [None; FAMILIES.len()];
    for links in 2..=20 {
        print!("| {links} |");
        for (family, before) in FAMILIES.into_iter().zip(&mut before) {
            let now = operations(family, links)?.cast_signed();
            let more = before.replace(now).map_or(String::new(), |before| format!("{:+}", now - before));
            print!(" {now} | {more} |");
        }
        println!();
    }
    Ok(())
}
