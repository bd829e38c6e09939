//! The derivatives of the methods that forces and outputs call.

use std::collections::BTreeSet;

use super::resolver::Resolver;
use crate::report::{Diagnostic, Extent};
use crate::suggest::did_you_mean;
use crate::syntax::ast::MethodDerivative;

impl Resolver {
    /// Gives each call the methods that differentiate it. Forces and outputs come first.
    pub(super) fn derivatives(&mut self, declared: &[MethodDerivative]) {
        let mut seen = BTreeSet::new();
        for line in declared {
            let method = &line.method;
            if !seen.insert(method.text.as_str()) {
                let what = format!("the derivatives of `self.{}` are given twice", method.text);
                self.report(line, Diagnostic::new(method.extent(), what).way_out("keep one of the lines"));
                continue;
            }
            self.derivatives_of(line);
        }
    }

    fn derivatives_of(&mut self, line: &MethodDerivative) {
        let MethodDerivative { method, derivatives } = line;
        let given = derivatives.len();
        let names: Vec<String> = derivatives.iter().map(|name| name.text.clone()).collect();
        for name in derivatives {
            self.methods.entry(name.text.clone()).or_insert_with(|| name.ident.clone());
        }
        let (mut called, mut wanted) = (false, None);
        for call in self.calls.iter_mut().filter(|call| call.method == method.text) {
            called = true;
            if call.arguments.len() == given {
                call.derivatives = Some(names.clone());
            } else {
                wanted = wanted.or(Some(call.arguments.len()));
            }
        }
        if let Some(wanted) = wanted {
            let extent = match (derivatives.first(), derivatives.last()) {
                (Some(first), Some(last)) => first.extent().to(last.extent()),
                _ => method.extent(),
            };
            let error = Self::wrong_number(line, extent, wanted);
            self.report(line, error);
        } else if !called && !self.reports.any() {
            // a call that is in error is not known
            let known: Vec<&str> = self.calls.iter().map(|call| call.method.as_str()).collect();
            let error =
                Diagnostic::new(method.extent(), format!("`self.{}` is not called anywhere", method.text));
            let error = match did_you_mean(&method.text, known) {
                Some(question) => error.way_out(question),
                None => error
                    .evidence("derivatives are of methods that `forces` or `outputs` call")
                    .way_out("leave this line out"),
            };
            self.report(line, error);
        }
    }

    fn wrong_number(line: &MethodDerivative, at: Extent, wanted: usize) -> Diagnostic {
        let (method, given) = (&line.method.text, line.derivatives.len());
        let is = |count: usize| if count == 1 { "1 derivative is" } else { "derivatives are" };
        let given = if given == 1 { is(1).to_owned() } else { format!("{given} {}", is(given)) };
        let arguments = if wanted == 1 { "1 argument".to_owned() } else { format!("{wanted} arguments") };
        let example: Vec<String> = (1..=wanted).map(|k| format!("self.{method}_d{k}")).collect();
        Diagnostic::new(at, format!("`self.{method}` is called with {arguments}, and {given} given"))
            .evidence("there is one derivative for each argument, in their order")
            .way_out(format!("write `{method}: [{}];`", example.join(", ")))
    }
}
