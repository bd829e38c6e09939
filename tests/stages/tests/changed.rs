//! Changed declarations of the repository: whatever is written, the macro answers in code or in words. More of them:
//! `cargo run -p nh-stages --bin fuzz`.

use nh_stages::{Collection, Random, Verdict, collected, judged, minimised};

/// What one declaration may take: nearly all take less.
const WORK: u64 = 300_000;

#[test]
fn changed_declarations_are_compiled_or_refused() {
    let declarations = collected();
    assert!(declarations.len() > 300, "{} declarations", declarations.len());
    let collection = Collection::of(declarations);
    let (mut compiled, mut refused) = (0, 0);
    for round in 0..700 {
        let mut random = Random::new(round);
        let declaration = collection.changed(&mut random).expect("a declaration");
        match judged(&declaration, WORK) {
            Ok(Verdict::Compiled) => compiled += 1,
            Ok(_) => refused += 1,
            Err(defect) => {
                let is_same = |smaller: &_| judged(smaller, WORK).is_err_and(|other| other.is_like(&defect));
                let smallest = minimised(&declaration, 300, is_same);
                panic!(
                    "round {round}: {defect:?}\n#[nonholonomic({})]\n{}",
                    smallest.attribute, smallest.item
                );
            }
        }
    }
    assert!(compiled > 30 && refused > 30, "{compiled} compiled, {refused} refused");
}
