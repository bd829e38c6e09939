//! The constraints: independent, and fewer than the sections. Linear, affine and nonlinear ones are
//! told apart here.

use super::assumptions::{as_on_the_base, on_the_base};
use super::dependence::{dependent_rows, where_they_hold};
use super::empty_entries::{Equation, empty_entries, told};
use super::evidence::{name_of, shown};
use super::kinematics::Motion;
use super::no_force::constraint_without_force;
use super::parts_of_positions::dependent_on_part;
use super::positions::Positions;
use crate::algebra::{Demand, Facts, Graph, Matrix, NotLinear};
use crate::geometry::{Algebroid, ConstraintDistribution, LinearConstraints, Manifold, Rank, RankSetting};
use crate::id::{ConstraintId, ExprId, Id, Origin, SectionId, SymbolId, Table};
use crate::model::{ConstraintDecl, Model};
use crate::violation::{Law, Violation};

/// Constraints φ^A(t, x, y) = 0, proved independent.
#[derive(Clone, Debug)]
pub struct Constraints {
    /// φ^A, in quasi-velocities.
    pub residuals: Vec<ExprId>,
    /// Φ and b, if every constraint is linear or affine.
    pub linear: Option<LinearConstraints>,
    /// The embedded base, and the constraint manifold over it where it is known already.
    base: Manifold,
    known: Option<Manifold>,
    /// Entries of vector equations that say nothing: for the report.
    pub dropped: Vec<String>,
}

impl Constraints {
    /// D spanned by sections, on an embedded base.
    #[must_use]
    pub fn spanned(
        graph: &mut Graph,
        base: &Manifold,
        distribution: &ConstraintDistribution,
        velocities: &[SymbolId],
    ) -> Self {
        let images = velocities.iter().copied().zip(distribution.velocity.iter().copied());
        let mut manifold = Manifold::of_images(graph, images);
        manifold.extend(graph, base);
        let linear = Some(distribution.constraints.clone());
        Self { residuals: Vec::new(), linear, base: base.clone(), known: Some(manifold), dropped: Vec::new() }
    }

    /// D by velocities that the constraints determine at most points, for questions whose answer is
    /// the same at all of them. `None` for nonlinear constraints.
    pub fn generic_distribution(
        &self,
        graph: &mut Graph,
        velocities: &[SymbolId],
    ) -> Option<ConstraintDistribution> {
        let linear = self.linear.as_ref()?;
        let rows = self.generic().restrict_matrix(graph, &linear.annihilator);
        let dependent = graph.independent_columns(&rows).ok()?;
        let dependent: Vec<SectionId> = dependent.into_iter().map(SectionId::from_index).collect();
        ConstraintDistribution::solved_for(graph, linear.clone(), &dependent, velocities)
    }

    /// The constraint manifold over the embedded base.
    pub fn manifold(&self, graph: &mut Graph, velocities: &[SymbolId]) -> Manifold {
        if let Some(known) = &self.known {
            return known.clone();
        }
        // linear constraints that are independent can be solved for velocities
        solved_over(graph, &self.base, &self.residuals, velocities).unwrap_or_else(|_| self.base.clone())
    }

    /// The rank of ∂φ/∂y where the constraints hold, or of the sections that span D, and where it drops:
    /// there they are dependent.
    pub fn rank(
        &self,
        model: &mut Model,
        algebroid: &Algebroid,
        spanned: Option<&ConstraintDistribution>,
        facts: &Facts,
    ) -> Option<Rank> {
        let parameters: Vec<SymbolId> = model.parameters.iter().map(|parameter| parameter.symbol).collect();
        let jacobian = match (&self.linear, spanned) {
            (_, Some(spanned)) => spanned.basis.clone(),
            (Some(linear), None) => linear.annihilator.clone(),
            (None, None) => fibre_jacobian(model, algebroid, &self.residuals),
        };
        if jacobian.is_empty() {
            return None;
        }
        let mut holding = on_the_base(model);
        holding.extend(model.positions.iter().map(|position| (position.value, Demand::Zero)));
        // the coefficients of linear constraints have no velocities
        if self.linear.is_none() {
            holding.extend(self.residuals.iter().map(|residual| (*residual, Demand::Zero)));
        }
        let setting = RankSetting {
            holding: &holding,
            manifold: self.generic(),
            residuals: &self.residuals,
            facts,
            parameters: &parameters,
        };
        setting.rank(&mut model.graph, &jacobian).ok()
    }

