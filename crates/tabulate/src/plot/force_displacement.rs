//! Load against penetration for the paper's system with films of several thicknesses: the course with imposed penetration and with
//! imposed load, with the jumps where stability ends.

use interp::{Control, ForceDisplacement, State};

use super::axis::Axis;
use super::chart::{BLUE, Figure, GREEN, GREY, Panel, Point, Side, VERMILION};
use super::paper::{self, WORK_OF_ADHESION};
use crate::Error;

/// The film thicknesses, m.
pub const THICKNESSES: [f64; 3] = [1e-6, 30e-6, 300e-6];

/// How far the sphere is pushed in the figure: penetration in m, load in N.
const FARTHEST: [f64; 2] = [5e-6, 0.4e-3];

/// States on each branch.
const POINTS: usize = 200;

/// What is drawn for one film.
#[derive(Clone, Debug)]
pub struct Film {
    /// m.
    pub thickness: f64,
    /// With imposed penetration.
    pub displacement: ForceDisplacement,
    /// With imposed load.
    pub load: ForceDisplacement,
}

/// From direct solves, for each of [`THICKNESSES`].
///
/// # Errors
/// Those of [`crate::curve::curve`].
pub fn data() -> Result<Vec<Film>, Error> {
    let film = |&thickness: &f64| {
        let contact = paper::contact(thickness)?;
        let course = |control, most| contact.equilibria(WORK_OF_ADHESION, control)?.force_displacement(most, POINTS);
        let [deepest, heaviest] = FARTHEST;
        Ok(Film { thickness, displacement: course(Control::Displacement, deepest)?, load: course(Control::Load, heaviest)? })
    };
    THICKNESSES.iter().map(film).collect()
}

/// Draws it.
pub fn figure(films: &[Film]) -> Figure {
    let penetration = panel("Imposed penetration", films, |film| &film.displacement);
    let load = panel("Imposed load", films, |film| &film.load);
    Figure::new(460, [penetration, load])
}

fn panel(title: &str, films: &[Film], course: fn(&Film) -> &ForceDisplacement) -> Panel {
    const X: [f64; 2] = [-4.0, 5.0];
    let mut panel = Panel::new(title, Axis::linear("penetration (μm)", X), Axis::linear("load (mN)", [-0.25, 0.4]));
    panel.line([[X[0], 0.0], [0.0, 0.0]], GREY);
    for (film, colour) in films.iter().zip([BLUE, GREEN, VERMILION]) {
        let course = course(film);
        for branch in course.loading.iter().chain(&course.unloading) {
            panel.line(branch.iter().map(point).collect::<Vec<_>>(), colour);
        }
        for jump in &course.jumps {
            // Where it leaves for good, the sphere leaves the figure, too.
            let gone = [X[0], point(&jump.from)[1]];
            panel.arrow(point(&jump.from), jump.to.as_ref().map_or(gone, point), colour);
        }
        if let Some(end) = course.loading.last().and_then(|branch| branch.last()) {
            panel.label(point(end), format!("{:.0} μm", 1e6 * film.thickness), colour, Side::Left);
        }
    }
    panel
}

/// Penetration in um and load in mN.
fn point(state: &State) -> Point {
    [1e6 * state.penetration, 1e3 * state.load]
}
