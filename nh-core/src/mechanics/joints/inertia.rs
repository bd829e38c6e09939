//! Inertias of bodies about the origin of their axes, rigid and articulated.
//!
//! What carries the origin with the acceleration a and turns at ω̇ has, of Gauss's function, the part
//! ½ ω̇ᵀΘω̇ + ω̇ᵀH a + ½ aᵀM a; of a rigid body M = m 1, H = ĥ with h = m d, and Θ = I + m (d² 1 − d dᵀ).

use super::sheet::{Sheet, Square, Vector, mirrored, transposed};
use super::turning::Turning;
use crate::id::ExprId;

/// A direction of accelerations (ω̇, a), or a force along these: a moment about the origin, and a force.
pub(super) type Twist = [Vector; 2];

/// Θ, H and M.
#[derive(Clone, Debug)]
pub(super) enum Inertia {
    /// Of bodies that do not move in each other.
    Rigid { mass: ExprId, moment: Vector, turning: Square },
    /// Of such that move as the forces on them do.
    Articulated { turning: Square, coupling: Square, mass: Square },
}

impl Inertia {
    pub(super) fn none(sheet: &mut Sheet) -> Self {
        let zero = sheet.zero();
        Self::Rigid { mass: zero[0], moment: zero, turning: [zero; 3] }
    }

    /// Θ, H, M.
    fn parts(&self, sheet: &mut Sheet) -> [Square; 3] {
        match self {
            Self::Rigid { mass, moment, turning } => {
                let zero = sheet.graph.zero();
                let round =
                    std::array::from_fn(|i| std::array::from_fn(|j| if i == j { *mass } else { zero }));
                [*turning, sheet.hat(moment), round]
            }
            Self::Articulated { turning, coupling, mass } => [*turning, *coupling, *mass],
        }
    }

    pub(super) fn plus(&self, sheet: &mut Sheet, other: &Self) -> Self {
        if let (
            Self::Rigid { mass, moment, turning },
            Self::Rigid { mass: more, moment: further, turning: other },
        ) = (self, other)
        {
            let mass = sheet.graph.formula(mass + more);
            let moment = sheet.sum(*moment, *further);
            return Self::Rigid { mass, moment, turning: sum(sheet, turning, other) };
        }
        let (one, other) = (self.parts(sheet), other.parts(sheet));
        let [turning, coupling, mass] = std::array::from_fn(|k| sum(sheet, &one[k], &other[k]));
        Self::Articulated { turning, coupling, mass }
    }

    /// With its entries as intermediate results.
    pub(super) fn named(&self, sheet: &mut Sheet) -> Self {
        match self {
            Self::Rigid { mass, moment, turning } => Self::Rigid {
                mass: sheet.named("mass", *mass),
                moment: sheet.named_all("moment", *moment),
                turning: named_symmetric(sheet, turning),
            },
            Self::Articulated { turning, coupling, mass } => Self::Articulated {
                turning: named_symmetric(sheet, turning),
                coupling: coupling.map(|row| sheet.named_all("inertia", row)),
                mass: named_symmetric(sheet, mass),
            },
        }
    }

    /// The force (Θ ω̇ + H a, Hᵀω̇ + M a).
    pub(super) fn force(&self, sheet: &mut Sheet, [turning, along]: &Twist) -> Twist {
        if let Self::Rigid { mass, moment, turning: theta } = self {
            let (turned, levered) = (sheet.image(theta, turning), sheet.cross(moment, along));
            let (moved, carried) = (sheet.scaled(*mass, *along), sheet.cross(turning, moment));
            return [sheet.sum(turned, levered), sheet.sum(moved, carried)];
        }
        let [theta, coupling, mass] = self.parts(sheet);
        let (turned, levered) = (sheet.image(&theta, turning), sheet.image(&coupling, along));
        let (carried, moved) = (sheet.image(&transposed(&coupling), turning), sheet.image(&mass, along));
        [sheet.sum(turned, levered), sheet.sum(carried, moved)]
    }

    /// Less U Uᵀ/D, of what moves without resistance along a direction: U is the force that belongs to that, and
    /// `shares` are U/D.
    pub(super) fn without(&self, sheet: &mut Sheet, force: &Twist, shares: &Twist) -> Self {
        let parts = self.parts(sheet);
        let one = sheet.graph.one();
        let mut less = |part: usize, [u, v]: [usize; 2]| -> Square {
            std::array::from_fn(|i| {
                std::array::from_fn(|j| {
                    // a share of 1 cancels
                    let (share, of) = if shares[v][j] == one {
                        (shares[v][j], force[u][i])
                    } else {
                        (shares[u][i], force[v][j])
                    };
                    sheet.graph.formula(parts[part][i][j] - share * of)
                })
            })
        };
        let (turning, coupling, mass) = (less(0, [0, 0]), less(1, [0, 1]), less(2, [1, 1]));
        Self::Articulated { turning: mirrored(&turning), coupling, mass: mirrored(&mass) }
    }

