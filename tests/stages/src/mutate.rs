//! Declarations that are changed here and there: most are ill-posed, and all have to be refused in words or compiled.

use crate::{Declaration, Relation};
use nonholonomic_core::model::Request;
use proc_macro2::{Group, Ident, Literal, Punct, Spacing, Span, TokenStream, TokenTree};

/// Random numbers that are the same in every run: SplitMix64.
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// A sequence of its own for every seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// A number below a bound, or 0.
    pub fn below(&mut self, bound: usize) -> usize {
        let bound = u64::try_from(bound.max(1)).unwrap_or(1);
        usize::try_from(self.next() % bound).unwrap_or(0)
    }

    fn pick<'a, T>(&mut self, list: &'a [T]) -> Option<&'a T> {
        let place = self.below(list.len());
        list.get(place)
    }
}

/// Numbers at the ends of what is understood, and beyond.
const EXTREME: [&str; 22] = [
    "0",
    "1",
    "2",
    "3",
    "64",
    "511",
    "512",
    "4096",
    "1000",
    "1001",
    "1e-1000",
    "1e1000",
    "1e9999",
    "0.1",
    "1e308",
    "4294967296",
    "9223372036854775807",
    "9223372036854775808",
    "170141183460469231731687303715884105728",
    "1e-9223372036854775808",
    "0.0",
    "99999999999999999999999999999999999999999999999999999999",
];

/// Words with a meaning of their own, but for those of `emit`.
const WORDS: [&str; 27] = [
    "t",
    "pi",
    "der",
    "sum",
    "dot",
    "cross",
    "sin",
    "cos",
    "tan",
    "exp",
    "ln",
    "sqrt",
    "abs",
    "sign",
    "min",
    "max",
    "atan2",
    "let",
    "for",
    "in",
    "self",
    "almost",
    "volume",
    "projected",
    "adapted",
    "careful",
    "fast",
];

/// What the declarations of a collection are made of.
#[derive(Clone, Debug, Default)]
pub struct Collection {
    /// What is changed.
    declarations: Vec<Declaration>,
    /// Tokens that are no groups.
    leaves: Vec<TokenTree>,
    /// Sections with their braces.
    sections: Vec<[TokenTree; 2]>,
    /// Maps and quotients that are changed.
    relations: Vec<Relation>,
}

impl Collection {
    /// The parts of these declarations. Those that are well-posed are changed, and parts of all are put in.
    #[must_use]
    pub fn of(declarations: Vec<Declaration>) -> Self {
        let mut collection = Self::default();
        for declaration in &declarations {
            leaves(&declaration.attribute, &mut collection.leaves);
            let tokens: Vec<TokenTree> = declaration.attribute.clone().into_iter().collect();
            for pair in tokens.windows(2) {
                if let [TokenTree::Ident(_), TokenTree::Group(_)] = pair {
                    collection.sections.push([pair[0].clone(), pair[1].clone()]);
                }
            }
        }
        let is_well_posed = |declaration: &Declaration| declaration.model().is_ok();
        collection.declarations = declarations.into_iter().filter(is_well_posed).collect();
        collection
    }

    /// The same with maps and quotients.
    #[must_use]
    pub fn with_relations(mut self, relations: Vec<Relation>) -> Self {
        for relation in &relations {
            leaves(&relation.written, &mut self.leaves);
        }
        self.relations = relations;
        self
    }

    /// One of the maps and quotients with something changed in what is written of it, or in one of its systems.
    pub fn changed_relation(&self, random: &mut Random) -> Option<Relation> {
        let mut relation = random.pick(&self.relations)?.clone();
        for _ in 0..[1, 1, 1, 2, 3][random.below(5)] {
            let changed = match (random.below(8), &mut relation.target) {
                (0, _) => &mut relation.source.attribute,
                (1, Some(target)) => &mut target.attribute,
                _ => &mut relation.written,
            };
            let mut own = Vec::new();
            leaves(changed, &mut own);
            let list = if random.below(4) == 0 || own.is_empty() { &self.leaves } else { &own };
            let mut place = random.below(count(changed));
            *changed = changed_at(changed.clone(), &mut place, list, random);
        }
        Some(relation)
    }

