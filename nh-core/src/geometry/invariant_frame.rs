//! A frame of sections that commute with the generators of a symmetry group (CM section 4), in which
//! nothing invariant depends on the coordinates along the group.
//!
//! Sections of the basis that commute with the generators ξ_a are kept. The rest is made of vertical
//! ones, A^a ξ_a with ξ_b(A^a) + C^a_{bc} A^c = 0, where [ξ_b, ξ_c] = C^a_{bc} ξ_a; the A^a are sought
//! as polynomials in the coordinates along the group, their sines and cosines, and their exponentials.

use super::algebroid::Algebroid;
use super::change_of_basis::ChangeOfBasis;
use super::manifold::Manifold;
use super::orbits::Factor;
use crate::algebra::{Derivation, Echelon, Function, Graph, Matrix, Node, Rational, Residue, Substitution};
use crate::id::{ExprId, SymbolId};

/// An invariant frame.
#[derive(Clone, Debug)]
pub struct InvariantFrame {
    /// To it from the basis.
    pub change: ChangeOfBasis,
    /// Whether each section is one of the basis: that of the same position.
    pub kept: Vec<bool>,
}

/// Products of more factors than this are not tried.
const DEGREE: usize = 3;
/// More coefficients than this are not sought.
const UNKNOWNS: usize = 400;

impl InvariantFrame {
    /// The frame that commutes with `generators`, which move no coordinates but those of `group`;
    /// `hints` are more functions whose sines and cosines tell angles from lengths.
    ///
    /// # Errors
    /// Why none was found.
    pub fn of(
        graph: &mut Graph,
        algebroid: &Algebroid,
        base: &Manifold,
        generators: &[Vec<ExprId>],
        group: &[SymbolId],
        hints: &[ExprId],
    ) -> Result<Self, String> {
        let rank = algebroid.rank();
        let identity = graph.identity(rank);
        // 1. sections of the basis that are invariant
        let mut frame: Vec<Option<Vec<ExprId>>> = Vec::new();
        for section in &identity {
            let is_invariant = commutes(graph, algebroid, base, generators, section);
            frame.push(is_invariant.then(|| section.clone()));
        }
        let kept: Vec<bool> = frame.iter().map(Option::is_some).collect();
        // 2. vertical ones in the place of the others
        if kept.contains(&false) {
            let generators = independent(graph, base, generators)?;
            let hints: Vec<ExprId> = hints.iter().chain(generators.iter().flatten()).copied().collect();
            let beside: Matrix = frame.iter().flatten().cloned().collect();
            let vertical = vertical(graph, algebroid, base, &generators, group, (&hints, &beside))?;
            for (index, section) in at_identity(graph, base, &vertical, group, &kept) {
                if frame[index].is_none() && commutes(graph, algebroid, base, &generators, &section) {
                    frame[index] = Some(section);
                }
            }
        }
        let sections: Matrix = frame.into_iter().flatten().collect();
        if sections.len() < rank {
            return Err("no invariant sections were found in the place of those that are not".into());
        }
        // 3. the change to it
        let columns = Graph::transposed(&sections);
        let sampled = base.restrict_matrix(graph, &columns);
        if graph.generic_rank(&sampled)? < rank {
            return Err("the invariant sections found are dependent".into());
        }
        let velocities = if is_orthogonal(graph, base, &sections) {
            sections
        } else {
            let inverse = graph
                .solve_linear(&columns, &identity)
                .ok_or("the invariant sections found are dependent")?;
            let rows = inverse.values.into_iter();
            rows.map(|row| row.into_iter().map(|entry| graph.simplify(entry)).collect()).collect()
        };
        Ok(Self { change: ChangeOfBasis { sections: columns, velocities }, kept })
    }
}

/// Whether the components of the sections are an orthogonal matrix.
fn is_orthogonal(graph: &mut Graph, base: &Manifold, sections: &Matrix) -> bool {
    sections.iter().enumerate().all(|(i, first)| {
        sections[i..].iter().enumerate().all(|(k, second)| {
            let product = graph.inner_product(first, second);
            let wanted = if k == 0 { graph.one() } else { graph.zero() };
            let defect = graph.formula(product - wanted);
            base.zero_test(graph, defect).is_zero()
        })
    })
}

