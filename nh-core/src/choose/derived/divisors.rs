//! What a function divides by, as a function of one number along lines through the field.

use super::super::pivots::{is_multiple, is_pivot};
use super::super::proof::{Defect, FIRST_SEED, defined};
use super::super::zero_set::{Polynomial, numerator_at, values_for};
use super::definition::is_defined;
use super::place::{Place, gram};
use super::returns::{independent_slopes, products};
use super::{Allowed, Derived, Images, Motion, choose_all};
use crate::algebra::{FieldPass, FieldPoint, Function, Graph, Node, Residue, determinant_in_field};
use crate::id::{ExprId, SymbolId};
use crate::mechanics::{Definition, Procedure};
use std::collections::{BTreeMap, BTreeSet};

/// As many unknowns that touch each other are tried in every order; more stay as they are.
const TOGETHER: usize = 9;

/// What a procedure of a claim divides by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Divisor {
    Expression(ExprId),
    /// The determinant of the matrix of a definition.
    Determinant(usize),
}

/// The divisors that neither the motion nor the declaration has, and that the facts do not keep from 0.
pub(super) struct Asked {
    /// Each with the number of the procedure.
    divisors: Vec<(usize, Divisor)>,
    /// Those parameters among what they are made of that may be 0.
    pub(super) parameters: Vec<SymbolId>,
    /// What the motion and the declaration divide by.
    known: Vec<ExprId>,
    motion: Procedure,
}

/// The divisors of a claim that are to be asked.
pub(super) fn asked(
    graph: &Graph,
    claim: &Derived,
    (declared, motion): (&[ExprId], Motion),
    allowed: &Allowed,
) -> Asked {
    let known = graph.divisors(&[declared, &motion.derivative.expressions()].concat());
    let solved: BTreeSet<SymbolId> =
        motion.derivative.definitions.iter().flat_map(unknowns).copied().collect();
    let (mut divisors, mut symbols) = (Vec::new(), BTreeSet::new());
    for (number, procedure) in claim.procedures().into_iter().enumerate() {
        let (mut own, mut made_of) = (Vec::new(), Vec::new());
        for divisor in graph.divisors(&procedure.expressions()).difference(&known) {
            if !graph.vanishes_nowhere(*divisor, allowed.facts) {
                own.push((number, Divisor::Expression(*divisor)));
            }
            made_of.push(*divisor);
        }
        for (place, definition) in procedure.definitions.iter().enumerate() {
            if let Definition::Solve { matrix, unknowns, .. } = definition
                && !unknowns.iter().all(|unknown| solved.contains(unknown))
            {
                own.push((number, Divisor::Determinant(place)));
                made_of.extend(matrix.iter().flatten());
            }
        }
        let occurring =
            if made_of.is_empty() { BTreeSet::new() } else { procedure.depends_on(graph, &made_of) };
        if claim.has_open_factors() {
            // a multiple by a function of the state is another choice
            let named = defined(procedure);
            let is_number = |symbol: &SymbolId| allowed.parameters.contains(symbol) || named.contains(symbol);
            own.retain(|(_, divisor)| {
                matches!(divisor, Divisor::Expression(divisor)
                    if procedure.depends_on(graph, &[*divisor]).iter().all(is_number))
            });
        }
        divisors.extend(own);
        symbols.extend(occurring);
    }
    let parameters =
        allowed.may_vanish.iter().copied().filter(|parameter| symbols.contains(parameter)).collect();
    Asked { divisors, parameters, known: known.into_iter().collect(), motion: motion.derivative.clone() }
}

fn unknowns(definition: &Definition) -> &[SymbolId] {
    match definition {
        Definition::Solve { unknowns, .. } => unknowns,
        Definition::Value { .. } | Definition::Call { .. } => &[],
    }
}

impl Asked {
    pub(super) fn is_empty(&self) -> bool {
        self.divisors.is_empty() && self.parameters.is_empty()
    }

    pub(super) fn count(&self) -> usize {
        self.divisors.len()
    }

    /// A divisor with the number of its procedure.
    pub(super) fn place(&self, index: usize) -> (usize, Divisor) {
        self.divisors[index]
    }

