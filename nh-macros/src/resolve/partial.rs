//! `diff(e, x)`: partial derivatives by coordinates, parameters, the time, velocities, and by arguments of the
//! function that is defined.

use nonholonomic_core::algebra::{Derivation, Substitution};
use nonholonomic_core::id::{ExprId, SymbolId};

use super::array::{Array, Shape};
use super::reports::Outcome;
use super::resolver::Resolver;
use super::scope::Meaning;
use crate::report::Diagnostic;
use crate::syntax::ast::{Expr, ExprKind};

/// What a derivative is taken by.
const TAKES: &str =
    "a derivative is taken by base coordinates, parameters, `t`, velocities, or arguments of the function";

impl Resolver {
    /// `diff(e, x)`; by a vector or a list: a gradient.
    pub(super) fn partial(&mut self, expr: &Expr, of: &Expr, by: &Expr) -> Outcome<Array> {
        let parts: Vec<&Expr> = match &by.kind {
            ExprKind::Vector(parts) => parts.iter().collect(),
            _ => vec![by],
        };
        // arguments of the function that is defined are symbols while the derivative is taken
        let mut stood_for: Vec<(SymbolId, ExprId)> = Vec::new();
        let mut replaced: Vec<(String, Meaning)> = Vec::new();
        for part in &parts {
            let Some((name, value)) = self.argument(part) else { continue };
            if replaced.iter().any(|(known, _)| *known == name) {
                continue;
            }
            let symbols: Vec<SymbolId> = (0..value.shape.len())
                .map(|k| self.graph.new_symbol(value.shape.entry_name(&name, k)))
                .collect();
            stood_for.extend(symbols.iter().copied().zip(value.entries.iter().copied()));
            let entries = symbols.iter().map(|symbol| self.graph.symbol(*symbol)).collect();
            let free = Meaning::Argument(std::rc::Rc::new(Array { shape: value.shape, entries }));
            let bound = self.scope.rebind(&name, free);
            replaced.extend(bound.map(|meaning| (name, meaning)));
        }
        let variables = self.variables(by, &parts, &stood_for);
        let value = self.value(of);
        for (name, meaning) in replaced {
            self.scope.rebind(&name, meaning);
        }
        let ((variables, shape), value) = (variables?, value?);
        self.depends_on_time_itself(expr, &value, &variables)?;
        let value = self.with_rates_known(of, value, &variables, &stood_for)?;
        let gradient = self.gradient(expr, &value, &variables, shape)?;
        if stood_for.is_empty() {
            return Ok(gradient);
        }
        let entries = Substitution::new(stood_for).apply_all(&mut self.graph, &gradient.entries);
        Ok(Array { shape: gradient.shape, entries })
    }

    /// The argument of a function that an expression names, or a part of it.
    fn argument(&self, part: &Expr) -> Option<(String, Array)> {
        let name = match &part.kind {
            ExprKind::Name(name) => name,
            ExprKind::Index(of, _) => match &of.kind {
                ExprKind::Name(name) => name,
                _ => return None,
            },
            _ => return None,
        };
        match self.scope.get(&name.text) {
            Some(Meaning::Argument(value)) => Some((name.text.clone(), (**value).clone())),
            _ => None,
        }
    }

    /// The symbols that a derivative is taken by, and the shape of a gradient.
    fn variables(
        &mut self,
        by: &Expr,
        parts: &[&Expr],
        arguments: &[(SymbolId, ExprId)],
    ) -> Outcome<(Vec<SymbolId>, Shape)> {
        let mut variables = Vec::new();
        let mut shape = Shape::Number;
        for part in parts {
            let value = self.value(part)?;
            shape = value.shape;
            for entry in &value.entries {
                match self.graph.as_symbol(*entry) {
                    Some(symbol) if self.is_variable(symbol, arguments) => variables.push(symbol),
                    _ => {
                        let what = format!(
                            "`{}` is nothing that a derivative is taken by",
                            self.graph.text_within(*entry, 40)
                        );
                        let error = Diagnostic::new(part.extent, what).way_out(TAKES);
                        return Err(self.report(*part, error));
                    }
                }
            }
        }
        if matches!(by.kind, ExprKind::Vector(_)) {
            shape = Shape::Vector(variables.len());
        }
        Ok((variables, shape))
    }

