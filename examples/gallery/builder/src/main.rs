//! Builds the gallery: `cargo run --release -p gallery-builder`, in the folder of the gallery, leaves a folder of
//! static files in `site`, which any server of files shows.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::{env, fs};

fn main() -> Result<(), Box<dyn Error>> {
    let gallery = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    // where this program was built, whose packages are the same
    let target = env::var_os("CARGO_TARGET_DIR").map_or_else(|| gallery.join("target"), PathBuf::from);
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
    equations(&gallery, &site)?;
    for entry in fs::read_dir(gallery.join("web"))? {
        let path = entry?.path();
        if let Some(name) = path.file_name() {
            fs::copy(&path, site.join(name))?;
        }
    }
    println!("{} kB in {}", size(&site)? / 1000, site.canonicalize()?.display());
    Ok(())
}

/// Puts KaTeX beside the page, as `package-lock.json` names it. Without npm, equations are shown as they are typed.
fn equations(gallery: &Path, site: &Path) -> Result<(), Box<dyn Error>> {
    let arguments = ["ci", "--ignore-scripts", "--no-audit", "--no-fund", "--loglevel=error"];
    let installed = Command::new("npm").current_dir(gallery).args(arguments).stdout(Stdio::null()).status();
    if !installed.is_ok_and(|status| status.success()) {
        eprintln!("WARNING: npm does not give KaTeX, so the page shows its equations as TeX");
        fs::write(site.join("katex.js"), "export default null;\n")?;
        fs::write(site.join("katex.css"), "")?;
        return Ok(());
    }
    let katex = gallery.join("node_modules/katex/dist");
    let script = fs::read_to_string(katex.join("katex.min.js"))?;
    // as a module, which it is not by itself
    let module = format!(
        "const module = {{ exports: {{}} }}, exports = module.exports;\n{script}\nexport default module.exports;\n"
    );
    fs::write(site.join("katex.js"), module)?;
    fs::copy(katex.join("katex.min.css"), site.join("katex.css"))?;
    fs::create_dir_all(site.join("fonts"))?;
    for entry in fs::read_dir(katex.join("fonts"))? {
        let path = entry?.path();
        // one of three formats, which every browser of this decade reads
        if let (Some(name), Some("woff2")) = (path.file_name(), path.extension().and_then(|end| end.to_str()))
        {
            fs::copy(&path, site.join("fonts").join(name))?;
        }
    }
    Ok(())
}

/// The size of a folder in bytes.
fn size(folder: &Path) -> Result<u64, Box<dyn Error>> {
    let mut size = 0;
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let metadata = entry.metadata()?;
        size += if metadata.is_dir() { self::size(&entry.path())? } else { metadata.len() };
    }
    Ok(size)
}