    /// All divisors at a place.
    fn at(&self, claim: &Derived, place: &Place) -> Vec<Option<Residue>> {
        let mut found = Vec::new();
        for (number, procedure) in claim.procedures().into_iter().enumerate() {
            let own = self.divisors.iter().filter(|(of, _)| *of == number);
            let wanted: Vec<Divisor> = own.map(|(_, divisor)| *divisor).collect();
            if wanted.is_empty() {
                continue;
            }
            let mut pass = place.pass();
            // what is loaded has no value at the zeros of what gives it one
            if claim.prepare(place, &mut pass).is_ok() || !claim.loads(procedure) {
                found.extend(values(&mut pass, procedure, &wanted));
            } else {
                found.resize(found.len() + wanted.len(), None);
            }
        }
        found
    }

    /// What the motion and the declaration divide by at a place.
    fn known_at(&self, place: &Place) -> Vec<Option<Residue>> {
        let mut pass = place.pass();
        _ = values(&mut pass, &self.motion, &[]);
        self.known.iter().map(|other| pass.evaluate(&[*other]).ok().map(|values| values[0])).collect()
    }

    /// The divisors that are no multiples by numbers of products of what the motion and the declaration divide by,
    /// and of the determinants of the kinetic metric on E and on D, at two places.
    pub(super) fn unrecognised<'a, 's>(
        &self,
        claim: &Derived,
        point: impl Fn(u64) -> FieldPoint,
        at: impl Fn(FieldPoint) -> Result<Place<'a, 's>, Defect>,
    ) -> Vec<usize> {
        let mut places = (FIRST_SEED..FIRST_SEED + SEEDS).filter_map(|seed| at(point(seed)).ok());
        let (Some(first), Some(second)) = (places.next(), places.next()) else {
            return (0..self.count()).collect();
        };
        let both = [&first, &second];
        let divisors = both.map(|place| self.at(claim, place));
        let known = both.map(|place| self.known_at(place));
        let pair = |lists: &[Vec<Option<Residue>>; 2], k: usize| Some([lists[0][k]?, lists[1][k]?]);
        let mut factors: Vec<[Residue; 2]> = vec![[Residue::ONE; 2]];
        factors.extend((0..known[0].len()).filter_map(|k| pair(&known, k)));
        let is_met = |value: [Residue; 2], factors: &[[Residue; 2]]| {
            factors.iter().enumerate().any(|(k, a)| {
                factors[..=k].iter().any(|b| {
                    let product = [a[0] * b[0], a[1] * b[1]];
                    is_multiple(value, product) || is_multiple([value[0] * b[0], value[1] * b[1]], *a)
                })
            })
        };
        let mut open: Vec<usize> = (0..self.count()).collect();
        open.retain(|k| pair(&divisors, *k).is_none_or(|value| !is_met(value, &factors)));
        if !open.is_empty() {
            let determinants = both.map(|place| metric_determinants(place).unwrap_or_default());
            factors.extend(determinants[0].iter().zip(&determinants[1]).map(|(a, b)| [*a, *b]));
            open.retain(|k| pair(&divisors, *k).is_none_or(|value| !is_met(value, &factors)));
        }
        if let Derived::Normalisation(_, identities) = claim
            && let [Ok(first), Ok(second)] = both.map(|place| independent_slopes(place, identities))
        {
            // products of gradients are definite
            let matrices = [first, second].map(|rows| products(&rows));
            open.retain(|k| pair(&divisors, *k).is_none_or(|value| !is_pivot(&matrices, TOGETHER, value)));
        }
        open
    }

    pub(super) fn text(&self, graph: &Graph, index: usize) -> String {
        match self.divisors[index].1 {
            // steps of derivatives have no names
            Divisor::Expression(divisor) if graph.text(divisor).is_empty() => "an intermediate result".into(),
            Divisor::Expression(divisor) => graph.text(divisor),
            Divisor::Determinant(_) => "the determinant of what it solves".into(),
        }
    }
}

impl Derived<'_> {
    /// Gives values to what the procedures load beside the state.
    fn prepare(&self, place: &Place, pass: &mut FieldPass) -> Result<(), Defect> {
        match self {
            Self::Hamiltonian(side, _) => choose_all(pass, &side.momenta, &place.run(&side.legendre)?),
            _ => Ok(()),
        }
    }

    /// Whether a procedure has values at a place.
    pub(super) fn has_values(&self, place: &Place, procedure: &Procedure) -> bool {
        let mut pass = place.pass();
        // what is not prepared is any number
        _ = self.prepare(place, &mut pass);
        super::super::proof::run(&mut pass, procedure).is_ok()
    }

    /// What its symbols are that others determine.
    fn loaded(&self) -> &[SymbolId] {
        match self {
            Self::Hamiltonian(side, _) => &side.momenta,
            _ => &[],
        }
    }

    /// Whether a procedure is one in terms of those.
    fn loads(&self, procedure: &Procedure) -> bool {
        match self {
            Self::Hamiltonian(side, energy) => {
                !std::ptr::eq(procedure, *energy)
                    && !std::ptr::eq(procedure, std::ptr::from_ref(&side.legendre))
            }
            _ => false,
        }
    }
}

