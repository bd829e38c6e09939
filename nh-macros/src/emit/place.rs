//! What the return to position constraints asks for at one place, as one program.

use nonholonomic_core::functions::RESIDUAL;
use nonholonomic_core::mechanics::Procedure;
use nonholonomic_core::program::{Program, Value};
use nonholonomic_core::system::{PositionReturn, System};

use super::setting::Context;

/// Residuals of positions and velocities, then the change of positions, then that of velocities where it is known.
pub(super) struct Place {
    pub(super) program: Program,
    /// The outputs of each.
    pub(super) counts: Vec<usize>,
    /// The residuals that are those of positions.
    of_positions: usize,
}

impl Place {
    pub(super) fn of(context: &Context, system: &System, positions: &PositionReturn) -> Self {
        let residual = system.functions.get(&RESIDUAL).unwrap_or(&positions.residual);
        let parts = [Some(residual), Some(&positions.step), positions.velocities.as_ref()];
        let parts: Vec<&Procedure> = parts.into_iter().flatten().collect();
        let counts = parts.iter().map(|part| part.outputs.len()).collect();
        let program = context.lowering.program(&system.model, &Procedure::joined(parts));
        Self { program, counts, of_positions: positions.residual.outputs.len() }
    }

    /// The residuals of positions alone.
    pub(super) fn residual(&self) -> Program {
        self.outputs(0, self.of_positions)
    }

    /// The change of positions alone.
    pub(super) fn change(&self) -> Program {
        match self.counts[..] {
            [residuals, changes, ..] => self.outputs(residuals, changes),
            _ => Program::default(),
        }
    }

    /// The change of velocities alone.
    pub(super) fn change_of_velocities(&self) -> Option<Program> {
        match self.counts[..] {
            [residuals, changes, velocities] => Some(self.outputs(residuals + changes, velocities)),
            _ => None,
        }
    }

    fn outputs(&self, from: usize, count: usize) -> Program {
        let outputs: Vec<Value> = self.program.outputs.iter().skip(from).take(count).copied().collect();
        self.program.giving(&outputs)
    }
}
