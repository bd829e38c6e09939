//! Events of functions that carry rounding: of floors that are not at zero, of places far away, of clocks that pass
//! zero. None is lost, none is told twice, and where they accumulate a run ends.

use core::ops::ControlFlow;

use nonholonomic::prelude::*;
use nonholonomic::{D, Method};

/// Two balls in a plane, that fall beside one another.
#[derive(Clone, Copy)]
struct Balls<T> {
    g: T,
}

/// x, y₁, y₂ and their rates.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Flight<T>([T; 6]);

impl<T: Real> State for Flight<T> {
    type Scalar = T;
    type Dim = D<6>;
    fn to_array(&self) -> [T; 6] {
        self.0
    }
    fn from_array(numbers: [T; 6]) -> Self {
        Self(numbers)
    }
    fn names() -> [&'static str; 6] {
        ["x", "y[1]", "y[2]", "x_dot", "y_dot[1]", "y_dot[2]"]
    }
}

impl<T: Real> Dynamics for Balls<T> {
    type State = Flight<T>;
    type Input = ();
    fn derivative(&self, _t: T, Flight([_, _, _, u, v, w]): &Flight<T>, (): &()) -> Flight<T> {
        Flight([*u, *v, *w, T::ZERO, -self.g, -self.g])
    }
}

/// Calls a law with methods of every kind.
macro_rules! methods {
    ($law:expr, $number:ty) => {{
        let h = <$number as Scalar>::from_f64(0.1);
        macro_rules! call {
            ($method:expr) => {
                $law(stringify!($method), $method)
            };
        }
        call!(Rk4::new(h));
        call!(ImplicitMidpoint::new(h));
        call!(GaussLegendre6::new(h));
        call!(Bs23::new());
        call!(Dopri5::new());
        call!(Dop853::new());
        call!(Vern9::new());
        call!(Radau5::new());
        call!(Rodas5P::new());
        call!(Auto::new());
    }};
}

/// Functions of x that vanish together at a level, none of which rounds as another does.
fn at_a_level<T: Real>(x: T, level: T) -> [T; 6] {
    let c = T::from_f64;
    [
        x - level,
        x * x - level * level,
        c(3.0) * x - c(3.0) * level,
        level * level * level - x * x * x,
        (x * c(0.5)).sin() - (level * c(0.5)).sin(),
        T::ONE / x - T::ONE / level,
    ]
}

/// A slow passage of a level: every function has one event, however the run is continued.
fn passes<T: Real>(name: &str, method: impl Method<Balls<T>> + Clone) {
    let c = T::from_f64;
    for (number, level) in [0.3, 1.5, 1.1, 0.7].into_iter().enumerate() {
        for (speed, clock) in [(0.0137, 0.0), (-1.3, 0.0), (0.9, 80.0), (0.31, -0.7)] {
            let (level, speed) = (c(level), c(speed));
            let from = level - speed * c(0.2);
            let start = Flight([from, T::ONE, T::ONE, speed, T::ZERO, T::ZERO]);
            let events = Events::new(|_, x: &Flight<T>, (): &()| at_a_level(x.0[0], level));
            let case = format!("{name}, level {level:?} at {speed:?}, {number}");
            let clock = c(clock);
            let begin = || Integrator::new(Balls { g: T::ZERO }, method.clone(), clock, start);
            let end = clock + c(0.4);
            let tells_all = |found: &[usize], how: &str| {
                let mut sorted = found.to_vec();
                sorted.sort_unstable();
                assert_eq!(sorted, [0, 1, 2, 3, 4, 5], "{case}, {how}: {found:?}");
            };
            let mut found = Vec::new();
            let mut sim = begin();
            while let Some(event) = sim.advance_until(end, &events).unwrap() {
                found.push(event.index);
            }
            tells_all(&found, "one after the other");
            found.clear();
            begin()
                .advance_watching(end, &events, |event| {
                    found.push(event.index);
                    ControlFlow::Continue(())
                })
                .unwrap();
            tells_all(&found, "without a stop");
            for reset in [false, true] {
                found.clear();
                begin()
                    .advance_acting(end, &events, |sim, now| {
                        found.extend(now.iter().map(|event| event.index));
                        if reset {
                            sim.set_state(now.state);
                        }
                        ControlFlow::Continue(())
                    })
                    .unwrap();
                tells_all(&found, "acting");
            }
        }
    }
}

#[test]
fn of_functions_that_vanish_together_none_is_lost() {
    methods!(passes::<f64>, f64);
    methods!(passes::<f32>, f32);
}

