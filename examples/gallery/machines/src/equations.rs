//! The equations of motion of a text in TeX.

/// The displayed formulas of its section on the equations of motion, each with its delimiters, and in words what the
/// section says beside them; first of all the mass matrix, where the equations leave its entries to it.
pub fn of(typeset: &str) -> Vec<String> {
    let equations = section(typeset, "Equations of motion");
    let is_left_out = |entry: &str| equations.iter().any(|formula| formula.contains(entry));
    let matrix =
        if is_left_out("W_{") || is_left_out("C_{") { section(typeset, "Mass matrix") } else { Vec::new() };
    [matrix, equations].concat()
}

/// The formulas and the words of the section with this title.
fn section(typeset: &str, title: &str) -> Vec<String> {
    let of_title =
        |section: &&str| section.strip_prefix('{').is_some_and(|section| section.starts_with(title));
    let section = typeset.split("\\subsection*").find(of_title);
    let body = section.and_then(|section| section.split_once('\n')).map_or("", |(_, body)| body);
    // behind the last section stands what ends the document
    let mut rest = body.split("\\par\\medskip").next().unwrap_or("");
    let mut shown = Vec::new();
    while let Some((before, after)) = rest.split_once("\\begin{align*}") {
        shown.extend(words(before));
        let Some((formula, left)) = after.split_once("\\end{align*}") else { break };
        shown.push(format!("\\begin{{align*}}{formula}\\end{{align*}}"));
        rest = left;
    }
    shown.extend(words(rest));
    shown
}

/// Words between formulas, those in them between dollars.
fn words(text: &str) -> Option<String> {
    let text = text.trim();
    (!text.is_empty()).then(|| text.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_machine_shows_equations() {
        for name in crate::NAMES {
            let machine = crate::machine(name).expect("it is in the gallery");
            let equations = of(machine.typeset());
            let formulas = equations.iter().filter(|line| line.starts_with("\\begin{align*}"));
            assert!(formulas.clone().all(|line| line.contains('=')), "{name}: {equations:?}");
            assert!(formulas.count() >= 1, "{name}: {equations:?}");
            assert!(!equations.iter().any(|line| line.contains("\\item")), "{name}: {equations:?}");
        }
    }
}
