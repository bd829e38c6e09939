//! A quantity over another.

use crate::colour::{FAINT, INK, MUTED};
use crate::picture::{Page, Picture};

/// A chart: ranges of two quantities on a rectangle of the page.
#[derive(Clone, Debug)]
pub struct Chart {
    /// The upper left corner.
    pub corner: Page,
    /// The width on the page.
    pub width: f64,
    /// The height on the page.
    pub height: f64,
    /// The range from left to right.
    pub across: [f64; 2],
    /// The range from bottom to top.
    pub up: [f64; 2],
}

impl Chart {
    /// The page point of a pair of values.
    #[must_use]
    pub fn at(&self, across: f64, up: f64) -> Page {
        let share = |value: f64, range: [f64; 2]| (value - range[0]) / (range[1] - range[0]);
        Page {
            x: self.corner.x + self.width * share(across, self.across),
            y: self.corner.y + self.height * (1.0 - share(up, self.up)),
        }
    }

    /// Draws marks at these values with their labels, and a title in the upper left.
    pub fn axes(&self, picture: &mut Picture, title: &str, across: &[(f64, &str)], up: &[(f64, &str)]) {
        let small = format!(r#"font-size="12" fill="{MUTED}""#);
        for (value, label) in up {
            let (from, to) = (self.at(self.across[0], *value), self.at(self.across[1], *value));
            picture.line(&[from, to], &format!(r#"stroke="{FAINT}" stroke-width="1""#));
            let at = Page { x: from.x - 8.0, y: from.y + 4.0 };
            picture.text(at, label, &format!(r#"{small} text-anchor="end""#));
        }
        for (value, label) in across {
            let foot = self.at(*value, self.up[0]);
            let below = Page { y: foot.y + 5.0, ..foot };
            picture.line(&[foot, below], &format!(r#"stroke="{MUTED}" stroke-width="1""#));
            let at = Page { y: foot.y + 19.0, ..foot };
            picture.text(at, label, &format!(r#"{small} text-anchor="middle""#));
        }
        let above = Page { y: self.corner.y - 10.0, ..self.corner };
        picture.text(above, title, &format!(r#"font-size="13.5" fill="{INK}""#));
    }

    /// Draws a line through pairs of values.
    pub fn line(&self, picture: &mut Picture, pairs: impl IntoIterator<Item = (f64, f64)>, style: &str) {
        let points: Vec<Page> = pairs.into_iter().map(|(across, up)| self.at(across, up)).collect();
        picture.line(&points, style);
    }

    /// Fills what lies between two curves: triples of a value across, the lower and the upper one.
    pub fn band(
        &self,
        picture: &mut Picture,
        triples: impl IntoIterator<Item = (f64, f64, f64)>,
        style: &str,
    ) {
        let triples: Vec<_> = triples.into_iter().collect();
        let upper = triples.iter().map(|(across, _, up)| self.at(*across, *up));
        let lower = triples.iter().rev().map(|(across, down, _)| self.at(*across, *down));
        let outline: Vec<Page> = upper.chain(lower).collect();
        picture.polygon(&outline, style);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_find_their_place() {
        let corner = Page { x: 10.0, y: 20.0 };
        let chart = Chart { corner, width: 100.0, height: 50.0, across: [0.0, 2.0], up: [-1.0, 1.0] };
        assert_eq!(chart.at(0.0, -1.0), Page { x: 10.0, y: 70.0 });
        assert_eq!(chart.at(1.0, 1.0), Page { x: 60.0, y: 20.0 });
    }
}
