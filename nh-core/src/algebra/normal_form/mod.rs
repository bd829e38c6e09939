//! Normal forms, and simplification by them.
//!
//! An expression is read as a Laurent polynomial over atoms (`reader.rs`), angles by the addition
//! theorems (`trigonometry.rs`), powers become monomials (`powers.rs`), denominators are cancelled (`division.rs`), and the polynomial is
//! written back (`rebuild.rs`). Identities beyond those of construction:
//!
//! | identity | condition |
//! |---|---|
//! | `a (b + c) = ab + ac` | – |
//! | addition theorems of `sin`, `cos`, `sinh`, `cosh`, `exp` | – |
//! | `cos² + sin² = 1`, `cosh² − sinh² = 1` | – |
//! | `(xa + xb)^n = x^n (a + b)^n`, `(a/x + b)^−1 = x (a + bx)^−1` | `n` an integer; only removes divisions |
//! | `PQ / Q = P` | an exact division of polynomials; only removes a division |
//! | `a/p + b/q = (aq + bp) / (pq)` | both were divisors before |
//! | `√(ab) = √a √b` | positive numbers |
//!
//! What exceeds the budget is left as it is: nothing here grows without bound.

mod division;
mod evaluation_cost;
mod factors;
mod harmonics;
mod monomial;
mod polynomial;
mod reader;
mod rebuild;
mod roots;
mod terms;
mod trigonometry;

use super::graph::Graph;
use super::level::Accuracy;
use super::memory::{Attempt, Image, STYLE_COUNT, Simplifier, Style};
use super::node::Function::{Cos, Cosh, Exp, Sin, Sinh};
use super::node::Node;
use super::number::Rational;
use crate::count::Count;
use crate::id::ExprId;
use reader::Reader;

/// Most monomials that a normal form, or a polynomial on the way to it, may have.
const MONOMIALS: usize = 2000;
/// Most multiplications of monomials for one normal form.
const WORK: usize = 40_000;
/// Most multiplications of monomials for one attempt at simplification.
const ATTEMPT: usize = 4000;
/// Most multiplications of monomials for all subexpressions of one simplification.
const SUBEXPRESSIONS: usize = 30_000;
/// The work for all expressions of a declaration together, after which they are left as they are: a
/// declaration can make the equations long, but not the compiler hang.
const TOTAL: usize = 1_000_000;
/// What visiting a subexpression counts as work.
const NODE: usize = 100;
/// Expressions made of more distinct ones are not attempted as a whole.
const CONE: usize = 1500;
/// Expressions of a set that are exchanged one by one.
const EXCHANGES: usize = 32;
/// Times that the common denominators of angles may grow.
const ROUNDS: usize = 3;

const CANONICAL: Style = Style { expand: true, angles: true, canonical: true };

/// The forms among which simplification chooses, besides the canonical one.
const STYLES: [Style; STYLE_COUNT] = [
    Style { expand: false, angles: false, canonical: false },
    Style { expand: true, angles: false, canonical: false },
    CANONICAL,
];

impl Graph {
    /// The canonical form: equal rational functions of the same symbols, angles, exponentials and
    /// roots mostly become the same expression. `None` beyond the budget, and for expressions
    /// that divide by zero.
    pub fn normal_form(&mut self, e: ExprId) -> Option<ExprId> {
        let (canonical, _) = self.forms(e, CANONICAL, WORK).forms?;
        Some(canonical)
    }

    /// An equal expression that costs at most as much ([`Graph::operation_count`]).
    pub fn simplify(&mut self, e: ExprId) -> ExprId {
        let mut simplifier = std::mem::take(&mut self.simplifier);
        let image = simplifier.apply(self, e);
        self.simplifier = simplifier;
        image
    }

    /// Equal expressions, whatever they cost: as sums in which every term occurs once, and simplified, unless these
    /// sums are beyond any attempt.
    pub(super) fn spelled_out(&mut self, e: ExprId) -> Vec<ExprId> {
        let mut found = Vec::new();
        for style in [STYLES[1], CANONICAL] {
            let forms = self.forms(e, style, ATTEMPT).forms;
            found.extend(forms.iter().flat_map(|(collected, factored)| [*collected, *factored]));
        }
        if !found.is_empty() {
            found.push(self.simplify(e));
        }
        found.sort_unstable();
        found.dedup();
        found
    }

