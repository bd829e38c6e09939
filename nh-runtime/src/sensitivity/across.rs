//! An integration with its derivatives from event to event.

use core::ops::ControlFlow;

use nalgebra::SMatrix;

use super::crossing::{AfterEvent, Passage};
use super::motion::{Variational, WithColumns};
use super::no_derivative::SensitivityError;
use super::stack::Columns;
use crate::arrays::{all_finite, displaced};
use crate::integrator::Spent;
use crate::methods::Method;
use crate::{D, Direction, Dynamics, Event, Events, Integrator, Jacobian, Jet, Real, Scalar, State};

/// Events at which the state jumps, written for any numbers, so that they are differentiated by [`Jet`]s: `N` components
/// of the state, `K` columns, `E` events.
///
/// Where an event or a jump contains what column k is taken by, a coefficient of restitution for instance, add `by[k]` to
/// it: it is zero, and carries the derivative.
pub trait Jumps<const N: usize, const K: usize, const E: usize> {
    /// The event functions.
    fn events<A: Scalar>(&self, t: A, state: &[A; N], by: &[A; K]) -> [A; E];

    /// The state after the event of this number.
    fn reset<A: Scalar>(&self, event: usize, t: A, state: &[A; N], by: &[A; K]) -> [A; N];

    /// In which direction each function passes zero where it is an event: falling, unless said otherwise. What may come to
    /// rest on a gap has to say [`Direction::Closing`], or falls through it.
    fn directions(&self) -> [Direction; E] {
        [Direction::Falling; E]
    }
}

/// Another event happens at the same time if its function is zero but for so many roundings of its terms.
const SAME_TIME: f64 = 64.0;

/// A motion grazes if its rate turns within the time in which the function passes so many roundings of its terms.
const GRAZES: f64 = 4.0;

/// A jump that was made.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Jumped<T, X, const K: usize> {
    /// Which event.
    pub event: usize,
    /// When.
    pub time: T,
    /// The derivative of that time by what each column is taken by.
    pub time_by: [T; K],
    /// State and columns before.
    pub before: WithColumns<X, K>,
    /// State and columns after.
    pub after: WithColumns<X, K>,
}

/// A jump of a system.
type JumpedOf<S, T, const K: usize> = Jumped<T, <S as Dynamics>::State, K>;

/// Takes steps to `target`; at each event makes its jump and takes the columns through it, mathematics (53), and tells
/// `visit`, which may end the run there. Gives that jump, or nothing at the target.
///
/// The columns are derivatives at the same time: after an event that comes later by δτ they contain what the motion has
/// not yet done. Jumps of declared `impacts` are written anew for `Jumps`, as their generated form is one of numbers.
///
/// # Errors
/// [`SensitivityError::Grazing`], where the event function, within its rounding, only touches zero;
/// [`SensitivityError::Simultaneous`], [`SensitivityError::NotFinite`]: with the integration
/// standing at the event before its jump; and what [`Integrator::advance_watching`] says, with the limits on steps and
/// evaluations for the whole call.
///
/// ```
/// use core::ops::ControlFlow;
/// use nonholonomic::prelude::*;
/// use nonholonomic::sensitivity::{By, Jumps, Variational, advance_across};
///
/// /// A ball over the ground.
/// #[nonholonomic(
///     base       { height }
///     lagrangian { m / 2 * der(height)^2 - m * g * height }
///     emit       { jacobian, parameter_jacobian }
/// )]
/// #[derive(Clone, Copy, Debug)]
/// struct Ball { m: f64, g: f64 }
///
/// /// The ground: a share of the speed is left after each bounce. Column 1 is taken by that share.
/// struct Ground { restitution: f64 }
///
/// impl Jumps<2, 2, 1> for Ground {
///     fn events<A: Scalar>(&self, _t: A, [height, _]: &[A; 2], _by: &[A; 2]) -> [A; 1] { [*height] }
///     fn reset<A: Scalar>(&self, _event: usize, _t: A, [height, speed]: &[A; 2], by: &[A; 2]) -> [A; 2] {
///         [*height, -(A::from_f64(self.restitution) + by[1]) * *speed]
///     }
///     fn directions(&self) -> [Direction; 1] { [Direction::Closing] }
/// }
///
/// # fn main() -> Result<(), Box<dyn core::error::Error>> {
/// // by the height it falls from; and by the restitution, which the equations of motion do not contain
/// let motion = Variational::new(Ball { m: 1.0, g: 2.0 }, [By::Start(0), By::Parameter(0)])
///     .by_parameters(|_: &Ball, _, _, _| nonholonomic::nalgebra::SMatrix::<f64, 2, 1>::zeros());
/// let start = motion.start(&BallState { height: 1.0, height_dot: 0.0 })?;
/// let mut sim = Integrator::new(motion, Dopri5::new().rtol(1e-10), 0.0, start);
/// advance_across(&mut sim, 1.5, &Ground { restitution: 0.5 }, |_bounce| ControlFlow::Continue(()))?;
/// // it arrives at √h and leaves with e √h·2: height = 2 e √h (t − √h) − (t − √h)²
/// let [by_height, by_restitution] = sim.state().columns;
/// assert!((by_height.height - 0.25).abs() < 1e-8);
/// assert!((by_restitution.height - 1.0).abs() < 1e-8);
/// # Ok(())
/// # }
/// ```
pub fn advance_across<
    S,
    F,
    T,
    A,
    J,
    const N: usize,
    const M: usize,
    const Q: usize,
    const K: usize,
    const E: usize,
