//! Verified systems written by hand, to test the emitters apart from the derivation.

use nonholonomic_core::algebra::{Facts, Graph, Rational};
use nonholonomic_core::functions::{ENERGY, Functions, MULTIPLIERS, OUTPUTS, REACTIONS, RESIDUAL, VELOCITY};
use nonholonomic_core::id::{ExprId, Id, Origin, SymbolId, Table};
use nonholonomic_core::mechanics::{Definition, Procedure};
use nonholonomic_core::model::{
    ConstraintDecl, Coordinate, Formulation, Input, Kinematics, Located, Model, OutputDecl, Parameter,
    Section,
};
use nonholonomic_core::system::{ParameterCheck, Projection, System};
use proc_macro2::TokenStream;

use super::layout::{Family, Layout};
use crate::syntax;

/// A sample's declaration: the attribute, and the struct.
pub(crate) struct Sample {
    /// The attribute's tokens.
    pub(crate) attribute: TokenStream,
    /// The struct's tokens.
    pub(crate) item: TokenStream,
}

/// The layout of a declaration whose families stand in `base`, `basis`, `inputs` and `outputs`.
pub(crate) fn layout(sample: &Sample) -> Layout {
    let declaration =
        syntax::parse(sample.attribute.clone(), sample.item.clone()).expect("the sample is well-formed");
    let sections = declaration.sections;
    let mut layout = Layout::of_struct(&declaration.structure, sample.attribute.clone());
    let families = |declared: &[syntax::ast::Declared]| declared.iter().map(Family::from).collect();
    layout.coordinates = sections.base.map_or_else(Vec::new, |s| families(&s.body));
    layout.velocities = sections.basis.map_or_else(Vec::new, |s| families(&s.body));
    layout.inputs = sections.inputs.map_or_else(Vec::new, |s| families(&s.body));
    let outputs = sections.outputs.map_or_else(Vec::new, |s| s.body);
    for item in outputs {
        if let syntax::ast::Item::One(definition) = item {
            layout.outputs.push(Family {
                ident: definition.name.ident.clone(),
                lengths: Vec::new(),
                docs: definition.docs.clone(),
                units: Vec::new(),
            });
        }
    }
    // the symbols of a `Builder` are numbered in this order, after the time
    let count = |families: &[Family]| families.iter().map(|family| family.entries().len()).sum::<usize>();
    let first = 1 + count(&layout.parameters) + count(&layout.coordinates);
    layout.coordinate_symbols = (1 + count(&layout.parameters)..first).map(SymbolId::from_index).collect();
    layout.velocity_symbols = (first..first + count(&layout.velocities)).map(SymbolId::from_index).collect();
    layout
}

/// The names of all entries.
fn names_of(families: &[Family]) -> impl Iterator<Item = String> {
    families.iter().flat_map(Family::names)
}

/// A model with the symbols of a layout and nothing else.
pub(crate) struct Builder {
    pub(crate) graph: Graph,
    pub(crate) model: Model,
}

