//! What a further link of an arm costs: a table of the operations of the derivative of arms and pendulums, with `--space`
//! of arms in space, with `--loops` of closed loops side by side.

use nh_stages::families;
use nonholonomic_core::program::{Cost, schedule_grouping};

/// The operations of the derivative of a member of a family.
fn operations(family: &str, links: usize) -> Result<usize, String> {
    let known = families().find(|known| known.name == family).ok_or("no such family")?;
    let system = known.member(links).system().map_err(|messages| messages.join("\n"))?;
    let parameters: Vec<_> = system.model.parameters.iter().map(|parameter| parameter.symbol).collect();
    Ok(Cost::of(&schedule_grouping(&system.model.graph, &system.derivative, &parameters)).operations())
}

/// The families in the plane, in the order of the columns.
const IN_THE_PLANE: [&str; 6] = [
    "arm on two wheels",
    "arm on a skate",
    "arm in a vertical plane",
    "fast arms in pairs",
    "pendulum, absolute angles",
    "pendulum, relative angles",
];

/// Those in space.
const IN_SPACE: [&str; 5] = [
    "arm in space",
    "arm in space, parallel axes",
    "arm in space, skew axes",
    "fast arm in space, on wheels",
    "fast arm in space, afloat",
];

fn main() -> Result<(), String> {
    if std::env::args().any(|argument| argument == "--space") {
        return table(&IN_SPACE, 12);
    }
    if std::env::args().any(|argument| argument == "--loops") {
        return table(&["four-bars side by side"], 20);
    }
    table(&IN_THE_PLANE, 20)
}

fn table(families: &[&str], most: usize) -> Result<(), String> {
    println!(
        "| links | {} |\n|--:|{}",
        families.join(" | more | ") + " | more",
        "--:|--:|".repeat(families.len())
    );
    let mut before = vec![None; families.len()];
    for links in 2..=most {
        print!("| {links} |");
        for (family, before) in families.iter().zip(&mut before) {
            let now = operations(family, links)?.cast_signed();
            let more = before.replace(now).map_or(String::new(), |before| format!("{:+}", now - before));
            print!(" {now} | {more} |");
        }
        println!();
    }
    Ok(())
}
