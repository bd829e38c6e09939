//! The machines by name, in the order of the gallery.

use crate::live::{Live, Machine};

mod balancing;
mod bicycle;
mod chaplygin_sphere;
mod disk;
mod four_bar;
mod rattleback;
mod robot;
mod roller_racer;
mod skate;
mod sleigh;
mod snakeboard;
mod trailers;
mod turntable;
mod veselova;

macro_rules! gallery {
    ($($name:literal => $model:ty),* $(,)?) => {
        /// The names of all machines.
        pub const NAMES: &[&str] = &[$($name),*];

        /// The machine of a name, at its start.
        #[must_use]
        pub fn machine(name: &str) -> Option<Box<dyn Machine>> {
            match name {
                $($name => Some(Box::new(Live::<$model>::new())),)*
                _ => None,
            }
        }
    };
}

gallery! {
    "sleigh" => sleigh::Sleigh,
    "skate" => skate::Skate,
    "robot" => robot::Robot,
    "snakeboard" => snakeboard::Snakeboard,
    "roller_racer" => roller_racer::RollerRacer,
    "trailers" => trailers::Trailers,
    "bicycle" => bicycle::Bicycle<f64>,
    "balancing" => balancing::Balancing,
    "disk" => disk::Disk,
    "rattleback" => rattleback::Rattleback,
    "chaplygin_sphere" => chaplygin_sphere::ChaplyginSphere,
    "turntable" => turntable::Turntable,
    "veselova" => veselova::Veselova,
    "four_bar" => four_bar::FourBar,
}