    /// The embedded base.
    #[must_use]
    pub fn base(&self) -> &Manifold {
        &self.base
    }

    /// Where matrices are regular that depend on velocities only as the constraints do: the
    /// embedded base for linear constraints, the constraint manifold for nonlinear ones.
    #[must_use]
    pub fn generic(&self) -> &Manifold {
        self.known.as_ref().unwrap_or(&self.base)
    }

    /// The same, where it is found that parts of it cannot be asked.
    pub(crate) fn generic_mut(&mut self) -> &mut Manifold {
        self.known.as_mut().unwrap_or(&mut self.base)
    }
}

/// One constraint, taken apart as far as it can be.
enum Shape {
    Affine(Vec<ExprId>, ExprId),
    Nonlinear,
}

/// Reads the constraints and proves them independent on the constraint manifold.
///
/// # Errors
/// Constraints without velocities, dependent or inconsistent ones, and as many as there are
/// sections.
pub fn constraints(
    model: &mut Model,
    motion: &mut Motion,
    algebroid: &Algebroid,
    positions: &Positions,
) -> Result<Constraints, Vec<Violation>> {
    let base = &positions.manifold;
    let mut asked = base.clone();
    let mut shapes = Vec::new();
    let mut violations = Vec::new();
    let (residuals, dropped) = in_quasi_velocities(model, motion, positions);
    for (id, residual) in model.constraints.ids().zip(residuals.iter().copied()) {
        match shape(model, algebroid, base, id, residual) {
            Ok(shape) => shapes.push(shape),
            Err(violation) => violations.push(violation),
        }
    }
    if !violations.is_empty() {
        return Err(violations);
    }
    let linear = all_affine(shapes);
    // linear ones before they are solved, so that a contradiction is shown as a combination
    if let Some(linear) = &linear {
        let dependent = dependent_rows(model, &linear.annihilator, Some(&linear.drift), &mut asked);
        violations.extend(dependent.or_else(|| {
            positions.part.as_ref()?;
            dependent_on_part(model, &positions.where_unsolved(), &linear.annihilator)
        }));
        if !violations.is_empty() {
            return Err(violations);
        }
    }
    let mut known = None;
    if linear.is_none() {
        if let Some(violation) = without_real_point(model, algebroid, &residuals) {
            return Err(vec![violation]);
        }
        let jacobian = fibre_jacobian(model, algebroid, &residuals);
        if let Some(violation) = constraint_without_force(model, algebroid, &residuals) {
            return Err(vec![violation]);
        }
        let mut manifold = constraint_manifold(model, algebroid, base, &residuals).map_err(|v| vec![v])?;
        let mut demands = where_they_hold(model);
        demands.extend(residuals.iter().map(|residual| (*residual, Demand::Zero)));
        manifold.keep_parts_with_points(&mut model.graph, &demands);
        violations.extend(dependent_rows(model, &jacobian, None, &mut manifold));
        known = Some(manifold);
    }
    if violations.is_empty()
        && !model.constraints.is_empty()
        && model.constraints.len() >= model.sections.len()
    {
        violations.push(too_many(model));
    }
    if violations.is_empty() {
        Ok(Constraints { residuals, linear, base: asked, known, dropped })
    } else {
        Err(violations)
    }
}

