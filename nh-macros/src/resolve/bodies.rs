//! Rigid bodies and material points: velocities and kinetic energies.

use nonholonomic_core::algebra::Rational;
use nonholonomic_core::id::ExprId;
use nonholonomic_core::model::{Attitude, Body, Inertia, Turn};

use super::alike::Measured;
use super::array::{Array, Shape};
use super::reports::Outcome;
use super::resolver::Resolver;
use crate::report::Diagnostic;
use crate::syntax::ast::Expr;

/// What `velocity_at` takes.
const AT: &str = "`velocity_at` takes a point of the body, its attitude, and where the material point is";
/// What `kinetic` takes.
const BODY: &str = "`kinetic` takes a mass, an inertia, the centre of mass and the attitude";

impl Resolver {
    /// `velocity_at(p, R, c)` = ṗ + space_rate(R) × (c − p): the velocity of the material point that is at c.
    pub(super) fn velocity_at(&mut self, expr: &Expr, p: &Array, r: &Array, c: &Array) -> Outcome<Array> {
        let point = match r.shape {
            Shape::Matrix(3, 3) => Shape::Vector(3),
            Shape::Number => Shape::Vector(2),
            _ => return Err(self.no_attitude(expr, AT, &[p, r, c])),
        };
        let (Some(at), Some(to)) = (self.in_shape(p, point), self.in_shape(c, point)) else {
            return Err(self.no_attitude(expr, AT, &[p, r, c]));
        };
        let velocity = self.rate_of_value(expr, at.clone())?;
        let rate = self.space_rate(expr, r)?;
        let mut arm = Vec::with_capacity(3);
        for (to, from) in to.entries.iter().zip(&at.entries) {
            arm.push(self.difference(expr, *to, *from)?);
        }
        let turned = match arm.as_slice() {
            [x, y] => {
                let back = self.graph.formula(-y);
                let rate = rate.entries[0];
                vec![self.times(expr, rate, back)?, self.times(expr, rate, *x)?]
            }
            _ => self.cross(expr, &rate, &Array::vector(arm))?.entries,
        };
        let mut entries = Vec::with_capacity(3);
        for (along, turned) in velocity.entries.iter().zip(turned) {
            entries.push(self.sum_of(expr, vec![(Rational::ONE, *along), (Rational::ONE, turned)])?);
        }
        Ok(Array::vector(entries))
    }

    /// `kinetic(m, p)` = m/2 ṗ².
    pub(super) fn kinetic_of_point(
        &mut self,
        expr: &Expr,
        mass: (&Expr, &Array),
        p: &Array,
    ) -> Outcome<Array> {
        let number = self.as_number(mass.0, mass.1)?;
        let mass = self.of_parameters(mass.0, "the mass of a point", number)?;
        if !matches!(p.shape, Shape::Vector(2 | 3)) {
            return Err(self.wrong_shapes(
                expr,
                "`kinetic(m, p)` takes a point: a vector of 2 or 3 entries",
                &[p],
            ));
        }
        let origin = self.origin(expr.extent);
        let energy = self.of_translation(expr, mass, p)?;
        self.bodies.push(Body {
            mass,
            inertia: Inertia::None,
            position: p.entries.clone(),
            attitude: Attitude::None,
            energy,
            origin,
        });
        Ok(Array::number(energy))
    }

