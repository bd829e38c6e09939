//! Units of declared names, and what follows from them.

use std::collections::{BTreeMap, BTreeSet};

use nonholonomic_core::algebra::Rational;
use nonholonomic_core::id::{ConstraintId, ParamId, SymbolId, Table};
use nonholonomic_core::model::{ConstraintDecl, OutputDecl, SymmetryDecl};
use nonholonomic_core::units::{
    Dimension, Form, IN_UNITS, Kind, Quantity, Reading, Refused, UNITS, USUAL, Unit, Unknown, infer, raised,
};

use super::alike::Measured;
use super::declared_impacts::Impulse;
use super::reports::{Outcome, Reported};
use super::resolver::Resolver;
use super::scope::Meaning;
use crate::emit::Layout;
use crate::report::{Diagnostic, Extent};
use crate::suggest::did_you_mean;
use crate::syntax::ast::{Place, UnitFactor, UnitLine};

/// What has a name but no symbol.
pub(super) struct Named<'a> {
    pub(super) outputs: &'a [OutputDecl],
    pub(super) claims: &'a [OutputDecl],
    pub(super) constraints: &'a Table<ConstraintId, ConstraintDecl>,
    pub(super) symmetries: &'a [SymmetryDecl],
    pub(super) impulses: &'a [Impulse],
    /// These have symbols, and are no sections of E.
    pub(super) orthonormal: &'a [SymbolId],
}

/// A declared name or entry, and whether it is that of a symbol, with the text of its unit: an output may have the name
/// of a coordinate.
type Declared = BTreeMap<(String, bool), String>;

/// Something with a unit.
struct Unitary {
    /// As the report says it.
    said: String,
    /// As `units` names it, and whether that is the name of a symbol.
    key: (String, bool),
    form: Form,
}

impl Resolver {
    /// The units of everything that has a name: those declared, and what follows. Contradictions are reported.
    pub(super) fn units(
        &mut self,
        lines: &[UnitLine],
        named: &Named<'_>,
        layout: &mut Layout,
    ) -> Vec<Quantity> {
        self.defaults(lines);
        let mut declared = Declared::new();
        let mut given = BTreeSet::new();
        let upper = self.symmetric.iter().map(|(upper, _)| self.tables.parameters[*upper].symbol);
        let on_both_sides: BTreeSet<String> =
            upper.map(|symbol| self.graph.symbols()[symbol].clone()).collect();
        for line in lines {
            let unit = self.unit(&line.factors);
            for place in &line.places {
                // a name in error was reported; the others go on
                let Ok((is_free, measured)) = self.unit_of(place, named) else { continue };
                let Ok((dimension, text)) = &unit else { continue };
                let are_several = measured.len() > 1;
                for (name, side) in measured {
                    // the rows of a symmetric matrix share entries, whose units have to agree
                    let is_shared = are_several && on_both_sides.contains(&name);
                    let key = (name, is_free);
                    if !given.insert(key.clone()) && !is_shared {
                        let name = &key.0;
                        let what = format!("the unit of `{name}` is given twice");
                        self.report(place, Diagnostic::new(place.extent, what).way_out("keep one of them"));
                        continue;
                    }
                    declared.insert(key, text.clone());
                    let unit = Measured::expected(IN_UNITS, place.extent).unit(dimension.clone());
                    self.open_conditions();
                    // what follows from expressions is compared with them, when these have been looked at
                    let section = if is_free {
                        ""
                    } else {
                        self.uses_abbreviation(&place.name.text);
                        "units"
                    };
                    self.same_unit_in(section, std::ptr::from_ref(line).addr(), "is", vec![unit, side]);
                    self.close_conditions();
                }
            }
        }
        if self.reports.any() {
            return Vec::new();
        }
        let mut reading = self.reading();
        let conditions = self.conditions(&mut reading);
        match infer(&self.graph, &conditions) {
            Ok(inferred) => {
                let known = |Unitary { said, key, form }: Unitary| {
                    let unit = declared.get(&key).map(|text| Unit::Known(text.clone()));
                    let dimension = inferred.dimension(&form);
                    Quantity { name: said, unit: unit.unwrap_or_else(|| inferred.unit(&form)), dimension }
                };
                let quantities: Vec<Quantity> =
                    self.measured(named, &mut reading).into_iter().map(known).collect();
                describe(layout, &quantities);
                self.homogeneity.reading = Some(reading);
                quantities
            }
            Err(violations) => {
                for violation in violations {
                    let error = self.origins.diagnostic(violation);
                    self.reports.report_missing(error);
                }
                Vec::new()
            }
        }
    }

