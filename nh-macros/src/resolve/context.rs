//! What may be used in which section.

use crate::report::{Diagnostic, Extent};

/// The section whose expressions are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Context {
    /// `constants`
    Constants,
    /// `on`
    On,
    /// `anchor`
    Anchor,
    /// `velocities`
    Velocities,
    /// `brackets`
    Brackets,
    /// `frame`
    Frame,
    /// `lagrangian`
    Lagrangian,
    /// `holonomic`
    Holonomic,
    /// `constraints`
    Constraints,
    /// `impacts`
    Impacts,
    /// `forces`
    Forces,
    /// `auxiliary`
    Auxiliary,
    /// `outputs`
    Outputs,
    /// `conserved`
    Conserved,
    /// `symmetries`
    Symmetries,
    /// `volume`
    Volume,
    /// `hamilton_jacobi`
    HamiltonJacobi,
    /// `routh`
    Routh,
    /// `assume`
    Assume,
    /// `parameters` of a map between systems
    MapParameters,
    /// `base` of a map between systems
    MapBase,
    /// `velocities` of a map between systems
    MapVelocities,
    /// `inputs` of a map between systems
    MapInputs,
    /// Between the sections: what a value contains is asked for where it is used.
    Shared,
}

/// Something that not every section may use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Usage {
    /// A quasi-velocity.
    Velocity,
    /// `der(x)`.
    Rate,
    /// A control input.
    Input,
    /// `t`.
    Time,
    /// `abs`, `sign`, `min`, `max`.
    Branches,
    /// `self.motor(…)`.
    Method,
    /// An auxiliary state.
    Auxiliary,
    /// The rate of one.
    AuxiliaryRate,
}

/// Where what is no constant belongs.
pub(super) const VARYING: &str =
    "what differs from system to system is a field of the struct; write `name = …` with numbers here";

