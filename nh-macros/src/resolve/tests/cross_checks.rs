//! Other derivations of the same equations, on every reference system: Gibbs and Appell (CNS (17)),
//! and the projections of the free motion (CLMM Theorems 3.14, 3.15, 7.3, 7.4), computed in numbers.

use nonholonomic_core::algebra::Matrix;
use nonholonomic_core::check;
use nonholonomic_core::functions::{GIBBS_APPELL, VELOCITY};
use nonholonomic_core::geometry::{Algebroid, LinearConstraints};
use nonholonomic_core::id::{ExprId, Id, Origin, SectionId, SymbolId};
use nonholonomic_core::mechanics::{LagrangianSystem, saddle_equations};
use nonholonomic_core::model::{Model, Request};
use nonholonomic_core::program::{interpret, schedule};
use nonholonomic_core::system::System;

use super::catalogue::{all, resolved};
use super::of_name;

/// Every reference system, without its requests.
fn models() -> Vec<Model> {
    let model = |(attribute, item)| {
        let mut model = resolved(attribute, item).model;
        model.requests.clear();
        model
    };
    all().into_iter().map(model).collect()
}

/// A point: the value of every name, from 0.5 to 1.5, so that angles stay away from singular charts.
struct Point<'a> {
    model: &'a Model,
    /// What stands in place of that for some symbols.
    changed: Vec<(SymbolId, f64)>,
    number: u32,
}

impl Point<'_> {
    fn value(&self, symbol: SymbolId) -> f64 {
        let changed = self.changed.iter().find(|(known, _)| *known == symbol);
        let name = format!("{}{}", self.model.graph.symbols()[symbol], self.number);
        changed.map_or(of_name(&name) - 0.5, |(_, value)| *value)
    }

    fn of(&self, expressions: &[ExprId]) -> Vec<f64> {
        let values = self.model.graph.evaluate(expressions, |symbol| self.value(symbol));
        values.into_iter().map(|bounded| bounded.value).collect()
    }

    fn of_matrix(&self, matrix: &Matrix) -> Vec<Vec<f64>> {
        matrix.iter().map(|row| self.of(row)).collect()
    }
}

