//! Attitudes whose rates are velocities of the state: what turns them is read off, and not differentiated.

use nonholonomic_core::algebra::Substitution;
use nonholonomic_core::geometry::Manifold;
use nonholonomic_core::id::{ExprId, SymbolId};
use nonholonomic_core::mechanics::where_attitude_is_one;

use super::array::{Array, Shape};
use super::context::Usage;
use super::reports::Outcome;
use super::resolver::Resolver;
use super::turns::MOST;
use crate::syntax::ast::Expr;

impl Resolver {
    /// An attitude made of coordinates whose anchor turns it: Ṙ = R ω̂, or Ṙ = Ω̂ R, is read off where R is 1,
    /// and proved everywhere on the base.
    pub(super) fn rate_of_attitude(
        &mut self,
        expr: &Expr,
        r: &Array,
        in_body: bool,
    ) -> Outcome<Option<Array>> {
        let Some((omega, is_of_body)) = self.spin(expr, r)? else { return Ok(None) };
        self.check_usage(expr, Usage::Velocity, "body_rate(…)", expr.extent)?;
        if is_of_body == in_body {
            return Ok(Some(omega));
        }
        let mut entries = Vec::with_capacity(3);
        for k in 0..3 {
            let row = if in_body { r.column(k) } else { r.entries[3 * k..3 * k + 3].to_vec() };
            entries.push(self.inner_product(expr, &row, &omega.entries)?);
        }
        Ok(Some(Array::vector(entries)))
    }

    /// The angular velocity of an attitude whose anchor turns it, and whether that is along the axes of the body.
    fn spin(&mut self, expr: &Expr, r: &Array) -> Outcome<Option<(Array, bool)>> {
        if let Some(known) = self.rotations.spins.get(&r.entries) {
            return Ok(known.clone());
        }
        let found = self.spin_by_anchor(expr, r)?;
        if self.anchor_lines.is_some() {
            self.rotations.spins.insert(r.entries.clone(), found.clone());
        }
        Ok(found)
    }

    fn spin_by_anchor(&mut self, expr: &Expr, r: &Array) -> Outcome<Option<(Array, bool)>> {
        let symbols = self.graph.symbols_in(&r.entries);
        let moving: Vec<SymbolId> = self
            .tables
            .coordinates
            .iter()
            .map(|declared| declared.symbol)
            .filter(|symbol| symbols.contains(symbol))
            .collect();
        let Some(level) = where_attitude_is_one(&mut self.graph, &r.entries, &moving) else {
            return Ok(None);
        };
        let rate = self.rate_of_value(expr, r.clone())?;
        let Some(rate) = self.along_anchor(&rate) else { return Ok(None) };
        let entries = Substitution::new(level).apply_all(&mut self.graph, &rate.entries);
        let omega = self.vee(expr, &Array { shape: Shape::Matrix(3, 3), entries })?;
        let hat = self.hat(expr, &omega)?;
        for is_of_body in [true, false] {
            let (left, right) = if is_of_body { (r, &hat) } else { (&hat, r) };
            let mut holds = true;
            for (k, known) in rate.entries.iter().enumerate() {
                let row = &left.entries[3 * (k / 3)..3 * (k / 3) + 3];
                let turned = self.inner_product(expr, row, &right.column(k % 3))?;
                let defect = self.difference(expr, *known, turned)?;
                holds = holds && self.vanishes_on_base(defect);
            }
            if holds {
                return Ok(Some((omega, is_of_body)));
            }
        }
        Ok(None)
    }

    /// Whether a function of coordinates and velocities vanishes where the identities of the base hold.
    fn vanishes_on_base(&mut self, function: ExprId) -> bool {
        if self.graph.zero_test(function).is_zero() {
            return true;
        }
        if self.embedding.is_none() {
            let unknowns: Vec<SymbolId> =
                self.tables.coordinates.iter().map(|declared| declared.symbol).collect();
            let solved = Manifold::where_zero(&mut self.graph, &self.identities, &unknowns);
            self.embedding = Some(solved.unwrap_or_default());
        }
        let base = self.embedding.as_ref().filter(|base| !base.is_whole());
        base.is_some_and(|base| base.zero_test(&mut self.graph, function).is_zero())
    }

    /// Takes a product apart whose factors are both attitudes that the anchor turns, or products of rotations.
    pub(super) fn factored(&mut self, expr: &Expr, r: &Array) -> Outcome<()> {
        self.factored_within(expr, r, MOST)
    }

    /// The same of so many products of products at most.
    fn factored_within(&mut self, expr: &Expr, r: &Array, most: usize) -> Outcome<()> {
        if self.rotations.known.contains_key(&r.entries) {
            return Ok(());
        }
        let Some([left, right]) = self.rotations.products.get(&r.entries).cloned() else { return Ok(()) };
        for factor in [&left, &right] {
            if most > 0 {
                self.factored_within(expr, factor, most - 1)?;
            }
            if !self.rotations.known.contains_key(&factor.entries) && self.spin(expr, factor)?.is_none() {
                return Ok(());
            }
        }
        self.rotations.join(&left, &right, r);
        Ok(())
    }

    /// Remembers that velocities are the angular velocity of an attitude.
    pub(super) fn spins(&mut self, rate: &[ExprId], velocities: &[SymbolId]) {
        if let Some(turns) = self.rotations.rates.get(rate).cloned() {
            let velocities = velocities.iter().map(|symbol| self.graph.symbol(*symbol)).collect();
            self.rotations.spinning.push((turns, velocities));
        }
    }
}
