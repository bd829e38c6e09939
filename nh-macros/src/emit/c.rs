//! `emit { c }`: the programs as one C99 file that needs nothing but libm, the same arithmetic in the same order.

use std::collections::BTreeSet;
use std::fmt::Write;

use nonholonomic_core::algebra::{Function, Function2};
use nonholonomic_core::functions::TABLE;
use nonholonomic_core::id::{Id, SymbolId, Table};
use nonholonomic_core::model::{Model, Request};
use nonholonomic_core::program::{Program, Step, Value};
use nonholonomic_core::system::System;
use proc_macro2::TokenStream;
use quote::quote;

use super::c_names::{Names, snake};
use super::layout::plain;
use super::literal;
use super::record::Record;
use super::setting::Context;
use super::symbols::{Argument, Scope};
use crate::syntax::ast;

/// `const C99`, if it is asked for.
pub(super) fn constant(
    context: &Context,
    scope: &Scope,
    system: &System,
    programs: &[(&str, &Program)],
) -> TokenStream {
    if !system.model.requests.iter().any(|(request, _)| *request == Request::C) {
        return TokenStream::new();
    }
    let file = File::new(context, scope, &system.model, programs);
    with_text(context, &file.text(programs))
}

/// `const C99` with this text.
pub(super) fn with_text(context: &Context, text: &str) -> TokenStream {
    let visibility = &context.visibility;
    quote! {
        /// The generated functions as one C99 file that needs nothing but libm: the same arithmetic in the same
        /// order.
        #visibility const C99: &'static ::core::primitive::str = #text;
    }
}

/// What all functions of the file share.
struct File<'a> {
    context: &'a Context<'a>,
    scope: &'a Scope<'a>,
    model: &'a Model,
    /// `double` or `float`.
    scalar: &'static str,
    /// The suffix of numbers and functions: nothing or `f`.
    suffix: &'static str,
    /// The name of the struct.
    name: String,
    /// What the names of functions begin with.
    prefix: String,
    types: Names,
    /// Parameters, components of the state, and inputs.
    fields: Names,
    /// Methods of the struct, which the user writes in C.
    methods: Names,
}

/// A function, with what its prototype takes.
struct Method {
    name: String,
    arguments: String,
    body: String,
}

impl<'a> File<'a> {
    fn new(
        context: &'a Context<'a>,
        scope: &'a Scope<'a>,
        model: &'a Model,
        programs: &[(&str, &Program)],
    ) -> Self {
        let is_single = matches!(context.layout.scalar, ast::Scalar::F32);
        let (scalar, suffix) = if is_single { ("float", "f") } else { ("double", "") };
        let records = || [Some(&context.state), context.input.as_ref()].into_iter().flatten();
        let declared = records().flat_map(Record::declared).map(|(name, _)| name);
        let parameters = context.layout.parameters.iter().map(|family| plain(&family.ident));
        let fields = Names::new(parameters.chain(declared), &[]);
        let steps = programs.iter().flat_map(|(_, program)| program.steps.iter());
        let called =
            steps.filter_map(
                |step| if let Step::Call { method, .. } = step { Some(method.clone()) } else { None },
            );
        let functions = programs.iter().map(|(name, _)| *name).filter(|name| is_written(name));
        let functions: Vec<String> = functions.map(str::to_owned).collect();
        let methods = Names::new(called, &functions);
        let types = records().map(|record| plain(&record.name)).chain([plain(&context.layout.name)]);
        // what functions call their arguments and results
        let types = Names::new(types, &["p", "t", "x", "u", "rate", "result"].map(str::to_owned));
        let name = types.of(&plain(&context.layout.name));
        Self { context, scope, model, scalar, suffix, prefix: snake(&name), name, types, fields, methods }
    }

    fn text(&self, programs: &[(&str, &Program)]) -> String {
        // what other programs need would be defined and not used
        let written =
            programs.iter().filter_map(|(name, program)| Some((self.method(name, program)?, *program)));
        let (methods, used): (Vec<Method>, Vec<&Program>) = written.unzip();
        let mut text = format!(
            "/* {}: generated from its declaration. C99, needs nothing but libm; no memory is allocated.\n   Compile \
             without contraction of products and sums (-std=c99 of GCC is) for the same bits everywhere. */\n\
             #include <math.h>\n\n",
            self.name
        );
        text.push_str(&self.structs());
        text.push_str(&self.prototypes_of_user(&used));
        for Method { name, arguments, .. } in &methods {
            _ = writeln!(text, "void {name}({arguments});");
        }
        text.push('\n');
        text.push_str(&self.helpers(&used));
        for Method { name, arguments, body } in &methods {
            _ = write!(text, "void {name}({arguments})\n{{\n{body}}}\n\n");
        }
        text.trim_end().to_owned() + "\n"
    }

