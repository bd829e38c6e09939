//! A wrong length where a name is declared spoils every place where the name stands. It is one mistake, and is told where
//! it was made, if another length of one name leaves nothing of what these places say.

use std::collections::BTreeSet;

use proc_macro2::TokenStream;

use super::array::Shape;
use super::{Unresolved, resolve};
use crate::emit::Layout;
use crate::report::{Diagnostic, Extent};
use crate::syntax::ast::{Declared, SystemDecl};

/// The steps of resolving that all trials may take.
const STEPS: usize = 200_000;

/// Other lengths of a name, and the errors that these leave nothing of.
struct Trial {
    name: String,
    extent: Extent,
    is_field: bool,
    shapes: [Shape; 2],
    lengths: Vec<u32>,
    removed: BTreeSet<usize>,
}

/// The errors, of which those that other lengths of one name would remove are one at its declaration. A single error stays
/// where it is, and so do those that changes of several names would remove, as far as these are tried: what is said is true of
/// the one in any case.
pub(crate) fn told_of_lengths(declaration: &mut SystemDecl, unresolved: Unresolved) -> Unresolved {
    let Unresolved { errors, model, steps } = unresolved;
    let mut trials_left = STEPS / steps.max(1);
    if errors.len() < 2 {
        return Unresolved { errors, model, steps };
    }
    let known: Vec<(String, String)> = errors.iter().map(Diagnostic::of_any_entry).collect();
    let mut trials: Vec<Trial> = Vec::new();
    let count = declared(declaration).count();
    for index in 0..count {
        let Some(name) = declared(declaration).nth(index) else { continue };
        let (own, is_symmetric) = (name.lengths.clone(), name.symmetric);
        let (name, extent) = (name.name.text.clone(), name.extent);
        for lengths in others(&own, is_symmetric) {
            let Some(left) = trials_left.checked_sub(1) else { break };
            trials_left = left;
            let Some(removed) = removed(declaration, (index, &lengths), &known) else { continue };
            trials.push(Trial {
                name: name.clone(),
                extent,
                is_field: index >= count - declaration.structure.parameters.len(),
                shapes: [Shape::of(&own), Shape::of(&lengths)],
                lengths,
                removed,
            });
        }
    }
    let most = trials.iter().map(|trial| trial.removed.len()).max().filter(|most| *most > 1);
    trials.retain(|trial| Some(trial.removed.len()) == most);
    let is_unique = trials.iter().all(|trial| trial.name == trials[0].name);
    let least = trials.into_iter().min_by_key(|trial| trial.shapes[1].len());
    let errors = match least {
        Some(trial) if is_unique => trial.told(errors),
        _ => errors,
    };
    Unresolved { errors, model, steps }
}

impl Trial {
    /// The errors, with one in the place of those that it removes.
    fn told(self, errors: Vec<Diagnostic>) -> Vec<Diagnostic> {
        let Self { name, extent, is_field, shapes: [own, other], lengths, removed } = self;
        let first = removed.first().and_then(|index| errors.get(*index)).map(ToString::to_string);
        let first = first.unwrap_or_default();
        let first = first.split("\nhelp: ").next().unwrap_or_default().replace('\n', ": ");
        let declare = match (is_field, other) {
            (true, Shape::Number) => format!("it as {other}"),
            (true, _) => {
                let written = lengths
                    .iter()
                    .rev()
                    .fold("…".to_owned(), |inner, length| format!("[{inner}; {length}]"));
                format!("it as `{written}`")
            }
            (false, _) => {
                let written = lengths.iter().fold(name.clone(), |text, length| format!("{text}[{length}]"));
                format!("`{written}`")
            }
        };
        let error = Diagnostic::new(extent, format!("`{name}` is {own}, and stands where {other} fits"))
            .evidence(format!(
                "as {other} it has a meaning in {} places where it has none now, first where {first}",
                removed.len()
            ))
            .way_out(format!("declare {declare}, or change what stands in those places"));
        let left = errors.into_iter().enumerate().filter(|(index, _)| !removed.contains(index));
        std::iter::once(error).chain(left.map(|(_, error)| error)).collect()
    }
}

/// Which errors are not there with other lengths of a name, if there are no others instead.
fn removed(
    declaration: &mut SystemDecl,
    (index, lengths): (usize, &[u32]),
    known: &[(String, String)],
) -> Option<BTreeSet<usize>> {
    let own = std::mem::replace(&mut declared(declaration).nth(index)?.lengths, lengths.to_vec());
    let mut layout = Layout::of_struct(&declaration.structure, TokenStream::new());
    let left = match resolve(declaration, &mut layout) {
        Ok(_) => Vec::new(),
        Err(unresolved) => unresolved.errors,
    };
    declared(declaration).nth(index)?.lengths = own;
    let left: BTreeSet<(String, String)> = left.iter().map(Diagnostic::of_any_entry).collect();
    left.iter().all(|error| known.contains(error)).then(|| {
        let is_removed = |index: &usize| !left.contains(&known[*index]);
        (0..known.len()).filter(is_removed).collect()
    })
}

/// The names that lists and the struct declare; the fields are the last.
fn declared(declaration: &mut SystemDecl) -> impl Iterator<Item = &mut Declared> {
    let sections = &mut declaration.sections;
    let lists = [&mut sections.base, &mut sections.basis, &mut sections.inputs];
    let of_lists = lists.into_iter().flatten().flat_map(|section| &mut section.body);
    of_lists.chain(&mut declaration.structure.parameters)
}

/// Lengths that may have been meant instead: of a symmetric matrix two that are the same.
fn others(own: &[u32], is_symmetric: bool) -> Vec<Vec<u32>> {
    let near = |length: u32| [length.saturating_sub(1), length + 1];
    let mut all = vec![vec![], vec![2], vec![3], vec![3, 3]];
    match *own {
        [] => {}
        [length] => {
            all.extend(near(length).map(|length| vec![length]));
            all.push(vec![length, length]);
        }
        [rows, columns, ..] => {
            all.extend([vec![rows], vec![rows, rows], vec![columns, columns], vec![columns, rows]]);
            all.extend(near(rows).map(|rows| vec![rows, columns]));
            all.extend(near(columns).map(|columns| vec![rows, columns]));
        }
    }
    let is_square = |lengths: &[u32]| matches!(lengths, [rows, columns] if rows == columns);
    all.retain(|lengths| lengths != own && !lengths.contains(&0) && (!is_symmetric || is_square(lengths)));
    all.sort();
    all.dedup();
    all
}
