//! Solutions of one function for one unknown, and charts of spheres and rotations.

use crate::algebra::{Graph, Node, Rational, Verdict};
use crate::id::{ExprId, SymbolId};

/// The ways to solve a function for unknowns.
#[derive(Clone, Copy)]
pub(super) enum Ease {
    /// A sphere, by the stereographic projection.
    Sphere,
    /// By a division by a number.
    Number,
    /// By a division.
    Linear,
    /// By a root.
    Root,
}

/// A solution, and the coefficients of the powers of the unknown, the highest first: without any where that is a number.
pub(super) struct Solved {
    pub(super) image: ExprId,
    pub(super) coefficients: Vec<ExprId>,
    /// What a root of even order is taken of, and the solution with the other sign of that root.
    pub(super) other: Option<(ExprId, ExprId)>,
}

/// The root of the symbol, or of a sum in which it is a term with a number for its coefficient.
pub(super) fn difference(graph: &mut Graph, function: ExprId, symbol: SymbolId) -> Option<Solved> {
    let coefficients = Vec::new();
    if graph.as_symbol(function) == Some(symbol) {
        return Some(Solved { image: graph.zero(), coefficients, other: None });
    }
    let Node::Sum { terms, .. } = graph.node(function) else { return None };
    let is_term = |(term, _): &&(ExprId, Rational)| graph.as_symbol(*term) == Some(symbol);
    let (term, factor) = terms.iter().find(is_term).cloned()?;
    let by = -factor.recip()?;
    let rest = graph.linear_combination(&[(Rational::ONE, function), (-factor, term)]);
    (!graph.depends_on(rest, &[symbol])).then(|| Solved {
        image: graph.scale(by, rest),
        coefficients,
        other: None,
    })
}

/// The root of a function that is linear in the symbol.
pub(super) fn quotient(graph: &mut Graph, function: ExprId, symbol: SymbolId) -> Option<Solved> {
    let form = graph.linear_form(function, &[symbol]).ok()?;
    if !graph.zero_test(form.coefficients[0]).is_nonzero() {
        return None;
    }
    let image = graph.formula(-(form.rest / form.coefficients[0]));
    Some(Solved { image, coefficients: vec![form.coefficients[0], form.rest], other: None })
}

/// `a (x_1² + … + x_m² − r²)`, m ≥ 2 with rational r: the stereographic projection.
pub(super) fn sphere(
    graph: &mut Graph,
    function: ExprId,
    symbols: &[SymbolId],
) -> Option<Vec<(SymbolId, ExprId)>> {
    if symbols.len() < 2 {
        return None;
    }
    let scale = {
        let first = graph.partial(function, symbols[0]);
        let second = graph.partial(first, symbols[0]);
        graph.value_of(second)?.clone() * Rational::new(1, 2)
    };
    if scale.is_zero() {
        return None;
    }
    let squares: Vec<(Rational, ExprId)> = symbols
        .iter()
        .map(|symbol| {
            let x = graph.symbol(*symbol);
            (-scale.clone(), graph.square(x))
        })
        .chain([(Rational::ONE, function)])
        .collect();
    let rest = graph.linear_combination(&squares);
    let rest = graph.simplify(rest);
    let radius = (-graph.value_of(rest)?.clone() * scale.recip()?).sqrt()?;
    let (last, others) = symbols.split_last()?;
    let parameters: Vec<ExprId> = others
        .iter()
        .enumerate()
        .map(|(index, _)| {
            let symbol = graph.new_symbol(format!("sphere{index}"));
            graph.symbol(symbol)
        })
        .collect();
    let squares: Vec<ExprId> = parameters.iter().map(|u| graph.square(*u)).collect();
    let (sum, one) = (graph.sum(&squares), graph.one());
    let (above, below) = (graph.formula(one - sum), graph.formula(one + sum));
    let mut points = Vec::with_capacity(symbols.len());
    for (symbol, u) in others.iter().zip(&parameters) {
        let quotient = graph.formula(u / below);
        points.push((*symbol, graph.scale(radius.clone() * Rational::from(2), quotient)));
    }
    let quotient = graph.formula(above / below);
    points.push((*last, graph.scale(radius, quotient)));
    Some(points)
}

