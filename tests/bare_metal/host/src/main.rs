//! Prints the states that the images have to reach: `single` or `double`.
#![forbid(unsafe_code)]

use models::{STEPS, double, single};

fn main() {
    match std::env::args().nth(1).as_deref() {
        Some("single") => {
            println!("state sleigh {:08x?}", single::sleigh(STEPS).map(f32::to_bits));
            println!("state robot {:08x?}", single::robot(STEPS).map(f32::to_bits));
        }
        Some("double") => {
            println!("state sleigh {:016x?}", double::sleigh(STEPS).map(f64::to_bits));
            println!("state robot {:016x?}", double::robot(STEPS).map(f64::to_bits));
        }
        _ => {
            eprintln!("usage: host single|double");
            std::process::exit(1);
        }
    }
}
