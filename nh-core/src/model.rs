//! A declared system with its names resolved: what the front end hands over.
//!
//! Nothing is proved yet. Positions in the declaration are opaque [`Origin`]s.

mod impact;
mod position;
mod request;

pub use crate::mechanics::{Attitude, Body, Inertia, Turn};
pub use impact::{ImpactDecl, ImpactRowDecl};
pub use position::PositionDecl;
pub use request::Request;

use crate::algebra::{Facts, Graph};
use crate::geometry::Clock;
use crate::id::{ConstraintId, CoordId, ExprId, InputId, Origin, ParamId, SectionId, SymbolId, Table};
use crate::units::Quantity;

/// A declaration with its names resolved.
#[derive(Clone, Debug)]
pub struct Model {
    /// The expressions of the declaration.
    pub graph: Graph,
    /// The name of the annotated struct.
    pub name: String,
    /// Where the name of the struct stands: blamed when a section is missing.
    pub origin: Origin,
    /// The time `t`.
    pub time: SymbolId,
    /// Scalar parameters, array fields entry by entry.
    pub parameters: Table<ParamId, Parameter>,
    /// Coordinates `x^i` on the base M.
    pub coordinates: Table<CoordId, Coordinate>,
    /// The declared basis of sections `e_α`.
    pub sections: Table<SectionId, Section>,
    /// Control inputs.
    pub inputs: Table<InputId, Input>,
    /// Auxiliary states z.
    pub auxiliary: Vec<AuxiliaryDecl>,
    /// Identities f = 0 that embedded base coordinates satisfy (`on`).
    pub identities: Vec<Located>,
    /// What drops out of the declaration, as factors of 0 do, and has to be defined all the same.
    pub dropped: Vec<Located>,
    /// Arguments of functions that have a shorter form, which stands in their place: where they have no value, neither have
    /// the equations.
    pub shortened: Vec<ExprId>,
    /// What has to vanish on the base for words of the declaration to have their meaning.
    pub claimed: Vec<Claimed>,
    /// Entries of symmetric matrices that are one parameter: that above the diagonal, which is read, and that below.
    pub symmetric: Vec<(ParamId, ParamId)>,
    /// Bodies and material points whose kinetic energies are declared, mathematics (33).
    pub bodies: Vec<Body>,
    /// How the anchor is given.
    pub kinematics: Kinematics,
    /// Declared brackets; known algebras are expanded by [`crate::geometry::KnownAlgebra`].
    pub brackets: Vec<BracketDecl>,
    /// Whether a `brackets` section stands in the declaration, even an empty one.
    pub brackets_declared: bool,
    /// Whether the structure equations (2) and (3) are waived (`almost;`).
    pub almost: bool,
    /// New sections as combinations of the declared ones (`frame`).
    pub frame: Vec<FrameDecl>,
    /// The Lagrangian L(t, x, y); rates ẋ^i may occur in it.
    pub lagrangian: Located,
    /// Position constraints f = 0 (`holonomic`); their velocity forms are the first of the constraints.
    pub positions: Vec<PositionDecl>,
    /// Where the declaration says that some of them follow from others (`redundant`).
    pub redundant: Option<Origin>,
    /// Constraints φ = 0.
    pub constraints: Table<ConstraintId, ConstraintDecl>,
    /// What velocities jump to (`impacts`).
    pub impacts: Vec<ImpactDecl>,
    /// Sections that span D (`distribution`), by their velocity symbols, instead of constraints.
    pub distribution: Option<Vec<(SymbolId, Origin)>>,
    /// Generalized forces.
    pub forces: Vec<ForceDecl>,
    /// Calls of methods of the struct, each with a symbol for its result.
    pub calls: Vec<MethodCall>,
    /// Named observables.
    pub outputs: Vec<OutputDecl>,
    /// Claimed first integrals (`conserved`).
    pub claims: Vec<OutputDecl>,
    /// Labelled sections whose momenta are wanted (`symmetries`).
    pub symmetries: Vec<SymmetryDecl>,
    /// The claim that a volume is invariant (`volume`).
    pub volume: Option<VolumeClaim>,
    /// A section of D* that is claimed to solve the Hamilton–Jacobi equation (`hamilton_jacobi`).
    pub hamilton_jacobi: Option<SectionClaim>,
    /// Momenta that become parameters (`routh`).
    pub routh: Vec<RouthDecl>,
    /// Facts about parameters (`assume`).
    pub assumptions: Vec<Assumption>,
    /// The ranges that follow from them, once they are checked.
    pub facts: Facts,
    /// What to generate beyond the default (`emit`).
    pub requests: Vec<(Request, Origin)>,
    /// The state variables and observables that are needed (`track`); all of them if not given.
    pub tracked: Option<Vec<(TrackedItem, Origin)>>,
    /// The variables of the state that a linearisation keeps (`linearization`); the independent ones if none is named.
    pub linearization: Option<Kept>,
    /// The velocities that the user wants the adapted state to keep.
    pub independent: Option<Vec<(SymbolId, Origin)>>,
    /// The base coordinates that the user names as independent: a chart of N.
    pub chart: Option<Vec<(SymbolId, Origin)>>,
    /// Velocities of an orthonormal basis of D (`orthonormal`), and where they are named.
    pub orthonormal: Option<(Vec<SymbolId>, Origin)>,
    /// The formulation that the user asks for.
    pub formulation: Option<(Formulation, Origin)>,
    /// The fields of the struct that stand in no expression.
    pub idle: Vec<String>,
    /// The inputs that do.
    pub idle_inputs: Vec<String>,
    /// The units of what is declared, if `units` gives some.
    pub units: Vec<Quantity>,
}

