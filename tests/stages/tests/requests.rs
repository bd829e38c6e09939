//! Whatever is asked for of a system is derived, or refused for a reason that lies in the system: for each section of the
//! language, every word of `emit` on the shortest declaration that has it.

use nh_stages::{Declaration, Verdict, collected, declarations, errors, judged};
use nonholonomic_core::model::Request;
use proc_macro2::{Delimiter, TokenStream, TokenTree};
use std::collections::BTreeSet;
use std::fmt::Write;
use std::sync::LazyLock;

/// What one declaration may take.
const WORK: u64 = 60_000;

#[test]
fn every_word_of_emit_is_derived_or_refused_beside_every_section() {
    every_second_from(0);
}

#[test]
fn every_word_of_emit_is_derived_or_refused_beside_every_other_section() {
    every_second_from(1);
}

#[test]
fn every_word_is_compiled_with_all_others() {
    let together = declarations(include_str!("../../tests/asked_for_together.rs"));
    let words: BTreeSet<String> = together.iter().flat_map(asked).collect();
    // texts are compared as such: `latex.rs`, `c99.rs`, `explain.rs`
    let texts = [Request::Latex, Request::C, Request::Explain];
    for (word, request) in Request::WORDS {
        assert!(words.contains(word) || texts.contains(&request), "{word}");
    }
    let compiled: BTreeSet<String> = together.iter().flat_map(sections).collect();
    let all: BTreeSet<String> = declarations(&SHORTEST).iter().flat_map(sections).collect();
    let missing: Vec<&String> = all.difference(&compiled).collect();
    assert!(missing.is_empty(), "{missing:?}");
}

/// A function that is derived has a definition that it is proved by.
#[test]
fn nothing_is_derived_without_a_definition() {
    for declaration in declarations(include_str!("../../tests/asked_for_together.rs")) {
        let system = declaration.system().unwrap_or_else(|_| panic!("{}", declaration.attribute));
        let without = system.ledger.decisions.iter().filter(|decision| {
            decision.limits.iter().any(|limit| limit.contains("no definition is given for it"))
        });
        let without: Vec<&str> = without.map(|decision| decision.site).collect();
        assert!(without.is_empty(), "{}: {without:?}", declaration.attribute);
    }
}

fn every_second_from(first: usize) {
    let short = declarations(&SHORTEST);
    let (mut derived, mut refused) = (0, 0);
    for declaration in short.iter().skip(first).step_by(2) {
        for (word, _) in Request::WORDS {
            let asking = declaration.asking_for(word);
            let shown = || format!("#[nonholonomic({})]\n{}", asking.attribute, asking.item);
            match judged(&asking, WORK) {
                Ok(Verdict::Compiled) => derived += 1,
                Ok(Verdict::TooLarge) => {}
                Ok(Verdict::Refused) => {
                    refused += 1;
                    let found = errors(&asking.expanded()).join("\n");
                    assert!(!found.contains("please report"), "{word}: {found}\n{}", shown());
                }
                Err(defect) => panic!("{word}: {defect:?}\n{}", shown()),
            }
        }
    }
    assert!(derived > 150 && refused > 150, "{derived} derived, {refused} refused of {}", short.len());
}

/// The shortest declaration of the repository with each section that is in order.
static SHORTEST: LazyLock<String> = LazyLock::new(|| {
    let mut all = collected();
    all.sort_by_key(|declaration| declaration.attribute.to_string().len());
    all.dedup_by_key(|declaration| declaration.attribute.to_string());
    let mut taken: BTreeSet<String> = BTreeSet::new();
    let mut found = String::new();
    for declaration in all {
        let sections = sections(&declaration);
        if sections.iter().all(|section| taken.contains(section))
            || judged(&declaration, WORK) != Ok(Verdict::Compiled)
        {
            continue;
        }
        taken.extend(sections);
        _ = writeln!(found, "#[nonholonomic({})] {}", declaration.attribute, declaration.item);
    }
    found
});

/// The words before braces.
fn sections(declaration: &Declaration) -> Vec<String> {
    groups(declaration).into_iter().map(|(name, _)| name).filter(|name| name != "emit").collect()
}

/// The words of `emit`.
fn asked(declaration: &Declaration) -> Vec<String> {
    let emit = groups(declaration).into_iter().filter(|(name, _)| name == "emit");
    emit.flat_map(|(_, words)| words).map(|word| word.to_string()).collect()
}

fn groups(declaration: &Declaration) -> Vec<(String, TokenStream)> {
    let tokens: Vec<TokenTree> = declaration.attribute.clone().into_iter().collect();
    let named = |pair: &[TokenTree]| match pair {
        [TokenTree::Ident(name), TokenTree::Group(group)] if group.delimiter() == Delimiter::Brace => {
            Some((name.to_string(), group.stream()))
        }
        _ => None,
    };
    tokens.windows(2).filter_map(named).collect()
}
