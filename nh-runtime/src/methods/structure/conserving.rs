//! Any method, with a return to the level of the stated invariants after every step.

use crate::arrays::displaced;
use crate::linear::Factors;
use crate::methods::{Arrival, Method, Start};
use crate::projection::largest;
use crate::tolerance::power_of_two;
use crate::{
    Dim, IntegrationError, Invariants, ProjectionError, Real, Scalar, ScalarOf, State, Statistics, VecOf,
};

/// A method whose state is moved, after every step, to the nearest point where the stated first
/// integrals have the values that they had at the first state (Hairer, Lubich, Wanner, Geometric
/// Numerical Integration, section IV.4). For systems with `conserved { … }` and `emit { invariants }`.
///
/// Nearest is measured in units of what the method's tolerance permits each component, or plainly where steps are fixed
/// or nothing is permitted to some component: give tolerances by component where these have different units. The invariants stay to round-off and the order of the
/// method stays; a symmetric method does not stay symmetric. The integrals have to be independent. Where the level is not
/// found the step is refused: [`IntegrationError::Projection`].
///
/// Where the system has position constraints the level is gone to on these, also in an
/// [`Integrator`](crate::Integrator) that is to leave states alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conserving<M> {
    method: M,
}

impl<M> Conserving<M> {
    /// The method with a return to the invariants after every step.
    #[must_use]
    pub fn new(method: M) -> Self {
        Self { method }
    }
}

/// The gradients of a system's invariants.
type Rows<S> = <<S as Invariants>::Count as Dim>::Vec<VecOf<S>>;
/// The numbers of a system's invariants.
type Values<S> = <<S as Invariants>::Count as Dim>::Vec<ScalarOf<S>>;

/// What the method remembers, and the values of the invariants at the first state.
pub struct Memory<S: Invariants, K> {
    method: K,
    values: Option<Values<S>>,
}

impl<S: Invariants, K: Copy> Clone for Memory<S, K> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<S: Invariants, K: Copy> Copy for Memory<S, K> {}

/// The iterations after which the level is given up: corrections that halve go through all digits before.
const MOST_ITERATIONS: u32 = 64;
/// How often level and position constraints are gone to in turn.
const MOST_IN_TURN: u32 = 1000;

impl<S: Invariants, M: Method<S>> Method<S> for Conserving<M>
where
    ScalarOf<S>: Real,
{
    type Memory = Memory<S, M::Memory>;

    // it goes back to them itself, or has to leave the level
    handed_on!(forget { values = None } restart {} keeps_positions { |_this| true });

    fn memory(&self) -> Self::Memory {
        Memory { method: self.method.memory(), values: None }
    }

    fn check(&self) -> Result<(), IntegrationError> {
        self.method.check()
    }

    fn advance(
        &self,
        start: &Start<'_, S>,
        target: Option<ScalarOf<S>>,
        memory: &mut Self::Memory,
        statistics: &mut Statistics,
    ) -> Result<Arrival<S>, IntegrationError> {
        let values = memory.values.unwrap_or_else(|| start.system.invariants(start.time, start.state));
        let mut arrival = self.method.advance(start, target, &mut memory.method, statistics)?;
        let time = arrival.time.to_f64();
        let units = units::<ScalarOf<S>, _>(self.method.permitted(start.state));
        let before = arrival.state;
        if let Err(error) = level(start.system, &mut arrival, (&values, &units)) {
            // the method has gone on to an end that is not taken
            self.method.stand(&mut memory.method);
            return Err(IntegrationError::Projection { time, error });
        }
        statistics.projections += 1;
        let correction = largest(start.system.correction(&before, &arrival.state).as_ref()).to_f64();
        statistics.largest_correction = statistics.largest_correction.max(correction);
        self.method.moved(&mut memory.method);
        memory.values = Some(values);
        Ok(arrival)
    }
}

