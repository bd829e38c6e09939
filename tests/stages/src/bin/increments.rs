//! What a further link of an arm costs: a table of the operations of planar arms on driven bases.

use nh_stages::families;
use nonholonomic_core::program::{Cost, schedule_grouping};

/// The operations of the derivative of a member of a family.
fn operations(family: &str, links: usize) -> Result<usize, String> {
    let known = families().find(|known| known.name == family).ok_or("no such family")?;
    let system = known.member(links).system().map_err(|messages| messages.join("\n"))?;
    let parameters: Vec<_> = system.model.parameters.iter().map(|parameter| parameter.symbol).collect();
    Ok(Cost::of(&schedule_grouping(&system.model.graph, &system.derivative, &parameters)).operations())
}

fn main() -> Result<(), String> {
    println!("| links | on two wheels | more | on a skate | more |\n|--:|--:|--:|--:|--:|");
    let mut before = [None; 2];
    for links in 2..=20 {
        print!("| {links} |");
        for (family, before) in ["arm on two wheels", "arm on a skate"].into_iter().zip(&mut before) {
            let now = operations(family, links)?.cast_signed();
            let more = before.replace(now).map_or(String::new(), |before| format!("{:+}", now - before));
            print!(" {now} | {more} |");
        }
        println!();
    }
    Ok(())
}
