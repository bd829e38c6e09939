//! A verified system: what the derivation hands to the back end.

use crate::choose::Ledger;
use crate::functions::{self, Functions, Sizes};
use crate::id::{ExprId, SymbolId};
use crate::mechanics::Procedure;
use crate::model::{Formulation, Model};
use crate::phase_space::PhaseSpace;
use crate::program::Limits;

/// A system that has passed every check, with its functions derived.
#[derive(Clone, Debug)]
pub struct System {
    /// The declaration; its graph holds every derived expression.
    pub model: Model,
    /// The form of the equations.
    pub formulation: Formulation,
    /// The coordinates in the state, in declared order: all of them, unless `track` leaves some out.
    pub state_coordinates: Vec<SymbolId>,
    /// The velocities in the state, in declared order: all of them in the projected formulation.
    pub state_velocities: Vec<SymbolId>,
    /// The auxiliary states in the state, in declared order.
    pub state_auxiliary: Vec<SymbolId>,
    /// Outputs: ẋ^i for each coordinate in the state, then v̇ for each velocity, then ż for each auxiliary state.
    pub derivative: Procedure,
    /// The functions that are generated beside the derivative.
    pub functions: Functions,
    /// The labels of the symmetries whose momenta are among them.
    pub momenta: Vec<String>,
    /// The coordinates along which the gyroscopic force acts, if that is among them.
    pub gyroscopic: Vec<SymbolId>,
    /// The coordinates that are left to quadratures, since nothing depends on them.
    pub quadratures: Vec<SymbolId>,
    /// Outputs: the derivative, then ∂derivative/∂(state, input) row by row, in one; if asked for.
    pub linearized: Option<Procedure>,
    /// Products of that Jacobian with vectors, as far as they are asked for.
    pub products: Vec<VectorProduct>,
    /// The way back to the constraint manifold; in the projected formulation.
    pub projection: Option<Projection>,
    /// The way back to position constraints, if there are any.
    pub positions: Option<PositionReturn>,
    /// What velocities jump to.
    pub impacts: Vec<ImpactForm>,
    /// What linearising the motion on the constraint manifold takes; if asked for.
    pub linearization: Option<Linearization>,
    /// Brackets, momenta, volume and connections; as far as they are asked for.
    pub phase_space: PhaseSpace,
    /// The identities of an embedded base.
    pub embedding: Option<Embedding>,
    /// What `validate` checks beyond finite parameters.
    pub parameter_checks: Vec<ParameterCheck>,
    /// What was chosen among forms, and how it was proved.
    pub ledger: Ledger,
    /// What was derived, as text.
    pub report: String,
    /// The equations of motion as lines of text for the documentation of the struct, and what it says beside them.
    pub equations: Vec<String>,
    /// The sections of a text in TeX about it, if that is asked for.
    pub latex: Option<String>,
    /// Whether derivatives that are asked for tend to values where roots vanish by which they divide: what is emitted has to
    /// have these.
    pub derivatives_go_on: bool,
}

impl System {
    /// The state: coordinates, then velocities, then auxiliary states.
    #[must_use]
    pub fn state(&self) -> Vec<SymbolId> {
        [self.state_coordinates.as_slice(), &self.state_velocities, &self.state_auxiliary].concat()
    }

    /// ∂derivative/∂(state, input) row by row; if asked for.
    #[must_use]
    pub fn jacobian(&self) -> Option<Procedure> {
        let linearized = self.linearized.as_ref()?;
        let rows = linearized.outputs.get(self.derivative.outputs.len()..)?;
        Some(linearized.with_outputs(rows.to_vec()))
    }

    /// What is known of derivatives of the motion where lengths vanish by which they divide.
    #[must_use]
    pub fn limits_at_rest(&self) -> Limits {
        if self.derivatives_go_on { Limits::WithoutQuotients } else { Limits::Open }
    }

