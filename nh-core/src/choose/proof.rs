//! The proof that comes before admission: a form is evaluated, as it will be emitted, at points of the field,
//! and has to satisfy the declared equations there.
//!
//! Equality is asked as functions of the whole state. Points are taken until the probability that a wrong form
//! passes is below 2⁻⁸⁰: at each by its degree over the number of elements of the field (`algebra/degree.rs`),
//! and by one half only where there are roots that are not proved to be independent (`algebra/independent_roots.rs`), between
//! whose branches the field chooses by chance.

use super::ground::Ground;
use super::ledger::Proof;
use super::reference::{Balance, Instant, Reference, inner};
use crate::algebra::{
    Degrees, Echelon, FieldPass, FieldPoint, Graph, IndependentRoots, Matrix, NoValue, Radicands, Residue,
};
use crate::id::{ExprId, SymbolId};
use crate::mechanics::{Definition, Procedure, ReducedEquations};
use rustc_hash::FxHashSet;
use std::fmt;

/// The probability that something wrong passes is below 2 to the power of minus this.
const CERTAIN: f64 = 80.0;
/// log₂ of the number of elements of the field, rounded down.
const FIELD: f64 = 60.9;
/// Points tried for all that are wanted: at a pole, or where a root is not in the field, there is no value.
const PATIENCE: u64 = 1 << 15;
/// Where the points begin: the zero test, which simplification asks, takes others.
pub(super) const FIRST_SEED: u64 = 7_340_033;

/// Why something is not proved.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Defect {
    /// There is no value at this point: another may do.
    Here,
    /// It could not be decided, and why.
    Unknown(String),
    /// It is not so.
    Wrong(String),
}

impl fmt::Display for Defect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Here => f.write_str("it has no value"),
            Self::Unknown(why) => write!(f, "it could not be proved: {why}"),
            Self::Wrong(what) => f.write_str(what),
        }
    }
}

impl From<NoValue> for Defect {
    fn from(reason: NoValue) -> Self {
        match reason {
            NoValue::Here => Self::Here,
            NoValue::Ever(why) => Self::Unknown(why),
        }
    }
}

/// What is claimed of a form.
pub(crate) enum Claim<'p> {
    /// Outputs: ẋ, then the accelerations of the state, (8) or (9), then ż.
    Motion(&'p Procedure),
    /// C v̇ = f for all v̇, with f and C of (8) along the sections of the state.
    Equations(&'p ReducedEquations, &'p [(SymbolId, Vec<ExprId>)]),
    /// After a motion: λ_A of constraints with the gradients of rows, if these are known, or else the first of all.
    Multipliers(&'p Procedure, &'p Procedure, Option<&'p Matrix>),
    /// After a motion: δL_α − Υ_α.
    Reactions(&'p Procedure, &'p Procedure),
}

impl Claim<'_> {
    fn roots(&self) -> Vec<ExprId> {
        match self {
            Self::Motion(motion) => motion.expressions(),
            Self::Equations(equations, sections) => {
                let mut roots = equations.definitions.expressions();
                roots.extend(equations.mass.iter().flatten().chain(&equations.force).chain(&equations.rates));
                roots.extend(sections.iter().flat_map(|(_, section)| section));
                roots
            }
            Self::Multipliers(motion, forces, rows) => {
                let mut roots = [motion.expressions(), forces.expressions()].concat();
                roots.extend(rows.iter().flat_map(|rows| rows.iter().flatten()));
                roots
            }
            Self::Reactions(motion, forces) => [motion.expressions(), forces.expressions()].concat(),
        }
    }

    /// What it runs.
    fn procedures(&self) -> Vec<&Procedure> {
        match self {
            Self::Motion(motion) => vec![*motion],
            Self::Equations(equations, _) => vec![&equations.definitions],
            Self::Multipliers(motion, forces, _) | Self::Reactions(motion, forces) => vec![*motion, *forces],
        }
    }

    /// The symbols of its intermediate results.
    fn defined(&self) -> Vec<SymbolId> {
        match self {
            Self::Motion(motion) => defined(motion),
            Self::Equations(equations, _) => defined(&equations.definitions),
            Self::Multipliers(motion, forces, _) | Self::Reactions(motion, forces) => {
                [defined(motion), defined(forces)].concat()
            }
        }
    }

    /// A bound on the degrees of what is computed.
    fn degree(&self, degrees: &mut Degrees) -> f64 {
        match self {
            Self::Motion(motion) => motion.degree(degrees),
            Self::Equations(equations, _) => {
                equations.definitions.degree(degrees);
                let all = [equations.mass.concat(), equations.force.clone()].concat();
                let factor = f64::from(u32::try_from(all.len()).unwrap_or(u32::MAX));
                factor * (degrees.most(&all) + 1.0)
            }
            Self::Multipliers(motion, forces, _) | Self::Reactions(motion, forces) => {
                let factor = f64::from(u32::try_from(forces.outputs.len()).unwrap_or(u32::MAX));
                motion.degree(degrees).max(factor * forces.degree(degrees))
            }
        }
    }
}

