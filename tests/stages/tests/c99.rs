//! `emit { c }`: the file compiles without a warning, and computes what the programs say, bit for bit where both take
//! the sine of the C library.

use std::fmt::Write;
use std::path::PathBuf;
use std::process::Command;

use nh_stages::{Declaration, constant, declarations};
use nonholonomic_core::functions::ENERGY;
use nonholonomic_core::id::SymbolId;
use nonholonomic_core::mechanics::Procedure;
use nonholonomic_core::program::{interpret, schedule_grouping};
use nonholonomic_core::system::System;

/// What the compiler is asked: no warning, no fused operations that were not written.
const FLAGS: [&str; 8] =
    ["-std=c99", "-pedantic", "-Wall", "-Wextra", "-Wconversion", "-Wshadow", "-Werror", "-ffp-contract=off"];

const MACHINES: &str = "
#[nonholonomic(
    base { theta, x, y } basis { omega, v1, v2 }
    anchor {
        der(theta) = omega; der(x) = v1 * cos(theta) - v2 * sin(theta); der(y) = v1 * sin(theta) + v2 * cos(theta);
    }
    lagrangian { J / 2 * omega^2 + m / 2 * ((v1 - b * omega)^2 + (v2 + a * omega)^2) }
    constraints { edge: v2 = 0; } inputs { torque } forces { omega: torque - c * omega^3; }
    outputs { speed = sqrt(v1^2 + v2^2); } emit { c, jacobian, multipliers }
)]
struct Sleigh { m: f64, J: f64, a: f64, b: f64, c: f64 }

#[nonholonomic(
    base { g[3] } on { dot(g, g) = 1; } basis { w[3] } anchor { der(g) = cross(g, w); } brackets so(3) { w }
    lagrangian { sum(i in 0..3: I[i] * w[i]^2) / 2 - dot(double, g) } constraints { dot(g, w) = 0; } emit { c }
)]
struct VeselovaBody { I: [f64; 3], double: [f64; 3] }

#[nonholonomic(
    base { q[5] }
    lagrangian {
        sum(i in 0..5: m / 2 * der(q[i])^2) + k * sum(i in 0..4: cos(q[i] - q[i+1]) * der(q[i]) * der(q[i+1])) / 3
    }
    forces { for i in 0..5 { q[i]: min(q[i], 1) * sign(der(q[i])) - abs(q[i])^(5/2) + max(t, atan2(q[i], 2)); } }
    emit { c }
)]
struct Chain { m: f64, k: f64 }

#[nonholonomic(
    base { x, y, z }
    lagrangian { a * der(x) * der(y) + b * der(y) * der(z) + c * der(z) * der(x) + sin(x) * der(x)^2 - k * x * y * z }
    emit { c }
)]
struct Indefinite { a: f64, b: f64, c: f64, k: f64 }
";

/// Prints a number so that it reads back as itself.
const PRINT: &str = r#"printf("%.17g\n", "#;

fn text_of(declaration: &Declaration) -> String {
    constant(declaration.expanded(), "C99").expect("`C99`")
}

/// A value for every symbol, not the same for any two.
fn value(symbol: SymbolId) -> f64 {
    let k = f64::from(u32::try_from(nonholonomic_core::id::Id::index(symbol)).expect("small"));
    0.3 + (k * 0.618).fract()
}

