//! A delta robot, three loops in space: three arms with rods to a platform that does not turn. And a disk on a rope over a
//! pulley, whose equations are solved by hand.

use nonholonomic::prelude::*;

#[nonholonomic(
    base { arm[3], p[3] }
    let elbow[k in 0..3] = rot_z(2 * pi * k / 3) * [r + L * cos(arm[k]), 0, -L * sin(arm[k])];
    holonomic { for k in 0..3 { rod: dot(p - elbow[k], p - elbow[k]) = l^2; } }
    lagrangian {
        kinetic(M, p) - M * g * p[2] + sum(k in 0..3: J / 2 * der(arm[k])^2 + ma * g * L / 2 * sin(arm[k]))
    }
    inputs { torque[3] }
    forces { for k in 0..3 { arm[k]: torque[k]; } }
)]
#[derive(Clone, Copy, Debug)]
struct Delta {
    r: f64,
    L: f64,
    l: f64,
    J: f64,
    ma: f64,
    M: f64,
    g: f64,
}

#[test]
fn accelerations_of_the_platform() {
    let delta = Delta { r: 0.1, L: 0.25, l: 0.6, J: 0.01, ma: 0.4, M: 0.9, g: 9.81 };
    let state = DeltaState {
        arm: [0.3, 0.5, 0.1],
        p: [0.001_747_995_863_051_712_1, -0.097_067_478_447_766_08, -0.560_656_024_782_399],
        arm_dot: [0.8, -0.5, 0.3],
        p_dot: [-0.258_533_773_840_794_8, 0.189_637_797_484_431_96, -0.090_780_233_755_085_36],
    };
    let found = delta.derivative(0.0, &state, &DeltaInput { torque: [0.6, -0.3, 0.2] }).to_array();
    // reference/loops.py
    let expected = [
        46.303_867_275_432_174,
        35.040_125_268_339_77,
        46.707_387_503_961_93,
        -1.569_331_062_348_255,
        0.526_141_089_810_053_8,
        -12.328_391_059_035_788,
    ];
    for (found, expected) in found[6..].iter().zip(expected) {
        assert!((found - expected).abs() < 1e-12 * 46.0, "{found} {expected}");
    }
}

/// A weight and a disk on the two ends of a rope over a pulley; the rope unwinds from the disk as well.
#[nonholonomic(
    base { weight, pulley, disk, unwound }
    holonomic {
        left: weight = R * pulley;
        right: disk = -R * pulley - r * unwound;
    }
    lagrangian {
        m[0] / 2 * der(weight)^2 + m[1] / 2 * der(disk)^2 + I[0] / 2 * der(pulley)^2 + I[1] / 2 * der(unwound)^2
            - g * (m[0] * weight + m[1] * disk)
    }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct OnARope {
    m: [f64; 2],
    I: [f64; 2],
    R: f64,
    r: f64,
    g: f64,
}

#[test]
fn a_disk_on_a_rope_over_a_pulley() {
    let machine = OnARope { m: [1.2, 3.0], I: [0.05, 0.08], R: 0.2, r: 0.15, g: 9.81 };
    let OnARope { m: [m1, m2], I: [i1, i2], R, r, g } = machine;
    let found = machine.derivative(0.0, &OnARopeState::default(), &());
    // tensions T₁, T₂: m₁ R α = T₁ − m₁ g, I₁ α = (T₂ − T₁) R, m₂ (−R α − r ψ) = T₂ − m₂ g, I₂ ψ = r T₂
    let kappa = 1.0 + m2 * r * r / i2;
    let alpha = R * g * (m2 / kappa - m1) / (i1 + m1 * R * R + m2 * R * R / kappa);
    let tension = (m2 * g - m2 * R * alpha) / kappa;
    assert!((found.pulley_dot - alpha).abs() < 1e-13, "{} {alpha}", found.pulley_dot);
    assert!((found.unwound_dot - r * tension / i2).abs() < 1e-12, "{}", found.unwound_dot);
    assert!((found.weight_dot - R * alpha).abs() < 1e-13);
    // the rope pulls both ends up
    let pull = machine.multipliers(0.0, &OnARopeState::default(), &());
    assert!((pull.left - (m1 * g + m1 * R * alpha)).abs() < 1e-12, "{pull:?}");
    assert!((pull.right - tension).abs() < 1e-12, "{pull:?}");
}
