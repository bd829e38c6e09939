//! What can be read off expanded code.

use proc_macro2::{TokenStream, TokenTree};

/// The messages of all `compile_error!`s, those inside of functions included, in order.
#[must_use]
pub fn errors(items: &TokenStream) -> Vec<String> {
    let tokens: Vec<TokenTree> = items.clone().into_iter().collect();
    let mut found = Vec::new();
    for (k, token) in tokens.iter().enumerate() {
        let TokenTree::Group(group) = token else { continue };
        let before = |back: usize| k.checked_sub(back).and_then(|k| tokens.get(k)).map(ToString::to_string);
        found.extend(errors(&group.stream()));
        if before(1).as_deref() == Some("!") && before(2).as_deref() == Some("compile_error") {
            found.extend(syn::parse2::<syn::LitStr>(group.stream()).map(|text| text.value()));
        }
    }
    found
}

/// How many tokens there are, those inside of groups included.
#[must_use]
pub fn length(items: &TokenStream) -> usize {
    let mut open = vec![items.clone()];
    let mut count = 0;
    while let Some(tokens) = open.pop() {
        for token in tokens {
            count += 1;
            if let TokenTree::Group(group) = token {
                open.push(group.stream());
            }
        }
    }
    count
}

/// The text of a generated constant.
#[must_use]
pub fn constant(tokens: TokenStream, name: &str) -> Option<String> {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    for (k, token) in tokens.iter().enumerate() {
        if matches!(token, TokenTree::Ident(ident) if ident == name) {
            let literal = tokens[k..].iter().find_map(|token| match token {
                TokenTree::Literal(literal) => syn::parse_str::<syn::LitStr>(&literal.to_string()).ok(),
                _ => None,
            });
            return literal.map(|literal| literal.value());
        }
        if let TokenTree::Group(group) = token
            && let Some(found) = constant(group.stream(), name)
        {
            return Some(found);
        }
    }
    None
}
