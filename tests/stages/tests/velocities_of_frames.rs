//! Velocities of sections of a frame beside `distribution`: those of sections that do not span D belong to no motion.

use nh_stages::declarations;

/// The errors of a declaration whose D is spanned by `along`, given by further sections.
fn errors(further: &str) -> Vec<String> {
    let source = format!(
        "#[nonholonomic(base {{ x, y }} frame {{ along = der(x) + y * der(y); across = der(y); }}
            distribution {{ along }} lagrangian {{ (der(x)^2 + der(y)^2) / 2 }} {further})] struct S;"
    );
    declarations(&source)[0].system().err().unwrap_or_default()
}

#[test]
fn a_velocity_beside_the_span_is_refused_where_it_is_written() {
    for further in [
        "conserved { c = across; } emit { invariants }",
        "outputs { o = across^2; }",
        "volume { across; }",
        "forces { along: -across; }",
        "auxiliary { der(z) = across; }",
        "impacts { stop: across = 0; }",
    ] {
        let found = errors(further);
        assert_eq!(found.len(), 1, "{further}: {found:?}");
        assert!(
            found[0].starts_with("`across` is no velocity of a motion\nD is the span of along"),
            "{further}: {}",
            found[0]
        );
    }
}

#[test]
fn velocities_of_the_span_and_declared_ones_are_written_anywhere() {
    for further in [
        "outputs { o = along^2; p = der(y); }",
        "forces { along: -along * der(y)^2; }",
        "auxiliary { der(z) = along - z; }",
    ] {
        assert_eq!(errors(further), Vec::<String>::new(), "{further}");
    }
}
