//! The continuation of a curve beyond its nodes in `a/t`: the first terms of the expansions about
//! the exact limits, with an estimate of the terms left out.

use std::f64::consts::{LN_2, PI};

use crate::{Material, Quantities, Quantity};

/// The sum of `ln 2` and Euler's constant.
const C0: f64 = LN_2 + 0.577_215_664_901_532_9;

/// The quantities at the first or the last node of a curve, where an expansion begins.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Edge {
    /// The first or the last `a/t` of the nodes.
    pub(crate) a_over_t: f64,
    /// The quantities at this `a/t`. A quantity that is not known has no meaningful value.
    pub(crate) quantities: Quantities,
    /// Which quantities the curve knows, in the order of [`Quantity::ALL`].
    pub(crate) known: [bool; 4],
    /// The relative error of the quantities.
    pub(crate) error: f64,
}

/// The result of an expansion at one `a/t`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Expansion {
    /// The quantities. A quantity that the curve does not know has no meaningful value.
    pub(crate) values: Quantities,
    /// The logarithmic slopes of the quantities, `x dQ/dx`.
    pub(crate) slopes: Quantities,
    /// The estimated relative error.
    pub(crate) error: f64,
}

impl Edge {
    /// Continues the quantities to thicker films, `x < self.a_over_t`. Returns `None` if no two
    /// known quantities allow an estimate of the error.
    ///
    /// The kernel is even and smooth. Therefore it only adds a constant to first and second order
    /// in `x`. With one coefficient `k` of the material, and errors of the third order,
    ///
    /// ```text
    /// es/Eeq = es/Gamma = 1 + k x,   Delta0 = 1 + 2/3 k x,   Pi0 = 8/3 es
    /// ```
    ///
    /// Each quantity is continued from its own value at the edge. The differences of the `k` of
    /// these values estimate the third order. (With a quadratic kernel the differences are two
    /// thirds of the next coefficient. The largest error, that of `Gamma`, is four thirds of it.)
    pub(crate) fn continue_to_thicker_films(
        &self,
        material: &Material,
        x: f64,
    ) -> Option<Expansion> {
        let (ratio, es) = (x / self.a_over_t, material.sphere_film_modulus());
        let (at, limit) = (self.quantities, material.thick_film_limit());
        let [pi0, delta0] = [at.pi0 / limit.pi0 - 1.0, at.delta0 - 1.0];
        let [eeq, gamma] = [es / at.eeq - 1.0, es / at.gamma - 1.0];
        let compliant = |departure: f64| {
            let compliance = 1.0 + ratio * departure;
            (
                es / compliance,
                -es * ratio * departure / (compliance * compliance),
            )
        };
        let (eeq_there, gamma_there) = (compliant(eeq), compliant(gamma));
        let values = [
            limit.pi0 * (1.0 + ratio * pi0),
            eeq_there.0,
            gamma_there.0,
            1.0 + ratio * delta0,
        ];
        let slopes = [
            limit.pi0 * ratio * pi0,
            eeq_there.1,
            gamma_there.1,
            ratio * delta0,
        ];

        let differences = [
            (Quantity::Pi0, Quantity::Pi0, pi0),
            (Quantity::Eeq, Quantity::Gamma, eeq - gamma),
            (Quantity::Eeq, Quantity::Delta0, 2.0 / 3.0 * eeq - delta0),
            (
                Quantity::Gamma,
                Quantity::Delta0,
                2.0 / 3.0 * gamma - delta0,
            ),
        ];
        let third_order = self.largest_of_known(differences)?;
        // On a film much stiffer than its substrate the departure is far above 1 at the edge, and
        // the relative error of `1 + k x` falls only where `k x` falls below 1.
        let departure = eeq.max(gamma).max(0.0);
        let share = ratio / (1.0 + ratio * departure);
        let error = share * ((1.0 + departure) * self.error + 2.0 * third_order);
        Some(Expansion {
            values: Quantities::from_array(values),
            slopes: Quantities::from_array(slopes),
            error,
        })
    }

