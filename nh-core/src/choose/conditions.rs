//! A form adds no condition: whatever it divides by is proved not to vanish where the declared equations are
//! regular. Speed must not make a parameter, the inertia of a wheel, say, something that may not be zero.
//!
//! A divisor is admitted that the facts keep from zero; that the declaration divides by itself, or the solution
//! of its constraints; that is a pivot of the mass matrix C on D where that is definite, or the determinant of a
//! block of it where it is regular; and any whose zeros are zeros of these. The last is asked in one symbol after
//! the other: the numerator of a divisor, found from its values, has no factor but theirs. What is left is admitted where C is definite if it has one sign at all samples
//! of parameters and configurations for which C is, a parameter 0 among them in turn: as evidence goes, that is
//! what C itself is called definite by.

use super::proof::{Defect, FIRST_SEED, run};
use super::reference::{Instant, Reference};
use super::zero_set::{Polynomial, numerator, place, values_for};
use crate::algebra::{Facts, FieldPoint, Graph, Node, Residue, Substitution, determinant_in_field};
use crate::id::{ExprId, SymbolId};
use crate::mechanics::{Definiteness, Definition, Procedure, ReducedEquations, keeps_its_sign, uncoupled};
use rustc_hash::FxHashMap;
use std::collections::BTreeSet;

/// Where the declared equations are regular.
pub(crate) struct Regular<'r> {
    pub(crate) reference: &'r Reference,
    /// The equations that are proved, of which the mass matrix is asked.
    pub(crate) equations: &'r ReducedEquations,
    pub(crate) definiteness: Definiteness,
    pub(crate) parameters: &'r [SymbolId],
    pub(crate) facts: &'r Facts,
}

/// Values at one point.
struct Sample {
    divisors: Vec<Residue>,
    /// C.
    mass: Vec<Vec<Residue>>,
    /// What may not vanish anyway.
    declared: Vec<Residue>,
}

/// Values of all divisors that are asked for, along lines of one symbol.
struct Lines {
    asked: Vec<ExprId>,
    /// What may not vanish anyway.
    declared: Vec<ExprId>,
    known: FxHashMap<(Varied, usize), Option<Vec<Sample>>>,
}

/// Blocks of the mass matrix with so many unknowns have all their principal minors looked at.
const SMALL_BLOCK: usize = 4;
/// Degrees of numerators in one symbol that are looked for, in turn.
const DEGREES: [usize; 3] = [2, 6, 14];
/// Divisors written out with more operations are not asked for their range.
const SHORT: u64 = 200;
/// Points, in all but one symbol, tried where one has no value.
const SEEDS: u64 = 48;
/// Points tried where one has no value.
const PATIENCE: u64 = 4096;

