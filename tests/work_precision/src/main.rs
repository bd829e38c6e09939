//! What accuracy costs for reference systems: `cargo run --release -p nh-work-precision [name …]`.

mod systems;

fn main() -> std::io::Result<()> {
    let wanted: Vec<String> = std::env::args().skip(1).collect();
    for study in systems::all() {
        if wanted.is_empty() || wanted.iter().any(|name| name == study.name()) {
            study.finish()?;
        }
    }
    Ok(())
}
