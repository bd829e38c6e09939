//! Generated code and the integrator leave the heap alone.

use nh_tests::systems::catalogue;

#[test]
fn nothing_is_allocated() {
    for entry in catalogue() {
        let reference = entry.reference();
        for set in reference.parameter_sets.iter().filter(|set| entry.covers(&set.values)) {
            let sample = &set.samples[0];
            let state: Vec<f64> = entry.state(&sample.state).iter().map(|x| x.value).collect();
            entry.exercise(&set.values, sample.t, &state, &mut |work| {
                let allocations = allocation_counter::measure(work).count_total;
                assert_eq!(allocations, 0, "{} ({})", entry.name(), set.name);
            });
        }
    }
}

#[test]
fn the_counter_counts() {
    let allocations = allocation_counter::measure(|| {
        std::hint::black_box(Vec::<f64>::with_capacity(1));
    });
    assert_eq!(allocations.count_total, 1);
}
