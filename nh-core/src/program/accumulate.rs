//! Derivatives of procedures from the partial derivatives of the steps of their programs: Jacobians, and their
//! products with vectors from either side.
//!
//! A linear system C x = f in a procedure is not differentiated through its solution: with x held, the residuals
//! f − C x are functions like others, and ∂x = C⁻¹ ∂(f − C x) takes the factors that x was found with. Products
//! from the left take them as well: what x̄ is to x, C⁻ᵀ x̄ is to the residuals.

use super::opened::{OpenSystem, Opened};
use super::schedule::schedule_grouping;
use super::step::{Program, Step};
use super::tape::Tape;
use super::vertex_order::{Edges, IsUnit, Vertex};
use crate::algebra::{Graph, Node, Rational};
use crate::id::{ExprId, Id, SymbolId};
use crate::mechanics::{NotDifferentiable, Procedure};
use rustc_hash::FxHashMap;

/// Which linear systems are differentiated as such.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Systems {
    /// Those that are solved with pivoting.
    Pivoted,
    /// All.
    All,
}

/// Which derivatives are wanted.
#[derive(Clone, Copy, Debug)]
pub enum Wanted<'w> {
    /// ∂output/∂argument, row by row: one row for each output.
    Jacobian,
    /// The outputs, then the same.
    Linearized,
    /// The derivatives of the outputs along the direction with these components.
    AlongDirection(&'w [SymbolId]),
    /// The derivatives by the arguments of the sum of the outputs with these weights.
    OfWeightedSum(&'w [SymbolId]),
}

/// Derivatives of a procedure by its `arguments`, by elimination of the steps of its program; `None` where they are
/// better found in another way: there are no such systems, one depends on its own unknowns, or there are powers that
/// have more derivatives than the roots that they are computed by.
///
/// # Errors
/// Where an output depends on an argument through a method whose derivative is missing.
pub fn accumulated(
    graph: &mut Graph,
    procedure: &Procedure,
    (arguments, parameters): (&[SymbolId], &[SymbolId]),
    systems: Systems,
    wanted: Wanted,
) -> Result<Option<Procedure>, NotDifferentiable> {
    let is_other = systems == Systems::Pivoted || !procedure.solved.is_empty();
    if !is_other || has_powers_beyond_roots(graph, procedure) {
        return Ok(None);
    }
    let opened = Opened::of(graph, procedure, systems == Systems::All);
    let program = schedule_grouping(graph, &opened.procedure, parameters);
    let Some(tape) = Tape::of(graph, &program, &opened.systems, procedure) else { return Ok(None) };
    let rows = procedure.outputs.len();
    let mut accumulation = Accumulation::of(graph, tape, arguments, (&opened.systems, rows))?;
    let (rows, columns) = match wanted {
        Wanted::Jacobian | Wanted::Linearized => {
            if opened.systems.iter().any(OpenSystem::is_local) {
                accumulation.begin_at_sums(graph, arguments.len(), rows);
            }
            (0..rows, 0..arguments.len())
        }
        Wanted::AlongDirection(direction) => {
            accumulation.along(graph, direction);
            (0..rows, 0..1)
        }
        Wanted::OfWeightedSum(weights) => {
            accumulation.weigh(graph, weights);
            let sink = accumulation.rows.len() - 1;
            opened.systems.iter().rev().for_each(|system| accumulation.pull_back(graph, system));
            (sink..sink + 1, 0..arguments.len())
        }
    };
    accumulation.eliminate(graph);
    if !matches!(wanted, Wanted::OfWeightedSum(_)) {
        let sums = accumulation.sums.len();
        let all = columns.start..columns.end + sums;
        opened.systems.iter().for_each(|system| accumulation.push_forward(graph, system, all.clone()));
    }
    let values = match wanted {
        Wanted::Linearized => accumulation.tape.outputs(&rows).unwrap_or_default(),
        _ => Vec::new(),
    };
    let entries = rows.flat_map(|row| accumulation.row(graph, row, columns.clone()));
    let outputs = values.into_iter().chain(entries.collect::<Vec<ExprId>>()).collect();
    Ok(Some(accumulation.tape.procedure.with_outputs(outputs)))
}

/// Whether there is a power like x^(3/2): its derivative is finite at 0, and that of the root that it is computed
/// by is not.
fn has_powers_beyond_roots(graph: &Graph, procedure: &Procedure) -> bool {
    let is_beyond = |power: &Rational| !power.is_integer() && *power > Rational::ONE;
    graph.reachable(&procedure.expressions()).into_iter().any(|id| match graph.node(id) {
        Node::Product { factors, .. } => factors.iter().any(|(_, power)| is_beyond(power)),
        _ => false,
    })
}

/// Where ways begin.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Source {
    /// At an argument, or a direction.
    Column(usize),
    Unknown(SymbolId),
}