impl Builder {
    pub(crate) fn new(layout: &Layout) -> Self {
        let mut graph = Graph::new();
        let origin = Origin::from_index(0);
        let time = graph.new_symbol("t");
        let mut symbols = |families: &[Family]| -> Vec<(String, SymbolId)> {
            let mut found = Vec::new();
            for name in names_of(families) {
                found.push((name.clone(), graph.new_symbol(name)));
            }
            found
        };
        let parameters = symbols(&layout.parameters);
        let coordinates = symbols(&layout.coordinates);
        let sections = symbols(&layout.velocities);
        let inputs = symbols(&layout.inputs);
        let zero = graph.zero();
        let model = Model {
            graph: Graph::new(),
            name: layout.name.to_string(),
            origin,
            time,
            parameters: table(parameters, |name, symbol| Parameter { name, symbol, origin }),
            coordinates: table(coordinates, |name, symbol| Coordinate { name, symbol, rate: symbol, origin }),
            sections: table(sections, |name, symbol| Section { name, symbol, origin }),
            auxiliary: Vec::new(),
            inputs: table(inputs, |name, symbol| Input { name, symbol, origin }),
            kinematics: Kinematics::Tangent,
            brackets: Vec::new(),
            brackets_declared: false,
            almost: false,
            positions: Vec::new(),
            redundant: None,
            lagrangian: Located { value: zero, origin },
            constraints: Table::new(),
            forces: Vec::new(),
            outputs: names_of(&layout.outputs).map(|name| OutputDecl { name, value: zero, origin }).collect(),
            identities: Vec::new(),
            frame: Vec::new(),
            impacts: Vec::new(),
            distribution: None,
            claims: Vec::new(),
            symmetries: Vec::new(),
            volume: None,
            hamilton_jacobi: None,
            routh: Vec::new(),
            calls: Vec::new(),
            dropped: Vec::new(),
            shortened: Vec::new(),
            claimed: Vec::new(),
            symmetric: Vec::new(),
            bodies: Vec::new(),
            assumptions: Vec::new(),
            facts: Facts::default(),
            requests: Vec::new(),
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
        Self { graph, model }
    }

    /// The expression of a name.
    pub(crate) fn symbol(&mut self, name: &str) -> ExprId {
        let symbols = self.graph.symbols();
        let id = symbols.ids().find(|id| symbols[*id] == name).expect("the name is declared");
        self.graph.symbol(id)
    }

    /// `coefficient · Π name^exponent`.
    pub(crate) fn term(&mut self, coefficient: Rational, factors: &[(&str, i64)]) -> ExprId {
        let factors: Vec<_> =
            factors.iter().map(|(name, e)| (self.symbol(name), Rational::from(*e))).collect();
        let product = self.graph.product(&factors);
        self.graph.scale(coefficient, product)
    }

    pub(crate) fn system(
        mut self,
        kept: &[usize],
        procedures: [Procedure; 4],
        nonzero: &[(ExprId, &str)],
    ) -> System {
        self.model.graph = self.graph;
        let velocities: Vec<SymbolId> = self.model.sections.iter().map(|section| section.symbol).collect();
        let [derivative, energy, velocity, observables] = procedures;
        let coordinates = self.model.coordinates.iter().map(|coordinate| coordinate.symbol).collect();
        let mut functions = Functions::default();
        functions.add(&ENERGY, energy);
        functions.add(&VELOCITY, velocity);
        functions.add(&OUTPUTS, observables);
        System {
            model: self.model,
            formulation: Formulation::Adapted,
            state_coordinates: coordinates,
            state_velocities: kept.iter().map(|index| velocities[*index]).collect(),
            state_auxiliary: Vec::new(),
            derivative,
            functions,
            momenta: Vec::new(),
            quadratures: Vec::new(),
            gyroscopic: Vec::new(),
            positions: None,
            projection: None,
            linearized: None,
            products: Vec::new(),
            linearization: None,
            impacts: Vec::new(),
            phase_space: nonholonomic_core::phase_space::PhaseSpace::default(),
            embedding: None,
            parameter_checks: nonzero
                .iter()
                .map(|(nonzero, text)| ParameterCheck { nonzero: *nonzero, text: (*text).to_owned() })
                .collect(),
            ledger: nonholonomic_core::choose::Ledger::default(),
            report: "Derived by hand.".to_owned(),
            equations: vec!["x' = …".to_owned()],
            latex: None,
            derivatives_go_on: false,
        }
    }
}

fn table<I: Id, T>(symbols: Vec<(String, SymbolId)>, entry: impl Fn(String, SymbolId) -> T) -> Table<I, T> {
    symbols.into_iter().map(|(name, symbol)| entry(name, symbol)).collect()
}

fn sample(attribute: &str, item: &str) -> Sample {
    let tokens = |text: &str| text.parse().expect("the sample lexes");
    Sample { attribute: tokens(attribute), item: tokens(item) }
}

/// The Chaplygin sleigh, CLMM section 6.1.
pub(crate) fn sleigh() -> Sample {
    sample(
        "base { theta, /// Along the first axis. \n x, y } basis { omega, v1, v2 } \
         lagrangian { 0 } constraints { v2 = 0; } inputs { torque } outputs { speed = v1; E = v1; }",
        "/// A rigid body on a plane, carried by a knife edge.\n #[derive(Clone, Copy, Debug)] \
         pub struct Sleigh { /** Mass. */ pub m: f64, /** Inertia. */ pub J: f64, /** Offset. */ pub a: f64, \
         /** Not used. */ pub c: f64 }",
    )
}

/// The equations of [`sleigh`].
pub(crate) fn sleigh_system(layout: &Layout) -> System {
    let mut b = Builder::new(layout);
    let [theta, v1, omega, torque, j] = ["theta", "v1", "omega", "torque", "J"].map(|name| b.symbol(name));
    let (sin, cos) = (b.graph.sin(theta), b.graph.cos(theta));
    let (dx, dy) = (b.graph.formula(v1 * cos), b.graph.formula(v1 * sin));
    let maa = b.term(Rational::ONE, &[("m", 1), ("a", 2)]);
    let inertia = b.graph.formula(j + maa);
    let gyroscopic = b.term(Rational::ONE, &[("m", 1), ("a", 1), ("omega", 1), ("v1", 1)]);
    let domega = b.graph.formula((torque - gyroscopic) / inertia);
    let dv = b.term(Rational::ONE, &[("a", 1), ("omega", 2)]);
    let squared = b.graph.square(omega);
    let rotation = b.graph.formula(inertia * squared);
    let translation = b.term(Rational::ONE, &[("m", 1), ("v1", 2)]);
    let (half, zero) = (Rational::new(1, 2), b.graph.zero());
    let energy = b.graph.linear_combination(&[(half.clone(), rotation), (half, translation)]);
    let v_squared = b.graph.square(v1);
    let speed = b.graph.sqrt(v_squared);
    let procedures = [
        Procedure::of(vec![omega, dx, dy, domega, dv]),
        Procedure::of(vec![energy]),
        Procedure::of(vec![omega, v1, zero]),
        Procedure::of(vec![speed, energy]),
    ];
    b.system(&[0, 1], procedures, &[(inertia, "J + m*a^2")])
}

/// Families with two indices and kept in part, a type parameter, a linear system.
pub(crate) fn chain() -> Sample {
    sample(
        "base { q[2], R[2][2] } basis { w[3], u } lagrangian { 0 } constraints { u = 0; w[1] = 0; }",
        "pub struct Chain<T = f64> { /** Inertias. */ pub I: [[T; 2]; 2], /** Mass. */ pub r#type: T }",
    )
}

/// The equations of [`chain`]: not those of a real system.
pub(crate) fn chain_system(layout: &Layout) -> System {
    let mut b = Builder::new(layout);
    let [w0, w2, q0, q1, mass] = ["w[0]", "w[2]", "q[0]", "q[1]", "type"].map(|name| b.symbol(name));
    let matrix = [["I[0][0]", "I[0][1]"], ["I[1][0]", "I[1][1]"]];
    let matrix: Vec<Vec<ExprId>> =
        matrix.iter().map(|row| row.iter().map(|name| b.symbol(name)).collect()).collect();
    let angle = b.graph.formula(q0 - q1);
    let (sin, cos) = (b.graph.sin(angle), b.graph.cos(angle));
    let third = b.graph.scale(Rational::new(1, 3), cos);
    let exp = b.graph.apply(nonholonomic_core::algebra::Function::Exp, q0);
    let root = b.graph.pow(exp, Rational::new(2, 7));
    let (pi, one) = (b.graph.pi(), b.graph.one());
    let shifted = b.graph.formula(root + pi);
    let unknowns = vec![b.graph.new_symbol("a_w0"), b.graph.new_symbol("a_w2")];
    let (a0, a2) = (b.graph.symbol(unknowns[0]), b.graph.symbol(unknowns[1]));
    let mut derivative = Procedure::default();
    let ratio = b.graph.formula(sin / mass);
    let forced = derivative.define(&mut b.graph, "force_1", ratio);
    derivative.definitions.push(Definition::Solve { unknowns, matrix, right: vec![forced, third] });
    let decay = b.graph.formula(one - shifted);
    let sum = b.graph.formula(a2 + forced);
    derivative.outputs = vec![w0, w2, sin, third, exp, decay, a0, sum];
    let energy = b.term(Rational::new(1, 2), &[("type", 1), ("w[0]", 2)]);
    let zero = b.graph.zero();
    let procedures = [
        derivative,
        Procedure::of(vec![energy]),
        Procedure::of(vec![w0, zero, w2, zero]),
        Procedure::default(),
    ];
    b.system(&[0, 2], procedures, &[])
}

/// Two constraints in the projected formulation, one of them labelled with a keyword.
pub(crate) fn rails() -> Sample {
    sample(
        "base { x } basis { w[2], v } lagrangian { 0 } constraints { w[1] = x * w[0]; r#type: v = w[1]; }",
        "struct Rails { m: f64 }",
    )
}

/// The equations of [`rails`]: the constraints, and a projection that is not orthogonal.
pub(crate) fn rails_system(layout: &Layout) -> System {
    let mut b = Builder::new(layout);
    let [x, w0, w1, v, mass] = ["x", "w[0]", "w[1]", "v", "m"].map(|name| b.symbol(name));
    let start = ["w_0_start", "w_1_start", "v_start"].map(|name| b.graph.new_symbol(name));
    let [s0, s1, s2] = start.map(|symbol| b.graph.symbol(symbol));
    let zero = b.graph.zero();
    let along = b.graph.formula(x * w0);
    let residual = [b.graph.formula(w1 - along), b.graph.formula(v - w1)];
    let gap = b.graph.formula(w1 - s1);
    let mut step = Procedure::default();
    let mu = b.graph.formula(gap / mass);
    let mu = step.define(&mut b.graph, "mu", mu);
    let reached = b.graph.formula(s2 + mu);
    step.outputs = vec![s0, b.graph.formula(x * s0), reached];
    let lambda = b.graph.formula(mass * along);
    let forces = vec![lambda, zero, b.graph.formula(-lambda)];
    let procedures = [
        Procedure::of(vec![w0, zero, zero, zero]),
        Procedure::of(vec![zero]),
        Procedure::of(vec![w0, w1, v]),
        Procedure::default(),
    ];
    let mut system = b.system(&[0, 1, 2], procedures, &[]);
    for (residual, label) in residual.iter().zip([None, Some("type".to_owned())]) {
        let (residual, origin) = (*residual, system.model.origin);
        system.model.constraints.push(ConstraintDecl {
            label,
            residual,
            solved_for: None,
            is_entry: false,
            origin,
        });
    }
    system.formulation = Formulation::Projected;
    system.functions.add(&RESIDUAL, Procedure::of(residual.to_vec()));
    system.projection = Some(Projection { start: start.to_vec(), step });
    system.functions.add(&MULTIPLIERS, Procedure::of(vec![lambda, zero]));
    system.functions.add(&REACTIONS, Procedure::of(forces));
    system
}
