//! A slider crank: dead centres at both ends of the stroke.

use nonholonomic::prelude::*;

macro_rules! slider_crank {
    ($(#[$doc:meta])* $name:ident: $($more:tt)*) => {
        $(#[$doc])*
        #[nonholonomic(
            base { crank, rod, slide }
            holonomic {
                along: slide = r * cos(crank) + l * cos(rod);
                across: r * sin(crank) = l * sin(rod);
            }
            lagrangian {
                J / 2 * der(crank)^2 + m / 2 * der(slide)^2
                + M / 2 * (r^2 * der(crank)^2 + l^2 / 3 * der(rod)^2 - r * l * cos(crank + rod) * der(crank) * der(rod))
            }
            $($more)*
        )]
        #[derive(Clone, Copy, Debug)]
        struct $name { r: f64, l: f64, J: f64, m: f64, M: f64 }

        impl $name {
            const MODEL: Self = Self { r: 0.3, l: 0.8, J: 0.05, m: 0.4, M: 0.2 };
        }
    };
}

slider_crank!(
    /// All velocities, with multipliers.
    SliderCrank:
);
slider_crank!(
    /// The crank's velocity, which determines the others everywhere.
    ByTheCrank: independent { der(crank) }
);

#[test]
fn dead_centres_are_passed() {
    let guess = SliderCrankState { crank: 0.3, crank_dot: 30.0, slide: 1.0, ..SliderCrankState::default() };
    let start = SliderCrank::MODEL.assemble_holding(0.0, &guess, &[SliderCrankCoordinate::crank]).unwrap();
    let energy = SliderCrank::MODEL.energy(0.0, &start);
    let method = Dopri5::new().rtol(1e-9).atol(1e-9);
    let mut sim = Integrator::new(SliderCrank::MODEL, method, 0.0, start);
    let SliderCrankState { crank, rod, slide, crank_dot, .. } = start;
    let mut one =
        Integrator::new(ByTheCrank::MODEL, method, 0.0, ByTheCrankState { crank, rod, slide, crank_dot });
    let mut turns: f64 = 0.0;
    for tenth in 1..=100 {
        let time = f64::from(tenth) / 10.0;
        sim.advance_to(time).unwrap();
        one.advance_to(time).unwrap();
        let (state, alone) = (sim.state(), one.state());
        turns = turns.max(state.crank / core::f64::consts::TAU);
        assert!((state.crank - alone.crank).abs() < 1e-5 && (state.slide - alone.slide).abs() < 1e-5);
        let left: [f64; 4] = SliderCrank::MODEL.constraint_residual(time, state).into();
        assert!(left.iter().all(|left| left.abs() < 1e-13), "{left:?}");
    }
    assert!(turns > 40.0, "{turns}");
    assert!((SliderCrank::MODEL.energy(10.0, sim.state()) / energy - 1.0).abs() < 1e-7);
}

slider_crank!(
    /// The slide's velocity, which does not determine the crank's at the dead centres.
    BySlide: independent { der(slide) }
);

#[test]
fn a_dead_centre_ends_a_run_by_the_slide() {
    assert!(BySlide::REPORT.contains("they break down where"), "{}", BySlide::REPORT);
    let guess = BySlideState { crank: 0.9, rod: 0.3, slide: 0.9, slide_dot: -2.0 };
    let start = BySlide::MODEL.assemble_holding(0.0, &guess, &[BySlideCoordinate::crank]).unwrap();
    // fixed steps go past it, and adaptive ones come as near as they can
    let mut fixed = Integrator::new(BySlide::MODEL, Rk4::new(0.01), 0.0, start);
    let error = fixed.advance_to(2.0).unwrap_err();
    let text = error.to_string();
    assert!(matches!(error, IntegrationError::DeadCentre { .. }), "{error:?}");
    assert!(
        text.contains("past a configuration where the velocities that `independent` names do not"),
        "{text}"
    );
    assert!(fixed.time() > 0.05 && fixed.state().crank < core::f64::consts::PI, "{:?}", fixed.state());
    let method = Dopri5::new().rtol(1e-6).atol(1e-6);
    let mut adaptive = Integrator::new(BySlide::MODEL, method, 0.0, start);
    let error = adaptive.advance_to(2.0).unwrap_err();
    assert!((adaptive.time() - fixed.time()).abs() < 0.02, "{error:?} {}", adaptive.time());
}

#[test]
fn the_stroke_is_assembled_by_its_slide() {
    use SliderCrankCoordinate::slide;
    let guess =
        |crank: f64| SliderCrankState { crank, rod: crank / 3.0, slide: 0.9, ..SliderCrankState::default() };
    // one position of the slide, and two of the crank
    let [above, below] =
        [0.9, -0.9].map(|crank| SliderCrank::MODEL.assemble_holding(0.0, &guess(crank), &[slide]).unwrap());
    assert!((above.crank + below.crank).abs() < 1e-15 && above.crank > 0.5, "{above:?} {below:?}");
    // beyond the end of the stroke
    let beyond = SliderCrankState { slide: 1.11, ..guess(0.5) };
    let error = SliderCrank::MODEL.assemble_holding(0.0, &beyond, &[slide]).unwrap_err();
    assert!(error.to_string().contains("no positions were found: `a"), "{error}");
}
