use nonholonomic::prelude::*;

use crate::live::{Model, Slider};
use crate::scene::{Colour, Scene};
use crate::space::{seen, turn};

/// A disk that rolls on a plane without slipping, as a coin does.
#[nonholonomic(
    base {
        /// The point of contact.
        x, y,
        /// The heading, the lean from upright, the roll.
        heading, lean, roll
    }
    lagrangian {
        // the velocity of the centre, which is R above the contact and leans with the disk
        let vx = der(x) + R * (cos(lean) * der(lean) * sin(heading) + sin(lean) * cos(heading) * der(heading));
        let vy = der(y) - R * (cos(lean) * der(lean) * cos(heading) - sin(lean) * sin(heading) * der(heading));
        m / 2 * (vx^2 + vy^2 + (R * sin(lean) * der(lean))^2)
            + A / 2 * (der(lean)^2 + (der(heading) * cos(lean))^2)
            + C / 2 * (der(roll) + der(heading) * sin(lean))^2 - m * g * R * cos(lean)
    }
    constraints {
        der(x) = R * cos(heading) * der(roll);
        der(y) = R * sin(heading) * der(roll);
    }
    assume { m > 0; A > 0; C > 0; R > 0; }
    units { x, y, R = m; heading, lean, roll = rad; m = kg; A, C = kg m^2; g = m/s^2; }
    emit { latex }
)]
#[derive(Clone, Copy, Debug)]
pub struct Disk {
    pub m: f64,
    /// Moment of inertia about a diameter, and about the axle (kg m²).
    pub A: f64,
    pub C: f64,
    pub R: f64,
    pub g: f64,
}

impl Model for Disk {
    const TITLE: &'static str = "A rolling disk";
    const TEXT: &'static str = "A disk rolls without slipping: fast, it stays upright and curves gently; slow, it leans \
        and spirals as a coin does. Five coordinates, two constraints, energy conserved.";
    const SOURCE: &'static str = include_str!("disk.rs");
    const DERIVED: &'static str = Self::REPORT;
    const TYPESET: &'static str = Self::LATEX;

    fn start() -> (Self, DiskState) {
        let disk = Self { m: 1.0, A: 0.25 * 0.16, C: 0.5 * 0.16, R: 0.4, g: 9.81 };
        let start = DiskState { lean: 0.35, heading_dot: -1.45, roll_dot: 4.0, ..DiskState::default() };
        (disk, start)
    }

    fn sliders() -> Vec<Slider<Self>> {
        vec![Slider { label: "gravity (m/s²)", range: [1.0, 20.0], get: |s| s.g, set: |s, x| s.g = x }]
    }

    fn pushed(&self, state: &DiskState, [right, up]: [f64; 2]) -> DiskState {
        DiskState { roll_dot: state.roll_dot + right / self.R, lean_dot: state.lean_dot + up, ..*state }
    }

    fn traced(&self, state: &DiskState) -> Option<[f64; 2]> {
        Some(seen([state.x, state.y, 0.0]))
    }

    fn view(&self, state: &DiskState) -> ([f64; 2], f64) {
        (seen([state.x, state.y, 0.3]), 1.5)
    }

    fn draw(&self, _t: f64, state: &DiskState, scene: &mut Scene) {
        let ([sh, ch], [sl, cl]) = (sin_cos(state.heading), sin_cos(state.lean));
        // from the contact to the centre, and the direction of rolling
        let up = [self.R * sl * sh, -self.R * sl * ch, self.R * cl];
        let centre = [state.x + up[0], state.y + up[1], up[2]];
        let rim = |angle: f64| {
            let (sin, cos) = angle.sin_cos();
            let at = |i: usize, ahead: f64| centre[i] - up[i] * cos + self.R * ahead * sin;
            seen([at(0, ch), at(1, sh), at(2, 0.0)])
        };
        for k in -6..=6 {
            let place = f64::from(k) * 0.5;
            let (x, y) = ((state.x * 2.0).round() / 2.0, (state.y * 2.0).round() / 2.0);
            scene.line(
                Colour::Faint,
                1.0,
                &[seen([x + place, y - 3.0, 0.0]), seen([x + place, y + 3.0, 0.0])],
            );
            scene.line(
                Colour::Faint,
                1.0,
                &[seen([x - 3.0, y + place, 0.0]), seen([x + 3.0, y + place, 0.0])],
            );
        }
        let points: Vec<[f64; 2]> = turn(48).map(rim).collect();
        scene.area(Colour::Body, &points);
        scene.line(Colour::Contact, 3.0, &points);
        scene.line(Colour::Accent, 3.0, &[seen(centre), rim(-state.roll)]);
    }
}

fn sin_cos(angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [sin, cos]
}
