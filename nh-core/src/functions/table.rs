//! The lines of the table: what each function is called, takes and gives.

use super::{Record, Shape, Signature, Size, Sliced, When};
use crate::model::Request;

/// Every function, in the order in which they are generated.
pub static TABLE: &[&Signature] = &[
    &ENERGY,
    &VELOCITY,
    &OUTPUTS,
    &MULTIPLIERS,
    &REACTIONS,
    &RESIDUAL,
    &POWER,
    &OUTPUT_JACOBIAN,
    &PARAMETER_JACOBIAN,
    &MOMENTA,
    &MOMENTUM_RATES,
    &BRACKET,
    &BRACKET_WITH_ENERGY,
    &DRIFT_OF_OUTPUTS,
    &DIVERGENCE,
    &VOLUME_DENSITY,
    &CONNECTION,
    &CHRISTOFFEL,
    &HAMILTON_JACOBI,
    &GIBBS_APPELL,
    &QUADRATURES,
    &GYROSCOPIC,
    &VERTICAL_SECTIONS,
    &HORIZONTAL_LIFTS,
    &LOCKED_INERTIA,
    &CONNECTION_COEFFICIENTS,
    &CURVATURE,
    &VERTICAL_MOMENTA,
    &VERTICAL_MOMENTUM_RATES,
    &VERTICAL_VELOCITIES,
    &HORIZONTAL_FORCE,
];

/// `energy`.
pub static ENERGY: Signature = Signature {
    name: "energy",
    doc: &[" The energy y · ∂L/∂y − L."],
    takes_input: false,
    shape: Shape::Scalar,
    when: When::Always,
    sliced: Sliced::Named("the energy"),
};

/// `velocity`.
pub static VELOCITY: Signature = Signature {
    name: "velocity",
    doc: &[" All quasi-velocities, as the constraints give them from the state."],
    takes_input: false,
    shape: Shape::Record(Record::Velocity),
    when: When::Always,
    sliced: Sliced::Named("the velocities that are not in the state"),
};

/// `outputs`.
pub static OUTPUTS: Signature = Signature {
    name: "outputs",
    doc: &[" The observables at a state."],
    takes_input: true,
    shape: Shape::Record(Record::Outputs),
    when: When::WithOutputs,
    sliced: Sliced::Outputs,
};

/// `multipliers`.
pub static MULTIPLIERS: Signature = Signature {
    name: "multipliers",
    doc: &[" The multipliers of the constraints, with their sign in +λ ∂φ/∂y on the side of the forces."],
    takes_input: true,
    shape: Shape::Record(Record::Multipliers),
    when: When::Asked(Request::Multipliers),
    sliced: Sliced::Named("the multipliers"),
};

/// `reactions`.
pub static REACTIONS: Signature = Signature {
    name: "reactions",
    doc: &[" The forces along the sections by which the constraints are kept."],
    takes_input: true,
    shape: Shape::Record(Record::Reactions),
    when: When::Asked(Request::Reactions),
    sliced: Sliced::Named("the reactions"),
};

/// `constraint_residual`.
pub static RESIDUAL: Signature = Signature {
    name: "constraint_residual",
    doc: &[" The constraints at a state: left-hand side less right-hand side, zero where they hold."],
    takes_input: false,
    shape: Shape::Record(Record::Residual),
    when: When::WithConstraints,
    sliced: Sliced::Kept,
};

/// `power`.
pub static POWER: Signature = Signature {
    name: "power",
    doc: &[
        " The power of each force, by its direction, and of each constraint, by its label: that of a row with",
        " a drift b is −λ b, that of a homogeneous row 0. The energy changes at the rate of their `total()`,",
        " less the rate at which the Lagrangian depends on the time.",
    ],
    takes_input: true,
    shape: Shape::Power,
    when: When::Asked(Request::Power),
    sliced: Sliced::Whole,
};

/// `output_jacobian`.
pub static OUTPUT_JACOBIAN: Signature = Signature {
    name: "output_jacobian",
    doc: &[
        " The derivatives of the outputs by the state, C, and by the inputs, D: entry (i, j) is that of output i",
        " by component j.",
    ],
    takes_input: true,
    shape: Shape::ByStateAndInput(Size::Outputs),
    when: When::Asked(Request::OutputJacobian),
    sliced: Sliced::Outputs,
};

/// `parameter_jacobian`.
pub static PARAMETER_JACOBIAN: Signature = Signature {
    name: "parameter_jacobian",
    doc: &[
        " The derivative of the derivative by the parameters: entry (i, j) is that of component i of ẋ by",
        " the parameter j, the numbers in the fields of the struct counted in order.",
    ],
    takes_input: true,
    shape: Shape::Matrix(Size::State, Size::Parameters),
    when: When::Asked(Request::ParameterJacobian),
    sliced: Sliced::Rows,
};

