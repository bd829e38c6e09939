//! Parameters and states, ordinary and extreme.

use std::f64::consts::{FRAC_PI_2, PI};

/// Where a system is evaluated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Regime {
    /// Parameters between 1/2 and 2, states between −1 and 1.
    Ordinary,
    /// Inertias over eighteen decades, one against the other.
    Masses,
    /// States close to those where a denominator vanishes, and velocities over six decades.
    States,
}

/// All of them, in the order of the table.
pub const REGIMES: [Regime; 3] = [Regime::Ordinary, Regime::Masses, Regime::States];

impl Regime {
    /// As it is called in the table.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Ordinary => "ordinary",
            Self::Masses => "mass ratios 1e±9",
            Self::States => "near-singular states",
        }
    }
}

/// The numbers of a system: how many, and which of them go to extremes.
#[derive(Clone, Copy, Debug)]
pub struct Numbers {
    /// How many parameters.
    pub parameters: usize,
    /// The parameters that are inertias.
    pub inertias: &'static [usize],
    /// How many states.
    pub states: usize,
    /// The states that are velocities: from this one on.
    pub velocities: usize,
    /// States and the values at which a denominator vanishes, or nearly does.
    pub singular: &'static [(usize, f64)],
    /// How many inputs.
    pub inputs: usize,
}

/// Exact numbers at which a system is evaluated.
#[derive(Clone, Debug)]
pub struct Place {
    /// The parameters.
    pub parameters: Vec<f64>,
    /// The state.
    pub state: Vec<f64>,
    /// The inputs.
    pub input: Vec<f64>,
}

impl Numbers {
    /// Random numbers of a regime.
    pub fn draw(&self, regime: Regime, random: &mut Random) -> Place {
        let mut parameters: Vec<f64> = (0..self.parameters).map(|_| random.between(0.5, 2.0)).collect();
        let mut state: Vec<f64> = (0..self.states).map(|_| random.between(-1.0, 1.0)).collect();
        let input = (0..self.inputs).map(|_| random.between(-1.0, 1.0)).collect();
        match regime {
            Regime::Ordinary => {}
            Regime::Masses => {
                for index in self.inertias {
                    parameters[*index] *= 10f64.powf(random.between(-9.0, 9.0));
                }
            }
            Regime::States => {
                for (index, value) in self.singular {
                    let distance = 10f64.powf(random.between(-8.0, -2.0));
                    state[*index] = value + distance.copysign(random.between(-1.0, 1.0));
                }
                for velocity in &mut state[self.velocities..] {
                    *velocity *= 10f64.powf(random.between(-3.0, 3.0));
                }
            }
        }
        Place { parameters, state, input }
    }
}

/// What is tried for coordinates that look singular: zeros of sines and cosines, exact, rounded, and near.
const CORNERS: [f64; 7] = [0.0, FRAC_PI_2, -FRAC_PI_2, PI, 1e-9, -1e-4, FRAC_PI_2 + 1e-4];

impl Numbers {
    /// A place with coordinates of which some look singular, all numbers those of `f32`.
    pub fn draw_corner(&self, regime: Regime, random: &mut Random) -> Place {
        let mut place = self.draw(regime, random);
        for coordinate in &mut place.state[..self.velocities] {
            *coordinate = random.between(-1.0, 1.0);
            if random.between(0.0, 1.0) < 0.7 {
                *coordinate = CORNERS[random.below(CORNERS.len())];
            }
        }
        for list in [&mut place.parameters, &mut place.state, &mut place.input] {
            for entry in list {
                #[allow(clippy::cast_possible_truncation, reason = "it is meant")]
                let rounded = *entry as f32;
                *entry = rounded.into();
            }
        }
        place
    }
}

/// Marsaglia's xorshift.
#[derive(Clone, Debug)]
pub struct Random(pub u64);

impl Random {
    /// A number in an interval.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        #[allow(clippy::cast_precision_loss, reason = "53 bits")]
        let unit = (self.0 >> 11) as f64 / (1_u64 << 53) as f64;
        low + (high - low) * unit
    }

    /// An index below a length.
    pub fn below(&mut self, length: usize) -> usize {
        let _ = self.between(0.0, 1.0);
        usize::try_from(self.0 >> 33).unwrap_or(0) % length
    }
}
