//! A procedure in which linear systems are open: their unknowns are free, and what they have to satisfy is computed.

use crate::algebra::Graph;
use crate::id::{ExprId, SymbolId};
use crate::mechanics::{Definition, Eliminated, Equations, Factors, Hanging, Inverse, Procedure, Solved};
use rustc_hash::FxHashMap;
use std::collections::BTreeSet;
use std::ops::Range;

/// The procedure, and how the unknowns are found.
pub(super) struct Opened {
    /// The outputs of the procedure, and for each system its residuals, then what closes it.
    pub(super) procedure: Procedure,
    /// In an order in which each may depend on those before.
    pub(super) systems: Vec<OpenSystem>,
}

/// Unknowns x, with residuals f − C x; all others are places among the outputs.
pub(super) struct OpenSystem {
    pub(super) unknowns: Vec<SymbolId>,
    /// What stands for x in the residuals, and for what is given by x, where it does not vary.
    pub(super) held: Vec<(SymbolId, Held)>,
    pub(super) residuals: Range<usize>,
    pub(super) closing: Closing,
}

/// The value of what is held.
#[derive(Clone, Copy)]
pub(super) enum Held {
    Unknown(SymbolId),
    /// At its place among the outputs.
    Output(usize),
}

/// How unknowns are found, and the solution for other right-hand sides.
pub(super) enum Closing {
    /// In closed form, by these values; C = L D Lᵀ, the rows of L left of the diagonal.
    Factorised { values: Range<usize>, lower: Vec<Range<usize>>, diagonal: Range<usize> },
    /// In closed form, by these values; C is what is left of a quadratic form that variables leave one after the other.
    OneByOne { values: Range<usize>, eliminated: Vec<Eliminated<usize>> },
    /// In closed form, by these values; C⁻¹ = D⁻¹ + σ a aᵀ for the unknowns at the places that do not hang on others.
    DiagonalAndOne { values: Range<usize>, inverse: DiagonalAndOne },
    /// In closed form, by these values; rows of C⁻¹ for the first of them, which alone others are made of.
    Inverted { values: Range<usize>, rows: Vec<Range<usize>> },
    /// By elimination with pivoting.
    Pivoted { matrix: Vec<Range<usize>>, right: Range<usize> },
}

/// C⁻¹ = D⁻¹ + σ a aᵀ by its places among the outputs.
pub(super) struct DiagonalAndOne {
    pub(super) hanging: Vec<Hanging<usize>>,
    /// The unknowns that do not hang on others.
    pub(super) rest: Vec<usize>,
    /// 1 / D_i.
    pub(super) over: Range<usize>,
    /// a.
    pub(super) along: Range<usize>,
    /// σ.
    pub(super) weight: usize,
}

impl Opened {
    /// Opens the systems that elimination with pivoting solves, and those in closed form if they are asked for.
    pub(super) fn of(graph: &mut Graph, procedure: &Procedure, is_closed_form_opened: bool) -> Self {
        let values: FxHashMap<SymbolId, ExprId> = procedure
            .definitions
            .iter()
            .filter_map(|definition| match definition {
                Definition::Value { symbol, value } => Some((*symbol, *value)),
                _ => None,
            })
            .collect();
        // what was simplified since may have taken with it what a solution was made of
        let known: BTreeSet<SymbolId> =
            graph.symbols_in(&procedure.expressions()).into_iter().chain(values.keys().copied()).collect();
        let is_whole = |solved: &&Solved| {
            let symbols = solved.symbols(graph);
            solved.results().iter().all(|unknown| values.contains_key(unknown))
                && symbols.iter().all(|symbol| known.contains(symbol))
        };
        let mut closed: Vec<&Solved> =
            procedure.solved.iter().filter(|_| is_closed_form_opened).filter(is_whole).collect();
        let cut: BTreeSet<SymbolId> = closed.iter().flat_map(|solved| solved.unknowns.clone()).collect();
        let mut open = Self { procedure: Procedure::default(), systems: Vec::new() };
        open.procedure.outputs.clone_from(&procedure.outputs);
        for definition in &procedure.definitions {
            match definition {
                Definition::Value { symbol, .. } if cut.contains(symbol) => {
                    let place = closed.iter().position(|solved| solved.unknowns.contains(symbol));
                    if let Some(place) = place {
                        open.closed(graph, closed.remove(place), &values);
                    }
                }
                Definition::Value { .. } | Definition::Call { .. } => {
                    open.procedure.definitions.push(definition.clone());
                }
                Definition::Solve { unknowns, matrix, right } => {
                    let (held, residuals) = open.residuals(graph, unknowns, matrix, right);
                    let matrix = matrix.iter().map(|row| open.put(row)).collect();
                    let closing = Closing::Pivoted { matrix, right: open.put(right) };
                    open.systems.push(OpenSystem { unknowns: unknowns.clone(), held, residuals, closing });
                }
            }
        }
        open
    }

