//! Approach, hold and retract of a rigid sphere on gels of three thicknesses that relax by a power
//! law, and what comes of the usual short cut: the load on a half-space times the elastic effect of
//! the thickness at the same contact.

use contact::{Contact, Control, Relaxation, TimedContact};
use interp::{Elastic, HalfSpace, Probe, System};

use crate::Error;
use figures::axis::Axis;
use figures::chart::{BLUE, Figure, Panel, Point, Side, VERMILION};
use solve::curve;

/// The radius of the sphere (m), the modulus of the gel after 1 s (Pa) and its Poisson ratio.
const RADIUS: f64 = 1e-5;
const MODULUS: f64 = 1e3;
const POISSON: f64 = 0.5;
/// The thicknesses of the gels, m.
const FILMS: [f64; 3] = [1e-5, 3e-6, 1e-6];
/// The relaxation function.
const LAW: Relaxation = Relaxation::PowerLaw {
    exponent: 0.3,
    time: 1.0,
};
/// The penetrations (m) in time (s).
const PROGRAM: [(f64, f64); 4] = [(0.0, 0.0), (1.0, 5e-7), (1.5, 5e-7), (2.5, 0.0)];
/// The number of times.
const POINTS: u32 = 251;

/// Draws a panel for each film: the load (nN) in time, and the load on a half-space times the elastic effect of the
/// thickness at the same contact.
pub fn figure() -> Result<Figure, Error> {
    let solid = Elastic::new(MODULUS, POISSON)?;
    let rigid = Elastic::new(f64::INFINITY, POISSON)?;
    let probe = Probe::Paraboloid { radius: RADIUS };
    let bare = Contact::half_space(&HalfSpace {
        probe: probe.clone(),
        sphere_modulus: f64::INFINITY,
        solid,
    })?;
    let on_half_space = follow(&bare)?;
    let film = |thickness: f64| {
        let system = System {
            probe: probe.clone(),
            sphere_modulus: f64::INFINITY,
            film: solid,
            film_thickness: thickness,
            substrate: rigid,
        };
        let curve = curve(&system.material()?, [1e-4, 10.0], 1e-9)?;
        let contact = Contact::new(&system, curve)?;
        let exact = follow(&contact)?;
        // At one time both contacts have the radii of one elastic penetration.
        let pairs = exact.iter().zip(&on_half_space);
        let short_cut = pairs.map(|(film, bare_state)| {
            let [a, b] = [film, bare_state].map(|at| at.state.contact_radius);
            let effect = if a > 0.0 && b > 0.0 {
                contact.load(a, 0.0)? / bare.load(b, 0.0)?
            } else {
                0.0
            };
            Ok([film.time, 1e9 * effect * bare_state.state.load])
        });
        let short_cut = short_cut.collect::<Result<Vec<Point>, Error>>()?;
        let exact: Vec<Point> = exact
            .iter()
            .map(|at| [at.time, 1e9 * at.state.load])
            .collect();
        Ok(panel(thickness, exact, short_cut))
    };
    let panels = FILMS.into_iter().map(film);
    Ok(Figure::new(330, panels.collect::<Result<Vec<_>, Error>>()?))
}

/// Follows the program on a contact.
fn follow(contact: &Contact) -> Result<Vec<TimedContact>, Error> {
    let end = PROGRAM[PROGRAM.len() - 1].0;
    let times: Vec<f64> = (0..POINTS)
        .map(|i| end * f64::from(i) / f64::from(POINTS - 1))
        .collect();
    let history = contact.history(&LAW)?;
    Ok(history
        .at(Control::Displacement, &PROGRAM, &times, None)?
        .states)
}

/// Draws the loads on the film of a thickness (m).
fn panel(thickness: f64, exact: Vec<Point>, short_cut: Vec<Point>) -> Panel {
    let end = PROGRAM[PROGRAM.len() - 1].0;
    let largest = exact.iter().map(|point| point[1]).fold(0.0, f64::max);
    let mut panel = Panel::new(
        format!("gel of {} µm", 1e6 * thickness),
        Axis::linear("time (s)", [0.0, end]),
        Axis::linear("load (nN)", [0.0, 1.4 * largest]),
    );
    panel
        .dashed(short_cut, VERMILION)
        .line(exact, BLUE)
        // Above the lines, where the texts meet none of them.
        .label(
            [0.7, 1.25 * largest],
            "half-space × factor",
            VERMILION,
            Side::Right,
        )
        .label([1.1, 1.05 * largest], "exact", BLUE, Side::Right);
    panel
}
