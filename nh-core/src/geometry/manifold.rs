//! Points on a manifold: where claims that hold only there are tested.
//!
//! The base may be embedded (|γ| = 1, a rotation matrix), and the constraint manifold lies in E.
//! Both are parametrised rationally where possible, by a square root where need be, so that a
//! claim on the manifold becomes a claim about the parameters.

use super::common_zeros::vanish_together;
use super::solutions::{Ease, Solved, cayley, difference, quotient, root, sphere};
use crate::algebra::{Demand, Graph, Matrix, Node, Substitution, Verdict, Witness};
use crate::id::{ExprId, SymbolId};
use crate::limits::{attempt, spent};

/// The work that the search for parts may take.
const WORK: u64 = 24_000_000;

/// A manifold, by symbols that are functions of the others.
#[derive(Clone, Debug, Default)]
pub struct Manifold {
    pub(super) images: Vec<(SymbolId, ExprId)>,
    /// The symbols in the images that are parameters of a chart.
    pub(super) chart: Vec<SymbolId>,
    /// A function of those that define it which vanishes elsewhere, too, as a product does: what holds on this manifold
    /// need not hold wherever the functions vanish.
    pub(super) in_parts: Option<ExprId>,
    /// What square roots of images are taken of: the other root is as good as this one.
    pub(super) radicands: Vec<ExprId>,
    /// A function that was solved by the root of a square, which is a function on one part of the manifold and another one on
    /// the other, and the symbols whose images may be others there.
    pub(super) by_part: Option<(ExprId, Vec<SymbolId>)>,
    /// The other parts that were found, each as if it were the only one.
    pub(super) others: Vec<Manifold>,
    /// The roots that were not taken because images would divide by 0 there.
    pub(super) not_taken: Vec<(SymbolId, ExprId)>,
    /// Parts that could not be solved for.
    pub(super) open: Vec<OpenPart>,
}

/// A part of a manifold that could not be solved for: there may be points of it where further functions vanish.
#[derive(Clone, Debug)]
pub(crate) struct OpenPart {
    /// The symbols that are functions of the others there.
    pub(crate) images: Vec<(SymbolId, ExprId)>,
    /// What vanishes there besides.
    pub(crate) functions: Vec<ExprId>,
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
            return Self::on_all_parts(graph, functions, unknowns);
        }
        let mut manifold = Self::default();
        for group in groups {
            let of_group: Vec<ExprId> = group.iter().map(|index| functions[*index]).collect();
            let solved =
                Self::on_all_parts(graph, &of_group, unknowns).map_err(|position| group[position])?;
            manifold.extend(graph, &solved);
        }
        manifold.note_roots_of(graph, functions);
        Ok(manifold)
    }

    /// The same of functions that share unknowns.
    fn on_all_parts(graph: &mut Graph, functions: &[ExprId], unknowns: &[SymbolId]) -> Result<Self, usize> {
        let mut manifold = Self::where_all_zero(graph, functions, unknowns)?;
        let demands: Vec<(ExprId, Demand)> =
            functions.iter().map(|function| (*function, Demand::Zero)).collect();
        manifold.add_unreached_parts(graph, &demands, unknowns, |graph, further| {
            Self::where_all_zero(graph, &[further, functions].concat(), unknowns).ok()
        });
        Ok(manifold)
    }

    /// The same, with the parts that charts reach.
    fn where_all_zero(graph: &mut Graph, functions: &[ExprId], unknowns: &[SymbolId]) -> Result<Self, usize> {
        if let Some(rotations) = Self::rotations(graph, functions, unknowns) {
            return Ok(rotations);
        }
        // a sphere takes all its coordinates; where others restrict these as well they come first, and roots come before
        // what would put powers into them
        let orders = [
            [Ease::Sphere, Ease::Linear, Ease::Root],
            [Ease::Linear, Ease::Sphere, Ease::Root],
            [Ease::Root, Ease::Linear, Ease::Sphere],
        ];
        let solve = |graph: &mut Graph, start: &Self, functions: &[ExprId], moving: &[SymbolId]| {
            let mut failed: Option<(Self, Vec<usize>)> = None;
            for order in orders {
                let (found, index) = start.solved_in_order(graph, functions, (unknowns, moving), order);
                let Some(index) = index else { return (found, Vec::new()) };
                let first = failed.as_ref().map(|(_, unsolved)| unsolved.clone());
                // where a root was taken there is another
                if first.is_none() || !found.others.is_empty() {
                    failed = Some((found, first.unwrap_or_else(|| vec![index])));
                }
            }
            failed.unwrap_or_default()
        };
        let began = spent();
        let near = |graph: &mut Graph, start: &Self, functions: &[ExprId]| {
            let work = WORK.saturating_sub(spent() - began);
            attempt(work, || solve(graph, start, functions, unknowns))
                .unwrap_or_else(|| (start.clone(), (0..functions.len()).collect()))
        };
        let otherwise = |graph: &mut Graph, start: &Self, functions: &[ExprId], index: usize| {
            let (part, unsolved) = solve(graph, start, functions, &[]);
            (unsolved.is_empty()).then(|| Self { in_parts: Some(functions[index]), ..part })
        };
        let (mut manifold, unsolved) =
            Self::by_parts(graph, vec![Self::default()], (functions, unknowns), near, otherwise);
        if let Some(index) = unsolved.first() {
            return Err(*index);
        }
        manifold.note_roots_of(graph, functions);
        Ok(manifold)
    }

    /// The same, by the easiest ways first, so that no root gets into what could be solved without; and a function that
    /// could not be solved.
    fn solved_in_order(
        &self,
        graph: &mut Graph,
        functions: &[ExprId],
        unknowns: (&[SymbolId], &[SymbolId]),
        order: [Ease; 3],
    ) -> (Self, Option<usize>) {
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
            let Some(solved) = solved else { return (manifold, Some(open[0])) };
            open.retain(|index| *index != solved);
        }
        (manifold, None)
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
        both.open.extend(self.open.iter().chain(&other.open).cloned());
        let mut parts = both.others.into_iter();
        if let Some(first) = parts.next() {
            *self = Self { others: parts.collect(), open: both.open, ..first };
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

    /// The images, where they are rational functions of parameters that reach a dense part of the whole manifold.
    #[must_use]
    pub fn rational_chart(&self) -> Option<&[(SymbolId, ExprId)]> {
        let is_one = self.others.is_empty() && self.open.is_empty() && self.not_taken.is_empty();
        let is_rational = self.radicands.is_empty() && self.in_parts.is_none() && self.by_part.is_none();
        (is_one && is_rational).then_some(self.images.as_slice())
    }

    /// The restriction of a function.
    pub fn restrict(&self, graph: &mut Graph, function: ExprId) -> ExprId {
        if graph.as_number(function).is_some() {
            return function;
        }
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

    /// Takes note of functions that define it and have a root which images have too.
    pub(crate) fn note_roots_of(&mut self, graph: &mut Graph, functions: &[ExprId]) {
        self.in_parts =
            self.in_parts.or_else(|| self.shared_root(graph, functions).map(|(function, _)| function));
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
        let by_part = by_part.filter(|_| !self.vanishes_on_all_parts(graph, function));
        if let Some(product) = self.in_parts.or(by_part.map(|(product, _)| *product)) {
            let product = graph.text_within(product, 200);
            return Verdict::Unknown(format!(
                "{product} = 0 holds in several ways, and it was asked in one of them"
            ));
        }
        match self.shared_root(graph, &[function]) {
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
mod manifold_tests;
