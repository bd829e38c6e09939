//! Structure functions C^γ_{αβ}: the bracket of a Lie algebroid in a local basis of sections.

use crate::algebra::Graph;
use crate::id::{ExprId, Id, SectionId};

/// The functions of `[e_α, e_β] = C^γ_{αβ}(x) e_γ`.
///
/// Stored for α < β only, so that antisymmetry is in the type. For a moving frame on TQ they are
/// Hamel's transpositional symbols.
#[derive(Clone, Debug)]
pub struct StructureFunctions {
    rank: usize,
    /// The components of each bracket, pairs in lexicographic order. A bracket that is written as 0 has none:
    /// most are, where there are many sections.
    brackets: Vec<Vec<ExprId>>,
    /// Those of them that are not written as 0.
    terms: Vec<Vec<(SectionId, ExprId)>>,
}

impl StructureFunctions {
    /// All brackets zero.
    #[must_use]
    pub fn commuting(rank: usize) -> Self {
        let pairs = rank * rank.saturating_sub(1) / 2;
        Self { rank, brackets: vec![Vec::new(); pairs], terms: vec![Vec::new(); pairs] }
    }

    /// The rank of the bundle.
    #[must_use]
    pub fn rank(&self) -> usize {
        self.rank
    }

    /// The position of the pair α < β.
    fn position(&self, alpha: usize, beta: usize) -> usize {
        alpha * self.rank - alpha * (alpha + 1) / 2 + beta - alpha - 1
    }

    /// Sets `[e_α, e_β]`, and with it `[e_β, e_α]`. The bracket of a section with itself stays 0.
    pub fn set(&mut self, graph: &mut Graph, alpha: SectionId, beta: SectionId, components: Vec<ExprId>) {
        let (a, b) = (alpha.index(), beta.index());
        let is_zero = components.iter().all(|component| graph.is_literal_zero(*component));
        let components = if is_zero { Vec::new() } else { components };
        let (position, components) = match a.cmp(&b) {
            std::cmp::Ordering::Less => (self.position(a, b), components),
            std::cmp::Ordering::Equal => return,
            std::cmp::Ordering::Greater => {
                (self.position(b, a), components.into_iter().map(|c| graph.formula(-c)).collect())
            }
        };
        let terms =
            components.iter().enumerate().filter(|(_, component)| !graph.is_literal_zero(**component));
        self.terms[position] = terms.map(|(gamma, c)| (SectionId::from_index(gamma), *c)).collect();
        self.brackets[position] = components;
    }

    /// C^γ_{αβ}.
    pub fn get(&self, graph: &mut Graph, gamma: SectionId, alpha: SectionId, beta: SectionId) -> ExprId {
        let (a, b) = (alpha.index(), beta.index());
        match a.cmp(&b) {
            std::cmp::Ordering::Less => self.component(graph, self.position(a, b), gamma),
            std::cmp::Ordering::Equal => graph.zero(),
            std::cmp::Ordering::Greater => {
                let entry = self.component(graph, self.position(b, a), gamma);
                graph.formula(-entry)
            }
        }
    }

    fn component(&self, graph: &mut Graph, position: usize, gamma: SectionId) -> ExprId {
        self.brackets[position].get(gamma.index()).copied().unwrap_or_else(|| graph.zero())
    }

    /// The structure functions with every entry replaced by its image.
    #[must_use]
    pub fn mapped(&self, mut image: impl FnMut(ExprId) -> ExprId) -> Self {
        let brackets: Vec<Vec<ExprId>> =
            self.brackets.iter().map(|bracket| bracket.iter().map(|entry| image(*entry)).collect()).collect();
        let image_of =
            |(gamma, _): &(SectionId, ExprId), bracket: &Vec<ExprId>| (*gamma, bracket[gamma.index()]);
        let terms = self.terms.iter().zip(&brackets);
        let terms = terms.map(|(terms, bracket)| terms.iter().map(|term| image_of(term, bracket)).collect());
        Self { rank: self.rank, terms: terms.collect(), brackets }
    }

    /// The components that are not written as 0, with α < β: (α, β, γ, C^γ_{αβ}).
    pub fn terms(&self) -> impl Iterator<Item = (SectionId, SectionId, SectionId, ExprId)> + '_ {
        let pairs = (0..self.rank).flat_map(move |a| (a + 1..self.rank).map(move |b| (a, b)));
        pairs.zip(&self.terms).flat_map(|((a, b), terms)| {
            let (alpha, beta) = (SectionId::from_index(a), SectionId::from_index(b));
            terms.iter().map(move |(gamma, component)| (alpha, beta, *gamma, *component))
        })
    }

    /// The non-zero brackets with α < β.
    pub fn nonzero<'a>(
        &'a self,
        graph: &'a Graph,
    ) -> impl Iterator<Item = (SectionId, SectionId, &'a [ExprId])> + 'a {
        let pairs = (0..self.rank).flat_map(move |a| (a + 1..self.rank).map(move |b| (a, b)));
        pairs
            .zip(&self.brackets)
            .filter(|(_, components)| components.iter().any(|c| !graph.is_literal_zero(*c)))
            .map(|((a, b), components)| {
                (SectionId::from_index(a), SectionId::from_index(b), components.as_slice())
            })
    }

    /// `C^γ_{αβ} y^β p_γ` for each α: the bracket term of the Euler–Lagrange equations,
    /// mathematics (6), CLMM (2.7).
    pub fn bracket_term(&self, graph: &mut Graph, velocity: &[ExprId], momenta: &[ExprId]) -> Vec<ExprId> {
        let mut summands: Vec<Vec<ExprId>> = vec![Vec::new(); self.rank];
        for a in 0..self.rank {
            for b in a + 1..self.rank {
                let terms = &self.terms[self.position(a, b)];
                if terms.is_empty() {
                    continue;
                }
                let (components, along): (Vec<ExprId>, Vec<ExprId>) =
                    terms.iter().map(|(gamma, component)| (*component, momenta[gamma.index()])).unzip();
                let momentum = graph.inner_product(&components, &along);
                let first = graph.formula(momentum * velocity[b]);
                let second = graph.formula(momentum * velocity[a]);
                summands[a].push(first);
                summands[b].push(graph.formula(-second));
            }
        }
        summands.iter().map(|list| graph.sum(list)).collect()
    }

    /// `[σ, τ]^γ` without the derivative terms: `C^γ_{αβ} σ^α τ^β`.
    pub fn contract(&self, graph: &mut Graph, sigma: &[ExprId], tau: &[ExprId]) -> Vec<ExprId> {
        let mut summands: Vec<Vec<ExprId>> = vec![Vec::new(); self.rank];
        for a in 0..self.rank {
            for b in a + 1..self.rank {
                let terms = &self.terms[self.position(a, b)];
                if terms.is_empty() {
                    continue;
                }
                let (st, ts) = (graph.formula(sigma[a] * tau[b]), graph.formula(sigma[b] * tau[a]));
                let wedge = graph.formula(st - ts);
                for (gamma, component) in terms {
                    summands[gamma.index()].push(graph.formula(component * wedge));
                }
            }
        }
        summands.iter().map(|list| graph.sum(list)).collect()
    }
}
