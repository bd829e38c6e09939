//! The zero test on identities of roots, exponentials, logarithms and arcs, and on near misses of them.

use nonholonomic_core::algebra::{Function, Graph, Rational, Verdict};
use nonholonomic_core::id::ExprId;
use proptest::prelude::*;

/// A graph with x and y.
fn graph() -> (Graph, ExprId, ExprId) {
    let mut g = Graph::new();
    let [x, y] = ["x", "y"].map(|name| g.new_symbol(name));
    let (x, y) = (g.symbol(x), g.symbol(y));
    (g, x, y)
}

/// An expression that vanishes where it is defined, number `which` of some, made with the numbers a and b.
fn nothing(g: &mut Graph, x: ExprId, y: ExprId, which: usize, a: i64, b: i64) -> ExprId {
    let (ea, eb) = (g.number(a), g.number(b));
    let (ax, bx) = (g.formula(ea * x), g.formula(eb * x));
    match which {
        // √((x² − y²)² + 4 x² y²) = x² + y²
        0 => {
            let (xx, yy) = (g.square(ax), g.square(y));
            let (difference, product, sum) = (g.formula(xx - yy), g.formula(xx * yy), g.formula(xx + yy));
            let square = g.square(difference);
            let inside = g.linear_combination(&[(Rational::ONE, square), (4.into(), product)]);
            let root = g.sqrt(inside);
            g.formula(root - sum)
        }
        // √cosh² = cosh
        1 => {
            let c = g.apply(Function::Cosh, ax);
            let square = g.square(c);
            let one = g.one();
            let (inner, sinh) = (g.formula(square - one), g.apply(Function::Sinh, ax));
            let with = g.square(sinh);
            let square = g.formula(square + (inner - with));
            let root = g.sqrt(square);
            g.formula(root - c)
        }
        // ln(sinh + cosh)
        2 => {
            let (s, c) = (g.apply(Function::Sinh, ax), g.apply(Function::Cosh, ax));
            let sum = g.formula(s + c);
            let ln = g.apply(Function::Ln, sum);
            g.formula(ln - ax)
        }
        // ln(x^a y) = a ln x + ln y
        3 => {
            let power = g.pow(x, a.into());
            let product = g.formula(power * y);
            let [whole, lx, ly] = [product, x, y].map(|e| g.apply(Function::Ln, e));
            g.linear_combination(&[(1.into(), whole), ((-a).into(), lx), ((-1).into(), ly)])
        }
        // √(a + 2√(ab) + b) = √a + √b
        4 => {
            let (ra, rb) = (g.sqrt(ea), g.sqrt(eb));
            let ab = g.formula(ea * eb);
            let middle = g.sqrt(ab);
            let inside = g.linear_combination(&[(1.into(), ea), (2.into(), middle), (1.into(), eb)]);
            let root = g.sqrt(inside);
            g.linear_combination(&[(1.into(), root), ((-1).into(), ra), ((-1).into(), rb)])
        }
        // atan(1/a) = atan(1/(a + b)) + atan(b/(a² + ab + 1))
        5 => {
            let arc = |g: &mut Graph, n, d| {
                let quotient = g.number(Rational::new(n, d));
                g.apply(Function::Atan, quotient)
            };
            let arcs = [arc(g, 1, a), arc(g, 1, a + b), arc(g, b, a * a + a * b + 1)];
            g.linear_combination(&[(1.into(), arcs[0]), ((-1).into(), arcs[1]), ((-1).into(), arcs[2])])
        }
        // Π over k of 2 cos(kπ/(2n + 1)) = 1
        6 => {
            let (n, pi) = (a.min(5), g.pi());
            let mut product = g.one();
            for k in 1..=n {
                let angle = g.scale(Rational::new(k, 2 * n + 1), pi);
                let cosine = g.cos(angle);
                let double = g.scale(2.into(), cosine);
                product = g.formula(product * double);
            }
            let one = g.one();
            g.formula(product - one)
        }
        // the golden ratio: φ² = φ + 1, times something that is not 0
        7 => {
            let (five, one) = (g.number(5), g.one());
            let root = g.sqrt(five);
            let sum = g.formula(one + root);
            let golden = g.scale(Rational::new(1, 2), sum);
            let square = g.square(golden);
            let nested = g.sqrt(square);
            let defect =
                g.linear_combination(&[(1.into(), square), ((-1).into(), nested), ((-1).into(), one)]);
            let exponential = g.apply(Function::Exp, bx);
            g.formula(defect * exponential)
        }
        // sin(arc) in a triangle: asin(s) + acos(s) = π/2
        _ => {
            let s = g.number(Rational::new(a, a + b));
            let arcs = [g.apply(Function::Asin, s), g.apply(Function::Acos, s), g.pi()];
            g.linear_combination(&[(1.into(), arcs[0]), (1.into(), arcs[1]), (Rational::new(-1, 2), arcs[2])])
        }
    }
}

const KINDS: usize = 9;

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, ..ProptestConfig::default() })]

    #[test]
    fn identities_are_proved(which in 0..KINDS, a in 1..12i64, b in 1..12i64) {
        let (mut g, x, y) = graph();
        let defect = nothing(&mut g, x, y, which, a, b);
        prop_assert_eq!(g.zero_test(defect), Verdict::Zero, "{}", g.text(defect));
    }

    #[test]
    fn near_misses_are_not(which in 0..KINDS, a in 1..12i64, b in 1..12i64, digits in 9..31u32, negative: bool) {
        let (mut g, x, y) = graph();
        let defect = nothing(&mut g, x, y, which, a, b);
        let tiny = Rational::from(10).pow(-i64::from(digits)).unwrap();
        let tiny = g.number(if negative { -tiny } else { tiny });
        let missed = g.formula(defect + tiny);
        let verdict = g.zero_test(missed);
        prop_assert!(verdict.is_nonzero(), "{}: {verdict:?}", g.text(missed));
    }
}

#[test]
fn numbers_that_look_like_integers() {
    // e^(π√163) is an integer to twelve digits behind the point
    let mut g = Graph::new();
    let (pi, n) = (g.pi(), g.number(163));
    let root = g.sqrt(n);
    let product = g.formula(pi * root);
    let power = g.apply(Function::Exp, product);
    let integer = g.number(262_537_412_640_768_744);
    let defect = g.formula(power - integer);
    let Verdict::NonZero(witness) = g.zero_test(defect) else { panic!("not decided") };
    assert!((witness.value + 7.499e-13).abs() < 1e-15, "{witness:?}");
}

#[test]
fn what_no_identity_explains_is_unknown_and_says_how_many_digits_agree() {
    let mut g = Graph::new();
    let one = g.one();
    let sine = g.sin(one);
    let arc = g.apply(Function::Asin, sine);
    let defect = g.formula(arc - one);
    let Verdict::Unknown(why) = g.zero_test(defect) else { panic!("decided") };
    assert!(why.starts_with("it is zero to 614 digits"), "{why}");
}
