//! A program as definitions, and the partial derivatives of its steps.

use super::opened::{Closing, Held, OpenSystem};
use super::step::{Program, Step, Value};
use crate::algebra::{Graph, Matrix, Rational};
use crate::id::{ExprId, Id, SymbolId};
use crate::mechanics::{Definition, NotDifferentiable, Procedure};
use rustc_hash::FxHashMap;
use std::collections::BTreeSet;
use std::ops::Range;

/// The program of an opened procedure as definitions, with a name for every result.
pub(super) struct Tape<'p> {
    pub(super) program: &'p Program,
    /// The value of each step in terms of names of earlier ones.
    values: Vec<Option<ExprId>>,
    /// The definitions, those that close systems among them.
    pub(super) procedure: Procedure,
    /// The methods that differentiate a method.
    methods: FxHashMap<String, Option<Vec<String>>>,
    /// What arguments of functions are made of by arithmetic: it is written out, so that addition theorems are seen.
    is_written_out: Vec<bool>,
}

impl<'p> Tape<'p> {
    /// Names the results of all steps; `None` if a system depends on its own unknowns.
    pub(super) fn of(
        graph: &mut Graph,
        program: &'p Program,
        systems: &[OpenSystem],
        methods: &Procedure,
    ) -> Option<Self> {
        let methods = methods.definitions.iter().filter_map(|definition| match definition {
            Definition::Call { method, derivatives, .. } => Some((method.clone(), derivatives.clone())),
            _ => None,
        });
        let mut tape = Self {
            program,
            values: vec![None; program.steps.len()],
            procedure: Procedure::default(),
            methods: methods.collect(),
            is_written_out: written_out(program),
        };
        let symbols = |system: &OpenSystem| {
            let held = system.held.iter().map(|(symbol, _)| *symbol);
            system.unknowns.iter().copied().chain(held).collect::<Vec<SymbolId>>()
        };
        let mut open: BTreeSet<SymbolId> = systems.iter().flat_map(symbols).collect();
        let mut left: Vec<Value> = program.steps.iter_ids().map(|(value, _)| value).collect();
        while !left.is_empty() || !open.is_empty() {
            let before = left.len() + open.len();
            left.retain(|value| {
                let step = &program.steps[*value];
                let mut is_known = !matches!(step, Step::Load(symbol) if open.contains(symbol));
                step.each_operand(|operand| is_known &= tape.values[operand.index()].is_some());
                if is_known {
                    tape.values[value.index()] = Some(tape.result(graph, *value, step));
                }
                !is_known
            });
            for system in systems {
                tape.close(graph, system, &mut open);
            }
            if left.len() + open.len() == before {
                return None;
            }
        }
        Some(tape)
    }

    /// Defines the unknowns of a system of which everything is known that they depend on.
    fn close(&mut self, graph: &mut Graph, system: &OpenSystem, open: &mut BTreeSet<SymbolId>) {
        match &system.closing {
            Closing::Factorised { values, .. }
            | Closing::Inverted { values, .. }
            | Closing::DiagonalAndOne { values, .. }
            | Closing::OneByOne { values, .. } => {
                for (unknown, place) in system.unknowns.iter().zip(values.clone()) {
                    if let Some(value) = self.output(place)
                        && open.remove(unknown)
                    {
                        self.procedure.definitions.push(Definition::Value { symbol: *unknown, value });
                    }
                }
            }
            Closing::Pivoted { matrix, right } => {
                let matrix: Option<Matrix> = matrix.iter().map(|row| self.outputs(row)).collect();
                if let Some((matrix, right)) = matrix.zip(self.outputs(right))
                    && system.unknowns.iter().all(|unknown| open.contains(unknown))
                {
                    open.retain(|symbol| !system.unknowns.contains(symbol));
                    let unknowns = system.unknowns.clone();
                    self.procedure.definitions.push(Definition::Solve { unknowns, matrix, right });
                }
            }
        }
        for (held, value) in &system.held {
            let value = match value {
                Held::Unknown(unknown) => (!open.contains(unknown)).then(|| graph.symbol(*unknown)),
                Held::Output(place) => self.output(*place),
            };
            if let Some(value) = value
                && open.remove(held)
            {
                self.procedure.definitions.push(Definition::Value { symbol: *held, value });
            }
        }
    }

