//! The machines whose returns are counted.

use nonholonomic::prelude::*;

use super::count;

/// A four-bar linkage in three angles.
#[nonholonomic(
    base { crank, coupler, rocker }
    let along(angle) = [cos(angle), sin(angle)];
    holonomic { closure: l[0] * along(crank) + l[1] * along(coupler) = l[2] * along(rocker) + [d, 0]; }
    lagrangian {
        J[0] / 2 * der(crank)^2 + kinetic(m, J[1], l[0] * along(crank) + l[1] / 2 * along(coupler), coupler)
            + J[2] / 2 * der(rocker)^2
    }
)]
#[derive(Clone, Copy, Debug)]
struct FourBar {
    l: [f64; 3],
    d: f64,
    m: f64,
    J: [f64; 3],
}

/// A crank whose rod pushes a slide.
#[nonholonomic(
    base { crank, rod, slide }
    holonomic {
        along: slide = r * cos(crank) + l * cos(rod);
        across: r * sin(crank) = l * sin(rod);
    }
    lagrangian {
        J / 2 * der(crank)^2 + m / 2 * der(slide)^2
            + kinetic(M, M * l^2 / 12, [r * cos(crank) + l / 2 * cos(rod), l / 2 * sin(rod)], rod)
    }
)]
#[derive(Clone, Copy, Debug)]
struct SliderCrank {
    r: f64,
    l: f64,
    J: f64,
    m: f64,
    M: f64,
}

/// Two cranks whose couplers meet, under gravity.
#[nonholonomic(
    base { a, b, c, d }
    let along(angle) = [cos(angle), sin(angle)];
    holonomic { closure: l1 * along(a) + l2 * along(b) = l3 * along(c) + l4 * along(d) + [base, 0]; }
    lagrangian {
        J1 / 2 * der(a)^2 + J2 / 2 * der(b)^2 + J3 / 2 * der(c)^2 + J4 / 2 * der(d)^2
        + m / 2 * (l1^2 * der(a)^2 + l2^2 * der(b)^2 + 2 * l1 * l2 * cos(a - b) * der(a) * der(b))
        - m * g * (l1 * sin(a) + l2 * sin(b))
    }
)]
#[derive(Clone, Copy, Debug)]
struct FiveBar {
    l1: f64,
    l2: f64,
    l3: f64,
    l4: f64,
    base: f64,
    J1: f64,
    J2: f64,
    J3: f64,
    J4: f64,
    m: f64,
    g: f64,
}

/// A mass on a rope.
#[nonholonomic(
    base { x, y }
    holonomic { rope: x^2 + y^2 = l^2; }
    lagrangian { (der(x)^2 + der(y)^2) / 2 - g * y }
)]
#[derive(Clone, Copy, Debug)]
struct Swing {
    l: f64,
    g: f64,
}

nh_models::bicycle! {
    #[derive(Clone, Copy, Debug)]
    struct Bicycle<T>;
}

/// Their names, in the order of the table.
pub(crate) const MACHINES: [&str; 5] =
    ["four-bar linkage", "slider crank", "five-bar linkage", "pendulum in x and y", "bicycle"];

/// Counts the returns of all of them.
pub(crate) fn on_each() {
    let linkage = FourBar { l: [1.0, 3.0, 2.5], d: 3.0, m: 1.0, J: [0.1, 0.3, 0.4] };
    let rough = FourBarState { crank: 0.2, coupler: 0.9, rocker: 1.6, crank_dot: 20.0, ..Default::default() };
    let start = linkage.assemble_holding(0.0, &rough, &[FourBarCoordinate::crank]);
    count(linkage, start.expect("a crank of that length turns"));
    let machine = SliderCrank { r: 0.3, l: 0.8, J: 0.05, m: 0.4, M: 0.2 };
    let rough = SliderCrankState { crank: 0.3, crank_dot: 30.0, slide: 1.0, ..Default::default() };
    let turning = machine.assemble_holding(0.0, &rough, &[SliderCrankCoordinate::crank]);
    count(machine, turning.expect("a crank turns"));
    let robot = FiveBar {
        l1: 1.0,
        l2: 2.0,
        l3: 2.2,
        l4: 1.1,
        base: 1.5,
        J1: 0.3,
        J2: 0.4,
        J3: 0.5,
        J4: 0.25,
        m: 0.7,
        g: 9.81,
    };
    let rough = FiveBarState { a: 2.0, b: 0.8, c: 2.0, d: 1.0, a_dot: 1.0, d_dot: 0.5, ..Default::default() };
    let held = [FiveBarCoordinate::a, FiveBarCoordinate::d];
    count(robot, robot.assemble_holding(0.0, &rough, &held).expect("its couplers meet"));
    let (sin, cos) = 1.0_f64.sin_cos();
    let rest = SwingState { x: 250.0 * sin, y: -250.0 * cos, ..Default::default() };
    count(Swing { l: 250.0, g: 9.81 }, rest);
    let bicycle: Bicycle<f64> = nh_models::published_bicycle!(Bicycle, 9.81, f64::from);
    let mut pushed = BicycleState { rear_dot: -4.6 / 0.3, lean_dot: 0.3, ..Default::default() };
    bicycle.project(0.0, &mut pushed).expect("it stands on its wheels");
    count(bicycle, pushed);
}
