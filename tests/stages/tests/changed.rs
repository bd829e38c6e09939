//! Changed declarations of the repository: whatever is written, the macro answers in code or in words. More of them:
//! `cargo run -p nh-stages --bin fuzz`.

use nh_stages::{
    Collection, Random, Verdict, collected, collected_relations, declarations, errors, judged,
    judged_relation, minimised, minimised_relation, relations,
};

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

#[test]
fn changed_maps_and_quotients_are_compiled_or_refused() {
    let relations = collected_relations();
    assert!(relations.len() > 40, "{} maps and quotients", relations.len());
    let collection = Collection::of(Vec::new()).with_relations(relations);
    let (mut compiled, mut refused) = (0, 0);
    for round in 0..200 {
        let mut random = Random::new(round);
        let relation = collection.changed_relation(&mut random).expect("a map");
        match judged_relation(&relation, WORK) {
            Ok(Verdict::Compiled) => compiled += 1,
            Ok(_) => refused += 1,
            Err(defect) => {
                let is_same =
                    |smaller: &_| judged_relation(smaller, WORK).is_err_and(|other| other.is_like(&defect));
                let smallest = minimised_relation(&relation, 300, is_same);
                panic!("round {round}: {defect:?}\n{}! {{ {} }}", smallest.name(), smallest.written);
            }
        }
    }
    assert!(compiled > 5 && refused > 50, "{compiled} compiled, {refused} refused");
}

/// What was found once.
#[test]
fn what_stands_before_the_new_struct_is_read() {
    let source = "#[nonholonomic(base { x, y } lagrangian { (der(x)^2 + der(y)^2)/2 })] struct Full;
                  quotient! { Full -> [] struct Reduced by { x } }";
    let found = relations(source);
    let [relation] = found.as_slice() else { panic!("{} quotients", found.len()) };
    let expected = "before `struct` stand attributes and a visibility, and nothing else\nhelp: a quotient reads \
                    `Full -> pub struct Reduced by { x, y } { velocities { v = …; } }`";
    assert_eq!(errors(&relation.expanded()), [expected]);
}

/// What was found once: the sizes beside an error are derived from what is left, here names without what defines them.
#[test]
fn names_beside_an_empty_coframe_are_refused() {
    let source = "#[nonholonomic(basis { a b } constraints { c: a + b = 0; } velocities { })] struct Empty;
                  #[nonholonomic(base { x } basis { a, b } constraints { c: a + b = 0; } velocities { v = der(x); })]
                  struct Beside;";
    for declaration in declarations(source) {
        assert!(!errors(&declaration.expanded()).is_empty(), "{}", declaration.name);
    }
}
