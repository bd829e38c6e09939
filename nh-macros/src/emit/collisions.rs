//! Names that are made of declared ones may meet: impacts `Wall` and `wall` have types of one name, entries `q[0]` and a
//! coordinate `q_0` one variant. What is emitted is looked through once, whatever it was made by.

use std::collections::BTreeMap;

use proc_macro2::{Delimiter, Ident, TokenStream, TokenTree};

use crate::report::{Diagnostic, Extent};

/// Something emitted that has a name.
struct Named {
    ident: Ident,
    /// The first sentence of its documentation.
    doc: String,
}

/// The first two types, members of a type, or methods of one name.
pub(crate) fn collision(items: &TokenStream) -> Option<Diagnostic> {
    let tokens: Vec<TokenTree> = items.clone().into_iter().collect();
    let types = named_after(&tokens, &["struct", "enum", "trait", "type", "union"]);
    if let Some(found) = twice(&types, "types") {
        return Some(found);
    }
    let mut methods: BTreeMap<String, Vec<Named>> = BTreeMap::new();
    let mut start = 0;
    for (place, token) in tokens.iter().enumerate() {
        let TokenTree::Group(body) = token else { continue };
        if body.delimiter() != Delimiter::Brace {
            continue;
        }
        let header = &tokens[start..place];
        start = place + 1;
        let inside: Vec<TokenTree> = body.stream().into_iter().collect();
        let keyword = |wanted: &str| header.iter().position(|token| is_ident(token, wanted));
        let own = keyword("struct").or(keyword("enum"));
        if let Some(TokenTree::Ident(owner)) = own.and_then(|keyword| header.get(keyword + 1)) {
            if let Some(found) = twice(&members(&inside), &format!("fields or variants of `{owner}`")) {
                return Some(found);
            }
        } else if let (Some(keyword), None) = (keyword("impl"), keyword("for")) {
            let of: TokenStream = header[keyword..].iter().cloned().collect();
            methods.entry(of.to_string()).or_default().extend(named_after(&inside, &["fn", "const"]));
        }
    }
    methods.values().find_map(|methods| twice(methods, "methods or constants"))
}

fn is_ident(token: &TokenTree, text: &str) -> bool {
    matches!(token, TokenTree::Ident(ident) if *ident == text)
}

/// Names behind one of these keywords, not inside of braces.
fn named_after(tokens: &[TokenTree], keywords: &[&str]) -> Vec<Named> {
    let mut found = Vec::new();
    let mut doc = String::new();
    for (place, token) in tokens.iter().enumerate() {
        if let Some(text) = doc_of(tokens, place) {
            if doc.is_empty() {
                doc = text;
            }
            continue;
        }
        let TokenTree::Ident(keyword) = token else { continue };
        // `const fn` names a function
        if let Some(TokenTree::Ident(name)) = tokens.get(place + 1)
            && keywords.iter().any(|known| keyword == known)
            && *name != "fn"
            && *name != "_"
        {
            found.push(Named { ident: name.clone(), doc: std::mem::take(&mut doc) });
        }
    }
    found
}

/// The fields or variants of a type.
fn members(tokens: &[TokenTree]) -> Vec<Named> {
    let mut found = Vec::new();
    let mut doc = String::new();
    let mut is_open = true;
    let mut depth = 0_i32;
    for (place, token) in tokens.iter().enumerate() {
        if let Some(text) = doc_of(tokens, place) {
            if doc.is_empty() {
                doc = text;
            }
            continue;
        }
        match token {
            TokenTree::Punct(mark) if mark.as_char() == '<' => depth += 1,
            TokenTree::Punct(mark) if mark.as_char() == '>' => depth -= 1,
            TokenTree::Punct(mark) if mark.as_char() == ',' && depth == 0 => is_open = true,
            TokenTree::Ident(ident) if is_open && *ident != "pub" => {
                found.push(Named { ident: ident.clone(), doc: std::mem::take(&mut doc) });
                is_open = false;
            }
            _ => {}
        }
    }
    found
}

/// The text of a line of documentation whose brackets stand here.
fn doc_of(tokens: &[TokenTree], place: usize) -> Option<String> {
    let TokenTree::Group(group) = &tokens[place] else { return None };
    let before = place.checked_sub(1).and_then(|before| tokens.get(before));
    let is_attribute = matches!(before, Some(TokenTree::Punct(mark)) if mark.as_char() == '#');
    let inside: Vec<TokenTree> = group.stream().into_iter().collect();
    match inside.as_slice() {
        [TokenTree::Ident(doc), _, TokenTree::Literal(text)] if is_attribute && *doc == "doc" => {
            let text = text.to_string();
            Some(text.trim_matches('"').trim().trim_end_matches('.').to_owned())
        }
        _ => None,
    }
}

/// The first name that stands there a second time.
fn twice(names: &[Named], what: &str) -> Option<Diagnostic> {
    let mut known: BTreeMap<String, &Named> = BTreeMap::new();
    for named in names {
        let Some(first) = known.insert(named.ident.to_string(), named) else { continue };
        let documented = |named: &Named| match named.doc.as_str() {
            "" => format!("`{}`", named.ident),
            doc => format!("\"{doc}\""),
        };
        let error = Diagnostic::new(
            Extent::at(named.ident.span()),
            format!("two {what} that are generated are called `{}`", named.ident),
        );
        return Some(
            error
                .evidence(format!("one is {}, the other {}", documented(first), documented(named)))
                .way_out("choose another name for what one of them is made of"),
        );
    }
    None
}
