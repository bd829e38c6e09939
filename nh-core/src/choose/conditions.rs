//! A form adds no condition: whatever it divides by is proved not to vanish where the declared equations are
//! regular. Speed must not make a parameter, the inertia of a wheel, say, something that may not be zero.
//!
//! A divisor is admitted that the facts keep from zero; that the declaration divides by itself, or the solution
//! of its constraints; that is a pivot of the mass matrix C on D where that is definite, or the determinant of a
//! block of it where it is regular, or, where there are multipliers, a pivot of J W⁻¹ Jᵀ or the determinant of a saddle
//! matrix; and any whose zeros are zeros of these. The last is asked in one symbol after
//! the other: the numerator of a divisor, found from its values, has no factor but theirs. What is left is admitted where C is definite if it has one sign at all samples
//! of parameters and configurations for which C is, a parameter 0 among them in turn: as evidence goes, that is
//! what C itself is called definite by. Where there are multipliers, a mass matrix with a factor on its diagonal that vanishes at
//! places, as r² of polar coordinates, is not taken to be definite where it is divided by that factor: constraints may make
//! up for it.

use super::ground::Ground;
use super::pivots::{Pivots, is_multiple, is_pivot};
use super::proof::{Defect, FIRST_SEED, run};
use super::reference::{Instant, Reference, inner};
use super::zero_set::{Polynomial, numerator, place, values_for};
use crate::algebra::{
    Echelon, Facts, FieldPoint, Graph, Matrix, Node, Residue, Substitution, determinant_in_field,
};
use crate::id::{ExprId, SymbolId};
use crate::mechanics::{
    DefiniteSets, Definiteness, Definition, OtherAxes, Procedure, keeps_its_sign, uncoupled,
};
use rustc_hash::FxHashMap;
use std::collections::BTreeSet;
use varied::{Arguments, Varied};

#[cfg(test)]
mod multiplier_tests;
mod varied;

/// Where the declared equations are regular.
pub(crate) struct Regular<'r> {
    pub(crate) reference: &'r Reference,
    /// What the entries of the mass matrix are made of.
    pub(crate) definitions: &'r Procedure,
    /// The mass matrix that is factorised: C on D; W on E, or what weighed constraints make of it.
    pub(crate) mass: &'r Matrix,
    pub(crate) definiteness: Definiteness,
    /// J, where the solution has multipliers: the saddle matrix is regular.
    pub(crate) jacobian: &'r Matrix,
    /// Axes along which velocities are eliminated, beside their own.
    pub(crate) turned: &'r [OtherAxes],
    pub(crate) parameters: &'r [SymbolId],
    pub(crate) facts: &'r Facts,
}

/// Values at one point.
struct Sample {
    divisors: Vec<Residue>,
    mass: Vec<Vec<Residue>>,
    jacobian: Vec<Vec<Residue>>,
    /// The mass matrix along other axes.
    turned: Vec<Vec<Residue>>,
    /// What may not vanish anyway.
    declared: Vec<Residue>,
}

/// Values of all divisors that are asked for, along lines of one symbol.
struct Lines<'g> {
    asked: Vec<ExprId>,
    /// What may not vanish anyway.
    declared: Vec<ExprId>,
    arguments: Arguments,
    ground: &'g Ground,
    /// The unknowns that the mass matrix couples.
    blocks: Vec<Vec<usize>>,
    known: FxHashMap<Varied, Line>,
}

/// Values at the first places of a line.
#[derive(Default)]
struct Line {
    /// Which of the lines: those before it have places without a value.
    seed: u64,
    values: Values,
    /// The most values that a line before it has.
    most: Values,
}

