//! Fig. 2 of the paper: the adhesionless load `Pi0` against `a/t` for the material of Table 1,
//! between its two limits.

use interp::Quantity;

use super::paper;
use crate::Error;
use figures::axis::Axis;
use figures::chart::{BLUE, Figure, Panel, Point, Side};

/// The data of the figure.
#[derive(Clone, Debug)]
pub struct Data {
    /// `a/t` and `Pi0`.
    pub pi0: Vec<Point>,
    /// `8/3 es` and `8/3 einf`: the sphere on a half-space of film, and on the bare substrate.
    pub limits: [f64; 2],
}

/// Computes the data from direct solves.
///
/// # Errors
/// Those of [`solve::curve`].
pub fn data() -> Result<Data, Error> {
    let curve = paper::quantities()?;
    let point = |a_over_t| Ok([a_over_t, curve.quantity(Quantity::Pi0, a_over_t)?]);
    let material = curve.material();
    let limits = [
        material.thick_film_limit().pi0,
        material.thin_film_limit().pi0,
    ];
    Ok(Data {
        pi0: paper::spaced(paper::A_OVER_T, 301)
            .map(point)
            .collect::<Result<_, Error>>()?,
        limits,
    })
}

/// Draws the load between its limits.
///
/// # Errors
/// Those of [`data`].
pub fn figure() -> Result<Figure, Error> {
    let data = data()?;
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
    let [film, substrate] = data.limits;
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
        .named(data.pi0, BLUE, "Π_{0}", (0.55, Side::AboveLeft));
    Ok(Figure::new(440, [panel]))
}