>(
    sim: &mut Integrator<Variational<S, F, K>, A>,
    target: T,
    jumps: &J,
    mut visit: impl FnMut(&JumpedOf<S, T, K>) -> ControlFlow<()>,
) -> Result<Option<JumpedOf<S, T, K>>, SensitivityError>
where
    T: Real,
    S: Jacobian<InputDim = D<M>, State: State<Scalar = T, Dim = D<N>>>,
    F: Fn(&S, T, &S::State, &S::Input) -> SMatrix<T, N, Q>,
    D<K>: Columns,
    A: Method<Variational<S, F, K>>,
    J: Jumps<N, K, E>,
{
    let values = |t: T, x: &WithColumns<S::State, K>| jumps.events(t, &x.state.to_array(), &[T::ZERO; K]);
    let forwards = target >= sim.time();
    // how far beyond zero, by rounding, each function has been left
    let mut depths = [T::ZERO; E];
    let mut spent = Spent::default();
    loop {
        let over = |t: T, x: &WithColumns<S::State, K>, _: &S::Input| {
            let mut values = values(t, x);
            values.iter_mut().zip(&depths).for_each(|(value, depth)| *value -= *depth);
            values
        };
        let events = Events::new(over).directions(jumps.directions());
        let (mut first, mut second) = (None, None);
        let note = |event: &Event<T, WithColumns<S::State, K>>| {
            if first.is_none() {
                first = Some(event.index);
            } else {
                second = second.or(Some(event.index));
            }
            ControlFlow::Break(())
        };
        sim.watch((target, &mut spent), &events, false, note, |_| Ok::<_, SensitivityError>(()))?;
        let Some(event) = first else { return Ok(None) };
        let time = sim.time();
        if let Some(other) = second {
            return Err(SensitivityError::Simultaneous { events: [event, other], time: time.to_f64() });
        }
        let jumped = jumped((sim.system(), sim.input(), forwards), jumps, (event, time), *sim.state())?;
        let left =
            [&jumped.before, &jumped.after].map(|x| values(time, x).get(event).copied().unwrap_or(T::ZERO));
        if let (Some(depth), [before, after]) = (depths.get_mut(event), left) {
            // a jump that leaves the function where it was starts it from there, as if that were zero
            let stays = after.abs() <= T::from_f64(4.0) * before.abs();
            *depth = if stays { after } else { T::ZERO };
        }
        sim.set_state(jumped.after);
        if visit(&jumped).is_break() {
            return Ok(Some(jumped));
        }
    }
}

/// The size of the terms of a function that is zero, whose roundings it is known to; `along` is its rate.
fn size_at_zero<T: Real, const N: usize>(gradient: &Jet<T, N, 1>, (along, time): (T, T), x: &[T; N]) -> T {
    let terms =
        gradient.by.iter().zip(x).map(|(by, x)| *by * *x).chain(gradient.by_others.map(|by| by * time));
    terms.fold((along * time).abs(), |sum, term| sum + term.abs())
}

