//! Gauss's function of the accelerations, minimised by eliminating one after the other.
//!
//! Z = ½ Σ Q_ij a_i a_j + Σ L_i a_i over accelerations that are free, or carried by earlier ones,
//! a_i = Σ c_p a_p + b. The last one is eliminated first, a carried one by substitution and a free one where
//! ∂Z/∂a_i = 0: what is left for the earlier ones is the articulated inertia of all that they carry, mathematics (39).
//! The free ones are those of the mass matrix, so that pivots are its pivots.

use crate::algebra::{Graph, Node, Rational};
use crate::id::ExprId;
use crate::limits;
use crate::mechanics::Procedure;
use std::collections::BTreeMap;

/// An acceleration.
#[derive(Clone, Debug)]
pub(super) enum Acceleration {
    /// An unknown.
    Free,
    /// Σ c_p a_p + b, by earlier ones.
    Carried {
        /// p with c_p.
        by: Vec<(usize, ExprId)>,
        /// b.
        bias: ExprId,
    },
}

/// A coefficient of Z as the terms that it collects.
#[derive(Clone, Debug, Default)]
pub(super) struct Collected {
    /// Of the body itself, in which sines and cosines of one angle meet.
    own: Vec<ExprId>,
    /// Of what it carries, in terms of intermediate results.
    carried: Vec<ExprId>,
}

/// A coefficient, and whether it is of the body itself.
#[derive(Clone, Copy, Debug)]
struct Coefficient {
    value: ExprId,
    is_own: bool,
}

/// Z.
#[derive(Debug, Default)]
pub(super) struct GaussFunction {
    pub(super) quadratic: BTreeMap<(usize, usize), Collected>,
    pub(super) linear: BTreeMap<usize, Collected>,
}

/// How an eliminated acceleration follows from the earlier ones: Σ c_p a_p + b.
pub(super) struct Found {
    pub(super) by: Vec<(usize, ExprId)>,
    rest: ExprId,
    /// Q_ii, where it is free.
    pub(super) pivot: Option<ExprId>,
    /// Q_ij with j, where it is carried.
    pub(super) inertias: Vec<(usize, ExprId)>,
}

impl Collected {
    fn add(&mut self, graph: &Graph, value: ExprId, is_own: bool) {
        if !graph.is_literal_zero(value) {
            let list = if is_own { &mut self.own } else { &mut self.carried };
            list.push(value);
        }
    }

    pub(super) fn of_the_body(&self, graph: &mut Graph) -> ExprId {
        let own = graph.sum(&self.own);
        if self.own.len() > 1 { graph.simplify(own) } else { own }
    }

    /// The sum, as an intermediate result unless it is short; `None` where there is nothing.
    fn total(self, graph: &mut Graph, procedure: &mut Procedure, name: &str) -> Option<Coefficient> {
        let is_own = self.carried.is_empty();
        let own = self.of_the_body(graph);
        let carried = graph.sum(&self.carried);
        let value = graph.formula(own + carried);
        if graph.is_literal_zero(value) {
            return None;
        }
        let value = if is_own { value } else { named(graph, procedure, name, value) };
        Some(Coefficient { value, is_own })
    }
}

/// A sum as an intermediate result; products stay in place.
fn named(graph: &mut Graph, procedure: &mut Procedure, name: &str, value: ExprId) -> ExprId {
    match graph.node(value) {
        Node::Sum { .. } => procedure.define(graph, name, value),
        _ => value,
    }
}

/// Where Z is least.
pub(super) struct Minimum {
    /// All accelerations.
    pub(super) values: Vec<ExprId>,
    /// How they left, the last one first.
    pub(super) left: Vec<Found>,
}

impl GaussFunction {
    /// Adds a term of Q_ij, of a body itself.
    pub(super) fn couple(&mut self, graph: &Graph, i: usize, j: usize, value: ExprId) {
        self.quadratic.entry((i.min(j), i.max(j))).or_default().add(graph, value, true);
    }

    /// Adds a term of L_i.
    pub(super) fn push(&mut self, graph: &Graph, i: usize, value: ExprId) {
        self.linear.entry(i).or_default().add(graph, value, true);
    }

    fn add(&mut self, graph: &Graph, i: usize, j: usize, coefficient: Coefficient) {
        let Coefficient { value, is_own } = coefficient;
        self.quadratic.entry((i.min(j), i.max(j))).or_default().add(graph, value, is_own);
    }

    fn add_linear(&mut self, graph: &Graph, i: usize, coefficient: Coefficient) {
        self.linear.entry(i).or_default().add(graph, coefficient.value, coefficient.is_own);
    }

    /// All accelerations where Z is least, in order; `None` where Z does not determine one of them.
    pub(super) fn minimum(
        mut self,
        graph: &mut Graph,
        accelerations: &[Acceleration],
        procedure: &mut Procedure,
    ) -> Option<Minimum> {
        let mut found: Vec<Found> = Vec::with_capacity(accelerations.len());
        for (i, acceleration) in accelerations.iter().enumerate().rev() {
            found.push(match acceleration {
                Acceleration::Free => self.minimise(graph, i, procedure)?,
                Acceleration::Carried { by, bias } => self.substitute(graph, i, (by, *bias), procedure),
            });
        }
        let mut values: Vec<ExprId> = Vec::with_capacity(accelerations.len());
        for (i, Found { by, rest, .. }) in found.iter().rev().enumerate() {
            let mut terms: Vec<ExprId> = Vec::with_capacity(by.len() + 1);
            for (p, coefficient) in by {
                terms.push(graph.formula(coefficient * values[*p]));
            }
            terms.push(*rest);
            let value = graph.sum(&terms);
            let name = format!("acceleration{i}");
            values.push(match accelerations[i] {
                Acceleration::Free => procedure.define(graph, &name, value),
                Acceleration::Carried { .. } => named(graph, procedure, &name, value),
            });
        }
        Some(Minimum { values, left: found })
    }

