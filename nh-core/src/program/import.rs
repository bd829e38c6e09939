//! From the graph to the arena: only what the outputs depend on, roots taken apart from powers.

use super::nary::{Arena, Call, Nary, Source, System, Term};
use crate::algebra::{Graph, Node, Rational};
use crate::id::{ExprId, Id, SymbolId};
use crate::mechanics::{Definition, Procedure};
use rustc_hash::FxHashMap;

/// The arena of a procedure.
pub(super) fn import(graph: &Graph, procedure: &Procedure, parameters: &[SymbolId]) -> Arena {
    let mut arena = Arena::default();
    arena.parameters.extend(parameters);
    let is_nameless = |symbol: &SymbolId| graph.symbols()[*symbol].is_empty();
    for definition in &procedure.definitions {
        let defined = match definition {
            Definition::Value { symbol, .. } | Definition::Call { symbol, .. } => {
                std::slice::from_ref(symbol)
            }
            Definition::Solve { unknowns, .. } => unknowns,
        };
        arena.nameless.extend(defined.iter().copied().filter(is_nameless));
    }
    let mut importer = Importer { graph, arena, images: vec![None; graph.len()] };
    importer.run(procedure);
    importer.arena
}

struct Importer<'a> {
    graph: &'a Graph,
    arena: Arena,
    images: Vec<Option<Term>>,
}

impl Importer<'_> {
    fn run(&mut self, procedure: &Procedure) {
        let (live, definitions) = live(self.graph, procedure);
        for (index, _) in live.iter().enumerate().filter(|(_, live)| **live) {
            let term = self.node(ExprId::from_index(index));
            self.images[index] = Some(term);
        }
        for definition in definitions {
            match definition {
                Definition::Value { symbol, value } => {
                    let value = self.image(*value);
                    self.arena.sources.insert(*symbol, Source::Value(value));
                }
                Definition::Call { symbol, method, arguments, .. } => {
                    let arguments = arguments.iter().map(|id| self.image(*id)).collect();
                    let call = self.arena.calls.len();
                    self.arena.calls.push(Call { method: method.clone(), arguments });
                    self.arena.sources.insert(*symbol, Source::Call(call));
                }
                Definition::Solve { unknowns, matrix, right } => {
                    let of = |list: &Vec<ExprId>| list.iter().map(|id| self.image(*id)).collect();
                    let solve = System { matrix: matrix.iter().map(of).collect(), right: of(right) };
                    let system = self.arena.systems.len();
                    self.arena.systems.push(solve);
                    for (component, symbol) in unknowns.iter().enumerate() {
                        self.arena.sources.insert(*symbol, Source::Unknown { system, component });
                    }
                }
            }
        }
        self.arena.outputs = procedure.outputs.iter().map(|id| self.image(*id)).collect();
    }

    /// The image of an operand, which has a smaller id.
    fn image(&self, id: ExprId) -> Term {
        self.images[id.index()].expect("operands are imported first")
    }

    fn node(&mut self, id: ExprId) -> Term {
        let graph = self.graph;
        match graph.node(id) {
            Node::Number(value) => self.arena.number(value.clone()),
            Node::Pi => self.arena.intern(Nary::Pi),
            Node::Constant(constant) => {
                let value = graph.constants()[*constant].value.clone();
                self.arena.intern(Nary::Constant(*constant, value))
            }
            Node::Symbol(symbol) => self.arena.intern(Nary::Symbol(*symbol)),
            Node::Sum { constant, terms } => self.sum(constant, terms),
            Node::Product { coefficient, factors } => {
                let product = self.product(&coefficient.abs(), factors);
                if coefficient.is_negative() { self.arena.intern(Nary::Neg(product)) } else { product }
            }
            Node::Apply(function, x) => {
                let x = self.image(*x);
                self.arena.intern(Nary::Apply(*function, x))
            }
            Node::Apply2(function, x, y) => {
                let (x, y) = (self.image(*x), self.image(*y));
                self.arena.intern(Nary::Apply2(*function, x, y))
            }
        }
    }

    /// Signs go to the sum, magnitudes of coefficients to the products.
    fn sum(&mut self, constant: &Rational, terms: &[(ExprId, Rational)]) -> Term {
        let mut operands = Vec::with_capacity(terms.len() + 1);
        for (term, coefficient) in terms {
            let magnitude = coefficient.abs();
            let operand = match self.graph.node(*term) {
                Node::Product { coefficient: inner, factors } if inner.is_one() => {
                    self.product(&magnitude, factors)
                }
                _ => self.product(&magnitude, &[(*term, Rational::ONE)]),
            };
            operands.push((operand, coefficient.is_negative()));
        }
        if !constant.is_zero() {
            operands.push((self.arena.number(constant.abs()), constant.is_negative()));
        }
        if operands.iter().all(|(_, negative)| *negative) {
            let (sum, _) = self.arena.sum(operands);
            return self.arena.intern(Nary::Neg(sum));
        }
        operands.sort_unstable();
        self.arena.intern(Nary::Sum(operands.into()))
    }

    fn product(&mut self, magnitude: &Rational, factors: &[(ExprId, Rational)]) -> Term {
        let mut list = Vec::with_capacity(factors.len() + 1);
        if !magnitude.is_one() {
            list.push((self.arena.number(magnitude.clone()), 1));
        }
        for (base, exponent) in factors {
            let base = self.image(*base);
            self.power(base, exponent, &mut list);
        }
        self.arena.product(list)
    }

    /// `base^exponent` as integer powers of the base and of a root.
    fn power(&mut self, base: Term, exponent: &Rational, list: &mut Vec<(Term, i32)>) {
        let sign = if exponent.is_negative() { -1 } else { 1 };
        let magnitude = exponent.abs();
        let small = magnitude.to_small().and_then(|(p, q)| Some((i32::try_from(p).ok()?, q)));
        let (whole, rest, root) = match small {
            Some((p, 1)) => (p, 0, base),
            Some((p, 2)) => (p / 2, 1, self.arena.intern(Nary::Sqrt(base))),
            Some((p, 3)) => (p / 3, p % 3, self.arena.intern(Nary::Cbrt(base))),
            _ => (0, 1, self.arena.intern(Nary::PowReal(base, magnitude))),
        };
        list.extend(
            [(base, sign * whole), (root, sign * rest)].iter().filter(|(_, exponent)| *exponent != 0),
        );
    }
}