/// Whether a section commutes with all generators.
fn commutes(
    graph: &mut Graph,
    algebroid: &Algebroid,
    base: &Manifold,
    generators: &[Vec<ExprId>],
    section: &[ExprId],
) -> bool {
    generators.iter().all(|generator| {
        let bracket = algebroid.bracket(graph, generator, section);
        bracket.into_iter().all(|component| base.zero_test(graph, component).is_zero())
    })
}

/// Generators that are independent at generic points, and span the same.
fn independent(graph: &mut Graph, base: &Manifold, generators: &[Vec<ExprId>]) -> Result<Matrix, String> {
    let independent = base.independent_rows(graph, generators)?;
    Ok(independent.into_iter().map(|index| generators[index].clone()).collect())
}

/// C^a_{bc} of the generators: entry `[b][c][a]`.
fn structure_constants(
    graph: &mut Graph,
    algebroid: &Algebroid,
    base: &Manifold,
    generators: &[Vec<ExprId>],
) -> Result<Vec<Vec<Vec<Residue>>>, String> {
    let r = generators.len();
    let mut columns: Matrix = generators.to_vec();
    for first in generators {
        for second in generators {
            columns.push(algebroid.bracket(graph, first, second));
        }
    }
    let rows = base.restrict_matrix(graph, &Graph::transposed(&columns));
    let mut found: Option<Vec<Vec<Residue>>> = None;
    for start in [25_000, 26_000] {
        let sampled = graph.matrix_at_random(&rows, start)?;
        let echelon = Echelon::of(sampled);
        let here: Vec<Vec<Residue>> = echelon.rows.iter().map(|row| row[r..].to_vec()).collect();
        let is_constant = found.as_ref().is_none_or(|known| *known == here);
        if echelon.pivots != (0..r).collect::<Vec<_>>() || !is_constant {
            return Err(
                "the brackets of the symmetries are no combinations of them with constant coefficients"
                    .into(),
            );
        }
        found = Some(here);
    }
    let rows = found.unwrap_or_default();
    let entry = |b: usize, c: usize| rows.iter().map(|row| row[b * r + c]).collect();
    Ok((0..r).map(|b| (0..r).map(|c| entry(b, c)).collect()).collect())
}

/// Invariant combinations A^a ξ_a that are a frame with those `beside` them; with functions whose sines and
/// cosines tell angles from lengths.
fn vertical(
    graph: &mut Graph,
    algebroid: &Algebroid,
    base: &Manifold,
    generators: &[Vec<ExprId>],
    group: &[SymbolId],
    (hints, beside): (&[ExprId], &Matrix),
) -> Result<Matrix, String> {
    let r = generators.len();
    let constants = structure_constants(graph, algebroid, base, generators)?;
    let factors = factors(graph, group, hints);
    for degree in 0..=DEGREE {
        let functions = products(graph, &factors, degree);
        if functions.len() * r > UNKNOWNS {
            break;
        }
        let coefficients = solutions(graph, algebroid, base, generators, &constants, &functions)?;
        let mut found = beside.clone();
        for solution in coefficients {
            let mut section = vec![graph.zero(); algebroid.rank()];
            for (generator, row) in generators.iter().zip(solution.chunks(functions.len())) {
                let terms: Vec<(Rational, ExprId)> =
                    row.iter().zip(&functions).map(|(c, f)| (c.clone(), *f)).collect();
                let factor = graph.linear_combination(&terms);
                for (component, along) in section.iter_mut().zip(generator) {
                    *component = graph.formula(*component + factor * along);
                }
            }
            found.push(section.into_iter().map(|component| graph.simplify(component)).collect());
        }
        let found = independent(graph, base, &found)?;
        if found.len() == algebroid.rank() {
            return Ok(found[beside.len()..].to_vec());
        }
    }
    Err("no invariant sections were found among polynomials in the coordinates along the group, their sines, \
         cosines and exponentials"
        .into())
}

