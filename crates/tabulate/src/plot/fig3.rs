//! Fig. 3 of the paper: the contact stiffness `Eeq` and the edge singularity `Gamma` against `a/t`
//! for the material of Table 1.

use interp::Quantity;

use super::paper;
use crate::Error;
use figures::axis::Axis;
use figures::chart::{BLUE, Figure, Panel, Side, VERMILION};

/// Draws both quantities between their limits: `es` of both on a thick film, and on a thin film `einf` and
/// `sqrt(es einf)`.
///
/// # Errors
/// Those of [`paper::line`].
pub fn figure() -> Result<Figure, Error> {
    let (eeq, [film, substrate]) = paper::line(Quantity::Eeq)?;
    let (gamma, [_, edge]) = paper::line(Quantity::Gamma)?;
    let x = Axis::logarithmic("contact radius / film thickness, a/t", paper::A_OVER_T);
    let y = Axis::linear("normalised by E_{2}*", [0.65, 1.05]);
    let mut panel = Panel::new(
        "Fig. 3: stiffness and edge singularity of the contact",
        x,
        y,
    );
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
            eeq,
            BLUE,
            "E_{eq}, contact stiffness",
            (0.55, Side::AboveLeft),
        )
        .named(
            gamma,
            VERMILION,
            "Γ, edge singularity",
            (0.55, Side::BelowRight),
        );
    Ok(Figure::new(440, [panel]))
}
