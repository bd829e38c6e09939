//! What things are called in C: as in the declaration, unless C keeps that name for itself.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

/// Words that C keeps for itself, up to C23 and with what GCC adds, and names that `math.h` gives to numbers and types.
const KEPT: &str = "auto break case char const continue default do double else enum extern float for goto if inline int \
                    long register restrict return short signed sizeof static struct switch typedef union unsigned void \
                    volatile while alignas alignof asm bool complex constexpr false imaginary nullptr static_assert \
                    thread_local true typeof typeof_unqual _Alignas _Alignof _Atomic _BitInt _Bool _Complex _Decimal32 \
                    _Decimal64 _Decimal128 _Generic _Imaginary _Noreturn _Static_assert _Thread_local INFINITY NAN \
                    DOMAIN SING OVERFLOW UNDERFLOW PLOSS TLOSS MAXFLOAT HUGE double_t float_t math_errhandling \
                    unix linux i386";

/// What the names of numbers in `math.h` begin with.
const KEPT_BEGINNINGS: [&str; 4] = ["FP_", "HUGE_VAL", "M_", "MATH_"];

/// The names of one kind, each by its name in the declaration, no two alike.
pub(super) struct Names(BTreeMap<String, String>);

impl Names {
    /// Names for these, and none of those that are `taken`.
    pub(super) fn new(declared: impl IntoIterator<Item = String>, taken: &[String]) -> Self {
        let declared: BTreeSet<String> = declared.into_iter().collect();
        let (mut names, mut used) = (BTreeMap::new(), taken.iter().cloned().collect::<BTreeSet<_>>());
        // what can stay stays, whatever becomes of the others
        let (stay, change): (Vec<_>, Vec<_>) =
            declared.into_iter().partition(|name| identifier(name) == *name && !used.contains(name));
        used.extend(stay.iter().cloned());
        names.extend(stay.into_iter().map(|name| (name.clone(), name)));
        for name in change {
            let mut text = identifier(&name);
            while used.contains(&text) {
                text.push('_');
            }
            used.insert(text.clone());
            names.insert(name, text);
        }
        Self(names)
    }

    /// The name in C of what is called this in the declaration, without `r#`.
    pub(super) fn of(&self, declared: &str) -> String {
        self.0.get(declared).cloned().unwrap_or_else(|| identifier(declared))
    }

    /// The place in C of `theta[0]`.
    pub(super) fn place(&self, place: &str) -> String {
        let (name, indices) = place.find('[').map_or((place, ""), |at| place.split_at(at));
        format!("{}{indices}", self.of(name.trim_start_matches("r#")))
    }
}

/// A name that C accepts: letters beyond ASCII by their numbers, an underscore behind what C keeps.
fn identifier(name: &str) -> String {
    let mut text = String::new();
    for c in name.chars() {
        if c.is_ascii_alphanumeric() || c == '_' {
            text.push(c);
        } else {
            _ = write!(text, "u{:04x}", u32::from(c));
        }
    }
    let is_kept = KEPT.split(' ').any(|kept| kept == text)
        || KEPT_BEGINNINGS.iter().any(|beginning| text.starts_with(beginning));
    if is_kept {
        text.push('_');
    }
    text
}

/// `chaplygin_sleigh` for `ChaplyginSleigh`.
pub(super) fn snake(name: &str) -> String {
    let mut text = String::new();
    for (k, c) in name.chars().enumerate() {
        if c.is_ascii_uppercase() && k > 0 && !text.ends_with('_') {
            text.push('_');
        }
        text.push(c.to_ascii_lowercase());
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_names_become_one() {
        let declared = ["double", "double_", "double___", "é", "u00e9", "m", "const", "M_PI", "p", "_Bool"];
        let names = Names::new(declared.map(str::to_owned), &["p".to_owned()]);
        assert_eq!(
            declared.map(|name| names.of(name)),
            ["double__", "double_", "double___", "u00e9_", "u00e9", "m", "const_", "M_PI_", "p_", "_Bool_"]
        );
        assert_eq!(
            (names.place("double[1][2]").as_str(), names.place("r#const").as_str()),
            ("double__[1][2]", "const_")
        );
    }
}
