//! Which velocities a declaration might keep where every choice of them breaks down somewhere.
//!
//! Choices are ranked by what costs little, and only the few that come first are judged exactly. For one machine, the
//! determinant of a choice near the origin of the coordinates is compared with the largest that it has at points farther
//! away, in floating point: sin(θ) does not take the place of cos(θ) for a car that starts with θ = 0. Of those that
//! keep up, short pivots come first. What is said of the choice that comes of it is proved: that its determinant does
//! not vanish everywhere on the manifold, and where it may.

use super::independent_velocities::{Choice, Subsets, judge};
use super::pivot::PivotSetting;
use crate::algebra::{
    Echelon, FieldPoint, Graph, Matrix, Residue, determinant_in_field, sample, triangular_blocks,
};
use crate::count::Count;
use crate::id::{ExprId, Id, SectionId, SymbolId};
use crate::limits::{attempt, spend};
use std::cmp::Reverse;

/// Velocities that the constraints determine by the others, at generic points: proved.
#[derive(Clone, Debug)]
pub struct Suggested {
    /// The velocities to eliminate.
    pub dependent: Vec<SectionId>,
    /// Where the choice is valid; `None` where that would take too many steps.
    pub judged: Option<Choice>,
}

/// Points of each kind.
const POINTS: u64 = 12;
/// How many times less than the best choice's share of its largest determinant that of another may be.
const SHARE: f64 = 4.0;
/// The same for what the best choice's determinant is near the origin, of the largest that it is anywhere.
const DEGENERATE: f64 = 8.0;
/// More sets of velocities are not looked at.
const LIMIT: usize = 4096;
/// So many choices are judged exactly.
const JUDGED: usize = 6;
/// What a factor counts beside its operations: as much as a sine.
const FACTOR: u64 = 20;
/// What the ranking may take, in steps, and what one judgement may.
const RANKING: u64 = 400_000;
const JUDGEMENT: u64 = 700_000;

/// What a suggestion has to heed.
#[derive(Clone, Copy, Debug)]
pub struct Wanted<'a> {
    /// Φ on an embedded base alone, where parameters have any values: those that close a loop at a given place are of
    /// another machine at the next.
    pub off_positions: &'a Matrix,
    /// What changes by itself.
    pub time: SymbolId,
    /// Sections whose velocities have to stay in the state.
    pub kept: &'a [SectionId],
}

/// A choice that the constraints allow; `None` where none was found.
pub fn suggested(graph: &mut Graph, setting: &PivotSetting<'_>, wanted: &Wanted<'_>) -> Option<Suggested> {
    let ranked =
        attempt(RANKING, || Ranking::of(graph, setting, wanted).map(|ranking| ranking.first(wanted)))??;
    let mut found: Option<(Merit, Suggested)> = None;
    for (is_small, dependent) in ranked {
        let columns: Matrix =
            setting.on_base.iter().map(|row| dependent.iter().map(|c| row[c.index()]).collect()).collect();
        if graph.generic_rank(&columns) != Ok(dependent.len()) {
            continue;
        }
        let judged = match attempt(JUDGEMENT, || judge(graph, setting, &dependent)) {
            Some(Ok(Some(choice))) => Some(choice),
            Some(_) => continue,
            None => None,
        };
        let merit = match &judged {
            Some(choice) => merit(graph, setting, wanted.time, is_small, &choice.breaks_down),
            None => (usize::MAX, is_small, Count::TOO_MANY),
        };
        let is_valid_everywhere = merit.2 == 0;
        if found.as_ref().is_none_or(|(least, _)| merit < *least) {
            found = Some((merit, Suggested { dependent, judged }));
        }
        if is_valid_everywhere {
            break;
        }
    }
    found.map(|(_, suggested)| suggested)
}

/// How many factors vanish at times that no motion avoids, whether the pivots are small near the origin, and how much
/// there is to read and to avoid in all: less is better.
type Merit = (usize, bool, Count);

fn merit(
    graph: &Graph,
    setting: &PivotSetting<'_>,
    time: SymbolId,
    is_small: bool,
    factors: &[ExprId],
) -> Merit {
    let is_avoidable = |factor: &ExprId| {
        let mut symbols = graph.symbols_in(&[*factor]).into_iter();
        symbols.any(|symbol| symbol != time && !setting.parameters.contains(&symbol))
    };
    let unavoidable = factors.iter().filter(|factor| !is_avoidable(factor)).count();
    let length = factors.iter().map(|factor| graph.operation_count(&[*factor]) + FACTOR).sum();
    (unavoidable, is_small, length)
}

/// A set of columns, ascending.
type Columns = Vec<usize>;

/// Those that are not small near the origin first, then shorter pivots, then those that keep what is declared first.
type Key = (bool, Count, Reverse<Vec<usize>>);

/// What choices are ranked by.
struct Ranking {
    /// Φ at a point of the field.
    exact: Vec<Vec<Residue>>,
    /// Φ of one machine near the origin of the coordinates, and at other points.
    values: [Vec<Vec<Vec<f64>>>; 2],
    /// The operations of an entry.
    lengths: Vec<Vec<Count>>,
}