/// φ^A in quasi-velocities, without the entries of vector equations that are 0 = 0, and what is said of these.
fn in_quasi_velocities(
    model: &mut Model,
    motion: &mut Motion,
    positions: &Positions,
) -> (Vec<ExprId>, Vec<String>) {
    let declared: Vec<ConstraintDecl> = model.constraints.iter().cloned().collect();
    let equations = declared.iter().map(|constraint| Equation {
        value: motion.rates.apply(&mut model.graph, constraint.residual),
        is_entry: constraint.is_entry,
        origin: constraint.origin,
    });
    let equations: Vec<Equation> = equations.collect();
    // the rates of position constraints stand first, and those have been looked at
    let rates = model.positions.len();
    let mut empty = vec![false; rates];
    empty.extend(empty_entries(&mut model.graph, &positions.manifold, &equations[rates..]));
    let ids = model.constraints.ids().zip(&empty).filter(|(_, is_empty)| **is_empty);
    let dropped: Vec<String> = ids.map(|(id, _)| told(&name_of(model, id))).collect();
    let mut kept = Table::new();
    let mut residuals = Vec::new();
    for ((constraint, equation), _) in
        declared.into_iter().zip(equations).zip(empty).filter(|(_, empty)| !empty)
    {
        kept.push(constraint);
        residuals.push(equation.value);
    }
    model.constraints = kept;
    (residuals, dropped)
}

fn all_affine(shapes: Vec<Shape>) -> Option<LinearConstraints> {
    let mut linear = LinearConstraints { annihilator: Vec::new(), drift: Vec::new() };
    for shape in shapes {
        let Shape::Affine(row, drift) = shape else { return None };
        linear.annihilator.push(row);
        linear.drift.push(drift);
    }
    Some(linear)
}

/// J^A_α = ∂φ^A/∂y^α.
fn fibre_jacobian(model: &mut Model, algebroid: &Algebroid, residuals: &[ExprId]) -> Matrix {
    let graph = &mut model.graph;
    residuals
        .iter()
        .map(|residual| algebroid.velocities.iter().map(|symbol| graph.partial(*residual, *symbol)).collect())
        .collect()
}

/// Where functions vanish over the embedded base.
fn solved_over(
    graph: &mut Graph,
    base: &Manifold,
    residuals: &[ExprId],
    velocities: &[SymbolId],
) -> Result<Manifold, usize> {
    let (mut found, mut refused) = (Vec::new(), Vec::new());
    for part in base.parts() {
        match solved_over_part(graph, part, residuals, velocities) {
            Ok(manifold) => found.push(manifold),
            Err(index) => refused.push((part, index)),
        }
    }
    let mut parts = found.into_iter();
    let Some(mut manifold) = parts.next() else { return Err(refused[0].1) };
    for part in parts {
        manifold.add_parts(&part);
    }
    manifold.add_open_parts(graph, base, refused.iter().map(|(part, _)| *part), residuals);
    Ok(manifold)
}

/// The same over one part of the base.
fn solved_over_part(
    graph: &mut Graph,
    base: &Manifold,
    declared: &[ExprId],
    velocities: &[SymbolId],
) -> Result<Manifold, usize> {
    let mut unknowns: Vec<SymbolId> = graph
        .symbols_in(declared)
        .into_iter()
        .filter(|symbol| !velocities.contains(symbol) && base.is_free(*symbol))
        .collect();
    unknowns.extend(velocities);
    // on the base: what vanishes there is no pivot
    let residuals: Vec<ExprId> = declared.iter().map(|residual| base.restrict(graph, *residual)).collect();
    let solved = Manifold::where_zero(graph, &residuals, velocities)
        .or_else(|_| Manifold::where_zero(graph, &residuals, &unknowns))?;
    let mut manifold = base.alone();
    // before what the base puts for its coordinates
    manifold.note_roots_of(graph, declared);
    manifold.extend(graph, &solved);
    Ok(manifold)
}

