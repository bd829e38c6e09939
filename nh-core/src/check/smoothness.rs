//! What is differentiated is smooth: it has no branches that meet with an edge, open or in disguise.

use super::evidence::shown;
use super::steps::{Order, order_at_zeros};
use crate::algebra::{Facts, Function, Function2, Graph, Node, Rational};
use crate::id::{ExprId, Origin, SymbolId};
use crate::model::Model;
use crate::violation::{Law, Violation};

/// An expression with `abs`, `sign`, `min` or `max`, or with a root of a square that changes sign.
pub(crate) fn not_smooth(
    model: &mut Model,
    facts: &Facts,
    what: &str,
    value: ExprId,
    origin: Origin,
) -> Option<Violation> {
    let edge = Edge::of(model, facts, value, Wanted::Smooth)?;
    Some(edge.violation(what, "smooth", origin))
}

/// An expression that jumps and is constant on both sides, or changes sign there: an integral or a density that is none
/// for a motion that comes by.
pub(super) fn not_continuous(
    model: &mut Model,
    facts: &Facts,
    what: &str,
    value: ExprId,
    origin: Origin,
) -> Option<Violation> {
    let edge = Edge::of(model, facts, value, Wanted::Continuous)?;
    Some(edge.violation(what, "continuous", origin))
}

/// What is asked of an expression.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Wanted {
    Smooth,
    Continuous,
}

const SMOOTH: &str = "use a smooth expression, such as sqrt(x^2 + eps^2) for abs(x); `abs`, `sign`, `min` and \
                      `max` are at home in `forces` and `outputs`";

/// Why an expression has an edge.
struct Edge {
    uses: String,
    evidence: String,
    way_out: String,
}

impl Edge {
    fn violation(self, what: &str, wanted: &str, origin: Origin) -> Violation {
        let Self { uses, evidence, way_out } = self;
        let what = format!("this {what} is not {wanted}: it uses {uses}");
        Violation { law: Law::Smooth, origin, what, evidence, way_out }
    }

    fn of(model: &mut Model, facts: &Facts, value: ExprId, wanted: Wanted) -> Option<Self> {
        let parameters: Vec<SymbolId> = model.parameters.iter().map(|parameter| parameter.symbol).collect();
        let graph = &mut model.graph;
        let named = graph.reachable(&[value]).into_iter().find_map(|id| match graph.node(id) {
            Node::Apply(function @ (Function::Abs | Function::Sign), _) => Some(function.name()),
            Node::Apply2(function @ (Function2::Min | Function2::Max), ..) => Some(function.name()),
            _ => None,
        });
        let Some(name) = named else { return Self::in_disguise(graph, value, wanted, &parameters, facts) };
        Some(Self {
            uses: format!("`{name}`"),
            evidence: format!(
                "`{name}` has no derivative where its branches meet, and the equations need one"
            ),
            way_out: SMOOTH.into(),
        })
    }

