//! What is drawn, as a list of numbers that a page reads from the front.

/// A colour of the page's palette, which is its own in light and dark.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colour {
    /// Ground, axes, what only helps the eye.
    Faint,
    /// Bodies.
    Body,
    /// Wheels, blades, contacts.
    Contact,
    /// What is behind: a track.
    Track,
    /// What is driven or pushed.
    Accent,
}

/// Lines and areas, in metres, with the part of the plane that should be seen.
///
/// Numbers: centre x, centre y, half the height to be seen; then figures, each a kind (0 line, 1 area, 2 circle, 3
/// disk), a colour, a width in pixels, a count of numbers, and that many numbers: x and y of each point, or x, y and radius.
#[derive(Clone, Debug)]
pub struct Scene {
    numbers: Vec<f32>,
}

impl Scene {
    /// An empty picture of the surroundings of a point.
    #[must_use]
    pub fn around(centre: [f64; 2], half_height: f64) -> Self {
        Self { numbers: vec![narrow(centre[0]), narrow(centre[1]), narrow(half_height)] }
    }

    /// A line through points.
    pub fn line(&mut self, colour: Colour, width: f64, points: &[[f64; 2]]) {
        self.figure(0.0, colour, width, points.iter().flatten().copied());
    }

    /// An area.
    pub fn area(&mut self, colour: Colour, points: &[[f64; 2]]) {
        self.figure(1.0, colour, 1.0, points.iter().flatten().copied());
    }

    /// A circle.
    pub fn circle(&mut self, colour: Colour, width: f64, [x, y]: [f64; 2], radius: f64) {
        self.figure(2.0, colour, width, [x, y, radius]);
    }

    /// A filled circle.
    pub fn disk(&mut self, colour: Colour, [x, y]: [f64; 2], radius: f64) {
        self.figure(3.0, colour, 1.0, [x, y, radius]);
    }

    /// A rectangle about a point, turned: half its length along, half its width across.
    pub fn block(&mut self, colour: Colour, at: [f64; 2], heading: f64, [along, across]: [f64; 2]) {
        let corners = [[along, across], [-along, across], [-along, -across], [along, -across]];
        self.area(colour, &corners.map(|corner| placed(at, heading, corner)));
    }

    /// Squares of the ground around what is seen, so that motion shows.
    pub fn ground(&mut self, around: [f64; 2], half: f64, mesh: f64) {
        let lines = (half / mesh).ceil();
        let nearest = around.map(|x| (x / mesh).round() * mesh);
        let mut offset = -lines;
        while offset <= lines {
            let (dx, reach) = (offset * mesh, lines * mesh);
            let [x, y] = nearest;
            self.line(Colour::Faint, 1.0, &[[x + dx, y - reach], [x + dx, y + reach]]);
            self.line(Colour::Faint, 1.0, &[[x - reach, y + dx], [x + reach, y + dx]]);
            offset += 1.0;
        }
    }

    /// The list.
    #[must_use]
    pub fn into_numbers(self) -> Vec<f32> {
        self.numbers
    }

    fn figure(&mut self, kind: f32, colour: Colour, width: f64, coordinates: impl IntoIterator<Item = f64>) {
        self.numbers.extend([kind, f32::from(colour as u8), narrow(width), 0.0]);
        let count = self.numbers.len() - 1;
        self.numbers.extend(coordinates.into_iter().map(narrow));
        let length = u16::try_from(self.numbers.len() - 1 - count).unwrap_or(u16::MAX);
        self.numbers[count] = f32::from(length);
    }
}

/// A point of a body that is at a place with a heading.
#[must_use]
pub fn placed([x, y]: [f64; 2], heading: f64, [along, across]: [f64; 2]) -> [f64; 2] {
    let (sin, cos) = heading.sin_cos();
    [x + along * cos - across * sin, y + along * sin + across * cos]
}

/// Pictures do with single precision.
#[allow(clippy::cast_possible_truncation)]
fn narrow(x: f64) -> f32 {
    x as f32
}
