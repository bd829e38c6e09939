//! Forces that methods of the struct compute, and facts about parameters.

use nh_tests::random::Random;
use nonholonomic::prelude::*;

/// A sleigh that lands on its runner: a motor with a torque curve given at a few speeds turns it, and
/// the ground pushes when it is pressed in.
#[nonholonomic(
    base   { theta, x, y, z }
    basis  { omega, v1, v2, w }
    anchor {
        der(theta) = omega;
        der(x) = v1 * cos(theta) - v2 * sin(theta);
        der(y) = v1 * sin(theta) + v2 * cos(theta);
        der(z) = w;
    }
    lagrangian  { (J + m * a^2) / 2 * omega^2 + m / 2 * (v1^2 + v2^2 + w^2) + m * a * omega * v2 - m * g * z }
    constraints { blade: v2 = 0; }
    forces {
        omega: self.motor(omega, throttle);
        v1: -self.friction(v1, self.contact(z, w));
        z: self.contact(z, w);
    }
    inputs { throttle }
    assume { m > 0; J > 0; g >= 0; }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
#[allow(non_snake_case, reason = "as in mechanics")]
struct ByMethods {
    m: f64,
    J: f64,
    a: f64,
    g: f64,
    stiffness: f64,
    damping: f64,
    #[nh(skip)]
    torques: [f64; 4],
}

impl ByMethods {
    /// Piecewise linear between the speeds −2, 0, 2, 4, constant beyond.
    fn motor(&self, speed: f64, throttle: f64) -> f64 {
        let place = (speed / 2.0 + 1.0).clamp(0.0, 3.0);
        let below = if place < 1.0 {
            0
        } else if place < 2.0 {
            1
        } else {
            2
        };
        let fraction = place - f64::from(u8::try_from(below).unwrap_or(0));
        throttle * (self.torques[below] * (1.0 - fraction) + self.torques[below + 1] * fraction)
    }

    fn contact(&self, height: f64, rate: f64) -> f64 {
        (-self.stiffness * height - self.damping * rate).max(0.0)
    }

    fn friction(&self, speed: f64, normal: f64) -> f64 {
        0.3 * normal * self.m.recip() * speed
    }
}

/// The same with the contact as a formula and the motor's torque as an input.
#[nonholonomic(
    base   { theta, x, y, z }
    basis  { omega, v1, v2, w }
    anchor {
        der(theta) = omega;
        der(x) = v1 * cos(theta) - v2 * sin(theta);
        der(y) = v1 * sin(theta) + v2 * cos(theta);
        der(z) = w;
    }
    lagrangian  { (J + m * a^2) / 2 * omega^2 + m / 2 * (v1^2 + v2^2 + w^2) + m * a * omega * v2 - m * g * z }
    constraints { blade: v2 = 0; }
    forces {
        let contact = max(-stiffness * z - damping * w, 0);
        omega: torque;
        v1: -0.3 * contact / m * v1;
        z: contact;
    }
    inputs { torque }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
#[allow(non_snake_case, reason = "as in mechanics")]
struct ByFormulas {
    m: f64,
    J: f64,
    a: f64,
    g: f64,
    stiffness: f64,
    damping: f64,
}

const BY_METHODS: ByMethods = ByMethods {
    m: 1.3,
    J: 0.4,
    a: 0.2,
    g: 9.8,
    stiffness: 800.0,
    damping: 6.0,
    torques: [2.0, 1.5, 0.9, 0.0],
};
const BY_FORMULAS: ByFormulas = ByFormulas { m: 1.3, J: 0.4, a: 0.2, g: 9.8, stiffness: 800.0, damping: 6.0 };

#[test]
fn a_method_is_the_force_that_it_computes() {
    let mut random = Random::new(7);
    let mut touched = 0;
    for _ in 0..200 {
        let numbers: [f64; 7] = std::array::from_fn(|_| random.between(-1.0, 1.0));
        let mut state = ByMethodsState::from(numbers);
        state.omega *= 6.0;
        let throttle = random.between(-1.0, 1.0);
        let formula = ByFormulasState::from(<[f64; 7]>::from(state));
        let torque = BY_METHODS.motor(state.omega, throttle);
        let (input, known) = (ByMethodsInput { throttle }, ByFormulasInput { torque });
        let rate = <[f64; 7]>::from(BY_METHODS.derivative(0.0, &state, &input));
        let expected = <[f64; 7]>::from(BY_FORMULAS.derivative(0.0, &formula, &known));
        let largest = expected.iter().fold(1.0_f64, |m, x| m.max(x.abs()));
        for (rate, expected) in rate.iter().zip(expected) {
            assert!((rate - expected).abs() < 1e-14 * largest, "{rate} {expected}");
        }
        let blade = BY_METHODS.multipliers(0.0, &state, &input).blade;
        let expected = BY_FORMULAS.multipliers(0.0, &formula, &known).blade;
        assert!((blade - expected).abs() < 1e-13 * largest, "{blade} {expected}");
        touched += usize::from(BY_METHODS.contact(state.z, state.w) > 0.0);
    }
    assert!((50..150).contains(&touched), "{touched}");
}

