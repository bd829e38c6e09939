//! Shared drawing code of the examples.