/// `momenta`.
pub static MOMENTA: Signature = Signature {
    name: "momenta",
    doc: &[" The momenta of the symmetries: σ · ∂L/∂y for each section σ."],
    takes_input: false,
    shape: Shape::Record(Record::Momenta),
    when: When::WithSymmetries,
    sliced: Sliced::Named("the momenta"),
};

/// `momentum_rates`.
pub static MOMENTUM_RATES: Signature = Signature {
    name: "momentum_rates",
    doc: &[" The rates of the momenta along the motion, by the momentum equation; zero if conserved."],
    takes_input: true,
    shape: Shape::Record(Record::Momenta),
    when: When::WithSymmetries,
    sliced: Sliced::Named("the momenta"),
};

/// `bracket`.
pub static BRACKET: Signature = Signature {
    name: "bracket",
    doc: &[
        " The nonholonomic brackets of the outputs: entry (i, j) is {output i, output j}, the outputs in",
        " the order of their declaration.",
    ],
    takes_input: true,
    shape: Shape::Matrix(Size::Outputs, Size::Outputs),
    when: When::Asked(Request::Bracket),
    sliced: Sliced::Outputs,
};

/// `bracket_with_energy`.
pub static BRACKET_WITH_ENERGY: Signature = Signature {
    name: "bracket_with_energy",
    doc: &[
        " The nonholonomic brackets of the outputs with the energy: their rates along the motion, but for",
        " `drift_of_outputs`.",
    ],
    takes_input: true,
    shape: Shape::Record(Record::Outputs),
    when: When::Asked(Request::Bracket),
    sliced: Sliced::Outputs,
};

/// `drift_of_outputs`.
pub static DRIFT_OF_OUTPUTS: Signature = Signature {
    name: "drift_of_outputs",
    doc: &[
        " R_L, what the rates of the outputs have beyond their brackets with the energy: zero where the",
        " constraints are homogeneous, nothing depends on the time, and no force acts.",
    ],
    takes_input: true,
    shape: Shape::Record(Record::Outputs),
    when: When::Asked(Request::Bracket),
    sliced: Sliced::Outputs,
};

/// `divergence`.
pub static DIVERGENCE: Signature = Signature {
    name: "divergence",
    doc: &[
        " The divergence of the vector field of the motion in the coordinates of the state.",
        "",
        " Where base coordinates are embedded it is that of the motion on the embedded base. Where position",
        " constraints f = 0 hold it is that of the motion on these positions, for the volume that is divided by df,",
        " and in a state with all velocities by the differentials of the constraints on velocities as well. At other",
        " states it is that in all coordinates of the state.",
    ],
    takes_input: true,
    shape: Shape::Scalar,
    when: When::Asked(Request::Divergence),
    sliced: Sliced::Whole,
};

/// `volume_density`.
pub static VOLUME_DENSITY: Signature = Signature {
    name: "volume_density",
    doc: &[
        " The density, in the coordinates of the state, of a volume that the motion keeps.",
        "",
        " Where the state satisfies identities or constraints it is divided by their differentials. It is kept at",
        " states that satisfy them, position constraints included, and may be anything else at others.",
    ],
    takes_input: false,
    shape: Shape::Scalar,
    when: When::Asked(Request::Volume),
    sliced: Sliced::Whole,
};

/// `connection`.
pub static CONNECTION: Signature = Signature {
    name: "connection",
    doc: &[
        " The symbols of the constrained connection: entry `[a][b][c]` is the component along c of the",
        " derivative of section b along section a. Without potential and forces, the rate of velocity c",
        " is minus the sum of `[a][b][c]` times the velocities a and b.",
    ],
    takes_input: false,
    shape: Shape::Array(&[Size::Velocities, Size::Velocities, Size::Velocities]),
    when: When::Asked(Request::Connection),
    sliced: Sliced::Whole,
};

/// `christoffel`.
pub static CHRISTOFFEL: Signature = Signature {
    name: "christoffel",
    doc: &[
        " The Christoffel symbols of the kinetic metric, without constraints: entry `[a][b][c]` is the",
        " component along c of the derivative of section b along section a.",
    ],
    takes_input: false,
    shape: Shape::Array(&[Size::Sections, Size::Sections, Size::Sections]),
    when: When::Asked(Request::Connection),
    sliced: Sliced::Whole,
};

/// `hamilton_jacobi`.
pub static HAMILTON_JACOBI: Signature = Signature {
    name: "hamilton_jacobi",
    doc: &[
        " The state over the same point of the base whose momenta are the declared solution of the",
        " Hamilton–Jacobi equation: the motion from there keeps them so.",
    ],
    takes_input: false,
    shape: Shape::OverThePoint,
    when: When::WithSection,
    sliced: Sliced::Whole,
};

/// `gibbs_appell`.
pub static GIBBS_APPELL: Signature = Signature {
    name: "gibbs_appell",
    doc: &[
        " The time derivative of the state by the function of Gibbs and Appell: another derivation of",
        " the same equations, which agrees with `derivative` to rounding.",
    ],
    takes_input: true,
    shape: Shape::Record(Record::State),
    when: When::Asked(Request::GibbsAppell),
    sliced: Sliced::Rows,
};