    /// Simplifies expressions that are computed together: what they share stays shared where that
    /// is cheaper. Together they cost at most as much as before.
    pub fn simplify_all(&mut self, roots: &[ExprId]) -> Vec<ExprId> {
        let images: Vec<_> = roots.iter().map(|root| self.simplify(*root)).collect();
        let (before, after) = (self.operation_count(roots), self.operation_count(&images));
        let (mut chosen, mut cost) =
            if after < before { (images.clone(), after) } else { (roots.to_vec(), before) };
        for index in (0..roots.len()).take(EXCHANGES) {
            let kept = chosen[index];
            chosen[index] = if kept == images[index] { roots[index] } else { images[index] };
            if chosen[index] != kept {
                let exchanged = self.operation_count(&chosen);
                if exchanged < cost {
                    cost = exchanged;
                } else {
                    chosen[index] = kept;
                }
            }
        }
        chosen
    }

    /// The expression in a style: the same again if it was read before in one that reads it alike, and for the same work.
    fn forms(&mut self, e: ExprId, style: Style, work: usize) -> Attempt {
        if let Some(known) = self.attempts.made.get(&(e, style)).filter(|known| known.spent <= work) {
            return *known;
        }
        if let Some(failed) = self.attempts.failed.get(&(e, style, work)) {
            return *failed;
        }
        let attempt = self.read_forms(e, style, work);
        for alike in STYLES.into_iter().filter(|other| attempt.asked.nothing_between(style, *other)) {
            if attempt.forms.is_some() {
                self.attempts.made.insert((e, alike), attempt);
            } else {
                self.attempts.failed.insert((e, alike, work), attempt);
            }
        }
        attempt
    }

    fn read_forms(&mut self, e: ExprId, style: Style, work: usize) -> Attempt {
        let mut reader = Reader::new(self, style, work, MONOMIALS);
        let mut forms = None;
        for _ in 0..ROUNDS {
            reader.restart();
            forms = reader.read(e).and_then(|polynomial| {
                let polynomial = reader.tidy(&polynomial)?;
                Some(reader.expressions(&polynomial))
            });
            if forms.is_none() || !reader.stale {
                break;
            }
        }
        Attempt { forms, spent: work - reader.work, asked: reader.asked.get() }
    }
}

impl Simplifier {
    /// An equal expression that costs at most as much, its subexpressions simplified first.
    fn apply(&mut self, graph: &mut Graph, e: ExprId) -> ExprId {
        match self.known.get(&e) {
            Some(image) if image.is_whole => return image.id,
            Some(_) => _ = self.known.remove(&e),
            None => {}
        }
        if self.spent > TOTAL {
            return e;
        }
        let mut work = SUBEXPRESSIONS;
        let known = self.known.len();
        let mut open = vec![e];
        while let Some(&id) = open.last() {
            if self.known.contains_key(&id) {
                open.pop();
                continue;
            }
            let before = open.len();
            open.extend(graph.node(id).operands().filter(|operand| !self.known.contains_key(operand)));
            if open.len() == before {
                let image = self.of_node(graph, id, id == e, &mut work);
                self.known.insert(id, image);
            }
        }
        self.spent += SUBEXPRESSIONS - work + NODE * (self.known.len() - known);
        let image = self.known[&e].id;
        // the parts became cheaper one by one; the whole may have lost what they shared
        if image != e && graph.operation_count(&[image]) > graph.operation_count(&[e]) {
            self.known.entry(e).and_modify(|image| image.id = e);
        }
        self.known[&e].id
    }

    /// A node whose operands are simplified.
    fn of_node(&self, graph: &mut Graph, id: ExprId, is_root: bool, work: &mut usize) -> Image {
        let node = graph.node(id).clone();
        let mut image = Image {
            id,
            of_parts: id,
            has_sum: false,
            has_angle: false,
            is_whole: is_root,
            beyond: [false; STYLES.len()],
        };
        for operand in node.operands() {
            let part = self.known[&operand];
            image.has_sum |= part.has_sum;
            image.has_angle |= part.has_angle;
            for (whole, part) in image.beyond.iter_mut().zip(part.beyond) {
                *whole |= part;
            }
        }
        let rebuilt = self.rebuilt(graph, id, &node);
        let is_sum = matches!(node, Node::Sum { .. });
        let styles = match (is_sum || (is_root && matches!(node, Node::Product { .. })), image) {
            (false, _) => 0,
            (true, Image { has_angle: true, .. }) if graph.gains_nothing_from_addition_theorems(rebuilt) => 2,
            (true, Image { has_angle: true, .. }) => STYLES.len(),
            (true, Image { has_sum: true, .. }) => 2,
            // nothing to multiply out, but perhaps something to take out
            (true, _) => 1,
        };
        if styles > 0 || rebuilt != id {
            let budget = if is_root { (*work).max(2 * ATTEMPT) } else { *work };
            let mut choice = Choice::new(graph, id, rebuilt, budget);
            for (style, beyond) in STYLES.iter().zip(&mut image.beyond).take(styles) {
                if !*beyond {
                    *beyond = choice.is_beyond(graph, *style);
                }
            }
            *work = work.saturating_sub(budget - choice.work);
            image.id = choice.best;
        }
        image.of_parts = rebuilt;
        image.has_sum |= is_sum;
        image.has_angle |= matches!(node, Node::Apply(Sin | Cos | Sinh | Cosh | Exp, _));
        image
    }