impl Model {
    /// What changes whatever the velocity is.
    #[must_use]
    pub fn clock(&self) -> Clock {
        let auxiliary = self.auxiliary.iter().map(|state| (state.symbol, state.rate)).collect();
        Clock { time: self.time, auxiliary }
    }

    /// Rewrites what is declared by the identities that hold under the facts.
    pub(crate) fn assume(&mut self, facts: &Facts) {
        self.facts = facts.clone();
        let graph = &mut self.graph;
        // what has another form in the equations is noted, and what has one beside them is not
        let (equations, beside) = (&mut Vec::new(), &mut Vec::new());
        let mut rewrite = |value: &mut ExprId, long: &mut Vec<ExprId>| {
            *value = graph.assuming_and_noting(&[*value], facts, long)[0];
        };
        rewrite(&mut self.lagrangian.value, equations);
        self.bodies.iter_mut().for_each(|body| rewrite(&mut body.energy, equations));
        self.positions.iter_mut().for_each(|position| rewrite(&mut position.value, equations));
        self.constraints.iter_mut().for_each(|constraint| rewrite(&mut constraint.residual, equations));
        for impact in &mut self.impacts {
            impact.rows.iter_mut().for_each(|row| rewrite(&mut row.value, equations));
            impact.restitution.iter_mut().for_each(|restitution| rewrite(&mut restitution.value, equations));
        }
        self.forces.iter_mut().for_each(|force| rewrite(&mut force.value, equations));
        self.auxiliary.iter_mut().for_each(|state| rewrite(&mut state.value, equations));
        self.outputs.iter_mut().for_each(|output| rewrite(&mut output.value, beside));
        self.claims.iter_mut().for_each(|claim| rewrite(&mut claim.value, beside));
        for symmetry in &mut self.symmetries {
            rewrite(&mut symmetry.value, beside);
            symmetry.gauge.iter_mut().for_each(|gauge| rewrite(gauge, beside));
        }
        let densities = self.volume.iter_mut().filter_map(|claim| claim.density.as_mut());
        densities.for_each(|density| rewrite(density, beside));
        let sections = self.hamilton_jacobi.iter_mut().flat_map(|claim| &mut claim.components);
        sections.for_each(|(_, component)| rewrite(&mut component.value, beside));
        self.brackets.iter_mut().for_each(|bracket| rewrite(&mut bracket.value, equations));
        match &mut self.kinematics {
            Kinematics::Tangent => {}
            Kinematics::Anchor(lines) => lines.iter_mut().for_each(|line| rewrite(&mut line.rate, equations)),
            Kinematics::Coframe(rows) => rows.iter_mut().for_each(|row| rewrite(&mut row.value, equations)),
        }
        self.shortened.append(equations);
    }
}

/// An expression and where it stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Located {
    /// The expression.
    pub value: ExprId,
    /// Where it stands.
    pub origin: Origin,
}

