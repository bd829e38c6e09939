//! Points where functions vanish that can be solved for nothing, such as the closure of a loop in space: found modulo a
//! small prime by trying all digits, and lifted to a high power of it by Newton's method (Hensel).
//!
//! All digits but the first of the coordinates that are free are random. So a matrix whose rank is r at such a point has
//! that rank at most points of the part of the manifold that the point is of; and where functions say the same twice,
//! those that were not used for the point vanish there with all digits.

use super::first_digits::{Search, random};
use crate::algebra::{Chosen, Graph, Matrix, PrimePower, ResidueSteps, StepsModulo};
use crate::id::{ExprId, SymbolId};

/// Which rows of a matrix are independent of those before them where functions vanish.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RowsOnPart {
    /// The independent ones, ascending.
    pub rows: Vec<usize>,
    /// The primes modulo whose powers points were found.
    pub primes: Vec<u64>,
    /// At how many points.
    pub points: usize,
}

impl RowsOnPart {
    fn count(&mut self, prime: u64) {
        self.points += 1;
        if !self.primes.contains(&prime) {
            self.primes.push(prime);
        }
    }
}

/// Primes that are 3 modulo 4: there every t is a point of the circle.
const PRIMES: [u64; 5] = [7, 11, 19, 23, 31];
/// Searches, each with other values of the parameters.
const SEARCHES: usize = 24;
/// Points looked for where all rows are independent at one of them, and else; and of one search.
const POINTS: usize = 8;
const POINTS_OF_DEPENDENT: usize = 48;
const POINTS_OF_SEARCH: usize = 4;
/// One search may take the inverse of this of what is left.
const SHARE: u64 = 4;
/// The work of all trials.
const TRIALS: u64 = 6_000_000;

/// The rows of a matrix that are independent where all functions vanish, on each of the parts of that manifold that
/// points were found of. None, if no points were found.
pub fn rows_on_parts(
    graph: &mut Graph,
    functions: &[ExprId],
    coordinates: &[SymbolId],
    rows: &Matrix,
) -> Vec<RowsOnPart> {
    let present = graph.symbols_in(functions);
    let coordinates: Vec<SymbolId> =
        coordinates.iter().copied().filter(|symbol| present.contains(symbol)).collect();
    if coordinates.is_empty() {
        return Vec::new();
    }
    let mut all = functions.to_vec();
    for function in functions {
        all.extend(coordinates.iter().map(|symbol| graph.partial(*function, *symbol)));
    }
    all.extend(rows.iter().flatten());
    let Some(steps) = ResidueSteps::of(graph, &all, &coordinates) else { return Vec::new() };
    let Some(order) =
        coordinates.iter().map(|symbol| steps.place_of(graph, *symbol)).collect::<Option<Vec<_>>>()
    else {
        return Vec::new();
    };
    let lifting = Lifting { steps: &steps, places: &order, functions: functions.len(), rows: rows.len() };
    let mut found: Vec<RowsOnPart> = Vec::new();
    let mut left = TRIALS;
    // the primes in turn: each has other points, and parts of which there are none modulo it
    for search in 0..SEARCHES {
        let prime = PRIMES[search % PRIMES.len()];
        let [first, highest] = [PrimePower::first(prime), PrimePower::highest(prime)];
        let (Some(trial), Some(lifted)) = (steps.modulo(first), steps.modulo(highest)) else { continue };
        let allowed = left / SHARE;
        let seed = u64::try_from(search).unwrap_or(0);
        let mut search = Search::new(&steps, &trial, &order, functions.len(), seed, allowed);
        let mut points = 0;
        search.run(&mut |seed, digits| {
            let independent = lifting.independent_rows(&trial, &lifted, digits, seed);
            let Some(independent) = independent else { return true };
            points += 1;
            match found.iter_mut().find(|part| part.rows == independent) {
                Some(part) => part.count(prime),
                None => found.push(RowsOnPart { rows: independent, primes: vec![prime], points: 1 }),
            }
            points < POINTS_OF_SEARCH
        });
        left -= allowed - search.left;
        let points: usize = found.iter().map(|part| part.points).sum();
        // where fewer are independent a part is larger, and has more of the points
        let is_any_whole = found.iter().any(|part| part.rows.len() == rows.len());
        if left < SHARE || points >= if is_any_whole { POINTS } else { POINTS_OF_DEPENDENT } {
            break;
        }
    }
    found
}

/// First digits that become points.
struct Lifting<'a> {
    steps: &'a ResidueSteps,
    /// The coordinates, by their places among what is chosen.
    places: &'a [usize],
    /// How many functions vanish.
    functions: usize,
    /// How many rows the matrix has.
    rows: usize,
}

