//! Declared names: symbols, tables of the model, and the layout of generated types.

use std::collections::BTreeSet;
use std::rc::Rc;

use nonholonomic_core::algebra::Constant;
use nonholonomic_core::id::{ConstantId, Id, ParamId, SymbolId};
use nonholonomic_core::model::{AuxiliaryDecl, Coordinate, Input, Located, Parameter, Section};
use quote::format_ident;

use super::array::{Array, Shape};
use super::context::{Context, VARYING};
use super::reports::Outcome;
use super::resolver::Resolver;
use super::scope::{Meaning, Named, Numbers, Role};
use super::statements;
use crate::emit::{Family, Layout};
use crate::report::Diagnostic;
use crate::syntax::ast::{self, Declared, Definition, Name, PositionLine, SystemDecl};

/// Coordinates or velocities of a system: matrices of this size are inverted.
pub(super) const DIMENSION: usize = 512;

impl Resolver {
    /// Declares everything that lists and fields name. After this point every name is known
    /// but those that `velocities` defines.
    pub(super) fn declare(&mut self, declaration: &SystemDecl, layout: &mut Layout) {
        let sections = &declaration.sections;
        self.scope.skipped = declaration.structure.skipped.iter().map(|name| name.text.clone()).collect();
        for declared in &declaration.structure.parameters {
            // a family in error was reported; the others go on
            let _ = self.family(declared, Role::Parameter);
        }
        layout.coordinates = self.list(sections.base.as_ref(), Role::Coordinate);
        layout.velocities = match &sections.basis {
            Some(_) => self.list(sections.basis.as_ref(), Role::Velocity),
            None if sections.velocities.is_none() => self.implied_velocities(sections.base.as_ref()),
            None => Vec::new(),
        };
        layout.inputs = self.list(sections.inputs.as_ref(), Role::Input);
        self.declare_auxiliary(sections.auxiliary.as_ref(), layout);
        self.share(declaration);
        let names =
            sections.velocities.iter().chain(&sections.frame).flat_map(|s| statements::statements(&s.body));
        self.scope.pending = names.map(|definition| definition.name.text.clone()).collect();
        for constant in sections.constants.iter().flat_map(|section| &section.body) {
            // one in error was reported
            let _ = self.constant(constant);
        }
        let names = sections.outputs.iter().flat_map(|s| statements::statements(&s.body));
        self.scope.outputs = names.map(|definition| definition.name.text.clone()).collect();
        self.scope.labels = labels(sections).map(|name| name.text.clone()).collect();
    }

    /// A list of names, and those that are in order.
    fn list(&mut self, section: Option<&ast::Section<Vec<Declared>>>, role: Role) -> Vec<Family> {
        let Some(section) = section else { return Vec::new() };
        self.check_dimension(
            &section.keyword,
            section.body.iter().map(|d| Shape::of(&d.lengths).len()).sum(),
            role,
        );
        section
            .body
            .iter()
            .filter_map(|declared| self.family(declared, role).map(|()| Family::from(declared)).ok())
            .collect()
    }

    /// Refuses systems that nobody could wait for.
    pub(super) fn check_dimension(&mut self, keyword: &Name, count: usize, role: Role) {
        if count > DIMENSION && matches!(role, Role::Coordinate | Role::Velocity) {
            let what = format!("`{}` declares {count} entries", keyword.text);
            let error = Diagnostic::new(keyword.extent(), what)
                .way_out(format!("at most {DIMENSION} can be treated; split the system"));
            // the rest of the declaration is not worth looking at
            self.report(keyword, error);
            self.reports.stop();
        }
    }

    /// One declared name.
    fn family(&mut self, declared: &Declared, role: Role) -> Outcome<()> {
        let checked = self.scope.check_new(&declared.name);
        if let Err(reported) = self.keep(&declared.name, checked) {
            // which of its meanings a use has is not known: uses are silent
            self.scope.insert(declared.name.text.clone(), Meaning::Broken);
            return Err(reported);
        }
        let text = &declared.name.text;
        let mut named = self.enter(text, Shape::of(&declared.lengths), role, declared.extent)?;
        if let (true, Shape::Matrix(n, _)) = (declared.symmetric, named.shape) {
            self.symmetric_entries(&mut named, n);
        }
        let outcome = self.scope.declare(&declared.name, Meaning::Named(Rc::new(named)));
        self.keep(&declared.name, outcome)
    }