/// The determinants of ∂²L/∂y² and of what it is on D.
fn metric_determinants(place: &Place) -> Result<Vec<Residue>, Defect> {
    let mass = place.mass()?;
    let on_distribution = gram(&mass, &place.distribution()?);
    Ok([mass, on_distribution].map(determinant_in_field).to_vec())
}

/// The values of divisors as far as the definitions before them have values.
fn values(pass: &mut FieldPass, procedure: &Procedure, wanted: &[Divisor]) -> Vec<Option<Residue>> {
    let mut found: Vec<Option<Residue>> = vec![None; wanted.len()];
    let determinant = |place: usize, pass: &mut FieldPass| -> Option<Residue> {
        let Definition::Solve { matrix, .. } = &procedure.definitions[place] else { return None };
        let rows = matrix.iter().map(|row| pass.evaluate(row)).collect::<Result<Vec<_>, _>>();
        rows.ok().map(determinant_in_field)
    };
    for (place, definition) in procedure.definitions.iter().enumerate() {
        for (slot, divisor) in found.iter_mut().zip(wanted) {
            if *divisor == Divisor::Determinant(place) {
                *slot = determinant(place, pass);
            }
        }
        let mut one = Procedure::of(Vec::new());
        one.definitions.push(definition.clone());
        if super::super::proof::run(pass, &one).is_err() {
            break;
        }
    }
    for (slot, divisor) in found.iter_mut().zip(wanted) {
        if let Divisor::Expression(divisor) = divisor {
            *slot = pass.evaluate(&[*divisor]).ok().map(|values| values[0]);
        }
    }
    found
}

/// Where a divisor vanishes on a line.
pub(super) enum Zeros {
    /// It is no quotient of polynomials of low degree there.
    Unknown,
    /// Nowhere but where something else does that may not.
    Nowhere,
    /// As far as they are in the field.
    At(Vec<Residue>),
}

/// Values of divisors along lines.
pub(super) struct Lines<'q> {
    asked: &'q Asked,
    claim: &'q Derived<'q>,
    /// The symbols that lines vary, and those whose sines and cosines they do.
    varied: Vec<SymbolId>,
    angles: Vec<SymbolId>,
    known: BTreeMap<u64, Line>,
}

/// Values along one line: where, of the divisors, and of what the motion and the declaration divide by.
#[derive(Default)]
struct Line {
    places: Vec<Residue>,
    divisors: Vec<Vec<Option<Residue>>>,
    others: Vec<Vec<Option<Residue>>>,
    next: u64,
}

/// Degrees of numerators that are looked for, in turn.
const DEGREES: [usize; 3] = [2, 6, 14];
/// Points tried for two that have values.
const SEEDS: u64 = 24;
/// Places tried on a line for each that is wanted: there is no value at poles, or where a root is not in the field.
const PATIENCE: u64 = 4;

impl<'q> Lines<'q> {
    pub(super) fn of(graph: &Graph, claim: &'q Derived<'q>, asked: &'q Asked, images: Images) -> Self {
        let procedures = claim.procedures();
        let roots: Vec<ExprId> = procedures.iter().flat_map(|procedure| procedure.expressions()).collect();
        let mut determined: BTreeSet<SymbolId> =
            procedures.iter().flat_map(|procedure| defined(procedure)).collect();
        determined.extend(defined(&asked.motion));
        determined.extend(claim.loaded().iter().chain(images.iter().map(|(symbol, _)| symbol)));
        // functions have values of their own: what stands in them rests, but for sines and cosines of symbols
        let (mut resting, mut angles) = (BTreeSet::new(), BTreeSet::new());
        for id in graph.reachable(&[roots.as_slice(), &asked.known, &asked.motion.expressions()].concat()) {
            match graph.node(id) {
                Node::Apply(Function::Sin | Function::Cos, x) => {
                    for (term, _) in graph.terms_of_angle(*x) {
                        match graph.as_symbol(term) {
                            Some(symbol) => _ = angles.insert(symbol),
                            None => resting.extend(graph.symbols_in(&[term])),
                        }
                    }
                }
                Node::Apply(_, x) => resting.extend(graph.symbols_in(&[*x])),
                Node::Apply2(_, x, y) => resting.extend(graph.symbols_in(&[*x, *y])),
                _ => {}
            }
        }
        let mut symbols: BTreeSet<SymbolId> = BTreeSet::new();
        for procedure in &procedures {
            symbols.extend(procedure.depends_on(graph, &procedure.expressions()));
        }
        let is_free = |symbol: &SymbolId| !determined.contains(symbol) && !resting.contains(symbol);
        let varied = symbols.iter().copied().filter(is_free).collect();
        let angles = angles.into_iter().filter(is_free).collect();
        Self { asked, claim, varied, angles, known: BTreeMap::new() }
    }

