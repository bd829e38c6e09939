//! The equations that the minimum of Gauss's function solves, body by body, with what solved them.
//!
//! Where Z is least, `Σ Q_ij a_j + L_i + Σ c_ki f_k = f_i` for a carried acceleration a_i and `= 0` for a free one: f_i is the
//! force that carries it, and k runs over what it carries itself. With `a_i = Σ c_ip a_p + b_i` these are linear equations
//! for a and f, whose coefficients are those of the bodies. Differentiated where a and f are held, they say by how much
//! accelerations change, and no term of the whole chain is in them.

use super::gauss::{Acceleration, Found, GaussFunction};
use crate::algebra::Graph;
use crate::id::{ExprId, SymbolId};
use crate::mechanics::{Eliminated, Equations, Factors, Solved};

/// Q and L of the bodies themselves, before any has left.
pub(super) struct Balance {
    quadratic: Vec<((usize, usize), ExprId)>,
    linear: Vec<(usize, ExprId)>,
}

impl Balance {
    pub(super) fn of(graph: &mut Graph, gauss: &GaussFunction) -> Self {
        let quadratic = gauss.quadratic.iter().map(|(pair, all)| (*pair, all.of_the_body(graph))).collect();
        let linear = gauss.linear.iter().map(|(i, all)| (*i, all.of_the_body(graph))).collect();
        Self { quadratic, linear }
    }

    /// The accelerations that were found, as what solves these equations; `None` where one of them is no result of its
    /// own. `found` is in the order in which they left.
    pub(super) fn solved(
        &self,
        graph: &mut Graph,
        accelerations: &[Acceleration],
        found: Vec<Found>,
        values: &[ExprId],
    ) -> Option<Solved> {
        let count = values.len();
        // 1. what no unknown moves is known, and is not pushed
        let mut is_moved = vec![false; count];
        for (i, Found { by, pivot, .. }) in found.iter().rev().enumerate() {
            is_moved[i] = pivot.is_some() || by.iter().any(|(p, _)| is_moved[*p]);
        }
        let free: Vec<usize> =
            (0..count).filter(|i| matches!(accelerations[*i], Acceleration::Free)).collect();
        let unknowns: Vec<SymbolId> =
            free.iter().map(|i| graph.as_symbol(values[*i])).collect::<Option<_>>()?;
        // 2. accelerations and forces that are held
        let mut held: Vec<(SymbolId, ExprId)> = Vec::new();
        let mut hold = |graph: &mut Graph, value: ExprId| {
            let symbol = graph.new_symbol("");
            held.push((symbol, value));
            graph.symbol(symbol)
        };
        let mut a: Vec<ExprId> = values.to_vec();
        let mut motions = vec![graph.zero(); count];
        for i in (0..count).filter(|i| is_moved[*i]) {
            a[i] = match &accelerations[i] {
                Acceleration::Free => hold(graph, values[i]),
                Acceleration::Carried { by, bias } => {
                    let moved = by.iter().map(|(p, c)| graph.formula(c * a[*p]));
                    let moved: Vec<ExprId> = moved.chain([*bias]).collect();
                    motions[i] = graph.sum(&moved);
                    hold(graph, motions[i])
                }
            };
        }
        let mut forces: Vec<Vec<ExprId>> = vec![Vec::new(); count];
        for ((i, j), coefficient) in &self.quadratic {
            forces[*i].push(graph.formula(*coefficient * a[*j]));
            if i != j {
                forces[*j].push(graph.formula(*coefficient * a[*i]));
            }
        }
        for (i, push) in &self.linear {
            forces[*i].push(*push);
        }
        // 3. the residuals, in the order in which accelerations left
        let (mut of_forces, mut of_motions) = (Vec::with_capacity(count), Vec::with_capacity(count));
        let mut eliminated = Vec::with_capacity(count);
        for (place, Found { mut by, pivot, mut inertias, .. }) in (0..count).rev().zip(found) {
            if !is_moved[place] {
                continue;
            }
            let force = graph.sum(&forces[place]);
            of_forces.push(graph.formula(-force));
            of_motions.push(motions[place]);
            if let Acceleration::Carried { by, .. } = &accelerations[place] {
                let force = hold(graph, force);
                for (p, c) in by {
                    forces[*p].push(graph.formula(c * force));
                }
            }
            by.retain(|(p, _)| is_moved[*p]);
            inertias.retain(|(p, _)| is_moved[*p]);
            let unknown = free.iter().position(|other| *other == place).zip(pivot);
            eliminated.push(Eliminated { place, by, inertias, unknown });
        }
        let residuals = of_forces.into_iter().chain(of_motions).collect();
        let equations = Equations::Balance { held, residuals };
        Some(Solved { unknowns, equations, factors: Factors::OneByOne(eliminated) })
    }
}
