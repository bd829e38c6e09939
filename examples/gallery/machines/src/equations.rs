//! The equations of motion of a report in the words of TeX.

/// What is longer stays in the report.
const LONGEST: usize = 700;

/// The equations of motion of a report, those that can be read on a page; a last line says how many cannot.
pub fn of(report: &str) -> Vec<String> {
    let lines: Vec<&str> = report
        .lines()
        .skip_while(|line| *line != "Equations of motion")
        .skip(1)
        .map(str::trim)
        .take_while(|line| !line.is_empty())
        .collect();
    let (mut shown, mut long) = (Vec::new(), 0);
    for line in lines {
        match equation(line) {
            // that a velocity is the rate of its coordinate
            Some([left, right]) if left == right => {}
            Some([left, right]) if left.len() + right.len() < LONGEST => {
                shown.push(format!("{left} = {right}"))
            }
            _ => long += 1,
        }
    }
    if long > 0 {
        let others = if shown.is_empty() { "equations" } else { "more" };
        shown.push(format!(r"\text{{{long} {others}, too long for this page: see the report below}}"));
    }
    shown
}

/// The two sides of an equation, where they are read to their ends.
fn equation(line: &str) -> Option<[String; 2]> {
    let (left, right) = line.split_once(" = ")?;
    let mut sides = [left, right].into_iter().map(|side| {
        let mut reader = Reader { rest: side };
        let read = reader.sum()?;
        reader.rest.trim().is_empty().then_some(read.text)
    });
    Some([sides.next()??, sides.next()??])
}

/// How tightly an expression holds together.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum Tightness {
    Sum,
    Product,
    Atom,
}

struct Read {
    text: String,
    tightness: Tightness,
    /// A power may follow without parentheses.
    is_bare: bool,
}

impl Read {
    /// As a factor: with parentheses where it is a sum.
    fn as_factor(&self) -> String {
        if self.tightness == Tightness::Sum { enclosed(&self.text) } else { self.text.clone() }
    }
}

fn enclosed(text: &str) -> String {
    format!(r"\left({text}\right)")
}

/// The reader of infix expressions, which are those of reports.
struct Reader<'a> {
    rest: &'a str,
}

impl<'a> Reader<'a> {
    fn takes(&mut self, sign: &str) -> bool {
        let rest = self.rest.trim_start();
        let after = rest.strip_prefix(sign);
        self.rest = after.unwrap_or(rest);
        after.is_some()
    }

    fn sum(&mut self) -> Option<Read> {
        let mut terms = 0;
        let mut text = String::new();
        let mut tightness = Tightness::Product;
        loop {
            let sign = match (self.takes("-"), terms) {
                (true, _) => "-",
                (false, 0) => "",
                (false, _) if self.takes("+") => "+",
                (false, _) => break,
            };
            let term = self.product()?;
            terms += 1;
            if terms > 1 || !sign.is_empty() {
                tightness = Tightness::Sum;
            } else {
                tightness = term.tightness;
                if !matches!(self.rest.trim_start().chars().next(), Some('+' | '-')) {
                    return Some(term);
                }
            }
            // a sum after a sign is a sum in parentheses that the report wrote
            let term = if sign == "-" { term.as_factor() } else { term.text };
            text.extend([if terms > 1 { " " } else { "" }, sign, if terms > 1 { " " } else { "" }, &term]);
        }
        Some(Read { text, tightness, is_bare: false })
    }

    fn product(&mut self) -> Option<Read> {
        let first = self.power()?;
        let (mut above, mut below, mut alone) = (vec![first], Vec::new(), true);
        loop {
            if self.takes("*") {
                above.push(self.power()?);
            } else if self.takes("/") {
                below.push(self.power()?);
            } else {
                break;
            }
            alone = false;
        }
        if alone {
            return above.pop();
        }
        let numerator = |factors: &[Read]| match factors {
            [only] => only.text.clone(),
            several => several
                .iter()
                .filter(|factor| factor.text != "1")
                .map(Read::as_factor)
                .collect::<Vec<_>>()
                .join(r"\,"),
        };
        let text = if below.is_empty() {
            numerator(&above)
        } else {
            format!(r"\frac{{{}}}{{{}}}", numerator(&above), numerator(&below))
        };
        Some(Read { text, tightness: Tightness::Product, is_bare: false })
    }

    fn power(&mut self) -> Option<Read> {
        let base = self.atom()?;
        if !self.takes("^") {
            return Some(base);
        }
        let sign = if self.takes("-") { "-" } else { "" };
        let exponent = self.atom()?.text;
        // sin²φ, as it is written
        if let Some((function, argument)) =
            base.text.strip_prefix('\\').and_then(|rest| rest.split_once(r"{\left("))
            && matches!(function, "sin" | "cos" | "tan")
        {
            let text = format!(r"\{function}^{{{sign}{exponent}}}{{\left({argument}");
            return Some(Read { text, tightness: Tightness::Atom, is_bare: false });
        }
        let base = if base.is_bare { base.text } else { enclosed(&base.text) };
        Some(Read {
            text: format!("{base}^{{{sign}{exponent}}}"),
            tightness: Tightness::Atom,
            is_bare: false,
        })
    }