/// An expression that has to vanish on the base: an axis has length 1, an attitude is a rotation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Claimed {
    /// The expression.
    pub value: ExprId,
    /// Where it comes from.
    pub origin: Origin,
    /// What is said if it does not vanish.
    pub what: String,
    /// What it is of what the user wrote: the square of a length less 1.
    pub measure: String,
    /// What the user can do then.
    pub way_out: String,
}

/// A scalar parameter.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// `m`, or `I[0][1]`.
    pub name: String,
    /// Its symbol.
    pub symbol: SymbolId,
    /// Where it is declared.
    pub origin: Origin,
}

/// A base coordinate.
#[derive(Clone, Debug)]
pub struct Coordinate {
    /// `theta`, or `theta[0]`.
    pub name: String,
    /// The coordinate x^i.
    pub symbol: SymbolId,
    /// The rate ẋ^i, written `der(x)`. Where E = TM this is the velocity of its section.
    pub rate: SymbolId,
    /// Where it is declared.
    pub origin: Origin,
}

/// A section of the declared basis.
#[derive(Clone, Debug)]
pub struct Section {
    /// `omega`, or `w[0]`; `x_dot` where E = TM.
    pub name: String,
    /// The quasi-velocity y^α.
    pub symbol: SymbolId,
    /// Where it is declared.
    pub origin: Origin,
}

/// A control input.
#[derive(Clone, Debug)]
pub struct Input {
    /// The name.
    pub name: String,
    /// Its symbol.
    pub symbol: SymbolId,
    /// Where it is declared.
    pub origin: Origin,
}

/// An auxiliary state z with ż = g(t, x, y, z, u): a current, a lag, a filter.
#[derive(Clone, Debug)]
pub struct AuxiliaryDecl {
    /// `current`, or `slip[0]`.
    pub name: String,
    /// The state z.
    pub symbol: SymbolId,
    /// What stands for ż.
    pub rate: SymbolId,
    /// g; t, x, y, rates, inputs, calls and auxiliary states may occur in it.
    pub value: ExprId,
    /// Where the line stands.
    pub origin: Origin,
}

/// How the anchor ρ is given.
#[derive(Clone, Debug)]
pub enum Kinematics {
    /// E = TM: section `i` is ∂/∂x^i, and its velocity symbol is the rate of coordinate `i`.
    Tangent,
    /// `anchor { der(x) = …; }`: the rate of each coordinate, in the quasi-velocities.
    Anchor(Vec<AnchorDecl>),
    /// `velocities { w = …; }`: each quasi-velocity in the rates, one line per section, in the
    /// order of the sections.
    Coframe(Vec<Located>),
}

/// One line `der(x) = …` of the anchor.
#[derive(Clone, Copy, Debug)]
pub struct AnchorDecl {
    /// The coordinate.
    pub coordinate: CoordId,
    /// Its rate in the quasi-velocities.
    pub rate: ExprId,
    /// Where the line stands.
    pub origin: Origin,
}

/// One declared bracket `[e_α, e_β] = Σ c^γ e_γ`.
#[derive(Clone, Debug)]
pub struct BracketDecl {
    /// α.
    pub left: SectionId,
    /// β.
    pub right: SectionId,
    /// The right-hand side with the velocity symbol of `e_γ` standing for the section `e_γ`.
    pub value: ExprId,
    /// Where it stands.
    pub origin: Origin,
    /// Whether it comes from a known algebra; an explicit line for the same pair is then an error.
    pub known: Option<&'static str>,
}

/// One new section of the frame, with its quasi-velocity.
#[derive(Clone, Debug)]
pub struct FrameDecl {
    /// Its name.
    pub name: String,
    /// Its quasi-velocity.
    pub symbol: SymbolId,
    /// The combination, with the velocity symbol of a section standing for the section.
    pub value: ExprId,
    /// Where it stands.
    pub origin: Origin,
}

/// What a linearisation keeps (`linearization`).
#[derive(Clone, Debug)]
pub struct Kept {
    /// The variables of the state that are named.
    pub variables: Vec<(SymbolId, Origin)>,
    /// Where the section is.
    pub origin: Origin,
}

/// A fact `left relation right` about parameters.
#[derive(Clone, Debug)]
pub struct Assumption {
    /// The left side, an expression of parameters.
    pub left: ExprId,
    /// How the sides compare.
    pub relation: Relation,
    /// The right side, an expression of parameters.
    pub right: ExprId,
    /// The fact as the user wrote it.
    pub text: String,
    /// Where it stands.
    pub origin: Origin,
}

