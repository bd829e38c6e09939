//! The systems that the benchmark of record has too are the same there.

use nh_accuracy::measured::{Level, Measured};
use nh_accuracy::systems::{bodies, tractors};
use nh_bench::runner::{self, AGREEMENT, Run};

/// Compares the derivative with the hand-written one of the benchmark, whose parameters are taken in
/// this order.
fn same<S: Measured>(contest: &[Box<dyn Run>], order: impl Fn(&[f64]) -> Vec<f64>) {
    let entry = contest.iter().find(|entry| entry.name() == S::NAME).expect("it is in the benchmark");
    let data = entry.data();
    let parameters = order(&data.parameters);
    assert_eq!(parameters.len(), S::NUMBERS.parameters, "{}", S::NAME);
    for [state, input, by_hand, _] in &data.samples {
        let found = S::Balanced::derivative(&parameters, state, input);
        assert_eq!(found.len(), by_hand.len(), "{}", S::NAME);
        for (found, expected) in found.iter().zip(by_hand) {
            let off = (found - expected).abs();
            assert!(off <= AGREEMENT * (1.0 + expected.abs()), "{}: {found} for {expected}", S::NAME);
        }
    }
}

#[test]
fn the_fixed_systems() {
    let contest = runner::all();
    same::<bodies::sleigh::Levels>(&contest, <[f64]>::to_vec);
    same::<bodies::veselova::Levels>(&contest, <[f64]>::to_vec);
    same::<bodies::snakeboard::Levels>(&contest, <[f64]>::to_vec);
    same::<bodies::robot::Levels>(&contest, <[f64]>::to_vec);
    same::<bodies::ball::Levels>(&contest, <[f64]>::to_vec);
}

#[test]
fn the_tractors() {
    // m, J and a of the tractor, then m, J and d of each trailer; here by kinds
    let by_kind = |p: &[f64]| {
        let (tractor, trailers) = p.split_at(3);
        let of_trailers = |kind: usize| trailers.iter().skip(kind).step_by(3).copied();
        [tractor[0]]
            .into_iter()
            .chain(of_trailers(0))
            .chain([tractor[1]])
            .chain(of_trailers(1))
            .chain(of_trailers(2))
            .chain([tractor[2]])
            .collect()
    };
    let contest = runner::all();
    same::<tractors::one::Levels>(&contest, by_kind);
    same::<tractors::two::Levels>(&contest, by_kind);
    same::<tractors::three::Levels>(&contest, by_kind);
    same::<tractors::four::Levels>(&contest, by_kind);
    same::<tractors::five::Levels>(&contest, by_kind);
    same::<tractors::six::Levels>(&contest, by_kind);
}
