use nalgebra::{Rotation3, Vector3};
use nonholonomic::prelude::*;

use crate::diagram::Diagram;
use crate::live::{Fault, Model, Slider};
use crate::scene::{Colour, Scene};
use crate::space::{Vector, seen_from, turn};

nh_models::bicycle! {
    /// The benchmark bicycle, with a torque about the steering axis.
    #[derive(Clone, Copy, Debug)]
    pub struct Bicycle<T> with {
        /// How fast it is set going (m/s), and how it is steered (N m), as the sliders say.
        #[nh(skip)]
        pub speed: f64,
        #[nh(skip)]
        pub steering: f64,
    };
    forces { steer: torque; }
    inputs { torque }
    linearization { keep: lean, steer, der(lean), der(steer); }
    emit { latex }
}

/// The speeds of the diagram (m/s), and how many there are.
const SPEEDS: [f64; 2] = [0.0, 10.0];
const COUNT: u32 = 200;
/// It has fallen when it leans so far, or when the handlebar is across (rad).
const FALLEN: f64 = 1.2;

impl Bicycle<f64> {
    /// Upright and straight ahead.
    fn straight(&self, speed: f64) -> BicycleState<f64> {
        BicycleState { rear_dot: -speed / self.rR, ..BicycleState::default() }
    }

    /// Real and imaginary parts of the four eigenvalues in lean and steer.
    fn eigenvalues(&self, speed: f64) -> Option<[[f64; 2]; 4]> {
        let model = self.linearize(0.0, &self.straight(speed), &BicycleInput::default()).ok()?;
        let found = model.a.complex_eigenvalues();
        Some([0, 1, 2, 3].map(|index| [found[index].re, found[index].im]))
    }

    /// The places of its parts.
    fn parts(&self, state: &BicycleState<f64>) -> Parts {
        let about = |axis, angle| Rotation3::from_axis_angle(&axis, angle);
        let (x, y, z) = (Vector3::x_axis(), Vector3::y_axis(), Vector3::z_axis());
        let roll = about(z, state.yaw) * about(x, state.lean);
        let frame = roll * about(y, state.pitch);
        let tilt = about(y, self.lambda);
        let fork = frame * tilt * about(z, state.steer) * tilt.inverse();
        let hub = Vector3::new(state.x, state.y, 0.0) - roll * Vector3::new(0.0, 0.0, self.rR);
        let head = hub + frame * Vector3::new(self.w + self.c, 0.0, self.rR);
        let axle = head - fork * Vector3::new(self.c, 0.0, self.rF);
        Parts { frame, fork, hub, head, axle, up: fork * tilt * Vector3::new(0.0, 0.0, -1.0) }
    }
}

struct Parts {
    frame: Rotation3<f64>,
    fork: Rotation3<f64>,
    hub: Vector3<f64>,
    /// Where the steering axis meets the ground, and upwards along it.
    head: Vector3<f64>,
    up: Vector3<f64>,
    axle: Vector3<f64>,
}

/// The picture of a point; in the declaration y points to the right and z down.
fn shown(point: Vector3<f64>) -> [f64; 2] {
    seen([point.x, -point.y, -point.z])
}

/// From behind, and aside.
fn seen(point: Vector) -> [f64; 2] {
    seen_from([0.9, 0.3], point)
}

impl Model for Bicycle<f64> {
    const TITLE: &'static str = "A bicycle that rides by itself";
    const TEXT: &'static str = "The benchmark bicycle of Meijaard, Papadopoulos, Ruina and Schwab, declared by its \
        geometry: four bodies, two wheels that roll, a front wheel that stays on the ground. Nobody rides it. The diagram has the \
        eigenvalues of its linear model over the speed: between weave and capsize, all real parts are negative. Set a speed there, \
        push it, and it steers itself upright; slower it weaves, and slower still it falls. Trail and the spin of the front wheel move the curves.";
    const SOURCE: &'static str = include_str!("bicycle.rs");
    const DERIVED: &'static str = Self::REPORT;
    const TYPESET: &'static str = Self::LATEX;