    /// The parameters, the state, the inputs.
    fn structs(&self) -> String {
        let layout = self.context.layout;
        let parameters: Vec<(String, &[u32])> = layout
            .parameters
            .iter()
            .map(|family| (plain(&family.ident), family.lengths.as_slice()))
            .collect();
        let mut text = self.record(&self.name, &parameters);
        let records = [Some(&self.context.state), self.context.input.as_ref()];
        for record in records.into_iter().flatten() {
            text.push_str(&self.record(&self.type_name(record), &record.declared()));
        }
        text
    }

    fn record(&self, name: &str, fields: &[(String, &[u32])]) -> String {
        let scalar = self.scalar;
        let mut text = "typedef struct {\n".to_owned();
        for (field, lengths) in fields {
            _ = write!(text, "    {scalar} {}", self.fields.of(field));
            for length in *lengths {
                _ = write!(text, "[{length}]");
            }
            text.push_str(";\n");
        }
        if fields.is_empty() {
            text.push_str("    char nothing;\n");
        }
        _ = write!(text, "}} {name};\n\n");
        text
    }

    /// Methods of the struct, which the user writes in C.
    fn prototypes_of_user(&self, programs: &[&Program]) -> String {
        let (name, scalar) = (&self.name, self.scalar);
        let mut lines = BTreeSet::new();
        for step in programs.iter().flat_map(|program| program.steps.iter()) {
            if let Step::Call { method, arguments } = step {
                let mut line = format!("extern {scalar} {}(const {name} *p", self.method_name(method));
                for k in 0..arguments.len() {
                    _ = write!(line, ", {scalar} x{k}");
                }
                line.push_str(");\n");
                lines.insert(line);
            }
        }
        lines.into_iter().collect()
    }

    /// A method of the struct.
    fn method_name(&self, name: &str) -> String {
        format!("{}_{}", self.prefix, self.methods.of(name))
    }

    fn type_name(&self, record: &Record) -> String {
        self.types.of(&plain(&record.name))
    }

    /// The components of a record, without the dot.
    fn places(&self, record: &Record) -> Vec<String> {
        let text = |place: &TokenStream| place.to_string().replace(' ', "");
        let places = record.places(&TokenStream::new());
        places.iter().map(|place| self.fields.place(text(place).trim_start_matches('.'))).collect()
    }

    /// Multiply-adds, signs, and linear systems, as far as they occur.
    fn helpers(&self, programs: &[&Program]) -> String {
        let (scalar, f) = (self.scalar, self.suffix);
        let steps = || programs.iter().flat_map(|program| program.steps.iter());
        let mut text = String::new();
        if steps().any(|step| matches!(step, Step::MulAdd { .. })) {
            let fast = if f.is_empty() { "FP_FAST_FMA" } else { "FP_FAST_FMAF" };
            _ = write!(
                text,
                "/* a * b + c, rounded once where the target has an instruction for it */\n\
                 static {scalar} multiply_add({scalar} a, {scalar} b, {scalar} c)\n{{\n#ifdef {fast}\n    \
                 return fma{f}(a, b, c);\n#else\n    return (a * b) + c;\n#endif\n}}\n\n"
            );
        }
        if steps().any(|step| matches!(step, Step::Apply(Function::Sign, _))) {
            _ = write!(
                text,
                "static {scalar} sign_of({scalar} x)\n{{\n    return (x > 0.0{f}) ? 1.0{f} : ((x < 0.0{f}) ? -1.0{f} : \
                 x);\n}}\n\n"
            );
        }
        for (function, relation) in [(Function2::Min, "<"), (Function2::Max, ">")] {
            let name = function.name();
            let is_solving = relation == ">" && steps().any(|step| matches!(step, Step::Solve { .. }));
            if is_solving || steps().any(|step| matches!(step, Step::Apply2(found, ..) if *found == function))
            {
                _ = write!(
                    text,
                    "static {scalar} {name}_of({scalar} x, {scalar} y)\n{{\n    return ((x {relation} y) || isnan(x)) ? \
                     x : y;\n}}\n\n"
                );
            }
        }
        let sizes: BTreeSet<usize> = steps()
            .filter_map(|step| if let Step::Solve { right, .. } = step { Some(right.len()) } else { None })
            .collect();
        for size in sizes {
            text.push_str(
                &SOLVE.replace("SCALAR", scalar).replace("SIZE", &size.to_string()).replace("_F", f),
            );
        }
        text
    }

