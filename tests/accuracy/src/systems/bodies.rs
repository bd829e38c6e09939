//! Systems of fixed size.

use crate::places::Numbers;
use std::f64::consts::FRAC_PI_2;

measured! {
    sleigh, "sleigh",
    Numbers { parameters: 5, inertias: &[0, 1], states: 5, velocities: 3, singular: &[(0, FRAC_PI_2)], inputs: 1 },
    /// The Chaplygin sleigh with a torque and rotary friction.
    struct Sleigh, SleighState, SleighInput of 1 { m: T, J: T, a: T, b: T, c: T }
    from |p| { m: p[0], J: p[1], a: p[2], b: p[3], c: p[4] },
    states 5 of 6,
    nh_models::sleigh!()
}

measured! {
    veselova, "veselova",
    Numbers { parameters: 6, inertias: &[0, 1, 2], states: 6, velocities: 3, singular: &[(2, 0.0)], inputs: 0 },
    /// Veselova's system in principal axes with a linear potential.
    struct Veselova, VeselovaState { I: [T; 3], c: [T; 3] }
    from |p| { I: [p[0], p[1], p[2]], c: [p[3], p[4], p[5]] },
    states 6 of 6,
    nh_models::veselova!()
}

measured! {
    snakeboard, "snakeboard",
    Numbers { parameters: 4, inertias: &[0, 2, 3], states: 8, velocities: 5, singular: &[(4, FRAC_PI_2)], inputs: 2 },
    /// The snakeboard with torques on its rotor and on its wheels.
    struct Snakeboard, SnakeboardState, SnakeboardInput of 2 { m: T, l: T, J0: T, J1: T }
    from |p| { m: p[0], l: p[1], J0: p[2], J1: p[3] },
    states 8 of 10,
    nh_models::snakeboard!()
}

measured! {
    robot, "robot",
    Numbers { parameters: 7, inertias: &[0, 1, 3, 4], states: 7, velocities: 5, singular: &[(4, FRAC_PI_2)], inputs: 0 },
    /// The two-wheeled robot on the plane.
    struct Robot, RobotState { m0: T, m1: T, l: T, J: T, J2: T, c: T, R: T }
    from |p| { m0: p[0], m1: p[1], l: p[2], J: p[3], J2: p[4], c: p[5], R: p[6] },
    states 7 of 10,
    nh_models::robot!()
}

measured! {
    ball, "ball on table",
    Numbers { parameters: 4, inertias: &[0, 2], states: 5, velocities: 2, singular: &[], inputs: 0 },
    /// A homogeneous ball that rolls on a rotating table.
    struct Ball, BallState { m: T, r: T, k2: T, Omega: T }
    from |p| { m: p[0], r: p[1], k2: p[2], Omega: p[3] },
    states 5 of 7,
    nh_models::ball!()
}

measured! {
    board_in_coordinates, "snakeboard in coordinates",
    Numbers { parameters: 5, inertias: &[0, 2, 3, 4], states: 10, velocities: 5, singular: &[(4, FRAC_PI_2)], inputs: 2 },
    /// The snakeboard in coordinates of the plane, with multipliers.
    struct Board, BoardState, BoardInput of 2 { m: T, l: T, J: T, J0: T, J1: T }
    from |p| { m: p[0], l: p[1], J: p[2], J0: p[3], J1: p[4] },
    states 10 of 10,
    {
        base { x, y, theta, psi, phi }
        lagrangian {
            m / 2 * (der(x)^2 + der(y)^2) + J / 2 * der(theta)^2 + J0 / 2 * (der(psi) + der(theta))^2
                + J1 / 2 * ((der(phi) + der(theta))^2 + (der(phi) - der(theta))^2)
        }
        constraints {
            wheel_back:  -sin(theta + phi) * der(x) + cos(theta + phi) * der(y) - l * cos(phi) * der(theta) = 0;
            wheel_front: -sin(theta - phi) * der(x) + cos(theta - phi) * der(y) + l * cos(phi) * der(theta) = 0;
        }
        forces { psi: rotor; phi: steering; }
        inputs { rotor, steering }
    }
}

