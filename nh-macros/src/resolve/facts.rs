//! What is claimed about a system: identities of the base, first integrals, facts about parameters;
//! and what is asked for beyond the default.

use nonholonomic_core::algebra::Rational;
use nonholonomic_core::functions::{TABLE, When};
use nonholonomic_core::id::{ExprId, Origin, SymbolId};
use nonholonomic_core::model::{
    Assumption, Located, OutputDecl, Relation, Request, SectionClaim, VolumeClaim,
};

use super::alike::Measured;
use super::array::{Array, Shape};
use super::context::Context;
use super::reports::Outcome;
use super::resolver::Resolver;
use crate::report::Diagnostic;
use crate::suggest::did_you_mean;
use crate::syntax::ast::{self, Comparison, Definition, Equation, Item, Momentum, Name};

/// Longest side of an assumption shown, in bytes.
const SHOWN: usize = 160;

/// What is generated anyway, beside the functions of the table.
const GENERATED: [&str; 2] = ["derivative", "validate"];
/// What sections generate, beside the functions of the table.
const OF_SECTIONS: [(&str, &str); 4] = [
    ("linearize", "linearization"),
    ("trim", "linearization"),
    ("normalize", "on"),
    ("assemble", "holonomic"),
];

/// What is wrong where a function that is no word of `emit` stands there: what generates it is something else.
fn generated_otherwise(name: &Name) -> Option<Diagnostic> {
    let text = name.text.as_str();
    let says = |what: &str| Diagnostic::new(name.extent(), format!("`{text}` is generated {what}"));
    let anyway = || says("without being asked for").way_out("leave it out");
    let by_section = |section: &str| {
        says(&format!("by `{section} {{ … }}`")).way_out("declare that section, and leave this out")
    };
    let by_word = |asked: Request| {
        let (word, _) = Request::WORDS.iter().find(|(_, request)| *request == asked)?;
        Some(says(&format!("by `{word}`")).way_out(format!("write `{word}`")))
    };
    if GENERATED.contains(&text) {
        return Some(anyway());
    }
    if let Some((_, section)) = OF_SECTIONS.iter().find(|(known, _)| *known == text) {
        return Some(by_section(section));
    }
    match TABLE.iter().find(|signature| signature.name == text)?.when {
        When::Always | When::WithOutputs | When::WithConstraints => Some(anyway()),
        When::Asked(request) => by_word(request),
        When::WithSymmetries => by_word(Request::Momenta),
        When::WithSection => Some(by_section("hamilton_jacobi")),
        When::WithQuadratures => Some(by_section("routh")),
    }
}

impl Resolver {
    /// f = 0 on the embedded base; vectors entry by entry.
    pub(super) fn identities(&mut self, items: &[Item<Equation>]) -> Vec<Located> {
        let mut found = Vec::new();
        self.section(Context::On, items, &mut |this, equation| {
            let (left, right) = this.sides(equation)?;
            let origin = this.origin(equation.extent);
            for (left, right) in left.entries.iter().zip(&right.entries) {
                let value = this.residual(equation, *left, *right)?;
                found.push(Located { value, origin });
            }
            Ok(())
        });
        self.identities = found.iter().map(|identity| identity.value).collect();
        found
    }

    /// Both sides of an equation, in one shape. `= 0` is said of vectors too.
    pub(super) fn sides(&mut self, equation: &Equation) -> Outcome<(Array, Array)> {
        let (left, right) = (self.value(&equation.left), self.value(&equation.right));
        let (left, right) = (left?, right?);
        let (as_left, as_right) = (self.in_shape(&right, left.shape), self.in_shape(&left, right.shape));
        match (as_left, as_right) {
            (Some(right), _) => return Ok((left, right)),
            (None, Some(left)) => return Ok((left, right)),
            (None, None) => {}
        }
        let error = Diagnostic::new(equation.extent, "the two sides have different shapes")
            .evidence(format!("on the left is {}, on the right {}", left.shape, right.shape));
        Err(self.report(equation, match (left.shape, right.shape) {
            (Shape::Matrix(n, m), Shape::Number) | (Shape::Number, Shape::Matrix(n, m)) if n == m => error
                .way_out(format!("the matrix with ones on its diagonal is `identity({n})`; only the literal `0` has any shape")),
            _ => error,
        }))
    }

