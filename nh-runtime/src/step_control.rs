//! The choice of the step's length from an error estimate
//! (Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, sections II.4 and IV.2).

use crate::{IntegrationError, Real};

/// How an adaptive method chooses the length of its next step from the errors ε, ε′, ε″ of the last three,
/// newest first, in units of the tolerance:
///
/// h ← h · safety · (ε/aim)^(−β₁/q) ε′^(−β₂/q) ε″^(−β₃/q), within h · least … h · most,
///
/// where q is one more than the order of the estimate. After a rejected step it is
/// h ← h · safety · (ε/aim)^(−1/q), at most 0.9 h. Powers are taken of ratios alone, so that the choice is the
/// same in all units, mathematics (29).
///
/// The default is the PI control of Gustafsson as in the code DOPRI5, `β₁/q = 1/q − 0.03`,
/// `β₂/q = −0.04`, with the safety factor 0.9 and the factors 0.2 … 10 (Hairer, Nørsett, Wanner, Solving
/// Ordinary Differential Equations I, II.4; II, IV.2). [`Radau5`](crate::Radau5) has
/// [predictive control](Self::predictive) if it is given none.
///
/// ```
/// use nonholonomic::{Controller, Dopri5};
///
/// // step lengths that change smoothly: Söderlind's H211PI, aimed at 0.4 of the tolerance
/// let control = Controller::filter([1.0 / 6.0, 1.0 / 6.0, 0.0]).aim(0.4).factors(0.5, 2.0);
/// let method: Dopri5<f64> = Dopri5::new().rtol(1e-8).controller(control);
/// # let _ = method;
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Controller<T> {
    law: Law<T>,
    safety: T,
    aim: T,
    /// Its logarithm.
    log_aim: T,
    least: T,
    most: T,
}

/// The exponents.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Law<T> {
    /// 1/q − 3β/4 and β.
    Gustafsson(T),
    /// Multiples of 1/q.
    Filter([T; 3]),
    /// The shorter one of what the error and its trend propose.
    Predictive,
}

/// What control remembers of the steps before.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Past<T> {
    /// The logarithms of the errors of the last two, newest first.
    errors: [T; 2],
    /// The length of the last one.
    length: Option<T>,
}

/// The share of its length that a rejected step keeps at most.
const AFTER_REJECTION: f64 = 0.9;
/// A preceding error is taken to be at least 10⁻⁴, whose logarithm this is.
const LEAST_LOG_ERROR: f64 = -9.210_340_371_976_182;
/// A trend begins at an error of 10⁻² at least, whose logarithm this is.
const LEAST_LOG_ERROR_OF_TREND: f64 = -4.605_170_185_988_091;

impl<T: Real> Default for Controller<T> {
    fn default() -> Self {
        Self::gustafsson(T::from_f64(0.04))
    }
}

impl<T: Real> Controller<T> {
    fn new(law: Law<T>) -> Self {
        let [safety, least, most] = [0.9, 0.2, 10.0].map(T::from_f64);
        Self { law, safety, aim: T::ONE, log_aim: T::ZERO, least, most }
    }

    /// Gustafsson's PI control: `β₁/q = 1/q − 3β/4`, `β₂/q = −β`. With β = 0.04 it is the default, with
    /// β = 0 the integral control of most codes (Hairer, Wanner, Solving Ordinary Differential Equations
    /// II, section IV.2).
    #[must_use]
    pub fn gustafsson(beta: T) -> Self {
        Self::new(Law::Gustafsson(beta))
    }

    /// Any PI or PID control by its β, whose sum has to be positive and at most 2 (Söderlind, Digital
    /// filters in adaptive time-stepping, ACM Trans. Math. Softw. 29 (2003)):
    ///
    /// | name | β₁ | β₂ | β₃ | |
    /// |---|---|---|---|---|
    /// | I | 1 | 0 | 0 | fast, and rough where stability limits the step |
    /// | PI.3.3 | 2/3 | −1/3 | 0 | for nonstiff methods at the limit of stability |
    /// | PI.4.2 | 3/5 | −1/5 | 0 | likewise |
    /// | H211PI | 1/6 | 1/6 | 0 | smooth lengths |
    /// | H312PID | 1/18 | 1/9 | 1/18 | smoother, and slower |
    #[must_use]
    pub fn filter(beta: [T; 3]) -> Self {
        Self::new(Law::Filter(beta))
    }

