//! Reference declarations with tokens exchanged, repeated and left out: no panic, no long run.

use nonholonomic_core::limits::timed;
use proc_macro2::{Group, TokenStream, TokenTree};

use super::super::resolve;
use super::catalogue::all;
use crate::emit::Layout;
use crate::syntax;
use crate::syntax::testing::Random;

/// All tokens that are no groups, to put in place of others.
fn leaves(tokens: &TokenStream, into: &mut Vec<TokenTree>) {
    for token in tokens.clone() {
        match token {
            TokenTree::Group(group) => leaves(&group.stream(), into),
            leaf => into.push(leaf),
        }
    }
}

/// The tokens with something changed here and there.
fn changed(tokens: TokenStream, leaves: &[TokenTree], random: &mut Random) -> TokenStream {
    const ODDS: usize = 400;
    let mut out: Vec<TokenTree> = Vec::new();
    for token in tokens {
        let token = match token {
            TokenTree::Group(group) => {
                let inside = changed(group.stream(), leaves, random);
                let mut group_changed = Group::new(group.delimiter(), inside);
                group_changed.set_span(group.span());
                TokenTree::Group(group_changed)
            }
            leaf => leaf,
        };
        let other = leaves[random.below(leaves.len())].clone();
        match (random.below(ODDS), &token, &other) {
            (0..10, TokenTree::Ident(_), TokenTree::Ident(_) | TokenTree::Literal(_))
            | (0..10, TokenTree::Literal(_), TokenTree::Literal(_))
            | (0..10, TokenTree::Punct(_), TokenTree::Punct(_)) => out.push(other),
            (10, ..) => out.extend([token.clone(), token]),
            (11, ..) => {}
            (12, ..) => out.extend([token, other]),
            _ => out.push(token),
        }
    }
    out.into_iter().collect()
}

#[test]
fn changed_declarations_are_resolved_or_refused() {
    let declarations = all();
    if declarations.is_empty() {
        return;
    }
    let mut words = Vec::new();
    for (attribute, _) in &declarations {
        leaves(attribute, &mut words);
    }
    let mut random = Random(1);
    let (mut resolved, mut refused) = (0, 0);
    for round in 0..600 {
        let (attribute, item) = &declarations[round % declarations.len()];
        let attribute = changed(attribute.clone(), &words, &mut random);
        let Ok(declaration) = syntax::parse(attribute.clone(), item.clone()) else {
            // beside the errors there are items all the same
            let expanded = crate::expand::nonholonomic(attribute.clone(), item.clone());
            assert!(syn::parse2::<syn::File>(expanded).is_ok(), "{attribute}");
            continue;
        };
        let mut layout = Layout::of_struct(&declaration.structure, attribute.clone());
        let (outcome, seconds) = timed(|| resolve(&declaration, &mut layout));
        match outcome {
            Ok(_) => resolved += 1,
            Err(unresolved) => {
                assert!(!unresolved.errors.is_empty(), "{attribute}");
                refused += 1;
            }
        }
        assert!(seconds < 10.0, "{seconds} s: {attribute}");
    }
    assert!(resolved > 10 && refused > 10, "{resolved} resolved, {refused} refused");
}
