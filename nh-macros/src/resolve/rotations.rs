//! Rotations, active, from the axes of a body to those of space, and how fast they turn.
//!
//! Of a product of rotations about axes the factors are remembered, so that its rate is the sum of theirs, each
//! in the axes of those behind it, and not a product of matrices with their derivatives:
//! mathematics (32).

use std::rc::Rc;

use nonholonomic_core::algebra::{Function, Rational};
use nonholonomic_core::id::ExprId;
use nonholonomic_core::model::{Claimed, Turn};

use super::alike::Measured;
use super::array::{Array, Shape};
use super::context::Usage;
use super::reports::Outcome;
use super::resolver::Resolver;
use crate::report::Diagnostic;
use crate::syntax::ast::Expr;

impl Resolver {
    /// `rot_x(a)`, `rot_y(a)`, `rot_z(a)`
    pub(super) fn about(&mut self, expr: &Expr, axis: usize, angle: ExprId) -> Outcome<Array> {
        let (zero, one) = (self.graph.zero(), self.graph.one());
        self.angle(expr, angle);
        let sin = self.apply(Function::Sin, angle);
        let cos = self.apply(Function::Cos, angle);
        let (sin, cos) = (self.checked(expr, sin, 1)?, self.checked(expr, cos, 1)?);
        let minus = self.graph.formula(-sin);
        let (y, z) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut matrix = vec![zero; 9];
        matrix[4 * axis] = one;
        (matrix[4 * y], matrix[4 * z]) = (cos, cos);
        (matrix[3 * y + z], matrix[3 * z + y]) = (minus, sin);
        let unit = (0..3).map(|k| if k == axis { one } else { zero }).collect();
        Ok(self.turn(matrix, unit, angle))
    }

    /// `rot(axis, a)`: cos a 1 + (1 − cos a) n nᵀ + sin a n̂.
    pub(super) fn about_axis(
        &mut self,
        expr: &Expr,
        at: &Expr,
        axis: &Array,
        angle: ExprId,
    ) -> Outcome<Array> {
        if axis.shape != Shape::Vector(3) {
            return Err(self.wrong_shapes(at, "the axis of `rot` is a vector of 3 entries", &[axis]));
        }
        let square = self.inner_product(expr, &axis.entries, &axis.entries)?;
        let one = self.graph.one();
        let excess = self.difference(expr, square, one)?;
        if !self.graph.is_literal_zero(excess) {
            let origin = self.origin(at.extent);
            self.claimed.push(Claimed {
                value: excess,
                origin,
                what: "the axis of this rotation is not proved to have length 1".into(),
                measure: "the square of its length, less 1".into(),
                way_out: "divide it by its length: `rot(n / norm(n), a)`".into(),
            });
        }
        for (k, unit) in axis.entries.iter().enumerate() {
            let others = (0..3).all(|j| j == k || self.graph.is_literal_zero(axis.entries[j]));
            if others && self.graph.value_of(*unit).is_some_and(Rational::is_one) {
                return self.about(expr, k, angle);
            }
        }
        self.angle(expr, angle);
        let sin = self.apply(Function::Sin, angle);
        let cos = self.apply(Function::Cos, angle);
        let (sin, cos) = (self.checked(expr, sin, 1)?, self.checked(expr, cos, 1)?);
        let versine = self.difference(expr, one, cos)?;
        let hat = self.hat(expr, axis)?;
        let mut matrix = Vec::with_capacity(9);
        for k in 0..9 {
            let (i, j) = (k / 3, k % 3);
            let outer = self.product_of(
                expr,
                &[
                    (versine, Rational::ONE),
                    (axis.entries[i], Rational::ONE),
                    (axis.entries[j], Rational::ONE),
                ],
            )?;
            let turned = self.times(expr, sin, hat.entries[k])?;
            let mut terms = vec![(Rational::ONE, outer), (Rational::ONE, turned)];
            if i == j {
                terms.push((Rational::ONE, cos));
            }
            matrix.push(self.sum_of(expr, terms)?);
        }
        Ok(self.turn(matrix, axis.entries.clone(), angle))
    }

