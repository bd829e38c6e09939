//! What forms are proved against: the equations (6), (8) and (9) of the declared L, ρ, C, Φ and Υ, as numbers
//! at points of the field.
//!
//! Nothing here is an expression that was derived. At a point (t, x, v) with accelerations v̇, the velocities
//! and their rates come from the constraints, and one gradient of L with its derivative along the motion
//! (`algebra/tangent.rs`) gives d/dt ∂L/∂y^α and ∂_iL; what is left of (6) is arithmetic.

use super::proof::Defect;
use crate::algebra::{Degrees, Direction, FieldPass, FieldPoint, Graph, Residue, TangentPass};
use crate::geometry::ConstraintDistribution;
use crate::id::{ExprId, Id, SymbolId};
use crate::mechanics::LagrangianSystem;

/// What is given along a motion, in quasi-velocities.
#[derive(Clone, Debug)]
pub(crate) enum Given {
    /// The result of a method of the user's.
    Call { symbol: SymbolId, method: String, arguments: Vec<ExprId>, derivatives: Option<Vec<String>> },
    /// The rate ż of an auxiliary state.
    Rate { symbol: SymbolId, value: ExprId },
}

impl Given {
    /// What stands for it.
    pub(crate) fn symbol(&self) -> SymbolId {
        match self {
            Self::Call { symbol, .. } | Self::Rate { symbol, .. } => *symbol,
        }
    }

    /// What it is made of.
    pub(crate) fn roots(&self) -> Vec<ExprId> {
        match self {
            Self::Call { arguments, .. } => arguments.clone(),
            Self::Rate { value, .. } => vec![*value],
        }
    }
}

/// The velocities of the state, and those that follow.
#[derive(Clone, Debug)]
pub(crate) struct Velocities {
    /// The velocities v of the state.
    pub(crate) state: Vec<SymbolId>,
    /// y in terms of them.
    pub(crate) all: Vec<ExprId>,
    /// Further velocities with a symbol, in terms of them.
    pub(crate) determined: Vec<(SymbolId, ExprId)>,
    /// Sections of D by their components, with the velocities along which forces act on D alone.
    pub(crate) sections: Vec<(SymbolId, Vec<ExprId>)>,
}

/// The declared equations.
#[derive(Clone, Debug)]
pub(crate) struct Reference {
    system: LagrangianSystem,
    given: Vec<Given>,
    /// φ^A(t, x, y, z), and the momenta on levels less these.
    residuals: Vec<ExprId>,
    velocities: Velocities,
    /// Whether the equations are those on D.
    reduced: bool,
}

/// The declared data at one point.
#[derive(Clone)]
pub(crate) struct Instant<'a, 's> {
    reference: &'s Reference,
    /// Evaluates forms at the point: the data are known to it.
    pub(crate) pass: FieldPass<'a>,
    y: Vec<Residue>,
    /// ẋ^i = ρ^i_α y^α.
    pub(crate) rates: Vec<Residue>,
    /// The time and the auxiliary states, with their rates.
    clock: Vec<(SymbolId, Residue)>,
}

/// δL_α − Υ_α for some accelerations, and the rates of y that they mean.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Balance {
    /// δL_α − Υ_α.
    pub(crate) unbalanced: Vec<Residue>,
    /// ẏ.
    rates: Vec<Residue>,
}

impl Reference {
    /// On D, in a basis: (8). `full` is D, `kept` what levels of momenta leave of it.
    pub(crate) fn adapted(
        system: &LagrangianSystem,
        given: Vec<Given>,
        residuals: Vec<ExprId>,
        full: &ConstraintDistribution,
        kept: &ConstraintDistribution,
    ) -> Self {
        let sections = full.independent.iter().copied().zip(full.sections()).collect();
        let velocities = Velocities {
            state: kept.independent.clone(),
            all: kept.velocity.clone(),
            determined: kept.eliminated.clone(),
            sections,
        };
        Self { system: system.clone(), given, residuals, velocities, reduced: true }
    }

    /// The symbols whose values follow from others: velocities, and what is given.
    pub(crate) fn determined(&self) -> Vec<SymbolId> {
        let Velocities { state, determined, .. } = &self.velocities;
        let velocities = self.system.algebroid.velocities.iter().chain(state).copied();
        let others = determined.iter().map(|(symbol, _)| *symbol);
        velocities.chain(others).chain(self.given.iter().map(Given::symbol)).collect()
    }

    /// On all of E, with multipliers: (9).
    pub(crate) fn projected(
        graph: &mut Graph,
        system: &LagrangianSystem,
        given: Vec<Given>,
        residuals: Vec<ExprId>,
    ) -> Self {
        let (state, all) = (system.algebroid.velocities.clone(), system.algebroid.velocity(graph));
        let velocities = Velocities { state, all, determined: Vec::new(), sections: Vec::new() };
        Self { system: system.clone(), given, residuals, velocities, reduced: false }
    }

