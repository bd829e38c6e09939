//! Planar velocities that a Lagrangian has in axes of their own, in the axes of the quasi-velocities.
//!
//! A trailer behind a trailer is often written by its velocities along its own axis and across it. Such a pair of forms
//!
//! `u₁ = cos a x + sin a y + …`, `u₂ = −sin a x + cos a y + …`
//!
//! enters the Lagrangian as μ/2 (u₁² + u₂²), in which it may be turned by −a. Then all points are in the same axes, and
//! what one of them has beyond its neighbour can be seen.

use super::planar_points::{Square, axes};
use super::velocity_forms::VelocityForms;
use crate::algebra::{Function, Graph, Node};
use crate::id::{ExprId, SymbolId};

/// Forms with more operations than this are not looked at: as those of bodies in space have.
const LONGEST: u64 = 160;

impl VelocityForms {
    /// Turns pairs of forms in axes of their own back, among the forms and among the squares of them.
    pub(super) fn turn_back(&mut self, graph: &mut Graph, velocities: &[SymbolId], squares: &mut [Square]) {
        let mut own = own_axes(graph, squares);
        for k in &own {
            for entry in &mut squares[*k].2 {
                *entry = graph.nested_products_to_sums(*entry);
            }
        }
        while let Some(k) = own.pop() {
            let alike = own.iter().enumerate().filter(|(_, l)| squares[**l].1 == squares[k].1);
            let places: Vec<(usize, usize)> = alike.map(|(place, l)| (place, *l)).collect();
            let found = places.into_iter().rev().find_map(|(place, l)| {
                turn(graph, &squares[l].2, &squares[k].2).map(|turned| (place, l, turned))
            });
            let Some((place, l, (axes, angle))) = found else { continue };
            own.remove(place);
            let mut back = components(graph, (axes, angle), [&squares[l].2, &squares[k].2]);
            if axes[0] > axes[1] {
                back.swap(0, 1);
            }
            for (square, coefficients) in [l, k].into_iter().zip(back) {
                let terms: Vec<ExprId> = velocities
                    .iter()
                    .zip(&coefficients)
                    .map(|(velocity, entry)| {
                        let velocity = graph.symbol(*velocity);
                        graph.formula(*entry * velocity)
                    })
                    .collect();
                self.forms[squares[square].0].1 = graph.sum(&terms);
                squares[square].2 = coefficients;
            }
        }
    }
}

/// The squares that have no axes with any other of the same μ, which is there.
fn own_axes(graph: &Graph, squares: &[Square]) -> Vec<usize> {
    let alike = |k: usize| (0..squares.len()).filter(move |l| *l != k && squares[*l].1 == squares[k].1);
    let together = |k: usize, l: usize| axes(graph, &squares[k.min(l)].2, &squares[k.max(l)].2).is_some();
    let is_short = |k: usize| graph.operation_count(&squares[k].2) <= LONGEST;
    let is_alone = |k: &usize| alike(*k).next().is_some() && !alike(*k).any(|l| together(*k, l));
    (0..squares.len()).filter(|k| is_alone(k) && is_short(*k)).collect()
}

/// The sections on which two forms are (cos a, −sin a) and (sin a, cos a), and a.
fn turn(graph: &mut Graph, first: &[ExprId], second: &[ExprId]) -> Option<([usize; 2], ExprId)> {
    for (x, (cos, minus)) in first.iter().zip(second).enumerate() {
        let Node::Apply(Function::Cos, angle) = *graph.node(*cos) else { continue };
        let (sin, opposite) = (graph.sin(angle), graph.formula(-*minus));
        let signed = if opposite == sin {
            angle
        } else if *minus == sin {
            graph.formula(-angle)
        } else {
            continue;
        };
        if let Some(y) = (0..first.len()).find(|y| first[*y] == opposite && second[*y] == *cos) {
            return Some(([x, y], signed));
        }
    }
    None
}

/// The coefficients of the forms turned by −a: 1 and 0 on their axes.
fn components(
    graph: &mut Graph,
    (axes, angle): ([usize; 2], ExprId),
    [first, second]: [&[ExprId]; 2],
) -> [Vec<ExprId>; 2] {
    let (sin, cos) = (graph.sin(angle), graph.cos(angle));
    let mut components = [Vec::new(), Vec::new()];
    for (section, (u, v)) in first.iter().zip(second).enumerate() {
        if axes.contains(&section) {
            for (axis, coefficients) in axes.iter().zip(&mut components) {
                coefficients.push(if *axis == section { graph.one() } else { graph.zero() });
            }
            continue;
        }
        let turned = [graph.formula(cos * *u - sin * *v), graph.formula(sin * *u + cos * *v)];
        for (coefficients, entry) in components.iter_mut().zip(turned) {
            coefficients.push(graph.nested_products_to_sums(entry));
        }
    }
    components
}
