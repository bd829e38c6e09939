//! The plane on the page, with equal scales.

use crate::colour::{BACKGROUND, FAINT, INK, MUTED};
use crate::picture::{Page, Picture};

/// A place in the plane with a heading, as of a body that moves on it.
#[derive(Clone, Copy, Debug)]
pub struct Pose {
    /// The first coordinate.
    pub x: f64,
    /// The second coordinate.
    pub y: f64,
    /// The heading, counter-clockwise from the first axis.
    pub heading: f64,
}

impl Pose {
    /// The point at `ahead` and `left` of the body.
    #[must_use]
    pub fn point(self, ahead: f64, left: f64) -> (f64, f64) {
        let (sin, cos) = self.heading.sin_cos();
        (self.x + ahead * cos - left * sin, self.y + ahead * sin + left * cos)
    }
}

/// A part of the plane on the page.
#[derive(Clone, Copy, Debug)]
pub struct View {
    /// The upper left corner on the page.
    corner: Page,
    width: f64,
    height: f64,
    /// The point of the plane in the middle.
    middle: (f64, f64),
    /// Pixels per unit of length.
    scale: f64,
}

impl View {
    /// Shows all points, and `margin` around them, in a rectangle of the page.
    pub fn showing(
        points: impl IntoIterator<Item = (f64, f64)>,
        margin: f64,
        corner: Page,
        width: f64,
        height: f64,
    ) -> Self {
        let start = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        let (low, high) = points.into_iter().fold(start, |(low, high), (x, y)| {
            ([low[0].min(x), low[1].min(y)], [high[0].max(x), high[1].max(y)])
        });
        let size = [0, 1].map(|axis| high[axis] - low[axis] + 2.0 * margin);
        let middle = (f64::midpoint(low[0], high[0]), f64::midpoint(low[1], high[1]));
        Self { corner, width, height, middle, scale: (width / size[0]).min(height / size[1]) }
    }

    /// The page point of a point of the plane.
    #[must_use]
    pub fn at(&self, (x, y): (f64, f64)) -> Page {
        Page {
            x: self.corner.x + self.width / 2.0 + (x - self.middle.0) * self.scale,
            y: self.corner.y + self.height / 2.0 - (y - self.middle.1) * self.scale,
        }
    }

    /// The page points of points in the frame of a body, given as `(ahead, left)`.
    #[must_use]
    pub fn body(&self, pose: Pose, shape: &[(f64, f64)]) -> Vec<Page> {
        shape.iter().map(|(ahead, left)| self.at(pose.point(*ahead, *left))).collect()
    }

    /// A length on the page.
    #[must_use]
    pub fn length(&self, length: f64) -> f64 {
        length * self.scale
    }

    /// Draws a grid with lines at multiples of `spacing`, and a bar that shows their distance.
    pub fn grid(&self, picture: &mut Picture, spacing: f64, unit: &str) {
        let style = format!(r#"stroke="{FAINT}" stroke-width="1""#);
        let half = [self.width, self.height].map(|length| length / 2.0 / self.scale);
        let Page { x: left, y: top } = self.corner;
        let (right, bottom) = (left + self.width, top + self.height);
        for value in multiples(spacing, self.middle.0, half[0]) {
            let x = self.at((value, 0.0)).x;
            picture.line(&[Page { x, y: top }, Page { x, y: bottom }], &style);
        }
        for value in multiples(spacing, self.middle.1, half[1]) {
            let y = self.at((0.0, value)).y;
            picture.line(&[Page { x: left, y }, Page { x: right, y }], &style);
        }
        let bar = [Page { x: left + 14.0, y: bottom - 16.0 }, Page { x: 0.0, y: bottom - 16.0 }];
        let bar = [bar[0], Page { x: bar[0].x + self.length(spacing), ..bar[1] }];
        picture.rectangle(
            Page { x: left + 1.0, y: bottom - 42.0 },
            self.length(spacing) + 28.0,
            41.0,
            &format!(r#"fill="{BACKGROUND}" fill-opacity="0.85""#),
        );
        picture.line(&bar, &format!(r#"stroke="{INK}" stroke-width="2.5" stroke-linecap="butt""#));
        let above = Page { x: f64::midpoint(bar[0].x, bar[1].x), y: bottom - 23.0 };
        let label = format!(r#"font-size="12" fill="{MUTED}" text-anchor="middle""#);
        picture.text(above, &format!("{spacing} {unit}"), &label);
    }
}

/// The multiples of `spacing` within `half` of `middle`.
fn multiples(spacing: f64, middle: f64, half: f64) -> Vec<f64> {
    let first = ((middle - half) / spacing).ceil() * spacing;
    std::iter::successors(Some(first), |value| Some(value + spacing))
        .take_while(|value| *value <= middle + half)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_are_equal_and_up_is_up() {
        let corner = Page { x: 0.0, y: 0.0 };
        let view = View::showing([(0.0, 0.0), (4.0, 1.0)], 1.0, corner, 600.0, 600.0);
        assert_eq!(view.at((2.0, 0.5)), Page { x: 300.0, y: 300.0 });
        assert_eq!(view.at((3.0, 1.5)), Page { x: 400.0, y: 200.0 });
        assert_eq!(multiples(0.5, 1.0, 0.6), [0.5, 1.0, 1.5]);
    }
}
