//! The parts of a manifold: where an equation is solved by the root of a square, as x² = 4 is, each sign of the root has
//! a part of its own, and what is asked at the points of one is not known at those of another.

use super::manifold::{Manifold, OpenPart};
use super::ways::ways_to_vanish;
use crate::algebra::{Demand, Graph, Node, Rational, Verdict, Witness, sample};
use crate::id::{ExprId, SymbolId};
use std::borrow::Cow;

/// More parts are not looked at.
const PARTS: usize = 64;
/// Nor more that may turn out to have no points.
const TRIED: usize = 3 * PARTS;
/// More functions are not put in the place of others, one after the other.
const REWRITTEN: usize = 16;
/// Nor more arguments in the place of functions: numbers that are roots of roots of roots take long to compare.
const INVERTED: usize = 2;

impl Manifold {
    /// This part and the others that were found, each as if it were the only one.
    pub(crate) fn parts(&self) -> impl Iterator<Item = &Self> {
        std::iter::once(self).chain(&self.others)
    }

    /// The images of a part that are not those of all parts.
    pub(crate) fn own_images(&self, images: &[(SymbolId, ExprId)]) -> Vec<(SymbolId, ExprId)> {
        let is_own = |image: &&(SymbolId, ExprId)| !self.parts().all(|other| other.images.contains(image));
        images.iter().filter(is_own).copied().collect()
    }

    /// Starts the part where a symbol that was solved for just now has the other root.
    pub(super) fn begin_another(
        &mut self,
        graph: &mut Graph,
        before: &Self,
        (symbol, other): (SymbolId, ExprId),
    ) {
        let mut part = before.alone();
        part.by_part.clone_from(&self.by_part);
        part.radicands.clone_from(&self.radicands);
        part.note_solved(graph, &[symbol]);
        part.insert(graph, symbol, other);
        if part.is_defined(graph, &before.images) {
            self.others.push(part);
        } else {
            self.not_taken.push((symbol, other));
        }
    }

