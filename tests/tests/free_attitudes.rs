//! Bodies that turn freely, their attitudes by quaternions, matrices and angles and their velocities along axes of their own
//! and of space, mathematics (42) and (43): each time the forces of Newton and Euler balance.
#![allow(non_snake_case, reason = "parameters are written as in mechanics: M")]

use nh_tests::random::Random;
use nh_tests::vectors::{Square, Vector, cross, dot, image, plus, product, transposed};
use nonholonomic::prelude::*;

/// Aᵀ u.
fn back(a: &Square, u: Vector) -> Vector {
    image(&transposed(a), u)
}

fn scaled(factor: f64, a: Vector) -> Vector {
    a.map(|entry| factor * entry)
}

/// The rotation of a quaternion of length 1.
fn rotation([w, x, y, z]: [f64; 4]) -> Square {
    [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
        [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
    ]
}

/// Of rot_z(yaw) rot_y(pitch) rot_x(roll).
fn quaternion([roll, pitch, yaw]: Vector) -> [f64; 4] {
    let ([sr, cr], [sp, cp], [sy, cy]) = (half(roll), half(pitch), half(yaw));
    [
        cr * cp * cy + sr * sp * sy,
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
    ]
}

fn half(angle: f64) -> [f64; 2] {
    [(angle / 2.0).sin(), (angle / 2.0).cos()]
}

fn about_z(angle: f64) -> Square {
    let (s, c) = angle.sin_cos();
    [[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]
}

fn about_y(angle: f64) -> Square {
    let (s, c) = angle.sin_cos();
    [[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]]
}

/// A spacecraft with an arm of two links in a field of gravity.
#[derive(Clone, Copy, Debug)]
struct Craft {
    M: f64,
    I: Vector,
    m: f64,
    J: Vector,
    b: Vector,
    l: Vector,
    c: Vector,
    g: f64,
}

/// Where it is and how it moves: v of space, w along its own axes; then their rates.
#[derive(Clone, Copy, Debug)]
struct Motion {
    p: Vector,
    angles: Vector,
    a: [f64; 2],
    v: Vector,
    w: Vector,
    s: [f64; 2],
}

#[derive(Clone, Copy, Debug)]
struct Rates {
    v: Vector,
    w: Vector,
    s: [f64; 2],
}

const TORQUE: [f64; 2] = [0.3, -0.7];

impl Motion {
    fn attitude(&self) -> Square {
        rotation(quaternion(self.angles))
    }
}

/// A frame as it moves, all in the axes of space.
struct Frame {
    attitude: Square,
    rate: Vector,
    turned: Vector,
    origin: Vector,
    moved: Vector,
}

impl Frame {
    /// A place fixed in it, with its acceleration.
    fn at(&self, place: Vector) -> [Vector; 2] {
        let arm = image(&self.attitude, place);
        let swung = plus(cross(self.turned, arm), cross(self.rate, cross(self.rate, arm)));
        [plus(self.origin, arm), plus(self.moved, swung)]
    }

    /// A frame that turns about an axis of this one.
    fn hinged(&self, place: Vector, (axis, by): (usize, Square), speed: f64, change: f64) -> Self {
        let [origin, moved] = self.at(place);
        let n: Vector = std::array::from_fn(|i| self.attitude[i][axis]);
        let rate = plus(self.rate, scaled(speed, n));
        let gyroscopic = scaled(speed, cross(self.rate, n));
        let turned = plus(plus(self.turned, scaled(change, n)), gyroscopic);
        Self { attitude: product(&self.attitude, &by), rate, turned, origin, moved }
    }

    /// The force and the moment about its centre of mass that a body takes beside its weight, with that place.
    fn taken(&self, (mass, inertia, centre): (f64, Vector, Vector), g: f64) -> [Vector; 3] {
        let [place, moved] = self.at(centre);
        let force = scaled(mass, plus(moved, [0.0, 0.0, g]));
        let [w, dw] = [self.rate, self.turned].map(|vector| back(&self.attitude, vector));
        let of = |u: Vector| std::array::from_fn(|k| inertia[k] * u[k]);
        let moment = image(&self.attitude, plus(of(dw), cross(w, of(w))));
        [force, moment, place]
    }
}

/// The moment that bodies take about a place.
fn about(bodies: &[[Vector; 3]], place: Vector) -> Vector {
    bodies.iter().fold([0.0; 3], |sum, [force, moment, at]| {
        plus(sum, plus(*moment, cross(plus(*at, scaled(-1.0, place)), *force)))
    })
}

/// What is left of the balance of forces, and of moments, of all bodies and at the joints.
fn unbalanced(craft: &Craft, motion: &Motion, rates: &Rates) -> Vec<f64> {
    let attitude = motion.attitude();
    let [rate, turned] = [motion.w, rates.w].map(|u| image(&attitude, u));
    let hull = Frame { attitude, rate, turned, origin: motion.p, moved: rates.v };
    let upper = hull.hinged(craft.b, (2, about_z(motion.a[0])), motion.s[0], rates.s[0]);
    let lower = upper.hinged(craft.l, (1, about_y(motion.a[1])), motion.s[1], rates.s[1]);
    let taken = [
        hull.taken((craft.M, craft.I, [0.0; 3]), craft.g),
        upper.taken((craft.m, craft.J, craft.c), craft.g),
        lower.taken((craft.m, craft.J, craft.c), craft.g),
    ];
    let force = taken.iter().fold([0.0; 3], |sum, [force, ..]| plus(sum, *force));
    let axis = |frame: &Frame, k: usize| std::array::from_fn(|i| frame.attitude[i][k]);
    let mut left = [force, about(&taken, motion.p)].concat();
    left.push(dot(axis(&upper, 2), about(&taken[1..], upper.origin)) - TORQUE[0]);
    left.push(dot(axis(&lower, 1), about(&taken[2..], lower.origin)) - TORQUE[1]);
    left
}

/// A machine that is this spacecraft.
trait Spacecraft {
    const DERIVED: &'static str;
    fn rates(craft: &Craft, motion: &Motion) -> Rates;
}

macro_rules! spacecraft {
    ($name:ident { $($sections:tt)* } $state:expr, $rates:expr) => {
        #[nonholonomic(
            $($sections)*
            let R1 = R * rot_z(a[0]);
            let R2 = R1 * rot_y(a[1]);
            let x1 = p + R * b + R1 * c;
            let x2 = p + R * b + R1 * l + R2 * c;
            lagrangian {
                kinetic(M, I, p, R) + kinetic(m, J, x1, R1) + kinetic(m, J, x2, R2)
                - g * (M * p[2] + m * (x1 + x2)[2])
            }
            inputs { torque[2] }
            forces { s: torque; }
            emit { explain }
        )]
        #[derive(Clone, Copy, Debug)]
        struct $name { M: f64, I: [f64; 3], m: f64, J: [f64; 3], b: [f64; 3], l: [f64; 3], c: [f64; 3], g: f64 }

        impl Spacecraft for $name {
            const DERIVED: &'static str = Self::DERIVATION;
            fn rates(craft: &Craft, motion: &Motion) -> Rates {
                type Input = <$name as Dynamics>::Input;
                let Craft { M, I, m, J, b, l, c, g } = *craft;
                let machine = $name { M, I, m, J, b, l, c, g };
                let state = $state(motion);
                $rates(motion, machine.derivative(0.0, &state, &Input { torque: TORQUE }))
            }
        }
    };
}

