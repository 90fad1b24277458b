//! Fig. 4 of the paper: reduced JKR plots (eq. 9) for several film thicknesses, with the lines of
//! the JKR model without a film and without a substrate.

use contact::{Contact, JkrPoint};
use interp::HalfSpace;
use solve::stack::Interface;

use super::paper::{self, WORK_OF_ADHESION};
use crate::Error;
use figures::axis::Axis;
use figures::chart::{BLACK, BLUE, Figure, GREEN, ORANGE, PURPLE, Panel, Point, Side, VERMILION};

/// The film thicknesses, m.
pub const THICKNESSES: [f64; 5] = [1e-6, 3e-6, 10e-6, 30e-6, 100e-6];

/// The largest contact radius, m: twice that at zero load, the end of the paper's fits.
const LARGEST_RADIUS: f64 = 130e-6;

/// The data of the figure: `a^{3/2} / (sqrt(pi) R)` in m^{1/2} and `F / (sqrt(6 pi) a^{3/2})` in N
/// m^{-3/2}.
#[derive(Clone, Debug)]
pub struct Data {
    /// A line for each film of [`THICKNESSES`].
    pub films: Vec<Vec<Point>>,
    /// The JKR model on the bare substrate: the limit of a thin film, except at the smallest
    /// contacts.
    pub sphere: Vec<Point>,
    /// The JKR model on a half-space of film: the limit of a thick film.
    pub sphere_film: Vec<Point>,
}

/// Computes the data from direct solves.
///
/// # Errors
/// Those of [`solve::curve`].
pub fn data() -> Result<Data, Error> {
    let system = paper::system(THICKNESSES[0])?;
    let half_space = |solid| {
        Contact::half_space(&HalfSpace {
            solid,
            ..system.without_film()
        })
    };
    Ok(Data {
        films: THICKNESSES
            .iter()
            .map(|&t| jkr_plot(&paper::contact(&paper::PROBE, t, Interface::Bonded)?))
            .collect::<Result<_, Error>>()?,
        sphere: jkr_plot(&half_space(system.substrate)?)?,
        sphere_film: jkr_plot(&half_space(system.film)?)?,
    })
}

/// Returns the line of a contact, at radii that are evenly spaced along the abscissa.
fn jkr_plot(contact: &Contact) -> Result<Vec<Point>, Error> {
    const POINTS: u32 = 300;
    let point = |i: u32| {
        let a = LARGEST_RADIUS * (f64::from(i) / f64::from(POINTS)).powf(2.0 / 3.0);
        let radius = contact.mechanics().sphere_radius();
        let jkr = JkrPoint::new(a, contact.load(a, WORK_OF_ADHESION)?, radius);
        Ok([jkr.abscissa, jkr.ordinate])
    };
    (1..=POINTS).map(point).collect()
}

/// Draws the lines, each with its film thickness.
///
/// # Errors
/// Those of [`data`].
pub fn figure() -> Result<Figure, Error> {
    let data = data()?;
    let scaled =
        |line: &[Point]| -> Vec<Point> { line.iter().map(|[x, y]| [1e4 * x, *y]).collect() };
    let (sphere, sphere_film) = (scaled(&data.sphere), scaled(&data.sphere_film));
    let end = sphere[sphere.len() - 1][0];
    let x = Axis::linear("a^{3/2} / (√π R)  (10^{−4} m^{1/2})", [0.0, end]);
    let y = Axis::linear("F / (√6π a^{3/2})  (N m^{−3/2})", [-400.0, 650.0]);
    let mut panel =
        Panel::new("Fig. 4: reduced JKR plots for films of 1 to 100 μm", x, y).margin(70);
    for ((line, t), colour) in data
        .films
        .iter()
        .zip(THICKNESSES)
        .zip([BLUE, GREEN, ORANGE, VERMILION, PURPLE])
    {
        // The uppermost label leaves room for the next ones.
        let side = if t == THICKNESSES[0] {
            Side::AboveRight
        } else {
            Side::Right
        };
        panel.named(
            scaled(line),
            colour,
            format!("{:.0} μm", 1e6 * t),
            (1.0, side),
        );
    }
    let at = |line: &[Point], part: f64| line[(part * line.len() as f64) as usize];
    panel.dashed(sphere.clone(), BLACK).label(
        at(&sphere, 0.75),
        "JKR, sphere: no film",
        BLACK,
        Side::AboveLeft,
    );
    panel.dashed(sphere_film.clone(), BLACK).label(
        at(&sphere_film, 0.6),
        "JKR, sphere-film: no substrate",
        BLACK,
        Side::BelowRight,
    );
    Ok(Figure::new(520, [panel]))
}
