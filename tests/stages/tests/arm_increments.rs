//! What a further link of an arm costs: a table of the operations of planar arms on driven bases.

use nh_stages::families;
use nonholonomic_core::program::{Cost, schedule_grouping};

/// The operations of the derivative of a member of a family.
fn operations(family: &str, links: usize) -> usize {
    let family = families().find(|known| known.name == family).expect("a family of arms");
    let system = family.member(links).system().expect("an arm");
    let parameters: Vec<_> = system.model.parameters.iter().map(|parameter| parameter.symbol).collect();
    Cost::of(&schedule_grouping(&system.model.graph, &system.derivative, &parameters)).operations()
}

#[test]
#[ignore = "a table of 38 derivations, some of them long: with `--release`"]
fn operations_of_further_links() {
    println!("| links | on two wheels | more | on a skate | more |\n|--:|--:|--:|--:|--:|");
    let mut before: Option<[usize; 2]> = None;
    for links in 2..=20 {
        let now = ["arm on two wheels", "arm on a skate"].map(|family| operations(family, links));
        let more = |which: usize| {
            before.map_or(String::new(), |before| {
                format!("{:+}", now[which].cast_signed() - before[which].cast_signed())
            })
        };
        println!("| {links} | {} | {} | {} | {} |", now[0], more(0), now[1], more(1));
        before = Some(now);
    }
}
