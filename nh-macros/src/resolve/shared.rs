//! `let …;` between the sections: values and functions that every section knows.
//!
//! A value is read when it is first needed, those that it is made of before it, so that their order does not
//! matter. What it contains – velocities, inputs – is remembered, and asked for where it is used.

use std::collections::BTreeMap;
use std::rc::Rc;

use super::array::Array;
use super::between_sections::{Contained, Contents, Known, State};
use super::context::Context;
use super::reports::{Outcome, Reported};
use super::resolver::Resolver;
use super::scope::Meaning;
use super::statements::lets;
use super::vectors::is_built_in;
use crate::report::Diagnostic;
use crate::syntax::ast::{Expr, ExprKind, Let, Name, SystemDecl};

/// Functions that call each other, at most so many in a row.
const NESTED: usize = 32;

impl Resolver {
    /// Declares the names of the lines between the sections.
    pub(super) fn share(&mut self, declaration: &SystemDecl) {
        self.scope.elsewhere = local_lets(declaration);
        self.share_also(&declaration.sections.lets);
    }

    /// Declares the names of these lines beside those that are known.
    pub(super) fn share_also(&mut self, lines: &[Rc<Let>]) {
        for line in lines {
            let place = self.shared.lines.len();
            let meaning = match line.arguments {
                None => Meaning::Shared(place),
                Some(_) => Meaning::Function(place),
            };
            let fresh = Self::fresh_function(line).and_then(|()| self.scope.declare(&line.name, meaning));
            let fresh = self.keep(&line.name, fresh);
            if fresh.is_err() {
                self.scope.insert(line.name.text.clone(), Meaning::Broken);
            }
            self.shared.lines.push(Rc::clone(line));
            self.shared.states.push(if fresh.is_ok() { State::Unread } else { State::Broken });
        }
        self.shared.needs = self.shared.lines.iter().map(|line| self.needed(line)).collect();
        self.refuse_cycles();
    }

    /// A function has a name that no function has.
    fn fresh_function(line: &Let) -> Result<(), Diagnostic> {
        let name = &line.name;
        if line.arguments.is_some() && is_built_in(&name.text) {
            return Err(Diagnostic::new(name.extent(), format!("`{}` is a function already", name.text))
                .way_out("choose another name for yours"));
        }
        Ok(())
    }

    /// The lines that a line names, in the order of their names in it.
    fn needed(&self, line: &Let) -> Vec<usize> {
        let mut found = Vec::new();
        let mut visit = |expr: &Expr| {
            let meaning = match &expr.kind {
                ExprKind::Name(name) => match self.scope.get(&name.text) {
                    Some(Meaning::Shared(place)) => Some(*place),
                    _ => None,
                },
                ExprKind::Call(name, _) => match self.scope.get(&name.text) {
                    Some(Meaning::Function(place)) => Some(*place),
                    _ => None,
                },
                _ => None,
            };
            found.extend(meaning.filter(|place| !found.contains(place)));
        };
        line.value.walk(&mut visit);
        for binder in &line.binders {
            binder.from.walk(&mut visit);
            binder.to.walk(&mut visit);
        }
        found
    }

    /// Lines that lead back to themselves have no value.
    fn refuse_cycles(&mut self) {
        let count = self.shared.lines.len();
        // 0: not met, 1: on the way, 2: done
        let mut met = vec![0_u8; count];
        for start in 0..count {
            let mut way: Vec<(usize, usize)> = vec![(start, 0)];
            while let Some((line, next)) = way.last_mut() {
                let line = *line;
                if *next == 0 {
                    if met[line] != 0 {
                        way.pop();
                        continue;
                    }
                    met[line] = 1;
                }
                let needs = self.shared.needs[line].get(*next).copied();
                *next += 1;
                match needs {
                    None => {
                        met[line] = 2;
                        way.pop();
                    }
                    Some(needed) if met[needed] == 1 => {
                        let from = way.iter().position(|(line, _)| *line == needed).unwrap_or(0);
                        let cycle: Vec<usize> = way[from..].iter().map(|(line, _)| *line).collect();
                        self.cycle(&cycle);
                    }
                    Some(needed) => way.push((needed, 0)),
                }
            }
        }
    }

    fn cycle(&mut self, cycle: &[usize]) {
        let names: Vec<String> = cycle
            .iter()
            .chain(cycle.first())
            .map(|k| format!("`{}`", self.shared.lines[*k].name.text))
            .collect();
        for line in cycle {
            self.shared.states[*line] = State::Broken;
            self.scope.insert(self.shared.lines[*line].name.text.clone(), Meaning::Broken);
        }
        let Some(first) = cycle.first().map(|line| Rc::clone(&self.shared.lines[*line])) else { return };
        let what = match (first.arguments.is_some(), cycle.len()) {
            (true, 1) => format!("the function {} calls itself", names[0]),
            (true, _) => format!("the function {} leads back to itself", names[0]),
            (false, _) => format!("{} is defined by itself", names[0]),
        };
        let error = Diagnostic::new(first.name.extent(), what)
            .evidence(format!("{} needs {}", names[0], names[1..].join(", which needs ")))
            .way_out("write one of them without the others");
        self.report(&*first, error);
    }