    /// The use of the declaration, and the declaration, which other programs share.
    fn declaration() -> String {
        let cut = |source: &'static str, from: &str, to: &str| -> &'static str {
            let from = source.find(from).unwrap_or(0);
            let end = source[from..].find(to).map_or(source.len(), |at| from + at + to.len());
            &source[from..end]
        };
        let used = cut(Self::SOURCE, "nh_models::bicycle! {", "\n}\n");
        let models = include_str!("../../../../../tests/models/src/lib.rs");
        let declared = cut(models, "macro_rules! bicycle {", "\n}\n");
        let declared = cut(declared, "        #[nonholonomic::nonholonomic(", "\n        }\n");
        let lines: Vec<&str> =
            declared.lines().map(|line| line.strip_prefix("        ").unwrap_or(line)).collect();
        format!("{used}\n// where nh_models::bicycle! stands for\n{}", lines.join("\n"))
    }

    fn is_conservative(&self) -> bool {
        self.steering == 0.0
    }

    fn start() -> (Self, BicycleState<f64>) {
        let bicycle =
            nh_models::published_bicycle!(Bicycle, 9.81, |number: f64| number, speed: 4.6, steering: 0.0);
        (bicycle, BicycleState { lean_dot: 0.3, ..bicycle.straight(bicycle.speed) })
    }

    fn sliders() -> Vec<Slider<Self>> {
        vec![
            Slider { label: "speed (m/s)", range: SPEEDS, get: |s| s.speed, set: |s, x| s.speed = x },
            Slider {
                label: "torque on the handlebar (N m)",
                range: [-1.0, 1.0],
                get: |s| s.steering,
                set: |s, x| s.steering = x,
            },
            Slider { label: "trail (m)", range: [-0.05, 0.15], get: |s| s.c, set: |s, x| s.c = x },
            Slider {
                label: "inertia of the front wheel (kg m²)",
                range: [0.0, 0.6],
                get: |s| s.IFy,
                set: |s, x| s.IFy = x,
            },
        ]
    }

    fn input(&self, _t: f64, _state: &BicycleState<f64>) -> BicycleInput<f64> {
        BicycleInput { torque: self.steering }
    }

    fn after(
        &self,
        t: f64,
        tick: f64,
        state: &BicycleState<f64>,
        input: BicycleInput<f64>,
    ) -> Result<BicycleState<f64>, Fault> {
        if state.lean.abs().max(state.steer.abs()) > FALLEN {
            return Ok(*state);
        }
        let mut motion = Integrator::new(*self, Dopri5::new().rtol(1e-9).atol(1e-10), t, *state);
        motion.set_input(input);
        motion.advance_to(t + tick)?;
        Ok(*motion.state())
    }

    fn adjusted(&self, t: f64, state: &BicycleState<f64>) -> BicycleState<f64> {
        let mut moved = BicycleState { rear_dot: -self.speed / self.rR, ..*state };
        // with another trail the front wheel stands elsewhere
        match self.project(t, &mut moved) {
            Ok(()) => moved,
            Err(_) => *state,
        }
    }

    fn off_constraints(&self, t: f64, state: &BicycleState<f64>) -> Option<f64> {
        Some(self.constraint_residual(t, state).ground.abs())
    }

    fn diagram(&self) -> Option<Diagram> {
        let heading = "eigenvalues (1/s) over the speed (m/s)";
        let mut diagram = Diagram::new(heading, SPEEDS, [-10.0, 10.0]);
        let (mut real, mut imaginary) = (Vec::new(), Vec::new());
        let mut stable: Option<[f64; 2]> = None;
        for index in 0..=COUNT {
            let speed = SPEEDS[0] + (SPEEDS[1] - SPEEDS[0]) * f64::from(index) / f64::from(COUNT);
            let values = self.eigenvalues(speed)?;
            real.extend(values.map(|[re, _]| [speed, re]));
            imaginary.extend(values.iter().filter(|[_, im]| *im > 1e-6).map(|[_, im]| [speed, *im]));
            if values.iter().all(|[re, _]| *re < 0.0) {
                stable = Some([stable.map_or(speed, |[from, _]| from), speed]);
            }
        }
        if let Some([from, to]) = stable {
            diagram.band(from, to, "stable");
        }
        diagram.marks_up(&[-10.0, -5.0, 0.0, 5.0, 10.0]);
        diagram.marks_across(&[0.0, 2.0, 4.0, 6.0, 8.0, 10.0]);
        diagram.dots("imaginary", imaginary);
        diagram.dots("real", real);
        diagram.label("real", [3.1, -8.6], "real parts");
        diagram.label("imaginary", [7.6, 5.6], "imaginary parts");
        Some(diagram)
    }

