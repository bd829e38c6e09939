use super::*;
use crate::algebra::{Function, Rational};

fn symbols<const N: usize>(g: &mut Graph, names: [&str; N]) -> [ExprId; N] {
    names.map(|name| {
        let symbol = g.new_symbol(name);
        g.symbol(symbol)
    })
}

#[test]
fn addition_theorems() {
    let mut g = Graph::new();
    let [a, b] = symbols(&mut g, ["a", "b"]);
    let half = g.scale(Rational::new(1, 2), b);
    let sum = g.add(a, half);
    let left = g.sin(sum);
    let (sa, ca, sb, cb) = (g.sin(a), g.cos(a), g.sin(half), g.cos(half));
    let (x, y) = (g.mul(sa, cb), g.mul(ca, sb));
    let right = g.add(x, y);
    let defect = g.sub(left, right);
    assert_eq!(g.zero_test(defect), Verdict::Zero);
    let wrong = g.sub(x, y);
    let defect = g.sub(left, wrong);
    assert!(g.zero_test(defect).is_nonzero());
}

#[test]
fn parts_of_a_turn() {
    let mut g = Graph::new();
    let [a] = symbols(&mut g, ["a"]);
    let pi = g.pi();
    for n in 1..12 {
        let part = g.scale(Rational::new(n, 12), pi);
        let shifted = g.add(a, part);
        let (left, s, c) = (g.sin(shifted), g.sin(a), g.cos(a));
        let (sp, cp) = (g.sin(part), g.cos(part));
        let (x, y) = (g.mul(s, cp), g.mul(c, sp));
        let right = g.add(x, y);
        let defect = g.sub(left, right);
        assert_eq!(g.zero_test(defect), Verdict::Zero, "{}", g.text(defect));
    }
}

#[test]
fn half_angles() {
    let mut g = Graph::new();
    let [b] = symbols(&mut g, ["b"]);
    let half = g.scale(Rational::new(1, 2), b);
    let (sb, ch, sh) = (g.sin(b), g.cos(half), g.sin(half));
    let product = g.mul(sh, ch);
    let defect = g.linear_combination(&[(Rational::ONE, sb), (Rational::from(-2), product)]);
    assert_eq!(g.zero_test(defect), Verdict::Zero);
}

#[test]
fn angles_are_compared_by_value() {
    let mut g = Graph::new();
    let [x, y, z] = symbols(&mut g, ["x", "y", "z"]);
    let sum = g.add(y, z);
    let factored = g.mul(x, sum);
    let (xy, xz) = (g.mul(x, y), g.mul(x, z));
    let expanded = g.add(xy, xz);
    let (a, b) = (g.cos(factored), g.cos(expanded));
    let defect = g.sub(a, b);
    assert_eq!(g.zero_test(defect), Verdict::Zero);
}

#[test]
fn hyperbolic_functions_and_exponentials() {
    let mut g = Graph::new();
    let [x] = symbols(&mut g, ["x"]);
    let (c, s) = (g.apply(Function::Cosh, x), g.apply(Function::Sinh, x));
    let (cc, ss) = (g.square(c), g.square(s));
    let one = g.one();
    let defect = g.linear_combination(&[(Rational::ONE, cc), (-Rational::ONE, ss), (-Rational::ONE, one)]);
    assert_eq!(g.zero_test(defect), Verdict::Zero);
    let e = g.apply(Function::Exp, x);
    let sum = g.add(c, s);
    let defect = g.sub(e, sum);
    assert_eq!(g.zero_test(defect), Verdict::Zero);
}

#[test]
fn roots_keep_their_sign() {
    let mut g = Graph::new();
    let [x, y] = symbols(&mut g, ["x", "y"]);
    let squared = g.square(x);
    let root = g.sqrt(squared);
    let defect = g.sub(root, x);
    assert!(!g.zero_test(defect).is_zero());
    let yy = g.square(y);
    let sum = g.add(squared, yy);
    let r = g.sqrt(sum);
    let rr = g.div(sum, r);
    let defect = g.sub(rr, r);
    assert_eq!(g.zero_test(defect), Verdict::Zero);
    let (two, three, six) = (g.number(2), g.number(3), g.number(6));
    let (r2, r3, r6) = (g.sqrt(two), g.sqrt(three), g.sqrt(six));
    let product = g.mul(r2, r3);
    let defect = g.sub(product, r6);
    assert_eq!(g.zero_test(defect), Verdict::Zero);
}

