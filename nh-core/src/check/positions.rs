//! Position constraints f(t, x) = 0: the manifold N where they hold, and that each of them says something
//! there that the others do not.

use super::assumptions::on_the_base;
use super::dependence::{ONE_PART, PARTS, combination_shown, place_of, where_they_hold};
use super::empty_entries::{Equation, empty_entries, told};
use super::evidence::{listed, name_of, shown};
use super::kinematics::Motion;
use super::no_force::{position_without_force, touching_as_multiples, touching_each_other};
use super::parts_of_positions::{
    LesserPart, Unsolved, does_not_follow, on_all_parts, part_of_positions, rates_on_part, unknown_motion,
    where_these_hold, without_lesser_parts,
};
use super::whole_base::beside_positions;
use crate::algebra::{Demand, Graph, Matrix};
use crate::geometry::{Algebroid, Manifold, NearManifold, RowsOnPart};
use crate::id::{ConstraintId, ExprId, Id, Origin, SymbolId, Table};
use crate::model::{ConstraintDecl, Model, PositionDecl};
use crate::violation::{Law, Violation};

/// Position constraints, proved independent where they hold.
#[derive(Clone, Debug, Default)]
pub struct Positions {
    /// N over the embedded base.
    pub manifold: Manifold,
    /// The embedded base.
    base: Manifold,
    /// What is 0 on it, as declared.
    pub values: Vec<ExprId>,
    /// Those that were solved for no coordinate and no parameter: N is asked near them.
    pub unsolved: Vec<ExprId>,
    /// The part of N where it was asked which are independent, if some were not solved and points were found.
    pub part: Option<RowsOnPart>,
    /// Other parts, on which fewer are independent.
    pub elsewhere: Vec<LesserPart>,
    /// A^a_α = ρ^i_α ∂_i f^a, a row for each of the independent ones.
    pub jacobian: Matrix,
    /// How many rates are independent, and how many dimensions the equations take away, if these are more: then one of
    /// them is a square.
    curved: Option<[usize; 2]>,
    /// Equations that follow from the others wherever these hold, which the declaration permits.
    pub redundant: Vec<PositionDecl>,
    /// Entries of vector equations that say nothing, or what an earlier one says: for the report.
    pub dropped: Vec<String>,
}

impl Positions {
    /// No position constraints on an embedded base.
    #[must_use]
    pub fn none(base: &Manifold) -> Self {
        Self { manifold: base.clone(), base: base.clone(), ..Self::default() }
    }

    /// The embedded base.
    pub(super) fn base(&self) -> &Manifold {
        &self.base
    }

    /// What was not solved, on the base.
    pub(super) fn where_unsolved(&self) -> Unsolved<'_> {
        Unsolved { values: &self.values, base: &self.base }
    }
}

