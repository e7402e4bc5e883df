//! Methods and systems that do not fit each other are refused before a step is taken.

use ballrace::integrate::{
    Adams, Controller, DORMAND_PRINCE, Failure, FailureKind, LinearlyImplicit, Options, Solution,
    StepMethod, System, Tableau, Tolerance, integrate,
};

/// States that decay at a rate of one each.
struct Decay(usize);

impl System for Decay {
    fn dim(&self) -> usize {
        self.0
    }

    fn rhs(&mut self, _t: f64, y: &[f64], dy: &mut [f64]) {
        for (rate, x) in dy.iter_mut().zip(y) {
            *rate = -x;
        }
    }
}

impl LinearlyImplicit for Decay {
    fn prepare(&mut self, _t: f64, _y: &[f64], _gamma_h: f64, _reach: f64) {}

    fn solve(&mut self, _r: &mut [f64]) {}

    fn relaxation(&self) -> f64 {
        0.0
    }

    fn longest(&self) -> f64 {
        f64::INFINITY
    }
}

fn decayed<M: StepMethod<Decay>>(
    method: &M,
    dim: usize,
    options: &Options,
) -> Result<Solution, Failure> {
    let tolerance = Tolerance::uniform(dim, 1e-6, 1e-9).unwrap();
    let y0 = vec![1.0; dim];
    integrate(
        &mut Decay(dim),
        method,
        (0.0, 1.0),
        &y0,
        &tolerance,
        options,
        &mut (),
    )
}

fn refusal(found: Result<Solution, Failure>) -> String {
    match found {
        Err(failure) if matches!(failure.kind, FailureKind::Invalid(_)) => failure.to_string(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_method_without_an_error_estimate_takes_fixed_steps_only() {
    let blind = Tableau {
        b_err: &[0.0; 7],
        ..DORMAND_PRINCE
    };
    let message = refusal(decayed(&blind, 3, &Options::default()));
    assert!(message.contains("fixed_step"), "{message}");
    let fixed = Options {
        fixed_step: Some(0.05),
        ..Options::default()
    };
    // The analytic solution.
    let end = decayed(&blind, 3, &fixed).unwrap();
    assert!(end.y.iter().all(|y| (y - (-1.0_f64).exp()).abs() < 1e-9));
}

#[test]
fn coefficients_that_do_not_fit_are_refused() {
    for tableau in [
        Tableau {
            b_err: &[1.0; 3],
            ..DORMAND_PRINCE
        },
        Tableau {
            stages: 6,
            ..DORMAND_PRINCE
        },
        Tableau {
            dense: &[],
            ..DORMAND_PRINCE
        },
        Tableau {
            fsal: false,
            ..DORMAND_PRINCE
        },
        Tableau {
            stages: 0,
            ..DORMAND_PRINCE
        },
    ] {
        let message = refusal(decayed(&tableau, 2, &Options::default()));
        assert!(message.contains("coefficients"), "{message}");
    }
}

#[test]
fn places_without_velocities_are_refused() {
    let message = refusal(decayed(&Adams, 3, &Options::default()));
    assert!(message.contains("even"), "{message}");
    // An explicit method does not ask what its states are.
    assert!(decayed(&DORMAND_PRINCE, 3, &Options::default()).is_ok());
}

#[test]
fn a_controller_without_numbers_is_refused() {
    let refused = |controller| {
        let options = Options {
            controller,
            ..Options::default()
        };
        let message = refusal(decayed(&DORMAND_PRINCE, 2, &options));
        assert!(message.contains("controller"), "{message}");
    };
    let default = Controller::default();
    for wrong in [f64::NAN, 0.0, -1.0, f64::INFINITY] {
        refused(Controller {
            max_factor: wrong,
            ..default
        });
    }
    refused(Controller {
        error_exponent: f64::NAN,
        ..default
    });
}