    /// `kinetic(m, I, p, R)` = m/2 ṗ² + ωᵀIω/2 with ω in the axes of the body, mathematics (33).
    pub(super) fn kinetic_of_body(
        &mut self,
        expr: &Expr,
        mass: (&Expr, &Array),
        inertia: &Array,
        p: &Array,
        r: &Array,
    ) -> Outcome<Array> {
        let at = mass.0;
        let number = self.as_number(at, mass.1)?;
        let position = match r.shape {
            Shape::Matrix(3, 3) => Shape::Vector(3),
            Shape::Number => Shape::Vector(2),
            _ => return Err(self.no_attitude(expr, BODY, &[mass.1, inertia, p, r])),
        };
        let fits = matches!(
            (r.shape, inertia.shape),
            (_, Shape::Number) | (Shape::Matrix(..), Shape::Vector(3) | Shape::Matrix(3, 3))
        );
        let Some(p) = self.in_shape(p, position) else {
            return Err(self.no_attitude(expr, BODY, &[mass.1, inertia, p, r]));
        };
        if !fits {
            let way_out = match position {
                Shape::Vector(2) => "in the plane the inertia is a number",
                _ => {
                    "in space the inertia is a number, a vector of 3 principal moments or a matrix of 3 × 3 entries"
                }
            };
            return Err(self.misfit(expr, BODY, &[mass.1, inertia, &p, r], way_out));
        }
        let mass = self.of_parameters(at, "the mass of a body", number)?;
        for entry in &inertia.entries {
            self.of_parameters(expr, "the inertia of a body", *entry)?;
            self.moment(expr, *entry);
        }
        if r.shape == Shape::Number {
            self.angle(expr, r.entries[0]);
        }
        let rate = self.body_rate(expr, r)?;
        let momentum = match inertia.shape {
            Shape::Number => {
                let number = inertia.entries[0];
                self.entrywise(rate.clone(), |this, entry| this.times(expr, number, entry))?.entries
            }
            Shape::Vector(_) => {
                let pairs = inertia.entries.iter().zip(&rate.entries);
                let products: Vec<_> = pairs.map(|(a, b)| self.times(expr, *a, *b)).collect();
                products.into_iter().collect::<Outcome<Vec<_>>>()?
            }
            Shape::Matrix(..) => {
                let rows: Vec<_> = inertia
                    .entries
                    .chunks(3)
                    .map(|row| self.inner_product(expr, row, &rate.entries))
                    .collect();
                rows.into_iter().collect::<Outcome<Vec<_>>>()?
            }
        };
        let turning = self.inner_product(expr, &momentum, &rate.entries)?;
        let along = self.of_translation(expr, mass, &p)?;
        let origin = self.origin(expr.extent);
        let inertia = match inertia.shape {
            Shape::Number => Inertia::Isotropic(inertia.entries[0]),
            Shape::Vector(_) => Inertia::Diagonal(inertia.entries.clone()),
            Shape::Matrix(..) => Inertia::Full(inertia.entries.clone()),
        };
        let attitude = if r.shape == Shape::Number {
            Attitude::Angle(r.entries[0])
        } else {
            Attitude::Turns(self.turns_of(r))
        };
        let energy = self.sum_of(expr, vec![(Rational::ONE, along), (Rational::new(1, 2), turning)])?;
        self.bodies.push(Body { mass, inertia, position: p.entries.clone(), attitude, energy, origin });
        Ok(Array::number(energy))
    }

    /// A mass or a moment of inertia, which is the same wherever the body is: a place in its stead is a slip.
    fn of_parameters(&mut self, at: &Expr, what: &str, value: ExprId) -> Outcome<ExprId> {
        let Some(symbol) = self.moving_symbol(value) else { return Ok(value) };
        let name = self.graph.symbols()[symbol].clone();
        let error = Diagnostic::new(at.extent, format!("{what} is an expression of parameters"))
            .evidence(format!("it depends on `{name}`"))
            .way_out(
                "`kinetic` takes `(m, p)` or `(m, I, p, R)` in this order; what moves mass about is written out, as in \
                 `m / 2 * dot(der(p), der(p))`",
            );
        Err(self.report(at, error))
    }

    /// A moment of inertia times the square of a rate is an energy, whether the body ever turns about its axis or not.
    fn moment(&mut self, expr: &Expr, entry: ExprId) {
        if !self.graph.is_literal_zero(entry) {
            let expected = Measured::expected("a moment of inertia", expr.extent).energy(1).time(2);
            let given = self.shown(entry, expr.extent);
            self.same_unit(expr, "is", vec![expected, given]);
        }
    }

    /// The rotations that an attitude is the product of.
    fn turns_of(&self, attitude: &Array) -> Vec<Turn> {
        let known = self.rotations.known.get(&attitude.entries);
        let claimed = || vec![Turn { matrix: attitude.entries.clone(), about: None }];
        known.map_or_else(claimed, |turns| turns.to_vec())
    }

    /// m/2 ṗ²
    fn of_translation(&mut self, expr: &Expr, mass: ExprId, p: &Array) -> Outcome<ExprId> {
        if self.graph.is_literal_zero(mass) {
            return Ok(mass);
        }
        let velocity = self.rate_of_value(expr, p.clone())?;
        let square = self.inner_product(expr, &velocity.entries, &velocity.entries)?;
        let product = self.times(expr, mass, square)?;
        self.sum_of(expr, vec![(Rational::new(1, 2), product)])
    }
}
