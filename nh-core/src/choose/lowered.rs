//! The last proof: a program, as it is emitted, computes what its procedure says, and divides by nothing else.
//!
//! A program is run over the field, step by step, at points where the procedure was evaluated. Sines, cosines and
//! exponentials are kernels of the values of their arguments, which is enough wherever lowering leaves angles
//! alone; where it writes them by those of others, a second trial has the addition theorems. Points are counted
//! as in `proof.rs`, with the degrees of both.

use super::divisions::{Divisions, OTHER_DIVISOR, are_those_of_the_procedure};
use super::ledger::Proof;
use super::proof::{Defect, at_points, bits_without_branches, defined, has_branches, run, with_branches};
use crate::algebra::{
    Degree, Degrees, Echelon, FieldPass, FieldPoint, Function, Graph, Radicand, Radicands, Rational, Residue,
};
use crate::id::{ExprId, Id, SymbolId, Table};
use crate::limits;
use crate::mechanics::Procedure;
use crate::program::{Program, Split, Step, Value};
use num_integer::Integer;
use rustc_hash::FxHashMap;
use std::cell::Cell;

/// Proves that a program computes what a procedure says, wherever that has a value.
///
/// # Errors
/// What is wrong, or why it could not be decided.
pub fn prove_program(graph: &Graph, procedure: &Procedure, program: &Program) -> Result<Proof, Unproved> {
    prove_parts(graph, procedure, &[(&[], program)])
}

/// Proves the same of a program in two parts: what is computed ahead is known to the rest by its symbols.
///
/// # Errors
/// As [`prove_program`].
pub fn prove_split(graph: &Graph, procedure: &Procedure, split: &Split) -> Result<Proof, Unproved> {
    prove_parts(graph, procedure, &[(&split.symbols, &split.ahead), (&[], &split.rest)])
}

/// Why a program is not proved.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unproved {
    /// It computes something else.
    Wrong,
    /// It could not be decided, and why.
    Unknown(String),
}

/// Programs in order, with symbols for the outputs of those that later ones load.
type Parts<'p> = [(&'p [SymbolId], &'p Program)];

fn prove_parts(graph: &Graph, procedure: &Procedure, parts: &Parts) -> Result<Proof, Unproved> {
    let mut angles: Vec<Angles> = Vec::new();
    let first = proved_with(graph, procedure, parts, &mut angles);
    let has_angles = parts.iter().any(|(_, program)| program.steps.iter().any(|step| angle(step).is_some()));
    let outcome = match first {
        Err(Defect::Wrong(_) | Defect::Unknown(_)) if has_angles => {
            angles.extend(parts.iter().map(|(_, program)| Angles::of(program)));
            proved_with(graph, procedure, parts, &mut angles)
        }
        other => other,
    };
    outcome.map_err(|defect| match defect {
        Defect::Wrong(_) => Unproved::Wrong,
        other => Unproved::Unknown(other.to_string()),
    })
}

/// With the addition theorems where there are `angles`.
fn proved_with(
    graph: &Graph,
    procedure: &Procedure,
    parts: &Parts,
    angles: &mut [Angles],
) -> Result<Proof, Defect> {
    let roots = procedure.expressions();
    let divisions = angles.iter().map(|angles| angles.graph.angle_division(&angles.functions()));
    let division = divisions.fold(graph.angle_division(&roots), num_integer::lcm);
    let mut degree = procedure.degree(&mut Degrees::new(graph, division));
    for (index, (_, program)) in parts.iter().enumerate() {
        degree += degree_of(graph, program, angles.get(index), division);
    }
    let bits = bits_without_branches(degree)?;
    let bound = defined(procedure);
    let radicands = Radicands::of(graph, &roots, &bound);
    let pass = |point: FieldPoint| {
        if angles.is_empty() {
            FieldPass::by_value(graph, point)
        } else {
            FieldPass::without_arcs(graph, point, division)
        }
    };
    let has_branches = has_branches(graph, &roots);
    let independent =
        if has_branches { graph.independent_roots(&roots, &bound, pass, |_, _| None) } else { None };
    let known = independent.as_ref().map_or_else(Vec::new, |roots| roots.radicands.clone());
    let bits = if has_branches { with_branches(bits, independent.as_ref()) } else { bits };
    let mut divisions: Vec<Divisions> = Vec::new();
    let takes_others = Cell::new(false);
    let seeds = |seed| radicands.point_in(seed, pass);
    let mut agrees = |point: FieldPoint| {
        let mut own = pass(point.clone());
        let wanted = run(&mut own, procedure)?;
        let radicands = own.evaluate(&known)?;
        let mut pass = pass(point);
        let (mut outputs, mut values) = (Vec::new(), Vec::new());
        for (index, (symbols, program)) in parts.iter().enumerate() {
            let all = Run::new(program, &mut pass, angles.get(index), division).values()?;
            outputs = program.outputs.iter().map(|output| all[*output]).collect();
            if independent.is_some() && takes_roots_of_others(program, &all, &radicands) {
                takes_others.set(true);
            }
            values.push(all);
            for (symbol, value) in symbols.iter().zip(&outputs) {
                if !pass.choose(*symbol, *value) {
                    return Err(Defect::Wrong("a symbol has two values".into()));
                }
            }
        }
        if outputs != wanted {
            return Err(Defect::Wrong("it computes something else".into()));
        }
        if divisions.len() < 2 {
            divisions.push(Divisions::at((graph, procedure), &mut own, values));
        }
        Ok(())
    };
    let mut proof = at_points(bits, seeds, &mut agrees)?;
    if takes_others.get() {
        // nothing is known of these
        proof = at_points(1.0, seeds, &mut agrees)?;
    }
    let programs: Vec<&Program> = parts.iter().map(|(_, program)| *program).collect();
    match <[Divisions; 2]>::try_from(divisions) {
        Ok(points) if are_those_of_the_procedure(&programs, &points) => Ok(proof),
        _ => Err(Defect::Unknown(OTHER_DIVISOR.into())),
    }
}