impl Lifting<'_> {
    /// The rows that are independent at the point with these first digits. `None`, if there is none in whose
    /// neighbourhood the functions vanish as often as here, or if the first digits do not show which rows are
    /// independent.
    fn independent_rows(
        &self,
        trial: &StepsModulo,
        lifted: &StepsModulo,
        digits: &[u64],
        seed: u64,
    ) -> Option<Vec<usize>> {
        let values = trial.evaluate(digits)?;
        let pivots = Elimination::of(trial.power, self.slopes(trial.power, &values, digits))?.pivots;
        let prime = trial.power.prime();
        let highest = lifted.power.modulus() / prime;
        let mut chosen: Vec<u64> = digits
            .iter()
            .zip(0..)
            .map(|(digit, place)| digit + prime * (random(seed, place) % highest))
            .collect();
        let mut values = lifted.evaluate(&chosen)?;
        for _ in 0..PrimePower::DOUBLINGS {
            let slopes = self.slopes(lifted.power, &values, &chosen);
            let square: Vec<Vec<u64>> = pivots
                .iter()
                .map(|(row, _)| {
                    let columns = pivots.iter().map(|(_, column)| slopes[*row][*column]);
                    columns.chain([values[self.steps.roots[*row]]]).collect()
                })
                .collect();
            let change = solved(lifted.power, square)?;
            for ((_, column), change) in pivots.iter().zip(change) {
                let place = self.places[*column];
                chosen[place] = lifted.power.difference(chosen[place], change);
            }
            values = lifted.evaluate(&chosen)?;
        }
        let roots = &self.steps.roots;
        if roots[..self.functions].iter().any(|root| values[*root] != 0) {
            return None;
        }
        let matrix = &roots[self.functions * (1 + self.places.len())..];
        let width = matrix.len() / self.rows.max(1);
        let matrix = matrix.chunks(width).map(|row| row.iter().map(|root| values[*root]).collect()).collect();
        let independent = Elimination::of(lifted.power, matrix)?;
        Some(independent.pivots.iter().map(|(row, _)| *row).collect())
    }

    /// The derivatives of the functions by what is chosen for coordinates: of an angle q that is n times 2 atan t, by t.
    fn slopes(&self, power: PrimePower, values: &[u64], chosen: &[u64]) -> Vec<Vec<u64>> {
        let slopes = self.steps.roots[self.functions..].chunks(self.places.len()).take(self.functions);
        let of_angle = |place: usize| match self.steps.chosen[place] {
            Chosen::Value(_) => Some(1),
            Chosen::Circle(_) => {
                let t = chosen[place];
                let twice = 2 * self.steps.division.unsigned_abs() % power.modulus();
                Some(power.product(twice, power.inverse(power.sum(1, power.product(t, t)))?))
            }
        };
        let factors: Vec<u64> = self.places.iter().map(|place| of_angle(*place).unwrap_or(0)).collect();
        slopes
            .map(|row| {
                row.iter().zip(&factors).map(|(root, factor)| power.product(values[*root], *factor)).collect()
            })
            .collect()
    }
}

/// Rows that are independent of those before them, with a column each where that is to be seen.
struct Elimination {
    pivots: Vec<(usize, usize)>,
}

impl Elimination {
    /// `None`, if a row differs from a combination of those before it, but not in its first digits.
    fn of(power: PrimePower, matrix: Vec<Vec<u64>>) -> Option<Self> {
        let mut reduced: Vec<(usize, Vec<u64>)> = Vec::new();
        let mut pivots = Vec::new();
        for (index, mut row) in matrix.into_iter().enumerate() {
            for (column, earlier) in &reduced {
                subtract(power, &mut row, power.inverse(earlier[*column])?, earlier, *column);
            }
            if let Some(column) = row.iter().position(|entry| power.is_unit(*entry)) {
                pivots.push((index, column));
                reduced.push((column, row));
            } else if row.iter().any(|entry| *entry != 0) {
                return None;
            }
        }
        Some(Self { pivots })
    }
}

/// Takes so much of another row off that nothing is left in a column.
fn subtract(power: PrimePower, row: &mut [u64], inverse: u64, other: &[u64], column: usize) {
    let times = power.product(row[column], inverse);
    if times != 0 {
        for (entry, of_other) in row.iter_mut().zip(other) {
            *entry = power.difference(*entry, power.product(times, *of_other));
        }
    }
}

