//! What full friction changes in the system of the paper: stiffness, load and pull-off load with
//! stick over those without friction, against the thickness of the film.

use contact::{Contact, Control, root};
use interp::{Curve, Material};

use super::paper::{WORK_OF_ADHESION, spaced, system};
use crate::Error;
use figures::axis::Axis;
use figures::chart::{BLUE, Figure, GREEN, PURPLE, Panel, Point, Side, VERMILION};
use solve::curve;
use solve::parallel::try_map;
use solve::stick::{StickCurves, Sticking};

/// The ends of the film's thickness, m, and the number of points between them.
const THICKNESS: [f64; 2] = [0.3e-6, 300e-6];
const POINTS: usize = 49;

/// The contact radius (m) of the paper's lens without a film and without load, at which stiffness
/// and load are compared.
const RADIUS: f64 = 65.6e-6;

/// The range of `a/t` of the sphere, and the relative tolerance of all solves.
const A_OVER_T: [f64; 2] = [1e-2, 30.0];
const TOLERANCE: f64 = 1e-9;

/// The lines: what is compared, in the order of [`data`].
const LINES: [&str; 4] = [
    "stiffness, rigid sphere",
    "load at equal penetration",
    "stiffness",
    "pull-off load (lower)",
];

/// Computes the thickness (um) and the change by full friction (%) for each line. A line ends where
/// the contact is 30 times as wide as the film is thick, that of the stiffness at 219 times.
fn data() -> Result<Vec<Vec<Point>>, Error> {
    let soft = system(1e-6)?.material()?;
    let rigid = Material::new(0.0, soft.nu1(), f64::INFINITY, soft.nu0())?;
    let [soft_film, rigid_film] = [soft, rigid].map(|material| Sticking::on_film(&material, 0.5));
    let [soft_film, rigid_film] = [soft_film?, rigid_film?];
    let sticks = StickCurves::new(&soft_film, A_OVER_T, TOLERANCE)?;
    let curves = [sticks.receding(1.0)?, curve(&soft, A_OVER_T, TOLERANCE)?];
    let thicknesses: Vec<f64> = spaced(THICKNESS, POINTS).collect();
    let rows = try_map(thicknesses, |t| {
        let x = RADIUS / t;
        let narrow = x <= A_OVER_T[1];
        let of_rigid = narrow.then(|| rigid_film.stiffening(x, 1e-6)).transpose()?;
        let stiffness = soft_film.stiffening(x, TOLERANCE.max(1e-8))?;
        let load = narrow
            .then(|| load_at_equal_penetration(&curves, x))
            .transpose()?;
        let pull_off = pull_off_at(&curves, t)?;
        Ok::<_, Error>((t, [of_rigid, load, Some(stiffness), pull_off]))
    })?;
    let line = |i: usize| {
        let point = |(t, ratios): &(f64, [Option<f64>; 4])| {
            ratios[i].map(|ratio| [1e6 * t, 1e2 * (ratio - 1.0).abs()])
        };
        rows.iter().filter_map(point).collect()
    };
    Ok((0..LINES.len()).map(line).collect())
}

/// Returns the load without adhesion with stick, over that without friction, at the penetration that
/// the latter has at `x = a/t`.
fn load_at_equal_penetration([stick, slide]: &[Curve; 2], x: f64) -> Result<f64, Error> {
    let without = slide.quantities(x)?;
    let deep = x * x * without.delta0;
    let excess = |x: f64| Ok::<_, Error>(x * x * stick.quantities(x)?.delta0 - deep);
    let wider = root(excess, 0.9 * x, (1.1 * x).min(A_OVER_T[1]))?;
    Ok(wider.powi(3) * stick.quantities(wider)?.pi0 / (x.powi(3) * without.pi0))
}

/// Returns the pull-off load with stick over that without friction, of a film of thickness `t`;
/// `None` where the contact is too wide, and where friction does not lower the load.
fn pull_off_at(curves: &[Curve; 2], t: f64) -> Result<Option<f64>, Error> {
    let mut loads = [0.0; 2];
    for (load, curve) in loads.iter_mut().zip(curves) {
        let contact = Contact::new(&system(t)?, curve.clone())?;
        match contact.pull_off(WORK_OF_ADHESION, Control::Load) {
            Ok(state) => *load = state.load,
            Err(contact::Error::OutsideRadii { .. }) => return Ok(None),
            Err(error) => return Err(error.into()),
        }
    }
    Ok(Some(loads[0] / loads[1]).filter(|ratio| *ratio < 1.0))
}

/// Draws the lines.
pub fn figure() -> Result<Figure, Error> {
    let lines = data()?;
    let mut panel = Panel::new(
        "What full friction changes in the paper's system",
        Axis::logarithmic("film thickness, μm", THICKNESS.map(|t| 1e6 * t)),
        Axis::logarithmic("change by full friction, %", [1e-3, 1e2]),
    );
    panel.horizontal_guide(10.0, "measured: modulus of thin films too low", Side::Left);
    for (((name, points), colour), place) in LINES
        .into_iter()
        .zip(lines)
        .zip([VERMILION, BLUE, GREEN, PURPLE])
        .zip([
            (0.6, Side::Right),
            (0.3, Side::AboveLeft),
            (0.2, Side::Below),
            (0.5, Side::Below),
        ])
    {
        panel.named(points, colour, name, place);
    }
    Ok(Figure::new(460, [panel]))
}
