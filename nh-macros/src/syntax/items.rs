//! Items that end with `;`: splitting a section into them, `let` and `for`, recovery at the next.

use proc_macro2::{Delimiter, Group, TokenTree};

use super::ast::{Binder, For, Item, Lagrangian, Let, Name};
use super::limits;
use super::names::is_mark;
use super::stream::Stream;
use crate::report::{Diagnostic, Errors, Extent};

/// What follows an item.
pub(crate) const END: &str = "`;`";

/// How a section reads its own kind of line.
type Statement<'a, T> = &'a dyn Fn(&mut Stream) -> Result<T, Diagnostic>;

/// The items of a section: every wrong one is reported, the right ones are kept.
pub(crate) fn items<T>(body: &Group, errors: &mut Errors, statement: Statement<'_, T>) -> Vec<Item<T>> {
    block(body, 0, errors, statement)
}

/// The items of a section or of a `for` block in it.
fn block<T>(body: &Group, blocks: u32, errors: &mut Errors, statement: Statement<'_, T>) -> Vec<Item<T>> {
    let mut found = Vec::new();
    for mut chunk in chunks(body) {
        let parsed = match first_word(&chunk).as_deref() {
            Some("for") => for_block(&mut chunk, blocks, errors, statement).map(Item::For),
            Some("let") => let_line(&mut chunk).and_then(local).map(Item::Let),
            _ => statement(&mut chunk).and_then(|one| chunk.end(END).map(|()| Item::One(one))),
        };
        found.extend(errors.keep(parsed));
    }
    found
}

/// The Lagrangian is an expression, not an equation: `L = …` is refused.
fn named(chunk: &Stream) -> Result<(), Diagnostic> {
    let (Some(TokenTree::Ident(name)), Some(TokenTree::Punct(mark))) = (chunk.peek(), chunk.peek_at(1))
    else {
        return Ok(());
    };
    if mark.as_char() != '=' {
        return Ok(());
    }
    Err(Diagnostic::new(Extent::at(mark.span()), "the Lagrangian has no name")
        .way_out(format!("leave out `{name} =`: the section holds the expression alone")))
}

/// `let …; expr`, where only the expression at the end is no `let`.
pub(crate) fn lagrangian(body: &Group, errors: &mut Errors) -> Option<Lagrangian> {
    let mut lets = Vec::new();
    // a `let` in error may have swallowed the expression
    let (mut value, mut in_error) = (None, false);
    for mut chunk in chunks(body) {
        let start = chunk.whole();
        if first_word(&chunk).as_deref() == Some("let") {
            let kept = errors.keep(let_line(&mut chunk).and_then(local));
            in_error |= kept.is_none();
            lets.extend(kept);
            if value.is_some() {
                errors.push(
                    Diagnostic::new(start, "a `let` behind the Lagrangian itself")
                        .way_out("move it before the expression"),
                );
            }
            continue;
        }
        if value.is_some() {
            errors.push(
                Diagnostic::new(start, "a second expression")
                    .way_out("the Lagrangian is one expression; name parts of it with `let`"),
            );
        }
        let parsed = chunk.docs().and_then(|_| named(&chunk)).and_then(|()| chunk.last_expression(END));
        value = Some(errors.keep(parsed));
    }
    if value.is_none() && !in_error {
        errors.push(
            Diagnostic::new(Extent::at(body.span()), "there is no expression in `lagrangian`")
                .way_out("write kinetic minus potential energy: `lagrangian { m / 2 * v^2 - m * g * z }`"),
        );
    }
    Some(Lagrangian { lets, value: value?? })
}

/// Splits at every `;`, and behind the braces of every `for`.
pub(crate) fn chunks(body: &Group) -> Vec<Stream> {
    let whole = Stream::inside(body);
    let around = Extent::at(body.span());
    let mut chunks = Vec::new();
    let mut chunk: Vec<TokenTree> = Vec::new();
    let mut in_for = None;
    for token in whole.tokens() {
        if is_mark(token, ';') {
            if !chunk.is_empty() {
                chunks.push(Stream::over(std::mem::take(&mut chunk), around));
            }
            in_for = None;
            continue;
        }
        // the first word behind doc comments decides
        let in_for = in_for.get_or_insert(false);
        let documents = is_mark(token, '#')
            || matches!((token, chunk.last()), (TokenTree::Group(_), Some(last)) if is_mark(last, '#'));
        if chunk.iter().all(is_documentation) && !documents {
            *in_for = matches!(token, TokenTree::Ident(ident) if ident == "for");
        }
        let closes =
            *in_for && matches!(token, TokenTree::Group(group) if group.delimiter() == Delimiter::Brace);
        chunk.push(token.clone());
        if closes {
            chunks.push(Stream::over(std::mem::take(&mut chunk), around));
        }
    }
    if !chunk.is_empty() {
        chunks.push(Stream::over(chunk, around));
    }
    chunks
}

