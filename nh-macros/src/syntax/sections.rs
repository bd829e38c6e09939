//! The attribute: sections in any order, each at most once except `brackets`.

use std::cell::RefCell;
use std::rc::Rc;

use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};
use syn::parse::Parser;

use super::ast::{Brackets, Expr, Formulation, KnownAlgebra, Let, Name, Section, Sections, Velocity};
use super::items::{items, lagrangian, let_line};
use super::names::list;
use super::render::render;
use super::stream::Stream;
use super::vocabulary::{ALGEBRAS, SECTIONS};
use crate::report::{Diagnostic, Errors, Extent};
use crate::suggest::{did_you_mean, nearest};

/// Reads all sections; what is wrong with one of them does not hide the others.
pub(crate) fn sections(attribute: TokenStream, around: Extent, errors: &mut Errors) -> Sections {
    let mut stream = Stream::new(attribute, around);
    let mut sections = Sections::default();
    let mut seen: Vec<String> = Vec::new();
    while !stream.is_empty() {
        if let Err(error) = section(&mut stream, &mut sections, &mut seen, errors) {
            errors.push(error);
            recover(&mut stream);
        }
    }
    sections
}

/// Reads one section.
fn section(
    stream: &mut Stream,
    sections: &mut Sections,
    seen: &mut Vec<String>,
    errors: &mut Errors,
) -> Result<(), Diagnostic> {
    let documented = stream.position();
    if !stream.docs()?.is_empty() {
        errors.push(
            Diagnostic::new(stream.since(documented), "a doc comment before a section documents nothing")
                .way_out("write `//`, or put it before a declared name"),
        );
    }
    while stream.eat(";") {}
    if stream.is_empty() {
        return Ok(());
    }
    if stream.at_word("let") {
        let line = shared(stream)?;
        sections.lets.push(Rc::new(line));
        return Ok(());
    }
    let Some(ident) = stream.eat_ident() else {
        return Err(if stream.at_marks(",") {
            Diagnostic::new(stream.here(), "sections are not separated by commas").way_out("leave it out")
        } else {
            stream.expected("a section").way_out("a section reads `base { x, y }`")
        });
    };
    let keyword = Name::new(ident);
    let text = keyword.text.clone();
    if !SECTIONS.contains(&text.as_str()) {
        let error = unknown(&keyword);
        return probably_meant(stream, sections, seen, keyword)
            .ok_or(error.clone())
            .map(|()| errors.push(error));
    }
    if text != "brackets" && seen.contains(&text) {
        errors.push(
            Diagnostic::new(keyword.extent(), format!("a second `{text}`"))
                .evidence(format!("`{text}` was declared above already"))
                .way_out("move its content into the first one"),
        );
    }
    let doubled = text != "brackets" && seen.contains(&text);
    seen.push(text.clone());
    if text == "almost" {
        sections.almost = Some(keyword.extent());
        return match stream.peek_group(Delimiter::Brace) {
            Some(_) => Err(stream.expected("`;`").way_out("`almost;` has no content")),
            None => Ok(()),
        };
    }
    if text == "volume" && stream.peek_group(Delimiter::Brace).is_none() {
        sections.volume = Section::some(keyword, None);
        return Ok(());
    }
    let algebra = if text == "brackets" { algebra(stream)? } else { None };
    let Some(body) = stream.eat_group(Delimiter::Brace) else {
        return Err(stream.expected("`{`").way_out(format!("write `{text} {{ … }}`")));
    };
    if doubled {
        // what is wrong inside is reported, what is right is not kept
        fill(&mut Sections::default(), keyword, algebra, &body, errors);
    } else {
        fill(sections, keyword, algebra, &body, errors);
    }
    Ok(())
}

/// `let …;` between the sections. Without its `;` it ends before the next section all the same.
pub(super) fn shared(stream: &mut Stream) -> Result<Let, Diagnostic> {
    let mut tokens = Vec::new();
    let around = stream.here();
    while !stream.is_empty() && !stream.at_marks(";") && !at_section(stream) {
        tokens.extend(stream.advance());
    }
    let ended = stream.eat(";");
    let line = let_line(&mut Stream::over(tokens, around))?;
    if ended {
        return Ok(line);
    }
    Err(Diagnostic::new(line.extent, "a `;` is missing behind this `let`")
        .way_out("between the sections every `let` ends with `;`"))
}

