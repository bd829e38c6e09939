//! A linkage assembled from guesses that are far off, some of them where it cannot reach: what is found holds, and what is
//! held stays, or it is refused.

use nonholonomic::AssemblyError;
use nonholonomic::prelude::*;

/// Four bars, and a slide over the end of the crank, which reaches no farther than that is long.
#[nonholonomic(
    base { a, b, c, x }
    holonomic {
        across: l1 * cos(a) + l2 * cos(b) - l3 * cos(c) = d;
        along: l1 * sin(a) + l2 * sin(b) - l3 * sin(c) = 0;
        slide: x = l1 * cos(a);
    }
    lagrangian { m / 2 * (l1^2 * der(a)^2 + l2^2 * der(b)^2 + l3^2 * der(c)^2 + der(x)^2) }
)]
#[derive(Clone, Copy, Debug)]
struct Slide {
    m: f64,
    l1: f64,
    l2: f64,
    l3: f64,
    d: f64,
}

const SLIDE: Slide = Slide { m: 1.0, l1: 0.4, l2: 1.1, l3: 0.8, d: 1.0 };

/// A guess with numbers from −3.14 to 3.14.
#[allow(clippy::approx_constant)] // the hard guesses are these to the last digit
fn guess(number: u32) -> SlideState {
    let random = |place: u32| 6.28 * (f64::from(number * 7 + place) * 0.754_877_666).fract() - 3.14;
    let [a, b, c, x, a_dot, b_dot] = [1, 2, 3, 4, 5, 6].map(random);
    SlideState { a, b, c, x, a_dot, b_dot, ..SlideState::default() }
}

#[test]
fn what_is_assembled_holds() {
    use SlideCoordinate::{a, b, c, x};
    let mut found = 0;
    // where steps of 10⁹ and more come between
    let hard = [447, 671, 1441, 1912, 3100, 3569, 3661, 3779];
    for number in (0..40).chain(hard) {
        let guess = guess(number);
        for held in [a, b, c, x] {
            let case = format!("{number}, {held:?}");
            let Ok(state) = SLIDE.assemble_holding(0.0, &guess, &[held]) else { continue };
            found += 1;
            let size = state.a.abs() + state.b.abs() + state.c.abs();
            let left = Constrained::constraint_residual(&SLIDE, 0.0, &state);
            assert!(left.iter().all(|left| left.abs() <= 4e-15 * (1.0 + size)), "{case}: {left:?} {state:?}");
            let of = |state: &SlideState| match held {
                a => state.a,
                b => state.b,
                c => state.c,
                x => state.x,
            };
            assert_eq!(of(&state).to_bits(), of(&guess).to_bits(), "{case}");
        }
    }
    assert!(found > 50, "{found}");
}

#[test]
fn a_slide_beyond_the_crank_is_out_of_reach() {
    for number in (0..40).chain([447, 1912, 3100, 3569, 3661, 3779]) {
        let guess = guess(number);
        if guess.x.abs() > 0.4 {
            let refused = SLIDE.assemble_holding(0.0, &guess, &[SlideCoordinate::x]);
            let is_told =
                matches!(refused, Err(AssemblyError::NoSolution { .. } | AssemblyError::Singular { .. }));
            assert!(is_told, "{number}: {refused:?}");
        }
    }
}
