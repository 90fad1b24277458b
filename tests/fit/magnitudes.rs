//! Numbers that no contact experiment has: a wrong unit is named before it is a result.

use acceptance::{Refused, assert_names, solid};
use fit::{Experiment, Kind, Parameter, WarningKind};
use interp::Probe;

use crate::imagined::{Course, Imagined, LENS, assert_warned, film, fit_all, half_space, text};

/// Makes a mistake in a lens of 1 mm on a film of 10 um. Returns as an error what is said of it: of the
/// experiment, else of the fit.
fn with(mistake: impl Fn(&mut Experiment)) -> Result<(), String> {
    let lens = Imagined::lens(Kind::LoadRadius, 10e-6, 2e-6, &LENS);
    let mut experiment = lens.measured(&lens.exact(), 1);
    mistake(&mut experiment);
    let mut found = experiment.magnitudes();
    if found.is_empty() {
        match fit_all(&[experiment], &lens.free) {
            Ok(fit) => found = fit.magnitudes(),
            Err(error) => return Err(error.to_string()),
        }
    }
    let texts: Vec<String> = found.iter().map(ToString::to_string).collect();
    if texts.is_empty() {
        return Ok(());
    }
    Err(texts.join("; "))
}

/// Multiplies the abscissae or the ordinates of all points.
fn scale(experiment: &mut Experiment, [x, y]: [f64; 2]) {
    for point in &mut experiment.measurement.points {
        point.abscissa *= x;
        point.ordinate *= y;
    }
}

#[test]
fn what_no_experiment_has_is_named_with_the_likely_mistake() {
    let paraboloid = |radius| Probe::Paraboloid { radius };
    with(|one| one.bodies.probe = paraboloid(2.0)).refused("radius of the sphere = 2 m; 2 mm");
    with(|one| film(one).thickness = 30.0).refused("film thickness = 30 m; 30 um");
    with(|one| film(one).thickness = 1e-11).refused("film thickness; an atom");
    with(|one| one.bodies.base = solid(2e20, 0.25)).refused("substrate's modulus; 2000 GPa");
    with(|one| film(one).solid = solid(3.5e-3, 0.5))
        .refused("film's modulus = 0.0035 Pa; below the moduli of all solids");
    // Radii in mm, a sphere of too small a radius, and loads in mN and in nN.
    with(|one| scale(one, [1e3, 1.0]))
        .refused("contact radius; below the radius of the sphere; units");
    with(|one| one.bodies.probe = paraboloid(1.5e-4))
        .refused("half the radius of the sphere; check the units of both");
    with(|one| scale(one, [1.0, 1e3])).refused("moduli of all solids; mN or uN taken for N");
    with(|one| scale(one, [1.0, 1e9])).refused("range of the load; nN were probably taken for N");
    with(|one| one.stiffness = Some(1e12)).refused("stiffness; check its unit");
    assert_eq!(with(|_| {}), Ok(()));
}

#[test]
fn a_result_that_no_solid_has_is_named_and_warned_of() {
    // A rigid probe on a half-space of 20 kPa, with forces that are far too large.
    const FACTOR: f64 = 5e9;
    let mut gel = Imagined::probe(Course::Approach, 0.0, &[Parameter::FilmModulus]);
    gel.truth.bodies = half_space(20e-6, f64::INFINITY, solid(2e4, 0.45));
    let mut experiment = gel.measured(&gel.exact(), 1);
    scale(&mut experiment, [1.0, FACTOR]);
    experiment.noise = experiment.noise.map(|noise| noise * FACTOR);
    experiment.stiffness = Some(1e9);
    experiment.baseline *= FACTOR;
    assert_eq!(experiment.magnitudes(), []);
    let found = fit_all(&[experiment], &gel.free).expect("a fit");
    let modulus = found.estimate(Parameter::FilmModulus).expect("free").value;
    assert!((modulus / 1e14 - 1.0).abs() < 0.05, "{modulus:e}");
    let magnitudes = found.magnitudes();
    assert_eq!(magnitudes[0].what, "film-modulus");
    assert_names(
        &magnitudes[0].to_string(),
        "film-modulus; 1 Pa to 2000 GPa; mN or uN taken for N",
    );
    assert_warned(&found, WarningKind::Implausible);
}

#[test]
fn a_film_that_the_contacts_hardly_see_is_doubted_and_one_that_they_see_is_not() {
    for (thickness, words) in [
        (
            3e-3,
            Some("larger than the radius of the sphere; half-space"),
        ),
        (3e-8, Some("the film hardly shows; check the units")),
        (30e-6, None),
        (1e-6, None),
    ] {
        let lens = Imagined::lens(Kind::LoadRadius, thickness, 2e-6, &LENS);
        let experiment = lens.measured(&lens.exact(), 1);
        let found = fit_all(&[experiment], &lens.free);
        let said = text(&found.expect("possible"), WarningKind::Implausible);
        match words {
            Some(words) => assert_names(&said, words),
            None => assert_eq!(said, "", "{thickness:e}"),
        }
    }
}
