//! Veselova's system in principal axes with a linear potential, all velocities in the state.

use crate::contest::contest;

nh_models::veselova! {
    /// Veselova's system.
    #[derive(Clone, Copy, Debug)]
    pub struct Veselova { I: [f64; 3], c: [f64; 3] }
    emit { jacobian, sparse_jacobian }
}

contest! {
    Veselova as "veselova", 6 states, 0 inputs,
    parameters [p.I[0], p.I[1], p.I[2], p.c[0], p.c[1], p.c[2]] of p,
    Veselova { I: [1.1, 1.7, 2.3], c: [0.4, -0.3, 0.8] },
    hand |s, _t, x, _u| {
        let ([g1, g2, g3], [w1, w2, w3]) = (x.g, x.w);
        let ([i1, i2, i3], [c1, c2, c3]) = (s.I, s.c);
        // Iω × ω + γ × c
        let k1 = ((i2 - i3) * w2).mul_add(w3, g2.mul_add(c3, -(g3 * c2)));
        let k2 = ((i3 - i1) * w3).mul_add(w1, g3.mul_add(c1, -(g1 * c3)));
        let k3 = ((i1 - i2) * w1).mul_add(w2, g1.mul_add(c2, -(g2 * c1)));
        // one division: I⁻¹ = adj I / det I, and det I cancels in the multiplier
        let (a1, a2, a3) = (i2 * i3, i3 * i1, i1 * i2);
        let (b1, b2, b3) = (a1 * g1, a2 * g2, a3 * g3);
        let norm = b1.mul_add(g1, b2.mul_add(g2, b3 * g3));
        let power = b1.mul_add(k1, b2.mul_add(k2, b3 * k3));
        let determinant = i1 * a1;
        let reciprocal = 1.0 / (norm * determinant);
        let (scale, pull) = (norm * reciprocal, -power * reciprocal);
        VeselovaState {
            g: [
                g2.mul_add(w3, -(g3 * w2)),
                g3.mul_add(w1, -(g1 * w3)),
                g1.mul_add(w2, -(g2 * w1)),
            ],
            w: [
                (a1 * k1).mul_add(scale, b1 * pull),
                (a2 * k2).mul_add(scale, b2 * pull),
                (a3 * k3).mul_add(scale, b3 * pull),
            ],
        }
    }
}
