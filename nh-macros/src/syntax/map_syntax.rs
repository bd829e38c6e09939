//! `Full -> Reduced { … }`: a map between two declared systems.

use std::rc::Rc;

use proc_macro2::{Delimiter, Group, Ident, TokenStream, TokenTree};
use quote::quote;

use super::ast::{Definition, Item, Let, Name, Section};
use super::items::items;
use super::sections::{runtime, shared};
use super::stream::Stream;
use crate::report::{Diagnostic, Errors, Extent};
use crate::suggest::did_you_mean;

/// The sections of a map.
const SECTIONS: [&str; 5] = ["parameters", "base", "velocities", "inputs", "crate"];

/// How it should look.
const READS: &str = "a morphism reads `Full -> Reduced { velocities { v = …; } }`";

/// Definitions of the target's quantities.
pub(crate) type Definitions = Option<Section<Vec<Item<Definition>>>>;

/// A declared map.
#[derive(Debug)]
pub(crate) struct MorphismDecl {
    /// The system that is mapped.
    pub(crate) source: SystemPath,
    /// The system it is mapped to.
    pub(crate) target: SystemPath,
    /// `parameters`: those of the target.
    pub(crate) parameters: Definitions,
    /// `base`: the coordinates of the target.
    pub(crate) base: Definitions,
    /// `velocities`: the quasi-velocities of the target.
    pub(crate) velocities: Definitions,
    /// `inputs`: those of the target.
    pub(crate) inputs: Definitions,
    /// `let …;` between the sections, in the names of the source.
    pub(crate) lets: Vec<Rc<Let>>,
    /// `crate`: the path of the runtime, where the dependency was renamed.
    pub(crate) runtime: Option<Section<TokenStream>>,
}

/// The path of a declared struct.
#[derive(Debug)]
pub(crate) struct SystemPath {
    /// All of it.
    pub(crate) path: TokenStream,
    /// What is before the last name.
    before: TokenStream,
    /// The last name.
    pub(crate) name: Ident,
    /// Where it stands.
    pub(crate) extent: Extent,
}

