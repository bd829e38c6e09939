//! The Lagrangian, constraints, forces and outputs.

use std::collections::{BTreeMap, BTreeSet};

use nonholonomic_core::id::{ConstraintId, ExprId, SymbolId, Table};
use nonholonomic_core::model::{AnchorDecl, ConstraintDecl, ForceDecl, Kinematics, Located, OutputDecl};

use super::context::Context;
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
        for line in &lagrangian.lets {
            // an abbreviation in error was reported, and its uses are silent
            let _ = self.abbreviation(line);
        }
        let value = self.number_value(&lagrangian.value);
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
    ) -> Table<ConstraintId, ConstraintDecl> {
        let mut found = Table::new();
        let mut labels = BTreeSet::new();
        let lone = self.lone_rates(kinematics);
        self.section(Context::Constraints, items, &mut |this, equation| {
            let constraints = this.constraint(equation, &lone, &mut labels).inspect_err(|_| {
                let placeholder = this.placeholder(Some(&equation.left), &lone);
                found.push(placeholder);
            })?;
            for constraint in constraints {
                found.push(constraint);
            }
            Ok(())
        });
        for left in lost {
            let placeholder = self.placeholder(left.as_deref(), &lone);
            found.push(placeholder);
        }
        found
    }

    /// Stands for a constraint in error, in a model that is not compiled.
    fn placeholder(&mut self, left: Option<&Expr>, lone: &Lone) -> ConstraintDecl {
        let residual = self.graph.zero();
        let solved_for = left.and_then(|left| {
            let entry = self.value(left).ok()?.as_number()?;
            self.solved_for(left, entry, residual, lone).ok()?
        });
        ConstraintDecl { label: None, residual, solved_for, origin: Self::whole() }
    }

    fn constraint(
        &mut self,
        equation: &Equation,
        lone: &Lone,
        labels: &mut BTreeSet<String>,
    ) -> Outcome<Vec<ConstraintDecl>> {
        let (left, right) = self.sides(equation)?;
        let origin = self.origin(equation.extent);
        let around = self.scope.loop_values();
        let mut found = Vec::new();
        for (k, (left_entry, right_entry)) in left.entries.iter().zip(&right.entries).enumerate() {
            let label = equation
                .label
                .as_ref()
                .map(|label| entry_label(&label.text, &around, &left.shape.indices(k)));
            if let (Some(text), Some(name)) = (&label, &equation.label)
                && !labels.insert(text.clone())
            {
                let error = Diagnostic::new(name.extent(), format!("the label `{text}` is given twice"))
                    .way_out("choose another label");
                return Err(self.report(name, error));
            }
            let residual = self.difference(&equation.left, *left_entry, *right_entry)?;
            let solved_for = self.solved_for(&equation.left, *left_entry, *right_entry, lone)?;
            found.push(ConstraintDecl { label, residual, solved_for, origin });
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
        if !matches!(left.kind, ExprKind::Name(_) | ExprKind::Index(..) | ExprKind::Der(_)) {
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
                seen.push(direction);
                found.push(ForceDecl { direction, value, origin });
            }
            Ok(())
        });
        found
    }

    /// Named observables.
    pub(super) fn outputs(&mut self, items: &[Item<Definition>], layout: &mut Layout) -> Vec<OutputDecl> {
        let (defined, _) = self.definitions(Context::Outputs, items);
        let mut found = Vec::new();
        for family in &defined {
            layout.outputs.push(family.family());
            for (k, (value, extent)) in family.entries.iter().enumerate() {
                let name = family.shape().entry_name(&family.name.text, k);
                found.push(OutputDecl { name, value: *value, origin: self.origin(*extent) });
            }
        }
        found
    }
}

/// The label of an entry: `roll_1` for the second of a vector, `roll_0_1` in a `for` around it.
pub(super) fn entry_label(label: &str, around: &[i64], indices: &[usize]) -> String {
    let around = around.iter().map(ToString::to_string);
    let parts = around.chain(indices.iter().map(ToString::to_string));
    parts.fold(label.to_owned(), |text, part| text + "_" + &part)
}

/// Rates that are a quasi-velocity, and rates in which one occurs.
#[derive(Default)]
struct Lone {
    velocity_of_rate: BTreeMap<SymbolId, SymbolId>,
    rates_with_velocity: BTreeMap<SymbolId, Vec<SymbolId>>,
}
