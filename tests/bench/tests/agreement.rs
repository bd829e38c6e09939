//! The contestants compute the same function.

#[test]
fn emitted_and_hand_written_derivatives_agree() {
    for system in nh_bench::runner::all() {
        system.compare().unwrap();
    }
}