    /// All expressions that the equations are made of.
    pub(crate) fn roots(&self) -> Vec<ExprId> {
        let LagrangianSystem { algebroid, lagrangian, forces, forces_on_distribution, .. } = &self.system;
        let mut roots = vec![*lagrangian];
        roots.extend(algebroid.anchor.entries.iter().flatten().chain(forces));
        roots.extend(algebroid.structure.terms().map(|(.., component)| component));
        roots.extend(forces_on_distribution.iter().map(|(_, force)| force));
        roots.extend(self.given.iter().flat_map(Given::roots).chain(self.residuals.iter().copied()));
        let Velocities { all, determined, sections, .. } = &self.velocities;
        roots.extend(all.iter().chain(determined.iter().map(|(_, value)| value)));
        roots.extend(sections.iter().flat_map(|(_, section)| section));
        roots
    }

    /// Velocities of the declaration and those that constraints determine, with what they are in those of the state.
    fn velocities_by_the_state(&self) -> impl Iterator<Item = (SymbolId, ExprId)> {
        let Velocities { all, determined, .. } = &self.velocities;
        let declared = self.system.algebroid.velocities.iter().copied();
        determined.iter().copied().chain(declared.zip(all.iter().copied()))
    }

    /// Bounds on degrees where velocities and rates stand for what they are made of, as they do at points.
    pub(crate) fn degrees<'g>(&self, graph: &'g Graph, division: i64) -> Degrees<'g> {
        let rates = self.given.iter().filter_map(|given| match given {
            Given::Rate { symbol, value } => Some((*symbol, *value)),
            Given::Call { .. } => None,
        });
        Degrees::with_images(graph, division, self.velocities_by_the_state().chain(rates))
    }

    /// A bound on the degree of (6) along sections, for accelerations of a degree.
    pub(crate) fn degree(&self, graph: &Graph, division: i64, accelerations: f64) -> f64 {
        let mut degrees = self.degrees(graph, division);
        let LagrangianSystem { algebroid, lagrangian, forces, forces_on_distribution, clock } = &self.system;
        let s = count(algebroid.rank());
        let n = count(algebroid.anchor.coordinates.len() + clock.auxiliary.len());
        // 1. of functions on E as such
        let lagrangian = degrees.most(&[*lagrangian]);
        let anchor = degrees.most(&algebroid.anchor.entries.concat());
        let brackets: Vec<ExprId> = algebroid.structure.terms().map(|(.., component)| component).collect();
        let brackets = if brackets.is_empty() { 0.0 } else { degrees.most(&brackets) };
        let mut given = 0.0;
        for rate in &self.given {
            if let Given::Rate { symbol, value } = rate {
                let degree = degrees.of(*value);
                degrees.name(*symbol, degree);
                given = degrees.most(&[*value]).max(given);
            }
        }
        let mut forces = forces.clone();
        forces.extend(forces_on_distribution.iter().map(|(_, force)| *force));
        let force = degrees.most(&forces);
        let mut residual = 0.0;
        if !self.residuals.is_empty() {
            residual = degrees.most(&self.residuals);
        }
        let sections: Vec<ExprId> =
            self.velocities.sections.iter().flat_map(|(_, section)| section.iter().copied()).collect();
        let section = degrees.most(&sections);
        // 2. at y: each of its velocities has the degree of the longest
        let y = degrees.most(&self.velocities.all);
        let x_dot = (s * (anchor + y)).max(given * y);
        let y_dot = (n + s) * (2.0 * y + x_dot.max(accelerations));
        // 3. second derivatives of L along the motion, brackets, forces; the constraints' gradient
        let second = (n + s) * (4.0 * lagrangian * y + x_dot.max(y_dot));
        let bracket = if brackets == 0.0 { 0.0 } else { s * s * (brackets + y + 2.0 * lagrangian * y) };
        let gradient = n * (anchor + 2.0 * lagrangian * y);
        let balance = second + bracket + gradient + force * y;
        let pulled = 4.0 * (residual * y) * (n + s + accelerations);
        s * (section + balance) + pulled
    }

    /// The data at a random point.
    ///
    /// # Errors
    /// Where there are none, or where the velocities do not obey the constraints.
    pub(crate) fn at<'a, 's>(
        &'s self,
        graph: &'a Graph,
        point: FieldPoint,
        division: i64,
    ) -> Result<Instant<'a, 's>, Defect> {
        let mut pass = FieldPass::new(graph, point, division);
        let algebroid = &self.system.algebroid;
        // 1. y, and what is called with it
        let y = pass.evaluate(&self.velocities.all)?;
        let determined: Vec<ExprId> = self.velocities.determined.iter().map(|(_, value)| *value).collect();
        pass.evaluate(&determined)?;
        for (symbol, image) in self.velocities_by_the_state() {
            if !pass.choose_image(symbol, image) {
                return Err(Defect::Wrong("a velocity has two values".into()));
            }
        }
        let mut values = Vec::with_capacity(self.given.len());
        for given in &self.given {
            let (value, is_one, what) = match given {
                Given::Call { method, arguments, .. } => {
                    let arguments = pass.evaluate(arguments)?;
                    let value = pass.kernel(method, &arguments);
                    (value, pass.choose(given.symbol(), value), format!("`{method}`"))
                }
                Given::Rate { symbol, value } => {
                    let computed = pass.evaluate(&[*value])?[0];
                    (
                        computed,
                        pass.choose_image(*symbol, *value),
                        "the rate of an auxiliary state".to_owned(),
                    )
                }
            };
            if !is_one {
                return Err(Defect::Wrong(format!("{what} has two values")));
            }
            values.push((given.symbol(), value));
        }
        // rates are given in the order in which they can be computed, and stand in that of the declaration
        let clock = &self.system.clock;
        let auxiliary = clock.auxiliary.iter().filter_map(|(state, rate)| {
            let (_, value) = values.iter().find(|(symbol, _)| symbol == rate)?;
            Some((*state, *value))
        });
        let moving = [(clock.time, Residue::ONE)].into_iter().chain(auxiliary).collect();
        // 2. ẋ = ρ y
        let rates = algebroid.anchor.entries.iter().map(|row| Ok(inner(&pass.evaluate(row)?, &y)));
        let rates = rates.collect::<Result<Vec<Residue>, Defect>>()?;
        Ok(Instant { reference: self, pass, y, rates, clock: moving })
    }

    /// The declared system.
    pub(crate) fn system(&self) -> &LagrangianSystem {
        &self.system
    }

    /// φ^A, and the momenta on levels less these.
    pub(crate) fn residuals(&self) -> &[ExprId] {
        &self.residuals
    }

    /// y in terms of the velocities of the state.
    pub(crate) fn all_velocities(&self) -> &[ExprId] {
        &self.velocities.all
    }

    /// Sections that span D, where the state is over them.
    pub(crate) fn sections(&self) -> Option<&[(SymbolId, Vec<ExprId>)]> {
        self.reduced.then_some(self.velocities.sections.as_slice())
    }

    /// The velocities v of the state.
    pub(crate) fn state(&self) -> &[SymbolId] {
        &self.velocities.state
    }

    /// Whether the equations are those on D, (8).
    pub(crate) fn is_reduced(&self) -> bool {
        self.reduced
    }
}

