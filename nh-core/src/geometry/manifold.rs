//! Points on a manifold: where claims that hold only there are tested.
//!
//! The base may be embedded (|γ| = 1, a rotation matrix), and the constraint manifold lies in E.
//! Both are parametrised rationally where possible, by a square root where need be, so that a
//! claim on the manifold becomes a claim about the parameters.

use super::common_zeros::vanish_together;
use super::solutions::{Ease, Solved, cayley, difference, quotient, root, sphere};
use crate::algebra::{Graph, Matrix, Node, Substitution, Verdict, Witness};
use crate::id::{ExprId, SymbolId};

/// A manifold, by symbols that are functions of the others.
#[derive(Clone, Debug, Default)]
pub struct Manifold {
    pub(super) images: Vec<(SymbolId, ExprId)>,
    /// The symbols in the images that are parameters of a chart.
    pub(super) chart: Vec<SymbolId>,
    /// A function of those that define it which vanishes elsewhere, too, as a product does: what holds on this manifold
    /// need not hold wherever the functions vanish.
    in_parts: Option<ExprId>,
    /// What square roots of images are taken of: the other root is as good as this one.
    radicands: Vec<ExprId>,
    /// A function that was solved by the root of a square, which is a function on one part of the manifold and another one on
    /// the other, and the symbols whose images may be others there.
    by_part: Option<(ExprId, Vec<SymbolId>)>,
    /// The other parts that were found, each as if it were the only one.
    pub(super) others: Vec<Manifold>,
}

impl Manifold {
    /// Everything: no symbol depends on another.
    #[must_use]
    pub fn whole() -> Self {
        Self::default()
    }

    /// Where symbols are these functions of others; an image may be the symbol itself.
    #[must_use]
    pub fn of_images(graph: &Graph, images: impl IntoIterator<Item = (SymbolId, ExprId)>) -> Self {
        let moved = |(symbol, image): &(SymbolId, ExprId)| graph.as_symbol(*image) != Some(*symbol);
        Self { images: images.into_iter().filter(moved).collect(), ..Self::default() }
    }

    /// Where all `functions` vanish, solved for some of the symbols `unknowns`. Functions that share none of these restrict
    /// different ones, and are solved apart: so each of several rotation matrices is recognised.
    ///
    /// # Errors
    /// The index of a function that could not be solved.
    pub fn where_zero(graph: &mut Graph, functions: &[ExprId], unknowns: &[SymbolId]) -> Result<Self, usize> {
        let groups = apart(graph, functions, unknowns);
        if groups.len() < 2 {
            return Self::where_all_zero(graph, functions, unknowns);
        }
        let mut manifold = Self::default();
        for group in groups {
            let of_group: Vec<ExprId> = group.iter().map(|index| functions[*index]).collect();
            let solved =
                Self::where_all_zero(graph, &of_group, unknowns).map_err(|position| group[position])?;
            manifold.extend(graph, &solved);
        }
        manifold.note_roots_of(graph, functions);
        Ok(manifold)
    }

    /// The same without looking for functions that share no unknown.
    fn where_all_zero(graph: &mut Graph, functions: &[ExprId], unknowns: &[SymbolId]) -> Result<Self, usize> {
        if let Some(rotations) = Self::rotations(graph, functions, unknowns) {
            return Ok(rotations);
        }
        // a sphere takes all its coordinates; where others restrict these as well they come first
        let orders = [[Ease::Sphere, Ease::Linear, Ease::Root], [Ease::Linear, Ease::Sphere, Ease::Root]];
        let solve = |graph: &mut Graph, start: &Self, moving: &[SymbolId]| {
            let first = start.solved_in_order(graph, functions, (unknowns, moving), orders[0]);
            first.or_else(|index| {
                start.solved_in_order(graph, functions, (unknowns, moving), orders[1]).map_err(|_| index)
            })
        };
        let solved_from = |graph: &mut Graph, start: &Self| {
            solve(graph, start, unknowns).or_else(|index| {
                let part = solve(graph, start, &[]);
                part.map(|part| Self { in_parts: Some(functions[index]), ..part })
            })
        };
        let mut manifold = solved_from(graph, &Self::default())?;
        manifold.complete_others(|start| solved_from(graph, start).ok());
        manifold.note_roots_of(graph, functions);
        Ok(manifold)
    }