impl Context {
    /// The keyword of the section.
    pub(super) fn keyword(self) -> &'static str {
        match self {
            Self::Constants => "constants",
            Self::On => "on",
            Self::Anchor => "anchor",
            Self::Velocities | Self::MapVelocities => "velocities",
            Self::Brackets => "brackets",
            Self::Frame => "frame",
            Self::Lagrangian => "lagrangian",
            Self::Holonomic => "holonomic",
            Self::Constraints => "constraints",
            Self::Impacts => "impacts",
            Self::Forces => "forces",
            Self::Auxiliary => "auxiliary",
            Self::Outputs => "outputs",
            Self::Conserved => "conserved",
            Self::Symmetries => "symmetries",
            Self::Volume => "volume",
            Self::HamiltonJacobi => "hamilton_jacobi",
            Self::Routh => "routh",
            Self::Assume => "assume",
            Self::MapParameters => "parameters",
            Self::MapBase => "base",
            Self::MapInputs => "inputs",
            Self::Shared => "let",
        }
    }

    fn permits(self, usage: Usage) -> bool {
        match self {
            Self::Anchor | Self::Brackets => usage == Usage::Velocity,
            Self::Velocities => usage == Usage::Rate,
            Self::Holonomic => usage == Usage::Time,
            // where E = TM the rates are the sections
            Self::Frame => matches!(usage, Usage::Velocity | Usage::Rate),
            // moving constraints have moving sections
            Self::Symmetries => matches!(usage, Usage::Velocity | Usage::Rate | Usage::Time),
            Self::Constants | Self::On | Self::HamiltonJacobi | Self::MapParameters | Self::MapBase => false,
            Self::MapVelocities => matches!(usage, Usage::Velocity | Usage::Rate),
            Self::MapInputs => !matches!(usage, Usage::Method | Usage::AuxiliaryRate),
            Self::Constraints | Self::Impacts | Self::Conserved => {
                matches!(usage, Usage::Velocity | Usage::Rate | Usage::Time | Usage::Auxiliary)
            }
            Self::Lagrangian | Self::Volume => matches!(usage, Usage::Velocity | Usage::Rate | Usage::Time),
            Self::Forces | Self::Outputs | Self::Auxiliary | Self::Shared => true,
            // that facts and levels are about parameters alone is a law of its own
            Self::Assume | Self::Routh => {
                matches!(usage, Usage::Velocity | Usage::Rate | Usage::Time | Usage::Input)
            }
        }
    }

    /// Refuses what has no place in this section. `written` is what stands there.
    pub(super) fn check(self, usage: Usage, written: &str, at: Extent) -> Result<(), Diagnostic> {
        if self.permits(usage) {
            return Ok(());
        }
        let keyword = self.keyword();
        let role = match usage {
            Usage::Velocity => "the quasi-velocity ",
            Usage::Input => "the input ",
            Usage::Auxiliary => "the auxiliary state ",
            Usage::AuxiliaryRate => "the rate of an auxiliary state ",
            Usage::Rate | Usage::Time | Usage::Branches | Usage::Method => "",
        };
        let error = Diagnostic::new(at, format!("{role}`{written}` cannot be used in `{keyword}`"));
        Err(match (usage, self) {
            (_, Self::Constants) => {
                error.evidence("constants are numbers, the same in every system").way_out(VARYING)
            }
            (Usage::Velocity | Usage::Rate, Self::On) => error
                .evidence("identities are functions of the base coordinates")
                .way_out("relations between velocities have their place in `constraints`"),
            (Usage::Velocity | Usage::Rate, Self::Holonomic) => error
                .evidence("a position constraint relates base coordinates, parameters and `t`")
                .way_out("constrain velocities in `constraints`"),
            (_, Self::MapParameters) => error
                .evidence("the parameters of a system are constants")
                .way_out("write them in the parameters of the first system"),
            (_, Self::MapBase) => error
                .evidence("the base of one system is mapped to that of the other: a point to a point")
                .way_out("write base coordinates in those of the first system"),
            (_, Self::MapVelocities) => error
                .evidence("velocities are mapped linearly, with coefficients on the base")
                .way_out("write a sum of velocities or `der(…)` with such coefficients"),
            (_, Self::MapInputs) => {
                error.way_out("write a formula in the inputs and the state of the first system")
            }
            (Usage::Velocity | Usage::Rate | Usage::Time, Self::HamiltonJacobi) => error
                .evidence("a section of D* gives momenta as functions on the base")
                .way_out("write base coordinates and parameters"),
            (Usage::Velocity, _) => error
                .evidence("a quasi-velocity is defined as a combination of the `der(…)`")
                .way_out("write its definition out in the `der(…)`"),
            (Usage::Rate, Self::Brackets) => error
                .evidence("a bracket is a combination of sections with coefficients on the base")
                .way_out("write it with the names of the sections"),
            (Usage::Rate, _) => error
                .evidence("the anchor gives every `der(…)` as a combination of the quasi-velocities")
                .way_out("write it with the names of the quasi-velocities"),
            (Usage::Input, Self::Constraints) => error
                .evidence("a constraint holds at all times, and an input may jump")
                .way_out(format!(
                    "command its rate: `auxiliary {{ der(rate) = {written}; }} constraints {{ der(delta) = rate; }}`, \
                     or let it act through `forces`"
                )),
            (Usage::Auxiliary, Self::Assume | Self::Routh) => error
                .evidence("facts and levels are about parameters")
                .way_out("write parameters and numbers"),
            (Usage::Auxiliary, _) => error
                .evidence("it has no inertia: it acts through `forces` and through coefficients of `constraints`")
                .way_out(format!(
                    "make it a base coordinate whose velocity is commanded: `base {{ {written} }} auxiliary \
                     {{ der(rate) = …; }} constraints {{ der({written}) = rate; }}`"
                )),
            (Usage::AuxiliaryRate, Self::Constraints | Self::Conserved) => error
                .evidence("an input may be in it, and what stands here is differentiated")
                .way_out(
                    "where no input is in it, write its right-hand side; a rate that an input commands is a state of \
                     its own: `auxiliary { der(rate) = command; }`",
                ),
            (Usage::AuxiliaryRate, _) => {
                error.way_out("rates of auxiliary states have their place in `forces`, `outputs` and `auxiliary`")
            }
            (Usage::Input, _) => error.way_out(
                "inputs act through `forces`, and can be watched in `outputs`; make a constant a parameter",
            ),
            (Usage::Time, _) => error
                .evidence(
                    "its coefficients are functions on the base: of the base coordinates and the parameters",
                )
                .way_out("the time has its place in `lagrangian`, `constraints`, `forces` and `outputs`"),
            (Usage::Method, _) => error
                .evidence("what a method computes is not known when the equations are derived")
                .way_out("methods have their place in `forces` and `outputs`"),
            (Usage::Branches, _) => error
                .evidence(format!(
                    "`{written}` has no derivative where its branches meet, and the equations need one"
                ))
                .way_out(
                    "use a smooth expression, such as sqrt(x^2 + eps^2) for abs(x); `abs`, `sign`, `min` and \
                     `max` are at home in `forces` and `outputs`",
                ),
        })
    }
}
