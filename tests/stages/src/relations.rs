//! Maps between declared systems and quotients of them, found in source text.

use crate::{Declaration, declarations};
use proc_macro2::{TokenStream, TokenTree};

/// A `morphism!` or a `quotient!` with the declarations that it is about.
#[derive(Clone, Debug)]
pub struct Relation {
    /// The system that is mapped.
    pub source: Declaration,
    /// What it is mapped to; a quotient declares that itself.
    pub target: Option<Declaration>,
    /// What stands between the braces.
    pub written: TokenStream,
}

impl Relation {
    /// What the macro makes of it.
    #[must_use]
    pub fn expanded(&self) -> TokenStream {
        match &self.target {
            Some(target) => self.source.morphism(target, &self.written),
            None => self.source.quotient(&self.written),
        }
    }

    /// The macro's name.
    #[must_use]
    pub fn name(&self) -> &'static str {
        if self.target.is_some() { "morphism" } else { "quotient" }
    }
}

/// Every map and quotient in a Rust source text of systems that are declared there.
#[must_use]
pub fn relations(source: &str) -> Vec<Relation> {
    let mut found = Vec::new();
    if let Ok(tokens) = source.parse::<TokenStream>() {
        let declared = declarations(source);
        if !declared.is_empty() {
            collect(tokens, &declared, &mut found);
        }
    }
    found
}

fn collect(tokens: TokenStream, declared: &[Declaration], found: &mut Vec<Relation>) {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    for (place, token) in tokens.iter().enumerate() {
        let TokenTree::Group(group) = token else { continue };
        let name = match place.checked_sub(2).map(|before| &tokens[before..place]) {
            Some([TokenTree::Ident(name), TokenTree::Punct(mark)]) if mark.as_char() == '!' => {
                name.to_string()
            }
            _ => String::new(),
        };
        match name.as_str() {
            "morphism" | "quotient" => {
                found.extend(relation(group.stream(), declared, name == "morphism"));
            }
            _ => collect(group.stream(), declared, found),
        }
    }
}

/// `Source -> Target …`, with the names of declared systems.
fn relation(written: TokenStream, declared: &[Declaration], is_map: bool) -> Option<Relation> {
    let tokens: Vec<TokenTree> = written.clone().into_iter().collect();
    let is_mark = |token: &TokenTree, mark| matches!(token, TokenTree::Punct(p) if p.as_char() == mark);
    let arrow = tokens.windows(2).position(|pair| is_mark(&pair[0], '-') && is_mark(&pair[1], '>'))?;
    let named = |token: Option<&TokenTree>| {
        let name = token?.to_string();
        declared.iter().find(|declaration| declaration.name == name).cloned()
    };
    let source = named(tokens.get(arrow.checked_sub(1)?))?;
    let target = if is_map { Some(named(tokens.get(arrow + 2))?) } else { None };
    Some(Relation { source, target, written })
}
