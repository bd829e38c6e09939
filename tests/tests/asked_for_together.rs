//! Everything that `emit` can be asked for, asked for together, on short systems with each section of the language, over
//! any scalar where they have parameters: what is generated compiles. `nh-stages`, `tests/requests.rs`, sees to it
//! that no word and no section is missing here.
#![allow(dead_code, non_snake_case, reason = "compiled, not called; J and I are letters of mechanics")]

use nonholonomic::prelude::*;

#[nonholonomic(
    basis { u, v }
    brackets { }
    lagrangian { m / 2 * (u ^ 2 + v ^ 2) }
    emit {
        jacobian, taylor, sparse_jacobian, jacobian_product, adjoint_product, parameter_jacobian, power, prepared,
        angle_cache, splitting, gibbs_appell, hamiltonian, discrete_gradient, divergence, volume, connection,
        euler_poincare_suslov
    }
)]
#[derive(Clone, Copy)]
struct Abelian<T> {
    m: T,
}

#[nonholonomic(
    base { a, x, y }
    lagrangian { J / 2 * der(a) ^ 2 + m / 2 * (der(x) ^ 2 + der(y) ^ 2) - m * g * x }
    constraints { blade: sin(a) * der(x) = cos(a) * der(y); }
    emit {
        jacobian, taylor, sparse_jacobian, jacobian_product, adjoint_product, parameter_jacobian, power, prepared,
        angle_cache, multipliers, reactions, gyroscopic, gibbs_appell, discrete_gradient, symmetric_projection
    }
)]
#[derive(Clone, Copy)]
struct Skate<T> {
    J: T,
    m: T,
    g: T,
}

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x) ^ 2 }
    outputs { x = 2 * x; y = x + 1; }
    emit {
        jacobian, taylor, sparse_jacobian, jacobian_product, adjoint_product, parameter_jacobian, output_jacobian,
        power, prepared, angle_cache, momenta, splitting, gibbs_appell, hamiltonian, bracket, discrete_gradient,
        divergence, volume, connection, rattle
    }
)]
#[derive(Clone, Copy)]
struct Mass<T> {
    m: T,
}

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x) ^ 2 + der(y) ^ 2) }
    track { der(x) }
    emit {
        jacobian, taylor, sparse_jacobian, jacobian_product, adjoint_product, parameter_jacobian, prepared,
        gibbs_appell
    }
)]
#[derive(Clone, Copy)]
struct Tracked<T> {
    m: T,
}

#[nonholonomic(
    basis { w[3] }
    brackets so(3) { w[0], w[1], w[2] }
    lagrangian { dot(w, I * w) / 2 }
    emit {
        jacobian, taylor, sparse_jacobian, jacobian_product, adjoint_product, parameter_jacobian, power, prepared,
        angle_cache, splitting, gibbs_appell, hamiltonian, discrete_gradient, divergence, volume, connection,
        euler_poincare_suslov
    }
)]
#[derive(Clone, Copy)]
struct FreeRigidBody<T> {
    I: [[T; 3]; 3],
}

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x) ^ 2 + der(y) ^ 2) }
    constraints { der(y) = a; }
    emit {
        jacobian, taylor, sparse_jacobian, jacobian_product, adjoint_product, parameter_jacobian, power, prepared,
        angle_cache, multipliers, reactions, momenta, gibbs_appell, hamiltonian, divergence, volume
    }
)]
#[derive(Clone, Copy)]
struct Towed<T> {
    m: T,
    a: T,
}

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x) ^ 2 }
    forces { x: push - self.drag(der(x)); }
    inputs { push }
    derivative { drag: [self.slope]; }
    linearization { keep: x, der(x); }
    emit {
        jacobian, sparse_jacobian, jacobian_product, adjoint_product, power, prepared, angle_cache, momenta, splitting,
        gibbs_appell, hamiltonian, divergence, connection
    }
)]
#[derive(Clone, Copy)]
struct Pushed<T> {
    m: T,
    c: T,
}

impl<T: Scalar> Pushed<T> {
    fn drag(&self, speed: T) -> T {
        self.c * speed * speed.abs()
    }
    fn slope(&self, speed: T) -> T {
        (self.c + self.c) * speed.abs()
    }
}

