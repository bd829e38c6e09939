//! Changed declarations by the thousand: `cargo run --release -p nh-stages --bin fuzz -- 10000 [SEED]`; every fourth is a
//! map or a quotient of declared systems. Each defect is printed with the smallest declaration that shows it.

use nh_stages::{
    Collection, Random, collected, collected_relations, judged, judged_relation, minimised,
    minimised_relation,
};

/// What one declaration may take.
const WORK: u64 = 3_000_000;

fn main() {
    let mut arguments = std::env::args().skip(1).map(|argument| argument.parse::<u64>());
    let mut next = || arguments.next().and_then(Result::ok);
    let (rounds, seed) = (next().unwrap_or(1000), next().unwrap_or(1));
    // panics are told below
    std::panic::set_hook(Box::new(|_| {}));
    let collection = Collection::of(collected()).with_relations(collected_relations());
    println!("{} declarations, {rounds} changes, seed {seed}", collection.len());
    let (mut counts, mut defects) = ([0_u64; 3], 0);
    for round in 0..rounds {
        let mut random = Random::new(seed.wrapping_mul(1 << 40).wrapping_add(round));
        if round % 4 == 3 {
            let Some(relation) = collection.changed_relation(&mut random) else { return };
            match judged_relation(&relation, WORK) {
                Ok(verdict) => counts[verdict as usize] += 1,
                Err(defect) => {
                    defects += 1;
                    let is_same = |smaller: &_| {
                        judged_relation(smaller, WORK).is_err_and(|other| other.is_like(&defect))
                    };
                    let smallest = minimised_relation(&relation, 400, is_same);
                    let systems = [Some(&smallest.source), smallest.target.as_ref()].into_iter().flatten();
                    println!("round {round}: {defect:?}\n{}! {{ {} }}", smallest.name(), smallest.written);
                    for system in systems {
                        println!("#[nonholonomic({})]\n{}\n", system.attribute, system.item);
                    }
                }
            }
            continue;
        }
        let Some(declaration) = collection.changed(&mut random) else { return };
        match judged(&declaration, WORK) {
            Ok(verdict) => counts[verdict as usize] += 1,
            Err(defect) => {
                defects += 1;
                let is_same = |smaller: &_| judged(smaller, WORK).is_err_and(|other| other.is_like(&defect));
                let smallest = minimised(&declaration, 400, is_same);
                println!(
                    "round {round}: {defect:?}\n#[nonholonomic({})]\n{}\n",
                    smallest.attribute, smallest.item
                );
            }
        }
    }
    let [compiled, refused, too_large] = counts;
    println!("{compiled} compiled, {refused} refused, {too_large} too large, {defects} defects");
    std::process::exit(i32::from(defects > 0));
}