    /// An angle is a pure number.
    pub(super) fn angle(&mut self, expr: &Expr, angle: ExprId) {
        let expected = Measured::expected("the angle of a rotation", expr.extent);
        let given = self.shown(angle, expr.extent);
        self.same_unit(expr, "is", vec![expected, given]);
    }

    /// Remembers a rotation.
    fn turn(&mut self, matrix: Vec<ExprId>, axis: Vec<ExprId>, angle: ExprId) -> Array {
        let turn = Turn { matrix: matrix.clone(), about: Some((axis, angle)) };
        self.rotations.known.entry(matrix.clone()).or_insert_with(|| Rc::new(vec![turn]));
        Array { shape: Shape::Matrix(3, 3), entries: matrix }
    }

    /// `body_rate(R)` = vee(RᵀṘ), the angular velocity in the axes of the body; of an angle its rate.
    pub(super) fn body_rate(&mut self, expr: &Expr, r: &Array) -> Outcome<Array> {
        self.angular_velocity(expr, r, "`body_rate` takes a matrix of 3 × 3 entries, or an angle", true)
    }

    /// `space_rate(R)` = vee(ṘRᵀ), the angular velocity in the axes of space; of an angle its rate.
    pub(super) fn space_rate(&mut self, expr: &Expr, r: &Array) -> Outcome<Array> {
        self.angular_velocity(expr, r, "`space_rate` takes a matrix of 3 × 3 entries, or an angle", false)
    }

    fn angular_velocity(&mut self, expr: &Expr, r: &Array, takes: &str, in_body: bool) -> Outcome<Array> {
        if r.shape == Shape::Number {
            return self.rate_of_value(expr, r.clone());
        }
        if r.shape != Shape::Matrix(3, 3) {
            return Err(self.wrong_shapes(expr, takes, &[r]));
        }
        self.factored(expr, r)?;
        if let Some(turns) = self.rotations.known.get(&r.entries).cloned() {
            return self.rate_of_turns(expr, &turns, in_body);
        }
        self.claim_rotation(expr, r)?;
        if let Some(rate) = self.rate_of_attitude(expr, r, in_body)? {
            return Ok(rate);
        }
        let rate = self.rate_of_value(expr, r.clone())?;
        self.skew_rate(expr, r, &rate, in_body)
    }

    /// vee(RᵀṘ), or vee(ṘRᵀ).
    fn skew_rate(&mut self, expr: &Expr, r: &Array, rate: &Array, in_body: bool) -> Outcome<Array> {
        let (rows, columns): (Vec<_>, Vec<_>) = if in_body {
            ((0..3).map(|i| r.column(i)).collect(), (0..3).map(|j| rate.column(j)).collect())
        } else {
            let rows = |of: &Array| of.entries.chunks(3).map(<[ExprId]>::to_vec).collect();
            (rows(rate), rows(r))
        };
        let mut entries = Vec::with_capacity(9);
        for row in &rows {
            for column in &columns {
                entries.push(self.inner_product(expr, row, column)?);
            }
        }
        self.vee(expr, &Array { shape: Shape::Matrix(3, 3), entries })
    }

    /// The rates of a product of rotations add up, each in the axes that are asked for.
    fn rate_of_turns(&mut self, expr: &Expr, turns: &[Turn], in_body: bool) -> Outcome<Array> {
        let zero = self.graph.zero();
        let mut sum = Array::vector(vec![zero; 3]);
        // in the body from the left, in space from the right: what is carried is turned on the way
        let mut order: Vec<&Turn> =
            if in_body { turns.iter().collect() } else { turns.iter().rev().collect() };
        if in_body && let Some((first, rate)) = self.rotations.spinning(turns) {
            self.check_usage(expr, Usage::Velocity, "body_rate(…)", expr.extent)?;
            order.drain(..first);
            sum = Array::vector(rate);
        }
        for turn in order {
            let matrix = Array { shape: Shape::Matrix(3, 3), entries: turn.matrix.clone() };
            let own = self.rate_of_turn(expr, turn, &matrix, in_body)?;
            let mut entries = Vec::with_capacity(3);
            for k in 0..3 {
                let row: Vec<ExprId> =
                    if in_body { matrix.column(k) } else { matrix.entries[3 * k..3 * k + 3].to_vec() };
                let carried = self.inner_product(expr, &row, &sum.entries)?;
                entries.push(
                    self.sum_of(expr, vec![(Rational::ONE, carried), (Rational::ONE, own.entries[k])])?,
                );
            }
            sum = Array::vector(entries);
        }
        if in_body {
            self.rotations.rates.insert(sum.entries.clone(), turns.to_vec());
        }
        Ok(sum)
    }

