//! Rules about which sections there are and which go together.

use super::ast::SystemDecl;
use crate::report::{Diagnostic, Errors, Extent};

/// After this point the sections that are needed are there, and none contradicts another.
pub(crate) fn check(declaration: &SystemDecl) -> Result<(), Vec<Diagnostic>> {
    let mut errors = Errors::new();
    if is_empty(declaration) {
        let name = &declaration.structure.name;
        errors.push(
            Diagnostic::new(Extent::at(name.span()), format!("`{name}` has no declaration")).way_out(
                "say what moves, and how: `#[nonholonomic(base { x } lagrangian { m / 2 * der(x)^2 })]`",
            ),
        );
    } else {
        require_lagrangian(declaration, &mut errors);
        require_motion(declaration, &mut errors);
    }
    refuse_two_frames(declaration, &mut errors);
    require_basis(declaration, &mut errors);
    errors.finish(())
}

/// Whether neither what moves nor how is said, as by an attribute without parentheses.
fn is_empty(declaration: &SystemDecl) -> bool {
    let s = &declaration.sections;
    s.lagrangian.is_none() && s.base.is_none() && s.basis.is_none() && s.velocities.is_none()
}

/// Without a Lagrangian there is no system.
fn require_lagrangian(declaration: &SystemDecl, errors: &mut Errors) {
    if declaration.sections.lagrangian.is_none() {
        let name = &declaration.structure.name;
        errors.push(
            Diagnostic::new(Extent::at(name.span()), format!("`{name}` has no Lagrangian"))
                .way_out("add `lagrangian { … }`: kinetic minus potential energy"),
        );
    }
}

/// Something has to move.
fn require_motion(declaration: &SystemDecl, errors: &mut Errors) {
    let s = &declaration.sections;
    if s.base.is_none() && s.basis.is_none() && s.velocities.is_none() {
        let name = &declaration.structure.name;
        errors.push(
            Diagnostic::new(
                Extent::at(name.span()),
                format!("`{name}` has neither coordinates nor velocities"),
            )
            .way_out("add `base { x, y }` for coordinates, `basis { omega }` for quasi-velocities"),
        );
    }
}

/// Quasi-velocities come from a basis with its anchor, or from a coframe.
fn refuse_two_frames(declaration: &SystemDecl, errors: &mut Errors) {
    let s = &declaration.sections;
    let Some(velocities) = &s.velocities else { return };
    for other in [s.basis.as_ref().map(|s| &s.keyword), s.anchor.as_ref().map(|s| &s.keyword)] {
        let Some(other) = other else { continue };
        errors.push(
            Diagnostic::new(other.extent(), format!("`{}` and `velocities` in one declaration", other.text))
                .evidence("both say what the quasi-velocities are")
                .way_out("keep either `basis` with `anchor`, or `velocities`"),
        );
    }
    if s.base.is_none() {
        errors.push(
            Diagnostic::new(velocities.keyword.extent(), "`velocities` without `base`")
                .evidence("velocities are defined by derivatives of base coordinates")
                .way_out("add `base { x, y }`"),
        );
    }
}

/// Anchors and brackets speak about the sections of a basis.
fn require_basis(declaration: &SystemDecl, errors: &mut Errors) {
    let s = &declaration.sections;
    // without a base that there are none is said already
    if s.basis.is_some() || s.velocities.is_some() || s.base.is_none() {
        return;
    }
    let (anchor, brackets) = (s.anchor.as_ref().map(|s| &s.keyword), s.brackets.first().map(|s| &s.keyword));
    let Some(first) = anchor.or(brackets) else { return };
    let (what, sections) = match (anchor, brackets) {
        (Some(_), Some(_)) => ("`anchor` and `brackets` without `basis`".to_owned(), "sections"),
        _ => (format!("`{}` without `basis`", first.text), "section"),
    };
    errors.push(
        Diagnostic::new(first.extent(), what)
            .evidence("there are no quasi-velocities but the derivatives of the base coordinates")
            .way_out(format!("add `basis {{ omega, v1 }}`, or leave the {sections} out")),
    );
}

#[cfg(test)]
mod tests {
    use crate::syntax::testing::messages;

    #[test]
    fn what_is_needed_is_asked_for() {
        assert_eq!(
            messages("base { x }", "struct S;"),
            ["`S` has no Lagrangian\nhelp: add `lagrangian { … }`: kinetic minus potential energy"]
        );
        assert_eq!(
            messages("lagrangian { 1 }", "struct S;"),
            ["`S` has neither coordinates nor velocities\nhelp: add `base { x, y }` for coordinates, \
              `basis { omega }` for quasi-velocities"]
        );
        assert_eq!(
            messages("lagrangian { w^2 } velocities { w = 1 }", "struct S;"),
            ["`velocities` without `base`\nvelocities are defined by derivatives of base \
              coordinates\nhelp: add `base { x, y }`"]
        );
    }

    #[test]
    fn an_empty_declaration_is_one_error() {
        let told = "`S` has no declaration\nhelp: say what moves, and how: \
                    `#[nonholonomic(base { x } lagrangian { m / 2 * der(x)^2 })]`";
        assert_eq!(messages("", "struct S;"), [told]);
        assert_eq!(messages("assume { m > 0; }", "struct S { m: f64 }"), [told]);
    }

    #[test]
    fn contradicting_sections_are_refused() {
        assert_eq!(
            messages("base { x } basis { w } velocities { w = der(x) } lagrangian { w^2 }", "struct S;"),
            ["`basis` and `velocities` in one declaration\nboth say what the quasi-velocities \
              are\nhelp: keep either `basis` with `anchor`, or `velocities`"]
        );
        assert_eq!(
            messages("base { x } anchor { der(x) = v; } lagrangian { 1 }", "struct S;"),
            ["`anchor` without `basis`\nthere are no quasi-velocities but the derivatives of the base \
              coordinates\nhelp: add `basis { omega, v1 }`, or leave the section out"]
        );
    }
}
