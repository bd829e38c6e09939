//! Motions of four components: smooth, stiff, fast, from rest, and over many orders of magnitude.

use core::marker::PhantomData;

use nonholonomic::{D, Dynamics, Jacobian, Jet, Real, Scalar, State};

use crate::record::Course;

/// Four numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Four<T>(pub(crate) [T; 4]);

impl<T: Scalar> State for Four<T> {
    type Scalar = T;
    type Dim = D<4>;
    fn to_array(&self) -> [T; 4] {
        self.0
    }
    fn from_array(components: [T; 4]) -> Self {
        Self(components)
    }
    fn names() -> [&'static str; 4] {
        ["a", "b", "c", "d"]
    }
}

/// Which motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// A pendulum that is driven, the integral of its angle, and a filter.
    Pendulum,
    /// A planet, of eccentricity 0.6.
    Kepler,
    /// Two springs at rest, one of which is pushed: everything starts from zero, half of it stays there.
    Rest,
    /// Van der Pol's oscillator, stiff, and a soft one beside it.
    VanDerPol,
    /// Robertson's reaction, and a decay.
    Robertson,
    /// A stone that falls, beside a spring.
    Stone,
    /// The reaction E5 of Enright, Hull and Lindberg (1975) as in Hairer, Wanner II, IV.10.
    E5,
}

impl Kind {
    pub(crate) const ALL: [Self; 6] =
        [Self::Pendulum, Self::Kepler, Self::Rest, Self::VanDerPol, Self::Robertson, Self::E5];
    /// Those within the range of single precision.
    pub(crate) const SINGLE: [Self; 4] = [Self::Pendulum, Self::Kepler, Self::Rest, Self::VanDerPol];

    fn rates<S: Scalar>(self, t: S, [a, b, c, d]: [S; 4]) -> [S; 4] {
        let w = S::from_f64;
        match self {
            Self::Pendulum => [b, w(0.5) * (w(2.0) * t).sin() - a.sin(), a, t.cos() - d],
            Self::Kepler => {
                let square = a * a + b * b;
                let cube = square * square.sqrt();
                [c, d, -a / cube, -b / cube]
            }
            Self::Stone => [b, -S::ONE, d, -c],
            Self::Rest => [b, S::ONE - a - w(0.1) * b, d, -c],
            Self::VanDerPol => [b, ((S::ONE - a * a) * b - a) * w(1e4), d, (S::ONE - c * c) * d - c],
            Self::Robertson => {
                let (slow, fast, middle) = (w(0.04) * a, w(3e7) * b * b, w(1e4) * b * c);
                [middle - slow, slow - middle - fast, fast, -d]
            }
            Self::E5 => {
                let (first, second) = (w(7.89e-10) * a, w(1.1e7) * a * c);
                let (third, fourth) = (w(1.13e9) * b * c, w(1.13e3) * d);
                [-first - second, first - third, first - second + fourth - third, second - fourth]
            }
        }
    }
}

/// The motion in numbers of type `T`.
#[derive(Clone, Copy)]
pub(crate) struct Problem<T>(pub(crate) Kind, PhantomData<T>);

impl<T: Real> Problem<T> {
    pub(crate) fn new(kind: Kind) -> Self {
        Self(kind, PhantomData)
    }

    /// Where it goes, and a step that resolves it at first.
    pub(crate) fn course(self) -> (Course<Four<T>>, T) {
        let (start, from, to, step) = match self.0 {
            Kind::Pendulum => ([0.3, -0.2, 0.0, 1.0], 1.5, 9.0, 0.1),
            Kind::Kepler => ([0.4, 0.0, 0.0, 2.0], 0.25, 10.0, 0.05),
            Kind::Rest => ([0.0; 4], 0.5, 8.0, 0.1),
            Kind::Stone => ([1.0, 0.0, 0.3, 0.0], 0.5, 20.0, 0.1),
            Kind::VanDerPol => ([2.0, -0.66, 2.0, 0.0], 0.0, 2.0, 1e-5),
            Kind::Robertson => ([1.0, 0.0, 0.0, 1.0], 0.0, 1e9, 1e-4),
            Kind::E5 => ([1.76e-3, 0.0, 0.0, 0.0], 0.0, 1e13, 1e-5),
        };
        let w = T::from_f64;
        (Course { start: Four(start.map(w)), from: w(from), to: w(to), steps: 60 }, w(step))
    }

    /// An absolute tolerance for each component.
    pub(crate) fn negligible(self) -> Four<T> {
        let numbers = match self.0 {
            Kind::Robertson => [1e-8, 1e-12, 1e-8, 1e-8],
            Kind::E5 => [1e-11, 1e-17, 1e-19, 1e-17],
            _ => [1e-6, 1e-7, 1e-6, 1e-5],
        };
        Four(numbers.map(T::from_f64))
    }
}

impl<T: Real> Dynamics for Problem<T> {
    type State = Four<T>;
    type Input = ();
    fn derivative(&self, t: T, Four(x): &Four<T>, (): &()) -> Four<T> {
        Four(self.0.rates(t, *x))
    }
}

impl<T: Real> Jacobian for Problem<T> {
    type InputDim = D<0>;
    fn state_jacobian(&self, t: T, Four(x): &Four<T>, (): &()) -> [[T; 4]; 4] {
        self.0.rates(Jet::constant(t), Jet::<T, 4>::variables(*x)).map(|jet| jet.by)
    }
    fn input_jacobian(&self, _t: T, _x: &Four<T>, (): &()) -> [[T; 0]; 4] {
        [[]; 4]
    }
}