/// For each coordinate its sines and cosines where such occur, of the multiples that occur, and the exponentials
/// of these and of their halves and opposites; else itself.
fn factors(graph: &mut Graph, group: &[SymbolId], hints: &[ExprId]) -> Vec<Vec<ExprId>> {
    let angles: Vec<ExprId> = graph
        .reachable(hints)
        .into_iter()
        .filter_map(|id| match graph.node(id) {
            Node::Apply(Function::Sin | Function::Cos, argument) => Some(*argument),
            _ => None,
        })
        .collect();
    let mut found = Vec::new();
    for symbol in group {
        let coordinate = graph.symbol(*symbol);
        let mut multiples: Vec<ExprId> = Vec::new();
        for angle in &angles {
            if graph.depends_on(*angle, &[*symbol]) {
                let factor = graph.partial(*angle, *symbol);
                multiples.push(match graph.value_of(factor).map(Rational::is_negative) {
                    Some(negative) => {
                        let multiple = graph.formula(factor * coordinate);
                        if negative { graph.formula(-multiple) } else { multiple }
                    }
                    None => coordinate,
                });
            }
        }
        multiples.sort_unstable();
        multiples.dedup();
        let mut choices = Vec::new();
        for angle in &multiples {
            choices.extend([graph.cos(*angle), graph.sin(*angle)]);
        }
        choices.extend(exponentials(graph, *symbol, hints));
        found.push(if choices.is_empty() { vec![coordinate] } else { choices });
    }
    found
}

/// e^{κx} for a coordinate x and each κ of which e^{κx} or e^{2κx} occurs, up to the sign: a metric has the
/// squares of the lengths.
fn exponentials(graph: &mut Graph, symbol: SymbolId, hints: &[ExprId]) -> Vec<ExprId> {
    let exponents: Vec<ExprId> = graph
        .reachable(hints)
        .into_iter()
        .filter_map(|id| match graph.node(id) {
            Node::Apply(Function::Exp, exponent) => Some(*exponent),
            _ => None,
        })
        .collect();
    let coordinate = graph.symbol(symbol);
    let mut found = Vec::new();
    for exponent in exponents {
        let rate = graph.partial(exponent, symbol);
        if graph.value_of(rate).is_none_or(Rational::is_zero) {
            continue;
        }
        for scale in [(1, 1), (-1, 1), (1, 2), (-1, 2)].map(|(n, d)| Rational::new(n, d)) {
            let multiple = graph.formula(rate * coordinate);
            let multiple = graph.scale(scale, multiple);
            found.push(graph.apply(Function::Exp, multiple));
        }
    }
    if !found.is_empty() {
        found.push(coordinate);
    }
    found.sort_unstable();
    found.dedup();
    found
}

/// Products of at most `degree` factors, at most one for each coordinate.
fn products(graph: &mut Graph, factors: &[Vec<ExprId>], degree: usize) -> Vec<ExprId> {
    let mut found = vec![(graph.one(), 0)];
    for choices in factors {
        for (product, count) in found.clone().into_iter().filter(|(_, count)| *count < degree) {
            for factor in choices {
                found.push((graph.formula(product * factor), count + 1));
            }
        }
    }
    found.into_iter().map(|(product, _)| product).collect()
}

