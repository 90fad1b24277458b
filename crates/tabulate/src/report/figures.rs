//! The pictures in a report: what can be drawn of any table, and the paper's figures where they are
//! its subject.

use interp::Table;

use crate::Error;
use crate::plot::chart::Figure;
use crate::plot::{error_map, fig2, fig3, fig4, paper};

/// A figure of a report, and what is said below it.
#[derive(Debug)]
pub struct Illustration {
    /// What there is to see, a sentence or two.
    pub caption: &'static str,
    /// The figure.
    pub figure: Figure,
}

/// How many steps [`figures()`] takes for a table, of which it tells its progress.
pub fn steps(table: &Table) -> usize {
    if error_map::fixed(table).is_none() {
        error_map::CELLS.iter().product()
    } else {
        0
    }
}

/// The figures for a table: its error map, unless it fixes `a_over_t` or `e1_over_e2`; Figs. 2 to 4
/// of the paper, if it covers the paper's material. They take direct solves, a second or some ten
/// seconds.
///
/// # Errors
/// Those of the solve.
pub fn figures(
    table: &Table,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Vec<Illustration>, Error> {
    let mut figures = Vec::new();
    if error_map::fixed(table).is_none() {
        let figure = error_map::figure(&error_map::data(table, progress)?);
        let caption = "The largest relative error of any quantity against direct solves at random points, over a/t and E₁/E₂*, \
                       whatever the other parameters.";
        figures.push(Illustration { caption, figure });
    }
    if table.curve(&paper::system(1e-6)?.material()?).is_ok() {
        let paper = [
            (
                fig2::figure(&fig2::data()?),
                "The adhesionless load of the paper’s system, from direct solves.",
            ),
            (
                fig3::figure(&fig3::data()?),
                "The contact stiffness and the edge singularity of the paper’s system, from direct solves.",
            ),
            (
                fig4::figure(&fig4::data()?),
                "JKR plots of the paper’s system with films of several thicknesses, from direct solves.",
            ),
        ];
        figures.extend(paper.map(|(figure, caption)| Illustration { caption, figure }));
    }
    Ok(figures)
}
