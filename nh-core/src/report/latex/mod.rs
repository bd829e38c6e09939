//! The declaration and what was derived from it, in the notation of the papers, as TeX.

mod declaration_parts;
mod derived_parts;
mod expression;
mod line;
mod names;
mod words;

use std::fmt::Write;

use self::expression::Printer;
use self::line::{Equation, Line, Typeset, display};
use self::names::{Name, Names};
use super::classification;
use crate::compile::{Derived, Proved};
use crate::findings::Findings;
use crate::id::{ExprId, SymbolId};
use crate::model::Model;

/// Longest expression shown, and shortest that is cut, in nodes.
const SHOWN: [usize; 2] = [160, 24];
/// The nodes that the expressions of one kind share, if there are many.
const SHARED: usize = 1_200;
/// The widest matrix.
const MATRIX: usize = 24_000;
/// Equations of one kind that are shown.
const EQUATIONS: usize = 30;

/// The sections of a text about a derived system, without its title.
pub(crate) fn sections(
    proved: &Proved,
    derived: &Derived<'_>,
    findings: &Findings,
    reason: &str,
    conditions: &[ExprId],
) -> String {
    let page = &Page { model: &proved.model, names: &Names::of(&proved.model), shown: SHOWN[0] };
    let mut text = String::new();
    for (title, body) in declaration_parts::parts(page, proved) {
        section(&mut text, title, &body);
    }
    let classification = classification::lines(proved, derived, findings, reason);
    section(&mut text, "Classification", &items(&classification));
    for (title, body) in derived_parts::parts(page, proved, derived, findings, conditions) {
        section(&mut text, title, &body);
    }
    text
}

fn section(text: &mut String, title: &str, body: &str) {
    if !body.is_empty() {
        _ = write!(text, "\\subsection*{{{title}}}\n{}\n", body.trim_end());
    }
}

/// Lines of words.
fn items(lines: &[String]) -> String {
    if lines.is_empty() {
        return String::new();
    }
    let lines: Vec<String> =
        lines.iter().map(|line| format!("\\item {}\n", words::text_with_code(line))).collect();
    let lines = lines.concat();
    format!("\\begin{{itemize}}\n{lines}\\end{{itemize}}\n")
}

/// The section that says what `track` keeps.
pub(crate) fn tracked(kept: &str, left_out: &str) -> String {
    let mut text = String::new();
    section(&mut text, "Tracked variables", &items(&[kept.to_owned(), format!("left out: {left_out}")]));
    text
}

/// A text that compiles by itself, and that can be put into a document that loads amsmath.
#[must_use]
pub fn document(title: &str, documentation: &str, sections: &str) -> String {
    let (title, documentation) = (words::escaped(title), words::documentation(documentation));
    format!(
        "% {title}: generated from its declaration. It compiles by itself with pdflatex; in a document that loads amsmath,\n\
         % \\input puts its text there.\n\
         \\expandafter\\ifx\\csname @nodocument\\endcsname\\relax\n\
         \\expandafter\\def\\csname nonholonomic@end\\endcsname{{}}\n\
         \\else\n\
         \\documentclass[a4paper]{{article}}\n\
         \\usepackage{{amsmath}}\n\
         \\setlength{{\\parindent}}{{0pt}}\n\
         \\expandafter\\def\\csname nonholonomic@end\\endcsname{{\\end{{document}}}}\n\
         \\begin{{document}}\n\
         \\fi\n\
         \\begingroup\n\
         \\allowdisplaybreaks\\raggedright\\emergencystretch=3em\\def\\labelitemi{{$\\bullet$}}\n\
         \\section*{{{title}}}\n\
         {documentation}\n\
         {sections}\
         \\par\\medskip\n\
         Numbers of formulas are those of \\texttt{{MATHEMATICS.md}} of the library; dots stand for what is too long.\n\
         \\par\\endgroup\n\
         \\csname nonholonomic@end\\endcsname\n"
    )
}