/// Reads the position constraints; those that are not independent leave the model, or are refused.
///
/// # Errors
/// Equations that hold always or never, that the anchor keeps by itself, that nothing moves, or that follow
/// from others.
pub fn positions(
    model: &mut Model,
    motion: &mut Motion,
    algebroid: &Algebroid,
    base: &Manifold,
) -> Result<Positions, Vec<Violation>> {
    if model.positions.is_empty() {
        return Ok(Positions::none(base));
    }
    let refused = beside_positions(model);
    if !refused.is_empty() {
        return Err(refused);
    }
    let mut found = Positions::none(base);
    drop_empty_entries(model, base, &mut found);
    let mut violations = Vec::new();
    for index in 0..model.positions.len() {
        violations.extend(says_nothing(model, motion, algebroid, base, index));
    }
    if violations.is_empty() {
        violations.extend(without_real_point(model, &found));
    }
    if !violations.is_empty() {
        return Err(violations);
    }
    let values: Vec<ExprId> = model.positions.iter().map(|position| position.value).collect();
    let coordinates: Vec<SymbolId> = model.coordinates.iter().map(|c| c.symbol).collect();
    let parameters: Vec<SymbolId> = model.parameters.iter().map(|p| p.symbol).collect();
    let demands = on_the_base(model);
    let NearManifold { manifold, unsolved } =
        on_all_parts(&mut model.graph, (base, demands), &values, [&coordinates, &parameters]);
    found.unsolved = unsolved.iter().map(|index| values[*index]).collect();
    found.manifold = manifold;
    let demands = where_they_hold(model);
    found.manifold.keep_parts_with_points(&mut model.graph, &demands);
    found.values = values;
    let rows = jacobian(model, motion, algebroid);
    violations.extend((0..rows.len()).filter_map(|index| position_without_force(model, index)));
    if violations.is_empty() {
        violations.extend(touching_each_other(model, &found.manifold));
    }
    if !violations.is_empty() {
        return Err(violations);
    }
    let mut counts = Vec::new();
    if !found.unsolved.is_empty() {
        (found.part, counts) = part_of_positions(model, &found.where_unsolved(), &rows);
    }
    if found.unsolved.is_empty() || found.part.is_some() {
        let at_points = found.part.as_ref().map(|part| part.rows.len());
        found.elsewhere = without_lesser_parts(model, &mut found.manifold, &rows, at_points);
    }
    counts.retain(|count| found.elsewhere.iter().all(|lesser| lesser.rank != *count));
    found.elsewhere.extend(counts.into_iter().map(|rank| LesserPart { place: None, rank }));
    independent(model, &rows, &mut found)?;
    if let Some(violation) = touching_as_multiples(model) {
        return Err(vec![violation]);
    }
    if !found.unsolved.is_empty() && found.part.is_none() && model.positions.len() >= model.sections.len() {
        return Err(vec![unknown_motion(model)]);
    }
    Ok(found)
}

/// A^a_α, simplified.
fn jacobian(model: &mut Model, motion: &mut Motion, algebroid: &Algebroid) -> Matrix {
    let forms: Vec<ExprId> =
        model.constraints.iter().take(model.positions.len()).map(|c| c.residual).collect();
    let graph = &mut model.graph;
    let forms = motion.rates.apply_all(graph, &forms);
    let row = |form: &ExprId| {
        let entries = algebroid.velocities.iter().map(|symbol| {
            let entry = graph.partial(*form, *symbol);
            graph.simplify(entry)
        });
        entries.collect()
    };
    forms.iter().map(row).collect()
}

/// Leaves out entries of vector equations that are 0 = 0.
fn drop_empty_entries(model: &mut Model, base: &Manifold, found: &mut Positions) {
    let equations = model.positions.iter();
    let equations: Vec<Equation> = equations
        .map(|PositionDecl { value, is_entry, origin, .. }| Equation {
            value: *value,
            is_entry: *is_entry,
            origin: *origin,
        })
        .collect();
    let empty = empty_entries(&mut model.graph, base, &equations);
    let (left_out, kept): (Vec<usize>, Vec<usize>) = (0..empty.len()).partition(|index| empty[*index]);
    let named = left_out.into_iter().map(|index| told(&name_of(model, ConstraintId::from_index(index))));
    found.dropped.extend(named);
    keep(model, &kept);
}

/// Keeps some of the position constraints, with their velocity forms.
fn keep(model: &mut Model, kept: &[usize]) {
    let count = model.positions.len();
    if kept.len() == count {
        return;
    }
    let all: Vec<ConstraintDecl> = model.constraints.iter().cloned().collect();
    let mut table = Table::new();
    let forms = kept.iter().map(|index| all[*index].clone());
    for constraint in forms.chain(all[count..].iter().cloned()) {
        table.push(constraint);
    }
    model.constraints = table;
    model.positions = kept.iter().map(|index| model.positions[*index].clone()).collect();
}