    /// The same, by the easiest ways first, so that no root gets into what could be solved without.
    fn solved_in_order(
        &self,
        graph: &mut Graph,
        functions: &[ExprId],
        unknowns: (&[SymbolId], &[SymbolId]),
        order: [Ease; 3],
    ) -> Result<Self, usize> {
        let mut manifold = self.clone();
        let mut open: Vec<usize> = (0..functions.len()).collect();
        while !open.is_empty() {
            let restricted: Vec<(usize, ExprId)> =
                open.iter().map(|index| (*index, manifold.restrict(graph, functions[*index]))).collect();
            let solved = order.into_iter().find_map(|ease| {
                restricted.iter().find_map(|(index, function)| {
                    let holds = graph.zero_test(*function) == Verdict::Zero;
                    (holds || manifold.solve(graph, *function, unknowns, ease, &|_, _| true))
                        .then_some(*index)
                })
            });
            let solved = solved.ok_or(open[0])?;
            open.retain(|index| *index != solved);
        }
        Ok(manifold)
    }

    /// The intersection with a manifold that is solved for other symbols than this one, as functions
    /// of all the rest.
    pub fn extend(&mut self, graph: &mut Graph, other: &Self) {
        let mut both = Self::default();
        for part in self.parts() {
            for of_other in other.parts() {
                both.add_parts(&part.on(graph, of_other));
            }
        }
        let mut parts = both.others.into_iter();
        if let Some(first) = parts.next() {
            *self = Self { others: parts.collect(), ..first };
        }
    }

    /// The intersection of one part with one part.
    fn on(&self, graph: &mut Graph, other: &Self) -> Self {
        let mut both = self.alone();
        for (symbol, image) in &other.images {
            let image = both.restrict(graph, *image);
            both.insert(graph, *symbol, image);
        }
        both.chart.extend(&other.chart);
        both.in_parts = both.in_parts.or(other.in_parts);
        if let Some((function, _)) = both.by_part.as_ref().or(other.by_part.as_ref()) {
            let of_self = both.by_part.iter().flat_map(|(_, symbols)| symbols);
            let all = other.images.iter().map(|(symbol, _)| symbol);
            both.by_part = Some((*function, of_self.chain(all).copied().collect()));
        }
        let radicands: Vec<ExprId> =
            other.radicands.iter().map(|radicand| both.restrict(graph, *radicand)).collect();
        both.radicands.extend(radicands);
        both
    }

    /// The symbols that are functions of the others, with these.
    #[must_use]
    pub fn images(&self) -> &[(SymbolId, ExprId)] {
        &self.images
    }

    /// Whether a symbol is not a function of others.
    #[must_use]
    pub fn is_free(&self, symbol: SymbolId) -> bool {
        self.images.iter().all(|(solved, _)| *solved != symbol)
    }

    /// Whether a symbol is none of the parameters of a chart.
    #[must_use]
    pub(crate) fn is_outside_charts(&self, symbol: SymbolId) -> bool {
        !self.chart.contains(&symbol)
    }

