//! Invariant volume: whether a density on the base is kept by the motion (M 2.5).
//!
//! A density μ is kept iff Γ(log μ) + div Γ = 0. For μ on the base this is linear in the velocities:
//! `ρ(y) log μ = −div Γ`, that is d^D log μ is minus the modular section, mathematics (19).

use crate::algebra::{
    Derivation, Echelon, FieldPoint, Function, Graph, Matrix, Node, NotLinear, Rational, Residue,
    Substitution, Verdict,
};
use crate::geometry::Manifold;
use crate::id::{ExprId, SymbolId};

/// `Π factor^exponent`; the exponents are numbers, or functions of parameters.
pub type Density = Vec<(ExprId, ExprId)>;

/// div Γ = Σ M_a v^a + M_0 on the constraint manifold, with the vector fields on the base that belong
/// to the v^a.
#[derive(Clone, Debug)]
pub struct ModularSection {
    /// M_a; M_0 last.
    pub components: Vec<ExprId>,
    /// ρ(B_a): a row for each v^a; ρ(y₀) + ∂_t last, the time component last.
    pub fields: Vec<Vec<ExprId>>,
    /// The v^a.
    pub velocities: Vec<SymbolId>,
}

/// What the search for a density needs.
#[derive(Debug)]
pub struct VolumeSetting<'a> {
    /// div Γ on the constraint manifold, as a function of (t, x, v).
    pub divergence: ExprId,
    /// The vector fields: see [`ModularSection::fields`].
    pub fields: Vec<Vec<ExprId>>,
    /// The coordinates x^i, and the time.
    pub base: Vec<SymbolId>,
    /// The velocities v^a.
    pub velocities: Vec<SymbolId>,
    /// Symbols that do not move.
    pub parameters: Vec<SymbolId>,
    /// Where the coordinates are: the embedded base, or a part of it that motions keep.
    pub manifold: &'a Manifold,
    /// Whether they are known to be in a part of that, of which no points were found.
    pub is_larger: bool,
    /// Where the factors of a density are looked for first.
    pub hints: Vec<ExprId>,
}

/// The verdict.
#[derive(Clone, Debug)]
pub enum Volume {
    /// A density on the base that is kept.
    Kept(Density),
    /// There is none: d^D f is minus this section for no function f on the base.
    None(ModularSection),
    /// The divergence is no linear function of the velocities, so no density on the base is kept.
    Nonlinear,
    /// No density was found in the class searched, and none was excluded.
    Unknown(ModularSection),
    /// Whether the divergence is linear in the velocities could not be decided, and why.
    Undecided(String),
}

/// Factors tried.
const CANDIDATES: usize = 40;
/// Points of the base at which exponents are looked for.
const POINTS: i64 = 4;
/// Vector fields whose brackets are taken in the proof that there is no density.
const FIELDS: usize = 12;

/// Decides.
pub fn invariant_volume(graph: &mut Graph, setting: &VolumeSetting<'_>) -> Volume {
    // 1. M
    let section = match modular_section(graph, setting) {
        Ok(section) => section,
        Err(verdict) => return verdict,
    };
    // 2. log μ = Σ q_k log P_k
    if let Some(density) = search(graph, setting, &section) {
        return Volume::Kept(density);
    }
    // 3. no μ at all
    let is_none = !setting.is_larger && is_excluded(graph, setting, &section);
    if is_none { Volume::None(section) } else { Volume::Unknown(section) }
}