#[test]
fn a_motor_turns_up_to_its_free_speed() {
    let start = ByMethodsState { z: 0.5, v1: 1.0, ..ByMethodsState::default() };
    let mut sim = Integrator::new(BY_METHODS, Dopri5::new().rtol(1e-7), 0.0, start);
    sim.set_input(ByMethodsInput { throttle: 1.0 });
    sim.advance_to(10.0).unwrap();
    let state = *sim.state();
    let rest = -BY_METHODS.m * BY_METHODS.g / BY_METHODS.stiffness;
    // the body lies on the ground, and friction has slowed it down
    assert!((state.z - rest).abs() < 1e-3 && state.v1.abs() < 1.0, "{state:?}");
    assert!(state.omega > 1.0 && state.omega < 4.0, "{state:?}");
}

#[test]
fn what_is_assumed_is_validated() {
    BY_METHODS.validate().unwrap();
    let refusal = |system: ByMethods| system.validate().unwrap_err().to_string();
    assert_eq!(
        refusal(ByMethods { m: -1.0, ..BY_METHODS }),
        "the parameter `m` is -1.0, but the declaration assumes `m > 0`: give a value that satisfies it, \
         or change the assumption"
    );
    assert_eq!(
        refusal(ByMethods { J: 0.0, ..BY_METHODS }),
        "the parameter `J` is 0.0, but the declaration assumes `J > 0`: give a value that satisfies it, \
         or change the assumption"
    );
    assert_eq!(
        refusal(ByMethods { g: -9.8, ..BY_METHODS }),
        "the parameter `g` is -9.8, but the declaration assumes `g >= 0`: give a value that satisfies it, \
         or change the assumption"
    );
    ByMethods { g: 0.0, ..BY_METHODS }.validate().unwrap();
    let mut sim =
        Integrator::new(ByMethods { m: -1.0, ..BY_METHODS }, Rk4::new(0.1), 0.0, ByMethodsState::default());
    assert!(matches!(sim.step(), Err(IntegrationError::Parameter(_))));
}

/// A cart whose wheel is geared to its motion: eliminating the cart's speed divides by the ratio.
macro_rules! cart {
    ($system:ident $($assume:tt)*) => {
        #[nonholonomic(
            base { x, phi }
            lagrangian { m / 2 * der(x)^2 + J / 2 * der(phi)^2 }
            constraints { l * der(x) - r * der(phi) = 0; }
            independent { phi_dot }
            $($assume)*
        )]
        #[derive(Clone, Copy, Debug)]
        #[allow(non_snake_case, reason = "as in mechanics")]
        struct $system {
            m: f64,
            J: f64,
            l: f64,
            r: f64,
        }
    };
}

cart!(Checked);
cart!(Assumed assume { l > 0; });

#[test]
fn an_assumption_takes_the_place_of_a_check() {
    let checked = Checked { m: 1.0, J: 1.0, l: 0.0, r: 1.0 };
    assert_eq!(
        checked.validate().unwrap_err().to_string(),
        "the parameter `l` is 0.0, but the equations divide by `l`, which it makes zero: give another \
         value, or choose other velocities with `independent { … }`"
    );
    // a negative ratio is as good as a positive one, unless it is excluded
    Checked { l: -1.0, ..checked }.validate().unwrap();
    let assumed = Assumed { m: 1.0, J: 1.0, l: -1.0, r: 1.0 };
    for l in [-1.0, 0.0] {
        assert_eq!(
            Assumed { l, ..assumed }.validate().unwrap_err().to_string(),
            format!(
                "the parameter `l` is {l:?}, but the declaration assumes `l > 0`: give a value that \
                 satisfies it, or change the assumption"
            )
        );
    }
    assert!(Checked::REPORT.contains("Conditions on the parameters\n  l != 0\n"), "{}", Checked::REPORT);
    assert!(!Assumed::REPORT.contains("l != 0"), "{}", Assumed::REPORT);
}

/// A knife edge whose slope is divided by a cosine, in a potential with a root, a logarithm and a pole.
#[nonholonomic(
    base        { x, y, theta }
    lagrangian  {
        m / 2 * (der(x)^2 + der(y)^2) + J / 2 * der(theta)^2
            - ln(1 + x^2) - ln(x) - sqrt(y) - 1 / (2 + cos(x)) - m / (J * y)
    }
    constraints { der(y) = tan(theta) * der(x); }
    forces      { theta: acos(x) - asin(sin(x)) }
)]
#[derive(Clone, Copy, Debug)]
#[allow(dead_code, non_snake_case, reason = "only its report is read")]
struct Somewhere {
    m: f64,
    J: f64,
}

#[test]
fn a_report_says_where_the_declaration_has_a_value() {
    let mut conditions: Vec<&str> = Somewhere::REPORT
        .lines()
        .filter_map(|line| line.trim().strip_prefix("the equations have a value only where "))
        .collect();
    conditions.sort_unstable();
    assert_eq!(conditions, ["cos(theta) != 0", "x > 0", "y > 0", "|x| <= 1"]);
}
