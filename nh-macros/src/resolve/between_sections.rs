//! What is known of the lines between the sections, and what their values contain.

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use super::array::Array;
use super::context::{Context, Usage};
use crate::syntax::ast::Let;

/// Something in a shared value that not every section may use.
#[derive(Clone, Debug)]
pub(super) struct Contained {
    pub(super) usage: Usage,
    /// As it is written.
    pub(super) written: String,
    /// The shared names that lead to it, the outermost first.
    pub(super) path: Vec<String>,
}

/// What a shared value contains: one example of each kind.
#[derive(Clone, Debug, Default)]
pub(super) struct Contents {
    pub(super) found: Vec<Contained>,
}

impl Contents {
    pub(super) fn add(&mut self, contained: Contained) {
        if self.found.iter().all(|known| known.usage != contained.usage) {
            self.found.push(contained);
        }
    }
}

/// A shared value, with what it contains.
pub(super) type Known = (Rc<Array>, Rc<Contents>);

/// What is known of a `let` between the sections.
#[derive(Clone, Debug)]
pub(super) enum State {
    /// Nothing yet.
    Unread,
    /// Its value.
    Read(Known),
    /// That it is in error, which was reported.
    Broken,
}

/// The lines between the sections.
#[derive(Debug, Default)]
pub(super) struct Shared {
    pub(super) lines: Vec<Rc<Let>>,
    /// For each line, the lines that it names.
    pub(super) needs: Vec<Vec<usize>>,
    pub(super) states: Vec<State>,
    /// Functions that were called.
    pub(super) called: BTreeSet<usize>,
    /// What was said already of what lines contain.
    pub(super) told: BTreeSet<String>,
    /// The values of functions that were called with these arguments.
    pub(super) values: BTreeMap<(usize, Vec<Array>), Option<Known>>,
    /// The functions whose values are read, the outermost first.
    pub(super) calling: Vec<usize>,
    /// What is found in the values that are read, the outermost first.
    pub(super) recording: Vec<Contents>,
    /// The section that uses the value that is read.
    pub(super) user: Option<Context>,
}

impl Shared {
    /// Whether a value between the sections is read.
    pub(super) fn reading(&self) -> bool {
        !self.recording.is_empty()
    }

    /// The section that uses what is read, if that stands between the sections.
    pub(super) fn user(&self) -> Option<Context> {
        self.user
    }

    /// Remembers what is found in the value that is read.
    pub(super) fn record(&mut self, usage: Usage, written: &str) {
        if let Some(contents) = self.recording.last_mut() {
            contents.add(Contained { usage, written: written.to_owned(), path: Vec::new() });
        }
    }
}