fn modular_section(graph: &mut Graph, setting: &VolumeSetting<'_>) -> Result<ModularSection, Volume> {
    let form = graph.linear_form(setting.divergence, &setting.velocities).map_err(|error| match error {
        NotLinear::Curved(first, second) => {
            let slope = graph.partial(setting.divergence, first);
            let curvature = graph.partial(slope, second);
            match setting.manifold.zero_test(graph, curvature) {
                Verdict::NonZero(_) if !setting.is_larger => Volume::Nonlinear,
                _ => Volume::Undecided("it is not written as a linear function of the velocities".into()),
            }
        }
        NotLinear::Unknown(why) => Volume::Undecided(why),
    })?;
    // the derivative of a step is 0 on both of its sides
    let terms = form.coefficients.iter().zip(&setting.velocities);
    let terms: Vec<ExprId> = terms
        .map(|(coefficient, velocity)| {
            let velocity = graph.symbol(*velocity);
            graph.formula(coefficient * velocity)
        })
        .collect();
    let sum = graph.sum(&terms);
    let beyond = graph.formula(setting.divergence - sum - form.rest);
    match graph.zero_test(beyond) {
        Verdict::Zero => {}
        Verdict::NonZero(_) if !setting.is_larger => return Err(Volume::Nonlinear),
        _ => {
            return Err(Volume::Undecided("it is not written as a linear function of the velocities".into()));
        }
    }
    let mut components = form.coefficients;
    components.push(form.rest);
    let components = components.into_iter().map(|m| graph.simplify(m)).collect();
    Ok(ModularSection { components, fields: setting.fields.clone(), velocities: setting.velocities.clone() })
}

/// Functions of the base that may be factors of a density, the likely ones first.
fn candidates(graph: &Graph, setting: &VolumeSetting<'_>, section: &ModularSection) -> Vec<ExprId> {
    let mut found: Vec<ExprId> = Vec::new();
    let mut consider = |candidate: ExprId| {
        let symbols = graph.symbols_in(&[candidate]);
        let on_base = symbols.iter().any(|symbol| setting.base.contains(symbol))
            && !symbols.iter().any(|symbol| setting.velocities.contains(symbol));
        if on_base && found.len() < CANDIDATES && !found.contains(&candidate) {
            found.push(candidate);
        }
    };
    // factors of what is hinted at, then every factor of M, then what these are made of
    for hint in &setting.hints {
        graph.factors(*hint).into_iter().for_each(|(factor, _)| consider(factor));
    }
    let reachable = graph.reachable(&section.components);
    for id in reachable.iter().rev() {
        match graph.node(*id) {
            Node::Product { factors, .. } => factors.iter().for_each(|(base, _)| consider(*base)),
            Node::Symbol(_) | Node::Apply(..) => consider(*id),
            _ => {}
        }
    }
    let fields: Vec<ExprId> = section.fields.concat();
    for id in graph.reachable(&fields) {
        if matches!(graph.node(id), Node::Symbol(_) | Node::Apply(..)) {
            consider(id);
        }
    }
    found
}

/// ρ(B_a) f for each a.
fn differential(graph: &mut Graph, setting: &VolumeSetting<'_>, function: ExprId) -> Vec<ExprId> {
    let partials: Vec<ExprId> = setting.base.iter().map(|symbol| graph.partial(function, *symbol)).collect();
    graph.image(&setting.fields, &partials)
}

/// Solves Σ q_k d log P_k = −M for constant q, and proves the solution.
fn search(graph: &mut Graph, setting: &VolumeSetting<'_>, section: &ModularSection) -> Option<Density> {
    let manifold = setting.manifold;
    let right: Vec<ExprId> = section
        .components
        .iter()
        .map(|component| {
            let negative = graph.formula(-component);
            manifold.restrict(graph, negative)
        })
        .collect();
    if right.iter().all(|component| graph.zero_test(*component).is_zero()) {
        return Some(Vec::new());
    }
    let mut factors = candidates(graph, setting, section);
    for symbol in &setting.base {
        let coordinate = graph.symbol(*symbol);
        factors.push(graph.apply(Function::Exp, coordinate));
    }
    let mut columns = Vec::with_capacity(factors.len() + 1);
    for factor in &factors {
        let column: Vec<ExprId> = differential(graph, setting, *factor)
            .into_iter()
            .map(|change| {
                let change = graph.formula(change / factor);
                manifold.restrict(graph, change)
            })
            .collect();
        columns.push(column);
    }
    columns.push(right);
    let matrix = Graph::transposed(&columns);
    let with = |exponents: Vec<(usize, ExprId)>| -> Density {
        exponents.into_iter().map(|(index, exponent)| (factors[index], exponent)).collect()
    };
    let rational = rational_exponents(graph, &matrix).map(&with);
    let found = match rational.filter(|density| is_kept(graph, setting, section, density)) {
        Some(density) => density,
        None => with(parametric_exponents(graph, setting, &matrix)?),
    };
    is_kept(graph, setting, section, &found).then_some(found)
}

