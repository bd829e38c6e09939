//! Builds the gallery: `cargo run --release -p gallery-builder`, in the folder of the gallery, leaves a folder of
//! static files in `site`, which any server of files shows.

use std::error::Error;
use std::path::Path;
use std::process::Command;
use std::{env, fs};

fn main() -> Result<(), Box<dyn Error>> {
    let gallery = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let target = gallery.join("target");
    let cargo = env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned());
    let built = Command::new(cargo)
        .current_dir(&gallery)
        .args(["build", "--release", "--locked", "--package", "gallery-machines", "--lib"])
        .args(["--target", "wasm32-unknown-unknown"])
        .arg("--target-dir")
        .arg(&target)
        .status()?;
    if !built.success() {
        return Err("the machines do not compile for wasm32-unknown-unknown: `rustup target add` it".into());
    }
    let site = gallery.join("site");
    if site.exists() {
        fs::remove_dir_all(&site)?;
    }
    fs::create_dir_all(&site)?;
    wasm_bindgen_cli_support::Bindgen::new()
        .input_path(target.join("wasm32-unknown-unknown/release/gallery_machines.wasm"))
        .web(true)?
        .typescript(false)
        .out_name("machines")
        .generate(&site)?;
    let mut size = 0;
    for entry in fs::read_dir(gallery.join("web"))? {
        let path = entry?.path();
        if let Some(name) = path.file_name() {
            fs::copy(&path, site.join(name))?;
        }
    }
    for entry in fs::read_dir(&site)? {
        size += entry?.metadata()?.len();
    }
    println!("{} kB in {}", size / 1000, site.canonicalize()?.display());
    Ok(())
}
