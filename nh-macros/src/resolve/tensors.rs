//! The functions of vectors, matrices and bodies: their names, and how calls of them read.

/// A function of vectors, matrices and bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Tensor {
    /// `diff(e, x)`
    Diff,
    /// `transpose(A)`
    Transpose,
    /// `hat(v)`
    Hat,
    /// `vee(A)`
    Vee,
    /// `norm(v)`
    Norm,
    /// `diag(a, b, c)`
    Diag,
    /// `identity(3)`
    Identity,
    /// `rot_x(a)`, `rot_y(a)`, `rot_z(a)`
    About(usize),
    /// `rot(axis, a)`
    Rot,
    /// `body_rate(R)`
    BodyRate,
    /// `space_rate(R)`
    SpaceRate,
    /// `velocity_at(p, R, c)`
    VelocityAt,
    /// `kinetic(m, p)`, `kinetic(m, I, p, R)`
    Kinetic,
}

/// Their names, and how calls of them read.
const TENSORS: [(&str, Tensor, &str); 15] = [
    ("diff", Tensor::Diff, "diff(e, x)"),
    ("transpose", Tensor::Transpose, "transpose(A)"),
    ("hat", Tensor::Hat, "hat(v)"),
    ("vee", Tensor::Vee, "vee(A)"),
    ("norm", Tensor::Norm, "norm(v)"),
    ("diag", Tensor::Diag, "diag(a, b, c)"),
    ("identity", Tensor::Identity, "identity(3)"),
    ("rot_x", Tensor::About(0), "rot_x(a)"),
    ("rot_y", Tensor::About(1), "rot_y(a)"),
    ("rot_z", Tensor::About(2), "rot_z(a)"),
    ("rot", Tensor::Rot, "rot(axis, a)"),
    ("body_rate", Tensor::BodyRate, "body_rate(R)"),
    ("space_rate", Tensor::SpaceRate, "space_rate(R)"),
    ("velocity_at", Tensor::VelocityAt, "velocity_at(p, R, c)"),
    ("kinetic", Tensor::Kinetic, "kinetic(m, I, p, R)"),
];

/// The names of the functions of vectors, matrices and bodies.
pub(super) fn tensor_names<'a>() -> impl Iterator<Item = &'a str> {
    TENSORS.iter().map(|(name, ..)| *name)
}

/// How a call of a function of vectors, matrices and bodies is written.
pub(super) fn usage(name: &str) -> Option<&'static str> {
    let (_, tensor, usage) = TENSORS.iter().find(|(known, ..)| *known == name)?;
    Some(if *tensor == Tensor::Kinetic { "kinetic(m, p)` or `kinetic(m, I, p, R)" } else { usage })
}

impl Tensor {
    pub(super) fn named(name: &str) -> Option<Self> {
        TENSORS.iter().find(|(known, ..)| *known == name).map(|(_, tensor, _)| *tensor)
    }

    /// The least and the largest number of arguments.
    pub(super) fn arity(self) -> (usize, usize) {
        match self {
            Self::Diff | Self::Rot => (2, 2),
            Self::Diag => (1, usize::MAX),
            Self::VelocityAt => (3, 3),
            Self::Kinetic => (2, 4),
            _ => (1, 1),
        }
    }
}