    /// `left − right`
    pub(super) fn difference(&mut self, at: &ast::Expr, left: ExprId, right: ExprId) -> Outcome<ExprId> {
        self.sum_of(at, vec![(Rational::ONE, left), (Rational::MINUS_ONE, right)])
    }

    /// What an equation says is 0: left − right.
    pub(super) fn residual(&mut self, equation: &Equation, left: ExprId, right: ExprId) -> Outcome<ExprId> {
        self.signed_residual(equation, left, right, Rational::ONE)
    }

    /// left − right with a sign.
    pub(super) fn signed_residual(
        &mut self,
        equation: &Equation,
        left: ExprId,
        right: ExprId,
        sign: Rational,
    ) -> Outcome<ExprId> {
        let sides =
            vec![self.written(&equation.left, left, None), self.written(&equation.right, right, None)];
        self.same_unit(equation, "equals", sides);
        let terms = vec![(sign.clone(), left), (-sign, right)];
        self.combination_of(&equation.left, terms)
    }

    /// Claimed first integrals.
    pub(super) fn claims(&mut self, items: &[Item<Definition>]) -> Vec<OutputDecl> {
        let (defined, _) = self.definitions(Context::Conserved, items);
        let mut found = Vec::new();
        for family in &defined {
            for (k, entry) in family.entries.iter().enumerate() {
                let name = family.shape().entry_name(&family.name.text, k);
                found.push(OutputDecl { name, value: entry.value, origin: self.origin(entry.extent) });
            }
        }
        found
    }

    /// The claim that a volume is kept.
    pub(super) fn volume(&mut self, claim: &ast::Section<Option<ast::Expr>>) -> Outcome<VolumeClaim> {
        self.context = Context::Volume;
        let density = claim.body.as_ref().map(|density| self.number_value(density)).transpose()?;
        let extent = claim.body.as_ref().map_or(claim.keyword.extent(), |density| density.extent);
        Ok(VolumeClaim { density, origin: self.origin(extent) })
    }

    /// Momenta as functions on the base; families entry by entry.
    pub(super) fn hamilton_jacobi(&mut self, section: &ast::Section<Vec<Item<Momentum>>>) -> SectionClaim {
        let mut components: Vec<(SymbolId, Located)> = Vec::new();
        self.section(Context::HamiltonJacobi, &section.body, &mut |this, momentum| {
            let named = this.velocities(&momentum.along);
            let value = this.value(&momentum.value);
            let ((velocities, extent), value) = (named?, value?);
            if velocities.len() != value.entries.len() {
                let error = Diagnostic::new(
                    momentum.value.extent,
                    format!("{} momenta are needed here, this is {}", velocities.len(), value.shape),
                );
                return Err(this.report(momentum, error));
            }
            let origin = this.origin(extent.to(momentum.value.extent));
            for (velocity, value) in velocities.into_iter().zip(value.entries) {
                let expected = Measured::expected("the momentum", extent).energy(1).symbol(velocity, -1);
                let given = this.written(&momentum.value, value, None);
                this.same_unit(momentum, "is", vec![expected, given]);
                if components.iter().any(|(known, _)| *known == velocity) {
                    let name = this.graph.symbols()[velocity].clone();
                    let error =
                        Diagnostic::new(extent, format!("the momentum along `{name}` is given twice"));
                    return Err(this.report(momentum, error));
                }
                components.push((velocity, Located { value, origin }));
            }
            Ok(())
        });
        SectionClaim { components, origin: self.origin(section.keyword.extent()) }
    }

