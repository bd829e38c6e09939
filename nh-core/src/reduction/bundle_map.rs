//! Φ: E → E' over φ: M → M', read off its declaration, and the target pulled back by it.

use std::collections::BTreeMap;

use super::side::Side;
use super::{MorphismDecl, assuming};
use crate::algebra::{Derivation, Matrix, NotLinear, Transplant};
use crate::check::evidence::shown;
use crate::geometry::StructureFunctions;
use crate::id::{ExprId, Id, Origin, SectionId, SymbolId};
use crate::model::{Kinematics, Located};
use crate::violation::{Law, Violation};

/// Φ, with the structure of the target over the base of the source.
pub(super) struct BundleMap {
    /// Where the map is declared.
    pub(super) origin: Origin,
    /// The target's parameters.
    pub(super) parameters: Vec<Located>,
    /// φ^i.
    pub(super) coordinates: Vec<Located>,
    /// Φ^β_α: a row for each section of the target, a column for each of the source.
    pub(super) fibre: Matrix,
    /// Φ y, each row where it is declared.
    pub(super) velocity: Vec<Located>,
    /// The target's inputs.
    pub(super) inputs: Vec<Located>,
    /// The target's auxiliary states: those of the source of the same names.
    pub(super) auxiliary: Vec<ExprId>,
    /// ρ'∘φ: a row for each coordinate of the target.
    pub(super) anchor: Matrix,
    /// C'∘φ.
    pub(super) structure: StructureFunctions,
    /// What stands in the source's graph for each symbol of the target's.
    images: Vec<(SymbolId, ExprId)>,
}

impl BundleMap {
    /// Reads the declaration.
    ///
    /// # Errors
    /// Velocities that are missing or not linear, parameters that are not of parameters alone.
    pub(super) fn of(
        source: &mut Side,
        target: &Side,
        declared: &MorphismDecl,
    ) -> Result<Self, Vec<Violation>> {
        let model = &target.proved.model;
        // 1. parameters, base and inputs
        let mut parameters = in_order(model.parameters.ids(), &declared.parameters);
        let coordinates = in_order(model.coordinates.ids(), &declared.coordinates);
        let mut inputs = in_order(model.inputs.ids(), &declared.inputs);
        let mut violations: Vec<Violation> =
            parameters.iter().filter_map(|parameter| stranger(source, *parameter)).collect();
        for parameter in &mut parameters {
            parameter.value = assuming(source, parameter.value);
        }
        for input in &mut inputs {
            input.value = in_velocities(source, input.value);
        }
        // 2. the fibres
        let mut velocity = Vec::new();
        let mut fibre = Matrix::new();
        for (index, symbol) in target.velocities().iter().enumerate() {
            let section = &model.sections[SectionId::from_index(index)];
            let row = given(source, target, declared, &coordinates, (index, *symbol))
                .ok_or_else(|| missing(source, target, declared.origin, &section.name))
                .and_then(|value| Ok((value, linear(source, value, &section.name)?)));
            match row {
                Ok((value, row)) => {
                    velocity.push(value);
                    fibre.push(row);
                }
                Err(violation) => violations.push(violation),
            }
        }
        let mut auxiliary = Vec::new();
        for state in &model.auxiliary {
            let known = source.proved.model.auxiliary.iter().find(|known| known.name == state.name);
            match known.map(|known| known.symbol) {
                Some(symbol) => auxiliary.push(source.graph().symbol(symbol)),
                None => violations.push(unmatched(source, target, declared.origin, &state.name)),
            }
        }
        if !violations.is_empty() {
            return Err(violations);
        }
        // 3. what stands for the symbols of the target, and its structure over the source's base
        let values = |list: &[Located]| list.iter().map(|located| located.value).collect::<Vec<_>>();
        let time = source.proved.model.time;
        let time = source.graph().symbol(time);
        let images: Vec<(SymbolId, ExprId)> = model
            .parameters
            .iter()
            .map(|parameter| parameter.symbol)
            .zip(values(&parameters))
            .chain(model.coordinates.iter().map(|coordinate| coordinate.symbol).zip(values(&coordinates)))
            .chain(target.velocities().iter().copied().zip(values(&velocity)))
            .chain(model.inputs.iter().map(|input| input.symbol).zip(values(&inputs)))
            .chain(model.auxiliary.iter().map(|state| state.symbol).zip(auxiliary.iter().copied()))
            .chain([(model.time, time)])
            .collect();
        let mut pull_back = Transplant::new(&model.graph, images.iter().copied());
        let algebroid = &target.proved.system.algebroid;
        let graph = source.graph();
        let anchor = algebroid.anchor.entries.iter().map(|row| pull_back.apply_all(graph, row)).collect();
        let structure = algebroid.structure.mapped(|entry| pull_back.apply(graph, entry));
        let origin = declared.origin;
        Ok(Self {
            origin,
            parameters,
            coordinates,
            fibre,
            velocity,
            inputs,
            auxiliary,
            anchor,
            structure,
            images,
        })
    }

