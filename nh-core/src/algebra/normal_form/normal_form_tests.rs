use crate::algebra::{Facts, Function, Graph, Node, Rational};
use crate::id::ExprId;

fn symbols<const N: usize>(g: &mut Graph, names: [&str; N]) -> [ExprId; N] {
    names.map(|name| {
        let symbol = g.new_symbol(name);
        g.symbol(symbol)
    })
}

fn simplified(g: &mut Graph, e: ExprId) -> String {
    let simple = g.simplify(e);
    let defect = g.sub(e, simple);
    assert!(g.zero_test(defect).is_zero(), "{} became {}", g.text(e), g.text(simple));
    assert!(g.operation_count(&[simple]) <= g.operation_count(&[e]));
    g.text(simple)
}

#[test]
fn squares_of_cosine_and_sine() {
    let mut g = Graph::new();
    let [m, theta] = symbols(&mut g, ["m", "theta"]);
    let (s, c) = (g.sin(theta), g.cos(theta));
    let (ss, cc) = (g.square(s), g.square(c));
    let (a, b) = (g.mul(m, ss), g.mul(m, cc));
    let sum = g.add(a, b);
    assert_eq!(simplified(&mut g, sum), "m");
    let defect = g.sub(sum, m);
    assert_eq!(simplified(&mut g, defect), "0");
}

#[test]
fn addition_theorems() {
    let mut g = Graph::new();
    let [theta, phi] = symbols(&mut g, ["theta", "phi"]);
    g.sin(phi);
    let (sum, difference) = (g.add(theta, phi), g.sub(theta, phi));
    let (a, b) = (g.sin(sum), g.cos(difference));
    let (c, d) = (g.cos(sum), g.sin(difference));
    let (ab, cd) = (g.mul(a, b), g.mul(c, d));
    let e = g.sub(ab, cd);
    assert_eq!(simplified(&mut g, e), "2*sin(phi)*cos(phi)");
}

#[test]
fn half_angles_are_related() {
    let mut g = Graph::new();
    let [b] = symbols(&mut g, ["b"]);
    let half = g.scale(Rational::new(1, 2), b);
    let (sb, sh, ch) = (g.sin(b), g.sin(half), g.cos(half));
    let product = g.mul(sh, ch);
    let defect = g.linear_combination(&[(Rational::ONE, sb), (Rational::from(-2), product)]);
    assert_eq!(simplified(&mut g, defect), "0");
}

#[test]
fn fractions_cancel() {
    let mut g = Graph::new();
    let [a, b] = symbols(&mut g, ["a", "b"]);
    let sum = g.add(a, b);
    let (x, y) = (g.div(a, sum), g.div(b, sum));
    let e = g.add(x, y);
    assert_eq!(simplified(&mut g, e), "1");
    let difference = g.sub(a, b);
    let product = {
        let (aa, bb) = (g.square(a), g.square(b));
        g.sub(aa, bb)
    };
    let quotient = g.div(product, sum);
    let e = g.sub(quotient, difference);
    assert_eq!(simplified(&mut g, e), "0");
    // 1/(a+b) + 1/(a−b) − 2a/(a²−b²)
    let one = g.one();
    let (p, q, r) = (g.div(one, sum), g.div(one, difference), g.div(a, product));
    let e = g.linear_combination(&[(Rational::ONE, p), (Rational::ONE, q), (Rational::from(-2), r)]);
    assert_eq!(simplified(&mut g, e), "0");
}

#[test]
fn a_numerator_may_divide_its_denominator() {
    let mut g = Graph::new();
    let [a, b] = symbols(&mut g, ["a", "b"]);
    let (aa, bb) = (g.square(a), g.square(b));
    let (below, above) = (g.sub(aa, bb), g.sub(a, b));
    let e = g.div(above, below);
    assert_eq!(simplified(&mut g, e), "1/(a + b)");
    let (s, c) = (g.sin(a), g.cos(a));
    let one = g.one();
    let (ss, below) = (g.square(s), g.add(one, c));
    let e = g.div(ss, below);
    assert_eq!(simplified(&mut g, e), "-cos(a) + 1");
}

