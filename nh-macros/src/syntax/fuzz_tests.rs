//! Random tokens from the language's own vocabulary: no panic, no long run.

use proc_macro2::{Delimiter, Group, Ident, Literal, Punct, Spacing, Span, TokenStream, TokenTree};

use super::parse;
use super::testing::Random;
use super::vocabulary::{FUNCTIONS, RESERVED, SECTIONS};
use crate::report::compile_errors;

fn word(text: &str) -> TokenTree {
    TokenTree::Ident(Ident::new(text, Span::call_site()))
}

fn soup(random: &mut Random, length: usize, depth: u32) -> TokenStream {
    const NAMES: [&str; 12] = ["x", "y", "w", "m", "i", "j", "in", "let", "for", "self", "so", "adapted"];
    let mut tokens = Vec::new();
    for _ in 0..random.below(length + 1) {
        match random.below(12) {
            0 => tokens.push(word(random.pick(&SECTIONS))),
            1 => tokens.push(word(random.pick(&FUNCTIONS))),
            2 => tokens.push(word(random.pick(&RESERVED))),
            3..5 => tokens.push(word(random.pick(&NAMES))),
            5 => {
                let text = random.pick(&["0", "2", "0.5", "1e-3", "3f64", "2x", "\"a\"", "0x1", "4", "1_0"]);
                tokens.push(TokenTree::Literal(text.parse::<Literal>().expect("a literal")));
            }
            6..9 => {
                let marks = "+-*/^=;:,.<>!#'&|%..;;==";
                let mark = char::from(marks.as_bytes()[random.below(marks.len())]);
                let spacing = if random.below(2) == 0 { Spacing::Joint } else { Spacing::Alone };
                tokens.push(TokenTree::Punct(Punct::new(mark, spacing)));
            }
            _ if depth == 0 => {}
            9 if depth > 2 => {
                // a section as it should be, with anything in it
                tokens.push(word(random.pick(&SECTIONS)));
                let body = soup(random, length, depth - 1);
                tokens.push(TokenTree::Group(Group::new(Delimiter::Brace, body)));
            }
            _ => {
                let kinds = [Delimiter::Parenthesis, Delimiter::Bracket, Delimiter::Brace, Delimiter::None];
                let body = soup(random, length / 2, depth - 1);
                tokens.push(TokenTree::Group(Group::new(kinds[random.below(4)], body)));
            }
        }
    }
    tokens.into_iter().collect()
}

#[test]
fn token_soup_never_panics() {
    let mut random = Random(1);
    let mut read = 0;
    for round in 0..20_000 {
        let attribute = soup(&mut random, 4 + round % 24, 4);
        let item = if round % 3 == 0 {
            soup(&mut random, 12, 3)
        } else {
            quote::quote!(
                struct S {
                    m: f64,
                }
            )
        };
        match parse(attribute, item) {
            Ok(_) => read += 1,
            Err(malformed) => {
                assert!(!malformed.errors.is_empty());
                compile_errors(&malformed.errors);
            }
        }
    }
    // such soup is hardly ever a system
    assert!(read < 100);
}

#[test]
fn damaged_declarations_never_panic() {
    let text = "base { x, theta[2] } basis { w[3], v } anchor { der(x) = v * cos(x) - .5; for i in 0..2 { \
                der(theta[i]) = w[i]; } } brackets so(3) { w } lagrangian { let a[i in 0..3] = i^2; \
                sum(i in 0..3: a[i] * w[i]^2) + dot([1, 2], theta) } constraints { knife: v = 0; } \
                forces { w[0]: self.motor(v, 2); } names { state = Q; } formulation { projected }";
    let whole: Vec<TokenTree> = text.parse::<TokenStream>().expect("tokens").into_iter().collect();
    let mut random = Random(2);
    let mut read = 0;
    for _ in 0..5_000 {
        let damaged = damage(&whole, &mut random);
        read += usize::from(
            parse(
                damaged,
                quote::quote!(
                    struct S;
                ),
            )
            .is_ok(),
        );
    }
    assert!((10..4_900).contains(&read), "{read}");
}

/// A copy with a token lost, doubled or exchanged here and there, at every depth.
fn damage(tokens: &[TokenTree], random: &mut Random) -> TokenStream {
    let mut copy = Vec::new();
    for token in tokens {
        let token = match token {
            TokenTree::Group(group) => {
                let inside: Vec<TokenTree> = group.stream().into_iter().collect();
                TokenTree::Group(Group::new(group.delimiter(), damage(&inside, random)))
            }
            other => other.clone(),
        };
        match random.below(300) {
            0 => {}
            1 => copy.extend([token.clone(), token]),
            2 => copy.push(tokens[random.below(tokens.len())].clone()),
            _ => copy.push(token),
        }
    }
    copy.into_iter().collect()
}
