//! Resolved models by hand: names, then terms as texts.

use nonholonomic_core::algebra::{Facts, Graph, Rational};
use nonholonomic_core::id::{ExprId, Id, Origin, SymbolId, Table};
use nonholonomic_core::model::{
    AnchorDecl, BracketDecl, ConstraintDecl, Coordinate, Kinematics, Located, Model, OutputDecl, Parameter,
    Section,
};

pub(crate) fn origin() -> Origin {
    Origin::from_index(0)
}

/// A model without anything but names.
pub(crate) struct Builder {
    pub(crate) model: Model,
}

impl Builder {
    pub(crate) fn new(parameters: &[&str], coordinates: &[&str], sections: &[&str]) -> Self {
        let mut graph = Graph::new();
        let time = graph.new_symbol("t");
        let parameters = parameters
            .iter()
            .map(|name| Parameter { name: (*name).into(), symbol: graph.new_symbol(*name), origin: origin() })
            .collect();
        let tangent = sections.is_empty();
        let coordinates: Table<_, Coordinate> = coordinates
            .iter()
            .map(|name| Coordinate {
                name: (*name).into(),
                symbol: graph.new_symbol(*name),
                rate: graph.new_symbol(format!("{name}_dot")),
                origin: origin(),
            })
            .collect();
        let sections = if tangent {
            coordinates
                .iter()
                .map(|c| Section { name: format!("{}_dot", c.name), symbol: c.rate, origin: origin() })
                .collect()
        } else {
            sections
                .iter()
                .map(|name| Section {
                    name: (*name).into(),
                    symbol: graph.new_symbol(*name),
                    origin: origin(),
                })
                .collect()
        };
        let zero = graph.zero();
        let model = Model {
            graph,
            name: "Test".into(),
            origin: origin(),
            time,
            parameters,
            coordinates,
            sections,
            inputs: Table::new(),
            auxiliary: Vec::new(),
            identities: Vec::new(),
            calls: Vec::new(),
            dropped: Vec::new(),
            shortened: Vec::new(),
            claimed: Vec::new(),
            symmetric: Vec::new(),
            bodies: Vec::new(),
            frame: Vec::new(),
            impacts: Vec::new(),
            distribution: None,
            claims: Vec::new(),
            routh: Vec::new(),
            symmetries: Vec::new(),
            volume: None,
            hamilton_jacobi: None,
            assumptions: Vec::new(),
            facts: Facts::default(),
            requests: Vec::new(),
            kinematics: if tangent { Kinematics::Tangent } else { Kinematics::Anchor(Vec::new()) },
            brackets: Vec::new(),
            brackets_declared: false,
            almost: false,
            positions: Vec::new(),
            redundant: None,
            lagrangian: Located { value: zero, origin: origin() },
            constraints: Table::new(),
            forces: Vec::new(),
            outputs: Vec::new(),
            tracked: None,
            linearization: None,
            orthonormal: None,
            independent: None,
            chart: None,
            formulation: None,
            units: Vec::new(),
            idle: Vec::new(),
            idle_inputs: Vec::new(),
        };
        Self { model }
    }

    /// The symbol called `name`.
    pub(crate) fn symbol(&self, name: &str) -> SymbolId {
        self.model
            .graph
            .symbols()
            .iter_ids()
            .find(|(_, n)| *n == name)
            .map(|(id, _)| id)
            .expect("a known name")
    }

    /// A polynomial in names and their sines and cosines: `"m*w*w"` or `"sin(theta)*x_dot"`.
    pub(crate) fn term(&mut self, factor: Rational, text: &str) -> ExprId {
        let factors: Vec<(ExprId, Rational)> = text
            .split('*')
            .map(|word| {
                let inner =
                    word.strip_prefix("sin(").or(word.strip_prefix("cos(")).map(|w| w.trim_end_matches(')'));
                let symbol = self.symbol(inner.unwrap_or(word));
                let value = self.model.graph.symbol(symbol);
                let value = match &word[..3.min(word.len())] {
                    "sin" => self.model.graph.sin(value),
                    "cos" => self.model.graph.cos(value),
                    _ => value,
                };
                (value, Rational::ONE)
            })
            .collect();
        let product = self.model.graph.product(&factors);
        self.model.graph.scale(factor, product)
    }

    pub(crate) fn sum(&mut self, terms: &[(i64, i64, &str)]) -> ExprId {
        let terms: Vec<ExprId> =
            terms.iter().map(|(n, d, text)| self.term(Rational::new(*n, *d), text)).collect();
        self.model.graph.sum(&terms)
    }

    pub(crate) fn anchor(&mut self, lines: &[&[(i64, i64, &str)]]) {
        let lines: Vec<ExprId> = lines.iter().map(|line| self.sum(line)).collect();
        let lines = lines.into_iter().enumerate().map(|(index, rate)| AnchorDecl {
            coordinate: Id::from_index(index),
            rate,
            origin: origin(),
        });
        self.model.kinematics = Kinematics::Anchor(lines.collect());
    }

    pub(crate) fn bracket(&mut self, left: usize, right: usize, value: &[(i64, i64, &str)]) {
        let value = self.sum(value);
        self.model.brackets_declared = true;
        self.model.brackets.push(BracketDecl {
            left: Id::from_index(left),
            right: Id::from_index(right),
            value,
            origin: origin(),
            known: None,
        });
    }

    pub(crate) fn lagrangian(&mut self, terms: &[(i64, i64, &str)]) {
        self.model.lagrangian.value = self.sum(terms);
    }

    pub(crate) fn claim(&mut self, name: &str, value: ExprId) {
        self.model.claims.push(OutputDecl { name: name.into(), value, origin: origin() });
    }

    pub(crate) fn constraint(&mut self, terms: &[(i64, i64, &str)]) {
        let residual = self.sum(terms);
        self.model.constraints.push(ConstraintDecl {
            label: None,
            residual,
            solved_for: None,
            is_entry: false,
            origin: origin(),
        });
    }
}
