//! The Lagrangian, constraints, forces and outputs.

use std::collections::{BTreeMap, BTreeSet};

use nonholonomic_core::id::{ExprId, SymbolId};
use nonholonomic_core::model::{
    AnchorDecl, ConstraintDecl, ForceDecl, ForceDirection, Kinematics, Located, OutputDecl,
};

use super::alike::Measured;
use super::array::Shape;
use super::context::Context;
use super::holonomic::Labels;
use super::reports::Outcome;
use super::resolver::Resolver;
use crate::emit::Layout;
use crate::report::Diagnostic;
use crate::syntax::ast::{Definition, Equation, Expr, ExprKind, Force, Item, Lagrangian};

impl Resolver {
    /// L(t, x, y).
    pub(super) fn lagrangian(&mut self, lagrangian: &Lagrangian) -> Outcome<Located> {
        self.context = Context::Lagrangian;
        let depth = self.scope.depth();
        self.open_conditions();
        for line in &lagrangian.lets {
            // an abbreviation in error was reported, and its uses are silent
            let _ = self.abbreviation(line);
        }
        let value = self.number_value(&lagrangian.value);
        if let Ok(value) = value {
            let expected = Measured::expected("the Lagrangian", lagrangian.value.extent).energy(1);
            let given = self.written(&lagrangian.value, value, None);
            self.same_unit(lagrangian, "is", vec![expected, given]);
        }
        self.close_conditions();
        self.scope.leave(depth);
        let origin = self.origin(lagrangian.value.extent);
        Ok(Located { value: value?, origin })
    }

    /// φ = lhs − rhs; vectors entry by entry. What is in error is kept as far as the left-hand side,
    /// which tells what the state would be; `lost` are those of which no more could be read.
    pub(super) fn constraints(
        &mut self,
        items: &[Item<Equation>],
        lost: &[Option<Box<Expr>>],
        kinematics: &Kinematics,
        labels: &mut Labels,
    ) -> Vec<ConstraintDecl> {
        let mut found = Vec::new();
        let lone = self.lone_rates(kinematics);
        self.section(Context::Constraints, items, &mut |this, equation| {
            let constraints = this.constraint(equation, &lone, labels).inspect_err(|_| {
                let placeholder = this.placeholder(Some(&equation.left), &lone);
                found.push(placeholder);
            })?;
            found.extend(constraints);
            if let Some(label) = &equation.label {
                this.abbreviates(&label.text);
            }
            Ok(())
        });
        for left in lost {
            let placeholder = self.placeholder(left.as_deref(), &lone);
            found.push(placeholder);
        }
        by_label(found, |constraint| constraint.label.as_deref())
    }

    /// Stands for a constraint in error, in a model that is not compiled.
    fn placeholder(&mut self, left: Option<&Expr>, lone: &Lone) -> ConstraintDecl {
        let residual = self.graph.zero();
        let solved_for = left.and_then(|left| {
            let entry = self.value(left).ok()?.as_number()?;
            self.solved_for(left, entry, residual, lone).ok()?
        });
        ConstraintDecl { label: None, residual, solved_for, is_entry: false, origin: Self::whole() }
    }

    fn constraint(
        &mut self,
        equation: &Equation,
        lone: &Lone,
        labels: &mut Labels,
    ) -> Outcome<Vec<ConstraintDecl>> {
        let (left, right) = self.sides(equation)?;
        let origin = self.origin(equation.extent);
        let around = self.scope.loop_values();
        let is_entry = left.entries.len() > 1;
        let mut found = Vec::new();
        for (k, (left_entry, right_entry)) in left.entries.iter().zip(&right.entries).enumerate() {
            let indices = left.shape.indices(k);
            let label = self.new_label(equation.label.as_ref(), &around, &indices, labels)?;
            let residual = self.residual(equation, *left_entry, *right_entry)?;
            // a vector equation says nothing of which velocity it is to be solved for
            let solved_for = match left.shape {
                Shape::Number => self.solved_for(&equation.left, *left_entry, *right_entry, lone)?,
                _ => None,
            };
            found.push(ConstraintDecl { label, residual, solved_for, is_entry, origin });
        }
        Ok(found)
    }

    /// The velocity on the left, if it stands alone and is absent on the right.
    fn solved_for(
        &mut self,
        left: &Expr,
        entry: ExprId,
        right: ExprId,
        lone: &Lone,
    ) -> Outcome<Option<SymbolId>> {
        if !stands_alone(left) {
            return Ok(None);
        }
        let Some(symbol) = self.graph.as_symbol(entry) else { return Ok(None) };
        let velocity = lone.velocity_of_rate.get(&symbol).copied().unwrap_or(symbol);
        let is_velocity = self.tables.sections.iter().any(|section| section.symbol == velocity)
            || self.tables.frame.iter().any(|section| section.symbol == velocity)
            || self.tables.coordinates.iter().any(|coordinate| coordinate.rate == velocity);
        if !is_velocity {
            return Ok(None);
        }
        let mut absent: BTreeSet<SymbolId> = [symbol, velocity].into();
        absent.extend(lone.rates_with_velocity.get(&velocity).into_iter().flatten());
        let occurs = self.occurs(left, right, &absent)?;
        Ok((!occurs).then_some(velocity))
    }