/// Moves to the level and, where there are position constraints, to these, in turn until neither moves the other's point:
/// as projections on two manifolds that cross each other do.
fn level<S: Invariants>(
    system: &S,
    arrival: &mut Arrival<S>,
    to: (&Values<S>, &VecOf<S>),
) -> Result<(), ProjectionError>
where
    ScalarOf<S>: Real,
{
    arrival.state = returned(system, arrival, to)?;
    if !system.has_positions() {
        return Ok(());
    }
    let mut best: Option<ScalarOf<S>> = None;
    for _ in 0..MOST_IN_TURN {
        system.return_to_positions(arrival.time, &mut arrival.state)?;
        let on_positions = arrival.state.to_array();
        arrival.state = returned(system, arrival, to)?;
        let on_level = arrival.state.to_array();
        let moved = length(&displaced(&on_level, -ScalarOf::<S>::ONE, &on_positions), to.1);
        let stagnates = best.is_some_and(|best| moved >= best);
        let is_near = moved <= ScalarOf::<S>::EPSILON.sqrt() * length(&on_level, to.1);
        if moved == ScalarOf::<S>::ZERO || (stagnates && is_near) {
            // the constraints hold to rounding, the level to what is left of it there
            arrival.state = S::State::from_array(on_positions);
            return Ok(());
        }
        best = Some(best.map_or(moved, |best| best.min(moved)));
    }
    Err(ProjectionError { iterations: MOST_IN_TURN, residual: best.map_or(0.0, Scalar::to_f64) })
}

/// The point with these values: x − P² Gᵀ (G P² Gᵀ)⁻¹ (c(x) − c₀) until it stagnates, where P are the units of components.
fn returned<S: Invariants>(
    system: &S,
    arrival: &Arrival<S>,
    (values, units): (&Values<S>, &VecOf<S>),
) -> Result<S::State, ProjectionError>
where
    ScalarOf<S>: Real,
{
    let mut x = arrival.state.to_array();
    let mut best: Option<ScalarOf<S>> = None;
    let mut residual = ScalarOf::<S>::ZERO;
    for iteration in 0..MOST_ITERATIONS {
        let state = S::State::from_array(x);
        let mut off = system.invariants(arrival.time, &state);
        for (defect, value) in off.as_mut().iter_mut().zip(values.as_ref()) {
            *defect -= *value;
        }
        // at rest the gradients may vanish, and there is nothing to do
        if off.as_ref().iter().all(|defect| *defect == ScalarOf::<S>::ZERO) {
            return Ok(state);
        }
        residual = largest(off.as_ref());
        let mut gradients = system.invariant_gradients(arrival.time, &state);
        for gradient in gradients.as_mut() {
            gradient.as_mut().iter_mut().zip(units.as_ref()).for_each(|(entry, unit)| *entry *= *unit);
        }
        let (gradients, defect) = in_their_units::<S>(gradients, &off);
        let mut gram = <S::Count as Dim>::mat(ScalarOf::<S>::ZERO);
        for (row, first) in gram.as_mut().iter_mut().zip(gradients.as_ref()) {
            for (entry, second) in row.as_mut().iter_mut().zip(gradients.as_ref()) {
                *entry = dot::<S>(first, second);
            }
        }
        let weights = Factors::<S::Count, ScalarOf<S>>::new(&gram).solve(&defect);
        let mut moved = ScalarOf::<S>::ZERO;
        for (gradient, weight) in gradients.as_ref().iter().zip(weights.as_ref()) {
            moved = moved.max(largest(gradient.as_ref()) * weight.abs());
            for ((x, entry), unit) in x.as_mut().iter_mut().zip(gradient.as_ref()).zip(units.as_ref()) {
                *x -= *weight * *entry * *unit;
            }
        }
        if !moved.is_finite() {
            return Err(ProjectionError { iterations: iteration + 1, residual: residual.to_f64() });
        }
        // far from the level Newton's iteration need not halve its corrections; near it, only round-off does not
        let round_off = ScalarOf::<S>::from_f64(64.0) * ScalarOf::<S>::EPSILON;
        let mut levels = off.as_ref().iter().zip(values.as_ref());
        let is_near = moved <= ScalarOf::<S>::EPSILON.sqrt() * length(&x, units)
            || levels.all(|(defect, value)| defect.abs() <= round_off * value.abs());
        let stagnates = best.is_some_and(|best| moved >= best * ScalarOf::<S>::from_f64(0.5));
        if is_near && (moved == ScalarOf::<S>::ZERO || stagnates) {
            return Ok(S::State::from_array(x));
        }
        best = Some(moved);
    }
    Err(ProjectionError { iterations: MOST_ITERATIONS, residual: residual.to_f64() })
}