    /// An output, if it is known.
    pub(super) fn output(&self, place: usize) -> Option<ExprId> {
        self.values[self.program.outputs.get(place)?.index()]
    }

    /// An output of which is known that it is.
    pub(super) fn known_output(&self, graph: &mut Graph, place: usize) -> ExprId {
        self.output(place).unwrap_or_else(|| graph.zero())
    }

    /// Outputs in a row, if they are known.
    pub(super) fn outputs(&self, places: &Range<usize>) -> Option<Vec<ExprId>> {
        places.clone().map(|place| self.output(place)).collect()
    }

    fn known(&self, graph: &mut Graph, value: Value) -> ExprId {
        self.values[value.index()].unwrap_or_else(|| graph.zero())
    }

    /// Where the angle of a sine or cosine is.
    fn angle(&self, pair: Value) -> Value {
        match &self.program.steps[pair] {
            Step::SinCos(angle) => *angle,
            _ => pair,
        }
    }

    /// The result of a step, by a name where something is computed.
    fn result(&mut self, graph: &mut Graph, value: Value, step: &Step) -> ExprId {
        let zero = graph.zero();
        let of = |value: &Value| self.values[value.index()].unwrap_or(zero);
        let sign = |minus: bool| if minus { Rational::MINUS_ONE } else { Rational::ONE };
        let is_written_out = self.is_written_out[value.index()];
        let result = match step {
            Step::Constant(number) => graph.number(number.clone()),
            Step::Pi => graph.pi(),
            Step::Load(symbol) => graph.symbol(*symbol),
            Step::Add(a, b) => graph.formula(of(a) + of(b)),
            Step::Sub(a, b) => graph.formula(of(a) - of(b)),
            Step::Mul(a, b) => graph.formula(of(a) * of(b)),
            Step::MulAdd { a, b, c, minus_product, minus_c } => {
                let product = graph.formula(of(a) * of(b));
                graph.linear_combination(&[(sign(*minus_product), product), (sign(*minus_c), of(c))])
            }
            Step::Div(a, b) => graph.formula(of(a) / of(b)),
            Step::Neg(a) => return graph.formula(-of(a)),
            Step::Recip(a) => graph.pow(of(a), Rational::MINUS_ONE),
            Step::Sqrt(a) => graph.sqrt(of(a)),
            Step::Cbrt(a) => graph.pow(of(a), Rational::new(1, 3)),
            Step::PowReal(a, exponent) => graph.pow(of(a), exponent.clone()),
            // taken apart by others, and not solved here
            Step::SinCos(_) | Step::Solve { .. } | Step::Component(..) => return zero,
            Step::SinOf(pair) => return graph.sin(of(&self.angle(*pair))),
            Step::CosOf(pair) => return graph.cos(of(&self.angle(*pair))),
            Step::Apply(function, a) => graph.apply(*function, of(a)),
            Step::Apply2(function, a, b) => graph.apply2(*function, of(a), of(b)),
            Step::Call { method, arguments } => {
                let arguments: Vec<ExprId> = arguments.iter().map(of).collect();
                return self.procedure.call(graph, method, &arguments);
            }
        };
        if is_written_out {
            return result;
        }
        // an intermediate result keeps the name that it has
        let named = self.program.names.get(&value).map(|symbol| graph.symbols()[*symbol].clone());
        self.procedure.define(graph, &named.unwrap_or_default(), result)
    }