    /// Entries below the diagonal stand for those above it.
    fn symmetric_entries(&mut self, named: &mut Named, n: usize) {
        for row in 0..n {
            for column in 0..row {
                let (upper, lower) = (column * n + row, row * n + column);
                named.symbols[lower] = named.symbols[upper];
                let id = |entry: usize| ParamId::from_index(named.first + entry);
                self.symmetric.push((id(upper), id(lower)));
            }
        }
    }

    /// A name for numbers.
    fn constant(&mut self, constant: &Definition) -> Outcome<()> {
        let fresh = self.scope.check_new(&constant.name);
        let fresh = self.keep(&constant.name, fresh);
        let value = self.numbers(constant);
        fresh?;
        let meaning = match &value {
            Ok(values) => {
                let origin = self.origin(constant.value.extent);
                for value in &values.entries {
                    if self.graph.as_number(*value).is_none() {
                        self.dropped.push(Located { value: *value, origin });
                    }
                }
                let names = self.constants_of(&constant.name.text, values);
                Meaning::Constant(Rc::new(Numbers { values: values.clone(), names }))
            }
            Err(_) => Meaning::Broken,
        };
        self.scope.insert(constant.name.text.clone(), meaning);
        value.map(|_| ())
    }

    /// Constants of the graph for the rational numbers among the values.
    fn constants_of(&mut self, text: &str, values: &Array) -> Vec<Option<ConstantId>> {
        let mut names = Vec::with_capacity(values.entries.len());
        for (entry, value) in values.entries.iter().enumerate() {
            let value = self.graph.as_number(*value).filter(|value| !value.is_zero()).cloned();
            let name = values.shape.entry_name(text, entry);
            names.push(value.map(|value| self.graph.new_constant(Constant { name, value })));
        }
        names
    }

    /// A value in which nothing varies.
    fn numbers(&mut self, constant: &Definition) -> Outcome<Array> {
        if !constant.subscripts.is_empty() {
            let error = Diagnostic::new(constant.extent, "a constant is given as a whole").way_out(format!(
                "write `{} = [1, 2, 3];`, a vector, or a vector of rows",
                constant.name.text
            ));
            return Err(self.report(&constant.name, error));
        }
        self.context = Context::Constants;
        let value = self.value(&constant.value)?;
        let Some(symbol) = self.graph.symbols_in(&value.entries).into_iter().next() else { return Ok(value) };
        let name = &self.graph.symbols()[symbol];
        let error =
            Diagnostic::new(constant.value.extent, format!("`{}` is not constant", constant.name.text))
                .evidence(format!("it depends on `{name}`"))
                .way_out(VARYING);
        Err(self.report(&constant.value, error))
    }

    /// Enters a family into its table of the model.
    pub(super) fn enter(
        &mut self,
        text: &str,
        shape: Shape,
        role: Role,
        extent: crate::report::Extent,
    ) -> Outcome<Named> {
        self.reports.spend(extent, shape.len())?;
        let origin = self.origin(extent);
        let first = match role {
            Role::Parameter => self.tables.parameters.len(),
            Role::Coordinate => self.tables.coordinates.len(),
            Role::Velocity | Role::ImpliedVelocity => self.tables.sections.len(),
            Role::FrameVelocity => self.tables.frame.len(),
            Role::Input => self.tables.inputs.len(),
            Role::Auxiliary => self.tables.auxiliary.len(),
        };
        let (mut symbols, mut rates): (Vec<SymbolId>, Vec<SymbolId>) = (Vec::new(), Vec::new());
        for entry in 0..shape.len() {
            let name = shape.entry_name(text, entry);
            let symbol = self.graph.new_symbol(name.clone());
            symbols.push(symbol);
            match role {
                Role::Parameter => {
                    self.tables.parameters.push(Parameter { name, symbol, origin });
                }
                Role::Coordinate => {
                    let rate = self.graph.new_symbol(format!("der({name})"));
                    rates.push(rate);
                    self.tables.coordinates.push(Coordinate { name, symbol, rate, origin });
                }
                Role::Velocity | Role::ImpliedVelocity => {
                    self.tables.sections.push(Section { name, symbol, origin });
                }
                // entered with their values
                Role::FrameVelocity => {}
                Role::Input => {
                    self.tables.inputs.push(Input { name, symbol, origin });
                }
                Role::Auxiliary => {
                    let rate = self.graph.new_symbol(format!("der({name})"));
                    rates.push(rate);
                    // its value is read when all names are known
                    let value = self.graph.zero();
                    self.tables.auxiliary.push(AuxiliaryDecl { name, symbol, rate, value, origin });
                }
            }
        }
        Ok(Named { role, shape, first, symbols, rates, extent })
    }

