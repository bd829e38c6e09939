//! Expressions as steps that are evaluated modulo powers of primes, many times and in part.
//!
//! Sine and cosine of an angle go through the rational parametrisation of the circle, (1 − t²)/(1 + t²) and
//! 2 t/(1 + t²), with one t for each term of the angle, so that the addition theorems hold.

use super::graph::Graph;
use super::node::{Function, Node};
use super::number::Rational;
use super::prime_power::PrimePower;
use crate::id::{ExprId, SymbolId};
use crate::id_map::IdMap;
use num_traits::ToPrimitive;

/// What values are chosen for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Chosen {
    /// The value of a symbol.
    Value(SymbolId),
    /// The parameter t of the circle above the term of an angle; above the number 1, if there is none.
    Circle(Option<ExprId>),
}

/// Expressions as steps.
#[derive(Clone, Debug)]
pub(crate) struct ResidueSteps {
    /// What has to be chosen.
    pub(crate) chosen: Vec<Chosen>,
    /// A term of an angle is so many times the angle that belongs to its t.
    pub(crate) division: i64,
    steps: Vec<Step<Rational>>,
    /// The steps that are the expressions.
    pub(crate) roots: Vec<usize>,
}

/// One step; operands are steps before it.
#[derive(Clone, Debug)]
enum Step<Number> {
    Number(Number),
    Chosen(usize),
    Cosine(usize),
    Sine(usize),
    /// The square root of a prime number.
    Root(u64),
    Sum(Number, Vec<(usize, Number)>),
    Product(Number, Vec<(usize, i64)>),
}

/// Exponents and multiples of angles up to this are written out.
const MOST_TURNS: i64 = 64;

impl ResidueSteps {
    /// The steps for some expressions, unless they have functions or roots that no digits are known of. A symbol that
    /// `varies` stands inside of sines and cosines or outside, not both: an angle and its t have no digits in common.
    pub(crate) fn of(graph: &Graph, expressions: &[ExprId], varies: &[SymbolId]) -> Option<Self> {
        let mut writer = Writer {
            graph,
            varies,
            known: IdMap::default(),
            units: IdMap::default(),
            made: Self {
                chosen: Vec::new(),
                division: graph.angle_division(expressions),
                steps: Vec::new(),
                roots: Vec::new(),
            },
        };
        for expression in expressions {
            let root = writer.written(*expression)?;
            writer.made.roots.push(root);
        }
        let made = writer.made;
        let symbol_of = |term: &Option<ExprId>| term.and_then(|term| graph.as_symbol(term));
        let is_both = |symbol: &SymbolId| {
            made.chosen.contains(&Chosen::Value(*symbol))
                && made
                    .chosen
                    .iter()
                    .any(|c| matches!(c, Chosen::Circle(term) if symbol_of(term) == Some(*symbol)))
        };
        (!varies.iter().any(is_both)).then_some(made)
    }

    /// The place of a symbol among what is chosen.
    pub(crate) fn place_of(&self, graph: &Graph, symbol: SymbolId) -> Option<usize> {
        self.chosen.iter().position(|chosen| match chosen {
            Chosen::Value(of) => *of == symbol,
            Chosen::Circle(term) => term.and_then(|term| graph.as_symbol(term)) == Some(symbol),
        })
    }

    /// The same modulo a power of a prime, if no number in them is divided by the prime.
    pub(crate) fn modulo(&self, power: PrimePower) -> Option<StepsModulo> {
        let step = |step: &Step<Rational>| {
            Some(match step {
                Step::Number(number) => Step::Number(power.of(number)?),
                Step::Root(number) => Step::Number(power.root(*number)?),
                Step::Chosen(place) => Step::Chosen(*place),
                Step::Cosine(place) => Step::Cosine(*place),
                Step::Sine(place) => Step::Sine(*place),
                Step::Sum(constant, terms) => {
                    let terms = terms.iter().map(|(term, factor)| Some((*term, power.of(factor)?)));
                    Step::Sum(power.of(constant)?, terms.collect::<Option<_>>()?)
                }
                Step::Product(factor, factors) => Step::Product(power.of(factor)?, factors.clone()),
            })
        };
        Some(StepsModulo { power, steps: self.steps.iter().map(step).collect::<Option<_>>()? })
    }
}

/// Steps modulo a power of a prime.
#[derive(Clone, Debug)]
pub(crate) struct StepsModulo {
    pub(crate) power: PrimePower,
    steps: Vec<Step<u64>>,
}

