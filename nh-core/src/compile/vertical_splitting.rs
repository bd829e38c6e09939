//! The splitting of D by the vertical sections, in an invariant frame where symmetries are declared.

use super::proved::Proved;
use crate::algebra::{Graph, Matrix, Substitution};
use crate::check::Invariance;
use crate::geometry::{
    Algebroid, Anchor, ConstraintDistribution, InvariantFrame, LinearConstraints, PivotSetting,
    constant_along, independent_velocities,
};
use crate::id::{CoordId, ExprId, Id, SectionId, SymbolId};
use crate::mechanics::{Chaplygin, LagrangianSystem, NotSplit, Splitting, translations};
use crate::model::Model;

/// A system as its reduction by symmetries sees it.
#[derive(Clone, Debug)]
pub(crate) struct Reduced {
    /// In the invariant frame, without the coordinates along the group; as declared where no frame is
    /// needed.
    pub(crate) system: LagrangianSystem,
    /// D there.
    pub(crate) distribution: ConstraintDistribution,
    /// How it lies to the vertical sections.
    pub(crate) splitting: Splitting,
    /// The frame, where one is needed.
    pub(crate) frame: Option<InvariantFrame>,
    /// The names of the sections.
    pub(crate) names: Vec<String>,
    /// Sections that span V, in the declared basis, where they are those of a group.
    pub(crate) group: Vec<Vec<ExprId>>,
    /// Whether the state keeps all velocities: then no choice of some of D is made for what is a function of them.
    keeps_all: bool,
}

impl Reduced {
    /// The reduction of a system with linear constraints that do not depend on the time; `distribution`
    /// where D has a basis of its own.
    ///
    /// # Errors
    /// Why there is none.
    pub(crate) fn of(
        proved: &mut Proved,
        distribution: Option<&ConstraintDistribution>,
    ) -> Result<Self, String> {
        let velocities = proved.system.algebroid.velocities.clone();
        let keeps_all = distribution.is_none();
        let distribution = match distribution {
            Some(distribution) => distribution.clone(),
            None => proved
                .constraints
                .generic_distribution(&mut proved.model.graph, &velocities)
                .ok_or("its constraints are not linear in the velocities")?,
        };
        let graph = &mut proved.model.graph;
        let offset = distribution.offset.iter().all(|entry| graph.zero_test(*entry).is_zero());
        let entries: Vec<ExprId> = distribution.basis.iter().flatten().copied().collect();
        if !offset || proved.system.clock.occurs_in(graph, &entries) {
            return Err("its constraints are affine or depend on the time".into());
        }
        // the group: declared sections with the cyclic coordinates that these move, else all cyclic coordinates
        let sections = declared(proved, |_| true);
        let moving = moved(&mut proved.model.graph, &proved.system.algebroid.anchor, &sections);
        let is_cyclic = |id: &CoordId| proved.symmetries.cyclic.contains(id);
        let translations = moving.iter().all(is_cyclic);
        let group = if sections.is_empty() { proved.symmetries.cyclic.clone() } else { moving.clone() };
        let anchor =
            proved.base.restrict_matrix(&mut proved.model.graph, &proved.system.algebroid.anchor.entries);
        let is_injective = proved.model.graph.generic_rank(&anchor)? == velocities.len();
        if is_injective && !translations {
            let generators = with_translations(proved, &sections, |id| moving.contains(&id));
            return in_invariant_frame(proved, (&distribution, keeps_all), &generators).map_err(|why| {
                format!("no frame of sections that commute with the declared symmetries: {why}")
            });
        }
        let splitting =
            Splitting::of(&mut proved.model.graph, &proved.system, &distribution, &group, &proved.base)
                .map_err(|why| not_split(proved, why))?;
        let names = proved.model.sections.iter().map(|section| section.name.clone()).collect();
        let generators = if splitting.by_group {
            with_translations(proved, &sections, |id| group.contains(&id))
        } else {
            Vec::new()
        };
        let system = proved.system.clone();
        Ok(Self { system, distribution, splitting, frame: None, names, group: generators, keeps_all })
    }

