//! Contacts outside the assumptions of the model: atoms, films that hardly show, wide contacts, large
//! strains, friction and attraction over a range.

use contact::{Contact, Validity, ZoneSize};
use interp::{Probe, Table};

use super::friction;
use crate::estimate::problem::Problem;
use crate::estimate::problem::no_adhesion;
use crate::model::ends_of_radii;
use crate::{Error, Estimate, Experiment, Options, Parameter, Warning, WarningKind};

/// A contact radius (m) below which there is no continuum.
const SMALLEST_RADIUS: f64 = 1e-9;

impl Experiment {
    /// Lists the assumptions of the model that the contacts of this experiment leave, at its present
    /// values: of an experiment that is planned, before it is made. A fit lists them, too.
    ///
    /// The ordinates of the points are not used. The attraction is taken to have the range of
    /// [`Options::default`]. What friction does is not said, because it is judged by a standard error;
    /// [`forecast`](crate::forecast) says it.
    ///
    /// # Errors
    /// As [`Experiment::predictions`].
    pub fn broken_assumptions(&self, table: &Table) -> Result<Vec<Warning>, Error> {
        let contact = self.bodies.contact(table, &[])?;
        let radii = self.predictions(table, None, &[])?.contact_radii;
        let range = Options::default().interaction_range;
        Ok(doubts(self, &contact, ends_of_radii(radii), range, &[]))
    }
}

/// Warns of contacts outside the assumptions of the model in experiment `e`, at the present values; `None` where these have
/// no contact.
pub(crate) fn of_problem(
    problem: &Problem<'_>,
    e: usize,
    interaction_range: f64,
    estimates: &[Estimate],
) -> Option<Vec<Warning>> {
    let experiment = &problem.assigned[e].experiment;
    let radii = problem.contact_radii(e)?;
    let contact = problem.contact(&experiment.bodies, false).ok()?;
    Some(doubts(
        experiment,
        &contact,
        radii,
        interaction_range,
        estimates,
    ))
}

/// Warns of contacts outside the assumptions of the model. The radii are the smallest and the largest one, m.
fn doubts(
    experiment: &Experiment,
    contact: &Contact,
    radii: [f64; 2],
    interaction_range: f64,
    estimates: &[Estimate],
) -> Vec<Warning> {
    let [_, a] = radii;
    // Where elasticity does not tell the contact radii, the shape of the probe does not matter.
    if !experiment.has_shape(false) {
        return friction::doubt(experiment, contact, a, estimates)
            .into_iter()
            .collect();
    }
    let Ok(validity) = contact.validity(a) else {
        return Vec::new();
    };
    let mut warnings = sizes(experiment, radii);
    warnings.extend(shape(experiment, &validity, a));
    warnings.extend(surface_tension(experiment, &validity));
    warnings.extend(film(experiment, contact, &validity, radii));
    warnings.extend(friction::doubt(experiment, contact, a, estimates));
    warnings.extend(range(experiment, contact, a, interaction_range));
    warnings
}

/// Warns of contacts smaller than atoms, and of those that hardly tell the film.
fn sizes(experiment: &Experiment, [least, a]: [f64; 2]) -> Vec<Warning> {
    let mut warnings = Vec::new();
    let name = &experiment.measurement.name;
    if a < SMALLEST_RADIUS {
        warnings.push(WarningKind::Implausible.with(format!(
            "{name}: no contact radius is above {a:.1e} m, and those below {SMALLEST_RADIUS:e} \
             m are smaller than atoms: check the units of the data"
        )));
    }
    if let Some(doubt) = experiment.doubt_of_film([least, a]) {
        warnings.push(WarningKind::Implausible.with(format!("{name}: {doubt}")));
    }
    warnings
}

/// Warns of a contact radius `a` (m) that is large beside the probe, and of steep probes.
fn shape(experiment: &Experiment, validity: &Validity, a: f64) -> Vec<Warning> {
    let mut warnings = Vec::new();
    let name = &experiment.measurement.name;
    let paraboloid = experiment.bodies.probe.is_paraboloid();
    if paraboloid && validity.a_over_r > Validity::WARNING_A_OVER_R {
        let exact = "the exact sphere, which is a probe of its own";
        let limit = Validity::EXACT_SPHERE_A_OVER_R;
        let remedy = if experiment.bodies.are_layered() {
            "leave out the points of wider contacts, because the exact sphere is solved on a half-space \
             and on one bonded film, without friction"
                .into()
        } else if experiment.bodies.are_coated() && validity.a_over_r > limit {
            format!(
                "leave out the points of contacts above {limit} R, and fit {exact} and is solved up to there"
            )
        } else {
            format!("fit {exact}")
        };
        warnings.push(WarningKind::LargeContact.with(format!(
            "{name}: a/R reaches {:.2}, above {}: the model takes the sphere for a paraboloid, \
             which changes the penetration by up to 3 % at this limit, and more above it; {remedy}",
            validity.a_over_r,
            Validity::WARNING_A_OVER_R
        )));
    }
    let slope = experiment.bodies.probe.slope(a);
    if !paraboloid && slope > Validity::WARNING_SLOPE {
        let end = match experiment.bodies.probe {
            Probe::RoundedCone { .. } => {
                ". The end of a rounded cone is a paraboloid, and wider than a sphere of its radius: fit a tip with a \
                 spherical end as a measured profile"
            }
            _ => "",
        };
        warnings.push(WarningKind::LargeContact.with(format!(
            "{name}: the slope of the probe reaches {slope:.2} at the edge of the contact, as of a cone of half angle \
             {:.0} degrees; the model takes slopes to be small. Half angles count from the axis{end}",
            slope.recip().atan().to_degrees()
        )));
    }
    warnings
}