impl Instant<'_, '_> {
    /// Whether y obeys the constraints and the levels, as it does on D by construction.
    pub(crate) fn obeys(&mut self) -> Result<bool, Defect> {
        let values = self.pass.evaluate(&self.reference.residuals)?;
        Ok(values.into_iter().all(|value| value == Residue::ZERO))
    }

    /// y.
    pub(crate) fn velocity(&self) -> &[Residue] {
        &self.y
    }

    /// The rates ż of auxiliary states, in the order of their declaration.
    pub(crate) fn auxiliary_rates(&self) -> Vec<Residue> {
        self.clock[1..].iter().map(|(_, rate)| *rate).collect()
    }

    /// E_L = y^α ∂L/∂y^α − L.
    pub(crate) fn energy(&mut self) -> Result<Residue, Defect> {
        let LagrangianSystem { algebroid, lagrangian, .. } = &self.reference.system;
        let mut pass = TangentPass::new(&mut self.pass, Direction::default());
        let momenta = pass.gradient(*lagrangian, &algebroid.velocities)?;
        let momenta: Vec<Residue> = momenta.into_iter().map(|dual| dual.value).collect();
        Ok(inner(&momenta, &self.y) - self.pass.evaluate(&[*lagrangian])?[0])
    }

    /// The direction of the motion with given accelerations of the state.
    fn direction(&mut self, accelerations: &[Residue]) -> Result<(Direction, Vec<Residue>), Defect> {
        let LagrangianSystem { algebroid, .. } = &self.reference.system;
        let Velocities { state, all, .. } = &self.reference.velocities;
        let mut direction: Direction =
            algebroid.anchor.coordinates.iter().copied().zip(self.rates.iter().copied()).collect();
        direction.extend(self.clock.iter().copied());
        direction.extend(state.iter().copied().zip(accelerations.iter().copied()));
        // ẏ along it: in a basis, Ḃ v + B v̇ + ẏ₀ with ∂_z(·) ż
        let duals = TangentPass::new(&mut self.pass, direction.clone()).duals(all)?;
        let rates: Vec<Residue> = duals.into_iter().map(|dual| dual.rate).collect();
        direction.extend(algebroid.velocities.iter().copied().zip(rates.iter().copied()));
        Ok((direction, rates))
    }

