//! Reductions between declared systems: proved by `morphism!`, and seen on trajectories.

mod morphisms {
    mod bodies;
    mod brackets;
    mod elsewhere;
    mod fibres;
    mod invariant_frames;
    mod motors;
    mod planar;
    mod quotients;
    mod shared_lets;
    mod support;
}