    /// The function that a program becomes; none where it takes more than time, state and input.
    fn method(&self, name: &str, program: &Program) -> Option<Method> {
        if !is_written(name) {
            return None;
        }
        let signature = TABLE.iter().find(|signature| signature.name == name);
        let takes_input =
            signature.is_none_or(|signature| signature.takes_input) && self.context.input.is_some();
        let program = program.with_known_numbers();
        let program = &program.giving(&program.outputs);
        let mut writer =
            Writer { file: self, program, values: Table::new(), used: BTreeSet::new(), body: String::new() };
        for (value, step) in program.steps.iter_ids() {
            let expression = writer.step(value, step)?;
            writer.values.push(expression);
        }
        let Writer { values, used, mut body, .. } = writer;
        let state = self.type_name(&self.context.state);
        let (struct_name, scalar) = (&self.name, self.scalar);
        let mut arguments = format!("const {struct_name} *p, {scalar} t, const {state} *x");
        let mut unused = vec![(Argument::This, "p"), (Argument::Time, "t"), (Argument::State, "x")];
        if takes_input {
            let input = self.context.input.as_ref().map(|record| self.type_name(record))?;
            _ = write!(arguments, ", const {input} *u");
            unused.push((Argument::Input, "u"));
        }
        for (_, name) in unused.iter().filter(|(argument, _)| !used.contains(argument)) {
            _ = writeln!(body, "    (void){name};");
        }
        let outputs: Vec<&String> = program.outputs.iter().map(|output| &values[*output]).collect();
        if name == "derivative" {
            _ = write!(arguments, ", {state} *rate");
            for (place, value) in self.places(&self.context.state).iter().zip(outputs) {
                _ = writeln!(body, "    rate->{place} = {value};");
            }
        } else {
            _ = write!(arguments, ", {scalar} result[{}]", outputs.len().max(1));
            for (k, value) in outputs.into_iter().enumerate() {
                _ = writeln!(body, "    result[{k}] = {value};");
            }
            if program.outputs.is_empty() {
                _ = writeln!(body, "    result[0] = 0.0{};", self.suffix);
            }
        }
        Some(Method { name: format!("{}_{name}", self.prefix), arguments, body })
    }
}

/// Whether a program with this name is a function of the file.
fn is_written(name: &str) -> bool {
    ["derivative", "jacobian"].contains(&name) || TABLE.iter().any(|signature| signature.name == name)
}

/// One function.
struct Writer<'a> {
    file: &'a File<'a>,
    program: &'a Program,
    /// What each value is called.
    values: Table<Value, String>,
    used: BTreeSet<Argument>,
    body: String,
}