/// Whether a section begins at the cursor.
fn at_section(stream: &Stream) -> bool {
    let begins = |token: Option<&TokenTree>| matches!(token, Some(TokenTree::Ident(ident)) if SECTIONS.contains(&ident.to_string().as_str()));
    let opens = |token: Option<&TokenTree>| matches!(token, Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Brace);
    begins(stream.peek()) && opens(stream.peek_at(1))
}

/// Reads the body of a section into its place.
fn fill(sections: &mut Sections, keyword: Name, algebra: Option<Algebra>, body: &Group, errors: &mut Errors) {
    let text = keyword.text.clone();
    let s = sections;
    match text.as_str() {
        "constants" => s.constants = Section::some(keyword, plain(body, errors, &Stream::definition)),
        "base" => s.base = Section::some(keyword, list(body, errors, Stream::declared)),
        "on" => s.on = Section::some(keyword, items(body, errors, &Stream::equation)),
        "basis" => s.basis = Section::some(keyword, list(body, errors, Stream::declared)),
        "velocities" => s.velocities = Section::some(keyword, items(body, errors, &Stream::definition)),
        "anchor" => s.anchor = Section::some(keyword, items(body, errors, &Stream::anchor_line)),
        "brackets" => {
            let body = match algebra {
                None => Brackets::Table(items(body, errors, &Stream::bracket_line)),
                Some((algebra, order, extent)) => {
                    let sections = list(body, errors, |entry| entry.place("a section"));
                    Brackets::Known(KnownAlgebra { algebra, order, extent, sections })
                }
            };
            s.brackets.push(Section { keyword, body });
        }
        "frame" => s.frame = Section::some(keyword, items(body, errors, &Stream::definition)),
        "lagrangian" => {
            s.lagrangian = lagrangian(body, errors).and_then(|body| Section::some(keyword, body));
        }
        "holonomic" => s.holonomic = Section::some(keyword, items(body, errors, &Stream::position_line)),
        "constraints" => {
            let lost = RefCell::new(Vec::new());
            let equation = |stream: &mut Stream| {
                stream.equation_or_left().map_err(|(error, left)| {
                    lost.borrow_mut().push(left);
                    error
                })
            };
            s.constraints = Section::some(keyword, items(body, errors, &equation));
            s.lost = lost.into_inner();
        }
        "impacts" => s.impacts = Section::some(keyword, items(body, errors, &Stream::impact_line)),
        "distribution" => {
            s.distribution = Section::some(keyword, list(body, errors, Stream::spanning_section));
        }
        "forces" => s.forces = Section::some(keyword, items(body, errors, &Stream::force)),
        "inputs" => s.inputs = Section::some(keyword, list(body, errors, Stream::declared)),
        "auxiliary" => s.auxiliary = Section::some(keyword, items(body, errors, &Stream::auxiliary_line)),
        "outputs" => s.outputs = Section::some(keyword, items(body, errors, &Stream::definition)),
        "conserved" => s.conserved = Section::some(keyword, items(body, errors, &Stream::definition)),
        "volume" => {
            s.volume = errors.keep(density(body)).and_then(|body| Section::some(keyword, Some(body)));
        }
        "hamilton_jacobi" => {
            s.hamilton_jacobi = Section::some(keyword, items(body, errors, &Stream::momentum));
        }
        "symmetries" => s.symmetries = Section::some(keyword, items(body, errors, &Stream::symmetry)),
        "routh" => s.routh = Section::some(keyword, items(body, errors, &Stream::definition)),
        "assume" => s.assume = Section::some(keyword, items(body, errors, &Stream::comparison)),
        "units" => s.units = Section::some(keyword, plain(body, errors, &Stream::unit_line)),
        "linearization" => {
            s.linearization = errors.keep(kept(body)).and_then(|body| Section::some(keyword, body));
        }
        "independent" => s.independent = Section::some(keyword, list(body, errors, Stream::velocity)),
        "orthonormal" => s.orthonormal = Section::some(keyword, list(body, errors, Stream::declared)),
        "formulation" => {
            s.formulation = errors.keep(formulation(body)).and_then(|body| Section::some(keyword, body));
        }
        "accuracy" => s.accuracy = errors.keep(level(body)).and_then(|body| Section::some(keyword, body)),
        "emit" => s.emit = Section::some(keyword, list(body, errors, |entry| entry.name("what to generate"))),
        "track" => s.track = Section::some(keyword, list(body, errors, Stream::velocity)),
        "names" => s.names = Section::some(keyword, plain(body, errors, &Stream::renaming)),
        "derivative" => {
            s.derivative = Section::some(keyword, plain(body, errors, &Stream::method_derivative));
        }
        "crate" => {
            s.runtime = errors.keep(runtime(body)).and_then(|body| Section::some(keyword, body));
        }
        // `SECTIONS` is what leads here; a test walks through it
        _ => {}
    }
}

