//! Impacts on Lie algebroids with sections of their own.

use nonholonomic::prelude::*;

/// A rigid body with a rotor about its third axis, over the vertical in body axes.
#[nonholonomic(
    base { g[3] }
    on { dot(g, g) = 1; }
    basis { w[3] }
    anchor {
        der(g[0]) = g[1] * w[2] - g[2] * w[1];
        der(g[1]) = g[2] * w[0] - g[0] * w[2];
        der(g[2]) = g[0] * w[1] - g[1] * w[0];
    }
    brackets so(3) { w }
    lagrangian { A / 2 * w[0]^2 + B / 2 * w[1]^2 + C / 2 * w[2]^2 }
    impacts {
        brake: dot(w, g) = 0;
        lid: g[2] >= low with restitution e;
    }
)]
#[derive(Clone, Copy, Debug)]
struct Body {
    A: f64,
    B: f64,
    C: f64,
    low: f64,
    e: f64,
}

#[test]
fn impulses_turn_a_body_about_its_own_axes() {
    let body = Body { A: 1.0, B: 2.0, C: 2.5, low: 0.6, e: 0.3 };
    let state = BodyState { g: [0.0, 0.8, 0.6], w: [0.4, -0.7, 1.1] };
    // Veselova's projection: ω − ⟨ω, γ⟩/⟨γ, I⁻¹γ⟩ I⁻¹γ
    let (after, impulses) = body.impact_brake(0.0, &state).unwrap();
    let inertia = [1.0, 2.0, 2.5];
    let along: f64 = state.w.iter().zip(&state.g).map(|(w, g)| w * g).sum();
    let mobility: f64 = state.g.iter().zip(&inertia).map(|(g, i)| g * g / i).sum();
    for (k, i) in inertia.iter().enumerate() {
        let wanted = state.w[k] - along / mobility * state.g[k] / i;
        assert!((after.w[k] - wanted).abs() < 1e-15, "{after:?}");
    }
    assert!((impulses.brake + along / mobility).abs() < 1e-15 && impulses.lid == 0.0);
    // the rate of γ₃ is γ₁ω₂ − γ₂ω₁: the moment of the lid is along (−γ₂, γ₁, 0)
    let falling = BodyState { w: [0.9, 0.2, -0.3], ..state };
    let (after, impulses) = body.impact_lid(0.0, &falling).unwrap();
    let rate = |state: &BodyState| state.g[0] * state.w[1] - state.g[1] * state.w[0];
    assert!((rate(&after) + 0.3 * rate(&falling)).abs() < 1e-15 && impulses.lid > 0.0);
    assert!(after.w[1] == 0.2 && after.w[2] == -0.3 && (after.w[0] - 0.9 + 0.8 * impulses.lid).abs() < 1e-15);
}

/// A disk that rolls, by sections that span its distribution, and comes to a curb.
#[nonholonomic(
    base { x, y, th, ph }
    frame {
        roll = R * cos(th) * der(x) + R * sin(th) * der(y) + der(ph);
        turn = der(th);
    }
    distribution { roll, turn }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) + J / 2 * der(th)^2 + I / 2 * der(ph)^2 }
    impacts {
        curb: x <= 0 with restitution e;
        lock: roll + k * turn = 0;
    }
)]
#[derive(Clone, Copy, Debug)]
struct Disk {
    m: f64,
    I: f64,
    J: f64,
    R: f64,
    k: f64,
    e: f64,
}

#[test]
fn sections_of_the_distribution_jump() {
    let disk = Disk { m: 2.0, I: 0.3, J: 0.2, R: 0.5, k: 0.4, e: 0.5 };
    let state = DiskState { x: 0.0, th: 0.3, roll: 2.0, turn: 0.7, ..DiskState::default() };
    let (after, impulses) = disk.impact_curb(0.0, &state).unwrap();
    assert!((after.roll + 0.5 * 2.0).abs() < 1e-14 && after.turn == 0.7, "{after:?}");
    // (m R² + I) Δroll = −R cos θ μ
    let wanted = (2.0 * 0.25 + 0.3) * 3.0 / (0.5 * 0.3_f64.cos());
    assert!((impulses.curb - wanted).abs() < 1e-13, "{impulses:?}");
    let (after, _) = disk.impact_lock(0.0, &state).unwrap();
    assert!((after.roll + 0.4 * after.turn).abs() < 1e-15);
    // what is left along (−k, 1) is what it was
    let kept = |state: &DiskState| -0.4 * 0.8 * state.roll + 0.2 * state.turn;
    assert!((kept(&after) - kept(&state)).abs() < 1e-15);
}