/// An equation that holds always or never, or that nothing changes.
fn says_nothing(
    model: &mut Model,
    motion: &mut Motion,
    algebroid: &Algebroid,
    base: &Manifold,
    index: usize,
) -> Option<Violation> {
    let PositionDecl { value, origin, .. } = model.positions[index];
    let id = ConstraintId::from_index(index);
    let name = name_of(model, id);
    let graph = &mut model.graph;
    let blame = |what: String, evidence: String, way_out: &str| {
        let law = Law::Constraint;
        Some(Violation { law, origin, what, evidence, way_out: way_out.into() })
    };
    if base.zero_test(graph, value).is_zero() {
        return blame(format!("{name} says nothing: its two sides are equal"), String::new(), "leave it out");
    }
    if graph.contradiction(&[(value, Demand::Zero)]).is_some() {
        return blame(
            format!("{name} holds nowhere: its two sides are never equal"),
            format!("{} should be 0, and is not at any real positions", shown(graph, value)),
            "correct it, or leave it out",
        );
    }
    let form = motion.rates.apply(graph, model.constraints[id].residual);
    let coefficients: Vec<ExprId> =
        algebroid.velocities.iter().map(|symbol| graph.partial(form, *symbol)).collect();
    if !coefficients.iter().all(|entry| base.zero_test(graph, *entry).is_zero()) {
        return None;
    }
    let symbols = graph.symbols_in(&[value]);
    let has_coordinates = model.coordinates.iter().any(|coordinate| symbols.contains(&coordinate.symbol));
    if symbols.contains(&model.time) {
        return blame(
            format!("{name} can be kept by no motion: it changes with time alone"),
            format!("along every section {} stays as it is", shown(graph, value)),
            "write the coordinates that follow the time: `x - a * t = 0`",
        );
    }
    if has_coordinates {
        return blame(
            format!("{name} is kept by the anchor: no motion changes it"),
            format!("the rate of {} is 0 along every section", shown(graph, value)),
            "it is no constraint: write it in `on`",
        );
    }
    blame(
        format!("{name} constrains nothing that moves"),
        format!("{} is the same at all times: it is 0 always or never", shown(graph, value)),
        "leave it out; a fact about parameters belongs in `assume`",
    )
}

/// Equations that no real positions of the base satisfy together, for parameters as they are assumed.
fn without_real_point(model: &mut Model, found: &Positions) -> Option<Violation> {
    let mut demands = on_the_base(model);
    let is_alone = demands.is_empty();
    for index in 0..model.positions.len() {
        let PositionDecl { value, origin, .. } = model.positions[index];
        demands.push((value, Demand::Zero));
        if (index == 0 && is_alone) || model.graph.contradiction(&demands).is_none() {
            continue;
        }
        let name = name_of(model, ConstraintId::from_index(index));
        let before: Vec<usize> = (0..index).collect();
        if index > 0
            && let others = where_these_hold(model, &before, &found.base)
            && let Some(left) = left_of(model, &others, value, found)
            && model.graph.value_of(left).is_some()
        {
            return Some(says_left(model, origin, &name, left));
        }
        let of_positions: Vec<(ExprId, Demand)> =
            model.positions[..=index].iter().map(|position| (position.value, Demand::Zero)).collect();
        let there = match model.graph.contradiction(&of_positions) {
            Some(_) => "",
            None => super::assumptions::as_on_the_base(model),
        };
        let (what, with) = match index {
            0 => (format!("{name} holds nowhere"), ""),
            _ => (format!("{name} contradicts the constraints before it"), " together with those"),
        };
        return Some(Violation {
            law: Law::Independence,
            origin,
            what,
            evidence: format!("no real positions satisfy {} = 0{with}{there}", shown(&model.graph, value)),
            way_out: "change or leave out one of them".into(),
        });
    }
    None
}