/// Warns of bodies so soft that surface tension may matter.
fn surface_tension(experiment: &Experiment, validity: &Validity) -> Option<Warning> {
    let name = &experiment.measurement.name;
    let matters = validity.surface_tension < Validity::WARNING_SURFACE_TENSION;
    matters.then(|| {
        WarningKind::SurfaceTension.with(format!(
            "{name}: a surface tension of {:.1e} N/m would raise the load of the widest contact without adhesion by a tenth at its \
             penetration, and the model has none. Gels and elastomers in air have 0.02 \
             to 0.07 N/m, the cortex of a cell 1e-4 to 1e-3 N/m, a gel in its liquid hardly any: where it matters, the modulus \
             falls with wider contacts and larger spheres",
            validity.surface_tension
        ))
    })
}

/// Warns of films that are compressed or bent by much, and of contacts on them that are no discs.
fn film(
    experiment: &Experiment,
    contact: &Contact,
    validity: &Validity,
    radii: [f64; 2],
) -> Vec<Warning> {
    let mut warnings = Vec::new();
    let name = &experiment.measurement.name;
    let film = validity.film;
    if let Some(film) = film.filter(|film| film.strain > Validity::SMALL) {
        let what = match experiment.bodies.have_film() {
            true => "film",
            false => "stack of layers",
        };
        warnings.push(WarningKind::LargeStrain.with(format!(
            "{name}: the {what} is compressed by up to {:.0} % of its thickness; above {:.0} % \
             its elasticity is not linear",
            1e2 * film.strain,
            1e2 * Validity::SMALL
        )));
    }
    if let Some(film) = film.filter(|film| film.bending > Validity::WARNING_BENDING) {
        warnings.push(WarningKind::Bending.with(format!(
            "{name}: the film or top layer, which is stiffer than what lies below it, is pressed down by up to {:.2} of its \
             thickness. It is then also stretched, which makes it stiffer and which the linear model leaves out: fit smaller contacts",
            film.bending
        )));
    }
    if let Some(a) = contact.first_no_disc(radii, 0.0) {
        warnings.push(WarningKind::NoDisc.with(format!(
            "{name}: without adhesion a contact of radius {a:.2e} m may be no disc: the film or top layer is so much stiffer than \
             what lies below it that it bends, and touches the probe farther outside or lifts off inside; fit smaller contacts, \
             or measure with a sphere"
        )));
    }
    warnings
}

/// Warns of an attraction whose range is not small beside a contact up to the radius `a` (m).
fn range(
    experiment: &Experiment,
    contact: &Contact,
    a: f64,
    interaction_range: f64,
) -> Vec<Warning> {
    let mut warnings = Vec::new();
    let name = &experiment.measurement.name;
    for parameter in Parameter::WORKS {
        let Some(w) = experiment.get(parameter).filter(|&w| w > 0.0) else {
            continue;
        };
        if no_adhesion::is_none(experiment, contact, a, w) {
            continue;
        }
        let Ok(range) = contact.zone_size(w, interaction_range) else {
            continue;
        };
        if !range.is_jkr() {
            let (jkr, thin, tense) = (ZoneSize::JKR, ZoneSize::THIN, ZoneSize::TENSE);
            let (tabor, part, tension) = (range.tabor, range.range_over_thickness, range.tension);
            let reason = if tabor < jkr {
                format!("Tabor's parameter is {tabor:.2}, below {jkr}")
            } else if part > thin {
                format!("this is {part:.2} of the thickness, above {thin}")
            } else if tension > tense {
                format!(
                    "the mean tension at pull-off is {tension:.2} of the stress of the attraction, above {tense}"
                )
            } else {
                continue;
            };
            warnings.push(WarningKind::LongRange.with(format!(
                "{name}: with {parameter} = {w:.2e} J/m^2 and an attraction over {:.1e} m \
                 {reason}: the attraction acts outside the contact, too. {}",
                interaction_range,
                error_of_jkr(&range)
            )));
        }
    }
    warnings
}

/// Says by how much the model is wrong where the attraction has a range.
fn error_of_jkr(range: &ZoneSize<'_>) -> String {
    match range.pull_off_error() {
        Ok(error) => format!(
            "The pull-off load of the model is too small by {:.1} %; a direct solve \
             computes it with the range",
            1e2 * error
        ),
        // A fit has no stress of the attraction, which these errors would have raised.
        Err(contact::Error::LongZone {
            zone, what, length, ..
        }) => does_not_hold(&format!(
            "the cohesive zone is {zone:.1e} m long beside the {what}, {length:.1e} m"
        )),
        Err(contact::Error::Tension {
            tension, stress, ..
        }) => does_not_hold(&format!(
            "the mean tension in the contact is {tension:.1e} Pa, and the stress of the attraction {stress:.1e} Pa"
        )),
        Err(error) => format!("By how much the model is wrong is not known: {error}"),
    }
}

/// Says why the model does not hold where the attraction has a range, and what then is wrong.
fn does_not_hold(why: &str) -> String {
    format!(
        "The model does not hold: {why}, and the work of adhesion is wrong; a direct solve tells the pull-off load with \
         the range"
    )
}