    /// Continues the quantities to thinner films, `x > self.a_over_t`. Returns `None` between rigid
    /// bodies, or if no two known quantities allow an estimate of the error.
    ///
    /// With `A = einf X'(0)/(pi e1)`, `c0 = ln 2 + 0.5772`, one coefficient `C` of the material and
    /// errors of order `(ln x / x)^2`,
    ///
    /// ```text
    /// Eeq = einf {1 - [A (ln x + c0) + C]/x}           Gamma = sqrt(es einf) [1 - A/(2x)]
    /// Delta0 = 1 - 2 [A (ln x + c0 - 2) + C]/x          Pi0 = 8/3 einf {1 - 3 [A (ln x + c0 - 1) + C]/x}
    /// ```
    ///
    /// (from the Wiener-Hopf solution for a half-plane). `C` is found for each quantity, and the
    /// second order for `Gamma`, from its own value at the edge. The differences of these `C`
    /// estimate the second order there, and with it the error of the most sensitive quantity,
    /// `Pi0`.
    pub(crate) fn continue_to_thinner_films(
        &self,
        material: &Material,
        x: f64,
    ) -> Option<Expansion> {
        let (edge, at, limit) = (self.a_over_t, self.quantities, material.thin_film_limit());
        if !limit.eeq.is_finite() {
            return None;
        }
        let slope = limit.eeq * material.compliance_slope() / PI;
        // `C`, value and slope of a quantity `limit {1 - factor [A (ln x + c0 - offset) + C]/x}`.
        let logarithmic = |at: f64, limit: f64, factor: f64, offset: f64| {
            let bracket = |x: f64| slope * (x.ln() + C0 - offset);
            let constant = edge * (1.0 - at / limit) / factor - bracket(edge);
            let departure = factor * (bracket(x) + constant) / x;
            (
                constant,
                limit * (1.0 - departure),
                limit * (departure - factor * slope / x),
            )
        };
        let pi0 = logarithmic(at.pi0, limit.pi0, 3.0, 1.0);
        let eeq = logarithmic(at.eeq, limit.eeq, 1.0, 0.0);
        let delta0 = logarithmic(at.delta0, 1.0, 2.0, 2.0);
        let second_order = edge * (edge * (1.0 - at.gamma / limit.gamma) - 0.5 * slope);
        let first = 0.5 * slope / x;
        let second = second_order / (x * x);
        let values = [pi0.1, eeq.1, limit.gamma * (1.0 - first - second), delta0.1];
        let slopes = [pi0.2, eeq.2, limit.gamma * (first + 2.0 * second), delta0.2];

        let differences = [
            (Quantity::Gamma, Quantity::Gamma, second_order / edge),
            (Quantity::Pi0, Quantity::Eeq, pi0.0 - eeq.0),
            (Quantity::Pi0, Quantity::Delta0, pi0.0 - delta0.0),
            (Quantity::Eeq, Quantity::Delta0, eeq.0 - delta0.0),
        ];
        let constant = self.largest_of_known(differences)?;
        let error = self.error * (edge / x) + 6.0 * constant * (1.0 - edge / x) / x;
        Some(Expansion {
            values: Quantities::from_array(values),
            slopes: Quantities::from_array(slopes),
            error,
        })
    }

    /// Returns the largest absolute value of the numbers whose two quantities are both known, or
    /// `None` if there is no such number.
    fn largest_of_known<const N: usize>(
        &self,
        numbers: [(Quantity, Quantity, f64); N],
    ) -> Option<f64> {
        let is_known = |quantity: Quantity| self.known[quantity as usize];
        let of_known = numbers
            .into_iter()
            .filter(|&(first, second, _)| is_known(first) && is_known(second));
        of_known.map(|(_, _, number)| number.abs()).reduce(f64::max)
    }
}