/// A root of a function that is quadratic in the symbol, or a power of it and a rest.
pub(super) fn root(graph: &mut Graph, function: ExprId, symbol: SymbolId) -> Option<Solved> {
    let first = graph.partial(function, symbol);
    let second = graph.partial(first, symbol);
    let third = graph.partial(second, symbol);
    if graph.zero_test(third) != Verdict::Zero {
        return pure_root(graph, function, first, symbol);
    }
    if !graph.zero_test(second).is_nonzero() {
        return None;
    }
    // a s² + b s + c
    let (b, c) = (graph.at_zero(first, &[symbol]), graph.at_zero(function, &[symbol]));
    let curvature = graph.at_zero(second, &[symbol]);
    if graph.is_undefined(b) || graph.is_undefined(c) || graph.is_undefined(curvature) {
        return None;
    }
    let (bb, ac) = (graph.square(b), graph.formula(curvature * c));
    let discriminant = graph.linear_combination(&[(1.into(), bb), ((-2).into(), ac)]);
    let radical = root_of_square(graph, discriminant).unwrap_or_else(|| graph.sqrt(discriminant));
    let minus_b = graph.formula(-b);
    let image = graph.formula((minus_b + radical) / curvature);
    let other = graph.formula((minus_b - radical) / curvature);
    Some(Solved { image, coefficients: vec![curvature, b, c], other: Some((discriminant, other)) })
}

/// A function of which this is the square as it is written: it is a root at all points, up to the sign, which a square
/// root tells apart where it passes through 0.
fn root_of_square(graph: &mut Graph, function: ExprId) -> Option<ExprId> {
    let simple = graph.simplify(function);
    let Node::Product { coefficient, factors } = graph.node(simple).clone() else { return None };
    let factor = coefficient.sqrt()?;
    let half = Rational::new(1, 2);
    let factors: Vec<(ExprId, Rational)> =
        factors.iter().map(|(base, exponent)| (*base, exponent.clone() * half.clone())).collect();
    if factors.iter().any(|(_, exponent)| !exponent.is_integer()) {
        return None;
    }
    let product = graph.product(&factors);
    Some(graph.scale(factor, product))
}

/// The root of `a s^n + c`: there `s φ' = n (φ − c)`.
fn pure_root(graph: &mut Graph, function: ExprId, slope: ExprId, symbol: SymbolId) -> Option<Solved> {
    let rest = graph.at_zero(function, &[symbol]);
    let s = graph.symbol(symbol);
    let power = graph.formula(function - rest);
    let fibre = graph.formula(s * slope);
    if !graph.has_value(fibre) {
        return None;
    }
    let degree = (3..=6).find(|n| {
        let defect = graph.linear_combination(&[(1.into(), fibre), (Rational::from(-n), power)]);
        graph.zero_test(defect) == Verdict::Zero
    })?;
    let monomial = graph.pow(s, Rational::from(degree));
    let coefficient = graph.formula(power / monomial);
    let coefficient = graph.simplify(coefficient);
    let radicand = graph.formula(-(rest / coefficient));
    let image = graph.pow(radicand, Rational::new(1, degree));
    let other = (degree % 2 == 0).then(|| (radicand, graph.formula(-image)));
    Some(Solved { image, coefficients: vec![coefficient, rest], other })
}

/// The entries, row by row, of the rotation with Cayley parameters (a, b, c).
pub(super) fn cayley(graph: &mut Graph) -> Vec<ExprId> {
    let [a, b, c] = ["a", "b", "c"].map(|name| {
        let symbol = graph.new_symbol(format!("cayley_{name}"));
        graph.symbol(symbol)
    });
    let one = graph.one();
    let [aa, bb, cc] = [a, b, c].map(|x| graph.square(x));
    let norm = graph.sum(&[one, aa, bb, cc]);
    let mut entry = |terms: &[(i64, ExprId)]| {
        let terms: Vec<(Rational, ExprId)> = terms.iter().map(|(k, e)| (Rational::from(*k), *e)).collect();
        let numerator = graph.linear_combination(&terms);
        graph.formula(numerator / norm)
    };
    let diagonal = |x, y, z| [(1, one), (1, x), (-1, y), (-1, z)];
    let mut rows =
        vec![entry(&diagonal(aa, bb, cc)), entry(&diagonal(bb, aa, cc)), entry(&diagonal(cc, aa, bb))];
    let mut off = |x, y, z, sign: i64| {
        let product = graph.formula(x * y);
        let terms = [(Rational::from(2), product), (Rational::from(2 * sign), z)];
        let numerator = graph.linear_combination(&terms);
        graph.formula(numerator / norm)
    };
    let (xy, xz, yz) = (off(a, b, c, -1), off(a, c, b, 1), off(b, c, a, -1));
    let (yx, zx, zy) = (off(a, b, c, 1), off(a, c, b, -1), off(b, c, a, 1));
    let zz = rows.remove(2);
    let yy = rows.remove(1);
    let xx = rows.remove(0);
    vec![xx, xy, xz, yx, yy, yz, zx, zy, zz]
}
