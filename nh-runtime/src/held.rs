//! Equations that a step keeps by itself: at a state, with the directions in which each is corrected.

use crate::arrays::Array;
use crate::linear::Factors;
use crate::{Dim, Dynamics, Real, Scalar, ScalarOf, State, VecOf};

/// An array of the components of a state.
type Vector<X> = <<X as State>::Dim as Dim>::Vec<<X as State>::Scalar>;
/// Rows of them.
type Matrix<X> = <<X as State>::Dim as Dim>::Mat<<X as State>::Scalar>;

/// A system whose steps can keep its constraints by themselves: declared with `emit { symmetric_projection }`, or with
/// `emit { discrete_gradient }` beside `holonomic`.
///
/// ```
/// use nonholonomic::prelude::*;
/// use nonholonomic::{D, Held};
///
/// /// A point that goes round the unit circle, at a speed that varies.
/// #[derive(Clone, Copy)]
/// struct Circle;
/// #[derive(Clone, Copy)]
/// struct Point { x: f64, y: f64 }
/// impl State for Point {
///     type Scalar = f64;
///     type Dim = D<2>;
///     fn to_array(&self) -> [f64; 2] { [self.x, self.y] }
///     fn from_array([x, y]: [f64; 2]) -> Self { Self { x, y } }
///     fn names() -> [&'static str; 2] { ["x", "y"] }
/// }
/// impl Dynamics for Circle {
///     type State = Point;
///     type Input = ();
///     fn derivative(&self, _t: f64, s: &Point, (): &()) -> Point {
///         let speed = 2.0 + s.x.sin();
///         // and outwards where it has left the circle
///         let out = s.x * s.x + s.y * s.y - 1.0;
///         Point { x: -speed * s.y + out * s.x, y: speed * s.x + out * s.y }
///     }
/// }
/// impl Holding for Circle {
///     fn held(&self, _t: f64, s: &Point) -> Held<Point> {
///         let square = 2.0 * (s.x * s.x + s.y * s.y);
///         Held::new([[2.0 * s.x, 2.0 * s.y]], [[s.x / square, s.y / square]])
///     }
///     fn equations(&self, _t: f64, s: &Point) -> [f64; 2] { [s.x * s.x + s.y * s.y - 1.0, 0.0] }
/// }
///
/// # fn main() -> Result<(), IntegrationError> {
/// let method = ImplicitMidpoint::new(0.05).symmetrically_projected();
/// let mut sim = Integrator::new(Circle, method, 0.0, Point { x: 1.0, y: 0.0 });
/// sim.advance_to(100.0)?;
/// assert!((sim.state().x.hypot(sim.state().y) - 1.0).abs() < 1e-14);
/// # Ok(())
/// # }
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not say how its constraints are corrected within a step",
    label = "needs the trait `Holding`",
    note = "add `emit {{ symmetric_projection }}` to its declaration, or implement `Holding` by hand"
)]
pub trait Holding: Dynamics {
    /// The equations at a state.
    fn held(&self, t: ScalarOf<Self>, state: &Self::State) -> Held<Self::State>;

    /// g(t, x) alone, in the first components: zero where the state belongs.
    fn equations(&self, t: ScalarOf<Self>, state: &Self::State) -> VecOf<Self>;
}

/// Equations g(t, x) = 0 at a state: their slopes ∂g, and for each the direction in which it is corrected. With these
/// directions as columns of R, ∂g R is 1 up to the slopes of velocity constraints by positions.
#[derive(Clone, Copy)]
pub struct Held<X: State> {
    count: usize,
    slopes: Matrix<X>,
    directions: Matrix<X>,
}

impl<X: State> core::fmt::Debug for Held<X> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Held").field("count", &self.count).finish_non_exhaustive()
    }
}

impl<X: State> Held<X> {
    /// No equations.
    #[must_use]
    pub fn none() -> Self {
        let nought = X::Dim::mat(X::Scalar::ZERO);
        Self { count: 0, slopes: nought, directions: nought }
    }

    /// Equations with these slopes by the components of the state, and these directions; no more than the state has
    /// components.
    #[must_use]
    pub fn new<const M: usize>(slopes: [Vector<X>; M], directions: [Vector<X>; M]) -> Self {
        let mut held = Self { count: M.min(<X::Dim as Dim>::N), ..Self::none() };
        held.slopes.as_mut().iter_mut().zip(slopes).for_each(|(row, given)| *row = given);
        held.directions.as_mut().iter_mut().zip(directions).for_each(|(row, given)| *row = given);
        held
    }

