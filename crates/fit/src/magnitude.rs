//! Whether an experiment, and what is found by it, have the [magnitudes](Magnitude) of contacts.
//!
//! What may be, if seldom, is only warned of ([`WarningKind::Implausible`](crate::WarningKind::Implausible)).

use std::borrow::Cow;

use contact::magnitude::{LENGTHS, Magnitude};
use interp::Probe;

use crate::estimate::UNDETERMINED;
use crate::statistics::range;
use crate::{Bodies, Estimate, Experiment, Fit, Kind};

/// The largest load, N.
const LARGEST_LOAD: f64 = 1e5;
/// The contact radius over that of the sphere from which on the sphere is no paraboloid at all.
const WIDE: f64 = 0.5;
/// The largest `a/t` below which the substrate hardly shows, and the one if the film is thicker than
/// the radius of the sphere.
const UNSEEN: [f64; 2] = [1e-2, 0.05];
/// The smallest `a/t` above which the film hardly shows.
const TOO_THIN: f64 = 1e3;

impl Bodies {
    /// Names what no contact has of the radius, the thickness and the moduli of the bodies, and of
    /// the work of adhesion (J/m^2) between them. Infinite moduli are rigid bodies.
    pub fn magnitudes(&self, work_of_adhesion: f64) -> Vec<Magnitude> {
        if let Some(system) = self.system() {
            return Magnitude::of_system(&system, work_of_adhesion);
        }
        if self.are_half_space() {
            return Magnitude::of_half_space(&self.on(self.base), work_of_adhesion);
        }
        let layers = self.layers.iter().map(|named| &named.layer);
        let layers = layers.map(|layer| [layer.thickness, layer.solid.young()]);
        let (modulus, base) = (self.sphere_modulus, self.base.young());
        Magnitude::of_layered(&self.probe, modulus, base, layers, work_of_adhesion)
    }
}

impl Experiment {
    /// Names what no experiment has: of the bodies, the work of adhesion, the stiffness of the
    /// cantilever, and the points. [`fit`](crate::fit) does not ask for it: whoever fits the data of
    /// people does, before the fit, and refuses what it finds.
    pub fn magnitudes(&self) -> Vec<Magnitude> {
        let mut found = self.bodies.magnitudes(self.work_of_adhesion);
        let receding = self.work_of_adhesion_receding;
        found.extend(receding.and_then(Magnitude::work_of_adhesion_receding));
        found.extend(self.stiffness.and_then(Magnitude::stiffness));
        self.ranges(&mut found);
        found.extend(self.wide_contacts());
        found
    }

    /// Checks the ranges of the points.
    fn ranges(&self, found: &mut Vec<Magnitude>) {
        let kind = self.measurement.kind;
        let points = &self.measurement.points;
        // A number that is not finite is refused by its point.
        let of = |value: fn(&crate::Point) -> f64| {
            range(points.iter().map(value).filter(|value| value.is_finite()))
        };
        let ranges = [of(|point| point.abscissa), of(|point| point.ordinate)];
        for ((name, unit), value) in kind.names().into_iter().zip(kind.units()).zip(ranges) {
            let [_, most] = LENGTHS;
            let reason = match unit {
                "N" if value > LARGEST_LOAD => {
                    format!("is above {LARGEST_LOAD:e} N: mN, uN or nN were probably taken for N")
                }
                "m" if value > most && value < 1e100 => {
                    format!("is above {most} m: mm, um or nm were probably taken for m")
                }
                _ => continue,
            };
            let what = format!("the range of the {name}");
            found.push(magnitude(what, value, unit, reason));
        }
    }

    /// Checks measured contact radii against the radius of the sphere.
    fn wide_contacts(&self) -> Option<Magnitude> {
        let at_radii = matches!(
            self.measurement.kind,
            Kind::LoadRadius | Kind::PenetrationRadius
        );
        let Probe::Paraboloid { radius } = self.bodies.probe else {
            return None;
        };
        let points = self.measurement.points.iter().map(|point| point.abscissa);
        let touching: Vec<f64> = points.filter(|&a| a > 0.0 && at_radii).collect();
        // A radius above that of the sphere is an error of the point.
        if touching.iter().any(|&a| a >= radius) {
            return None;
        }
        let wide = touching.iter().filter(|&&a| a > WIDE * radius).count();
        let reason = format!(
            "is one of {wide} above half the radius of the sphere, {radius:?} m, where a \
             paraboloid is no sphere: check the units of both, or take the sphere itself"
        );
        let widest = touching.iter().copied().fold(0.0, f64::max);
        let found = || magnitude("the largest contact radius", widest, "m", reason);
        (2 * wide > touching.len()).then(found)
    }