#[test]
fn roots_of_sums() {
    let mut g = Graph::new();
    let [x, y] = symbols(&mut g, ["x", "y"]);
    let (xx, yy) = (g.square(x), g.square(y));
    let squares = g.add(xx, yy);
    let r = g.sqrt(squares);
    let (p, q) = (g.div(xx, r), g.div(yy, r));
    let e = g.linear_combination(&[(Rational::ONE, p), (Rational::ONE, q), (Rational::MINUS_ONE, r)]);
    assert_eq!(simplified(&mut g, e), "0");
    let root = g.sqrt(xx);
    assert_eq!(simplified(&mut g, root), "sqrt(x^2)");
}

#[test]
fn the_square_of_the_tangent() {
    let mut g = Graph::new();
    let [x] = symbols(&mut g, ["x"]);
    let tan = g.tan(x);
    let squared = g.square(tan);
    let one = g.one();
    let sum = g.add(squared, one);
    assert_eq!(simplified(&mut g, sum), "1/cos(x)^2");
}

#[test]
fn exponentials_and_hyperbolic_functions() {
    let mut g = Graph::new();
    let [x, y] = symbols(&mut g, ["x", "y"]);
    let sum = g.add(x, y);
    let negative = g.neg(x);
    let (a, b) = (g.apply(Function::Exp, sum), g.apply(Function::Exp, negative));
    let product = g.mul(a, b);
    let ey = g.apply(Function::Exp, y);
    let e = g.sub(product, ey);
    assert_eq!(simplified(&mut g, e), "0");
    let (c, s) = (g.apply(Function::Cosh, x), g.apply(Function::Sinh, x));
    let (cc, ss) = (g.square(c), g.square(s));
    let e = g.sub(cc, ss);
    assert_eq!(simplified(&mut g, e), "1");
}

#[test]
fn a_factored_form_is_not_multiplied_out() {
    let mut g = Graph::new();
    let [x, y, theta] = symbols(&mut g, ["x", "y", "theta"]);
    let (s, c) = (g.sin(theta), g.cos(theta));
    let (ss, cc) = (g.square(s), g.square(c));
    let unit = g.add(ss, cc);
    let sum = g.add(x, y);
    let power = g.pow(sum, Rational::from(5));
    let e = g.mul(unit, power);
    assert_eq!(simplified(&mut g, e), "(x + y)^5");
}

#[test]
fn equal_factors_are_collected() {
    let mut g = Graph::new();
    let [a, b, c, d, e] = symbols(&mut g, ["a", "b", "c", "d", "e"]);
    let mut summands = vec![e];
    for x in [a, b] {
        summands.extend([c, d].map(|y| g.mul(x, y)));
    }
    let sum = g.sum(&summands);
    assert_eq!(simplified(&mut g, sum), "e + (a + b)*(c + d)");
}

#[test]
fn what_is_shared_stays_shared() {
    let mut g = Graph::new();
    let [a, b, c, d] = symbols(&mut g, ["a", "b", "c", "d"]);
    let products = [g.mul(a, b), g.mul(a, c), g.mul(b, c)];
    let shared = g.sum(&products);
    let power = g.square(shared);
    let (first, second) = (g.mul(shared, d), g.add(power, d));
    let roots = [shared, first, second];
    let together = g.simplify_all(&roots);
    assert!(g.operation_count(&together) <= g.operation_count(&roots));
}

#[test]
fn many_large_expressions_take_bounded_time() {
    let mut g = Graph::new();
    let names: Vec<_> = (0..40).map(|i| g.new_symbol(format!("x{i}"))).collect();
    let mut layer: Vec<_> = names.into_iter().map(|symbol| g.symbol(symbol)).collect();
    for _ in 0..25 {
        let next = |i: usize| {
            let (a, b) = (layer[i], layer[(i + 7) % layer.len()]);
            let (s, c) = (g.sin(a), g.cos(b));
            let (x, y) = (g.mul(s, b), g.mul(c, a));
            g.sum(&[x, y, a])
        };
        layer = (0..layer.len()).map(next).collect();
    }
    let simple = g.simplify_all(&layer);
    assert!(g.operation_count(&simple) <= g.operation_count(&layer));
}