    /// The time is in seconds and L in joules, unless `units` says otherwise.
    fn defaults(&mut self, lines: &[UnitLine]) {
        let given =
            |name: &str| lines.iter().flat_map(|line| &line.places).any(|place| place.name.text == name);
        let whole = self.origins.whole();
        for (name, unit, text) in [("t", "s", "`t`"), ("lagrangian", "J", "the Lagrangian")] {
            let Ok(unit) = Dimension::named(unit) else { continue };
            if !given(name) {
                let side = Measured::expected(text, whole);
                let side = if name == "t" { side.time(1) } else { side.energy(1) };
                let expected = Measured::expected("its usual unit", whole).unit(unit);
                self.same_unit_in("", USUAL, "is", vec![expected, side]);
            }
        }
    }

    /// A product of units, with its text.
    fn unit(&mut self, factors: &[UnitFactor]) -> Outcome<(Dimension, String)> {
        let mut product = Ok(Dimension::none());
        let mut texts = Vec::new();
        for factor in factors {
            let exponent = Rational::new(factor.numerator, factor.denominator);
            let text = &factor.name.text;
            match Dimension::named(text) {
                Ok(unit) => product = product.map(|product| product.times(&unit, &exponent)),
                Err(refused) => product = Err(self.no_unit(factor, refused)),
            }
            texts.push(format!("{}{}", if text == "ohm" { "Ω" } else { text }, raised(&exponent)));
        }
        let text = if texts.is_empty() { "1".to_owned() } else { texts.join(" ") };
        product.map(|product| (product, text))
    }

    fn no_unit(&mut self, factor: &UnitFactor, refused: Refused) -> Reported {
        let name = &factor.name.text;
        let error = match refused {
            Refused::Multiple(is) => {
                let unit = is.rsplit_once(' ').map_or(is.as_str(), |(_, unit)| unit);
                Diagnostic::new(factor.name.extent(), format!("`{name}` is a multiple: {is}"))
                    .evidence("the equations have no factors for them: they are in coherent units")
                    .way_out(if unit == "rad" {
                        "declare `rad`, or `1`, and give values in radians".to_owned()
                    } else {
                        format!("declare it in `{}`, and give values in that unit", coherent(&is))
                    })
            }
            Refused::Unknown => {
                let error = Diagnostic::new(factor.name.extent(), format!("unknown unit `{name}`"));
                let known = format!("known are {}", UNITS.join(" "));
                let question = joined(name).map(|written| format!("write `{written}`"));
                match question.or_else(|| did_you_mean(name, UNITS)) {
                    Some(question) => error.evidence(known).way_out(question),
                    None => error.way_out(known),
                }
            }
        };
        self.report(factor, error)
    }

    /// Every entry that a place in `units` names, and what has its unit; and whether that is an unknown of its own.
    fn unit_of(&mut self, place: &Place, named: &Named<'_>) -> Outcome<(bool, Vec<(String, Measured)>)> {
        let text = &place.name.text;
        let of = |name: &str| Measured::expected(format!("`{name}`"), place.extent);
        match self.scope.get(text).cloned() {
            Some(Meaning::Time) => return Ok((true, vec![(text.clone(), of(text).time(1))])),
            Some(Meaning::Named(family)) => {
                let part = self.part(&format!("`{text}`"), family.shape, &place.indices)?;
                let symbols = &family.symbols[part.positions()];
                let sides = symbols.iter().map(|symbol| {
                    let name = self.graph.symbols()[*symbol].clone();
                    (name.clone(), of(&name).symbol(*symbol, 1))
                });
                return Ok((true, sides.collect()));
            }
            Some(Meaning::Constant(constant)) => {
                let part = self.part(&format!("`{text}`"), constant.values.shape, &place.indices)?;
                let names = constant.names[part.positions()].iter().flatten();
                let sides = names.map(|id| {
                    let name = self.graph.constants()[*id].name.clone();
                    (name.clone(), of(&name).unknown(Unknown::Constant(*id)))
                });
                return Ok((true, sides.collect()));
            }
            Some(Meaning::Broken) => return Err(Reported),
            Some(_) => {
                let error = Diagnostic::new(place.extent, format!("the unit of `{text}` follows"))
                    .evidence("it is defined by an expression")
                    .way_out("leave it out");
                return Err(self.report(place, error));
            }
            None => {}
        }
        if text == "lagrangian" {
            return Ok((true, vec![(text.clone(), of(text).energy(1))]));
        }
        self.unit_of_label(place, named).map(|sides| (false, sides))
    }