    /// Where functions vanish on manifolds: `near` solves as many as it can, and may start further parts; where one is left
    /// that is a product, or an invertible function, it is solved by its factors or its argument. `otherwise` has the last
    /// word: by a division, perhaps, that leaves something out. The indices are of functions that could not be solved.
    pub(super) fn by_parts(
        graph: &mut Graph,
        starts: Vec<Self>,
        (functions, unknowns): (&[ExprId], &[SymbolId]),
        mut near: impl FnMut(&mut Graph, &Self, &[ExprId]) -> (Self, Vec<usize>),
        mut otherwise: impl FnMut(&mut Graph, &Self, &[ExprId], usize) -> Option<Self>,
    ) -> (Self, Vec<usize>) {
        let start = |manifold| Start {
            manifold,
            functions: functions.to_vec(),
            is_exact: true,
            rewritten: 0,
            inverted: 0,
        };
        let mut begun: Vec<Start> = starts.into_iter().rev().map(start).collect();
        let (mut solved, mut unsolved, mut whole) = (Vec::new(), Vec::new(), None);
        let mut tried = 0;
        let all = || (0..functions.len()).collect::<Vec<usize>>();
        while let Some(start) = begun.pop() {
            if tried == TRIED || solved.len() == PARTS {
                unsolved.push((start.clone(), start.manifold, all()));
                continue;
            }
            tried += 1;
            let (mut part, mut left) = near(graph, &start.manifold, &start.functions);
            let ways = left.iter().filter(|_| start.rewritten < REWRITTEN).find_map(|index| {
                let function = part.restrict(graph, start.functions[*index]);
                let ways = ways_to_vanish(graph, function, unknowns)?;
                (ways.is_exact || start.inverted < INVERTED).then_some((*index, function, ways))
            });
            if ways.is_none()
                && let Some(index) = left.first()
                && let Some(found) = otherwise(graph, &start.manifold, &start.functions, *index)
            {
                (part, left) = (found, Vec::new());
            }
            for (symbol, other) in std::mem::take(&mut part.not_taken) {
                // solved anew, this root first
                let symbol = graph.symbol(symbol);
                let mut functions = start.functions.clone();
                functions.push(graph.formula(symbol - other));
                begun.push(Start { functions, rewritten: start.rewritten + 1, ..start.clone() });
            }
            let others = std::mem::take(&mut part.others).into_iter();
            begun.extend(others.map(|manifold| Start { manifold, ..start.clone() }));
            match ways {
                Some((index, function, ways)) => {
                    whole = whole.or_else(|| Some((start.clone(), part.clone(), left)));
                    if ways.functions.len() > 1 {
                        part.by_part = part.by_part.take().or_else(|| Some((function, Vec::new())));
                    }
                    let ways_from = ways.functions.into_iter().rev();
                    begun.extend(ways_from.map(|way| start.rewritten(&part, (index, way), ways.is_exact)));
                }
                None if !left.is_empty() => unsolved.push((start, part, left)),
                None if start.is_exact => solved.push(part),
                None => match part.zero_tests(graph, functions) {
                    Verdict::Zero => solved.push(part),
                    // with |z| for a root of z² they may vanish for one sign of z and not for the other
                    Verdict::NonZero(_) if !part.has_roots_of_squares(graph) => {}
                    _ => unsolved.push((start, part, all())),
                },
            }
        }
        let mut main = None;
        // a factor does not stand for the product
        if let (Some(whole), true) = (whole, unsolved.iter().any(|(start, ..)| start.rewritten > 0)) {
            let (start, _, left) = &whole;
            match otherwise(graph, &start.manifold, &start.functions, left[0]) {
                Some(found) if solved.is_empty() => solved.push(found),
                Some(found) => solved.iter_mut().for_each(|part| part.in_parts = found.in_parts),
                None => main = Some(whole),
            }
        }
        if main.is_none() && solved.is_empty() && !unsolved.is_empty() {
            main = Some(unsolved.remove(0));
        }
        if solved.len() > 1 && solved.iter().any(|part: &Self| part.images.len() != solved[0].images.len()) {
            solved = without_contained(graph, &solved);
        }
        let mut solved = solved.into_iter();
        let (mut first, left) = match main {
            Some((_, part, left)) => {
                (part, left.into_iter().filter(|index| *index < functions.len()).collect())
            }
            None => solved.next().map_or_else(|| (Self::default(), all()), |part| (part, Vec::new())),
        };
        first.others = solved.collect();
        for (start, part, unsolved) in unsolved {
            if left.is_empty() {
                first.open.push(part.left_open(graph, &start.functions, &unsolved));
            } else if start.rewritten == 0 {
                // larger than it is, as the first
                first.others.push(part);
            }
        }
        (first, left)
    }

    /// What demands are on this part alone: equations that hold there are none.
    pub(crate) fn demands(&self, graph: &mut Graph, demands: &[(ExprId, Demand)]) -> Vec<(ExprId, Demand)> {
        let mut left: Vec<(ExprId, Demand)> =
            self.radicands.iter().map(|radicand| (*radicand, Demand::NotNegative)).collect();
        for (function, demand) in demands {
            let restricted = self.restrict(graph, *function);
            if *demand != Demand::Zero || !graph.zero_test(restricted).is_zero() {
                left.push((restricted, *demand));
            }
        }
        left
    }

