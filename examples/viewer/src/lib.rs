//! A disk that rolls on a floor, for a viewer: its state as numbers to plot, its place and attitude, its shape.
//!
//! [`Channels::of`] takes any declared machine: the names of its state become the names of the curves. The scene is
//! that of the disk.

use std::sync::Arc;

use foxglove::messages::{
    Color, CubePrimitive, CylinderPrimitive, FrameTransform, LinePrimitive, Point3, Pose, Quaternion,
    SceneEntity, SceneUpdate, Timestamp, Vector3,
};
use foxglove::{Channel, Context, FoxgloveError, PartialMetadata, RawChannel, Schema};
use nalgebra::{Matrix3, Rotation3, UnitQuaternion};
use nonholonomic::prelude::*;

/// A disk that rolls on a floor without slipping, declared by where it is.
#[nonholonomic(
    base { x, y, yaw, lean, spin }
    let R = rot_z(yaw) * rot_x(lean) * rot_y(spin);
    let centre = [x, y, r * cos(lean)];
    // below the centre in the plane of the disk
    let contact = centre - r * (rot_z(yaw) * rot_x(lean) * [0, 0, 1]);
    lagrangian  { kinetic(m, [m * r^2 / 4, m * r^2 / 2, m * r^2 / 4], centre, R) - m * g * centre[2] }
    constraints { rolling: velocity_at(centre, R, contact)[0..2] = 0; }
    outputs     { place = centre; touch = contact; attitude = R; }
    assume      { m > 0; r > 0; }
    units       { x, y, r = m; yaw, lean, spin = rad; m = kg; g = m/s^2; }
)]
#[derive(Clone, Copy, Debug)]
pub struct Disk {
    /// Mass (kg).
    pub m: f64,
    /// Radius (m).
    pub r: f64,
    /// Gravity (m/s²).
    pub g: f64,
}

/// The disk of the recording, and how it sets out: rolling in a circle that turns.
#[must_use]
pub fn disk() -> (Disk, DiskState) {
    let start = DiskState { lean: 0.35, yaw_dot: 1.2, spin_dot: 4.0, ..DiskState::default() };
    (Disk { m: 1.0, r: 0.25, g: 9.81 }, start)
}

/// What a viewer is sent: a channel for the numbers of a state, one for the place of the body, one for shapes.
pub struct Channels {
    state: Arc<RawChannel>,
    place: Channel<FrameTransform>,
    scene: Channel<SceneUpdate>,
    /// When the run began, in nanoseconds since 1970.
    begin: u64,
    trail: Vec<Point3>,
}

