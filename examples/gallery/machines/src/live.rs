//! A declared system that moves: its state, its time, the track behind it.

use std::fmt;

use nonholonomic::prelude::*;

use crate::diagram::Diagram;
use crate::scene::{Colour, Scene};

/// A slider: a parameter by its label and range.
pub struct Slider<S> {
    /// The label, with the unit.
    pub label: &'static str,
    /// The least and the largest value.
    pub range: [f64; 2],
    /// The value.
    pub get: fn(&S) -> f64,
    /// Sets it.
    pub set: fn(&mut S, f64),
}

/// A slider without the system that it belongs to.
pub struct Labelled {
    /// The label, with the unit.
    pub label: &'static str,
    /// The least and the largest value.
    pub range: [f64; 2],
}

/// What the motion ended with.
pub type Fault = IntegrationError;

/// A declared system with what a page needs of it.
pub trait Model: Energy + Copy + 'static
where
    Self::State: State<Scalar = f64> + fmt::Debug,
{
    /// The heading of the page.
    const TITLE: &'static str;
    /// What there is to see, in two or three sentences.
    const TEXT: &'static str;
    /// The file with the declaration.
    const SOURCE: &'static str;
    /// `Self::REPORT`.
    const DERIVED: &'static str;
    /// `Self::LATEX`.
    const TYPESET: &'static str;
    /// Whether nothing drives or brakes it.
    const CONSERVATIVE: bool = true;

    /// The declaration as it is compiled, cut out of [`Self::SOURCE`].
    #[must_use]
    fn declaration() -> String {
        let from = Self::SOURCE.find("#[nonholonomic(").unwrap_or(0);
        let end = Self::SOURCE[from..].find("\n}\n").map_or(Self::SOURCE.len(), |at| from + at + 2);
        Self::SOURCE[from..end].to_owned()
    }

    /// Whether nothing drives or brakes it as its sliders stand.
    fn is_conservative(&self) -> bool {
        Self::CONSERVATIVE
    }

    /// Ordinary parameters, and a start worth seeing.
    fn start() -> (Self, Self::State);

    /// The parameters that can be changed.
    fn sliders() -> Vec<Slider<Self>>;

    /// The input, decided from tick to tick.
    fn input(&self, _t: f64, _state: &Self::State) -> Self::Input {
        Self::Input::default()
    }

    /// The state after a tick, with the input held.
    ///
    /// # Errors
    /// What ended the motion.
    fn after(
        &self,
        t: f64,
        tick: f64,
        state: &Self::State,
        input: Self::Input,
    ) -> Result<Self::State, Fault> {
        let mut motion = Integrator::new(*self, Dopri5::new().rtol(1e-10).atol(1e-12), t, *state);
        motion.set_input(input);
        motion.advance_to(t + tick)?;
        Ok(*motion.state())
    }

    /// How far the state is off the constraints, where it can be.
    fn off_constraints(&self, _t: f64, _state: &Self::State) -> Option<f64> {
        None
    }

    /// The state that goes on after a slider was moved.
    fn adjusted(&self, _t: f64, state: &Self::State) -> Self::State {
        *state
    }

    /// What is drawn beside the motion, for the parameters as they stand.
    fn diagram(&self) -> Option<Diagram> {
        None
    }

    /// Where the state stands in the diagram, from 0 at its left to 1 at its right.
    fn diagram_share(&self, _state: &Self::State) -> Option<f64> {
        None
    }

    /// The state after a push (m/s, in the plane of the picture).
    fn pushed(&self, state: &Self::State, push: [f64; 2]) -> Self::State;

    /// The point of the picture that leaves a track.
    fn traced(&self, _state: &Self::State) -> Option<[f64; 2]> {
        None
    }

    /// Centre and half the height of what is seen.
    fn view(&self, state: &Self::State) -> ([f64; 2], f64);

    /// Draws it.
    fn draw(&self, t: f64, state: &Self::State, scene: &mut Scene);
}

