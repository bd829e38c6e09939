//! What the return to position constraints asks for at one place, as one program.

use nonholonomic_core::functions::RESIDUAL;
use nonholonomic_core::id::SymbolId;
use nonholonomic_core::mechanics::Procedure;
use nonholonomic_core::program::{Program, Value};
use nonholonomic_core::system::{PositionReturn, System};

use super::setting::Context;

/// Residuals of positions and velocities and how large their terms are, and the changes that they lead to, as functions of what
/// is open.
pub(super) struct Place {
    pub(super) program: Program,
    /// What the changes are for: symbols of what is left of equations on positions, then of those on velocities.
    pub(super) open: Vec<SymbolId>,
    /// By how much each coordinate of the state changes near to the place.
    pub(super) moved: Vec<SymbolId>,
    counts: Counts,
}

/// How many outputs there are of each kind.
struct Counts {
    residuals: usize,
    /// The residuals that are those of positions.
    of_positions: usize,
    /// What the step is for.
    open: usize,
    nearby: usize,
    positions: usize,
    velocities: Option<usize>,
}

impl Place {
    pub(super) fn of(context: &Context, system: &System, positions: &PositionReturn) -> Self {
        let residual = system.functions.get(&RESIDUAL).unwrap_or(&positions.residual);
        let (step, of_step) = positions.step.opened(&positions.open);
        let velocities = positions.velocities.as_ref().map(|velocities| velocities.opened(&positions.open));
        let of_velocities = velocities.iter().flat_map(|(_, values)| values);
        let (open, values): (Vec<_>, Vec<_>) = of_step.iter().chain(of_velocities).copied().unzip();
        let velocities = velocities.as_ref().map(|(velocities, _)| velocities);
        let counts = Counts {
            residuals: residual.outputs.len(),
            of_positions: positions.count.min(residual.outputs.len()),
            open: of_step.len(),
            nearby: positions.nearby.changes.outputs.len(),
            positions: step.outputs.len(),
            velocities: velocities.map(|velocities| velocities.outputs.len()),
        };
        let values = Procedure::of(values);
        let nearby = &positions.nearby;
        let parts = [Some(residual), Some(&values), Some(&nearby.changes), Some(&step), velocities];
        let procedure = Procedure::joined(parts.into_iter().flatten());
        let program = context.lowering.program(&system.model, &procedure);
        let residuals = program.outputs[..counts.residuals.min(program.outputs.len())].to_vec();
        let moved_by = |symbol: &SymbolId| nearby.by.iter().find(|(coordinate, _)| coordinate == symbol);
        let moved = system.state_coordinates.iter().filter_map(moved_by).map(|(_, moved)| *moved).collect();
        Self { program: program.with_sizes_of(&residuals), open, moved, counts }
    }

    /// What is left of all equations, and what the changes are for.
    pub(super) fn look(&self) -> [&[Value]; 4] {
        let Counts { residuals, of_positions, open, .. } = self.counts;
        let of_velocities = residuals + open;
        [
            self.outputs(0, of_positions),
            self.outputs(of_positions, residuals - of_positions),
            self.outputs(residuals, open),
            self.outputs(of_velocities, self.open.len() - open),
        ]
    }

    /// How large the terms are of equations on positions, and of those on velocities.
    pub(super) fn sizes(&self) -> [&[Value]; 2] {
        let Counts { residuals, of_positions, positions, velocities, .. } = self.counts;
        let from = self.changes() + positions + velocities.unwrap_or(0);
        [self.outputs(from, of_positions), self.outputs(from + of_positions, residuals - of_positions)]
    }

    /// The change of positions.
    pub(super) fn change(&self) -> &[Value] {
        self.outputs(self.changes(), self.counts.positions)
    }

    /// The change of velocities, where it is known.
    pub(super) fn change_of_velocities(&self) -> Option<&[Value]> {
        let count = self.counts.velocities?;
        Some(self.outputs(self.changes() + self.counts.positions, count))
    }

    /// How what is open changes nearby: equations on positions to first order and by the second, and those on velocities.
    pub(super) fn nearby(&self) -> [&[Value]; 3] {
        let Counts { residuals, open, nearby, .. } = self.counts;
        let from = residuals + self.open.len();
        [
            self.outputs(from, open),
            self.outputs(from + open, open),
            self.outputs(from + 2 * open, nearby.saturating_sub(2 * open)),
        ]
    }

    /// Where the changes begin.
    fn changes(&self) -> usize {
        self.counts.residuals + self.open.len() + self.counts.nearby
    }

    /// What some outputs are for: symbols, and their values here.
    pub(super) fn open_of(&self, outputs: &[Value]) -> (Vec<SymbolId>, Vec<Value>) {
        let loaded = self.program.giving(outputs).symbols();
        let [.., positions, velocities] = self.look();
        let values = positions.iter().chain(velocities).copied();
        self.open.iter().copied().zip(values).filter(|(symbol, _)| loaded.contains(symbol)).unzip()
    }

    /// Some outputs with what they are for, as a program.
    pub(super) fn whole(&self, outputs: &[Value]) -> Program {
        let (_, values) = self.open_of(outputs);
        self.program.giving(&[&values, outputs].concat())
    }

    fn outputs(&self, from: usize, count: usize) -> &[Value] {
        // nothing is there if no program could be proved
        self.program.outputs.get(from..from + count).unwrap_or_default()
    }
}