/// At each place the values of the divisors, and those of what may not vanish.
type Values = Vec<(Vec<Residue>, Vec<Residue>)>;

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
        self.added_among(graph, procedure, |_, _| true).or_else(|| self.added_in_holes(graph, procedure))
    }

    /// The same where constraints make up for a mass matrix that is singular at places whatever the parameters are, as
    /// that of polar coordinates: definite in general, its pivots vanish there.
    fn added_in_holes(&self, graph: &mut Graph, procedure: &Procedure) -> Option<ExprId> {
        let holes = if self.jacobian.is_empty() { Vec::new() } else { self.holes(graph) };
        if holes.is_empty() || self.definiteness == Definiteness::Unknown {
            return None;
        }
        let unknown = Regular { definiteness: Definiteness::Unknown, ..*self };
        unknown.added_among(graph, procedure, |graph, divisor| {
            graph.factors(divisor).iter().any(|(factor, _)| holes.contains(factor))
        })
    }

    /// Factors of the diagonal of W that have no parameters, and may vanish.
    fn holes(&self, graph: &Graph) -> Vec<ExprId> {
        let diagonal = self.mass.iter().enumerate().map(|(k, row)| row[k]);
        // sums are inertias, nearly always: they are taken to be as definite as samples say
        let diagonal = diagonal.filter(|entry| !matches!(graph.node(*entry), Node::Sum { .. }));
        let factors = diagonal.flat_map(|entry| graph.factors(entry));
        let mut holes: Vec<ExprId> = factors.map(|(factor, _)| factor).collect();
        let is_parameter = |symbol: &SymbolId| self.parameters.contains(symbol);
        holes.retain(|factor| {
            // most are inertias
            if let Some(symbol) = graph.as_symbol(*factor) {
                return !is_parameter(&symbol);
            }
            let symbols = graph.symbols_in(&[*factor]);
            !symbols.is_empty()
                && !symbols.iter().any(is_parameter)
                && !graph.vanishes_nowhere(*factor, self.facts)
        });
        holes
    }

    fn added_among(
        &self,
        graph: &mut Graph,
        procedure: &Procedure,
        is_asked: impl Fn(&Graph, ExprId) -> bool,
    ) -> Option<ExprId> {
        // 1. divisors of the declaration, and those that the facts keep from zero
        let roots = self.reference.roots();
        let declared = graph.singularities(&roots);
        let divisors: Vec<ExprId> = graph.divisors(&procedure.expressions()).into_iter().collect();
        let mut written = written_out(graph, procedure, divisors.is_empty());
        let mut left: Vec<ExprId> = Vec::new();
        for divisor in &divisors {
            let whole = written.apply(graph, *divisor);
            let is_known = declared.contains(divisor) || declared.contains(&whole);
            if !is_known && is_asked(graph, whole) && !graph.vanishes_nowhere(whole, self.facts) {
                left.push(*divisor);
            }
        }
        if left.is_empty() {
            return None;
        }
        let grounds = {
            let division = self.division(graph, procedure);
            let expressions = [roots, procedure.expressions()].concat();
            let base = Ground::base(graph, &expressions, division);
            [Some(Ground::whole(division)), base]
        };
        let declared: Vec<ExprId> = declared.into_iter().collect();
        for ground in grounds.iter().flatten() {
            let known = (declared.as_slice(), divisors.as_slice());
            left = self.vanishing(graph, (procedure, ground), known, left);
        }
        // 4. signs, where C is definite
        let mut known = DefiniteSets::default();
        left.into_iter().find(|divisor| {
            let whole = written.apply(graph, *divisor);
            let matrix = (self.mass.as_slice(), &mut known);
            self.definiteness == Definiteness::Unknown
                || !keeps_its_sign(graph, matrix, whole, self.parameters, self.facts)
        })
    }

    /// The divisors of which nothing says that they vanish only where something does that may not.
    fn vanishing(
        &self,
        graph: &mut Graph,
        (procedure, ground): (&Procedure, &Ground),
        (declared, divisors): (&[ExprId], &[ExprId]),
        mut left: Vec<ExprId>,
    ) -> Vec<ExprId> {
        if left.is_empty() {
            return left;
        }
        // 2. pivots, at two points
        let recognised = self.recognised(graph, procedure, (declared, divisors), ground);
        left.retain(|divisor| !recognised.contains(divisor));
        if left.is_empty() {
            return left;
        }
        // 3. zeros in one symbol after the other
        let procedure = &procedure.as_far_as(graph, &left);
        let arguments = Arguments::of(graph, procedure, declared);
        let (asked, blocks) = (left.clone(), uncoupled(graph, self.mass));
        let declared = declared.to_vec();
        let mut lines = Lines { asked, declared, arguments, ground, blocks, known: FxHashMap::default() };
        left.retain(|divisor| !self.vanishes_with_others(graph, procedure, &mut lines, *divisor));
        left
    }

    /// The same of a function that is derived from a motion, which is judged by itself.
    pub(crate) fn added_beside(
        &self,
        graph: &mut Graph,
        procedure: &Procedure,
        motion: &Procedure,
    ) -> Option<ExprId> {
        let known: Vec<ExprId> = graph.divisors(&motion.expressions()).into_iter().collect();
        let own = graph.divisors(&procedure.expressions());
        if own.iter().all(|divisor| known.contains(divisor)) { None } else { self.added(graph, procedure) }
    }

    /// The data at a point where everything has a value, with the values of divisors and of what may not vanish.
    fn sampled(
        &self,
        graph: &Graph,
        procedure: &Procedure,
        (divisors, declared): (&[ExprId], &[ExprId]),
        (point, ground): (FieldPoint, &Ground),
    ) -> Result<Sample, Defect> {
        let point = ground.point(graph, point)?;
        let mut instant: Instant = self.reference.at(graph, point, ground.division())?;
        run(&mut instant.pass, &procedure.with_outputs(Vec::new()))?;
        let divisors = instant.pass.evaluate(divisors)?;
        let declared = instant.pass.evaluate(declared)?;
        run(&mut instant.pass, self.definitions)?;
        let rows = self.mass.iter().map(|row| Ok(instant.pass.evaluate(row)?));
        let mass = rows.collect::<Result<Vec<_>, Defect>>()?;
        let rows = self.jacobian.iter().map(|row| Ok(instant.pass.evaluate(row)?));
        let jacobian = rows.collect::<Result<Vec<_>, Defect>>()?;
        let mut turned = mass.clone();
        for OtherAxes { velocities, matrix, .. } in self.turned {
            let matrix = matrix.iter().map(|row| Ok(instant.pass.evaluate(row)?));
            turn(&mut turned, velocities, &matrix.collect::<Result<Vec<_>, Defect>>()?);
        }
        Ok(Sample { divisors, mass, jacobian, turned, declared })
    }

    fn division(&self, graph: &Graph, procedure: &Procedure) -> i64 {
        let Self { reference, definitions, mass, jacobian, .. } = self;
        let own = [definitions.expressions(), mass.concat(), jacobian.concat()].concat();
        graph.angle_division(&[reference.roots(), procedure.expressions(), own].concat())
    }

    /// The divisors that are pivots, or multiples by numbers of what may not vanish.
    fn recognised(
        &self,
        graph: &Graph,
        procedure: &Procedure,
        (declared, divisors): (&[ExprId], &[ExprId]),
        ground: &Ground,
    ) -> BTreeSet<ExprId> {
        let blocks = uncoupled(graph, self.mass);
        let mut samples = Vec::new();
        for seed in FIRST_SEED..FIRST_SEED + PATIENCE {
            let point = FieldPoint::random(seed);
            if let Ok(sample) = self.sampled(graph, procedure, (divisors, declared), (point, ground)) {
                samples.push(sample);
            }
            if samples.len() == 2 {
                break;
            }
        }
        let [first, second] = samples.as_slice() else { return BTreeSet::new() };
        let is_definite = self.definiteness == Definiteness::Definite;
        let minors = [first, second].map(|sample| {
            let mut minors = self.minors(&blocks, sample);
            // the diagonal of a definite matrix, whatever is eliminated before
            minors.extend((0..sample.mass.len()).filter(|_| is_definite).map(|i| sample.mass[i][i]));
            minors
        });
        let pivots = |matrices: [Option<Vec<Vec<Residue>>>; 2]| match matrices {
            [Some(first), Some(second)] if is_definite => Some(Pivots::of([first, second])),
            _ => None,
        };
        let mut matrices: Vec<Pivots> = [
            pivots([first, second].map(|sample| Some(sample.mass.clone()))),
            pivots([first, second].map(Sample::complement)),
            pivots([first, second].map(|sample| Some(sample.turned.clone()))),
        ]
        .into_iter()
        .flatten()
        .collect();
        let masses = [first.mass.clone(), second.mass.clone()];
        let mut recognised: BTreeSet<ExprId> = BTreeSet::new();
        for (k, divisor) in divisors.iter().enumerate() {
            let value = [first.divisors[k], second.divisors[k]];
            let known = minors[0].iter().zip(&minors[1]).any(|(a, b)| is_multiple(value, [*a, *b]));
            // the first of a block may be divided by factor after factor; each of the matrices goes on by it
            let is_met = matrices.iter_mut().fold(false, |is_met, pivots| pivots.are_met(value) | is_met);
            if is_met || known || (is_definite && is_pivot(&masses, SMALL_BLOCK, value)) {
                recognised.insert(*divisor);
            }
        }
        recognised
    }

    /// What may not vanish, and quotients of it: principal minors where the mass matrix is definite, determinants of
    /// blocks; with it, and some of the constraints, those of saddle matrices.
    fn minors(&self, blocks: &[Vec<usize>], sample: &Sample) -> Vec<Residue> {
        let Sample { mass, jacobian, declared, .. } = sample;
        let is_definite = self.definiteness == Definiteness::Definite;
        let mut found = declared.clone();
        // a definite matrix is regular without the constraints
        for block in blocks.iter().filter(|_| is_definite || jacobian.is_empty()) {
            for subset in subsets(block, is_definite) {
                let rows = subset.iter().map(|i| subset.iter().map(|j| mass[*i][*j]).collect());
                found.push(determinant_in_field(rows.collect()));
            }
        }
        let rows: Vec<usize> = (0..jacobian.len()).collect();
        for subset in subsets(&rows, is_definite).into_iter().filter(|subset| !subset.is_empty()) {
            let mut saddle: Vec<Vec<Residue>> = Vec::new();
            for (alpha, row) in mass.iter().enumerate() {
                saddle.push(row.iter().copied().chain(subset.iter().map(|a| -jacobian[*a][alpha])).collect());
            }
            let rest = vec![Residue::ZERO; subset.len()];
            saddle.extend(subset.iter().map(|a| [jacobian[*a].as_slice(), &rest].concat()));
            found.push(determinant_in_field(saddle));
        }
        found
    }

    /// Whether a divisor vanishes only where something does that may not.
    fn vanishes_with_others(
        &self,
        graph: &Graph,
        procedure: &Procedure,
        lines: &mut Lines<'_>,
        divisor: ExprId,
    ) -> bool {
        let mut symbols = procedure.depends_on(graph, &[divisor]);
        procedure.definitions.iter().for_each(|definition| match definition {
            Definition::Value { symbol, .. } | Definition::Call { symbol, .. } => _ = symbols.remove(symbol),
            Definition::Solve { unknowns, .. } => symbols.retain(|symbol| !unknowns.contains(symbol)),
        });
        let symbols = lines.ground.variables(graph, symbols.into_iter().collect());
        let all: Vec<Varied> = symbols.iter().flat_map(|symbol| lines.arguments.ways(*symbol)).collect();
        all.into_iter().all(|varied| self.factors_are_known(graph, procedure, lines, divisor, varied))
    }

    fn factors_are_known(
        &self,
        graph: &Graph,
        procedure: &Procedure,
        lines: &mut Lines<'_>,
        divisor: ExprId,
        varied: Varied,
    ) -> bool {
        let Some(position) = lines.asked.iter().position(|asked| *asked == divisor) else { return false };
        for degree in DEGREES {
            let Some(values) = self.values_along(graph, procedure, lines, varied, values_for(degree)) else {
                return false;
            };
            let own: Vec<Residue> = values.iter().map(|(divisors, _)| divisors[position]).collect();
            let Some(mut left) = numerator(&own) else { continue };
            if matches!(varied, Varied::Exponential(_)) {
                left = left.without(&Polynomial::variable());
            }
            for k in 0..values[0].1.len() {
                if left.degree() == 0 {
                    return true;
                }
                let column: Vec<Residue> = values.iter().map(|(_, others)| others[k]).collect();
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

    /// The values of divisors, and of what may not vanish, at the first places of a line; `None` where too many lines
    /// have places without a value: where there are roots, at some places all of them may be in the field.
    fn values_along<'l>(
        &self,
        graph: &Graph,
        procedure: &Procedure,
        lines: &'l mut Lines<'_>,
        varied: Varied,
        places: usize,
    ) -> Option<&'l [(Vec<Residue>, Vec<Residue>)]> {
        let Lines { asked, declared, arguments, ground, blocks, known } = lines;
        let line = known.entry(varied).or_default();
        while line.values.len() < places && line.seed < SEEDS {
            let point = varied.point(arguments, place(line.values.len()), line.seed);
            if let Ok(sample) = self.sampled(graph, procedure, (asked, declared), (point, ground)) {
                let others = self.minors(blocks, &sample);
                line.values.push((sample.divisors, others));
            } else {
                line.seed += 1;
                let values = std::mem::take(&mut line.values);
                if values.len() > line.most.len() {
                    line.most = values;
                }
            }
        }
        line.values.get(..places).or_else(|| line.most.get(..places))
    }
}

