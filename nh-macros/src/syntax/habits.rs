//! What people write out of habit, in Rust or on paper, and what to write instead.

use proc_macro2::{Delimiter, Group, TokenTree};

use super::ast::Name;
use super::items::END;
use super::render::render;
use super::stream::Stream;
use super::vocabulary::{is_function, is_keyword};
use crate::report::{Diagnostic, Extent};

type Checked = Result<(), Diagnostic>;

/// The marks at the cursor, with an error that covers them.
fn marks(stream: &Stream, marks: &str, what: &str) -> Diagnostic {
    let tokens = &stream.rest()[..marks.chars().count()];
    Diagnostic::new(Extent::of(tokens).unwrap_or(stream.here()), what)
}

/// `**` for a power.
pub(crate) fn double_star(stream: &Stream) -> Checked {
    if stream.at_marks("**") {
        return Err(marks(stream, "**", "`**` is not an operator").way_out("write `^` for a power"));
    }
    Ok(())
}

/// `+=` and its kin.
pub(crate) fn assignment(stream: &Stream) -> Checked {
    for written in ["+=", "-=", "*=", "/=", "^="] {
        if stream.at_marks(written) {
            return Err(marks(stream, written, &format!("`{written}` is not an operator"))
                .way_out("write equations out, with a single `=`"));
        }
    }
    if stream.at_marks("->") {
        return Err(marks(stream, "->", "`->` is not an operator"));
    }
    Ok(())
}

/// `()` where a value should be.
pub(crate) fn empty_parentheses(group: &Group) -> Checked {
    if group.stream().is_empty() {
        return Err(Diagnostic::new(
            Extent::at(group.span()),
            "expected an expression between the parentheses",
        ));
    }
    Ok(())
}

/// `x.sin()`, `x.powi(2)`, `x.y` behind the value that begins at `start`.
pub(crate) fn method(stream: &Stream, start: usize) -> Checked {
    if !stream.at_marks(".") || stream.at_marks("..") {
        return Ok(());
    }
    let receiver = render(stream.consumed(start));
    let at = stream.since(start);
    let upto = |ahead: usize| stream.peek_at(ahead).map_or(at, |end| at.to(Extent::at(end.span())));
    let Some(TokenTree::Ident(name)) = stream.peek_at(1) else {
        return Err(Diagnostic::new(upto(0), "a `.` behind a value")
            .way_out("numbers are written `0.5` or `.5`; a product takes a `*`"));
    };
    let Some(TokenTree::Group(call)) = stream.peek_at(2) else {
        return Err(Diagnostic::new(upto(1), format!("`{receiver}.{name}` is not an expression here"))
            .way_out("parameters, coordinates and velocities are written by their names alone"));
    };
    let name = name.to_string();
    let arguments = render(&call.stream().into_iter().collect::<Vec<_>>());
    let instead = match name.as_str() {
        "powi" | "powf" | "pow" => format!("{receiver}^{}", exponent(&arguments)),
        "sin_cos" => format!("sin({receiver})` and `cos({receiver})"),
        "signum" => format!("sign({receiver})"),
        "recip" => format!("1 / {receiver}"),
        _ if arguments.is_empty() => format!("{name}({receiver})"),
        _ => format!("{name}({receiver}, {arguments})"),
    };
    Err(Diagnostic::new(upto(2), "functions are not called as methods").way_out(format!("write `{instead}`")))
}

/// An exponent, in parentheses if it needs them.
fn exponent(text: &str) -> String {
    if text.chars().all(|c| c.is_alphanumeric() || "._".contains(c)) {
        text.to_owned()
    } else {
        format!("({text})")
    }
}