/// How two sides of an assumption compare.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relation {
    /// `<`
    Less,
    /// `<=`
    LessOrEqual,
    /// `>`
    Greater,
    /// `>=`
    GreaterOrEqual,
    /// `!=`
    NotEqual,
}

impl Relation {
    /// As it is written.
    #[must_use]
    pub fn sign(self) -> &'static str {
        match self {
            Self::Less => "<",
            Self::LessOrEqual => "<=",
            Self::Greater => ">",
            Self::GreaterOrEqual => ">=",
            Self::NotEqual => "!=",
        }
    }
}

/// The claim that the motion keeps a volume.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VolumeClaim {
    /// Its density in the coordinates of the state; to be found on the base if not given.
    pub density: Option<ExprId>,
    /// Where it stands.
    pub origin: Origin,
}

/// A section of D*: momenta as functions on the base.
#[derive(Clone, Debug)]
pub struct SectionClaim {
    /// The momentum along each velocity; 0 along the others.
    pub components: Vec<(SymbolId, Located)>,
    /// Where it stands.
    pub origin: Origin,
}

/// Something that is needed of a system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TrackedItem {
    /// A coordinate or a velocity.
    Variable(SymbolId),
    /// An observable, by its position.
    Output(usize),
}

/// One constraint `lhs = rhs`, as φ = lhs − rhs.
#[derive(Clone, Debug)]
pub struct ConstraintDecl {
    /// The user's label.
    pub label: Option<String>,
    /// φ(t, x, y); rates may occur in it.
    pub residual: ExprId,
    /// The left-hand side, if it is a velocity or `der(x)` alone that is absent on the right.
    pub solved_for: Option<SymbolId>,
    /// Whether it is one of several entries of a vector equation.
    pub is_entry: bool,
    /// Where it stands.
    pub origin: Origin,
}

/// One generalized force.
#[derive(Clone, Copy, Debug)]
pub struct ForceDecl {
    /// What it acts along.
    pub direction: ForceDirection,
    /// Its value; t, x, y, rates and inputs may occur in it.
    pub value: ExprId,
    /// Where it stands.
    pub origin: Origin,
}

/// What a generalized force acts along.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ForceDirection {
    /// Υ along a section of the declared basis or of the frame, by its velocity symbol.
    Section(SymbolId),
    /// Q_i along a base coordinate, pulled back by the anchor (CNS section 3).
    Coordinate(CoordId),
}

/// A call `self.method(arguments)` in a force or an observable.
#[derive(Clone, Debug)]
pub struct MethodCall {
    /// What stands for its result.
    pub symbol: SymbolId,
    /// The name of the method.
    pub method: String,
    /// The arguments; t, x, y, rates, inputs and earlier calls may occur in them.
    pub arguments: Vec<ExprId>,
    /// The methods that differentiate it by each argument, if they are declared.
    pub derivatives: Option<Vec<String>>,
    /// Where it stands.
    pub origin: Origin,
}

/// A named observable.
#[derive(Clone, Debug)]
pub struct OutputDecl {
    /// The name.
    pub name: String,
    /// Its value; t, x, y, rates and inputs may occur in it.
    pub value: ExprId,
    /// Where it stands.
    pub origin: Origin,
}

/// A labelled section σ whose momentum σ^α p_α is wanted.
#[derive(Clone, Debug)]
pub struct SymmetryDecl {
    /// The label.
    pub name: String,
    /// The section, with the velocity symbol of a section standing for the section.
    pub value: ExprId,
    /// A function f on the base with σ^C(L) = ρ(f): then σ^α p_α − f is the momentum.
    pub gauge: Option<ExprId>,
    /// Where it stands.
    pub origin: Origin,
}

/// A conserved momentum on a level.
#[derive(Clone, Debug)]
pub struct RouthDecl {
    /// The label of a symmetry, or the name of a cyclic coordinate.
    pub symmetry: String,
    /// The value of the momentum, an expression of parameters.
    pub level: ExprId,
    /// Where it stands.
    pub origin: Origin,
}

/// The form of the equations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Formulation {
    /// Reduced state (x, v) with y = B v: mathematics (8), CLMM (3.5).
    Adapted,
    /// Full state (x, y) with multipliers: the saddle form (9).
    Projected,
}
