//! The tensor spline of a table: from its coefficients to those of the splines of one material over
//! `ln(a/t)`.

use std::sync::Arc;

use low_rank::once::Once;
use low_rank::{DenseSpline, PreparedTrain, WeightedSum};
use piecewise::bspline::Basis;

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
    /// The B-splines of `a_over_t`.
    pub(crate) a_over_t_basis: Basis,
    form: Form,
}

/// The coefficients in one of two forms.
#[derive(Clone, Debug)]
enum Form {
    Dense(DenseSpline),
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
            a_over_t_basis: axes.basis(Parameter::AOverT),
            form,
        }
    }

    /// Makes the spline through `logarithms` at the nodes, which become the coefficients in place.
    ///
    /// They are row-major over `e1_over_e2`, `nu1`, `e0_over_e2`, `a_over_t` and the quantities.
    pub(crate) fn through(axes: &Axes, logarithms: Vec<f64>) -> Self {
        let bases = axes.of_material().map(|parameter| axes.basis(parameter));
        let a_over_t_basis = axes.basis(Parameter::AOverT);
        let spline = DenseSpline::through(bases, &a_over_t_basis, logarithms);
        Self {
            a_over_t_basis,
            form: Form::Dense(spline),
        }
    }

    /// Returns the coefficients over `ln(a/t)` of the material at `coordinates`: a group of the
    /// quantities held for each B-spline.
    pub(crate) fn coefficients(&self, coordinates: [f64; 3]) -> Vec<f64> {
        match &self.form {
            Form::Tiles(trains) => {
                let train = trains.of(coordinates, &self.a_over_t_basis);
                train.coefficients(coordinates)
            }
            Form::Dense(spline) => spline.coefficients(coordinates),
        }
    }

    /// Replaces the columns of `coefficients` that `sums` name by weighted sums of the coefficients
    /// of materials that differ in one coordinate, the number `axis`, which has the values `places`.
    pub(crate) fn sums_along(
        &self,
        coordinates: [f64; 3],
        axis: usize,
        places: &[f64],
        sums: &[WeightedSum<'_>],
        coefficients: &mut [f64],
    ) {
        match &self.form {
            Form::Tiles(trains) => {
                let train = trains.of(coordinates, &self.a_over_t_basis);
                train.sums_along(coordinates, axis, places, sums, coefficients);
            }
            Form::Dense(spline) => {
                spline.sums_along(coordinates, axis, places, sums, coefficients);
            }
        }
    }

    /// Returns these coefficients, followed by their derivatives with respect to the three
    /// coordinates; those that are not `wanted` are empty.
    pub(crate) fn coefficients_and_slopes(
        &self,
        coordinates: [f64; 3],
        wanted: [bool; 3],
    ) -> [Vec<f64>; 4] {
        match &self.form {
            Form::Tiles(trains) => {
                let train = trains.of(coordinates, &self.a_over_t_basis);
                train.coefficients_and_slopes(coordinates, wanted)
            }
            Form::Dense(spline) => spline.coefficients_and_slopes(coordinates, wanted),
        }
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