#[nonholonomic(
    base { x, y }
    holonomic { rod: x ^ 2 + y ^ 2 = 1; }
    lagrangian { m / 2 * (der(x) ^ 2 + der(y) ^ 2) }
    emit {
        jacobian, taylor, sparse_jacobian, jacobian_product, adjoint_product, return_jacobian, parameter_jacobian,
        power, prepared, angle_cache, multipliers, reactions, gibbs_appell, discrete_gradient, symmetric_projection,
        divergence, volume, connection, rattle
    }
)]
#[derive(Clone, Copy)]
struct Plane<T> {
    m: T,
}

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * der(x) ^ 2 + c / 2 * der(y) ^ 2 - k / 2 * x ^ 2 }
    routh { y = mu; }
    emit {
        jacobian, taylor, sparse_jacobian, jacobian_product, adjoint_product, parameter_jacobian, power, prepared,
        angle_cache, momenta, gibbs_appell
    }
)]
#[derive(Clone, Copy)]
struct ByParameter<T> {
    m: T,
    c: T,
    k: T,
    mu: T,
}

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x) ^ 2 }
    auxiliary { der(lag) = der(x) - c * lag; }
    forces { x: lag; }
    emit {
        jacobian, taylor, sparse_jacobian, jacobian_product, adjoint_product, parameter_jacobian, power, prepared,
        angle_cache, momenta, splitting, gibbs_appell, divergence, connection
    }
)]
#[derive(Clone, Copy)]
struct Lagging<T> {
    m: T,
    c: T,
}

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x) ^ 2 + der(y) ^ 2) - m * g * y }
    impacts { floor: y >= 0 with restitution e; }
    emit {
        jacobian, taylor, sparse_jacobian, jacobian_product, adjoint_product, parameter_jacobian, power, prepared,
        angle_cache, momenta, splitting, gibbs_appell, hamiltonian, discrete_gradient, divergence, volume, connection,
        rattle
    }
)]
#[derive(Clone, Copy)]
struct Ball<T> {
    m: T,
    g: T,
    e: T,
}

#[nonholonomic(
    base { c, s }
    on { c ^ 2 + s ^ 2 = 1; }
    basis { w }
    anchor { der(c) = - s * w; der(s) = c * w; }
    lagrangian { m / 2 * w ^ 2 }
    emit {
        jacobian, taylor, sparse_jacobian, jacobian_product, adjoint_product, parameter_jacobian, power, prepared,
        angle_cache, gibbs_appell, hamiltonian, discrete_gradient, divergence, volume, connection
    }
)]
#[derive(Clone, Copy)]
struct OnACircle<T> {
    m: T,
}

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x) ^ 2 + der(y) ^ 2) - k * (x ^ 2 + y ^ 2) }
    symmetries { spin: x * der(y) - y * der(x); }
    emit {
        jacobian, taylor, sparse_jacobian, jacobian_product, adjoint_product, parameter_jacobian, power, prepared,
        angle_cache, momenta, gibbs_appell, hamiltonian, discrete_gradient, divergence, volume, connection, rattle
    }
)]
#[derive(Clone, Copy)]
struct Central<T> {
    m: T,
    k: T,
}

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x) ^ 2 + der(y) ^ 2) - m * g * y }
    assume { m > 0; }
    units { x, y = m; m = kg; g = m / s ^ 2; }
    emit {
        jacobian, taylor, sparse_jacobian, jacobian_product, adjoint_product, parameter_jacobian, power, prepared,
        angle_cache, momenta, splitting, gibbs_appell, hamiltonian, discrete_gradient, divergence, volume, connection,
        rattle
    }
)]
#[derive(Clone, Copy)]
struct Flying<T> {
    m: T,
    g: T,
}

#[nonholonomic(
    base { x, y }
    lagrangian { (der(x) ^ 2 + der(y) ^ 2) / 2 }
    constraints { der(y) = W; }
    hamilton_jacobi { x_dot: p; }
    emit {
        jacobian, taylor, sparse_jacobian, jacobian_product, adjoint_product, parameter_jacobian, power, prepared,
        angle_cache, multipliers, reactions, momenta, gibbs_appell, hamiltonian, divergence, volume
    }
)]
#[derive(Clone, Copy)]
struct Belt<T> {
    W: T,
    p: T,
}

#[nonholonomic(
    base { x, y }
    formulation { projected }
    lagrangian { m / 2 * (der(x) ^ 2 + der(y) ^ 2 - y) }
    constraints { ray: x * der(y) = y * der(x); }
    emit {
        jacobian, taylor, sparse_jacobian, jacobian_product, adjoint_product, parameter_jacobian, power, prepared,
        angle_cache, multipliers, reactions, gibbs_appell, discrete_gradient, symmetric_projection, divergence,
        volume, connection, leapfrog
    }
)]
#[derive(Clone, Copy)]
struct Ray<T> {
    m: T,
}

