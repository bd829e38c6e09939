//! That nothing depends on the coordinates along a group, or what does and how.

use super::quotient::{Equation, QuotientDecl};
use super::side::Side;
use crate::algebra::{Graph, Matrix, Rational, Substitution, Verdict};
use crate::check::evidence::{name_of, not_zero, shown};
use crate::compile::Proved;
use crate::geometry::{Change, ChangeOfBasis, Varies, constant_along};
use crate::id::{ExprId, Id, Origin, SymbolId};
use crate::violation::{Law, Violation};

/// Takes the dropped coordinates out of expressions, and collects what depends on them.
pub(super) struct Invariant<'a> {
    /// The full system.
    pub(super) side: &'a mut Side,
    /// The dropped coordinates.
    pub(super) dropped: Vec<SymbolId>,
    /// What was found.
    pub(super) violations: Vec<Violation>,
    origin: Origin,
    renaming: Substitution,
    no_frame: Option<String>,
}

impl<'a> Invariant<'a> {
    /// With the reason why no frame was derived from declared symmetries.
    pub(super) fn of(side: &'a mut Side, declared: &QuotientDecl, no_frame: Option<String>) -> Self {
        let coordinates = &side.proved.model.coordinates;
        let dropped = declared.dropped.iter().map(|id| coordinates[*id].symbol).collect();
        let mut images = Vec::new();
        for (id, name) in &declared.renamed {
            let graph = &mut side.proved.model.graph;
            let fresh = graph.new_symbol(name.clone());
            images.push((side.proved.model.coordinates[*id].symbol, graph.symbol(fresh)));
        }
        let renaming = Substitution::new(images);
        Self { side, dropped, violations: Vec::new(), origin: declared.origin, renaming, no_frame }
    }

    /// The expression without the dropped coordinates; `what` it is, where it depends on them.
    pub(super) fn checked(&mut self, value: ExprId, what: &str) -> ExprId {
        match self.without(value) {
            Ok(value) => {
                let value = self.renaming.apply(self.side.graph(), value);
                self.side.graph().simplify(value)
            }
            Err(Varies { along, change: change @ (Change::OnFibres | Change::NotExpressed) }) => {
                let graph = &mut self.side.proved.model.graph;
                let value = graph.simplify(value);
                let (name, shown) = (graph.symbols()[along].clone(), shown(graph, value));
                if matches!(change, Change::OnFibres) {
                    let evidence = format!(
                        "it is {shown}, which changes on the embedded base where the coordinates that are left do not"
                    );
                    self.depends(format!("{what} depends on `{name}`"), evidence);
                } else {
                    let evidence = format!(
                        "it is {shown}: constant along what is dropped, but no polynomial in the coordinates that are \
                         left was found for it"
                    );
                    let way_out = "write it in the full system in the coordinates that the quotient has";
                    self.refuse(format!("{what} could not be written without `{name}`"), evidence, way_out);
                }
                value
            }
            Err(Varies { along, change: Change::By(slope, verdict) }) => {
                let graph = &mut self.side.proved.model.graph;
                let (value, slope) = (graph.simplify(value), graph.simplify(slope));
                // by a parameter of the embedded base, which has no name that was declared
                if !self.dropped.contains(&along) {
                    let occurs = |symbol: &&SymbolId| graph.depends_on(value, &[**symbol]);
                    let first = self.dropped.iter().find(occurs).copied().unwrap_or(along);
                    let name = graph.symbols()[first].clone();
                    let evidence = format!(
                        "it is {}, which changes along what is dropped of the embedded base",
                        shown(graph, value)
                    );
                    self.depends(format!("{what} depends on `{name}`"), evidence);
                    return value;
                }
                let name = graph.symbols()[along].clone();
                let defect = match &verdict {
                    Verdict::NonZero(witness) => not_zero(graph, slope, witness),
                    _ => format!("{} should be 0", shown(graph, slope)),
                };
                let evidence = format!("it is {}; its derivative by `{name}` {defect}", shown(graph, value));
                self.depends(format!("{what} depends on `{name}`"), evidence);
                value
            }
        }
    }

    /// Records what depends on the dropped coordinates.
    fn depends(&mut self, what: String, evidence: String) {
        let way_out = match &self.no_frame {
            Some(reason) => format!(
                "drop fewer coordinates, or give invariant `velocities {{ … }}`: from the declared symmetries no frame \
                 was derived, since {reason}"
            ),
            None => "drop fewer coordinates, give invariant `velocities { … }`, or declare the symmetries that move \
                     them in `symmetries` of the full system"
                .into(),
        };
        self.refuse(what, evidence, &way_out);
    }

    /// Records what stands in the way.
    pub(super) fn refuse(&mut self, what: String, evidence: String, way_out: &str) {
        self.violations.push(Violation {
            law: Law::Invariance,
            origin: self.origin,
            what,
            evidence,
            way_out: way_out.into(),
        });
    }

    /// The expression at one place of the group, where it is the same at all of them.
    fn without(&mut self, value: ExprId) -> Result<ExprId, Varies> {
        let Proved { model, base, .. } = &mut self.side.proved;
        constant_along(&mut model.graph, base, value, &self.dropped)
    }
}

