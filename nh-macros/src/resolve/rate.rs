//! `der(e)`: rates of coordinates, and of expressions along the motion.

use nonholonomic_core::algebra::Derivation;
use nonholonomic_core::id::{ExprId, SymbolId};

use super::array::Array;
use super::context::Usage;
use super::reports::{Outcome, Reported};
use super::resolver::Resolver;
use super::scope::{Meaning, Role};
use crate::report::Diagnostic;
use crate::syntax::ast::{Expr, ExprKind, Place};

/// What is known of the rate of a symbol.
enum Rate {
    /// It is 0.
    Constant,
    /// It is this.
    Known(ExprId),
    /// It is no function of positions and velocities, because the symbol is this.
    Unknown(&'static str),
}

impl Resolver {
    /// `der(e)`
    pub(super) fn rate(&mut self, expr: &Expr, of: &Expr) -> Outcome<Array> {
        if let Some(place) = self.lone_coordinate(of) {
            if let Some(Meaning::Named(named)) = self.scope.get(&place.name.text).cloned()
                && named.role == Role::Auxiliary
            {
                let text = &place.name.text;
                let part = self.part(&format!("`{text}`"), named.shape, &place.indices)?;
                self.check_usage(expr, Usage::AuxiliaryRate, &format!("der({text})"), expr.extent)?;
                return self.symbols(expr, &named.rates, part);
            }
            let (named, part) = self.coordinate(&place)?;
            self.check_usage(expr, Usage::Rate, "der(…)", expr.extent)?;
            return self.symbols(expr, &named.rates, part);
        }
        let value = self.value(of)?;
        self.rate_of_value(of, value)
    }

    /// The rate of a value that stands at `at`, mathematics (31).
    pub(super) fn rate_of_value(&mut self, at: &Expr, value: Array) -> Outcome<Array> {
        let seeds = self.rates_in(at, &value)?;
        if seeds.is_empty() {
            return self.entrywise(value, |this, _| Ok(this.graph.zero()));
        }
        let auxiliary = self.tables.auxiliary.iter();
        let mut known: Vec<SymbolId> = auxiliary.map(|state| state.symbol).collect();
        if let Some((symbol, _)) = seeds.iter().find(|(symbol, _)| known.contains(symbol)) {
            let written = format!("der({})", self.graph.symbols()[*symbol]);
            self.check_usage(at, Usage::AuxiliaryRate, &written, at.extent)?;
        }
        known.push(self.time);
        if seeds.iter().any(|(symbol, _)| !known.contains(symbol)) {
            self.check_usage(at, Usage::Rate, "der(…)", at.extent)?;
        }
        self.derived(at, &value, seeds)
    }

    /// Whether a value changes along motions.
    pub(super) fn moves(&mut self, value: &Array) -> bool {
        let symbols = self.graph.symbols_in(&value.entries);
        symbols.into_iter().any(|symbol| !matches!(self.rate_of(symbol), Rate::Constant))
    }

    /// What a value depends on that the motion changes, beside the time.
    pub(super) fn moving_symbol(&mut self, value: ExprId) -> Option<SymbolId> {
        let symbols = self.graph.symbols_in(&[value]);
        symbols
            .into_iter()
            .find(|symbol| *symbol != self.time && !matches!(self.rate_of(*symbol), Rate::Constant))
    }

    /// A name that stands alone in `der(…)`, unless it is that of a value.
    fn lone_coordinate(&self, of: &Expr) -> Option<Place> {
        let (name, indices) = match &of.kind {
            ExprKind::Name(name) => (name, Vec::new()),
            ExprKind::Index(inner, indices) => match &inner.kind {
                ExprKind::Name(name) => (name, indices.clone()),
                _ => return None,
            },
            _ => return None,
        };
        match self.scope.get(&name.text) {
            Some(Meaning::Value(_) | Meaning::Argument(_) | Meaning::Shared(_) | Meaning::Function(_)) => {
                None
            }
            _ => Some(Place { name: name.clone(), indices, extent: of.extent }),
        }
    }

    /// The rates of the symbols in a value: Σ of them times ∂/∂symbol is ∂_t + ρ^i_α y^α ∂_i + ż ∂_z.
    fn rates_in(&mut self, of: &Expr, value: &Array) -> Outcome<Vec<(SymbolId, ExprId)>> {
        let mut seeds = Vec::new();
        for symbol in self.graph.symbols_in(&value.entries) {
            match self.rate_of(symbol) {
                Rate::Constant => {}
                Rate::Known(rate) => seeds.push((symbol, rate)),
                Rate::Unknown(noun) => return Err(self.no_rate(of, symbol, noun)),
            }
        }
        Ok(seeds)
    }

    /// The rate of a symbol.
    fn rate_of(&mut self, symbol: SymbolId) -> Rate {
        if symbol == self.time {
            return Rate::Known(self.graph.one());
        }
        let found = self.tables.coordinates.iter().find(|coordinate| coordinate.symbol == symbol);
        if let Some(rate) = found.map(|coordinate| coordinate.rate) {
            return Rate::Known(self.graph.symbol(rate));
        }
        let found = self.tables.auxiliary.iter().find(|state| state.symbol == symbol);
        if let Some(rate) = found.map(|state| state.rate) {
            return Rate::Known(self.graph.symbol(rate));
        }
        let tables = &self.tables;
        if tables.parameters.iter().any(|parameter| parameter.symbol == symbol) {
            return Rate::Constant;
        }
        if tables.inputs.iter().any(|input| input.symbol == symbol) {
            return Rate::Unknown(Role::Input.noun());
        }
        if self.tables.auxiliary.iter().any(|state| state.rate == symbol) {
            return Rate::Unknown("the rate of an auxiliary state");
        }
        if self.calls.iter().any(|call| call.symbol == symbol) {
            return Rate::Unknown("the value of a method");
        }
        Rate::Unknown("a velocity")
    }

    /// Reports that a symbol has no known rate, being what the noun says.
    fn no_rate(&mut self, of: &Expr, symbol: SymbolId, noun: &str) -> Reported {
        let name = &self.graph.symbols()[symbol];
        let way_out = match noun {
            "a velocity" => "accelerations are what is derived; they cannot be used",
            "an input" => "inputs have no known rates; an auxiliary state has: `auxiliary { der(z) = …; }`",
            _ => "take the rate of a formula instead",
        };
        let error = Diagnostic::new(
            of.extent,
            format!("the rate of this is not known, because it depends on `{name}`"),
        )
        .evidence(format!(
            "`{name}` is {noun}; `der` takes expressions of base coordinates, auxiliary states, parameters and `t`"
        ))
        .way_out(way_out);
        self.report(of, error)
    }

    /// The derivation with these seeds, entry by entry.
    pub(super) fn derived(
        &mut self,
        expr: &Expr,
        value: &Array,
        seeds: Vec<(SymbolId, ExprId)>,
    ) -> Outcome<Array> {
        let before = self.graph.len();
        let entries = Derivation::new(seeds).apply_all(&mut self.graph, &value.entries);
        self.reports.spend(expr.extent, self.graph.len() - before)?;
        Ok(Array { shape: value.shape, entries })
    }
}
