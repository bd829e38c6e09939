//! What was written: the declaration as a tree, names unresolved, every node with its extent.
//!
//! Scope of a `let`: the whole declaration where it stands between the sections, else from its line to the
//! end of the section, or of the `for` block, that it stands in. The variable of a `for`, of a `sum` and of an
//! indexed `let` is seen in its body.

mod expression_tree;
mod impact_tree;
mod unit_tree;

use std::rc::Rc;

use proc_macro2::{Ident, TokenStream};

pub(crate) use self::expression_tree::{Expr, ExprKind, Factor, Number, Sign};
pub(crate) use self::impact_tree::{ImpactLine, ImpactRow};
pub(crate) use self::unit_tree::{UnitFactor, UnitLine};
use crate::report::Extent;

/// A whole declaration: the struct and the sections of the attribute.
#[derive(Debug)]
pub(crate) struct SystemDecl {
    /// The struct that carries the attribute: its fields are the parameters.
    pub(crate) structure: StructDecl,
    /// What the attribute says.
    pub(crate) sections: Sections,
}

/// The sections of the attribute, each where it was given.
#[derive(Debug, Default)]
pub(crate) struct Sections {
    /// `let …;` between the sections, known in all of them.
    pub(crate) lets: Vec<Rc<Let>>,
    /// `constants`: names of numbers.
    pub(crate) constants: Option<Section<Vec<Definition>>>,
    /// `base`: the coordinates x^i.
    pub(crate) base: Option<Section<Vec<Declared>>>,
    /// `on`: identities that embedded base coordinates satisfy.
    pub(crate) on: Option<Section<Vec<Item<Equation>>>>,
    /// `basis`: the sections `e_α`, whose names are also their quasi-velocities.
    pub(crate) basis: Option<Section<Vec<Declared>>>,
    /// `velocities`: quasi-velocities defined by a coframe.
    pub(crate) velocities: Option<Section<Vec<Item<Definition>>>>,
    /// `anchor`: the kinematic equations.
    pub(crate) anchor: Option<Section<Vec<Item<AnchorLine>>>>,
    /// `brackets`: any number of blocks.
    pub(crate) brackets: Vec<Section<Brackets>>,
    /// `frame`: new sections as combinations of the declared ones.
    pub(crate) frame: Option<Section<Vec<Item<Definition>>>>,
    /// `almost`: the structure equations are not demanded.
    pub(crate) almost: Option<Extent>,
    /// `lagrangian`: L(t, x, y, parameters).
    pub(crate) lagrangian: Option<Section<Lagrangian>>,
    /// `holonomic`: equations between positions.
    pub(crate) holonomic: Option<Section<Vec<Item<PositionLine>>>>,
    /// `constraints`: equations between velocities.
    pub(crate) constraints: Option<Section<Vec<Item<Equation>>>>,
    /// The left-hand sides of constraints in error, as far as they are known.
    pub(crate) lost: Vec<Option<Box<Expr>>>,
    /// `impacts`: what velocities jump to.
    pub(crate) impacts: Option<Section<Vec<Item<ImpactLine>>>>,
    /// `distribution`: sections that span the constraint distribution.
    pub(crate) distribution: Option<Section<Vec<Velocity>>>,
    /// `forces`: a generalized force along a section or a base coordinate.
    pub(crate) forces: Option<Section<Vec<Item<Force>>>>,
    /// `inputs`: the control inputs.
    pub(crate) inputs: Option<Section<Vec<Declared>>>,
    /// `auxiliary`: states that follow from rates of their own.
    pub(crate) auxiliary: Option<Section<Vec<Item<Definition>>>>,
    /// `outputs`: named observables.
    pub(crate) outputs: Option<Section<Vec<Item<Definition>>>>,
    /// `conserved`: claimed first integrals.
    pub(crate) conserved: Option<Section<Vec<Item<Definition>>>>,
    /// `volume`: the claim that the motion keeps a volume, perhaps with its density.
    pub(crate) volume: Option<Section<Option<Expr>>>,
    /// `hamilton_jacobi`: momenta as functions on the base.
    pub(crate) hamilton_jacobi: Option<Section<Vec<Item<Momentum>>>>,
    /// `symmetries`: labelled sections whose momentum equation is wanted.
    pub(crate) symmetries: Option<Section<Vec<Item<Symmetry>>>>,
    /// `routh`: momenta that become parameters.
    pub(crate) routh: Option<Section<Vec<Item<Definition>>>>,
    /// `assume`: sign and range facts about parameters.
    pub(crate) assume: Option<Section<Vec<Item<Comparison>>>>,
    /// `units`: the units of declared names.
    pub(crate) units: Option<Section<Vec<UnitLine>>>,
    /// `linearization`: the variables of the state that it keeps, unless they are left to be chosen.
    pub(crate) linearization: Option<Section<Option<Vec<Velocity>>>>,
    /// `independent`: the velocities that the adapted state keeps.
    pub(crate) independent: Option<Section<Vec<Velocity>>>,
    /// `orthonormal`: names for the velocities of an orthonormal basis of D.
    pub(crate) orthonormal: Option<Section<Vec<Declared>>>,
    /// `formulation`: adapted or projected.
    pub(crate) formulation: Option<Section<Formulation>>,
    /// `accuracy`: the level, as it is written.
    pub(crate) accuracy: Option<Section<Name>>,
    /// `emit`: what to generate beyond the default.
    pub(crate) emit: Option<Section<Vec<Name>>>,
    /// `track`: the state variables and outputs that are needed.
    pub(crate) track: Option<Section<Vec<Velocity>>>,
    /// `names`: other names for generated types.
    pub(crate) names: Option<Section<Vec<Renaming>>>,
    /// `derivative`: derivatives of the methods that forces call.
    pub(crate) derivative: Option<Section<Vec<MethodDerivative>>>,
    /// `crate`: the path of the runtime, where the dependency was renamed.
    pub(crate) runtime: Option<Section<TokenStream>>,
}

