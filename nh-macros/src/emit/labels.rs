//! Labels of equations: those of the entries of one array, `rolling[0]`, `rolling[1]`, stand together.

use std::ops::Range;

/// Consecutive equations with one name: a number, or an array row by row.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Group {
    /// The name; none for an equation without a label.
    pub(super) name: Option<String>,
    /// The length of every index: none for a number, at most two.
    pub(super) lengths: Vec<u32>,
    /// The places of the equations.
    pub(super) places: Range<usize>,
}

/// The groups of labels in order. Entries of an array of which some are missing are groups of their own, `rolling_1`.
pub(super) fn grouped(labels: &[Option<&str>]) -> Vec<Group> {
    let mut found = Vec::new();
    let mut first = 0;
    while let Some(label) = labels.get(first) {
        let (name, indices) = label.map_or((None, Vec::new()), |label| {
            let (name, indices) = split(label);
            (Some(name), indices)
        });
        let rest = labels[first + 1..].iter();
        let same = rest.take_while(|label| label.is_some_and(|label| Some(split(label).0) == name));
        let run = 1 + same.count();
        let entries: Vec<_> =
            labels[first..first + run].iter().flatten().map(|label| split(label).1).collect();
        if let (Some(name), false, Some(lengths)) = (name, indices.is_empty(), whole(&entries)) {
            found.push(Group { name: Some(name.to_owned()), lengths, places: first..first + run });
            first += run;
        } else {
            let name = label.map(flat);
            found.push(Group { name, lengths: Vec::new(), places: first..first + 1 });
            first += 1;
        }
    }
    found
}

/// `rolling[0][1]` as a name and its indices.
fn split(label: &str) -> (&str, Vec<u32>) {
    let (name, rest) = label.find('[').map_or((label, ""), |at| label.split_at(at));
    (name, rest.split(['[', ']']).filter_map(|index| index.parse().ok()).collect())
}

/// The name of an entry that stands alone: `rolling_0_1`.
pub(super) fn flat(label: &str) -> String {
    let (name, indices) = split(label);
    indices.iter().fold(name.to_owned(), |text, index| format!("{text}_{index}"))
}

/// The same behind the name: `closure_dot[0]`.
pub(super) fn with_suffix(label: &str, suffix: &str) -> String {
    let (name, rest) = label.find('[').map_or((label, ""), |at| label.split_at(at));
    format!("{name}{suffix}{rest}")
}

/// The lengths of the indices, if these are all entries of an array, row by row.
fn whole(entries: &[Vec<u32>]) -> Option<Vec<u32>> {
    let lengths: Vec<u32> = entries.last()?.iter().map(|index| index + 1).collect();
    let expected: Vec<Vec<u32>> = match *lengths {
        [n] => (0..n).map(|i| vec![i]).collect(),
        [rows, columns] => (0..rows).flat_map(|i| (0..columns).map(move |j| vec![i, j])).collect(),
        _ => return None,
    };
    (expected == entries).then_some(lengths)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(labels: &[&str]) -> Vec<String> {
        let labels: Vec<_> = labels.iter().map(|label| (!label.is_empty()).then_some(*label)).collect();
        let shown = |group: Group| {
            format!("{:?} {:?} {:?}", group.name.unwrap_or_default(), group.lengths, group.places)
        };
        grouped(&labels).into_iter().map(shown).collect()
    }

    #[test]
    fn entries_of_an_array_stand_together() {
        assert_eq!(
            shown(&["", "roll[0]", "roll[1]", "blade", "a[0][0]", "a[0][1]", "a[1][0]", "a[1][1]"]),
            ["\"\" [] 0..1", "\"roll\" [2] 1..3", "\"blade\" [] 3..4", "\"a\" [2, 2] 4..8"]
        );
    }

    #[test]
    fn entries_of_which_some_are_missing_stand_alone() {
        assert_eq!(shown(&["roll[1]", "roll[2]"]), ["\"roll_1\" [] 0..1", "\"roll_2\" [] 1..2"]);
        assert_eq!(shown(&["a[0][0]", "a[1][1]"]), ["\"a_0_0\" [] 0..1", "\"a_1_1\" [] 1..2"]);
        assert_eq!(with_suffix("closure[1]", "_dot"), "closure_dot[1]");
    }
}