    /// Returns a doubt about the thickness of the film beside the least and the largest contact
    /// radius, m: the data may hardly tell the film.
    pub(crate) fn doubt_of_film(&self, [least, most]: [f64; 2]) -> Option<Magnitude> {
        let thickness = self.bodies.thickness().filter(|_| most > 0.0)?;
        let radius = self.bodies.probe.radius();
        let smaller_radius = radius.filter(|&radius| thickness > radius);
        let is_thick = smaller_radius.is_some();
        let [usual, thick] = UNSEEN;
        let unseen = if is_thick { thick } else { usual };
        let reason = if most < unseen * thickness {
            let beside = smaller_radius.map_or_else(String::new, |radius| {
                format!("is larger than the radius of the sphere, {radius:?} m, and ")
            });
            format!(
                "{beside}is {:.0} times the largest contact radius: the data hardly tell the film from \
                 a half-space; check the units of both",
                thickness / most
            )
        } else if least > TOO_THIN * thickness {
            format!(
                "is 1/{:.0} of the smallest contact radius: the film hardly shows; check the units of \
                 both",
                least / thickness
            )
        } else {
            return None;
        };
        Some(magnitude("the thickness", thickness, "m", reason))
    }
}

impl Fit {
    /// Names what no experiment has of the values found. Each is warned of, too.
    pub fn magnitudes(&self) -> Vec<Magnitude> {
        self.estimates.iter().filter_map(of_estimate).collect()
    }
}

fn magnitude(
    what: impl Into<Cow<'static, str>>,
    value: f64,
    unit: &'static str,
    reason: String,
) -> Magnitude {
    let (what, reason) = (what.into(), reason.into());
    Magnitude {
        what,
        value,
        unit,
        reason,
    }
}

/// Checks what a fit has found.
pub(crate) fn of_estimate(estimate: &Estimate) -> Option<Magnitude> {
    let Estimate {
        parameter,
        value,
        standard_error,
        ..
    } = *estimate;
    let name = parameter.name();
    let (found, mistake) = if parameter.is_modulus() {
        let mistake = "; mN or uN taken for N, or mm or um for m, give such a result";
        (Magnitude::modulus(name, value)?, mistake)
    } else if parameter.is_thickness() {
        (Magnitude::length(name, value)?, "")
    } else if parameter.is_work_of_adhesion() {
        (Magnitude::work_of_adhesion(name, value)?, "")
    } else {
        return None;
    };
    let usual = found.reason;
    let reason = if standard_error < UNDETERMINED * value {
        format!("{usual}{mistake}")
    } else {
        let undetermined = "is not determined by these data: fix it or give a prior";
        // The thickness of a film that the data do not see goes to any value. Its unit was given with its start, which
        // is checked. Loads or lengths in a wrong unit may leave a modulus undetermined.
        if parameter.is_thickness() {
            undetermined.into()
        } else {
            format!("{undetermined}; it {usual}{mistake}")
        }
    };
    Some(Magnitude {
        reason: reason.into(),
        ..found
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Parameter;

    #[test]
    fn a_value_that_is_not_determined_is_no_mistake_of_a_unit() {
        let text = |value: f64, standard_error: f64| {
            let found = of_estimate(&Estimate {
                parameter: Parameter::FilmThickness,
                experiment: None,
                value,
                standard_error,
                profile: None,
                prior: None,
                bounds: None,
            });
            found.expect("no film is as thick").to_string()
        };
        for error in [7e44, f64::INFINITY, f64::NAN] {
            let text = text(7e40, error);
            assert!(text.contains("m is not determined by these data"), "{text}");
            assert!(!text.contains("probably meant"), "{text}");
        }
        assert!(text(7.0, 0.1).contains("probably meant"));
    }
}
