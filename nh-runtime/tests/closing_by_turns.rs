//! Rows of one jump that act on one another, mathematics (50).

use nonholonomic::impacts::{Impact, Rows, strike};
use nonholonomic::prelude::*;
use nonholonomic::{D, Dynamics};

/// A particle of mass 1 in the plane, by its velocity.
#[derive(Clone, Copy, Debug)]
struct Particle;

#[derive(Clone, Copy, Debug, PartialEq)]
struct Velocity([f64; 2]);

impl State for Velocity {
    type Scalar = f64;
    type Dim = D<2>;
    fn to_array(&self) -> [f64; 2] {
        self.0
    }
    fn from_array(x: [f64; 2]) -> Self {
        Self(x)
    }
    fn names() -> [&'static str; 2] {
        ["u", "v"]
    }
}

impl Dynamics for Particle {
    type State = Velocity;
    type Input = ();
    fn derivative(&self, _t: f64, _x: &Velocity, (): &()) -> Velocity {
        Velocity([0.0; 2])
    }
}

fn energy(Velocity([u, v]): &Velocity) -> f64 {
    0.5 * (u * u + v * v)
}

/// Two walls with these normals that the particle touches; the second is a slip that ends if it is no gap.
struct Corner {
    normals: [[f64; 2]; 2],
    restitution: f64,
    are_gaps: [bool; 2],
}

impl Impact<Particle, 2> for Corner {
    fn names(&self) -> [&'static str; 2] {
        ["first", "second"]
    }
    fn restitution(&self, _system: &Particle) -> f64 {
        self.restitution
    }
    fn bounces(&self) -> [bool; 2] {
        self.are_gaps
    }
    fn is_homogeneous(&self) -> bool {
        true
    }
    fn gaps(&self, _system: &Particle, _t: f64, _x: &Velocity) -> [Option<f64>; 2] {
        self.are_gaps.map(|is_gap| is_gap.then_some(0.0))
    }
    fn rows(&self, _system: &Particle, _t: f64, Velocity([u, v]): &Velocity) -> Rows<f64, [f64; 2], 2> {
        Rows {
            approach: self.normals.map(|[a, b]| a * u + b * v),
            response: self.normals,
            mobility: self.normals.map(|[a, b]| self.normals.map(|[c, d]| a * c + b * d)),
        }
    }
}

#[test]
fn rows_that_close_each_other_by_turns_land_together() {
    // without restitution there is an end in any corner, however the rates of the walls are rounded
    let mut seed = 3_u64;
    let mut random = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from(u32::try_from(seed >> 32).unwrap()) / f64::from(u32::MAX) - 0.5
    };
    for _ in 0..50_000 {
        let normals: [[f64; 2]; 2] = core::array::from_fn(|_| [random(), random()]);
        let before = Velocity([random(), random()]);
        let [[a, b], [c, d]] = normals;
        if (a * d - b * c).abs() < 0.05 * a.hypot(b) * c.hypot(d) {
            // walls that are hardly told apart
            continue;
        }
        let corner = Corner { normals, restitution: 0.0, are_gaps: [true; 2] };
        let struck = match strike(&Particle, &corner, 0.0, &before, 0.0) {
            Ok(struck) => struck,
            Err(error) => panic!("{error}: {normals:?} {before:?}"),
        };
        let lost = energy(&before) - energy(&struck.after);
        assert!(lost > -1e-15 && (lost - struck.lost.unwrap()).abs() < 1e-12, "{lost} {struck:?}");
        let Velocity([u, v]) = struck.after;
        assert!(normals.iter().all(|[a, b]| a * u + b * v > -1e-12), "{struck:?}");
    }
}

#[test]
fn a_bounce_that_grips_may_gain_energy_and_says_so() {
    let grip = Corner { normals: [[0.0, 1.0], [1.0, 0.5]], restitution: 1.0, are_gaps: [true, false] };
    let before = Velocity([0.3, -1.0]);
    let struck = strike(&Particle, &grip, 0.0, &before, 0.0).unwrap();
    let Velocity([u, v]) = struck.after;
    assert!((v - 1.0).abs() < 1e-14 && (u + 0.5).abs() < 1e-14, "{struck:?}");
    let lost = struck.lost.unwrap();
    assert!((lost - (energy(&before) - energy(&struck.after))).abs() < 1e-14, "{struck:?}");
    assert!((lost - 0.5 * (0.09 - 0.25)).abs() < 1e-14, "{struck:?}");
}