spacecraft! { ByAngles {
    base { p[3], e[3], a[2] }
    let R = rot_z(e[2]) * rot_y(e[1]) * rot_x(e[0]);
    velocities { w = body_rate(R); v = der(p); s = der(a); }
}
    |motion: &Motion| {
        let Motion { p, angles, a, v, w, s } = *motion;
        ByAnglesState { p, e: angles, a, w, v, s }
    },
    |_: &Motion, rate: ByAnglesState| Rates { v: rate.v, w: rate.w, s: rate.s }
}

spacecraft! { ByQuaternion {
    base { p[3], q[4], a[2] }
    on { dot(q, q) = 1; }
    basis { w[3], v[3], s[2] }
    anchor {
        der(q[0]) = -(q[1] * w[0] + q[2] * w[1] + q[3] * w[2]) / 2;
        der(q[1]) = (q[0] * w[0] + q[2] * w[2] - q[3] * w[1]) / 2;
        der(q[2]) = (q[0] * w[1] + q[3] * w[0] - q[1] * w[2]) / 2;
        der(q[3]) = (q[0] * w[2] + q[1] * w[1] - q[2] * w[0]) / 2;
        der(p) = v;
        der(a) = s;
    }
    brackets so(3) { w }
    let R = [
        [q[0]^2 + q[1]^2 - q[2]^2 - q[3]^2, 2 * (q[1] * q[2] - q[0] * q[3]), 2 * (q[1] * q[3] + q[0] * q[2])],
        [2 * (q[1] * q[2] + q[0] * q[3]), q[0]^2 - q[1]^2 + q[2]^2 - q[3]^2, 2 * (q[2] * q[3] - q[0] * q[1])],
        [2 * (q[1] * q[3] - q[0] * q[2]), 2 * (q[2] * q[3] + q[0] * q[1]), q[0]^2 - q[1]^2 - q[2]^2 + q[3]^2]
    ];
}
    |motion: &Motion| {
        let Motion { p, angles, a, v, w, s } = *motion;
        ByQuaternionState { p, q: quaternion(angles), a, w, v, s }
    },
    |_: &Motion, rate: ByQuaternionState| Rates { v: rate.v, w: rate.w, s: rate.s }
}