impl<T> Section<T> {
    /// A section that is given.
    #[expect(clippy::unnecessary_wraps, reason = "sections are optional")]
    fn some(keyword: Name, body: T) -> Option<Self> {
        Some(Self { keyword, body })
    }
}

/// Lines without `let` and `for`.
fn plain<T>(
    body: &Group,
    errors: &mut Errors,
    line: &dyn Fn(&mut Stream) -> Result<T, Diagnostic>,
) -> Vec<T> {
    let mut found = Vec::new();
    for item in super::items::chunks(body) {
        let mut item = item;
        found.extend(errors.keep(line(&mut item)));
    }
    found
}

/// An algebra, its number, and where both stand.
type Algebra = (Name, Option<u32>, Extent);

/// `so(3)` behind `brackets`, if it is there.
fn algebra(stream: &mut Stream) -> Result<Option<Algebra>, Diagnostic> {
    let start = stream.position();
    let Some(ident) = stream.eat_ident() else { return Ok(None) };
    let name = Name::new(ident);
    if !ALGEBRAS.contains(&name.text.as_str()) {
        let known = "known algebras: `so(n)`, `se(2)`, `se(3)`, `sl(2)`, `heisenberg(n)`";
        let error =
            Diagnostic::new(name.extent(), format!("unknown algebra `{}`", name.text)).evidence(known);
        let letters = name.text.trim_end_matches(|c: char| c.is_ascii_digit());
        let number = &name.text[letters.len()..];
        return Err(match did_you_mean(letters, ALGEBRAS) {
            _ if ALGEBRAS.contains(&letters) => error.way_out(format!("write `{letters}({number})`")),
            Some(question) => error.way_out(question),
            None => error.way_out("write its table: `brackets { [a, b] = c; }`"),
        });
    }
    let order = match stream.eat_group(Delimiter::Parenthesis) {
        None => None,
        Some(group) => {
            let mut inner = Stream::inside(&group);
            let order = inner.integer("the number of the algebra")?;
            inner.end("`)`")?;
            Some(order)
        }
    };
    Ok(Some((name, order, stream.since(start))))
}

/// `adapted` or `projected`.
fn formulation(body: &Group) -> Result<Formulation, Diagnostic> {
    let mut stream = Stream::inside(body);
    let known = "write `adapted` or `projected`";
    let name = stream.name("a formulation").map_err(|error| error.way_out(known))?;
    let formulation = match name.text.as_str() {
        "adapted" => Formulation::Adapted,
        "projected" => Formulation::Projected,
        other => {
            return Err(
                Diagnostic::new(name.extent(), format!("unknown formulation `{other}`")).way_out(known)
            );
        }
    };
    stream.eat(";");
    if stream.is_empty() {
        Ok(formulation)
    } else {
        Err(stream.expected("`}`").way_out("there is one formulation"))
    }
}