    /// Whether one of the symbols occurs in an expression.
    fn occurs(&mut self, at: &Expr, root: ExprId, symbols: &BTreeSet<SymbolId>) -> Outcome<bool> {
        let mut seen = BTreeSet::from([root]);
        let mut open = vec![root];
        while let Some(id) = open.pop() {
            if self.graph.as_symbol(id).is_some_and(|symbol| symbols.contains(&symbol)) {
                return Ok(true);
            }
            let operands: Vec<_> = self.graph.node(id).operands().collect();
            self.reports.spend(at.extent, 1 + operands.len())?;
            open.extend(operands.into_iter().filter(|operand| seen.insert(*operand)));
        }
        Ok(false)
    }

    /// What the kinematics says about rates.
    fn lone_rates(&mut self, kinematics: &Kinematics) -> Lone {
        let mut lone = Lone::default();
        match kinematics {
            Kinematics::Tangent => {}
            Kinematics::Anchor(lines) => {
                for AnchorDecl { coordinate, rate, .. } in lines {
                    let symbol = self.tables.coordinates[*coordinate].rate;
                    if let Some(velocity) = self.graph.as_symbol(*rate) {
                        lone.velocity_of_rate.insert(symbol, velocity);
                    }
                    for velocity in self.graph.symbols_in(&[*rate]) {
                        lone.rates_with_velocity.entry(velocity).or_default().push(symbol);
                    }
                }
            }
            Kinematics::Coframe(rows) => {
                for (row, section) in rows.iter().zip(&self.tables.sections) {
                    if let Some(rate) = self.graph.as_symbol(row.value) {
                        lone.velocity_of_rate.insert(rate, section.symbol);
                        lone.rates_with_velocity.entry(section.symbol).or_default().push(rate);
                    }
                }
            }
        }
        lone
    }

    /// Forces along sections and coordinates; families entry by entry.
    pub(super) fn forces(&mut self, items: &[Item<Force>]) -> Vec<ForceDecl> {
        let mut found = Vec::new();
        let mut seen = Vec::new();
        self.section(Context::Forces, items, &mut |this, force| {
            let directions = this.directions(&force.along);
            let Ok((directions, part)) = directions else {
                // mistakes on the right are found too
                this.value(&force.value)?;
                return Err(super::reports::Reported);
            };
            let values = this.components(force, part, &force.value)?;
            let (shape, first) = (part.shape, seen.len());
            let origin = this.origin(force.along.extent.to(force.value.extent));
            for (direction, value) in directions.into_iter().zip(values) {
                if seen.contains(&direction) {
                    let error = Diagnostic::new(
                        force.along.extent,
                        format!("the force along `{}` is given twice", force.along.name.text),
                    )
                    .way_out("write one line with the sum");
                    return Err(this.report(force, error));
                }
                let entry = (shape != Shape::Number).then(|| seen.len() - first);
                let expected = this.force_along(direction, force, entry);
                let given = this.written(&force.value, value, entry);
                this.same_unit(force, "is", vec![expected, given]);
                seen.push(direction);
                found.push(ForceDecl { direction, value, origin });
            }
            Ok(())
        });
        found
    }

    /// What a force is expected to be: along a section, Υ_α times y^α is a power.
    fn force_along(&self, direction: ForceDirection, force: &Force, entry: Option<usize>) -> Measured {
        let along = match direction {
            ForceDirection::Section(symbol) => symbol,
            ForceDirection::Coordinate(id) => self.tables.coordinates[id].symbol,
        };
        let name = match (entry, force.along.indices.as_slice()) {
            (None, []) => &force.along.name.text,
            _ => &self.graph.symbols()[along],
        };
        let text = format!("the force along `{name}`");
        let expected = Measured::expected(text, force.along.extent).energy(1).symbol(along, -1);
        match direction {
            ForceDirection::Section(_) => expected.time(-1),
            ForceDirection::Coordinate(_) => expected,
        }
    }

    /// Named observables.
    pub(super) fn outputs(&mut self, items: &[Item<Definition>], layout: &mut Layout) -> Vec<OutputDecl> {
        let (defined, _) = self.definitions(Context::Outputs, items);
        let mut found = Vec::new();
        for family in &defined {
            layout.outputs.push(family.family());
            for (k, entry) in family.entries.iter().enumerate() {
                let name = family.shape().entry_name(&family.name.text, k);
                found.push(OutputDecl { name, value: entry.value, origin: self.origin(entry.extent) });
            }
        }
        found
    }
}

/// Whether an expression is a name, an entry, or the rate of one of these.
fn stands_alone(expr: &Expr) -> bool {
    match &expr.kind {
        ExprKind::Name(_) | ExprKind::Index(..) => true,
        ExprKind::Der(of) => matches!(of.kind, ExprKind::Name(_) | ExprKind::Index(..)),
        _ => false,
    }
}

/// Equations with those of the same array beside them, in the order of the first of each.
pub(super) fn by_label<T>(equations: Vec<T>, label: impl Fn(&T) -> Option<&str>) -> Vec<T> {
    let mut first: BTreeMap<String, usize> = BTreeMap::new();
    let place = |(index, equation): (usize, T)| {
        let array = label(&equation).and_then(|label| label.split_once('['));
        let place = array.map_or(index, |(name, _)| *first.entry(name.to_owned()).or_insert(index));
        (place, equation)
    };
    let mut placed: Vec<(usize, T)> = equations.into_iter().enumerate().map(place).collect();
    placed.sort_by_key(|(place, _)| *place);
    placed.into_iter().map(|(_, equation)| equation).collect()
}

/// Rates that are a quasi-velocity, and rates in which one occurs.
#[derive(Default)]
struct Lone {
    velocity_of_rate: BTreeMap<SymbolId, SymbolId>,
    rates_with_velocity: BTreeMap<SymbolId, Vec<SymbolId>>,
}