/// Whether a program takes even roots of more than numbers that are not among radicands, by their values at a point.
fn takes_roots_of_others(program: &Program, values: &Table<Value, Residue>, radicands: &[Residue]) -> bool {
    program.steps.iter().any(|step| {
        let radicand = match step {
            Step::Sqrt(x) => x,
            Step::PowReal(x, exponent) if exponent.denominator().is_even() => x,
            _ => return false,
        };
        !matches!(program.steps[*radicand], Step::Constant(_)) && !radicands.contains(&values[*radicand])
    })
}

/// The argument of a periodic function or an exponential.
fn angle(step: &Step) -> Option<Value> {
    use Function::{Cos, Cosh, Exp, Sin, Sinh, Tanh};
    match step {
        Step::SinCos(x) | Step::Apply(Sin | Cos | Exp | Sinh | Cosh | Tanh, x) => Some(*x),
        _ => None,
    }
}

/// The angles of a program as expressions of what is no arithmetic.
struct Angles {
    graph: Graph,
    arguments: FxHashMap<Value, ExprId>,
    functions: FxHashMap<(Function, Value), ExprId>,
    /// The symbols of values that are taken as they are.
    atoms: FxHashMap<Value, SymbolId>,
}

impl Angles {
    fn of(program: &Program) -> Self {
        // 1. what angles are made of by arithmetic
        let mut needed = vec![false; program.steps.len()];
        let mut arguments: FxHashMap<Value, ExprId> = FxHashMap::default();
        for step in &program.steps {
            if let Some(x) = angle(step) {
                needed[x.index()] = true;
            }
        }
        for value in program.steps.ids().rev() {
            let step = &program.steps[value];
            if needed[value.index()] && is_arithmetic(step) {
                step.operands().into_iter().for_each(|operand| needed[operand.index()] = true);
            }
        }
        // 2. as expressions
        let mut graph = Graph::new();
        let mut atoms = FxHashMap::default();
        for (value, step) in program.steps.iter_ids().filter(|(value, _)| needed[value.index()]) {
            let of = |operand: &Value| arguments[operand];
            let expression = match step {
                Step::Constant(number) => graph.number(number.clone()),
                Step::Pi => graph.pi(),
                Step::Add(a, b) => graph.formula(of(a) + of(b)),
                Step::Sub(a, b) => graph.formula(of(a) - of(b)),
                Step::Mul(a, b) => graph.formula(of(a) * of(b)),
                Step::Neg(a) => graph.formula(-of(a)),
                Step::MulAdd { a, b, c, minus_product, minus_c } => {
                    let sign = |minus: bool| if minus { Rational::MINUS_ONE } else { Rational::ONE };
                    let product = graph.formula(of(a) * of(b));
                    graph.linear_combination(&[(sign(*minus_product), product), (sign(*minus_c), of(c))])
                }
                _ => {
                    let symbol = graph.new_symbol("angle");
                    atoms.insert(value, symbol);
                    graph.symbol(symbol)
                }
            };
            arguments.insert(value, expression);
        }
        // 3. with what is made of them
        let mut functions = FxHashMap::default();
        for step in &program.steps {
            if let Some((function, angle)) = applied(program, step) {
                let Some(expression) = arguments.get(&angle) else { continue };
                functions.insert((function, angle), graph.apply(function, *expression));
            }
        }
        Self { graph, arguments, functions, atoms }
    }

