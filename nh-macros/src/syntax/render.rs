//! Tokens as a person would write them, for messages.

use proc_macro2::{Delimiter, Punct, Spacing, TokenStream, TokenTree};

/// Messages quote this much and no more.
const LONGEST: usize = 60;

/// The tokens as text, cut when they are long.
pub(crate) fn render(tokens: &[TokenTree]) -> String {
    let mut text = String::new();
    // an explicit stack: what is nested too deeply is rendered too, for the error about it
    let whole: TokenStream = tokens.iter().cloned().collect();
    let mut stack = vec![(whole.into_iter(), "")];
    while let Some((tokens, close)) = stack.last_mut() {
        if text.chars().count() > LONGEST {
            text = text.chars().take(LONGEST).chain(['…']).collect();
            break;
        }
        match tokens.next() {
            Some(TokenTree::Group(group)) => {
                let (open, close) = match group.delimiter() {
                    Delimiter::Parenthesis => ("(", ")"),
                    Delimiter::Brace => ("{ ", " }"),
                    Delimiter::Bracket => ("[", "]"),
                    Delimiter::None => ("", ""),
                };
                text.push_str(open);
                stack.push((group.stream().into_iter(), close));
            }
            Some(TokenTree::Punct(punct)) => push_punct(&mut text, &punct),
            Some(word) => {
                if text.ends_with(|c: char| c.is_alphanumeric() || c == '_') {
                    text.push(' ');
                }
                text.push_str(&word.to_string());
            }
            None => {
                text.push_str(close);
                stack.pop();
            }
        }
    }
    text.trim().to_owned()
}

/// A mark with the blanks that are usual around it.
fn push_punct(text: &mut String, punct: &Punct) {
    let mark = punct.as_char();
    let mark_joins = punct.spacing() == Spacing::Joint;
    let after_value = text.ends_with(|c: char| c.is_alphanumeric() || "_)]".contains(c));
    match mark {
        ':' if mark_joins || text.ends_with(':') => text.push(mark),
        ',' | ';' | ':' => {
            text.push(mark);
            text.push(' ');
        }
        '+' | '-' | '*' | '/' | '=' if after_value => {
            text.push(' ');
            text.push(mark);
            text.push(' ');
        }
        '*' | '=' if text.ends_with(' ') => {
            text.pop();
            text.push(mark);
            text.push(' ');
        }
        _ => text.push(mark),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rendered(text: &str) -> String {
        let tokens: TokenStream = text.parse().unwrap();
        render(&tokens.into_iter().collect::<Vec<_>>())
    }

    #[test]
    fn tokens_are_written_as_usual() {
        assert_eq!(rendered("a+b * - c"), "a + b * -c");
        assert_eq!(rendered("f ( a , b )"), "f(a, b)");
        assert_eq!(rendered("I [0] . sin ()"), "I[0].sin()");
        assert_eq!(rendered("der ( x ) = y"), "der(x) = y");
        assert_eq!(rendered("sin x"), "sin x");
        assert_eq!(rendered("w : :: a :: b"), "w: ::a::b");
        assert_eq!(rendered("a == b"), "a == b");
        assert_eq!(rendered("base{x}"), "base{ x }");
    }

    #[test]
    fn long_text_is_cut() {
        let long = rendered(&"omega + ".repeat(1000));
        assert_eq!(long.chars().count(), 61);
        assert!(long.ends_with('…'));
    }
}
