//! The picture: cost against correct digits, a panel for each family of methods, a colour for each method, a style for
//! each variant. Axes and lines are drawn by plotters.

use plotters::coord::Shift;
use plotters::prelude::*;

use crate::study::Outcome;

/// The panels, and whom they show; methods that are in none have one of their own.
const FAMILIES: [(&str, &[&str]); 3] = [
    ("explicit, up to order 5", &["Rk4", "Bs23", "Dopri5", "Tsit5"]),
    ("explicit, of high order", &["Dop853", "Vern9", "Taylor"]),
    ("implicit", &["GaussLegendre6", "Radau5", "Rodas5P"]),
];
/// Apart in hue and in lightness; a panel begins with the first.
const COLOURS: [RGBColor; 5] = [
    RGBColor(33, 89, 158),
    RGBColor(214, 96, 36),
    RGBColor(46, 125, 72),
    RGBColor(150, 60, 140),
    RGBColor(90, 90, 90),
];
const INK: RGBColor = RGBColor(34, 38, 46);
const MUTED: RGBColor = RGBColor(107, 114, 128);
const FAINT: RGBColor = RGBColor(228, 226, 220);
const FONTS: &str = "Helvetica, Arial, 'DejaVu Sans', sans-serif";

/// Plotters counts whole pixels, of which there are this many in one of the page.
const FINE: i32 = 10;
/// A panel with room on its right for names, the numbers on the left, and what stands above and below the panels.
const PANEL: [i32; 2] = [330, 400];
const LEFT: i32 = 60;
const ABOVE: i32 = 80;

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Drawn = Result<(), DrawingAreaErrorKind<std::io::Error>>;

/// The runs of one method on one variant that pay: no other of them is both cheaper and more accurate.
struct Line {
    variant: usize,
    method: &'static str,
    /// Correct digits and the cost, from the least accurate on.
    points: Vec<(f64, f64)>,
}