    /// Σ κ_a R_a.
    pub(crate) fn along(&self, amounts: &Vector<X>) -> Vector<X> {
        sum_of_rows::<X>(&self.directions, amounts)
    }
}

impl<X: State> Held<X>
where
    X::Scalar: Real,
{
    /// The equations with slopes that are corrected along a covector: row a by `factors[a]` of it.
    pub(crate) fn tilted(&self, factors: &Vector<X>, covector: &Vector<X>) -> Self {
        let mut tilted = *self;
        let rows = tilted.slopes.as_mut().iter_mut().zip(factors.as_ref()).take(self.count);
        // by none of it also where it is no number
        for (row, factor) in rows.filter(|(_, factor)| **factor != X::Scalar::ZERO) {
            row.as_mut().iter_mut().zip(covector.as_ref()).for_each(|(slope, c)| *slope += *factor * *c);
        }
        tilted
    }

    /// The rates of the equations along a vector: ∂g w.
    pub(crate) fn rates(&self, vector: &Vector<X>) -> Vector<X> {
        products::<X>(&self.slopes, vector)
    }

    /// What brings about the projections P = 1 − R (∂g R)⁻¹ ∂g.
    pub(crate) fn projector(&self) -> Projector<X> {
        let mut matrix = X::Dim::mat(X::Scalar::ZERO);
        let mut transposed = matrix;
        let of_directions = self.directions.as_ref();
        for (a, (row, slopes)) in matrix.as_mut().iter_mut().zip(self.slopes.as_ref()).enumerate() {
            for (b, (entry, direction)) in row.as_mut().iter_mut().zip(of_directions).enumerate() {
                // what is no equation stays as it is
                *entry = if a < self.count && b < self.count {
                    inner(slopes, direction)
                } else if a == b {
                    X::Scalar::ONE
                } else {
                    X::Scalar::ZERO
                };
                if let Some(mirrored) = transposed.as_mut().get_mut(b).and_then(|row| row.as_mut().get_mut(a))
                {
                    *mirrored = *entry;
                }
            }
        }
        Projector { held: *self, factors: Factors::new(&matrix), transposed: Factors::new(&transposed) }
    }
}

/// P = 1 − R (∂g R)⁻¹ ∂g, with ∂g P = 0.
pub(crate) struct Projector<X: State> {
    held: Held<X>,
    factors: Factors<X::Dim, X::Scalar>,
    transposed: Factors<X::Dim, X::Scalar>,
}

impl<X: State> Projector<X>
where
    X::Scalar: Real,
{
    /// (∂g R)⁻¹ times rates of the equations.
    pub(crate) fn amounts(&self, rates: &Vector<X>) -> Vector<X> {
        self.factors.solve(rates)
    }

    /// P w.
    pub(crate) fn of_vector(&self, vector: &Vector<X>) -> Vector<X> {
        let moved = self.held.along(&self.amounts(&self.held.rates(vector)));
        crate::arrays::difference(vector, &moved)
    }

    /// Pᵀ c.
    pub(crate) fn of_covector(&self, covector: &Vector<X>) -> Vector<X> {
        let amounts = self.transposed.solve(&products::<X>(&self.held.directions, covector));
        crate::arrays::difference(covector, &sum_of_rows::<X>(&self.held.slopes, &amounts))
    }
}

fn inner<T: Scalar, V: Array<T>>(a: &V, b: &V) -> T {
    a.as_ref().iter().zip(b.as_ref()).fold(T::ZERO, |sum, (a, b)| sum + *a * *b)
}

fn products<X: State>(rows: &Matrix<X>, vector: &Vector<X>) -> Vector<X> {
    let mut products = X::Dim::vec(X::Scalar::ZERO);
    let pairs = products.as_mut().iter_mut().zip(rows.as_ref());
    pairs.for_each(|(product, row)| *product = inner(row, vector));
    products
}

fn sum_of_rows<X: State>(rows: &Matrix<X>, amounts: &Vector<X>) -> Vector<X> {
    let mut sum = X::Dim::vec(X::Scalar::ZERO);
    for (row, amount) in rows.as_ref().iter().zip(amounts.as_ref()) {
        sum.as_mut().iter_mut().zip(row.as_ref()).for_each(|(sum, entry)| *sum += *amount * *entry);
    }
    sum
}
