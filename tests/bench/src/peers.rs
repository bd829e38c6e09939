//! Peers: C that other tools generate for the same systems, by the scripts in `peers/`, compiled by gcc
//! for the same processor, and measured in the same way.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use crate::runner::{Data, Run, agree};
use nh_counted::callgrind;

/// A tool, and what it is given: constraints as typed, or an expert's elimination by hand.
pub const PEERS: [(&str, &str, &str); 5] = [
    ("CasADi, typed", "casadi_peer", "typed"),
    ("CasADi, expert", "casadi_peer", "expert"),
    ("SymPy, typed", "sympy_peer", "typed"),
    ("SymPy, expert", "sympy_peer", "expert"),
    ("CasADi, with jacobian", "casadi_peer", JACOBIAN),
];

/// What a tool is given where it is asked for Jacobians, too.
pub const JACOBIAN: &str = "jacobian";

/// The flags of gcc: those of this benchmark, fused multiply-adds as they are used in Rust, and none that let it assume
/// numbers to be finite or sums to be associative.
const FLAGS: [&str; 7] = [
    "-O3",
    "-march=x86-64-v3",
    "-std=gnu11",
    "-ffp-contract=fast",
    "-fno-math-errno",
    "-fno-trapping-math",
    "-Wl,-z,now",
];

/// The longest that a tool may take.
const PATIENCE: Duration = Duration::from_secs(60);

/// A peer's measurements.
#[derive(Clone, Copy)]
pub struct Measured {
    /// Instructions per evaluation.
    pub instructions: Option<f64>,
    /// Nanoseconds per evaluation.
    pub nanoseconds: f64,
    /// Milliseconds that the tool took to derive, without its start and without writing C.
    pub derivation: f64,
}

/// Where the scripts are, what runs them, and where their results go.
pub struct Workshop {
    python: String,
    scripts: PathBuf,
    results: PathBuf,
}

impl Workshop {
    /// Looks for Python with the tools, and gcc. `PYTHON` in the environment names an interpreter.
    ///
    /// # Errors
    /// What is missing.
    pub fn open(results: &Path) -> Result<Self, String> {
        let python = std::env::var("PYTHON").unwrap_or_else(|_| "python3".to_owned());
        let scripts = Path::new(env!("CARGO_MANIFEST_DIR")).join("peers");
        succeeds(Command::new(&python).args(["-c", "import casadi, sympy"])).map_err(|_| {
            "peers are not measured: they need `pip install -r tests/bench/peers/requirements.txt` \
             (PYTHON names the interpreter)"
                .to_owned()
        })?;
        succeeds(Command::new("gcc").arg("--version"))
            .map_err(|_| "peers are not measured: they need gcc".to_owned())?;
        std::fs::create_dir_all(results).map_err(|error| error.to_string())?;
        Ok(Self { python, scripts, results: results.to_owned() })
    }

    /// Measures every peer on a system; `None` where a tool takes too long.
    ///
    /// # Errors
    /// A peer that fails or computes something else.
    pub fn measure(&self, system: &dyn Run) -> Result<[Option<Measured>; PEERS.len()], String> {
        let data = system.data();
        let input = self.results.join("samples.txt");
        std::fs::write(&input, text(&data)).map_err(|error| error.to_string())?;
        let mut measured = [None; PEERS.len()];
        for (slot, peer) in measured.iter_mut().zip(PEERS) {
            let Some((program, derivation)) = self.build(system.name(), peer)? else { continue };
            let values = succeeds(Command::new(&program).arg(&input).arg("values"))?;
            let mut values = values.lines().map(|line| line.parse().unwrap_or(f64::NAN));
            for [state, _, derivative, jacobian] in &data.samples {
                let found: Vec<f64> = values.by_ref().take(state.len()).collect();
                agree(system.name(), peer.0, &found, derivative)?;
                if peer.2 == JACOBIAN {
                    let found: Vec<f64> = values.by_ref().take(jacobian.len()).collect();
                    agree(system.name(), peer.0, &found, jacobian)?;
                }
            }
            let time = succeeds(Command::new(&program).arg(&input).arg("time"))?;
            let nanoseconds = time.trim().parse().unwrap_or(f64::NAN);
            *slot = Some(Measured { instructions: self.count(&program, &input)?, nanoseconds, derivation });
        }
        Ok(measured)
    }

    /// The program of a peer, and the time that its derivation took; `None` if that is too long.
    fn build(
        &self,
        system: &str,
        (name, script, style): (&str, &str, &str),
    ) -> Result<Option<(PathBuf, f64)>, String> {
        let (source, program) = (self.results.join("peer.c"), self.results.join("peer"));
        let script = self.scripts.join(script).with_extension("py");
        let mut tool = Command::new(&self.python);
        tool.arg(script).args([system, style]).arg(&source);
        let failed = |why: String| format!("{system}: {name}: {why}");
        let Some(printed) = patiently(&mut tool).map_err(failed)? else { return Ok(None) };
        let derivation = printed.trim().parse().map_err(|_| failed(printed.clone()))?;
        let mut compiler = Command::new("gcc");
        compiler
            .args(FLAGS)
            .arg("-o")
            .arg(&program)
            .arg(self.scripts.join("driver.c"))
            .arg(&source)
            .arg("-lm");
        succeeds(&mut compiler).map_err(failed)?;
        Ok(Some((program, derivation)))
    }

    /// Instructions per evaluation, what a tool wraps around its function included where gcc leaves it.
    fn count(&self, program: &Path, input: &Path) -> Result<Option<f64>, String> {
        if !callgrind::is_present() {
            return Ok(None);
        }
        let profile = self.results.join("peer.callgrind");
        let command = [program, input, Path::new("count")].map(Path::to_string_lossy);
        let command = command.each_ref().map(AsRef::as_ref);
        let counts = callgrind::count(&command, &profile, |name| name == "peer")?;
        Ok(counts.get("peer").copied())
    }
}

/// What the driver reads: sizes, parameters, then states with inputs.
fn text(data: &Data) -> String {
    let Some([state, input, ..]) = data.samples.first() else { return String::new() };
    let mut text =
        format!("{} {} {} {}\n", data.parameters.len(), state.len(), input.len(), data.samples.len());
    let states = data.samples.iter().flat_map(|[state, input, ..]| state.iter().chain(input));
    for number in data.parameters.iter().chain(states) {
        // the shortest decimals that read back as the same number
        let _ = writeln!(text, "{number:e}");
    }
    text
}

/// The output of a command.
fn succeeds(command: &mut Command) -> Result<String, String> {
    let output = command.output().map_err(|error| error.to_string())?;
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    if output.status.success() { Ok(text(&output.stdout)) } else { Err(text(&output.stderr)) }
}

/// The output of a command; `None` if it takes too long. What it says of its failure goes where ours would.
fn patiently(command: &mut Command) -> Result<Option<String>, String> {
    let mut child = command.stdout(Stdio::piped()).spawn().map_err(|error| error.to_string())?;
    let start = Instant::now();
    while child.try_wait().map_err(|error| error.to_string())?.is_none() {
        if start.elapsed() > PATIENCE {
            let _ = child.kill();
            let _ = child.wait();
            return Ok(None);
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    let output = child.wait_with_output().map_err(|error| error.to_string())?;
    let printed = String::from_utf8_lossy(&output.stdout).into_owned();
    if output.status.success() { Ok(Some(printed)) } else { Err(format!("ends with {}", output.status)) }
}
