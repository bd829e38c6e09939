//! The tables of the benchmark, in Markdown.

use crate::peers::{JACOBIAN, Measured, PEERS};
use crate::runner::OWN;

/// A system's measurements: by hand, the emitted `derivative`, with full Jacobians, with their entries that are not zero.
pub struct Row {
    /// The system.
    pub name: &'static str,
    /// Instructions per evaluation, where they could be counted.
    pub instructions: [Option<f64>; OWN.len()],
    /// Nanoseconds per evaluation.
    pub nanoseconds: [f64; OWN.len()],
}

/// Prints the table and the geometric means of its ratios.
pub fn print(rows: &[Row]) {
    println!(
        "| system | instructions: by hand | derivative | ratio | with jacobian | ratio | ns: by hand | derivative | ratio | with jacobian | ratio |"
    );
    println!("|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|");
    for row in rows {
        let [by_hand, derivative, jacobian, _] = row.instructions;
        let counted = cells(by_hand, derivative, jacobian, 0);
        let [by_hand, derivative, jacobian, _] = row.nanoseconds.map(Some);
        let timed = cells(by_hand, derivative, jacobian, 1);
        println!("| {} | {counted} | {timed} |", row.name);
    }
    let mean = |ratio: &dyn Fn(&Row) -> Option<f64>| cell(geometric_mean(rows.iter().map(ratio)), 2);
    let counted =
        |row: &Row, above: usize, below: usize| Some(row.instructions[above]? / row.instructions[below]?);
    let timed = |row: &Row, above: usize, below: usize| Some(row.nanoseconds[above] / row.nanoseconds[below]);
    println!(
        "| geometric mean | | | {} | | {} | | | {} | | {} |",
        mean(&|row| counted(row, 1, 0)),
        mean(&|row| counted(row, 2, 1)),
        mean(&|row| timed(row, 1, 0)),
        mean(&|row| timed(row, 2, 1)),
    );
}

/// Prints instructions, times and derivation times of the peers beside our own.
pub fn print_peers(rows: &[Row], peers: &[[Option<Measured>; PEERS.len()]]) {
    let names = PEERS.map(|(name, ..)| name).join(" | ");
    for (what, digits, own, of) in [
        (
            "instructions",
            0,
            (|row, which| row.instructions[which]) as fn(&Row, usize) -> Option<f64>,
            INSTRUCTIONS,
        ),
        ("ns", 1, |row, which| Some(row.nanoseconds[which]), |peer| Some(peer.nanoseconds)),
        ("ms to derive", 0, |_, _| None, |peer| Some(peer.derivation)),
    ] {
        println!("\n| {what} | derivative | with jacobian | {names} |\n|---|--:|--:|--:|--:|--:|--:|--:|");
        for (row, peers) in rows.iter().zip(peers) {
            let cells = peers.map(|peer| cell(peer.as_ref().and_then(of), digits)).join(" | ");
            let [derivative, jacobian] = [1, 2].map(|which| cell(own(row, which), digits));
            println!("| {} | {derivative} | {jacobian} | {cells} |", row.name);
        }
        print_ratios(rows, peers, own, of);
    }
}

/// Prints the ratio of the derivative, or for a peer that has Jacobians of the derivative with them, to each peer: its
/// geometric mean over the systems that the peer has, the worst, and how many these are and how many of them are above one.
fn print_ratios(
    rows: &[Row],
    peers: &[[Option<Measured>; PEERS.len()]],
    own: impl Fn(&Row, usize) -> Option<f64>,
    of: impl Fn(&Measured) -> Option<f64>,
) {
    let columns: [Vec<f64>; PEERS.len()] = std::array::from_fn(|place| {
        let which = if PEERS[place].2 == JACOBIAN { 2 } else { 1 };
        let ratio = |(row, peers): (&Row, &[Option<Measured>; PEERS.len()])| {
            Some(own(row, which)? / of(peers[place].as_ref()?)?)
        };
        rows.iter().zip(peers).filter_map(ratio).collect()
    });
    if columns.iter().all(Vec::is_empty) {
        return;
    }
    let line = |what: &str, text: &dyn Fn(&Vec<f64>) -> String| {
        println!("| {what} | | | {} |", columns.each_ref().map(text).join(" | "));
    };
    line("ours to theirs, geometric mean", &|ratios| {
        cell(geometric_mean(ratios.iter().copied().map(Some)), 2)
    });
    line("ours to theirs, worst", &|ratios| cell(ratios.iter().copied().reduce(f64::max), 2));
    line("ours more, of systems", &|ratios| {
        format!("{} of {}", ratios.iter().filter(|ratio| **ratio > 1.0).count(), ratios.len())
    });
}

/// Prints the derivative with the entries of its Jacobians that are not always zero, and with full matrices, beside the peer
/// that has the entries, and the means and the worst of the ratios.
pub fn print_jacobians(rows: &[Row], peers: &[[Option<Measured>; PEERS.len()]]) {
    let Some(place) = PEERS.iter().position(|(.., style)| *style == JACOBIAN) else { return };
    println!(
        "\n| instructions | {} | entries | ratio | matrices | ratio |\n|---|--:|--:|--:|--:|--:|",
        PEERS[place].0
    );
    let mut ratios: [Vec<f64>; 2] = Default::default();
    for (row, peers) in rows.iter().zip(peers) {
        let theirs = peers[place].as_ref().and_then(INSTRUCTIONS);
        let [_, _, full, entries] = row.instructions;
        let mut cells = Vec::new();
        for (ours, ratios) in [entries, full].into_iter().zip(&mut ratios) {
            let ratio = ours.zip(theirs).map(|(ours, theirs)| ours / theirs);
            ratios.extend(ratio);
            cells.extend([cell(ours, 0), cell(ratio, 2)]);
        }
        println!("| {} | {} | {} |", row.name, cell(theirs, 0), cells.join(" | "));
    }
    let [entries, full] = ratios.each_ref().map(|ratios| {
        let mean = geometric_mean(ratios.iter().copied().map(Some));
        [cell(mean, 2), cell(ratios.iter().copied().reduce(f64::max), 2)]
    });
    for (what, which) in [("geometric mean", 0), ("worst", 1)] {
        println!("| {what} | | | {} | | {} |", entries[which], full[which]);
    }
}

const INSTRUCTIONS: fn(&Measured) -> Option<f64> = |peer| peer.instructions;

/// Five cells: by hand, the derivative and its ratio to that, the Jacobian and its ratio to the derivative.
fn cells(by_hand: Option<f64>, derivative: Option<f64>, jacobian: Option<f64>, digits: usize) -> String {
    let ratio = |above: Option<f64>, below: Option<f64>| cell(above.zip(below).map(|(a, b)| a / b), 2);
    [
        cell(by_hand, digits),
        cell(derivative, digits),
        ratio(derivative, by_hand),
        cell(jacobian, digits),
        ratio(jacobian, derivative),
    ]
    .join(" | ")
}

/// A number, or a dash.
#[must_use]
pub fn cell(value: Option<f64>, digits: usize) -> String {
    value.map_or_else(|| "–".to_owned(), |value| format!("{value:.digits$}"))
}

/// The geometric mean, if every value is known.
pub fn geometric_mean(values: impl Iterator<Item = Option<f64>>) -> Option<f64> {
    let logarithms: Vec<f64> = values.map(|value| value.map(f64::ln)).collect::<Option<_>>()?;
    (!logarithms.is_empty()).then(|| (logarithms.iter().sum::<f64>() / logarithms.len() as f64).exp())
}