/// Powers of two near what is permitted, as the units of components; one for all where nothing is permitted to one.
fn units<T: Real, V: AsRef<[T]> + AsMut<[T]>>(mut permitted: V) -> V {
    let are_units = permitted.as_ref().iter().all(|permitted| *permitted > T::ZERO && permitted.is_finite());
    for permitted in permitted.as_mut() {
        *permitted = if are_units { power_of_two(*permitted) } else { T::ONE };
    }
    permitted
}

/// The largest component, in units.
fn length<T: Real, V: AsRef<[T]>>(x: &V, units: &V) -> T {
    let pairs = x.as_ref().iter().zip(units.as_ref());
    pairs.fold(T::ZERO, |most, (x, unit)| Scalar::max(most, x.abs() / *unit))
}

/// Gradients and defects, each pair in units of a power of two near its largest derivative: their products are then in
/// the range of the numbers wherever the gradients are.
fn in_their_units<S: Invariants>(mut gradients: Rows<S>, off: &Values<S>) -> (Rows<S>, Values<S>)
where
    ScalarOf<S>: Real,
{
    let mut off = *off;
    for (gradient, off) in gradients.as_mut().iter_mut().zip(off.as_mut()) {
        let size = largest(gradient.as_ref());
        if size > ScalarOf::<S>::ZERO && size.is_finite() {
            let unit = power_of_two(size);
            gradient.as_mut().iter_mut().for_each(|entry| *entry = *entry / unit);
            *off = *off / unit;
        }
    }
    (gradients, off)
}

fn dot<S: Invariants>(a: &VecOf<S>, b: &VecOf<S>) -> ScalarOf<S> {
    a.as_ref().iter().zip(b.as_ref()).fold(ScalarOf::<S>::ZERO, |sum, (a, b)| sum + *a * *b)
}

#[cfg(test)]
mod tests {
    use crate::pair::Pair;
    use crate::prelude::*;
    use crate::{D, Invariants, Method};

    /// x' = 1, which keeps no power of x; what is stated is that xⁿ + drift t is kept.
    #[derive(Clone, Copy)]
    struct Wrong {
        power: i32,
        drift: f64,
    }
    impl Dynamics for Wrong {
        type State = Pair;
        type Input = ();
        fn derivative(&self, _t: f64, _state: &Pair, (): &()) -> Pair {
            Pair([1.0, 0.0])
        }
    }
    impl Invariants for Wrong {
        type Count = D<1>;
        fn invariants(&self, t: f64, Pair([x, _]): &Pair) -> [f64; 1] {
            [x.powi(self.power) + self.drift * t]
        }
        fn invariant_gradients(&self, _t: f64, Pair([x, _]): &Pair) -> [[f64; 2]; 1] {
            [[f64::from(self.power) * x.powi(self.power - 1), 0.0]]
        }
    }

    /// From x = 10 to 0.01, where corrections of a fourth power fall by a quarter at a time.
    #[test]
    fn a_level_is_reached_from_far_away_and_how_far_is_told() {
        let start = Pair([0.01, 0.0]);
        let wrong = Wrong { power: 4, drift: 0.0 };
        let mut sim = Integrator::new(wrong, Conserving::new(Rk4::new(10.0)), 0.0, start);
        sim.step().unwrap();
        assert!((sim.state().0[0] - 0.01).abs() < 1e-15, "{:?}", sim.state());
        let Statistics { projections, largest_correction, .. } = sim.statistics();
        assert!(projections == 1 && (largest_correction - 10.0).abs() < 1e-14, "{largest_correction}");
    }

    #[test]
    fn a_level_that_is_nowhere_is_an_error() {
        let wrong = Wrong { power: 2, drift: 1.0 };
        let mut sim = Integrator::new(wrong, Conserving::new(Rk4::new(1.0)), 0.0, Pair([0.5, 0.0]));
        let refused = sim.step();
        assert!(matches!(refused, Err(IntegrationError::Projection { .. })), "{refused:?}");
        assert!((sim.state().0[0] - 0.5).abs() == 0.0);
    }

