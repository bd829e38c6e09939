//! Bodies that a declaration names: mass, inertia, place and attitude.

use crate::id::{ExprId, Origin};

/// A rigid body or a material point, declared by `kinetic`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Body {
    /// m.
    pub mass: ExprId,
    /// The inertia about the centre of mass, in the axes of the body.
    pub inertia: Inertia,
    /// The centre of mass in space, of 3 entries, or in the plane, of 2.
    pub position: Vec<ExprId>,
    /// How the axes of the body lie in space.
    pub attitude: Attitude,
    /// Its kinetic energy, as it occurs in the Lagrangian.
    pub energy: ExprId,
    /// Where it is declared.
    pub origin: Origin,
}

/// The inertia of a body.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Inertia {
    /// Of a material point.
    None,
    /// The same about all axes, or about that of the plane.
    Isotropic(ExprId),
    /// About the three axes of the body.
    Diagonal(Vec<ExprId>),
    /// Row by row.
    Full(Vec<ExprId>),
}

/// The attitude of a body.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Attitude {
    /// Of a material point.
    None,
    /// In the plane.
    Angle(ExprId),
    /// In space, as a product of rotations.
    Turns(Vec<Turn>),
}

/// A factor of an attitude.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Turn {
    /// From the axes behind it to those before it, row by row.
    pub matrix: Vec<ExprId>,
    /// The axis, of length 1, and the angle, unless it is a matrix that is only claimed to be a rotation.
    pub about: Option<(Vec<ExprId>, ExprId)>,
}
