//! What accuracy costs for reference systems: `cargo run --release -p nh-work-precision [name …]`.

mod systems;

fn main() -> std::io::Result<()> {
    let studies = systems::all();
    let names: Vec<String> = studies.iter().map(|study| study.name().to_owned()).collect();
    let wanted = nh_work_precision::wanted(&names.iter().map(String::as_str).collect::<Vec<_>>())?;
    for study in studies {
        if wanted.contains(&study.name()) {
            study.finish()?;
        }
    }
    Ok(())
}
