//! The numbers with which the page computes: the table as tensor trains of integers, as few as its
//! pictures need.

use figures::page::list;
use interp::{Parameter, Quantity, Table, Tile};
use low_rank::coarser;

use crate::Error;
use crate::table::{compress, random_points};

/// The largest relative difference, at random points, between a quantity that the page knows and that
/// of the table in low-rank form.
const DIFFERENCE: f64 = 5e-5;
/// The error of a dense table's low-rank form at its nodes. Between the nodes it is larger.
const TRUNCATION: f64 = 5e-6;
/// The binary logarithm of the largest factor by which the integers of a table become smaller.
const LARGEST_FACTOR: u32 = 12;
/// The number of random points at which the two forms are compared.
pub const COMPARED: usize = 2000;
/// The seed of these points.
const SEED: u64 = 1;
/// The largest first a/t at which the page begins its integrals of `Gamma`. The error of their
/// beginning is at most `4 (a/t)^5`.
const LARGEST_FIRST: f64 = 0.1;

/// The table as the page knows it.
#[derive(Debug)]
pub struct Coarse {
    /// The table with fewer integers.
    pub table: Table,
    /// The largest relative difference of a quantity, at random points.
    pub difference: f64,
}

/// Returns the quantities with which the page computes, held or derived.
pub fn quantities(table: &Table) -> Vec<Quantity> {
    let first = table.axis(Parameter::AOverT)[0];
    if first <= LARGEST_FIRST {
        table.answers()
    } else {
        table.quantities()
    }
}

/// Returns the table in as few integers as pictures need.
///
/// # Errors
/// Those of [`compress`] and of the lookup.
pub fn coarse(table: &Table) -> Result<Coarse, Error> {
    // The page derives all quantities, also where the table with its own tolerance does not.
    let mut description = table.description().clone();
    description.tolerance = description.tolerance.max(1e-2);
    let of_tiles = |tiles: Vec<Tile>| -> Result<Coarse, Error> {
        let coarse =
            Table::from_low_rank(description.clone(), table.axes(), table.quantities(), tiles)?;
        let difference = largest_difference(table, &coarse)?;
        Ok(Coarse {
            table: coarse,
            difference,
        })
    };
    let Some(tiles) = table.low_rank() else {
        return of_tiles(compress(table, TRUNCATION)?);
    };
    for exponent in (1..=LARGEST_FACTOR).rev() {
        let coarser = |tile: &Tile| {
            let form = coarser(&tile.form, 1 << exponent)?;
            Ok(Tile { form, ..*tile })
        };
        let tiles: Result<Vec<Tile>, low_rank::Malformed> = tiles.iter().map(coarser).collect();
        let Ok(tiles) = tiles else { continue };
        let coarse = of_tiles(tiles)?;
        if coarse.difference < DIFFERENCE {
            return Ok(coarse);
        }
    }
    of_tiles(tiles.to_vec())
}

/// Returns the largest relative difference of the quantities of two tables, held or derived, at
/// random points of their box.
fn largest_difference(table: &Table, other: &Table) -> Result<f64, Error> {
    let mut largest = 0.0_f64;
    for (x, material) in random_points(table, COMPARED, SEED) {
        let curves = [table.curve(&material)?, other.curve(&material)?];
        for quantity in Quantity::ALL {
            if let [Ok(value), Ok(other)] =
                curves.each_ref().map(|curve| curve.quantity(quantity, x))
            {
                largest = largest.max((other / value - 1.0).abs());
            }
        }
    }
    Ok(largest)
}

/// Returns the trains of a table as entries of an object of JavaScript: for each core, where it begins among
/// the [`integers`].
pub fn script(table: &Table) -> String {
    let mut begins = 0;
    let train = |tile: &Tile| {
        let form = &tile.form;
        let cores = form.variables().into_iter().zip(form.shapes());
        let core = |(axis, [before, terms, after]): (usize, [usize; 3])| {
            let core =
                format!("{{ axis: {axis}, terms: {terms}, after: {after}, begins: {begins} }}");
            begins += before * terms * after;
            core
        };
        let cores: Vec<String> = cores.map(core).collect();
        let weights = form.exponents().each_ref().map(|exponents| {
            let weights: Vec<f64> = exponents.iter().map(|&e| f64::from(e).exp2()).collect();
            list(&weights)
        });
        format!(
            "{{ step: {:?}, ends: [{}],\nweights: [{}],\ncores: [{}] }}",
            form.step(),
            table.ends(tile).map(|ends| list(&ends)).join(", "),
            weights.join(", "),
            cores.join(", ")
        )
    };
    let trains: Vec<String> = table.low_rank().into_iter().flatten().map(train).collect();
    let range = table.axis(Parameter::AOverT);
    let (held, answers) = (table.quantities(), quantities(table));
    format!(
        "range: {}, held: {:?}, penetrates: {}, derives: {}, smoothDegrees: {},\ntrains: [{}]",
        list(&[range[0], range[range.len() - 1]]),
        held.iter().map(|q| q.name()).collect::<Vec<_>>(),
        answers.contains(&Quantity::Delta0),
        held != answers,
        list(&Tile::SMOOTH_DEGREES),
        trains.join(",\n")
    )
}

/// Returns the integers of the trains, separated by commas, with nothing in place of a zero.
pub fn integers(table: &Table) -> String {
    let cores = table
        .low_rank()
        .into_iter()
        .flatten()
        .flat_map(|tile| tile.form.cores());
    let integers = cores.flatten().map(|&n| match n {
        0 => String::new(),
        n => n.to_string(),
    });
    integers.collect::<Vec<_>>().join(",")
}
