//! Names and what they stand for. No name is declared twice: nothing is ever shadowed.

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use nonholonomic_core::id::{ConstantId, SymbolId};

use super::array::{Array, Shape};
use super::tensors::usage;
use crate::report::{Diagnostic, Extent};
use crate::suggest::did_you_mean;
use crate::syntax::ast::Name;
use crate::syntax::vocabulary::{FUNCTIONS, RESERVED};

/// Names compared with an unknown one.
const COMPARED: usize = 1000;

/// What a declared name is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// A field of the struct.
    Parameter,
    /// A base coordinate.
    Coordinate,
    /// A section and its quasi-velocity.
    Velocity,
    /// The velocity of a coordinate, where E = TM.
    ImpliedVelocity,
    /// A section of the frame and its quasi-velocity.
    FrameVelocity,
    /// A control input.
    Input,
    /// An auxiliary state.
    Auxiliary,
}

impl Role {
    /// As a noun.
    pub(super) fn noun(self) -> &'static str {
        match self {
            Self::Parameter => "a parameter",
            Self::Coordinate => "a base coordinate",
            Self::Velocity => "a quasi-velocity",
            Self::ImpliedVelocity => "the velocity of a base coordinate",
            Self::FrameVelocity => "a section of the frame",
            Self::Input => "an input",
            Self::Auxiliary => "an auxiliary state",
        }
    }
}

/// A declared number or family.
#[derive(Debug)]
pub(super) struct Named {
    /// What it is.
    pub(super) role: Role,
    /// Its shape.
    pub(super) shape: Shape,
    /// The position of its first entry in its table of the model.
    pub(super) first: usize,
    /// Its symbols, row by row.
    pub(super) symbols: Vec<SymbolId>,
    /// Of a coordinate or an auxiliary state: the symbols of its rates.
    pub(super) rates: Vec<SymbolId>,
    /// Where it is declared.
    pub(super) extent: Extent,
}

/// What `constants` defines.
#[derive(Debug)]
pub(super) struct Numbers {
    /// The values.
    pub(super) values: Array,
    /// Those that have a name in expressions: rational numbers but 0, which leaves nothing to be named.
    pub(super) names: Vec<Option<ConstantId>>,
}

/// What a name stands for.
#[derive(Clone, Debug)]
pub(super) enum Meaning {
    /// Something declared.
    Named(Rc<Named>),
    /// `t`
    Time,
    /// `pi`
    Pi,
    /// A constant, or several.
    Constant(Rc<Numbers>),
    /// A `let`.
    Value(Rc<Array>),
    /// An argument of the function that is read.
    Argument(Rc<Array>),
    /// A `let` between the sections, by its place there.
    Shared(usize),
    /// A function, by its place between the sections.
    Function(usize),
    /// The value of a loop variable.
    Index(i64),
    /// Something that was in error, which was reported.
    Broken,
}

impl Meaning {
    /// What it is, for "it is … already".
    fn noun(&self) -> &'static str {
        match self {
            Self::Named(named) => match named.role {
                Role::Parameter => "a parameter (a field of the struct)",
                Role::ImpliedVelocity => "the name of a coordinate's velocity in generated code",
                role => role.noun(),
            },
            Self::Time => "the time",
            Self::Pi => "the number π",
            Self::Constant(_) => "a constant",
            Self::Value(_) | Self::Shared(_) => "an abbreviation (a `let`)",
            Self::Function(_) => "a function (a `let`)",
            Self::Argument(_) => "an argument",
            Self::Index(_) => "a loop variable",
            Self::Broken => "declared",
        }
    }
}