    /// L̄, K and ⟨J, K⟩ of a Chaplygin system.
    pub(crate) fn chaplygin(&self, proved: &mut Proved) -> Option<Chaplygin> {
        if !self.splitting.is_chaplygin() {
            return None;
        }
        let rate = |id: &CoordId| proved.model.coordinates[*id].rate;
        let rates: Vec<SymbolId> = self.splitting.coordinates.iter().map(rate).collect();
        let graph = &mut proved.model.graph;
        let mut distribution = self.distribution.clone();
        if self.keeps_all {
            distribution.velocity = self.system.algebroid.velocity(graph);
        }
        Chaplygin::of(graph, &self.system, &distribution, &self.splitting, &rates)
    }

    /// The group that V is along, in words.
    pub(crate) fn group_in_words(&self, proved: &Proved) -> String {
        if self.frame.is_some() {
            return "the declared symmetries of L and D, with the cyclic coordinates that they move".into();
        }
        let kept = |id: &CoordId| self.splitting.coordinates.contains(id);
        if !proved.symmetries.cyclic.iter().any(kept) {
            return "translations along the cyclic coordinates".into();
        }
        let ids = (0..proved.model.coordinates.len()).map(CoordId::from_index);
        let names: Vec<&str> =
            ids.filter(|id| !kept(id)).map(|id| proved.model.coordinates[id].name.as_str()).collect();
        format!("translations along {}", names.join(", "))
    }

    /// A section in the declared basis.
    pub(crate) fn declared(&self, graph: &mut Graph, section: &[ExprId]) -> Vec<ExprId> {
        let Some(frame) = &self.frame else { return section.to_vec() };
        let section = frame.change.old_velocity(graph, section);
        section.into_iter().map(|component| graph.simplify(component)).collect()
    }

    /// A function of the velocities of the frame at those of E.
    pub(crate) fn at_declared_velocities(&self, proved: &mut Proved, function: ExprId) -> ExprId {
        let Some(frame) = &self.frame else { return function };
        let graph = &mut proved.model.graph;
        let velocity = proved.system.algebroid.velocity(graph);
        let images = graph.image(&frame.change.velocities, &velocity);
        let symbols = self.system.algebroid.velocities.iter().copied();
        Substitution::new(symbols.zip(images)).apply(graph, function)
    }
}

/// Why D is not split.
fn not_split(proved: &Proved, why: NotSplit) -> String {
    match why {
        NotSplit::NothingVertical if proved.model.symmetries.is_empty() => {
            "the kernel of the anchor is 0 and no coordinate is cyclic".into()
        }
        NotSplit::NothingVertical => {
            "the kernel of the anchor is 0, no coordinate is cyclic, and no declared section leaves L and D invariant"
                .into()
        }
        NotSplit::NotOnto { rank, dimension } => format!(
            "the anchor is not onto: over coordinates of {dimension} dimensions its rank is {rank}, so that what moves \
             is a leaf of the base"
        ),
        NotSplit::Undecided => "the rank of the anchor could not be decided".into(),
    }
}

/// The declared sections that leave L and D invariant and move no coordinates but those `within`; none
/// where the time is in one.
pub(crate) fn declared(proved: &mut Proved, within: impl Fn(CoordId) -> bool) -> Vec<Vec<ExprId>> {
    let model = &proved.model;
    let strict = |name: &String| model.symmetries.iter().any(|s| s.name == *name && s.gauge.is_none());
    let mut found: Vec<Vec<ExprId>> = proved
        .symmetries
        .declared
        .iter()
        .filter(|s| s.keeps_lagrangian == Invariance::Everywhere && s.keeps_constraints && strict(&s.name))
        .map(|symmetry| symmetry.section.clone())
        .collect();
    let moving: Vec<ExprId> = found.iter().flatten().copied().collect();
    if found.is_empty() || model.graph.symbols_in(&moving).contains(&model.time) {
        return Vec::new();
    }
    let (graph, anchor) = (&mut proved.model.graph, &proved.system.algebroid.anchor);
    found.retain(|section| moved(graph, anchor, std::slice::from_ref(section)).into_iter().all(&within));
    found
}

/// The generators of a group: declared ones, and translations along cyclic coordinates.
pub(crate) fn with_translations(
    proved: &mut Proved,
    declared: &[Vec<ExprId>],
    cyclic: impl Fn(CoordId) -> bool,
) -> Vec<Vec<ExprId>> {
    let (graph, anchor) = (&mut proved.model.graph, &proved.system.algebroid.anchor);
    let along: Vec<CoordId> = proved.symmetries.cyclic.iter().copied().filter(|id| cyclic(*id)).collect();
    if along.is_empty() {
        return declared.to_vec();
    }
    let translations = translations(graph, anchor, &along).into_iter().flatten();
    declared.iter().cloned().chain(translations).collect()
}