    /// δL_α − Υ_α at given accelerations of the state: mathematics (6), CLMM (2.7).
    pub(crate) fn balance(&mut self, accelerations: &[Residue]) -> Result<Balance, Defect> {
        let LagrangianSystem { algebroid, lagrangian, forces, .. } = &self.reference.system;
        let (direction, rates) = self.direction(accelerations)?;
        // 1. p_α with d/dt p_α, and ∂_iL
        let symbols = [algebroid.velocities.as_slice(), &algebroid.anchor.coordinates].concat();
        let gradient = TangentPass::new(&mut self.pass, direction).gradient(*lagrangian, &symbols)?;
        let (momenta, slopes) = gradient.split_at(algebroid.rank());
        let mut unbalanced: Vec<Residue> = momenta.iter().map(|momentum| momentum.rate).collect();
        // 2. C^γ_{αβ} y^β p_γ
        for (alpha, beta, gamma, component) in algebroid.structure.terms() {
            let along = self.pass.evaluate(&[component])?[0] * momenta[gamma.index()].value;
            let (alpha, beta) = (alpha.index(), beta.index());
            unbalanced[alpha] = unbalanced[alpha] + along * self.y[beta];
            unbalanced[beta] = unbalanced[beta] - along * self.y[alpha];
        }
        // 3. − ρ^i_α ∂_iL
        for (row, slope) in algebroid.anchor.entries.iter().zip(slopes) {
            for (slot, entry) in unbalanced.iter_mut().zip(self.pass.evaluate(row)?) {
                *slot = *slot - entry * slope.value;
            }
        }
        // 4. − Υ_α
        for (slot, force) in unbalanced.iter_mut().zip(self.pass.evaluate(forces)?) {
            *slot = *slot - force;
        }
        Ok(Balance { unbalanced, rates })
    }

    /// B^α (δL − Υ)_α − Υ_B along a section of D, with the forces that act along it on D alone.
    pub(crate) fn along(
        &mut self,
        section: &[ExprId],
        velocity: SymbolId,
        balance: &Balance,
    ) -> Result<Residue, Defect> {
        let mut along = inner(&self.pass.evaluate(section)?, &balance.unbalanced);
        for force in self.reference.system.forces_along(velocity) {
            along = along - self.pass.evaluate(&[force])?[0];
        }
        Ok(along)
    }

    /// Whether all of (8) holds: along every section of D.
    pub(crate) fn holds_on_distribution(&mut self, balance: &Balance) -> Result<bool, Defect> {
        for (velocity, section) in &self.reference.velocities.sections {
            if self.along(section, *velocity, balance)? != Residue::ZERO {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// J = ∂φ/∂y, a row for each constraint, and dφ/dt along the motion with given ẏ.
    pub(crate) fn constraints(
        &mut self,
        balance: &Balance,
    ) -> Result<(Vec<Vec<Residue>>, Vec<Residue>), Defect> {
        let LagrangianSystem { algebroid, .. } = &self.reference.system;
        let (clock, clock_rates): (Vec<SymbolId>, Vec<Residue>) = self.clock.iter().copied().unzip();
        let symbols = [algebroid.velocities.as_slice(), &algebroid.anchor.coordinates, &clock].concat();
        let motion = [balance.rates.as_slice(), &self.rates, &clock_rates].concat();
        let (mut jacobian, mut rates) = (Vec::new(), Vec::new());
        for residual in &self.reference.residuals {
            let mut pass = TangentPass::new(&mut self.pass, Direction::default());
            let row = pass.gradient(*residual, &symbols)?;
            let mut row: Vec<Residue> = row.into_iter().map(|dual| dual.value).collect();
            rates.push(inner(&row, &motion));
            row.truncate(algebroid.rank());
            jacobian.push(row);
        }
        Ok((jacobian, rates))
    }
}

/// Σ a b.
pub(crate) fn inner(a: &[Residue], b: &[Residue]) -> Residue {
    a.iter().zip(b).fold(Residue::ZERO, |sum, (a, b)| sum + *a * *b)
}

#[allow(clippy::cast_precision_loss, reason = "a bound on a degree")]
fn count(n: usize) -> f64 {
    n as f64
}
