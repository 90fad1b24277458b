//! The reduced JKR plot of a fit.

use contact::JkrPoint;
use interp::Probe;

use crate::{Error, Estimate, Experiment, Fit, Kind, Parameter};

/// A measured point in the reduced JKR plot, in which a contact without a film is a straight line:
/// `F/(sqrt(6 pi) a^{3/2})` against `a^{3/2}/(sqrt(pi) R)`.
///
/// The load offset found, or known, is taken from all ordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JkrPlotPoint {
    /// `a^{3/2}/(sqrt(pi) R)`, m^{1/2}.
    pub abscissa: f64,
    /// The ordinate measured, N m^{-3/2}.
    pub measured: f64,
    /// The ordinate of the fit; `None` for a point that was left out.
    pub fit: Option<f64>,
    /// The ordinate of the fit without the film; `None` where there is none.
    pub without_film: Option<f64>,
}

/// Returns the points of the experiment `number` of a fit in the reduced JKR plot, in the order
/// measured; `None` for a point without a contact. `experiment` is this experiment.
///
/// # Errors
/// [`Error::NotFitted`] unless loads were measured at contact radii, under a probe with a radius of
/// curvature at its tip.
///
/// # Panics
/// If the fit has no experiment of this `number`.
pub fn jkr_plot(
    fit: &Fit,
    experiment: &Experiment,
    number: usize,
) -> Result<Vec<Option<JkrPlotPoint>>, Error> {
    let none = |reason: &'static str| Err(experiment.not_fitted(reason));
    if experiment.measurement.kind != Kind::LoadRadius {
        return none("it has no JKR plot: it needs loads that were measured at contact radii");
    }
    let (Probe::Paraboloid { radius }
    | Probe::Sphere { radius }
    | Probe::RoundedCone { radius, .. }) = experiment.bodies.probe
    else {
        return none(
            "it has no JKR plot: it needs a probe with a radius of curvature at its tip: a paraboloid, a sphere or a \
             rounded cone",
        );
    };
    let offset = |estimates: &[Estimate]| {
        let found = Fit::value_of(estimates, Parameter::LoadOffset, number);
        found.unwrap_or(experiment.load_offset)
    };
    let with_film = offset(&fit.estimates);
    let without = fit.without_film.as_ref();
    let without = without.map_or(with_film, |without| offset(&without.estimates));
    let points = fit.experiments[number].points.iter().map(|point| {
        let a = point.abscissa;
        let place = |load: f64| JkrPoint::new(a, load, radius);
        let measured = place(point.ordinate - with_film);
        (a > 0.0).then(|| JkrPlotPoint {
            abscissa: measured.abscissa,
            measured: measured.ordinate,
            fit: point.fit.map(|load| place(load - with_film).ordinate),
            without_film: point
                .without_film
                .map(|load| place(load - without).ordinate),
        })
    });
    Ok(points.collect())
}
