//! Random machines as declarations.

mod draws;
mod groups;
mod loops;
mod particles;
mod planar;
mod spatial;

pub use draws::Random;

/// A declaration as text, as a user writes it.
#[derive(Clone, Debug)]
pub struct Machine {
    /// The number that it was made from.
    pub member: u64,
    /// The family.
    pub family: &'static str,
    /// What stands in `#[nonholonomic(…)]`, without a level of accuracy.
    pub sections: String,
    /// The fields of the struct.
    pub parameters: Vec<String>,
}

impl Machine {
    /// A member of the family of a seed.
    #[must_use]
    pub fn of(seed: u64, member: u64) -> Self {
        let mut random = Random::of(seed, member);
        let mut draft = Draft::default();
        let family = match random.below(20) {
            0..12 => planar::machine(&mut draft, &mut random),
            12..15 => spatial::machine(&mut draft, &mut random),
            15..17 => groups::machine(&mut draft, &mut random),
            _ => particles::machine(&mut draft, &mut random),
        };
        if random.happens(15) {
            draft.choices.push("formulation { projected }".into());
        }
        Self { member, family, sections: draft.sections(), parameters: draft.parameters }
    }

    /// A member of the family of a seed, with constraints on positions.
    #[must_use]
    pub fn closed(seed: u64, member: u64) -> Self {
        let mut random = Random::of(seed, member);
        let mut draft = Draft::default();
        let family = loops::machine(&mut draft, &mut random);
        Self { member, family, sections: draft.sections(), parameters: draft.parameters }
    }

    /// What stands in `#[nonholonomic(…)]` at a level of accuracy.
    #[must_use]
    pub fn attribute(&self, level: &str) -> String {
        format!("{}\naccuracy {{ {level} }}", self.sections)
    }

    /// The struct.
    #[must_use]
    pub fn item(&self) -> String {
        let fields: Vec<String> = self.parameters.iter().map(|name| format!("{name}: f64")).collect();
        format!("struct Machine {{ {} }}", fields.join(", "))
    }
}

/// A declaration in the making.
#[derive(Clone, Debug, Default)]
pub(crate) struct Draft {
    pub(crate) base: Vec<String>,
    pub(crate) on: Vec<String>,
    pub(crate) basis: Vec<String>,
    pub(crate) anchor: Vec<String>,
    /// Whole sections.
    pub(crate) brackets: Vec<String>,
    /// Known in the Lagrangian and in constraints.
    pub(crate) lets: Vec<String>,
    /// The terms of the Lagrangian.
    pub(crate) lagrangian: Vec<String>,
    pub(crate) holonomic: Vec<String>,
    pub(crate) constraints: Vec<String>,
    pub(crate) forces: Vec<String>,
    pub(crate) inputs: Vec<String>,
    /// Whole sections.
    pub(crate) choices: Vec<String>,
    pub(crate) parameters: Vec<String>,
}

impl Draft {
    /// A new parameter.
    pub(crate) fn parameter(&mut self, letter: &str) -> String {
        let name = format!("{letter}{}", self.parameters.len());
        self.parameters.push(name.clone());
        name
    }

    /// A new parameter, or nothing.
    pub(crate) fn maybe(&mut self, random: &mut Random, percent: usize, letter: &str) -> Option<String> {
        random.happens(percent).then(|| self.parameter(letter))
    }

    /// A force along a velocity or coordinate: friction, an input, a spring with a parameter of its own.
    pub(crate) fn push(&mut self, random: &mut Random, along: &str, velocity: &str) {
        let force = match random.below(6) {
            0 | 1 => {
                let input = format!("u{}", self.inputs.len());
                self.inputs.push(input.clone());
                input
            }
            2 => format!("-{}*{velocity}", self.parameter("c")),
            3 => {
                let input = format!("u{}", self.inputs.len());
                self.inputs.push(input.clone());
                format!("{input} - {}*{velocity}", self.parameter("c"))
            }
            _ => return,
        };
        self.forces.push(format!("{along}: {force};"));
    }

    fn sections(&self) -> String {
        let mut text = String::new();
        let mut section = |name: &str, items: &[String], between: &str| {
            if !items.is_empty() {
                text.extend([name, " { ", &items.join(between), " }\n"]);
            }
        };
        section("base", &self.base, ", ");
        section("on", &self.on, " ");
        section("basis", &self.basis, ", ");
        section("anchor", &self.anchor, " ");
        let lets = self.lets.join("\n    ");
        let whole = |body: String| vec![format!("{lets}\n    {body}")];
        section("lagrangian", &whole(self.lagrangian.join(" + ").replace("+ -", "- ")), "");
        for (name, rows) in [("holonomic", &self.holonomic), ("constraints", &self.constraints)] {
            if !rows.is_empty() {
                section(name, &whole(rows.join(" ")), "");
            }
        }
        if !self.holonomic.is_empty() || !self.constraints.is_empty() {
            section("emit", &["multipliers".into()], "");
        }
        section("forces", &self.forces, " ");
        section("inputs", &self.inputs, ", ");
        for whole in self.brackets.iter().chain(&self.choices) {
            text.push_str(whole);
            text.push('\n');
        }
        text
    }
}

/// Names one after the other.
pub(crate) fn names(letter: &str, count: usize) -> Vec<String> {
    (0..count).map(|index| format!("{letter}{index}")).collect()
}
