//! Least squares with the contact model, by Levenberg and Marquardt's method with the analytic
//! Jacobian.
//!
//! `data` reads the measured points, `jkr` finds start values without a film, `model` predicts the
//! loads and their derivatives, `uncertainty` gives the errors at the minimum, and `report` prints
//! the result. The residuals are differences of loads in units of the noise, also where the load
//! was measured against the penetration. Moduli, work of adhesion and thickness are fitted by their
//! logarithms, so that they stay positive.

mod data;
mod jkr;
mod model;
mod report;
mod uncertainty;

pub use data::{Against, Data};
use interp::{System, Table};
pub use jkr::Homogeneous;
use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt, TerminationReason};
pub use model::{Parameter, State};
use model::{Predicted, predict};
use nalgebra::storage::Owned;
use nalgebra::{DMatrix, DVector, Dyn};
pub use report::print;
use uncertainty::Uncertainty;

/// The largest standard error of an identifiable parameter, relative to its value; for the offset,
/// relative to the range of the data.
const IDENTIFIABLE: f64 = 0.5;
/// The largest ratio of the singular values of the Jacobian, with columns scaled to length 1, of
/// identifiable parameters. The derivatives are not accurate enough for a larger one.
const CONDITION: f64 = 1e6;

/// The largest distance of the end of a fit from the minimum of its linearisation, in standard
/// errors. A fit that ends farther away was stopped by the end of the table.
const SHORT: f64 = 0.1;

/// The largest excess of a sum of squares over its expectation that noise explains, in standard
/// deviations. Noise exceeds it once in 300,000 fits.
const BEYOND_NOISE: f64 = 4.5;

/// The residuals at parameters without a contact, such as those outside the table. They are so
/// large that the method rejects the step.
const REFUSED: f64 = 1e100;

/// A fitted parameter.
#[derive(Clone, Copy, Debug)]
pub struct Estimate {
    pub parameter: Parameter,
    /// The value, in SI units.
    pub value: f64,
    /// The standard error.
    pub error: f64,
}

/// The result of a fit.
#[derive(Clone, Debug)]
pub struct Fit {
    /// The number of points.
    pub points: usize,
    /// The quantity that the loads were measured against.
    pub against: Against,
    /// The fit of JKR to these data, which ignores the film.
    pub homogeneous: Homogeneous,
    /// The fitted parameters.
    pub estimates: Vec<Estimate>,
    /// The correlation matrix of the estimates, in their order.
    pub correlation: DMatrix<f64>,
    /// The sum of the squares of the residuals, in units of the given noise, per degree of freedom;
    /// `None` if the noise was estimated.
    pub reduced_chi_squared: Option<f64>,
    /// The noise of the load (N), given or estimated.
    pub noise: f64,
    /// The doubts about the result, in words.
    pub warnings: Vec<String>,
}

