//! Formulas as pieces that lines can be broken between, with their widths.

use super::super::line_breaks::{Extent, first_line};

/// TeX, and how wide it comes out in thousandths of an em.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Typeset {
    pub(super) tex: String,
    pub(super) width: usize,
}

impl Typeset {
    pub(super) fn new(tex: impl Into<String>, width: usize) -> Self {
        Self { tex: tex.into(), width }
    }
}

/// What stands between two places where a line may be broken.
#[derive(Clone, Debug, Default)]
struct Piece {
    set: Typeset,
    depth: usize,
    /// What a line begins with that begins here.
    sign: &'static str,
}

/// A formula on its way to the page.
#[derive(Clone, Debug, Default)]
pub(super) struct Line {
    pieces: Vec<Piece>,
    /// Whether it is higher than a letter, so that brackets around it have to grow.
    pub(super) is_tall: bool,
}

impl Line {
    pub(super) fn of(set: &Typeset) -> Self {
        let mut line = Self::default();
        line.push(set);
        line
    }

    pub(super) fn write(&mut self, tex: &str, width: usize) {
        if self.pieces.is_empty() {
            self.pieces.push(Piece::default());
        }
        if let Some(last) = self.pieces.last_mut() {
            last.set.tex.push_str(tex);
            last.set.width += width;
        }
    }

    pub(super) fn push(&mut self, set: &Typeset) {
        self.write(&set.tex, set.width);
    }

    /// What follows may begin a line, with this sign in front then.
    pub(super) fn may_break(&mut self, depth: usize, sign: &'static str) {
        if !self.is_empty() {
            self.pieces.push(Piece { depth, sign, ..Piece::default() });
        }
    }

    /// What another line holds, so many brackets deeper.
    pub(super) fn append(&mut self, inner: Self, depth: usize) {
        self.is_tall |= inner.is_tall;
        let mut pieces = inner.pieces.into_iter();
        if let Some(first) = pieces.next() {
            self.push(&first.set);
        }
        self.pieces.extend(pieces.map(|piece| Piece { depth: piece.depth + depth, ..piece }));
    }

    pub(super) fn is_empty(&self) -> bool {
        self.pieces.is_empty()
    }

    pub(super) fn begins_with(&self, tex: &str) -> bool {
        self.pieces.first().is_some_and(|piece| piece.set.tex.starts_with(tex))
    }

    pub(super) fn width(&self) -> usize {
        self.pieces.iter().map(|piece| piece.set.width).sum()
    }

    /// In one piece.
    pub(super) fn joined(self) -> Typeset {
        let width = self.width();
        Typeset { tex: self.pieces.into_iter().map(|piece| piece.set.tex).collect(), width }
    }

    /// Broken into lines, the first with as much room as stated, the others with that of the rest.
    pub(super) fn broken(&self, first: usize, rest: usize) -> Vec<String> {
        let mut extents: Vec<Extent> =
            self.pieces.iter().map(|piece| Extent { width: piece.set.width, depth: piece.depth }).collect();
        let mut pieces = self.pieces.as_slice();
        let mut lines = Vec::new();
        while !pieces.is_empty() {
            let room = if lines.is_empty() { first } else { rest };
            let count = first_line(&extents, room);
            let sign = if lines.is_empty() { "" } else { pieces[0].sign };
            let text: String = pieces[..count].iter().map(|piece| piece.set.tex.as_str()).collect();
            lines.push(format!("{sign}{}", text.trim()));
            pieces = &pieces[count..];
            extents.drain(..count);
        }
        lines
    }
}

/// The width of the text of a column.
const ROOM: usize = 30_500;
/// Left sides up to this width stand in a column of their own.
const NARROW: usize = 7_500;
/// The width of `\quad` with what follows a sign.
const QUAD: usize = 1_000;
/// The width of an equals sign with its spaces.
pub(super) const EQUALS: usize = 1_400;

/// An equation.
#[derive(Clone, Debug)]
pub(super) struct Equation {
    pub(super) left: Line,
    pub(super) right: Line,
}

/// The equations below each other, each on lines of its own: aligned at their equals signs where the left sides are short.
pub(super) fn display(equations: Vec<Equation>) -> String {
    let widest = equations.iter().map(|equation| equation.left.width()).max().unwrap_or(0);
    let mut lines: Vec<String> = Vec::new();
    for Equation { left, right } in equations {
        if widest <= NARROW {
            let room = ROOM - widest - EQUALS;
            let mut parts = right.broken(room, room - QUAD).into_iter();
            lines.push(format!("{} &= {}", left.joined().tex, parts.next().unwrap_or_default()));
            lines.extend(parts.map(|part| format!(r"&\quad {part}")));
        } else {
            let mut whole = left;
            whole.may_break(0, "");
            whole.write(" = ", EQUALS);
            whole.append(right, 1);
            let mut parts = whole.broken(ROOM, ROOM - QUAD).into_iter();
            lines.push(format!("& {}", parts.next().unwrap_or_default()));
            lines.extend(parts.map(|part| format!(r"&\quad {part}")));
        }
    }
    if lines.is_empty() {
        return String::new();
    }
    format!("\\begin{{align*}}\n{}\n\\end{{align*}}\n", lines.join(" \\\\\n"))
}
