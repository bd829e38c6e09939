//! Words of text, and units, for TeX: what its input encoding does not know by itself is replaced.

use std::fmt::Write;

use super::names::greek;

/// Characters of running text that have another form in TeX.
const FORMS: [(char, &str); 49] = [
    ('\\', r"\textbackslash{}"),
    ('{', r"\{"),
    ('}', r"\}"),
    ('$', r"\$"),
    ('&', r"\&"),
    ('#', r"\#"),
    ('%', r"\%"),
    ('_', r"\_"),
    ('^', r"\textasciicircum{}"),
    ('~', r"\textasciitilde{}"),
    ('<', r"$<$"),
    ('>', r"$>$"),
    ('|', r"$|$"),
    ('*', r"$*$"),
    ('"', r"''"),
    ('–', "--"),
    ('—', "---"),
    ('“', "``"),
    ('”', "''"),
    ('‘', "`"),
    ('’', "'"),
    ('…', r"\dots{}"),
    ('·', r"$\cdot$"),
    ('×', r"$\times$"),
    ('±', r"$\pm$"),
    ('−', "$-$"),
    ('≤', r"$\le$"),
    ('≥', r"$\ge$"),
    ('≠', r"$\ne$"),
    ('≈', r"$\approx$"),
    ('≡', r"$\equiv$"),
    ('∂', r"$\partial$"),
    ('∩', r"$\cap$"),
    ('∈', r"$\in$"),
    ('⊥', r"$\perp$"),
    ('√', r"$\surd$"),
    ('∞', r"$\infty$"),
    ('→', r"$\to$"),
    ('⟨', r"$\langle$"),
    ('⟩', r"$\rangle$"),
    ('°', r"$^{\circ}$"),
    ('ẋ', r"$\dot{x}$"),
    ('ẏ', r"$\dot{y}$"),
    ('²', "$^{2}$"),
    ('³', "$^{3}$"),
    ('Σ', r"$\Sigma$"),
    ('\u{a0}', "~"),
    ('\t', " "),
    ('\r', " "),
];

/// Accented letters in Latin: what stands for the accent, and the letters.
const ACCENTS: [(&str, &str, &str); 7] = [
    (r"\'", "áéíóúýÁÉÍÓÚ", "aeiouyAEIOU"),
    (r"\`", "àèìòùÀÈÌÒÙ", "aeiouAEIOU"),
    (r"\^", "âêîôûÂÊÎÔÛ", "aeiouAEIOU"),
    ("\\\"", "äëïöüÄËÏÖÜ", "aeiouAEIOU"),
    (r"\~", "ñãõÑÃÕ", "naoNAO"),
    (r"\c", "çÇşŞ", "cCsS"),
    (r"\v", "čšžČŠŽřěň", "cszCSZren"),
];

/// Running text.
pub(super) fn escaped(text: &str) -> String {
    text.chars().map(character).collect()
}

fn character(c: char) -> String {
    if let Some((_, form)) = FORMS.iter().find(|(known, _)| *known == c) {
        return (*form).to_owned();
    }
    if c.is_ascii() {
        return if c.is_ascii_control() { " ".into() } else { c.to_string() };
    }
    if let Some(tex) = greek(c) {
        return format!("${tex}$");
    }
    let accented = ACCENTS.iter().find_map(|(accent, letters, plain)| {
        let place = letters.chars().position(|letter| letter == c)?;
        Some(format!("{accent}{{{}}}", plain.chars().nth(place)?))
    });
    accented.unwrap_or_else(|| match c {
        'ß' => r"\ss{}".into(),
        'ø' => r"\o{}".into(),
        'å' => r"\aa{}".into(),
        'æ' => r"\ae{}".into(),
        _ => format!("[U+{:04X}]", u32::from(c)),
    })
}

/// Running text with code between backticks.
pub(super) fn text_with_code(text: &str) -> String {
    let code = |part: &str| format!(r"\texttt{{{}}}", escaped(part));
    let parts = text.split('`').enumerate();
    parts.map(|(index, part)| if index % 2 == 0 { escaped(part) } else { code(part) }).collect()
}

/// What documentation says before its first heading and its first example, in paragraphs; code in the type of code.
pub(super) fn documentation(text: &str) -> String {
    let mut shown = String::new();
    let lines = text.lines().map(str::trim);
    for line in lines.take_while(|line| !line.starts_with(['#', '|']) && !line.starts_with("```")) {
        shown.push_str(&text_with_code(line));
        shown.push('\n');
    }
    shown.trim().to_owned()
}

/// A unit as the library prints it: `kg m² s⁻²`.
pub(super) fn unit(text: &str) -> String {
    let mut tex = String::new();
    let mut above = String::new();
    let flush = |above: &mut String, tex: &mut String| {
        if !above.is_empty() {
            _ = write!(tex, "^{{{above}}}");
            above.clear();
        }
    };
    for c in text.chars() {
        let raised = "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().position(|digit| digit == c);
        match (raised, c) {
            (Some(digit), _) => above.push_str(&digit.to_string()),
            (None, '⁻') => above.push('-'),
            (None, c) => {
                flush(&mut above, &mut tex);
                match c {
                    ' ' => tex.push_str(r"\,"),
                    'Ω' => tex.push_str(r"\Omega"),
                    '^' => tex.push('^'),
                    '(' => tex.push('{'),
                    ')' => tex.push('}'),
                    c => tex.push(c),
                }
            }
        }
    }
    flush(&mut above, &mut tex);
    format!(r"\mathrm{{{tex}}}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_what_it_was() {
        assert_eq!(escaped("a_b & 50 % of {x} → θ"), r"a\_b \& 50 \% of \{x\} $\to$ $\theta$");
        assert_eq!(escaped("Gauß, Čaplygin, 車"), r"Gau\ss{}, \v{C}aplygin, [U+8ECA]");
        assert_eq!(documentation(" A `der(x)_1`.\n\n # Then\n x"), r"A \texttt{der(x)\_1}.");
    }

    #[test]
    fn every_accent_has_its_letter() {
        for (accent, letters, plain) in ACCENTS {
            assert_eq!(letters.chars().count(), plain.chars().count(), "{accent}");
        }
    }

    #[test]
    fn units_are_upright() {
        assert_eq!(unit("kg m² s⁻²"), r"\mathrm{kg\,m^{2}\,s^{-2}}");
        assert_eq!(unit("m^(1/2)"), r"\mathrm{m^{1/2}}");
    }
}