/// The expressions and definitions that the outputs depend on.
fn live<'a>(graph: &Graph, procedure: &'a Procedure) -> (Vec<bool>, Vec<&'a Definition>) {
    let mut defined: FxHashMap<SymbolId, usize> = FxHashMap::default();
    for (index, definition) in procedure.definitions.iter().enumerate() {
        match definition {
            Definition::Value { symbol, .. } | Definition::Call { symbol, .. } => {
                defined.insert(*symbol, index);
            }
            Definition::Solve { unknowns, .. } => defined.extend(unknowns.iter().map(|s| (*s, index))),
        }
    }
    let mut needed = vec![false; procedure.definitions.len()];
    let mut live = vec![false; graph.len()];
    let mut open = procedure.outputs.clone();
    while let Some(id) = open.pop() {
        if std::mem::replace(&mut live[id.index()], true) {
            continue;
        }
        open.extend(graph.node(id).operands());
        let definition = graph.as_symbol(id).and_then(|symbol| defined.get(&symbol));
        if let Some(&index) = definition.filter(|index| !std::mem::replace(&mut needed[**index], true)) {
            match &procedure.definitions[index] {
                Definition::Value { value, .. } => open.push(*value),
                Definition::Call { arguments, .. } => open.extend(arguments),
                Definition::Solve { matrix, right, .. } => open.extend(matrix.iter().flatten().chain(right)),
            }
        }
    }
    let definitions = procedure.definitions.iter().zip(needed).filter_map(|(d, needed)| needed.then_some(d));
    (live, definitions.collect())
}