/// The whole picture.
///
/// # Errors
/// If plotters cannot draw it.
pub(crate) fn draw(name: &str, outcomes: &[Outcome]) -> std::io::Result<String> {
    let mut text = String::new();
    draw_into(&mut text, name, outcomes).map_err(std::io::Error::other)?;
    // the same picture in pixels of the page
    let [width, height] = [0, 1].map(|side| whole(outcomes)[side] * FINE);
    let (fine, page) = (
        format!(r#"<svg width="{width}" height="{height}""#),
        format!(r#"<svg width="{}" height="{}" stroke-linejoin="round""#, width / FINE, height / FINE),
    );
    Ok(text.replacen(&fine, &page, 1))
}

/// The panels that have something to show.
fn panels(outcomes: &[Outcome]) -> Vec<(&'static str, Vec<&'static str>)> {
    let mut panels: Vec<_> = FAMILIES.iter().map(|(family, _)| (*family, Vec::new())).collect();
    panels.push(("others", Vec::new()));
    for Outcome { method, .. } in outcomes {
        let family = FAMILIES.iter().position(|(_, methods)| methods.contains(method));
        let members = &mut panels[family.unwrap_or(FAMILIES.len())].1;
        if !members.contains(method) {
            members.push(*method);
        }
    }
    panels.retain(|(_, methods)| !methods.is_empty());
    panels
}

/// Width and height of the page.
fn whole(outcomes: &[Outcome]) -> [i32; 2] {
    let count = i32::try_from(panels(outcomes).len()).unwrap_or(1).max(1);
    [LEFT + count * PANEL[0], ABOVE + PANEL[1]]
}

fn draw_into(text: &mut String, name: &str, outcomes: &[Outcome]) -> Drawn {
    let [width, height] = whole(outcomes).map(|side| (side * FINE).unsigned_abs());
    let root = SVGBackend::with_string(text, (width, height)).into_drawing_area();
    root.fill(&WHITE)?;
    let counted = outcomes.iter().all(|outcome| outcome.instructions.is_some());
    let cost = if counted { "instructions" } else { "microseconds" };
    write(&root, [LEFT, 30], &format!("{name}: {cost} for correct digits at the end"), 16, INK)?;
    let below = "Settings that cost more than another and give less are left out.";
    write(&root, [LEFT, 50], below, 12, MUTED)?;
    let mut variants: Vec<&str> = Vec::new();
    for outcome in outcomes {
        if !variants.contains(&outcome.variant.as_str()) {
            variants.push(&outcome.variant);
        }
    }
    let mut across = LEFT + 420;
    for (index, variant) in variants.iter().enumerate() {
        let sample = [(across, 46), (across + 36, 46)].map(|(x, y)| (x * FINE, y * FINE));
        for dash in dashes(&sample.map(|(x, y)| (f64::from(x), f64::from(y))), index) {
            root.draw(&PathElement::new(dash, stroke(INK, index)))?;
        }
        write(&root, [across + 42, 50], variant, 12, INK)?;
        across += 62 + 7 * i32::try_from(variant.len()).unwrap_or(0);
    }
    let lines: Vec<Line> = panels(outcomes)
        .iter()
        .flat_map(|(_, methods)| methods.iter())
        .flat_map(|method| {
            variants.iter().enumerate().map(move |(index, variant)| (*method, index, *variant))
        })
        .map(|(method, index, variant)| Line {
            variant: index,
            method,
            points: those_that_pay(
                outcomes.iter().filter(|o| o.method == method && o.variant == variant),
                counted,
            ),
        })
        .collect();
    let costs = || lines.iter().flat_map(|line| line.points.iter().map(|(_, cost)| *cost));
    let decade = |value: f64| 10.0_f64.powf(value);
    let least = decade(costs().fold(f64::INFINITY, f64::min).max(1e-3).log10().floor());
    let most = decade(costs().fold(10.0 * least, f64::max).log10().ceil());
    for (index, (family, methods)) in (0_i32..).zip(panels(outcomes)) {
        let corner = [LEFT + index * PANEL[0], ABOVE];
        panel(&root, corner, index == 0, family, [least, most], &methods, &lines)?;
    }
    root.present()
}

/// One family: axes, lines, and the names beside the ends of the first variant's lines.
fn panel(
    root: &Area,
    [left, top]: [i32; 2],
    first: bool,
    family: &str,
    [least, most]: [f64; 2],
    methods: &[&'static str],
    lines: &[Line],
) -> Drawn {
    let numbers = if first { LEFT } else { 0 };
    let area = root
        .clone()
        .shrink(((left - numbers) * FINE, top * FINE), ((PANEL[0] + numbers) * FINE, PANEL[1] * FINE));
    let mut chart = ChartBuilder::on(&area)
        .margin_top(20 * FINE)
        .margin_right(100 * FINE)
        .x_label_area_size(45 * FINE)
        .y_label_area_size(numbers * FINE)
        .build_cartesian_2d(0.0..16.0, (least..most).log_scale())?;
    let style = (FONTS, f64::from(12 * FINE) * 1.24).into_font().color(&MUTED);
    chart
        .configure_mesh()
        .max_light_lines(0)
        .bold_line_style(FAINT.stroke_width(10))
        .axis_style(FAINT.stroke_width(10))
        .set_all_tick_mark_size(4 * FINE)
        .x_labels(9)
        .x_label_formatter(&|digits| format!("{digits}"))
        .y_label_formatter(&|cost| short(*cost))
        .label_style(style)
        .draw()?;
    write(root, [left + 4, top + 12], family, 13, INK)?;
    write(root, [left + 70, top + PANEL[1] - 8], "correct digits", 12, MUTED)?;
    let mut ends: Vec<(i32, i32, &str, RGBColor)> = Vec::new();
    for (method, colour) in methods.iter().zip(COLOURS.iter().cycle()) {
        for line in lines.iter().filter(|line| line.method == *method) {
            let points: Vec<(f64, f64)> = line
                .points
                .iter()
                .map(|point| chart.backend_coord(point))
                .map(|(x, y)| (f64::from(x), f64::from(y)))
                .collect();
            for dash in dashes(&points, line.variant) {
                root.draw(&PathElement::new(dash, stroke(*colour, line.variant)))?;
            }
            let named = ends.iter().any(|(_, _, known, _)| known == method);
            if let (Some(last), false) = (line.points.last(), named) {
                let (x, y) = chart.backend_coord(last);
                ends.push((y / FINE, x / FINE, method, *colour));
            }
        }
    }
    ends.sort_unstable_by_key(|(y, ..)| *y);
    let mut row = top;
    for (y, x, method, colour) in ends {
        row = y.max(row + 14);
        write(root, [x + 6, row + 4], method, 12, colour)?;
    }
    Ok(())
}

/// From the least accurate on, what is cheaper than everything that is more accurate.
fn those_that_pay<'a>(outcomes: impl Iterator<Item = &'a Outcome>, counted: bool) -> Vec<(f64, f64)> {
    #[allow(clippy::cast_precision_loss)] // counts below 2^53
    let cost = |outcome: &Outcome| match outcome.instructions {
        Some(count) if counted => count as f64,
        _ => outcome.seconds * 1e6,
    };
    let mut all: Vec<(f64, f64)> = outcomes
        .filter(|outcome| (1e-16..1.0).contains(&outcome.error))
        .map(|outcome| (-outcome.error.log10(), cost(outcome)))
        .collect();
    all.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.total_cmp(&b.1)));
    let mut least = f64::INFINITY;
    all.retain(|(_, cost)| {
        let pays = *cost < least;
        least = least.min(*cost);
        pays
    });
    all.reverse();
    all
}

