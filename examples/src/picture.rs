//! An SVG picture under construction.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

use crate::colour::{BACKGROUND, INK, MUTED};

/// The letters, by what machines have.
pub(crate) const FONTS: &str = "Helvetica, Arial, 'DejaVu Sans', sans-serif";

/// A point of the page: `x` to the right, `y` downwards, in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Page {
    /// To the right.
    pub x: f64,
    /// Downwards.
    pub y: f64,
}

/// A picture: SVG elements in the order in which they are drawn.
#[derive(Clone, Debug)]
pub struct Picture {
    width: f64,
    height: f64,
    elements: String,
}

impl Picture {
    /// An empty page with a title and a line below it.
    #[must_use]
    pub fn new(width: f64, height: f64, title: &str, subtitle: &str) -> Self {
        let mut picture = Self { width, height, elements: String::new() };
        picture.rectangle(Page { x: 0.0, y: 0.0 }, width, height, &format!(r#"fill="{BACKGROUND}""#));
        picture.text(
            Page { x: 36.0, y: 46.0 },
            title,
            &format!(r#"font-size="23" font-weight="600" fill="{INK}""#),
        );
        picture.text(Page { x: 36.0, y: 69.0 }, subtitle, &format!(r#"font-size="13.5" fill="{MUTED}""#));
        picture
    }

    /// A line through points, not filled. What is nearer to its predecessor than the eye can tell is
    /// left out.
    pub fn line(&mut self, points: &[Page], style: &str) {
        let [first, .., last] = points else { return };
        let mut kept = vec![*first];
        let mut latest = *first;
        for point in &points[1..points.len() - 1] {
            if (point.x - latest.x).hypot(point.y - latest.y) > 0.8 {
                kept.push(*point);
                latest = *point;
            }
        }
        kept.push(*last);
        self.path(&kept, "", &format!(r#"fill="none" {style}"#));
    }

    /// A closed line.
    pub fn polygon(&mut self, points: &[Page], style: &str) {
        self.path(points, "Z", style);
    }

    fn path(&mut self, points: &[Page], end: &str, style: &str) {
        let mut data = String::new();
        for (index, Page { x, y }) in points.iter().enumerate() {
            let command = if index == 0 { "M" } else { " " };
            let _ = write!(data, "{command}{x:.1},{y:.1}");
        }
        self.element(&format!(r#"<path d="{data}{end}" {style}/>"#));
    }

    /// A rectangle by its upper left corner.
    pub fn rectangle(&mut self, corner: Page, width: f64, height: f64, style: &str) {
        let Page { x, y } = corner;
        self.element(&format!(
            r#"<rect x="{x:.1}" y="{y:.1}" width="{width:.1}" height="{height:.1}" {style}/>"#
        ));
    }

    /// A circle.
    pub fn circle(&mut self, centre: Page, radius: f64, style: &str) {
        let Page { x, y } = centre;
        self.element(&format!(r#"<circle cx="{x:.1}" cy="{y:.1}" r="{radius:.1}" {style}/>"#));
    }

    /// A line of text that begins at a point, unless its style has another `text-anchor`.
    pub fn text(&mut self, at: Page, text: &str, style: &str) {
        let Page { x, y } = at;
        let text = text.replace('&', "&amp;").replace('<', "&lt;");
        self.element(&format!(r#"<text x="{x:.1}" y="{y:.1}" {style}>{text}</text>"#));
    }

    /// A closed line that moves for ever: its points around the origin, and where it is at equal intervals of
    /// time with its angle in degrees, clockwise on the page.
    pub fn moving(&mut self, shape: &[Page], poses: &[(Page, f64)], seconds: f64, style: &str) {
        let places: Vec<String> = poses.iter().map(|(Page { x, y }, _)| format!("{x:.1} {y:.1}")).collect();
        let angles: Vec<String> = poses.iter().map(|(_, angle)| format!("{angle:.1}")).collect();
        let turn = format!(r#"attributeName="transform" dur="{seconds}s" repeatCount="indefinite""#);
        self.element("<g>");
        self.element(&format!(
            r#"<animateTransform {turn} type="translate" values="{}"/>"#,
            places.join(";")
        ));
        let angles = angles.join(";");
        self.element(&format!(
            r#"<animateTransform {turn} type="rotate" additive="sum" values="{angles}"/>"#
        ));
        self.polygon(shape, style);
        self.element("</g>");
    }

    /// Puts a whole SVG document onto a part of the page.
    pub(crate) fn embed(&mut self, corner: Page, size: [f64; 2], document: &str) {
        let body = document.split_once('>').map_or("", |(_, body)| body).trim_end();
        let view = document.split_once("viewBox=").and_then(|(_, rest)| rest.split('"').nth(1)).unwrap_or("");
        let (Page { x, y }, [width, height]) = (corner, size);
        self.element(&format!(
            r#"<svg x="{x:.1}" y="{y:.1}" width="{width:.1}" height="{height:.1}" viewBox="{view}">{body}"#
        ));
    }

    /// What was drawn.
    #[cfg(test)]
    pub(crate) fn text_of(&self) -> &str {
        &self.elements
    }

    fn element(&mut self, element: &str) {
        self.elements.push_str(element);
        self.elements.push('\n');
    }

    /// Writes the picture to the path given on the command line, else to `target/pictures` of the
    /// workspace, and says where it is.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn save(&self, name: &str) -> io::Result<()> {
        let path = env::args_os().nth(1).map_or_else(|| default_path(name), PathBuf::from);
        if let Some(folder) = path.parent() {
            fs::create_dir_all(folder)?;
        }
        let Self { width, height, elements } = self;
        let text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" font-family=\"{FONTS}\" \
             stroke-linecap=\"round\" stroke-linejoin=\"round\">\n{elements}</svg>\n"
        );
        fs::write(&path, text)?;
        println!("\npicture: {}", path.display());
        Ok(())
    }
}

/// `target/pictures/<name>.svg` in the workspace if cargo runs the example, in the current
/// directory if not; relative to the current directory where that is shorter.
fn default_path(name: &str) -> PathBuf {
    let package = env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from);
    let workspace = package.as_deref().and_then(Path::parent).map(Path::to_path_buf).unwrap_or_default();
    let here = env::current_dir().unwrap_or_default();
    let root = workspace.strip_prefix(&here).map(Path::to_path_buf).unwrap_or(workspace);
    root.join("target").join("pictures").join(format!("{name}.svg"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_come_in_order_and_text_is_escaped() {
        let mut picture = Picture::new(10.0, 10.0, "a < b", "");
        picture.line(&[Page { x: 1.0, y: 2.0 }], "");
        picture.line(&[Page { x: 1.0, y: 2.0 }, Page { x: 3.04, y: -4.0 }], r#"stroke="red""#);
        assert!(picture.elements.contains("a &lt; b</text>"));
        assert!(picture.elements.ends_with("<path d=\"M1.0,2.0 3.0,-4.0\" fill=\"none\" stroke=\"red\"/>\n"));
    }
}
