//! The neighbourhood of a minimum that is known, in which no other start is followed.

use nalgebra::{DMatrix, DVector};

/// The neighbourhood of a minimum from which every start leads to it.
#[derive(Clone, Debug)]
pub(crate) struct Basin {
    x: DVector<f64>,
    jacobian: DMatrix<f64>,
}

impl Basin {
    /// The change of the residuals, in units of the noise, up to which a point belongs to the
    /// minimum.
    const REACH: f64 = 2.0;
    /// The largest change of a coordinate up to which a point may: beyond, residuals that hardly depend on it here say
    /// nothing.
    const FARTHEST: f64 = 10.0;

    /// Takes the coordinates of the minimum, and the derivatives of the residuals there.
    pub const fn new(x: DVector<f64>, jacobian: DMatrix<f64>) -> Self {
        Self { x, jacobian }
    }

    /// Tells whether coordinates belong to the minimum.
    pub fn holds(&self, x: &DVector<f64>) -> bool {
        let change = x - &self.x;
        change.amax() < Self::FARTHEST && (&self.jacobian * change).norm() < Self::REACH
    }
}
