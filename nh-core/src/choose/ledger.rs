//! The ledger: what competed where, what was chosen, and why the others were not.

use std::fmt;

/// Every decision of a derivation, in order.
#[derive(Clone, Debug, Default)]
pub struct Ledger {
    /// The decisions.
    pub decisions: Vec<Decision>,
}

/// One choice among forms of the same function.
#[derive(Clone, Debug, Default)]
pub struct Decision {
    /// What was to be computed.
    pub site: &'static str,
    /// The forms that were looked at.
    pub contenders: Vec<Contender>,
    /// What was left aside for its size, with the limit, and what could not be proved or decided.
    pub limits: Vec<String>,
}

/// A form that was looked at.
#[derive(Clone, Debug)]
pub struct Contender {
    /// Its name in the registry.
    pub form: &'static str,
    /// The work, in the unit of [`crate::program::Cost::weighted`]; `None` for what was not solved.
    pub cost: Option<u64>,
    /// How much larger rounding errors are than those of the most accurate contender.
    pub rounding: Option<f64>,
    /// What became of it.
    pub fate: Fate,
}

/// What became of a contender.
#[derive(Clone, Debug, PartialEq)]
pub enum Fate {
    /// It is emitted, and proved: a motion by the declared equations, any other function by its definition.
    Chosen(Proof),
    /// It was not admitted, and why.
    NotAdmitted(String),
    /// It was not looked at any further, nor proved: why it could not win.
    Lost(&'static str),
}

/// How a form was proved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Proof {
    /// Points of the field at which it was evaluated.
    pub points: u64,
    /// The probability that something else passes, as a power of two: log₂ of one over it.
    pub bits: f64,
    /// Whether the points are those of the embedded base: elsewhere it need not hold.
    pub is_on_base: bool,
}

impl Ledger {
    /// What was decided at a site, the last time.
    #[must_use]
    pub fn at(&self, site: &str) -> Option<&Decision> {
        self.decisions.iter().rev().find(|decision| decision.site == site)
    }

    /// Takes out what was decided at a site, to be completed.
    pub(crate) fn take(&mut self, site: &str) -> Option<Decision> {
        let place = self.decisions.iter().position(|decision| decision.site == site)?;
        Some(self.decisions.remove(place))
    }
}

impl Decision {
    /// The form that is emitted.
    #[must_use]
    pub fn chosen(&self) -> Option<&Contender> {
        self.contenders.iter().find(|contender| matches!(contender.fate, Fate::Chosen(_)))
    }
}

impl fmt::Display for Ledger {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for decision in &self.decisions {
            writeln!(f, "{}", decision.site)?;
            for Contender { form, cost, rounding, fate } in &decision.contenders {
                write!(f, "  {form}")?;
                if let Some(cost) = cost {
                    write!(f, ", cost {cost}")?;
                }
                if let Some(rounding) = rounding {
                    write!(f, ", rounding {rounding:.2}")?;
                }
                match fate {
                    Fate::Chosen(Proof { points, bits, is_on_base }) => {
                        let whose = if *is_on_base { " of the base" } else { "" };
                        writeln!(f, ": chosen, proved at {points} points{whose} to 2^-{bits:.0}")?;
                    }
                    Fate::NotAdmitted(reason) => writeln!(f, ": not admitted: {reason}")?,
                    Fate::Lost(reason) => writeln!(f, ": {reason}")?,
                }
            }
            for limit in &decision.limits {
                writeln!(f, "  {limit}")?;
            }
        }
        Ok(())
    }
}
