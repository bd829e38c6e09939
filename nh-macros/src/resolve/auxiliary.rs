//! Auxiliary states: declared by the left sides of their lines, `der(current) = …`.

use std::collections::BTreeMap;
use std::rc::Rc;

use nonholonomic_core::model::AuxiliaryDecl;

use super::alike::Measured;
use super::array::Shape;
use super::context::Context;
use super::definitions::Entry;
use super::resolver::Resolver;
use super::scope::{Meaning, Named, Role};
use crate::emit::{Family, Layout};
use crate::report::Diagnostic;
use crate::syntax::ast::{Definition, Expr, ExprKind, Item, Section, Subscript};

/// A family while its left sides are read.
struct Declared<'a> {
    definition: &'a Definition,
    /// The length of every index; `None` where a left side is in error.
    lengths: Option<Vec<usize>>,
}

impl Resolver {
    /// Declares what the left sides name, so that all sections can use it.
    pub(super) fn declare_auxiliary(
        &mut self,
        section: Option<&Section<Vec<Item<Definition>>>>,
        layout: &mut Layout,
    ) {
        let Some(section) = section else { return };
        self.context = Context::Auxiliary;
        let mut order: Vec<Declared<'_>> = Vec::new();
        let mut positions: BTreeMap<&str, usize> = BTreeMap::new();
        for definition in super::statements::statements(&section.body) {
            positions.entry(definition.name.text.as_str()).or_insert_with(|| {
                order.push(Declared { definition, lengths: Some(Vec::new()) });
                order.len() - 1
            });
        }
        self.left_sides(&section.body, &mut |definition, indices| {
            let Some(declared) = positions.get(definition.name.text.as_str()).map(|at| &mut order[*at])
            else {
                return;
            };
            declared.lengths = match (declared.lengths.take(), indices) {
                (Some(known), Some(indices)) => {
                    let lengths = indices.into_iter().enumerate();
                    let length =
                        |(k, index): (usize, usize)| known.get(k).copied().unwrap_or(0).max(index + 1);
                    Some(lengths.map(length).collect())
                }
                _ => None,
            };
        });
        for Declared { definition, lengths } in order {
            let name = &definition.name;
            let checked = self.scope.check_new(name);
            let fresh = self.keep(name, checked);
            let lengths: Option<Vec<u32>> =
                lengths.and_then(|all| all.into_iter().map(|length| u32::try_from(length).ok()).collect());
            let (Ok(()), Some(lengths)) = (fresh, lengths) else {
                self.scope.insert(name.text.clone(), Meaning::Broken);
                continue;
            };
            let shape = Shape::of(&lengths);
            let Ok(named) = self.enter(&name.text, shape, Role::Auxiliary, definition.extent) else {
                continue;
            };
            self.scope.insert(name.text.clone(), Meaning::Named(Rc::new(named)));
            let (ident, docs) = (name.ident.clone(), definition.docs.clone());
            layout.auxiliary.push(Family { ident, lengths, docs, units: Vec::new() });
        }
    }

    /// Visits the left sides with their indices, which are numbers and variables of loops.
    fn left_sides<'a>(
        &mut self,
        items: &'a [Item<Definition>],
        visit: &mut dyn FnMut(&'a Definition, Option<Vec<usize>>),
    ) {
        for item in items {
            match item {
                Item::Let(_) => {}
                Item::For(block) => {
                    // a range in error was reported
                    let _ = self.each_value(&block.binders, &mut |this| this.left_sides(&block.items, visit));
                }
                Item::One(definition) => {
                    self.left_side(definition, &definition.subscripts, &mut Vec::new(), visit);
                }
            }
        }
    }

    fn left_side<'a>(
        &mut self,
        definition: &'a Definition,
        subscripts: &'a [Subscript],
        before: &mut Vec<usize>,
        visit: &mut dyn FnMut(&'a Definition, Option<Vec<usize>>),
    ) {
        match subscripts.split_first() {
            None => visit(definition, Some(before.clone())),
            Some((Subscript::Entry(expr @ Expr { kind: ExprKind::Range(from, to), .. }), rest)) => {
                let Ok(part) = self.new_part(expr, from, to) else {
                    return visit(definition, None);
                };
                for index in part {
                    before.push(index);
                    self.left_side(definition, rest, before, visit);
                    before.pop();
                }
            }
            Some((Subscript::Entry(expr), rest)) => match self.new_index(expr, expr.extent) {
                Ok(index) => {
                    before.push(index);
                    self.left_side(definition, rest, before, visit);
                    before.pop();
                }
                Err(_) => visit(definition, None),
            },
            Some((Subscript::Each(binder), rest)) => {
                let outcome = self.each_value(std::slice::from_ref(&**binder), &mut |this| match this
                    .new_index_of(&binder.name.text, binder)
                {
                    Ok(index) => {
                        before.push(index);
                        this.left_side(definition, rest, before, visit);
                        before.pop();
                    }
                    Err(_) => visit(definition, None),
                });
                if outcome.is_err() {
                    visit(definition, None);
                }
            }
        }
    }

    /// Reads the rates of what was declared.
    pub(super) fn auxiliary(&mut self, items: &[Item<Definition>]) {
        let (defined, _) = self.definitions(Context::Auxiliary, items);
        for family in defined {
            let Some(Meaning::Named(named)) = self.scope.get(&family.name.text).cloned() else { continue };
            if named.role != Role::Auxiliary {
                continue;
            }
            if family.shape() != named.shape {
                let error = Diagnostic::new(family.extent, "the two sides have different shapes")
                    .evidence(format!("on the left is {}, on the right {}", named.shape, family.shape()))
                    .way_out(format!(
                        "the left side says how many there are: `der({}[i in 0..3]) = …;`",
                        family.name.text
                    ));
                self.report(family.name, error);
                continue;
            }
            self.enter_rates(&named, &family.entries);
        }
    }

    fn enter_rates(&mut self, named: &Named, entries: &[Entry]) {
        for (k, Entry { value, extent, place }) in entries.iter().copied().enumerate() {
            let origin = self.origin(extent);
            let symbol = named.symbols[k];
            let text = format!("`der({})`", self.graph.symbols()[symbol]);
            let expected = Measured::expected(text, extent).symbol(symbol, 1).time(-1);
            let given = self.shown(value, extent);
            self.same_unit_of(place, "equals", vec![expected, given]);
            if let Some(state) = self.tables.auxiliary.get_mut(named.first + k) {
                *state = AuxiliaryDecl { value, origin, ..state.clone() };
            }
        }
    }
}
