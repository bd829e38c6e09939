//! The functions that are generated for a system: each is a value, made where it is derived and carried
//! through slicing, Routh reduction and scheduling to the printer as a member of one list.

mod table;

use crate::algebra::Graph;
use crate::id::{ExprId, SymbolId};
use crate::mechanics::Procedure;
use crate::model::Request;

pub use table::*;

/// What a function is called, what it takes and what it gives: a line of the table.
#[derive(Debug)]
pub struct Signature {
    /// The name of the generated method.
    pub name: &'static str,
    /// Its documentation, a line each.
    pub doc: &'static [&'static str],
    /// Whether it takes the inputs, beside time and state.
    pub takes_input: bool,
    /// What it gives.
    pub shape: Shape,
    /// When it is generated.
    pub when: When,
    /// What becomes of it where `track` leaves out state variables.
    pub sliced: Sliced,
}

/// What a function gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// One number.
    Scalar,
    /// A record.
    Record(Record),
    /// The state over the same point of the base, with these velocities.
    OverThePoint,
    /// Nested arrays, by their lengths, the outermost first.
    Array(&'static [Size]),
    /// A matrix, row by row.
    Matrix(Size, Size),
    /// Two matrices, the derivatives by the state and by the inputs; rows of both together, one after the other.
    ByStateAndInput(Size),
    /// The power of forces and of constraints, a record each.
    Power,
}

/// The generated structs that functions give.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Record {
    /// The state.
    State,
    /// All quasi-velocities.
    Velocity,
    /// The declared observables.
    Outputs,
    /// λ_A.
    Multipliers,
    /// λ_A Φ^A_α.
    Reactions,
    /// φ^A.
    Residual,
    /// The momenta of the symmetries.
    Momenta,
    /// The rates that are left to quadratures.
    Quadratures,
    /// The gyroscopic force of a Chaplygin system.
    Gyroscopic,
    /// Υ_α y^α for each declared force.
    PowerOfForces,
    /// λ_A y^α ∂φ^A/∂y^α for each constraint.
    PowerOfConstraints,
}

/// A number that a declaration determines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Size {
    /// The variables of the state.
    State,
    /// The velocities among them.
    Velocities,
    /// The sections of the basis.
    Sections,
    /// The declared observables.
    Outputs,
    /// The numbers in the fields of the struct.
    Parameters,
    /// The rank of S = D ∩ V.
    Vertical,
    /// The coordinates of the horizontal lifts.
    Lifted,
}

/// The numbers of a system.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sizes {
    /// The variables of the state.
    pub state: usize,
    /// The velocities among them.
    pub velocities: usize,
    /// The sections of the basis.
    pub sections: usize,
    /// The declared observables.
    pub outputs: usize,
    /// The numbers in the fields of the struct.
    pub parameters: usize,
    /// The rank of S = D ∩ V.
    pub vertical: usize,
    /// The coordinates of the horizontal lifts.
    pub lifted: usize,
}

impl Sizes {
    /// The number that is meant.
    #[must_use]
    pub fn of(&self, size: Size) -> usize {
        match size {
            Size::State => self.state,
            Size::Velocities => self.velocities,
            Size::Sections => self.sections,
            Size::Outputs => self.outputs,
            Size::Parameters => self.parameters,
            Size::Vertical => self.vertical,
            Size::Lifted => self.lifted,
        }
    }
}

/// When a function is generated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum When {
    /// Always, if what it needs is there.
    Always,
    /// Where it is asked for in `emit { … }`.
    Asked(Request),
    /// With symmetries, or where momenta are asked for.
    WithSymmetries,
    /// With outputs.
    WithOutputs,
    /// With a section of D* that is claimed to solve the Hamilton–Jacobi equation.
    WithSection,
    /// With constraints, in the projected formulation.
    WithConstraints,
    /// Where Routh reduction leaves coordinates to it.
    WithQuadratures,
}

/// What becomes of a function where `track` leaves out state variables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sliced {
    /// It has a component for each state variable: those of the others go.
    Rows,
    /// If it depends on one of them it is left out, or refused where it is asked for, under this name.
    Named(&'static str),
    /// It may not be asked for if any is left out.
    Whole,
    /// It has a component, or a row, for each output: those of outputs that depend on one of them go.
    Outputs,
    /// It is of variables that no slice leaves out.
    Kept,
}

/// A generated function: its line of the table, and how it is computed.
#[derive(Clone, Debug)]
pub struct Function {
    /// What it is called, takes and gives.
    pub signature: &'static Signature,
    /// How it is computed.
    pub procedure: Procedure,
}

/// The functions of a system, in the order of the table.
#[derive(Clone, Debug, Default)]
pub struct Functions(Vec<Function>);

impl Functions {
    /// Adds a function at its place; one that gives a struct without fields is none.
    pub fn add(&mut self, signature: &'static Signature, procedure: Procedure) {
        let is_always_there = matches!(signature.shape, Shape::Record(Record::State | Record::Velocity));
        if matches!(signature.shape, Shape::Record(_)) && !is_always_there && procedure.outputs.is_empty() {
            return;
        }
        let place = |signature: &Signature| TABLE.iter().position(|line| line.name == signature.name);
        let at = self.0.partition_point(|function| place(function.signature) <= place(signature));
        self.0.insert(at, Function { signature, procedure });
    }

    /// The same, if there is one.
    pub fn add_if(&mut self, signature: &'static Signature, procedure: Option<Procedure>) {
        if let Some(procedure) = procedure {
            self.add(signature, procedure);
        }
    }

    /// How a function is computed, if it is there.
    #[must_use]
    pub fn get(&self, signature: &Signature) -> Option<&Procedure> {
        self.iter().find(|function| function.signature.name == signature.name).map(|f| &f.procedure)
    }

    /// All of them.
    pub fn iter(&self) -> impl Iterator<Item = &Function> {
        self.0.iter()
    }

    /// All of them, to be changed.
    pub fn iter_mut(&mut self) -> impl Iterator<Item = &mut Function> {
        self.0.iter_mut()
    }

    /// Leaves out those that are not wanted.
    pub fn retain(&mut self, wanted: impl FnMut(&Function) -> bool) {
        self.0.retain(wanted);
    }

    /// Those of both.
    pub fn extend(&mut self, others: Self) {
        for function in others.0 {
            self.add(function.signature, function.procedure);
        }
    }

    /// Whether any of them depends on a symbol.
    #[must_use]
    pub fn depend_on(&self, graph: &Graph, symbol: SymbolId) -> bool {
        self.iter().any(|Function { procedure, .. }| {
            procedure.depends_on(graph, &procedure.outputs).contains(&symbol)
        })
    }
}

impl Signature {
    /// The word in `emit { … }` by which it may be asked for.
    #[must_use]
    pub fn request(&self) -> Option<Request> {
        match self.when {
            When::Asked(request) => Some(request),
            When::WithSymmetries => Some(Request::Momenta),
            _ => None,
        }
    }
}

impl Function {
    /// Keeps the outputs of the rows that are wanted, of as many as there are rows.
    pub(crate) fn keep_rows(&mut self, rows: usize, is_kept: impl Fn(usize) -> bool) {
        let width = self.procedure.outputs.len() / rows.max(1);
        let chunks = self.procedure.outputs.chunks(width.max(1)).enumerate();
        let kept: Vec<ExprId> =
            chunks.filter(|(row, _)| is_kept(*row)).flat_map(|(_, row)| row.to_vec()).collect();
        self.procedure.outputs = kept;
    }
}