    /// The value of a line, where an expression uses it.
    pub(super) fn shared_value(&mut self, place: usize, at: &Name) -> Outcome<Rc<Array>> {
        self.read(place)?;
        let State::Read((value, contents)) = self.shared.states[place].clone() else { return Err(Reported) };
        self.admit(&contents, at)?;
        self.uses_abbreviation(&at.text);
        Ok(value)
    }

    /// Reads a line, and before it whatever it needs: a long chain of lines is no deep recursion.
    fn read(&mut self, place: usize) -> Outcome<()> {
        let mut way = vec![(place, false)];
        while let Some((line, ready)) = way.pop() {
            if !matches!(self.shared.states[line], State::Unread) {
                continue;
            }
            if self.shared.lines[line].arguments.is_some() {
                // what a function needs is read before the line that calls it
                if !ready && self.shared.called.insert(line) {
                    way.extend(self.shared.needs[line].iter().map(|needed| (*needed, false)));
                }
                continue;
            }
            if ready {
                let written = Rc::clone(&self.shared.lines[line]);
                self.open_conditions();
                let read = self.apart(Vec::new(), |this| this.abbreviated(&written));
                self.abbreviates(&written.name.text);
                self.close_conditions();
                self.shared.states[line] = read.map_or(State::Broken, State::Read);
            } else {
                way.push((line, true));
                way.extend(self.shared.needs[line].iter().map(|needed| (*needed, false)));
            }
        }
        if matches!(self.shared.states[place], State::Read(_)) { Ok(()) } else { Err(Reported) }
    }

    /// Reads something between the sections: only shared names and these are known.
    fn apart(
        &mut self,
        bound: Vec<(String, Meaning)>,
        value: impl FnOnce(&mut Self) -> Outcome<Array>,
    ) -> Outcome<Known> {
        let context = std::mem::replace(&mut self.context, Context::Shared);
        let locals = self.scope.exchange(bound);
        let user = self.shared.user;
        self.shared.user = user.or(Some(context));
        self.shared.recording.push(Contents::default());
        let value = value(self);
        let contents = self.shared.recording.pop().unwrap_or_default();
        self.shared.user = user;
        self.scope.exchange(locals);
        self.context = context;
        Ok((Rc::new(value?), Rc::new(contents)))
    }

    /// Asks whether a section may use what a shared value contains, or hands that on.
    fn admit(&mut self, contents: &Contents, at: &Name) -> Outcome<()> {
        for Contained { usage, written, path } in &contents.found {
            let path: Vec<String> = std::iter::once(&at.text).chain(path).cloned().collect();
            if self.shared.reading() {
                let contained = Contained { usage: *usage, written: written.clone(), path };
                self.shared.recording.iter_mut().rev().take(1).for_each(|into| into.add(contained.clone()));
                continue;
            }
            if let Err(error) = self.context.check(*usage, written, at.extent()) {
                let way: Vec<String> = path.iter().map(|name| format!("`{name}`")).collect();
                let error = error.because(format!("it is in {}", way.join(", which needs ")));
                // at the first of its uses in a section
                let is_new = self.shared.told.insert(error.to_string());
                return Err(if is_new { self.report(at, error) } else { Reported });
            }
        }
        Ok(())
    }

    /// `h(a, b)`: the value of a function.
    pub(super) fn called(&mut self, place: usize, at: (&Expr, &Name), values: Vec<Array>) -> Outcome<Array> {
        let (expr, name) = at;
        let line = Rc::clone(&self.shared.lines[place]);
        let arguments = line.arguments.as_deref().unwrap_or_default();
        self.count_of_own(arguments, expr, name, values.len())?;
        self.shared.called.insert(place);
        let key = (place, values);
        if !self.shared.values.contains_key(&key) {
            let found = self.body(&line, expr, place, &key.1).ok();
            self.shared.values.insert(key.clone(), found);
        }
        let Some(Some((value, contents))) = self.shared.values.get(&key).cloned() else {
            return Err(Reported);
        };
        self.reports.spend(expr.extent, value.shape.len())?;
        self.admit(&contents, name)?;
        self.uses_abbreviation(&name.text);
        Ok((*value).clone())
    }

    /// Whether a function between the sections has as many arguments as it takes.
    pub(super) fn count_of_own(
        &mut self,
        arguments: &[Name],
        expr: &Expr,
        name: &Name,
        given: usize,
    ) -> Outcome<()> {
        self.counted(expr, name, given, arguments.len(), || {
            let names: Vec<&str> = arguments.iter().map(|argument| argument.text.as_str()).collect();
            format!("{}({})", name.text, names.join(", "))
        })
    }