impl StepsModulo {
    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.steps.len()
    }

    /// The operands of a step, and what is chosen for it.
    pub(crate) fn needs(&self, place: usize) -> (Vec<usize>, Option<usize>) {
        match &self.steps[place] {
            Step::Number(_) | Step::Root(_) => (Vec::new(), None),
            Step::Chosen(chosen) | Step::Cosine(chosen) | Step::Sine(chosen) => (Vec::new(), Some(*chosen)),
            Step::Sum(_, terms) => (terms.iter().map(|(term, _)| *term).collect(), None),
            Step::Product(_, factors) => (factors.iter().map(|(factor, _)| *factor).collect(), None),
        }
    }

    /// Takes one step; `None` where it divides by what is divisible by the prime.
    pub(crate) fn take(&self, place: usize, chosen: &[u64], values: &mut [u64]) -> Option<()> {
        let power = self.power;
        let over = |t: u64| power.inverse(power.sum(1, power.product(t, t)));
        values[place] = match &self.steps[place] {
            Step::Number(number) => *number,
            Step::Root(_) => return None,
            Step::Chosen(of) => chosen[*of],
            Step::Cosine(of) => {
                let t = chosen[*of];
                power.product(power.difference(1, power.product(t, t)), over(t)?)
            }
            Step::Sine(of) => {
                let t = chosen[*of];
                power.product(power.sum(t, t), over(t)?)
            }
            Step::Sum(constant, terms) => terms
                .iter()
                .fold(*constant, |sum, (term, factor)| power.sum(sum, power.product(*factor, values[*term]))),
            Step::Product(factor, factors) => {
                let mut product = *factor;
                for (base, exponent) in factors {
                    let value =
                        if *exponent == 1 { values[*base] } else { power.power(values[*base], *exponent)? };
                    product = power.product(product, value);
                }
                product
            }
        };
        Some(())
    }

    /// Takes all steps.
    pub(crate) fn evaluate(&self, chosen: &[u64]) -> Option<Vec<u64>> {
        let mut values = vec![0; self.steps.len()];
        for place in 0..self.steps.len() {
            self.take(place, chosen, &mut values)?;
        }
        Some(values)
    }
}

struct Writer<'a> {
    graph: &'a Graph,
    varies: &'a [SymbolId],
    known: IdMap<ExprId, usize>,
    /// Cosine and sine of angles.
    units: IdMap<ExprId, [usize; 2]>,
    made: ResidueSteps,
}

