//! The lines of a section: `let` and `for` around statements.

use std::rc::Rc;

use nonholonomic_core::count::Count;

use super::array::{Array, Shape};
use super::context::Context;
use super::reports::{Outcome, Reported};
use super::resolver::Resolver;
use super::scope::Meaning;
use crate::report::Diagnostic;
use crate::syntax::ast::{Binder, Item, Let};

/// The statements of a section, in order, as they are written.
pub(super) fn statements<T>(items: &[Item<T>]) -> Vec<&T> {
    let mut found = Vec::new();
    for item in items {
        match item {
            Item::Let(_) => {}
            Item::For(block) => found.extend(statements(&block.items)),
            Item::One(statement) => found.push(statement),
        }
    }
    found
}

/// The lets of a section, in order, as they are written.
pub(super) fn lets<T>(items: &[Item<T>]) -> Vec<&Let> {
    let mut found = Vec::new();
    for item in items {
        match item {
            Item::Let(line) => found.push(line),
            Item::For(block) => found.extend(lets(&block.items)),
            Item::One(_) => {}
        }
    }
    found
}

impl Resolver {
    /// Visits every statement of a section, once for all values of the variables around it.
    pub(super) fn section<T>(
        &mut self,
        context: Context,
        items: &[Item<T>],
        visit: &mut dyn FnMut(&mut Self, &T) -> Outcome<()>,
    ) {
        self.context = context;
        self.items(items, visit);
    }

    fn items<T>(&mut self, items: &[Item<T>], visit: &mut dyn FnMut(&mut Self, &T) -> Outcome<()>) {
        let depth = self.scope.depth();
        for item in items {
            self.open_conditions();
            // an item in error was reported; the others go on
            let _ = match item {
                Item::Let(line) => self.abbreviation(line),
                Item::For(block) => {
                    self.each_value(&block.binders, &mut |this| this.items(&block.items, visit))
                }
                Item::One(statement) => visit(self, statement),
            };
            self.close_conditions();
        }
        self.scope.leave(depth);
    }

    /// `let name = …;`, bound even in error, so that its uses are not reported too.
    pub(super) fn abbreviation(&mut self, line: &Let) -> Outcome<()> {
        let checked = self.scope.check_new(&line.name);
        let fresh = self.keep(&line.name, checked);
        self.open_conditions();
        let value = self.abbreviated(line);
        self.abbreviates(&line.name.text);
        self.close_conditions();
        fresh?;
        let meaning = value.as_ref().map_or(Meaning::Broken, |value| Meaning::Value(Rc::new(value.clone())));
        self.scope.bind(&line.name.text, meaning);
        value.map(|_| ())
    }

    pub(super) fn abbreviated(&mut self, line: &Let) -> Outcome<Array> {
        let mut entries: Vec<(Vec<i64>, Array)> = Vec::new();
        let mut failed = false;
        let depth = self.scope.loop_values().len();
        self.each_value(&line.binders, &mut |this| match this.value(&line.value) {
            Ok(value) => entries.push((this.scope.loop_values().split_off(depth), value)),
            Err(Reported) => failed = true,
        })?;
        if failed {
            return Err(Reported);
        }
        self.assembled(line, entries)
    }

    /// The array whose entries stand at these indices.
    fn assembled(&mut self, line: &Let, entries: Vec<(Vec<i64>, Array)>) -> Outcome<Array> {
        let of_entry = entries.first().map_or(Shape::Number, |(_, first)| first.shape);
        let mut shape = of_entry;
        let lengths = self.lengths(&line.binders, &entries)?;
        for length in lengths.iter().rev() {
            let Some(more) = shape.times(*length) else {
                let name = &line.name.text;
                let error = Diagnostic::new(line.extent, "a `let` has at most two indices")
                    .evidence(format!("each of its entries is {of_entry}"))
                    .way_out(format!(
                        "make it a function, `let {name}(a) = …;` between the sections, whose argument is what differs, \
                         or define single entries"
                    ));
                return Err(self.report(line, error));
            };
            shape = more;
        }
        let entries: Vec<_> = entries.into_iter().flat_map(|(_, value)| value.entries).collect();
        if entries.len() != shape.len() {
            let error = Diagnostic::new(line.extent, "the entries of this `let` have different shapes");
            return Err(self.report(line, error));
        }
        Ok(Array { shape, entries })
    }

    /// The lengths of an array whose indices count from 0 without gaps.
    fn lengths(&mut self, binders: &[Binder], entries: &[(Vec<i64>, Array)]) -> Outcome<Vec<usize>> {
        let values = |k: usize| entries.iter().filter_map(move |(indices, _)| indices.get(k).copied());
        let bounds = |k: usize| (values(k).min().unwrap_or(0), values(k).max().map_or(0, |most| most + 1));
        let lengths: Vec<usize> = (0..binders.len())
            .map(bounds)
            .map(|(least, end)| usize::try_from(end.saturating_sub(least)).unwrap_or(0))
            .collect();
        if let Some(last) = binders.last()
            && lengths.iter().copied().map(Count::from).product::<Count>() != Count::from(entries.len())
        {
            let error = Diagnostic::new(last.extent, "the rows of a `let` have the same length")
                .way_out("let the second range not depend on the first index");
            return Err(self.report(last, error));
        }
        if let Some((_, binder)) = binders.iter().enumerate().find(|(k, _)| bounds(*k).0 != 0) {
            let error = Diagnostic::new(binder.extent, "the indices of a `let` count from 0")
                .way_out(format!("write `{} in 0..…`, and shift the index in the value", binder.name.text));
            return Err(self.report(binder, error));
        }
        Ok(lengths)
    }
}
