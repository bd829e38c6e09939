//! Declarations found in source text.

use proc_macro2::{Delimiter, Group, Ident, Span, TokenStream, TokenTree};

/// A struct with `#[nonholonomic(…)]`.
#[derive(Clone, Debug)]
pub struct Declaration {
    /// The name of the struct.
    pub name: String,
    /// What stands between the parentheses of the attribute.
    pub attribute: TokenStream,
    /// The struct, with its other attributes.
    pub item: TokenStream,
}

impl Declaration {
    /// The same with one word more in `emit { … }`.
    #[must_use]
    pub fn asking_for(&self, word: &str) -> Self {
        let mut tokens: Vec<TokenTree> = self.attribute.clone().into_iter().collect();
        let is_emit = |token: &TokenTree| matches!(token, TokenTree::Ident(ident) if ident == "emit");
        let place =
            tokens.windows(2).position(|pair| is_emit(&pair[0]) && matches!(pair[1], TokenTree::Group(_)));
        let asked = |others: &TokenStream| -> TokenStream {
            let others: Vec<String> =
                others.to_string().split(',').map(|other| other.trim().to_owned()).collect();
            let others =
                others.iter().filter(|other| !other.is_empty() && *other != word).map(String::as_str);
            let words = others.chain([word]).collect::<Vec<_>>().join(", ");
            words.parse().unwrap_or_default()
        };
        if let Some(TokenTree::Group(group)) = place.and_then(|place| tokens.get_mut(place + 1)) {
            *group = Group::new(Delimiter::Brace, asked(&group.stream()));
        } else {
            tokens.push(TokenTree::Ident(Ident::new("emit", Span::call_site())));
            tokens.push(TokenTree::Group(Group::new(Delimiter::Brace, asked(&TokenStream::new()))));
        }
        Self { attribute: tokens.into_iter().collect(), ..self.clone() }
    }
}

/// Every declaration in a Rust source text, those inside modules, functions and macros included, in their
/// order. Text that is not made of Rust tokens has none.
#[must_use]
pub fn declarations(source: &str) -> Vec<Declaration> {
    let mut found = Vec::new();
    if let Ok(tokens) = source.parse::<TokenStream>() {
        collect(tokens, &mut found);
    }
    found
}

fn collect(tokens: TokenStream, found: &mut Vec<Declaration>) {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let mut attributes: Vec<TokenTree> = Vec::new();
    let mut declaration: Option<TokenStream> = None;
    let mut rest = tokens.into_iter().peekable();
    while let Some(token) = rest.next() {
        let is_pound = matches!(&token, TokenTree::Punct(punct) if punct.as_char() == '#');
        if let (true, Some(TokenTree::Group(group))) = (is_pound, rest.peek())
            && group.delimiter() == Delimiter::Bracket
        {
            let group = group.clone();
            rest.next();
            match sections(&group) {
                Some(sections) => declaration = Some(sections),
                None => attributes.extend([token, TokenTree::Group(group)]),
            }
            continue;
        }
        if let Some(attribute) = declaration.take() {
            let mut item: Vec<TokenTree> = std::mem::take(&mut attributes);
            item.push(token);
            for next in rest.by_ref() {
                let is_end = matches!(&next, TokenTree::Group(group) if group.delimiter() == Delimiter::Brace)
                    || matches!(&next, TokenTree::Punct(punct) if punct.as_char() == ';');
                item.push(next);
                if is_end {
                    break;
                }
            }
            found.push(Declaration { name: name_of(&item), attribute, item: item.into_iter().collect() });
            continue;
        }
        attributes.clear();
        if let TokenTree::Group(group) = token {
            collect(group.stream(), found);
        }
    }
}

/// What `[nonholonomic(…)]` has between its parentheses.
fn sections(attribute: &Group) -> Option<TokenStream> {
    let tokens: Vec<TokenTree> = attribute.stream().into_iter().collect();
    let [path @ .., TokenTree::Group(arguments)] = tokens.as_slice() else { return None };
    let is_ours = matches!(path.last(), Some(TokenTree::Ident(ident)) if ident == "nonholonomic");
    (is_ours && arguments.delimiter() == Delimiter::Parenthesis).then(|| arguments.stream())
}

/// The identifier after `struct`.
fn name_of(item: &[TokenTree]) -> String {
    let mut tokens = item.iter().skip_while(|token| !matches!(token, TokenTree::Ident(i) if i == "struct"));
    tokens.nth(1).map(ToString::to_string).unwrap_or_default()
}
