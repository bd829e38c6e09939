//! Mathematics (7), (9) and (34) as they are declared, unreduced.

use f256::f256;
use nonholonomic_core::id::{ExprId, Id, SymbolId};
use nonholonomic_core::model::{ForceDirection, Kinematics, Model};
use std::collections::BTreeMap;

use crate::evaluate::evaluate;
use crate::jet::Jet;
use crate::numbers::{inner, solve};
use crate::place::Place;

/// A declaration with numbers for its symbols.
pub(crate) struct Declared<'a> {
    model: &'a Model,
    values: BTreeMap<SymbolId, f256>,
}

impl<'a> Declared<'a> {
    pub(crate) fn at(model: &'a Model, place: &Place) -> Self {
        let values = place.values.iter().map(|(symbol, value)| (*symbol, f256::from(*value))).collect();
        Self { model, values }
    }

    fn velocities(&self) -> Vec<SymbolId> {
        self.model.sections.iter().map(|section| section.symbol).collect()
    }

    fn symbol(&self, symbol: SymbolId, variables: &[SymbolId]) -> Jet {
        let value = self.values.get(&symbol).copied().unwrap_or(f256::NAN);
        match variables.iter().position(|variable| *variable == symbol) {
            Some(index) => Jet::variable(value, index, variables.len()),
            None => Jet::constant(value, variables.len()),
        }
    }

    /// Expressions by some of the symbols, with the rates that the kinematics give.
    pub(crate) fn jets(&self, roots: &[ExprId], variables: &[SymbolId]) -> Vec<Jet> {
        let rates = self.rates(variables);
        self.with_rates(roots, variables, &rates)
    }

    fn with_rates(&self, roots: &[ExprId], variables: &[SymbolId], rates: &[Jet]) -> Vec<Jet> {
        evaluate(&self.model.graph, roots, variables.len(), |symbol| {
            let rate = self.model.coordinates.iter().position(|x| x.rate == symbol);
            rate.map_or_else(|| self.symbol(symbol, variables), |index| rates[index].clone())
        })
    }

    /// ẋ^i, mathematics (1).
    fn rates(&self, variables: &[SymbolId]) -> Vec<Jet> {
        let coordinates = &self.model.coordinates;
        match &self.model.kinematics {
            Kinematics::Tangent => coordinates.iter().map(|x| self.symbol(x.rate, variables)).collect(),
            Kinematics::Anchor(lines) => {
                let zero = Jet::constant(f256::ZERO, variables.len());
                let mut rates = vec![zero; coordinates.len()];
                let roots: Vec<ExprId> = lines.iter().map(|line| line.rate).collect();
                for (line, rate) in lines.iter().zip(self.with_rates(&roots, variables, &[])) {
                    rates[line.coordinate.index()] = rate;
                }
                rates
            }
            Kinematics::Coframe(rows) => {
                // w = α ẋ, solved in jets: ẋ = β w
                let roots: Vec<ExprId> = rows.iter().map(|row| row.value).collect();
                let unit = |index: usize| -> Vec<Jet> {
                    let entry =
                        |k| Jet::constant(if k == index { f256::ONE } else { f256::ZERO }, variables.len());
                    self.with_rates(&roots, variables, &(0..rows.len()).map(entry).collect::<Vec<_>>())
                };
                let columns: Vec<Vec<Jet>> = (0..rows.len()).map(unit).collect();
                let matrix =
                    (0..rows.len()).map(|i| columns.iter().map(|column| column[i].clone()).collect());
                let right = self.velocities().into_iter().map(|y| self.symbol(y, variables)).collect();
                solve_jets(matrix.collect(), right)
            }
        }
    }

    /// Solves linear constraints for the velocities that are not kept.
    fn complete(&mut self, kept: &[SymbolId]) -> Option<()> {
        let velocities = self.velocities();
        let dependent: Vec<SymbolId> = velocities.into_iter().filter(|y| !kept.contains(y)).collect();
        if dependent.is_empty() {
            return Some(());
        }
        let residuals: Vec<ExprId> = self.model.constraints.iter().map(|c| c.residual).collect();
        let residuals = self.jets(&residuals, &dependent);
        let matrix = residuals.iter().map(|r| r.first.clone()).collect();
        let right = residuals.iter().map(|r| vec![-r.value]).collect();
        let changes = solve(matrix, right)?;
        for (symbol, change) in dependent.iter().zip(changes) {
            *self.values.get_mut(symbol)? += change[0];
        }
        Some(())
    }