/// D in the frame: the constraints as they are where they are invariant; where only D is, in the form
/// that is solved for velocities, which D alone determines. Rates of position constraints are left to these.
pub(super) fn constraints(
    invariant: &mut Invariant<'_>,
    velocities: &[SymbolId],
    change: &ChangeOfBasis,
    in_frame: &mut Substitution,
) -> Vec<Equation> {
    let residuals = invariant.side.residuals();
    let zero = invariant.side.graph().zero();
    let mut as_declared = Vec::new();
    let mut broken = None;
    let of_positions = invariant.side.proved.model.positions.len();
    for (index, residual) in residuals.into_iter().enumerate().skip(of_positions) {
        let value = in_frame.apply(invariant.side.graph(), residual);
        let label =
            invariant.side.proved.model.constraints.get(Id::from_index(index)).and_then(|c| c.label.clone());
        match invariant.without(value) {
            Ok(_) => as_declared.push((label, value, index)),
            Err(_) => broken = broken.or(Some(index)),
        }
    }
    let linear = linear(invariant, change, in_frame);
    if let (Some(_), Some((rows, drift))) = (broken, linear)
        && let Some(solved) = solved(invariant, velocities, &rows, &drift)
    {
        return solved;
    }
    if let Some(index) = broken {
        let model = &invariant.side.proved.model;
        let id = Id::from_index(index);
        let name = if model.constraints.get(id).is_some() { name_of(model, id) } else { "D".into() };
        let residual = invariant.side.residuals()[index];
        let value = in_frame.apply(invariant.side.graph(), residual);
        invariant.checked(value, &name);
        return Vec::new();
    }
    as_declared
        .into_iter()
        .map(|(label, value, _)| Equation {
            label,
            left: invariant.checked(value, "a constraint"),
            right: zero,
        })
        .collect()
}

/// Φ Ψ and b, where the constraints are linear or affine.
fn linear(
    invariant: &mut Invariant<'_>,
    change: &ChangeOfBasis,
    in_frame: &mut Substitution,
) -> Option<(Matrix, Vec<ExprId>)> {
    let linear = match &invariant.side.distribution {
        Some(distribution) => distribution.constraints.clone(),
        None => invariant.side.proved.constraints.linear.clone()?,
    };
    let of_positions = invariant.side.proved.model.positions.len();
    let graph = invariant.side.graph();
    let columns = Graph::transposed(&change.sections);
    let mut rows = Matrix::new();
    for row in linear.annihilator.iter().skip(of_positions) {
        let mut new = Vec::new();
        for column in &columns {
            let entry = graph.inner_product(row, column);
            new.push(graph.simplify(entry));
        }
        rows.push(new);
    }
    let drift = in_frame.apply_all(graph, linear.drift.get(of_positions..).unwrap_or_default());
    Some((rows, drift))
}

/// The constraints solved for velocities whose pivot vanishes nowhere, or at least not everywhere;
/// `None` where that depends on the dropped coordinates.
fn solved(
    invariant: &mut Invariant<'_>,
    velocities: &[SymbolId],
    rows: &Matrix,
    drift: &[ExprId],
) -> Option<Vec<Equation>> {
    let (count, width) = (rows.len(), velocities.len());
    let pick = |columns: &[usize]| -> Matrix {
        rows.iter().map(|row| columns.iter().map(|column| row[*column]).collect()).collect()
    };
    let mut chosen: Option<Vec<usize>> = None;
    for columns in subsets(width, count) {
        let minor = pick(&columns);
        if invariant.side.rank_over_base(&minor) != Ok(count) {
            continue;
        }
        let facts = invariant.side.proved.facts.clone();
        let graph = invariant.side.graph();
        let good = count <= 3 && {
            let determinant = graph.small_determinant(&minor);
            let determinant = graph.simplify(determinant);
            graph.vanishes_nowhere(determinant, &facts)
        };
        if good {
            chosen = Some(columns);
            break;
        }
        chosen.get_or_insert(columns);
    }
    let pivots = chosen?;
    let others: Vec<usize> = (0..width).filter(|column| !pivots.contains(column)).collect();
    let mut right = pick(&others);
    right.iter_mut().zip(drift).for_each(|(row, drift)| row.push(*drift));
    let solution = invariant.side.graph().solve_linear(&pick(&pivots), &right)?;
    let mut equations = Vec::new();
    for (pivot, row) in pivots.iter().zip(solution.values) {
        let graph = invariant.side.graph();
        let mut terms: Vec<(Rational, ExprId)> = Vec::new();
        for (entry, column) in row.iter().zip(&others) {
            let velocity = graph.symbol(velocities[*column]);
            terms.push((Rational::MINUS_ONE, graph.formula(entry * velocity)));
        }
        terms.extend(row.last().map(|drift| (Rational::MINUS_ONE, *drift)));
        let value = graph.linear_combination(&terms);
        invariant.without(value).ok()?;
        let right = invariant.checked(value, "D");
        let left = invariant.side.graph().symbol(velocities[*pivot]);
        equations.push(Equation { label: None, left, right });
    }
    Some(equations)
}

/// Subsets of a size, those of the last columns first, not too many.
fn subsets(width: usize, size: usize) -> Vec<Vec<usize>> {
    const LIMIT: usize = 400;
    let mut found = Vec::new();
    let mut stack = vec![(width, Vec::new())];
    while let Some((below, chosen)) = stack.pop() {
        if chosen.len() == size {
            found.push(chosen.into_iter().rev().collect());
            if found.len() == LIMIT {
                break;
            }
            continue;
        }
        // pushed in ascending order, so that the last column is tried first
        for column in 0..below {
            let mut more: Vec<usize> = chosen.clone();
            more.push(column);
            stack.push((column, more));
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::subsets;

    #[test]
    fn the_last_columns_come_first() {
        assert_eq!(subsets(3, 2), [vec![1, 2], vec![0, 2], vec![0, 1]]);
        assert_eq!(subsets(2, 0), [Vec::<usize>::new()]);
    }
}
