//! The figures in a report: the error map of the table, and the paper's figures if the table covers
//! the paper's material.

use figures::page::Illustration;
use interp::Table;

use crate::Error;
use crate::plot::{error_map, fig2, fig3, fig4, paper};

/// Returns the number of steps that [`figures()`] reports to its `progress`.
pub fn steps(table: &Table) -> usize {
    if error_map::is_possible(table) {
        error_map::CELLS.iter().product()
    } else {
        0
    }
}

/// Draws the figures for a table: its error map, if the table has ranges of `a_over_t` and
/// `e1_over_e2`;
/// Figs. 2 to 4 of the paper, if the table covers the paper's material.
///
/// The figures take direct solves: 1 to 10 s for the error map. `progress` is called with the
/// number of cells done.
///
/// # Errors
/// Those of the solve; [`interp::Error::OfStack`] for a table of a stack of layers, of which there
/// is no page.
pub fn figures(
    table: &Table,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Vec<Illustration>, Error> {
    if table.is_of_stack() {
        return Err(interp::Error::OfStack.into());
    }
    let mut figures = Vec::new();
    if error_map::is_possible(table) {
        let figure = error_map::figure(&error_map::data(table, progress)?);
        let caption = "The largest relative error of any quantity against direct solves, over a/t and E₁/E₂*. \
                       Each cell shows the worst of many random points.";
        figures.push(Illustration { caption, figure });
    }
    if table.curve(&paper::system(1e-6)?.material()?).is_ok() {
        let paper = [
            (
                fig2::figure()?,
                "Fig. 2 of the paper: the adhesionless load, from direct solves.",
            ),
            (
                fig3::figure()?,
                "Fig. 3 of the paper: the contact stiffness and the edge singularity, from direct solves.",
            ),
            (
                fig4::figure()?,
                "Fig. 4 of the paper: JKR plots for films of several thicknesses, from direct solves.",
            ),
        ];
        figures.extend(paper.map(|(figure, caption)| Illustration { caption, figure }));
    }
    Ok(figures)
}