impl Channels {
    /// Channels for a machine, with the names of its state.
    ///
    /// # Errors
    /// If a channel cannot be made.
    pub fn of<S: Dynamics>(context: &Arc<Context>, begin: u64) -> Result<Self, FoxgloveError> {
        let names = S::State::names();
        let fields: Vec<String> = ["energy"]
            .iter()
            .chain(names.as_ref())
            .map(|name| format!(r#""{name}":{{"type":"number"}}"#))
            .collect();
        let schema = format!(r#"{{"type":"object","properties":{{{}}}}}"#, fields.join(","));
        let state = context
            .channel_builder("/state")
            .message_encoding("json")
            .schema(Schema::new("State", "jsonschema", schema.into_bytes()))
            .build_raw()?;
        let place = context.channel_builder("/place").build();
        let scene = context.channel_builder("/scene").build();
        Ok(Self { state, place, scene, begin, trail: Vec::new() })
    }

    /// Sends the numbers of a state, by their names.
    pub fn state<S: State<Scalar = f64>>(&self, t: f64, state: &S, energy: f64) {
        let (names, values) = (S::names(), state.to_array());
        let numbers = names.as_ref().iter().zip(values.as_ref());
        let mut text = format!(r#"{{"energy":{energy:?}"#);
        for (name, value) in numbers {
            text.push_str(&format!(r#","{name}":{value:?}"#));
        }
        text.push('}');
        self.state.log_with_meta(text.as_bytes(), self.at(t));
    }

    /// Sends where the disk is, and its shape with the trail of its contact.
    pub fn disk(&mut self, t: f64, disk: &Disk, state: &DiskState) {
        let out = disk.outputs(t, state, &());
        let attitude = Matrix3::from_fn(|row, column| out.attitude[row][column]);
        let turned = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(attitude));
        let [x, y, z] = out.place;
        self.place.log_with_meta(
            &FrameTransform {
                timestamp: Some(self.stamp(t)),
                parent_frame_id: "floor".to_owned(),
                child_frame_id: "disk".to_owned(),
                translation: Some(Vector3 { x, y, z }),
                rotation: Some(Quaternion { x: turned.i, y: turned.j, z: turned.k, w: turned.w }),
            },
            self.at(t),
        );
        let [x, y, z] = out.touch;
        self.trail.push(Point3 { x, y, z });
        self.scene.log_with_meta(
            &SceneUpdate { deletions: Vec::new(), entities: self.shapes(t, disk) },
            self.at(t),
        );
    }

    /// The disk in its own frame, and the trail on the floor.
    fn shapes(&self, t: f64, disk: &Disk) -> Vec<SceneEntity> {
        let colour = |r, g, b| Some(Color { r, g, b, a: 1.0 });
        let side = 2.0 * disk.r;
        // the axis of a cylinder is z, that of the disk y
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let upright = Pose {
            position: Some(Vector3 { x: 0.0, y: 0.0, z: 0.0 }),
            orientation: Some(Quaternion { x: half, y: 0.0, z: 0.0, w: half }),
        };
        let body = SceneEntity {
            timestamp: Some(self.stamp(t)),
            frame_id: "disk".to_owned(),
            id: "disk".to_owned(),
            frame_locked: true,
            cylinders: vec![CylinderPrimitive {
                pose: Some(upright),
                size: Some(Vector3 { x: side, y: side, z: 0.02 }),
                bottom_scale: 1.0,
                top_scale: 1.0,
                color: colour(0.36, 0.48, 0.69),
            }],
            // a spoke, so that one sees it turn
            cubes: vec![CubePrimitive {
                pose: Some(upright),
                size: Some(Vector3 { x: side, y: 0.02, z: 0.024 }),
                color: colour(0.91, 0.38, 0.24),
            }],
            ..SceneEntity::default()
        };
        let trail = SceneEntity {
            timestamp: Some(self.stamp(t)),
            frame_id: "floor".to_owned(),
            id: "trail".to_owned(),
            lines: vec![LinePrimitive {
                thickness: 2.0,
                scale_invariant: true,
                points: self.trail.clone(),
                color: colour(0.13, 0.15, 0.18),
                ..LinePrimitive::default()
            }],
            ..SceneEntity::default()
        };
        vec![body, trail]
    }

    /// A time of the run, as the viewer counts: nanoseconds since 1970.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // times of a run, from zero on
    fn nanoseconds(&self, t: f64) -> u64 {
        self.begin + (t * 1e9).round() as u64
    }

    fn at(&self, t: f64) -> PartialMetadata {
        PartialMetadata::with_log_time(self.nanoseconds(t))
    }

    fn stamp(&self, t: f64) -> Timestamp {
        let nanoseconds = self.nanoseconds(t);
        let second = 1_000_000_000;
        let part = |number: u64| u32::try_from(number).unwrap_or(u32::MAX);
        Timestamp::new(part(nanoseconds / second), part(nanoseconds % second))
    }
}

/// The time between two pictures (s).
pub const FRAME: f64 = 1.0 / 30.0;

/// Rolls the disk for `frames` pictures, and sends each; `wait` is called before it, with its time.
///
/// # Errors
/// If the integration fails.
pub fn roll(channels: &mut Channels, frames: u32, mut wait: impl FnMut(f64)) -> Result<(), IntegrationError> {
    let (disk, start) = disk();
    let mut sim = Integrator::new(disk, Dopri5::new().rtol(1e-9).atol(1e-9), 0.0, start);
    for frame in 0..frames {
        let t = FRAME * f64::from(frame);
        wait(t);
        sim.advance_to(t)?;
        channels.state(t, sim.state(), disk.energy(t, sim.state()));
        channels.disk(t, &disk, sim.state());
    }
    Ok(())
}