impl Regular<'_> {
    /// What a procedure divides by that may vanish where the declared equations are regular.
    pub(crate) fn added(&self, graph: &mut Graph, procedure: &Procedure) -> Option<ExprId> {
        // 1. divisors of the declaration, and those that the facts keep from zero
        let roots = self.reference.roots(graph);
        let declared = graph.singularities(&roots);
        let divisors: Vec<ExprId> = graph.divisors(&procedure.expressions()).into_iter().collect();
        let mut written = written_out(graph, procedure, divisors.is_empty());
        let mut left: Vec<ExprId> = Vec::new();
        for divisor in &divisors {
            let whole = written.apply(graph, *divisor);
            let is_known = declared.contains(divisor) || declared.contains(&whole);
            if !is_known && !graph.vanishes_nowhere(whole, self.facts) {
                left.push(*divisor);
            }
        }
        if left.is_empty() {
            return None;
        }
        // 2. pivots, at two points
        let declared: Vec<ExprId> = declared.into_iter().collect();
        let recognised = self.recognised(graph, procedure, &declared, &divisors);
        left.retain(|divisor| !recognised.contains(divisor));
        // 3. zeros in one symbol after the other
        let mut lines = Lines { asked: left.clone(), declared, known: FxHashMap::default() };
        left.retain(|divisor| !self.vanishes_with_others(graph, procedure, &mut lines, *divisor));
        // 4. signs, where C is definite
        left.into_iter().find(|divisor| {
            let whole = written.apply(graph, *divisor);
            self.definiteness == Definiteness::Unknown
                || !keeps_its_sign(graph, &self.equations.mass, whole, self.parameters, self.facts)
        })
    }

    /// The data at a point where everything has a value, with the values of divisors and of what may not vanish.
    fn sampled(
        &self,
        graph: &Graph,
        procedure: &Procedure,
        (divisors, declared): (&[ExprId], &[ExprId]),
        point: FieldPoint,
        division: i64,
    ) -> Result<Sample, Defect> {
        let mut instant: Instant = self.reference.at(graph, point, division)?;
        run(&mut instant.pass, &procedure.with_outputs(Vec::new()))?;
        let divisors = instant.pass.evaluate(divisors)?;
        let declared = instant.pass.evaluate(declared)?;
        run(&mut instant.pass, &self.equations.definitions)?;
        let rows = self.equations.mass.iter().map(|row| Ok(instant.pass.evaluate(row)?));
        Ok(Sample { divisors, mass: rows.collect::<Result<_, Defect>>()?, declared })
    }

    fn division(&self, graph: &Graph, procedure: &Procedure) -> i64 {
        let Self { reference, equations, .. } = self;
        let mass: Vec<ExprId> = equations.mass.concat();
        let own = equations.definitions.expressions();
        graph.angle_division(&[reference.roots(graph), procedure.expressions(), mass, own].concat())
    }

    /// The divisors that are pivots, or multiples by numbers of what may not vanish.
    fn recognised(
        &self,
        graph: &Graph,
        procedure: &Procedure,
        declared: &[ExprId],
        divisors: &[ExprId],
    ) -> BTreeSet<ExprId> {
        let division = self.division(graph, procedure);
        let blocks = uncoupled(graph, &self.equations.mass);
        let mut samples = Vec::new();
        for seed in FIRST_SEED..FIRST_SEED + PATIENCE {
            let point = FieldPoint::random(seed);
            if let Ok(sample) = self.sampled(graph, procedure, (divisors, declared), point, division) {
                samples.push(sample);
            }
            if samples.len() == 2 {
                break;
            }
        }
        let [first, second] = samples.as_slice() else { return BTreeSet::new() };
        let minors = [first, second].map(|sample| self.minors(&blocks, &sample.mass, &sample.declared));
        let is_multiple = |a: [Residue; 2], b: [Residue; 2]| {
            let ratios = [a[0] * b[1], a[1] * b[0]];
            let ratio = b[0].inverse().map(|inverse| a[0] * inverse);
            ratios[0] == ratios[1] && ratio.is_some_and(|ratio| ratio.recognised().is_some())
        };
        let mut recognised: BTreeSet<ExprId> = BTreeSet::new();
        let mut pivots = [first, second].map(|sample| sample.mass.clone());
        let mut open: Vec<usize> = (0..pivots[0].len()).collect();
        for (k, divisor) in divisors.iter().enumerate() {
            let value = [first.divisors[k], second.divisors[k]];
            let known = minors[0].iter().zip(&minors[1]).any(|(a, b)| is_multiple(value, [*a, *b]));
            // the pivots of elimination, in whatever order
            let pivot = open.iter().position(|i| is_multiple(value, [pivots[0][*i][*i], pivots[1][*i][*i]]));
            if let (Some(position), Definiteness::Definite) = (pivot, self.definiteness) {
                let index = open.remove(position);
                for matrix in &mut pivots {
                    eliminate(matrix, index, &open);
                }
                recognised.insert(*divisor);
            } else if known {
                recognised.insert(*divisor);
            }
        }
        recognised
    }

    /// What may not vanish, and quotients of it: principal minors where C is definite, determinants of blocks.
    fn minors(&self, blocks: &[Vec<usize>], mass: &[Vec<Residue>], declared: &[Residue]) -> Vec<Residue> {
        let mut found = declared.to_vec();
        for block in blocks {
            let is_small = block.len() <= SMALL_BLOCK && self.definiteness == Definiteness::Definite;
            let subsets: Vec<Vec<usize>> = if is_small {
                let pick = |mask: usize| {
                    let members = block.iter().enumerate().filter(|(k, _)| mask >> k & 1 == 1);
                    members.map(|(_, index)| *index).collect()
                };
                (1..1 << block.len()).map(pick).collect()
            } else {
                vec![block.clone()]
            };
            for subset in subsets {
                let rows = subset.iter().map(|i| subset.iter().map(|j| mass[*i][*j]).collect());
                found.push(determinant_in_field(rows.collect()));
            }
        }
        found
    }

    /// Whether a divisor vanishes only where something does that may not.
    fn vanishes_with_others(
        &self,
        graph: &Graph,
        procedure: &Procedure,
        lines: &mut Lines,
        divisor: ExprId,
    ) -> bool {
        let mut symbols = procedure.depends_on(graph, &[divisor]);
        procedure.definitions.iter().for_each(|definition| match definition {
            Definition::Value { symbol, .. } | Definition::Call { symbol, .. } => _ = symbols.remove(symbol),
            Definition::Solve { unknowns, .. } => symbols.retain(|symbol| !unknowns.contains(symbol)),
        });
        let angles = angles(graph, &procedure.expressions());
        let of_symbol = |symbol: &SymbolId| {
            let angle = angles.contains(symbol).then_some(Varied::Angle(*symbol));
            [Some(Varied::Value(*symbol)), angle].into_iter().flatten()
        };
        let mut is_known =
            |varied| self.factors_are_known(graph, procedure, (lines, &angles), divisor, varied);
        symbols.iter().flat_map(of_symbol).all(&mut is_known)
    }

    fn factors_are_known(
        &self,
        graph: &Graph,
        procedure: &Procedure,
        (lines, angles): (&mut Lines, &[SymbolId]),
        divisor: ExprId,
        varied: Varied,
    ) -> bool {
        let division = self.division(graph, procedure);
        let blocks = uncoupled(graph, &self.equations.mass);
        for degree in DEGREES {
            let Lines { asked, declared, known } = &mut *lines;
            let Some(position) = asked.iter().position(|asked| *asked == divisor) else { return false };
            // where there are roots, at some places all of them may be in the field
            let sampled = || {
                (0..SEEDS).find_map(|seed| {
                    let places = (0..values_for(degree)).map(place);
                    let sample = |t| {
                        let point = varied.point(angles, t, seed);
                        self.sampled(graph, procedure, (asked, declared), point, division).ok()
                    };
                    places.map(sample).collect::<Option<Vec<_>>>()
                })
            };
            let Some(samples) = known.entry((varied, degree)).or_insert_with(sampled) else { return false };
            let values: Vec<Residue> = samples.iter().map(|sample| sample.divisors[position]).collect();
            let others: Vec<Vec<Residue>> =
                samples.iter().map(|sample| self.minors(&blocks, &sample.mass, &sample.declared)).collect();
            let Some(mut left) = numerator(&values) else { continue };
            for k in 0..others[0].len() {
                if left.degree() == 0 {
                    return true;
                }
                let column: Vec<Residue> = others.iter().map(|row| row[k]).collect();
                if let Some(other) = numerator(&column) {
                    left = Polynomial::without(left, &other);
                }
            }

            if left.degree() == 0 {
                return true;
            }
        }

        false
    }
}

