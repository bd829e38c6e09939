//! The program that times derivations finds the declarations that it times.

use std::process::Command;

#[test]
fn every_declaration_is_found() {
    // one is timed; all are read
    let output =
        Command::new(env!("CARGO_BIN_EXE_derivation")).arg("ball on table").output().expect("it runs");
    let (table, errors) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success(), "{errors}");
    assert!(table.contains("| ball on table |"), "{table}");
}
