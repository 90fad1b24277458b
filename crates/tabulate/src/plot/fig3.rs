//! Fig. 3 of the paper: the contact stiffness `Eeq` and the edge singularity `Gamma` against `a/t`
//! for the material of Table 1.

use interp::Quantity;

use super::paper;
use crate::Error;
use figures::axis::Axis;
use figures::chart::{BLUE, Figure, Panel, Point, Side, VERMILION};

/// The data of the figure.
#[derive(Clone, Debug)]
pub struct Data {
    /// `a/t` and `Eeq`.
    pub eeq: Vec<Point>,
    /// `a/t` and `Gamma`.
    pub gamma: Vec<Point>,
    /// The limits `es` of both on a thick film, `sqrt(es einf)` of `Gamma` on a thin film, and
    /// `einf` of `Eeq` on a thin film.
    pub limits: [f64; 3],
}

/// Computes the data from direct solves.
///
/// # Errors
/// Those of [`solve::curve`].
pub fn data() -> Result<Data, Error> {
    let curve = paper::quantities()?;
    let line = |quantity| {
        paper::spaced(paper::A_OVER_T, 301)
            .map(|x| Ok([x, curve.quantity(quantity, x)?]))
            .collect::<Result<_, Error>>()
    };
    let (thick, thin) = (
        curve.material().thick_film_limit(),
        curve.material().thin_film_limit(),
    );
    Ok(Data {
        eeq: line(Quantity::Eeq)?,
        gamma: line(Quantity::Gamma)?,
        limits: [thick.eeq, thin.gamma, thin.eeq],
    })
}

/// Draws both quantities between their limits.
///
/// # Errors
/// Those of [`data`].
pub fn figure() -> Result<Figure, Error> {
    let data = data()?;
    let x = Axis::logarithmic("contact radius / film thickness, a/t", paper::A_OVER_T);
    let y = Axis::linear("normalised by E_{2}*", [0.65, 1.05]);
    let mut panel = Panel::new(
        "Fig. 3: stiffness and edge singularity of the contact",
        x,
        y,
    );
    let [film, edge, substrate] = data.limits;
    panel
        .horizontal_guide(
            film,
            format!("sphere on film alone: E_{{s}}*/E_{{2}}* = {film:.1}"),
            Side::Right,
        )
        .horizontal_guide(
            edge,
            format!("edge on a thin film: √{film:.1} = {edge:.3}"),
            Side::Left,
        )
        .horizontal_guide(
            substrate,
            format!("sphere on substrate alone: {substrate:.0}"),
            Side::Left,
        )
        .named(
            data.eeq,
            BLUE,
            "E_{eq}, contact stiffness",
            (0.55, Side::AboveLeft),
        )
        .named(
            data.gamma,
            VERMILION,
            "Γ, edge singularity",
            (0.55, Side::BelowRight),
        );
    Ok(Figure::new(440, [panel]))
}