/// The jump at an event of a run in this direction of time.
fn jumped<S, F, T, J, const N: usize, const M: usize, const Q: usize, const K: usize, const E: usize>(
    (motion, input, forwards): (&Variational<S, F, K>, &S::Input, bool),
    jumps: &J,
    (event, time): (usize, T),
    before: WithColumns<S::State, K>,
) -> Result<JumpedOf<S, T, K>, SensitivityError>
where
    T: Real,
    S: Jacobian<InputDim = D<M>, State: State<Scalar = T, Dim = D<N>>>,
    F: Fn(&S, T, &S::State, &S::Input) -> SMatrix<T, N, Q>,
    J: Jumps<N, K, E>,
{
    let x = before.state.to_array();
    let rate = motion.system.derivative(time, &before.state, input).to_array();
    // along each column, and along the motion
    let mut state = x.map(Jet::<T, K, 1>::constant);
    for (jet, rate) in state.iter_mut().zip(rate) {
        jet.by_others = [rate];
    }
    for (k, column) in before.columns.iter().enumerate() {
        for (jet, entry) in state.iter_mut().zip(column.to_array()) {
            if let Some(by) = jet.by.get_mut(k) {
                *by = entry;
            }
        }
    }
    let clock = Jet { by_others: [T::ONE], ..Jet::constant(time) };
    let by = Jet::variables([T::ZERO; K]);
    let functions = jumps.events(clock, &state, &by);
    let function = functions.get(event).copied().unwrap_or_default();
    let reset = jumps.reset(event, clock, &state, &by);
    let after = S::State::from_array(reset.map(|component| component.value));
    let not_finite = SensitivityError::NotFinite { what: "state after the jump", time: time.to_f64() };
    if !all_finite(&reset.map(|component| component.value)) {
        return Err(not_finite);
    }
    // the terms that the rate of the function is the sum of
    let apart = Jet { by_others: [T::ONE], ..Jet::<T, N, 1>::constant(time) };
    let gradients = jumps.events(apart, &Jet::variables(x), &[Jet::ZERO; K]);
    let others = functions.iter().zip(&gradients).zip(jumps.directions()).enumerate();
    for (other, ((function, gradient), direction)) in others.filter(|(other, _)| *other != event) {
        let [along] = function.by_others;
        let terms = gradient.by.iter().zip(&rate).map(|(by, rate)| *by * *rate).chain(gradient.by_others);
        let resolved =
            T::from_f64(SAME_TIME) * T::EPSILON * terms.fold(T::ZERO, |sum, term| sum + term.abs());
        // a function rises or falls in the direction in which the run goes
        let ahead = if forwards { along } else { -along };
        let arrives = match direction {
            Direction::Rising => ahead > resolved,
            Direction::Falling | Direction::Closing => ahead < -resolved,
            Direction::Either => ahead.abs() > resolved,
        };
        let size = size_at_zero(gradient, (along, time), &x);
        if arrives && function.value.abs() <= T::from_f64(SAME_TIME) * T::EPSILON * size {
            return Err(SensitivityError::Simultaneous { events: [event, other], time: time.to_f64() });
        }
    }
    let gradient = gradients.get(event).copied().unwrap_or_default();
    let terms = gradient.by.iter().zip(&rate).map(|(by, rate)| *by * *rate).chain(gradient.by_others);
    let terms = terms.fold(T::ZERO, |sum, term| sum + term.abs());
    let [along] = function.by_others;
    // where the event is known to roundings alone, a motion that touches shows some rate all the same
    let passing = T::from_f64(GRAZES) * T::EPSILON * size_at_zero(&gradient, (along, time), &x) / along.abs();
    let turns = |delay: T| {
        let there = displaced(&x, delay, &rate);
        let slope = motion.system.derivative(time + delay, &S::State::from_array(there), input).to_array();
        let mut state = there.map(Jet::<T, K, 1>::constant);
        state.iter_mut().zip(slope).for_each(|(jet, slope)| jet.by_others = [slope]);
        let clock = Jet { by_others: [T::ONE], ..Jet::constant(time + delay) };
        let functions = jumps.events(clock, &state, &[Jet::ZERO; K]);
        functions.get(event).is_some_and(|Jet { by_others: [then], .. }| *then * along <= T::ZERO)
    };
    if turns(passing) || turns(-passing) {
        return Err(SensitivityError::Grazing { event, time: time.to_f64(), rate: (along / terms).to_f64() });
    }
    let mut columns = [[T::ZERO; N]; K];
    for (k, column) in columns.iter_mut().enumerate() {
        for (entry, component) in column.iter_mut().zip(&reset) {
            *entry = component.by.get(k).copied().unwrap_or(T::ZERO);
        }
    }
    let AfterEvent { columns, times } = Passage {
        rate: along,
        size: terms,
        event: function.by,
        reset: columns,
        along: reset.map(|Jet { by_others: [along], .. }| along),
        rate_after: motion.system.derivative(time, &after, input).to_array(),
    }
    .columns((event, time))?;
    let after = WithColumns { state: after, columns: columns.map(S::State::from_array) };
    Ok(Jumped { event, time, time_by: times, before, after })
}