impl Ranking {
    fn of(graph: &Graph, setting: &PivotSetting<'_>, wanted: &Wanted<'_>) -> Option<Self> {
        let exact = graph.matrix_in_field(setting.on_base, |seed| FieldPoint::random(7_000 + seed)).ok()?;
        let length = |entry: &ExprId| graph.operation_count(&[*entry]);
        let lengths = setting.annihilator.iter().map(|row| row.iter().map(length).collect()).collect();
        let values =
            [1.0 / 16.0, 1.5].map(|reach| values(graph, wanted.off_positions, setting.parameters, reach));
        Some(Self { exact, values, lengths })
    }

    /// The choices to judge, the most promising first; whether they are small near the origin, as others are not.
    fn first(&self, wanted: &Wanted<'_>) -> Vec<(bool, Vec<SectionId>)> {
        let rank = self.exact.first().map_or(0, Vec::len);
        let columns: Columns =
            (0..rank).filter(|column| !wanted.kept.contains(&SectionId::from_index(*column))).collect();
        let regular: Vec<(Columns, f64)> = self
            .candidates(&columns)
            .into_iter()
            .filter(|columns| columns.len() == self.exact.len() && self.is_regular(columns))
            .map(|columns| {
                let share = self.share(&columns);
                (columns, share)
            })
            .collect();
        let best = regular.iter().map(|(_, share)| *share).fold(f64::NEG_INFINITY, f64::max);
        // where every choice is nearly singular near the origin, as loops of links in line are, it tells nothing
        let least = if best < -DEGENERATE.ln() { f64::NEG_INFINITY } else { best - SHARE.ln() };
        let mut keys: Vec<Key> =
            regular.into_iter().map(|(columns, share)| self.key(columns, share < least)).collect();
        keys.sort();
        let sections = |(is_small, _, Reverse(columns)): Key| -> (bool, Vec<SectionId>) {
            (is_small, columns.into_iter().rev().map(SectionId::from_index).collect())
        };
        keys.into_iter().take(JUDGED).map(sections).collect()
    }

    /// All choices among these columns if they are not too many, else one that is regular and those that differ from it
    /// in one velocity.
    fn candidates(&self, columns: &Columns) -> Vec<Columns> {
        let size = self.exact.len();
        let of = |set: Vec<SectionId>| -> Columns { set.into_iter().map(|id| columns[id.index()]).collect() };
        let all: Vec<Columns> = Subsets::of(columns.len(), size).take(LIMIT + 1).map(of).collect();
        if all.len() <= LIMIT {
            return all;
        }
        // the last that are regular
        let last: Columns = columns.iter().rev().copied().collect();
        let pivots = Echelon::of(minor(&self.exact, &last)).pivots;
        let mut start: Columns = pivots.into_iter().map(|pivot| last[pivot]).collect();
        start.sort_unstable();
        let mut found = vec![start.clone()];
        for place in 0..start.len() {
            for column in columns.iter().filter(|column| !start.contains(column)) {
                let mut exchanged = start.clone();
                exchanged[place] = *column;
                exchanged.sort_unstable();
                found.push(exchanged);
            }
        }
        found.truncate(LIMIT);
        found
    }

    fn is_regular(&self, columns: &Columns) -> bool {
        determinant_in_field(minor(&self.exact, columns)) != Residue::ZERO
    }

    /// The logarithm of what the determinant is near the origin, in the mean, of the largest that it is anywhere.
    fn share(&self, columns: &Columns) -> f64 {
        let logarithms = self.values.each_ref().map(|points| -> Vec<f64> {
            points.iter().map(|rows| log_determinant(minor(rows, columns))).collect()
        });
        let largest = logarithms.iter().flatten().copied().fold(f64::NEG_INFINITY, f64::max);
        let near = if logarithms[0].is_empty() { &logarithms[1] } else { &logarithms[0] };
        if near.is_empty() || largest == f64::NEG_INFINITY {
            return f64::NEG_INFINITY;
        }
        #[allow(clippy::cast_precision_loss, reason = "a few points")]
        let count = near.len() as f64;
        near.iter().sum::<f64>() / count - largest
    }

    fn key(&self, mut columns: Columns, is_small: bool) -> Key {
        let length = self.length(&columns);
        columns.reverse();
        (is_small, length, Reverse(columns))
    }

    /// What the pivots come to, by their blocks, before anything is multiplied out.
    fn length(&self, columns: &Columns) -> Count {
        spend(columns.len());
        let pattern: Vec<Vec<bool>> = minor(&self.exact, columns)
            .into_iter()
            .map(|row| row.into_iter().map(|entry| entry != Residue::ZERO).collect())
            .collect();
        let Some(blocks) = triangular_blocks(&pattern) else { return Count::TOO_MANY };
        let of_block = |(rows, unknowns): &(Vec<usize>, Vec<usize>)| -> Count {
            let entries =
                rows.iter().flat_map(|row| unknowns.iter().map(|u| self.lengths[*row][columns[*u]]));
            let size = rows.len() as u64;
            entries.sum::<Count>() * size + (size * size - 1)
        };
        blocks.iter().map(of_block).sum()
    }
}