    /// That of a root of a square, or of an arc that touches its ends.
    fn in_disguise(
        graph: &mut Graph,
        value: ExprId,
        wanted: Wanted,
        parameters: &[SymbolId],
        facts: &Facts,
    ) -> Option<Self> {
        for id in graph.reachable(&[value]) {
            match graph.node(id).clone() {
                Node::Product { factors, .. } => {
                    for (base, exponent) in factors.iter().filter(|(_, exponent)| !exponent.is_integer()) {
                        let step = Self::of_quotient(graph, (id, *base), exponent, wanted, parameters, facts);
                        if step.is_some() {
                            return step;
                        }
                        if wanted == Wanted::Smooth
                            && let Some(edge) = Self::of_root(graph, *base, exponent, parameters, facts)
                        {
                            return Some(edge);
                        }
                    }
                }
                Node::Apply(function @ (Function::Asin | Function::Acos), x) if wanted == Wanted::Smooth => {
                    let (one, square) = (graph.one(), graph.square(x));
                    let rest = graph.formula(one - square);
                    let squared = squared(graph, rest, parameters, facts).map(|(inner, _)| inner);
                    if let Some(inner) = squared.or_else(|| graph.double_zero(rest, parameters)) {
                        return Some(Self {
                            uses: format!("`{}`", shown(graph, id)),
                            evidence: format!(
                                "`{}` has an edge where its argument touches -1 or 1, at {} = 0",
                                function.name(),
                                shown(graph, inner)
                            ),
                            way_out: SMOOTH.into(),
                        });
                    }
                }
                Node::Apply2(Function2::Atan2, y, x) if is_step(graph, [y, x], parameters, facts) => {
                    return Some(Self {
                        uses: format!("`{}`", shown(graph, id)),
                        evidence:
                            "its derivative is 0, and it jumps by half a turn where both arguments change \
                                   their sign"
                                .into(),
                        way_out: "write the angle that is meant, as a number".into(),
                    });
                }
                _ => {}
            }
        }
        None
    }

    /// That of a product in which a root of a square stands over what vanishes with it, or the other way round, as in
    /// x/sqrt(x^2), which is the sign of x.
    fn of_quotient(
        graph: &mut Graph,
        (product, base): (ExprId, ExprId),
        exponent: &Rational,
        wanted: Wanted,
        parameters: &[SymbolId],
        facts: &Facts,
    ) -> Option<Self> {
        // 1. what the root is a power of, and the rest of the product
        let root = graph.pow(base, exponent.clone());
        let rest = graph.formula(product / root);
        let varies = graph.symbols_in(&[rest]).iter().any(|symbol| !parameters.contains(symbol));
        if !varies {
            return None;
        }
        let (inner, power) = squared(graph, base, parameters, facts)
            .or_else(|| Some((graph.double_zero(base, parameters)?, Rational::from(2))))?;
        let power = power * exponent.clone();
        let is_even = power.is_integer() && !power.has_odd_numerator();
        if is_even {
            return None;
        }
        // 2. of which order the rest vanishes with it, or is infinite
        let size = power.abs();
        let rest = if power.is_negative() { rest } else { graph.formula(root / product) };
        let order = order_at_zeros(graph, rest, inner, &size, parameters)?;
        let inner = shown(graph, inner);
        let evidence = match (order, wanted) {
            (Order::Same, _) => {
                format!("it is the sign of {inner} up to a factor: it jumps where {inner} = 0")
            }
            (Order::Higher, Wanted::Smooth) if power.is_negative() => {
                format!("it is abs({inner}) up to a factor, or a power of that: not smooth where {inner} = 0")
            }
            _ => return None,
        };
        Some(Self {
            uses: format!("`{}`", shown(graph, product)),
            evidence,
            way_out: format!(
                "where {inner} is meant to keep its sign, write it without the root; otherwise use a smooth expression, \
                 such as x/sqrt(x^2 + eps^2) for the sign of x"
            ),
        })
    }

