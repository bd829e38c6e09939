//! Derivatives of motions, against closed forms and against whole integrations in numbers that carry derivatives.

// bits are meant, counts are small, and motions have the types of their closures
#![allow(clippy::float_cmp, clippy::cast_precision_loss, clippy::type_complexity)]

mod adjoints;
mod columns;
mod events;
mod implicit;
mod models;
