//! What an editor resolves the names inside an attribute by: code that uses every declared name, in the words of the
//! attribute. It is seen by rust-analyzer alone, and never compiled.

use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::{Delimiter, Ident, TokenStream, TokenTree};
use quote::quote;

use super::layout::{local, plain};
use super::record::Record;
use super::setting::Context;
use crate::syntax::is_mark;

/// A function with a statement for every name that the attribute uses.
///
/// A parameter is a field of the struct, a coordinate one of the state, and so on: from the use, hover and definition
/// lead there, and renaming takes both along. What is no field anywhere, a `let` or the variable of a sum, is a variable here.
pub(super) fn emit(context: &Context, has_velocity: bool) -> TokenStream {
    let layout = context.layout;
    let (name, lints) = (&layout.name, &context.lints);
    let (impl_generics, ty_generics, where_clause) = context.generics.split_for_impl();
    let mut names = Names::default();
    let system = local("system");
    names.add(&system, layout.parameters.iter().map(|family| &family.ident));
    let mut arguments = vec![quote!(#system: &#name #ty_generics)];
    let velocity = has_velocity.then_some(&context.velocity);
    let records: [(&str, Option<&Record>); 4] = [
        ("state", Some(&context.state)),
        ("velocity", velocity),
        ("input", context.input.as_ref()),
        ("outputs", context.outputs.as_ref()),
    ];
    for (argument, record) in records {
        let Some(record) = record else { continue };
        let (argument, type_of) = (local(argument), context.type_of(record));
        names.add(&argument, record.fields.iter().map(|field| &field.ident));
        arguments.push(quote!(#argument: &#type_of));
    }
    let families = [&layout.coordinates, &layout.velocities, &layout.frame, &layout.auxiliary];
    let families = families.into_iter().chain([&layout.inputs, &layout.outputs, &layout.parameters]);
    let constants = constants(&layout.attribute);
    let mut declared: Vec<&Ident> = families.flatten().map(|family| &family.ident).collect();
    declared.extend(&constants);
    let mut seen = BTreeSet::new();
    declared.retain(|ident| seen.insert(plain(ident)));
    // names of no field: constants, and families of which the state keeps some entries
    let loose: Vec<&Ident> =
        declared.iter().copied().filter(|ident| !names.0.contains_key(&plain(ident))).collect();
    let mut body = quote!(#(let #loose = ();)*);
    let loose: Vec<String> = loose.into_iter().map(plain).collect();
    names.scope(layout.attribute.clone(), &loose, &mut body);
    quote! {
        #lints
        #[allow(unexpected_cfgs)]
        const _: () = {
            #[cfg(rust_analyzer)]
            #[allow(warnings)]
            fn names #impl_generics (#(#arguments),*) #where_clause { #body }
        };
    }
}

/// The values that have declared names as fields.
#[derive(Default)]
struct Names(BTreeMap<String, Ident>);

/// Sections that hold other words than names of the declaration.
const OTHER_WORDS: [&str; 5] = ["emit", "accuracy", "names", "formulation", "crate"];

impl Names {
    fn add<'a>(&mut self, place: &Ident, fields: impl Iterator<Item = &'a Ident>) {
        for field in fields {
            self.0.entry(plain(field)).or_insert_with(|| place.clone());
        }
    }

    /// What a list of tokens introduces, then what it uses; a group in braces is a scope of its own.
    fn scope(&self, tokens: TokenStream, outer: &[String], body: &mut TokenStream) {
        let tokens: Vec<TokenTree> = tokens.into_iter().collect();
        let mut own = Vec::new();
        binders(&tokens, &mut own);
        // half-typed lines introduce words of the language
        own.retain(|ident| syn::parse_str::<Ident>(&ident.to_string()).is_ok());
        body.extend(own.iter().map(|ident| quote!(let #ident = ();)));
        let bound: Vec<String> = outer.iter().cloned().chain(own.iter().map(plain)).collect();
        self.uses(&tokens, &bound, body);
    }

    fn uses(&self, tokens: &[TokenTree], bound: &[String], body: &mut TokenStream) {
        let mut before = None;
        for (index, token) in tokens.iter().enumerate() {
            match token {
                TokenTree::Ident(ident) => {
                    let follows = tokens.get(index + 1);
                    let introduced = before.as_deref() == Some("let") || is_word(follows, "in");
                    if !introduced {
                        self.use_of(ident, follows, bound, body);
                    }
                    before = Some(plain(ident));
                }
                TokenTree::Group(group) => {
                    let word = before.take().unwrap_or_default();
                    let inside: Vec<TokenTree> = group.stream().into_iter().collect();
                    if group.delimiter() != Delimiter::Brace {
                        self.uses(&inside, bound, body);
                    } else if word == "units" {
                        // behind `=` stand units
                        for line in inside.split(|token| is_mark(token, ';')) {
                            let names = line.split(|token| is_mark(token, '=')).next().unwrap_or_default();
                            self.uses(names, bound, body);
                        }
                    } else if !OTHER_WORDS.contains(&word.as_str()) {
                        let mut block = TokenStream::new();
                        self.scope(group.stream(), bound, &mut block);
                        if !block.is_empty() {
                            body.extend(quote!({ #block }));
                        }
                    }
                }
                TokenTree::Punct(_) | TokenTree::Literal(_) => before = None,
            }
        }
    }

    fn use_of(&self, ident: &Ident, follows: Option<&TokenTree>, bound: &[String], body: &mut TokenStream) {
        let name = plain(ident);
        let is_call =
            matches!(follows, Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Parenthesis);
        if bound.contains(&name) {
            body.extend(quote!(_ = #ident;));
        } else if let (Some(place), false) = (self.0.get(&name), is_call) {
            body.extend(quote!(_ = #place.#ident;));
        }
    }
}

/// The names that `let`, `in` and the arguments of functions introduce in a list of tokens, outside braces.
fn binders(tokens: &[TokenTree], found: &mut Vec<Ident>) {
    for (index, token) in tokens.iter().enumerate() {
        match token {
            TokenTree::Ident(ident) if is_word(tokens.get(index + 1), "in") => found.push(ident.clone()),
            TokenTree::Ident(ident) if *ident == "let" => {
                let Some(TokenTree::Ident(name)) = tokens.get(index + 1) else { continue };
                found.push(name.clone());
                if let Some(TokenTree::Group(group)) = tokens.get(index + 2)
                    && group.delimiter() == Delimiter::Parenthesis
                {
                    found.extend(group.stream().into_iter().filter_map(|token| match token {
                        TokenTree::Ident(argument) => Some(argument),
                        _ => None,
                    }));
                }
            }
            TokenTree::Group(group) if group.delimiter() != Delimiter::Brace => {
                binders(&group.stream().into_iter().collect::<Vec<_>>(), found);
            }
            _ => {}
        }
    }
}

/// The names that a section `constants` declares.
fn constants(attribute: &TokenStream) -> Vec<Ident> {
    let tokens: Vec<TokenTree> = attribute.clone().into_iter().collect();
    let body = tokens.windows(2).find_map(|pair| match pair {
        [TokenTree::Ident(word), TokenTree::Group(body)] if word == "constants" => Some(body.stream()),
        _ => None,
    });
    let tokens: Vec<TokenTree> = body.into_iter().flatten().collect();
    let lines = tokens.split(|token| is_mark(token, ';'));
    lines
        .filter_map(|line| {
            line.iter().find_map(|token| match token {
                TokenTree::Ident(ident) => Some(ident.clone()),
                _ => None,
            })
        })
        .collect()
}

fn is_word(token: Option<&TokenTree>, word: &str) -> bool {
    matches!(token, Some(TokenTree::Ident(ident)) if ident == word)
}