    /// The operands of a step that vary, with the derivatives by them.
    ///
    /// # Errors
    /// Where a method is called whose derivative is missing.
    pub(super) fn partials(
        &mut self,
        graph: &mut Graph,
        value: Value,
        varies: &impl Fn(Value) -> bool,
    ) -> Result<Vec<(Value, ExprId)>, NotDifferentiable> {
        let step = &self.program.steps[value];
        let result = self.known(graph, value);
        let (zero, one) = (graph.zero(), graph.one());
        let minus_one = graph.formula(-one);
        let of = |value: &Value| self.values[value.index()].unwrap_or(zero);
        let sign = |minus: bool| if minus { minus_one } else { one };
        let mut partials = match step {
            Step::Constant(_)
            | Step::Pi
            | Step::Load(_)
            | Step::SinCos(_)
            | Step::Solve { .. }
            | Step::Component(..) => Vec::new(),
            Step::Add(a, b) => vec![(*a, one), (*b, one)],
            Step::Sub(a, b) => vec![(*a, one), (*b, minus_one)],
            Step::Mul(a, b) => vec![(*a, of(b)), (*b, of(a))],
            Step::MulAdd { a, b, c, minus_product, minus_c } => {
                let sign_of_product = sign(*minus_product);
                vec![
                    (*a, graph.formula(sign_of_product * of(b))),
                    (*b, graph.formula(sign_of_product * of(a))),
                    (*c, sign(*minus_c)),
                ]
            }
            Step::Div(a, b) => {
                let inverse = graph.formula(one / of(b));
                let inverse = self.procedure.define(graph, "", inverse);
                vec![(*a, inverse), (*b, graph.formula(-(result * inverse)))]
            }
            Step::Neg(a) => vec![(*a, minus_one)],
            Step::Recip(a) => vec![(*a, graph.formula(-(result * result)))],
            Step::Sqrt(a) => {
                let half = graph.number(Rational::new(1, 2));
                vec![(*a, graph.formula(half / result))]
            }
            Step::Cbrt(a) => {
                let third = graph.number(Rational::new(1, 3));
                vec![(*a, graph.formula(third / (result * result)))]
            }
            Step::PowReal(a, exponent) => {
                let power = graph.pow(of(a), exponent.clone() - Rational::ONE);
                vec![(*a, graph.scale(exponent.clone(), power))]
            }
            Step::SinOf(pair) => {
                let angle = self.angle(*pair);
                vec![(angle, graph.cos(of(&angle)))]
            }
            Step::CosOf(pair) => {
                let angle = self.angle(*pair);
                let sine = graph.sin(of(&angle));
                vec![(angle, graph.formula(-sine))]
            }
            Step::Apply(function, a) => {
                vec![(*a, graph.derivative_of_function(*function, of(a), result))]
            }
            Step::Apply2(function, a, b) => {
                let arguments = (of(a), of(b));
                [(a, (one, zero)), (b, (zero, one))]
                    .map(|(operand, change)| {
                        (*operand, graph.derivative_of_function_of_two(*function, arguments, change))
                    })
                    .into()
            }
            Step::Call { method, arguments } => return self.of_call(graph, method, arguments, varies),
        };
        partials.retain(|(operand, _)| varies(*operand));
        Ok(partials)
    }

    /// The arguments of a call that vary, with the calls of the methods that differentiate by them.
    fn of_call(
        &mut self,
        graph: &mut Graph,
        method: &str,
        arguments: &[Value],
        varies: &impl Fn(Value) -> bool,
    ) -> Result<Vec<(Value, ExprId)>, NotDifferentiable> {
        let values: Vec<ExprId> = arguments.iter().map(|argument| self.known(graph, *argument)).collect();
        let derivatives = self.methods.get(method).cloned().flatten().unwrap_or_default();
        let mut partials = Vec::new();
        for (index, argument) in arguments.iter().enumerate().filter(|(_, argument)| varies(**argument)) {
            let Some(derivative) = derivatives.get(index) else {
                return Err(NotDifferentiable { method: method.to_owned() });
            };
            partials.push((*argument, self.procedure.call(graph, derivative, &values)));
        }
        Ok(partials)
    }
}

/// Which steps arguments of functions are made of.
fn written_out(program: &Program) -> Vec<bool> {
    let mut marked = vec![false; program.steps.len()];
    for (index, step) in program.steps.iter().enumerate().rev() {
        let is_function = matches!(step, Step::SinCos(_) | Step::Apply(..) | Step::Apply2(..));
        if is_function || marked[index] {
            step.each_operand(|operand| marked[operand.index()] = true);
        }
    }
    marked
}