/// A program that prints the derivative and the energy at these values.
fn main_of(system: &System, name: &str, prefix: &str, text: &str) -> String {
    let names = system.model.graph.symbols();
    let mut main =
        format!("{text}\n#include <stdio.h>\nint main(void)\n{{\n    {name} p;\n    {name}State x;\n");
    let mut arguments = format!("&p, {:?}, &x", value(system.model.time));
    if !system.model.inputs.is_empty() {
        _ = writeln!(main, "    {name}Input u;");
    }
    main.push_str("    double e[1];\n");
    _ = writeln!(main, "    {name}State rate;");
    let c = |name: &str| name.replace("double", "double_");
    for parameter in &system.model.parameters {
        _ = writeln!(main, "    p.{} = {:?};", c(&parameter.name), value(parameter.symbol));
    }
    for symbol in system.state() {
        _ = writeln!(main, "    x.{} = {:?};", names[symbol], value(symbol));
    }
    for input in &system.model.inputs {
        _ = writeln!(main, "    u.{} = {:?};", input.name, value(input.symbol));
    }
    _ = writeln!(main, "    {prefix}_energy({arguments}, e);");
    if !system.model.inputs.is_empty() {
        arguments.push_str(", &u");
    }
    _ = writeln!(main, "    {prefix}_derivative({arguments}, &rate);");
    for symbol in system.state() {
        _ = writeln!(main, "    {PRINT}rate.{});", names[symbol]);
    }
    _ = write!(main, "    {PRINT}e[0]);\n    return 0;\n}}\n");
    main
}

fn scratch(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name)
}

fn compiled(name: &str, text: &str, more: &[&str]) -> PathBuf {
    let (source, binary) = (scratch(&format!("{name}.c")), scratch(name));
    std::fs::write(&source, text).expect("written");
    let run =
        Command::new("gcc").args(FLAGS).args(more).arg(&source).arg("-o").arg(&binary).arg("-lm").output();
    let output = run.expect("gcc is there");
    assert!(output.status.success(), "{}\n{text}", String::from_utf8_lossy(&output.stderr));
    binary
}

#[test]
fn c_computes_what_the_programs_say() {
    for declaration in declarations(MACHINES) {
        let name = declaration.name.clone();
        let prefix = match name.as_str() {
            "VeselovaBody" => "veselova_body".to_owned(),
            _ => name.to_lowercase(),
        };
        let text = text_of(&declaration);
        let system = declaration.system().unwrap_or_else(|errors| panic!("{name}: {errors:?}"));
        assert_eq!(text.contains("solve_3("), name == "Indefinite", "{text}");
        let binary = compiled(&name, &main_of(&system, &name, &prefix, &text), &[]);
        let printed = String::from_utf8(Command::new(binary).output().expect("runs").stdout).expect("text");
        let found: Vec<f64> = printed.lines().map(|line| line.parse().expect("a number")).collect();
        let parameters: Vec<_> = system.model.parameters.iter().map(|parameter| parameter.symbol).collect();
        let run = |procedure: &Procedure| {
            interpret(&schedule_grouping(&system.model.graph, procedure, &parameters), value)
        };
        let mut expected = run(&system.derivative);
        expected.extend(run(system.functions.get(&ENERGY).expect("an energy")));
        assert_eq!(found.len(), expected.len(), "{name}");
        for (k, (found, expected)) in found.iter().zip(&expected).enumerate() {
            // the interpreter chooses other pivots than the runtime, and C
            let apart = found.to_bits().abs_diff(expected.to_bits());
            let allowed = if name == "Indefinite" { 2 } else { 0 };
            assert!(apart <= allowed, "{name}, component {k}: {found} and {expected}\n{text}");
        }
    }
}

/// A linkage that keeps one velocity: functions that are not written in C solve for all of them.
const LINKAGE: &str = "
#[nonholonomic(
    base { a, b, c, e, f }
    inputs { torque }
    let u(q) = [cos(q), sin(q)];
    let P = l[0] * u(a);
    let Q = [d[0], 0] + l[2] * u(c);
    let S = P + tri[0] * u(b) + tri[1] * u(b + pi / 2);
    let Z = [d[0] + d[1], 0] + l[4] * u(f);
    holonomic {
        first: P + l[1] * u(b) - Q = 0;
        second: S + l[3] * u(e) - Z = 0;
    }
    lagrangian {
        kinetic(m[0], J[0], P / 2, a) + kinetic(m[1], J[1], (P + Q) / 2, b) + kinetic(m[2], J[2], [d[0], 0] + l[2] / 2 * u(c), c)
        + kinetic(m[3], J[3], (S + Z) / 2, e) + kinetic(m[4], J[4], Z - l[4] / 2 * u(f), f)
        - g * (m[0] * P[1] + m[1] * (P[1] + Q[1]) + m[2] * Q[1] + m[3] * (S[1] + Z[1]) + m[4] * Z[1]) / 2
        - k / 2 * (f - pi / 2)^2
    }
    forces { a: torque; }
    independent { a, der(a) }
    linearization { }
    outputs { height = S[1]; rise = der(S[1]); }
    emit { jacobian, multipliers, reactions, power, c, explain, return_jacobian }
)]
#[derive(Clone, Copy, Debug)]
struct Watt { d: [f64; 2], l: [f64; 5], tri: [f64; 2], m: [f64; 5], J: [f64; 5], g: f64, k: f64 }
";

