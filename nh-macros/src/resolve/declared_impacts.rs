//! What velocities jump to.

use nonholonomic_core::algebra::Rational;
use nonholonomic_core::id::{ExprId, SymbolId};
use nonholonomic_core::model::{ImpactDecl, ImpactRowDecl, Located};

use super::alike::Measured;
use super::context::Context;
use super::reports::Outcome;
use super::resolver::Resolver;
use crate::report::Diagnostic;
use crate::syntax::ast::{ImpactLine, ImpactRow, Item};

/// What a row of an impact exerts: times the rate of the row it is an energy.
pub(super) struct Impulse {
    pub(super) name: String,
    pub(super) row: ExprId,
    /// Whether the row is a rate itself.
    pub(super) is_velocity: bool,
}

impl Resolver {
    /// The impacts; rows of one label that stand in a `for` act together.
    pub(super) fn impacts(&mut self, items: &[Item<ImpactLine>]) -> Vec<ImpactDecl> {
        let mut found: Vec<ImpactDecl> = Vec::new();
        self.section(Context::Impacts, items, &mut |this, line| {
            let impact = this.impact(line)?;
            let is_in_loop = !this.scope.loop_values().is_empty();
            match found.iter_mut().find(|known| known.label == impact.label) {
                None => found.push(impact),
                Some(known)
                    if is_in_loop
                        && known.restitution.map(|e| e.value) == impact.restitution.map(|e| e.value) =>
                {
                    known.rows.extend(impact.rows);
                }
                Some(_) => {
                    let text = &line.label.text;
                    let at = line.label.extent();
                    let error = if is_in_loop {
                        Diagnostic::new(at, format!("the coefficient of restitution of `{text}` changes in the `for`"))
                            .evidence("rows of one label that stand in a `for` act together, with one coefficient")
                            .way_out("leave out the `for`, and write an item for each row, with a label of its own")
                    } else {
                        Diagnostic::new(at, format!("the label `{text}` is given twice"))
                            .evidence("rows that act together stand in one item, with one coefficient of restitution")
                            .way_out("separate them by commas, or choose another label")
                    };
                    return Err(this.report(&line.label, error));
                }
            }
            Ok(())
        });
        found
    }

    /// The impulses of the rows, by name.
    pub(super) fn impulses(&self, impacts: &[ImpactDecl]) -> Vec<Impulse> {
        let rates = self.tables.coordinates.iter().map(|coordinate| coordinate.rate);
        let sections = self.tables.sections.iter().map(|section| section.symbol);
        let frame = self.tables.frame.iter().map(|section| section.symbol);
        let moving: Vec<SymbolId> = rates.chain(sections).chain(frame).collect();
        let mut found = Vec::new();
        for impact in impacts {
            for (k, row) in impact.rows.iter().enumerate() {
                let is_velocity = self.graph.symbols_in(&[row.value]).iter().any(|s| moving.contains(s));
                found.push(Impulse { name: impact.row_name(k), row: row.value, is_velocity });
            }
        }
        found
    }

    fn impact(&mut self, line: &ImpactLine) -> Outcome<ImpactDecl> {
        let mut rows = Vec::new();
        let mut outcome = Ok(());
        for row in &line.rows {
            match self.impact_row(row) {
                Ok(entries) => rows.extend(entries),
                Err(reported) => outcome = Err(reported),
            }
        }
        let restitution = line.restitution.as_ref().map(|value| {
            let origin = self.origin(value.extent);
            let number = self.number_value(value)?;
            // a quotient of two rates of one gap
            let sides = vec![
                Measured::expected("a coefficient of restitution", value.extent),
                self.written(value, number, None),
            ];
            self.same_unit(value, "is", sides);
            Ok(Located { value: number, origin })
        });
        let restitution = restitution.transpose();
        outcome?;
        let origin = self.origin(line.label.extent());
        Ok(ImpactDecl { label: line.label.text.clone(), rows, restitution: restitution?, origin })
    }

    /// left − right, or right − left where the right side is the larger one; vectors entry by entry.
    fn impact_row(&mut self, row: &ImpactRow) -> Outcome<Vec<ImpactRowDecl>> {
        let ImpactRow { sides, is_unilateral, is_turned } = row;
        let (left, right) = self.sides(sides)?;
        let sign = if *is_turned { Rational::MINUS_ONE } else { Rational::ONE };
        let origin = self.origin(sides.extent);
        let mut rows = Vec::new();
        for (left, right) in left.entries.iter().zip(&right.entries) {
            let value = self.signed_residual(sides, *left, *right, sign.clone())?;
            rows.push(ImpactRowDecl { value, is_unilateral: *is_unilateral, origin });
        }
        Ok(rows)
    }
}
