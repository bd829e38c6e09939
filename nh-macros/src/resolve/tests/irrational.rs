//! Irrational numbers in declarations: nested roots, cosines of parts of π, roots of large order.

use nonholonomic_core::compile::compile;

use super::model;

/// Numbers that are not zero.
const NUMBERS: [&str; 6] = [
    "sqrt(3 + sqrt(67))",
    "(sqrt(3 + sqrt(67)) - 3)",
    "sqrt(2 + sqrt(2 + sqrt(2)))",
    "cos(pi/5)",
    "2^(1/64)",
    "(exp(pi*sqrt(163)) - 262537412640768744)",
];

/// Numbers that are.
const ZEROS: [&str; 8] = [
    "(sqrt(3 + 2*sqrt(2)) - 1 - sqrt(2))",
    "(cos(pi/5) - (1 + sqrt(5))/4)",
    "(cos(pi/7) - cos(2*pi/7) + cos(3*pi/7) - 1/2)",
    "(sqrt(2 + sqrt(2 + sqrt(2))) - 2*cos(pi/16))",
    "((2 + sqrt(5))^(1/3) - (1 + sqrt(5))/2)",
    "(tan(pi/8) - sqrt(2) + 1)",
    "(4*atan(1/5) - atan(1/239) - pi/4)",
    "(ln(6) - ln(2) - ln(3))",
];

/// What becomes of a declaration: nothing, or what is wrong and why.
fn outcome(attribute: &str) -> Result<(), String> {
    let outcome = compile(model(attribute, "struct S;"));
    outcome.map(drop).map_err(|violations| format!("{}: {}", violations[0].what, violations[0].evidence))
}

#[test]
fn numbers_as_masses() {
    for number in NUMBERS {
        let coupled = format!(
            "base {{ x, y }} lagrangian {{ ({number}*der(x) + der(y))^2 + der(x)^2 - x*y }} emit {{ jacobian, hamiltonian }}"
        );
        let alone = format!("base {{ x }} lagrangian {{ {number}*der(x)^2 - x }}");
        for attribute in [alone, coupled] {
            assert_eq!(outcome(&attribute), Ok(()), "{attribute}");
        }
    }
    let expected = "the mass matrix is singular on the constraint distribution: its rank is 0 of 1: the Lagrangian \
                    gives the velocity `x_dot` no inertia there";
    for zero in ZEROS {
        let attribute = format!("base {{ x }} lagrangian {{ {zero}*der(x)^2 - x }}");
        assert_eq!(outcome(&attribute), Err(expected.into()), "{attribute}");
    }
}

/// Terms that vanish are none, in Lagrangians and in constraints.
#[test]
fn zeros_beside_other_terms() {
    for zero in ZEROS {
        let attribute = format!(
            "base {{ x, y, z }} lagrangian {{ der(x)^2 + der(y)^2 + der(z)^2 + {zero}*x*der(y) }}
             constraints {{ der(z) = y*der(x) + {zero}*der(y); }}"
        );
        assert_eq!(outcome(&attribute), Ok(()), "{attribute}");
    }
}