    /// Further outputs.
    fn put(&mut self, values: &[ExprId]) -> Range<usize> {
        let start = self.procedure.outputs.len();
        self.procedure.outputs.extend(values);
        start..self.procedure.outputs.len()
    }

    /// x as it is held, and f − C x.
    fn residuals(
        &mut self,
        graph: &mut Graph,
        unknowns: &[SymbolId],
        matrix: &[Vec<ExprId>],
        right: &[ExprId],
    ) -> (Vec<(SymbolId, Held)>, Range<usize>) {
        let held: Vec<(SymbolId, Held)> =
            unknowns.iter().map(|unknown| (graph.new_symbol(""), Held::Unknown(*unknown))).collect();
        let values: Vec<ExprId> = held.iter().map(|(held, _)| graph.symbol(*held)).collect();
        let mut rows = Vec::with_capacity(right.len());
        for (row, right) in matrix.iter().zip(right) {
            let product = graph.inner_product(row, &values);
            rows.push(graph.formula(*right - product));
        }
        (held, self.put(&rows))
    }

    fn closed(&mut self, graph: &mut Graph, solved: &Solved, values: &FxHashMap<SymbolId, ExprId>) {
        let Solved { unknowns, equations, factors } = solved;
        let (held, residuals) = match equations {
            Equations::System { matrix, right } => self.residuals(graph, unknowns, matrix, right),
            Equations::Balance { held, residuals } => {
                let mut put = |value: ExprId| Held::Output(self.put(&[value]).start);
                let held = held.iter().map(|(symbol, value)| (*symbol, put(*value))).collect();
                (held, self.put(residuals))
            }
        };
        let mut values: Vec<ExprId> =
            solved.results().iter().filter_map(|unknown| values.get(unknown)).copied().collect();
        if let Factors::Rows { others, .. } = factors {
            values.extend(others);
        }
        let values = self.put(&values);
        let closing = match factors {
            Factors::Triangular { lower, diagonal } => {
                let lower = lower.iter().map(|row| self.put(row)).collect();
                Closing::Factorised { values, lower, diagonal: self.put(diagonal) }
            }
            Factors::Rows { rows, .. } => {
                Closing::Inverted { values, rows: rows.iter().map(|row| self.put(row)).collect() }
            }
            Factors::DiagonalAndOne { hanging, rest, inverse: Inverse { over, along, weight } } => {
                let hanging = hanging.iter().map(|gone| gone.map(|entry| self.put(&[entry]).start)).collect();
                let (over, along, rest) = (self.put(over), self.put(along), rest.clone());
                let weight = self.put(&[*weight]).start;
                let inverse = DiagonalAndOne { hanging, rest, over, along, weight };
                Closing::DiagonalAndOne { values, inverse }
            }
            Factors::OneByOne(eliminated) => {
                let mut put = |entry: ExprId| self.put(&[entry]).start;
                let eliminated = eliminated.iter().map(|variable| variable.map(&mut put)).collect();
                Closing::OneByOne { values, eliminated }
            }
        };
        self.systems.push(OpenSystem { unknowns: unknowns.clone(), held, residuals, closing });
    }
}