/// A section: its keyword and what stands in its braces.
#[derive(Clone, Debug)]
pub(crate) struct Section<T> {
    /// The keyword, where errors about the whole section point.
    pub(crate) keyword: Name,
    /// The parsed body.
    pub(crate) body: T,
}

/// The struct under the attribute.
pub(crate) struct StructDecl {
    /// The item as it is emitted: verbatim, except for its `#[nh(…)]` attributes.
    pub(crate) item: TokenStream,
    /// The item as it was written.
    pub(crate) written: TokenStream,
    /// The attributes of the struct and of its fields.
    pub(crate) attributes: Vec<syn::Attribute>,
    /// The struct's name, where errors about the whole declaration point.
    pub(crate) name: Ident,
    /// The visibility, which generated types take over.
    pub(crate) visibility: syn::Visibility,
    /// The generics with bounds and `where` clause.
    pub(crate) generics: syn::Generics,
    /// The one scalar type of the parameters.
    pub(crate) scalar: Scalar,
    /// The fields that are parameters, in order.
    pub(crate) parameters: Vec<Declared>,
    /// The fields marked `#[nh(skip)]`.
    pub(crate) skipped: Vec<Name>,
}

/// The scalar type of a declaration.
#[derive(Clone, Debug)]
pub(crate) enum Scalar {
    /// `f64`, also when there is no parameter.
    F64,
    /// `f32`.
    F32,
    /// A type parameter of the struct.
    Parameter(Ident),
}

/// An identifier as it was written.
#[derive(Clone, Debug)]
pub(crate) struct Name {
    /// The identifier without `r#`: what names are compared by.
    pub(crate) text: String,
    /// The identifier with its span: what is emitted.
    pub(crate) ident: Ident,
}

