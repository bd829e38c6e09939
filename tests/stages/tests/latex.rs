//! `emit { latex }`: one text that is a document by itself, and a body inside of another one.

use std::path::Path;

use nh_stages::{Declaration, arms, constant, declarations, references};

const SLEIGH: &str = "
    /// A sleigh on a blade, 100 % of `side` is lost.
    #[nonholonomic(
        base { x, y, theta }
        basis { omega, v, side }
        anchor {
            der(x) = v * cos(theta) - side * sin(theta);
            der(y) = v * sin(theta) + side * cos(theta);
            der(theta) = omega;
        }
        inputs { torque }
        lagrangian { J / 2 * omega^2 + m / 2 * (v^2 + (side + a * omega)^2) - m * g * a * x / sqrt(a^2 + y^2) }
        constraints { blade: side = 0; }
        forces { omega: torque - self.drag(v, omega); }
        auxiliary { der(lag_1) = (torque - lag_1) / tau; }
        outputs { power = torque * omega; }
        symmetries { spin: omega; }
        assume { m > 0; J > 0; }
        units { x, y = m; t = s; m = kg; }
        emit { latex }
    )]
    struct Sleigh {
        /// The mass.
        m: f64,
        J: f64,
        a: f64,
        g: f64,
        tau: f64,
    }";

fn text(declaration: &Declaration) -> String {
    constant(declaration.asking_for("latex").expanded(), "LATEX").expect("`LATEX`")
}

#[test]
fn the_text_of_a_sleigh() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/latex/sleigh.tex");
    let now = text(&declarations(SLEIGH)[0]);
    assert!(!now.is_empty(), "{:?}", nh_stages::errors(&declarations(SLEIGH)[0].expanded()));
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        std::fs::write(&path, &now).unwrap();
    }
    let pinned = std::fs::read_to_string(&path).unwrap();
    assert_eq!(now, pinned, "run with UPDATE_GOLDEN=1 if this is meant");
    assert_eq!(now, text(&declarations(SLEIGH)[0]), "it is the same every time");
}

#[test]
fn it_is_there_where_it_is_asked_for() {
    let silent = &declarations(&SLEIGH.replace("emit { latex }", ""))[0];
    assert_eq!(constant(silent.expanded(), "LATEX"), None);
    let refused = &declarations(&SLEIGH.replace("side = 0", "sides = 0"))[0];
    assert_eq!(constant(refused.expanded(), "LATEX").as_deref(), Some(""), "stubs have it, too");
}

/// Environments and braces close in the texts of all systems, and none is a book.
#[test]
fn every_system_has_a_text() {
    // the others are compiled by TeX, see `.ci/latex`
    let systems = [references(), arms().into_iter().step_by(7).collect()].concat();
    let mut count = 0;
    for (name, declaration) in systems {
        let text = text(&declaration);
        let body = text.split_once("\\begingroup").map_or_else(|| panic!("{name}"), |(_, body)| body);
        let is_open = |text: &str| {
            let braces = text.replace("\\{", "").replace("\\}", "");
            braces.matches('{').count() != braces.matches('}').count()
        };
        assert!(!is_open(body), "{name}\n{body}");
        for environment in ["align*", "itemize", "pmatrix"] {
            let count = |word: &str| body.matches(&format!("\\{word}{{{environment}}}")).count();
            assert_eq!(count("begin"), count("end"), "{name}: {environment}");
        }
        assert!(
            body.contains("Equations of motion") && body.contains("\\subsection*{Lagrangian}"),
            "{name}\n{body}"
        );
        assert!(body.len() < 40_000, "{name}: {} bytes", body.len());
        count += 1;
    }
    assert!(count > 40, "{count}");
}
