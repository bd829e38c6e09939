//! Andrews' squeezer of the test set for initial value problems (Mazzia, Magherini, release 2.4; Hairer, Wanner, Solving
//! Ordinary Differential Equations II, VII.7): seven bodies in three loops, driven by a torque against a spring. It is
//! published as an equation of index 3, in angles, with the matrices of the equations of motion; here it is declared by where its
//! bodies are.

use nonholonomic::prelude::*;

#[nonholonomic(
    base { beta, theta, gamma, phi, delta, omega, epsilon }

    let along(angle) = [cos(angle), sin(angle)];
    let across(angle) = [sin(angle), -cos(angle)];
    let crank = beta + theta;
    let hub = rr * along(beta) - d * along(crank);
    let lever = [xb, yb] + ss * across(gamma);
    let knee = [xa, ya] + zt * along(delta);
    let elbow = [xa, ya] + u * across(epsilon);

    holonomic {
        first: hub - lever = 0;
        second: hub - (knee + e * across(phi + delta)) = 0;
        third: hub - (elbow + zf * along(omega + epsilon)) = 0;
    }
    let hook = [xb, yb] + sd * along(gamma) + sc * across(gamma);
    lagrangian {
        kinetic(m[0], I[0], ra * along(beta), beta)
        + kinetic(m[1], I[1], rr * along(beta) - da * along(crank), crank)
        + kinetic(m[2], I[2], [xb, yb] + sb * along(gamma) + sa * across(gamma), gamma)
        + kinetic(m[3], I[3], knee + (e - ea) * across(phi + delta), phi + delta)
        + kinetic(m[4], I[4], [xa, ya] + ta * along(delta) + tb * across(delta), delta)
        + kinetic(m[5], I[5], elbow + (zf - fa) * along(omega + epsilon), omega + epsilon)
        + kinetic(m[6], I[6], [xa, ya] + ub * along(epsilon) + ua * across(epsilon), epsilon)
        - c0 / 2 * (norm(hook - [xc, yc]) - l0)^2
    }
    forces { beta: mom; }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct Squeezer {
    m: [f64; 7],
    I: [f64; 7],
    xa: f64,
    ya: f64,
    xb: f64,
    yb: f64,
    xc: f64,
    yc: f64,
    c0: f64,
    d: f64,
    da: f64,
    e: f64,
    ea: f64,
    rr: f64,
    ra: f64,
    l0: f64,
    ss: f64,
    sa: f64,
    sb: f64,
    sc: f64,
    sd: f64,
    ta: f64,
    tb: f64,
    u: f64,
    ua: f64,
    ub: f64,
    zf: f64,
    zt: f64,
    fa: f64,
    mom: f64,
}

const SQUEEZER: Squeezer = Squeezer {
    m: [0.04325, 0.00365, 0.02373, 0.00706, 0.0705, 0.00706, 0.05498],
    I: [2.194e-6, 4.41e-7, 5.255e-6, 5.667e-7, 1.169e-5, 5.667e-7, 1.912e-5],
    xa: -0.06934,
    ya: -0.00227,
    xb: -0.03635,
    yb: 0.03273,
    xc: 0.014,
    yc: 0.072,
    c0: 4530.0,
    d: 0.028,
    da: 0.0115,
    e: 0.02,
    ea: 0.01421,
    rr: 0.007,
    ra: 0.00092,
    l0: 0.07785,
    ss: 0.035,
    sa: 0.01874,
    sb: 0.01043,
    sc: 0.018,
    sd: 0.02,
    ta: 0.02308,
    tb: 0.00916,
    u: 0.04,
    ua: 0.01228,
    ub: 0.00449,
    zf: 0.02,
    zt: 0.04,
    fa: 0.01421,
    mom: 0.033,
};