/// Doc comments consist of such tokens.
fn is_documentation(token: &TokenTree) -> bool {
    is_mark(token, '#') || matches!(token, TokenTree::Group(group) if group.delimiter() == Delimiter::Bracket)
}

/// The word that an item begins with, behind its doc comments.
fn first_word(chunk: &Stream) -> Option<String> {
    chunk.tokens().iter().find(|token| !is_documentation(token)).and_then(|token| match token {
        TokenTree::Ident(ident) => Some(ident.to_string()),
        _ => None,
    })
}

/// `for i in 0..3, j in 0..3 { … }`
fn for_block<T>(
    chunk: &mut Stream,
    blocks: u32,
    errors: &mut Errors,
    statement: Statement<'_, T>,
) -> Result<For<T>, Diagnostic> {
    let documented = chunk.position();
    chunk.docs()?;
    let start = chunk.position().max(documented);
    chunk.advance();
    if blocks >= limits::BLOCKS {
        return Err(Diagnostic::new(
            chunk.since(start),
            format!("`for` blocks are nested more than {} deep", limits::BLOCKS),
        )
        .way_out("one `for` takes several variables: `for i in 0..3, j in 0..3 { … }`"));
    }
    let binders = chunk.binders()?;
    let Some(body) = chunk.eat_group(Delimiter::Brace) else {
        return Err(chunk.expected("the items of the `for` in braces"));
    };
    let items = block(&body, blocks + 1, errors, statement);
    Ok(For { binders, items, extent: chunk.since(start) })
}

/// What a `let` inside a section may be.
fn local(line: Let) -> Result<Let, Diagnostic> {
    if line.arguments.is_none() {
        return Ok(line);
    }
    let what = format!("the function `{}` stands inside a section", line.name.text);
    Err(Diagnostic::new(line.extent, what)
        .way_out("put its `let` between the sections, where all of them know it"))
}

/// `let name = expr`, `let name[i in 0..4] = expr`, `let name(u, v) = expr`
pub(super) fn let_line(chunk: &mut Stream) -> Result<Let, Diagnostic> {
    chunk.docs()?;
    let start = chunk.position();
    chunk.advance();
    if chunk.at_word("mut") {
        return Err(Diagnostic::new(chunk.here(), "a `let` names a value, which never changes")
            .way_out("leave out `mut`"));
    }
    let name = chunk.name("a name")?;
    let arguments = chunk.eat_group(Delimiter::Parenthesis).map(|group| arguments(&group)).transpose()?;
    let mut binders: Vec<Binder> = Vec::new();
    if let (true, Some(group)) = (arguments.is_some(), chunk.peek_group(Delimiter::Bracket)) {
        return Err(Diagnostic::new(Extent::at(group.span()), "an index behind the arguments of a function")
            .way_out("let its value be a vector: `let e(q) = [cos(q), sin(q)];`"));
    }
    while let Some(group) = chunk.eat_group(Delimiter::Bracket) {
        let mut inner = Stream::inside(&group);
        if !matches!(inner.peek_at(1), Some(TokenTree::Ident(word)) if word == "in") {
            return Err(Diagnostic::new(Extent::at(group.span()), "expected a range: `[i in 0..4]`")
                .way_out("an indexed `let` defines all entries in one line"));
        }
        binders.extend(inner.binders()?);
        inner.end("`]`")?;
        if binders.len() > 2 {
            return Err(Diagnostic::new(Extent::at(group.span()), "a third index")
                .way_out("a `let` has one or two indices"));
        }
    }
    if chunk.at_marks(":") {
        return Err(Diagnostic::new(chunk.here(), "a `let` has no type").way_out("write `let name = …;`"));
    }
    chunk.equals("an abbreviation reads `let name = …;`")?;
    let value = chunk.last_expression(END)?;
    Ok(Let { name, arguments, binders, value, extent: chunk.since(start) })
}

/// `(u, v)`
fn arguments(group: &Group) -> Result<Vec<Name>, Diagnostic> {
    let mut inner = Stream::inside(group);
    let mut names = Vec::new();
    while !inner.is_empty() {
        names.push(inner.name("the name of an argument")?);
        if !inner.eat(",") && !inner.is_empty() {
            return Err(inner.expected("`,` or `)`").way_out("a function reads `let h(u, v) = …;`"));
        }
    }
    if names.is_empty() {
        return Err(Diagnostic::new(Extent::at(group.span()), "a function without arguments")
            .way_out("leave the parentheses out: `let name = …;`"));
    }
    Ok(names)
}