/// What puts the values of short intermediate results for their symbols.
fn written_out(graph: &mut Graph, procedure: &Procedure, is_vain: bool) -> Substitution {
    let mut written = Substitution::new([]);
    for definition in procedure.definitions.iter().filter(|_| !is_vain) {
        if let Definition::Value { symbol, value } = definition {
            let whole = written.apply(graph, *value);
            if graph.operation_count(&[whole]) <= SHORT {
                written.insert(*symbol, whole);
            }
        }
    }
    written
}

/// The Schur complement: what is left of a matrix for other unknowns when one is eliminated.
fn eliminate(matrix: &mut [Vec<Residue>], index: usize, others: &[usize]) {
    let Some(inverse) = matrix[index][index].inverse() else { return };
    for i in others {
        for j in others {
            let update = matrix[*i][index] * inverse * matrix[index][*j];
            matrix[*i][*j] = matrix[*i][*j] - update;
        }
    }
}

/// What a divisor is a function of, all else at rest.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Varied {
    Value(SymbolId),
    Angle(SymbolId),
}

impl Varied {
    /// A point where angles that are symbols have chosen places on the circle, the varied one at t.
    fn point(self, angles: &[SymbolId], t: Residue, seed: u64) -> FieldPoint {
        let mut point = FieldPoint::random(FIRST_SEED - 1 - seed);
        for (k, angle) in angles.iter().enumerate() {
            let word = Residue::mixed(1_777 + seed, k as u64);
            let u = if matches!(self, Self::Angle(symbol) if symbol == *angle) { t } else { word };
            if let Some(scale) = (Residue::ONE + u * u).inverse() {
                point.circle.insert(*angle, ((Residue::ONE - u * u) * scale, (u + u) * scale));
            }
        }
        if let Self::Value(symbol) = self {
            point.chosen.insert(symbol, t);
        }
        point
    }
}

/// The symbols in the arguments of functions.
fn angles(graph: &Graph, roots: &[ExprId]) -> Vec<SymbolId> {
    let arguments = graph.reachable(roots).into_iter().filter_map(|id| match graph.node(id) {
        Node::Apply(_, x) => Some(*x),
        _ => None,
    });
    graph.symbols_in(&arguments.collect::<Vec<_>>())
}