    /// Takes parts of a base to be open where functions vanish besides, and those that are open on all of it.
    pub(crate) fn add_open_parts<'a>(
        &mut self,
        graph: &mut Graph,
        base: &Self,
        parts: impl Iterator<Item = &'a Self>,
        functions: &[ExprId],
    ) {
        let all: Vec<usize> = (0..functions.len()).collect();
        self.open.extend(base.open.iter().cloned());
        self.open.extend(parts.map(|part| part.alone().left_open(graph, functions, &all)));
    }

    /// Whether all of some functions vanish on it.
    fn zero_tests(&self, graph: &mut Graph, functions: &[ExprId]) -> Verdict {
        let mut verdict = Verdict::Zero;
        for function in functions {
            let restricted = self.restrict(graph, *function);
            match graph.zero_test(restricted) {
                Verdict::Zero => {}
                Verdict::Unknown(why) => verdict = Verdict::Unknown(why),
                nonzero @ Verdict::NonZero(_) => return nonzero,
            }
        }
        verdict
    }

    /// Whether images have roots of what is a square, so that they are other functions elsewhere.
    fn has_roots_of_squares(&self, graph: &Graph) -> bool {
        let images: Vec<ExprId> = self.images.iter().map(|(_, image)| *image).collect();
        graph.radicands(&images).into_iter().any(|radicand| graph.is_square_everywhere(radicand))
    }

    /// This part, where functions vanish besides that could not be solved.
    fn left_open(self, graph: &mut Graph, functions: &[ExprId], left: &[usize]) -> OpenPart {
        let functions = left.iter().map(|index| self.restrict(graph, functions[*index])).collect();
        OpenPart { images: self.images, functions }
    }

    /// Whether there are several parts, all of them are known, and a function vanishes on each.
    pub(super) fn vanishes_on_all_parts(&self, graph: &mut Graph, function: ExprId) -> bool {
        !self.others.is_empty()
            && self.open.is_empty()
            && self.parts().all(|part| part.zero_tests(graph, &[function]).is_zero())
    }

    /// What the zero test says of a function, and the part that it says it of: where the first one leaves it open, one with a
    /// real point at which it does not vanish.
    pub(crate) fn judged(&self, graph: &mut Graph, function: ExprId) -> (Cow<'_, Self>, Verdict) {
        let verdict = self.zero_test(graph, function);
        if matches!(verdict, Verdict::Unknown(_))
            && let Some((part, witness)) = self.part_without_zero(graph, function)
        {
            return (Cow::Owned(part), Verdict::NonZero(witness));
        }
        (Cow::Borrowed(self), verdict)
    }

    /// A part where a function certainly does not vanish at a real point, with that point.
    fn part_without_zero(&self, graph: &mut Graph, function: ExprId) -> Option<(Self, Witness)> {
        if self.others.is_empty() {
            return None;
        }
        self.parts().find_map(|part| {
            let restricted = part.restrict(graph, function);
            let Verdict::NonZero(witness) = graph.zero_test(restricted) else { return None };
            let solved: Vec<SymbolId> = part.images.iter().map(|(symbol, _)| *symbol).collect();
            let images = part.images.iter().map(|(_, image)| *image);
            let all: Vec<ExprId> = images.chain([function]).collect();
            let mut point = witness.clone();
            // what the function does not depend on may have any value
            let further = graph.symbols_in(&all).into_iter().enumerate();
            let free = further.filter(|(_, symbol)| witness.point.iter().all(|(known, _)| known != symbol));
            point.point.extend(free.map(|(place, symbol)| (symbol, sample(0, place))));
            part.point(graph, &point, &solved).is_some().then(|| (part.alone(), point))
        })
    }

    /// The parts that could not be solved for.
    pub(crate) fn open_parts(&self) -> &[OpenPart] {
        &self.open
    }

    /// One of some functions which has, by itself, a root that images have too, and what that is taken of: on another part
    /// of the manifold the image has the other root, and the function has not.
    pub(super) fn shared_root(&self, graph: &mut Graph, functions: &[ExprId]) -> Option<(ExprId, ExprId)> {
        if self.radicands.is_empty() {
            return None;
        }
        let of_number =
            self.radicands.iter().copied().find(|radicand| graph.symbols_in(&[*radicand]).is_empty());
        functions.iter().copied().find_map(|function| {
            // √3 has the other sign where the root of 3 has it
            if of_number.is_some() && graph.has_irrational_numbers(function) {
                return of_number.map(|radicand| (function, radicand));
            }
            let own = graph.radicands(&[function]);
            let shared = own.into_iter().find_map(|own| {
                let own = self.restrict(graph, own);
                self.radicands.iter().copied().find(|radicand| {
                    let product = graph.formula(own * radicand);
                    graph.is_square_everywhere(product)
                })
            });
            shared.map(|radicand| (function, radicand))
        })
    }

    /// Starts the parts where roots of images have the other sign, if functions have such roots by themselves: what these
    /// are there is not known from here; and parts of one sign in the place of those where roots of functions are those of
    /// squares. Whether there are any.
    pub(crate) fn add_parts_of_roots_in(&mut self, graph: &mut Graph, functions: &[ExprId]) -> bool {
        let mut further = Vec::new();
        for part in self.parts() {
            let Some((_, radicand)) = part.shared_root(graph, functions) else { continue };
            further.push(part.with_the_other_root(graph, radicand));
        }
        let mut is_found = !further.is_empty();
        self.others.extend(further);
        let is_curved = self.parts().any(|part| !part.images.is_empty());
        let radicands = if is_curved { graph.radicands(functions) } else { Vec::new() };
        for radicand in radicands {
            let mut all: Vec<Self> = Vec::new();
            for part in self.parts() {
                let of_one_sign = part.of_one_sign(graph, radicand);
                is_found |= !of_one_sign.is_empty();
                let instead = if of_one_sign.is_empty() { vec![part.alone()] } else { of_one_sign };
                let is_new = |part: &Self| all.iter().all(|known| known.images != part.images);
                let new: Vec<Self> = instead.into_iter().filter(is_new).collect();
                all.extend(new);
            }
            let mut all = all.into_iter();
            if let Some(first) = all.next() {
                *self = Self { others: all.collect(), open: std::mem::take(&mut self.open), ..first };
            }
            self.leave_open_what_is_too_much();
        }
        self.leave_open_what_is_too_much();
        is_found
    }

    /// Takes the parts beyond those that are looked at to be open.
    fn leave_open_what_is_too_much(&mut self) {
        let too_many = self.others.split_off((PARTS - 1).min(self.others.len()));
        self.open
            .extend(too_many.into_iter().map(|part| OpenPart { images: part.images, functions: Vec::new() }));
    }

    /// Takes open parts away.
    pub(crate) fn without_open_parts(&mut self) -> Vec<OpenPart> {
        std::mem::take(&mut self.open)
    }

    /// Takes further parts to be open.
    pub(crate) fn leave_open(&mut self, parts: Vec<OpenPart>) {
        for part in parts {
            let is_known =
                |known: &OpenPart| known.images == part.images && known.functions == part.functions;
            if !self.open.iter().any(is_known) {
                self.open.push(part);
            }
        }
    }

    /// The parts of this one on which a root that is one of a square here has one sign: with √(1 + y²) on x² = 1 + y², where
    /// x is that root, and where it is the other one. On this part, on which y is solved for, the root is |x|.
    fn of_one_sign(&self, graph: &mut Graph, radicand: ExprId) -> Vec<Self> {
        let solved: Vec<SymbolId> = self.images.iter().map(|(symbol, _)| *symbol).collect();
        if !graph.depends_on(radicand, &solved) {
            return Vec::new();
        }
        let restricted = self.restrict(graph, radicand);
        let restricted = graph.simplify(restricted);
        let Node::Product { coefficient, factors } = graph.node(restricted).clone() else {
            return Vec::new();
        };
        let [(base, exponent)] = &*factors else { return Vec::new() };
        let (Some(size), true) = (coefficient.sqrt(), *exponent == Rational::from(2)) else {
            return Vec::new();
        };
        // the square is that of base = slope · symbol + rest
        let symbols = graph.symbols_in(&[*base]);
        symbols
            .into_iter()
            .rev()
            .find_map(|symbol| {
                let slope = graph.partial(*base, symbol);
                graph.value_of(slope)?;
                // the image that makes way for that of the symbol
                let mut without = self.alone();
                without.images.retain(|(_, image)| !graph.depends_on(*image, &[symbol]));
                let moved = self.images.iter().find(|image| !without.images.contains(image))?;
                if without.images.len() + 1 != self.images.len() {
                    return None;
                }
                without.radicands.push(radicand);
                let (root, variable) = (graph.sqrt(radicand), graph.symbol(symbol));
                let rest = graph.formula(base - slope * variable);
                let (size, one) = (graph.number(size.clone()), graph.one());
                let signs = [one, graph.formula(-one)].map(|sign| {
                    let mut part = without.clone();
                    let image = graph.formula((sign * root / size - rest) / slope);
                    let image = part.restrict(graph, image);
                    part.insert(graph, symbol, image);
                    part
                });
                let (symbol, image) = (graph.symbol(moved.0), moved.1);
                let squares = graph.formula(symbol * symbol - image * image);
                signs.iter().all(|part| part.zero_tests(graph, &[squares]).is_zero()).then(|| signs.to_vec())
            })
            .unwrap_or_default()
    }

    /// What a root is taken of in every part and is positive nowhere where something is required: there the functions touch,
    /// and leave no more than the points where it is 0. That of the first part.
    pub(crate) fn touching(&self, graph: &mut Graph, demands: &[(ExprId, Demand)]) -> Option<ExprId> {
        if !self.open.is_empty() {
            return None;
        }
        let mut touching = self.parts().map(|part| {
            part.radicands.iter().copied().find(|radicand| {
                let demands = [demands, &[(*radicand, Demand::Positive)]].concat();
                graph.zero_test(*radicand).is_nonzero() && graph.contradiction(&demands).is_some()
            })
        });
        let first = touching.next()??;
        touching.all(|radicand| radicand.is_some()).then_some(first)
    }

    /// This part alone.
    pub(crate) fn alone(&self) -> Self {
        let mut part = self.clone();
        part.others.clear();
        part.open.clear();
        part
    }

    /// Takes the parts of another manifold to be further ones of this.
    pub(crate) fn add_parts(&mut self, other: &Self) {
        let parts = other.parts().map(Self::alone);
        self.others.extend(parts);
        self.leave_open_what_is_too_much();
        self.open.extend(other.open.iter().cloned());
    }
}

