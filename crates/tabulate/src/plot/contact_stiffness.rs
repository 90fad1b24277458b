//! Contact stiffness of an oxide on silicon against `a/t`, beside the closed forms that indenters
//! are read with.

use interp::{Elastic, Material, Probe, Quantity, System};

use super::paper::spaced;
use crate::Error;
use cost::approximations::{gao, springs_in_series};
use figures::axis::Axis;
use figures::chart::{BLUE, Figure, GREEN, Panel, Point, Side, VERMILION};

/// The range of `a/t`.
const A_OVER_T: [f64; 2] = [1e-2, 1e2];
/// The number of points of each line.
const POINTS: usize = 201;
/// The relative tolerance of the solves.
const TOLERANCE: f64 = 1e-6;
/// The reduced modulus of diamond, GPa, in which the moduli of the material are.
const DIAMOND: f64 = 1146.6;

/// Returns silicon dioxide on silicon under diamond.
fn material() -> Result<Material, Error> {
    let system = System {
        probe: Probe::Paraboloid { radius: 1.0 },
        sphere_modulus: DIAMOND,
        film: Elastic::new(72.0, 0.17)?,
        film_thickness: 1.0,
        substrate: Elastic::new(170.0, 0.28)?,
    };
    Ok(system.material()?)
}

/// Draws the stiffness from direct solves, that of film and substrate as springs in series, and the first order of Gao,
/// Chiu and Lee, between the limits of a thick and of a thin film.
pub fn figure() -> Result<Figure, Error> {
    let material = material()?;
    let curve = solve::curve(&material, A_OVER_T, TOLERANCE)?;
    let line = |of: &dyn Fn(f64) -> Result<f64, Error>| -> Result<Vec<Point>, Error> {
        let point = |x| Ok([x, DIAMOND * of(x)?]);
        spaced(A_OVER_T, POINTS).map(point).collect()
    };
    let exact = line(&|x| Ok(curve.quantity(Quantity::Eeq, x)?))?;
    let series = line(&|x| Ok(springs_in_series(x, &material)?))?;
    let of_gao = line(&|x| Ok(gao(x, &material)?))?;
    let limits = [material.thick_film_limit(), material.thin_film_limit()];
    let [film, substrate] = limits.map(|limit| DIAMOND * limit.eeq);
    let x = Axis::logarithmic("contact radius / film thickness, a/t", A_OVER_T);
    let y = Axis::linear("S/(2a)  (GPa)", [film - 10.0, substrate + 10.0]);
    let title = "Contact stiffness of silicon dioxide on silicon, under diamond";
    let mut panel = Panel::new(title, x, y);
    panel
        .horizontal_guide(film, format!("film alone: {film:.1}"), Side::Right)
        .horizontal_guide(
            substrate,
            format!("substrate alone: {substrate:.1}"),
            Side::Left,
        )
        .named(
            of_gao,
            GREEN,
            "Gao, Chiu and Lee 1992",
            (0.55, Side::BelowRight),
        )
        .named(
            series,
            VERMILION,
            "springs in series",
            (0.7, Side::AboveLeft),
        )
        .named(exact, BLUE, "exact layers", (0.4, Side::AboveLeft));
    Ok(Figure::new(440, [panel]))
}
