//! How measurements grow with the size of a family: exponents fitted to the larger members.

/// The measurements of one member.
pub(crate) struct Point {
    /// The family.
    pub(crate) family: &'static str,
    /// The number of bodies, or n of so(n).
    pub(crate) size: usize,
    /// Time of derivation, operations, instructions, time of LLVM.
    pub(crate) measured: [Option<f64>; 4],
}

/// Prints the exponents k of size^k for each family.
pub(crate) fn print(points: &[Point]) {
    println!(
        "\n| growth, n^k: k | from n | derivation | operations | instructions | LLVM |\n|---|--:|--:|--:|--:|--:|"
    );
    let mut families: Vec<&str> = points.iter().map(|point| point.family).collect();
    families.dedup();
    for family in families {
        let members: Vec<&Point> = points.iter().filter(|point| point.family == family).collect();
        let largest = members.iter().map(|point| point.size).max().unwrap_or(0);
        // the smallest are all overhead; of short families everything counts
        let from = if members.len() > 4 { largest / 3 } else { 0 };
        let upper: Vec<&Point> = members.into_iter().filter(|point| point.size >= from).collect();
        let exponents = [0, 1, 2, 3].map(|kind| {
            let of = |point: &&Point| Some(((point.size as f64).ln(), point.measured[kind]?.ln()));
            nh_bench::contest_table::cell(slope(&upper.iter().filter_map(of).collect::<Vec<_>>()), 2)
        });
        let first = upper.first().map_or(0, |point| point.size);
        println!("| {family} | {first} | {} |", exponents.join(" | "));
    }
}

/// The slope of the line nearest to the points in the sense of least squares.
fn slope(points: &[(f64, f64)]) -> Option<f64> {
    let count = points.len() as f64;
    let (x, y) = points.iter().fold((0.0, 0.0), |(x, y), point| (x + point.0 / count, y + point.1 / count));
    let covariance: f64 = points.iter().map(|point| (point.0 - x) * (point.1 - y)).sum();
    let variance: f64 = points.iter().map(|point| (point.0 - x).powi(2)).sum();
    (points.len() > 1).then(|| covariance / variance)
}