    /// Whether a symbol stands for itself: the rate of a coordinate where there is a basis follows from others.
    fn is_variable(&self, symbol: SymbolId, arguments: &[(SymbolId, ExprId)]) -> bool {
        let tables = &self.tables;
        let is_rate = tables.coordinates.iter().any(|coordinate| coordinate.rate == symbol);
        let is_velocity = tables.sections.iter().any(|section| section.symbol == symbol);
        let is_call = self.calls.iter().any(|call| call.symbol == symbol);
        arguments.iter().any(|(known, _)| *known == symbol) || is_velocity || !(is_rate || is_call)
    }

    /// Refuses ∂/∂t of what moves and does not depend on the time itself: it is zero, and what is meant is a rate.
    fn depends_on_time_itself(&mut self, expr: &Expr, value: &Array, variables: &[SymbolId]) -> Outcome<()> {
        if variables != [self.time]
            || self.graph.symbols_in(&value.entries).contains(&self.time)
            || !self.moves(value)
        {
            return Ok(());
        }
        let error =
            Diagnostic::new(expr.extent, "this derivative is zero: `t` is not in what is differentiated")
                .evidence("`diff` holds coordinates and velocities fixed")
                .way_out("`der(…)` is the rate along the motion");
        Err(self.report(expr, error))
    }

    /// Puts ρ(y) for the rates in a value, which depend on coordinates, parameters and velocities.
    fn with_rates_known(
        &mut self,
        of: &Expr,
        value: Array,
        variables: &[SymbolId],
        arguments: &[(SymbolId, ExprId)],
    ) -> Outcome<Array> {
        let symbols = self.graph.symbols_in(&value.entries);
        if let Some(call) = self.calls.iter().find(|call| symbols.contains(&call.symbol)) {
            let method = call.method.clone();
            let error = Diagnostic::new(of.extent, format!("the derivative of `self.{method}` is not known"))
                .evidence("what a method computes is not known when the equations are derived")
                .way_out("differentiate a formula");
            return Err(self.report(of, error));
        }
        let all_arguments =
            variables.iter().all(|variable| arguments.iter().any(|(known, _)| known == variable));
        if all_arguments || !self.has_rates(&symbols) {
            return Ok(value);
        }
        self.along_anchor(&value).ok_or_else(|| {
            let error = Diagnostic::new(of.extent, "a derivative of something with `der(…)`")
                .evidence("with `velocities` the rates are functions of the quasi-velocities and the base")
                .way_out("write it with the names of the quasi-velocities");
            self.report(of, error)
        })
    }

    /// ∂/∂x for each variable, entry by entry.
    fn gradient(
        &mut self,
        expr: &Expr,
        value: &Array,
        variables: &[SymbolId],
        shape: Shape,
    ) -> Outcome<Array> {
        let joined = match (value.shape, shape) {
            (of, Shape::Number) => Some(of),
            (Shape::Number, by) => Some(by),
            (Shape::Vector(rows), Shape::Vector(columns)) => Some(Shape::Matrix(rows, columns)),
            _ => None,
        };
        let Some(joined) = joined else {
            let error = Diagnostic::new(expr.extent, "a derivative with more than two indices")
                .evidence(format!("{} is differentiated by {shape}", value.shape))
                .way_out("take single entries");
            return Err(self.report(expr, error));
        };
        let before = self.graph.len();
        let mut columns = Vec::with_capacity(variables.len());
        for variable in variables {
            columns.push(
                Derivation::partial(&mut self.graph, *variable).apply_all(&mut self.graph, &value.entries),
            );
        }
        self.reports.spend(expr.extent, self.graph.len() - before)?;
        let entries = (0..value.entries.len()).flat_map(|k| columns.iter().map(move |column| column[k]));
        Ok(Array { shape: joined, entries: entries.collect() })
    }

    /// Whether rates that are no velocities are among the symbols.
    pub(super) fn has_rates(&self, symbols: &[SymbolId]) -> bool {
        let is_section = |symbol| self.tables.sections.iter().any(|section| section.symbol == symbol);
        self.tables
            .coordinates
            .iter()
            .any(|coordinate| symbols.contains(&coordinate.rate) && !is_section(coordinate.rate))
    }

    /// A value with ρ(y) for the rates, where the anchor is given.
    pub(super) fn along_anchor(&mut self, value: &Array) -> Option<Array> {
        let symbols = self.graph.symbols_in(&value.entries);
        if !self.has_rates(&symbols) {
            return Some(value.clone());
        }
        let images = self.anchor_lines.clone()?;
        let entries = Substitution::new(images).apply_all(&mut self.graph, &value.entries);
        Some(Array { shape: value.shape, entries })
    }
}