/// Derivatives on the way.
struct Accumulation<'p> {
    tape: Tape<'p>,
    /// The vertices of outputs and residuals, at their places among the outputs of the program, where these vary.
    rows: Vec<Option<Vertex>>,
    /// Vertices: steps, then rows, then one that all ways begin or end at.
    edges: Edges<ExprId>,
    sources: FxHashMap<Vertex, Source>,
    /// ∂x by a column, for each unknown, where it is not 0.
    columns: FxHashMap<(SymbolId, usize), ExprId>,
    /// What stands in columns after those of the arguments: each as a sum of columns before it.
    sums: Vec<SumOfColumns>,
}

/// ±1 times columns.
type SumOfColumns = Vec<(usize, ExprId)>;

impl<'p> Accumulation<'p> {
    /// The edges between steps that depend on arguments or unknowns and lead to outputs or residuals.
    fn of(
        graph: &mut Graph,
        mut tape: Tape<'p>,
        arguments: &[SymbolId],
        (systems, outputs): (&[OpenSystem], usize),
    ) -> Result<Self, NotDifferentiable> {
        let program: &Program = tape.program;
        let steps = program.steps.len();
        let unknowns = systems.iter().flat_map(|system| &system.unknowns);
        let columns = arguments.iter().enumerate().map(|(column, symbol)| (*symbol, Source::Column(column)));
        let starts: FxHashMap<SymbolId, Source> =
            unknowns.map(|symbol| (*symbol, Source::Unknown(*symbol))).chain(columns).collect();
        let mut sources = FxHashMap::default();
        let mut varies = vec![false; steps];
        for (value, step) in program.steps.iter_ids() {
            if let Step::Load(symbol) = step
                && let Some(source) = starts.get(symbol)
            {
                sources.insert(value.index(), *source);
                varies[value.index()] = true;
            }
            let mut varies_with_operands = false;
            step.each_operand(|operand| varies_with_operands |= varies[operand.index()]);
            varies[value.index()] |= varies_with_operands;
        }
        let residuals = systems.iter().flat_map(|system| system.residuals.clone());
        let places: Vec<usize> = (0..outputs).chain(residuals).collect();
        let mut is_needed = vec![false; steps];
        for place in &places {
            is_needed[program.outputs[*place].index()] = true;
        }
        for (index, step) in program.steps.iter().enumerate().rev() {
            if is_needed[index] {
                step.each_operand(|operand| is_needed[operand.index()] = true);
            }
        }
        let mut edges = Edges::new(steps + places.len() + 1);
        for (value, _) in program.steps.iter_ids() {
            let vertex = value.index();
            if !(varies[vertex] && is_needed[vertex]) {
                continue;
            }
            for (operand, partial) in tape.partials(graph, value, &|operand| varies[operand.index()])? {
                add(graph, &mut edges, (operand.index(), vertex), partial);
            }
        }
        let one = graph.one();
        let mut rows = vec![None; program.outputs.len()];
        for (row, place) in places.into_iter().enumerate() {
            let step = program.outputs[place].index();
            if varies[step] {
                edges.put(step, steps + row, one);
                rows[place] = Some(steps + row);
            }
        }
        Ok(Self { tape, rows, edges, sources, columns: FxHashMap::default(), sums: Vec::new() })
    }