/// `quadratures`.
pub static QUADRATURES: Signature = Signature {
    name: "quadratures",
    doc: &[" The rates of the coordinates that are not in the state: quadratures give these back."],
    takes_input: false,
    shape: Shape::Record(Record::Quadratures),
    when: When::WithQuadratures,
    sliced: Sliced::Kept,
};

/// `gyroscopic`.
pub static GYROSCOPIC: Signature = Signature {
    name: "gyroscopic",
    doc: &[
        " The force ⟨J, K⟩ on the right of the Euler–Lagrange equations of the reduced Lagrangian, by the",
        " curvature K of the constraint distribution.",
    ],
    takes_input: false,
    shape: Shape::Record(Record::Gyroscopic),
    when: When::Asked(Request::Gyroscopic),
    sliced: Sliced::Named("the gyroscopic force"),
};

/// `vertical_sections`.
pub static VERTICAL_SECTIONS: Signature = Signature {
    name: "vertical_sections",
    doc: &[
        " Sections S_ρ that span S = D ∩ V, the vertical part of the constraint distribution, by their",
        " components along the basis.",
    ],
    takes_input: false,
    shape: Shape::Array(&[Size::Vertical, Size::Sections]),
    when: When::Asked(Request::Splitting),
    sliced: Sliced::Whole,
};

/// `horizontal_lifts`.
pub static HORIZONTAL_LIFTS: Signature = Signature {
    name: "horizontal_lifts",
    doc: &[
        " The horizontal lifts h_κ of the nonholonomic connection: sections of the constraint distribution",
        " over the unit rates of the coordinates that the report names, orthogonal to S in the kinetic metric",
        " where this is a function of the coordinates alone.",
    ],
    takes_input: false,
    shape: Shape::Array(&[Size::Lifted, Size::Sections]),
    when: When::Asked(Request::Splitting),
    sliced: Sliced::Whole,
};

/// `locked_inertia`.
pub static LOCKED_INERTIA: Signature = Signature {
    name: "locked_inertia",
    doc: &[" The locked inertia: the kinetic metric on the sections S_ρ."],
    takes_input: false,
    shape: Shape::Array(&[Size::Vertical, Size::Vertical]),
    when: When::Asked(Request::Splitting),
    sliced: Sliced::Whole,
};

/// `connection_coefficients`.
pub static CONNECTION_COEFFICIENTS: Signature = Signature {
    name: "connection_coefficients",
    doc: &[
        " The coefficients Υ of the connection: entry `[κ][ρ]` is the bracket [h_κ, S_ρ] along the basis.",
    ],
    takes_input: false,
    shape: Shape::Array(&[Size::Lifted, Size::Vertical, Size::Sections]),
    when: When::Asked(Request::Splitting),
    sliced: Sliced::Whole,
};

/// `curvature`.
pub static CURVATURE: Signature = Signature {
    name: "curvature",
    doc: &[" The curvature K: entry `[κ][λ]` is the bracket [h_κ, h_λ] along the basis."],
    takes_input: false,
    shape: Shape::Array(&[Size::Lifted, Size::Lifted, Size::Sections]),
    when: When::Asked(Request::Splitting),
    sliced: Sliced::Whole,
};

/// `vertical_momenta`.
pub static VERTICAL_MOMENTA: Signature = Signature {
    name: "vertical_momenta",
    doc: &[" The nonholonomic momentum map: the momenta P_ρ along the sections S_ρ."],
    takes_input: false,
    shape: Shape::Array(&[Size::Vertical]),
    when: When::Asked(Request::Splitting),
    sliced: Sliced::Whole,
};

/// `vertical_momentum_rates`.
pub static VERTICAL_MOMENTUM_RATES: Signature = Signature {
    name: "vertical_momentum_rates",
    doc: &[" The right sides of the momentum equations: the rates of the momenta P_ρ along the motion."],
    takes_input: true,
    shape: Shape::Array(&[Size::Vertical]),
    when: When::Asked(Request::Splitting),
    sliced: Sliced::Whole,
};

/// `vertical_velocities`.
pub static VERTICAL_VELOCITIES: Signature = Signature {
    name: "vertical_velocities",
    doc: &[" The components v^ρ of the velocity along the sections S_ρ."],
    takes_input: false,
    shape: Shape::Array(&[Size::Vertical]),
    when: When::Asked(Request::Splitting),
    sliced: Sliced::Whole,
};

/// `horizontal_force`.
pub static HORIZONTAL_FORCE: Signature = Signature {
    name: "horizontal_force",
    doc: &[
        " The force on the right of the horizontal equations, by curvature and connection:",
        " −p([h_κ, h_λ]) ẋ^λ − p([h_κ, S_ρ]) v^ρ.",
    ],
    takes_input: false,
    shape: Shape::Array(&[Size::Lifted]),
    when: When::Asked(Request::Splitting),
    sliced: Sliced::Whole,
};