/// PᵀMP for v̇ = P u̇, where P has a block E: definite with M, as E is a rotation.
fn turn(mass: &mut [Vec<Residue>], velocities: &[usize; 3], matrix: &[Vec<Residue>]) {
    let turned = |values: [Residue; 3], k: usize| {
        matrix.iter().zip(values).fold(Residue::ZERO, |sum, (row, value)| sum + row[k] * value)
    };
    for row in mass.iter_mut() {
        let values = velocities.map(|a| row[a]);
        for (k, a) in velocities.iter().enumerate() {
            row[*a] = turned(values, k);
        }
    }
    let [x, y, z] = velocities.map(|a| mass[a].clone());
    for (k, a) in velocities.iter().enumerate() {
        let columns = x.iter().zip(&y).zip(&z);
        mass[*a] = columns.map(|((x, y), z)| turned([*x, *y, *z], k)).collect();
    }
}

/// All subsets that are not empty of a few, if all of them are wanted; else the whole.
fn subsets(members: &[usize], all: bool) -> Vec<Vec<usize>> {
    if !all || members.len() > SMALL_BLOCK {
        return vec![members.to_vec()];
    }
    let pick = |mask: usize| {
        let members = members.iter().enumerate().filter(|(k, _)| mask >> k & 1 == 1);
        members.map(|(_, index)| *index).collect()
    };
    (1..1 << members.len()).map(pick).collect()
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

impl Sample {
    /// J M⁻¹ Jᵀ, which is definite where the mass matrix is: what constraints are solved by.
    fn complement(&self) -> Option<Vec<Vec<Residue>>> {
        let s = self.mass.len();
        let with: Vec<Vec<Residue>> = (0..s)
            .map(|alpha| {
                let rows = self.jacobian.iter().map(|row| row[alpha]);
                self.mass[alpha].iter().copied().chain(rows).collect()
            })
            .collect();
        let echelon = Echelon::of(with);
        if self.jacobian.is_empty() || echelon.pivots.iter().copied().ne(0..s) {
            return None;
        }
        let reach = |b: usize| echelon.rows.iter().map(|row| row[s + b]).collect::<Vec<Residue>>();
        let entry = |row: &Vec<Residue>| (0..self.jacobian.len()).map(|b| inner(row, &reach(b))).collect();
        Some(self.jacobian.iter().map(entry).collect())
    }
}
