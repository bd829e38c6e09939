//! What vanishes on manifolds, and what does not.

use super::*;

fn symbols(graph: &mut Graph, names: &[&str]) -> Vec<SymbolId> {
    names.iter().map(|name| graph.new_symbol(*name)).collect()
}

#[test]
fn the_sphere_and_a_plane_through_it() {
    let mut g = Graph::new();
    let all = symbols(&mut g, &["g1", "g2", "g3", "w1", "w2", "w3"]);
    let e: Vec<ExprId> = all.iter().map(|s| g.symbol(*s)).collect();
    let (norm, one) = (g.inner_product(&e[..3], &e[..3]), g.one());
    let sphere = g.formula(norm - one);
    let plane = g.inner_product(&e[..3], &e[3..]);
    let mut manifold = Manifold::where_zero(&mut g, &[sphere], &all[..3]).unwrap();
    let tangent = Manifold::where_zero(&mut g, &[plane], &all[3..]).unwrap();
    manifold.extend(&mut g, &tangent);
    // |g × w|² = |g|²|w|² − (g·w)² = |w|²
    let mut cross = Vec::new();
    for i in 0..3 {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let (x, y) = (g.formula(e[j] * e[3 + k]), g.formula(e[k] * e[3 + j]));
        cross.push(g.formula(x - y));
    }
    let (left, right) = (g.inner_product(&cross, &cross), g.inner_product(&e[3..], &e[3..]));
    let defect = g.formula(left - right);
    assert!(!g.zero_test(defect).is_zero());
    assert!(manifold.zero_test(&mut g, defect).is_zero());
    assert!(manifold.zero_test(&mut g, left).is_nonzero());
}

#[test]
fn rotation_matrices() {
    let mut g = Graph::new();
    let names: Vec<String> = (0..9).map(|i| format!("R{i}")).collect();
    let all = symbols(&mut g, &names.iter().map(String::as_str).collect::<Vec<_>>());
    let e: Vec<ExprId> = all.iter().map(|s| g.symbol(*s)).collect();
    let column = |j: usize| [e[j], e[3 + j], e[6 + j]];
    let one = g.one();
    let mut identities = Vec::new();
    for i in 0..3 {
        for j in i..3 {
            let product = g.inner_product(&column(i), &column(j));
            identities.push(if i == j { g.formula(product - one) } else { product });
        }
    }
    let manifold = Manifold::where_zero(&mut g, &identities, &all).unwrap();
    // the determinant is 1
    let matrix: Matrix = e.chunks(3).map(<[ExprId]>::to_vec).collect();
    let determinant = g.small_determinant(&matrix);
    let defect = g.formula(determinant - one);
    assert!(manifold.zero_test(&mut g, defect).is_zero());
}

/// Two of them, with their identities in turn, and a direction.
#[test]
fn several_embedded_families() {
    let mut g = Graph::new();
    let names: Vec<String> = (0..21).map(|i| format!("x{i}")).collect();
    let all = symbols(&mut g, &names.iter().map(String::as_str).collect::<Vec<_>>());
    let e: Vec<ExprId> = all.iter().map(|s| g.symbol(*s)).collect();
    let one = g.one();
    let mut identities = vec![g.inner_product(&e[18..], &e[18..])];
    for i in 0..3 {
        for j in i..3 {
            for first in [0, 9] {
                let row = |k: usize| &e[first + 3 * k..first + 3 * k + 3];
                identities.push(g.inner_product(row(i), row(j)));
                if i == j {
                    let last = identities.len() - 1;
                    identities[last] = g.formula(identities[last] - one);
                }
            }
        }
    }
    identities[0] = g.formula(identities[0] - one);
    let manifold = Manifold::where_zero(&mut g, &identities, &all).unwrap();
    for first in [0, 9] {
        let matrix: Matrix = e[first..first + 9].chunks(3).map(<[ExprId]>::to_vec).collect();
        let determinant = g.small_determinant(&matrix);
        let defect = g.formula(determinant - one);
        assert!(manifold.zero_test(&mut g, defect).is_zero());
    }
    assert!(manifold.zero_test(&mut g, identities[0]).is_zero());
    let height = g.formula(e[20] - one);
    assert!(!manifold.zero_test(&mut g, height).is_zero());
}

#[test]
fn constant_speed() {
    let mut g = Graph::new();
    let all = symbols(&mut g, &["x", "y", "c"]);
    let e: Vec<ExprId> = all.iter().map(|s| g.symbol(*s)).collect();
    let (speed, c) = (g.inner_product(&e[..2], &e[..2]), g.square(e[2]));
    let function = g.formula(speed - c);
    let manifold = Manifold::where_zero(&mut g, &[function], &all[..2]).unwrap();
    assert!(manifold.zero_test(&mut g, function).is_zero());
}
