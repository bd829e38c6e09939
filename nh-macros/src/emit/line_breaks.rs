//! Long equations in documentation, broken where a reader would.

use nonholonomic_core::report::line_breaks::{Extent, first_line};

/// Columns of a line of code in documentation that are seen without scrolling.
const COLUMNS: usize = 100;
/// What stands before the rest of an equation.
const INDENT: &str = "    ";

/// The line, broken before signs that stand outside of as many brackets as possible.
pub(super) fn broken(line: &str) -> Vec<String> {
    let (mut texts, mut extents) = pieces(line);
    let mut lines = Vec::new();
    while !texts.is_empty() {
        let (indent, room) = if lines.is_empty() { ("", COLUMNS) } else { (INDENT, COLUMNS - INDENT.len()) };
        let count = first_line(&extents, room);
        let text: String = texts.drain(..count).collect();
        extents.drain(..count);
        lines.push(format!("{indent}{}", if lines.is_empty() { &text } else { text.trim_start() }));
    }
    if lines.is_empty() {
        lines.push(String::new());
    }
    lines
}

/// What stands between signs, each with the brackets around its sign.
fn pieces(line: &str) -> (Vec<&str>, Vec<Extent>) {
    let (mut texts, mut extents) = (Vec::new(), Vec::new());
    let (mut depth, mut start, mut outside) = (0_usize, 0, 0);
    let mut piece = |text: &'_ str, depth| extents.push(Extent { width: text.chars().count(), depth });
    for (place, character) in line.char_indices() {
        match character {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth = depth.saturating_sub(1),
            _ => {}
        }
        let (before, tail) = line.split_at(place);
        if (tail.starts_with(" + ") || tail.starts_with(" - ")) && !before.trim().is_empty() {
            let text = before.get(start..).unwrap_or_default();
            piece(text, outside);
            texts.push(text);
            (start, outside) = (place, depth);
        }
    }
    let last = line.get(start..).unwrap_or_default();
    if !last.is_empty() {
        piece(last, outside);
        texts.push(last);
    }
    (texts, extents)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_lines_and_those_without_signs_stay() {
        for line in ["der(x) = v*cos(theta)", "", &"x".repeat(300), &format!("x = {}", "a*".repeat(80))] {
            assert_eq!(broken(line), [line]);
        }
    }

    #[test]
    fn outer_signs_come_first_and_nothing_is_lost() {
        let term = |name: &str| format!("({name} + m*cos(q[0] - q[1])*der({name}))");
        let names = ["alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta"];
        let whole = format!("J*der(q) = {}", names.map(term).join(" - "));
        let lines = broken(&whole);
        assert!(lines.len() > 2, "{lines:?}");
        for line in &lines {
            assert!(line.chars().count() <= COLUMNS, "{line}");
            assert_eq!(line.matches('(').count(), line.matches(')').count(), "outside of brackets: {line}");
        }
        let joined: Vec<&str> = lines.iter().map(|line| line.trim_start()).collect();
        assert_eq!(joined.join(" "), whole);
    }

    #[test]
    fn a_long_product_of_sums_is_broken_inside() {
        let whole = format!("der(v) = ({})*u", vec!["a*cos(theta)"; 20].join(" + "));
        let lines = broken(&whole);
        assert!(lines.iter().all(|line| line.chars().count() <= COLUMNS), "{lines:?}");
        assert_eq!(lines.iter().map(|line| line.trim_start()).collect::<Vec<_>>().join(" "), whole);
    }
}