    /// E = TM: the velocity of `x` is called `x_dot`, and is its rate.
    fn implied_velocities(&mut self, base: Option<&ast::Section<Vec<Declared>>>) -> Vec<Family> {
        let mut families = Vec::new();
        let mut seen = BTreeSet::new();
        for declared in base.map_or(&[][..], |base| &base.body) {
            let Some(Meaning::Named(coordinate)) = self.scope.get(&declared.name.text).cloned() else {
                continue;
            };
            if coordinate.role != Role::Coordinate || !seen.insert(declared.name.text.as_str()) {
                continue;
            }
            let text = format!("{}_dot", declared.name.text);
            if self.implied_name_is_taken(declared, &text) {
                continue;
            }
            let Ok(velocity) = self.enter(&text, coordinate.shape, Role::ImpliedVelocity, declared.extent)
            else {
                continue;
            };
            let ids: Vec<_> = self.tables.coordinates.ids().collect();
            for (entry, symbol) in velocity.symbols.iter().enumerate() {
                self.tables.coordinates[ids[coordinate.first + entry]].rate = *symbol;
            }
            let same = Named {
                role: Role::Coordinate,
                shape: coordinate.shape,
                first: coordinate.first,
                symbols: coordinate.symbols.clone(),
                rates: velocity.symbols.clone(),
                extent: coordinate.extent,
            };
            self.scope.insert(declared.name.text.clone(), Meaning::Named(Rc::new(same)));
            self.scope.insert(text.clone(), Meaning::Named(Rc::new(velocity)));
            families.push(Family {
                ident: format_ident!("{text}", span = declared.name.ident.span()),
                lengths: declared.lengths.clone(),
                docs: proc_macro2::TokenStream::new(),
                units: Vec::new(),
            });
        }
        families
    }

    /// Whether something else has the name of an implied velocity, which is an error.
    fn implied_name_is_taken(&mut self, declared: &Declared, text: &str) -> bool {
        let extent = match self.scope.get(text) {
            None => return false,
            Some(Meaning::Named(named)) => named.extent,
            Some(_) => declared.extent,
        };
        let x = &declared.name.text;
        let error = Diagnostic::new(extent, format!("`{text}` is declared twice"))
            .evidence(format!(
                "without a `basis`, the velocity of `{x}` is called `{text}` in generated code"
            ))
            .way_out("choose another name");
        self.report(declared, error);
        true
    }
}

/// The labels of constraints and symmetries, and the names of claims.
fn labels(sections: &ast::Sections) -> impl Iterator<Item = &Name> {
    let constraints = sections.constraints.iter().flat_map(|s| statements::statements(&s.body));
    let positions = sections.holonomic.iter().flat_map(|s| statements::statements(&s.body));
    let positions = positions.filter_map(|line| match line {
        PositionLine::Equation(equation) => Some(&**equation),
        PositionLine::Redundant(_) => None,
    });
    let symmetries = sections.symmetries.iter().flat_map(|s| statements::statements(&s.body));
    let claims = sections.conserved.iter().flat_map(|s| statements::statements(&s.body));
    let equations = constraints.chain(positions).filter_map(|equation| equation.label.as_ref());
    equations.chain(symmetries.map(|line| &line.label)).chain(claims.map(|claim| &claim.name))
}
