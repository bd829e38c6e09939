//! A map between two declared systems: the quantities of the target as expressions of the source.

use nonholonomic_core::id::{ExprId, Id};
use nonholonomic_core::model::{Located, Model};
use nonholonomic_core::reduction::MorphismDecl;
use nonholonomic_core::units::{Quantity, infer};

use super::alike::Measured;
use super::array::Shape;
use super::choices;
use super::context::Context;
use super::origins::Origins;
use super::resolve;
use super::resolver::{Resolver, Tables};
use super::scope::{Meaning, Role};
use crate::emit::{Family, Layout};
use crate::report::{Diagnostic, Extent};
use crate::suggest::did_you_mean;
use crate::syntax::ast::SystemDecl;
use crate::syntax::map_syntax::{self, Definitions};

/// A map with its names resolved.
pub(crate) struct ResolvedMorphism {
    /// The system that is mapped; its graph holds the expressions of the map.
    pub(crate) source: Model,
    /// The system it is mapped to.
    pub(crate) target: Model,
    /// The map.
    pub(crate) declared: MorphismDecl,
    /// What the origins of the map are.
    pub(crate) origins: Origins,
}

/// Why a map could not be resolved.
pub(crate) enum Unrelated {
    /// One of the declarations is ill-posed, as is said where it stands.
    IllPosed,
    /// The map itself is.
    Errors(Vec<Diagnostic>),
}

/// What one section of the map is about.
struct Kind {
    context: Context,
    /// What of the source has a name for it.
    roles: &'static [Role],
    noun: &'static str,
    /// Whether what is not given may follow from the rest.
    implied: bool,
}

/// An entry of the target's families by its position, and its value.
type Entries = Vec<(usize, Located)>;

/// The same, with the name of the entry, and where its value stands.
type NamedEntries = Vec<(usize, String, Extent, ExprId)>;

/// Resolves both declarations and the map between them.
pub(crate) fn resolve_morphism(
    declaration: &map_syntax::MorphismDecl,
    (source, source_layout): (&SystemDecl, &mut Layout),
    (target, target_layout): (&SystemDecl, &mut Layout),
) -> Result<ResolvedMorphism, Unrelated> {
    let target = resolve(target, target_layout).map_err(|_| Unrelated::IllPosed)?.model;
    let mut resolver = Resolver::new(choices::whole(source));
    resolver.homogeneity.wanted = source.sections.units.is_some();
    resolver.declare(source, source_layout);
    resolver.surroundings(source, source_layout);
    let mut source = resolver.model(source, source_layout);
    let ill_posed = resolver.reports.any();
    resolver.read_on(&mut source);
    resolver.share_also(&declaration.lets);
    let declared = resolver.map(declaration, target_layout, &target.units);
    resolver.unused();
    resolver.units_of_map();
    source.graph = std::mem::take(&mut resolver.graph);
    let Resolver { origins, reports, .. } = resolver;
    match reports.finish(()) {
        _ if ill_posed => Err(Unrelated::IllPosed),
        Ok(()) => Ok(ResolvedMorphism { source, target, declared, origins }),
        Err(errors) => Err(Unrelated::Errors(errors)),
    }
}

impl Resolver {
    /// Goes on behind the declaration of a system, in its names: `der` of an expression asks what its symbols are.
    pub(super) fn read_on(&mut self, source: &mut Model) {
        self.graph = std::mem::take(&mut source.graph);
        self.tables = Tables {
            parameters: source.parameters.clone(),
            coordinates: source.coordinates.clone(),
            sections: source.sections.clone(),
            inputs: source.inputs.clone(),
            auxiliary: source.auxiliary.clone(),
            frame: source.frame.clone(),
        };
    }

    /// The map; what is in error is left out.
    fn map(
        &mut self,
        declaration: &map_syntax::MorphismDecl,
        layout: &Layout,
        units: &[Quantity],
    ) -> MorphismDecl {
        let origin = self.origin(declaration.extent());
        let mut read = |definitions: &Definitions, families: &[Family], kind: Kind| {
            let entries = self.quantities(declaration, definitions, families, &kind);
            entries
                .into_iter()
                .map(|(place, name, extent, value)| {
                    self.has_unit_of_target(declaration, &kind, units, (&name, extent), value);
                    (place, Located { value, origin: self.origin(extent) })
                })
                .collect::<Entries>()
        };
        let parameters = read(
            &declaration.parameters,
            &layout.parameters,
            Kind {
                context: Context::MapParameters,
                roles: &[Role::Parameter],
                noun: "parameter",
                implied: false,
            },
        );
        let coordinates = read(
            &declaration.base,
            &layout.coordinates,
            Kind {
                context: Context::MapBase,
                roles: &[Role::Coordinate],
                noun: "base coordinate",
                implied: false,
            },
        );
        let families = [layout.velocities.as_slice(), &layout.frame].concat();
        let velocities = read(
            &declaration.velocities,
            &families,
            Kind {
                context: Context::MapVelocities,
                roles: &[Role::Velocity, Role::FrameVelocity],
                noun: "quasi-velocity",
                implied: true,
            },
        );
        let inputs = read(
            &declaration.inputs,
            &layout.inputs,
            Kind { context: Context::MapInputs, roles: &[Role::Input], noun: "input", implied: false },
        );
        let velocity = |(k, value): (usize, Located)| Some((*layout.velocity_symbols.get(k)?, value));
        MorphismDecl {
            origin,
            parameters: with_ids(parameters),
            coordinates: with_ids(coordinates),
            velocities: velocities.into_iter().filter_map(velocity).collect(),
            inputs: with_ids(inputs),
        }
    }