#[nonholonomic(
    base { a }
    lagrangian { der(a) ^ 2 / 2 + g * cos(a) }
    conserved { total = der(a) ^ 2 / 2 - g * cos(a); }
    emit {
        jacobian, taylor, sparse_jacobian, jacobian_product, adjoint_product, parameter_jacobian, power, prepared,
        angle_cache, gibbs_appell, hamiltonian, discrete_gradient, divergence, volume, connection, invariants, rattle
    }
)]
#[derive(Clone, Copy)]
struct Swinging<T> {
    g: T,
}

#[nonholonomic(
    base { r, theta }
    velocities { w1 = der(r); w2 = r ^ 2 * der(theta); }
    lagrangian { m / 2 * (w1 ^ 2 + w2 ^ 2 / r ^ 2) - m * (c * r ^ 2 / 2 - k / r) }
    emit {
        jacobian, taylor, sparse_jacobian, jacobian_product, adjoint_product, parameter_jacobian, power, prepared,
        angle_cache, momenta, splitting, gibbs_appell, hamiltonian, discrete_gradient, divergence, volume, connection
    }
)]
#[derive(Clone, Copy)]
struct CentralForceAreal<T> {
    m: T,
    k: T,
    c: T,
}

#[nonholonomic(
    base { x, y, z }
    lagrangian { m / 2 * (der(x) ^ 2 + der(y) ^ 2 + der(z) ^ 2) - m * g * y }
    holonomic { bowl: y = h * x ^ 2; }
    independent { der(x), der(z) }
    emit {
        jacobian, taylor, sparse_jacobian, jacobian_product, adjoint_product, return_jacobian, parameter_jacobian,
        power, prepared, angle_cache, multipliers, reactions, momenta, gibbs_appell, hamiltonian, discrete_gradient,
        symmetric_projection, divergence, volume, connection
    }
)]
#[derive(Clone, Copy)]
struct Valley<T> {
    m: T,
    g: T,
    h: T,
}

#[nonholonomic(
    base { x, y }
    lagrangian { (der(x) ^ 2 + der(y) ^ 2) / 2 - g * y }
    constraints { der(x) ^ 2 + der(y) ^ 2 = u ^ 2; }
    volume { exp(- g * y / u ^ 2); }
    emit {
        jacobian, taylor, sparse_jacobian, jacobian_product, adjoint_product, parameter_jacobian, power, prepared,
        angle_cache, multipliers, reactions, gibbs_appell, symmetric_projection, divergence, volume
    }
)]
#[derive(Clone, Copy)]
struct Thermostat<T> {
    g: T,
    u: T,
}

#[nonholonomic(
    base { x }
    let h(u) = depth * cos(u);
    let place = [x, h(x)];
    lagrangian { kinetic(m, place) - m * g * h(x) }
    outputs { slope = diff(h(x), x); }
    assume { m > 0; }
    emit {
        jacobian, taylor, sparse_jacobian, jacobian_product, adjoint_product, parameter_jacobian, output_jacobian,
        power, prepared, angle_cache, gibbs_appell, hamiltonian, bracket, discrete_gradient, divergence, volume,
        connection, rattle
    }
)]
#[derive(Clone, Copy)]
struct Bead<T> {
    m: T,
    g: T,
    depth: T,
}

#[nonholonomic(
    constants { I = [0.5, 0.5, 0.2]; m = 1.5; l = 0.3; g = 9.81; }
    base { G[3] }
    on { dot(G, G) = 1; }
    basis { w[3] }
    anchor { der(G) = cross(G, w); }
    brackets so(3) { w[0], w[1], w[2] }
    lagrangian { sum(i in 0..3: I[i] / 2 * w[i] ^ 2) - m * g * l * G[2] }
    emit {
        jacobian, taylor, sparse_jacobian, jacobian_product, adjoint_product, parameter_jacobian, power, prepared,
        angle_cache, splitting, gibbs_appell, hamiltonian, discrete_gradient, divergence, volume, connection
    }
)]
#[derive(Clone, Copy)]
struct Top {}

#[nonholonomic(
    base { x, phi, psi }
    lagrangian { m / 2 * der(x) ^ 2 + (I * der(phi) ^ 2 + J * der(psi) ^ 2) / 2 }
    distribution { roll, spin }
    frame { roll = phi_dot + r * x_dot; spin = psi_dot; }
    forces { roll: push - sin(phi); }
    inputs { push }
    track { roll, phi }
    emit {
        jacobian, taylor, sparse_jacobian, jacobian_product, adjoint_product, parameter_jacobian, prepared,
        gibbs_appell
    }
)]
#[derive(Clone, Copy)]
struct Wheel<T> {
    m: T,
    I: T,
    J: T,
    r: T,
}