    /// The predictive control of Gustafsson, as in the code RADAU5: the shorter one of the lengths that integral
    /// control proposes and h ← h · safety · (h/h′) (aim ε′/ε²)^(1/q), in which the error goes on changing as it
    /// did over the last step, of length h′. For stiff systems, whose errors grow by orders of magnitude
    /// from step to step (Hairer, Wanner, Solving Ordinary Differential Equations II, eq. (IV.8.25)).
    #[must_use]
    pub fn predictive() -> Self {
        Self::new(Law::Predictive)
    }

    /// The share of the predicted length that is taken, above 0 and at most 1; 0.9 if not given.
    #[must_use]
    pub fn safety(mut self, safety: T) -> Self {
        self.safety = safety;
        self
    }

    /// The error that is aimed at, as a share of the tolerance, above 0 and at most 1: a safety that knows
    /// the order, since it shortens the step by `aim^(1/q)` alone. It takes the place of
    /// [`safety`](Self::safety); that may be given after it too. Usual are 0.25 and 0.38 (Hairer, Nørsett, Wanner I, II.4).
    #[must_use]
    pub fn aim(mut self, aim: T) -> Self {
        self.aim = aim;
        self.log_aim = aim.ln();
        self.safety = T::ONE;
        self
    }

    /// By what a step may differ from the one before: at least `least`, between 0 and 1, and at most
    /// `most`, above 1; 0.2 and 10 if not given.
    #[must_use]
    pub fn factors(mut self, least: T, most: T) -> Self {
        (self.least, self.most) = (least, most);
        self
    }

    fn check(&self) -> Result<(), IntegrationError> {
        let is_share = |x: T| x > T::ZERO && x <= T::ONE;
        let is_number = |x: &T| x.is_finite();
        let gain = match self.law {
            Law::Gustafsson(beta) => beta,
            Law::Filter([first, second, third]) => first + second + third,
            Law::Predictive => T::ONE,
        };
        let (law_holds, expected) = match self.law {
            Law::Gustafsson(_) => ((T::ZERO..=T::from_f64(0.2)).contains(&gain), "between 0 and 0.2"),
            Law::Filter(beta) => (
                beta.iter().all(is_number) && gain > T::ZERO && gain <= T::from_f64(2.0),
                "finite numbers whose sum is above 0 and at most 2",
            ),
            Law::Predictive => (true, ""),
        };
        let checks = [
            ("beta", gain, law_holds, expected),
            ("safety", self.safety, is_share(self.safety), "above 0 and at most 1"),
            ("aim", self.aim, is_share(self.aim), "above 0 and at most 1"),
            ("least factor", self.least, self.least > T::ZERO && self.least < T::ONE, "between 0 and 1"),
            ("most factor", self.most, self.most > T::ONE && self.most.is_finite(), "above 1 and finite"),
        ];
        for (setting, value, is_good, expected) in checks {
            if !is_good {
                return Err(IntegrationError::Setting { setting, value: value.to_f64(), expected });
            }
        }
        Ok(())
    }

    /// The past before the first step: errors that have no effect on it, but for Gustafsson's PI control, which
    /// begins as if the step before had been very exact.
    pub(crate) fn no_past(&self) -> Past<T> {
        let errors = match self.law {
            Law::Gustafsson(_) => [T::from_f64(LEAST_LOG_ERROR); 2],
            Law::Filter(_) | Law::Predictive => [T::ZERO; 2],
        };
        Past { errors, length: None }
    }

