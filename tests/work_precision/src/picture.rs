//! The picture: error against cost, a line for each method of each variant.

use std::fmt::Write;

use crate::study::Outcome;

const COLOURS: [&str; 10] = [
    "#1b6ca8", "#c8553d", "#3a7d44", "#8e5aa8", "#b8860b", "#2a9d8f", "#7a4b2a", "#d1495b", "#4b5d67",
    "#6b8e23",
];
/// The panel: left, top, width, height.
const PANEL: [f64; 4] = [70.0, 40.0, 520.0, 400.0];

/// The whole picture.
pub(crate) fn draw(name: &str, outcomes: &[Outcome]) -> String {
    let counted = outcomes.iter().all(|outcome| outcome.instructions.is_some());
    #[allow(clippy::cast_precision_loss)] // counts below 2^53
    let cost = |outcome: &Outcome| match outcome.instructions {
        Some(count) if counted => count as f64,
        _ => outcome.seconds * 1e6,
    };
    let shown: Vec<&Outcome> =
        outcomes.iter().filter(|outcome| (1e-16..10.0).contains(&outcome.error)).collect();
    let horizontal = Axis::over(shown.iter().map(|outcome| outcome.error));
    let vertical = Axis::over(shown.iter().map(|outcome| cost(outcome)));
    let [left, top, width, height] = PANEL;
    // the most accurate on the right
    let x = |error: f64| left + width * (1.0 - horizontal.part(error));
    let y = |cost: f64| top + height * (1.0 - vertical.part(cost));
    let mut svg = String::from(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 800 500\" font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect width=\"800\" height=\"500\" fill=\"#ffffff\"/>\n",
    );
    let unit = if counted { "instructions" } else { "time, microseconds" };
    let _ = writeln!(
        svg,
        "<text x=\"{left}\" y=\"24\" font-size=\"15\">{name}: {unit} against the error at the end</text>"
    );
    draw_decades(&mut svg, &horizontal, &vertical, &x, &y);
    let mut variants: Vec<&str> = Vec::new();
    let mut methods: Vec<&str> = Vec::new();
    let mut lines: Vec<(&str, &str)> = Vec::new();
    for outcome in &shown {
        let line = (outcome.variant.as_str(), outcome.method);
        if !lines.contains(&line) {
            lines.push(line);
        }
        if !variants.contains(&line.0) {
            variants.push(line.0);
        }
        if !methods.contains(&line.1) {
            methods.push(line.1);
        }
    }
    let at = |list: &[&str], name: &str| list.iter().position(|known| *known == name).unwrap_or(0);
    let colour = |method: &str| COLOURS[at(&methods, method) % COLOURS.len()];
    let style = |variant: &str, colour: &str| {
        let dashes = ["", "6 3", "2 3", "8 3 2 3"][at(&variants, variant) % 4];
        format!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.8\" stroke-dasharray=\"{dashes}\"")
    };
    // where each method's first line ends, from the top down
    let mut ends: Vec<(f64, f64, &str)> = Vec::new();
    for (variant, method) in lines {
        let of_line = shown.iter().filter(|o| o.variant == variant && o.method == method);
        let points: Vec<(f64, f64)> = of_line.map(|o| (x(o.error), y(cost(o)))).collect();
        let mut written = String::new();
        for (x, y) in &points {
            let _ = write!(written, "{x:.1},{y:.1} ");
        }
        let _ = writeln!(svg, "<polyline points=\"{written}\" {}/>", style(variant, colour(method)));
        let end = points.into_iter().max_by(|a, b| a.0.total_cmp(&b.0));
        if let (Some((x, y)), false) = (end, ends.iter().any(|(_, _, known)| *known == method)) {
            ends.push((y, x, method));
        }
    }
    label_ends(&mut svg, ends, &colour);
    // what the styles mean, where no line comes
    for (index, variant) in (0_u32..).zip(&variants) {
        let row = top + 18.0 + 16.0 * f64::from(index);
        let (from, to) = (left + 14.0, left + 44.0);
        let style = style(variant, "#4b5d67");
        let _ = writeln!(
            svg,
            "<line x1=\"{from}\" y1=\"{row}\" x2=\"{to}\" y2=\"{row}\" {style}/>\
             <text x=\"{}\" y=\"{}\">{variant}</text>",
            to + 6.0,
            row + 4.0
        );
    }
    let _ = writeln!(
        svg,
        "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">error at the end</text>\n</svg>",
        left + width / 2.0,
        top + height + 42.0
    );
    svg
}

/// The lines of the decades with their numbers.
fn draw_decades(
    svg: &mut String,
    horizontal: &Axis,
    vertical: &Axis,
    x: &impl Fn(f64) -> f64,
    y: &impl Fn(f64) -> f64,
) {
    let [left, top, width, height] = PANEL;
    for decade in horizontal.decades() {
        let (at, bottom) = (x(10.0_f64.powi(decade)), top + height);
        let _ = writeln!(
            svg,
            "<line x1=\"{at:.1}\" y1=\"{top}\" x2=\"{at:.1}\" y2=\"{bottom}\" stroke=\"#e3e3e3\"/>\
             <text x=\"{at:.1}\" y=\"{}\" text-anchor=\"middle\">1e{decade}</text>",
            bottom + 18.0
        );
    }
    for decade in vertical.decades() {
        let (at, right) = (y(10.0_f64.powi(decade)), left + width);
        let _ = writeln!(
            svg,
            "<line x1=\"{left}\" y1=\"{at:.1}\" x2=\"{right}\" y2=\"{at:.1}\" stroke=\"#e3e3e3\"/>\
             <text x=\"{}\" y=\"{:.1}\" text-anchor=\"end\">1e{decade}</text>",
            left - 8.0,
            at + 4.0
        );
    }
}

/// Names the methods beside the ends of their lines, one below the other.
fn label_ends(svg: &mut String, mut ends: Vec<(f64, f64, &str)>, colour: &impl Fn(&str) -> &'static str) {
    let [left, top, width, _] = PANEL;
    ends.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut row = top;
    for (y, x, method) in ends {
        row = y.max(row + 15.0);
        let (colour, beside) = (colour(method), left + width + 16.0);
        let _ = writeln!(
            svg,
            "<path d=\"M{x:.1} {y:.1}L{:.1} {row:.1}\" stroke=\"{colour}\" stroke-width=\"0.6\" opacity=\"0.6\"/>\
             <text x=\"{beside}\" y=\"{:.1}\" fill=\"{colour}\">{method}</text>",
            beside - 4.0,
            row + 4.0
        );
    }
}

/// A logarithmic axis over whole decades.
struct Axis {
    from: i32,
    to: i32,
}

impl Axis {
    #[allow(clippy::cast_possible_truncation)] // exponents of doubles
    fn over(values: impl Iterator<Item = f64>) -> Self {
        let logs: Vec<f64> = values.map(f64::log10).filter(|log| log.is_finite()).collect();
        let least = logs.iter().copied().fold(f64::INFINITY, f64::min);
        let largest = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        if least > largest {
            return Self { from: 0, to: 1 };
        }
        let (from, to) = (least.floor() as i32, largest.ceil() as i32);
        Self { from, to: to.max(from + 1) }
    }

    /// Where a value is between the ends.
    fn part(&self, value: f64) -> f64 {
        (value.log10() - f64::from(self.from)) / f64::from(self.to - self.from)
    }

    /// The decades with a line.
    fn decades(&self) -> impl Iterator<Item = i32> + use<> {
        let step = if self.to - self.from > 10 { 2 } else { 1 };
        (self.from..=self.to).filter(move |decade| decade % step == 0)
    }
}