#[nonholonomic(
    base { theta, x, y }
    basis { omega, v1, v2 }
    anchor {
        der(theta) = omega;
        der(x) = v1 * cos(theta) - v2 * sin(theta);
        der(y) = v1 * sin(theta) + v2 * cos(theta);
    }
    lagrangian { (J + m * a ^ 2) / 2 * omega ^ 2 + m / 2 * (v1 ^ 2 + v2 ^ 2) + m * a * omega * v2 }
    constraints { v2 = s; }
    impacts { wall: x + b * cos(theta) <= 0 with restitution e; }
    names { state = SleighState; }
    emit {
        jacobian, taylor, sparse_jacobian, jacobian_product, adjoint_product, parameter_jacobian, power, prepared,
        angle_cache, multipliers, reactions, gibbs_appell, hamiltonian, divergence
    }
)]
#[derive(Clone, Copy)]
struct Sleigh<T> {
    m: T,
    J: T,
    a: T,
    b: T,
    s: T,
    e: T,
}

#[nonholonomic(
    base { x, y, yaw }
    basis { u, v, r }
    anchor { der(x) = u * cos(yaw) - v * sin(yaw); der(y) = u * sin(yaw) + v * cos(yaw); der(yaw) = r; }
    inputs { steer, drive }
    let front = steer - atan((v + a * r) / u);
    let rear = - atan((v - b * r) / u);
    lagrangian { m / 2 * (u ^ 2 + v ^ 2) + J / 2 * r ^ 2 }
    forces {
        u: drive - cf * front * sin(steer);
        v: cf * front * cos(steer) + cr * rear;
        r: a * cf * front * cos(steer) - b * cr * rear;
    }
    outputs { slip = v / u; }
    linearization { keep: u, v, r; }
    emit {
        jacobian, taylor, sparse_jacobian, jacobian_product, adjoint_product, parameter_jacobian, output_jacobian,
        power, prepared, angle_cache, momenta, splitting, gibbs_appell, hamiltonian, bracket, divergence, connection
    }
)]
#[derive(Clone, Copy)]
struct Car<T> {
    m: T,
    J: T,
    a: T,
    b: T,
    cf: T,
    cr: T,
}

#[nonholonomic(
    base { x, y, yaw, lean, spin }
    let R = rot_z(yaw) * rot_x(lean) * rot_y(spin);
    let centre = [x, y, r * cos(lean)];
    let contact = centre - r * (rot_z(yaw) * rot_x(lean) * [0, 0, 1]);
    lagrangian { kinetic(m, [m * r ^ 2 / 4, m * r ^ 2 / 2, m * r ^ 2 / 4], centre, R) - m * g * centre[2] }
    constraints { rolling: velocity_at(centre, R, contact) [0..2] = 0; }
    outputs { place = centre; touch = contact; attitude = R; }
    assume { m > 0; r > 0; }
    units { x, y, r = m; yaw, lean, spin = rad; m = kg; g = m / s ^ 2; }
    emit {
        jacobian, taylor, sparse_jacobian, jacobian_product, adjoint_product, parameter_jacobian, output_jacobian,
        power, prepared, angle_cache, multipliers, reactions, splitting, gibbs_appell, hamiltonian, bracket,
        discrete_gradient, divergence, volume, connection
    }
)]
#[derive(Clone, Copy)]
struct Disk<T> {
    m: T,
    r: T,
    g: T,
}

#[nonholonomic(
    base { x, y, theta }
    constraints { axle: cos(theta) * der(y) = sin(theta) * der(x); }
    formulation { projected }
    inputs { volts[2] }
    let speed = cos(theta) * der(x) + sin(theta) * der(y);
    lagrangian { m / 2 * (der(x) ^ 2 + der(y) ^ 2) + J / 2 * der(theta) ^ 2 }
    auxiliary {
        der(current[i in 0..2]) = (volts[i] - k * (speed + (2 * i - 1) * b * der(theta)) - R * current[i]) / L;
    }
    forces {
        x: k * (current[0] + current[1]) * cos(theta);
        y: k * (current[0] + current[1]) * sin(theta);
        theta: k * b * (current[1] - current[0]);
    }
    emit {
        jacobian, taylor, sparse_jacobian, jacobian_product, adjoint_product, parameter_jacobian, power, prepared,
        angle_cache, multipliers, reactions, splitting, gibbs_appell, symmetric_projection, divergence, connection
    }
)]
#[derive(Clone, Copy)]
struct Driven<T> {
    m: T,
    J: T,
    b: T,
    k: T,
    R: T,
    L: T,
}