#[test]
fn a_sum_that_would_explode_is_left_alone() {
    let mut g = Graph::new();
    let names: Vec<_> = (0..12).map(|i| g.new_symbol(format!("x{i}"))).collect();
    let list: Vec<_> = names.into_iter().map(|symbol| g.symbol(symbol)).collect();
    let sum = g.sum(&list);
    let power = g.pow(sum, Rational::from(30));
    let one = g.one();
    let e = g.add(power, one);
    assert_eq!(g.normal_form(e), None);
    assert_eq!(g.simplify(e), e);
}

#[test]
fn a_deep_expression_is_survived() {
    let mut g = Graph::new();
    let [x] = symbols(&mut g, ["x"]);
    let mut e = x;
    for _ in 0..3000 {
        let sin = g.sin(e);
        let square = g.square(e);
        e = g.linear_combination(&[(Rational::ONE, sin), (Rational::ONE, square), (Rational::ONE, x)]);
    }
    g.simplify(e);
}

/// What shows that it is not negative goes on to show it under a root: multiplied out, rounding errors would make it
/// negative where it vanishes.
#[test]
fn radicands_stay_sums_of_squares() {
    let mut g = Graph::new();
    let [a, b, u, v, l] = ["a", "b", "u", "v", "l"].map(|name| {
        let symbol = g.new_symbol(name);
        g.symbol(symbol)
    });
    let ab = g.formula(a + b);
    let (sa, ca, sab, cab) = (g.sin(a), g.cos(a), g.sin(ab), g.cos(ab));
    let along = g.formula(u * ca + v * sa);
    let across = g.formula(v * ca - u * sa);
    let tip = [g.formula(-l * (sa * u + sab * (u + v))), g.formula(l * (ca * u + cab * (u + v)))];
    let slip = g.formula(across * across / (l * l));
    let of_tip = g.formula(tip[0] * tip[0] + tip[1] * tip[1]);
    let thin = g.formula((u - v) * (u + v) * (u - v) * l);
    for radicand in [slip, of_tip, thin] {
        for exponent in [Rational::new(1, 2), Rational::new(-1, 2), Rational::new(3, 2)] {
            let root = g.pow(radicand, exponent);
            let whole = g.formula(root * across * l - (u + v) * l);
            for form in [g.simplify(whole), g.normal_form(whole).expect("it is short")] {
                let roots: Vec<ExprId> = g.reachable(&[form]);
                let bases = roots.iter().filter_map(|id| match g.node(*id) {
                    Node::Product { factors, .. } => {
                        factors.iter().find(|(_, exponent)| !exponent.is_integer())
                    }
                    _ => None,
                });
                for (base, _) in bases {
                    let is_product = radicand == thin && matches!(g.node(*base), Node::Product { .. });
                    let is_shown = g.range(*base, &Facts::default()).is_not_negative();
                    assert!(is_product || is_shown, "{} in {}", g.text(*base), g.text(form));
                }
            }
        }
    }
    // the length of a turned vector is that of the vector
    let turned = g.formula(along * along + across * across);
    let root = g.sqrt(turned);
    assert_eq!(simplified(&mut g, root), "sqrt(v^2 + u^2)");
    // equal radicands are one
    let other = g
        .formula((l * l * u * u * ca * ca + l * l * v * v * sa * sa + 2 * l * l * u * v * sa * ca) / (l * l));
    let kept = g.formula(along * along);
    let [one, other] = [kept, other].map(|radicand| {
        let root = g.sqrt(radicand);
        g.normal_form(root).expect("it is short")
    });
    assert_eq!(one, other);
}
