//! `Full -> pub struct Reduced by { x, y } { … }`: the quotient of a declared system.

use std::collections::BTreeSet;
use std::rc::Rc;

use proc_macro2::{Delimiter, Ident, TokenStream, TokenTree};
use quote::quote;

use super::ast::{Definition, Item, Let, Name, Place, Section};
use super::items::items;
use super::map_syntax::{SystemPath, path};
use super::names::list;
use super::sections::{runtime, shared};
use super::stream::Stream;
use crate::report::{Diagnostic, Errors, Extent};

/// How it should look.
const READS: &str = "a quotient reads `Full -> pub struct Reduced by { x, y } { velocities { v = …; } }`";

/// A declared quotient.
#[derive(Debug)]
pub(crate) struct QuotientDecl {
    /// The full system.
    pub(crate) source: SystemPath,
    /// Attributes and visibility of the new struct.
    pub(crate) before: TokenStream,
    /// Its name.
    pub(crate) name: Ident,
    /// The coordinates along the group.
    pub(crate) dropped: Vec<Place>,
    /// The invariant quasi-velocities.
    pub(crate) velocities: Option<Section<Vec<Item<Definition>>>>,
    /// `let …;` between the sections, as far as the new declaration does not take them.
    pub(crate) lets: Vec<Rc<Let>>,
    /// Sections for the new declaration, and the lets that they use.
    pub(crate) passed: TokenStream,
    /// `crate`: the path of the runtime, where the dependency was renamed.
    pub(crate) runtime: Option<Section<TokenStream>>,
    /// From the full system to the new name.
    pub(crate) extent: Extent,
}

/// Reads the declaration of a quotient.
pub(crate) fn quotient(tokens: TokenStream) -> Result<QuotientDecl, Vec<Diagnostic>> {
    let mut errors = Errors::new();
    let mut stream = Stream::new(tokens, Extent::at(proc_macro2::Span::call_site()));
    let parsed = header(&mut stream, &mut errors).and_then(|mut declaration| {
        if let Some(body) = stream.eat_group(Delimiter::Brace) {
            sections(&mut Stream::inside(&body), &mut declaration, &mut errors)?;
        }
        if stream.is_empty() {
            Ok(declaration)
        } else {
            Err(stream.expected("the end of the macro").way_out(READS))
        }
    });
    match parsed {
        Ok(declaration) => errors.finish(declaration),
        Err(error) => {
            errors.push(error);
            errors.finish(()).and(Err(Vec::new()))
        }
    }
}

/// `Full -> #[…] pub struct Reduced by { x, y }`
fn header(stream: &mut Stream, errors: &mut Errors) -> Result<QuotientDecl, Diagnostic> {
    let start = stream.position();
    let source = path(stream).map_err(|error| error.or_way_out(READS))?;
    if !stream.eat("->") {
        return Err(stream.expected("`->`").way_out(READS));
    }
    let first = stream.position();
    while !stream.at_word("struct") {
        if stream.advance().is_none() {
            return Err(stream.expected("`struct`").way_out(READS));
        }
    }
    let before: TokenStream = stream.consumed(first).iter().cloned().collect();
    let between = stream.since(first);
    stream.eat_word("struct");
    let name = stream.name("the name of the new struct")?.ident;
    if syn::parse2::<syn::DeriveInput>(quote!(#before struct #name;)).is_err() {
        let what = "before `struct` stand attributes and a visibility, and nothing else";
        return Err(Diagnostic::new(between, what).way_out(READS));
    }
    let extent = stream.since(start);
    if !stream.eat_word("by") {
        return Err(stream.expected("`by` and the coordinates that are dropped").way_out(READS));
    }
    let Some(body) = stream.eat_group(Delimiter::Brace) else {
        return Err(stream.expected("`{`").way_out(READS));
    };
    let dropped = list(&body, errors, |entry| entry.place("a base coordinate"));
    Ok(QuotientDecl {
        source,
        before,
        name,
        dropped,
        velocities: None,
        lets: Vec::new(),
        passed: TokenStream::new(),
        runtime: None,
        extent,
    })
}

/// `velocities` and `crate` are read here, the others passed on.
fn sections(
    stream: &mut Stream,
    declaration: &mut QuotientDecl,
    errors: &mut Errors,
) -> Result<(), Diagnostic> {
    let mut lets = Vec::new();
    let mut of_the_map = BTreeSet::new();
    while !stream.is_empty() {
        if stream.at_word("let") {
            let first = stream.position();
            let line = Rc::new(shared(stream)?);
            lets.push((line, stream.consumed(first).iter().cloned().collect()));
            continue;
        }
        let Some(TokenTree::Ident(ident)) = stream.advance() else {
            return Err(stream.expected("a section").way_out(READS));
        };
        let keyword = Name::new(ident.clone());
        let Some(body) = stream.eat_group(Delimiter::Brace) else {
            return Err(stream.expected("`{`").way_out(format!("write `{} {{ … }}`", keyword.text)));
        };
        match keyword.text.as_str() {
            "velocities" => {
                words(body.stream(), &mut of_the_map);
                let body = items(&body, errors, &Stream::definition);
                declaration.velocities = Some(Section { keyword, body });
            }
            "crate" => {
                let body = errors.keep(runtime(&body));
                declaration.runtime = body.map(|body| Section { keyword, body });
            }
            "base" | "basis" | "anchor" | "brackets" | "frame" | "lagrangian" | "constraints"
            | "distribution" | "forces" | "inputs" => errors.push(
                Diagnostic::new(keyword.extent(), format!("`{}` is derived", keyword.text))
                    .way_out("leave it out; to declare both systems, use `morphism!`"),
            ),
            _ => declaration.passed.extend(quote!(#ident #body)),
        }
        while stream.eat(";") {}
    }
    declaration.share(&lets, of_the_map);
    Ok(())
}

impl QuotientDecl {
    /// A `let` belongs to what uses it: `velocities`, in the names of the full system, or the sections that are
    /// passed on, in those of the new one.
    fn share(&mut self, lets: &[(Rc<Let>, TokenStream)], mut of_the_map: BTreeSet<String>) {
        let mut of_the_new = BTreeSet::new();
        words(self.passed.clone(), &mut of_the_new);
        for used in [&mut of_the_map, &mut of_the_new] {
            // what a line names is used, too; no chain of lines is longer than their number
            for _ in lets {
                for (line, tokens) in lets {
                    if used.contains(&line.name.text) {
                        words(tokens.clone(), used);
                    }
                }
            }
        }
        let mut passed = TokenStream::new();
        for (line, tokens) in lets {
            let is_passed = of_the_new.contains(&line.name.text);
            if is_passed {
                passed.extend(tokens.clone());
            }
            // what nothing uses is read with the names of the full system
            if !is_passed || of_the_map.contains(&line.name.text) {
                self.lets.push(Rc::clone(line));
            }
        }
        passed.extend(std::mem::take(&mut self.passed));
        self.passed = passed;
    }
}

/// All words in some tokens.
fn words(tokens: TokenStream, found: &mut BTreeSet<String>) {
    let mut open = vec![tokens];
    while let Some(tokens) = open.pop() {
        for token in tokens {
            match token {
                TokenTree::Ident(ident) => drop(found.insert(Name::new(ident).text)),
                TokenTree::Group(group) => open.push(group.stream()),
                TokenTree::Punct(_) | TokenTree::Literal(_) => {}
            }
        }
    }
}