    /// Lets all arguments change together.
    fn along(&mut self, graph: &mut Graph, direction: &[SymbolId]) {
        let start = self.edges.len() - 1;
        let arguments: Vec<(Vertex, usize)> = self
            .sources
            .iter()
            .filter_map(|(vertex, source)| match source {
                Source::Column(column) => Some((*vertex, *column)),
                Source::Unknown(_) => None,
            })
            .collect();
        for (vertex, column) in arguments {
            let component = graph.symbol(direction[column]);
            self.edges.put(start, vertex, component);
            self.sources.remove(&vertex);
        }
        self.sources.insert(start, Source::Column(0));
    }

    /// Adds the outputs with weights; the sum is one more row.
    fn weigh(&mut self, graph: &mut Graph, weights: &[SymbolId]) {
        let end = self.edges.len() - 1;
        for (row, weight) in self.rows.iter().zip(weights) {
            if let Some(row) = row {
                let weight = graph.symbol(*weight);
                self.edges.put(*row, end, weight);
            }
        }
        self.rows.push(Some(end));
    }

    /// What the weighted sum is by the unknowns of a system it is by its residuals: y = C⁻ᵀ x̄.
    fn pull_back(&mut self, graph: &mut Graph, system: &OpenSystem) {
        let end = self.edges.len() - 1;
        let is_unknown =
            |source: &Source| matches!(source, Source::Unknown(symbol) if system.unknowns.contains(symbol));
        let mut is_behind = vec![false; end];
        let mut behind: Vec<Vertex> = Vec::new();
        for vertex in 0..end {
            is_behind[vertex] = self.sources.get(&vertex).is_some_and(is_unknown)
                || self.edges.operands(vertex).keys().any(|before| is_behind[*before]);
            if is_behind[vertex] && !self.sources.contains_key(&vertex) {
                behind.push(vertex);
            }
        }
        behind.into_iter().rev().for_each(|vertex| self.eliminate_vertex(graph, vertex));
        let mut slopes: Vec<ExprId> = vec![graph.zero(); system.unknowns.len()];
        for (slope, unknown) in slopes.iter_mut().zip(&system.unknowns) {
            let place = |(vertex, source): (&Vertex, &Source)| {
                (*source == Source::Unknown(*unknown)).then_some(*vertex)
            };
            let Some(vertex) = self.sources.iter().find_map(place) else { continue };
            if let Some(weight) = self.edges.operands(end).get(&vertex) {
                *slope = *weight;
            }
            self.edges.take(vertex);
        }
        if slopes.iter().all(|slope| graph.is_literal_zero(*slope)) {
            return;
        }
        let solution = system.weights(graph, &mut self.tape, slopes);
        for (place, weight) in system.residuals.clone().zip(solution) {
            if let Some(row) = self.rows[place] {
                self.edges.put(row, end, weight);
            }
        }
    }

    /// Lets ways begin at sums of arguments, absolute angles among relative ones, say: a system of which each equation is
    /// about few of them has short columns for these. An argument that occurs in a sum alone has none of its own.
    fn begin_at_sums(&mut self, graph: &mut Graph, arguments: usize, outputs: usize) {
        let one = graph.one();
        let minus_one = graph.formula(-one);
        let is_output: Vec<Vertex> = self.rows[..outputs].iter().flatten().copied().collect();
        for vertex in 0..self.tape.program.steps.len() {
            let operands = self.edges.operands(vertex);
            let column = |(before, weight): (&Vertex, &ExprId)| match self.sources.get(before) {
                Some(Source::Column(column)) if *weight == one || *weight == minus_one => {
                    Some((*column, *weight))
                }
                _ => None,
            };
            let Some(sum) = operands.iter().map(column).collect::<Option<SumOfColumns>>() else { continue };
            let is_only_here = |before: &Vertex| {
                let mut after = self.edges.results(*before);
                after.all(|after| after == vertex || is_output.contains(&after))
            };
            if sum.len() < 2 || !operands.keys().any(is_only_here) {
                continue;
            }
            let [_, out] = self.edges.take(vertex);
            for (after, weight) in out {
                self.edges.put(vertex, after, weight);
            }
            self.sources.insert(vertex, Source::Column(arguments + self.sums.len()));
            self.sums.push(sum);
        }
    }