/// The names that can be used.
#[derive(Debug)]
pub(super) struct Scope {
    globals: BTreeMap<String, Meaning>,
    locals: Vec<(String, Meaning)>,
    /// Quasi-velocities that `velocities` and `frame` are about to define.
    pub(super) pending: BTreeSet<String>,
    /// The names of outputs, which no expression can use.
    pub(super) outputs: BTreeSet<String>,
    /// Labels and the names of claims, as they are written.
    pub(super) labels: BTreeSet<String>,
    /// Fields that are left alone.
    pub(super) skipped: BTreeSet<String>,
    /// Names of lets inside sections, with the section.
    pub(super) elsewhere: BTreeMap<String, &'static str>,
}

impl Scope {
    /// `t` and `pi`.
    pub(super) fn new() -> Self {
        let globals = [("t".to_owned(), Meaning::Time), ("pi".to_owned(), Meaning::Pi)].into();
        Self {
            globals,
            locals: Vec::new(),
            pending: BTreeSet::new(),
            outputs: BTreeSet::new(),
            labels: BTreeSet::new(),
            skipped: BTreeSet::new(),
            elsewhere: BTreeMap::new(),
        }
    }

    /// What a name stands for.
    pub(super) fn get(&self, name: &str) -> Option<&Meaning> {
        let local = self.locals.iter().rev().find(|(known, _)| known == name).map(|(_, meaning)| meaning);
        local.or_else(|| self.globals.get(name))
    }

    /// Declares a name for the whole declaration.
    pub(super) fn declare(&mut self, name: &Name, meaning: Meaning) -> Result<(), Diagnostic> {
        self.check_new(name)?;
        self.globals.insert(name.text.clone(), meaning);
        Ok(())
    }

    /// Declares a name that is known to be new, or replaces one.
    pub(super) fn insert(&mut self, name: String, meaning: Meaning) {
        self.globals.insert(name, meaning);
    }

    /// Refuses names that mean something already.
    pub(super) fn check_new(&self, name: &Name) -> Result<(), Diagnostic> {
        check_reserved(name)?;
        self.get(&name.text).map_or(Ok(()), |first| Err(declared_twice(name, first)))
    }

    /// Refuses names that mean something already in the whole declaration.
    pub(super) fn check_new_global(&self, name: &Name) -> Result<(), Diagnostic> {
        check_reserved(name)?;
        self.globals.get(&name.text).map_or(Ok(()), |first| Err(declared_twice(name, first)))
    }

    /// Binds these names alone beside those of the whole declaration; what was bound is given back.
    pub(super) fn exchange(&mut self, bound: Vec<(String, Meaning)>) -> Vec<(String, Meaning)> {
        std::mem::replace(&mut self.locals, bound)
    }

    /// Binds a name until [`Scope::leave`].
    pub(super) fn bind(&mut self, name: &str, meaning: Meaning) {
        self.locals.push((name.to_owned(), meaning));
    }

    /// Gives a bound name another meaning, and what it had.
    pub(super) fn rebind(&mut self, name: &str, meaning: Meaning) -> Option<Meaning> {
        let (_, bound) = self.locals.iter_mut().rev().find(|(known, _)| known == name)?;
        Some(std::mem::replace(bound, meaning))
    }

    /// How many names are bound.
    pub(super) fn depth(&self) -> usize {
        self.locals.len()
    }

    /// Forgets the names bound since there were `depth`.
    pub(super) fn leave(&mut self, depth: usize) {
        self.locals.truncate(depth);
    }

    /// The values of the loop variables, the outermost first.
    pub(super) fn loop_values(&self) -> Vec<i64> {
        let value = |(_, meaning): &(String, Meaning)| match meaning {
            Meaning::Index(value) => Some(*value),
            _ => None,
        };
        self.locals.iter().filter_map(value).collect()
    }