/// The published start, at rest.
const START: SqueezerState = SqueezerState {
    beta: -0.061_713_890_014_276_45,
    theta: 0.0,
    gamma: 0.455_279_819_163_070_4,
    phi: 0.222_668_390_165_885_88,
    delta: 0.487_364_979_543_842_55,
    omega: -0.222_668_390_165_885_88,
    epsilon: 1.230_547_444_549_821_2,
    beta_dot: 0.0,
    theta_dot: 0.0,
    gamma_dot: 0.0,
    phi_dot: 0.0,
    delta_dot: 0.0,
    omega_dot: 0.0,
    epsilon_dot: 0.0,
};

/// The published angles and rates at t = 0.03, and the accelerations.
const ANGLES: [f64; 7] = [
    15.810_771_196_299_04,
    -15.756_371_059_842_98,
    0.040_822_240_130_731_01,
    -0.534_730_116_322_694_8,
    0.524_409_965_880_530_4,
    0.534_730_116_322_694_8,
    1.048_080_741_042_263,
];
const RATES: [f64; 7] = [
    1_139.920_302_151_208,
    -1_424.379_294_994_111,
    11.032_912_219_371_34,
    19.293_374_644_213_85,
    0.573_569_928_479_080_8,
    -19.293_374_644_213_85,
    0.323_179_165_802_695_5,
];
const ACCELERATIONS: [f64; 7] = [
    -24_631.763_169_451_96,
    51_850.377_016_103_29,
    324_102.568_641_378_1,
    566_749.364_517_621_3,
    16_743.629_294_793_61,
    -566_749.364_517_622_2,
    9_826.520_791_458_422,
];
/// The published multipliers, which enter with a minus there.
const MULTIPLIERS: [f64; 6] = [
    199.175_333_373_191,
    -29.755_312_280_150_52,
    23.066_541_190_983_99,
    31.452_713_654_759_27,
    22.642_492_320_827_39,
    11.617_407_000_196_73,
];

#[test]
fn the_start_is_the_published_one() {
    let left: [f64; 12] = SQUEEZER.constraint_residual(0.0, &START).into();
    assert!(left.iter().all(|left| left.abs() < 1e-16), "{left:?}");
}

#[test]
fn the_end_is_the_published_one() {
    let mut sim = Integrator::new(SQUEEZER, Dop853::new().rtol(1e-11).atol(1e-11), 0.0, START);
    sim.advance_to(0.03).unwrap();
    let state = *sim.state();
    let found = state.to_array();
    for (found, published) in found.iter().zip(ANGLES) {
        assert!((found - published).abs() < 1e-8, "{found} {published}");
    }
    for (found, published) in found[7..].iter().zip(RATES) {
        assert!((found - published).abs() < 1e-5, "{found} {published}");
    }
}

/// What the published angles and rates have for accelerations, by `tests/reference/squeezer.py`. The published ones, of
/// an equation of index 3, are 1e-7 of their largest away, since the published rates leave 1e-9 in the loops.
#[test]
fn accelerations_and_multipliers_at_the_published_end() {
    let mut end = [0.0; 14];
    end[..7].copy_from_slice(&ANGLES);
    end[7..].copy_from_slice(&RATES);
    let end = SqueezerState::from(end);
    let exact = [
        -24_631.764_251_062,
        51_850.321_376_498,
        324_102.600_586_73,
        566_749.421_788_61,
        16_743.635_403_113,
        -566_749.421_788_63,
        9_826.507_826_265,
    ];
    let rates = SQUEEZER.derivative(0.03, &end, &()).to_array();
    for ((found, exact), published) in rates[7..].iter().zip(exact).zip(ACCELERATIONS) {
        assert!((found - exact).abs() < 1e-12 * ACCELERATIONS[3], "{found} {exact}");
        assert!((found - published).abs() < 2e-7 * ACCELERATIONS[3], "{found} {published}");
    }
    let lambda = SQUEEZER.multipliers(0.03, &end, &());
    let found = [lambda.first, lambda.second, lambda.third];
    for (found, published) in found.as_flattened().iter().zip(MULTIPLIERS) {
        assert!((found + published).abs() < 2e-7 * MULTIPLIERS[0], "{found} {published}");
    }
}
