//! Contacts in time: the error of the loads against the time, of the integrals for one turn of the
//! penetration and of elements for several.

use contact::{Contact, Control, Course, Error, Relaxation};
use interp::{Elastic, Probe, System, Table};
use serde::{Deserialize, Serialize};

use super::clock::{Timing, human};
use crate::Measurement;

/// The error and the time of one history at one tolerance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// The law.
    pub law: String,
    /// The program, which decides the method: `one cycle` (integrals) or `two cycles` (elements).
    pub program: String,
    /// The relative tolerance asked for.
    pub tolerance: f64,
    /// The number of points.
    pub points: u64,
    /// The largest error of a load, over the largest load: of integrals against a run at a much
    /// smaller tolerance, of elements, which would take long for that, the stated one.
    pub error: f64,
    /// The error that the history states.
    pub stated_error: f64,
    /// The time, s.
    pub seconds: f64,
}

impl Measurement for Row {}

/// The number of points of a history.
const POINTS: u32 = 1001;
/// The seconds spent on measuring one time.
const SECONDS: f64 = 0.2;
/// The tolerances of integrals and of elements, and that of the true values of integrals.
const INTEGRALS: [f64; 3] = [1e-4, 1e-6, 1e-8];
const ELEMENTS: [f64; 3] = [1e-2, 1e-3, 3e-4];
const EXACT: f64 = 1e-10;
/// The name of each method in the summary.
const METHODS: [(&str, &str); 2] = [("one cycle", "integrals"), ("two cycles", "elements")];

/// Returns the laws by their names.
fn laws() -> [(&'static str, Relaxation); 3] {
    [
        (
            "standard linear solid",
            Relaxation::Prony {
                relaxed: 0.3,
                terms: vec![[0.7, 0.6]],
            },
        ),
        (
            "three Prony terms",
            Relaxation::Prony {
                relaxed: 0.15,
                terms: vec![[0.4, 0.02], [0.3, 0.2], [0.15, 3.0]],
            },
        ),
        (
            "power law 0.3",
            Relaxation::PowerLaw {
                exponent: 0.3,
                time: 1.0,
            },
        ),
    ]
}

/// Returns the contact of a rigid probe of 10 um on an incompressible film of 5 um, whose histories are timed.
pub(crate) fn contact_on_gel() -> Result<Contact, Error> {
    let system = System {
        probe: Probe::Paraboloid { radius: 1e-5 },
        sphere_modulus: f64::INFINITY,
        film: Elastic::new(1e3, 0.5)?,
        film_thickness: 5e-6,
        substrate: Elastic::new(f64::INFINITY, 0.25)?,
    };
    Contact::in_table(Table::embedded(), &system)
}

/// Measures all rows, of an incompressible film under a rigid probe up to a/t = 0.6.
///
/// # Errors
/// None for these contacts.
pub fn measure(timing: Timing) -> Result<Vec<Row>, Error> {
    let contact = contact_on_gel()?;
    let once = |t: f64| 1e-6 * (1.0 - (t - 1.0).abs());
    let twice = |t: f64| 1e-6 * (1.0 - (t % 1.0 - 0.5).abs() * 2.2);
    type Program<'a> = (&'a dyn Fn(f64) -> f64, [f64; 3], Option<f64>);
    let programs: [Program<'_>; 2] = [(&once, INTEGRALS, Some(EXACT)), (&twice, ELEMENTS, None)];
    let mut rows = Vec::new();
    for (law, relaxation) in laws() {
        for ((program, _), (penetration, tolerances, exact)) in METHODS.into_iter().zip(programs) {
            let times = (0..POINTS).map(|i| 2.0 * f64::from(i) / f64::from(POINTS - 1));
            let points: Vec<(f64, f64)> = times.map(|t| (t, penetration(t))).collect();
            let follow = |tolerance: f64| {
                let history = contact.history(&relaxation)?;
                history.run(Control::Displacement, &points, Some(tolerance))
            };
            let exact = exact.map(follow).transpose()?;
            for tolerance in tolerances {
                let course = follow(tolerance)?;
                rows.push(Row {
                    law: law.to_owned(),
                    program: program.to_owned(),
                    tolerance,
                    points: u64::from(POINTS),
                    error: exact
                        .as_ref()
                        .map_or(course.error, |exact| difference(&course, exact)),
                    stated_error: course.error,
                    seconds: timing.seconds(SECONDS, || follow(tolerance).is_ok()),
                });
            }
        }
    }
    Ok(rows)
}

/// Returns the largest difference of the loads over the largest load.
fn difference(course: &Course, exact: &Course) -> f64 {
    let loads = exact.states.iter().map(|at| at.state.load);
    let largest = loads.fold(0.0, f64::max);
    let pairs = course.states.iter().zip(&exact.states);
    let difference = pairs.map(|(a, b)| (a.state.load - b.state.load).abs());
    difference.fold(0.0, f64::max) / largest
}

/// Returns a summary.
pub fn markdown(rows: &[Row]) -> String {
    let mut text = String::from(
        "1001 points: largest error of a load over the largest load, and time, at each tolerance\n\n",
    );
    for (program, method) in METHODS {
        let of_method: Vec<&Row> = rows.iter().filter(|row| row.program == program).collect();
        let mut tolerances: Vec<f64> = of_method.iter().map(|row| row.tolerance).collect();
        tolerances.sort_by(|a, b| b.total_cmp(a));
        tolerances.dedup();
        let heads: String = tolerances.iter().map(|one| format!(" {one:e} |")).collect();
        text += &format!("| {program}: {method} |{heads}\n|---|");
        text += &"---|".repeat(tolerances.len());
        text += "\n";
        let mut laws: Vec<&str> = of_method.iter().map(|row| row.law.as_str()).collect();
        laws.dedup();
        for law in laws {
            let of_law = of_method.iter().filter(|row| row.law == law);
            let cells = of_law.map(|row| format!(" {:.0e} in {} |", row.error, human(row.seconds)));
            text += &format!("| {law} |{}\n", cells.collect::<String>());
        }
        text += "\n";
    }
    text.truncate(text.trim_end().len());
    text + "\n"
}
