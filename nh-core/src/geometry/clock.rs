//! What changes along every motion whatever the velocity is: the time, and auxiliary states.

use crate::algebra::Graph;
use crate::id::{ExprId, SymbolId};

/// The time t, with ṫ = 1, and auxiliary states z, with ż = g(t, x, y, z, u), mathematics (40).
///
/// To geometry and mechanics z is a given function of the time: where a coefficient of a constraint depends on
/// it, Ḃ, ẏ₀ and φ̇ have ∂_z(·) ż beside ∂_t(·). The rates ż stand as symbols, whose values g are intermediate
/// results of what is generated, so that accelerations and multipliers may depend on inputs through them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Clock {
    /// The time t.
    pub time: SymbolId,
    /// Auxiliary states z with the symbols of their rates ż.
    pub auxiliary: Vec<(SymbolId, SymbolId)>,
}

impl Clock {
    /// The time alone.
    #[must_use]
    pub fn of_time(time: SymbolId) -> Self {
        Self { time, auxiliary: Vec::new() }
    }

    /// t and z.
    #[must_use]
    pub fn symbols(&self) -> Vec<SymbolId> {
        [self.time].into_iter().chain(self.auxiliary.iter().map(|(state, _)| *state)).collect()
    }

    /// t and z with their rates.
    pub fn rates(&self, graph: &mut Graph) -> Vec<(SymbolId, ExprId)> {
        let one = graph.one();
        let auxiliary = self.auxiliary.iter().map(|(state, rate)| (*state, graph.symbol(*rate)));
        [(self.time, one)].into_iter().chain(auxiliary).collect()
    }

    /// ∂_t f + ż ∂_z f.
    pub fn rate(&self, graph: &mut Graph, function: ExprId) -> ExprId {
        let mut rate = graph.partial(function, self.time);
        for (state, speed) in &self.auxiliary {
            let slope = graph.partial(function, *state);
            let speed = graph.symbol(*speed);
            rate = graph.formula(rate + slope * speed);
        }
        rate
    }

    /// Whether a function depends on t or z.
    #[must_use]
    pub fn moves(&self, graph: &Graph, function: ExprId) -> bool {
        graph.depends_on(function, &self.symbols())
    }

    /// Whether t or z occurs in some functions.
    #[must_use]
    pub fn occurs_in(&self, graph: &Graph, functions: &[ExprId]) -> bool {
        let present = graph.symbols_in(functions);
        self.symbols().iter().any(|symbol| present.contains(symbol))
    }
}