/// The solution of a regular linear system, whose right side is the last column.
fn solved(power: PrimePower, mut matrix: Vec<Vec<u64>>) -> Option<Vec<u64>> {
    let count = matrix.len();
    for place in 0..count {
        let pivot = (place..count).find(|row| power.is_unit(matrix[*row][place]))?;
        matrix.swap(place, pivot);
        let row = matrix[place].clone();
        let inverse = power.inverse(row[place])?;
        for (_, other) in matrix.iter_mut().enumerate().filter(|(index, _)| *index != place) {
            subtract(power, other, inverse, &row, place);
        }
    }
    (0..count).map(|row| Some(power.product(matrix[row][count], power.inverse(matrix[row][row])?))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::Function;

    fn rates(graph: &mut Graph, functions: &[ExprId], coordinates: &[SymbolId]) -> Matrix {
        let row = |function: &ExprId| coordinates.iter().map(|q| graph.partial(*function, *q)).collect();
        functions.iter().map(row).collect()
    }

    fn parts(graph: &mut Graph, functions: &[ExprId], coordinates: &[SymbolId]) -> Vec<Vec<usize>> {
        let rows = rates(graph, functions, coordinates);
        let found = rows_on_parts(graph, functions, coordinates, &rows);
        assert!(found.iter().all(|part| part.points > 0 && !part.primes.is_empty()));
        found.into_iter().map(|part| part.rows).collect()
    }

    fn symbols<const N: usize>(graph: &mut Graph, names: [&str; N]) -> ([SymbolId; N], [ExprId; N]) {
        let symbols = names.map(|name| graph.new_symbol(name));
        (symbols, symbols.map(|symbol| graph.symbol(symbol)))
    }

    /// Four angles of a parallelogram with a second one between the same cranks: three of four rates are independent
    /// where both are closed, four in general.
    #[test]
    fn the_second_parallelogram_follows() {
        let mut g = Graph::new();
        let (coordinates, [a, b, c, d]) = symbols(&mut g, ["a", "b", "c", "d"]);
        let mut functions = Vec::new();
        for (crank, coupler) in [(2, b), (1, d)] {
            let (of, one) = ([a, c, coupler].map(|angle| [g.cos(angle), g.sin(angle)]), g.one());
            for place in 0..2 {
                let [x, y, z] = of.map(|unit| unit[place]);
                let terms = [(crank.into(), x), ((-crank).into(), y), (3.into(), z)];
                let closed = g.linear_combination(&terms);
                let three = g.scale(3.into(), one);
                functions.push(if place == 0 { g.formula(closed - three) } else { closed });
            }
        }
        let rows = rates(&mut g, &functions, &coordinates);
        assert_eq!(g.generic_rank(&rows), Ok(4));
        assert_eq!(parts(&mut g, &functions, &coordinates), [[0, 1, 3]]);
    }

    /// What has no solution modulo some prime, or functions without digits, is left open.
    #[test]
    fn nothing_is_said_where_nothing_is_found() {
        let mut g = Graph::new();
        let (coordinates, [x, y]) = symbols(&mut g, ["x", "y"]);
        let (exponential, three) = (g.apply(Function::Exp, x), g.number(3));
        let functions = [g.formula(exponential - three)];
        assert!(parts(&mut g, &functions, &coordinates).is_empty());
        // x⁴ = −1 has no solution modulo a prime that is 3 modulo 4
        let one = g.one();
        let functions = [g.formula(x.square() + y.square()), g.formula(x * y + one)];
        assert!(parts(&mut g, &functions, &coordinates).is_empty());
    }

    /// What holds modulo each of the primes, and nowhere.
    #[test]
    fn first_digits_alone_are_no_point() {
        let mut g = Graph::new();
        let (coordinates, [x, y]) = symbols(&mut g, ["x", "y"]);
        let product = g.number(PRIMES.iter().map(|prime| i64::try_from(*prime).unwrap()).product::<i64>());
        let functions = [g.formula(x.square() - y), g.formula(x.square() - y + product)];
        assert_eq!(parts(&mut g, &functions[..1], &coordinates), [[0]]);
        assert!(parts(&mut g, &functions, &coordinates).is_empty());
    }

    /// x (x² + y² − 1) = 0 and x (x + 2 y) = 0: the line x = 0, where the second rate is a multiple of the first, and
    /// points of the circle, where it is not.
    #[test]
    fn parts_of_different_rank_are_told_apart() {
        let mut g = Graph::new();
        let (coordinates, [x, y]) = symbols(&mut g, ["x", "y"]);
        let (one, two) = (g.one(), g.number(2));
        let functions = [g.formula(x * (x.square() + y.square() - one)), g.formula(x * (x + two * y))];
        let mut found = parts(&mut g, &functions, &coordinates);
        found.sort();
        assert_eq!(found, [vec![0], vec![0, 1]]);
    }
}