    /// An error about a name that stands for nothing.
    pub(super) fn unknown(&self, name: &Name) -> Diagnostic {
        let text = &name.text;
        let error = Diagnostic::new(name.extent(), format!("unknown name `{text}`"));
        if self.skipped.contains(text) {
            return error
                .evidence(format!("the field `{text}` is marked `#[nh(skip)]`"))
                .way_out("take the mark away to make it a parameter");
        }
        if self.outputs.contains(text) {
            return error
                .evidence(format!("`{text}` is an output, and outputs are not used in expressions"))
                .way_out("name the value with a `let`, and use that");
        }
        if let Some(keyword) = self.elsewhere.get(text) {
            return error
                .evidence(format!("`{text}` is a `let` of `{keyword}`, where it stays, from its line on"))
                .way_out("put that `let` between the sections, where all of them know it");
        }
        if text == "time" {
            return error.way_out("the time is `t`");
        }
        if let Some(call) = usage(text) {
            return error.way_out(format!("the function of this name is called as `{call}`"));
        }
        // the names of the generated fields
        let of_coordinate = |suffix| text.strip_suffix(suffix).filter(|rest| self.is_coordinate(rest));
        if let Some(coordinate) = of_coordinate("_dot") {
            return error.way_out(format!("the rate of `{coordinate}` is written `der({coordinate})`"));
        }
        if of_coordinate("_ddot").is_some() {
            return error.way_out("accelerations are what is derived; they cannot be used");
        }
        if let Some(nearest) = self.nearest(text) {
            return error.way_out(nearest);
        }
        error.about_unknown(text).way_out(
            "parameters are fields of the struct; other names are declared in `base`, `basis`, `inputs` or \
             `auxiliary`, or by a `let`",
        )
    }

    /// Whether a name means something that expressions here have no use of: a skipped field, an output, a `let` of
    /// another section.
    pub(super) fn is_known_elsewhere(&self, name: &str) -> bool {
        self.skipped.contains(name) || self.outputs.contains(name) || self.elsewhere.contains_key(name)
    }

    /// The known name that is nearest to an unknown one.
    pub(super) fn nearest(&self, name: &str) -> Option<String> {
        let locals = self.locals.iter().map(|(known, _)| known.as_str());
        let globals = self.globals.keys().map(String::as_str);
        did_you_mean(name, locals.chain(globals).take(COMPARED))
    }

    /// The names of functions.
    pub(super) fn functions(&self) -> impl Iterator<Item = &str> {
        let is_function = |meaning: &Meaning| matches!(meaning, Meaning::Function(_));
        self.globals.iter().filter(move |(_, meaning)| is_function(meaning)).map(|(name, _)| name.as_str())
    }

    fn is_coordinate(&self, name: &str) -> bool {
        matches!(self.globals.get(name), Some(Meaning::Named(named)) if named.role == Role::Coordinate)
    }

    /// The known name of one of these roles that is nearest to an unknown one.
    pub(super) fn did_you_mean(&self, name: &str, roles: &[Role]) -> Option<String> {
        let fits =
            |meaning: &Meaning| matches!(meaning, Meaning::Named(named) if roles.contains(&named.role));
        let candidates =
            self.globals.iter().filter(|(_, meaning)| fits(meaning)).map(|(known, _)| known.as_str());
        did_you_mean(name, candidates.take(COMPARED))
    }
}

/// A name that means something already.
fn declared_twice(name: &Name, first: &Meaning) -> Diagnostic {
    Diagnostic::new(name.extent(), format!("`{}` is declared twice", name.text))
        .evidence(format!("it is {} already", first.noun()))
        .way_out("choose another name: every name has one meaning in the whole declaration")
}

/// Refuses names that belong to the language.
pub(super) fn check_reserved(name: &Name) -> Result<(), Diagnostic> {
    let text = name.text.as_str();
    let meaning = match text {
        "t" => "the time",
        "pi" => "the number π",
        _ if RESERVED.contains(&text) || FUNCTIONS.contains(&text) => "a function",
        _ => return Ok(()),
    };
    Err(Diagnostic::new(name.extent(), format!("`{text}` is reserved"))
        .evidence(format!("it is {meaning}"))
        .way_out("choose another name"))
}