/// Finds those whose rows of A are independent on N; the others are dropped, kept aside or refused.
fn independent(model: &mut Model, rows: &Matrix, found: &mut Positions) -> Result<(), Vec<Violation>> {
    let restricted = found.manifold.restrict_matrix(&mut model.graph, rows);
    let solved = found.manifold.images().len() - found.base.images().len();
    let rank = model.graph.generic_rank(&restricted).ok().filter(|rank| *rank < solved);
    found.curved = rank.filter(|_| found.part.is_none()).map(|rank| [rank, solved]);
    let mut kept: Vec<usize> = Vec::new();
    let mut violations = Vec::new();
    for index in 0..rows.len() {
        let mut trial: Vec<usize> = kept.clone();
        trial.push(index);
        let matrix: Matrix = trial.iter().map(|row| restricted[*row].clone()).collect();
        let rank = match &found.part {
            Some(part) => Ok(kept.len() + usize::from(part.rows.contains(&index))),
            None => model.graph.generic_rank(&matrix),
        };
        match rank {
            Ok(rank) if rank == trial.len() => kept = trial,
            Ok(_) => match followed(model, rows, &kept, index, found) {
                Follows::Dropped(line) => found.dropped.push(line),
                Follows::Permitted => found.redundant.push(model.positions[index].clone()),
                Follows::Refused(violation) => violations.push(violation),
            },
            Err(why) => violations.push(undecided(model.positions[index].origin, why)),
        }
    }
    if !violations.is_empty() {
        return Err(violations);
    }
    found.jacobian = kept.iter().map(|row| rows[*row].clone()).collect();
    keep(model, &kept);
    Ok(())
}

fn undecided(origin: Origin, why: String) -> Violation {
    Violation {
        law: Law::Decidable,
        origin,
        what: "whether the position constraints are independent could not be decided".into(),
        evidence: why,
        way_out: "write them without roots of negative numbers and divisions by zero".into(),
    }
}

/// Parameters, or the time, that an equation would have to fix: its row depends on others by the velocities, and does not
/// with these. Points that are found for any parameters show that there are none.
fn fixes(
    model: &mut Model,
    rows: &Matrix,
    kept: &[usize],
    index: usize,
    found: &Positions,
) -> Option<String> {
    if found.part.is_some() {
        return None;
    }
    let named = model.parameters.iter().map(|parameter| (parameter.symbol, format!("`{}`", parameter.name)));
    let candidates: Vec<(SymbolId, String)> = named.chain([(model.time, "the time".to_owned())]).collect();
    let graph = &mut model.graph;
    let fixed = candidates.into_iter().filter_map(|(symbol, name)| {
        let matrix: Matrix = kept
            .iter()
            .chain([&index])
            .map(|row| {
                let change = graph.partial(model.positions[*row].value, symbol);
                rows[*row].iter().copied().chain([change]).collect()
            })
            .collect();
        let restricted = found.manifold.restrict_matrix(graph, &matrix);
        (graph.generic_rank(&restricted) == Ok(matrix.len())).then_some(name)
    });
    let fixed: Vec<String> = fixed.collect();
    (!fixed.is_empty()).then(|| listed(&fixed))
}

/// What the others leave of an equation where they hold, if that is not 0 and the same everywhere there.
fn left_of(model: &mut Model, others: &NearManifold, value: ExprId, found: &Positions) -> Option<ExprId> {
    let coordinates: Vec<SymbolId> = model.coordinates.iter().map(|c| c.symbol).collect();
    let graph = &mut model.graph;
    let restricted = others.manifold.restrict(graph, value);
    let left = graph.simplify(restricted);
    let is_left = others.unsolved.is_empty()
        && graph.zero_test(left).is_nonzero()
        && graph.symbols_in(&[left]).into_iter().all(|symbol| {
            let is_given = !coordinates.contains(&symbol) && found.base.is_outside_charts(symbol);
            let slope = graph.partial(left, symbol);
            is_given || graph.zero_test(slope).is_zero()
        });
    is_left.then_some(left)
}

/// That a number which is not 0 is left of an equation where those before it hold.
fn says_left(model: &Model, origin: Origin, name: &str, left: ExprId) -> Violation {
    Violation {
        law: Law::Independence,
        origin,
        what: format!("{name} contradicts the position constraints before it"),
        evidence: format!("where those hold, it says {} = 0", shown(&model.graph, left)),
        way_out: "change or leave out one of them".into(),
    }
}