/// Fits the parameters in `free` to `data`.
///
/// The sphere's modulus and the work of adhesion start from the fit of JKR, the other parameters
/// from their values in `system`. `noise` is the standard deviation of a load (N); without it the
/// noise is estimated from the residuals.
pub fn fit(
    table: &Table,
    data: &Data,
    system: &System,
    free: &[Parameter],
    noise: Option<f64>,
) -> Result<Fit, String> {
    let (count, points) = (free.len(), data.points.len());
    if points <= count {
        return Err(format!(
            "{points} points do not determine {count} parameters and their errors: give more points or fit fewer parameters"
        ));
    }
    if let Some(noise) = noise.filter(|&noise| !(noise > 0.0 && noise.is_finite())) {
        return Err(format!("the noise is {noise:?}: it must be > 0 and finite"));
    }
    let homogeneous = Homogeneous::fit(
        data,
        system.sphere_radius,
        free.contains(&Parameter::Offset),
    )?;
    let start = start(data, system, &homogeneous);
    let [abscissae, loads] = data.ranges();
    let offset_unit = match data.against {
        Against::ContactRadius => loads,
        Against::Penetration => abscissae,
    };
    let unit = noise.unwrap_or(1e-3 * loads);
    let mut problem = Problem {
        table,
        data,
        free,
        start,
        offset_unit,
        unit,
        x: DVector::zeros(count),
        predicted: None,
    };
    let outside = |error| {
        format!(
            "where the fit starts, at E2* = {:e} Pa: {error}",
            start.system.sphere_modulus
        )
    };
    problem.predicted = Some(problem.predict().map_err(outside)?);

    // The parameters are scaled already, by a factor of e or by the range of the data.
    let method = LevenbergMarquardt::new()
        .with_scale_diag(false)
        .with_stepbound(1.0)
        .with_ftol(1e-12)
        .with_xtol(1e-10);
    let (problem, report) = method.minimize(problem);
    // A fit that rounding has stopped has converged.
    if !(report.termination.was_successful()
        || matches!(
            report.termination,
            TerminationReason::NoImprovementPossible(_)
        ))
    {
        return Err(format!(
            "the fit did not converge: {:?} after {} evaluations; fit fewer parameters or start from other values",
            report.termination, report.number_of_evaluations
        ));
    }
    problem.finish(homogeneous, noise.is_some())
}

/// Returns the parameters at which the fit starts.
///
/// JKR's modulus is taken for that of the sphere and the body below it, which is a thick film or
/// else the substrate.
fn start(data: &Data, system: &System, homogeneous: &Homogeneous) -> State {
    let largest = data
        .points
        .iter()
        .map(|point| point.0.abs())
        .fold(0.0, f64::max);
    let radius = match data.against {
        Against::ContactRadius => largest,
        Against::Penetration => (largest * system.sphere_radius).sqrt(),
    };
    let below = if system.film_thickness > radius {
        system.film.reduced()
    } else {
        system.substrate.reduced()
    };
    let compliance = 1.0 / homogeneous.modulus - 1.0 / below;
    let sphere_modulus = if compliance > 0.0 {
        1.0 / compliance
    } else {
        homogeneous.modulus
    };
    let work_of_adhesion = homogeneous.work_of_adhesion.max(f64::MIN_POSITIVE);
    State {
        system: System {
            sphere_modulus,
            ..*system
        },
        work_of_adhesion,
        offset: homogeneous.offset,
    }
}

/// The least-squares problem at one set of parameters.
struct Problem<'a> {
    table: &'a Table,
    data: &'a Data,
    free: &'a [Parameter],
    start: State,
    /// The unit of the offset.
    offset_unit: f64,
    /// The unit of loads.
    unit: f64,
    /// The logarithm of each free parameter over its start value; for the offset, the difference
    /// from its start value in its unit.
    x: DVector<f64>,
    /// The loads at all points; `None` if there is no contact with these parameters.
    predicted: Option<Vec<Predicted>>,
}

