//! Definitions `name = …;` that declare their names: outputs and velocities by a coframe. The
//! left-hand sides imply families: `w[0] = …; w[1] = …;`, `w[i in 0..3] = …;`, or a vector on the
//! right-hand side.

use std::collections::BTreeMap;
use std::ops::Range;

use nonholonomic_core::id::ExprId;

use super::array::{Array, Shape};
use super::context::Context;
use super::reports::Outcome;
use super::resolver::Resolver;
use super::scope::{Meaning, check_reserved};
use super::statements::statements;
use crate::emit::Family;
use crate::report::{Diagnostic, Extent};
use crate::syntax::ast::{Definition, Expr, ExprKind, Item, Name, Subscript};
use crate::syntax::limits;

/// What a definition says of one entry.
#[derive(Clone, Copy)]
pub(super) struct Entry {
    /// What it stands for.
    pub(super) value: ExprId,
    /// The definition.
    pub(super) extent: Extent,
    /// Where the definition is in memory: the same for all entries that it gives.
    pub(super) place: usize,
}

/// A family that definitions imply.
pub(super) struct Defined<'a> {
    /// Its name where it is first defined.
    pub(super) name: &'a Name,
    /// The left-hand side that defines it first.
    pub(super) extent: Extent,
    /// The lengths of its indices.
    pub(super) lengths: Vec<u32>,
    /// Its entries, row by row.
    pub(super) entries: Vec<Entry>,
    /// Its documentation: that of the first definition.
    pub(super) docs: proc_macro2::TokenStream,
}

impl Defined<'_> {
    /// Its shape.
    pub(super) fn shape(&self) -> Shape {
        Shape::of(&self.lengths)
    }

    /// As a field of a generated type.
    pub(super) fn family(&self) -> Family {
        let (ident, lengths) = (self.name.ident.clone(), self.lengths.clone());
        Family { ident, lengths, docs: self.docs.clone(), units: Vec::new() }
    }
}

/// An index on the left-hand side.
#[derive(Clone)]
enum Slot {
    /// `w[0]`, and each value of `w[i in 0..3]`.
    Entry(usize),
    /// `w[0..2]`: the entries of the value one after the other.
    Part(Range<usize>),
}

/// The indices that an entry of the value defines: its own run through the parts, what is left of them comes behind.
fn filled(slots: &[Slot], indices: &[usize]) -> Vec<usize> {
    let mut own = indices.iter().copied();
    let mut found = Vec::with_capacity(slots.len() + indices.len());
    for slot in slots {
        found.push(match slot {
            Slot::Entry(index) => *index,
            Slot::Part(part) => part.start + own.next().unwrap_or(0),
        });
    }
    found.extend(own);
    found
}

/// A family while its definitions are read.
struct Growing<'a> {
    definition: &'a Definition,
    entries: BTreeMap<Vec<usize>, Entry>,
    /// How many indices the entries have.
    rank: Option<usize>,
    broken: bool,
}