/// Proves a claim.
///
/// # Errors
/// What is wrong, or why it could not be decided.
pub(crate) fn prove(graph: &Graph, reference: &Reference, claim: &Claim) -> Result<Proof, Defect> {
    let roots = [reference.roots(), claim.roots()].concat();
    let division = graph.angle_division(&roots);
    let degree = reference.degree(graph, division, claim.degree(&mut reference.degrees(graph, division)));
    let bound = [reference.determined(), claim.defined()].concat();
    let radicands = Radicands::of(graph, &reference.roots(), &reference.determined());
    let prove_on = |ground: &Ground| {
        let degree = degree * ground.degree(graph);
        let bits = bits_of_a_point(graph, (&roots, &bound), &claim.procedures(), degree, division)?;
        let point = |seed| radicands.point_in(seed, |point| FieldPass::new(graph, point, division));
        let outcome = at_points(bits, point, |point| {
            let mut instant = reference.at(graph, ground.point(graph, point)?, division)?;
            judge(&mut instant, reference, claim)
        });
        unless_roots_are_missing(graph, &roots, outcome)
    };
    let outcome = prove_on(&Ground::whole(division));
    let Err(Defect::Wrong(_)) = outcome else { return outcome };
    let Some(base) = Ground::base(graph, &roots, division) else { return outcome };
    Ok(Proof { is_on_base: true, ..prove_on(&base)? })
}

/// Proves that two procedures with the same symbols compute the same.
///
/// # Errors
/// What is wrong, or why it could not be decided.
pub(crate) fn prove_equal(graph: &Graph, one: &Procedure, other: &Procedure) -> Result<Proof, Defect> {
    let roots = [one.expressions(), other.expressions()].concat();
    let division = graph.angle_division(&roots);
    let degrees = || Degrees::new(graph, division);
    let bound = [defined(one), defined(other)].concat();
    let degree = one.degree(&mut degrees()) + other.degree(&mut degrees());
    let bits = bits_of_a_point(graph, (&roots, &bound), &[one, other], degree, division)?;
    at_points(bits, FieldPoint::random, |point| {
        let evaluate = |procedure| run(&mut FieldPass::new(graph, point.clone(), division), procedure);
        if evaluate(one)? == evaluate(other)? {
            return Ok(());
        }
        Err(Defect::Wrong("it computes something else".into()))
    })
}

/// What a point proves of a function of a degree, some of whose symbols are bound to others: log₂ of one over the
/// probability that it misses a defect.
pub(super) fn bits_of_a_point(
    graph: &Graph,
    (roots, bound): (&[ExprId], &[SymbolId]),
    procedures: &[&Procedure],
    degree: f64,
    division: i64,
) -> Result<f64, Defect> {
    let bits = bits_without_branches(degree)?;
    if !has_branches(graph, roots) {
        return Ok(bits);
    }
    let pass = |point| FieldPass::new(graph, point, division);
    let values_of_bound = |point: FieldPoint, radicands: &[ExprId]| {
        values_in(graph, (procedures, bound), (&point, division), radicands)
    };
    Ok(with_branches(bits, graph.independent_roots(roots, bound, pass, values_of_bound).as_ref()))
}

/// The values of expressions in intermediate results of procedures, each of the first that knows what is in it.
fn values_in(
    graph: &Graph,
    (procedures, bound): (&[&Procedure], &[SymbolId]),
    (point, division): (&FieldPoint, i64),
    expressions: &[ExprId],
) -> Option<Vec<Residue>> {
    let mut values = vec![None; expressions.len()];
    for procedure in procedures {
        let own: FxHashSet<SymbolId> = defined(procedure).into_iter().collect();
        let unknown: Vec<SymbolId> = bound.iter().copied().filter(|symbol| !own.contains(symbol)).collect();
        let mut pass = FieldPass::new(graph, point.clone(), division);
        run(&mut pass, procedure).ok()?;
        for (value, expression) in values.iter_mut().zip(expressions) {
            if value.is_none() && !graph.depends_on(*expression, &unknown) {
                *value = Some(pass.evaluate_one(*expression).ok()?);
            }
        }
    }
    values.into_iter().collect()
}

/// The same without regard to roots.
pub(super) fn bits_without_branches(degree: f64) -> Result<f64, Defect> {
    let bits = FIELD - degree.max(1.0).log2();
    if bits.is_nan() || bits < 1.0 {
        let reason = "its degree as a rational function is too large for the field that proofs are made in";
        return Err(Defect::Unknown(reason.into()));
    }
    Ok(bits)
}