    /// The point of a line at t.
    fn point(&self, seed: u64, t: Residue) -> FieldPoint {
        let line = |stream: u64, symbol: usize| {
            let base = Residue::mixed(stream + 2 * seed, symbol as u64);
            base + Residue::mixed(stream + 2 * seed + 1, symbol as u64) * t
        };
        let mut point = FieldPoint::random(15_485_863 + seed);
        for (k, symbol) in self.varied.iter().enumerate() {
            point.chosen.insert(*symbol, line(9_001, k));
        }
        for (k, angle) in self.angles.iter().enumerate() {
            let u = line(19_001, k);
            if let Some(scale) = (Residue::ONE + u * u).inverse() {
                point.circle.insert(*angle, ((Residue::ONE - u * u) * scale, (u + u) * scale));
            }
        }
        point
    }

    /// Where a divisor vanishes on a line, but for the zeros of what the motion and the declaration divide by.
    pub(super) fn zeros<'a, 's>(
        &mut self,
        index: usize,
        seed: u64,
        at: impl Fn(FieldPoint) -> Result<Place<'a, 's>, Defect>,
    ) -> Zeros {
        for degree in DEGREES {
            self.extend(seed, values_for(degree), &at);
            let Some(line) = self.known.get(&seed).filter(|line| line.places.len() >= values_for(degree))
            else {
                return Zeros::Unknown;
            };
            let column = |rows: &[Vec<Option<Residue>>], k: usize| -> Option<Polynomial> {
                let pairs = line.places.iter().zip(rows).filter_map(|(t, row)| Some((*t, row[k]?)));
                let (places, values): (Vec<Residue>, Vec<Residue>) = pairs.take(values_for(degree)).unzip();
                (places.len() == values_for(degree)).then(|| numerator_at(&places, &values))?
            };
            let Some(mut left) = column(&line.divisors, index) else { continue };
            for k in 0..line.others.first().map_or(0, Vec::len) {
                if left.degree() > 0
                    && let Some(other) = column(&line.others, k)
                {
                    left = left.without(&other);
                }
            }
            return if left.degree() > 0 { Zeros::At(left.zeros()) } else { Zeros::Nowhere };
        }
        Zeros::Unknown
    }

    /// Takes values at further places.
    fn extend<'a, 's>(
        &mut self,
        seed: u64,
        wanted: usize,
        at: impl Fn(FieldPoint) -> Result<Place<'a, 's>, Defect>,
    ) {
        let mut line = self.known.remove(&seed).unwrap_or_default();
        let limit = PATIENCE * wanted as u64;
        while line.places.len() < wanted && line.next < limit {
            let t = Residue::mixed(2_039, line.next);
            line.next += 1;
            if let Ok(place) = at(self.point(seed, t)) {
                line.places.push(t);
                line.divisors.push(self.asked.at(self.claim, &place));
                line.others.push(self.asked.known_at(&place));
            }
        }
        self.known.insert(seed, line);
    }

    /// Whether, where a divisor vanishes, all else has a value.
    pub(super) fn is_added<'a, 's>(
        &self,
        claim: &Derived,
        index: usize,
        (seed, t): (u64, Residue),
        allowed: &Allowed,
        at: impl Fn(FieldPoint) -> Result<Place<'a, 's>, Defect>,
    ) -> bool {
        let Ok(mut place) = at(self.point(seed, t)) else { return false };
        let vanishes = self.asked.at(claim, &place)[index] == Some(Residue::ZERO);
        let is_checked =
            || place.values(allowed.conditions).is_ok_and(|values| !values.contains(&Residue::ZERO));
        vanishes && is_checked() && is_defined(claim, &mut place).unwrap_or(false)
    }
}