/// Words that begin something of Rust's that is no expression here: paths, macros, control flow.
pub(crate) fn foreign_word(stream: &Stream) -> Checked {
    let Some(TokenTree::Ident(ident)) = stream.peek() else { return Ok(()) };
    let word = ident.to_string();
    let at = Extent::at(ident.span());
    if matches!(stream.peek_at(1), Some(TokenTree::Punct(p)) if p.as_char() == ':')
        && matches!(stream.peek_at(2), Some(TokenTree::Punct(p)) if p.as_char() == ':')
    {
        return Err(Diagnostic::new(at, "paths are not part of expressions")
            .way_out("`pi` is π; other constants become fields of the struct, or are written as numbers"));
    }
    if matches!(stream.peek_at(1), Some(TokenTree::Punct(p)) if p.as_char() == '!')
        && matches!(stream.peek_at(2), Some(TokenTree::Group(_)))
    {
        return Err(Diagnostic::new(at, format!("macros are not expanded here: `{word}!`")));
    }
    let before_operator = match stream.peek_at(1) {
        None => true,
        // `if -x`, `match *x` begin control flow
        Some(TokenTree::Punct(mark)) => word == "loop" || !"-*&!".contains(mark.as_char()),
        Some(_) => false,
    };
    match word.as_str() {
        // a name that Rust does not permit, as is said of names
        "if" | "match" | "loop" | "while" if before_operator => Ok(()),
        "if" | "match" | "loop" | "while" => {
            Err(Diagnostic::new(at, format!("`{word}` has no place in an expression"))
                .way_out("expressions do not branch; forces and outputs have `abs`, `sign`, `min`, `max`"))
        }
        "for" => Err(Diagnostic::new(at, "`for` has no place in an expression")
            .way_out("a sum is written `sum(i in 0..4: …)`; `for` goes around whole items")),
        "let" => Err(Diagnostic::new(at, "`let` has no place in an expression")
            .way_out("put `let name = …;` on a line of its own, before it is used")),
        "true" | "false" => Err(Diagnostic::new(at, format!("`{word}` is no number"))),
        _ => Ok(()),
    }
}

/// A function's name without its parentheses.
pub(crate) fn bare_function(stream: &Stream, name: &Name) -> Diagnostic {
    let argument = match stream.peek() {
        Some(TokenTree::Ident(ident)) if !is_keyword(&ident.to_string()) => ident.to_string(),
        Some(TokenTree::Literal(literal)) => literal.to_string(),
        _ => "…".to_owned(),
    };
    let text = &name.text;
    if stream.at_marks("^") {
        return Diagnostic::new(name.extent(), format!("`{text}` is a function"))
            .way_out(format!("a power of its value is written `{text}(…)^2`"));
    }
    Diagnostic::new(name.extent(), format!("`{text}` is a function and needs its parentheses"))
        .way_out(format!("write `{text}({argument})`"))
}

/// No expression begins at the cursor.
pub(crate) fn no_value(stream: &Stream) -> Diagnostic {
    if stream.at_marks("+") {
        return marks(stream, "+", "a `+` with nothing before it").way_out("leave it out");
    }
    if stream.peek_group(Delimiter::Brace).is_some() {
        return Diagnostic::new(stream.here(), "braces do not group an expression")
            .way_out("write parentheses");
    }
    let borrowed = stream.at_marks("&") && !stream.at_marks("&&");
    if borrowed || (stream.at_marks("*") && !stream.at_marks("**")) && stream.position() == 0 {
        return stream.expected("an expression").way_out("values are not references here");
    }
    if let Some(error) = mark(stream) {
        return error;
    }
    stream.expected("an expression")
}

