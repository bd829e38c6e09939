//! The words of the language.

/// The sections, as they are written.
pub(crate) const SECTIONS: [&str; 35] = [
    "constants",
    "base",
    "on",
    "basis",
    "velocities",
    "anchor",
    "brackets",
    "frame",
    "almost",
    "lagrangian",
    "holonomic",
    "constraints",
    "impacts",
    "distribution",
    "forces",
    "inputs",
    "auxiliary",
    "outputs",
    "conserved",
    "volume",
    "hamilton_jacobi",
    "symmetries",
    "routh",
    "assume",
    "units",
    "linearization",
    "independent",
    "orthonormal",
    "formulation",
    "accuracy",
    "emit",
    "track",
    "names",
    "derivative",
    "crate",
];

/// Functions of one number (`atan2`, `min` and `max` take two), and the derivative of a coordinate.
pub(crate) const FUNCTIONS: [&str; 18] = [
    "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh", "exp", "ln", "sqrt", "abs",
    "sign", "min", "max", "der",
];

/// Names that mean something already and cannot be declared, beside the functions.
pub(crate) const RESERVED: [&str; 5] = ["t", "pi", "sum", "dot", "cross"];

/// The generated types that `names` renames.
pub(crate) const TYPES: [&str; 15] = [
    "state",
    "velocity",
    "input",
    "multipliers",
    "outputs",
    "reactions",
    "residual",
    "momenta",
    "phase",
    "quadratures",
    "gyroscopic",
    "power",
    "coordinate",
    "variable",
    "impulses",
];

/// The known algebras of `brackets`.
pub(crate) const ALGEBRAS: [&str; 4] = ["so", "se", "sl", "heisenberg"];

/// Words that Rust keeps for itself: as a field they would not compile.
const KEYWORDS: [&str; 54] = [
    "_", "Self", "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "crate",
    "do", "dyn", "else", "enum", "extern", "false", "final", "fn", "for", "gen", "if", "impl", "in", "let",
    "loop", "macro", "match", "mod", "move", "mut", "override", "priv", "pub", "ref", "return", "self",
    "static", "struct", "super", "trait", "true", "try", "type", "typeof", "unsafe", "unsized", "use",
    "virtual", "where", "while", "yield", "$crate",
];

/// Whether Rust keeps the word for itself.
pub(crate) fn is_keyword(word: &str) -> bool {
    KEYWORDS.contains(&word)
}

/// Whether the word is one of the language's functions.
pub(crate) fn is_function(word: &str) -> bool {
    FUNCTIONS.contains(&word) || ["sum", "dot", "cross"].contains(&word)
}
