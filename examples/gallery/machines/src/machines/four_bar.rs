use nonholonomic::prelude::*;

use crate::live::{Model, Slider};
use crate::scene::{Colour, Scene};

/// A four-bar linkage: crank, coupler and rocker close a loop with the ground.
#[nonholonomic(
    base {
        /// The angles of the three links.
        crank, coupler, rocker
    }
    // rods of a mass per length; the crank turns about the origin, the rocker d beside it
    let pin = l1 * [cos(crank), sin(crank)];
    let end = pin + l2 * [cos(coupler), sin(coupler)];
    let seat = [d, 0];
    let top = seat + l3 * [cos(rocker), sin(rocker)];

    holonomic { closure: end - top = 0; }
    lagrangian {
        kinetic(mu * l1, mu * l1^3 / 12, pin / 2, crank)
        + kinetic(mu * l2, mu * l2^3 / 12, (pin + end) / 2, coupler)
        + kinetic(mu * l3, mu * l3^3 / 12, (seat + top) / 2, rocker)
        - mu * g * (l1 * pin[1] + l2 * (pin[1] + end[1]) + l3 * top[1]) / 2
    }
    inputs { motor }
    forces { crank: motor; }
    assume { mu > 0; l1 > 0; l2 > 0; l3 > 0; d > 0; }
    units { crank, coupler, rocker = rad; l1, l2, l3, d = m; mu = kg/m; g = m/s^2; motor = N m; closure = N; }
    emit { latex }
)]
#[derive(Clone, Copy, Debug)]
pub struct FourBar {
    pub l1: f64,
    pub l2: f64,
    pub l3: f64,
    /// The distance of the two joints on the ground.
    pub d: f64,
    pub mu: f64,
    pub g: f64,
    /// The motor's torque as its slider stands (N m).
    #[nh(skip)]
    pub torque: f64,
}

impl FourBar {
    /// A point that the coupler carries beside its middle, with its two ends.
    fn carried(&self, state: &FourBarState) -> [[f64; 2]; 3] {
        let (sin, cos) = state.crank.sin_cos();
        let pin = [self.l1 * cos, self.l1 * sin];
        let (sin, cos) = state.coupler.sin_cos();
        let (half, beside) = (self.l2 / 2.0, 0.3);
        let end = [pin[0] + self.l2 * cos, pin[1] + self.l2 * sin];
        [pin, end, [pin[0] + half * cos - beside * sin, pin[1] + half * sin + beside * cos]]
    }
}

impl Model for FourBar {
    const TITLE: &'static str = "A four-bar linkage";
    const TEXT: &'static str = "Three angles and one loop that has to close: two position constraints, declared as they \
        stand. The state keeps all angles and rates, and returns to the loop after every step; how far it is open is drawn below, on a \
        logarithmic scale. A point of the coupler draws its curve. Other lengths close the loop anew.";
    const SOURCE: &'static str = include_str!("four_bar.rs");
    const DERIVED: &'static str = Self::REPORT;
    const TYPESET: &'static str = Self::LATEX;

    fn is_conservative(&self) -> bool {
        self.torque == 0.0
    }

    fn start() -> (Self, FourBarState) {
        let linkage = Self { l1: 0.3, l2: 0.8, l3: 0.6, d: 0.8, mu: 1.0, g: 9.81, torque: 0.0 };
        let guess = FourBarState {
            crank: 0.4,
            coupler: 0.6,
            rocker: 1.6,
            crank_dot: 14.0,
            ..FourBarState::default()
        };
        (linkage, linkage.adjusted(0.0, &guess))
    }

    fn sliders() -> Vec<Slider<Self>> {
        vec![
            Slider {
                label: "torque on the crank (N m)",
                range: [-1.0, 1.0],
                get: |s| s.torque,
                set: |s, x| s.torque = x,
            },
            Slider { label: "crank (m)", range: [0.1, 0.35], get: |s| s.l1, set: |s, x| s.l1 = x },
            Slider { label: "coupler (m)", range: [0.7, 1.0], get: |s| s.l2, set: |s, x| s.l2 = x },
            Slider { label: "gravity (m/s²)", range: [0.0, 20.0], get: |s| s.g, set: |s, x| s.g = x },
        ]
    }

    fn input(&self, _t: f64, _state: &FourBarState) -> FourBarInput {
        FourBarInput { motor: self.torque }
    }

    /// The loop closed, with rates that keep it closed.
    fn adjusted(&self, t: f64, state: &FourBarState) -> FourBarState {
        let mut closed = *state;
        match self.project(t, &mut closed) {
            Ok(()) => closed,
            Err(_) => *state,
        }
    }

    fn off_constraints(&self, t: f64, state: &FourBarState) -> Option<f64> {
        let [x, y] = self.constraint_residual(t, state).closure;
        Some(x.hypot(y))
    }

    fn pushed(&self, state: &FourBarState, [right, up]: [f64; 2]) -> FourBarState {
        let pushed = FourBarState { crank_dot: state.crank_dot - 6.0 * (right + up), ..*state };
        self.adjusted(0.0, &pushed)
    }

    fn traced(&self, state: &FourBarState) -> Option<[f64; 2]> {
        Some(self.carried(state)[2])
    }

    fn view(&self, _state: &FourBarState) -> ([f64; 2], f64) {
        ([0.4, 0.3], 0.8)
    }

    fn draw(&self, _t: f64, state: &FourBarState, scene: &mut Scene) {
        let [pin, end, carried] = self.carried(state);
        let seat = [self.d, 0.0];
        scene.line(Colour::Faint, 3.0, &[[-0.15, 0.0], [self.d + 0.15, 0.0]]);
        scene.area(Colour::Body, &[pin, end, carried]);
        scene.line(Colour::Accent, 6.0, &[[0.0, 0.0], pin]);
        scene.line(Colour::Contact, 6.0, &[pin, end]);
        scene.line(Colour::Contact, 6.0, &[end, seat]);
        for joint in [[0.0, 0.0], pin, end, seat] {
            scene.disk(Colour::Contact, joint, 0.025);
        }
        scene.disk(Colour::Track, carried, 0.02);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn other_lengths_close_the_loop_anew() {
        let (mut linkage, state) = FourBar::start();
        assert!(linkage.off_constraints(0.0, &state) < Some(1e-12));
        linkage.l2 = 1.0;
        assert!(linkage.off_constraints(0.0, &state) > Some(0.1));
        let closed = linkage.adjusted(0.0, &state);
        assert!(linkage.off_constraints(0.0, &closed) < Some(1e-12));
    }
}