    /// C^γ_{αβ} y^β p_γ for every α: by the declared brackets, or by those that an injective anchor determines, (2).
    fn bracket_force(&self, rates: &[Jet], momenta: &[f256]) -> Option<Vec<f256>> {
        let velocities = self.velocities();
        let (s, n) = (velocities.len(), self.model.coordinates.len());
        let y: Vec<f256> = velocities.iter().map(|symbol| self.values[symbol]).collect();
        let mut force = vec![f256::ZERO; s];
        if self.model.brackets_declared {
            let roots: Vec<ExprId> = self.model.brackets.iter().map(|bracket| bracket.value).collect();
            for (bracket, value) in self.model.brackets.iter().zip(self.jets(&roots, &velocities)) {
                let (left, right) = (bracket.left.index(), bracket.right.index());
                let paired = inner(&value.first, momenta);
                force[left] += y[right] * paired;
                force[right] -= y[left] * paired;
            }
            return Some(force);
        }
        if matches!(self.model.kinematics, Kinematics::Tangent) {
            return Some(force);
        }
        // variables: t, x, y
        let anchor = |i: usize, alpha: usize| rates[i].first[1 + n + alpha];
        let gram: Vec<Vec<f256>> = (0..s)
            .map(|a| {
                (0..s)
                    .map(|b| (0..n).map(|i| anchor(i, a) * anchor(i, b)).fold(f256::ZERO, |x, y| x + y))
                    .collect()
            })
            .collect();
        for alpha in 0..s {
            for beta in 0..s {
                // [ρ_α, ρ_β]^j
                let along = |a: usize, b: usize, j: usize| {
                    (0..n)
                        .map(|i| anchor(i, a) * rates[j].second(1 + i, 1 + n + b))
                        .fold(f256::ZERO, |x, y| x + y)
                };
                let bracket: Vec<f256> =
                    (0..n).map(|j| along(alpha, beta, j) - along(beta, alpha, j)).collect();
                let right = (0..s)
                    .map(|c| vec![(0..n).map(|j| anchor(j, c) * bracket[j]).fold(f256::ZERO, |x, y| x + y)]);
                let structure = solve(gram.clone(), right.collect())?;
                for (gamma, value) in structure.iter().enumerate() {
                    force[alpha] += value[0] * y[beta] * momenta[gamma];
                }
            }
        }
        Some(force)
    }
}

/// A constraint as it is differentiated: Σ J_α ẏ^α + change = 0.
struct Row {
    slope: Vec<f256>,
    change: f256,
}

impl Declared<'_> {
    /// The constraints on positions, differentiated twice, then those on velocities, by variables (t, x, y).
    fn rows(&self, variables: &[SymbolId], rates: &[Jet], along: &impl Fn(&[f256]) -> f256) -> Vec<Row> {
        let n = rates.len();
        let (positions, of_y) = (self.model.positions.len(), 1 + n);
        let roots: Vec<ExprId> = self.model.positions.iter().map(|position| position.value).collect();
        let twice = self.with_rates(&roots, variables, rates).into_iter().map(|f| {
            // φ = ∂_tf + ẋ^i ∂_if, with the rates as functions of (t, x, y)
            let by = |k: usize| -> f256 { along(&(0..of_y).map(|l| f.second(l, k)).collect::<Vec<_>>()) };
            let first: Vec<f256> = (0..of_y).map(by).collect();
            let turn = (0..n).map(|i| f.first[1 + i] * along(&rates[i].first));
            let slope = (of_y..variables.len())
                .map(|k| (0..n).fold(f256::ZERO, |sum, i| sum + f.first[1 + i] * rates[i].first[k]));
            Row { slope: slope.collect(), change: turn.fold(along(&first), |sum, x| sum + x) }
        });
        let twice: Vec<Row> = twice.collect();
        let roots: Vec<ExprId> =
            self.model.constraints.iter().skip(positions).map(|constraint| constraint.residual).collect();
        let once = self.with_rates(&roots, variables, rates).into_iter();
        let once = once.map(|c| Row { slope: c.first[of_y..].to_vec(), change: along(&c.first) });
        twice.into_iter().chain(once).collect()
    }
}