    /// The factor after an accepted step of length h, and the past for the next time.
    #[inline]
    pub(crate) fn after_success(&self, h: T, error: T, past: &Past<T>, order: u32) -> (T, Past<T>) {
        let per_order = T::from_f64(f64::from(order).recip());
        let log_error = error.max(T::MIN_POSITIVE).ln();
        let [last, before] = past.errors;
        let log_factor = match self.law {
            Law::Gustafsson(beta) => {
                let exponent = per_order - T::from_f64(0.75) * beta;
                beta * last - exponent * (log_error - self.log_aim)
            }
            Law::Filter([first, second, third]) => {
                -per_order * (first * (log_error - self.log_aim) + second * last + third * before)
            }
            Law::Predictive => {
                let by_error = per_order * (self.log_aim - log_error);
                past.length.map_or(by_error, |length| {
                    let change = last.max(T::from_f64(LEAST_LOG_ERROR_OF_TREND)) - log_error;
                    by_error.min((h / length).ln() + by_error + per_order * change)
                })
            }
        };
        let factor = self.safety * log_factor.exp();
        let errors = [log_error.max(T::from_f64(LEAST_LOG_ERROR)), last];
        (factor.max(self.least).min(self.most), Past { errors, length: Some(h) })
    }

    /// The factor after a rejected step: as short as permitted if the error is not even finite.
    #[inline]
    pub(crate) fn after_rejection(&self, error: T, order: u32) -> T {
        if !error.is_finite() {
            return self.least;
        }
        let factor = self.safety * ((self.log_aim - error.ln()) / T::from_u32(order)).exp();
        factor.max(self.least).min(T::from_f64(AFTER_REJECTION))
    }
}

/// The settings of an adaptive method beside its tolerances.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct StepControl<T> {
    /// Chosen from the equations if not given.
    pub(crate) first_step: Option<T>,
    /// Unlimited if not given.
    pub(crate) max_step: Option<T>,
    /// That of the method if not given.
    pub(crate) controller: Option<Controller<T>>,
}

impl<T: Real> StepControl<T> {
    pub(crate) fn new() -> Self {
        Self { first_step: None, max_step: None, controller: None }
    }

    pub(crate) fn check(&self) -> Result<(), IntegrationError> {
        for (setting, value) in [("first_step", self.first_step), ("max_step", self.max_step)] {
            if let Some(value) = value
                && !(value > T::ZERO && value.is_finite())
            {
                let expected = "positive and finite";
                return Err(IntegrationError::Setting { setting, value: value.to_f64(), expected });
            }
        }
        self.controller.map_or(Ok(()), |controller| controller.check())
    }

    /// The length, at most `max_step`, and at most a quarter of the largest number: a step that is no number can be
    /// shortened for ever.
    #[inline]
    pub(crate) fn limited(&self, h: T) -> T {
        let h = h.min(T::MIN_POSITIVE.recip());
        match self.max_step {
            Some(longest) => h.min(longest),
            None => h,
        }
    }

    /// The shortest step that time can resolve, if steps may be as long.
    #[inline]
    pub(crate) fn least(&self, time: T) -> Result<T, IntegrationError> {
        let shortest = Self::shortest(time);
        match self.max_step {
            Some(step) if step < shortest => Err(IntegrationError::UnresolvedStep {
                time: time.to_f64(),
                step: step.to_f64(),
                resolution: shortest.to_f64(),
            }),
            _ => Ok(shortest),
        }
    }

    /// The shortest step that time can resolve.
    #[inline]
    pub(crate) fn shortest(time: T) -> T {
        (T::from_f64(4.0) * T::EPSILON * time.abs()).max(T::MIN_POSITIVE / T::EPSILON)
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp)] // exact values are meant
mod tests {
    use super::*;

