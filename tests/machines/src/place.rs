//! Where a machine is looked at.

use f256::f256;
use nonholonomic_core::id::{ExprId, SymbolId};
use nonholonomic_core::model::Model;
use std::collections::BTreeMap;

use crate::generator::Random;
use crate::jet::Jet;
use crate::numbers::{inner, rounded, solve};
use crate::reference::Declared;

/// How large parameters are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scale {
    /// About one.
    Ordinary,
    /// Each by itself up to so many decades above or below.
    Apart(f64),
}

/// Numbers for parameters, inputs, time and state.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// The value of every symbol of the declaration that is not a rate.
    pub values: BTreeMap<SymbolId, f64>,
}

/// Letters of parameters that are inertias or stiffnesses.
const POSITIVE: &str = "mJIACkr";

impl Place {
    /// A place on the embedded base, on closed loops and on the constraint manifold, as nearly as rounding allows where
    /// there is one nearby.
    #[must_use]
    pub fn draw(model: &Model, scale: Scale, random: &mut Random) -> Self {
        let mut values = BTreeMap::new();
        for parameter in &model.parameters {
            let decades = match scale {
                Scale::Ordinary => 0.0,
                Scale::Apart(decades) => random.between(-decades, decades),
            };
            let size = random.between(0.4, 2.5) * 10f64.powf(decades);
            let is_positive = parameter.name.starts_with(|letter| POSITIVE.contains(letter));
            let sign = if !is_positive && random.happens(40) { -1.0 } else { 1.0 };
            values.insert(parameter.symbol, sign * size);
        }
        values.insert(model.time, random.between(0.0, 3.0));
        let inputs = model.inputs.iter().map(|input| input.symbol);
        let coordinates: Vec<SymbolId> = model.coordinates.iter().map(|x| x.symbol).collect();
        let velocities: Vec<SymbolId> = model.sections.iter().map(|section| section.symbol).collect();
        for symbol in inputs.chain(coordinates.iter().copied()).chain(velocities.iter().copied()) {
            let size = random.between(0.2, 1.6);
            values.insert(symbol, if random.happens(50) { -size } else { size });
        }
        let mut place = Self { values };
        let identities = model.identities.iter().map(|identity| identity.value);
        let positions = model.positions.iter().map(|position| position.value);
        let residuals: Vec<ExprId> = identities.chain(positions).collect();
        place.return_to(model, &residuals, &coordinates);
        let constraints: Vec<ExprId> =
            model.constraints.iter().map(|constraint| constraint.residual).collect();
        place.return_to(model, &constraints, &velocities);
        place
    }

    /// Whether the position constraints hold as far as numbers of 53 bits can say.
    #[must_use]
    pub fn is_closed(&self, model: &Model) -> bool {
        let residuals: Vec<ExprId> = model.positions.iter().map(|position| position.value).collect();
        let coordinates: Vec<SymbolId> = model.coordinates.iter().map(|x| x.symbol).collect();
        let residuals = Declared::at(model, self).jets(&residuals, &coordinates);
        residuals.iter().all(|residual| {
            let moves = coordinates.iter().zip(&residual.first).map(|(x, slope)| {
                let size = self.values[x].abs().max(1e-3);
                rounded(slope.abs()) * size
            });
            rounded(residual.value.abs()) <= 8.0 * f64::EPSILON * moves.sum::<f64>()
        })
    }

    /// Newton's method for zeros of residuals, with the least change relative to the size of each variable.
    fn return_to(&mut self, model: &Model, residuals: &[ExprId], variables: &[SymbolId]) {
        const ENOUGH: usize = 12;
        for _ in 0..ENOUGH {
            let residuals = Declared::at(model, self).jets(residuals, variables);
            let size = |k: usize| f256::from(self.values[&variables[k]].abs().max(1e-3));
            let weighed = |r: &Jet| -> Vec<f256> {
                r.first.iter().enumerate().map(|(k, slope)| *slope * size(k) * size(k)).collect()
            };
            let weighed: Vec<Vec<f256>> = residuals.iter().map(weighed).collect();
            let matrix = residuals.iter().map(|r| weighed.iter().map(|row| inner(&r.first, row)).collect());
            let right = residuals.iter().map(|r| vec![-r.value]).collect();
            let Some(multipliers) = solve(matrix.collect(), right) else { return };
            for (k, variable) in variables.iter().enumerate() {
                let moves = weighed.iter().zip(&multipliers).map(|(row, multiplier)| row[k] * multiplier[0]);
                let change = moves.fold(f256::ZERO, |sum, x| sum + x);
                if let Some(value) = self.values.get_mut(variable) {
                    *value += rounded(change);
                }
            }
        }
    }
}