// the scalar last, a matrix that is a rotation on the sphere alone, and the velocity along axes of its own
spacecraft! { ByQuaternionAndItsOwnVelocity {
    base { p[3], q[4], a[2] }
    on { dot(q, q) = 1; }
    basis { w[3], u[3], s[2] }
    let R = [
        [1 - 2 * (q[1]^2 + q[2]^2), 2 * (q[0] * q[1] - q[3] * q[2]), 2 * (q[0] * q[2] + q[3] * q[1])],
        [2 * (q[0] * q[1] + q[3] * q[2]), 1 - 2 * (q[0]^2 + q[2]^2), 2 * (q[1] * q[2] - q[3] * q[0])],
        [2 * (q[0] * q[2] - q[3] * q[1]), 2 * (q[1] * q[2] + q[3] * q[0]), 1 - 2 * (q[0]^2 + q[1]^2)]
    ];
    anchor {
        der(q[0]) = (q[3] * w[0] + q[1] * w[2] - q[2] * w[1]) / 2;
        der(q[1]) = (q[3] * w[1] + q[2] * w[0] - q[0] * w[2]) / 2;
        der(q[2]) = (q[3] * w[2] + q[0] * w[1] - q[1] * w[0]) / 2;
        der(q[3]) = -(q[0] * w[0] + q[1] * w[1] + q[2] * w[2]) / 2;
        der(p) = R * u;
        der(a) = s;
    }
}
    |motion: &Motion| {
        let Motion { p, angles, a, v, w, s } = *motion;
        let [real, x, y, z] = quaternion(angles);
        ByQuaternionAndItsOwnVelocityState { p, q: [x, y, z, real], a, w, u: back(&motion.attitude(), v), s }
    },
    |motion: &Motion, rate: ByQuaternionAndItsOwnVelocityState| {
        let attitude = motion.attitude();
        let own = plus(rate.u, cross(motion.w, back(&attitude, motion.v)));
        Rates { v: image(&attitude, own), w: rate.w, s: rate.s }
    }
}