/// Where an equation follows by its rate from earlier ones, if it does so on one part of N and not on another.
fn only_on_a_part(
    model: &mut Model,
    rows: &Matrix,
    kept: &[usize],
    index: usize,
    found: &Positions,
) -> Option<String> {
    let matrix: Matrix = kept.iter().chain([&index]).map(|row| rows[*row].clone()).collect();
    let graph = &mut model.graph;
    let is_independent = found.manifold.parts().skip(1).any(|part| {
        let restricted = part.restrict_matrix(graph, &matrix);
        graph.generic_rank(&restricted) == Ok(matrix.len())
    });
    is_independent.then(|| place_of(model, &found.manifold, &found.manifold))
}

/// What becomes of an equation whose row depends on earlier ones.
enum Follows {
    Dropped(String),
    Permitted,
    Refused(Violation),
}

fn followed(model: &mut Model, rows: &Matrix, kept: &[usize], index: usize, found: &Positions) -> Follows {
    let PositionDecl { value, is_entry, origin, .. } = model.positions[index];
    let name = name_of(model, ConstraintId::from_index(index));
    let repeated = kept.iter().copied().find(|earlier| {
        let other = model.positions[*earlier].value;
        let graph = &mut model.graph;
        let (sum, difference) = (graph.formula(value + other), graph.formula(value - other));
        graph.zero_test(sum).is_zero() || graph.zero_test(difference).is_zero()
    });
    if let (true, Some(earlier)) = (is_entry, repeated) {
        let earlier = name_of(model, ConstraintId::from_index(earlier));
        return Follows::Dropped(format!("{name} is left out: it says what {earlier} says"));
    }
    let law = Law::Independence;
    if let Some(fixed) = fixes(model, rows, kept, index, found) {
        return Follows::Refused(Violation {
            law,
            origin,
            what: format!("{name} contradicts the position constraints before it"),
            evidence: format!("its rate follows from theirs, but what they leave of it changes with {fixed} alone"),
            way_out: "change or leave out one of them; a parameter that follows from others is written as such, in \
                      a `let`"
                .into(),
        });
    }
    let others = where_these_hold(model, kept, &found.base);
    if let Some(left) = left_of(model, &others, value, found) {
        return Follows::Refused(says_left(model, origin, &name, left));
    }
    let follows = format!("{name} follows from the position constraints before it");
    let place = only_on_a_part(model, rows, kept, index, found)
        .or_else(|| does_not_follow(model, &others, value).map(|place| format!(", but not{place}")));
    if let Some(place) = place {
        return Follows::Refused(Violation {
            law,
            origin,
            what: format!("{follows}{place}"),
            evidence: PARTS.into(),
            way_out: ONE_PART.into(),
        });
    }
    let is_alone = rows.len() == 1;
    let graph = &mut model.graph;
    let on_manifold = |graph: &mut Graph, entry: &ExprId| found.manifold.zero_test(graph, *entry).is_zero();
    let vanishes = rows[index].iter().all(|entry| on_manifold(graph, entry));
    if model.redundant.is_some() && found.curved.is_none() {
        return Follows::Permitted;
    }
    if vanishes {
        return Follows::Refused(Violation {
            law,
            origin,
            what: format!(
                "{name} exerts no force: its derivative vanishes where {}",
                if is_alone { "it holds" } else { "all position constraints hold" }
            ),
            evidence: format!("the rate of {} is 0 along every section there", shown(graph, value)),
            way_out: "write it without the power, as `a = b` instead of `(a - b)^2 = 0`".into(),
        });
    }
    if let Some([rates, dimensions]) = found.curved {
        return Follows::Refused(Violation {
            law,
            origin,
            what: format!(
                "{name} says nothing of velocities that those before it do not say, but of positions"
            ),
            evidence: format!(
                "where all position constraints hold, they take away {dimensions} dimensions, and {rates} of their \
                 rates are independent"
            ),
            way_out: "write what is 0 as a square without it, as `a = b` instead of `(a - b)^2 = 0`".into(),
        });
    }
    let evidence = match &found.part {
        Some(part) => rates_on_part(part),
        None => combination_shown(model, rows, kept, index),
    };
    Follows::Refused(Violation {
        law,
        origin,
        what: follows,
        evidence,
        way_out: "leave it out; or write `redundant;` in `holonomic`: it then stays in residual and return, \
                  without a multiplier"
            .into(),
    })
}
