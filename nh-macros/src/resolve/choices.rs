//! What the user chooses: independent velocities, the formulation, names of types, the runtime.

use std::collections::BTreeSet;
use std::rc::Rc;

use nonholonomic_core::algebra::Accuracy;
use nonholonomic_core::id::{Origin, SymbolId};
use nonholonomic_core::model::Formulation;
use proc_macro2::Ident;
use quote::quote;

use super::alike::Measured;
use super::array::Shape;
use super::reports::Outcome;
use super::resolver::Resolver;
use super::scope::{Meaning, Role};
use crate::emit::{Family, Layout, TypeNames};
use crate::report::{Diagnostic, Extent};
use crate::suggest::did_you_mean;
use crate::syntax::ast::{self, Declared, Name, Renaming, Section, Sections, SystemDecl, Velocity};

/// Variables that a section lists, and where.
type Listed = Vec<(SymbolId, Origin)>;

impl Resolver {
    /// The coordinates that are a chart of where positions are bound, and the velocities that the adapted state keeps,
    /// each once; a kind of which none is named is left to be chosen.
    pub(super) fn independent(&mut self, sections: &Sections) -> (Option<Listed>, Option<Listed>) {
        let Some(Section { body: named, .. }) = &sections.independent else { return (None, None) };
        let positions_are_bound = sections.holonomic.is_some() || sections.on.is_some();
        let (mut coordinates, mut velocities) = (Listed::new(), Listed::new());
        let mut seen = BTreeSet::new();
        let mut is_broken = false;
        for entry in named {
            let chart = if positions_are_bound { self.coordinates_named(entry) } else { None };
            let (found, kind) = match chart {
                Some(_) => (&mut coordinates, "coordinate"),
                None => (&mut velocities, "velocity"),
            };
            let Ok((symbols, extent)) = chart.unwrap_or_else(|| self.velocities(entry)) else {
                is_broken = true;
                continue;
            };
            let origin = self.origin(extent);
            for symbol in symbols {
                if seen.insert(symbol) {
                    found.push((symbol, origin));
                } else {
                    let name = &self.graph.symbols()[symbol];
                    let error = Diagnostic::new(extent, format!("the {kind} `{name}` is named twice"));
                    self.report(entry, error);
                }
            }
        }
        // an empty list names no velocities, of which there may be none to name
        let velocities =
            (!velocities.is_empty() || coordinates.is_empty() || is_broken).then_some(velocities);
        ((!coordinates.is_empty()).then_some(coordinates), velocities)
    }

    /// The coordinates of an entry that names some, with its extent.
    fn coordinates_named(&mut self, entry: &Velocity) -> Option<Outcome<(Vec<SymbolId>, Extent)>> {
        let Velocity::Named(place) = entry else { return None };
        match self.scope.get(&place.name.text) {
            Some(Meaning::Named(named)) if named.role == Role::Coordinate => {}
            _ => return None,
        }
        Some(
            self.coordinate(place)
                .map(|(named, part)| (named.symbols[part.positions()].to_vec(), place.extent)),
        )
    }

    /// The velocities of an orthonormal basis of D: named when every expression has been read, since
    /// they have a meaning in the state alone.
    pub(super) fn orthonormal(
        &mut self,
        section: &Section<Vec<Declared>>,
        layout: &mut Layout,
    ) -> (Vec<SymbolId>, Origin) {
        let mut symbols = Vec::new();
        for declared in &section.body {
            let checked = self.scope.check_new(&declared.name);
            if self.keep(&declared.name, checked).is_err() {
                continue;
            }
            let (text, shape) = (&declared.name.text, Shape::of(&declared.lengths));
            let Ok(named) = self.enter(text, shape, Role::FrameVelocity, declared.extent) else { continue };
            for symbol in &named.symbols {
                // T is half the sum of their squares
                let name = &self.graph.symbols()[*symbol];
                let square = Measured::expected(format!("the square of `{name}`"), declared.extent);
                let square = square.symbol(*symbol, 2);
                let energy = Measured::expected("the kinetic energy", declared.extent).energy(1);
                let place = std::ptr::from_ref(declared).addr();
                self.same_unit_in("orthonormal", place, "is a part of", vec![energy, square]);
            }
            symbols.extend(&named.symbols);
            self.scope.insert(text.clone(), Meaning::Named(Rc::new(named)));
            layout.frame.push(Family::from(declared));
        }
        (symbols, self.origin(section.keyword.extent()))
    }