/// The variables in `linearization { keep: …; }`; in `linearization { }` they are left to be chosen.
fn kept(body: &Group) -> Result<Option<Vec<Velocity>>, Diagnostic> {
    let mut stream = Stream::inside(body);
    if stream.is_empty() {
        return Ok(None);
    }
    let known =
        "write `linearization { keep: x, der(x); }` with the variables of the state that are to be kept";
    if !(stream.eat_word("keep") && stream.eat(":")) {
        return Err(stream.expected("`keep:`").way_out(known));
    }
    let mut found = Vec::new();
    while !stream.is_empty() && !stream.at_marks(";") {
        found.push(stream.velocity().map_err(|error| error.way_out(known))?);
        if !stream.eat(",") {
            break;
        }
    }
    stream.eat(";");
    if stream.is_empty() { Ok(Some(found)) } else { Err(stream.expected("`,` or `;`").way_out(known)) }
}

/// The one word in `accuracy { … }`.
fn level(body: &Group) -> Result<Name, Diagnostic> {
    let mut stream = Stream::inside(body);
    let known = "write `fast`, `balanced` or `careful`";
    let name = stream.name("a level of accuracy").map_err(|error| error.way_out(known))?;
    stream.eat(";");
    if stream.is_empty() { Ok(name) } else { Err(stream.expected("`}`").way_out("there is one level")) }
}

/// The density in `volume { … }`.
fn density(body: &Group) -> Result<Expr, Diagnostic> {
    let mut chunks = super::items::chunks(body).into_iter();
    let mut stream = chunks.next().unwrap_or_else(|| Stream::inside(body));
    let density = stream
        .last_expression("`;`")
        .map_err(|error| error.way_out("write a density, or `volume;` to have one looked for"))?;
    match chunks.next() {
        None => Ok(density),
        Some(second) => {
            Err(Diagnostic::new(second.whole(), "a second expression")
                .way_out("the density is one expression"))
        }
    }
}

/// The path of the runtime.
pub(super) fn runtime(body: &Group) -> Result<TokenStream, Diagnostic> {
    let tokens = body.stream();
    match syn::Path::parse_mod_style.parse2(tokens.clone()) {
        Ok(_) => Ok(tokens),
        Err(_) => Err(Diagnostic::new(Extent::at(body.span()), "expected the path of the runtime crate")
            .evidence(match render(&tokens.into_iter().collect::<Vec<_>>()).as_str() {
                "" => "found nothing".into(),
                found => format!("found `{found}`"),
            })
            .way_out("write `crate { ::my_name_for_nonholonomic }`")),
    }
}

/// Reads a section whose keyword is mistyped as what was probably meant, so that the rest of the
/// program finds what it declares. Nothing is reported.
fn probably_meant(
    stream: &mut Stream,
    sections: &mut Sections,
    seen: &[String],
    keyword: Name,
) -> Option<()> {
    let meant = nearest(&keyword.text, SECTIONS).filter(|meant| !seen.iter().any(|known| known == meant))?;
    let body = stream.eat_group(Delimiter::Brace)?;
    let mut unreported = Errors::new();
    let keyword = Name { text: meant.to_owned(), ..keyword };
    fill(sections, keyword, None, &body, &mut unreported);
    _ = unreported.finish(());
    Some(())
}

/// A section that does not exist.
fn unknown(keyword: &Name) -> Diagnostic {
    let error = Diagnostic::new(keyword.extent(), format!("unknown section `{}`", keyword.text));
    if keyword.text == "for" {
        return Diagnostic::new(keyword.extent(), "a `for` around sections").way_out(
            "it goes around the items inside of one: `brackets { for i in 0..3 { … } }`; blocks such as `brackets so(3) { … }` \
             are written one by one",
        );
    }
    match did_you_mean(&keyword.text, SECTIONS) {
        Some(question) => error.way_out(question),
        None => error.way_out(format!("sections: {}", SECTIONS.join(", "))),
    }
}

/// Skips what is left of a broken section: to behind its braces, or to the next keyword.
fn recover(stream: &mut Stream) {
    if stream.eat(",") || stream.eat(";") {
        return;
    }
    let opens = |token: Option<&TokenTree>| matches!(token, Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Brace);
    while !stream.is_empty() {
        if at_section(stream) || stream.at_word("let") {
            return;
        }
        if opens(stream.advance().as_ref()) {
            return;
        }
    }
}
