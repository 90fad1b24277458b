//! The tiles of a low-rank form: where they meet, and the table of each.

use std::ops::Range;

use interp::{Parameter, Quantity, Table, Tiles};

use crate::Error;
use crate::parallel::try_map;
use crate::table::compress::truncation::truncate;

/// The `E1*/Einf*` where tiles meet: between films softer than sphere and substrate together, and
/// stiffer ones.
const FILM_LIKE_THE_REST: f64 = 1.0;
/// The smallest number of nodes on both sides of a cut. A smaller tile would save nothing.
const LEAST_NODES: usize = 16;

/// Returns a table in low-rank form, with about as few numbers as `error` allows, the largest
/// relative error of the quantities at the nodes.
///
/// # Errors
/// [`Error::Truncation`] where a form that leaves out next to nothing has a larger error;
/// [`Error::Table`] for a low-rank form that needs too much at its first lookup.
pub fn compress(table: &Table, error: f64) -> Result<Tiles, Error> {
    let cuts = cuts(table);
    let [_, film, ..] = table.shape();
    let dense = table.expand()?;
    let tiles: Vec<Table> = Tiles::nodes(&cuts, film)
        .into_iter()
        .map(|nodes| part(&dense, nodes))
        .collect::<Result<_, Error>>()?;
    let forms = try_map(&tiles, |tile| truncate(tile, error))?;
    Ok(Tiles::new(cuts, forms)?)
}

/// Returns the nodes of the film's modulus where the tiles of a table meet.
fn cuts(table: &Table) -> Vec<usize> {
    let nodes = table.axis(Parameter::E1sOverEinfs);
    let cut = nodes.partition_point(|&node| node < FILM_LIKE_THE_REST);
    if cut >= LEAST_NODES && cut + LEAST_NODES <= nodes.len() {
        vec![cut]
    } else {
        Vec::new()
    }
}

/// Returns the table of some nodes of the film's modulus.
fn part(table: &Table, nodes: Range<usize>) -> Result<Table, Error> {
    let [n_a, n_film, n_nu, n_substrate] = table.shape();
    let mut axes = table.axes();
    axes[1].1 = axes[1].1[nodes.clone()].to_vec();
    let width = n_nu * n_substrate;
    let of_part = |values: &[f64]| {
        let slabs = (0..n_a).map(|a| &values[(a * n_film + nodes.start) * width..]);
        slabs
            .flat_map(|slab| &slab[..nodes.len() * width])
            .copied()
            .collect()
    };
    let values = Quantity::ALL.map(|quantity| table.values(quantity).map(of_part));
    Ok(Table::new(table.description().clone(), axes, values)?)
}
