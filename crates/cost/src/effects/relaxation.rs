//! Relaxation: the error of the elastic load where the modulus falls in time, and the cost of a history.

use contact::{Contact, Control, Relaxation};
use interp::{Material, Probe, System};

use crate::clock::Timing;
use crate::history::contact_on_gel;
use solve::{A_OVER_T, Error, curve};

/// The exponent of the power law by which all bodies relax.
pub const EXPONENT: f64 = 0.2;

/// The program: times (s) and parts of the largest penetration.
const CYCLE: [(f64, f64); 3] = [(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)];
/// The relative tolerance of the elastic curve and of the loads.
const TOLERANCE: f64 = 1e-6;
/// The number of times in a cycle at which loads are compared.
const COMPARED: u32 = 100;
/// The number of points of a history that is timed.
const POINTS: u32 = 1001;

/// Returns the loads (N) in a cycle up to a penetration (m) under a law.
fn follow(
    contact: &Contact,
    law: &Relaxation,
    penetration: f64,
    points: u32,
    tolerance: Option<f64>,
) -> Result<Vec<f64>, Error> {
    let program = CYCLE.map(|(time, part)| (time, part * penetration));
    let end = CYCLE[CYCLE.len() - 1].0;
    let times: Vec<f64> = (0..points)
        .map(|i| end * f64::from(i) / f64::from(points - 1))
        .collect();
    let to = |tolerance| {
        let history = contact.history(law)?;
        history.at(Control::Displacement, &program, &times, tolerance)
    };
    let course = match to(tolerance) {
        // Without a tolerance the history is as exact as it can be.
        Err(contact::Error::Unreached { .. }) if tolerance.is_some() => to(None),
        course => course,
    };
    Ok(course?.states.iter().map(|at| at.state.load).collect())
}

/// The law of the bodies, in units of the time of the turn.
const fn law() -> Relaxation {
    Relaxation::PowerLaw {
        exponent: EXPONENT,
        time: 1.0,
    }
}

/// Returns the largest error of the elastic load on approach and retract to a contact radius, over the
/// load at the turn. The elastic bodies have the modulus that gives this load.
pub(super) fn error_of_elastic(a_over_t: f64, material: &Material) -> Result<f64, Error> {
    // The smallest contact of the curve over the largest: its load does not count.
    const SMALLEST: f64 = 1e-2;
    // Films that are thicker beside the contact are half-spaces.
    let a_over_t = a_over_t.max(A_OVER_T[0] / SMALLEST);
    let curve = curve(material, [SMALLEST * a_over_t, a_over_t], TOLERANCE)?;
    // The radius does not matter, as long as the contact is smaller.
    let radius = 10.0 * a_over_t;
    let system = System::of_material(material, Probe::Paraboloid { radius });
    let contact = Contact::new(&system, curve)?;
    let (_, penetration) = contact.load_and_penetration(a_over_t, 0.0)?;
    let elastic = Relaxation::Prony {
        relaxed: 1.0,
        terms: Vec::new(),
    };
    let [relaxing, elastic] = [law(), elastic].map(|law| {
        let loads = follow(&contact, &law, penetration, COMPARED + 1, Some(TOLERANCE))?;
        let turn = loads[loads.len() / 2];
        Ok::<_, Error>(loads.into_iter().map(move |load| load / turn))
    });
    let pairs = relaxing?.zip(elastic?);
    Ok(pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max))
}

/// Returns the time of a history of an incompressible film up to `a/t` = 0.6, over that of an elastic curve of
/// as many points.
pub(super) fn time_ratio(timing: Timing) -> Result<f64, Error> {
    const LARGEST: f64 = 3e-6;
    let contact = contact_on_gel()?;
    let (_, penetration) = contact.load_and_penetration(LARGEST, 0.0)?;
    let relaxing = |(): &()| follow(&contact, &law(), penetration, POINTS, None);
    let elastic = |(): &()| {
        let radii = (1..=POINTS).map(|i| LARGEST * f64::from(i) / f64::from(POINTS));
        radii
            .map(|a| contact.load_and_penetration(a, 0.0))
            .collect::<Result<Vec<(f64, f64)>, _>>()
    };
    timing.ratio(&[()], relaxing, elastic)
}
