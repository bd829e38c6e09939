//! The choice of the independent velocities, and the judgement of one, of velocities or of coordinates.

use super::pivot::{PivotSetting, PivotZeros};
use crate::algebra::{Graph, Residue, determinant_in_field};
use crate::id::{ExprId, Id, SectionId};

/// Which velocities the constraints are solved for, or which coordinates.
#[derive(Clone, Debug)]
pub struct Choice<I = SectionId> {
    /// The velocities to eliminate.
    pub dependent: Vec<I>,
    /// Expressions of parameters that must not vanish.
    pub conditions: Vec<ExprId>,
    /// Where one of these vanishes the constraints are dependent.
    pub rank_drops: Vec<ExprId>,
    /// Where the choice breaks down although the constraints are independent; empty unless the
    /// user made the choice.
    pub breaks_down: Vec<ExprId>,
}

impl<I> Choice<I> {
    fn of(dependent: Vec<I>) -> Self {
        Self { dependent, conditions: Vec::new(), rank_drops: Vec::new(), breaks_down: Vec::new() }
    }

    /// Adds the zeros of a pivot.
    fn record(&mut self, zeros: PivotZeros) {
        let kinds = [
            (&mut self.conditions, zeros.conditions),
            (&mut self.rank_drops, zeros.rank_drops),
            (&mut self.breaks_down, zeros.elsewhere),
        ];
        for (known, more) in kinds {
            for factor in more {
                if !known.contains(&factor) {
                    known.push(factor);
                }
            }
        }
    }
}

/// Why there is no choice valid everywhere.
#[derive(Clone, Debug, Default)]
pub struct NoChoice {
    /// For the choices tried, the velocities to eliminate and the factor of the pivot that may
    /// vanish.
    pub tried: Vec<(Vec<SectionId>, ExprId)>,
}

/// How many sets of velocities are considered.
const LIMIT: usize = 4096;
/// For how many of them the zeros of the pivot are studied.
const STUDIED: usize = 24;

/// The values of Φ at two points that differ in everything.
struct Samples(Vec<Vec<Vec<Residue>>>);

impl Samples {
    fn of(graph: &Graph, setting: &PivotSetting<'_>) -> Result<Self, String> {
        [5_000, 6_000]
            .into_iter()
            .map(|start| graph.matrix_at_random(setting.on_base, start))
            .collect::<Result<_, _>>()
            .map(Self)
    }

    /// The sets of as many velocities as there are constraints, those that are `required` in all of them and the last
    /// declared ones first. What stands in no constraint is in none.
    fn candidates(&self, rank: usize, required: &[SectionId]) -> impl Iterator<Item = Vec<SectionId>> {
        let rows = || self.0.iter().flatten();
        let occurs = |column: SectionId| rows().any(|row| row[column.index()] != Residue::ZERO);
        let columns = (0..rank).map(SectionId::from_index);
        let free: Vec<SectionId> =
            columns.filter(|column| !required.contains(column) && occurs(*column)).collect();
        let size = self.0.first().map_or(0, Vec::len);
        let subsets = size.checked_sub(required.len()).map(|size| Subsets::of(free.len(), size));
        let required = required.to_vec();
        subsets.into_iter().flatten().map(move |subset| {
            let chosen = subset.into_iter().map(|k| free[k.index()]);
            let mut members: Vec<SectionId> = required.iter().copied().chain(chosen).collect();
            members.sort_unstable();
            members
        })
    }

    /// Whether the columns are independent at generic points.
    fn are_independent<I: Id>(&self, columns: &[I]) -> bool {
        self.0.iter().any(|rows| {
            let minor = rows.iter().map(|row| columns.iter().map(|c| row[c.index()]).collect()).collect();
            determinant_in_field(minor) != Residue::ZERO
        })
    }
}

/// Judges the user's choice: `None` if the constraints do not determine these velocities.
///
/// # Errors
/// The reason, where the algebra cannot evaluate the constraints.
pub fn judge<I: Id>(
    graph: &mut Graph,
    setting: &PivotSetting<'_>,
    dependent: &[I],
) -> Result<Option<Choice<I>>, String> {
    if !Samples::of(graph, setting)?.are_independent(dependent) {
        return Ok(None);
    }
    let mut choice = Choice::of(dependent.to_vec());
    for pivot in pivots(graph, setting, dependent) {
        choice.record(setting.zeros(graph, pivot));
    }
    Ok(Some(choice))
}

/// Searches for velocities whose pivot vanishes nowhere that the constraints are independent, the
/// last declared first; those in `preferred` are eliminated if any such choice contains them.
///
/// # Errors
/// The reason, where the algebra cannot evaluate the constraints.
pub fn search(
    graph: &mut Graph,
    setting: &PivotSetting<'_>,
    preferred: &[SectionId],
    rank: usize,
) -> Result<Result<Choice, NoChoice>, String> {
    let samples = Samples::of(graph, setting)?;
    let mut failure = NoChoice::default();
    let rounds: &[&[SectionId]] = if preferred.is_empty() { &[&[]] } else { &[preferred, &[]] };
    for required in rounds {
        let mut studied = 0;
        for dependent in samples.candidates(rank, required).take(LIMIT) {
            if !samples.are_independent(&dependent) {
                continue;
            }
            studied += 1;
            if studied > STUDIED {
                break;
            }
            match study(graph, setting, &dependent) {
                Ok(choice) => return Ok(Ok(choice)),
                Err(factor) => failure.tried.push((dependent, factor)),
            }
        }
    }
    Ok(Err(failure))
}

