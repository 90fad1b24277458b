//! Load against penetration for the paper's system with films of several thicknesses, with imposed
//! penetration and with imposed load. Arrows are the jumps at the ends of stability.

use interp::{Control, ForceDisplacement, State};

use super::axis::Axis;
use super::chart::{BLUE, Figure, GREEN, GREY, Panel, Point, Side, VERMILION};
use super::paper::{self, WORK_OF_ADHESION};
use crate::Error;

/// The film thicknesses, m.
pub const THICKNESSES: [f64; 3] = [1e-6, 30e-6, 300e-6];

/// The largest imposed penetration, m, and the largest imposed load, N.
const FARTHEST: [f64; 2] = [5e-6, 0.4e-3];

/// The number of states on each branch.
const POINTS: usize = 200;

/// The data of one film.
#[derive(Clone, Debug)]
pub struct Film {
    /// The thickness, m.
    pub thickness: f64,
    /// The curve with imposed penetration.
    pub displacement: ForceDisplacement,
    /// The curve with imposed load.
    pub load: ForceDisplacement,
}

/// Computes the data from direct solves, for each of [`THICKNESSES`].
///
/// # Errors
/// Those of [`crate::solve::curve`].
pub fn data() -> Result<Vec<Film>, Error> {
    let film = |&thickness: &f64| {
        let contact = paper::contact(thickness)?;
        let course = |control, most| {
            contact
                .equilibria(WORK_OF_ADHESION, control)?
                .force_displacement(most, POINTS)
        };
        let [deepest, heaviest] = FARTHEST;
        Ok(Film {
            thickness,
            displacement: course(Control::Displacement, deepest)?,
            load: course(Control::Load, heaviest)?,
        })
    };
    THICKNESSES.iter().map(film).collect()
}

/// Draws imposed penetration on the left and imposed load on the right.
pub fn figure(films: &[Film]) -> Figure {
    let mut penetration = panel("Imposed penetration", films, |film| &film.displacement);
    penetration
        .label([0.0, 0.0], "touch", GREY, Side::AboveRight)
        .label([-1.45, -0.05], "separation", GREY, Side::Left);
    let mut load = panel("Imposed load", films, |film| &film.load);
    load.label([0.7, 0.0], "touch", GREY, Side::Above).label(
        [-2.4, -0.19],
        "separation",
        GREY,
        Side::Above,
    );
    Figure::new(460, [penetration, load])
}

/// The ends of the axis of penetration, um.
const PENETRATIONS: [f64; 2] = [-4.0, 5.0];

fn panel(title: &str, films: &[Film], course: fn(&Film) -> &ForceDisplacement) -> Panel {
    let mut panel = Panel::new(
        title,
        Axis::linear("penetration (μm)", PENETRATIONS),
        Axis::linear("load (mN)", [-0.25, 0.4]),
    );
    panel
        .line([[PENETRATIONS[0], 0.0], [0.0, 0.0]], GREY)
        .label([-2.5, 0.0], "no contact", GREY, Side::Above);
    for (film, (colour, side)) in films.iter().zip([
        (BLUE, Side::Left),
        (GREEN, Side::Below),
        (VERMILION, Side::Right),
    ]) {
        let course = course(film);
        let branches = course.loading.iter().chain(&course.unloading);
        for branch in branches.clone() {
            panel.line(branch.iter().map(point).collect::<Vec<_>>(), colour);
        }
        for jump in &course.jumps {
            // After a separation without equilibrium the arrow leads to the edge of the figure.
            let gone = [PENETRATIONS[0], point(&jump.from)[1]];
            panel.arrow(
                point(&jump.from),
                jump.to.as_ref().map_or(gone, point),
                colour,
            );
        }
        // The label is beside the curve above zero load, or below its lowest point.
        let height = |state: &State| {
            if side == Side::Below {
                state.load
            } else {
                (state.load - 0.06e-3).abs()
            }
        };
        let named = branches
            .flatten()
            .min_by(|a, b| height(a).total_cmp(&height(b)));
        if let Some(state) = named {
            panel.label(
                point(state),
                format!("{:.0} μm film", 1e6 * film.thickness),
                colour,
                side,
            );
        }
    }
    panel
}

/// Returns penetration in um and load in mN.
fn point(state: &State) -> Point {
    [1e6 * state.penetration, 1e3 * state.load]
}
