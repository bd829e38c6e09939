//! The two-wheeled robot on the plane, CLMM section 6.4.

use crate::contest::contest;

nh_models::robot! {
    /// The two-wheeled robot.
    #[derive(Clone, Copy, Debug)]
    pub struct Robot { m0: f64, m1: f64, l: f64, J: f64, J2: f64, c: f64, R: f64 }
    emit { jacobian, sparse_jacobian }
}

contest! {
    Robot as "robot", 7 states, 0 inputs,
    parameters [p.m0, p.m1, p.l, p.J, p.J2, p.c, p.R] of p,
    Robot { m0: 5.0, m1: 0.4, l: 0.12, J: 0.31, J2: 0.004, c: 0.2, R: 0.08 },
    hand |s, _t, x, _u| {
        let (sin, cos) = x.theta.sin_cos();
        // mean and difference of the wheels' rates decouple:
        // (M R² + 2 J₂) σ̈ = −2 R m₀ l w²,  (J R² + 2 c² J₂) δ̈ = −2 c R m₀ l v w,  each halved
        let speed = -0.5 * s.R * (x.psi1_dot + x.psi2_dot);
        let quotient = s.R / s.c;
        let turn = 0.5 * quotient * (x.psi2_dot - x.psi1_dot);
        let pull = s.m0 * s.l * turn;
        let double = s.J2 + s.J2;
        let sum_mass = (2.0f64.mul_add(s.m1, s.m0) * s.R).mul_add(s.R, double);
        let difference_mass = (s.J * quotient).mul_add(quotient, double);
        // each is half of the second derivative of the sum, of the difference
        let half_sum = s.R * pull * turn / sum_mass;
        let half_difference = quotient * pull * speed / difference_mass;
        RobotState {
            psi1: x.psi1_dot,
            psi2: x.psi2_dot,
            x: speed * cos,
            y: speed * sin,
            theta: turn,
            psi1_dot: half_difference - half_sum,
            psi2_dot: -(half_sum + half_difference),
        }
    }
}