    fn functions(&self) -> Vec<ExprId> {
        self.functions.values().copied().collect()
    }
}

/// The function that a step applies, with its argument.
fn applied(program: &Program, step: &Step) -> Option<(Function, Value)> {
    let angle = |pair: &Value| match &program.steps[*pair] {
        Step::SinCos(angle) => *angle,
        _ => *pair,
    };
    match step {
        Step::SinOf(pair) => Some((Function::Sin, angle(pair))),
        Step::CosOf(pair) => Some((Function::Cos, angle(pair))),
        Step::Apply(function, x) => Some((*function, *x)),
        _ => None,
    }
}

fn is_arithmetic(step: &Step) -> bool {
    matches!(step, Step::Add(..) | Step::Sub(..) | Step::Mul(..) | Step::Neg(_) | Step::MulAdd { .. })
}

/// A program at a point.
struct Run<'r, 'a> {
    program: &'r Program,
    pass: &'r mut FieldPass<'a>,
    /// Its angles, evaluated beside it.
    angles: Option<(&'r Angles, FieldPass<'r>)>,
    values: Table<Value, Residue>,
    /// Whether they are the same at all points.
    is_constant: Table<Value, bool>,
    solutions: FxHashMap<Value, Vec<Residue>>,
}

impl<'r, 'a> Run<'r, 'a> {
    fn new(
        program: &'r Program,
        pass: &'r mut FieldPass<'a>,
        angles: Option<&'r Angles>,
        division: i64,
    ) -> Self {
        let point = FieldPoint::random(pass.seed());
        let angles = angles.map(|angles| (angles, FieldPass::without_arcs(&angles.graph, point, division)));
        let (values, is_constant, solutions) = Default::default();
        Self { program, pass, angles, values, is_constant, solutions }
    }

    /// Every value.
    fn values(mut self) -> Result<Table<Value, Residue>, Defect> {
        limits::spend(self.program.steps.len());
        for (value, step) in self.program.steps.iter_ids() {
            let result = self.step(value, step)?;
            self.values.push(result);
            let is_loaded = matches!(step, Step::Load(_) | Step::Call { .. } | Step::Component(..));
            let is_constant = !is_loaded && step.operands().iter().all(|operand| self.is_constant[*operand]);
            self.is_constant.push(is_constant);
            if let Some((angles, pass)) = &mut self.angles
                && let Some(symbol) = angles.atoms.get(&value)
                && !pass.choose(*symbol, result)
            {
                return Err(Defect::Wrong("an angle has two values".into()));
            }
        }
        Ok(self.values)
    }

    fn step(&mut self, value: Value, step: &Step) -> Result<Residue, Defect> {
        let of = |value: &Value| self.values[*value];
        let signed = |value: Residue, minus: bool| if minus { -value } else { value };
        let inverse = |value: &Value| of(value).inverse().ok_or(Defect::Here);
        if let Some((function, argument)) = applied(self.program, step) {
            return self.function(function, argument);
        }
        match step {
            Step::Constant(number) => Residue::of(number).ok_or(Defect::Here),
            Step::Pi => Ok(self.pass.pi()),
            Step::Load(symbol) => Ok(self.pass.symbol(*symbol)),
            Step::Add(a, b) => Ok(of(a) + of(b)),
            Step::Sub(a, b) => Ok(of(a) - of(b)),
            Step::Mul(a, b) => Ok(of(a) * of(b)),
            Step::MulAdd { a, b, c, minus_product, minus_c } => {
                Ok(signed(of(a) * of(b), *minus_product) + signed(of(c), *minus_c))
            }
            Step::Div(a, b) => Ok(of(a) * inverse(b)?),
            Step::Neg(a) => Ok(-of(a)),
            Step::Recip(a) => inverse(a),
            Step::Sqrt(a) => self.power(*a, &Rational::new(1, 2)),
            Step::Cbrt(a) => self.power(*a, &Rational::new(1, 3)),
            Step::PowReal(a, exponent) => self.power(*a, exponent),
            Step::Apply2(function, x, y) => Ok(self.pass.function_of_values(*function, of(x), of(y))),
            Step::Call { method, arguments } => {
                let arguments: Vec<Residue> = arguments.iter().map(of).collect();
                Ok(self.pass.kernel(method, &arguments))
            }
            Step::Solve { matrix, right } => {
                let row = |(row, right): (&Vec<Value>, &Value)| row.iter().chain([right]).map(of).collect();
                let echelon = Echelon::of(matrix.iter().zip(right).map(row).collect());
                if echelon.pivots.iter().copied().ne(0..right.len()) {
                    return Err(Defect::Here);
                }
                let unknowns = echelon.rows.iter().map(|row| row[right.len()]).collect();
                self.solutions.insert(value, unknowns);
                Ok(Residue::ZERO)
            }
            Step::Component(solution, index) => Ok(self.solutions[solution][*index]),
            // applied, and taken apart, by other steps
            Step::SinCos(_) | Step::SinOf(_) | Step::CosOf(_) | Step::Apply(..) => Ok(Residue::ZERO),
        }
    }