/// What is left of it where there are roots: one bit, or more if they are proved to be independent.
pub(super) fn with_branches(bits: f64, roots: Option<&IndependentRoots>) -> f64 {
    roots.map_or(1.0, |roots| (bits - roots.bits()).max(1.0))
}

/// Whether there are functions whose value in the field depends on what is a square there.
pub(super) fn has_branches(graph: &Graph, roots: &[ExprId]) -> bool {
    graph.square_radicands(roots).is_none_or(|radicands| !radicands.is_empty())
}

/// What disagrees may be no defect where the field has no root of a number: what stands for it there has another square.
pub(super) fn unless_roots_are_missing(
    graph: &Graph,
    roots: &[ExprId],
    outcome: Result<Proof, Defect>,
) -> Result<Proof, Defect> {
    let Err(Defect::Wrong(what)) = &outcome else { return outcome };
    match graph.root_outside_field(roots) {
        Some(root) => {
            Err(Defect::Unknown(format!("{what}, or the field that proofs are made in has no {root}")))
        }
        None => outcome,
    }
}

/// Asks at points until enough of them agree.
pub(super) fn at_points(
    bits: f64,
    point: impl Fn(u64) -> FieldPoint,
    mut ask: impl FnMut(FieldPoint) -> Result<(), Defect>,
) -> Result<Proof, Defect> {
    let mut proof = Proof { points: 0, bits: 0.0, is_on_base: false };
    for seed in FIRST_SEED..FIRST_SEED + PATIENCE {
        match ask(point(seed)) {
            Ok(()) => {
                proof.points += 1;
                proof.bits += bits;
                if proof.bits >= CERTAIN {
                    return Ok(proof);
                }
            }
            Err(Defect::Here) => {}
            Err(defect) => return Err(defect),
        }
    }
    Err(Defect::Unknown(
        "it has no value at the points tried (a division by zero, or the root of a negative number)".into(),
    ))
}

fn judge(instant: &mut Instant, reference: &Reference, claim: &Claim) -> Result<(), Defect> {
    match claim {
        Claim::Motion(motion) => moves(instant, reference, motion).map(drop),
        Claim::Equations(equations, sections) => {
            run(&mut instant.pass, &equations.definitions)?;
            let n = equations.independent.len();
            let accelerations: Vec<Residue> =
                (0..n).map(|a| instant.pass.kernel("acceleration", &[Residue::of_word(a as u64)])).collect();
            let balance = instant.balance(&accelerations)?;
            for ((row, force), (velocity, section)) in
                equations.mass.iter().zip(&equations.force).zip(*sections)
            {
                let inertia = inner(&instant.pass.evaluate(row)?, &accelerations);
                let force = instant.pass.evaluate(&[*force])?[0];
                if inertia - force != instant.along(section, *velocity, &balance)? {
                    return wrong("the equation along a section is not that of the declaration");
                }
            }
            if instant.pass.evaluate(&equations.rates)? != instant.rates {
                return wrong("the rates of the coordinates are not those of the anchor");
            }
            Ok(())
        }
        Claim::Multipliers(motion, forces, rows) => {
            let balance = moves(instant, reference, motion)?;
            let values = run(&mut instant.pass, forces)?;
            let known = rows.map(|rows| {
                rows.iter().map(|row| instant.pass.evaluate(row)).collect::<Result<_, NoValue>>()
            });
            let rows: Vec<Vec<Residue>> = match known {
                Some(rows) => rows?,
                None => instant.constraints(&balance)?.0,
            };
            // Σ λ_A Φ^A_α, and what the levels add, whose reactions are not asked for
            let (declared, levels) = rows.split_at(values.len().min(rows.len()));
            let mut left = balance.unbalanced.clone();
            for (row, multiplier) in declared.iter().zip(&values) {
                for (slot, entry) in left.iter_mut().zip(row) {
                    *slot = *slot - *multiplier * *entry;
                }
            }
            if depends(levels, &left) { Ok(()) } else { wrong("the multipliers do not balance the motion") }
        }
        Claim::Reactions(motion, forces) => {
            let balance = moves(instant, reference, motion)?;
            if run(&mut instant.pass, forces)? == balance.unbalanced {
                return Ok(());
            }
            wrong("the reactions do not balance the motion")
        }
    }
}