    /// Facts about parameters. A number on one side is compared with every entry of the other.
    pub(super) fn assumptions(&mut self, items: &[Item<Comparison>]) -> Vec<Assumption> {
        let mut found = Vec::new();
        self.section(Context::Assume, items, &mut |this, comparison| {
            let (left, right) = (this.value(&comparison.left), this.value(&comparison.right));
            let (left, right) = (left?, right?);
            let shape = if left.shape == Shape::Number { right.shape } else { left.shape };
            if [left.shape, right.shape].iter().any(|side| *side != shape && *side != Shape::Number) {
                let error = Diagnostic::new(comparison.extent, "the two sides have different shapes")
                    .evidence(format!("on the left is {}, on the right {}", left.shape, right.shape));
                return Err(this.report(comparison, error));
            }
            let origin = this.origin(comparison.extent);
            for k in 0..shape.len() {
                let side = |side: &Array| side.as_number().unwrap_or_else(|| side.entries[k]);
                let (left, right) = (side(&left), side(&right));
                let sides = vec![
                    this.written(&comparison.left, left, None),
                    this.written(&comparison.right, right, None),
                ];
                this.same_unit(comparison, "is compared with", sides);
                let (relation, sign) = relation(comparison.relation);
                let side = |side| this.graph.text_within(side, SHOWN);
                let text = format!("{} {sign} {}", side(left), side(right));
                found.push(Assumption { left, relation, right, text, origin });
            }
            Ok(())
        });
        found
    }

    /// What to generate beyond the default.
    pub(super) fn requests(
        &mut self,
        names: &[Name],
        constrained: bool,
        generic: bool,
    ) -> Vec<(Request, Origin)> {
        let mut found: Vec<(Request, Origin)> = Vec::new();
        let mut is_told = false;
        for name in names {
            let text = name.text.as_str();
            let Some((_, request)) = Request::WORDS.iter().find(|(known, _)| *known == text) else {
                if let Some(error) = generated_otherwise(name) {
                    self.report(name, error);
                    continue;
                }
                let all = Request::WORDS.map(|(known, _)| format!("`{known}`")).join(", ");
                let error = Diagnostic::new(name.extent(), format!("`{text}` cannot be emitted"));
                let known = format!("what can be asked for: {all}");
                let error = match did_you_mean(text, Request::WORDS.map(|(known, _)| known)) {
                    Some(question) => error.evidence(known).way_out(question),
                    None => error.way_out(known),
                };
                self.report(name, error);
                continue;
            };
            if found.iter().any(|(earlier, _)| earlier == request) {
                self.report(name, Diagnostic::new(name.extent(), format!("`{text}` is asked for twice")));
                continue;
            }
            if *request == Request::C && generic {
                let error = Diagnostic::new(name.extent(), "C is written for `f64` or `f32`")
                    .evidence("the fields of this struct are of a type that is a parameter")
                    .way_out("declare a struct with fields of one of these types beside it");
                self.report(name, error);
                continue;
            }
            if matches!(request, Request::Multipliers | Request::Reactions) && !constrained {
                let error =
                    Diagnostic::new(name.extent(), format!("there are no {text} without constraints"))
                        .way_out("state them in `constraints { … }`, or leave this out");
                // one section is missing, whatever is asked for of it
                if !std::mem::replace(&mut is_told, true) {
                    self.report(name, error);
                }
                continue;
            }
            let origin = self.origin(name.extent());
            found.push((*request, origin));
        }
        found
    }
}

/// The relation, and how it is written.
fn relation(relation: ast::Relation) -> (Relation, &'static str) {
    match relation {
        ast::Relation::Less => (Relation::Less, "<"),
        ast::Relation::LessOrEqual => (Relation::LessOrEqual, "<="),
        ast::Relation::Greater => (Relation::Greater, ">"),
        ast::Relation::GreaterOrEqual => (Relation::GreaterOrEqual, ">="),
        ast::Relation::NotEqual => (Relation::NotEqual, "!="),
    }
}
