//! Products of a Jacobian with vectors, against derivatives along directions in numbers.

use super::super::proof::{Defect, at_points, bits_of_a_point, defined, run};
use super::super::reference::inner;
use super::procedure_derivative::tangent;
use crate::algebra::{Degrees, Direction, FieldPass, FieldPoint, Graph, Radicands, Residue};
use crate::choose::Proof;
use crate::id::SymbolId;
use crate::mechanics::Procedure;
use crate::system::{Side, VectorProduct};

/// Proves that a product is J w, or Jᵀ p by what it is along a random direction, of a function of some arguments.
///
/// # Errors
/// What is wrong, or why it could not be decided.
pub(crate) fn prove_product(
    graph: &Graph,
    function: &Procedure,
    arguments: &[SymbolId],
    product: &VectorProduct,
) -> Result<Proof, Defect> {
    let VectorProduct { side, vector, procedure } = product;
    let roots = [function.expressions(), procedure.expressions()].concat();
    let division = graph.angle_division(&roots);
    let degree_of = |procedure: &Procedure| procedure.degree(&mut Degrees::new(graph, division));
    let terms = f64::from(u32::try_from(arguments.len() + vector.len()).unwrap_or(u32::MAX));
    // a derivative has at most three times the degree of its function
    let degree = terms * (3.0 * degree_of(function) + degree_of(procedure));
    let determined = [defined(function), defined(procedure)].concat();
    let bits = bits_of_a_point(graph, (&roots, &determined), &[function, procedure], degree, division)?;
    let radicands = Radicands::of(graph, &roots, &determined);
    let at = |point: FieldPoint| -> Result<(), Defect> {
        let pass = || FieldPass::new(graph, point.clone(), division);
        let here = pass();
        let known: Vec<Residue> = vector.iter().map(|symbol| here.symbol(*symbol)).collect();
        let direction: Vec<Residue> = match side {
            Side::Right => known.clone(),
            Side::Left => {
                let places = 0..arguments.len() as u64;
                places.map(|k| here.kernel("direction", &[Residue::of_word(k)])).collect()
            }
        };
        let along: Direction = arguments.iter().copied().zip(direction.iter().copied()).collect();
        let changes: Vec<Residue> =
            tangent(&mut pass(), function, along)?.into_iter().map(|dual| dual.rate).collect();
        let found = run(&mut pass(), procedure)?;
        let is_so = match side {
            Side::Right => found == changes,
            Side::Left => inner(&found, &direction) == inner(&known, &changes),
        };
        if is_so { Ok(()) } else { Err(Defect::Wrong("it is not the product with the Jacobian".into())) }
    };
    let point = |seed| radicands.point_in(seed, |point| FieldPass::new(graph, point, division));
    at_points(bits, point, at)
}