    fn diagram_share(&self, state: &BicycleState<f64>) -> Option<f64> {
        let speed = -self.rR * state.rear_dot;
        Some(((speed - SPEEDS[0]) / (SPEEDS[1] - SPEEDS[0])).clamp(0.0, 1.0))
    }

    fn pushed(&self, state: &BicycleState<f64>, [right, up]: [f64; 2]) -> BicycleState<f64> {
        BicycleState { lean_dot: state.lean_dot + right, rear_dot: state.rear_dot - up / self.rR, ..*state }
    }

    fn traced(&self, state: &BicycleState<f64>) -> Option<[f64; 2]> {
        Some(seen([state.x, -state.y, 0.0]))
    }

    fn view(&self, state: &BicycleState<f64>) -> ([f64; 2], f64) {
        let (sin, cos) = state.yaw.sin_cos();
        (seen([state.x + 0.5 * cos, -state.y - 0.5 * sin, 0.6]), 1.0)
    }

    fn draw(&self, _t: f64, state: &BicycleState<f64>, scene: &mut Scene) {
        let (near_x, near_y) = (state.x.round(), -state.y.round());
        for k in -6..=6 {
            let place = f64::from(k);
            scene.line(
                Colour::Faint,
                1.0,
                &[seen([near_x + place, near_y - 6.0, 0.0]), seen([near_x + place, near_y + 6.0, 0.0])],
            );
            scene.line(
                Colour::Faint,
                1.0,
                &[seen([near_x - 6.0, near_y + place, 0.0]), seen([near_x + 6.0, near_y + place, 0.0])],
            );
        }
        let parts = self.parts(state);
        let wheels =
            [(parts.hub, parts.frame, self.rR, state.rear), (parts.axle, parts.fork, self.rF, state.front)];
        for (centre, turned, radius, angle) in wheels {
            let rim = |at: f64| {
                let (sin, cos) = at.sin_cos();
                shown(centre + turned * Vector3::new(radius * cos, 0.0, -radius * sin))
            };
            scene.line(Colour::Contact, 4.0, &turn(40).map(rim).collect::<Vec<_>>());
            for spoke in turn(6) {
                scene.line(Colour::Faint, 1.0, &[shown(centre), rim(spoke - angle)]);
            }
        }
        // points of the rear frame are as seen from its hub, x forwards and z down
        let on_frame = |x: f64, z: f64| shown(parts.hub + parts.frame * Vector3::new(x, 0.0, z));
        let tube = |height: f64| parts.head + height * parts.up;
        let (crank, saddle) = (on_frame(0.42, 0.02), on_frame(0.24, -0.6));
        let (low, high, top) = (shown(tube(0.62)), shown(tube(0.82)), tube(0.95));
        scene.line(Colour::Body, 4.0, &[shown(parts.hub), crank, saddle, shown(parts.hub)]);
        scene.line(Colour::Body, 4.0, &[crank, low, high, saddle]);
        scene.line(Colour::Contact, 3.0, &[shown(parts.axle), low, shown(top)]);
        let grip = |side: f64| shown(top + parts.fork * Vector3::new(-0.1, side, 0.0));
        scene.line(Colour::Accent, 3.0, &[grip(-0.28), shown(top), grip(0.28)]);
        scene.disk(Colour::Accent, on_frame(self.xB, self.zB + self.rR), 0.05);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_rides_by_itself_where_the_diagram_says_so() {
        let (mut bicycle, start) = Bicycle::start();
        for (speed, rides) in [(4.6, true), (5.8, true), (3.5, false), (1.0, false)] {
            bicycle.speed = speed;
            let mut state = bicycle.adjusted(0.0, &start);
            // the most lean of the last seconds
            let mut most = 0.0_f64;
            for tick in 0..1200 {
                let t = f64::from(tick) * 0.01;
                state = bicycle.after(t, 0.01, &state, BicycleInput::default()).expect("it rides");
                if tick > 800 {
                    most = most.max(state.lean.abs());
                }
            }
            assert_eq!(most < 0.2, rides, "{speed} m/s: {most} rad");
        }
    }

    #[test]
    fn the_page_shows_the_geometry() {
        let text = Bicycle::declaration();
        for words in ["units {", "holonomic { ground:", "pub IFy: $t,", "linearization {"] {
            assert!(text.contains(words), "{words}: {text}");
        }
        assert!(!text.contains("published"), "{text}");
    }
}