impl Writer<'_> {
    fn push(&mut self, step: Step<Rational>) -> usize {
        self.made.steps.push(step);
        self.made.steps.len() - 1
    }

    fn chosen(&mut self, wanted: Chosen) -> usize {
        let known = self.made.chosen.iter().position(|chosen| *chosen == wanted);
        known.unwrap_or_else(|| {
            self.made.chosen.push(wanted);
            self.made.chosen.len() - 1
        })
    }

    /// The step of an expression, operands first.
    fn written(&mut self, root: ExprId) -> Option<usize> {
        let mut open = vec![root];
        while let Some(&id) = open.last() {
            let before = open.len();
            let graph = self.graph;
            if !matches!(graph.node(id), Node::Apply(..)) {
                open.extend(graph.node(id).operands().filter(|operand| !self.known.contains_key(operand)));
            }
            if open.len() == before {
                open.pop();
                if !self.known.contains_key(&id) {
                    let step = self.step(id)?;
                    self.known.insert(id, step);
                }
            }
        }
        Some(self.known[&root])
    }

    fn step(&mut self, id: ExprId) -> Option<usize> {
        let graph = self.graph;
        let step = match graph.node(id) {
            Node::Number(value) => Step::Number(value.clone()),
            Node::Constant(constant) => Step::Number(graph.constants()[*constant].value.clone()),
            Node::Symbol(symbol) => Step::Chosen(self.chosen(Chosen::Value(*symbol))),
            Node::Sum { constant, terms } => {
                let terms = terms.iter().map(|(term, factor)| (self.known[term], factor.clone()));
                Step::Sum(constant.clone(), terms.collect())
            }
            Node::Product { coefficient, factors } => {
                let mut written = Vec::new();
                for (base, exponent) in factors.iter() {
                    match exponent.to_small()? {
                        (times, 1) => written.push((self.known[base], times)),
                        (times, 2) => {
                            let number = graph.value_of(*base)?.to_i64()?.to_u64()?;
                            let root = self.root(number)?;
                            written.push((root, times));
                        }
                        _ => return None,
                    }
                }
                Step::Product(coefficient.clone(), written)
            }
            Node::Apply(function @ (Function::Sin | Function::Cos), x) => {
                let [cosine, sine] = self.unit(*x)?;
                return Some(if *function == Function::Sin { sine } else { cosine });
            }
            Node::Pi | Node::Apply(..) | Node::Apply2(..) => return None,
        };
        Some(self.push(step))
    }

    /// The root of a prime number: of these every combination of signs is as good as another.
    fn root(&mut self, number: u64) -> Option<usize> {
        let is_prime = (2..1000).contains(&number) && !(2..number).any(|d| number.is_multiple_of(d));
        is_prime.then(|| self.push(Step::Root(number)))
    }

    /// Cosine and sine of an angle.
    fn unit(&mut self, x: ExprId) -> Option<[usize; 2]> {
        if let Some(known) = self.units.get(&x) {
            return Some(*known);
        }
        let mut unit = [self.push(Step::Number(Rational::ONE)), self.push(Step::Number(Rational::ZERO))];
        for (term, coefficient) in self.graph.angle_terms(x) {
            let turn = match term {
                Some(term) if matches!(self.graph.node(term), Node::Pi) => self.part_of_turn(&coefficient)?,
                _ => self.turns_of(term, &coefficient)?,
            };
            unit = self.turned(unit, turn);
        }
        self.units.insert(x, unit);
        Some(unit)
    }

    /// A multiple of a term that is chosen for.
    fn turns_of(&mut self, term: Option<ExprId>, coefficient: &Rational) -> Option<[usize; 2]> {
        if let Some(term) = term
            && self.graph.as_symbol(term).is_none()
            && self.graph.depends_on(term, self.varies)
        {
            return None;
        }
        let times = (coefficient.clone() * Rational::from(self.made.division)).to_i64()?;
        let place = self.chosen(Chosen::Circle(term));
        let (cosine, sine) = (self.push(Step::Cosine(place)), self.push(Step::Sine(place)));
        let sine = if times < 0 { self.push(Step::Product(-Rational::ONE, vec![(sine, 1)])) } else { sine };
        if times == 0 || times.abs() > MOST_TURNS {
            return None;
        }
        let mut unit = [cosine, sine];
        for _ in 1..times.abs() {
            unit = self.turned(unit, [cosine, sine]);
        }
        Some(unit)
    }

    /// A multiple of π, in quarters or thirds of a right angle.
    fn part_of_turn(&mut self, coefficient: &Rational) -> Option<[usize; 2]> {
        let twelfths = (coefficient.clone() * Rational::from(12)).to_i64()?.rem_euclid(24);
        let half = |this: &mut Self, number| {
            let root = this.root(number)?;
            Some(this.push(Step::Product(Rational::new(1, 2), vec![(root, 1)])))
        };
        let (quarters, rest) = (twelfths / 6, twelfths % 6);
        let mut unit = match rest {
            0 => [self.push(Step::Number(Rational::ONE)), self.push(Step::Number(Rational::ZERO))],
            2 => [half(self, 3)?, self.push(Step::Number(Rational::new(1, 2)))],
            3 => [half(self, 2)?; 2],
            4 => [self.push(Step::Number(Rational::new(1, 2))), half(self, 3)?],
            _ => return None,
        };
        for _ in 0..quarters {
            let [cosine, sine] = unit;
            unit = [self.push(Step::Product(-Rational::ONE, vec![(sine, 1)])), cosine];
        }
        Some(unit)
    }

    /// The unit of a sum of two angles.
    fn turned(&mut self, [c, s]: [usize; 2], [d, t]: [usize; 2]) -> [usize; 2] {
        let mut product = |a, b| self.push(Step::Product(Rational::ONE, vec![(a, 1), (b, 1)]));
        let (cd, st, ct, sd) = (product(c, d), product(s, t), product(c, t), product(s, d));
        let minus = -Rational::ONE;
        let cosine = self.push(Step::Sum(Rational::ZERO, vec![(cd, Rational::ONE), (st, minus)]));
        let sine = self.push(Step::Sum(Rational::ZERO, vec![(ct, Rational::ONE), (sd, Rational::ONE)]));
        [cosine, sine]
    }
}