    /// That of a root of a square, or of something that touches 0 as a square does.
    fn of_root(
        graph: &mut Graph,
        base: ExprId,
        exponent: &Rational,
        parameters: &[SymbolId],
        facts: &Facts,
    ) -> Option<Self> {
        // x^(2k) to the power 1/2 is x^k for even k; 1/abs(x) is smooth wherever it is defined, as 1/x is
        let has_edge =
            |power: &Rational| !power.is_negative() && (!power.is_integer() || power.has_odd_numerator());
        if exponent.is_negative() {
            return None;
        }
        let whole = graph.pow(base, exponent.clone());
        let uses = format!("`{}`", shown(graph, whole));
        if let Some((inner, power)) = squared(graph, base, parameters, facts) {
            let power = power * exponent.clone();
            let signed = graph.pow(inner, power.clone());
            let (inner, signed) = (shown(graph, inner), shown(graph, signed));
            let as_power = power_text(&power);
            return has_edge(&power).then(|| Self {
                uses,
                evidence: format!(
                    "it is abs({inner}){as_power} up to a factor: not smooth where {inner} = 0"
                ),
                way_out: format!(
                    "where it is meant to keep its sign, write {signed} instead of the root; otherwise use \
                     a smooth expression, such as sqrt(x^2 + eps^2) for abs(x)"
                ),
            });
        }
        let power = exponent.clone() * Rational::from(2);
        let simple = graph.simplify(base);
        let touching = match graph.node(simple).clone() {
            Node::Product { factors, .. } => {
                let mut simple_ones =
                    factors.iter().filter(|(_, exponent)| exponent.is_one()).map(|(factor, _)| *factor);
                simple_ones.find_map(|factor| Some((factor, graph.double_zero(factor, parameters)?)))
            }
            _ => graph.double_zero(simple, parameters).map(|inner| (simple, inner)),
        };
        let (touching, inner) = touching.filter(|_| has_edge(&power))?;
        let place =
            if touching == inner { String::new() } else { format!(" at {} = 0", shown(graph, inner)) };
        let as_power = power_text(&power);
        Some(Self {
            uses,
            evidence: format!(
                "{} touches 0{place} without a change of sign: there the root has an edge, as abs(x){as_power} has \
                 at 0",
                shown(graph, touching)
            ),
            way_out: "write the function of which this is the square, such as sqrt(2)*sin(x/2) for sqrt(1 - cos(x)), \
                      if it is meant to keep its sign; otherwise use a smooth expression, such as sqrt(x^2 + eps^2) \
                      for abs(x)"
                .into(),
        })
    }
}

/// What stands behind a base to raise it to a power.
fn power_text(power: &Rational) -> String {
    if power.is_one() {
        String::new()
    } else if power.is_integer() {
        format!("^{power}")
    } else {
        format!("^({power})")
    }
}

/// Whether the point (x, y) moves on a line through the origin, to both sides of it.
fn is_step(graph: &mut Graph, [y, x]: [ExprId; 2], parameters: &[SymbolId], facts: &Facts) -> bool {
    let symbols = graph.symbols_in(&[y, x]);
    let turns = symbols.into_iter().any(|symbol| {
        let [dy, dx] = [y, x].map(|part| graph.partial(part, symbol));
        let turn = graph.formula(x * dy - y * dx);
        !graph.zero_test(turn).is_zero()
    });
    !turns && [y, x].into_iter().any(|part| changes_sign(graph, part, parameters, facts))
}

/// Something that changes sign, and the even power of it that the expression contains as a factor.
fn squared(
    graph: &mut Graph,
    base: ExprId,
    parameters: &[SymbolId],
    facts: &Facts,
) -> Option<(ExprId, Rational)> {
    let simple = graph.simplify(base);
    for form in [base, simple] {
        let Node::Product { factors, .. } = graph.node(form).clone() else { continue };
        let found = factors.iter().find(|(inner, power)| {
            let is_even = power.is_integer() && !power.has_odd_numerator();
            let varies = graph.symbols_in(&[*inner]).iter().any(|symbol| !parameters.contains(symbol));
            is_even && !power.is_negative() && varies && changes_sign(graph, *inner, parameters, facts)
        });
        if let Some((inner, power)) = found {
            return Some((*inner, power.clone()));
        }
    }
    let root = graph.square_factor(simple, parameters)?;
    changes_sign(graph, root, parameters, facts).then_some((root, Rational::from(2)))
}

/// Whether both signs were seen at some points, within the facts.
fn changes_sign(graph: &Graph, expression: ExprId, parameters: &[SymbolId], facts: &Facts) -> bool {
    let range = graph.range(expression, facts);
    !(range.low >= 0.0 || range.high <= 0.0) && graph.has_both_signs(expression, parameters)
}