    /// Whether nothing is restricted.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        self.images.is_empty()
    }

    /// The restriction of a function.
    pub fn restrict(&self, graph: &mut Graph, function: ExprId) -> ExprId {
        Substitution::new(self.images.iter().copied()).apply(graph, function)
    }

    /// The restriction of every entry of a matrix.
    pub fn restrict_matrix(&self, graph: &mut Graph, matrix: &[Vec<ExprId>]) -> Matrix {
        let mut substitution = Substitution::new(self.images.iter().copied());
        matrix.iter().map(|row| substitution.apply_all(graph, row)).collect()
    }

    /// The first rows of which all are combinations, at generic points of the manifold.
    ///
    /// # Errors
    /// The reason, where it cannot be decided.
    pub fn independent_rows(&self, graph: &mut Graph, matrix: &[Vec<ExprId>]) -> Result<Vec<usize>, String> {
        let restricted = self.restrict_matrix(graph, matrix);
        graph.independent_rows(&restricted)
    }

    /// One of some functions which has, by itself, a root that images have too: on another part of the manifold the image
    /// has the other root, and the function has not.
    pub(crate) fn with_a_root_of(&self, graph: &mut Graph, functions: &[ExprId]) -> Option<ExprId> {
        if self.radicands.is_empty() {
            return None;
        }
        let of_numbers = self.radicands.iter().any(|radicand| graph.symbols_in(&[*radicand]).is_empty());
        functions.iter().copied().find(|function| {
            // √3 has the other sign where the root of 3 has it
            (of_numbers && graph.has_irrational_numbers(*function))
                || graph.radicands(&[*function]).into_iter().any(|own| {
                    let own = self.restrict(graph, own);
                    self.radicands.iter().any(|radicand| {
                        let product = graph.formula(own * radicand);
                        graph.is_square_everywhere(product)
                    })
                })
        })
    }

    /// Takes note of functions that define it and have a root which images have too.
    pub(crate) fn note_roots_of(&mut self, graph: &mut Graph, functions: &[ExprId]) {
        self.in_parts = self.in_parts.or_else(|| self.with_a_root_of(graph, functions));
    }

    /// Whether a function vanishes on the manifold, and wherever the functions do that define it.
    pub fn zero_test(&self, graph: &mut Graph, function: ExprId) -> Verdict {
        let restricted = self.restrict(graph, function);
        let verdict = graph.zero_test(restricted);
        let is_one_part = self.in_parts.is_some() || self.by_part.is_some() || !self.radicands.is_empty();
        if !is_one_part || !verdict.is_zero() || graph.zero_test(function).is_zero() {
            return verdict;
        }
        let by_part = self.by_part.as_ref().filter(|(_, others)| graph.depends_on(function, others));
        if let Some(product) = self.in_parts.or(by_part.map(|(product, _)| *product)) {
            let product = graph.text_within(product, 200);
            return Verdict::Unknown(format!(
                "{product} = 0 holds in several ways, and it was asked in one of them"
            ));
        }
        match self.with_a_root_of(graph, &[function]) {
            None => verdict,
            Some(_) => Verdict::Unknown(
                "it contains a root of what the constraints are solved by a root of, and these may have the other sign"
                    .into(),
            ),
        }
    }

    /// The point of the manifold that belongs to values of the free symbols: the values of all
    /// `symbols`, or `None` where one is no real number.
    #[must_use]
    pub fn point(
        &self,
        graph: &Graph,
        witness: &Witness,
        symbols: &[SymbolId],
    ) -> Option<Vec<(SymbolId, f64)>> {
        let free =
            |symbol| witness.point.iter().find(|(known, _)| *known == symbol).map_or(f64::NAN, |(_, v)| *v);
        let value = |symbol: SymbolId| match self.images.iter().find(|(solved, _)| *solved == symbol) {
            Some((_, image)) => graph.evaluate(&[*image], free)[0].value,
            None => free(symbol),
        };
        let values: Vec<(SymbolId, f64)> = symbols.iter().map(|symbol| (*symbol, value(*symbol))).collect();
        values.iter().all(|(_, value)| value.is_finite()).then_some(values)
    }

    pub(super) fn insert(&mut self, graph: &mut Graph, symbol: SymbolId, image: ExprId) {
        let mut step = Substitution::new([(symbol, image)]);
        for (_, earlier) in &mut self.images {
            *earlier = step.apply(graph, *earlier);
        }
        for radicand in &mut self.radicands {
            *radicand = step.apply(graph, *radicand);
        }
        self.images.push((symbol, image));
    }

    /// Whether no image that has changed since `earlier` divides by what is 0 on the manifold.
    pub(super) fn is_defined(&self, graph: &Graph, earlier: &[(SymbolId, ExprId)]) -> bool {
        let changed = self.images.iter().zip(earlier).filter(|(now, before)| now != before);
        let images: Vec<ExprId> = changed.map(|((_, image), _)| *image).collect();
        let divisors = graph.reachable(&images).into_iter().flat_map(|id| match graph.node(id) {
            Node::Product { factors, .. } => {
                factors.iter().filter(|(_, exponent)| exponent.is_negative()).map(|(base, _)| *base).collect()
            }
            _ => Vec::new(),
        });
        divisors.into_iter().all(|divisor| !graph.zero_test(divisor).is_zero())
    }

    /// Solves one function for one unknown in one way; false if that is not possible, or if an image of
    /// another would divide by what is 0 then. A solution by a division or a root is taken if it is meant, and if it leaves
    /// out nothing that holds where `moving` symbols have other values.
    pub(super) fn solve(
        &mut self,
        graph: &mut Graph,
        function: ExprId,
        (unknowns, moving): (&[SymbolId], &[SymbolId]),
        ease: Ease,
        is_meant: &dyn Fn(&mut Graph, (SymbolId, ExprId)) -> bool,
    ) -> bool {
        let present: Vec<SymbolId> = graph
            .symbols_in(&[function])
            .into_iter()
            .filter(|symbol| unknowns.contains(symbol) && self.is_free(*symbol))
            .collect();
        let mut root_of = None;
        let mut by = |solution: fn(&mut Graph, ExprId, SymbolId) -> Option<Solved>| {
            let solved = present.iter().rev().find_map(|symbol| {
                let Solved { image, coefficients, other } = solution(graph, function, *symbol)?;
                let is_whole =
                    is_meant(graph, (*symbol, image)) && !vanish_together(graph, &coefficients, moving);
                is_whole.then(|| {
                    root_of = other;
                    (*symbol, image)
                })
            });
            solved.into_iter().collect()
        };
        let images: Vec<(SymbolId, ExprId)> = match ease {
            Ease::Number => by(difference),
            Ease::Linear => by(quotient),
            Ease::Root => by(root),
            Ease::Sphere => sphere(graph, function, &present).unwrap_or_default(),
        };
        if images.is_empty() {
            return false;
        }
        let before = self.clone();
        if matches!(ease, Ease::Sphere) {
            let values: Vec<ExprId> = images.iter().map(|(_, image)| *image).collect();
            self.chart.extend(graph.symbols_in(&values));
        }
        if let Some((radicand, other)) = root_of {
            self.radicands.push(radicand);
            // both roots of a square are functions, and each has a part of the manifold
            if graph.is_square_everywhere(radicand) {
                let by_part = self.by_part.take();
                self.by_part = by_part.or_else(|| Some((function, Vec::new())));
                self.begin_another(graph, &before, (images[0].0, other));
            }
        }
        let solved: Vec<SymbolId> = images.iter().map(|(symbol, _)| *symbol).collect();
        self.note_solved(graph, &solved);
        for (symbol, image) in &images {
            self.insert(graph, *symbol, *image);
        }
        let is_defined = self.is_defined(graph, &before.images);
        if !is_defined {
            *self = before;
        }
        is_defined
    }

    /// Takes note of what may be other functions on another part, before these symbols get their images.
    pub(super) fn note_solved(&mut self, graph: &Graph, solved: &[SymbolId]) {
        if let Some((_, others)) = &mut self.by_part {
            let moved = self.images.iter().filter(|(_, image)| graph.depends_on(*image, solved));
            others.extend(moved.map(|(symbol, _)| *symbol).chain(solved.iter().copied()));
        }
    }

    /// Rotation matrices by Cayley's parameters, if that is where the functions vanish.
    fn rotations(graph: &mut Graph, functions: &[ExprId], unknowns: &[SymbolId]) -> Option<Self> {
        let present: Vec<SymbolId> =
            graph.symbols_in(functions).into_iter().filter(|symbol| unknowns.contains(symbol)).collect();
        if present.len() != 9 || functions.len() < 6 {
            return None;
        }
        let entries = cayley(graph);
        let chart = graph.symbols_in(&entries);
        let manifold = Self { images: present.into_iter().zip(entries).collect(), chart, ..Self::default() };
        let all = functions.iter().all(|function| manifold.zero_test(graph, *function) == Verdict::Zero);
        all.then_some(manifold)
    }
}