    /// Whether the arguments of a function have names of their own; each that has not is reported once.
    fn fresh_arguments(&mut self, arguments: &[Name]) -> Outcome<()> {
        let mut outcome = Ok(());
        for (k, argument) in arguments.iter().enumerate() {
            let twice = arguments[..k].iter().any(|earlier| earlier.text == argument.text);
            let fresh = if twice {
                let what = format!("two arguments are called `{}`", argument.text);
                Err(Diagnostic::new(argument.extent(), what).way_out("give each its own name"))
            } else {
                self.scope.check_new_global(argument)
            };
            outcome = outcome.and(self.keep(argument, fresh));
        }
        outcome
    }

    /// The body of a function with these values for its arguments.
    fn body(&mut self, line: &Let, call: &Expr, place: usize, values: &[Array]) -> Outcome<Known> {
        if self.shared.calling.len() >= NESTED {
            let what = format!("functions call each other more than {NESTED} deep");
            return Err(self.report(call, Diagnostic::new(call.extent, what).way_out("write shorter chains")));
        }
        let arguments = line.arguments.as_deref().unwrap_or_default();
        self.fresh_arguments(arguments)?;
        let meanings = values.iter().map(|value| Meaning::Argument(Rc::new(value.clone())));
        let bound = arguments.iter().map(|argument| argument.text.clone()).zip(meanings).collect();
        self.shared.calling.push(place);
        let shapes: Vec<String> = arguments
            .iter()
            .zip(values)
            .map(|(argument, value)| format!("`{}` is {}", argument.text, value.shape))
            .collect();
        let plain = values.iter().all(|value| value.as_number().is_some());
        let note = (!plain).then(|| format!("here {}", shapes.join(", ")));
        let outer = self.reports.annotate(note);
        self.open_conditions();
        let found = self.apart(bound, |this| this.value(&line.value));
        self.abbreviates(&line.name.text);
        self.close_conditions();
        self.reports.annotate(outer);
        self.shared.calling.pop();
        found
    }

    /// Reads what no section uses, so that nothing wrong stays hidden.
    pub(super) fn unused(&mut self) {
        for place in 0..self.shared.lines.len() {
            let line = Rc::clone(&self.shared.lines[place]);
            let Some(arguments) = &line.arguments else {
                // one in error was reported
                let _ = self.read(place);
                continue;
            };
            if self.shared.called.contains(&place) || !matches!(self.shared.states[place], State::Unread) {
                continue;
            }
            // what is wrong is reported there
            let _ = self.fresh_arguments(arguments);
            self.uncalled(&line.value, arguments);
        }
    }

    /// A function without its arguments.
    pub(super) fn bare_function(&mut self, place: usize, expr: &Expr, name: &Name) -> Reported {
        let line = Rc::clone(&self.shared.lines[place]);
        let arguments: Vec<&str> =
            line.arguments.iter().flatten().map(|argument| argument.text.as_str()).collect();
        let text = &name.text;
        let error = Diagnostic::new(expr.extent, format!("`{text}` is a function and needs its arguments"))
            .way_out(format!("write `{text}({})`", arguments.join(", ")));
        self.report(expr, error)
    }
}

/// The names of lets inside sections, with the keyword of the first section.
fn local_lets(declaration: &SystemDecl) -> BTreeMap<String, &'static str> {
    let s = &declaration.sections;
    let mut found = BTreeMap::new();
    let mut all = |lines: Vec<&Let>, keyword: &'static str| {
        for line in lines {
            found.entry(line.name.text.clone()).or_insert(keyword);
        }
    };
    all(s.lagrangian.iter().flat_map(|s| &s.body.lets).collect(), "lagrangian");
    all(s.on.iter().flat_map(|s| lets(&s.body)).collect(), "on");
    all(s.velocities.iter().flat_map(|s| lets(&s.body)).collect(), "velocities");
    all(s.anchor.iter().flat_map(|s| lets(&s.body)).collect(), "anchor");
    all(s.frame.iter().flat_map(|s| lets(&s.body)).collect(), "frame");
    all(s.constraints.iter().flat_map(|s| lets(&s.body)).collect(), "constraints");
    all(s.forces.iter().flat_map(|s| lets(&s.body)).collect(), "forces");
    all(s.auxiliary.iter().flat_map(|s| lets(&s.body)).collect(), "auxiliary");
    all(s.outputs.iter().flat_map(|s| lets(&s.body)).collect(), "outputs");
    all(s.conserved.iter().flat_map(|s| lets(&s.body)).collect(), "conserved");
    all(s.symmetries.iter().flat_map(|s| lets(&s.body)).collect(), "symmetries");
    found
}