/// A name that a list or a struct field declares: a scalar, or a family of one or two indices.
#[derive(Debug)]
pub(crate) struct Declared {
    /// Its doc comments, as attributes.
    pub(crate) docs: TokenStream,
    /// The name.
    pub(crate) name: Name,
    /// The length of every index: none for a scalar, at most two.
    pub(crate) lengths: Vec<u32>,
    /// Whether entries (i, j) and (j, i) are one.
    pub(crate) symmetric: bool,
    /// The name with its lengths.
    pub(crate) extent: Extent,
}

/// A use of a declared name, perhaps an entry of a family: `x`, `w[0]`, `R[i][j]`.
#[derive(Clone, Debug)]
pub(crate) struct Place {
    /// The name.
    pub(crate) name: Name,
    /// The indices, at most two.
    pub(crate) indices: Vec<Expr>,
    /// The name with its indices.
    pub(crate) extent: Extent,
}

/// A velocity named in a list.
#[derive(Clone, Debug)]
pub(crate) enum Velocity {
    /// A quasi-velocity (or, in `track` and `linearization`, another variable): `v1`, `w[0]`.
    Named(Place),
    /// The velocity of a base coordinate, `der(x)`; the extent covers the call.
    Der(Place, Extent),
}

/// A line of a section: a statement of the section's own kind, or what structures such lines.
#[derive(Debug)]
pub(crate) enum Item<T> {
    /// `let name = expr;`
    Let(Let),
    /// `for i in 0..3 { … }`
    For(For<T>),
    /// A statement.
    One(T),
}

/// `for i in 0..3 { … }`: the items once for every value of the variables.
#[derive(Debug)]
pub(crate) struct For<T> {
    /// The variables with their ranges; a later range may use earlier variables.
    pub(crate) binders: Vec<Binder>,
    /// The items.
    pub(crate) items: Vec<Item<T>>,
    /// The whole block.
    pub(crate) extent: Extent,
}

/// `i in 0..4`, end excluded.
#[derive(Clone, Debug)]
pub(crate) struct Binder {
    /// The variable.
    pub(crate) name: Name,
    /// The first value.
    pub(crate) from: Expr,
    /// One more than the last value.
    pub(crate) to: Expr,
    /// The variable with its range.
    pub(crate) extent: Extent,
}

/// `let name = expr;`, `let name[i in 0..4] = expr;` or `let name(u, v) = expr;`
#[derive(Debug)]
pub(crate) struct Let {
    /// The name it declares.
    pub(crate) name: Name,
    /// The arguments of a function.
    pub(crate) arguments: Option<Vec<Name>>,
    /// Its indices: none for a plain abbreviation, at most two.
    pub(crate) binders: Vec<Binder>,
    /// What the name stands for.
    pub(crate) value: Expr,
    /// The whole line.
    pub(crate) extent: Extent,
}

/// `lhs = rhs`, perhaps labelled: a constraint, or an identity of the base.
#[derive(Debug)]
pub(crate) struct Equation {
    /// Its doc comments, as attributes.
    pub(crate) docs: TokenStream,
    /// The label before the colon.
    pub(crate) label: Option<Name>,
    /// The left-hand side.
    pub(crate) left: Expr,
    /// The right-hand side.
    pub(crate) right: Expr,
    /// Both sides without the label.
    pub(crate) extent: Extent,
}

/// A line of `holonomic`.
#[derive(Debug)]
pub(crate) enum PositionLine {
    /// An equation between positions.
    Equation(Box<Equation>),
    /// `redundant`: equations that follow from others are meant.
    Redundant(Extent),
}

/// `name = expr`, which declares the name: a velocity, a section, an output, a claim.
#[derive(Debug)]
pub(crate) struct Definition {
    /// Its doc comments, as attributes.
    pub(crate) docs: TokenStream,
    /// The name it declares.
    pub(crate) name: Name,
    /// The indices behind the name, at most two.
    pub(crate) subscripts: Vec<Subscript>,
    /// What the name stands for.
    pub(crate) value: Expr,
    /// The name with its subscripts.
    pub(crate) extent: Extent,
}

/// An index on the left-hand side of a definition.
#[derive(Debug)]
pub(crate) enum Subscript {
    /// `[2]` or `[i]`: one entry of the family.
    Entry(Expr),
    /// `[i in 0..4]`: every entry at once.
    Each(Box<Binder>),
}

