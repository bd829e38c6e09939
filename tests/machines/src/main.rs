//! Random machines against the reference: how many lose digits, which, and at which level.
//!
//! `LEVEL=balanced` looks at one level, `MEMBERS=17,42` at some machines; the word `closed` behind the numbers stands for
//! machines with constraints on positions.

use nh_machines::{Emitted, LEVELS, Machine, Place, Random, Scale, losses};

/// Components that are off by more than this are looked at.
const SUSPICIOUS: f64 = 1e-11;
/// Places at which each machine is looked at, at each scale.
const PLACES: usize = 2;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |index: usize| arguments.get(index).and_then(|text| text.parse::<u64>().ok());
    let seed = number(1).unwrap_or(1);
    let is_closed = arguments.iter().any(|word| word == "closed");
    let machine = if is_closed { Machine::closed } else { Machine::of };
    if arguments.first().is_some_and(|word| word == "show") {
        let machine = machine(number(2).unwrap_or(1), seed);
        println!("{}\n{}", machine.item(), machine.sections);
        look(&machine, true);
        return;
    }
    let count = number(0).unwrap_or(200);
    let mut total = Total::default();
    let members: Vec<u64> = match std::env::var("MEMBERS") {
        Ok(list) => list.split(',').filter_map(|m| m.parse().ok()).collect(),
        Err(_) => (0..count).collect(),
    };
    for member in members {
        total.add(look(&machine(seed, member), false));
    }
    println!("{} machines, {} refused", total.machines, total.refused);
    println!("off by more than 1e-3 (rows: levels; columns: ordinary a, λ; apart a, λ): {:?}", total.off);
    println!("losing more than 65536 units: {:?}", total.losing);
}

#[derive(Default)]
struct Total {
    machines: usize,
    refused: usize,
    off: [[usize; 4]; 3],
    losing: [[usize; 4]; 3],
}

impl Total {
    fn add(&mut self, found: Option<[[(f64, f64); 4]; 3]>) {
        let Some(found) = found else {
            self.refused += 1;
            return;
        };
        self.machines += 1;
        let counts = self.off.iter_mut().flatten().zip(self.losing.iter_mut().flatten());
        for ((off, losing), (error, units)) in counts.zip(found.into_iter().flatten()) {
            *off += usize::from(error > 1e-3 && units > 1e3);
            *losing += usize::from(units > 65536.0);
        }
    }
}

/// The error and the units of the worst acceleration and multiplier, at ordinary and extreme parameters.
fn look(machine: &Machine, is_shown: bool) -> Option<[[(f64, f64); 4]; 3]> {
    let mut found = [[(0.0_f64, 0.0_f64); 4]; 3];
    for (level, found) in LEVELS.iter().zip(&mut found) {
        if std::env::var("LEVEL").is_ok_and(|l| l != *level) {
            continue;
        }
        let emitted = match Emitted::of(machine, level) {
            Ok(emitted) => emitted,
            Err(errors) => {
                if is_shown {
                    println!("{errors:?}");
                }
                return None;
            }
        };
        for (at, scale) in [Scale::Ordinary, Scale::Apart(4.0)].into_iter().enumerate() {
            let mut random = Random::of(machine.member, 77);
            for _ in 0..PLACES {
                let place = Place::draw(&emitted.model, scale, &mut random);
                if !place.is_closed(&emitted.model) {
                    continue;
                }
                let Some(losses) = losses(&emitted, &place, SUSPICIOUS) else { continue };
                for (kind, worst) in losses.into_iter().enumerate() {
                    let Some(worst) = worst else { continue };
                    let units = worst.loss.units();
                    if units.is_finite() || worst.loss.error.is_infinite() {
                        let slot = &mut found[2 * at + kind];
                        if units > slot.1 || units.is_nan() {
                            *slot = (worst.loss.error, units);
                        }
                    }
                    if is_shown || units > 65536.0 {
                        let formulation = if emitted.is_projected() { "projected" } else { "adapted" };
                        println!(
                            "{} {} {level} {formulation} {scale:?} {} {}: off {:.1e}, explained {:.1e}, units {:.1e}",
                            machine.member,
                            machine.family,
                            ["acceleration", "multiplier"][kind],
                            worst.component,
                            worst.loss.error,
                            worst.loss.explained,
                            units
                        );
                    }
                }
            }
        }
    }
    Some(found)
}
