//! The emitted derivative compiled alone: LLVM's time for it, and its instructions.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

use nh_counted::callgrind;

use crate::expand;
use crate::families::Declaration;

/// What could be measured.
#[derive(Default)]
pub(crate) struct Compiled {
    /// Instructions per evaluation.
    pub(crate) instructions: Option<f64>,
    /// Milliseconds of code generation: compilation less a compilation that stops before it.
    pub(crate) llvm: Option<f64>,
}

/// Compiles a program that evaluates the derivative, with the compiler's default pass pipeline at
/// `-O3`, and counts.
pub(crate) fn measure(declaration: &Declaration) -> Compiled {
    let Some((program, llvm)) = compile(declaration) else { return Compiled::default() };
    let profile = program.with_extension("callgrind");
    let counts = callgrind::is_present().then(|| {
        callgrind::count(&[&program.to_string_lossy()], &profile, |name| name.ends_with("::evaluated")).ok()
    });
    let instructions = counts.flatten().and_then(|counts| counts.values().next().copied());
    Compiled { instructions, llvm: Some(llvm) }
}

/// The program, and the milliseconds that generating its code took.
fn compile(declaration: &Declaration) -> Option<(PathBuf, f64)> {
    let dependencies = std::env::current_exe().ok()?.with_file_name("deps");
    let runtime = newest(&dependencies, "libnonholonomic-")?;
    let source = dependencies.with_file_name("nh-bench-member.rs");
    std::fs::write(&source, text(declaration)?).ok()?;
    let program = source.with_extension("");
    let run = |emit: &str, output: &Path| -> Option<f64> {
        let (start, before) = (Instant::now(), children_on_processor());
        let status = Command::new("rustc")
            .args([
                "--edition",
                "2024",
                "-C",
                "opt-level=3",
                "-C",
                "target-cpu=x86-64-v3",
                "-C",
                "codegen-units=1",
            ])
            .args(["--emit", emit, "-A", "warnings", "-o"])
            .arg(output)
            .arg("-L")
            .arg(format!("dependency={}", dependencies.display()))
            .arg("--extern")
            .arg(format!("nonholonomic={}", runtime.display()))
            .arg(&source)
            .stderr(Stdio::null())
            .status()
            .ok()?;
        let spent = before.zip(children_on_processor()).map(|(before, after)| after - before);
        status.success().then(|| spent.unwrap_or_else(|| start.elapsed().as_secs_f64() * 1e3))
    };
    let shortest = |emit: &str, extension: &str| -> Option<f64> {
        let times: Option<Vec<f64>> = (0..3).map(|_| run(emit, &program.with_extension(extension))).collect();
        times?.into_iter().reduce(f64::min)
    };
    let llvm = shortest("obj", "o")? - shortest("metadata", "rmeta")?;
    run("link", &program)?;
    Some((program, llvm))
}

/// Milliseconds that finished children have spent on processors, as far as the clock ticks: Linux.
fn children_on_processor() -> Option<f64> {
    const TICK: f64 = 10.0;
    let text = std::fs::read_to_string("/proc/self/stat").ok()?;
    // after the name in parentheses; user and system time of children are the 14th and 15th from there
    let (_, fields) = text.rsplit_once(") ")?;
    let ticks: Option<Vec<f64>> =
        fields.split(' ').skip(13).take(2).map(|field| field.parse().ok()).collect();
    Some(TICK * ticks?.iter().sum::<f64>())
}

/// A program that evaluates the derivative at one state, over and over.
fn text(declaration: &Declaration) -> Option<String> {
    let items = expand::nonholonomic(declaration.attribute.parse().ok()?, declaration.item.parse().ok()?);
    let name = declaration.item.split_whitespace().skip_while(|word| *word != "struct").nth(1)?;
    let ordinary = &declaration.ordinary;
    Some(format!(
        "{items}
        #[inline(never)]
        fn evaluated(
            system: &{name}, state: &{name}State, input: &<{name} as nonholonomic::Dynamics>::Input,
        ) -> {name}State {{
            system.derivative(0.0, state, input)
        }}
        fn main() {{
            let system = {name} {{ {ordinary} }};
            let state = {name}State::from(core::array::from_fn(|i| 0.1 + 0.05 * i as f64));
            for _ in 0..100 {{
                let state = core::hint::black_box(&state);
                core::hint::black_box(evaluated(core::hint::black_box(&system), state, &Default::default()));
            }}
        }}"
    ))
}

/// The newest library of that name.
fn newest(directory: &Path, prefix: &str) -> Option<PathBuf> {
    let entries = std::fs::read_dir(directory).ok()?.filter_map(Result::ok);
    let libraries = entries.filter(|entry| {
        let path = entry.path();
        let is_library = path.extension().is_some_and(|extension| extension == "rlib");
        is_library && entry.file_name().to_string_lossy().starts_with(prefix)
    });
    libraries
        .max_by_key(|entry| entry.metadata().and_then(|data| data.modified()).ok())
        .map(|entry| entry.path())
}
