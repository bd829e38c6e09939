//! The texts of `emit { latex }`: `cargo run -p nh-stages --bin documents -- FOLDER [FILE …]` writes one for every
//! declaration in Rust files, or for the reference systems, the machines of the benchmark of record and the arms, and one
//! document into which all of them are put.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use nh_stages::{arms, constant, declarations, errors, references, whole_record};

fn main() -> std::io::Result<()> {
    let mut arguments = std::env::args().skip(1);
    let folder = arguments.next().unwrap_or_else(|| ".".into());
    let folder = Path::new(&folder);
    let files: Vec<String> = arguments.collect();
    let mut chosen = Vec::new();
    for file in &files {
        let found = declarations(&fs::read_to_string(file)?).into_iter();
        chosen.extend(found.map(|declaration| (declaration.name.clone(), declaration)));
    }
    if files.is_empty() {
        chosen = [references(), whole_record(), arms()].concat();
    }
    fs::create_dir_all(folder)?;
    let mut whole = "\\documentclass{article}\n\\usepackage{amsmath}\n\\begin{document}\n".to_owned();
    for (number, (name, declaration)) in chosen.into_iter().enumerate() {
        let expanded = declaration.asking_for("latex").expanded();
        let text = constant(expanded.clone(), "LATEX").filter(|text| !text.is_empty());
        let Some(text) = text else {
            println!("{name}: refused: {}", errors(&expanded).join("; "));
            continue;
        };
        let name: String = name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
        let name = format!("{number:03}_{name}");
        fs::write(folder.join(format!("{name}.tex")), text)?;
        _ = writeln!(whole, "\\input{{{name}}}");
    }
    fs::write(folder.join("all.tex"), whole + "\\end{document}\n")
}
