//! A quantity over another: the axes and the curves are drawn by plotters, onto a part of the page.

use plotters::coord::ranged1d::{Ranged, ValueFormatter};
use plotters::prelude::*;

use crate::colour::{FAINT, INK, MUTED};
use crate::picture::{FONTS, Page, Picture};

/// What is left of a chart for the numbers, below for those across and above for half a number, in pixels.
const LEFT: f64 = 70.0;
const BELOW: f64 = 30.0;
const BESIDE: f64 = 24.0;

/// Plotters counts whole pixels, of which there are this many in one of the page.
const FINE: f64 = 10.0;

/// How a quantity is spread over its side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scale {
    /// Equal differences are equally far.
    Linear,
    /// Equal ratios are equally far.
    Logarithmic,
}

/// A chart: ranges of two quantities on a rectangle of the page, and what is shown of them.
#[derive(Clone, Debug)]
pub struct Chart {
    corner: Page,
    size: [f64; 2],
    across: [f64; 2],
    up: [f64; 2],
    scales: [Scale; 2],
    curves: Vec<Curve>,
}

/// What is drawn, with its name and its colour.
#[derive(Clone, Debug)]
struct Curve {
    name: String,
    colour: RGBColor,
    shape: Shape,
}

#[derive(Clone, Debug)]
enum Shape {
    Line(Vec<(f64, f64)>),
    Area(Vec<(f64, f64)>),
}

impl Chart {
    /// A chart with its upper left corner, its width and height on the page, the range from left to right, and that
    /// from bottom to top.
    #[must_use]
    pub fn new(corner: Page, size: [f64; 2], across: [f64; 2], up: [f64; 2]) -> Self {
        Self { corner, size, across, up, scales: [Scale::Linear; 2], curves: Vec::new() }
    }

    /// The scales across and up, instead of linear ones.
    #[must_use]
    pub fn scales(self, across: Scale, up: Scale) -> Self {
        Self { scales: [across, up], ..self }
    }

    /// The page point of a pair of values.
    #[must_use]
    pub fn at(&self, across: f64, up: f64) -> Page {
        let share = |value: f64, range: [f64; 2], scale: Scale| match scale {
            Scale::Linear => (value - range[0]) / (range[1] - range[0]),
            Scale::Logarithmic => (value / range[0]).ln() / (range[1] / range[0]).ln(),
        };
        Page {
            x: self.corner.x + self.size[0] * share(across, self.across, self.scales[0]),
            y: self.corner.y + self.size[1] * (1.0 - share(up, self.up, self.scales[1])),
        }
    }

    /// Adds a line through pairs of values, with a name, or none where it is empty.
    pub fn line(&mut self, name: &str, colour: &str, pairs: impl IntoIterator<Item = (f64, f64)>) {
        let shape = Shape::Line(self.thinned(pairs));
        self.curves.push(Curve { name: name.to_owned(), colour: rgb(colour), shape });
    }

    /// Adds what lies between two curves: triples of a value across, the lower and the upper one.
    pub fn band(&mut self, name: &str, colour: &str, triples: impl IntoIterator<Item = (f64, f64, f64)>) {
        let triples: Vec<_> = triples.into_iter().collect();
        let mut outline = self.thinned(triples.iter().map(|(across, _, up)| (*across, *up)));
        outline.extend(self.thinned(triples.iter().rev().map(|(across, down, _)| (*across, *down))));
        self.curves.push(Curve { name: name.to_owned(), colour: rgb(colour), shape: Shape::Area(outline) });
    }

    /// The pairs without those that are nearer to their predecessor than the eye can tell.
    fn thinned(&self, pairs: impl IntoIterator<Item = (f64, f64)>) -> Vec<(f64, f64)> {
        let mut kept: Vec<(f64, f64)> = Vec::new();
        let mut last = None;
        for pair in pairs {
            let near = kept.last().is_some_and(|(across, up)| {
                let (from, to) = (self.at(*across, *up), self.at(pair.0, pair.1));
                (to.x - from.x).hypot(to.y - from.y) <= 0.8
            });
            last = near.then_some(pair);
            if !near {
                kept.push(pair);
            }
        }
        kept.extend(last);
        kept
    }

