//! Shared drawing code of the examples: a picture, views of the plane, charts and colours.
//!
//! Small on purpose. A [`Picture`] collects SVG elements in page coordinates; a [`View`] maps metres
//! to the page with equal scales, a [`Chart`] shows a quantity over another; the examples do the rest.

mod chart;
mod colour;
mod picture;
mod random;
mod view;

pub use chart::{Chart, Scale};
pub use colour::{BACKGROUND, BLUE, Colours, FAINT, GREEN, INK, MUTED, ORANGE, PALE};
pub use picture::{Page, Picture};
pub use random::Random;
pub use view::{Pose, View};

/// What README.md declares compiles.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct Readme;
