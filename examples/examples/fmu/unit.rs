//! What a functional mock-up unit says of itself: its variables, by the structs of the generated C.

use std::fmt::Write;

/// A machine with `emit { c }`, with a value for everything that it is given.
pub(crate) struct Unit<'a> {
    /// The name of the struct.
    pub(crate) name: &'a str,
    /// Its `C99`.
    pub(crate) functions: &'a str,
    /// Values in the order of the fields.
    pub(crate) parameters: &'a [f64],
    pub(crate) start: &'a [f64],
    pub(crate) inputs: &'a [f64],
}

impl Unit<'_> {
    /// The fields of a struct of the generated C, entry by entry: each as C names it.
    fn fields(&self, structure: &str) -> Vec<String> {
        let Some((before, _)) = self.functions.split_once(&format!("}} {structure};")) else {
            return Vec::new();
        };
        let body = before.rsplit('{').next().unwrap_or_default();
        let declared = body.lines().filter_map(|line| line.trim().strip_prefix("double ")?.strip_suffix(';'));
        let mut fields = Vec::new();
        for field in declared {
            let mut parts = field.split(['[', ']']).filter(|part| !part.is_empty());
            let mut entries = vec![parts.next().unwrap_or_default().to_owned()];
            for length in parts.filter_map(|length| length.parse::<usize>().ok()) {
                let indexed =
                    |entry: &String| (0..length).map(|k| format!("{entry}[{k}]")).collect::<Vec<_>>();
                entries = entries.iter().flat_map(indexed).collect();
            }
            fields.append(&mut entries);
        }
        fields
    }

    fn parameters(&self) -> Vec<String> {
        self.fields(self.name)
    }

    fn states(&self) -> Vec<String> {
        self.fields(&format!("{}State", self.name))
    }

    fn inputs(&self) -> Vec<String> {
        self.fields(&format!("{}Input", self.name))
    }

    /// A name of the unit that changes when its equations do (FNV-1a).
    fn identity(&self) -> u64 {
        self.functions
            .bytes()
            .fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
    }

    /// `modelDescription.xml`. The references of the variables: states, their rates, inputs, parameters, the energy.
    pub(crate) fn description(&self) -> String {
        let (states, inputs, parameters) = (self.states(), self.inputs(), self.parameters());
        let (mut variables, mut rates) = (String::new(), String::new());
        let mut reference = 0;
        let mut variable = |name: &str, attributes: &str, real: &str| {
            let _ = writeln!(
                variables,
                r#"    <ScalarVariable name="{name}" valueReference="{reference}" {attributes}><Real {real}/></ScalarVariable>"#
            );
            reference += 1;
        };
        for (name, start) in states.iter().zip(self.start) {
            variable(
                name,
                r#"causality="local" variability="continuous" initial="exact""#,
                &format!(r#"start="{start:?}""#),
            );
        }
        for (index, name) in (1..).zip(&states) {
            variable(
                &format!("der({name})"),
                r#"causality="local" variability="continuous" initial="calculated""#,
                &format!(r#"derivative="{index}""#),
            );
            let _ = writeln!(rates, r#"      <Unknown index="{}"/>"#, states.len() + index);
        }
        for (name, value) in inputs.iter().zip(self.inputs) {
            variable(name, r#"causality="input" variability="continuous""#, &format!(r#"start="{value:?}""#));
        }
        for (name, value) in parameters.iter().zip(self.parameters) {
            variable(
                name,
                r#"causality="parameter" variability="fixed" initial="exact""#,
                &format!(r#"start="{value:?}""#),
            );
        }
        variable("energy", r#"causality="output" variability="continuous" initial="calculated""#, "");
        let energy = format!("      <Unknown index=\"{reference}\"/>\n");
        format!(
            r#"<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="{name}" guid="{guid:016x}" generationTool="nonholonomic" numberOfEventIndicators="0">
  <ModelExchange modelIdentifier="model" canNotUseMemoryManagementFunctions="true" needsExecutionTool="false" canGetAndSetFMUstate="true" canSerializeFMUstate="true">
    <SourceFiles><File name="fmi2.c"/></SourceFiles>
  </ModelExchange>
  <ModelVariables>
{variables}  </ModelVariables>
  <ModelStructure>
    <Outputs>
{energy}    </Outputs>
    <Derivatives>
{rates}    </Derivatives>
    <InitialUnknowns>
{rates}{energy}    </InitialUnknowns>
  </ModelStructure>
</fmiModelDescription>
"#,
            name = self.name,
            guid = self.identity(),
        )
    }

    /// `model.h`: what `fmi2.c` has to know of the model.
    pub(crate) fn header(&self) -> String {
        let (name, prefix) = (self.name, self.name.to_lowercase());
        let (states, inputs, parameters) = (self.states(), self.inputs(), self.parameters());
        let list = |names: &[String], of: &str| -> String {
            names.iter().map(|name| format!("    &instance->{of}.{name},\n")).collect::<Vec<_>>().concat()
        };
        let values =
            |values: &[f64]| values.iter().map(|value| format!("{value:?}")).collect::<Vec<_>>().join(", ");
        format!(
            r#"#include "model.c"
#define GUID "{guid:016x}"
#define STATES {n}
#define INPUTS {m}
#define PARAMETERS {p}
typedef {name} Parameters;
typedef {name}State State;
typedef {name}Input Input;
#define DERIVATIVE {prefix}_derivative
#define ENERGY {prefix}_energy
static const double START[] = {{ {start} }};
/* all variables that can be set, by their references: states, inputs, parameters */
#define PLACES(instance) {{ \
{places}}}
"#,
            guid = self.identity(),
            n = states.len(),
            m = inputs.len(),
            p = parameters.len(),
            start = values(&[self.start, self.inputs, self.parameters].concat()),
            places = [list(&states, "state"), list(&inputs, "input"), list(&parameters, "parameters")]
                .concat()
                .replace('\n', " \\\n"),
        )
    }
}
