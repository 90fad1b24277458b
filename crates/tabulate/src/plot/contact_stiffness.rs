//! Contact stiffness of an oxide on silicon against `a/t`, beside the closed forms that indenters
//! are read with.

use interp::{Elastic, Material, Probe, Quantity, System};

use crate::Error;
use cost::approximations::{gao, springs_in_series};
use figures::axis::Axis;
use figures::chart::{BLUE, Figure, GREEN, Panel, Point, Side, VERMILION};

/// The range of `a/t`.
const A_OVER_T: [f64; 2] = [1e-2, 1e2];
/// The number of points of each line.
const POINTS: u32 = 201;
/// The relative tolerance of the solves.
const TOLERANCE: f64 = 1e-6;
/// The reduced modulus of diamond, GPa, in which the moduli of the material are.
const DIAMOND: f64 = 1146.6;

/// The data of the figure: `a/t`, and `S/(2a)` in GPa.
#[derive(Clone, Debug)]
pub struct Data {
    /// Direct solves.
    pub exact: Vec<Point>,
    /// Film and substrate as springs in series.
    pub series: Vec<Point>,
    /// The first order of Gao, Chiu and Lee.
    pub gao: Vec<Point>,
    /// The limits of a thick and of a thin film.
    pub limits: [f64; 2],
}

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

/// Computes the data, the exact ones from direct solves.
///
/// # Errors
/// Those of [`solve::curve`].
pub fn data() -> Result<Data, Error> {
    let material = material()?;
    let curve = solve::curve(&material, A_OVER_T, TOLERANCE)?;
    let [from, to] = A_OVER_T;
    let line = |of: &dyn Fn(f64) -> Result<f64, Error>| {
        (0..POINTS)
            .map(|i| {
                let x = from * (to / from).powf(f64::from(i) / f64::from(POINTS - 1));
                Ok([x, DIAMOND * of(x)?])
            })
            .collect::<Result<Vec<_>, Error>>()
    };
    Ok(Data {
        exact: line(&|x| Ok(curve.quantity(Quantity::Eeq, x)?))?,
        series: line(&|x| Ok(springs_in_series(x, &material)?))?,
        gao: line(&|x| Ok(gao(x, &material)?))?,
        limits: [
            DIAMOND * material.thick_film_limit().eeq,
            DIAMOND * material.thin_film_limit().eeq,
        ],
    })
}

/// Draws the three stiffnesses between their limits.
pub fn figure(data: &Data) -> Figure {
    let x = Axis::logarithmic("contact radius / film thickness, a/t", A_OVER_T);
    let [film, substrate] = data.limits;
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
        .line(data.gao.clone(), GREEN)
        .line(data.series.clone(), VERMILION)
        .line(data.exact.clone(), BLUE);
    let at = |line: &[Point], twentieths: usize| line[line.len() * twentieths / 20];
    panel
        .label(at(&data.exact, 8), "exact layers", BLUE, Side::AboveLeft)
        .label(
            at(&data.series, 14),
            "springs in series",
            VERMILION,
            Side::AboveLeft,
        )
        .label(
            at(&data.gao, 11),
            "Gao, Chiu and Lee 1992",
            GREEN,
            Side::BelowRight,
        );
    Figure::new(440, [panel])
}