/// The solution of the linear equations, the last column their right side, in which points of the
/// field agree.
fn solved_at(
    graph: &Graph,
    matrix: &Matrix,
    point: impl Fn(u64, u64) -> FieldPoint,
) -> Option<Vec<(usize, Residue)>> {
    let unknowns = matrix.first()?.len() - 1;
    let mut rows: Vec<Vec<Residue>> = Vec::new();
    for sample in 0..(unknowns as u64 + 4) {
        rows.extend(graph.matrix_in_field(matrix, |seed| point(sample, seed)).ok()?);
    }
    let solution = Echelon::of(rows).solution(unknowns)?.into_iter().enumerate();
    Some(solution.filter(|(_, exponent)| *exponent != Residue::ZERO).collect())
}

/// Exponents that are the same for all parameters.
fn rational_exponents(graph: &mut Graph, matrix: &Matrix) -> Option<Vec<(usize, ExprId)>> {
    let solution = solved_at(graph, matrix, |sample, seed| FieldPoint::random(21_000 + 64 * sample + seed))?;
    solution.into_iter().map(|(index, value)| Some((index, graph.number(value.recognised()?)))).collect()
}

/// Exponents that depend on the parameters: which are needed is found at one value of these, and the
/// equations are solved for them at points of the base.
fn parametric_exponents(
    graph: &mut Graph,
    setting: &VolumeSetting<'_>,
    matrix: &Matrix,
) -> Option<Vec<(usize, ExprId)>> {
    let mut moving = graph.symbols_in(&matrix.concat());
    moving.retain(|symbol| !setting.parameters.contains(symbol));
    let point = |sample: u64, seed: u64| {
        let mut point = FieldPoint::random(22_000);
        for (number, symbol) in (0..).zip(&moving) {
            let value = Residue::mixed(64 * sample + seed + 1, number);
            point.chosen.insert(*symbol, value);
            if let Some(scale) = (Residue::ONE + value * value).inverse() {
                let cosine = (Residue::ONE - value * value) * scale;
                point.circle.insert(*symbol, (cosine, (value + value) * scale));
            }
        }
        point
    };
    let solution = solved_at(graph, matrix, point)?;
    let unknowns = matrix.first()?.len() - 1;
    let needed: Matrix = matrix
        .iter()
        .map(|row| solution.iter().map(|(index, _)| row[*index]).chain([row[unknowns]]).collect())
        .collect();
    let mut equations = Matrix::new();
    for shift in 0..POINTS {
        equations.extend(at_point(graph, &needed, &moving, shift));
    }
    let (left, right): (Matrix, Vec<ExprId>) =
        equations.into_iter().filter_map(|mut row| row.pop().map(|right| (row, right))).unzip();
    let exponents = graph.solve_overdetermined(&left, &right)?;
    Some(solution.iter().map(|(index, _)| *index).zip(exponents).collect())
}

