//! The pull-off load against Tabor's parameter, from DMT (a long range of the attraction) to JKR (a
//! short one): on a half-space, on the paper's film, and on a confined incompressible film.

use std::f64::consts::PI;

use contact::Control;
use interp::Elastic;

use super::paper::spaced;
use crate::Error;
use figures::axis::Axis;
use figures::chart::{BLUE, Figure, GREEN, Panel, Point, Side, VERMILION};
use solve::cohesive::Cohesive;
use solve::parallel::try_map;
use solve::stack::{Layer, Stack};

/// The ends of Tabor's parameter, and the number of points on each line.
const TABOR: [f64; 2] = [0.05, 10.0];
const POINTS: usize = 65;

/// The bodies of a line. Lengths in units of the film's thickness, moduli in units of 1 MPa.
struct Bodies {
    young: f64,
    poisson: f64,
    base: f64,
    sphere: f64,
    sphere_radius: f64,
    work_of_adhesion: f64,
}

/// The names and the bodies of the lines.
const LINES: [(&str, Bodies); 3] = [
    (
        "half-space",
        Bodies {
            young: 1.0,
            poisson: 0.0,
            base: 1.0,
            sphere: f64::INFINITY,
            sphere_radius: 1.0,
            work_of_adhesion: 1e-6,
        },
    ),
    (
        "the paper's film, R/t = 100",
        Bodies {
            young: 1.75,
            poisson: 0.5,
            base: 1e5,
            sphere: 1.0,
            sphere_radius: 100.0,
            work_of_adhesion: 2e-3,
        },
    ),
    (
        "rigid sphere, incompressible film on a rigid base, R/t = 100",
        Bodies {
            young: 0.75,
            poisson: 0.5,
            base: f64::INFINITY,
            sphere: f64::INFINITY,
            sphere_radius: 100.0,
            work_of_adhesion: 1e-2,
        },
    ),
];

/// The units of length (m) and modulus (Pa) of [`Bodies`].
const LENGTH: f64 = 1e-6;
const MODULUS: f64 = 1e6;

/// Computes Tabor's parameter and the pull-off load over `pi w R` for each line.
fn data() -> Result<Vec<Vec<Point>>, Error> {
    let points = LINES
        .iter()
        .flat_map(|(_, bodies)| spaced(TABOR, POINTS).map(move |tabor| (bodies, tabor)));
    let points = try_map(points.collect::<Vec<_>>(), |(bodies, tabor)| {
        bodies.point(tabor)
    })?;
    Ok(points.chunks_exact(POINTS).map(<[Point]>::to_vec).collect())
}

impl Bodies {
    fn point(&self, tabor: f64) -> Result<Point, Error> {
        let film = Elastic::new(self.young * MODULUS, self.poisson)?;
        let base = Elastic::new(self.base * MODULUS, self.poisson)?;
        let layer = Layer::bonded(film, LENGTH);
        let stack = Stack::new(base, [layer])?;
        let sphere = self.sphere * MODULUS;
        let (radius, w) = (
            self.sphere_radius * LENGTH,
            self.work_of_adhesion * MODULUS * LENGTH,
        );
        let es = 1.0 / (1.0 / film.reduced() + 1.0 / sphere);
        let range = (radius * (w / es).powi(2)).cbrt() / tabor;
        let cohesive = Cohesive::new(&stack.system(radius, sphere), Some(&stack), w, range)?;
        let load = cohesive.pull_off(Control::Load)?.load;
        Ok([tabor, load / (PI * w * radius)])
    }
}

/// Draws the three lines.
pub fn figure() -> Result<Figure, Error> {
    let lines = data()?;
    let mut panel = Panel::new(
        "Pull-off load and range of the attraction (Dugdale's law)",
        Axis::logarithmic(
            "Tabor's parameter μ = (R w² / (E_{s}*² h_{0}³))^{1/3}",
            TABOR,
        ),
        Axis::linear("pull-off load / (π w R)", [-2.6, -1.2]),
    );
    panel
        .horizontal_guide(-2.0, "DMT, every film", Side::Left)
        .horizontal_guide(-1.5, "JKR, half-space", Side::Left);
    for (((name, _), points), (colour, place)) in LINES.iter().zip(lines).zip([
        (BLUE, (0.55, Side::AboveLeft)),
        (GREEN, (0.42, Side::Below)),
        (VERMILION, (0.3, Side::Below)),
    ]) {
        panel.named(points, colour, *name, place);
    }
    Ok(Figure::new(460, [panel]))
}
