//! Linear systems in procedures that were solved in closed form: what their unknowns satisfy, and the factors that they
//! were found with, which solve for other right-hand sides as well.

use crate::algebra::{Graph, Matrix};
use crate::id::{ExprId, SymbolId};
use std::collections::BTreeSet;

/// Unknowns that were solved for.
#[derive(Clone, Debug)]
pub(crate) struct Solved {
    pub(crate) unknowns: Vec<SymbolId>,
    pub(crate) equations: Equations,
    pub(crate) factors: Factors,
}

/// What unknowns x satisfy, C x = f.
#[derive(Clone, Debug)]
pub(crate) enum Equations {
    /// C and f.
    System { matrix: Matrix, right: Vec<ExprId> },
    /// What is left of the equations of variables that leave one after the other: of the forces on each, then of how each
    /// is carried, both in the order in which they leave.
    Balance {
        /// Symbols that are held in the place of the variables, and of the forces that carry them, with their values.
        held: Vec<(SymbolId, ExprId)>,
        residuals: Vec<ExprId>,
    },
}

/// What C is made of.
#[derive(Clone, Debug)]
pub(crate) enum Factors {
    /// C = L D Lᵀ.
    Triangular {
        /// The rows of L left of the diagonal.
        lower: Matrix,
        /// D.
        diagonal: Vec<ExprId>,
    },
    /// The rows of C⁻¹ for the unknowns that are intermediate results.
    Rows {
        rows: Matrix,
        /// The unknowns behind these, which nothing else is made of, in terms of them.
        others: Vec<ExprId>,
    },
    /// Unknowns that hang on others leave first; of the others, at these places, C⁻¹ = D⁻¹ + σ a aᵀ.
    DiagonalAndOne { hanging: Vec<Hanging<ExprId>>, rest: Vec<usize>, inverse: Inverse },
    /// Variables that leave a quadratic form one after the other; C is what is left of it for the unknowns among them.
    OneByOne(Vec<Eliminated<ExprId>>),
}

/// An unknown x_i that touches x_j alone: C_ii x_i + C_ij x_j = f_i.
#[derive(Clone, Debug)]
pub(crate) struct Hanging<T> {
    /// i.
    pub(crate) place: usize,
    /// j.
    pub(crate) on: usize,
    /// 1 / C_ii.
    pub(crate) inverse: T,
    /// C_ij / C_ii.
    pub(crate) ratio: T,
}

impl<T: Copy> Hanging<T> {
    /// With other entries.
    pub(crate) fn map<U>(&self, mut entry: impl FnMut(T) -> U) -> Hanging<U> {
        let Self { place, on, inverse, ratio } = *self;
        Hanging { place, on, inverse: entry(inverse), ratio: entry(ratio) }
    }
}

/// C⁻¹ = D⁻¹ + σ a aᵀ, with a = D⁻¹ u and σ = κ / (1 − κ u·a).
#[derive(Clone, Debug)]
pub(crate) struct Inverse {
    /// 1 / D_i.
    pub(crate) over: Vec<ExprId>,
    /// a.
    pub(crate) along: Vec<ExprId>,
    /// σ.
    pub(crate) weight: ExprId,
}

/// A variable a, at a place among all, in terms of those that leave later: a = Σ c_p a_p + b. For an unknown, b is what
/// pushes it over its pivot; for others it is given.
#[derive(Clone, Debug)]
pub(crate) struct Eliminated<T> {
    pub(crate) place: usize,
    /// p with c_p.
    pub(crate) by: Vec<(usize, T)>,
    /// What the force on it is by the variables that are left, itself among them, if it is no unknown.
    pub(crate) inertias: Vec<(usize, T)>,
    /// The unknown that it is, and what its square is multiplied by when it leaves.
    pub(crate) unknown: Option<(usize, T)>,
}

impl<T: Copy> Eliminated<T> {
    /// With other entries.
    pub(crate) fn map<U>(&self, mut entry: impl FnMut(T) -> U) -> Eliminated<U> {
        Eliminated {
            place: self.place,
            by: self.by.iter().map(|(p, c)| (*p, entry(*c))).collect(),
            inertias: self.inertias.iter().map(|(p, c)| (*p, entry(*c))).collect(),
            unknown: self.unknown.map(|(unknown, pivot)| (unknown, entry(pivot))),
        }
    }
}

impl Solved {
    /// Replaces every expression in it.
    pub(crate) fn replace(&mut self, mut image: impl FnMut(ExprId) -> ExprId) {
        let mut all: Vec<&mut ExprId> = Vec::new();
        match &mut self.equations {
            Equations::System { matrix, right } => all.extend(matrix.iter_mut().flatten().chain(right)),
            Equations::Balance { held, residuals } => {
                all.extend(held.iter_mut().map(|(_, value)| value).chain(residuals));
            }
        }
        match &mut self.factors {
            Factors::Triangular { lower, diagonal } => {
                all.extend(lower.iter_mut().flatten().chain(diagonal));
            }
            Factors::Rows { rows, others } => all.extend(rows.iter_mut().flatten().chain(others)),
            Factors::DiagonalAndOne { hanging, inverse: Inverse { over, along, weight }, .. } => {
                all.extend(over.iter_mut().chain(along).chain([weight]));
                all.extend(hanging.iter_mut().flat_map(|gone| [&mut gone.inverse, &mut gone.ratio]));
            }
            Factors::OneByOne(eliminated) => {
                for Eliminated { by, inertias, unknown, .. } in eliminated {
                    all.extend(by.iter_mut().chain(inertias).map(|(_, entry)| entry));
                    all.extend(unknown.iter_mut().map(|(_, pivot)| pivot));
                }
            }
        }
        for entry in all {
            *entry = image(*entry);
        }
    }

    /// The unknowns that are intermediate results.
    pub(crate) fn results(&self) -> &[SymbolId] {
        let others = match &self.factors {
            Factors::Rows { others, .. } => others.len(),
            Factors::Triangular { .. } | Factors::DiagonalAndOne { .. } | Factors::OneByOne(_) => 0,
        };
        &self.unknowns[..self.unknowns.len() - others]
    }

    /// The symbols that it is made of: those of its own left out.
    pub(crate) fn symbols(&self, graph: &Graph) -> BTreeSet<SymbolId> {
        let mut all = Vec::new();
        self.clone().replace(|entry| {
            all.push(entry);
            entry
        });
        let mut symbols: BTreeSet<SymbolId> = graph.symbols_in(&all).into_iter().collect();
        if let Equations::Balance { held, .. } = &self.equations {
            for (symbol, _) in held {
                symbols.remove(symbol);
            }
        }
        symbols
    }
}
