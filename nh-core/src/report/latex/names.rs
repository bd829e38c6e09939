//! Names as they stand in papers: Greek letters, indices below, dots for rates.

use std::collections::BTreeSet;
use std::fmt::Write;

use rustc_hash::FxHashMap;

use super::line::Typeset;
use crate::algebra::Graph;
use crate::id::{ConstantId, ExprId, SymbolId};
use crate::model::Model;

/// Greek letters by their names and in Unicode, with their words in TeX.
const GREEK: [(&str, char, &str); 34] = [
    ("alpha", 'α', r"\alpha"),
    ("beta", 'β', r"\beta"),
    ("gamma", 'γ', r"\gamma"),
    ("delta", 'δ', r"\delta"),
    ("epsilon", 'ε', r"\varepsilon"),
    ("zeta", 'ζ', r"\zeta"),
    ("eta", 'η', r"\eta"),
    ("theta", 'θ', r"\theta"),
    ("iota", 'ι', r"\iota"),
    ("kappa", 'κ', r"\kappa"),
    ("lambda", 'λ', r"\lambda"),
    ("mu", 'μ', r"\mu"),
    ("nu", 'ν', r"\nu"),
    ("xi", 'ξ', r"\xi"),
    ("pi", 'π', r"\pi"),
    ("rho", 'ρ', r"\rho"),
    ("sigma", 'σ', r"\sigma"),
    ("tau", 'τ', r"\tau"),
    ("upsilon", 'υ', r"\upsilon"),
    ("phi", 'φ', r"\varphi"),
    ("chi", 'χ', r"\chi"),
    ("psi", 'ψ', r"\psi"),
    ("omega", 'ω', r"\omega"),
    ("Gamma", 'Γ', r"\Gamma"),
    ("Delta", 'Δ', r"\Delta"),
    ("Theta", 'Θ', r"\Theta"),
    ("Lambda", 'Λ', r"\Lambda"),
    ("Xi", 'Ξ', r"\Xi"),
    ("Pi", 'Π', r"\Pi"),
    ("Sigma", 'Σ', r"\Sigma"),
    ("Upsilon", 'Υ', r"\Upsilon"),
    ("Phi", 'Φ', r"\Phi"),
    ("Psi", 'Ψ', r"\Psi"),
    ("Omega", 'Ω', r"\Omega"),
];

/// The word of TeX for a Greek letter in Unicode.
pub(super) fn greek(letter: char) -> Option<&'static str> {
    let letter = if letter == 'ϕ' { 'φ' } else { letter };
    GREEK.iter().find(|(_, known, _)| *known == letter).map(|(_, _, tex)| *tex)
}

/// A name in its parts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Name {
    letter: Typeset,
    below: Vec<Typeset>,
    dots: usize,
}

impl Name {
    /// The name of what is declared: `theta`, `m_wheel`, `q[2]`, `x_dot`, `der(x)`.
    pub(super) fn of(name: &str) -> Self {
        if let Some(inner) = name.strip_prefix("der(").and_then(|rest| rest.strip_suffix(')')) {
            return Self::of(inner).rate();
        }
        let (head, indices) = name.split_once('[').unwrap_or((name, ""));
        if let Some(stem) = head.strip_suffix("_dot").filter(|stem| !stem.is_empty()) {
            let index = name.get(head.len()..).unwrap_or_default();
            return Self::of(&format!("{stem}{index}")).rate();
        }
        let mut parts = head.split('_').filter(|part| !part.is_empty());
        let stem = parts.next().unwrap_or("_");
        let letters = stem.trim_end_matches(|c: char| c.is_ascii_digit());
        if letters.is_empty() {
            return Self::literal(name);
        }
        let digits = &stem[letters.len()..];
        let indices = indices.split(['[', ']']).filter(|part| !part.is_empty());
        let below = Some(digits).filter(|digits| !digits.is_empty()).into_iter().chain(parts).chain(indices);
        Self {
            letter: word(letters, r"\mathit"),
            below: below.map(|part| word(part, r"\mathrm")).collect(),
            dots: 0,
        }
    }