    fn power(&self, base: Value, exponent: &Rational) -> Result<Residue, Defect> {
        let radicand = match &self.program.steps[base] {
            Step::Constant(number) => Radicand::Number(number),
            _ if self.is_constant[base] => Radicand::Constant,
            _ => Radicand::Varying,
        };
        Ok(self.pass.power_of_value(self.values[base], radicand, exponent)?)
    }

    fn function(&mut self, function: Function, argument: Value) -> Result<Residue, Defect> {
        // where it is not 0, a square root is positive
        if function == Function::Sign && matches!(self.program.steps[argument], Step::Sqrt(_)) {
            return Residue::of(&Rational::ONE).ok_or(Defect::Here);
        }
        if let Some((angles, pass)) = &mut self.angles
            && let Some(expression) = angles.functions.get(&(function, argument))
        {
            return Ok(pass.evaluate(&[*expression])?[0]);
        }
        Ok(self.pass.function_of_value(function, self.values[argument])?)
    }
}

/// A bound on the degree of the outputs.
fn degree_of(graph: &Graph, program: &Program, angles: Option<&Angles>, division: i64) -> f64 {
    let mut degrees = Degrees::new(graph, division);
    let mut known: Table<Value, Degree> = Table::new();
    let (mut kernels, mut arguments) = (0.0_f64, 0.0_f64);
    for (value, step) in program.steps.iter_ids() {
        let of = |value: &Value| known[*value].clone();
        let power = |degrees: &mut Degrees, base: &Value, exponent: f64| {
            degrees.of_steps(&[(base.index(), &known[*base], exponent)])
        };
        let degree = match step {
            Step::Constant(_) | Step::Pi => Degree::polynomial(0.0),
            Step::Add(a, b) | Step::Sub(a, b) => degrees.of_sum(&[of(a), of(b)]),
            Step::Mul(a, b) => {
                degrees.of_steps(&[(a.index(), &known[*a], 1.0), (b.index(), &known[*b], 1.0)])
            }
            Step::MulAdd { a, b, c, .. } => {
                let product = degrees.of_steps(&[(a.index(), &known[*a], 1.0), (b.index(), &known[*b], 1.0)]);
                degrees.of_sum(&[product, of(c)])
            }
            Step::Div(a, b) => {
                degrees.of_steps(&[(a.index(), &known[*a], 1.0), (b.index(), &known[*b], -1.0)])
            }
            Step::Neg(a) | Step::SinCos(a) | Step::Component(a, _) => of(a),
            Step::Recip(a) => power(&mut degrees, a, -1.0),
            Step::Sqrt(a) => power(&mut degrees, a, 0.5),
            Step::Cbrt(a) => power(&mut degrees, a, 1.0 / 3.0),
            Step::PowReal(a, exponent) => power(&mut degrees, a, exponent.to_f64()),
            Step::SinOf(pair) | Step::CosOf(pair) | Step::Apply(_, pair) => {
                kernels += 1.0;
                arguments = arguments.max(degrees.size(&known[*pair]));
                let argument = applied(program, step).map_or(*pair, |(_, argument)| argument);
                let expression = angles.and_then(|angles| Some((angles, *angles.arguments.get(&argument)?)));
                let turns_of = |(angles, x): (&Angles, ExprId)| {
                    angles.graph.angle_turns(x, division, &FxHashMap::default()).max(1.0)
                };
                let turns = expression.map_or(1.0, turns_of);
                degrees.quotient_at(argument.index(), 2.0 * turns)
            }
            Step::Load(_) | Step::Apply2(..) | Step::Call { .. } => Degree::polynomial(1.0),
            Step::Solve { matrix, right } => {
                // Cramer: determinants of so many rows
                let rows = matrix.iter().zip(right);
                let size = |entry: &Value| degrees.size(&known[*entry]);
                let row =
                    |(row, right): (&Vec<Value>, &Value)| row.iter().chain([right]).map(size).sum::<f64>();
                let size = rows.map(row).sum();
                degrees.quotient_at(value.index(), size)
            }
        };
        known.push(degree);
    }
    let outputs = program.outputs.iter().map(|output| degrees.size(&known[*output]));
    // two kernels are one where their arguments happen to be equal
    outputs.fold(1.0, f64::max) + kernels * kernels * arguments
}