    #[test]
    fn settings_are_checked() {
        let good = StepControl::<f64>::new();
        assert_eq!(good.check(), Ok(()));
        for bad in
            [StepControl { first_step: Some(0.0), ..good }, StepControl { max_step: Some(f64::NAN), ..good }]
        {
            assert!(matches!(bad.check(), Err(IntegrationError::Setting { .. })), "{bad:?}");
        }
        let nan = f64::NAN;
        let plain = Controller::<f64>::default();
        for (name, controller) in [
            ("beta", Controller::gustafsson(-0.1)),
            ("beta", Controller::gustafsson(nan)),
            ("beta", Controller::filter([0.0; 3])),
            ("beta", Controller::filter([1.0, f64::INFINITY, 0.0])),
            ("beta", Controller::filter([nan, 0.0, 0.0])),
            ("safety", plain.safety(0.0)),
            ("safety", plain.safety(1.1)),
            ("safety", plain.safety(nan)),
            ("aim", plain.aim(-0.5)),
            ("aim", plain.aim(nan)),
            ("least factor", plain.factors(0.0, 5.0)),
            ("least factor", plain.factors(1.0, 5.0)),
            ("most factor", plain.factors(0.5, 1.0)),
            ("most factor", plain.factors(0.5, nan)),
        ] {
            let error = StepControl { controller: Some(controller), ..good }.check();
            assert!(
                matches!(error, Err(IntegrationError::Setting { setting, .. }) if setting == name),
                "{name}: {error:?}"
            );
        }
    }

    #[test]
    fn steps_change_within_bounds() {
        let control = StepControl::<f64> { max_step: Some(3.0), ..StepControl::new() };
        assert_eq!((control.limited(1.0), control.limited(10.0)), (1.0, 3.0));
        let controller = Controller::<f64>::default();
        let past = controller.no_past();
        assert_eq!(controller.after_success(0.1, 0.0, &past, 5).0, 10.0);
        assert!((controller.after_rejection(f64::NAN, 5) - 0.2).abs() < 1e-15);
        assert!(controller.after_rejection(1.0 + 1e-12, 5) <= 0.9);
        let narrow = controller.factors(0.7, 1.5);
        assert_eq!(narrow.after_success(0.1, 0.0, &past, 5).0, 1.5);
        assert_eq!(narrow.after_rejection(1e9, 5), 0.7);
    }

    #[test]
    fn the_laws_are_those_of_the_literature() {
        // 0.9 ε^(−1/5 + 0.03) ε′^0.04
        let (error, last, before) = (0.3_f64, 0.6_f64, 0.5_f64);
        let past = Past { errors: [last.ln(), before.ln()], length: Some(0.1) };
        let expected = 0.9 * error.powf(-0.2 + 0.03) * last.powf(0.04);
        let (factor, next) = Controller::default().after_success(0.2, error, &past, 5);
        assert!((factor - expected).abs() < 1e-15);
        assert_eq!(next, Past { errors: [error.ln(), last.ln()], length: Some(0.2) });
        // (0.38/ε)^(1/54) (1/ε′)^(2/54) (1/ε″)^(1/54), q = 3
        let expected = (0.38 / error).powf(1.0 / 54.0) * last.powf(-2.0 / 54.0) * before.powf(-1.0 / 54.0);
        let pid = Controller::filter([1.0 / 18.0, 1.0 / 9.0, 1.0 / 18.0]).aim(0.38);
        assert!((pid.after_success(0.2, error, &past, 3).0 - expected).abs() < 1e-15);
        // 0.9 ε^(−1/4) or 0.9 (h/h′) (ε′/ε²)^(1/4), which is shorter after a shorter step
        let predicted = |h: f64| Controller::predictive().after_success(h, error, &past, 4).0;
        assert!((predicted(0.2) - 0.9 * error.powf(-0.25)).abs() < 1e-15);
        assert!((predicted(0.05) - 0.9 * 0.5 * (last / (error * error)).powf(0.25)).abs() < 1e-15);
        let first = Controller::predictive();
        let first = first.after_success(0.05, error, &first.no_past(), 4).0;
        assert!((first - 0.9 * error.powf(-0.25)).abs() < 1e-15);
        // (0.25/ε)^(1/4) after a rejection, whatever the law
        assert!((pid.aim(0.25).after_rejection(7.0, 4) - (0.25_f64 / 7.0).powf(0.25)).abs() < 1e-15);
    }
}
