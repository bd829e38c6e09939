//! What becomes of declarations, as text: `cargo run -p nh-stages -- FILE [NAME …]` prints the report of every
//! declaration in a Rust file, or of those that are named, and the errors of those that are refused. Without a
//! file it reads the standard input.

use std::io::Read;

fn main() -> std::io::Result<()> {
    let mut arguments = std::env::args().skip(1);
    let mut source = String::new();
    match arguments.next().as_deref() {
        None | Some("-") => {
            std::io::stdin().read_to_string(&mut source)?;
        }
        Some(path) => source = std::fs::read_to_string(path)?,
    }
    let wanted: Vec<String> = arguments.collect();
    for declaration in nh_stages::declarations(&source) {
        if !wanted.is_empty() && !wanted.contains(&declaration.name) {
            continue;
        }
        match declaration.system() {
            Ok(system) => println!("{}", system.report),
            Err(errors) => println!("{}: refused\n{}\n", declaration.name, errors.join("\n")),
        }
    }
    Ok(())
}