impl Problem<'_> {
    /// Returns the values of all parameters.
    fn state(&self) -> Result<State, interp::Error> {
        self.free
            .iter()
            .zip(self.x.iter())
            .try_fold(self.start, |state, (&parameter, x)| {
                let start = self.start.get(parameter);
                state.with(
                    parameter,
                    if parameter == Parameter::Offset {
                        start + x * self.offset_unit
                    } else {
                        start * x.exp()
                    },
                )
            })
    }

    /// Predicts the loads at all points.
    fn predict(&self) -> Result<Vec<Predicted>, interp::Error> {
        predict(self.table, &self.state()?, self.data)
    }

    /// Returns the estimates at the minimum of the sum of squares, with their errors and doubts.
    fn finish(self, homogeneous: Homogeneous, noise_given: bool) -> Result<Fit, String> {
        let state = self.state().map_err(|error| error.to_string())?;
        let (residuals, jacobian) = self
            .residuals()
            .zip(self.jacobian())
            .ok_or("the fit ended outside the table: give a larger one with --table")?;
        let reduced_chi_squared = residuals.norm_squared() / self.freedom();
        let (points, against) = (self.data.points.len(), self.data.against);
        let scatter = if noise_given {
            1.0
        } else {
            reduced_chi_squared.sqrt()
        };
        let uncertainty = Uncertainty::new(jacobian, &residuals, scatter);
        let estimate = |(&parameter, relative): (&Parameter, &f64)| {
            let value = state.get(parameter);
            let unit = if parameter == Parameter::Offset {
                self.offset_unit
            } else {
                value
            };
            Estimate {
                parameter,
                value,
                error: relative * unit,
            }
        };
        let estimates = self
            .free
            .iter()
            .zip(&uncertainty.errors)
            .map(estimate)
            .collect();
        let reduced_chi_squared = noise_given.then_some(reduced_chi_squared);
        let warnings = self.warnings(&uncertainty, reduced_chi_squared);
        let (correlation, noise) = (uncertainty.correlation, scatter * self.unit);
        Ok(Fit {
            points,
            against,
            homogeneous,
            estimates,
            correlation,
            reduced_chi_squared,
            noise,
            warnings,
        })
    }

    /// Returns the degrees of freedom: the number of points minus that of the parameters.
    fn freedom(&self) -> f64 {
        (self.data.points.len() - self.free.len()) as f64
    }

    /// Lists the doubts about the result.
    fn warnings(&self, uncertainty: &Uncertainty, reduced_chi_squared: Option<f64>) -> Vec<String> {
        let mut warnings = Vec::new();
        for (parameter, error) in self.free.iter().zip(&uncertainty.errors) {
            if error.is_nan() || *error > IDENTIFIABLE {
                let (name, error, most) = (parameter.name(), 1e2 * error, 1e2 * IDENTIFIABLE);
                warnings.push(format!(
                    "{name} is not identifiable from these data: its standard error is {error:.0} %, above {most:.0} %"
                ));
            }
        }
        let condition = uncertainty.condition;
        if condition > CONDITION {
            warnings.push(format!(
                "a combination of the parameters is not identifiable: condition {condition:.0e}, above {CONDITION:.0e}"
            ));
        }
        let short = uncertainty.short;
        if short > SHORT {
            warnings.push(format!("the fit ended {short:.1} standard errors from the least squares: the table ends there"));
        }
        // The cube root of chi^2 is nearly normal (Wilson and Hilferty).
        let spread = 2.0 / (9.0 * self.freedom());
        if let Some(value) = reduced_chi_squared
            .filter(|value| (value.cbrt() - (1.0 - spread)) / spread.sqrt() > BEYOND_NOISE)
        {
            warnings.push(format!(
                "the model does not describe the data to their noise: reduced chi^2 is {value:.2}"
            ));
        }
        let pulled_off = self
            .predicted
            .iter()
            .flatten()
            .filter(|predicted| predicted.pulled_off)
            .count();
        if pulled_off > 0 {
            warnings.push(format!(
                "points beyond the pull-off of the fitted contact: {pulled_off}"
            ));
        }
        warnings
    }
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Problem<'_> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, x: &DVector<f64>) {
        self.x.copy_from(x);
        self.predicted = self
            .predict()
            .ok()
            .filter(|all| all.iter().all(|predicted| predicted.load.is_finite()));
    }

    fn params(&self) -> DVector<f64> {
        self.x.clone()
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        let points = &self.data.points;
        Some(match &self.predicted {
            Some(all) => {
                DVector::from_fn(points.len(), |i, _| (all[i].load - points[i].1) / self.unit)
            }
            None => DVector::from_element(points.len(), REFUSED),
        })
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let all = self.predicted.as_ref()?;
        Some(DMatrix::from_fn(all.len(), self.free.len(), |i, j| {
            let unit = if self.free[j] == Parameter::Offset {
                self.offset_unit
            } else {
                1.0
            };
            all[i].by[self.free[j] as usize] * unit / self.unit
        }))
    }
}