/// The solution of a linear system, by elimination with pivoting; `None` if it is nearly singular.
fn solved(mut rows: Vec<Vec<f64>>, right: &[f64]) -> Option<Vec<f64>> {
    let n = right.len();
    rows.iter_mut().zip(right).for_each(|(row, right)| row.push(*right));
    for i in 0..n {
        let pivot = (i..n).max_by(|a, b| rows[*a][i].abs().total_cmp(&rows[*b][i].abs()))?;
        rows.swap(i, pivot);
        let leading = rows[i].clone();
        if leading[i].abs() < 1e-6 {
            return None;
        }
        for row in rows.iter_mut().enumerate().filter(|(k, _)| *k != i).map(|(_, row)| row) {
            let factor = row[i] / leading[i];
            row.iter_mut().zip(&leading).for_each(|(x, y)| *x -= factor * y);
        }
    }
    Some((0..n).map(|i| rows[i][n] / rows[i][i]).collect())
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn assert_close(name: &str, what: &str, found: &[f64], expected: &[f64]) {
    let size = expected.iter().fold(1.0_f64, |size, value| size.max(value.abs()));
    for (k, (a, b)) in found.iter().zip(expected).enumerate() {
        assert!((a - b).abs() <= 1e-9 * size, "{name}, {what}, component {k}: {a} is not {b}");
    }
    assert_eq!(found.len(), expected.len(), "{name}, {what}");
}

#[test]
fn gibbs_and_appell() {
    for mut model in models() {
        model.requests.push((Request::GibbsAppell, Origin::from_index(0)));
        let name = model.name.clone();
        let system = nonholonomic_core::compile::compile(model).unwrap();
        let appell = system.functions.get(&GIBBS_APPELL).expect("asked for");
        for number in 0..3 {
            let point = Point { model: &system.model, changed: Vec::new(), number };
            let run = |procedure| {
                let program = schedule(&system.model.graph, procedure);
                interpret(&program, |symbol| point.value(symbol))
            };
            assert_close(&name, "Gibbs and Appell", &run(appell), &run(&system.derivative));
        }
    }
}

/// What the projections are made of, as expressions.
struct Geometry {
    system: LagrangianSystem,
    /// φ^A.
    residuals: Vec<ExprId>,
    /// Φ^A_α, where all constraints are linear and homogeneous, and nothing depends on the time.
    annihilator: Option<Matrix>,
}

/// The stages up to the constraints, without forces; `None` where D is given by sections.
fn geometry(model: &mut Model) -> Option<Geometry> {
    if model.distribution.is_some() {
        return None;
    }
    let facts = check::facts(model).unwrap();
    let mut motion = check::kinematics(model).unwrap();
    let base = check::embedding(model, &motion).unwrap();
    let structure = check::structure_functions(model, &motion, &base).unwrap();
    let velocities = model.sections.iter().map(|section| section.symbol).collect();
    let algebroid = Algebroid { anchor: motion.anchor.clone(), structure, velocities };
    let algebroid = check::change_to_frame(model, &mut motion, algebroid, &base, &facts).unwrap();
    let on_base = check::Positions::none(&base);
    let constraints = check::constraints(model, &mut motion, &algebroid, &on_base).unwrap();
    let lagrangian = motion.rates.apply(&mut model.graph, model.lagrangian.value);
    let forces = vec![model.graph.zero(); algebroid.rank()];
    let system = LagrangianSystem {
        algebroid,
        lagrangian,
        forces,
        forces_on_distribution: Vec::new(),
        clock: model.clock(),
    };
    let autonomous = |expressions: &[ExprId]| !model.graph.symbols_in(expressions).contains(&model.time);
    let homogeneous = |linear: &LinearConstraints| {
        let zero = linear.drift.iter().all(|drift| model.graph.is_literal_zero(*drift));
        zero && autonomous(&linear.annihilator.concat()) && autonomous(&[lagrangian])
    };
    let annihilator = constraints.linear.clone().filter(homogeneous).map(|linear| linear.annihilator);
    Some(Geometry { system, residuals: constraints.residuals, annihilator })
}

/// A state at which to compare, on the constraint manifold where that is linear: changed symbols.
fn on_manifold(system: &System, declared: &Model, geometry: &Geometry) -> Vec<(SymbolId, f64)> {
    let point = Point { model: &system.model, changed: Vec::new(), number: 0 };
    let velocities = &geometry.system.algebroid.velocities;
    let velocity = system.functions.get(&VELOCITY).unwrap();
    let program = schedule(&system.model.graph, velocity);
    let mut values = interpret(&program, |symbol| point.value(symbol));
    if let Some(annihilator) = &geometry.annihilator {
        // in the projected formulation the velocities were arbitrary: y − Φᵀ (Φ Φᵀ)⁻¹ Φ y
        let rows = Point { model: declared, ..point }.of_matrix(annihilator);
        let gram: Vec<Vec<f64>> = rows.iter().map(|a| rows.iter().map(|b| dot(a, b)).collect()).collect();
        let errors: Vec<f64> = rows.iter().map(|row| dot(row, &values)).collect();
        let weights = solved(gram, &errors).unwrap();
        for (row, weight) in rows.iter().zip(weights) {
            values.iter_mut().zip(row).for_each(|(y, entry)| *y -= weight * entry);
        }
    }
    velocities.iter().copied().zip(values).collect()
}

/// The rates of all quasi-velocities along the generated motion.
fn accelerations(system: &System, velocities: &[SymbolId], point: &Point) -> Vec<f64> {
    let graph = &mut system.model.graph.clone();
    let velocity = system.functions.get(&VELOCITY).unwrap().outputs.clone();
    let rates = {
        let program = schedule(graph, &system.derivative);
        interpret(&program, |symbol| point.value(symbol))
    };
    let state = system.state();
    let mut found = Vec::new();
    for component in velocity.iter().take(velocities.len()) {
        let mut rate = 0.0;
        let slopes: Vec<ExprId> = state
            .iter()
            .chain([&system.model.time])
            .map(|symbol| graph.partial(*component, *symbol))
            .collect();
        let slopes: Vec<f64> =
            graph.evaluate(&slopes, |symbol| point.value(symbol)).into_iter().map(|b| b.value).collect();
        for (slope, value) in slopes.iter().zip(rates.iter().chain([&1.0])) {
            rate += slope * value;
        }
        found.push(rate);
    }
    found
}

/// CLMM Theorems 3.14 and 7.3: the motion is the free one, brought back to the constraint manifold
/// along W⁻¹ Jᵀ. It is also its projection along the ω-complement of the tangents with velocities in
/// ker J, CLMM Theorems 3.15 and 7.4, exactly if J y = 0 where the constraints hold.
#[test]
fn the_motion_is_a_projection_of_the_free_one() {
    let (mut along_reactions, mut symplectic, mut others) = (0, 0, 0);
    for model in models() {
        let mut declared = model.clone();
        let Some(geometry) = geometry(&mut declared) else { continue };
        let mut free = model;
        free.forces.clear();
        let name = free.name.clone();
        let system = nonholonomic_core::compile::compile(free).unwrap();
        let changed = on_manifold(&system, &declared, &geometry);
        // the same symbols in both models
        let point = Point { model: &system.model, changed: changed.clone(), number: 0 };
        let expected = accelerations(&system, &geometry.system.algebroid.velocities, &point);
        let mut evaluated = declared.clone();
        let Some(free) = FreeMotion::at(&mut evaluated, &geometry, changed) else { continue };
        assert_close(&name, "P", &free.along_reactions(), &expected);
        along_reactions += 1;
        let Some([velocity, acceleration]) = free.symplectic() else { continue };
        if free.is_homogeneous() {
            assert_close(&name, "the velocity of the symplectic projection", &velocity, &free.velocity);
            assert_close(&name, "the symplectic projection", &acceleration, &expected);
            symplectic += 1;
        } else {
            let apart = velocity.iter().zip(&free.velocity).any(|(a, b)| (a - b).abs() > 1e-6);
            assert!(apart, "{name}: the symplectic projection is a second-order equation");
            others += 1;
        }
    }
    let counted = along_reactions > 25 && symplectic > 15 && others > 1;
    assert!(all().is_empty() || counted, "{along_reactions}, {symplectic}, {others}");
}

/// The free motion at a point, in numbers.
struct FreeMotion {
    velocity: Vec<f64>,
    /// W.
    mass: Vec<Vec<f64>>,
    /// W⁻¹ (−h).
    acceleration: Vec<f64>,
    /// J and −(ρ y)^i ∂_iφ − ∂_tφ.
    jacobian: Vec<Vec<f64>>,
    bias: Vec<f64>,
    /// ρ^i_β ∂_i p_α, in row α.
    change: Vec<Vec<f64>>,
    /// p_γ C^γ_{αβ}.
    bracket: Vec<Vec<f64>>,
    /// ρ^i_β ∂_iφ^A: in row A, for each β.
    turning: Vec<Vec<f64>>,
}

impl FreeMotion {
    /// `None` where W is singular.
    fn at(model: &mut Model, geometry: &Geometry, changed: Vec<(SymbolId, f64)>) -> Option<Self> {
        let graph = &mut model.graph;
        let algebroid = &geometry.system.algebroid;
        let saddle = saddle_equations(graph, &geometry.system, &geometry.residuals);
        let momenta = geometry.system.momenta(graph);
        let sections: Vec<SectionId> = algebroid.sections().collect();
        let (mut change, mut bracket) = (Matrix::new(), Matrix::new());
        for alpha in &sections {
            let rows = |beta: &SectionId| algebroid.anchor.along(*beta);
            change
                .push(sections.iter().map(|beta| rows(beta).apply(graph, momenta[alpha.index()])).collect());
            let mut row = Vec::new();
            for beta in &sections {
                let components: Vec<ExprId> = sections
                    .iter()
                    .map(|gamma| algebroid.structure.get(graph, *gamma, *alpha, *beta))
                    .collect();
                row.push(graph.inner_product(&components, &momenta));
            }
            bracket.push(row);
        }
        let velocity = algebroid.velocity(graph);
        let mut turning = Matrix::new();
        for residual in &geometry.residuals {
            let along = |beta: &SectionId| algebroid.anchor.along(*beta).apply(graph, *residual);
            turning.push(sections.iter().map(along).collect());
        }
        let point = Point { model, changed, number: 0 };
        let mass = point.of_matrix(&saddle.mass);
        let acceleration = solved(mass.clone(), &point.of(&saddle.force))?;
        Some(Self {
            velocity: point.of(&velocity),
            acceleration,
            jacobian: point.of_matrix(&saddle.jacobian),
            bias: point.of(&saddle.bias),
            change: point.of_matrix(&change),
            bracket: point.of_matrix(&bracket),
            turning: point.of_matrix(&turning),
            mass,
        })
    }

    /// ẏ + W⁻¹ Jᵀ λ with J ẏ = bias.
    fn along_reactions(&self) -> Vec<f64> {
        let reach: Vec<Vec<f64>> =
            self.jacobian.iter().map(|row| solved(self.mass.clone(), row).unwrap()).collect();
        let complement: Vec<Vec<f64>> =
            self.jacobian.iter().map(|row| reach.iter().map(|column| dot(row, column)).collect()).collect();
        let missing: Vec<f64> = self
            .jacobian
            .iter()
            .zip(&self.bias)
            .map(|(row, bias)| bias - dot(row, &self.acceleration))
            .collect();
        let multipliers = solved(complement, &missing).unwrap();
        let mut result = self.acceleration.clone();
        for (column, multiplier) in reach.iter().zip(multipliers) {
            result.iter_mut().zip(column).for_each(|(y, entry)| *y += multiplier * entry);
        }
        result
    }

    /// `ω(a, b)` of a = (z, w) and b: W_{αβ} 𝒳^α ∧ 𝒱^β + ½ (…) 𝒳^α ∧ 𝒳^β, CLMM (2.5).
    fn omega(&self, a: &[Vec<f64>; 2], b: &[Vec<f64>; 2]) -> f64 {
        let ([z, w], [x, v]) = (a, b);
        let mut sum = 0.0;
        for alpha in 0..z.len() {
            for beta in 0..z.len() {
                sum += self.mass[alpha][beta] * (z[alpha] * v[beta] - x[alpha] * w[beta]);
                let both = self.change[alpha][beta] - self.change[beta][alpha] + self.bracket[alpha][beta];
                sum += both * z[alpha] * x[beta];
            }
        }
        sum
    }

    /// Whether J y = 0: the Liouville vector field is tangent to the constraint manifold.
    fn is_homogeneous(&self) -> bool {
        self.jacobian.iter().all(|row| dot(row, &self.velocity).abs() < 1e-9)
    }

    /// The projection of the free motion to the tangents (z, w) of the constraint manifold with J z = 0, along
    /// their ω-complement; `None` where the constraints move with the time.
    fn symplectic(&self) -> Option<[Vec<f64>; 2]> {
        let moving = |(row, bias): (&Vec<f64>, &f64)| (dot(row, &self.velocity) + bias).abs() > 1e-9;
        if self.turning.iter().zip(&self.bias).any(moving) {
            return None;
        }
        let basis = kernel(&self.jacobian, self.velocity.len());
        let zero = vec![0.0; self.velocity.len()];
        let mut tangents: Vec<[Vec<f64>; 2]> = basis.iter().map(|w| [zero.clone(), w.clone()]).collect();
        for z in &basis {
            // J w + ρ(z)φ = 0
            let gram: Vec<Vec<f64>> =
                self.jacobian.iter().map(|a| self.jacobian.iter().map(|b| dot(a, b)).collect()).collect();
            let right: Vec<f64> = self.turning.iter().map(|row| -dot(row, z)).collect();
            let weights = solved(gram, &right)?;
            let mut w = zero.clone();
            for (row, weight) in self.jacobian.iter().zip(weights) {
                w.iter_mut().zip(row).for_each(|(w, entry)| *w += weight * entry);
            }
            tangents.push([z.clone(), w]);
        }
        let free = [self.velocity.clone(), self.acceleration.clone()];
        let matrix = tangents.iter().map(|l| tangents.iter().map(|k| self.omega(k, l)).collect()).collect();
        let right: Vec<f64> = tangents.iter().map(|l| self.omega(&free, l)).collect();
        let parts = solved(matrix, &right)?;
        let sum = |side: usize| {
            let mut sum = zero.clone();
            for (tangent, part) in tangents.iter().zip(&parts) {
                sum.iter_mut().zip(&tangent[side]).for_each(|(sum, entry)| *sum += part * entry);
            }
            sum
        };
        Some([sum(0), sum(1)])
    }
}

/// A basis of the kernel of independent rows.
fn kernel(rows: &[Vec<f64>], width: usize) -> Vec<Vec<f64>> {
    let mut rows: Vec<Vec<f64>> = rows.to_vec();
    let mut pivots: Vec<usize> = Vec::new();
    for i in 0..rows.len() {
        let column = (0..width)
            .filter(|column| !pivots.contains(column))
            .max_by(|a, b| rows[i][*a].abs().total_cmp(&rows[i][*b].abs()))
            .unwrap();
        pivots.push(column);
        let scale = rows[i][column];
        rows[i].iter_mut().for_each(|entry| *entry /= scale);
        let leading = rows[i].clone();
        for row in rows.iter_mut().enumerate().filter(|(k, _)| *k != i).map(|(_, row)| row) {
            let factor = row[column];
            row.iter_mut().zip(&leading).for_each(|(x, y)| *x -= factor * y);
        }
    }
    let free = (0..width).filter(|column| !pivots.contains(column));
    free.map(|column| {
        let mut vector = vec![0.0; width];
        vector[column] = 1.0;
        pivots.iter().zip(&rows).for_each(|(pivot, row)| vector[*pivot] = -row[column]);
        vector
    })
    .collect()
}