    /// Outputs, claims, multipliers of constraints, momenta of symmetries, impulses of impacts.
    fn unit_of_label(&mut self, place: &Place, named: &Named<'_>) -> Outcome<Vec<(String, Measured)>> {
        let text = &place.name.text;
        let (mut entry, mut label) = (text.clone(), text.clone());
        for index in &place.indices {
            let index = self.index(index)?;
            entry.extend(["[", &index.to_string(), "]"]);
            label.extend(["_", &index.to_string()]);
        }
        let is_meant = |name: &str| {
            let of_family = name.strip_prefix(&entry).is_some_and(|rest| rest.starts_with('['));
            let of_label = name.strip_prefix(&label).and_then(|rest| rest.strip_prefix('_'));
            let digits = |rest: &str| rest.chars().all(|c| c.is_ascii_digit() || c == '_');
            name == entry || name == label || of_family || of_label.is_some_and(digits)
        };
        let all = Self::labelled(named, place.extent);
        let known: Vec<String> = all.iter().map(|(_, name, _)| name.clone()).collect();
        let found = all.into_iter().filter(|(_, name, _)| is_meant(name));
        let found: Vec<_> = found.map(|(_, name, side)| (name, side)).collect();
        if !found.is_empty() {
            return Ok(found);
        }
        if self.scope.outputs.contains(text) || self.scope.labels.contains(text) {
            return Err(self.no_entry(place, &known));
        }
        let error = self.scope.unknown(&place.name);
        let error = match did_you_mean(text, known.iter().map(String::as_str).chain(["lagrangian"])) {
            Some(question) => {
                Diagnostic::new(place.name.extent(), format!("unknown name `{text}`")).way_out(question)
            }
            None => error,
        };
        Err(self.reports.report_unknown(place, text, error))
    }

    /// An index that an output or a label does not have. One in error was reported, and has no entries.
    fn no_entry(&mut self, place: &Place, known: &[String]) -> Reported {
        let text = &place.name.text;
        let is_of = |name: &&String| {
            name.strip_prefix(text).is_some_and(|rest| rest.is_empty() || rest.starts_with(['[', '_']))
        };
        let entries: Vec<&str> = known.iter().filter(is_of).map(String::as_str).collect();
        if entries.is_empty() && self.reports.any() {
            return Reported;
        }
        let error = Diagnostic::new(place.extent, format!("`{text}` has no such entry"));
        let way_out = format!("name it without an index: `{text}`");
        self.report(place, error.way_out(way_out))
    }

    /// What has a name but no symbol, and what it is: (7), λ times φ is a power; the momentum of a section has its unit
    /// times J s; an impulse times the rate of its row is an energy.
    fn labelled(named: &Named<'_>, at: Extent) -> Vec<(&'static str, String, Measured)> {
        let of = |name: &str| Measured::expected(format!("`{name}`"), at);
        let mut found = Vec::new();
        let outputs = named.outputs.iter().map(|output| (OUTPUT, output));
        for (what, value) in outputs.chain(named.claims.iter().map(|claim| ("claim", claim))) {
            let side = of(&value.name).expression(value.value, Kind::Velocities, 1);
            found.push((what, value.name.clone(), side));
        }
        for constraint in named.constraints {
            if let Some(label) = &constraint.label {
                let side = of(label).energy(1).time(-1);
                let side = side.expression(constraint.residual, Kind::Velocities, -1);
                found.push(("multiplier of", label.clone(), side));
            }
        }
        for symmetry in named.symmetries {
            let side = of(&symmetry.name).energy(1).time(1);
            let side = side.expression(symmetry.value, Kind::Sections, 1);
            found.push(("momentum of", symmetry.name.clone(), side));
        }
        for impulse in named.impulses {
            let side = of(&impulse.name).energy(1).time(i64::from(!impulse.is_velocity));
            let side = side.expression(impulse.row, Kind::Velocities, -1);
            found.push(("impulse of", impulse.name.clone(), side));
        }
        found
    }