/// Elimination by the largest values.
fn solve_jets(mut matrix: Vec<Vec<Jet>>, mut right: Vec<Jet>) -> Vec<Jet> {
    let n = right.len();
    for k in 0..n {
        let size = |row: &usize| matrix[*row][k].value.abs();
        let pivot = (k..n).max_by(|a, b| size(a).total_cmp(&size(b))).unwrap_or(k);
        matrix.swap(k, pivot);
        right.swap(k, pivot);
        let inverse = matrix[k][k].recip();
        for row in (0..n).filter(|row| *row != k) {
            let factor = matrix[row][k].times(&inverse);
            for column in k..n {
                let change = factor.times(&matrix[k][column]);
                matrix[row][column].add_scaled(f256::NEG_ONE, &change);
            }
            let change = factor.times(&right[k]);
            right[row].add_scaled(f256::NEG_ONE, &change);
        }
    }
    matrix.iter().enumerate().zip(right).map(|((k, row), right)| right.times(&row[k].recip())).collect()
}

/// What the equations say at a place.
#[derive(Clone, Debug)]
pub struct Motion {
    /// ẏ for every section.
    pub accelerations: Vec<f256>,
    /// λ for every constraint.
    pub multipliers: Vec<f256>,
}

impl Motion {
    /// The solution of W ẏ + h = Υ + Jᵀλ with J ẏ = −(ρ y)^i ∂_iφ − ∂_tφ, where `kept` velocities are given and linear
    /// constraints determine the others. None where that is singular.
    #[must_use]
    pub fn of(model: &Model, kept: &[SymbolId], place: &Place) -> Option<Self> {
        let mut declared = Declared::at(model, place);
        declared.complete(kept)?;
        let velocities = declared.velocities();
        let (s, n) = (velocities.len(), model.coordinates.len());
        let coordinates = model.coordinates.iter().map(|x| x.symbol);
        let variables: Vec<SymbolId> =
            std::iter::once(model.time).chain(coordinates).chain(velocities.iter().copied()).collect();
        let (of_x, of_y) = (1, 1 + n);
        let rates = declared.rates(&variables);
        let along = |first: &[f256]| (0..n).fold(first[0], |sum, i| sum + rates[i].value * first[of_x + i]);
        // 1. W, p and h of (6)
        let lagrangian = declared.with_rates(&[model.lagrangian.value], &variables, &rates).pop()?;
        let momenta = &lagrangian.first[of_y..];
        let mut right = declared.bracket_force(&rates, momenta)?;
        for (alpha, right) in right.iter_mut().enumerate() {
            let change: Vec<f256> = (0..of_y).map(|k| lagrangian.second(k, of_y + alpha)).collect();
            *right += along(&change);
            for i in 0..n {
                *right -= rates[i].first[of_y + alpha] * lagrangian.first[of_x + i];
            }
            *right = -*right;
        }
        // 2. Υ
        let roots: Vec<ExprId> = model.forces.iter().map(|force| force.value).collect();
        for (force, value) in model.forces.iter().zip(declared.with_rates(&roots, &variables, &rates)) {
            match force.direction {
                ForceDirection::Section(symbol) => {
                    right[velocities.iter().position(|y| *y == symbol)?] += value.value;
                }
                ForceDirection::Coordinate(coordinate) => {
                    for (alpha, right) in right.iter_mut().enumerate() {
                        *right += rates[coordinate.index()].first[of_y + alpha] * value.value;
                    }
                }
            }
        }
        // 3. the saddle system
        let rows = declared.rows(&variables, &rates, &along);
        let mut matrix: Vec<Vec<f256>> = Vec::with_capacity(s + rows.len());
        for alpha in 0..s {
            let mass = (0..s).map(|beta| lagrangian.second(of_y + alpha, of_y + beta));
            let pull = rows.iter().map(|row| -row.slope[alpha]);
            matrix.push(mass.chain(pull).collect());
        }
        let none = vec![f256::ZERO; rows.len()];
        for Row { slope, change } in rows {
            matrix.push([slope, none.clone()].concat());
            right.push(-change);
        }
        let right = right.into_iter().map(|x| vec![x]).collect();
        let mut accelerations: Vec<f256> = solve(matrix, right)?.into_iter().map(|row| row[0]).collect();
        let multipliers = accelerations.split_off(s);
        Some(Self { accelerations, multipliers })
    }
}