spacecraft! { ByQuaternionAndAxesOfSpace {
    base { p[3], q[4], a[2] }
    on { dot(q, q) = 1; }
    basis { W[3], v[3], s[2] }
    anchor {
        der(q[0]) = -(q[1] * W[0] + q[2] * W[1] + q[3] * W[2]) / 2;
        der(q[1]) = (q[0] * W[0] + q[3] * W[1] - q[2] * W[2]) / 2;
        der(q[2]) = (q[0] * W[1] + q[1] * W[2] - q[3] * W[0]) / 2;
        der(q[3]) = (q[0] * W[2] + q[2] * W[0] - q[1] * W[1]) / 2;
        der(p) = v;
        der(a) = s;
    }
    let R = [
        [q[0]^2 + q[1]^2 - q[2]^2 - q[3]^2, 2 * (q[1] * q[2] - q[0] * q[3]), 2 * (q[1] * q[3] + q[0] * q[2])],
        [2 * (q[1] * q[2] + q[0] * q[3]), q[0]^2 - q[1]^2 + q[2]^2 - q[3]^2, 2 * (q[2] * q[3] - q[0] * q[1])],
        [2 * (q[1] * q[3] - q[0] * q[2]), 2 * (q[2] * q[3] + q[0] * q[1]), q[0]^2 - q[1]^2 - q[2]^2 + q[3]^2]
    ];
}
    |motion: &Motion| {
        let Motion { p, angles, a, v, w, s } = *motion;
        ByQuaternionAndAxesOfSpaceState { p, q: quaternion(angles), a, W: image(&motion.attitude(), w), v, s }
    },
    |motion: &Motion, rate: ByQuaternionAndAxesOfSpaceState| {
        Rates { v: rate.v, w: back(&motion.attitude(), rate.W), s: rate.s }
    }
}

spacecraft! { ByMatrix {
    base { p[3], R[3][3], a[2] }
    on { transpose(R) * R = identity(3); }
    basis { w[3], v[3], s[2] }
    anchor {
        der(R) = R * hat(w);
        der(p) = v;
        der(a) = s;
    }
    brackets so(3) { w }
}
    |motion: &Motion| {
        let Motion { p, a, v, w, s, .. } = *motion;
        ByMatrixState { p, R: motion.attitude(), a, w, v, s }
    },
    |_: &Motion, rate: ByMatrixState| Rates { v: rate.v, w: rate.w, s: rate.s }
}

/// Two bodies that hang on each other by balls, the second one with its attitude in the first.
#[nonholonomic(
    base { q[4], r[4] }
    on { dot(q, q) = 1; dot(r, r) = 1; }
    basis { w[3], u[3] }
    let rates(e, z) = [
        -(e[1] * z[0] + e[2] * z[1] + e[3] * z[2]) / 2,
        (e[0] * z[0] + e[2] * z[2] - e[3] * z[1]) / 2,
        (e[0] * z[1] + e[3] * z[0] - e[1] * z[2]) / 2,
        (e[0] * z[2] + e[1] * z[1] - e[2] * z[0]) / 2
    ];
    let turned(e) = [
        [1 - 2 * (e[2]^2 + e[3]^2), 2 * (e[1] * e[2] - e[0] * e[3]), 2 * (e[1] * e[3] + e[0] * e[2])],
        [2 * (e[1] * e[2] + e[0] * e[3]), 1 - 2 * (e[1]^2 + e[3]^2), 2 * (e[2] * e[3] - e[0] * e[1])],
        [2 * (e[1] * e[3] - e[0] * e[2]), 2 * (e[2] * e[3] + e[0] * e[1]), 1 - 2 * (e[1]^2 + e[2]^2)]
    ];
    anchor {
        der(q) = rates(q, w);
        der(r) = rates(r, u);
    }
    let R = turned(q);
    let S = R * turned(r);
    lagrangian {
        kinetic(m, J, R * c, R) + kinetic(m, J, R * l + S * c, S) - m * g * (R * c + R * l + S * c)[2]
    }
    emit { explain }
)]
#[derive(Clone, Copy, Debug)]
struct Balls {
    m: f64,
    J: [f64; 3],
    l: [f64; 3],
    c: [f64; 3],
    g: f64,
}