/// The coordinates that generators move.
pub(crate) fn moved(graph: &mut Graph, anchor: &Anchor, generators: &[Vec<ExprId>]) -> Vec<CoordId> {
    let fields: Matrix = generators.iter().map(|generator| anchor.vector_field(graph, generator)).collect();
    (0..anchor.coordinates.len())
        .filter(|i| fields.iter().any(|field| !graph.zero_test(field[*i]).is_zero()))
        .map(CoordId::from_index)
        .collect()
}

/// The reduction by declared symmetries, where these move more than cyclic coordinates.
///
/// # Errors
/// Why there is none.
fn in_invariant_frame(
    proved: &mut Proved,
    (distribution, keeps_all): (&ConstraintDistribution, bool),
    generators: &[Vec<ExprId>],
) -> Result<Reduced, String> {
    if !proved.system.forces_on_distribution.is_empty() {
        return Err("the forces along spanning sections are known on D alone".into());
    }
    let algebroid = proved.system.algebroid.clone();
    let graph = &mut proved.model.graph;
    let group = moved(graph, &algebroid.anchor, generators);
    let coordinates = &algebroid.anchor.coordinates;
    let symbols: Vec<SymbolId> = group.iter().map(|id| coordinates[id.index()]).collect();
    let left: Vec<SymbolId> =
        coordinates.iter().copied().filter(|symbol| !symbols.contains(symbol)).collect();
    let across = proved.base.dimension_of(graph, coordinates)? - proved.base.dimension_of(graph, &left)?;
    let directions = proved.base.independent_rows(graph, generators)?.len();
    if across != directions {
        let moved: Vec<String> = symbols.iter().map(|symbol| graph.symbols()[*symbol].clone()).collect();
        return Err(format!(
            "their orbits have dimension {directions}, and they move {}: take coordinates of which they move no more",
            moved.join(", ")
        ));
    }
    // 1. the frame
    let hints: Vec<ExprId> = distribution
        .constraints
        .annihilator
        .iter()
        .flatten()
        .copied()
        .chain([proved.system.lagrangian])
        .collect();
    let frame = InvariantFrame::of(graph, &algebroid, &proved.base, generators, &symbols, &hints)?;
    let names = frame_names(&proved.model, &frame);
    // 2. everything in it
    let system = in_frame(proved, &frame, &names, &group)?;
    let constraints = annihilator(&mut proved.model.graph, &distribution.constraints.annihilator, &frame);
    // 3. D and its splitting
    let distribution = invariant_basis(proved, constraints, &system.algebroid.velocities, &symbols)
        .ok_or("in it no basis of D without the coordinates that they move was found")?;
    let Proved { model, base, .. } = &mut *proved;
    let splitting = Splitting::of(&mut model.graph, &system, &distribution, &group, base)
        .map_err(|why| not_split(proved, why))?;
    let group = generators.to_vec();
    Ok(Reduced { system, distribution, splitting, frame: Some(frame), names, group, keeps_all })
}