    /// In the axes of what carries it, about the origin there.
    pub(super) fn carried(&self, sheet: &mut Sheet, turning: &Turning, r: &Vector) -> Self {
        match self {
            Self::Rigid { mass, moment, turning: theta } => {
                let moment = turning.inward(sheet, *moment);
                let moment = sheet.named_all("moment", moment);
                let theta = turning.of_symmetric(sheet, theta);
                rigid_about(sheet, (*mass, moment, theta), r)
            }
            Self::Articulated { turning: theta, coupling, mass } => {
                let theta = turning.of_symmetric(sheet, theta);
                let coupling = turning.of_square(sheet, coupling);
                let mass = turning.of_symmetric(sheet, mass);
                let (coupling, mass) =
                    (coupling.map(|row| sheet.named_all("inertia", row)), named_symmetric(sheet, &mass));
                // H + r̂ M, Θ − H r̂ + r̂ (H + r̂ M)ᵀ
                let columns = transposed(&mass).map(|column| sheet.cross(r, &column));
                let moved = transposed(&columns);
                let moved = sum(sheet, &coupling, &moved);
                let moved = moved.map(|row| sheet.named_all("inertia", row));
                let back = coupling.map(|row| sheet.cross(r, &row));
                let forth = transposed(&moved.map(|row| sheet.cross(r, &row)));
                let theta = sum(sheet, &theta, &back);
                let theta = sum(sheet, &theta, &forth);
                Self::Articulated { turning: mirrored(&theta), coupling: moved, mass }
            }
        }
    }
}

/// About an origin from which the old one is at r: m, h + m r, Θ + r·(h + h') 1 − r hᵀ − h' rᵀ.
fn rigid_about(sheet: &mut Sheet, (mass, moment, theta): (ExprId, Vector, Square), r: &Vector) -> Inertia {
    let shift = sheet.scaled(mass, *r);
    let shifted = sheet.sum(moment, shift);
    let moved = sheet.named_all("moment", shifted);
    let twice = sheet.sum(moment, moved);
    let squares: Vector = std::array::from_fn(|k| sheet.graph.formula(r[k] * twice[k]));
    let mut turning = theta;
    for i in 0..3 {
        let others = sheet.graph.formula(squares[(i + 1) % 3] + squares[(i + 2) % 3]);
        turning[i][i] = sheet.graph.formula(theta[i][i] + others);
        for j in i + 1..3 {
            turning[i][j] = sheet.graph.formula(theta[i][j] - r[i] * moment[j] - moved[i] * r[j]);
        }
    }
    Inertia::Rigid { mass, moment: moved, turning: mirrored(&turning) }
}

fn sum(sheet: &mut Sheet, a: &Square, b: &Square) -> Square {
    std::array::from_fn(|i| sheet.sum(a[i], b[i]))
}

fn named_symmetric(sheet: &mut Sheet, a: &Square) -> Square {
    let mut named = *a;
    for i in 0..3 {
        for j in i..3 {
            named[i][j] = sheet.named("inertia", a[i][j]);
        }
    }
    mirrored(&named)
}

/// A force on what is carried, as one on what carries it.
pub(super) fn force_carried(sheet: &mut Sheet, turning: &Turning, r: &Vector, force: Twist) -> Twist {
    let [moment, along] = force.map(|part| {
        let part = turning.inward(sheet, part);
        sheet.named_all("force", part)
    });
    let lever = sheet.cross(r, &along);
    [sheet.sum(moment, lever), along]
}

/// Accelerations of what carries, as those of what it carries along.
pub(super) fn acceleration_carried(sheet: &mut Sheet, turning: &Turning, r: &Vector, by: Twist) -> Twist {
    let [turned, along] = by;
    let lever = sheet.cross(&turned, r);
    let moved = sheet.sum(along, lever);
    [turned, moved].map(|part| turning.outward(sheet, part))
}

/// The power of a force along a direction.
pub(super) fn power(sheet: &mut Sheet, direction: &Twist, force: &Twist) -> ExprId {
    let (turning, along) = (sheet.dot(&direction[0], &force[0]), sheet.dot(&direction[1], &force[1]));
    sheet.graph.formula(turning + along)
}
