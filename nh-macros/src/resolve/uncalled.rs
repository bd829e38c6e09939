//! The bodies of functions that nothing calls: without values for the arguments there are no shapes, and only names, calls
//! and loop variables can be looked at.

use std::rc::Rc;

use super::array::Array;
use super::calls::Called;
use super::resolver::Resolver;
use super::scope::Meaning;
use super::tensors::Tensor;
use crate::syntax::ast::{Expr, ExprKind, Name};

impl Resolver {
    /// Reports what is wrong with the body of a function whatever its arguments are.
    pub(super) fn uncalled(&mut self, body: &Expr, arguments: &[Name]) {
        let any = Rc::new(Array::number(self.graph.zero()));
        let bound = arguments.iter().map(|name| (name.text.clone(), Meaning::Argument(Rc::clone(&any))));
        let outer = self.scope.exchange(bound.collect());
        let mut parts: Vec<&Expr> = Vec::new();
        body.walk(&mut |expr| parts.push(expr));
        let mut variables: Vec<&str> = Vec::new();
        for binder in parts.iter().filter_map(|part| match &part.kind {
            ExprKind::Sum(binders, _) => Some(binders),
            _ => None,
        }) {
            for name in binder.iter().map(|binder| &binder.name) {
                let fresh = self.scope.check_new(name);
                // one in error was reported
                let _ = self.keep(name, fresh);
                variables.push(&name.text);
            }
        }
        for part in parts {
            match &part.kind {
                ExprKind::Name(name) if !variables.contains(&name.text.as_str()) => {
                    match self.scope.get(&name.text) {
                        None => {
                            let error = self.scope.unknown(name);
                            self.reports.report_unknown(name, &name.text, error);
                        }
                        Some(Meaning::Function(place)) => {
                            let place = *place;
                            self.bare_function(place, part, name);
                        }
                        Some(_) => {}
                    }
                }
                ExprKind::Call(name, values) => self.uncalled_call(part, name, values.len()),
                _ => {}
            }
        }
        self.scope.exchange(outer);
    }

    /// Whether there is a function of this name that takes so many arguments.
    fn uncalled_call(&mut self, expr: &Expr, name: &Name, given: usize) {
        if matches!(self.scope.get(&name.text), Some(Meaning::Broken)) {
            return;
        }
        // what is wrong is reported there
        let _ = if let Some(tensor) = Tensor::named(&name.text) {
            self.count_of_tensor(tensor, expr, name, given)
        } else if let Some(called) = Called::named(&name.text) {
            self.count_of_called(&called, expr, name, given)
        } else if let Some(Meaning::Function(place)) = self.scope.get(&name.text) {
            let line = Rc::clone(&self.shared.lines[*place]);
            self.count_of_own(line.arguments.as_deref().unwrap_or_default(), expr, name, given)
        } else {
            Err(self.not_a_function(name))
        };
    }
}
