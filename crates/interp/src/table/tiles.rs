//! The tiles of a table in low-rank form: boxes of the moduli of film and substrate, each with a
//! tensor train of its own.
//!
//! A film softer than sphere and substrate makes other contacts than a stiff one. The bonds of a
//! train for both would be as long as those of two trains together, and a lookup would multiply by
//! all of them.

use low_rank::{IntegerTrain, cover_once};
use serde::{Deserialize, Serialize};

use crate::table::axes::Axes;
use crate::table::demand::Demand;
use crate::{Error, Quantity};

/// The largest number of tiles, which limits what the first lookup of a forged table needs.
const MOST_TILES: usize = 16;
/// The largest number of values at the nodes. More are taken for a mistake or a forgery: they would
/// not fit in memory when written out.
const MOST_VALUES: usize = 200_000_000;

/// A box of the moduli of film and substrate, with the logarithms of a table's quantities in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Tile {
    /// The first and the last node of the film's modulus.
    pub film: [usize; 2],
    /// The first and the last node of the substrate's modulus.
    pub substrate: [usize; 2],
    /// The logarithms: `ln(Q/s)` of the quantities `Q` of the table, with the scale `s = es`, or 1 for
    /// `Delta0`, over the [coordinates](crate::Parameter::coordinate) of the axes. The variables 0 to 3
    /// of the train are the axes of the table.
    pub form: IntegerTrain,
}

/// The nodes between which a tile lies, in packed tables, too.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(crate) struct Place {
    /// The first and the last node of the film's modulus.
    pub(crate) film: [usize; 2],
    /// The first and the last node of the substrate's modulus.
    pub(crate) substrate: [usize; 2],
}

impl Place {
    /// Returns the first and the last node of each axis, of an axis of `shape` nodes.
    pub(crate) fn nodes(&self, [n_a, _, n_nu, _]: [usize; 4]) -> [[usize; 2]; 4] {
        [[0, n_a - 1], self.film, [0, n_nu - 1], self.substrate]
    }

    /// Returns the coordinates of the ends of each axis.
    pub(crate) fn ends(&self, axes: &Axes) -> [[f64; 2]; 4] {
        let (parameters, nodes) = (axes.parameters(), self.nodes(axes.shape()));
        std::array::from_fn(|dimension| {
            let parameter = parameters[dimension];
            nodes[dimension].map(|node| parameter.coordinate(axes.nodes(parameter)[node]))
        })
    }
}

impl Tile {
    /// The degree from which the factors of the polynomials fall, for each axis: `a/t`, the modulus of
    /// the film, its Poisson ratio, the modulus of the substrate. The derivative with respect to the
    /// Poisson ratio of nearly incompressible films is the one that errors change most.
    pub const SMOOTH_DEGREES: [f64; 4] = [40.0, 20.0, 2.0, 20.0];

    /// Returns the nodes between which the tile lies.
    pub(crate) fn place(&self) -> Place {
        Place {
            film: self.film,
            substrate: self.substrate,
        }
    }

    /// Returns whether the tile contains the nodes `film` and `substrate` of the moduli.
    fn contains(&self, film: usize, substrate: usize) -> bool {
        let within = |node: usize, [first, last]: [usize; 2]| (first..=last).contains(&node);
        within(film, self.film) && within(substrate, self.substrate)
    }
}

/// Accepts tiles of the logarithms of `quantities` that cover the moduli of `axes` once.
///
/// # Errors
/// [`Error::Malformed`] if there are more than 16 tiles or none, if they overlap or leave a gap; if
/// the quantities are not in order, or hold none of a sphere; if a train is not of so many functions,
/// or has other [smooth degrees](Tile::SMOOTH_DEGREES); if a core has several terms along an axis of one node; or for more
/// than 2e8 values at the nodes. [`Error::LowRankTooLarge`] if the first lookup in all tiles
/// together would need too much, see [`Demand::check`].
pub(crate) fn check(axes: &Axes, quantities: &[Quantity], tiles: &[Tile]) -> Result<(), Error> {
    let malformed = |what: String| Err(Error::Malformed(what));
    let shape = axes.shape();
    let [n_a, n_film, n_nu, n_substrate] = shape;
    if tiles.is_empty() || tiles.len() > MOST_TILES {
        return malformed(format!(
            "it has {} low-rank forms, it must have 1 to {MOST_TILES}",
            tiles.len()
        ));
    }
    if quantities.is_empty() || !quantities.is_sorted_by(|a, b| a < b) {
        return malformed(format!(
            "its low-rank forms hold {quantities:?}: they must hold one quantity of a sphere at least, \
             in order"
        ));
    }
    let misfits = |tile: &&Tile| {
        tile.form.functions() != quantities.len()
            || tile.form.smooth_degrees() != Tile::SMOOTH_DEGREES
    };
    if let Some(Tile { form, .. }) = tiles.iter().find(misfits) {
        return malformed(format!(
            "a low-rank form of it has {} functions of the smooth degrees {:?}: it must have {} of {:?}",
            form.functions(),
            form.smooth_degrees(),
            quantities.len(),
            Tile::SMOOTH_DEGREES
        ));
    }
    let values = [n_a, n_film, n_nu, n_substrate, quantities.len()]
        .into_iter()
        .try_fold(1_usize, usize::checked_mul);
    if values.is_none_or(|values| values > MOST_VALUES) {
        return malformed(format!(
            "it has {shape:?} nodes, more than {MOST_VALUES} values"
        ));
    }
    for tile in tiles {
        let terms = tile.form.variables().into_iter().zip(tile.form.terms());
        for (dimension, terms) in terms {
            if shape[dimension] == 1 && terms > 1 {
                return malformed(format!(
                    "a core of it has {terms} terms along an axis of one node, it must have 1"
                ));
            }
        }
    }
    let places: Vec<_> = tiles
        .iter()
        .map(|tile| [tile.film, tile.substrate])
        .collect();
    if !cover_once(&places, [n_film, n_substrate]) {
        return malformed(format!(
            "its tiles hold the nodes {places:?} of the two moduli: they must cover {n_film} and \
             {n_substrate} nodes once"
        ));
    }
    Demand::of(tiles, shape).check(tiles, shape)
}

