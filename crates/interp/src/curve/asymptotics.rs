//! The continuation of a curve beyond its nodes in `a/t`: the first terms of the expansions about
//! the exact limits, with an estimate of the terms left out.

use std::f64::consts::{LN_2, PI};

use crate::curve::thick_film::fifth_order;
use crate::{Material, Quantities, Quantity};

/// The sum of `ln 2` and Euler's constant.
const C0: f64 = LN_2 + 0.577_215_664_901_532_9;

/// The largest first `a/t` below which the expansion for thick films is used. The series of the
/// kernel converges below 1.
const LARGEST_FIRST: f64 = 1.0;

/// The smallest last `a/t` above which the expansion for thin films is used.
const SMALLEST_LAST: f64 = 2.0;

/// The quantities at the first or the last node of a curve, where an expansion begins.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Edge {
    /// The first or the last `a/t` of the nodes.
    pub(crate) a_over_t: f64,
    /// The quantities at this `a/t`. A quantity that is not known has no meaningful value.
    pub(crate) quantities: Quantities,
    /// Their logarithmic slopes, `x dQ/dx`.
    pub(crate) slopes: Quantities,
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
    /// Continues the quantities to thicker films, `x < self.a_over_t`. Returns `None` if the edge
    /// is not at a small `a/t`, or the known quantities do not allow an estimate of the error.
    ///
    /// The kernel is even and smooth. Therefore it only adds a constant to first and second order
    /// in `x`. With one coefficient `k` of the material, and errors of the third order,
    ///
    /// ```text
    /// es/Eeq = es/Gamma = 1 + k x,   Delta0 = 1 + 2/3 k x,   Pi0 = 8/3 es
    /// ```
    ///
    /// Each quantity is continued from its own value at the edge. The third order is a second
    /// number of the material, the `u` of [`thick_film`](crate::curve::thick_film), and two known
    /// quantities, or `Pi0` alone, give it. The errors are up to twice `u` (that of `Gamma`). As `u`
    /// may vanish for some material, the [bound on the fifth order](fifth_order) is added.
    pub(crate) fn continue_to_thicker_films(
        &self,
        material: &Material,
        x: f64,
    ) -> Option<Expansion> {
        if self.a_over_t > LARGEST_FIRST {
            return None;
        }
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

        let third_order = self.largest_of_known([
            (Quantity::Pi0, Quantity::Pi0, pi0),
            (
                Quantity::Eeq,
                Quantity::Gamma,
                (1.0 + gamma) / (1.0 + eeq) - 1.0,
            ),
            (
                Quantity::Eeq,
                Quantity::Delta0,
                (delta0 - 2.0 / 3.0 * eeq) / (8.0 / 15.0 + 2.0 / 3.0 * eeq),
            ),
        ])?;
        let left_out = fifth_order(material, self.a_over_t);
        // On a film much stiffer than its substrate the departure is far above 1 at the edge, and
        // the relative error of `1 + k x` falls only where `k x` falls below 1.
        let departures = [
            (Quantity::Eeq, Quantity::Eeq, eeq.max(0.0)),
            (Quantity::Gamma, Quantity::Gamma, gamma.max(0.0)),
            (Quantity::Delta0, Quantity::Delta0, delta0.max(0.0)),
        ];
        let departure = self.largest_of_known(departures).unwrap_or(0.0);
        let share = ratio * (1.0 + departure) / (1.0 + ratio * departure);
        let error = share * (self.error + 2.0 * third_order + left_out);
        Some(Expansion {
            values: Quantities::from_array(values),
            slopes: Quantities::from_array(slopes),
            error,
        })
    }

    /// Continues the quantities to thinner films, `x > self.a_over_t`; `at_half` holds the
    /// quantities at half the `a/t` of the edge. Returns `None` between rigid bodies, if the edge is
    /// not at a large `a/t`, or if no two known quantities, nor `Gamma`, allow an estimate of the
    /// error.
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
    /// second order for `Gamma`, from its own value at the edge. With `r` the `a/t` of the edge over
    /// `x`, a last term `D (r^16 - r^17)` makes the slope continuous there; it is `D/46` at most.
    ///
    /// The error is the sum of two parts. One is measured: what the quantities at the edge and at
    /// half its `a/t` say about the second order, by the differences of their `C` and by the change
    /// of each between the two. The other follows from the material, and does not vanish by
    /// accident: `A^2`, and the part of the compliance `ln(1 + X/e1)` beyond its slope, at the wave
    /// number of the contact.
    pub(crate) fn continue_to_thinner_films(
        &self,
        at_half: &Quantities,
        material: &Material,
        x: f64,
    ) -> Option<Expansion> {
        /// The most sensitive quantity, `Pi0`, changes by three times the change of `C`. The other
        /// factor allows for the logarithm.
        const MEASURED: f64 = 6.0;
        /// The power with which the term vanishes that makes the slope continuous.
        const SMOOTH: i32 = 16;
        /// The factor of the material's part.
        const OF_MATERIAL: f64 = 10.0;
        let (edge, at, limit) = (self.a_over_t, self.quantities, material.thin_film_limit());
        if !limit.eeq.is_finite() || edge < SMALLEST_LAST {
            return None;
        }
        let slope = limit.eeq * material.compliance_slope() / PI;
        // A quantity is `limit {1 - factor [A (ln x + c0 - offset) + C]/x}`.
        let bracket = |x: f64, offset: f64| slope * (x.ln() + C0 - offset);
        let constant = |x: f64, at: f64, limit: f64, [factor, offset]: [f64; 2]| {
            x * (1.0 - at / limit) / factor - bracket(x, offset)
        };
        const PI0: [f64; 2] = [3.0, 1.0];
        const EEQ: [f64; 2] = [1.0, 0.0];
        const DELTA0: [f64; 2] = [2.0, 2.0];
        // `C` of `Pi0`, `Eeq` and `Delta0`, and the second order of `Gamma` over `x`.
        let constants = |x: f64, at: &Quantities| {
            [
                constant(x, at.pi0, limit.pi0, PI0),
                constant(x, at.eeq, limit.eeq, EEQ),
                x * (1.0 - at.gamma / limit.gamma) - 0.5 * slope,
                constant(x, at.delta0, 1.0, DELTA0),
            ]
        };
        let [of_edge, of_half] =
            [(edge, &at), (0.5 * edge, at_half)].map(|(x, at)| constants(x, at));
        let [pi0, eeq, gamma, delta0] = of_edge;
        let of_gamma = |x: f64| {
            let (first, second) = (0.5 * slope / x, gamma * edge / (x * x));
            (
                limit.gamma * (1.0 - first - second),
                limit.gamma * (first + 2.0 * second),
            )
        };
        let at_x = |x: f64| {
            let logarithmic = |constant: f64, limit: f64, [factor, offset]: [f64; 2]| {
                let departure = factor * (bracket(x, offset) + constant) / x;
                (
                    limit * (1.0 - departure),
                    limit * (departure - factor * slope / x),
                )
            };
            [
                logarithmic(pi0, limit.pi0, PI0),
                logarithmic(eeq, limit.eeq, EEQ),
                of_gamma(x),
                logarithmic(delta0, 1.0, DELTA0),
            ]
        };
        let ratio = edge / x;
        let power = ratio.powi(SMOOTH);
        let (of_edge_slopes, at_edge) = (self.slopes.to_array(), at_x(edge));
        let mut expanded = at_x(x);
        for (q, (value, rate)) in expanded.iter_mut().enumerate() {
            let missing = of_edge_slopes[q] - at_edge[q].1;
            let order = f64::from(SMOOTH);
            *value += missing * power * (1.0 - ratio);
            *rate += missing * power * ((order + 1.0) * ratio - order);
        }

        // The second order falls like `1/x`: what is found at half the `a/t` counts half at the
        // edge, and what changes between the two is what is left.
        let differences = |[pi0, eeq, gamma, delta0]: [f64; 4], weight: f64| {
            self.largest_of_known([
                (Quantity::Gamma, Quantity::Gamma, weight * gamma),
                (Quantity::Pi0, Quantity::Eeq, weight * (pi0 - eeq)),
                (Quantity::Pi0, Quantity::Delta0, weight * (pi0 - delta0)),
                (Quantity::Eeq, Quantity::Delta0, weight * (eeq - delta0)),
            ])
        };
        let changes = self.largest_of_known(
            [Quantity::Pi0, Quantity::Eeq, Quantity::Delta0]
                .map(|q| (q, q, of_edge[q as usize] - of_half[q as usize])),
        );
        let measured = differences(of_edge, 1.0)?
            .max(differences(of_half, 0.5)?)
            .max(changes.unwrap_or(0.0));
        let first_order = slope * (edge.ln() + 2.0) / edge;
        let of_material = material.compliance_beyond_slope(2.0 / edge) + first_order * first_order;
        let share = edge / x;
        let left_out = MEASURED * measured / edge + OF_MATERIAL * of_material;
        Some(Expansion {
            values: Quantities::from_array(expanded.map(|(value, _)| value)),
            slopes: Quantities::from_array(expanded.map(|(_, slope)| slope)),
            error: share * (self.error + (1.0 - share) * left_out),
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