/// Where the constraints hold over the embedded base: solved for velocities, or else for whatever
/// else they can be solved for, since claims are about all parameters.
fn constraint_manifold(
    model: &mut Model,
    algebroid: &Algebroid,
    base: &Manifold,
    residuals: &[ExprId],
) -> Result<Manifold, Violation> {
    let graph = &mut model.graph;
    match solved_over(graph, base, residuals, &algebroid.velocities) {
        Ok(manifold) => Ok(manifold),
        Err(index) => {
            let id = ConstraintId::from_index(index);
            if let Some((_, violation)) = contradiction(model, algebroid, residuals, id) {
                return Err(violation);
            }
            Err(Violation {
                law: Law::Decidable,
                origin: model.constraints[id].origin,
                what: format!(
                    "no points that satisfy {} could be found, so nothing can be proved there",
                    name_of(model, id)
                ),
                evidence: format!(
                    "{} = 0 could not be solved by a division or a square root that leaves out none of its solutions",
                    shown(&model.graph, residuals[index])
                ),
                way_out: "write it as a polynomial of first or second degree in a velocity that the constraints before it \
                          leave free, without factors that vanish by themselves"
                    .into(),
            })
        }
    }
}

/// A constraint that holds at no real point at which those before it do, on the base and for parameters as they are
/// assumed.
fn without_real_point(model: &mut Model, algebroid: &Algebroid, residuals: &[ExprId]) -> Option<Violation> {
    let mut demands = on_the_base(model);
    demands.extend(model.positions.iter().map(|position| (position.value, Demand::Zero)));
    for (index, residual) in residuals.iter().enumerate() {
        demands.push((*residual, Demand::Zero));
        if model.graph.contradiction(&demands).is_none() {
            continue;
        }
        let own: Vec<(ExprId, Demand)> =
            residuals[..=index].iter().map(|residual| (*residual, Demand::Zero)).collect();
        let there = match model.graph.contradiction(&own) {
            Some(_) => "",
            None => as_on_the_base(model),
        };
        let id = ConstraintId::from_index(index);
        // what is left of it is shown in the words of the declaration, or not at all
        if index > 0
            && let Some((left_over, violation)) = contradiction(model, algebroid, residuals, id)
            && {
                let declared = model.graph.symbols_in(residuals);
                model.graph.symbols_in(&[left_over]).iter().all(|symbol| declared.contains(symbol))
            }
        {
            return Some(violation);
        }
        let what = match (index, there) {
            (0, "") => format!("{} holds nowhere: its two sides are never equal", name_of(model, id)),
            (0, _) => format!("{} holds nowhere", name_of(model, id)),
            _ => format!("{} contradicts the constraints before it", name_of(model, id)),
        };
        return Some(Violation {
            law: Law::Independence,
            origin: model.constraints[id].origin,
            what,
            evidence: format!(
                "no real velocities satisfy {} = 0{}{there}",
                shown(&model.graph, *residual),
                if index == 0 { "" } else { " together with those" }
            ),
            way_out: "change or leave out one of them".into(),
        });
    }
    None
}

/// A constraint that holds nowhere that those before it do, with what is left of it there.
fn contradiction(
    model: &mut Model,
    algebroid: &Algebroid,
    residuals: &[ExprId],
    id: ConstraintId,
) -> Option<(ExprId, Violation)> {
    let graph = &mut model.graph;
    let earlier = Manifold::where_zero(graph, &residuals[..id.index()], &algebroid.velocities).ok()?;
    let left_over = earlier.restrict(graph, residuals[id.index()]);
    let left_over = graph.simplify(left_over);
    let violation = |model: &Model| Violation {
        law: Law::Independence,
        origin: model.constraints[id].origin,
        what: format!("{} contradicts the constraints before it", name_of(model, id)),
        evidence: format!("where those hold, it says {} = 0", shown(&model.graph, left_over)),
        way_out: "change or leave out one of them".into(),
    };
    let is_contradictory = graph.contradiction(&[(left_over, Demand::Zero)]).is_some();
    is_contradictory.then(|| (left_over, violation(model)))
}