    /// The entries of the target's families: as defined, or else what has the same name in the source.
    fn quantities(
        &mut self,
        declaration: &map_syntax::MorphismDecl,
        definitions: &Definitions,
        families: &[Family],
        kind: &Kind,
    ) -> NamedEntries {
        let items = definitions.as_ref().map_or(&[][..], |section| &section.body);
        let (defined, broken) = self.definitions(kind.context, items);
        let target = &declaration.target.name;
        for family in &defined {
            let text = &family.name.text;
            if families.iter().any(|known| name_of(known) == *text) {
                continue;
            }
            let what = format!("`{target}` has no {} `{text}`", kind.noun);
            let error = Diagnostic::new(family.extent, what);
            let names: Vec<String> = families.iter().map(name_of).collect();
            let question = did_you_mean(text, names.iter().map(String::as_str));
            let error = error.way_out(question.unwrap_or_else(|| {
                format!(
                    "on the left stand the names of `{target}`, on the right those of `{}`",
                    declaration.source.name
                )
            }));
            self.report(family.name, error);
        }
        let mut entries = Vec::new();
        let mut first = 0;
        for family in families {
            let text = name_of(family);
            let shape = Shape::of(&family.lengths);
            let places = first..first + shape.len();
            first = places.end;
            if let Some(found) = defined.iter().find(|defined| defined.name.text == text) {
                if found.lengths == family.lengths {
                    let values: Vec<_> =
                        found.entries.iter().map(|entry| (entry.value, entry.extent)).collect();
                    for (k, (place, (value, extent))) in places.zip(values).enumerate() {
                        entries.push((place, shape.entry_name(&text, k), extent, value));
                    }
                } else {
                    let error = Diagnostic::new(found.extent, format!("`{text}` has another shape"))
                        .evidence(format!("in `{target}` it is {shape}, here it is {}", found.shape()));
                    self.report(found.name, error);
                }
                continue;
            }
            if broken.iter().any(|name| name.text == text) {
                continue;
            }
            match self.scope.get(&text).cloned() {
                Some(Meaning::Named(named)) if kind.roles.contains(&named.role) && named.shape == shape => {
                    for (k, (place, symbol)) in places.zip(&named.symbols).enumerate() {
                        let value = self.graph.symbol(*symbol);
                        entries.push((place, shape.entry_name(&text, k), declaration.extent(), value));
                    }
                }
                _ if kind.implied => {}
                _ => self.not_given(declaration, &text, shape, kind),
            }
        }
        entries
    }

    /// Notes that a value has the unit which the target gives to what it is.
    fn has_unit_of_target(
        &mut self,
        declaration: &map_syntax::MorphismDecl,
        kind: &Kind,
        units: &[Quantity],
        (name, extent): (&str, Extent),
        value: ExprId,
    ) {
        let dimension = units.iter().find(|unit| unit.name == name).and_then(|unit| unit.dimension.clone());
        let Some(dimension) = dimension else { return };
        let target = &declaration.target.name;
        let expected = Measured::expected(format!("`{name}` of `{target}`"), extent).unit(dimension);
        let given = self.shown(value, extent);
        // each line is a place of its own
        let (section, place) = (kind.context.keyword(), self.homogeneity.noted.len());
        self.same_unit_in(section, place, "stands for", vec![expected, given]);
    }

    /// What expressions of a map add, compare and are, with the units of the source.
    pub(super) fn units_of_map(&mut self) {
        let Some(mut reading) = self.homogeneity.reading.take() else { return };
        if self.reports.any() {
            return;
        }
        let conditions = self.conditions(&mut reading);
        if let Err(violations) = infer(&self.graph, &conditions) {
            for violation in violations {
                let error = self.origins.diagnostic(violation);
                self.reports.report_missing(error);
            }
        }
    }

    /// Something of the target that is neither given nor has the name of something in the source.
    fn not_given(&mut self, declaration: &map_syntax::MorphismDecl, text: &str, shape: Shape, kind: &Kind) {
        let (source, target) = (&declaration.source.name, &declaration.target.name);
        let (noun, keyword) = (kind.noun, kind.context.keyword());
        let of_shape = if shape == Shape::Number { String::new() } else { format!(", {shape},") };
        let what = format!("the {noun} `{text}`{of_shape} of `{target}` is not given");
        let error = Diagnostic::new(declaration.target.extent, what)
            .evidence(format!("`{source}` has no {noun} of that name and shape"))
            .way_out(format!("add `{text} = …;` to `{keyword}`"));
        // each of them is a mistake of its own
        self.reports.report_missing(error);
    }
}

/// Entries by ids.
fn with_ids<I: Id>(entries: Entries) -> Vec<(I, Located)> {
    entries.into_iter().map(|(place, value)| (I::from_index(place), value)).collect()
}

/// The name of a family in the declaration.
fn name_of(family: &Family) -> String {
    family.ident.to_string().replace("r#", "")
}