impl SystemPath {
    /// The path of something else beside the struct.
    pub(crate) fn beside(&self, name: &Ident) -> TokenStream {
        let before = &self.before;
        quote!(#before #name)
    }
}

impl MorphismDecl {
    /// Where the map as a whole is declared.
    pub(crate) fn extent(&self) -> Extent {
        self.source.extent.to(self.target.extent)
    }
}

/// Reads the declaration of a map.
pub(crate) fn morphism(tokens: TokenStream) -> Result<MorphismDecl, Vec<Diagnostic>> {
    let mut errors = Errors::new();
    let mut stream = Stream::new(tokens, Extent::at(proc_macro2::Span::call_site()));
    let parsed = header(&mut stream).map(|(source, target, body)| {
        let mut declaration = MorphismDecl {
            source,
            target,
            parameters: None,
            base: None,
            velocities: None,
            inputs: None,
            lets: Vec::new(),
            runtime: None,
        };
        let mut inner = Stream::inside(&body);
        while !inner.is_empty() {
            if let Err(error) = section(&mut inner, &mut declaration, &mut errors) {
                errors.push(error);
                break;
            }
        }
        declaration
    });
    let trailing = if stream.is_empty() { Ok(()) } else { Err(stream.expected("the end of the macro")) };
    match parsed {
        Ok(declaration) => {
            errors.keep(trailing);
            errors.finish(declaration)
        }
        Err(error) => {
            errors.push(error);
            errors.finish(()).and(Err(Vec::new()))
        }
    }
}

/// `Full -> Reduced { … }`
fn header(stream: &mut Stream) -> Result<(SystemPath, SystemPath, Group), Diagnostic> {
    let source = path(stream)?;
    if !stream.eat("->") {
        return Err(stream.expected("`->`").way_out(READS));
    }
    let target = path(stream)?;
    let Some(body) = stream.eat_group(Delimiter::Brace) else {
        return Err(stream.expected("`{`").way_out(READS));
    };
    Ok((source, target, body))
}

/// Words of Rust in front of a path.
const ABOVE: [&str; 3] = ["crate", "self", "super"];

/// `models::Sleigh`
pub(crate) fn path(stream: &mut Stream) -> Result<SystemPath, Diagnostic> {
    let start = stream.position();
    stream.eat("::");
    loop {
        let before: TokenStream = stream.consumed(start).iter().cloned().collect();
        let Some(name) = stream.eat_ident() else {
            return Err(stream.expected("the name of a system").way_out(READS));
        };
        let goes_on = stream.eat("::");
        let is_above = goes_on && ABOVE.contains(&name.to_string().as_str());
        if !is_above {
            Name::new(name.clone()).check_word("the name of a system")?;
        }
        if goes_on {
            continue;
        }
        if stream.at_marks("<") {
            return Err(Diagnostic::new(stream.here(), "a system is named without generics")
                .way_out("leave them out: the map is made for every scalar that both systems have"));
        }
        let path = stream.consumed(start).iter().cloned().collect();
        return Ok(SystemPath { path, before, name, extent: stream.since(start) });
    }
}

/// One section of the map.
fn section(
    stream: &mut Stream,
    declaration: &mut MorphismDecl,
    errors: &mut Errors,
) -> Result<(), Diagnostic> {
    while stream.eat(";") {}
    if stream.is_empty() {
        return Ok(());
    }
    if stream.at_word("let") {
        declaration.lets.push(Rc::new(shared(stream)?));
        return Ok(());
    }
    let Some(ident) = stream.eat_ident() else {
        return Err(stream.expected("a section").way_out(READS));
    };
    let keyword = Name::new(ident);
    let Some(body) = stream.eat_group(Delimiter::Brace) else {
        return Err(stream.expected("`{`").way_out(format!("write `{} {{ … }}`", keyword.text)));
    };
    let slot = match keyword.text.as_str() {
        "parameters" => &mut declaration.parameters,
        "base" => &mut declaration.base,
        "velocities" => &mut declaration.velocities,
        "inputs" => &mut declaration.inputs,
        "crate" => {
            let body = errors.keep(runtime(&body));
            declaration.runtime = body.map(|body| Section { keyword, body });
            return Ok(());
        }
        _ => {
            errors.push(unknown(&keyword));
            return Ok(());
        }
    };
    if slot.is_some() {
        errors.push(
            Diagnostic::new(keyword.extent(), format!("a second `{}`", keyword.text))
                .way_out("move its content into the first one"),
        );
        return Ok(());
    }
    *slot = Some(Section { keyword, body: items(&body, errors, &Stream::definition) });
    Ok(())
}

fn unknown(keyword: &Name) -> Diagnostic {
    let error = Diagnostic::new(keyword.extent(), format!("unknown section `{}` of a map", keyword.text));
    match did_you_mean(&keyword.text, SECTIONS) {
        Some(question) => error.way_out(question),
        None => error.way_out(format!("sections of a map: {}", SECTIONS.join(", "))),
    }
}

/// Takes `declaration { {attribute} {struct} }` off the front, where a declaration was handed over.
pub(crate) fn handed_over(tokens: &mut Vec<TokenTree>) -> Option<(TokenStream, TokenStream)> {
    let [TokenTree::Ident(word), TokenTree::Group(group), ..] = tokens.as_slice() else { return None };
    if word != "declaration" || group.delimiter() != Delimiter::Brace {
        return None;
    }
    let mut parts = group.stream().into_iter();
    let (Some(TokenTree::Group(attribute)), Some(TokenTree::Group(item)), None) =
        (parts.next(), parts.next(), parts.next())
    else {
        return None;
    };
    tokens.drain(..2);
    Some((attribute.stream(), item.stream()))
}
