//! Vectors and matrices of space, for what generated code is compared with.

/// Three components.
pub type Vector = [f64; 3];
/// Three rows.
pub type Square = [Vector; 3];

/// a × b.
#[must_use]
pub fn cross(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        a[j] * b[k] - a[k] * b[j]
    })
}

/// a + b.
#[must_use]
pub fn plus(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|i| a[i] + b[i])
}

/// a · b.
#[must_use]
pub fn dot(a: Vector, b: Vector) -> f64 {
    (0..3).map(|i| a[i] * b[i]).sum()
}

/// A u.
#[must_use]
pub fn image(a: &Square, u: Vector) -> Vector {
    std::array::from_fn(|i| dot(a[i], u))
}

/// A B.
#[must_use]
pub fn product(a: &Square, b: &Square) -> Square {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum()))
}

/// Aᵀ.
#[must_use]
pub fn transposed(a: &Square) -> Square {
    std::array::from_fn(|i| std::array::from_fn(|j| a[j][i]))
}
