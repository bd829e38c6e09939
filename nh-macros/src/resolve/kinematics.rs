//! How quasi-velocities and rates belong together: the anchor, or a coframe.

use std::collections::BTreeMap;
use std::rc::Rc;

use nonholonomic_core::id::{CoordId, Id, Origin};
use nonholonomic_core::model::{AnchorDecl, Kinematics, Located};

use super::alike::Measured;
use super::array::{Part, Shape};
use super::context::Context;
use super::definitions::Entry;
use super::reports::Outcome;
use super::resolver::Resolver;
use super::scope::{Meaning, Role};
use crate::emit::Layout;
use crate::report::Diagnostic;
use crate::syntax::ast::{self, AnchorLine, Definition, Item, SystemDecl};

impl Resolver {
    /// After this point every section is known.
    pub(super) fn kinematics(&mut self, declaration: &SystemDecl, layout: &mut Layout) -> Kinematics {
        let sections = &declaration.sections;
        match (&sections.velocities, &sections.basis, &sections.anchor) {
            (Some(velocities), _, _) => self.coframe(velocities, declaration, layout),
            (None, None, _) => Kinematics::Tangent,
            (None, Some(_), Some(anchor)) => self.anchor(declaration, &anchor.body),
            (None, Some(_), None) => {
                if let Some(base) = &sections.base {
                    let first = base.body.first().map_or("x", |declared| declared.name.text.as_str());
                    let error =
                        Diagnostic::new(base.keyword.extent(), "`base` and `basis` without an `anchor`")
                            .evidence("the kinematic equations give the rate of every base coordinate")
                            .way_out(format!("add `anchor {{ der({first}) = …; }}`"));
                    self.report(&base.keyword, error);
                }
                Kinematics::Anchor(Vec::new())
            }
        }
    }

    fn anchor(&mut self, declaration: &SystemDecl, lines: &[Item<AnchorLine>]) -> Kinematics {
        let mut found: BTreeMap<CoordId, Option<AnchorDecl>> = BTreeMap::new();
        let mut lost = false;
        // what `for` makes of a line stands at one place
        let mut origins: BTreeMap<usize, Origin> = BTreeMap::new();
        self.section(Context::Anchor, lines, &mut |this, line| {
            let Ok((named, part)) = this.coordinate(&line.coordinate) else {
                // which coordinate was meant is not known, so none is said to be missing
                lost = true;
                return Err(super::reports::Reported);
            };
            let ids: Vec<_> = part.positions().map(|k| CoordId::from_index(named.first + k)).collect();
            let twice = ids.iter().find(|id| found.contains_key(id)).copied();
            for id in &ids {
                found.entry(*id).or_insert(None);
            }
            if let Some(twice) = twice {
                let name = &this.tables.coordinates[twice].name;
                let error = Diagnostic::new(line.extent, format!("`der({name})` is given twice"))
                    .way_out("keep one of the lines");
                return Err(this.report(line, error));
            }
            let rates = this.components(line, part, &line.value)?;
            let address = std::ptr::from_ref(line).addr();
            let extent = line.extent.to(line.value.extent);
            let origin = *origins.entry(address).or_insert_with(|| this.origin(extent));
            for (coordinate, rate) in ids.into_iter().zip(rates) {
                let declared = &this.tables.coordinates[coordinate];
                let expected = Measured::expected(format!("`der({})`", declared.name), line.extent);
                let expected = expected.symbol(declared.symbol, 1).time(-1);
                let given = if part.shape == Shape::Number {
                    this.written(&line.value, rate, None)
                } else {
                    this.shown(rate, line.value.extent)
                };
                this.same_unit(line, "equals", vec![expected, given]);
                found.insert(coordinate, Some(AnchorDecl { coordinate, rate, origin }));
            }
            Ok(())
        });
        if !lost {
            self.missing_lines(declaration, &found);
        }
        let lines: Vec<AnchorDecl> = found.into_values().flatten().collect();
        let rate = |line: &AnchorDecl| (self.tables.coordinates[line.coordinate].rate, line.rate);
        self.anchor_lines = Some(lines.iter().map(rate).collect());
        Kinematics::Anchor(lines)
    }

