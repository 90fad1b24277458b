//! Robust losses, as residuals whose squares sum to the loss.

use crate::{Error, Loss};

/// Returns `s sqrt(loss)` of a residual, with its sign `s`, and the derivative with respect to the
/// residual.
pub(crate) fn weighted(loss: Loss, residual: f64) -> (f64, f64) {
    let size = residual.abs();
    match loss {
        Loss::Squares => (residual, 1.0),
        Loss::Huber { threshold } if size <= threshold => (residual, 1.0),
        Loss::Huber { threshold } => {
            let root = (threshold * (2.0 * size - threshold)).sqrt();
            (root.copysign(residual), threshold / root)
        }
        Loss::SoftL1 { threshold } => {
            let part = (residual / threshold).powi(2);
            let root = (1.0 + part).sqrt();
            // `2 (root - 1)` without cancellation.
            let twice = 2.0 * part / (1.0 + root);
            if part == 0.0 {
                return (residual, 1.0);
            }
            let value = threshold * twice.sqrt();
            (value.copysign(residual), size / root / value)
        }
    }
}

/// Returns half the derivative of the loss, `psi`, and that of `psi`.
pub(crate) fn influence(loss: Loss, residual: f64) -> (f64, f64) {
    match loss {
        Loss::Squares => (residual, 1.0),
        Loss::Huber { threshold } if residual.abs() <= threshold => (residual, 1.0),
        Loss::Huber { threshold } => (threshold.copysign(residual), 0.0),
        Loss::SoftL1 { threshold } => {
            let root = (1.0 + (residual / threshold).powi(2)).sqrt();
            (residual / root, 1.0 / (root * root * root))
        }
    }
}

/// Accepts the threshold of a loss.
pub(crate) fn accept(loss: Loss) -> Result<(), Error> {
    match loss {
        Loss::Huber { threshold } | Loss::SoftL1 { threshold }
            if !(threshold > 0.0 && threshold.is_finite()) =>
        {
            let name = "the threshold of the loss";
            Err(Error::setting(name, threshold, "positive and finite"))
        }
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_are_those_of_the_loss() {
        for loss in [Loss::Squares, Loss::HUBER, Loss::SOFT_L1] {
            for residual in [-30.0, -2.0, -0.3, 1e-9, 0.7, 1.3, 1.5, 100.0] {
                let step = 1e-5 * f64::max(1.0, residual);
                let at = |r: f64| weighted(loss, r);
                let (value, slope) = at(residual);
                let difference = (at(residual + step).0 - at(residual - step).0) / (2.0 * step);
                assert!((slope - difference).abs() < 1e-6, "{loss:?} at {residual}");
                let (psi, psi_slope) = influence(loss, residual);
                assert!((psi - value * slope).abs() < 1e-9 * (1.0 + psi.abs()));
                let psi_at = |r: f64| influence(loss, r).0;
                let difference = (psi_at(residual + step) - psi_at(residual - step)) / (2.0 * step);
                assert!(
                    (psi_slope - difference).abs() < 1e-6,
                    "{loss:?} at {residual}"
                );
            }
        }
    }
}