    /// How many declarations there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.declarations.len()
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.declarations.is_empty()
    }

    /// One of the declarations with something changed.
    pub fn changed(&self, random: &mut Random) -> Option<Declaration> {
        let mut declaration = random.pick(&self.declarations)?.clone();
        for _ in 0..[1, 1, 1, 1, 2, 3][random.below(6)] {
            declaration.attribute = match random.below(8) {
                0 => self.spliced(declaration.attribute, random),
                1 => self.without_a_section(declaration.attribute, random),
                2 => match random.pick(&Request::WORDS) {
                    Some((word, _)) => declaration.asking_for(word).attribute,
                    None => declaration.attribute,
                },
                _ => {
                    let places = count(&declaration.attribute);
                    let mut place = random.below(places);
                    let mut own = Vec::new();
                    leaves(&declaration.attribute, &mut own);
                    // mostly with names and marks of its own, so that more than the grammar is tried
                    let list = if random.below(4) == 0 || own.is_empty() { &self.leaves } else { &own };
                    changed_at(declaration.attribute.clone(), &mut place, list, random)
                }
            };
        }
        if random.below(12) == 0 {
            let mut place = random.below(count(&declaration.item));
            declaration.item = changed_at(declaration.item, &mut place, &self.leaves, random);
        }
        Some(declaration)
    }

    /// With a section of another declaration: in place of one, or besides.
    fn spliced(&self, attribute: TokenStream, random: &mut Random) -> TokenStream {
        let mut tokens: Vec<TokenTree> = attribute.into_iter().collect();
        let Some(section) = random.pick(&self.sections) else { return tokens.into_iter().collect() };
        let same = tokens.iter().position(|token| token.to_string() == section[0].to_string());
        match same {
            Some(place) if place + 1 < tokens.len() => tokens[place + 1] = section[1].clone(),
            _ => tokens.extend(section.clone()),
        }
        tokens.into_iter().collect()
    }

    #[allow(clippy::unused_self, reason = "one of the ways to change")]
    fn without_a_section(&self, attribute: TokenStream, random: &mut Random) -> TokenStream {
        let mut tokens: Vec<TokenTree> = attribute.into_iter().collect();
        let bodies: Vec<usize> =
            (1..tokens.len()).filter(|k| matches!(tokens[*k], TokenTree::Group(_))).collect();
        if let Some(body) = random.pick(&bodies) {
            tokens.drain(body - 1..=*body);
        }
        tokens.into_iter().collect()
    }
}

/// With the token at a place changed, where groups count as one and what they contain besides.
fn changed_at(
    tokens: TokenStream,
    place: &mut usize,
    leaves: &[TokenTree],
    random: &mut Random,
) -> TokenStream {
    let mut found: Vec<TokenTree> = Vec::new();
    let mut rest = tokens.into_iter().peekable();
    while let Some(token) = rest.next() {
        let here = *place == 0;
        *place = place.wrapping_sub(1);
        if !here {
            found.push(match token {
                TokenTree::Group(group) if *place < usize::MAX / 2 => {
                    let inside = changed_at(group.stream(), place, leaves, random);
                    regrouped(&group, inside)
                }
                token => token,
            });
            continue;
        }
        match random.below(12) {
            0 => {}
            1 => found.extend([token.clone(), token]),
            2 => {
                let next = rest.next();
                found.extend(next);
                found.push(token);
            }
            3 => {
                found.push(token);
                found.extend(random.pick(leaves).cloned());
            }
            4 => found.push(TokenTree::Ident(Ident::new(
                random.pick(&WORDS).copied().unwrap_or("t"),
                Span::call_site(),
            ))),
            5 | 6 | 9..12 => found.push(other(&token, leaves, random)),
            7 => {
                let inner = [token].into_iter().collect();
                found.push(TokenTree::Group(Group::new(proc_macro2::Delimiter::Parenthesis, inner)));
            }
            _ => {
                found.push(token);
                let mark = random.pick(&['+', '-', '*', '/', '^', ';', '=', ',']).copied().unwrap_or('+');
                found.push(TokenTree::Punct(Punct::new(mark, Spacing::Alone)));
                found.extend(random.pick(leaves).cloned());
            }
        }
    }
    found.into_iter().collect()
}

