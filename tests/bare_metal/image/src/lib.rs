//! What both images share: the count of instructions and of stack, and the exit.
#![no_std]

use cortex_m::peripheral::syst::SystClkSource;
use cortex_m::peripheral::{Peripherals, SYST};
use cortex_m_semihosting::debug;

/// Ticks of the 25 MHz timer; under `-icount shift=0` an instruction takes a nanosecond.
const INSTRUCTIONS_PER_TICK: u32 = 40;
const LONGEST: u32 = 0x00ff_ffff;

/// The timer, counting instructions.
pub struct Counter(SYST);

impl Counter {
    /// Starts the timer.
    pub fn start() -> Option<Self> {
        let mut timer = Peripherals::take()?.SYST;
        timer.set_clock_source(SystClkSource::Core);
        timer.set_reload(LONGEST);
        timer.clear_current();
        timer.enable_counter();
        Some(Self(timer))
    }

    fn ticks(&mut self, work: &mut dyn FnMut(u32), steps: u32) -> u32 {
        self.0.clear_current();
        let before = SYST::get_current();
        work(steps);
        before.wrapping_sub(SYST::get_current()) & LONGEST
    }

    /// The least and the most instructions per step, over ten hundreds of steps from different states: the
    /// differences of runs that are longer and longer.
    pub fn per_step(&mut self, work: &mut dyn FnMut(u32)) -> (u32, u32) {
        let (mut least, mut most) = (u32::MAX, 0);
        let mut before = self.ticks(work, 100);
        for hundreds in 2..=11 {
            let now = self.ticks(work, 100 * hundreds);
            let instructions = now.wrapping_sub(before).wrapping_mul(INSTRUCTIONS_PER_TICK) / 100;
            (least, most) = (least.min(instructions), most.max(instructions));
            before = now;
        }
        (least, most)
    }
}

/// How many bytes of the stack have been used since the start: those that are no longer painted.
#[allow(unsafe_code)]
pub fn stack_used() -> usize {
    unsafe extern "C" {
        static __euninit: u32;
        static _stack_start: u32;
    }
    let (end, start) = (&raw const __euninit, &raw const _stack_start);
    let mut lowest = end;
    // SAFETY: the words between the end of the data and the start of the stack are memory of this
    // program, aligned, and painted at start-up; they are only read, as volatile.
    while lowest < start && unsafe { lowest.read_volatile() } == cortex_m_rt::STACK_PAINT_VALUE {
        lowest = lowest.wrapping_add(1);
    }
    start as usize - lowest as usize
}

/// Ends the emulator.
pub fn finish(success: bool) -> ! {
    debug::exit(if success { debug::EXIT_SUCCESS } else { debug::EXIT_FAILURE });
    loop {}
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    finish(false)
}
