//! The velocities and heights that a Lagrangian is written in, with their coefficients on quasi-velocities.

use crate::algebra::{Derivation, Graph, Matrix, Node, Rational, Substitution};
use crate::id::{ExprId, SymbolId};
use crate::mechanics::LagrangianSystem;
use crate::mechanics::velocity_forms::VelocityForms;

/// A function of the coordinates, a sum, that L contains times what only parameters determine: of a weight, say.
#[derive(Clone, Copy, Debug)]
pub(super) struct Height {
    /// What stands for it in F.
    pub(super) symbol: SymbolId,
    value: ExprId,
}

/// L = F(t, x, h, u).
pub(super) struct Written {
    pub(super) forms: VelocityForms,
    pub(super) heights: Vec<Height>,
    /// θ^k(e_α), then dh^j(e_α).
    pub(super) rows: Matrix,
}

impl Written {
    /// `None` where L is written in quasi-velocities alone.
    pub(super) fn of(graph: &mut Graph, system: &LagrangianSystem) -> Option<Self> {
        let algebroid = &system.algebroid;
        let mut forms = VelocityForms::of(graph, system);
        if forms.forms.iter().all(|(symbol, _)| algebroid.velocities.contains(symbol)) {
            return None;
        }
        let heights = heights(graph, system, &forms);
        let mut named = Substitution::new([]);
        for Height { symbol, value } in &heights {
            named.insert_node(*value, graph.symbol(*symbol));
        }
        forms.function = named.apply(graph, forms.function);
        let velocity = algebroid.velocity(graph);
        let mut along = algebroid.along(graph, &velocity, &system.clock);
        let changes = heights.iter().map(|height| along.apply(graph, height.value));
        let written: Vec<ExprId> = forms.forms.iter().map(|(_, form)| *form).collect();
        let written: Vec<ExprId> = written.into_iter().chain(changes).collect();
        let partials = algebroid.velocities.iter().map(|velocity| Derivation::partial(graph, *velocity));
        let columns: Matrix = partials
            .collect::<Vec<_>>()
            .iter_mut()
            .map(|partial| partial.apply_all(graph, &written))
            .collect();
        let rows = (0..written.len()).map(|k| columns.iter().map(|column| column[k]).collect()).collect();
        Some(Self { forms, heights, rows })
    }

    /// Puts in values of the velocities, by their places, and the heights.
    pub(super) fn values(&self, places: &[usize], velocities: &[ExprId]) -> Substitution {
        let symbols = self.forms.forms.iter().map(|(symbol, _)| *symbol);
        let values = symbols.zip(places.iter().map(|place| velocities[*place]));
        let heights = self.heights.iter().map(|height| (height.symbol, height.value));
        Substitution::new(values.chain(heights))
    }
}

fn heights(graph: &mut Graph, system: &LagrangianSystem, forms: &VelocityForms) -> Vec<Height> {
    let Node::Sum { terms, .. } = graph.node(forms.function).clone() else { return Vec::new() };
    let coordinates = &system.algebroid.anchor.coordinates;
    let mut moving: Vec<SymbolId> = forms.forms.iter().map(|(symbol, _)| *symbol).collect();
    moving.extend(&system.algebroid.velocities);
    moving.extend(system.clock.symbols());
    let mut found: Vec<Height> = Vec::new();
    for (term, _) in terms.iter() {
        let Node::Product { factors, .. } = graph.node(*term) else { continue };
        let varies = |(base, _): &&(ExprId, Rational)| {
            graph.depends_on(*base, coordinates) || graph.depends_on(*base, &moving)
        };
        let varying: Vec<&(ExprId, Rational)> = factors.iter().filter(varies).collect();
        let [(value, power)] = varying.as_slice() else { continue };
        let is_height = power.is_one()
            && matches!(graph.node(*value), Node::Sum { .. })
            && !graph.depends_on(*value, &moving);
        if is_height && found.iter().all(|height| height.value != *value) {
            let value = *value;
            found.push(Height { symbol: graph.new_symbol("height"), value });
        }
    }
    found
}

/// A row of numbers, without those that are 0.
pub(super) fn in_numbers(graph: &Graph, row: &[ExprId]) -> Option<Vec<(usize, Rational)>> {
    let mut found = Vec::new();
    for (section, entry) in row.iter().enumerate() {
        let number = graph.as_number(*entry)?;
        if !number.is_zero() {
            found.push((section, number.clone()));
        }
    }
    (!found.is_empty()).then_some(found)
}