    /// The entries of a value that has the shape of a left-hand side.
    pub(super) fn components<N>(
        &mut self,
        line: &N,
        left: Part,
        value: &ast::Expr,
    ) -> Outcome<Vec<nonholonomic_core::id::ExprId>> {
        let right = self.value(value)?;
        if let Some(right) = self.in_shape(&right, left.shape) {
            return Ok(right.entries);
        }
        let error = Diagnostic::new(value.extent, "the two sides have different shapes")
            .evidence(format!("on the left is {}, on the right {}", left.shape, right.shape));
        Err(self.report(line, error))
    }

    /// Every coordinate has its line.
    fn missing_lines(&mut self, declaration: &SystemDecl, found: &BTreeMap<CoordId, Option<AnchorDecl>>) {
        const SHOWN: usize = 4;
        for declared in declaration.sections.base.iter().flat_map(|base| &base.body) {
            let Some(Meaning::Named(named)) = self.scope.get(&declared.name.text).cloned() else { continue };
            if named.role != Role::Coordinate {
                continue;
            }
            let missing: Vec<_> = (0..named.shape.len())
                .filter(|k| !found.contains_key(&CoordId::from_index(named.first + k)))
                .map(|k| named.shape.entry_name(&declared.name.text, k))
                .collect();
            let Some(first) = missing.first() else { continue };
            let shown: Vec<_> = missing.iter().take(SHOWN).map(|name| format!("`{name}`")).collect();
            let rest = missing.len() - shown.len();
            let more = if rest == 0 { String::new() } else { format!(" and {rest} more") };
            let error = Diagnostic::new(
                declared.extent,
                format!("the anchor has no line for {}{more}", shown.join(", ")),
            )
            .evidence("the kinematic equations give the rate of every base coordinate")
            .way_out(format!("add `der({first}) = …;`, or `der({first}) = 0;` if it never changes"));
            self.report(declared, error);
        }
    }

    fn coframe(
        &mut self,
        velocities: &ast::Section<Vec<Item<Definition>>>,
        declaration: &SystemDecl,
        layout: &mut Layout,
    ) -> Kinematics {
        let (defined, broken) = self.definitions(Context::Velocities, &velocities.body);
        let whole = broken.is_empty();
        self.spoil(&broken);
        let count = defined.iter().map(|family| family.entries.len()).sum();
        self.check_dimension(&velocities.keyword, count, Role::Velocity);
        let mut rows = Vec::with_capacity(count);
        for family in &defined {
            let checked = self.scope.check_new(family.name);
            if self.keep(family.name, checked).is_err() {
                continue;
            }
            let Ok(named) = self.enter(&family.name.text, family.shape(), Role::Velocity, family.extent)
            else {
                continue;
            };
            let symbols = named.symbols.clone();
            self.scope.insert(family.name.text.clone(), Meaning::Named(Rc::new(named)));
            let rate: Vec<_> = family.entries.iter().map(|entry| entry.value).collect();
            self.spins(&rate, &symbols);
            layout.velocities.push(family.family());
            for (Entry { value, extent, place }, symbol) in family.entries.iter().copied().zip(symbols) {
                let name = format!("`{}`", self.graph.symbols()[symbol]);
                let expected = Measured::expected(name, extent).symbol(symbol, 1);
                let given = self.shown(value, extent);
                self.same_unit_of(place, "equals", vec![expected, given]);
                rows.push(Located { value, origin: self.origin(extent) });
            }
        }
        let wanted = self.tables.coordinates.len();
        if whole && count != wanted && declaration.sections.base.is_some() {
            let error = Diagnostic::new(
                velocities.keyword.extent(),
                format!(
                    "the coframe is not square: {count} quasi-{} for {wanted} base {}",
                    if count == 1 { "velocity" } else { "velocities" },
                    if wanted == 1 { "coordinate" } else { "coordinates" },
                ),
            )
            .way_out("define one quasi-velocity for each base coordinate, or use `basis` and `anchor`")
            .lacking(wanted.saturating_sub(count));
            self.report(&velocities.keyword, error);
        }
        Kinematics::Coframe(rows)
    }
}