    /// As it is typed.
    fn literal(name: &str) -> Self {
        let letter = Typeset::new(format!(r"\mathtt{{{}}}", plain(name)), 550 * name.chars().count());
        Self { letter, below: Vec::new(), dots: 0 }
    }

    /// Its rate: with one dot more.
    pub(super) fn rate(mut self) -> Self {
        self.dots += 1;
        self
    }

    /// As an index: a word is upright.
    pub(super) fn label(mut self) -> Typeset {
        self.letter.tex = self.letter.tex.replacen(r"\mathit", r"\mathrm", 1);
        self.typeset()
    }

    pub(super) fn typeset(&self) -> Typeset {
        let Typeset { tex, width } = &self.letter;
        let mut set = match self.dots {
            0 => self.letter.clone(),
            1 => Typeset::new(format!(r"\dot{{{tex}}}"), *width),
            2 => Typeset::new(format!(r"\ddot{{{tex}}}"), *width),
            dots => Typeset::new(format!("{tex}^{{({dots})}}"), width + 900),
        };
        if !self.below.is_empty() {
            let below: Vec<&str> = self.below.iter().map(|part| part.tex.as_str()).collect();
            set.tex = format!("{}_{{{}}}", set.tex, below.join(","));
            let width: usize = self.below.iter().map(|part| part.width * 3 / 4 + 200).sum();
            set.width += width;
        }
        set
    }
}

/// A letter, a Greek letter by its name, or a word in an alphabet.
fn word(text: &str, alphabet: &str) -> Typeset {
    if let Some((_, _, tex)) =
        GREEK.iter().find(|(name, letter, _)| *name == text || text.chars().eq([*letter]))
    {
        return Typeset::new(format!("{tex} ").trim_end(), 680);
    }
    let width = text.chars().map(letter_width).sum();
    if text.chars().all(|c| c.is_ascii_digit())
        || (text.len() == 1 && text.chars().all(|c| c.is_ascii_alphabetic()))
    {
        return Typeset::new(text, width);
    }
    Typeset::new(format!("{alphabet}{{{}}}", plain(text)), width)
}

fn letter_width(letter: char) -> usize {
    match letter {
        'm' | 'w' | 'M' | 'W' => 1_000,
        'i' | 'j' | 'l' | 't' | 'f' | 'r' => 450,
        letter if letter.is_ascii_digit() => 510,
        letter if letter.is_ascii_uppercase() => 800,
        letter if letter.is_ascii() => 600,
        _ => 3_000,
    }
}

/// The characters of a name, for an alphabet of formulas: what is neither ASCII nor Greek by its number.
fn plain(name: &str) -> String {
    let mut text = String::new();
    for c in name.chars() {
        match (c, greek(c)) {
            (_, Some(tex)) => text.extend([tex, " "]),
            ('_', _) => text.push_str(r"\_"),
            (c, _) if c.is_ascii_alphanumeric() || "[](),.".contains(c) => text.push(c),
            (c, _) => _ = write!(text, "u{:04X}", u32::from(c)),
        }
    }
    text
}

/// The symbols of what is declared.
fn declared(model: &Model) -> Vec<SymbolId> {
    let coordinates = model.coordinates.iter().map(|x| x.symbol);
    let velocities = model.sections.iter().map(|x| x.symbol).chain(model.frame.iter().map(|x| x.symbol));
    let parameters = model.parameters.iter().map(|x| x.symbol);
    let others = model.inputs.iter().map(|x| x.symbol).chain(model.auxiliary.iter().map(|x| x.symbol));
    [model.time].into_iter().chain(coordinates).chain(velocities).chain(parameters).chain(others).collect()
}

/// What every symbol of a system is called.
#[derive(Clone, Debug)]
pub(super) struct Names {
    symbols: FxHashMap<SymbolId, Name>,
    constants: FxHashMap<ConstantId, Name>,
    calls: FxHashMap<SymbolId, (Name, Vec<ExprId>)>,
    parameters: BTreeSet<SymbolId>,
    coordinates: BTreeSet<SymbolId>,
}