/// What is solved on one part, or not.
#[derive(Clone)]
struct Start {
    manifold: Manifold,
    functions: Vec<ExprId>,
    /// Whether the functions vanish where the declared ones do and nowhere else.
    is_exact: bool,
    /// How many functions have been put in the place of others.
    rewritten: usize,
    /// How many of these are arguments of others.
    inverted: usize,
}

impl Start {
    /// The same with one function in the place of another.
    fn rewritten(&self, part: &Manifold, (index, function): (usize, ExprId), is_exact: bool) -> Self {
        let mut functions = self.functions.clone();
        functions[index] = function;
        let inverted = self.inverted + usize::from(!is_exact);
        let (is_exact, rewritten) = (self.is_exact && is_exact, self.rewritten + 1);
        Self { manifold: part.clone(), functions, is_exact, rewritten, inverted }
    }
}

/// The parts that are no proper parts of others, such as a line in a plane.
fn without_contained(graph: &mut Graph, parts: &[Manifold]) -> Vec<Manifold> {
    let mut kept: Vec<Manifold> = Vec::with_capacity(parts.len());
    for part in parts {
        let is_contained = parts.iter().filter(|other| other.images.len() < part.images.len()).any(|other| {
            let mut equations = Vec::with_capacity(other.images.len());
            for (symbol, image) in &other.images {
                let symbol = graph.symbol(*symbol);
                equations.push(graph.formula(symbol - image));
            }
            part.zero_tests(graph, &equations).is_zero()
        });
        if !is_contained {
            kept.push(part.clone());
        }
    }
    kept
}