/// The indices of functions, in groups that share no unknown with each other.
fn apart(graph: &Graph, functions: &[ExprId], unknowns: &[SymbolId]) -> Vec<Vec<usize>> {
    let mut groups: Vec<(Vec<usize>, Vec<SymbolId>)> = Vec::new();
    for (index, function) in functions.iter().enumerate() {
        let mut joined = (vec![index], graph.symbols_in(&[*function]));
        joined.1.retain(|symbol| unknowns.contains(symbol));
        groups.retain_mut(|(indices, symbols)| {
            let is_near = symbols.iter().any(|symbol| joined.1.contains(symbol));
            if is_near {
                joined.0.append(indices);
                joined.1.append(symbols);
            }
            !is_near
        });
        joined.0.sort_unstable();
        groups.push(joined);
    }
    groups.into_iter().map(|(indices, _)| indices).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn symbols(graph: &mut Graph, names: &[&str]) -> Vec<SymbolId> {
        names.iter().map(|name| graph.new_symbol(*name)).collect()
    }

    #[test]
    fn the_sphere_and_a_plane_through_it() {
        let mut g = Graph::new();
        let all = symbols(&mut g, &["g1", "g2", "g3", "w1", "w2", "w3"]);
        let e: Vec<ExprId> = all.iter().map(|s| g.symbol(*s)).collect();
        let (norm, one) = (g.inner_product(&e[..3], &e[..3]), g.one());
        let sphere = g.formula(norm - one);
        let plane = g.inner_product(&e[..3], &e[3..]);
        let mut manifold = Manifold::where_zero(&mut g, &[sphere], &all[..3]).unwrap();
        let tangent = Manifold::where_zero(&mut g, &[plane], &all[3..]).unwrap();
        manifold.extend(&mut g, &tangent);
        // |g × w|² = |g|²|w|² − (g·w)² = |w|²
        let mut cross = Vec::new();
        for i in 0..3 {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            let (x, y) = (g.formula(e[j] * e[3 + k]), g.formula(e[k] * e[3 + j]));
            cross.push(g.formula(x - y));
        }
        let (left, right) = (g.inner_product(&cross, &cross), g.inner_product(&e[3..], &e[3..]));
        let defect = g.formula(left - right);
        assert!(!g.zero_test(defect).is_zero());
        assert!(manifold.zero_test(&mut g, defect).is_zero());
        assert!(manifold.zero_test(&mut g, left).is_nonzero());
    }

    #[test]
    fn rotation_matrices() {
        let mut g = Graph::new();
        let names: Vec<String> = (0..9).map(|i| format!("R{i}")).collect();
        let all = symbols(&mut g, &names.iter().map(String::as_str).collect::<Vec<_>>());
        let e: Vec<ExprId> = all.iter().map(|s| g.symbol(*s)).collect();
        let column = |j: usize| [e[j], e[3 + j], e[6 + j]];
        let one = g.one();
        let mut identities = Vec::new();
        for i in 0..3 {
            for j in i..3 {
                let product = g.inner_product(&column(i), &column(j));
                identities.push(if i == j { g.formula(product - one) } else { product });
            }
        }
        let manifold = Manifold::where_zero(&mut g, &identities, &all).unwrap();
        // the determinant is 1
        let matrix: Matrix = e.chunks(3).map(<[ExprId]>::to_vec).collect();
        let determinant = g.small_determinant(&matrix);
        let defect = g.formula(determinant - one);
        assert!(manifold.zero_test(&mut g, defect).is_zero());
    }

    /// Two of them, with their identities in turn, and a direction.
    #[test]
    fn several_embedded_families() {
        let mut g = Graph::new();
        let names: Vec<String> = (0..21).map(|i| format!("x{i}")).collect();
        let all = symbols(&mut g, &names.iter().map(String::as_str).collect::<Vec<_>>());
        let e: Vec<ExprId> = all.iter().map(|s| g.symbol(*s)).collect();
        let one = g.one();
        let mut identities = vec![g.inner_product(&e[18..], &e[18..])];
        for i in 0..3 {
            for j in i..3 {
                for first in [0, 9] {
                    let row = |k: usize| &e[first + 3 * k..first + 3 * k + 3];
                    identities.push(g.inner_product(row(i), row(j)));
                    if i == j {
                        let last = identities.len() - 1;
                        identities[last] = g.formula(identities[last] - one);
                    }
                }
            }
        }
        identities[0] = g.formula(identities[0] - one);
        let manifold = Manifold::where_zero(&mut g, &identities, &all).unwrap();
        for first in [0, 9] {
            let matrix: Matrix = e[first..first + 9].chunks(3).map(<[ExprId]>::to_vec).collect();
            let determinant = g.small_determinant(&matrix);
            let defect = g.formula(determinant - one);
            assert!(manifold.zero_test(&mut g, defect).is_zero());
        }
        assert!(manifold.zero_test(&mut g, identities[0]).is_zero());
        let height = g.formula(e[20] - one);
        assert!(!manifold.zero_test(&mut g, height).is_zero());
    }

    #[test]
    fn constant_speed() {
        let mut g = Graph::new();
        let all = symbols(&mut g, &["x", "y", "c"]);
        let e: Vec<ExprId> = all.iter().map(|s| g.symbol(*s)).collect();
        let (speed, c) = (g.inner_product(&e[..2], &e[..2]), g.square(e[2]));
        let function = g.formula(speed - c);
        let manifold = Manifold::where_zero(&mut g, &[function], &all[..2]).unwrap();
        assert!(manifold.zero_test(&mut g, function).is_zero());
    }
}