    /// Takes out all coefficients of a_i: Q_ii, the others, L_i.
    fn taken(
        &mut self,
        graph: &mut Graph,
        i: usize,
        procedure: &mut Procedure,
    ) -> (Option<Coefficient>, Vec<(usize, Coefficient)>, Option<Coefficient>) {
        limits::spend(self.quadratic.len() / 64);
        let touching: Vec<(usize, usize)> =
            self.quadratic.keys().copied().filter(|(a, b)| *a == i || *b == i).collect();
        let (mut own, mut others) = (None, Vec::new());
        for (a, b) in touching {
            let Some(collected) = self.quadratic.remove(&(a, b)) else { continue };
            let Some(total) = collected.total(graph, procedure, &format!("inertia{a}_{b}")) else { continue };
            if a == b {
                own = Some(total);
            } else {
                others.push((a + b - i, total));
            }
        }
        let linear = self.linear.remove(&i);
        let linear = linear.and_then(|collected| collected.total(graph, procedure, &format!("force{i}")));
        (own, others, linear)
    }

    /// a_i = −(L_i + Σ Q_ij a_j) / Q_ii.
    fn minimise(&mut self, graph: &mut Graph, i: usize, procedure: &mut Procedure) -> Option<Found> {
        let (pivot, others, linear) = self.taken(graph, i, procedure);
        // a name for products, too: what is divided by is then recognised as a pivot of C
        let pivot = procedure.define(graph, &format!("pivot{i}"), pivot?.value);
        let zero = graph.zero();
        let linear = linear.map_or(zero, |linear| linear.value);
        let linear = named(graph, procedure, &format!("force{i}"), linear);
        let mut by: Vec<(usize, ExprId)> = Vec::with_capacity(others.len());
        let named_others: Vec<(usize, ExprId)> = others
            .iter()
            .map(|(j, coefficient)| {
                (*j, named(graph, procedure, &format!("inertia{j}_{i}"), coefficient.value))
            })
            .collect();
        for (j, coefficient) in &named_others {
            let share = graph.formula(-(coefficient / pivot));
            by.push((*j, procedure.define(graph, &format!("share{j}_{i}"), share)));
        }
        for (k, (j, share)) in by.iter().enumerate() {
            for (l, coefficient) in &named_others[k..] {
                let value = graph.formula(share * coefficient);
                self.add(graph, *j, *l, Coefficient { value, is_own: false });
            }
            let value = graph.formula(share * linear);
            self.add_linear(graph, *j, Coefficient { value, is_own: false });
        }
        let rest = graph.formula(-(linear / pivot));
        let rest = if graph.is_literal_zero(rest) {
            rest
        } else {
            procedure.define(graph, &format!("free{i}"), rest)
        };
        Some(Found { by, rest, pivot: Some(pivot), inertias: Vec::new() })
    }

    /// a_i = Σ c_p a_p + b put into Z.
    fn substitute(
        &mut self,
        graph: &mut Graph,
        i: usize,
        (by, bias): (&[(usize, ExprId)], ExprId),
        procedure: &mut Procedure,
    ) -> Found {
        let (own, others, linear) = self.taken(graph, i, procedure);
        // what is of the body itself stays in place, since much of it cancels: m c² sin² + m c² cos², d · ḋω
        let inertias = own.iter().map(|own| (i, own.value));
        let inertias = inertias.chain(others.iter().map(|(j, other)| (*j, other.value))).collect();
        let is_own =
            own.iter().chain(&linear).chain(others.iter().map(|(_, other)| other)).all(|found| found.is_own);
        let bias = if is_own { bias } else { procedure.define(graph, &format!("bias{i}"), bias) };
        let has_bias = !graph.is_literal_zero(bias);
        // 1. the terms of first order: L_i + Q_ii b
        let mut first = Collected::default();
        if let Some(linear) = linear {
            first.add(graph, linear.value, linear.is_own);
        }
        if let Some(own) = own
            && has_bias
        {
            let moved = graph.formula(own.value * bias);
            first.add(graph, moved, own.is_own);
        }
        if let Some(first) = first.total(graph, procedure, &format!("force{i}")) {
            for (p, c) in by {
                let value = graph.formula(c * first.value);
                self.add_linear(graph, *p, Coefficient { value, ..first });
            }
        }
        // 2. those of Q_ij a_i a_j
        for (j, Coefficient { value, is_own }) in &others {
            if has_bias {
                let value = graph.formula(value * bias);
                self.add_linear(graph, *j, Coefficient { value, is_own: *is_own });
            }
            for (p, c) in by {
                let twice = if p == j { Rational::from(2) } else { Rational::ONE };
                let value = graph.formula(value * c);
                let value = graph.scale(twice, value);
                self.add(graph, *j, *p, Coefficient { value, is_own: *is_own });
            }
        }
        // 3. those of ½ Q_ii a_i²
        if let Some(Coefficient { value, is_own }) = own {
            for (k, (p, c)) in by.iter().enumerate() {
                let scaled = graph.formula(c * value);
                let scaled = if is_own || graph.as_number(*c).is_some() {
                    scaled
                } else {
                    procedure.define(graph, &format!("inertia{p}_{i}"), scaled)
                };
                for (q, d) in &by[k..] {
                    let value = graph.formula(scaled * d);
                    self.add(graph, *p, *q, Coefficient { value, is_own });
                }
            }
        }
        Found { by: by.to_vec(), rest: bias, pivot: None, inertias }
    }
}
