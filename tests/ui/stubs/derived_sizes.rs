use nonholonomic::prelude::*;

/// A roller racer, in which a name is misspelt.
#[nonholonomic(
    base { theta, x, y, phi }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) + I1 / 2 * der(theta)^2 + I2 / 2 * (der(theta) + der(phi))^2 }
    constraints {
        cos(theta) * der(y) = sin(theta) * der(x);
        cos(theta + phi) * der(y) - sin(theta + phi) * der(x)
            = (d1 * cos(phi) + d2) * der(theta) + d2 * der(phi);
    }
    forces { phi: torqe; }
    inputs { torque }
    assume { d2 > 0; }
    symmetries { turn: der(theta) + x * der(y) - y * der(x); }
    emit { splitting, momenta }
)]
#[derive(Clone, Copy)]
struct Racer { m: f64, I1: f64, I2: f64, d1: f64, d2: f64 }

/// A Chaplygin system that is claimed to keep what it does not.
#[nonholonomic(
    base { x, y, z }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) - m * x^2 }
    constraints { der(z) = y * der(x); }
    conserved { height = z; }
    emit { gyroscopic }
)]
#[derive(Clone, Copy)]
struct Particle { m: f64 }

/// A level whose energy has a wrong unit.
#[nonholonomic(
    base { r, s }
    lagrangian { m / 2 * (der(r)^2 + r^2 * der(s)^2) - k * r }
    routh { s = mu; }
    units { r = m; s = 1; t = s; m = kg; k = N m; }
)]
#[derive(Clone, Copy)]
struct Level { m: f64, k: f64, mu: f64 }

/// What is tracked depends on less than all.
#[nonholonomic(
    base { x, y, z }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) - k * y^2 }
    outputs { far = [x, y]; }
    conserved { height = y; }
    emit { output_jacobian }
    track { x, der(y) }
)]
#[derive(Clone, Copy)]
struct Part { m: f64, k: f64 }

fn main() {
    let racer = Racer { m: 1.0, I1: 1.0, I2: 1.0, d1: 1.0, d2: 1.0 };
    let state = RacerState { theta: 0.0, x: 0.0, y: 0.0, phi: 0.5, ..RacerState::default() };
    let _: [[f64; 4]; 1] = racer.horizontal_lifts(0.0, &state);
    let _: [f64; 1] = racer.vertical_momenta(0.0, &state);
    let _ = racer.momenta(0.0, &state).turn;
    let particle = Particle { m: 1.0 };
    let state = ParticleState { x: 0.0, y: 0.0, z: 0.0, x_dot: 1.0, y_dot: 1.0 };
    let ParticleGyroscopic { x, y } = particle.gyroscopic(0.0, &state);
    let _ = x + y;
    let level = Level { m: 1.0, k: 1.0, mu: 1.0 };
    let LevelQuadratures { s } = level.quadratures(0.0, &LevelState { r: 1.0, r_dot: 0.0 });
    let _: f64 = s;
    let part = Part { m: 1.0, k: 1.0 };
    let state = PartState { x: 0.0, y: 0.0, x_dot: 0.0, y_dot: 0.0 };
    let PartOutputs { far } = part.outputs(0.0, &state, &());
    let _ = (far, part.output_jacobian(0.0, &state, &()).0[(1, 3)]);
}
