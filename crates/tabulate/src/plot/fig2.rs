//! Fig. 2 of the paper: the adhesionless load `Pi0` against `a/t` for the material of Table 1,
//! between its two limits.

use interp::Quantity;

use super::paper;
use crate::Error;
use figures::axis::Axis;
use figures::chart::{BLUE, Figure, Panel, Side};

/// Draws the load between its limits: the sphere on a half-space of film, and on the bare substrate.
///
/// # Errors
/// Those of [`paper::line`].
pub fn figure() -> Result<Figure, Error> {
    let (pi0, [film, substrate]) = paper::line(Quantity::Pi0)?;
    let x = Axis::logarithmic("contact radius / film thickness, a/t", paper::A_OVER_T);
    let y = Axis::linear(
        "normalised load Π_{0} = 2RF_{0} / (a^{3}E_{2}*)",
        [1.8, 2.8],
    );
    let mut panel = Panel::new(
        "Fig. 2: adhesionless load of a sphere on a coated substrate",
        x,
        y,
    );
    panel
        .horizontal_guide(
            film,
            format!("sphere on film alone: (8/3) E_{{s}}*/E_{{2}}* = {film:.3}"),
            Side::Right,
        )
        .horizontal_guide(
            substrate,
            format!("sphere on substrate alone: 8/3 = {substrate:.3}"),
            Side::Left,
        )
        .named(pi0, BLUE, "Π_{0}", (0.55, Side::AboveLeft));
    Ok(Figure::new(440, [panel]))
}
