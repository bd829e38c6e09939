//! A quantity over another, as a picture in SVG that takes its colours from the page.

use std::fmt::Write;

/// Points of curves over an axis to the right.
#[derive(Clone, Debug)]
pub struct Diagram {
    /// The heading of the vertical axis.
    pub heading: &'static str,
    /// From left to right.
    pub across: [f64; 2],
    /// From bottom to top.
    pub up: [f64; 2],
    inside: String,
}

/// The size of the picture, and what is left of it inside the axes: from the left, from the top, width, height.
const SIZE: [f64; 2] = [400.0, 230.0];
const FRAME: [f64; 4] = [34.0, 22.0, 350.0, 184.0];

impl Diagram {
    /// Axes without curves.
    #[must_use]
    pub fn new(heading: &'static str, across: [f64; 2], up: [f64; 2]) -> Self {
        Self { heading, across, up, inside: String::new() }
    }

    /// From 0 at the left to 1 at the right.
    #[must_use]
    pub fn share(&self, value: f64) -> f64 {
        (value - self.across[0]) / (self.across[1] - self.across[0])
    }

    /// Numbers below the axis.
    pub fn marks_across(&mut self, values: &[f64]) {
        for value in values {
            let x = self.x(*value);
            let y = FRAME[1] + FRAME[3] + 16.0;
            self.add(&format!(
                r#"<text class="quiet" text-anchor="middle" x="{x:.1}" y="{y:.1}">{value}</text>"#
            ));
        }
    }

    /// Numbers beside the axis, with lines through the picture.
    pub fn marks_up(&mut self, values: &[f64]) {
        for value in values {
            let (y, left, right) = (self.y(*value), FRAME[0], FRAME[0] + FRAME[2]);
            self.add(&format!(r#"<line class="rule" x1="{left}" x2="{right}" y1="{y:.1}" y2="{y:.1}"/>"#));
            let (x, y) = (left - 6.0, y + 4.0);
            self.add(&format!(
                r#"<text class="quiet" text-anchor="end" x="{x}" y="{y:.1}">{}</text>"#,
                value.to_string().replace('-', "−")
            ));
        }
    }

    /// Shades what lies between two values, and says what it is.
    pub fn band(&mut self, from: f64, to: f64, label: &str) {
        let (x, width) = (self.x(from), self.x(to) - self.x(from));
        let [_, top, _, height] = FRAME;
        self.add(&format!(
            r#"<rect class="band" x="{x:.1}" y="{top}" width="{width:.1}" height="{height}"/>"#
        ));
        let (x, y) = (x + width / 2.0, top + 14.0);
        self.add(&format!(r#"<text class="ink" text-anchor="middle" x="{x:.1}" y="{y}">{label}</text>"#));
    }

    /// Dots of a kind, those inside the frame: modes meet and part, so that no lines are drawn.
    pub fn dots(&mut self, kind: &str, points: impl IntoIterator<Item = [f64; 2]>) {
        let mut path = String::new();
        for [across, up] in points {
            let inside = |value: f64, [least, most]: [f64; 2]| (least..=most).contains(&value);
            if inside(across, self.across) && inside(up, self.up) {
                // a line of no length with round ends is a dot
                let _ = write!(path, "M{:.1} {:.1}h0", self.x(across), self.y(up));
            }
        }
        self.add(&format!(r#"<path class="{kind}" d="{path}"/>"#));
    }

    /// A word beside a point.
    pub fn label(&mut self, kind: &str, [across, up]: [f64; 2], word: &str) {
        let (x, y) = (self.x(across), self.y(up));
        self.add(&format!(r#"<text class="{kind}" x="{x:.1}" y="{y:.1}">{word}</text>"#));
    }

    /// The picture; the line of the class `now` is moved by the page, over the width that it carries.
    #[must_use]
    pub fn svg(&self) -> String {
        let ([width, height], [left, top, across, down]) = (SIZE, FRAME);
        format!(
            r#"<svg viewBox="0 0 {width} {height}" role="img" aria-label="{heading}"><text class="ink" x="0" y="12">{heading}</text>{inside}<line class="now" data-width="{across}" x1="{left}" x2="{left}" y1="{top}" y2="{bottom}"/></svg>"#,
            heading = self.heading,
            inside = self.inside,
            bottom = top + down,
        )
    }

    fn x(&self, value: f64) -> f64 {
        FRAME[0] + FRAME[2] * self.share(value)
    }

    fn y(&self, value: f64) -> f64 {
        FRAME[1] + FRAME[3] * (self.up[1] - value) / (self.up[1] - self.up[0])
    }

    fn add(&mut self, element: &str) {
        self.inside.push_str(element);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_find_their_place() {
        let mut diagram = Diagram::new("height (m)", [0.0, 10.0], [-1.0, 1.0]);
        diagram.dots("kind", [[5.0, 0.0], [5.0, 2.0]]);
        let svg = diagram.svg();
        assert!(svg.contains(r#"<path class="kind" d="M209.0 114.0h0"/>"#), "{svg}");
        assert!((diagram.share(2.5) - 0.25).abs() < 1e-15);
    }
}