/// What the functions that are written do not need is not there: a compiler would warn of it.
#[test]
fn no_helper_is_idle() {
    let text = text_of(&declarations(LINKAGE)[0]);
    let helpers = text.lines().filter_map(|line| line.strip_prefix("static ")?.split('(').next());
    for helper in helpers.filter_map(|line| line.split(' ').next_back()) {
        assert!(text.matches(&format!("{helper}(")).count() > 1, "{helper}\n{text}");
    }
    compiled("linkage", &text, &["-c"]);
}

#[test]
fn methods_are_prototypes_and_single_precision_is_float() {
    let source = "
        #[nonholonomic(
            base { x } lagrangian { m / 2 * der(x)^2 - m * g * sin(x) } inputs { auto }
            forces { x: auto - self.friction(der(x), 1/3); } emit { c }
        )]
        struct S { m: f32, g: f32 }";
    let text = text_of(&declarations(source)[0]);
    assert!(text.contains("extern float s_friction(const S *p, float x0, float x1);"), "{text}");
    assert!(text.contains("float auto_;") && !text.contains("double"), "{text}");
    compiled("single", &text, &["-c", "-Wdouble-promotion"]);
}

/// Words of C that Rust lets stand, or lets stand behind `r#`, numbers of `math.h`, letters beyond ASCII, and the names that
/// become of these.
#[test]
fn names_that_c_keeps_are_told_from_one_another() {
    let fields = [
        "double",
        "double_",
        "r#const",
        "r#enum",
        "r#do",
        "r#typeof",
        "_Bool",
        "FP_NAN",
        "HUGE_VALF",
        "M_PI",
        "unix",
        "é",
        "u00e9",
        "p",
        "x1",
        "v0",
    ];
    let sum = fields.join(" + ");
    let declared = fields.map(|field| format!("{field}: f64")).join(", ");
    let source = format!(
        "#[nonholonomic(
            base {{ short, short_, r#static[2] }} inputs {{ long, long_ }}
            lagrangian {{ ({sum}) / 2 * (der(short)^2 + der(short_)^2 + dot(der(r#static), der(r#static))) }}
            forces {{ short: long * self.int(short_) + self.int_(short); short_: long_ + self.derivative(short); }}
            emit {{ c }}
        )]
        struct Kept {{ {declared} }}"
    );
    let declaration = &declarations(&source)[0];
    assert_eq!(declaration.system().err(), None);
    let text = text_of(declaration);
    for (k, standard) in ["-std=c99", "-std=gnu99", "-std=gnu17", "-std=c2x"].into_iter().enumerate() {
        compiled(&format!("kept{k}"), &text, &["-c", standard]);
    }
    for line in
        ["double double_;", "double double__;", "double static_[2];", "double kept_derivative_(const Kept *p"]
    {
        assert!(text.contains(line), "{line}: {text}");
    }
}

#[test]
fn a_type_parameter_is_refused() {
    let source =
        "#[nonholonomic(base { x } lagrangian { m / 2 * der(x)^2 } emit { c })] struct S<T> { m: T }";
    let errors = declarations(source)[0].system().expect_err("refused");
    assert_eq!(
        errors,
        [
            "C is written for `f64` or `f32`\nthe fields of this struct are of a type that is a parameter\nhelp: declare a \
          struct with fields of one of these types beside it"
        ]
    );
}