/// A machine that a page can show, whatever its declaration.
pub trait Machine {
    fn title(&self) -> &'static str;
    fn text(&self) -> &'static str;
    fn declaration(&self) -> String;
    fn report(&self) -> &'static str;
    fn typeset(&self) -> &'static str;
    fn is_conservative(&self) -> bool;
    fn sliders(&self) -> Vec<Labelled>;
    fn value(&self, slider: usize) -> f64;
    fn set(&mut self, slider: usize, value: f64);
    /// # Errors
    /// What ended the motion.
    fn advance(&mut self, span: f64) -> Result<(), Fault>;
    fn push(&mut self, push: [f64; 2]);
    fn reset(&mut self);
    fn time(&self) -> f64;
    fn energy(&self) -> f64;
    fn off_constraints(&self) -> Option<f64>;
    fn scene(&self) -> Scene;
    /// A picture in SVG that depends on the parameters alone.
    fn diagram(&self) -> Option<String>;
    /// Where the state stands in it, from 0 at its left to 1 at its right.
    fn diagram_share(&self) -> Option<f64>;
}

/// The time between two looks at the input, and two points of the track (s).
const TICK: f64 = 1.0 / 120.0;
/// The points of a track that are kept.
const KEPT: usize = 2000;

/// A model that moves.
pub struct Live<S: Model>
where
    S::State: State<Scalar = f64> + fmt::Debug,
{
    system: S,
    state: S::State,
    t: f64,
    /// What is left of the time that should have passed.
    rest: f64,
    track: Vec<[f64; 2]>,
}

impl<S: Model> Live<S>
where
    S::State: State<Scalar = f64> + fmt::Debug,
{
    /// At its start.
    #[must_use]
    pub fn new() -> Self {
        let (system, state) = S::start();
        Self { system, state, t: 0.0, rest: 0.0, track: Vec::new() }
    }
}

impl<S: Model> Default for Live<S>
where
    S::State: State<Scalar = f64> + fmt::Debug,
{
    fn default() -> Self {
        Self::new()
    }
}

impl<S: Model> Machine for Live<S>
where
    S::State: State<Scalar = f64> + fmt::Debug,
{
    fn title(&self) -> &'static str {
        S::TITLE
    }

    fn text(&self) -> &'static str {
        S::TEXT
    }

    fn declaration(&self) -> String {
        S::declaration()
    }

    fn report(&self) -> &'static str {
        S::DERIVED
    }

    fn typeset(&self) -> &'static str {
        S::TYPESET
    }

    fn is_conservative(&self) -> bool {
        self.system.is_conservative()
    }

    fn sliders(&self) -> Vec<Labelled> {
        S::sliders().into_iter().map(|Slider { label, range, .. }| Labelled { label, range }).collect()
    }

    fn value(&self, slider: usize) -> f64 {
        S::sliders().get(slider).map_or(0.0, |slider| (slider.get)(&self.system))
    }

    fn set(&mut self, slider: usize, value: f64) {
        if let Some(slider) = S::sliders().get(slider) {
            (slider.set)(&mut self.system, value.clamp(slider.range[0], slider.range[1]));
            self.state = self.system.adjusted(self.t, &self.state);
        }
    }

    fn diagram(&self) -> Option<String> {
        self.system.diagram().map(|diagram| diagram.svg())
    }

    fn diagram_share(&self) -> Option<f64> {
        self.system.diagram_share(&self.state)
    }

    fn advance(&mut self, span: f64) -> Result<(), Fault> {
        // a page that was hidden for an hour does not catch up
        self.rest = (self.rest + span).min(0.25);
        while self.rest >= TICK {
            self.rest -= TICK;
            let input = self.system.input(self.t, &self.state);
            self.state = self.system.after(self.t, TICK, &self.state, input)?;
            self.t += TICK;
            if let Some(point) = self.system.traced(&self.state) {
                if self.track.len() == KEPT {
                    self.track.remove(0);
                }
                self.track.push(point);
            }
        }
        Ok(())
    }

    fn push(&mut self, push: [f64; 2]) {
        self.state = self.system.pushed(&self.state, push);
    }

    fn reset(&mut self) {
        *self = Self::new();
    }

    fn time(&self) -> f64 {
        self.t
    }

    fn energy(&self) -> f64 {
        self.system.energy(self.t, &self.state)
    }

    fn off_constraints(&self) -> Option<f64> {
        self.system.off_constraints(self.t, &self.state)
    }

    fn scene(&self) -> Scene {
        let (centre, half) = self.system.view(&self.state);
        let mut scene = Scene::around(centre, half);
        self.system.draw(self.t, &self.state, &mut scene);
        if self.track.len() > 1 {
            scene.line(Colour::Track, 1.5, &self.track);
        }
        scene
    }
}
