//! A recording is read by the reader of the format, and says what the disk did.

use std::collections::BTreeMap;
use std::io::Cursor;

use foxglove::{Context, McapWriteOptions};
use nh_viewer::{Channels, Disk, DiskState, FRAME, disk, roll};
use nonholonomic::prelude::*;

const FRAMES: u32 = 90;

fn recording() -> Vec<u8> {
    let context = Context::new();
    let options = McapWriteOptions::new().compression(None);
    let writer = context.mcap_writer_with_options(options).create(Cursor::new(Vec::new())).expect("created");
    roll(&mut Channels::of::<Disk>(&context, 0).expect("channels"), FRAMES, |_| ()).expect("rolls");
    writer.close().expect("closed").into_inner()
}

#[test]
fn every_frame_is_there_with_its_time_and_its_schema() {
    let bytes = recording();
    let mut topics: BTreeMap<String, Vec<u64>> = BTreeMap::new();
    for message in mcap::MessageStream::new(&bytes).expect("a recording") {
        let message = message.expect("a message");
        let schema = message.channel.schema.as_ref().expect("a schema");
        let name = match message.channel.topic.as_str() {
            "/state" => "State",
            "/place" => "foxglove.FrameTransform",
            _ => "foxglove.SceneUpdate",
        };
        assert_eq!(schema.name, name);
        assert!(!schema.data.is_empty() && !message.data.is_empty());
        topics.entry(message.channel.topic.clone()).or_default().push(message.log_time);
    }
    assert_eq!(topics.keys().collect::<Vec<_>>(), ["/place", "/scene", "/state"]);
    for times in topics.values() {
        let expected: Vec<u64> =
            (0..FRAMES).map(|frame| (f64::from(frame) * FRAME * 1e9).round() as u64).collect();
        assert_eq!(*times, expected);
    }
}

#[test]
fn the_numbers_are_those_of_the_state() {
    let bytes = recording();
    let states: Vec<serde_json::Value> = mcap::MessageStream::new(&bytes)
        .expect("a recording")
        .map(|message| message.expect("a message"))
        .filter(|message| message.channel.topic == "/state")
        .map(|message| serde_json::from_slice(&message.data).expect("JSON"))
        .collect();
    let (disk, start) = disk();
    let mut sim = Integrator::new(disk, Dop853::new().rtol(1e-12).atol(1e-12), 0.0, start);
    sim.advance_to(FRAME * f64::from(FRAMES - 1)).expect("rolls");
    let last = states.last().expect("states");
    for (name, value) in DiskState::names().iter().zip(sim.state().to_array()) {
        let recorded = last[name].as_f64().expect("a number");
        assert!((recorded - value).abs() < 1e-6, "{name}: {recorded} {value}");
    }
    for state in &states {
        let energy = state["energy"].as_f64().expect("a number");
        assert!((energy - disk.energy(0.0, &start)).abs() < 1e-7, "{energy}");
    }
}