/// `der(x) = expr`.
#[derive(Debug)]
pub(crate) struct AnchorLine {
    /// The base coordinate.
    pub(crate) coordinate: Place,
    /// Its velocity as a combination of quasi-velocities.
    pub(crate) value: Expr,
    /// The left-hand side, `der(x)`.
    pub(crate) extent: Extent,
}

/// One `brackets` block.
#[derive(Debug)]
pub(crate) enum Brackets {
    /// `brackets { [a, b] = c; … }`
    Table(Vec<Item<BracketLine>>),
    /// `brackets so(3) { w1, w2, w3 }`
    Known(KnownAlgebra),
}

/// `[a, b] = expr`.
#[derive(Debug)]
pub(crate) struct BracketLine {
    /// The first section.
    pub(crate) first: Place,
    /// The second section.
    pub(crate) second: Place,
    /// Their bracket as a combination of sections.
    pub(crate) value: Expr,
    /// The left-hand side, `[a, b]`.
    pub(crate) extent: Extent,
}

/// A known algebra for the listed sections.
#[derive(Debug)]
pub(crate) struct KnownAlgebra {
    /// `so`, `se`, `sl`, `heisenberg`.
    pub(crate) algebra: Name,
    /// The number in parentheses.
    pub(crate) order: Option<u32>,
    /// The algebra with its number.
    pub(crate) extent: Extent,
    /// The sections, in the order of the algebra's basis; a bare family name stands for all its
    /// entries.
    pub(crate) sections: Vec<Place>,
}

/// The body of `lagrangian`.
#[derive(Debug)]
pub(crate) struct Lagrangian {
    /// Abbreviations, in order.
    pub(crate) lets: Vec<Let>,
    /// The Lagrangian.
    pub(crate) value: Expr,
}

/// `name: expr`, a generalized force along a section or a base coordinate.
#[derive(Debug)]
pub(crate) struct Force {
    /// The direction.
    pub(crate) along: Place,
    /// The force.
    pub(crate) value: Expr,
}

/// `omega: expr`, the momentum along a velocity.
#[derive(Debug)]
pub(crate) struct Momentum {
    /// The velocity.
    pub(crate) along: Velocity,
    /// The momentum.
    pub(crate) value: Expr,
}

/// `label: expr`, or `label: expr up to f`: an infinitesimal symmetry.
#[derive(Debug)]
pub(crate) struct Symmetry {
    /// Its doc comments, as attributes.
    pub(crate) docs: TokenStream,
    /// The label.
    pub(crate) label: Name,
    /// A combination of sections.
    pub(crate) value: Expr,
    /// The function behind `up to`.
    pub(crate) gauge: Option<Expr>,
    /// The section with what it holds up to.
    pub(crate) extent: Extent,
}

/// `a < b`, a fact about parameters.
#[derive(Debug)]
pub(crate) struct Comparison {
    /// The left-hand side.
    pub(crate) left: Expr,
    /// The relation.
    pub(crate) relation: Relation,
    /// The right-hand side.
    pub(crate) right: Expr,
    /// The whole comparison.
    pub(crate) extent: Extent,
}

/// A relation between two numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Relation {
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

/// The formulation that the user demands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Formulation {
    /// Reduced state with quasi-velocities adapted to the constraints.
    Adapted,
    /// Full state with multipliers.
    Projected,
}

/// `state = RobotState`.
#[derive(Debug)]
pub(crate) struct Renaming {
    /// Which generated type: a word of [`super::vocabulary::TYPES`].
    pub(crate) role: Name,
    /// Its new name.
    pub(crate) name: Name,
}

/// `motor: [self.d1, self.d2]`: methods that differentiate a method by its arguments.
#[derive(Debug)]
pub(crate) struct MethodDerivative {
    /// The method.
    pub(crate) method: Name,
    /// One method per argument.
    pub(crate) derivatives: Vec<Name>,
}