measured! {
    sleigh_on_the_plane, "sleigh on the plane",
    Numbers { parameters: 4, inertias: &[0, 1], states: 6, velocities: 3, singular: &[(0, FRAC_PI_2)], inputs: 0 },
    /// The sleigh in coordinates of the plane, with a multiplier.
    struct Plane, PlaneState { m: T, J: T, a: T, b: T }
    from |p| { m: p[0], J: p[1], a: p[2], b: p[3] },
    states 6 of 6,
    {
        base { theta, x, y }
        lagrangian {
            let xc = der(x) - (a * sin(theta) + b * cos(theta)) * der(theta);
            let yc = der(y) + (a * cos(theta) - b * sin(theta)) * der(theta);
            J / 2 * der(theta)^2 + m / 2 * (xc^2 + yc^2)
        }
        constraints { blade: cos(theta) * der(y) - sin(theta) * der(x) = 0; }
    }
}

measured! {
    knife_edge, "knife edge on an incline",
    Numbers { parameters: 3, inertias: &[0, 1], states: 6, velocities: 3, singular: &[(2, FRAC_PI_2)], inputs: 0 },
    /// A knife edge on an inclined plane.
    struct Knife, KnifeState { m: T, J: T, g: T }
    from |p| { m: p[0], J: p[1], g: p[2] },
    states 6 of 6,
    {
        base { x, y, phi }
        lagrangian { m / 2 * (der(x)^2 + der(y)^2) + J / 2 * der(phi)^2 + m * g * x }
        constraints { sin(phi) * der(x) = cos(phi) * der(y); }
    }
}

measured! {
    vehicle, "two-axle vehicle",
    Numbers { parameters: 6, inertias: &[0, 1, 2], states: 8, velocities: 4, singular: &[(3, FRAC_PI_2)], inputs: 2 },
    /// A vehicle with a steered front axle, whose rear wheels drive, in body velocities.
    struct Vehicle, VehicleState, VehicleInput of 2 { m: T, J: T, Js: T, a: T, b: T, c: T }
    from |p| { m: p[0], J: p[1], Js: p[2], a: p[3], b: p[4], c: p[5] },
    states 8 of 8,
    {
        base  { x, y, th, delta }
        basis { u, w, r, ds }
        anchor {
            der(x) = u * cos(th) - w * sin(th);
            der(y) = u * sin(th) + w * cos(th);
            der(th) = r;
            der(delta) = ds;
        }
        lagrangian { m / 2 * (u^2 + (w + a * r)^2) + J / 2 * r^2 + Js / 2 * (r + ds)^2 }
        constraints {
            w = 0;
            cos(delta) * (w + b * r) = sin(delta) * u;
        }
        forces { u: push - c * u; delta: steer; }
        inputs { push, steer }
    }
}

measured! {
    two_links, "two arms and a wheel",
    Numbers { parameters: 6, inertias: &[0, 1, 2, 3], states: 8, velocities: 4, singular: &[(2, FRAC_PI_2)], inputs: 2 },
    /// A body with two arms in absolute angles, each with a wheel at its end.
    struct Arms, ArmsState, ArmsInput of 2 { m: T, J: T, m1: T, J1: T, d: T, l: T }
    from |p| { m: p[0], J: p[1], m1: p[2], J1: p[3], d: p[4], l: p[5] },
    states 8 of 8,
    {
        base { x, y, th, al }
        lagrangian {
            let x1 = der(x) - d * sin(th) * der(th) - l * sin(th + al) * (der(th) + der(al));
            let y1 = der(y) + d * cos(th) * der(th) + l * cos(th + al) * (der(th) + der(al));
            m / 2 * (der(x)^2 + der(y)^2) + J / 2 * der(th)^2
                + m1 / 2 * (x1^2 + y1^2) + J1 / 2 * (der(th) + der(al))^2
        }
        constraints { sin(th - al) * der(x) = cos(th - al) * der(y); }
        forces { th: push; al: bend; }
        inputs { push, bend }
    }
}
