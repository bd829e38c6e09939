//! A copy of a system, for what keeps one beside what was computed from it.

/// A system whose parameters can be kept by value: any that is `Copy`.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not `Copy`",
    label = "its parameters are kept beside what is computed from them",
    note = "write `#[derive(Clone, Copy)]` before the struct: `emit {{ prepared }}` and `emit {{ angle_cache }}` ask for it"
)]
pub trait KeptParameters: Copy {}

// the trait itself is named in an error, with its way out, and not that a struct has no `Copy`
#[diagnostic::do_not_recommend]
impl<S: Copy> KeptParameters for S {}

/// The copy.
#[inline]
pub fn kept_parameters<S: KeptParameters>(system: &S) -> S {
    *system
}