    /// The numbers that the shapes of its functions are made of.
    #[must_use]
    pub fn sizes(&self) -> Sizes {
        let count = |signature| self.functions.get(signature).map_or(0, |f: &Procedure| f.outputs.len());
        let sections = self.model.sections.len();
        Sizes {
            state: self.state().len(),
            velocities: self.state_velocities.len(),
            sections,
            outputs: self.model.outputs.len(),
            parameters: self.model.parameters.len(),
            vertical: count(&functions::VERTICAL_MOMENTA),
            lifted: count(&functions::HORIZONTAL_LIFTS) / sections.max(1),
        }
    }
}

/// A product of the Jacobian of the derivative by state and inputs with a vector.
#[derive(Clone, Debug)]
pub struct VectorProduct {
    /// Where the vector stands.
    pub side: Side,
    /// Its components: a direction in state and inputs, or weights of the components of the derivative.
    pub vector: Vec<SymbolId>,
    /// Outputs: a component for each of the derivative, or for each variable of the state, then for each input.
    pub procedure: Procedure,
}

/// On which side of a matrix a vector stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// J w.
    Right,
    /// Jᵀ p.
    Left,
}

impl Side {
    /// The word that asks for the product, and the name of its method.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Right => "jacobian_product",
            Self::Left => "adjoint_product",
        }
    }
}

/// An expression of parameters alone by which the equations divide.
#[derive(Clone, Debug)]
pub struct ParameterCheck {
    /// The expression that must not vanish.
    pub nonzero: ExprId,
    /// Its text in the declaration's syntax.
    pub text: String,
}

/// A Newton iteration for the point of the constraint manifold nearest to where it starts, in the
/// kinetic metric.
#[derive(Clone, Debug)]
pub struct Projection {
    /// The symbols of the velocities where the iteration started.
    pub start: Vec<SymbolId>,
    /// Outputs: the next velocities, from the present and the starting ones.
    pub step: Procedure,
}

/// Position constraints, and the way back to where they hold.
#[derive(Clone, Debug)]
pub struct PositionReturn {
    /// The labels of those that follow from others: they come last, and have no multiplier.
    pub redundant: Vec<Option<String>>,
    /// How many there are.
    pub count: usize,
    /// Outputs: what should be zero, for each of them.
    pub residual: Procedure,
    /// Outputs: how one Newton step changes the base coordinates.
    pub step: Procedure,
    /// Outputs: how the velocities in the state change to satisfy all constraints where they are; `None` where these
    /// hold by themselves, and where they are not affine in the velocities: then there is a [`Projection`].
    pub velocities: Option<Procedure>,
    /// Outputs: what the constraints were divided by to solve them for velocities, as far as it depends on the
    /// configuration; nothing in the projected formulation.
    pub pivots: Procedure,
    /// What is solved from a rough start.
    pub assembly: Assembly,
    /// The derivatives of the way back, if they are asked for.
    pub slopes: Option<SlopesOfReturn>,
}

/// The derivatives of one step back to position constraints, row by row.
#[derive(Clone, Debug)]
pub struct SlopesOfReturn {
    /// Those of the changes of the coordinates by the components of the state.
    pub positions: Procedure,
    /// Those of the change of velocities by the components of the state, with the coordinates where they have moved; with
    /// a [`Projection`] those of the next velocities, by the coordinates, the starting velocities, and the rest of the
    /// state; `None` where they stay.
    pub velocities: Option<Procedure>,
}

/// What assembling a machine from a rough start solves.
#[derive(Clone, Debug)]
pub struct Assembly {
    /// The identities of the base among the equations, by position.
    pub identities: Vec<usize>,
    /// How many equations of positions are independent: position constraints, then identities.
    pub independent: usize,
    /// Position constraints, identities, and what follows from the others, by the coordinates in the state.
    pub positions: Linearized,
    /// How many constraints on velocities there are.
    pub constraints: usize,
    /// Constraints on velocities, then the rates of the coordinates, by the velocities in the state.
    pub velocities: Linearized,
}