    /// Draws the axes, the curves, a title in the upper left and the names in the upper right; `unit` is that of the
    /// quantity across.
    ///
    /// # Panics
    /// Never: what is drawn is written into a text, which takes everything.
    pub fn draw(&self, picture: &mut Picture, title: &str, unit: &str) {
        let mut text = String::new();
        let [width, height] = self.size;
        let whole = [LEFT + width + BESIDE, BESIDE + height + BELOW];
        {
            let root =
                SVGBackend::with_string(&mut text, (fine(whole[0]), fine(whole[1]))).into_drawing_area();
            let ([left, right], [low, high]) = (self.across, self.up);
            let mut builder = ChartBuilder::on(&root);
            builder
                .margin_top(fine(BESIDE))
                .margin_right(fine(BESIDE))
                .x_label_area_size(fine(BELOW))
                .y_label_area_size(fine(LEFT));
            let drawn = match self.scales {
                [Scale::Linear, Scale::Linear] => {
                    builder.build_cartesian_2d(left..right, low..high).and_then(|chart| self.fill(chart))
                }
                [Scale::Linear, Scale::Logarithmic] => builder
                    .build_cartesian_2d(left..right, (low..high).log_scale())
                    .and_then(|chart| self.fill(chart)),
                [Scale::Logarithmic, Scale::Linear] => builder
                    .build_cartesian_2d((left..right).log_scale(), low..high)
                    .and_then(|chart| self.fill(chart)),
                [Scale::Logarithmic, Scale::Logarithmic] => builder
                    .build_cartesian_2d((left..right).log_scale(), (low..high).log_scale())
                    .and_then(|chart| self.fill(chart)),
            };
            drawn.and_then(|()| root.present()).expect("a text takes everything");
        }
        let corner = Page { x: self.corner.x - LEFT, y: self.corner.y - BESIDE };
        picture.embed(corner, whole, &text);
        let above = Page { y: self.corner.y - 10.0, ..self.corner };
        picture.text(above, title, &format!(r#"font-size="13.5" fill="{INK}""#));
        let small = r#"font-size="12""#;
        let end = Page { x: self.corner.x + width + 22.0, y: self.corner.y + height + 19.0 };
        picture.text(end, unit, &format!(r#"{small} fill="{MUTED}""#));
        let mut beside = Page { x: self.corner.x + width, ..above };
        for Curve { name, colour: RGBColor(red, green, blue), .. } in self.curves.iter().rev() {
            if !name.is_empty() {
                let style = format!(r#"{small} fill="rgb({red},{green},{blue})" text-anchor="end""#);
                picture.text(beside, name, &style);
                beside.x -= 6.4 * f64::from(u32::try_from(name.chars().count()).unwrap_or(0)) + 14.0;
            }
        }
    }

    /// The axes with their numbers, and the curves.
    fn fill<'a, X, Y>(
        &self,
        mut chart: ChartContext<'a, SVGBackend<'a>, Cartesian2d<X, Y>>,
    ) -> Result<(), DrawingAreaErrorKind<std::io::Error>>
    where
        X: Ranged<ValueType = f64> + ValueFormatter<f64>,
        Y: Ranged<ValueType = f64> + ValueFormatter<f64>,
    {
        let numbers = (FONTS, 1.24 * 12.0 * FINE).into_font().color(&rgb(MUTED));
        // a number across every sixty pixels, one up every thirty
        let fits = |length: f64, apart: f64| fine(length / apart / FINE) as usize;
        let [across, up] = [fits(self.size[0], 60.0), fits(self.size[1], 30.0)];
        chart
            .configure_mesh()
            .disable_x_mesh()
            .max_light_lines(0)
            .bold_line_style(rgb(FAINT).stroke_width(fine(1.0)))
            .axis_style(rgb(FAINT).stroke_width(fine(1.0)))
            .set_all_tick_mark_size(fine(5.0))
            .x_labels(across.max(3))
            .y_labels(up.max(3))
            .x_label_formatter(&|value| number(*value))
            .y_label_formatter(&|value| number(*value))
            .label_style(numbers)
            .draw()?;
        for Curve { colour, shape, .. } in &self.curves {
            match shape {
                Shape::Line(pairs) => {
                    let style = colour.stroke_width(fine(1.7));
                    chart.draw_series(std::iter::once(PathElement::new(pairs.clone(), style)))?;
                }
                Shape::Area(outline) => {
                    chart.draw_series(std::iter::once(Polygon::new(outline.clone(), colour.filled())))?;
                }
            }
        }
        Ok(())
    }
}

/// Pixels of plotters.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // sizes of a page
fn fine(pixels: f64) -> u32 {
    (pixels * FINE).round() as u32
}

/// A number at an axis, with the minus of the printers, without what rounding left.
fn number(value: f64) -> String {
    let rounded = (value * 1e6).round() / 1e6;
    if rounded == 0.0 { "0".to_owned() } else { rounded.to_string().replace('-', "−") }
}

/// A colour of the page, such as `#5b7bb0`, for plotters.
fn rgb(colour: &str) -> RGBColor {
    let part = |from: usize| {
        colour.get(from..from + 2).and_then(|digits| u8::from_str_radix(digits, 16).ok()).unwrap_or(0)
    };
    RGBColor(part(1), part(3), part(5))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chart() -> Chart {
        Chart::new(Page { x: 10.0, y: 20.0 }, [100.0, 50.0], [0.0, 2.0], [-1.0, 1.0])
    }

    #[test]
    fn values_find_their_place() {
        let chart = chart();
        assert_eq!(chart.at(0.0, -1.0), Page { x: 10.0, y: 70.0 });
        assert_eq!(chart.at(1.0, 1.0), Page { x: 60.0, y: 20.0 });
        let decades = Chart::new(Page { x: 0.0, y: 0.0 }, [100.0, 50.0], [1.0, 100.0], [0.0, 1.0])
            .scales(Scale::Logarithmic, Scale::Linear);
        assert_eq!(decades.at(10.0, 0.0), Page { x: 50.0, y: 50.0 });
    }

    #[test]
    fn what_is_drawn_lies_where_values_have_their_place() {
        let mut chart = chart();
        chart.line("up", "#5b7bb0", [(0.0, -1.0), (0.001, -1.0), (1.0, 0.0), (2.0, 1.0)]);
        let mut picture = Picture::new(200.0, 100.0, "", "");
        chart.draw(&mut picture, "a < b", "s");
        let text = picture.text_of();
        // the corner of the chart is at 70, 24 of what plotters drew, ten of its pixels to one, which are whole
        assert!(text.contains(r#"<svg x="-60.0" y="-4.0""#), "{text}");
        assert!(text.contains(r##"stroke="#5B7BB0" stroke-width="17" points="700,7"##), "{text}");
        assert!(text.contains("a &lt; b") && text.contains(">up<") && text.contains("−1"), "{text}");
        assert_eq!(text.matches("</svg>").count(), 1, "{text}");
    }

    #[test]
    fn numbers_are_short() {
        assert_eq!([0.1 + 0.2, -0.25, -0.0, 1e4].map(number), ["0.3", "−0.25", "0", "10000"]);
    }
}
