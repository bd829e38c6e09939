//! The two runs, and the right-hand side that everyone gets: the emitted one.

use nonholonomic::prelude::*;

/// A rigid body on a plane, carried by a knife edge (Chaplygin sleigh).
#[nonholonomic(
    base   { theta, x, y }
    basis  { omega, v1, v2 }
    anchor {
        der(theta) = omega;
        der(x) = v1 * cos(theta) - v2 * sin(theta);
        der(y) = v1 * sin(theta) + v2 * cos(theta);
    }
    lagrangian  { (J + m * (a^2 + b^2)) / 2 * omega^2 + m / 2 * (v1^2 + v2^2) - m * b * omega * v1 + m * a * omega * v2 }
    constraints { v2 = 0; }
    assume      { m > 0; J > 0; }
    emit        { taylor }
)]
#[derive(Clone, Copy, Debug)]
pub struct Sleigh {
    pub m: f64,
    pub J: f64,
    pub a: f64,
    pub b: f64,
}

/// A rigid body about a fixed point whose angular velocity stays orthogonal to a vector fixed in space.
#[nonholonomic(
    base  { g[3] }
    basis { w[3] }
    anchor {
        der(g[0]) = g[1] * w[2] - g[2] * w[1];
        der(g[1]) = g[2] * w[0] - g[0] * w[2];
        der(g[2]) = g[0] * w[1] - g[1] * w[0];
    }
    brackets so(3) { w }
    lagrangian  { sum(i in 0..3: I[i] * w[i]^2) / 2 - dot(c, g) }
    constraints { dot(g, w) = 0; }
    emit        { taylor }
)]
#[derive(Clone, Copy, Debug)]
pub struct Veselova {
    pub I: [f64; 3],
    pub c: [f64; 3],
}

/// A run whose end is known.
pub trait Problem<const N: usize>:
    TaylorSeries<State: State<Scalar = f64, Dim = nonholonomic::D<N>>, Input = ()> + Copy + 'static
{
    const NAME: &'static str;
    const END: f64;
    /// The end, from `python/reference.py`.
    const REFERENCE: [f64; N];

    /// The system and its start.
    fn given() -> (Self, [f64; N]);

    /// The derivative, as every library is given it.
    #[inline]
    fn rate(&self, t: f64, x: &[f64; N]) -> [f64; N] {
        self.derivative(t, &Self::State::from_array(*x), &()).to_array()
    }
}

impl Problem<5> for Sleigh {
    const NAME: &'static str = "sleigh";
    const END: f64 = 20.0;
    const REFERENCE: [f64; 5] = SLEIGH;

    fn given() -> (Self, [f64; 5]) {
        (Self { m: 1.5, J: 0.8, a: 0.35, b: -0.2 }, [0.3, 0.0, 0.0, 1.1, -0.6])
    }
}

impl Problem<6> for Veselova {
    const NAME: &'static str = "veselova";
    const END: f64 = 100.0;
    const REFERENCE: [f64; 6] = VESELOVA;

    fn given() -> (Self, [f64; 6]) {
        let body = Self { I: [2.1, 2.8, 3.3], c: [0.9, -0.4, 1.7] };
        (body, [14.0 / 15.0, 2.0 / 15.0, 1.0 / 3.0, 0.6, -1.1, -1.24])
    }
}

const SLEIGH: [f64; 5] =
    [4.867242701758369, -0.5919840513152261, -15.542084728666937, 0.00011734379580648774, 0.9684590165253134];
const VESELOVA: [f64; 6] = [
    -0.8968355415311274,
    -0.05129684593886489,
    0.4393798414166197,
    -0.674143014110514,
    1.4987453618993316,
    -1.2010439611814427,
];
