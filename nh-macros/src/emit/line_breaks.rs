//! Long equations in documentation, broken where a reader would.

/// Columns of a line of code in documentation that are seen without scrolling.
const COLUMNS: usize = 100;
/// What stands before the rest of an equation.
const INDENT: &str = "    ";

/// The line, broken before signs that stand outside of as many brackets as possible.
pub(super) fn broken(line: &str) -> Vec<String> {
    let mut lines = Vec::new();
    let mut rest = line.to_owned();
    while let Some(end) = place(&rest) {
        let tail = rest.split_off(end);
        lines.push(rest);
        rest = format!("{INDENT}{}", tail.trim_start());
    }
    lines.push(rest);
    lines
}

/// Where a line that is too long is broken: at the last of the outermost signs that leave it short enough, or else at the
/// first sign.
fn place(line: &str) -> Option<usize> {
    if line.chars().count() <= COLUMNS {
        return None;
    }
    let mut depth = 0_usize;
    let mut best: Option<(usize, usize)> = None;
    let rest = line.char_indices().enumerate().skip(INDENT.len() + 1);
    for (column, (place, character)) in rest {
        match character {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth = depth.saturating_sub(1),
            _ => {}
        }
        let is_sign =
            line.get(place..).is_some_and(|tail| tail.starts_with(" + ") || tail.starts_with(" - "));
        if !is_sign {
            continue;
        }
        if column > COLUMNS && best.is_some() {
            break;
        }
        if best.is_none_or(|(least, _)| depth <= least) {
            best = Some((depth, place));
        }
    }
    best.map(|(_, place)| place)
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