/// The system in the frame, without the coordinates along the group.
///
/// # Errors
/// What depends on them.
fn in_frame(
    proved: &mut Proved,
    frame: &InvariantFrame,
    names: &[String],
    group: &[CoordId],
) -> Result<LagrangianSystem, String> {
    let (graph, algebroid) = (&mut proved.model.graph, &proved.system.algebroid);
    let symbols: Vec<SymbolId> = group.iter().map(|id| algebroid.anchor.coordinates[id.index()]).collect();
    let velocities = names.iter().map(|name| graph.new_symbol(name.clone())).collect();
    let new = frame.change.apply(graph, algebroid, velocities);
    let velocity = new.velocity(graph);
    let old = frame.change.old_velocity(graph, &velocity);
    let mut in_frame = Substitution::new(algebroid.velocities.iter().copied().zip(old));
    let lagrangian = in_frame.apply(graph, proved.system.lagrangian);
    let depends = |what: &str, along: SymbolId, graph: &Graph| {
        format!("in it {what} depends on `{}`, which they move", graph.symbols()[along])
    };
    let lagrangian = constant_along(graph, &proved.base, lagrangian, &symbols)
        .map_err(|varies| depends("the Lagrangian", varies.along, graph))?;
    let mut broken = None;
    let mut free = |entry: ExprId| {
        constant_along(graph, &proved.base, entry, &symbols).unwrap_or_else(|varies| {
            broken = Some(varies.along);
            entry
        })
    };
    let structure = new.structure.mapped(&mut free);
    let entries: Matrix = new
        .anchor
        .entries
        .iter()
        .enumerate()
        .map(|(i, row)| {
            let along_group = group.contains(&CoordId::from_index(i));
            row.iter().map(|entry| if along_group { *entry } else { free(*entry) }).collect()
        })
        .collect();
    if let Some(along) = broken {
        return Err(depends("a bracket or the anchor", along, graph));
    }
    let forces = graph.image(&Graph::transposed(&frame.change.sections), &proved.system.forces);
    let forces = in_frame.apply_all(graph, &forces);
    let anchor = Anchor { entries, ..new.anchor };
    let algebroid = Algebroid { anchor, structure, velocities: new.velocities };
    let forces_on_distribution = Vec::new();
    Ok(LagrangianSystem {
        algebroid,
        lagrangian,
        forces,
        forces_on_distribution,
        clock: proved.system.clock.clone(),
    })
}

/// The constraints in the frame; they have no drift.
fn annihilator(graph: &mut Graph, rows: &Matrix, frame: &InvariantFrame) -> LinearConstraints {
    let columns = Graph::transposed(&frame.change.sections);
    let mut annihilator = Matrix::new();
    for row in rows {
        let entries = graph.image(&columns, row);
        annihilator.push(entries.into_iter().map(|entry| graph.simplify(entry)).collect());
    }
    let drift = vec![graph.zero(); annihilator.len()];
    LinearConstraints { annihilator, drift }
}

/// A basis of D with invariant coefficients: D determines the form that is solved for velocities.
fn invariant_basis(
    proved: &mut Proved,
    constraints: LinearConstraints,
    velocities: &[SymbolId],
    group: &[SymbolId],
) -> Option<ConstraintDistribution> {
    let parameters: Vec<SymbolId> =
        proved.model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let graph = &mut proved.model.graph;
    if constraints.annihilator.is_empty() {
        return Some(ConstraintDistribution::unconstrained(graph, velocities));
    }
    let setting = PivotSetting {
        annihilator: &constraints.annihilator,
        on_base: &constraints.annihilator,
        parameters: &parameters,
        facts: &proved.facts,
    };
    let dependent: Vec<SectionId> =
        match independent_velocities::search(graph, &setting, &[], velocities.len()).ok()? {
            Ok(choice) => choice.dependent,
            Err(none) => none.tried.into_iter().next()?.0,
        };
    let mut found = ConstraintDistribution::solved_for(graph, constraints, &dependent, velocities)?;
    for entry in found.basis.iter_mut().flatten().chain(&mut found.velocity) {
        *entry = constant_along(graph, &proved.base, *entry, group).ok()?;
    }
    Some(found)
}

/// The names of the velocities: declared ones where they are the same, else `body_x` for `x_dot`.
pub(crate) fn frame_names(model: &Model, frame: &InvariantFrame) -> Vec<String> {
    let graph = &model.graph;
    let declared: Vec<&String> = model.sections.iter().map(|section| &section.name).collect();
    let taken = |name: &str| {
        let names = model.coordinates.iter().map(|coordinate| &coordinate.name);
        let parameters = model.parameters.iter().map(|parameter| &parameter.name);
        let inputs = model.inputs.iter().map(|input| &input.name);
        names.chain(parameters).chain(inputs).chain(declared.iter().copied()).any(|other| other == name)
    };
    let is_same = |index: usize| {
        frame.change.velocities[index].iter().enumerate().all(|(other, entry)| {
            graph.as_number(*entry).is_some_and(|n| if other == index { n.is_one() } else { n.is_zero() })
        })
    };
    let renamed = |name: &String| {
        let stem = name.strip_suffix("_dot").unwrap_or(name).replace('[', "_").replace(']', "");
        let mut fresh = format!("body_{stem}");
        while taken(&fresh) {
            fresh.push('_');
        }
        fresh
    };
    let names = declared.iter().enumerate();
    names.map(|(index, name)| if is_same(index) { (*name).clone() } else { renamed(name) }).collect()
}