    fn atom(&mut self) -> Option<Read> {
        let atom = |text: String, is_bare| Some(Read { text, tightness: Tightness::Atom, is_bare });
        if self.takes("(") {
            let inside = self.sum()?;
            return self.takes(")").then_some(inside);
        }
        let word = self.word();
        if word.is_empty() {
            return None;
        }
        if word.starts_with(|c: char| c.is_ascii_digit()) {
            return atom(word.to_owned(), true);
        }
        if self.takes("(") {
            let argument = self.sum()?;
            if !self.takes(")") {
                return None;
            }
            return match word {
                "der" => match argument.text.strip_prefix(r"\dot") {
                    Some(symbol) => atom(format!(r"\ddot{symbol}"), true),
                    None => atom(format!(r"\dot{{{}}}", argument.text), true),
                },
                "sqrt" => atom(format!(r"\sqrt{{{}}}", argument.text), true),
                "sin" | "cos" | "tan" => atom(format!(r"\{word}{{{}}}", enclosed(&argument.text)), false),
                _ => None,
            };
        }
        let index = if self.takes("[") {
            let inside = self.word();
            self.takes("]").then_some(inside)?
        } else {
            ""
        };
        atom(named(word, index), true)
    }

    fn word(&mut self) -> &'a str {
        let rest = self.rest.trim_start();
        let is_inside = |c: char| c.is_alphanumeric() || c == '_' || c == '.';
        let (word, rest) = rest.split_at(rest.find(|c| !is_inside(c)).unwrap_or(rest.len()));
        self.rest = rest;
        word
    }
}

/// Greek letters and ends by their names.
const GREEK: [&str; 12] =
    ["theta", "phi", "psi", "omega", "delta", "lambda", "alpha", "beta", "gamma", "tau", "mu", "rho"];

/// A symbol: Greek letters by their names, a rate by its dot, the rest as a word, what follows `_` below.
fn named(word: &str, index: &str) -> String {
    let (word, is_rate) = word.strip_suffix("_dot").map_or((word, false), |word| (word, true));
    let (stem, mut below) = word.split_once('_').map_or((word, String::new()), |(a, b)| (a, b.to_owned()));
    let letters = stem.trim_end_matches(|c: char| c.is_ascii_digit());
    if letters.len() < stem.len() && !letters.is_empty() {
        below.insert_str(0, &stem[letters.len()..]);
    }
    let symbol = match letters {
        letter if letter.chars().count() == 1 => letter.to_owned(),
        greek if GREEK.contains(&greek) => format!(r"\{greek}"),
        word => format!(r"\mathrm{{{word}}}"),
    };
    let symbol = if is_rate { format!(r"\dot{{{symbol}}}") } else { symbol };
    let below: Vec<String> = [below.as_str(), index]
        .iter()
        .filter(|part| !part.is_empty())
        .map(|part| {
            if part.len() > 1 {
                format!(r"\mathrm{{{}}}", part.replace('_', r"\,"))
            } else {
                (*part).to_owned()
            }
        })
        .collect();
    if below.is_empty() { symbol } else { format!("{symbol}_{{{}}}", below.join(",")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equations_are_written_as_on_paper() {
        for (line, expected) in [
            ("der(theta) = omega", r"\dot{\theta} = \omega"),
            (
                "(J + m*a^2)*der(omega) = -omega*v*m*a",
                r"\left(J + m\,a^{2}\right)\,\dot{\omega} = -\omega\,v\,m\,a",
            ),
            ("(J)*der(w[0]) = x - (y - z)", r"J\,\dot{w_{0}} = x - \left(y - z\right)"),
            ("der(left) = (v - omega*b)/r", r"\dot{\mathrm{left}} = \frac{v - \omega\,b}{r}"),
            ("m/cos(phi)^2 = 0", r"\frac{m}{\cos^{2}{\left(\phi\right)}} = 0"),
            ("der(u1) = (x + y)^2*sqrt(z)", r"\dot{u_{1}} = \left(x + y\right)^{2}\,\sqrt{z}"),
            ("x_dot = lambda_blade*2", r"\dot{x} = \lambda_{\mathrm{blade}}\,2"),
            ("2*der(x_dot) = 0", r"2\,\ddot{x} = 0"),
            ("x = a/l/cos(phi)", r"x = \frac{a}{l\,\cos{\left(\phi\right)}}"),
        ] {
            assert_eq!(equation(line).map(|sides| sides.join(" = ")).as_deref(), Some(expected), "{line}");
        }
        assert_eq!(equation("x = … (812 operations)"), None);
    }

    #[test]
    fn every_machine_shows_equations() {
        for name in crate::NAMES {
            let machine = crate::machine(name).expect("it is in the gallery");
            let equations = of(machine.report());
            // those of the bicycle fill pages
            let is_shown = |line: &String| line.contains(" = ") || name == &"bicycle";
            assert!(equations.iter().any(is_shown), "{name}: {equations:?}");
        }
    }
}
