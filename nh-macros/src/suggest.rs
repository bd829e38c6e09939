//! "Did you mean": the known word nearest to an unknown one.

/// Words longer than this are not compared: nobody mistypes them twice.
const LONGEST: usize = 64;

/// The candidate nearest to `word`, if it is near enough to be what was meant. The first one wins
/// among equals.
pub(crate) fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let letters: Vec<char> = word.chars().flat_map(char::to_lowercase).take(LONGEST + 1).collect();
    if letters.len() > LONGEST {
        return None;
    }
    let mut best: Option<(usize, &str)> = None;
    for candidate in candidates {
        let other: Vec<char> = candidate.chars().flat_map(char::to_lowercase).take(LONGEST + 1).collect();
        if other.len() > LONGEST || candidate == word {
            continue;
        }
        let far = distance(&letters, &other);
        // a third of the letters may be wrong; of one or two letters, none but the case
        let allowed = letters.len().max(other.len()) / 3;
        if far <= allowed && best.is_none_or(|(least, _)| far < least) {
            best = Some((far, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}

/// The question to append to an error, or nothing.
pub(crate) fn did_you_mean<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<String> {
    nearest(word, candidates).map(|meant| format!("did you mean `{meant}`?"))
}

/// The Damerau–Levenshtein distance, each letter edited once: insertions, deletions, replacements
/// and exchanges of neighbours.
fn distance(a: &[char], b: &[char]) -> usize {
    let mut before: Vec<usize> = Vec::new();
    let mut above: Vec<usize> = (0..=b.len()).collect();
    for i in 0..a.len() {
        let mut row = vec![i + 1];
        for j in 0..b.len() {
            let replaced = above[j] + usize::from(a[i] != b[j]);
            let mut least = replaced.min(above[j + 1] + 1).min(row[j] + 1);
            if i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j] {
                least = least.min(before[j - 1] + 1);
            }
            row.push(least);
        }
        before = std::mem::replace(&mut above, row);
    }
    above[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_of_the_pen_are_recognised() {
        let known = ["base", "basis", "anchor", "omega", "theta", "J"];
        assert_eq!(nearest("omgea", known), Some("omega"));
        assert_eq!(nearest("thteta", known), Some("theta"));
        assert_eq!(nearest("ancor", known), Some("anchor"));
        assert_eq!(nearest("j", known), Some("J"));
        assert_eq!(nearest("x", known), None);
        assert_eq!(nearest("lagrangian", known), None);
        assert_eq!(did_you_mean("bass", known).as_deref(), Some("did you mean `base`?"));
    }

    #[test]
    fn distances() {
        let of = |a: &str, b: &str| distance(&a.chars().collect::<Vec<_>>(), &b.chars().collect::<Vec<_>>());
        assert_eq!(of("", ""), 0);
        assert_eq!(of("abc", ""), 3);
        assert_eq!(of("ab", "ba"), 1);
        assert_eq!(of("kitten", "sitting"), 3);
    }

    #[test]
    fn long_words_cost_nothing() {
        let long = "a".repeat(1_000_000);
        assert_eq!(nearest(&long, ["base"]), None);
        assert_eq!(nearest("base", [long.as_str()]), None);
    }
}