/// A token of the same kind: numbers become extreme ones.
fn other(token: &TokenTree, leaves: &[TokenTree], random: &mut Random) -> TokenTree {
    if let TokenTree::Literal(_) = token
        && let Some(Ok(extreme)) = random.pick(&EXTREME).map(|text| text.parse::<Literal>())
    {
        return TokenTree::Literal(extreme);
    }
    let is_like = |other: &&TokenTree| std::mem::discriminant(*other) == std::mem::discriminant(token);
    let start = random.below(leaves.len());
    let other = leaves[start..].iter().find(is_like).or_else(|| leaves.iter().find(is_like));
    other.cloned().unwrap_or_else(|| token.clone())
}

/// The tokens that are no groups.
fn leaves(tokens: &TokenStream, into: &mut Vec<TokenTree>) {
    for token in tokens.clone() {
        match token {
            TokenTree::Group(group) => leaves(&group.stream(), into),
            leaf => into.push(leaf),
        }
    }
}

fn regrouped(group: &Group, inside: TokenStream) -> TokenTree {
    let mut changed = Group::new(group.delimiter(), inside);
    changed.set_span(group.span());
    TokenTree::Group(changed)
}

/// The tokens, groups and what they contain.
fn count(tokens: &TokenStream) -> usize {
    let inside = |token| match token {
        TokenTree::Group(group) => 1 + count(&group.stream()),
        _ => 1,
    };
    tokens.clone().into_iter().map(inside).sum()
}

/// A smaller declaration that is still wrong in the same way: tokens are left out one by one for as long as that
/// goes on, at most so often.
#[must_use]
pub fn minimised(
    declaration: &Declaration,
    tries: usize,
    is_wrong: impl Fn(&Declaration) -> bool,
) -> Declaration {
    let with = |attribute: &TokenStream| Declaration { attribute: attribute.clone(), ..declaration.clone() };
    with(&smallest(declaration.attribute.clone(), tries, |attribute| is_wrong(&with(attribute))))
}

/// The same of what is written of a map or a quotient.
#[must_use]
pub fn minimised_relation(
    relation: &Relation,
    tries: usize,
    is_wrong: impl Fn(&Relation) -> bool,
) -> Relation {
    let with = |written: &TokenStream| Relation { written: written.clone(), ..relation.clone() };
    with(&smallest(relation.written.clone(), tries, |written| is_wrong(&with(written))))
}

fn smallest(tokens: TokenStream, mut tries: usize, is_wrong: impl Fn(&TokenStream) -> bool) -> TokenStream {
    let mut smallest = tokens;
    let mut place = 0;
    while place < count(&smallest) && tries > 0 {
        tries -= 1;
        let mut at = place;
        let smaller = without(smallest.clone(), &mut at);
        if is_wrong(&smaller) {
            smallest = smaller;
        } else {
            place += 1;
        }
    }
    smallest
}

fn without(tokens: TokenStream, place: &mut usize) -> TokenStream {
    let mut found: Vec<TokenTree> = Vec::new();
    for token in tokens {
        let here = *place == 0;
        *place = place.wrapping_sub(1);
        match token {
            _ if here => {}
            TokenTree::Group(group) if *place < usize::MAX / 2 => {
                let inside = without(group.stream(), place);
                found.push(regrouped(&group, inside));
            }
            token => found.push(token),
        }
    }
    found.into_iter().collect()
}