impl Names {
    /// The names of all symbols, which differ from each other.
    pub(super) fn of(model: &Model) -> Self {
        let graph: &Graph = &model.graph;
        let mut taken = BTreeSet::new();
        let mut distinct = |text: &str, name: Name| {
            if taken.insert(name.typeset().tex) { name } else { Name::literal(text) }
        };
        let mut symbols = FxHashMap::default();
        // what is declared has its own name, what derivations need gives way
        let all = declared(model).into_iter().chain(graph.symbols().iter_ids().map(|(symbol, _)| symbol));
        for symbol in all {
            let text = &graph.symbols()[symbol];
            symbols.entry(symbol).or_insert_with(|| distinct(text, Name::of(text)));
        }
        let mut constants = FxHashMap::default();
        for (constant, value) in graph.constants().iter_ids() {
            constants.insert(constant, distinct(&value.name, Name::of(&value.name)));
        }
        let calls = model.calls.iter();
        let calls =
            calls.map(|call| (call.symbol, (Name::of(&call.method), call.arguments.clone()))).collect();
        let parameters = model.parameters.iter().map(|parameter| parameter.symbol).collect();
        let coordinates =
            model.coordinates.iter().map(|coordinate| coordinate.symbol).chain([model.time]).collect();
        Self { symbols, constants, calls, parameters, coordinates }
    }

    /// The names of the symbols of a graph alone.
    #[cfg(test)]
    pub(super) fn of_graph(graph: &Graph) -> Self {
        let symbols = graph.symbols().iter_ids().map(|(symbol, text)| (symbol, Name::of(text))).collect();
        Self {
            symbols,
            constants: FxHashMap::default(),
            calls: FxHashMap::default(),
            parameters: BTreeSet::new(),
            coordinates: BTreeSet::new(),
        }
    }

    /// Where a letter stands in a product: parameters come before coordinates, and these before velocities.
    pub(super) fn place(&self, symbol: SymbolId) -> u8 {
        match (self.parameters.contains(&symbol), self.coordinates.contains(&symbol)) {
            (true, _) => 0,
            (false, true) => 1,
            (false, false) => 2,
        }
    }

    /// With the velocities standing for sections.
    pub(super) fn as_sections(&self, velocities: &[SymbolId]) -> Self {
        let mut names = self.clone();
        for symbol in velocities {
            let index = self.symbol(*symbol).typeset();
            let letter = Typeset::new("e", 600);
            names.symbols.insert(*symbol, Name { letter, below: vec![index], dots: 0 });
        }
        names
    }

    pub(super) fn symbol(&self, symbol: SymbolId) -> Name {
        self.symbols.get(&symbol).cloned().unwrap_or_else(|| Name::literal("_"))
    }

    pub(super) fn constant(&self, constant: ConstantId) -> Name {
        self.constants.get(&constant).cloned().unwrap_or_else(|| Name::literal("_"))
    }

    /// The method and its arguments, if the symbol stands for what it returns.
    pub(super) fn call(&self, symbol: SymbolId) -> Option<&(Name, Vec<ExprId>)> {
        self.calls.get(&symbol)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_papers() {
        for (name, expected) in [
            ("x", "x"),
            ("theta", r"\theta"),
            ("theta_1", r"\theta_{1}"),
            ("theta_dot", r"\dot{\theta}"),
            ("phi2", r"\varphi_{2}"),
            ("q[2]", "q_{2}"),
            ("I[0][1]", "I_{0,1}"),
            ("q_dot[2]", r"\dot{q}_{2}"),
            ("der(x_dot)", r"\ddot{x}"),
            ("m_wheel", r"m_{\mathrm{wheel}}"),
            ("side", r"\mathit{side}"),
            ("lambda_blade", r"\lambda_{\mathrm{blade}}"),
            ("ω_b", r"\omega_{b}"),
            ("dθ", r"\mathit{d\theta }"),
            ("é", r"\mathit{u00E9}"),
            ("_", r"\mathit{\_}"),
            ("_0", r"\mathtt{\_0}"),
        ] {
            assert_eq!(Name::of(name).typeset().tex, expected, "{name}");
        }
    }
}