    /// Eliminates all that is left between sources and rows.
    fn eliminate(&mut self, graph: &mut Graph) {
        let vertices = self.edges.len();
        let mut is_row = vec![false; vertices];
        self.rows.iter().flatten().for_each(|row| is_row[*row] = !self.edges.leads_on(*row));
        for vertex in (0..vertices).rev() {
            if !self.edges.leads_on(vertex) && !is_row[vertex] {
                self.edges.take(vertex);
            }
        }
        let inner: Vec<Vertex> = (0..vertices)
            .filter(|vertex| self.edges.leads_on(*vertex) && !self.edges.operands(*vertex).is_empty())
            .collect();
        let one = graph.one();
        let minus_one = graph.formula(-one);
        let units = self.edges.map(|weight| IsUnit(weight == one || weight == minus_one));
        units.cheapest_order(&inner).into_iter().for_each(|vertex| self.eliminate_vertex(graph, vertex));
    }

    fn eliminate_vertex(&mut self, graph: &mut Graph, vertex: Vertex) {
        let [mut into, mut out] = self.edges.take(vertex);
        let (ways_in, ways_out) = (into.len(), out.len());
        // what is multiplied several times is an intermediate result
        for (weights, times) in [(&mut into, ways_out), (&mut out, ways_in)] {
            if times > 1 {
                for (_, weight) in weights {
                    *weight = self.tape.procedure.define(graph, "", *weight);
                }
            }
        }
        for (before, first) in &into {
            for (after, second) in &out {
                let product = graph.formula(*second * *first);
                add(graph, &mut self.edges, (*before, *after), product);
            }
        }
    }

    /// The derivatives of a row by the arguments: by those of the columns that are sums of theirs.
    fn row(&mut self, graph: &mut Graph, place: usize, arguments: std::ops::Range<usize>) -> Vec<ExprId> {
        let all = arguments.end + self.sums.len();
        let mut terms: Vec<Vec<ExprId>> =
            (arguments.start..all).map(|column| vec![self.entry(graph, place, column)]).collect();
        for (column, sum) in (arguments.end..all).zip(&self.sums).rev() {
            let total = graph.sum(&terms[column - arguments.start]);
            let total = self.tape.procedure.define(graph, "", total);
            for (other, weight) in sum {
                terms[*other - arguments.start].push(graph.formula(*weight * total));
            }
        }
        terms[..arguments.len()].iter().map(|terms| graph.sum(terms)).collect()
    }

    /// The derivative of a row by a column, by way of the unknowns whose derivatives are known.
    fn entry(&self, graph: &mut Graph, place: usize, column: usize) -> ExprId {
        let mut terms = Vec::new();
        if let Some(vertex) = self.rows[place] {
            for (before, weight) in self.edges.operands(vertex) {
                match self.sources.get(before) {
                    Some(Source::Column(other)) if *other == column => terms.push(*weight),
                    Some(Source::Unknown(symbol)) => {
                        if let Some(change) = self.columns.get(&(*symbol, column)) {
                            terms.push(graph.formula(*weight * *change));
                        }
                    }
                    _ => {}
                }
            }
        }
        graph.sum(&terms)
    }

    /// ∂x = C⁻¹ ∂(f − C x).
    fn push_forward(&mut self, graph: &mut Graph, system: &OpenSystem, columns: std::ops::Range<usize>) {
        for column in columns {
            let right: Vec<ExprId> =
                system.residuals.clone().map(|row| self.entry(graph, row, column)).collect();
            if right.iter().all(|entry| graph.is_literal_zero(*entry)) {
                continue;
            }
            let solution = system.changes(graph, &mut self.tape, right);
            for (unknown, value) in system.unknowns.iter().zip(solution) {
                if !graph.is_literal_zero(value) {
                    self.columns.insert((*unknown, column), value);
                }
            }
        }
    }
}

/// Adds a weight to an edge.
fn add(graph: &mut Graph, edges: &mut Edges<ExprId>, (before, after): (Vertex, Vertex), weight: ExprId) {
    let known = edges.operands(after).get(&before).copied();
    let sum = known.map_or(weight, |known| graph.formula(known + weight));
    edges.put(before, after, sum);
}