impl Assembly {
    /// Leaves out coordinates that are not kept, by position, and derivatives by variables that are not.
    pub(crate) fn restrict(&mut self, has_rate: impl Fn(usize) -> bool, is_kept: impl Fn(SymbolId) -> bool) {
        self.positions.keep(&is_kept);
        let constraints = self.constraints;
        self.velocities.keep_rows(|row| row < constraints || has_rate(row - constraints));
        self.velocities.keep(&is_kept);
    }
}

/// What linearising the motion on the constraint manifold takes beside the motion: mathematics (36).
#[derive(Clone, Debug)]
pub struct Linearization {
    /// The variables that are kept, by their places in the state.
    pub kept: Vec<usize>,
    /// Outputs: what vanishes on the manifold, the constraints that a state can be off and then the identities of an
    /// embedded base.
    pub residuals: Procedure,
}

/// An impact: mathematics (50).
#[derive(Clone, Debug)]
pub struct ImpactForm {
    /// Its label.
    pub label: String,
    /// What the rows are called.
    pub names: Vec<String>,
    /// For each row, its place among the outputs of `gaps`; none for a row on velocities.
    pub places: Vec<Option<usize>>,
    /// Which rows push and never pull.
    pub unilateral: Vec<bool>,
    /// Whether the rows and the constraints are homogeneous in the velocities: b = 0.
    pub is_homogeneous: bool,
    /// Outputs: h of each row on positions.
    pub gaps: Procedure,
    /// Outputs: x^i ∂_i h, row by row, by which a gap is known up to rounding.
    pub terms: Procedure,
    /// Output: e.
    pub restitution: Procedure,
    /// Outputs: Ψ y + b of each row; C⁻¹ Nᵀ, row by row; K = N C⁻¹ Nᵀ, row by row.
    pub jump: Procedure,
}

impl ImpactForm {
    /// Every procedure, with what it is a part of.
    pub(crate) fn procedures(&mut self) -> [&mut Procedure; 4] {
        [&mut self.gaps, &mut self.terms, &mut self.restitution, &mut self.jump]
    }
}

/// Functions with their derivatives.
#[derive(Clone, Debug)]
pub struct Linearized {
    /// How many functions there are.
    pub rows: usize,
    /// By what they are differentiated.
    pub by: Vec<SymbolId>,
    /// Outputs: the functions, then their derivatives row by row.
    pub procedure: Procedure,
}

impl Linearized {
    /// Leaves out derivatives by what is not kept.
    pub(crate) fn keep(&mut self, is_kept: impl Fn(SymbolId) -> bool) {
        let by: Vec<bool> = self.by.iter().map(|symbol| is_kept(*symbol)).collect();
        let (values, slopes) = self.procedure.outputs.split_at(self.rows);
        let kept = slopes.iter().zip(by.iter().cycle()).filter(|(_, is_kept)| **is_kept);
        self.procedure.outputs = values.iter().copied().chain(kept.map(|(slope, _)| *slope)).collect();
        self.by.retain(|symbol| is_kept(*symbol));
    }

    /// Leaves out functions that are not kept, by position.
    pub(crate) fn keep_rows(&mut self, is_kept: impl Fn(usize) -> bool) {
        let width = self.by.len();
        let (values, slopes) = self.procedure.outputs.split_at(self.rows);
        let rows: Vec<usize> = (0..self.rows).filter(|row| is_kept(*row)).collect();
        let values = rows.iter().map(|row| values[*row]);
        let slopes = rows.iter().flat_map(|row| &slopes[row * width..(row + 1) * width]);
        self.procedure.outputs = values.chain(slopes.copied()).collect();
        self.rows = rows.len();
    }
}

/// Identities that embedded base coordinates satisfy, and the way back to them.
#[derive(Clone, Debug)]
pub struct Embedding {
    /// Each identity as text.
    pub texts: Vec<String>,
    /// Outputs: what should be zero, for each identity.
    pub residual: Procedure,
    /// Outputs: the base coordinates after one Newton step.
    pub step: Procedure,
}