fn shape(
    model: &mut Model,
    algebroid: &Algebroid,
    base: &Manifold,
    id: ConstraintId,
    residual: ExprId,
) -> Result<Shape, Violation> {
    let origin = model.constraints[id].origin;
    let name = name_of(model, id);
    let graph = &mut model.graph;
    if base.zero_test(graph, residual).is_zero() {
        return Err(Violation {
            law: Law::Constraint,
            origin,
            what: format!("{name} says nothing: its two sides are equal"),
            evidence: String::new(),
            way_out: "leave it out".into(),
        });
    }
    if graph.contradiction(&[(residual, Demand::Zero)]).is_some() {
        return Err(Violation {
            law: Law::Constraint,
            origin,
            what: format!("{name} holds nowhere: its two sides are never equal"),
            evidence: format!("{} should be 0, and is not at any real values", shown(graph, residual)),
            way_out: "correct it, or leave it out".into(),
        });
    }
    let form = match graph.linear_form(residual, &algebroid.velocities) {
        Ok(form) => form,
        Err(NotLinear::Curved(..)) => return Ok(Shape::Nonlinear),
        Err(NotLinear::Unknown(why)) => {
            return Err(Violation {
                law: Law::Decidable,
                origin,
                what: format!("whether {name} is linear in the velocities could not be decided"),
                evidence: why,
                way_out: "write it as a polynomial in the velocities".into(),
            });
        }
    };
    if form.coefficients.iter().all(|coefficient| base.zero_test(graph, *coefficient).is_zero()) {
        return Err(position_constraint(model, algebroid, residual, &name, origin));
    }
    let mut row = Vec::with_capacity(form.coefficients.len());
    for coefficient in form.coefficients {
        // differences of angles first: the addition theorems make long sums long
        let coefficient = graph.products_to_sums(coefficient);
        row.push(graph.simplify(coefficient));
    }
    let drift = if graph.zero_test(form.rest).is_zero() { graph.zero() } else { graph.simplify(form.rest) };
    Ok(Shape::Affine(row, drift))
}

/// A constraint on the base alone: its derivative is what a velocity constraint would say.
fn position_constraint(
    model: &mut Model,
    algebroid: &Algebroid,
    residual: ExprId,
    name: &str,
    origin: Origin,
) -> Violation {
    let clock = model.clock();
    let graph = &mut model.graph;
    let velocity = algebroid.velocity(graph);
    let derivative = algebroid.along(graph, &velocity, &clock).apply(graph, residual);
    let derivative = graph.simplify(derivative);
    let vanishes = graph.zero_test(derivative).is_zero();
    let (what, evidence, way_out) = if vanishes {
        (
            format!("{name} constrains nothing that moves"),
            format!("{} is the same at all times: it is 0 always or never", shown(graph, residual)),
            "leave it out; a fact about parameters belongs in `assume`".to_owned(),
        )
    } else {
        (
            format!("{name} has no velocities in it: it constrains positions"),
            format!("its derivative is {} = 0", shown(graph, derivative)),
            "write it in `holonomic`: its derivative follows there, and motions are kept where it holds"
                .to_owned(),
        )
    };
    Violation { law: Law::Constraint, origin, what, evidence, way_out }
}

fn too_many(model: &Model) -> Violation {
    let last = model.constraints.iter().last().map_or(model.origin, |constraint| constraint.origin);
    let (constraints, sections) = (model.constraints.len(), model.sections.len());
    Violation {
        law: Law::Independence,
        origin: last,
        what: format!(
            "as many independent constraints as sections ({constraints} of {sections}): no velocity is left free"
        ),
        evidence: "the constraint distribution has rank 0".into(),
        way_out: "leave a constraint out, or add the velocities that it leaves free".into(),
    }
}
