//! `cargo run --release` records twenty seconds of the disk as `target/rolling_disk.mcap`;
//! `cargo run --release --features live` shows them to viewers that connect to `ws://127.0.0.1:8765`.

use std::error::Error;

use foxglove::Context;
use nh_viewer::{Channels, Disk, roll};

/// Twenty seconds.
const FRAMES: u32 = 600;

#[cfg(not(feature = "live"))]
fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args_os().nth(1).unwrap_or_else(|| "target/rolling_disk.mcap".into());
    let path = std::path::PathBuf::from(path);
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder)?;
    }
    let file = std::io::BufWriter::new(std::fs::File::create(&path)?);
    let context = Context::new();
    // uncompressed: what compresses is C, which would have to be compiled
    let options = foxglove::McapWriteOptions::new().compression(None);
    let recording = context.mcap_writer_with_options(options).create(file)?;
    roll(&mut Channels::of::<Disk>(&context, 0)?, FRAMES, |_| ())?;
    recording.close()?;
    println!("recording: {}", path.display());
    Ok(())
}

#[cfg(feature = "live")]
fn main() -> Result<(), Box<dyn Error>> {
    use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

    let context = Context::new();
    let server = context.websocket_server().name("rolling disk").bind("127.0.0.1", 8765).start_blocking()?;
    println!("a viewer may connect to ws://127.0.0.1:{}", server.port());
    let begin = u64::try_from(SystemTime::now().duration_since(UNIX_EPOCH)?.as_nanos())?;
    let started = Instant::now();
    roll(&mut Channels::of::<Disk>(&context, begin)?, FRAMES, |t| {
        std::thread::sleep(Duration::from_secs_f64(t).saturating_sub(started.elapsed()));
    })?;
    // viewers are told that it is over
    server.stop().wait_blocking();
    Ok(())
}