/// The matrix with these columns alone.
fn minor<T: Copy>(rows: &[Vec<T>], columns: &Columns) -> Vec<Vec<T>> {
    rows.iter().map(|row| columns.iter().map(|column| row[*column]).collect()).collect()
}

/// A matrix for one machine at points whose coordinates reach so far, where it has values.
fn values(graph: &Graph, matrix: &Matrix, parameters: &[SymbolId], reach: f64) -> Vec<Vec<Vec<f64>>> {
    let entries: Vec<ExprId> = matrix.concat();
    let symbols = graph.symbols_in(&entries);
    let mut evaluator = graph.evaluator(&entries);
    let mut found = Vec::new();
    for point in 0..POINTS {
        let value = |symbol: SymbolId| {
            let index = symbols.iter().position(|known| *known == symbol).unwrap_or_default();
            if parameters.contains(&symbol) {
                sample(0, index)
            } else {
                let word = Residue::mixed(8_000 + point, index as u64).word();
                #[allow(clippy::cast_precision_loss, reason = "any number between 1/2 and 1")]
                let size = 0.5 + 0.5 * word as f64 / Residue::ORDER as f64;
                if word.is_multiple_of(2) { reach * size } else { -reach * size }
            }
        };
        let mut entries = evaluator.at(value).into_iter().map(|entry| entry.value);
        let rows: Vec<Vec<f64>> =
            matrix.iter().map(|row| entries.by_ref().take(row.len()).collect()).collect();
        if rows.iter().flatten().all(|entry| entry.is_finite()) {
            found.push(rows);
        }
    }
    found
}

/// ln |det|, by elimination with partial pivoting.
fn log_determinant(mut rows: Vec<Vec<f64>>) -> f64 {
    let mut logarithm = 0.0;
    spend(rows.len());
    for column in 0..rows.len() {
        let largest =
            (column..rows.len()).max_by(|a, b| rows[*a][column].abs().total_cmp(&rows[*b][column].abs()));
        let Some(largest) = largest else { return f64::NEG_INFINITY };
        rows.swap(column, largest);
        let leading = rows[column].clone();
        logarithm += leading[column].abs().ln();
        if !logarithm.is_finite() {
            return f64::NEG_INFINITY;
        }
        for row in rows.iter_mut().skip(column + 1) {
            let factor = row[column] / leading[column];
            for (entry, lead) in row.iter_mut().zip(&leading) {
                *entry -= factor * lead;
            }
        }
    }
    logarithm
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::Facts;

    /// A chain y_k = cos(q) y_{k+1} of twelve constraints among thirty velocities, of which there are 86 million choices.
    #[test]
    fn choices_that_are_too_many_are_not_all_looked_at() {
        let mut g = Graph::new();
        let (q, time) = (g.new_symbol("q"), g.new_symbol("t"));
        let angle = g.symbol(q);
        let (cos, sin, zero) = (g.cos(angle), g.sin(angle), g.zero());
        let mut annihilator: Matrix = vec![vec![zero; 30]; 12];
        for (k, row) in annihilator.iter_mut().enumerate() {
            (row[k], row[k + 1]) = (sin, cos);
        }
        let facts = Facts::default();
        let setting =
            PivotSetting { annihilator: &annihilator, on_base: &annihilator, parameters: &[], facts: &facts };
        let wanted = Wanted { off_positions: &annihilator, time, kept: &[] };
        let found = suggested(&mut g, &setting, &wanted).expect("a choice");
        let choice = found.judged.expect("short pivots");
        // the first velocity is kept
        assert_eq!(found.dependent, (1..=12).map(SectionId::from_index).collect::<Vec<_>>());
        assert_eq!(choice.breaks_down, [cos]);
        let kept = [SectionId::from_index(12)];
        let found = suggested(&mut g, &setting, &Wanted { kept: &kept, ..wanted }).expect("a choice");
        assert!(!found.dependent.contains(&kept[0]), "{found:?}");
    }

    #[test]
    fn near_the_origin_a_cosine_is_no_sine() {
        let mut g = Graph::new();
        let (q, time) = (g.new_symbol("q"), g.new_symbol("t"));
        let angle = g.symbol(q);
        let (cos, sin) = (g.cos(angle), g.sin(angle));
        let facts = Facts::default();
        for (row, expected) in [(vec![sin, cos], 1), (vec![cos, sin], 0)] {
            let annihilator = vec![row];
            let setting = PivotSetting {
                annihilator: &annihilator,
                on_base: &annihilator,
                parameters: &[],
                facts: &facts,
            };
            let wanted = Wanted { off_positions: &annihilator, time, kept: &[] };
            let found = suggested(&mut g, &setting, &wanted).expect("a choice");
            assert_eq!(found.dependent, [SectionId::from_index(expected)]);
            assert_eq!(found.judged.expect("short pivots").breaks_down, [cos]);
        }
    }
}
