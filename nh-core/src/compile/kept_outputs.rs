//! The outputs that can be computed from the variables that `track` keeps, and what is left of functions of outputs.

use std::collections::BTreeSet;

use crate::algebra::Graph;
use crate::functions::{Function, OUTPUTS, Shape, Sliced};
use crate::id::{ExprId, SymbolId};
use crate::mechanics::Procedure;
use crate::model::OutputDecl;
use crate::system::System;

/// What each declared output lacks.
pub(super) struct KeptOutputs(Vec<BTreeSet<SymbolId>>);

impl KeptOutputs {
    /// Judges all outputs of a system of which some variables are missing.
    pub(super) fn of(system: &System, is_missing: impl Fn(&SymbolId) -> bool) -> Self {
        let lacked = |observables: &Procedure, output: &ExprId| -> BTreeSet<SymbolId> {
            let all = observables.depends_on(&system.model.graph, &[*output]);
            all.into_iter().filter(&is_missing).collect()
        };
        let observables = system.functions.get(&OUTPUTS);
        Self(observables.map_or_else(Vec::new, |all| all.outputs.iter().map(|o| lacked(all, o)).collect()))
    }

    /// Whether an output is kept, by its position.
    pub(super) fn keeps(&self, output: usize) -> bool {
        self.0.get(output).is_none_or(BTreeSet::is_empty)
    }

    /// Whether there are outputs, of which none is kept.
    pub(super) fn are_none(&self) -> bool {
        !self.0.is_empty() && self.0.iter().all(|lacked| !lacked.is_empty())
    }

    /// What is left of a function of the outputs, where some of the variables of the state are.
    pub(super) fn part(
        &self,
        function: &Function,
        state: usize,
        is_in_state: impl Fn(usize) -> bool,
    ) -> Procedure {
        let is_column_kept = |column: usize| match function.signature.shape {
            Shape::Matrix(..) => self.keeps(column),
            Shape::ByStateAndInput(_) => column >= state || is_in_state(column),
            _ => true,
        };
        let all = &function.procedure.outputs;
        let rows = all.chunks((all.len() / self.0.len().max(1)).max(1)).enumerate();
        let kept = rows.filter(|(row, _)| self.keeps(*row)).flat_map(|(_, row)| row.iter().enumerate());
        let kept = kept.filter(|(column, _)| is_column_kept(*column)).map(|(_, entry)| *entry).collect();
        function.procedure.with_outputs(kept)
    }

    /// Takes the others out of the declaration and out of every function of outputs.
    pub(super) fn restrict(&self, system: &mut System, whole: &[SymbolId], needed: &BTreeSet<SymbolId>) {
        let is_in_state = |column: usize| whole.get(column).is_none_or(|symbol| needed.contains(symbol));
        for function in system.functions.iter_mut().filter(|f| f.signature.sliced == Sliced::Outputs) {
            function.procedure = self.part(function, whole.len(), is_in_state);
        }
        if self.are_none() {
            system.functions.retain(|function| function.signature.sliced != Sliced::Outputs);
        }
        let mut position = 0..;
        system.model.outputs.retain(|_| position.next().is_none_or(|position| self.keeps(position)));
    }

    /// The outputs that are not kept, each with what it lacks; a family of which nothing is kept by its own name.
    pub(super) fn dropped(&self, graph: &Graph, outputs: &[OutputDecl]) -> Vec<String> {
        let mut lines = Vec::new();
        let line = |name: &str, lacked: &BTreeSet<SymbolId>| {
            let lacked: Vec<&str> = lacked.iter().map(|symbol| graph.symbols()[*symbol].as_str()).collect();
            format!("the output `{name}`, which depends on {}", lacked.join(", "))
        };
        let judged: Vec<(&OutputDecl, &BTreeSet<SymbolId>)> = outputs.iter().zip(&self.0).collect();
        for entries in judged.chunk_by(|(output, _), (next, _)| family(&output.name) == family(&next.name)) {
            if let ([(first, _), ..], true) = (entries, entries.iter().all(|(_, lacked)| !lacked.is_empty()))
            {
                let lacked = entries.iter().flat_map(|(_, lacked)| lacked.iter().copied()).collect();
                lines.push(line(family(&first.name), &lacked));
                continue;
            }
            let alone = entries.iter().filter(|(_, lacked)| !lacked.is_empty());
            lines.extend(alone.map(|(output, lacked)| line(&output.name, lacked)));
        }
        lines
    }
}

/// The name of a family by that of an entry, `pose[1]`.
fn family(entry: &str) -> &str {
    entry.split('[').next().unwrap_or(entry)
}
