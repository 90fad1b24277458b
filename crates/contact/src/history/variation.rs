//! The derivatives of a relaxation function with respect to its numbers, as sums of the same
//! exponentials.
//!
//! The laws that are integrals of exponentials keep their rates while a number changes, and only
//! the weights move. The derivative of an exponential with respect to its own rate, `-t exp(-s t)`, is the difference of
//! two exponentials whose rates are a part of 2e-4 apart. All differences are of closed forms, and
//! hold 1e-8, as the unit tests measure.

use super::density::Density;
use super::exponentials::Exponentials;
use super::{LawParameter, Relaxation};

/// The part of a rate by which the two exponentials differ from it.
const APART: f64 = 1e-4;
/// The step of an exponent, over its distance to 0 and 1, and of the logarithm of a time.
const STEP: f64 = 1e-5;

/// Returns the law for times in `[shortest, longest]`, and its derivatives with respect to
/// `parameters`. The rates depend on the times and the tolerance alone.
pub(super) fn with_derivatives(
    law: &Relaxation,
    times: [f64; 2],
    tolerance: f64,
    parameters: &[LawParameter],
) -> (Exponentials, Vec<Exponentials>) {
    match law {
        Relaxation::Prony { terms, .. } => of_terms(law, terms, parameters),
        _ => of_density(law, times, tolerance, parameters),
    }
}

fn of_terms(
    law: &Relaxation,
    terms: &[[f64; 2]],
    parameters: &[LawParameter],
) -> (Exponentials, Vec<Exponentials>) {
    let sum = Exponentials::new(law, [1.0, 1.0], 1.0);
    let mut rates = sum.rates.clone();
    let sides = |time: f64| [(1.0 - APART) / time, (1.0 + APART) / time];
    for parameter in parameters {
        if let LawParameter::Time(k) = parameter {
            rates.extend(sides(terms[*k][1]));
        }
    }
    rates.sort_by(f64::total_cmp);
    let place = |rate: f64| rates.partition_point(|&own| own < rate);
    let mut weights = vec![0.0; rates.len()];
    for &[weight, time] in terms {
        weights[place(1.0 / time)] += weight;
    }
    let variation = |parameter: &LawParameter| {
        let mut own = Exponentials {
            weights: vec![0.0; rates.len()],
            rates: rates.clone(),
            ..Exponentials::default()
        };
        let first = place(1.0 / terms[0][1]);
        match *parameter {
            LawParameter::RelaxedFraction => {
                own.constant = 1.0;
                own.weights[first] -= 1.0;
            }
            LawParameter::Weight(k) => {
                own.weights[place(1.0 / terms[k][1])] += 1.0;
                own.weights[first] -= 1.0;
            }
            LawParameter::Time(k) => {
                let [weight, time] = terms[k];
                let [slower, faster] = sides(time);
                // d/d time = -(rate/time) d/d rate
                let part = 0.5 * weight / (APART * time);
                own.weights[place(slower)] += part;
                own.weights[place(faster)] -= part;
            }
            LawParameter::Exponent => {}
        }
        own
    };
    let variations = parameters.iter().map(variation).collect();
    let law = Exponentials {
        weights,
        rates,
        ..sum
    };
    (law, variations)
}

fn of_density(
    law: &Relaxation,
    times: [f64; 2],
    tolerance: f64,
    parameters: &[LawParameter],
) -> (Exponentials, Vec<Exponentials>) {
    let density = |law: &Relaxation| Density::of(law).expect("it is no sum of terms");
    let own = density(law);
    let grid = own.absolute_grid(times, tolerance);
    let sum = own.sum(&grid);
    let grid = grid.of_rates(&sum);
    let variation = |&parameter: &LawParameter| {
        let value = law.parameter(parameter).unwrap_or(0.0);
        let step = match parameter {
            LawParameter::Exponent => STEP * value.min(1.0 - value),
            LawParameter::Time(_) => STEP * value,
            // The law is linear in it.
            _ => 0.5,
        };
        let at = |value: f64| density(&law.with(parameter, value)).sum(&grid);
        let [below, above] = [at(value - step), at(value + step)];
        let slope = |below: f64, above: f64| (above - below) / (2.0 * step);
        let weights = below.weights.iter().zip(&above.weights);
        Exponentials {
            constant: slope(below.constant, above.constant),
            weights: weights.map(|(b, a)| slope(*b, *a)).collect(),
            rates: sum.rates.clone(),
            impulse: slope(below.impulse, above.impulse),
            second_impulse: slope(below.second_impulse, above.second_impulse),
            error: 0.0,
        }
    };
    let variations = parameters.iter().map(variation).collect();
    (sum, variations)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against the derivatives of the closed forms.
    #[test]
    fn derivatives_of_the_laws() {
        let (exponent, time, relaxed) = (0.3, 0.4, 0.2);
        let power = Relaxation::PowerLaw { exponent, time };
        let modified = Relaxation::ModifiedPowerLaw {
            relaxed,
            exponent,
            time,
        };
        let terms = vec![[0.5, 0.4], [0.3, 3.0]];
        let prony = Relaxation::Prony { relaxed, terms };
        let falls = |t: f64| (1.0 + t / time).powf(-exponent);
        type Exact<'a> = Box<dyn Fn(f64) -> f64 + 'a>;
        let cases: Vec<(&Relaxation, LawParameter, Exact<'_>)> = vec![
            (
                &power,
                LawParameter::Exponent,
                Box::new(|t| -(t / time).ln() * (t / time).powf(-exponent)),
            ),
            (
                &modified,
                LawParameter::RelaxedFraction,
                Box::new(|t| 1.0 - falls(t)),
            ),
            (
                &modified,
                LawParameter::Exponent,
                Box::new(|t| -0.8 * (t / time).ln_1p() * falls(t)),
            ),
            (
                &modified,
                LawParameter::Time(0),
                Box::new(|t| 0.8 * exponent * falls(t) * t / (time * (time + t))),
            ),
            (
                &prony,
                LawParameter::RelaxedFraction,
                Box::new(|t| 1.0 - (-t / 0.4).exp()),
            ),
            (
                &prony,
                LawParameter::Time(1),
                Box::new(|t| 0.3 * t / 9.0 * (-t / 3.0).exp()),
            ),
            (
                &prony,
                LawParameter::Weight(1),
                Box::new(|t| (-t / 3.0).exp() - (-t / 0.4).exp()),
            ),
        ];
        for (law, parameter, exact) in cases {
            let (_, own) = with_derivatives(law, [1e-3, 10.0], 1e-10, &[parameter]);
            for t in [1e-3, 0.02, 0.7, 10.0] {
                let error = own[0].value(t) - exact(t);
                assert!(error.abs() < 1e-7, "{law:?} {parameter:?} {t}: {error:.1e}");
            }
        }
    }
}
