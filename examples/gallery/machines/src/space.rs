//! Vectors of space and how they are seen in the picture.

pub type Vector = [f64; 3];

/// A view from above and aside, without perspective: the ground's x to the right, z up.
pub fn seen(point: Vector) -> [f64; 2] {
    seen_from([0.5, 0.5], point)
}

/// The same turned by an angle about the vertical, then looked at from another one above the ground.
pub fn seen_from([turn, above]: [f64; 2], [x, y, z]: Vector) -> [f64; 2] {
    let right = x * turn.cos() + y * turn.sin();
    let away = y * turn.cos() - x * turn.sin();
    [right, away * above.sin() + z * above.cos()]
}

pub fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The point of space at which a point of a body is, whose frame is given by the directions x, y, z of space as seen
/// from the body.
pub fn in_space(at: Vector, [x, y, z]: [Vector; 3], point: Vector) -> Vector {
    [at[0] + dot(x, point), at[1] + dot(y, point), at[2] + dot(z, point)]
}

/// The points of a curve over one turn.
pub fn turn(count: u32) -> impl Iterator<Item = f64> {
    (0..=count).map(move |k| std::f64::consts::TAU * f64::from(k) / f64::from(count))
}