    /// What symbols have which unit.
    fn reading(&self) -> Reading {
        let rates = self.tables.coordinates.iter().map(|coordinate| (coordinate.rate, coordinate.symbol));
        let auxiliary = self.tables.auxiliary.iter().map(|state| (state.rate, state.symbol));
        let rates = rates.chain(auxiliary);
        let sections = self.tables.sections.iter().map(|section| section.symbol);
        let frame = self.tables.frame.iter().map(|section| section.symbol);
        let calls = self.calls.iter().map(|call| (call.symbol, call.method.clone()));
        Reading::new(self.time, rates, sections.chain(frame), calls)
    }

    /// Everything with a name, in the order of the report.
    fn measured(&self, named: &Named<'_>, reading: &mut Reading) -> Vec<Unitary> {
        let tables = &self.tables;
        let symbols: Vec<SymbolId> = (tables.coordinates.iter().map(|coordinate| coordinate.symbol))
            .chain(tables.sections.iter().map(|section| section.symbol))
            .chain(tables.frame.iter().map(|section| section.symbol))
            .chain(named.orthonormal.iter().copied())
            .chain(tables.auxiliary.iter().map(|state| state.symbol))
            .chain(tables.inputs.iter().map(|input| input.symbol))
            .chain(tables.parameters.iter().map(|parameter| parameter.symbol))
            .collect();
        let name = |symbol: &SymbolId| self.graph.symbols()[*symbol].clone();
        let of_symbol = |name: String, form: Form| Unitary { said: name.clone(), key: (name, true), form };
        // of a symmetric matrix the entries above the diagonal are read, and those below are the same
        let of = |id: ParamId| tables.parameters[id].symbol;
        let above: BTreeMap<SymbolId, SymbolId> =
            self.symmetric.iter().map(|(upper, lower)| (of(*lower), of(*upper))).collect();
        let mut found: Vec<Unitary> = symbols
            .iter()
            .map(|symbol| {
                let read = above.get(symbol).unwrap_or(symbol);
                let form = reading.symbol(*read, Kind::Velocities);
                Unitary { said: name(symbol), ..of_symbol(name(read), form) }
            })
            .collect();
        for (id, constant) in self.graph.constants().iter_ids() {
            found.push(of_symbol(constant.name.clone(), Form::of(Unknown::Constant(id))));
        }
        let taken: BTreeSet<String> = found.iter().map(|unitary| unitary.said.clone()).collect();
        for (what, name, side) in Self::labelled(named, self.origins.whole()) {
            let said = if taken.contains(&name) { format!("{what} {name}") } else { name.clone() };
            let form = self.form_of(&side, reading);
            found.extend(form.map(|form| Unitary { said, key: (name, false), form }));
        }
        found
    }
}

/// What an output is called where its name is that of something else.
const OUTPUT: &str = "output";

/// The unit of a multiple, such as `m` for `1e-3 m`.
fn coherent(multiple: &str) -> &str {
    multiple.split_once(' ').map_or(multiple, |(_, unit)| unit.trim_start_matches("· 1e-3 "))
}

/// Units in the documentation of generated fields.
fn describe(layout: &mut Layout, quantities: &[Quantity]) {
    let known: BTreeMap<&str, &Unit> =
        quantities.iter().map(|quantity| (quantity.name.as_str(), &quantity.unit)).collect();
    let Layout { parameters, coordinates, velocities, frame, auxiliary, inputs, outputs, .. } = layout;
    let symbols = [parameters, coordinates, velocities, frame, auxiliary, inputs].map(|list| (list, false));
    for (list, is_output) in symbols.into_iter().chain([(outputs, true)]) {
        for family in list {
            let unit = |name: &String| {
                let of_output = is_output.then(|| known.get(format!("{OUTPUT} {name}").as_str())).flatten();
                match of_output.or_else(|| known.get(name.as_str()))? {
                    Unit::Known(text) => Some(text.clone()),
                    Unit::Free => None,
                }
            };
            let units: Option<Vec<String>> = family.names().iter().map(unit).collect();
            family.units = units.unwrap_or_default();
        }
    }
}

/// Two units without a space between them, or a unit with its power, as they are written.
fn joined(name: &str) -> Option<String> {
    (1..name.len()).filter_map(|at| name.split_at_checked(at)).find_map(|(unit, rest)| {
        let is_unit = |text: &str| UNITS.contains(&text);
        let is_power = rest.chars().all(|c| c.is_ascii_digit());
        match rest {
            _ if !is_unit(unit) => None,
            _ if is_power => Some(format!("{unit}^{rest}")),
            _ => is_unit(rest).then(|| format!("{unit} {rest}")),
        }
    })
}
