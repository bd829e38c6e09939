//! The span table: what the origins of a model are in the declaration.

use nonholonomic_core::id::{Id, Origin, Table};
use nonholonomic_core::violation::Violation;

use crate::report::{Diagnostic, Extent};

/// The extents that the origins of a model stand for.
#[derive(Clone, Debug, Default)]
pub(crate) struct Origins {
    extents: Table<Origin, Extent>,
}

impl Origins {
    /// A new origin for a place in the declaration.
    pub(super) fn at(&mut self, extent: Extent) -> Origin {
        self.extents.push(extent)
    }

    /// The whole declaration: what stands at the first origin.
    pub(super) fn whole(&self) -> Extent {
        let whole = self.extents.get(Origin::from_index(0)).copied();
        whole.unwrap_or(Extent::at(proc_macro2::Span::call_site()))
    }

    /// A violation as an error at its place.
    pub(crate) fn diagnostic(&self, violation: Violation) -> Diagnostic {
        let extent = self.extents.get(violation.origin).or_else(|| self.extents.get(Origin::from_index(0)));
        let extent = extent.copied().unwrap_or(Extent::at(proc_macro2::Span::call_site()));
        let mut error = Diagnostic::new(extent, violation.what);
        if !violation.evidence.is_empty() {
            error = error.evidence(violation.evidence);
        }
        if !violation.way_out.is_empty() {
            error = error.way_out(violation.way_out);
        }
        error
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nonholonomic_core::violation::Law;

    #[test]
    fn a_violation_keeps_its_parts() {
        let mut origins = Origins::default();
        let origin = origins.at(Extent::at(proc_macro2::Span::call_site()));
        let violation = Violation {
            law: Law::Jacobi,
            origin,
            what: "broken".into(),
            evidence: String::new(),
            way_out: "repair it".into(),
        };
        let message = violation.message();
        assert_eq!(origins.diagnostic(violation).to_string(), message);
    }
}