impl Resolver {
    /// The families that a section defines, in the order of their first lines. Those in error are
    /// left out, and named in the second list.
    pub(super) fn definitions<'a>(
        &mut self,
        context: Context,
        items: &'a [Item<Definition>],
    ) -> (Vec<Defined<'a>>, Vec<&'a Name>) {
        let mut order: Vec<Growing<'a>> = Vec::new();
        let mut positions: BTreeMap<&str, usize> = BTreeMap::new();
        for definition in statements(items) {
            positions.entry(definition.name.text.as_str()).or_insert_with(|| {
                order.push(Growing { definition, entries: BTreeMap::new(), rank: None, broken: false });
                order.len() - 1
            });
        }
        self.section(context, items, &mut |this, definition| {
            let Some(position) = positions.get(definition.name.text.as_str()) else { return Ok(()) };
            let growing = &mut order[*position];
            let outcome = this
                .keep(&definition.name, check_reserved(&definition.name))
                .and_then(|()| this.define(definition, &definition.subscripts, &mut Vec::new(), growing));
            growing.broken |= outcome.is_err();
            this.abbreviates(&definition.name.text);
            outcome
        });
        let (mut defined, mut broken) = (Vec::new(), Vec::new());
        for growing in order {
            match self.grown(&growing) {
                Ok(family) => defined.push(family),
                Err(_) => broken.push(&growing.definition.name),
            }
        }
        (defined, broken)
    }

    /// Names whose definitions are in error have no meaning: their uses are silent.
    pub(super) fn spoil(&mut self, names: &[&Name]) {
        for name in names {
            if self.scope.get(&name.text).is_none() {
                self.scope.insert(name.text.clone(), Meaning::Broken);
            }
        }
    }

    /// Enters the entries that one definition gives.
    fn define(
        &mut self,
        definition: &Definition,
        subscripts: &[Subscript],
        before: &mut Vec<Slot>,
        growing: &mut Growing<'_>,
    ) -> Outcome<()> {
        match subscripts.split_first() {
            None => self.enter_value(definition, before, growing),
            Some((Subscript::Entry(expr), rest)) => {
                let slot = match &expr.kind {
                    ExprKind::Range(from, to) => Slot::Part(self.new_part(expr, from, to)?),
                    _ => Slot::Entry(self.new_index(expr, expr.extent)?),
                };
                before.push(slot);
                let outcome = self.define(definition, rest, before, growing);
                before.pop();
                outcome
            }
            Some((Subscript::Each(binder), rest)) => {
                let mut outcome = Ok(());
                self.each_value(std::slice::from_ref(&**binder), &mut |this| {
                    let each = this.new_index_of(&binder.name.text, binder).and_then(|index| {
                        before.push(Slot::Entry(index));
                        let each = this.define(definition, rest, before, growing);
                        before.pop();
                        each
                    });
                    outcome = outcome.and(each);
                })?;
                outcome
            }
        }
    }

    /// The index that a variable on the left-hand side stands for.
    pub(super) fn new_index_of(&mut self, name: &str, binder: &crate::syntax::ast::Binder) -> Outcome<usize> {
        let value = match self.scope.get(name) {
            Some(Meaning::Index(value)) => usize::try_from(*value).ok(),
            _ => None,
        };
        value.ok_or_else(|| {
            let error = Diagnostic::new(binder.extent, "indices count from 0");
            self.report(binder, error.way_out("let the range begin at 0"))
        })
    }

    /// The entries that `w[0..2]` on the left-hand side stands for.
    pub(super) fn new_part(&mut self, expr: &Expr, from: &Expr, to: &Expr) -> Outcome<Range<usize>> {
        let (first, end) = (self.new_index(from, from.extent)?, self.new_index(to, to.extent)?);
        if first < end && end <= limits::FAMILY as usize {
            return Ok(first..end);
        }
        let error = if first < end {
            let most = format!("families have at most {} entries", limits::FAMILY);
            Diagnostic::new(expr.extent, format!("the part {first}..{end} is too long")).way_out(most)
        } else {
            Diagnostic::new(expr.extent, format!("the part {first}..{end} has no entries"))
        };
        Err(self.report(expr, error))
    }

    /// A value whose first indices run through the parts on the left-hand side.
    fn in_parts(&mut self, definition: &Definition, slots: &[Slot], value: Array) -> Outcome<Array> {
        let lengths: Vec<usize> = slots
            .iter()
            .filter_map(|slot| match slot {
                Slot::Entry(_) => None,
                Slot::Part(part) => Some(part.len()),
            })
            .collect();
        let left = match *lengths {
            [] => return Ok(value),
            [n] => Shape::Vector(n),
            [rows, columns, ..] => Shape::Matrix(rows, columns),
        };
        if let Some(value) = self.in_shape(&value, left) {
            return Ok(value);
        }
        // the rows of a matrix: `w[0..2] = A` defines `w[0][0]` and so on
        if matches!((left, value.shape), (Shape::Vector(n), Shape::Matrix(rows, _)) if n == rows) {
            return Ok(value);
        }
        let error = Diagnostic::new(definition.value.extent, "the two sides have different shapes")
            .evidence(format!("on the left is {left}, on the right {}", value.shape));
        Err(self.report(definition, error))
    }

    fn enter_value(
        &mut self,
        definition: &Definition,
        before: &[Slot],
        growing: &mut Growing<'_>,
    ) -> Outcome<()> {
        let value = self.value(&definition.value)?;
        let value = self.in_parts(definition, before, value)?;
        let whole = definition.extent.to(definition.value.extent);
        let name = &definition.name.text;
        let place = std::ptr::from_ref(definition).addr();
        for (k, entry) in value.entries.iter().enumerate() {
            let indices = filled(before, &value.shape.indices(k));
            if indices.len() > 2 {
                let error =
                    Diagnostic::new(whole, "a third index").way_out("families have one or two indices");
                return Err(self.report(definition, error));
            }
            if *growing.rank.get_or_insert(indices.len()) != indices.len() {
                let error =
                    Diagnostic::new(definition.extent, format!("`{name}` has different numbers of indices"))
                        .way_out("define all of its entries in the same way");
                return Err(self.report(definition, error));
            }
            let written = indices.iter().fold(name.clone(), |text, index| format!("{text}[{index}]"));
            let entry = Entry { value: *entry, extent: whole, place };
            if growing.entries.insert(indices, entry).is_some() {
                let error = Diagnostic::new(definition.extent, format!("`{written}` is defined twice"))
                    .way_out("keep one of the definitions");
                return Err(self.report(definition, error));
            }
        }
        Ok(())
    }

    /// A family whose entries are all there.
    fn grown<'a>(&mut self, growing: &Growing<'a>) -> Outcome<Defined<'a>> {
        if growing.broken {
            return Err(super::reports::Reported);
        }
        let Growing { definition, entries, .. } = growing;
        let mut lengths = vec![0_usize; growing.rank.unwrap_or(0)];
        for indices in entries.keys() {
            for (length, index) in lengths.iter_mut().zip(indices) {
                *length = (*length).max(index + 1);
            }
        }
        let name = &definition.name.text;
        let count = lengths.iter().fold(1_usize, |count, length| count.saturating_mul(*length));
        if count > limits::FAMILY as usize {
            let what = format!("`{name}` has more than {} entries", limits::FAMILY);
            return Err(self.report(*definition, Diagnostic::new(definition.extent, what)));
        }
        let counts: Vec<u32> = lengths.iter().filter_map(|length| u32::try_from(*length).ok()).collect();
        let shape = Shape::of(&counts);
        if let Some(missing) = (0..count).find(|k| !entries.contains_key(&shape.indices(*k))) {
            let missing = shape.entry_name(name, missing);
            // `n[2] = [a, b];`, as lists of names declare a family of two: of auxiliary states, a third one counts
            let one = |at: usize| entries.keys().all(|indices| indices.first() == Some(&at));
            let is_auxiliary = self.context == Context::Auxiliary;
            let way_out = match *lengths {
                [rows, columns]
                    if is_auxiliary
                        && definition.subscripts.len() == 1
                        && (columns..=columns + 1).contains(&rows)
                        && one(rows - 1) =>
                {
                    let count = rows - 1;
                    format!(
                        "write `der({name}[0..{count}]) = …;` for a vector: `{name}[{count}]` is one entry"
                    )
                }
                _ if is_auxiliary => format!("add `der({missing}) = …;`"),
                [rows, columns] if rows == columns + 1 && one(columns) => {
                    format!("write `{name} = …;` for a vector: `{name}[{columns}]` is one entry")
                }
                _ => format!("add `{missing} = …;`"),
            };
            let error = if entries.is_empty() {
                Diagnostic::new(definition.extent, format!("`{name}` has no entries")).way_out("leave it out")
            } else {
                Diagnostic::new(definition.extent, format!("`{missing}` is not defined"))
                    .evidence(format!("other entries of `{name}` are, and indices count from 0"))
                    .way_out(way_out)
            };
            return Err(self.report(*definition, error));
        }
        Ok(Defined {
            name: &definition.name,
            extent: definition.extent,
            lengths: counts,
            entries: entries.values().copied().collect(),
            docs: definition.docs.clone(),
        })
    }
}