/// A ball over each of two floors, dropped from the same height; both are sent up at their impacts.
fn on_two_floors<T: Real>(name: &str, method: impl Method<Balls<T>> + Clone) {
    let c = T::from_f64;
    for floor in [10.0, 1000.0, -77.7] {
        let floor = c(floor);
        let start = Flight([T::ZERO, c(2.0), floor + c(2.0), T::ZERO, T::ZERO, T::ZERO]);
        for clock in [0.0, -(4.0_f64 / 9.81).sqrt()] {
            let mut sim = Integrator::new(Balls { g: c(9.81) }, method.clone(), c(clock), start);
            let floors = Events::new(|_, x: &Flight<T>, (): &()| [x.0[1], x.0[2] - floor])
                .directions([Direction::Falling; 2]);
            let mut impacts = [0; 2];
            let end = sim.advance_acting(c(clock + 4.0), &floors, |sim, now| {
                let mut next = now.state;
                for event in now.iter() {
                    impacts[event.index] += 1;
                    let speed = &mut next.0[4 + event.index];
                    *speed = -c(0.8) * *speed;
                }
                sim.set_state(next);
                ControlFlow::Continue(())
            });
            let case = format!("{name}, {floor:?}, {clock}");
            assert_eq!((end, impacts), (Ok(None), [5, 5]), "{case}: {:?}", sim.state());
            let Flight([_, low, high, ..]) = *sim.state();
            assert!(low >= T::ZERO && high >= floor, "{case}: {:?}", sim.state());
        }
    }
}

#[test]
fn two_balls_on_floors_of_different_heights_both_bounce() {
    methods!(on_two_floors::<f64>, f64);
    methods!(on_two_floors::<f32>, f32);
}

/// Where a ball bounces until it rests.
struct Ground {
    slope: f64,
    height: f64,
    /// When the impacts accumulate.
    over: f64,
    restitution: f64,
    /// Whether it is put onto the ground after an impact.
    exact: bool,
}

impl Ground {
    fn stops<T: Real>(&self, name: &str, method: impl Method<Balls<T>>) {
        let c = T::from_f64;
        let (slope, height, e) = (c(self.slope), c(self.height), c(self.restitution));
        let case = format!(
            "{name}, slope {}, height {}, over at {}, e = {}, {}",
            self.slope, self.height, self.over, self.restitution, self.exact
        );
        let all = (2.0_f64 / 9.81).sqrt() * (1.0 + 2.0 * self.restitution / (1.0 - self.restitution));
        let clock = c(self.over - all);
        let x = c(0.2);
        let start = Flight([x, slope * x + height + T::ONE, c(1e6), T::ZERO, T::ZERO, T::ZERO]);
        let mut sim = Integrator::new(Balls { g: c(9.81) }, method, clock, start).max_steps(100_000);
        let gap = |x: &Flight<T>| x.0[1] - slope * x.0[0] - height;
        let ground = Events::new(|_, x: &Flight<T>, (): &()| [gap(x)]).directions([Direction::Falling]);
        let mut impacts = 0;
        // steps of a free fall grow as far as there is to go, and with them what they round
        let end = sim.advance_acting(c(self.over + 3.0), &ground, |sim, now| {
            impacts += 1;
            let mut next = now.state;
            // the ball slides where the ground is steep: its speed against the ground is what changes
            next.0[4] = slope * next.0[3] - e * (next.0[4] - slope * next.0[3]);
            if self.exact {
                next.0[1] = slope * next.0[0] + height;
            }
            sim.set_state(next);
            ControlFlow::Continue(())
        });
        assert!(
            matches!(end, Err(IntegrationError::EventsAccumulate { event: 0, .. })),
            "{case}: {end:?} after {impacts}, {:?}",
            sim.state()
        );
        let off = (sim.time() - c(self.over)).to_f64().abs();
        // what the ground's rounding hides of the last flights
        let hidden = (2.0 * T::EPSILON.to_f64() * (1.0 + self.height.abs()) / 9.81).sqrt();
        let most = 60.0 * hidden / (1.0 - self.restitution)
            + 20.0 * T::DEFAULT_TOLERANCE.to_f64() * (1.0 + self.over.abs()) / (1.0 - self.restitution);
        assert!(off <= most, "{case}: {off:e} {most:e} after {impacts}");
        assert!(
            gap(sim.state()).to_f64().abs() < 1e-4 * (1.0 + self.height.abs()),
            "{case}: {:?}",
            sim.state()
        );
    }
}

