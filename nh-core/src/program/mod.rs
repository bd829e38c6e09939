//! Straight-line programs: what is emitted, and what the interpreter runs.
