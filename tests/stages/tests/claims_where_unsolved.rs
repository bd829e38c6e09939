//! Claims where position constraints hold that are solved for no coordinate, such as `sin(x) = 0`.

use nh_stages::{declarations, errors};

fn refusals(position: &str, claim: &str) -> Vec<String> {
    let text = format!(
        "#[nonholonomic(base {{ x, z }} lagrangian {{ (der(x)^2 + der(z)^2)/2 }} holonomic {{ {position} }} \
         conserved {{ c = {claim}; }})] struct Machine {{}}"
    );
    errors(&declarations(&text).pop().expect("one declaration").expanded())
}

#[test]
fn values_of_functions_are_known_there() {
    for (position, claim) in [
        ("sin(x) = 0;", "sin(x)*z"),
        ("sin(x) = 0;", "sin(2*x)*z"),
        ("sin(x) = 0;", "(cos(x)^2 - 1)*z"),
        ("sin(x) = 0;", "(cos(4*x) - 1)*z + cos(x)"),
        ("cos(x) = 0;", "cos(x)*z + sin(x)"),
        ("2*cos(x) = 1;", "(4*sin(x)^2 - 3)*z"),
        ("2*cos(x) = 1;", "(cos(3*x) + 1)*z"),
    ] {
        assert_eq!(refusals(position, claim), [""; 0], "{position} {claim}");
    }
    for (position, claim) in [
        ("sin(x) = 0;", "cos(x)*z"),
        // true on every other zero
        ("sin(x) = 0;", "(cos(x) - 1)*z"),
        ("sin(x) = 0;", "sin(x/2)*z"),
        ("2*cos(x) = 1;", "(sin(x) - sqrt(3)/2)*z"),
        ("2*cos(x) = 1;", "(cos(3*x) - 1)*z"),
    ] {
        assert_eq!(refusals(position, claim).len(), 1, "{position} {claim}");
    }
}