    /// The formulation that is asked for.
    pub(super) fn formulation(&mut self, asked: &Section<ast::Formulation>) -> (Formulation, Origin) {
        let formulation = match asked.body {
            ast::Formulation::Adapted => Formulation::Adapted,
            ast::Formulation::Projected => Formulation::Projected,
        };
        (formulation, self.origin(asked.keyword.extent()))
    }

    /// The level of accuracy that is asked for.
    pub(super) fn accuracy(&mut self, asked: &Section<Name>) -> Accuracy {
        const LEVELS: [(&str, Accuracy); 3] =
            [("fast", Accuracy::Fast), ("balanced", Accuracy::Balanced), ("careful", Accuracy::Careful)];
        let text = asked.body.text.as_str();
        if let Some((_, level)) = LEVELS.iter().find(|(known, _)| *known == text) {
            return *level;
        }
        let error = Diagnostic::new(asked.body.extent(), format!("unknown level of accuracy `{text}`"));
        let error = match did_you_mean(text, LEVELS.map(|(known, _)| known)) {
            Some(question) => {
                error.evidence("the levels are `fast`, `balanced` and `careful`").way_out(question)
            }
            None => error.way_out("write `fast`, `balanced` or `careful`"),
        };
        self.report(&asked.body, error);
        Accuracy::default()
    }

    /// The names of the generated types, all different, and the path of the runtime.
    pub(super) fn surroundings(&mut self, declaration: &SystemDecl, layout: &mut Layout) {
        if let Some(runtime) = &declaration.sections.runtime {
            let path = &runtime.body;
            layout.runtime = quote!(#path);
        }
        let Some(names) = &declaration.sections.names else { return };
        let mut renamed = BTreeSet::new();
        for Renaming { role, name } in &names.body {
            if !renamed.insert(role.text.as_str()) {
                let what = format!("the type `{}` is renamed twice", role.text);
                self.report(role, Diagnostic::new(role.extent(), what).way_out("keep one of the names"));
                continue;
            }
            if let Some(slot) = slot(&mut layout.types, &role.text) {
                *slot = name.ident.clone();
            }
        }
        let mut taken = BTreeSet::from([layout.name.to_string()]);
        let types = layout.types.clone();
        let of_motion =
            [types.state, types.coordinate, types.variable, types.velocity, types.input, types.outputs];
        let of_constraints = [types.multipliers, types.reactions, types.residual];
        let of_momenta =
            [types.momenta, types.phase, types.quadratures, types.gyroscopic, types.power, types.impulses];
        let mut is_twice = false;
        for name in of_motion.into_iter().chain(of_constraints).chain(of_momenta) {
            if !taken.insert(name.to_string()) {
                let blamed = names.body.iter().rev().find(|renaming| renaming.name.ident == name);
                let extent = blamed.map_or(names.keyword.extent(), |renaming| renaming.name.extent());
                let error = Diagnostic::new(extent, format!("two types are called `{name}`"))
                    .evidence("the struct and the types generated for it need names of their own")
                    .way_out("choose another name");
                match blamed {
                    Some(renaming) => self.report(renaming, error),
                    None => self.report(&names.keyword, error),
                };
                is_twice = true;
            }
        }
        if is_twice {
            // so that stubs do not collide
            layout.types = TypeNames::of(&layout.name);
        }
    }
}

/// The name that a role of `names` renames.
fn slot<'a>(types: &'a mut TypeNames, role: &str) -> Option<&'a mut Ident> {
    match role {
        "state" => Some(&mut types.state),
        "velocity" => Some(&mut types.velocity),
        "input" => Some(&mut types.input),
        "multipliers" => Some(&mut types.multipliers),
        "outputs" => Some(&mut types.outputs),
        "reactions" => Some(&mut types.reactions),
        "residual" => Some(&mut types.residual),
        "momenta" => Some(&mut types.momenta),
        "phase" => Some(&mut types.phase),
        "quadratures" => Some(&mut types.quadratures),
        "gyroscopic" => Some(&mut types.gyroscopic),
        "power" => Some(&mut types.power),
        "coordinate" => Some(&mut types.coordinate),
        "variable" => Some(&mut types.variable),
        "impulses" => Some(&mut types.impulses),
        _ => None,
    }
}

/// Where errors about the whole declaration point.
pub(super) fn whole(declaration: &SystemDecl) -> Extent {
    Extent::at(declaration.structure.name.span())
}