/// Returns the logarithms at all nodes with node `film` of the film's modulus, as
/// [`Table::logarithms`](crate::Table::logarithms).
pub(crate) fn logarithms(axes: &Axes, tiles: &[Tile], film: usize) -> Vec<f64> {
    let [n_a, _, n_nu, n_substrate] = axes.shape();
    let width = n_a * tiles[0].form.functions();
    let mut logarithms = vec![0.0; n_nu * n_substrate * width];
    let mut first = 0;
    while first < n_substrate {
        let tile = tiles
            .iter()
            .find(|tile| tile.contains(film, first))
            .expect("the tiles cover the box");
        let last = tile.substrate[1];
        let (parameters, nodes) = (
            axes.parameters(),
            [[0, n_a - 1], [film; 2], [0, n_nu - 1], [first, last]],
        );
        let places: [Vec<f64>; 4] = std::array::from_fn(|dimension| {
            let (parameter, [first, last]) = (parameters[dimension], nodes[dimension]);
            let nodes = &axes.nodes(parameter)[first..=last];
            nodes
                .iter()
                .map(|&value| parameter.coordinate(value))
                .collect()
        });
        let part = tile.form.values(
            tile.place().ends(axes),
            places.each_ref().map(Vec::as_slice),
        );
        let length = (last - first + 1) * width;
        for (nu, rows) in part.chunks_exact(length).enumerate() {
            logarithms[(nu * n_substrate + first) * width..][..length].copy_from_slice(rows);
        }
        first = last + 1;
    }
    logarithms
}

/// Returns the coordinates of the two moduli between which each tile lies. At the ends of the table
/// they are infinite, because a coordinate may be beyond the end by rounding.
pub(crate) fn boxes(axes: &Axes, places: &[Place]) -> Vec<[[f64; 2]; 2]> {
    let [_, n_film, _, n_substrate] = axes.shape();
    let within = |[from, to]: [f64; 2], [first, last]: [usize; 2], count: usize| {
        [
            if first == 0 { f64::NEG_INFINITY } else { from },
            if last + 1 == count { f64::INFINITY } else { to },
        ]
    };
    let ends = |place: &Place| {
        let [_, film, _, substrate] = place.ends(axes);
        [
            within(film, place.film, n_film),
            within(substrate, place.substrate, n_substrate),
        ]
    };
    places.iter().map(ends).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Parameter;

    /// Makes tiles of rank 1 at these nodes.
    fn tiles(places: &[[[usize; 2]; 2]]) -> Vec<Tile> {
        let one = || vec![1];
        let form = IntegerTrain::new(
            1,
            [1, 2, 3],
            Tile::SMOOTH_DEGREES,
            [1; 4],
            std::array::from_fn(|_| vec![0]),
            1.0,
            std::array::from_fn(|_| one()),
        )
        .expect("sound");
        let tile = |&[film, substrate]: &[[usize; 2]; 2]| Tile {
            film,
            substrate,
            form: form.clone(),
        };
        places.iter().map(tile).collect()
    }

    #[test]
    fn at_most_16_tiles_must_cover_the_box_once() {
        let moduli = |count: usize| (0..count).map(|i| 1.5_f64.powi(i as i32)).collect();
        let axes = Axes::new([
            (Parameter::AOverT, vec![0.1, 1.0, 10.0]),
            (Parameter::E1OverE2, moduli(18)),
            (Parameter::Nu1, vec![0.0, 0.5]),
            (Parameter::E0OverE2, moduli(4)),
        ])
        .expect("sound");
        let check = |places: &[[[usize; 2]; 2]]| check(&axes, &[Quantity::Gamma], &tiles(places));
        assert!(check(&[[[0, 2], [0, 3]], [[2, 17], [0, 3]]]).is_ok());
        let of_one_interval: Vec<_> = (0..17).map(|i| [[i, i + 1], [0, 3]]).collect();
        let overlapping = [[[0, 3], [0, 3]], [[2, 17], [0, 3]]];
        for places in [&[][..], &overlapping, &of_one_interval] {
            let result = check(places);
            assert!(matches!(result, Err(Error::Malformed(_))), "{places:?}");
        }
    }
}