/// The pieces of a line in the style of a variant: whole, dashed, dotted, dashed at length.
fn dashes(points: &[(f64, f64)], variant: usize) -> Vec<Vec<(i32, i32)>> {
    #[allow(clippy::cast_possible_truncation)] // pixels
    let whole = |(x, y): (f64, f64)| (x.round() as i32, y.round() as i32);
    let [on, off] = [[f64::INFINITY, 0.0], [70.0, 40.0], [15.0, 35.0], [140.0, 40.0]][variant % 4];
    let (mut pieces, mut piece) = (Vec::new(), Vec::new());
    let (mut drawing, mut left) = (true, on);
    for pair in points.windows(2) {
        let [(mut x, mut y), end] = [pair[0], pair[1]];
        loop {
            if drawing && piece.is_empty() {
                piece.push(whole((x, y)));
            }
            let far = (end.0 - x).hypot(end.1 - y);
            if far <= left {
                left -= far;
                break;
            }
            (x, y) = (x + (end.0 - x) * left / far, y + (end.1 - y) * left / far);
            if drawing {
                piece.push(whole((x, y)));
                pieces.push(std::mem::take(&mut piece));
            }
            drawing = !drawing;
            left = if drawing { on } else { off };
        }
        if drawing {
            piece.push(whole(end));
        }
    }
    pieces.push(piece);
    pieces.retain(|piece| piece.len() > 1);
    pieces
}

/// The stroke of a variant: the first is the widest.
fn stroke(colour: RGBColor, variant: usize) -> ShapeStyle {
    colour.stroke_width(if variant == 0 { 20 } else { 15 })
}

/// A count at the axis: `200`, `30k`, `4M`.
fn short(cost: f64) -> String {
    match cost {
        cost if cost >= 999_999.0 => format!("{:.0}M", cost / 1e6),
        cost if cost >= 999.0 => format!("{:.0}k", cost / 1e3),
        cost => format!("{}", (cost * 1e3).round() / 1e3),
    }
}

/// Writes a line of text whose foot begins at a point of the page.
fn write(root: &Area, [x, y]: [i32; 2], text: &str, size: i32, colour: RGBColor) -> Drawn {
    use plotters::style::text_anchor::{HPos, Pos, VPos};
    let style = (FONTS, f64::from(size * FINE) * 1.24)
        .into_text_style(root)
        .color(&colour)
        .pos(Pos::new(HPos::Left, VPos::Bottom));
    root.draw(&Text::new(text, (x * FINE, y * FINE), style))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn outcome(error: f64, instructions: u64) -> Outcome {
        Outcome {
            variant: "f64".to_owned(),
            method: "Rk4",
            setting: 0.1,
            error,
            steps: 1,
            evaluations: 4,
            seconds: 1e-6,
            instructions: Some(instructions),
        }
    }

    #[test]
    fn what_costs_more_and_gives_less_is_left_out() {
        let all = [outcome(1e-2, 100), outcome(1e-5, 90), outcome(1e-4, 200), outcome(f64::INFINITY, 1)];
        assert_eq!(those_that_pay(all.iter(), true), [(5.0, 90.0)]);
        let all = [outcome(1e-2, 100), outcome(1e-4, 200)];
        assert_eq!(those_that_pay(all.iter(), true), [(2.0, 100.0), (4.0, 200.0)]);
    }

    #[test]
    fn dashes_cover_their_share() {
        let line = [(0.0, 0.0), (100.0, 0.0), (220.0, 0.0)];
        assert_eq!(dashes(&line, 0), [[(0, 0), (100, 0), (220, 0)].to_vec()]);
        assert_eq!(dashes(&line, 1), [[(0, 0), (70, 0)].to_vec(), [(110, 0), (180, 0)].to_vec()]);
    }

    #[test]
    fn a_picture_names_methods_and_variants() {
        let text = draw("skate", &[outcome(1e-2, 100), outcome(1e-4, 20_000)]).expect("drawn");
        assert!(text.starts_with(r#"<svg width="390" height="480""#), "{text}");
        for word in ["skate: instructions", "Rk4", "f64", "10k", "explicit, up to order 5"] {
            assert!(text.contains(word), "{word}: {text}");
        }
    }
}