#[test]
fn a_free_attitude_on_another() {
    let random = &mut Random::new(0xBA11);
    for _ in 0..20 {
        let Craft { m, J, l, c, g, .. } = craft(random);
        let Motion { angles, v, w, p, .. } = motion(random);
        let state = BallsState { q: quaternion(angles), r: quaternion(p), w, u: v };
        let rate = Balls { m, J, l, c, g }.derivative(0.0, &state, &());
        let attitude = rotation(state.q);
        let [turn, turned] = [w, rate.w].map(|vector| image(&attitude, vector));
        let upper = Frame { attitude, rate: turn, turned, origin: [0.0; 3], moved: [0.0; 3] };
        let [origin, moved] = upper.at(l);
        let attitude = product(&attitude, &rotation(state.r));
        let [own, change] = [state.u, rate.u].map(|vector| image(&attitude, vector));
        let turned = plus(plus(upper.turned, change), cross(turn, own));
        let lower = Frame { attitude, rate: plus(turn, own), turned, origin, moved };
        let taken = [&upper, &lower].map(|frame| frame.taken((m, J, c), g));
        let left = [about(&taken, [0.0; 3]), about(&taken[1..], origin)].concat();
        assert!(left.iter().all(|moment| moment.abs() < 1e-11), "{left:?} of {state:?}");
    }
    assert_eq!(chosen(Balls::DERIVATION), Some("joint by joint"), "{}", Balls::DERIVATION);
}

fn craft(random: &mut Random) -> Craft {
    let mut vector = |low: f64| [(); 3].map(|()| random.between(low, 1.6));
    let [[M, m, g], I, J] = [(); 3].map(|()| vector(0.4));
    let [b, l, c] = [(); 3].map(|()| vector(-1.6));
    Craft { M, I, m, J, b, l, c, g }
}

fn motion(random: &mut Random) -> Motion {
    let mut vector = || [(); 3].map(|()| random.between(-1.4, 1.4));
    let ([p, angles, v, w], [a0, a1, _], [s0, s1, _]) = ([(); 4].map(|()| vector()), vector(), vector());
    Motion { p, angles, a: [a0, a1], v, w, s: [s0, s1] }
}

/// The form that the derivative has.
fn chosen(derivation: &str) -> Option<&str> {
    let derivative = derivation.split("\nderivative\n").nth(1)?;
    let chosen = derivative.lines().find(|line| line.contains(": chosen, "))?;
    chosen.split([',', ':']).next().map(str::trim)
}

fn balances<T: Spacecraft>() {
    let random = &mut Random::new(0xA77);
    for _ in 0..20 {
        let (craft, motion) = (craft(random), motion(random));
        let left = unbalanced(&craft, &motion, &T::rates(&craft, &motion));
        assert!(left.iter().all(|force| force.abs() < 1e-11), "{left:?} of {craft:?} at {motion:?}");
    }
    assert_eq!(chosen(T::DERIVED), Some("joint by joint"), "{}", T::DERIVED);
}

#[test]
fn an_attitude_by_angles() {
    balances::<ByAngles>();
}

#[test]
fn an_attitude_by_a_quaternion() {
    balances::<ByQuaternion>();
}

#[test]
fn an_attitude_by_another_quaternion_with_its_own_velocity() {
    balances::<ByQuaternionAndItsOwnVelocity>();
}

#[test]
fn an_attitude_by_a_quaternion_with_angular_velocities_of_space() {
    balances::<ByQuaternionAndAxesOfSpace>();
}

#[test]
fn an_attitude_by_a_matrix() {
    balances::<ByMatrix>();
}