/// What all parts of the text share.
struct Page<'a> {
    model: &'a Model,
    names: &'a Names,
    /// Longest expression shown.
    shown: usize,
}

impl Page<'_> {
    /// For so many expressions of one kind: where there are many, each is shorter.
    fn shared_by(&self, count: usize) -> Page<'_> {
        let [longest, shortest] = SHOWN;
        Page { shown: (SHARED / count.max(1)).clamp(shortest, longest), ..*self }
    }

    fn printer(&self) -> Printer<'_> {
        Printer::new(&self.model.graph, self.names, self.shown)
    }

    fn formula(&self, id: ExprId) -> Line {
        self.printer().formula(id)
    }

    fn combination(&self, coefficients: &[ExprId], names: &[Typeset]) -> Line {
        self.printer().combination(coefficients, names)
    }

    fn symbol(&self, symbol: SymbolId) -> Typeset {
        self.names.symbol(symbol).typeset()
    }

    fn rate(&self, symbol: SymbolId) -> Typeset {
        self.names.symbol(symbol).rate().typeset()
    }

    /// The sections e_α of the basis.
    fn sections(&self) -> Vec<Typeset> {
        self.model.sections.iter().map(|section| below("e", &self.symbol(section.symbol))).collect()
    }

    /// The declared name.
    fn name(&self, name: &str) -> Typeset {
        let graph = &self.model.graph;
        let known = graph.symbols().iter_ids().find(|(_, known)| *known == name);
        known.map_or_else(|| Name::of(name).typeset(), |(symbol, _)| self.symbol(symbol))
    }

    /// A row of values between parentheses.
    fn tuple(&self, values: &[ExprId], before: &str) -> Line {
        let mut line = Line::default();
        line.write(&format!(r"{before}\bigl("), 700 + 500 * before.len().min(4));
        for (index, value) in values.iter().enumerate() {
            if index > 0 {
                line.write(r",\; ", 600);
                line.may_break(1, "");
            }
            line.append(self.formula(*value), 2);
        }
        line.write(r"\bigr)", 500);
        line
    }

    /// Values row by row: as a matrix where that is narrow enough, else as a row of rows.
    fn matrix(&self, values: &[ExprId], columns: usize) -> Line {
        let rows: Vec<Vec<Typeset>> = values
            .chunks(columns.max(1))
            .map(|row| row.iter().map(|value| self.formula(*value).joined()).collect())
            .collect();
        let column =
            |k: usize| rows.iter().filter_map(|row| row.get(k)).map(|entry| entry.width).max().unwrap_or(0);
        let width = (0..columns).map(|k| column(k) + 1_000).sum::<usize>() + 1_500;
        if width > MATRIX {
            return self.tuple(values, "");
        }
        let rows: Vec<String> = rows
            .iter()
            .map(|row| row.iter().map(|entry| entry.tex.as_str()).collect::<Vec<_>>().join(" & "))
            .collect();
        Line::of(&Typeset::new(format!(r"\begin{{pmatrix}} {} \end{{pmatrix}}", rows.join(r" \\ ")), width))
    }

    fn is_zero(&self, id: ExprId) -> bool {
        self.model.graph.is_literal_zero(id)
    }
}

/// A letter with an index.
fn below(letter: &str, index: &Typeset) -> Typeset {
    Typeset::new(format!("{letter}_{{{}}}", index.tex), 700 + index.width * 3 / 4)
}

/// A letter with a label above.
fn labelled(letter: &str, label: &str) -> Typeset {
    let name = Name::of(label).label();
    Typeset::new(format!("{letter}^{{{}}}", name.tex), 700 + name.width * 3 / 4)
}

fn equation(left: &Typeset, right: Line) -> Equation {
    Equation { left: Line::of(left), right }
}

/// Equations, up to a number of them.
fn equations(mut list: Vec<Equation>) -> String {
    let more = list.len().saturating_sub(EQUATIONS);
    list.truncate(EQUATIONS);
    let shown = display(list);
    if more == 0 { shown } else { format!("{shown}and {more} more.\n") }
}