/// Whether a procedure moves the state as the declaration says.
fn moves(instant: &mut Instant, reference: &Reference, motion: &Procedure) -> Result<Balance, Defect> {
    let outputs = run(&mut instant.pass, motion)?;
    let auxiliary = instant.auxiliary_rates();
    let (rest, moved) = outputs.split_at(outputs.len().saturating_sub(auxiliary.len()));
    if moved != auxiliary {
        return Err(Defect::Wrong("the rates of auxiliary states are not those that are declared".into()));
    }
    let (rates, accelerations) = rest.split_at(instant.rates.len().min(rest.len()));
    if rates != instant.rates || accelerations.len() != reference.state().len() {
        return Err(Defect::Wrong("the rates of the coordinates are not those of the anchor".into()));
    }
    let balance = instant.balance(accelerations)?;
    if reference.is_reduced() {
        if !instant.obeys()? {
            return Err(Defect::Wrong("the velocities do not obey the constraints".into()));
        }
        if !instant.holds_on_distribution(&balance)? {
            return Err(Defect::Wrong("the accelerations do not satisfy the declared equations".into()));
        }
        return Ok(balance);
    }
    let (jacobian, rates) = instant.constraints(&balance)?;
    if rates.iter().any(|rate| *rate != Residue::ZERO) {
        return Err(Defect::Wrong("the accelerations leave the constraints".into()));
    }
    if !depends(&jacobian, &balance.unbalanced) {
        return Err(Defect::Wrong("the accelerations do not satisfy the declared equations".into()));
    }
    Ok(balance)
}

fn wrong(what: &str) -> Result<(), Defect> {
    Err(Defect::Wrong(what.into()))
}

/// Whether a row is a combination of others.
fn depends(rows: &[Vec<Residue>], row: &[Residue]) -> bool {
    if row.iter().all(|entry| *entry == Residue::ZERO) {
        return true;
    }
    let with = rows.iter().cloned().chain([row.to_vec()]).collect();
    Echelon::of(rows.to_vec()).rank() == Echelon::of(with).rank()
}

/// The outputs of a procedure, its definitions in order.
pub(super) fn run(pass: &mut FieldPass, procedure: &Procedure) -> Result<Vec<Residue>, Defect> {
    let twice = || Defect::Wrong("an intermediate result has two values".into());
    for definition in &procedure.definitions {
        match definition {
            Definition::Value { symbol, value } => {
                let value = pass.evaluate_one(*value)?;
                if !pass.choose(*symbol, value) {
                    return Err(twice());
                }
            }
            Definition::Call { symbol, method, arguments, .. } => {
                let arguments = pass.evaluate(arguments)?;
                let value = pass.kernel(method, &arguments);
                if !pass.choose(*symbol, value) {
                    return Err(twice());
                }
            }
            Definition::Solve { unknowns, matrix, right } => {
                let rows = matrix.iter().zip(right).map(|(row, right)| {
                    let mut row = pass.evaluate(row)?;
                    row.push(pass.evaluate_one(*right)?);
                    Ok(row)
                });
                let echelon = Echelon::of(rows.collect::<Result<Vec<_>, Defect>>()?);
                if echelon.pivots.iter().copied().ne(0..unknowns.len()) {
                    return Err(Defect::Here);
                }
                for (symbol, row) in unknowns.iter().zip(&echelon.rows) {
                    if !pass.choose(*symbol, row[unknowns.len()]) {
                        return Err(twice());
                    }
                }
            }
        }
    }
    Ok(pass.evaluate(&procedure.outputs)?)
}

/// The symbols that a procedure gives values to.
pub(super) fn defined(procedure: &Procedure) -> Vec<SymbolId> {
    let mut found = Vec::new();
    for definition in &procedure.definitions {
        match definition {
            Definition::Value { symbol, .. } | Definition::Call { symbol, .. } => found.push(*symbol),
            Definition::Solve { unknowns, .. } => found.extend(unknowns),
        }
    }
    found
}

impl Procedure {
    /// All expressions in it.
    pub(crate) fn expressions(&self) -> Vec<ExprId> {
        let mut found = self.outputs.clone();
        for definition in &self.definitions {
            match definition {
                Definition::Value { value, .. } => found.push(*value),
                Definition::Call { arguments, .. } => found.extend(arguments),
                Definition::Solve { matrix, right, .. } => found.extend(matrix.iter().flatten().chain(right)),
            }
        }
        found
    }

    /// A bound on the degrees of the outputs.
    pub(super) fn degree(&self, degrees: &mut Degrees) -> f64 {
        for definition in &self.definitions {
            match definition {
                Definition::Value { symbol, value } => {
                    let degree = degrees.of(*value);
                    degrees.name(*symbol, degree);
                }
                Definition::Call { .. } => {}
                Definition::Solve { unknowns, matrix, right } => {
                    // Cramer: determinants of so many rows
                    let row_size = |degrees: &mut Degrees, (row, right): (&Vec<ExprId>, &ExprId)| -> f64 {
                        row.iter().chain([right]).map(|entry| degrees.most(&[*entry])).sum()
                    };
                    let size = matrix.iter().zip(right).map(|row| row_size(degrees, row)).sum();
                    for symbol in unknowns {
                        degrees.name_quotient(*symbol, size);
                    }
                }
            }
        }
        degrees.most(&self.outputs)
    }
}