/// The rows that have a value at a point of simple coordinates, there.
fn at_point(graph: &mut Graph, rows: &Matrix, moving: &[SymbolId], shift: i64) -> Matrix {
    let is_angle = |graph: &Graph, symbol: SymbolId| {
        graph.reachable(&rows.concat()).into_iter().any(|id| {
            matches!(graph.node(id), Node::Apply(Function::Sin | Function::Cos, x) if graph.depends_on(*x, &[symbol]))
        })
    };
    let images: Vec<(SymbolId, ExprId)> = (1..)
        .zip(moving)
        .map(|(number, symbol): (i64, _)| {
            let value = Rational::new((number * shift + shift) % 7, 1);
            let unit = if is_angle(graph, *symbol) { graph.pi() } else { graph.one() };
            let step = if graph.as_number(unit).is_some() { 1 } else { 2 };
            (*symbol, graph.scale(value * Rational::new(1, step), unit))
        })
        .collect();
    let mut there = Substitution::new(images);
    let rows: Matrix = rows.iter().map(|row| there.apply_all(graph, row)).collect();
    rows.into_iter().filter(|row| !row.iter().any(|entry| graph.is_undefined(*entry))).collect()
}

/// Whether ρ(B_a) log μ + M_a = 0 for every a.
fn is_kept(
    graph: &mut Graph,
    setting: &VolumeSetting<'_>,
    section: &ModularSection,
    density: &Density,
) -> bool {
    let mut sums: Vec<Vec<ExprId>> = section.components.iter().map(|m| vec![*m]).collect();
    for (factor, exponent) in density {
        for (sum, change) in sums.iter_mut().zip(differential(graph, setting, *factor)) {
            sum.push(graph.formula(exponent * (change / factor)));
        }
    }
    sums.into_iter().all(|sum| {
        let defect = graph.sum(&sum);
        setting.manifold.zero_test(graph, defect) == Verdict::Zero
    })
}

/// Whether the equations X_a f = −M_a contradict each other: X_a f is known for every vector field of
/// the list, so [X_a, X_b] f is, and at a point these fields may be dependent while what they are to
/// give is not.
fn is_excluded(graph: &mut Graph, setting: &VolumeSetting<'_>, section: &ModularSection) -> bool {
    let mut known: Vec<(Vec<ExprId>, ExprId)> =
        section.fields.iter().cloned().zip(section.components.iter().copied()).collect();
    let mut done = 0;
    loop {
        if contradicts(graph, setting, &known) {
            return true;
        }
        let end = known.len();
        if done == end || end >= FIELDS {
            return false;
        }
        for a in 0..end {
            for b in done.max(a + 1)..end {
                if known.len() < FIELDS {
                    let bracket = commutator(graph, setting, &known[a], &known[b]);
                    known.push(bracket);
                }
            }
        }
        done = end;
    }
}

fn commutator(
    graph: &mut Graph,
    setting: &VolumeSetting<'_>,
    first: &(Vec<ExprId>, ExprId),
    second: &(Vec<ExprId>, ExprId),
) -> (Vec<ExprId>, ExprId) {
    let along = |field: &[ExprId]| Derivation::new(setting.base.iter().copied().zip(field.iter().copied()));
    let (mut x, mut y) = (along(&first.0), along(&second.0));
    let mut difference = |graph: &mut Graph, of_second: ExprId, of_first: ExprId| {
        let (forth, back) = (x.apply(graph, of_second), y.apply(graph, of_first));
        graph.formula(forth - back)
    };
    let pairs: Vec<(ExprId, ExprId)> = second.0.iter().copied().zip(first.0.iter().copied()).collect();
    let field =
        pairs.into_iter().map(|(of_second, of_first)| difference(graph, of_second, of_first)).collect();
    let value = difference(graph, second.1, first.1);
    (field, value)
}

/// Whether the values are not a linear function of the fields at a random point.
fn contradicts(graph: &mut Graph, setting: &VolumeSetting<'_>, known: &[(Vec<ExprId>, ExprId)]) -> bool {
    let rows: Vec<Vec<ExprId>> =
        known.iter().map(|(field, value)| [field.as_slice(), &[*value]].concat()).collect();
    let rows = setting.manifold.restrict_matrix(graph, &rows);
    let last = setting.base.len();
    [23_000, 24_000].into_iter().all(|start| {
        graph.matrix_at_random(&rows, start).is_ok_and(|rows| Echelon::of(rows).pivots.contains(&last))
    })
}