    /// About an axis that stands still, the rate of the angle along it.
    fn rate_of_turn(&mut self, expr: &Expr, turn: &Turn, matrix: &Array, in_body: bool) -> Outcome<Array> {
        if let Some((axis, angle)) = &turn.about {
            let axis = Array::vector(axis.clone());
            if !self.moves(&axis) {
                let rate = self.rate_of_value(expr, Array::number(*angle))?.entries[0];
                return self.entrywise(axis, |this, entry| this.times(expr, entry, rate));
            }
        } else {
            self.claim_rotation(expr, matrix)?;
            if let Some(rate) = self.rate_of_attitude(expr, matrix, in_body)? {
                return Ok(rate);
            }
        }
        let rate = self.rate_of_value(expr, matrix.clone())?;
        self.skew_rate(expr, matrix, &rate, in_body)
    }

    /// That a matrix is a rotation is proved on the base: RᵀR = 1, det R = 1.
    pub(super) fn claim_rotation(&mut self, expr: &Expr, r: &Array) -> Outcome<()> {
        let known = self.rotations.known.contains_key(&r.entries);
        if known || self.rotations.claimed.contains(&r.entries) {
            return Ok(());
        }
        self.rotations.claimed.push(r.entries.clone());
        let one = self.graph.one();
        let mut values = Vec::new();
        for i in 0..3 {
            for j in i..3 {
                let product = self.inner_product(expr, &r.column(i), &r.column(j))?;
                let value = if i == j { self.difference(expr, product, one)? } else { product };
                values.push((value, format!("entry [{i}][{j}] of `transpose(R) * R - identity(3)`")));
            }
        }
        let rows: Vec<Array> = r.entries.chunks(3).map(|row| Array::vector(row.to_vec())).collect();
        if let [a, b, c] = rows.as_slice() {
            let normal = self.cross(expr, a, b)?;
            let volume = self.inner_product(expr, &normal.entries, &c.entries)?;
            values.push((self.difference(expr, volume, one)?, "its determinant, less 1".to_owned()));
        }
        let origin = self.origin(expr.extent);
        for (value, measure) in values {
            if self.graph.is_literal_zero(value) {
                continue;
            }
            self.claimed.push(Claimed {
                value,
                origin,
                what: "the attitude here is not proved to be a rotation matrix".into(),
                measure,
                way_out: "make it a product of `rot_x`, `rot_y`, `rot_z` and `rot`, or of coordinates with \
                          `on { transpose(R) * R = identity(3); }`"
                    .into(),
            });
        }
        Ok(())
    }

    /// A matrix of a shape that no attitude has.
    pub(super) fn no_attitude(
        &mut self,
        expr: &Expr,
        what: &str,
        values: &[&Array],
    ) -> super::reports::Reported {
        self.misfit(
            expr,
            what,
            values,
            "in space a point is a vector of 3 entries and an attitude a matrix of 3 × 3 entries, in the plane a \
             vector of 2 entries and an angle",
        )
    }

    /// Arguments of which one has another shape than it should have.
    pub(super) fn misfit(
        &mut self,
        expr: &Expr,
        what: &str,
        values: &[&Array],
        way_out: &str,
    ) -> super::reports::Reported {
        let shapes: Vec<String> = values.iter().map(|value| value.shape.to_string()).collect();
        let error = Diagnostic::new(expr.extent, what)
            .evidence(format!("these are {}", shapes.join(", ")))
            .way_out(way_out);
        self.report(expr, error)
    }
}
