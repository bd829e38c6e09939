//! Colours, chosen for a light background.

use crate::picture::{Page, Picture};

/// The paper.
pub const BACKGROUND: &str = "#fcfbf8";
/// Text and outlines.
pub const INK: &str = "#22262e";
/// Text that explains.
pub const MUTED: &str = "#6b7280";
/// Grids and frames.
pub const FAINT: &str = "#e4e2dc";

/// Curves: what is believed, or the first of several.
pub const BLUE: &str = "#5b7bb0";
/// What is real, or the second.
pub const ORANGE: &str = "#e8623e";
/// The third.
pub const GREEN: &str = "#3c8a5a";
/// Areas below a curve.
pub const PALE: &str = "#a9bad6";

/// Dark blue, violet, magenta, orange, amber: lightness grows evenly, so that the order also shows
/// in grey and to most colour-blind readers.
const STOPS: [[f64; 3]; 5] = [
    [33.0, 45.0, 120.0],
    [110.0, 38.0, 148.0],
    [190.0, 48.0, 116.0],
    [232.0, 98.0, 62.0],
    [242.0, 166.0, 48.0],
];

/// How many colours a scale has; points of one colour are joined in one element.
const SHADES: f64 = 48.0;

/// A quantity shown by colour.
#[derive(Clone, Copy, Debug)]
pub struct Colours {
    /// The value shown darkest.
    pub low: f64,
    /// The value shown brightest.
    pub high: f64,
}

impl Colours {
    /// The scale that covers these values.
    pub fn covering(values: impl IntoIterator<Item = f64>) -> Self {
        let (low, high) = values
            .into_iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
        Self { low, high }
    }

    /// The colour of a value, one of a few dozen.
    #[must_use]
    pub fn of(self, value: f64) -> String {
        let share = ((value - self.low) / (self.high - self.low)).clamp(0.0, 1.0);
        shade((share * SHADES).round() / SHADES)
    }

    /// Draws a line through points whose values the colours show.
    pub fn draw(self, picture: &mut Picture, points: &[(Page, f64)], style: &str) {
        let mut run: Vec<Page> = Vec::new();
        let mut colour = String::new();
        for (point, value) in points {
            let next = self.of(*value);
            run.push(*point);
            if next != colour {
                // the last point of a run is the first of the next: no gaps
                picture.line(&run, &format!(r#"stroke="{colour}" {style}"#));
                run.drain(..run.len() - 1);
                colour = next;
            }
        }
        picture.line(&run, &format!(r#"stroke="{colour}" {style}"#));
    }

    /// Draws the key: a bar with its ends and what it shows.
    pub fn key(self, picture: &mut Picture, at: Page, width: f64, title: &str, unit: &str) {
        let pieces = 24;
        let piece = width / f64::from(pieces);
        for index in 0..pieces {
            let x = at.x + piece * f64::from(index);
            let colour = shade((f64::from(index) + 0.5) / f64::from(pieces));
            picture.rectangle(Page { x, y: at.y }, piece + 0.4, 7.0, &format!(r#"fill="{colour}""#));
        }
        let small = format!(r#"font-size="12" fill="{MUTED}""#);
        picture.text(Page { y: at.y - 7.0, ..at }, title, &small);
        picture.text(Page { y: at.y + 21.0, ..at }, &format!("{:.1}", self.low), &small);
        let end = Page { x: at.x + width, y: at.y + 21.0 };
        picture.text(end, &format!("{:.1} {unit}", self.high), &format!(r#"{small} text-anchor="end""#));
    }
}

/// The colour at a share between 0 and 1 of the scale.
fn shade(share: f64) -> String {
    let pairs = STOPS.windows(2).enumerate();
    let mut mixed = STOPS[0];
    for (index, pair) in pairs {
        let within = share * 4.0 - f64::from(u8::try_from(index).unwrap_or(u8::MAX));
        if (0.0..=1.0).contains(&within) {
            mixed = [0, 1, 2].map(|part| pair[0][part] + (pair[1][part] - pair[0][part]) * within);
        }
    }
    let [red, green, blue] = mixed;
    format!("rgb({red:.0},{green:.0},{blue:.0})")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_reaches_from_end_to_end() {
        let scale = Colours::covering([3.0, 1.0, 2.0]);
        assert_eq!(scale.of(1.0), "rgb(33,45,120)");
        assert_eq!(scale.of(2.0), "rgb(190,48,116)");
        assert_eq!(scale.of(3.0), "rgb(242,166,48)");
        assert_eq!(scale.of(99.0), scale.of(3.0));
    }
}
