//! What the macro would emit, run without a compiler.

use nh_stages::Declaration;
use nonholonomic_core::algebra::Accuracy;
use nonholonomic_core::compile::compile;
use nonholonomic_core::functions::MULTIPLIERS;
use nonholonomic_core::id::SymbolId;
use nonholonomic_core::mechanics::Procedure;
use nonholonomic_core::model::{Formulation, Model};
use nonholonomic_core::program::{Program, corrected, interpret, schedule_grouping};
use nonholonomic_core::system::System;

use crate::generator::Machine;
use crate::place::Place;

/// The levels of accuracy, as they are written.
pub const LEVELS: [&str; 3] = ["fast", "balanced", "careful"];

/// A machine at one level of accuracy.
#[derive(Clone, Debug)]
pub struct Emitted {
    /// What was declared.
    pub model: Model,
    /// What was derived.
    pub system: System,
    derivative: Program,
    multipliers: Option<Program>,
}

impl Emitted {
    /// Derives a machine.
    ///
    /// # Errors
    /// The errors of the macro.
    pub fn of(machine: &Machine, level: &str) -> Result<Self, Vec<String>> {
        let tokens = |text: String| text.parse().map_err(|_| vec![format!("not made of tokens: {text}")]);
        let (attribute, item) = (tokens(machine.attribute(level))?, tokens(machine.item())?);
        let model = Declaration { name: "Machine".into(), attribute, item }.model()?;
        let text = |violations: Vec<_>| violations.iter().map(|v| format!("{v:?}")).collect::<Vec<_>>();
        let system = compile(model.clone()).map_err(text)?;
        let parameters: Vec<SymbolId> = system.model.parameters.iter().map(|p| p.symbol).collect();
        let is_careful = system.model.graph.accuracy() == Accuracy::Careful;
        let program = |procedure: &Procedure| {
            let program = schedule_grouping(&system.model.graph, procedure, &parameters);
            if is_careful { corrected(&program) } else { program }
        };
        let derivative = program(&system.derivative);
        let multipliers = system.functions.get(&MULTIPLIERS).map(program);
        Ok(Self { model, system, derivative, multipliers })
    }

    /// Whether multipliers are computed.
    pub(crate) fn has_multipliers(&self) -> bool {
        self.multipliers.is_some()
    }

    /// Whether the state has all velocities.
    #[must_use]
    pub fn is_projected(&self) -> bool {
        self.system.formulation == Formulation::Projected
    }

    /// The accelerations of the velocities in the state, then the multipliers.
    #[must_use]
    pub fn run(&self, place: &Place) -> Vec<f64> {
        let at = |symbol: SymbolId| place.values.get(&symbol).copied().unwrap_or(f64::NAN);
        let mut results = interpret(&self.derivative, at).split_off(self.system.state_coordinates.len());
        if let Some(multipliers) = &self.multipliers {
            results.extend(interpret(multipliers, at));
        }
        results
    }
}
