//! The sleigh and the robot in single precision.
#![no_std]
#![no_main]
#![forbid(unsafe_code)]

use core::hint::black_box;

use cortex_m_rt::entry;
use cortex_m_semihosting::hprintln;
use image::{Counter, finish, stack_used};
use models::{STEPS, single};

#[entry]
fn main() -> ! {
    // the stack of the steps alone, before anything is printed
    let sleigh = single::sleigh(STEPS);
    let of_sleigh = stack_used();
    let robot = single::robot(STEPS);
    let of_robot = stack_used();
    let Some(mut counter) = Counter::start() else { finish(false) };
    let sleigh_step = counter.per_step(&mut |steps| {
        black_box(single::sleigh(steps));
    });
    let robot_step = counter.per_step(&mut |steps| {
        black_box(single::robot(steps));
    });
    hprintln!("state sleigh {:08x?}", sleigh.map(f32::to_bits));
    hprintln!("state robot {:08x?}", robot.map(f32::to_bits));
    hprintln!("stack sleigh {}", of_sleigh);
    hprintln!("stack robot {}", of_robot);
    hprintln!("instructions sleigh {} {}", sleigh_step.0, sleigh_step.1);
    hprintln!("instructions robot {} {}", robot_step.0, robot_step.1);
    finish(true)
}
