//! Load and penetration of a shape of even powers on films so thick that `a/t` is below the first node of
//! the curve.

use interp::BelowNodes;

use super::beginning::{Beginning, Kernel};
use super::weights::{EvenShape, Weights, dilated};

/// A shape on thick films.
#[derive(Clone, Copy, Debug)]
pub(super) struct ThickFilms {
    pub(super) shape: EvenShape,
    /// The units of the grid per film thickness.
    pub(super) unit: f64,
    pub(super) beginning: Beginning,
    /// The sphere-film modulus in the unit of the quantities.
    pub(super) es: f64,
}

impl ThickFilms {
    /// Returns the weights of the shape for a contact radius in units of the grid.
    fn weights(&self, y: f64) -> Weights {
        self.shape.weights(y, self.unit)
    }

    /// Returns the derivatives of the logarithms of load and penetration with respect to that of all
    /// lengths of the shape, at a fixed contact radius.
    pub(super) fn by_size(&self, a_over_t: f64) -> [f64; 2] {
        let y = a_over_t * self.unit;
        let (kernel, weights) = (self.beginning.at(y), self.weights(y));
        let (of, by) = (kernel.sums(&weights), kernel.sums(&dilated(weights)));
        [by.load / of.load, by.penetration / of.penetration]
    }

    /// Returns the departure of `Delta0` from that on a half-space, relative to that and per `alpha`, at
    /// a contact radius in units of the grid.
    fn share(&self, y: f64) -> f64 {
        self.beginning.at(y).share(&self.weights(y))
    }

    /// Returns `Delta0` of the shape on a half-space at a contact radius in units of the grid.
    fn on_half_space(&self, y: f64) -> f64 {
        let half_space = Kernel {
            alpha: 0.0,
            beta: 0.0,
            y,
        };
        self.shape.unit_radius() * self.unit / (y * y)
            * half_space.sums(&self.weights(y)).penetration
    }
}

impl BelowNodes for ThickFilms {
    fn pi0_and_delta0(&self, a_over_t: f64) -> [[f64; 2]; 2] {
        let y = a_over_t * self.unit;
        let (kernel, weights) = (self.beginning.at(y), self.weights(y));
        let (of, by) = (kernel.sums(&weights), kernel.slopes(&weights));
        let radius = self.shape.unit_radius() * self.unit;
        let [load, penetration] = [self.es * radius / (y * y * y), radius / (y * y)];
        let [pi0, delta0] = [load * of.load, penetration * of.penetration];
        [
            [pi0, delta0],
            [
                load * by.load - 3.0 * pi0,
                penetration * by.penetration - 2.0 * delta0,
            ],
        ]
    }

    fn changes_of_delta0(&self, a_over_t: f64) -> [f64; 2] {
        let (y, first) = (a_over_t * self.unit, self.beginning.first);
        [
            y / first * self.share(y) / self.share(first),
            self.on_half_space(y) / self.on_half_space(first),
        ]
    }
}