    /// An oscillator whose energy nobody knows after some time.
    #[derive(Clone, Copy)]
    struct Until(f64);
    impl Dynamics for Until {
        type State = Pair;
        type Input = ();
        fn derivative(&self, _t: f64, Pair([x, v]): &Pair, (): &()) -> Pair {
            Pair([*v, -x])
        }
    }
    impl Invariants for Until {
        type Count = D<1>;
        fn invariants(&self, t: f64, Pair([x, v]): &Pair) -> [f64; 1] {
            [if t > self.0 { f64::NAN } else { x * x + v * v }]
        }
        fn invariant_gradients(&self, _t: f64, Pair([x, v]): &Pair) -> [[f64; 2]; 1] {
            [[2.0 * x, 2.0 * v]]
        }
    }

    /// A step that ends where there is no level is not taken: the next one, nearer, is that of a run without it.
    #[test]
    fn a_step_that_is_not_taken_leaves_nothing_behind() {
        fn check<M: Method<Until> + Copy>(name: &str, method: M) {
            let run = |ends: &[f64]| {
                let start = Pair([0.8, 0.7]);
                let mut sim = Integrator::new(Until(0.5), Conserving::new(method), 0.0, start);
                let refused = ends.iter().filter(|end| sim.step_towards(**end).is_err()).count();
                (refused, sim.time(), sim.state().0.map(f64::to_bits))
            };
            let (none, time, state) = run(&[0.25]);
            assert_eq!((none, time), (0, 0.25), "{name}");
            assert_eq!(run(&[1.0, 0.25]), (1, time, state), "{name}");
        }
        macro_rules! adaptive {
            ($($name:ident)*) => {$(check(stringify!($name), $name::new().rtol(0.1).first_step(1.0));)*};
        }
        adaptive! { Bs23 Dopri5 Tsit5 Dop853 Vern9 Radau5 Rodas5P }
        check("Rk4, compensated", Rk4::new(1.0).compensated());
        check("GaussLegendre4", GaussLegendre4::new(1.0));
    }

    /// An oscillator with a unit for its place and one for its speed, powers of two.
    #[derive(Clone, Copy)]
    struct Oscillator([f64; 2]);
    impl Dynamics for Oscillator {
        type State = Pair;
        type Input = ();
        fn derivative(&self, _t: f64, Pair([x, v]): &Pair, (): &()) -> Pair {
            let [place, speed] = self.0;
            Pair([v / speed * place, -x / place * speed])
        }
    }
    impl Invariants for Oscillator {
        type Count = D<1>;
        fn invariants(&self, _t: f64, Pair([x, v]): &Pair) -> [f64; 1] {
            let [place, speed] = self.0;
            [(x / place) * (x / place) + (v / speed) * (v / speed)]
        }
        fn invariant_gradients(&self, _t: f64, Pair([x, v]): &Pair) -> [[f64; 2]; 1] {
            let [place, speed] = self.0;
            [[2.0 * (x / place) / place, 2.0 * (v / speed) / speed]]
        }
    }

    /// What is nearest is so in any units of the components, with tolerances that have these.
    #[test]
    fn units_of_components_matter_to_nothing() {
        let ended = |place: f64, speed: f64| {
            let method = Conserving::new(Dopri5::new().rtol(1e-3).atol(0.0));
            let start = Pair([0.8 * place, 0.7 * speed]);
            let mut sim = Integrator::new(Oscillator([place, speed]), method, 0.0, start);
            sim.advance_to(20.0).unwrap();
            let Pair([x, v]) = *sim.state();
            let kept = (x / place).powi(2) + (v / speed).powi(2);
            assert!((kept - 1.13).abs() < 1e-14, "{place} {speed}: {kept}");
            [x / place, v / speed].map(f64::to_bits)
        };
        let plain = ended(1.0, 1.0);
        for (place, speed) in [(1024.0, 1.0), (1.0, 2_f64.powi(-60)), (2_f64.powi(100), 2_f64.powi(-100))] {
            assert_eq!(ended(place, speed), plain, "{place} {speed}");
        }
    }
}
