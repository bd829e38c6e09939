//! A mobile robot as a Python class. Its equations are derived and proved when this package is built.

use nonholonomic::prelude::*;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// A body on two driven coaxial wheels that roll without slipping, its centre of mass ahead of the axle.
#[nonholonomic(
    base { x, y, theta }
    basis { v, side, omega }
    anchor {
        der(x) = v * cos(theta) - side * sin(theta);
        der(y) = v * sin(theta) + side * cos(theta);
        der(theta) = omega;
    }
    lagrangian { m / 2 * (v^2 + (side + l * omega)^2) + J / 2 * omega^2 }
    constraints { no_skidding: side = 0; }
    forces { v: (torque_right + torque_left) / r; omega: c / r * (torque_right - torque_left); }
    inputs { torque_right, torque_left }
    assume { m > 0; J > 0; r > 0; c > 0; }
    units { x, y, l, c, r = m; theta = rad; m = kg; J = kg m^2; torque_right, torque_left = N m; }
    emit { jacobian }
)]
#[derive(Clone, Copy, Debug)]
struct Model {
    m: f64,
    J: f64,
    l: f64,
    c: f64,
    r: f64,
}

/// A state as Python sees it: x, y, theta, v, omega.
type Numbers = [f64; 5];

/// The word of Python for what a model or a run has to say.
fn refused(error: impl std::fmt::Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}

fn input([torque_right, torque_left]: [f64; 2]) -> ModelInput {
    ModelInput { torque_right, torque_left }
}

/// The state at the end of steps of `tick` seconds, each with torques of its own, and after each of them.
fn rolled_out(model: Model, start: Numbers, torques: &[[f64; 2]], tick: f64) -> Vec<Numbers> {
    let mut state = ModelState::from_array(start);
    let follow = |torques: &[f64; 2]| {
        state = Rk4::step(&model, 0.0, tick, &state, &input(*torques));
        state.to_array()
    };
    torques.iter().map(follow).collect()
}

/// A robot with mass m (kg), moment of inertia J (kg m²), its centre of mass l ahead of the axle (m), wheels of radius
/// r (m) at a distance of c on either side (m).
#[pyclass(frozen)]
struct Robot(Model);

#[pymethods]
impl Robot {
    /// Refuses parameters with which the equations have no solution.
    #[new]
    #[pyo3(signature = (*, m=10.0, J=0.6, l=0.1, c=0.2, r=0.05))]
    #[allow(non_snake_case)] // the name that mechanics gives it
    fn new(m: f64, J: f64, l: f64, c: f64, r: f64) -> PyResult<Self> {
        let model = Model { m, J, l, c, r };
        model.validate().map_err(refused)?;
        Ok(Self(model))
    }

    /// The names of the numbers of a state.
    #[staticmethod]
    fn state_names() -> [&'static str; 5] {
        ModelState::names()
    }

    /// The rates of a state under two torques (N m).
    fn derivative(&self, state: Numbers, torques: [f64; 2]) -> Numbers {
        self.0.derivative(0.0, &ModelState::from_array(state), &input(torques)).to_array()
    }

    /// The energy (J).
    fn energy(&self, state: Numbers) -> f64 {
        self.0.energy(0.0, &ModelState::from_array(state))
    }

    /// The derivatives of the rates by the state: a row for each rate.
    fn state_jacobian(&self, state: Numbers, torques: [f64; 2]) -> [Numbers; 5] {
        self.0.state_jacobian(0.0, &ModelState::from_array(state), &input(torques))
    }

    /// The state after `seconds` under constant torques, to the tolerance.
    #[pyo3(signature = (state, torques, seconds, rtol=1e-9))]
    fn advance(&self, state: Numbers, torques: [f64; 2], seconds: f64, rtol: f64) -> PyResult<Numbers> {
        let method = Dopri5::new().rtol(rtol).atol(rtol);
        let start = ModelState::from_array(state);
        let mut sim = Integrator::new(self.0, method, 0.0, start);
        sim.set_input(input(torques));
        sim.advance_to(seconds).map_err(refused)?;
        Ok(sim.state().to_array())
    }

    /// The states after each of the steps of `tick` seconds, for each sequence of torques. Other threads of Python run
    /// meanwhile.
    fn rollouts(
        &self,
        py: Python<'_>,
        start: Numbers,
        sequences: Vec<Vec<[f64; 2]>>,
        tick: f64,
    ) -> Vec<Vec<Numbers>> {
        let model = self.0;
        py.detach(|| sequences.iter().map(|torques| rolled_out(model, start, torques, tick)).collect())
    }
}

/// A mobile robot whose equations were derived when this package was built.
#[pymodule]
fn nh_robot(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Robot>()?;
    module.add("REPORT", Model::REPORT)
}
