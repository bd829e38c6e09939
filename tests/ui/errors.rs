//! What a user reads when a declaration is wrong.
//!
//! Each file `<kind>/<what_is_wrong>.rs` has one mistake, and beside it what the compiler says.
//! After a change of wording, `TRYBUILD=overwrite cargo test -p nh-errors` writes the texts
//! anew; read the difference before it is committed. Only messages of the macro are pinned here: a
//! message of the compiler itself changes with its version. What has to compile stands in
//! `tests/tests/exotic_declarations.rs`: with one such case among these, every case is a build of its own.

#[test]
fn errors_are_in_the_words_of_the_field() {
    trybuild::TestCases::new().compile_fail("*/*.rs");
}