/// Something follows that does not belong here. `wanted` says what would.
pub(crate) fn unexpected(stream: &Stream, wanted: &str) -> Diagnostic {
    if let Some(error) = mark(stream) {
        return error;
    }
    let next = stream.rest().first();
    if matches!(next, Some(TokenTree::Ident(ident)) if ident == "as") {
        return Diagnostic::new(stream.here(), "`as` has no place in an expression")
            .way_out("numbers are exact: there is nothing to cast");
    }
    match (stream.previous(), next) {
        (Some(left), Some(right)) if is_value(left) && is_value(right) => {
            let pair = [render(std::slice::from_ref(left)), render(std::slice::from_ref(right))];
            let at = Extent::at(left.span()).to(Extent::at(right.span()));
            let error = Diagnostic::new(
                at,
                format!("an operator or a `;` is missing between `{}` and `{}`", pair[0], pair[1]),
            );
            if is_plain(left) && is_plain(right) {
                error.way_out(format!("a product is written `{} * {}`", pair[0], pair[1]))
            } else {
                error.way_out("a product is written with `*`")
            }
        }
        (_, Some(TokenTree::Punct(mark))) if mark.as_char() == ',' && wanted == END => {
            let error = stream.expected(wanted);
            if stream.begins_with("let") {
                error.way_out("lines end with `;`, and a second `let` is a line of its own")
            } else {
                error.way_out("lines end with `;`: write it in place of the comma")
            }
        }
        _ => stream.expected(wanted),
    }
}

/// A token that can begin or end a value.
fn is_value(token: &TokenTree) -> bool {
    match token {
        TokenTree::Group(group) => group.delimiter() != Delimiter::Brace,
        TokenTree::Ident(ident) => {
            let word = ident.to_string();
            !is_keyword(&word) || word == "self"
        }
        TokenTree::Literal(_) => true,
        TokenTree::Punct(_) => false,
    }
}

/// A token that is a value by itself.
fn is_plain(token: &TokenTree) -> bool {
    match token {
        TokenTree::Ident(ident) => !is_function(&ident.to_string()),
        TokenTree::Group(group) => group.delimiter() == Delimiter::Parenthesis,
        token => is_value(token),
    }
}

/// Marks that mean something in Rust or on paper, but nothing here.
fn mark(stream: &Stream) -> Option<Diagnostic> {
    const GAP: &str =
        "facts about parameters stand in `assume`, gaps that close in `impacts { stop: x >= 0; }`";
    const MARKS: [(&str, &str, &str); 22] = [
        ("==", "`==` is not part of an equation", "write a single `=`"),
        ("**", "`**` is not an operator", "write `^` for a power"),
        ("&&", "conditions are not joined with `&&`", "write one condition per line, ended with `;`"),
        ("||", "conditions are not joined with `||`", "write one condition per line, ended with `;`"),
        ("..=", "a range leaves out its end", "write `0..4` for 0, 1, 2, 3"),
        ("..", "a range has no place here", "ranges stand in `sum`, `for` and `let x[i in 0..4]`"),
        ("=>", "`=>` has no place here", "an equation is written with `=`, a force with `:`"),
        ("!=", "a comparison has no place here", "facts about parameters stand in `assume`"),
        ("<=", "a comparison has no place here", GAP),
        (">=", "a comparison has no place here", GAP),
        ("<", "a comparison has no place here", "facts about parameters stand in `assume`"),
        (">", "a comparison has no place here", "facts about parameters stand in `assume`"),
        ("'", "a prime is not part of a name", "the velocity of `x` is written `der(x)`"),
        ("%", "`%` is not an operator", "expressions have `+ - * / ^`"),
        ("!", "`!` is not an operator", "expressions have `+ - * / ^`"),
        ("&", "`&` is not an operator", "expressions have `+ - * / ^`"),
        ("|", "`|` is not an operator", "a length is written `sqrt(dot(v, v))`, a magnitude `abs(x)`"),
        ("?", "`?` is not an operator", "expressions have `+ - * / ^`"),
        ("@", "`@` is not an operator", "a matrix times a vector is written with `*`"),
        ("~", "`~` is not an operator", "expressions have `+ - * / ^`"),
        ("$", "`$` has no place here", "expressions have `+ - * / ^`"),
        ("#", "attributes have no place here", "doc comments stand before declared names"),
    ];
    MARKS
        .iter()
        .find(|(written, ..)| stream.at_marks(written))
        .map(|(written, what, way_out)| marks(stream, written, what).way_out(*way_out))
}
