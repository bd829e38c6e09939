//! Expressions in TeX: what they look like, and that whatever is written is well formed.

use super::super::line::{Line, display};
use super::super::names::Names;
use super::super::{equation, line::Typeset};
use super::Printer;
use crate::algebra::{Function, Function2, Graph, Rational};
use crate::id::ExprId;

/// The expression up to so many nodes.
fn line(graph: &Graph, id: ExprId, nodes: usize) -> Line {
    Printer::new(graph, &Names::of_graph(graph), nodes).formula(id)
}

fn tex(graph: &Graph, id: ExprId) -> String {
    line(graph, id, 1_000).joined().tex
}

/// Asserts that braces close, and that brackets which grow come in pairs within each line.
fn assert_well_formed(text: &str) {
    let mut depth = 0_i32;
    let mut before = ' ';
    for c in text.chars() {
        match c {
            '{' if before != '\\' => depth += 1,
            '}' if before != '\\' => depth -= 1,
            _ => {}
        }
        assert!(depth >= 0, "{text}");
        before = if before == '\\' && c == '\\' { ' ' } else { c };
    }
    assert_eq!(depth, 0, "{text}");
    for row in text.split(r"\\") {
        assert_eq!(row.matches(r"\left").count(), row.matches(r"\right").count(), "{row}");
    }
    for size in ["bigl", "Bigl"] {
        let right = size.replace('l', "r");
        assert_eq!(
            text.matches(&format!("\\{size}")).count(),
            text.matches(&format!("\\{right}")).count(),
            "{text}"
        );
    }
    let opened = text.matches(r"\begin{").count();
    assert_eq!(opened, text.matches(r"\end{").count(), "{text}");
}

#[test]
fn expressions_are_written_as_on_paper() {
    let mut g = Graph::new();
    let names = ["m", "a", "omega", "x", "theta"].map(|name| g.new_symbol(name));
    let [m, a, omega, x, theta] = names.map(|symbol| g.symbol(symbol));
    let number = |p, q| Rational::new(p, q);
    let (sin, cos) = (g.sin(theta), g.cos(theta));
    let squared = g.square(omega);
    let inertia = g.formula(m * squared);
    let half = g.scale(number(1, 2), inertia);
    let minus = g.scale(number(-1, 2), inertia);
    let sum = g.formula(x - inertia);
    let quotient = g.formula(a / sum);
    let root = g.sqrt(sum);
    let inverse_root = g.pow(sum, number(-1, 2));
    let cube_root = g.pow(x, number(1, 3));
    let sine_squared = g.square(sin);
    let product = g.formula(sin * m);
    let tangent = g.formula(sin / cos);
    let difference = g.formula(a - product);
    let double = g.scale(number(2, 1), theta);
    let of_double = g.sin(double);
    let arc = g.apply(Function::Asin, x);
    let arc_squared = g.square(arc);
    let angle = g.apply2(Function2::Atan2, x, a);
    let size = g.apply(Function::Abs, x);
    let power = g.apply(Function::Exp, double);
    let third = g.number(number(-1, 3));
    let sum_squared = g.square(sum);
    for (id, expected) in [
        (half, r"\frac{1}{2}\,m\,\omega^{2}"),
        (minus, r"-\frac{1}{2}\,m\,\omega^{2}"),
        (quotient, r"\frac{a}{x - m\,\omega^{2}}"),
        (root, r"\sqrt{x - m\,\omega^{2}}"),
        (inverse_root, r"\frac{1}{\sqrt{x - m\,\omega^{2}}}"),
        (cube_root, r"\sqrt[3]{x}"),
        (sine_squared, r"\sin^{2} \theta"),
        (product, r"m \sin \theta"),
        (tangent, r"\tan \theta"),
        (difference, r"a - m \sin \theta"),
        (of_double, r"\sin(2\,\theta)"),
        (arc, r"\arcsin x"),
        (arc_squared, r"(\arcsin x)^{2}"),
        (angle, r"\operatorname{atan2}(x, a)"),
        (size, r"\lvert x\rvert"),
        (power, r"e^{2\,\theta}"),
        (third, r"-\frac{1}{3}"),
        (sum_squared, r"(x - m\,\omega^{2})^{2}"),
    ] {
        assert_eq!(tex(&g, id), expected);
    }
}

#[test]
fn what_is_long_is_cut_between_terms() {
    let mut g = Graph::new();
    let terms: Vec<ExprId> = (0..60)
        .map(|k| {
            let (q, m) = (g.new_symbol(format!("q[{k}]")), g.new_symbol(format!("m[{k}]")));
            let (q, m) = (g.symbol(q), g.symbol(m));
            let sin = g.sin(q);
            g.formula(m * sin)
        })
        .collect();
    let sum = g.sum(&terms);
    let cut = line(&g, sum, 12).joined().tex;
    assert_eq!(cut, r"m_{0} \sin q_{0} + m_{1} \sin q_{1} + m_{2} \sin q_{2} + \cdots");
}

/// Of whatever expressions, whole or cut anywhere, in one line or broken into several.
#[test]
fn braces_and_brackets_close() {
    let mut g = Graph::new();
    let names =
        ["m", "theta", "q[2]", "x_dot", "front_left", "phi2", "é", "_"].map(|name| g.new_symbol(name));
    let mut found: Vec<ExprId> = names.map(|symbol| g.symbol(symbol)).to_vec();
    let mut state = 11_u64;
    let mut below = |bound: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(state >> 33).unwrap_or(0) % bound
    };
    let functions =
        [Function::Sin, Function::Cos, Function::Abs, Function::Exp, Function::Ln, Function::Atan];
    for _ in 0..400 {
        let (a, b) = (found[below(found.len())], found[below(found.len())]);
        let exponents = [(2, 1), (-1, 1), (1, 2), (-1, 2), (3, 2), (-2, 1), (1, 3)];
        let made = match below(6) {
            0 => g.formula(a + b),
            1 => g.formula(a - b),
            2 => g.formula(a * b),
            3 => {
                let (p, q) = exponents[below(exponents.len())];
                g.pow(a, Rational::new(p, q))
            }
            4 => g.apply(functions[below(functions.len())], a),
            _ => g.apply2(Function2::Atan2, a, b),
        };
        found.push(made);
    }
    for (index, id) in found.iter().enumerate() {
        for nodes in [1, 2, 3, 5, 8, 13, 40, 160] {
            let right = line(&g, *id, nodes);
            assert_well_formed(&right.clone().joined().tex);
            let left = Typeset::new("x", if index % 2 == 0 { 500 } else { 9_000 });
            assert_well_formed(&display(vec![equation(&left, right)]));
        }
    }
}
