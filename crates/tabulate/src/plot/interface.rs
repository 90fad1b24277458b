//! The load of a film that is bonded to a rigid base, joined to it by springs, or slides on it,
//! against `a/t`: an incompressible film under a rigid sphere, where the interface matters most.

use interp::{Elastic, Quantity};

use super::paper::spaced;
use crate::Error;
use figures::axis::Axis;
use figures::chart::{BLACK, BLUE, Colour, Figure, GREEN, ORANGE, Panel, Point, Side, VERMILION};
use solve::parallel::try_map;
use solve::stack::{Interface, Layer, Stack};
use solve::stack_curve;

/// The ends of `a/t`, the number of points on each line, and the relative tolerance.
const A_OVER_T: [f64; 2] = [0.03, 30.0];
const POINTS: usize = 121;
const TOLERANCE: f64 = 1e-6;

/// Springs of a tangential stiffness in units of `E1*/t`.
const fn springs(tangential: f64) -> Interface {
    Interface::Springs {
        tangential,
        normal: f64::INFINITY,
    }
}

/// The names, interfaces and colours of the lines, from the stiffest to the softest.
const LINES: [(&str, Interface, Colour); 5] = [
    ("bonded", Interface::Bonded, BLACK),
    ("springs, k_{t} t/E_{1}* = 1", springs(1.0), BLUE),
    ("0.1", springs(0.1), GREEN),
    ("0.01", springs(0.01), ORANGE),
    ("sliding", Interface::Sliding, VERMILION),
];

/// Computes `a/t` and `Pi0` of each line, from the bonded film to the sliding one.
///
/// # Errors
/// Those of [`stack_curve`]; none for these films.
pub fn data() -> Result<Vec<Vec<Point>>, Error> {
    // A film of `E1* = 1` and thickness 1.
    let film = Elastic::new(0.75, 0.5)?;
    let base = Elastic::new(f64::INFINITY, 0.0)?;
    try_map(LINES, |(_, interface, _)| {
        let layer = Layer {
            interface,
            ..Layer::bonded(film, 1.0)
        };
        let stack = Stack::new(base, [layer])?;
        let curve = stack_curve(&stack, f64::INFINITY, A_OVER_T, TOLERANCE)?;
        let point = |x| Ok([x, curve.quantity(Quantity::Pi0, x)?]);
        spaced(A_OVER_T, POINTS)
            .map(point)
            .collect::<Result<Vec<Point>, Error>>()
    })
}

/// Draws the lines.
///
/// # Errors
/// Those of [`data`].
pub fn figure() -> Result<Figure, Error> {
    let lines = data()?;
    let mut panel = Panel::new(
        "Incompressible film on a rigid base under a rigid sphere, without adhesion",
        // Names stand to the right of the lines.
        Axis::logarithmic(
            "contact radius / film thickness, a/t",
            [A_OVER_T[0], 10.0 * A_OVER_T[1]],
        ),
        Axis::logarithmic("load, 2 R F/(E_{1}* a³)", [1.0, 3e3]),
    );
    panel.horizontal_guide(8.0 / 3.0, "Hertz, thick film: 8/3", Side::Left);
    for (points, (name, _, colour)) in lines.into_iter().zip(LINES) {
        panel.named(points, colour, name, (1.0, Side::Right));
    }
    Ok(Figure::new(460, [panel]))
}