fn rests<T: Real>(name: &str, method: impl Method<Balls<T>> + Clone) {
    for (slope, height) in [(0.0, 0.0), (0.0, 10.0), (0.0, 1000.0), (-0.5, 0.3), (0.7, -25.0)] {
        for over in [1.5, 0.0, 100.0] {
            for restitution in [0.02, 0.3, 0.5, 0.9] {
                for exact in [false, true] {
                    Ground { slope, height, over, restitution, exact }.stops(name, method.clone());
                }
            }
        }
    }
}

#[test]
fn impacts_accumulate_on_any_ground_and_at_any_time() {
    methods!(rests::<f64>, f64);
    methods!(rests::<f32>, f32);
    for restitution in [0.97, 0.985] {
        let hill = Ground { slope: -0.5, height: 100.0, over: 3.0, restitution, exact: false };
        hill.stops("Dopri5", Dopri5::<f64>::new());
    }
}

/// What reaches zero and stays there has one event, and one when it leaves.
fn stays<T: Real>(name: &str, method: impl Method<Balls<T>> + Clone) {
    let c = T::from_f64;
    let start = Flight([T::ZERO, T::ZERO, T::ZERO, T::ONE, T::ZERO, T::ZERO]);
    let larger = |a: T, b: T| if a > b { a } else { b };
    // zero from 0.45 on; zero from 0.45 to 1.15, and on the other side after; zero until 0.75
    let functions = |_: T, x: &Flight<T>, (): &()| {
        let x = x.0[0];
        let until = larger(c(0.45) - x, T::ZERO);
        [
            until,
            until - larger(x - c(1.15), T::ZERO),
            larger(x - c(0.75), T::ZERO),
            until + larger(x - c(1.15), T::ZERO),
        ]
    };
    let expected = [(0, 0.45), (1, 0.45), (3, 0.45), (3, 1.15)];
    for samples in [3, 8] {
        let events = Events::new(functions).samples(samples);
        let begin = || Integrator::new(Balls { g: T::ZERO }, method.clone(), T::ZERO, start);
        let (mut stopping, mut passing) = (Vec::new(), Vec::new());
        let mut sim = begin();
        while let Some(event) = sim.advance_until(c(2.0), &events).unwrap() {
            stopping.push((event.index, event.time));
        }
        begin()
            .advance_watching(c(2.0), &events, |event| {
                passing.push((event.index, event.time));
                ControlFlow::Continue(())
            })
            .unwrap();
        for found in [stopping, passing] {
            assert_eq!(found.len(), expected.len(), "{name}, {samples}: {found:?}");
            for ((index, time), (other, expected)) in found.iter().zip(expected) {
                let off = (*time - c(expected)).to_f64().abs();
                assert!(
                    *index == other && off <= 1000.0 * T::EPSILON.to_f64(),
                    "{name}, {samples}: {found:?}"
                );
            }
        }
    }
}

#[test]
fn what_reaches_zero_and_stays_has_one_event() {
    methods!(stays::<f64>, f64);
    methods!(stays::<f32>, f32);
}

/// Times are shifted without a trace: the events of a clock that passes zero are those of one that does not.
#[test]
fn a_clock_that_passes_zero_changes_nothing() {
    for clock in [0.0, -0.5, -1.0, -1.25, 3.0] {
        let start = Flight([0.0, 1.0, 1.0, 1.0, 0.0, 0.0]);
        // touches zero at 1, passes it at 0.5, 1.25 and 1.5, and watches the clock itself
        let events = Events::new(|t, x: &Flight<f64>, (): &()| {
            let x = x.0[0];
            [(x - 0.5) * (x - 1.5), t - clock - 1.25, x - 1.25, (x - 1.0) * (x - 1.0) * (x - 0.5)]
        });
        for given in [false, true] {
            let mut sim = Integrator::new(Balls { g: 0.0 }, Rk4::new(0.3), clock, start);
            let mut found = Vec::new();
            let end = sim.advance_acting(clock + 2.0, &events, |sim, now| {
                found.extend(now.iter().map(|event| (event.index, event.time - clock)));
                if given {
                    sim.set_state(now.state);
                }
                ControlFlow::Continue(())
            });
            assert_eq!(end, Ok(None));
            let at = |index| {
                found.iter().filter(|event| event.0 == index).map(|event| event.1).collect::<Vec<_>>()
            };
            for (index, expected) in [(0, vec![0.5, 1.5]), (1, vec![1.25]), (2, vec![1.25])] {
                let times = at(index);
                let near = times.iter().zip(&expected).all(|(a, b)| (a - b).abs() < 1e-14);
                assert!(times.len() == expected.len() && near, "{clock}, {given}, {index}: {found:?}");
            }
        }
    }
}
