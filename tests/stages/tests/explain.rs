//! `emit { explain }`: every choice is recorded with what competed, what it costs, and how it was proved.

use nh_stages::{collected, declarations, record};
use nonholonomic_core::choose::Fate;
use proc_macro2::TokenStream;

const SATELLITE: &str = "#[nonholonomic(
    basis { w[3], s[3] } brackets so(3) { w }
    lagrangian { sum(i in 0..3: I[i] * w[i]^2 + J[i] * (w[i] + s[i])^2) / 2 }
    emit { explain }
)] struct Satellite { I: [f64; 3], J: [f64; 3] }";

#[test]
fn the_derivative_was_chosen_among_forms_and_proved() {
    let system = declarations(SATELLITE)[0].system().unwrap();
    let decision = system.ledger.at("derivative").unwrap();
    assert!(decision.contenders.len() > 1, "{}", system.ledger);
    let chosen = decision.chosen().unwrap();
    let Fate::Chosen(proof) = &chosen.fate else { panic!("{}", system.ledger) };
    assert!(proof.bits >= 80.0, "{}", system.ledger);
    let lost = decision.contenders.iter().filter(|contender| matches!(contender.fate, Fate::Lost(_)));
    assert_eq!(lost.count(), decision.contenders.len() - 1, "{}", system.ledger);
}

#[test]
fn it_is_generated_as_a_text_where_it_is_asked_for() {
    let declaration = &declarations(SATELLITE)[0];
    let expanded = declaration.expanded().to_string();
    assert!(expanded.contains("const DERIVATION") && expanded.contains("chosen, proved at"), "{expanded}");
    assert!(expanded.contains("lowered: each proved to 2^-"), "{expanded}");
    let silent = declarations(&SATELLITE.replace("emit { explain }", ""));
    assert!(!silent[0].expanded().to_string().contains("DERIVATION"));
    let broken = declarations(&SATELLITE.replace("J[i] * (w[i]", "Q[i] * (w[i]"));
    assert!(broken[0].expanded().to_string().contains("const DERIVATION"), "stubs have it, too");
}

/// A random point of the field gives values to fifteen square roots once in 32768 times.
#[test]
fn many_square_roots_do_not_keep_a_form_from_being_proved() {
    let bodies = "#[nonholonomic(
        base { x[6], y[6] }
        lagrangian {
            sum(i in 0..6: m[i] / 2 * (der(x[i])^2 + der(y[i])^2))
                + sum(i in 0..6: sum(j in i+1..6: m[i] * m[j] / sqrt((x[i] - x[j])^2 + (y[i] - y[j])^2)))
        }
    )] struct Bodies { m: [f64; 6] }";
    let system = declarations(bodies)[0].system().unwrap();
    assert!(system.ledger.at("derivative").unwrap().chosen().is_some(), "{}", system.ledger);
}

/// 67 is no square modulo the prime of the proofs, and neither is 71; their product is one.
#[test]
fn roots_of_any_numbers_are_proved() {
    for constraint in [
        "der(x) = sqrt(67) * der(y)",
        "der(x) = sqrt(67) * sqrt(71) * der(y) + sqrt(4757) * der(z)",
        "der(x) = sqrt(67 / 2) * sin(z) * der(y)",
    ] {
        let source = format!(
            "#[nonholonomic(base {{ x, y, z }} constraints {{ {constraint}; }} emit {{ jacobian }}
             lagrangian {{ m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) + sqrt(73) * m * x * y }})]
             struct Rooted {{ m: f64 }}"
        );
        let declaration = &declarations(&source)[0];
        let system = declaration.system().unwrap_or_else(|errors| panic!("{constraint}: {errors:?}"));
        assert!(system.ledger.at("derivative").unwrap().chosen().is_some(), "{}", system.ledger);
        assert!(system.ledger.at("jacobian").unwrap().chosen().is_some(), "{}", system.ledger);
        assert_eq!(nh_stages::errors(&declaration.expanded()), <[String; 0]>::default());
    }
}

/// Nothing is emitted whose divisors were not recognised as those of what was derived: asked of every sixth of the
/// declarations of the repository, and of the machines of the benchmark.
#[test]
fn programs_divide_by_what_was_derived() {
    let explained: TokenStream = "emit { explain }".parse().expect("tokens");
    let mut proved = 0;
    let record = record().into_iter().map(|(_, declaration)| declaration);
    for mut declaration in collected().into_iter().step_by(6).chain(record) {
        declaration.attribute.extend(explained.clone());
        let text = declaration.expanded().to_string();
        assert!(!text.contains("it divides by what"), "{}: {}", declaration.name, declaration.attribute);
        proved += usize::from(text.contains("lowered: each proved to 2^-"));
    }
    assert!(proved > 40, "{proved}");
}