    /// The pull-back of functions of the target along Φ.
    pub(super) fn pull_back<'a>(&self, target: &'a Side) -> Transplant<'a> {
        Transplant::new(&target.proved.model.graph, self.images.iter().copied())
    }

    /// Φ σ of a section of the source.
    pub(super) fn image(&self, source: &mut Side, section: &[ExprId]) -> Vec<ExprId> {
        self.fibre.iter().map(|row| source.graph().inner_product(row, section)).collect()
    }
}

/// The values in the order of their ids.
fn in_order<I: Id>(ids: impl Iterator<Item = I>, given: &[(I, Located)]) -> Vec<Located> {
    let given: BTreeMap<I, Located> = given.iter().copied().collect();
    ids.filter_map(|id| given.get(&id).copied()).collect()
}

/// An expression of the declaration in the quasi-velocities of the source.
fn in_velocities(source: &mut Side, value: ExprId) -> ExprId {
    source.proved.motion.rates.apply(&mut source.proved.model.graph, value)
}

/// A parameter of the target that depends on more than parameters.
fn stranger(source: &Side, parameter: Located) -> Option<Violation> {
    let model = &source.proved.model;
    let is_parameter = |symbol: &SymbolId| model.parameters.iter().any(|known| known.symbol == *symbol);
    let found = model.graph.symbols_in(&[parameter.value]).into_iter().find(|s| !is_parameter(s))?;
    Some(Violation {
        law: Law::Morphism,
        origin: parameter.origin,
        what: format!("a parameter depends on `{}`", model.graph.symbols()[found]),
        evidence: format!("parameters are constant, `{}` changes", model.graph.symbols()[found]),
        way_out: format!("write it in the parameters of `{}`", model.name),
    })
}

/// Φ y along one section of the target: as declared; where E' = TM' and nothing is declared, the
/// rate of φ^i, which is what (13) demands.
fn given(
    source: &mut Side,
    target: &Side,
    declared: &MorphismDecl,
    coordinates: &[Located],
    (index, symbol): (usize, SymbolId),
) -> Option<Located> {
    if let Some((_, located)) = declared.velocities.iter().find(|(known, _)| *known == symbol) {
        return Some(Located { value: in_velocities(source, located.value), ..*located });
    }
    let is_rate =
        matches!(target.proved.model.kinematics, Kinematics::Tangent) && target.proved.model.frame.is_empty();
    let located = coordinates.get(index).filter(|_| is_rate)?;
    let algebroid = &source.proved.system.algebroid;
    let graph = &mut source.proved.model.graph;
    let velocity = algebroid.velocity(graph);
    let rates = algebroid.rates(graph, &velocity);
    let along = algebroid.anchor.coordinates.iter().copied().zip(rates);
    Some(Located { value: Derivation::new(along).apply(graph, located.value), ..*located })
}

fn missing(source: &Side, target: &Side, origin: Origin, name: &str) -> Violation {
    Violation {
        law: Law::Morphism,
        origin,
        what: format!("the quasi-velocity `{name}` of `{}` is not given", target.name()),
        evidence: format!("`{}` has no quasi-velocity of that name", source.name()),
        way_out: format!(
            "add `{name} = …;` to `velocities`, linear in the velocities of `{}`",
            source.name()
        ),
    }
}

/// An auxiliary state of the target that the source has not.
fn unmatched(source: &Side, target: &Side, origin: Origin, name: &str) -> Violation {
    let (from, to) = (source.name(), target.name());
    let states = &source.proved.model.auxiliary;
    let known: Vec<String> = states.iter().map(|state| format!("`{}`", state.name)).collect();
    Violation {
        law: Law::Auxiliary,
        origin,
        what: format!("`{to}` has the auxiliary state `{name}`, `{from}` has none of that name"),
        evidence: if known.is_empty() {
            format!("`{from}` has no auxiliary states")
        } else {
            format!("those of `{from}` are {}", known.join(", "))
        },
        way_out: "call what corresponds alike in both systems".into(),
    }
}

/// A row of Φ.
pub(super) fn linear(source: &mut Side, value: Located, name: &str) -> Result<Vec<ExprId>, Violation> {
    let velocities = source.velocities().to_vec();
    let graph = source.graph();
    let blame = |evidence: String| Violation {
        law: Law::Morphism,
        origin: value.origin,
        what: format!("`{name}` is not linear and homogeneous in the velocities"),
        evidence,
        way_out: "a map of vector bundles is linear on the fibres: write a sum of velocities with \
                  coefficients on the base"
            .into(),
    };
    let form = graph.linear_form(value.value, &velocities).map_err(|error| match error {
        NotLinear::Curved(..) => blame(format!("{} has a term that is not", shown(graph, value.value))),
        NotLinear::Unknown(why) => blame(why),
    })?;
    if graph.zero_test(form.rest).is_zero() {
        return Ok(form.coefficients);
    }
    Err(blame(format!("at rest it is {}", shown(graph, form.rest))))
}