impl Writer<'_> {
    /// How a value is written where it is used: a variable, unless it is a number or a place.
    fn step(&mut self, value: Value, step: &Step) -> Option<String> {
        let f = self.file.suffix;
        let of = |operand: &Value| &self.values[*operand];
        let call = |name: &str, x: &Value| format!("{name}{f}({})", of(x));
        let expression = match step {
            Step::Constant(number) => return Some(self.number(number)),
            Step::Pi => return Some(format!("3.141592653589793{f}")),
            Step::Load(symbol) => return self.load(*symbol),
            Step::SinCos(angle) => return Some(of(angle).clone()),
            Step::SinOf(pair) => call("sin", pair),
            Step::CosOf(pair) => call("cos", pair),
            Step::Add(a, b) => format!("{} + {}", of(a), of(b)),
            Step::Sub(a, b) => format!("{} - {}", of(a), of(b)),
            Step::Mul(a, b) => format!("{} * {}", of(a), of(b)),
            Step::Div(a, b) => format!("{} / {}", of(a), of(b)),
            Step::Neg(a) => format!("-{}", of(a)),
            Step::Recip(a) => format!("1.0{f} / {}", of(a)),
            Step::MulAdd { a, b, c, minus_product, minus_c } => {
                let sign = |minus: &bool| if *minus { "-" } else { "" };
                let (product, summand) = (sign(minus_product), sign(minus_c));
                // a rounding error is nothing without its exact product
                let function =
                    if self.program.is_rest(step) { format!("fma{f}") } else { "multiply_add".into() };
                format!("{function}({product}{}, {}, {summand}{})", of(a), of(b), of(c))
            }
            Step::Sqrt(a) => call("sqrt", a),
            Step::Cbrt(a) => call("cbrt", a),
            Step::PowReal(a, exponent) => format!("pow{f}({}, {})", of(a), self.number(exponent)),
            Step::Apply(Function::Sign, a) => format!("sign_of({})", of(a)),
            Step::Apply(Function::Abs, a) => call("fabs", a),
            Step::Apply(Function::Ln, a) => call("log", a),
            Step::Apply(function, a) => call(function.name(), a),
            Step::Apply2(Function2::Atan2, a, b) => format!("atan2{f}({}, {})", of(a), of(b)),
            Step::Apply2(function, a, b) => format!("{}_of({}, {})", function.name(), of(a), of(b)),
            Step::Call { method, arguments } => {
                let mut call = format!("{}(p", self.file.method_name(method));
                for argument in arguments {
                    _ = write!(call, ", {}", of(argument));
                }
                call.push(')');
                self.used.insert(Argument::This);
                call
            }
            Step::Solve { matrix, right } => return Some(self.solve(value, matrix, right)),
            Step::Component(system, index) => return Some(format!("{}[{index}]", of(system))),
        };
        let (name, scalar) = (format!("v{}", value.index()), self.file.scalar);
        let comment =
            self.program.names.get(&value).map(|symbol| self.file.model.graph.symbols()[*symbol].clone());
        let comment = comment.map(|name| format!(" /* {} */", name.replace("*/", "")));
        _ = writeln!(self.body, "    const {scalar} {name} = {expression};{}", comment.unwrap_or_default());
        Some(name)
    }

    /// A number; a negative one in parentheses.
    fn number(&self, number: &nonholonomic_core::algebra::Rational) -> String {
        let text = literal::literal(self.file.context, number).tokens.to_string().replace(' ', "");
        let (sign, digits) = text.strip_prefix('-').map_or(("", text.as_str()), |digits| ("-", digits));
        let f = self.file.suffix;
        if sign.is_empty() { format!("{digits}{f}") } else { format!("(-{digits}{f})") }
    }

    /// `p->m`, `x->theta[0]`, `u->torque`, `t`.
    fn load(&mut self, symbol: SymbolId) -> Option<String> {
        let (argument, place) = self.file.scope.place(symbol)?;
        let pointer = match argument {
            Argument::Time => "t",
            Argument::This => "p",
            Argument::State => "x",
            Argument::Input => "u",
            _ => return None,
        };
        self.used.insert(*argument);
        let text = place.to_string().replace(' ', "");
        Some(match text.split_once('.') {
            None => pointer.to_owned(),
            Some((_, field)) => format!("{pointer}->{}", self.file.fields.place(field)),
        })
    }

    fn solve(&mut self, value: Value, matrix: &[Vec<Value>], right: &[Value]) -> String {
        let (scalar, n, k) = (self.file.scalar, right.len(), value.index());
        let list = |values: &[Value]| {
            let texts: Vec<&str> = values.iter().map(|value| self.values[*value].as_str()).collect();
            format!("{{ {} }}", texts.join(", "))
        };
        let rows: Vec<String> = matrix.iter().map(|row| list(row)).collect();
        let lines = format!(
            "    {scalar} a{k}[{n}][{n}] = {{ {} }};\n    {scalar} b{k}[{n}] = {};\n    solve_{n}(a{k}, b{k});\n",
            rows.join(", "),
            list(right)
        );
        self.body.push_str(&lines);
        format!("b{k}")
    }
}

/// Gaussian elimination with scaled partial pivoting, as the runtime does it.
const SOLVE: &str = "\
/* Gaussian elimination with scaled partial pivoting: b becomes the solution of a x = b */
static void solve_SIZE(SCALAR a[SIZE][SIZE], SCALAR b[SIZE])
{
    SCALAR scales[SIZE];
    int i;
    int j;
    int k;
    for (i = 0; i < SIZE; i++) {
        SCALAR largest = 0.0_F;
        for (j = 0; j < SIZE; j++) {
            largest = max_of(largest, fabs_F(a[i][j]));
        }
        scales[i] = 1.0_F / largest;
    }
    for (k = 0; k < SIZE; k++) {
        for (i = k + 1; i < SIZE; i++) {
            if ((fabs_F(a[i][k]) * scales[i]) > (fabs_F(a[k][k]) * scales[k])) {
                SCALAR kept;
                for (j = k; j < SIZE; j++) {
                    kept = a[k][j];
                    a[k][j] = a[i][j];
                    a[i][j] = kept;
                }
                kept = b[k];
                b[k] = b[i];
                b[i] = kept;
                kept = scales[k];
                scales[k] = scales[i];
                scales[i] = kept;
            }
        }
        for (i = k + 1; i < SIZE; i++) {
            const SCALAR factor = a[i][k] / a[k][k];
            for (j = k + 1; j < SIZE; j++) {
                a[i][j] -= factor * a[k][j];
            }
            b[i] -= factor * b[k];
        }
    }
    for (k = SIZE - 1; k >= 0; k--) {
        SCALAR sum = b[k];
        for (j = k + 1; j < SIZE; j++) {
            sum -= a[k][j] * b[j];
        }
        b[k] = sum / a[k][k];
    }
}

";
