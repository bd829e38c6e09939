//! Constants become numbers: what is made of them alone is computed here, exactly, and like terms are
//! collected.

use super::nary::{Arena, Call, Nary, Source, System, Term};
use crate::algebra::Rational;
use crate::id::{Id, SymbolId};
use rustc_hash::FxHashMap;

/// The same arena with numbers for its constants. Common factors are found before, while constants keep
/// terms together, or after.
pub(super) fn folded(arena: &Arena) -> Arena {
    let mut into = Arena::default();
    into.parameters.clone_from(&arena.parameters);
    into.nameless.clone_from(&arena.nameless);
    let mut fold = Fold { from: arena, into, images: vec![None; arena.len()] };
    for term in arena.operands_first(&arena.outputs) {
        let image = fold.image(term);
        fold.images[term.index()] = Some(image);
    }
    fold.into.outputs = fold.all(&arena.outputs);
    fold.definitions();
    fold.into
}

/// What a term has become, up to its sign.
#[derive(Clone, Copy, Debug)]
struct Image {
    term: Term,
    negative: bool,
}

struct Fold<'a> {
    from: &'a Arena,
    into: Arena,
    images: Vec<Option<Image>>,
}

/// The factors of a term without its number.
type Rest = Vec<(Term, i32)>;

impl Fold<'_> {
    /// What becomes of a term, its operands first; zero for what nothing depends on.
    fn of(&mut self, term: Term) -> Image {
        self.images[term.index()].unwrap_or_else(|| self.number(&Rational::ZERO))
    }

    /// A term with its sign.
    fn whole(&mut self, term: Term) -> Term {
        let Image { term, negative } = self.of(term);
        match (negative, self.into.as_number(term).cloned()) {
            (false, _) => term,
            (true, Some(number)) => self.into.number(-number),
            (true, None) => self.into.intern(Nary::Neg(term)),
        }
    }

    fn all(&mut self, terms: &[Term]) -> Vec<Term> {
        terms.iter().map(|term| self.whole(*term)).collect()
    }

    fn number(&mut self, value: &Rational) -> Image {
        Image { term: self.into.number(value.abs()), negative: value.is_negative() }
    }

    fn plain(&mut self, nary: Nary) -> Image {
        Image { term: self.into.intern(nary), negative: false }
    }

    /// The definitions of symbols.
    fn definitions(&mut self) {
        let from = self.from;
        let mut symbols: Vec<SymbolId> = from.sources.keys().copied().collect();
        symbols.sort_unstable();
        for symbol in symbols {
            let source = match from.sources[&symbol] {
                Source::Value(value) => Source::Value(self.whole(value)),
                other => other,
            };
            self.into.sources.insert(symbol, source);
        }
        for Call { method, arguments } in &from.calls {
            let arguments = self.all(arguments);
            self.into.calls.push(Call { method: method.clone(), arguments });
        }
        for System { matrix, right } in &from.systems {
            let matrix = matrix.iter().map(|row| self.all(row)).collect();
            let right = self.all(right);
            self.into.systems.push(System { matrix, right });
        }
    }

    fn image(&mut self, term: Term) -> Image {
        let from = self.from;
        match from.get(term) {
            Nary::Number(value) | Nary::Constant(_, value) => self.number(value),
            Nary::Symbol(symbol) => match from.sources.get(symbol) {
                Some(Source::Value(value)) if self.is_number(*value) => self.of(*value),
                _ => self.plain(Nary::Symbol(*symbol)),
            },
            Nary::Sum(operands) => self.sum(operands),
            Nary::Product(factors) => self.product(factors),
            Nary::Quotient(a, b) => self.product(&[(*a, 1), (*b, -1)]),
            Nary::Recip(a) => self.product(&[(*a, -1)]),
            Nary::Neg(a) => {
                let Image { term, negative } = self.of(*a);
                Image { term, negative: !negative }
            }
            Nary::Sqrt(a) => {
                let inside = self.whole(*a);
                match self.into.as_number(inside).and_then(Rational::sqrt) {
                    Some(root) => self.number(&root),
                    None => self.plain(Nary::Sqrt(inside)),
                }
            }
            Nary::Pi => self.plain(Nary::Pi),
            Nary::Power(a, exponent) => {
                let base = self.whole(*a);
                self.plain(Nary::Power(base, *exponent))
            }
            Nary::Cbrt(a) => {
                let inside = self.whole(*a);
                self.plain(Nary::Cbrt(inside))
            }
            Nary::PowReal(a, exponent) => {
                let base = self.whole(*a);
                self.plain(Nary::PowReal(base, exponent.clone()))
            }
            Nary::Apply(function, a) => {
                let argument = self.whole(*a);
                self.plain(Nary::Apply(*function, argument))
            }
            Nary::Apply2(function, a, b) => {
                let (a, b) = (self.whole(*a), self.whole(*b));
                self.plain(Nary::Apply2(*function, a, b))
            }
        }
    }

    fn is_number(&mut self, term: Term) -> bool {
        let image = self.of(term);
        self.into.as_number(image.term).is_some()
    }

    /// Numbers are multiplied, signs taken out.
    fn product(&mut self, factors: &[(Term, i32)]) -> Image {
        let mut number = Rational::ONE;
        let mut rest = Rest::with_capacity(factors.len() + 1);
        for (base, exponent) in factors {
            let Image { term, negative } = self.of(*base);
            if negative && exponent % 2 != 0 {
                number = -number;
            }
            let power = self.into.as_number(term).and_then(|value| value.pow(i64::from(*exponent)));
            match power {
                Some(power) if is_short(&power) && is_short(&number) => number = number * power,
                _ => rest.push((term, *exponent)),
            }
        }
        self.multiple(&number, rest)
    }

    fn multiple(&mut self, number: &Rational, mut rest: Rest) -> Image {
        if number.is_zero() || rest.is_empty() {
            return self.number(number);
        }
        if !number.abs().is_one() {
            rest.push((self.into.number(number.abs()), 1));
        }
        Image { term: self.into.product(rest), negative: number.is_negative() }
    }

    /// Numbers are added, and so are the numbers of like terms.
    fn sum(&mut self, operands: &[(Term, bool)]) -> Image {
        let mut constant = Rational::ZERO;
        let mut places: FxHashMap<Rest, usize> = FxHashMap::default();
        // the number, what is left, and the operand itself as long as it is the only one
        let mut terms: Vec<(Rational, Rest, Option<Image>)> = Vec::with_capacity(operands.len());
        for (operand, minus) in operands {
            let image = self.of(*operand);
            let negative = image.negative != *minus;
            let (number, rest) = self.split(image.term);
            let number = if negative { -number } else { number };
            if rest.is_empty() {
                constant = constant + number;
            } else if let Some(place) = places.get(&rest) {
                let (sum, _, alone) = &mut terms[*place];
                *sum = sum.clone() + number;
                *alone = None;
            } else {
                places.insert(rest.clone(), terms.len());
                terms.push((number, rest, Some(Image { term: image.term, negative })));
            }
        }
        let mut list: Vec<(Term, bool)> = Vec::with_capacity(terms.len() + 1);
        for (number, rest, alone) in terms {
            if !number.is_zero() {
                let Image { term, negative } = alone.unwrap_or_else(|| self.multiple(&number, rest));
                list.push((term, negative));
            }
        }
        if !constant.is_zero() || list.is_empty() {
            let Image { term, negative } = self.number(&constant);
            list.push((term, negative));
        }
        if let [(term, negative)] = *list {
            return Image { term, negative };
        }
        let negative = list.iter().all(|(_, negative)| *negative);
        if negative {
            for (_, minus) in &mut list {
                *minus = false;
            }
        }
        list.sort_unstable();
        Image { term: self.into.intern(Nary::Sum(list.into())), negative }
    }

    /// A term as a number times what is left.
    fn split(&self, term: Term) -> (Rational, Rest) {
        match self.into.get(term) {
            Nary::Number(value) => (value.clone(), Rest::new()),
            Nary::Product(factors) => {
                let mut number = Rational::ONE;
                let mut rest = factors.to_vec();
                rest.retain(|(base, exponent)| match self.into.as_number(*base) {
                    Some(value) if *exponent == 1 => {
                        number = number.clone() * value.clone();
                        false
                    }
                    _ => true,
                });
                (number, rest)
            }
            _ => (Rational::ONE, vec![(term, 1)]),
        }
    }
}

/// Whether arithmetic with a number takes no time worth mentioning.
pub(super) fn is_short(number: &Rational) -> bool {
    number.to_small().is_some() || number.bits() <= Rational::MAX_BITS
}
