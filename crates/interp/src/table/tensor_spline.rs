//! The tensor spline of a table: from its coefficients to those of the splines of one material over
//! `ln(a/t)`.

use std::array;
use std::sync::Arc;

use low_rank::once::Once;
use low_rank::{PreparedTrain, Vectors, WeightedSum, add_rows};
use piecewise::bspline::{Basis, LARGEST_DEGREE, Weights};

use crate::Parameter;
use crate::table::axes::Axes;
use crate::table::stored_tiles::StoredTiles;
use crate::table::tiles;

/// The tensor B-spline of a table.
///
/// It interpolates `ln(Pi0/es)`, `ln(Eeq/es)`, `ln(Gamma/es)` and `ln Delta0` over the
/// [coordinates](Parameter::coordinate) of the axes.
#[derive(Clone, Debug)]
pub(crate) struct TensorSpline {
    /// The B-splines of the three material axes, in their order.
    bases: [Basis; 3],
    /// The B-splines of `a_over_t`.
    pub(crate) a_over_t_basis: Basis,
    form: Form,
}

/// The coefficients in one of two forms.
#[derive(Clone, Debug)]
enum Form {
    /// A row for each combination of the B-splines of the material axes, `e1_over_e2` slowest: a
    /// group of the quantities held for each B-spline of `a_over_t`.
    Dense(Vec<f64>),
    Tiles(Trains),
}

/// A train for each tile, prepared at the first lookup in the tile.
#[derive(Clone, Debug)]
struct Trains {
    tiles: Arc<StoredTiles>,
    prepared: Vec<Once<PreparedTrain>>,
    /// The ends of each tile in the coordinates of the moduli of film and substrate.
    boxes: Vec<[[f64; 2]; 2]>,
    /// The ends of each tile in the coordinates of all axes.
    ends: Vec<[[f64; 2]; 4]>,
    /// The coordinates of the nodes of `a/t`.
    a_over_t: Vec<f64>,
    /// The tolerance of the table.
    tolerance: f64,
}

impl TensorSpline {
    /// Makes the spline of a low-rank form, accurate enough for `tolerance`.
    pub(crate) fn of_low_rank(axes: &Axes, tiles: &Arc<StoredTiles>, tolerance: f64) -> Self {
        let (bases, a_over_t_basis) = bases(axes);
        let places = tiles.places();
        let a_over_t = axes.nodes(Parameter::AOverT).iter();
        let form = Form::Tiles(Trains {
            tiles: Arc::clone(tiles),
            prepared: vec![Once::new(); places.len()],
            boxes: tiles::boxes(axes, &places),
            ends: places.iter().map(|place| place.ends(axes)).collect(),
            a_over_t: a_over_t
                .map(|&value| Parameter::AOverT.coordinate(value))
                .collect(),
            tolerance,
        });
        Self {
            bases,
            a_over_t_basis,
            form,
        }
    }

    /// Makes the spline through `logarithms` at the nodes, which become the coefficients in place.
    ///
    /// They are row-major over `e1_over_e2`, `nu1`, `e0_over_e2`, `a_over_t` and the quantities: a
    /// curve is then a sum of whole rows.
    pub(crate) fn through(axes: &Axes, mut logarithms: Vec<f64>) -> Self {
        let (bases, a_over_t_basis) = bases(axes);
        let [n_a, n_e1, n_nu, n_e0] = axes.shape();
        let width = logarithms.len() / (n_e1 * n_nu * n_e0);
        bases[0].interpolate(&mut logarithms, n_nu * n_e0 * width);
        for slab in logarithms.chunks_exact_mut(n_nu * n_e0 * width) {
            bases[1].interpolate(slab, n_e0 * width);
            slab.chunks_exact_mut(n_e0 * width)
                .for_each(|slab| bases[2].interpolate(slab, width));
        }
        logarithms
            .chunks_exact_mut(width)
            .for_each(|row| a_over_t_basis.interpolate(row, width / n_a));
        Self {
            bases,
            a_over_t_basis,
            form: Form::Dense(logarithms),
        }
    }

    /// Evaluates the B-splines of the material axes.
    fn weights(&self, coordinates: [f64; 3]) -> [Weights; 3] {
        array::from_fn(|axis| self.bases[axis].weights(coordinates[axis]))
    }

    /// Returns the coefficients over `ln(a/t)` of the material at `coordinates`: a group of the
    /// quantities held for each B-spline.
    pub(crate) fn coefficients(&self, coordinates: [f64; 3]) -> Vec<f64> {
        match &self.form {
            Form::Tiles(trains) => {
                let train = trains.of(coordinates, &self.a_over_t_basis);
                train.coefficients(coordinates)
            }
            Form::Dense(rows) => {
                let [sum] = self.sums(rows, &self.weights(coordinates), [[false; 3]]);
                sum
            }
        }
    }