fn study(graph: &mut Graph, setting: &PivotSetting<'_>, dependent: &[SectionId]) -> Result<Choice, ExprId> {
    let mut choice = Choice::of(dependent.to_vec());
    for pivot in pivots(graph, setting, dependent) {
        choice.record(setting.zeros(graph, pivot));
        if let Some(factor) = choice.breaks_down.first() {
            return Err(*factor);
        }
    }
    Ok(choice)
}

/// The block determinants of the columns.
fn pivots<I: Id>(graph: &mut Graph, setting: &PivotSetting<'_>, dependent: &[I]) -> Vec<ExprId> {
    let matrix: Vec<Vec<ExprId>> =
        setting.annihilator.iter().map(|row| dependent.iter().map(|c| row[c.index()]).collect()).collect();
    let nothing: Vec<Vec<ExprId>> = vec![Vec::new(); matrix.len()];
    graph.solve_linear(&matrix, &nothing).map(|solution| solution.divisors).unwrap_or_default()
}

/// The subsets of a given size, those of the last elements first.
pub(crate) struct Subsets {
    rank: usize,
    next: Option<Vec<usize>>,
}

impl Subsets {
    /// Of the first `rank` numbers.
    pub(crate) fn of(rank: usize, size: usize) -> Self {
        Self { rank, next: (size <= rank).then(|| (rank - size..rank).rev().collect()) }
    }
}

impl Iterator for Subsets {
    type Item = Vec<SectionId>;

    /// Members descend; the successor lowers the last member that can be lowered.
    fn next(&mut self) -> Option<Self::Item> {
        let current = self.next.take()?;
        let size = current.len();
        let lowered = (0..size).rev().find(|position| current[*position] > size - 1 - position);
        self.next = lowered.map(|position| {
            let mut following = current.clone();
            let top = following[position] - 1;
            for (step, member) in following[position..].iter_mut().enumerate() {
                *member = top - step;
            }
            following
        });
        debug_assert!(current.iter().all(|member| *member < self.rank));
        let mut members: Vec<SectionId> = current.into_iter().map(SectionId::from_index).collect();
        members.sort_unstable();
        Some(members)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::Facts;

    #[test]
    fn subsets_start_with_the_last() {
        let all: Vec<Vec<usize>> =
            Subsets::of(4, 2).map(|set| set.into_iter().map(Id::index).collect()).collect();
        assert_eq!(all, [[2, 3], [1, 3], [0, 3], [1, 2], [0, 2], [0, 1]]);
        assert_eq!(Subsets::of(3, 0).count(), 1);
        assert_eq!(Subsets::of(2, 3).count(), 0);
    }

    #[test]
    fn few_of_many_velocities_are_found() {
        // forty velocities, of which the first ones are equal
        let mut g = Graph::new();
        let (zero, one) = (g.zero(), g.one());
        let minus = g.formula(-one);
        let row = |k: usize| {
            (0..40)
                .map(|c| {
                    if c == k {
                        one
                    } else if c == k + 1 {
                        minus
                    } else {
                        zero
                    }
                })
                .collect()
        };
        let annihilator: Vec<Vec<ExprId>> = (0..3).map(row).collect();
        let facts = Facts::default();
        let setting =
            PivotSetting { annihilator: &annihilator, on_base: &annihilator, parameters: &[], facts: &facts };
        let found = |g: &mut Graph, preferred: &[usize]| {
            let preferred: Vec<_> = preferred.iter().map(|k| SectionId::from_index(*k)).collect();
            let choice = search(g, &setting, &preferred, 40).unwrap().unwrap();
            choice.dependent.into_iter().map(Id::index).collect::<Vec<_>>()
        };
        assert_eq!(found(&mut g, &[]), [1, 2, 3]);
        assert_eq!(found(&mut g, &[0, 1, 2]), [0, 1, 2]);
        assert_eq!(found(&mut g, &[1]), [1, 2, 3]);
    }

    #[test]
    fn a_pivot_may_vanish_where_the_constraints_are_dependent() {
        // the snakeboard's wheels in the body frame: velocities theta, u1, u2
        let mut g = Graph::new();
        let (phi, l) = (g.new_symbol("phi"), g.new_symbol("l"));
        let (ephi, el) = (g.symbol(phi), g.symbol(l));
        let (s, c) = (g.sin(ephi), g.cos(ephi));
        let (ms, lc) = (g.formula(-s), g.formula(el * c));
        let mlc = g.formula(-lc);
        let annihilator = vec![vec![mlc, ms, c], vec![lc, s, c]];
        let facts = Facts::default();
        let setting = PivotSetting {
            annihilator: &annihilator,
            on_base: &annihilator,
            parameters: &[l],
            facts: &facts,
        };
        let choice = search(&mut g, &setting, &[], 3).unwrap().unwrap();
        assert_eq!(choice.dependent, [SectionId::from_index(0), SectionId::from_index(2)]);
        assert_eq!(choice.conditions, [el]);
    }

    #[test]
    fn a_knife_edge_has_no_choice() {
        let mut g = Graph::new();
        let theta = g.new_symbol("theta");
        let theta = g.symbol(theta);
        let (s, c) = (g.sin(theta), g.cos(theta));
        let minus = g.formula(-c);
        let annihilator = vec![vec![s, minus]];
        let facts = Facts::default();
        let setting =
            PivotSetting { annihilator: &annihilator, on_base: &annihilator, parameters: &[], facts: &facts };
        let failure = search(&mut g, &setting, &[], 2).unwrap().unwrap_err();
        assert_eq!(failure.tried.len(), 2);
    }
}
