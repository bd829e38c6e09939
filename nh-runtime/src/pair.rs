//! A state of two numbers, for tests of what lies in this crate and needs some state.

use crate::{D, State};

#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair(pub(crate) [f64; 2]);

impl State for Pair {
    type Scalar = f64;
    type Dim = D<2>;
    fn to_array(&self) -> [f64; 2] {
        self.0
    }
    fn from_array(x: [f64; 2]) -> Self {
        Self(x)
    }
    fn names() -> [&'static str; 2] {
        ["a", "b"]
    }
}