#[test]
fn what_cannot_be_decided_is_unknown() {
    let mut g = Graph::new();
    let [x, y] = symbols(&mut g, ["x", "y"]);
    let product = g.mul(x, y);
    let (lx, ly, lxy) = (g.apply(Function::Ln, x), g.apply(Function::Ln, y), g.apply(Function::Ln, product));
    let lx = g.add(lx, ly);
    let (square, other) = (g.square(lx), g.square(lxy));
    let defect = g.sub(square, other);
    assert_eq!(g.zero_test(defect), Verdict::Zero);
    // x² − y² is not written as a product
    let squares = g.formula(x.square() - y.square());
    let (sum, difference) = (g.add(x, y), g.sub(x, y));
    let [sum, difference, squares] = [sum, difference, squares].map(|e| g.apply(Function::Ln, e));
    let defect = g.formula((sum + difference).square() - squares.square());
    assert!(matches!(g.zero_test(defect), Verdict::Unknown(_)));
    let zero = g.zero();
    let poison = g.div(x, zero);
    assert!(matches!(g.zero_test(poison), Verdict::Unknown(_)));
}

#[test]
fn a_near_miss_is_not_zero() {
    let mut g = Graph::new();
    let [x] = symbols(&mut g, ["x"]);
    let tiny = g.number(Rational::new(1, 1_000_000_000_000));
    let sum = g.add(x, tiny);
    let defect = g.sub(sum, x);
    assert!(g.zero_test(defect).is_nonzero());
}

/// A point of the field has values for nine roots with probability 2⁻⁹, and one of the reals hardly ever here.
#[test]
fn many_roots_at_once() {
    let mut g = Graph::new();
    let [level] = symbols(&mut g, ["level"]);
    let heights = symbols(&mut g, ["a", "b", "c", "d", "e", "f", "g", "h", "i"]);
    let roots = heights.map(|height| {
        let radicand = g.formula(height.square() - 3 * height * level - level.square());
        g.sqrt(radicand)
    });
    let sum = g.sum(&roots);
    let (squared, squares) = (g.square(sum), g.inner_product(&roots, &roots));
    let products: Vec<ExprId> =
        (0..9).flat_map(|i| (0..i).map(move |j| (i, j))).map(|(i, j)| g.mul(roots[i], roots[j])).collect();
    let products = g.sum(&products);
    let defect = g.formula(squared - squares - 2 * products);
    assert_eq!(g.zero_test(defect), Verdict::Zero);
    let identity = g.identity(9);
    let matrix: Vec<Vec<ExprId>> = identity
        .iter()
        .zip(&roots)
        .map(|(row, root)| row.iter().map(|entry| g.formula(entry * root + level)).collect())
        .collect();
    assert_eq!(g.generic_rank(&matrix), Ok(9));
}

/// Exponentials have no zeros, though their values are beyond the range of floating point at every point of order one.
#[test]
fn exponentials_beyond_floating_point_are_not_zero() {
    let mut g = Graph::new();
    let [x, y] = symbols(&mut g, ["x", "y"]);
    for by in [900, 3000, 1_000_000] {
        let exponent = g.formula(x.square() + by);
        let opposite = g.neg(exponent);
        for argument in [exponent, opposite] {
            let exponential = g.apply(Function::Exp, argument);
            let product = g.formula((x - y) * exponential);
            assert!(g.zero_test(exponential).is_nonzero(), "{}", g.text(exponential));
            assert!(g.zero_test(product).is_nonzero(), "{}", g.text(product));
        }
    }
    // two of them that no factor has in common
    let arguments = [x, y].map(|z| g.formula(-z.square() - 900));
    let [one, other] = arguments.map(|argument| g.apply(Function::Exp, argument));
    let difference = g.formula(one - 2 * other);
    assert!(g.zero_test(difference).is_nonzero());
}
