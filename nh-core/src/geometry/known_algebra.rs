//! The Lie algebras that `brackets so(3) { … }` and its kin refer to.

/// A Lie algebra known by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum KnownAlgebra {
    /// Rotations of n-space. For n = 3 the basis is (w1, w2, w3) with `[w1, w2] = w3` and cyclic;
    /// for n ≥ 4 it is e_ij, i < j, in lexicographic order.
    So(usize),
    /// Planar rigid motions in the order (ω, v1, v2).
    Se2,
    /// Rigid motions of space in the order (w1, w2, w3, v1, v2, v3).
    Se3,
    /// Traceless 2 × 2 matrices in the order (h, e, f).
    Sl2,
    /// The Heisenberg algebra of dimension 2n + 1 in the order (x…, y…, z).
    Heisenberg(usize),
}

/// `[e_left, e_right] = Σ coefficient · e_index`, by positions in the basis, `left < right`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct KnownBracket {
    /// The first section.
    pub left: usize,
    /// The second section.
    pub right: usize,
    /// The terms of the bracket.
    pub terms: Vec<(usize, i64)>,
}

impl KnownAlgebra {
    /// Names accepted in a declaration.
    pub const NAMES: [&'static str; 5] = ["so", "se", "sl", "heisenberg", "so(n)"];
    /// Largest n of `so(n)` and `heisenberg(n)`: the number of brackets grows like n³.
    pub const MAX_RANK: usize = 32;

    /// The algebra `name(n)`, if it is known.
    #[must_use]
    pub fn named(name: &str, n: usize) -> Option<Self> {
        match (name, n) {
            ("so", 3..=Self::MAX_RANK) => Some(Self::So(n)),
            ("se", 2) => Some(Self::Se2),
            ("se", 3) => Some(Self::Se3),
            ("sl", 2) => Some(Self::Sl2),
            ("heisenberg", 1..=Self::MAX_RANK) => Some(Self::Heisenberg(n)),
            _ => None,
        }
    }

    /// The number of sections it takes.
    #[must_use]
    pub fn dimension(self) -> usize {
        match self {
            Self::So(n) => n * (n - 1) / 2,
            Self::Se2 | Self::Sl2 => 3,
            Self::Se3 => 6,
            Self::Heisenberg(n) => 2 * n + 1,
        }
    }

    /// The non-zero brackets of basis elements.
    #[must_use]
    pub fn brackets(self) -> Vec<KnownBracket> {
        let bracket = |left, right, terms: &[(usize, i64)]| KnownBracket { left, right, terms: terms.into() };
        match self {
            Self::So(3) => {
                vec![bracket(0, 1, &[(2, 1)]), bracket(0, 2, &[(1, -1)]), bracket(1, 2, &[(0, 1)])]
            }
            Self::So(n) => rotations(n),
            Self::Se2 => vec![bracket(0, 1, &[(2, 1)]), bracket(0, 2, &[(1, -1)])],
            Self::Se3 => rigid_motions(),
            Self::Sl2 => vec![bracket(0, 1, &[(1, 2)]), bracket(0, 2, &[(2, -2)]), bracket(1, 2, &[(0, 1)])],
            Self::Heisenberg(n) => (0..n).map(|i| bracket(i, n + i, &[(2 * n, 1)])).collect(),
        }
    }
}

/// `[e_ij, e_kl] = δ_jk e_il + δ_il e_jk − δ_ik e_jl − δ_jl e_ik` with e_ij = E_ij − E_ji.
fn rotations(n: usize) -> Vec<KnownBracket> {
    let pairs: Vec<(usize, usize)> = (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j))).collect();
    let position = |i: usize, j: usize| {
        let (low, high, sign) = if i < j { (i, j, 1) } else { (j, i, -1) };
        pairs.iter().position(|pair| *pair == (low, high)).map(|index| (index, sign))
    };
    let mut brackets = Vec::new();
    for (left, &(i, j)) in pairs.iter().enumerate() {
        for (right, &(k, l)) in pairs.iter().enumerate().skip(left + 1) {
            let candidates = [(j == k, i, l, 1), (i == l, j, k, 1), (i == k, j, l, -1), (j == l, i, k, -1)];
            let terms: Vec<(usize, i64)> = candidates
                .into_iter()
                .filter(|(applies, ..)| *applies)
                .filter_map(|(_, a, b, sign)| position(a, b).map(|(index, turned)| (index, sign * turned)))
                .collect();
            if !terms.is_empty() {
                brackets.push(KnownBracket { left, right, terms });
            }
        }
    }
    brackets
}

/// `[w_i, w_j] = ε_ijk w_k`, `[w_i, v_j] = ε_ijk v_k`.
fn rigid_motions() -> Vec<KnownBracket> {
    let mut brackets = Vec::new();
    for i in 0..3 {
        for j in 0..3 {
            let (k, sign) = match (3 + j - i) % 3 {
                1 => ((i + 2) % 3, 1),
                2 => ((i + 1) % 3, -1),
                _ => continue,
            };
            if i < j {
                brackets.push(KnownBracket { left: i, right: j, terms: vec![(k, sign)] });
            }
            brackets.push(KnownBracket { left: i, right: 3 + j, terms: vec![(3 + k, sign)] });
        }
    }
    brackets.sort_by_key(|bracket| (bracket.left, bracket.right));
    brackets
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The structure constants as a dense table.
    fn table(algebra: KnownAlgebra) -> Vec<Vec<Vec<i64>>> {
        let n = algebra.dimension();
        let mut c = vec![vec![vec![0; n]; n]; n];
        for KnownBracket { left, right, terms } in algebra.brackets() {
            assert!(left < right);
            for (index, coefficient) in terms {
                c[left][right][index] += coefficient;
                c[right][left][index] -= coefficient;
            }
        }
        c
    }

    /// Checks mathematics (3).
    #[test]
    fn all_satisfy_jacobi() {
        let all = [
            KnownAlgebra::So(3),
            KnownAlgebra::So(4),
            KnownAlgebra::So(5),
            KnownAlgebra::Se2,
            KnownAlgebra::Se3,
            KnownAlgebra::Sl2,
            KnownAlgebra::Heisenberg(2),
        ];
        for algebra in all {
            let c = table(algebra);
            let n = algebra.dimension();
            let double = |a: usize, b: usize, d: usize, e: usize| -> i64 {
                (0..n).map(|m| c[b][d][m] * c[a][m][e]).sum()
            };
            for a in 0..n {
                for b in 0..n {
                    for d in 0..n {
                        for e in 0..n {
                            let jacobi = double(a, b, d, e) + double(b, d, a, e) + double(d, a, b, e);
                            assert_eq!(jacobi, 0, "{algebra:?}");
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn signs_are_those_of_the_documentation() {
        let se3 = table(KnownAlgebra::Se3);
        assert_eq!((se3[0][1][2], se3[1][2][0], se3[2][0][1]), (1, 1, 1));
        assert_eq!((se3[0][4][5], se3[1][3][5], se3[2][3][4]), (1, -1, 1));
        // so(4): e_01, e_02, e_03, e_12, e_13, e_23; [e_01, e_12] = e_02
        assert_eq!(table(KnownAlgebra::So(4))[0][3][1], 1);
    }
}