    fn rebuilt(&self, graph: &mut Graph, id: ExprId, node: &Node) -> ExprId {
        if let Node::Product { coefficient, factors } = node
            && factors.iter().any(|(_, exponent)| !exponent.is_integer())
        {
            let image = |(base, exponent): &(ExprId, Rational)| {
                let Image { id, of_parts, .. } = self.known[base];
                let is_kept = !exponent.is_integer() && graph.is_better_kept(of_parts, id);
                (if is_kept { of_parts } else { id }, exponent.clone())
            };
            let factors: Vec<(ExprId, Rational)> = factors.iter().map(image).collect();
            let product = graph.product(&factors);
            return graph.scale(coefficient.clone(), product);
        }
        if node.operands().all(|operand| self.known[&operand].id == operand) {
            return id;
        }
        graph.rebuilt(node.clone(), |operand| self.known[&operand].id)
    }
}

/// The cheapest form of an expression so far.
struct Choice {
    best: ExprId,
    cost: Count,
    /// The same with simplified operands, from which the other forms come.
    rebuilt: ExprId,
    /// What is left of the budget.
    work: usize,
    /// The forms that were considered: a second time they change nothing.
    considered: Vec<ExprId>,
    /// The work of reading without multiplying out, if there was nothing to multiply out.
    unexpanded: Option<usize>,
}

impl Choice {
    /// Between an expression and the same with simplified operands. The latter it is for
    /// expressions too large to be counted.
    fn new(graph: &Graph, id: ExprId, rebuilt: ExprId, work: usize) -> Self {
        let Some(cost) = graph.operation_count_within(&[id], CONE.min(work)) else {
            return Self {
                best: rebuilt,
                cost: Count::ZERO,
                rebuilt,
                work: work.saturating_sub(CONE),
                considered: Vec::new(),
                unexpanded: None,
            };
        };
        let counted = usize::try_from(cost.get()).unwrap_or(CONE);
        let work = work.saturating_sub(counted);
        let mut choice = Self { best: id, cost, rebuilt, work, considered: vec![id], unexpanded: None };
        choice.consider(graph, rebuilt);
        choice
    }

    fn consider(&mut self, graph: &Graph, candidate: ExprId) {
        if self.considered.contains(&candidate) {
            return;
        }
        self.considered.push(candidate);
        if let Some(cost) = graph.operation_count_within(&[candidate], CONE)
            && cost < self.cost
            && (graph.accuracy() != Accuracy::Careful || graph.error_growth(candidate, self.rebuilt) <= 1.0)
        {
            (self.best, self.cost) = (candidate, cost);
        }
    }

    /// Considers the forms of a style; whether that is beyond the budget of any attempt.
    fn is_beyond(&mut self, graph: &mut Graph, style: Style) -> bool {
        if self.cost == 0 {
            return false;
        }
        let budget = self.work.min(ATTEMPT);
        if style.expand
            && !style.angles
            && let Some(spent) = self.unexpanded.filter(|spent| *spent <= budget)
        {
            // the same polynomial again
            self.work -= spent;
            return false;
        }
        let Attempt { forms, spent, asked } = graph.forms(self.rebuilt, style, budget);
        self.work -= spent;
        if let Some((expression, factored)) = forms {
            self.unexpanded = (!style.expand && !asked.expand).then_some(spent);
            self.consider(graph, expression);
            self.consider(graph, factored);
            return false;
        }
        budget == ATTEMPT
    }
}

#[cfg(test)]
mod normal_form_tests;
