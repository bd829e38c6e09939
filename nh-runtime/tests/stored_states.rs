//! States and inputs as they are stored: read as they were written, and refused by their own names.
#![cfg(feature = "serde")]

use nonholonomic::prelude::*;

/// A carriage with two lags.
#[nonholonomic(
    base       { q[3], phi }
    lagrangian { m / 2 * (der(q[0])^2 + der(q[1])^2 + der(q[2])^2 + der(phi)^2) }
    inputs     { u[2], w }
    auxiliary  { der(s[i in 0..2]) = u[i] - s[i]; }
    forces     { phi: w; q[0]: s[0]; q[1]: s[1]; }
)]
#[derive(Clone, Copy, Debug)]
struct Carriage {
    m: f64,
}

fn state() -> CarriageState {
    CarriageState {
        q: [1.5, -0.0, f64::MIN_POSITIVE],
        phi: f64::MAX,
        q_dot: [0.25, 5e-324, -3.0],
        phi_dot: 1.0,
        s: [0.5; 2],
    }
}

#[test]
fn what_is_read_is_what_was_written() {
    let text = serde_json::to_string(&state()).unwrap();
    let read: CarriageState = serde_json::from_str(&text).unwrap();
    assert_eq!(read.to_array().map(f64::to_bits), state().to_array().map(f64::to_bits));
    let input = CarriageInput { u: [1.0, 2.0], w: 3.0 };
    // a derivative is stored as a state is
    let rates = Carriage { m: 2.0 }.derivative(0.0, &state(), &input);
    let text = serde_json::to_string(&rates).unwrap();
    assert_eq!((rates.phi_dot, serde_json::from_str(&text).ok()), (1.5, Some(rates)));
    let text = serde_json::to_string(&input).unwrap();
    assert_eq!(
        (text.as_str(), serde_json::from_str(&text).ok()),
        (r#"{"u":[1.0,2.0],"w":3.0}"#, Some(input))
    );
    // in order and without names, for formats that have none
    assert_eq!(serde_json::from_str("[[1, 2], 3]").ok(), Some(input));
}

#[test]
fn what_is_something_else_is_refused_by_the_name_of_the_state() {
    let refused = |text: &str| serde_json::from_str::<CarriageState>(text).unwrap_err().to_string();
    for text in ["null", "3.0", "[]", "\"q\""] {
        assert!(refused(text).contains("expected CarriageState"), "{}", refused(text));
    }
    assert!(refused("{}").starts_with("missing field `q`"));
    let text = serde_json::to_string(&state()).unwrap();
    // JSON has no numbers that are not finite: they are written as null, and not taken for numbers
    let endless = serde_json::to_string(&CarriageState { phi_dot: f64::INFINITY, ..state() }).unwrap();
    assert!(refused(&endless).contains("null"));
    for (name, of) in
        [("too few", text.replacen("1.5,", "", 1)), ("too many", text.replacen("1.5,", "1.5,1.5,", 1))]
    {
        assert!(serde_json::from_str::<CarriageState>(&of).is_err(), "{name}");
    }
}
