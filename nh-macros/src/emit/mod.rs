//! Stage 8, emit: a verified system and its names to tokens.
//!
//! After this point there are items that name everything by absolute paths, allocate nothing and
//! cannot panic. One file per kind of item; `scope.rs` and `program.rs` turn straight-line programs
//! into statements for all of them.

mod layout;

pub(crate) use layout::{Family, Layout, TypeNames};
