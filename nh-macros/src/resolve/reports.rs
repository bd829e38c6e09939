//! Errors of this stage: each place in the declaration is reported once, however often `for` and
//! `sum` come by, and whatever an error spoils is not reported again.

use std::collections::{BTreeMap, BTreeSet};

use crate::report::{Diagnostic, Errors, Extent};
use crate::syntax::ast::Expr;

/// Proof that the reason was reported: what depends on the value gives up without a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Reported;

/// A value, or an error that was reported.
pub(super) type Outcome<T> = Result<T, Reported>;

/// Errors after which the rest is not looked at: nobody reads more.
const ENOUGH: usize = 200;

/// Steps of resolving: a node of an expression visited, an operand of a new one. An honest
/// declaration takes some thousands; an unoptimised macro does these in about a second.
const STEPS: usize = 400_000;

/// The errors, and the work that may still be done.
#[derive(Debug)]
pub(super) struct Reports {
    errors: Errors,
    /// Places reported already: address and size of the node, which lives as long as the stage.
    places: BTreeSet<(usize, usize)>,
    /// Mistakes that are told once: what is written there, how many errors there were before that about it, and in how
    /// many more places it stands.
    told_once: BTreeMap<String, (String, usize, usize)>,
    steps: usize,
    /// What is added to errors at present: the arguments of the function that is read.
    note: Option<String>,
}

impl Reports {
    /// Nothing reported, nothing spent.
    pub(super) fn new() -> Self {
        Self {
            errors: Errors::new(),
            places: BTreeSet::new(),
            told_once: BTreeMap::new(),
            steps: STEPS,
            note: None,
        }
    }

    /// Reports an error about a node of the declaration, unless there was one.
    pub(super) fn report<T>(&mut self, node: &T, error: Diagnostic) -> Reported {
        if self.places.insert((std::ptr::from_ref(node).addr(), size_of::<T>())) {
            self.errors.push(match &self.note {
                Some(note) => error.because(note.clone()),
                None => error,
            });
        }
        if self.places.len() >= ENOUGH {
            self.steps = 0;
        }
        Reported
    }

    /// Reports a name that stands for nothing, where it stands first: a declaration that is missing is one mistake,
    /// however often what it declares is used.
    pub(super) fn report_unknown<T>(&mut self, node: &T, name: &str, error: Diagnostic) -> Reported {
        self.report_once(node, name, (String::new(), error))
    }

    /// Reports what is `written` in a section that has no place for it, where it stands there first.
    pub(super) fn report_unsuited<T>(
        &mut self,
        node: &T,
        written: &str,
        (section, error): (&str, Diagnostic),
    ) -> Reported {
        self.report_once(node, written, (format!(" in {section}"), error))
    }

    /// Reports a mistake at its first place: what is written there, with what tells it from others in the same words.
    fn report_once<T>(&mut self, node: &T, written: &str, (of, error): (String, Diagnostic)) -> Reported {
        let place = (std::ptr::from_ref(node).addr(), size_of::<T>());
        let mistake = format!("{written}{of}");
        if let Some((_, _, more)) = self.told_once.get_mut(&mistake) {
            *more += usize::from(self.places.insert(place));
            return Reported;
        }
        let before = self.errors.len();
        let reported = self.report(node, error);
        if self.errors.len() > before {
            self.told_once.insert(mistake, (written.to_owned(), before, 0));
        }
        reported
    }

    /// Adds this to errors from here on; what was added before is given back.
    pub(super) fn annotate(&mut self, note: Option<String>) -> Option<String> {
        std::mem::replace(&mut self.note, note)
    }

    /// Reports an error about something that is missing, which is no node.
    pub(super) fn report_missing(&mut self, error: Diagnostic) {
        self.places.insert((0, self.places.len()));
        self.errors.push(error);
    }

    /// Refuses all further work: an error was reported, and the rest is not worth looking at.
    pub(super) fn stop(&mut self) {
        self.steps = 0;
    }

    /// Whether this stage goes wrong.
    pub(super) fn any(&self) -> bool {
        !self.places.is_empty()
    }

    /// The work that was done: all that may be, where it was refused.
    pub(super) fn steps_taken(&self) -> usize {
        STEPS - self.steps
    }

    /// Does some work, which is refused when there was too much.
    pub(super) fn spend(&mut self, at: Extent, steps: usize) -> Outcome<()> {
        if let Some(left) = self.steps.checked_sub(steps) {
            self.steps = left;
            return Ok(());
        }
        if self.steps > 0 || !self.any() {
            self.steps = 0;
            self.places.insert((0, 0));
            self.errors.push(
                Diagnostic::new(at, format!("this declaration is too large, because up to here it takes more than {STEPS} steps to write out"))
                    .way_out("shorten the ranges of `sum` and `for`, or use fewer bodies"),
            );
        }
        Err(Reported)
    }

    /// Does the work of visiting an expression.
    pub(super) fn visit(&mut self, expr: &Expr) -> Outcome<()> {
        self.spend(expr.extent, 1)
    }

    /// The value if nothing went wrong, else the errors.
    pub(super) fn finish<T>(mut self, value: T) -> Result<T, Vec<Diagnostic>> {
        for (written, error, more) in self.told_once.into_values() {
            if more > 0 {
                let places =
                    if more == 1 { "one more place".to_owned() } else { format!("{more} more places") };
                self.errors.because(error, format!("`{written}` stands in {places}"));
            }
        }
        self.errors.finish(value)
    }
}