    /// Replaces the columns of `coefficients` that `sums` name by weighted sums of the coefficients
    /// of materials that differ in one coordinate, the number `axis`, which has the values `places`.
    pub(crate) fn sums_along<const N: usize>(
        &self,
        coordinates: [f64; 3],
        axis: usize,
        places: &[f64],
        sums: &[WeightedSum<N>],
        coefficients: &mut [f64],
    ) {
        match &self.form {
            Form::Tiles(trains) => {
                let train = trains.of(coordinates, &self.a_over_t_basis);
                train.sums_along(coordinates, axis, places, sums, coefficients);
            }
            Form::Dense(_) => {
                let mut at_places = Vectors::zeros(places.len(), coefficients.len());
                for (i, &place) in places.iter().enumerate() {
                    let mut coordinates = coordinates;
                    coordinates[axis] = place;
                    let own = self.coefficients(coordinates);
                    at_places.get_mut(i).copy_from_slice(&own);
                }
                for sum in sums {
                    for column in sum.columns.clone() {
                        let term =
                            |&(place, weight): &(usize, f64)| weight * at_places.get(place)[column];
                        coefficients[column] = sum.weights.iter().map(term).sum();
                    }
                }
            }
        }
    }

    /// Returns these coefficients, followed by their derivatives with respect to the three
    /// coordinates.
    pub(crate) fn coefficients_and_slopes(&self, coordinates: [f64; 3]) -> [Vec<f64>; 4] {
        match &self.form {
            Form::Tiles(trains) => {
                let train = trains.of(coordinates, &self.a_over_t_basis);
                train.coefficients_and_slopes(coordinates)
            }
            Form::Dense(rows) => {
                let weights = self.weights(coordinates);
                let by = |axis: usize| array::from_fn(|i| i == axis);
                self.sums(rows, &weights, [[false; 3], by(0), by(1), by(2)])
            }
        }
    }

    /// Returns weighted sums of the rows around one material.
    ///
    /// Sum `i` has the slopes of axis `j` in place of its values if `slopes[i][j]`. Each row is
    /// read once for all sums.
    fn sums<const N: usize>(
        &self,
        rows: &[f64],
        weights: &[Weights; 3],
        slopes: [[bool; 3]; N],
    ) -> [Vec<f64>; N] {
        let [n_e1, n_nu, n_e0] = self.bases.each_ref().map(Basis::count);
        let width = rows.len() / (n_e1 * n_nu * n_e0);
        let [e1, nu, e0] = weights;
        let mut sums = array::from_fn(|_| vec![0.0; width]);
        for (i, j) in (0..e1.count).flat_map(|i| (0..nu.count).map(move |j| (i, j))) {
            let rows = &rows[(((e1.first + i) * n_nu + nu.first + j) * n_e0 + e0.first) * width..];
            for (sum, slopes) in sums.iter_mut().zip(slopes) {
                let [of_e1, of_nu, of_e0] = array::from_fn(|axis| {
                    if slopes[axis] {
                        &weights[axis].slopes
                    } else {
                        &weights[axis].values
                    }
                });
                let row_weights: [f64; LARGEST_DEGREE + 1] =
                    array::from_fn(|k| of_e1[i] * of_nu[j] * of_e0[k]);
                add_rows(sum, &row_weights[..e0.count], rows, width);
            }
        }
        sums
    }
}

impl Trains {
    /// Returns the train of the first tile that contains the material, with the B-splines of `a/t`.
    fn of(&self, [film, _, substrate]: [f64; 3], basis: &Basis) -> &PreparedTrain {
        let contains = |[of_film, of_substrate]: &[[f64; 2]; 2]| {
            let within = |u: f64, [from, to]: &[f64; 2]| (*from..=*to).contains(&u);
            within(film, of_film) && within(substrate, of_substrate)
        };
        let tile = self.boxes.iter().position(contains);
        let tile = tile.expect("the tiles cover all coordinates");
        self.prepared[tile].get_or_init(|| {
            let (ends, form) = (self.ends[tile], &self.tiles.tile(tile).form);
            PreparedTrain::new(form, ends, &self.a_over_t, basis, self.tolerance)
        })
    }
}

/// Makes the B-splines of the material axes, and those of `a_over_t`.
fn bases(axes: &Axes) -> ([Basis; 3], Basis) {
    (
        axes.of_material().map(|parameter| axes.basis(parameter)),
        axes.basis(Parameter::AOverT),
    )
}