/// The coefficients of all A^a = Σ_m A^a_m f_m with ξ_b(A^a) + C^a_{bc} A^c = 0, where they are
/// rational numbers.
fn solutions(
    graph: &mut Graph,
    algebroid: &Algebroid,
    base: &Manifold,
    generators: &[Vec<ExprId>],
    constants: &[Vec<Vec<Residue>>],
    functions: &[ExprId],
) -> Result<Vec<Vec<Rational>>, String> {
    let (r, m) = (generators.len(), functions.len());
    // a row for f_m, then one for each ξ_b(f_m)
    let mut table: Matrix = vec![functions.to_vec()];
    for generator in generators {
        let field = algebroid.anchor.vector_field(graph, generator);
        let mut along = Derivation::new(algebroid.anchor.coordinates.iter().copied().zip(field));
        table.push(along.apply_all(graph, functions));
    }
    let table = base.restrict_matrix(graph, &table);
    let mut equations: Vec<Vec<Residue>> = Vec::new();
    for point in 0..(m as u64 + 3) {
        let values = graph.matrix_at_random(&table, 30_000 + 97 * point)?;
        for (b, slopes) in values[1..].iter().enumerate() {
            for a in 0..r {
                let mut row = vec![Residue::ZERO; r * m];
                for k in 0..m {
                    row[a * m + k] = row[a * m + k] + slopes[k];
                    for c in 0..r {
                        row[c * m + k] = row[c * m + k] + constants[b][c][a] * values[0][k];
                    }
                }
                equations.push(row);
            }
        }
    }
    let recognised = |vector: Vec<Residue>| vector.into_iter().map(Residue::recognised).collect();
    Ok(Echelon::of(equations).kernel(r * m).filter_map(recognised).collect())
}

/// The combinations that are sections of the basis where the coordinates along the group vanish, each
/// with its position, those in the place of sections that are not kept first; as they are, where the
/// coordinates are none there. On an embedded group the parameters of its chart vanish.
fn at_identity(
    graph: &mut Graph,
    base: &Manifold,
    vertical: &Matrix,
    group: &[SymbolId],
    kept: &[bool],
) -> Vec<(usize, Vec<ExprId>)> {
    let of = |wanted: bool| (0..kept.len()).filter(move |index| kept[*index] == wanted);
    let order: Vec<usize> = of(false).chain(of(true)).collect();
    let (r, zero) = (vertical.len(), graph.zero());
    let free = || Factor { embedding: Vec::new(), parameters: group.to_vec() };
    let factor = base.factor(graph, group).unwrap_or_else(free);
    let mut embedding = Substitution::new(factor.embedding);
    let mut identity = Substitution::new(factor.parameters.into_iter().map(|symbol| (symbol, zero)));
    let mut rows = Matrix::new();
    for (k, section) in vertical.iter().enumerate() {
        let here: Vec<ExprId> = section
            .iter()
            .map(|component| {
                let component = embedding.apply(graph, *component);
                identity.apply(graph, component)
            })
            .collect();
        let combined = graph.unit_vector(r, k);
        rows.push(order.iter().map(|index| here[*index]).chain(combined).collect());
    }
    let Ok(sampled) = graph.matrix_at_random(&rows, 27_000) else {
        return beside_kept(graph, vertical, kept);
    };
    let echelon = Echelon::of(sampled);
    let mut found = Vec::new();
    for (row, pivot) in echelon.rows.iter().zip(&echelon.pivots) {
        let weights: Option<Vec<Rational>> =
            row[kept.len()..].iter().map(|weight| weight.recognised()).collect();
        let (Some(position), Some(weights)) = (order.get(*pivot), weights) else {
            return beside_kept(graph, vertical, kept);
        };
        let mut section = Vec::new();
        for index in 0..kept.len() {
            let terms: Vec<(Rational, ExprId)> =
                weights.iter().zip(vertical).map(|(weight, row)| (weight.clone(), row[index])).collect();
            let component = graph.linear_combination(&terms);
            section.push(graph.simplify(component));
        }
        found.push((*position, section));
    }
    found
}

/// Sections that are independent of those that are kept, in the place of the others.
fn beside_kept(graph: &mut Graph, vertical: &Matrix, kept: &[bool]) -> Vec<(usize, Vec<ExprId>)> {
    let units = graph.identity(kept.len()).into_iter().zip(kept);
    let mut chosen: Matrix = units.filter(|(_, kept)| **kept).map(|(unit, _)| unit).collect();
    let mut open = (0..kept.len()).filter(|index| !kept[*index]);
    let mut found = Vec::new();
    for section in vertical {
        chosen.push(section.clone());
        if graph.generic_rank(&chosen) == Ok(chosen.len()) {
            found.extend(open.next().map(|index| (index, section.clone())));
        } else {
            chosen.pop();
        }
    }
    found
}
