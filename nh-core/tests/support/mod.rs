//! Random expressions as trees, evaluated without the graph, and a parser of printed text.

pub(crate) mod parser;
pub(crate) mod tree;
