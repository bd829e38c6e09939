//! The machines of the gallery: each a declaration with what a browser needs to show it.
//!
//! A page asks for a machine by its name, lets time pass, and draws what [`Scene`] lists; sliders change the fields of
//! the declared struct, a push changes velocities. Nothing of mechanics is in the page.

mod diagram;
mod equations;
mod live;
mod machines;
mod scene;
mod space;

pub use diagram::Diagram;
pub use live::{Fault, Live, Machine, Model, Slider};
pub use machines::{NAMES, machine};
pub use scene::{Colour, Scene};

use wasm_bindgen::prelude::wasm_bindgen;

/// A machine behind the page.
#[wasm_bindgen]
pub struct Shown(Box<dyn Machine>);

/// The names of all machines, in the order of the gallery.
#[wasm_bindgen]
#[must_use]
pub fn names() -> Vec<String> {
    NAMES.iter().map(|name| (*name).to_owned()).collect()
}

#[wasm_bindgen]
impl Shown {
    /// The machine of a name, at its start.
    #[must_use]
    pub fn named(name: &str) -> Option<Shown> {
        machine(name).map(Shown)
    }

    /// What it is called on the page.
    #[must_use]
    pub fn title(&self) -> String {
        self.0.title().to_owned()
    }

    /// What there is to see.
    #[must_use]
    pub fn text(&self) -> String {
        self.0.text().to_owned()
    }

    /// The declaration as it is compiled.
    #[must_use]
    pub fn declaration(&self) -> String {
        self.0.declaration()
    }

    /// What was derived from it.
    #[must_use]
    pub fn report(&self) -> String {
        self.0.report().to_owned()
    }

    /// The equations of motion in TeX: displayed formulas, and words about them with formulas between dollars.
    #[must_use]
    pub fn equations(&self) -> Vec<String> {
        equations::of(self.0.typeset())
    }

    /// A picture in SVG beside the motion, for the parameters as they stand.
    #[must_use]
    pub fn diagram(&self) -> Option<String> {
        self.0.diagram()
    }

    /// Where the state stands in that picture, from 0 at its left to 1 at its right.
    #[must_use]
    pub fn diagram_share(&self) -> Option<f64> {
        self.0.diagram_share()
    }

    /// How a slider is labelled, its unit included; empty if there is none of this number.
    #[must_use]
    pub fn label(&self, slider: usize) -> String {
        self.0.sliders().get(slider).map(|slider| slider.label.to_owned()).unwrap_or_default()
    }

    /// Its least and largest value.
    #[must_use]
    pub fn range(&self, slider: usize) -> Vec<f64> {
        self.0.sliders().get(slider).map(|slider| slider.range.to_vec()).unwrap_or_default()
    }

    /// How many there are.
    #[must_use]
    pub fn sliders(&self) -> usize {
        self.0.sliders().len()
    }

    /// The value that a slider stands for.
    #[must_use]
    pub fn value(&self, slider: usize) -> f64 {
        self.0.value(slider)
    }

    /// Sets it.
    pub fn set(&mut self, slider: usize, value: f64) {
        self.0.set(slider, value);
    }

    /// Lets time pass (s). What went wrong, or nothing; after a fault the machine stays as it is.
    pub fn advance(&mut self, span: f64) -> Option<String> {
        self.0.advance(span).err().map(|fault| fault.to_string())
    }

    /// Pushes it: a change of velocity in the plane of the picture (m/s).
    pub fn push(&mut self, right: f64, up: f64) {
        self.0.push([right, up]);
    }

    /// Puts it back to its start, sliders included.
    pub fn reset(&mut self) {
        self.0.reset();
    }

    /// The time since the start (s).
    #[must_use]
    pub fn time(&self) -> f64 {
        self.0.time()
    }

    /// The energy (J).
    #[must_use]
    pub fn energy(&self) -> f64 {
        self.0.energy()
    }

    /// Whether the energy is conserved, so that its line should be flat.
    #[must_use]
    pub fn is_conservative(&self) -> bool {
        self.0.is_conservative()
    }

    /// How far the state is off the constraints; nothing where the state cannot be off them.
    #[must_use]
    pub fn off_constraints(&self) -> Option<f64> {
        self.0.off_constraints()
    }

    /// What to draw: see [`Scene`].
    #[must_use]
    pub fn scene(&self) -> Vec<f32> {
        self.0.scene().into_numbers()
    }
}
