//! The relaxation functions of linear viscoelastic solids.

use std::f64::consts::PI;

use super::exponentials::Exponentials;
use crate::Error;

/// How Young's modulus falls in time after a step of the strain: `E(t) = E_ref phi(t)`, at a
/// constant Poisson ratio.
///
/// The modulus of a contact is `E_ref`. It is the instantaneous modulus, except under a power law,
/// whose modulus is `E_ref` at the reference time.
///
/// ```
/// use contact::Relaxation;
///
/// let solid = Relaxation::Prony { relaxed: 0.3, terms: vec![[0.7, 0.6]] }; // a standard linear solid
/// let modulus = solid.modulus(0.6)?;
/// assert!((modulus - (0.3 + 0.7 * (-1.0_f64).exp())).abs() < 1e-15);
/// # Ok::<(), contact::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum Relaxation {
    /// `phi = relaxed + sum weight exp(-t/time)`, the generalised Maxwell solid. One term is the
    /// standard linear solid. `relaxed` and the weights sum to 1.
    Prony {
        /// The part of the modulus that is left in the end, from 0 to 1.
        relaxed: f64,
        /// Weight and relaxation time (s) of each term.
        terms: Vec<[f64; 2]>,
    },
    /// `phi = (t/time)^-exponent`.
    PowerLaw {
        /// The exponent, from 1e-9 to below 1.
        exponent: f64,
        /// The time (s) at which the modulus is `E_ref`.
        time: f64,
    },
    /// `phi = relaxed + (1 - relaxed) (1 + t/time)^-exponent`.
    ModifiedPowerLaw {
        /// The part of the modulus that is left in the end, from 0 to below 1.
        relaxed: f64,
        /// The exponent, from 1e-9 to below 1.
        exponent: f64,
        /// The time at which the modulus begins to fall, s.
        time: f64,
    },
    /// `phi = relaxed + (1 - relaxed) E_exponent(-(t/time)^exponent)` with the Mittag-Leffler
    /// function, which is `erfcx((t/time)^(1/2))` for the exponent 1/2. A history by elements takes time in
    /// proportion to `exponent/(1 - exponent)`, which is 99 for the largest exponent.
    FractionalZener {
        /// The part of the modulus that is left in the end, from 0 to below 1.
        relaxed: f64,
        /// The exponent, from 0.001 to 0.99.
        exponent: f64,
        /// The relaxation time, s.
        time: f64,
    },
}

/// The tolerance of a modulus or creep compliance at one time, where there is no closed form.
const TOLERANCE: f64 = 1e-13;
/// The part by which weights and the relaxed part may miss the sum 1.
const SUM: f64 = 1e-9;

impl Relaxation {
    /// Accepts a law with possible parameters.
    ///
    /// # Errors
    /// [`interp::Error::InvalidArgument`](interp::Error::InvalidArgument) names the parameter, its value and the values allowed.
    pub fn check(&self) -> Result<(), Error> {
        let unless = |holds: bool, name: &'static str, value: f64, allowed: &'static str| {
            interp::Error::argument(holds, name, value, allowed).map_err(Error::from)
        };
        let positive = |name, value: f64| {
            unless(
                (1e-50..=1e50).contains(&value),
                name,
                value,
                "from 1e-50 to 1e50",
            )
        };
        let part = |relaxed: f64| {
            unless(
                (0.0..=1.0).contains(&relaxed),
                "relaxed fraction",
                relaxed,
                "from 0 to 1",
            )
        };
        let (relaxed, exponent, time) = match self {
            Self::Prony { relaxed, terms } => {
                // Before the weights, of which one may be what the others and the fraction leave.
                part(*relaxed)?;
                // The first weight is often what the others leave.
                if let [[first, _], others @ ..] = &terms[..]
                    && *first <= 0.0
                {
                    let rest = relaxed + others.iter().map(|[weight, _]| weight).sum::<f64>();
                    let name = "sum of the relaxed fraction and all weights but the first";
                    unless(rest < 1.0, name, rest, "below 1, which the first one fills")?;
                }
                for &[weight, time] in terms {
                    positive("relaxation weight", weight)?;
                    positive("relaxation time", time)?;
                }
                let sum = relaxed + terms.iter().map(|[weight, _]| weight).sum::<f64>();
                unless(
                    (sum - 1.0).abs() <= SUM,
                    "sum of the relaxed fraction and the weights",
                    sum,
                    "1",
                )?;
                (*relaxed, 0.5, 1.0)
            }
            Self::PowerLaw { exponent, time } => (0.0, *exponent, *time),
            Self::ModifiedPowerLaw {
                relaxed,
                exponent,
                time,
            } => (*relaxed, *exponent, *time),
            Self::FractionalZener {
                relaxed,
                exponent,
                time,
            } => {
                let allowed = "from 0.001 to 0.99";
                unless(
                    (1e-3..=0.99).contains(exponent),
                    "relaxation exponent",
                    *exponent,
                    allowed,
                )?;
                (*relaxed, *exponent, *time)
            }
        };
        part(relaxed)?;
        unless(
            relaxed < 1.0 || matches!(self, Self::Prony { .. }),
            "relaxed fraction",
            relaxed,
            "below 1: at 1 the body is elastic, and needs no law",
        )?;
        let allowed = "from 1e-9 to below 1: a larger exponent is that of no solid, and its contact line would jump at every turn";
        unless(
            (1e-9..1.0).contains(&exponent),
            "relaxation exponent",
            exponent,
            allowed,
        )?;
        positive("relaxation time", time)
    }

    /// Returns `E(t)/E_ref` at a time `t` (s) after a step of the strain. At 0 a power law is
    /// infinite.
    ///
    /// # Errors
    /// As [`Relaxation::check`]; [`interp::Error::InvalidArgument`] for a time that is negative or not finite.
    pub fn modulus(&self, t: f64) -> Result<f64, Error> {
        self.check()?;
        time_of_a_step(t)?;
        Ok(match self {
            Self::FractionalZener { .. } if t > 0.0 => {
                Exponentials::new(self, [t, t], TOLERANCE).value(t)
            }
            _ => self.closed_form(t).unwrap_or(1.0),
        })
    }

    /// Returns the modulus of the laws that have a closed form.
    pub(super) fn closed_form(&self, t: f64) -> Option<f64> {
        match self {
            Self::Prony { relaxed, terms } => {
                let term = |[weight, time]: &[f64; 2]| weight * (-t / time).exp();
                Some(relaxed + terms.iter().map(term).sum::<f64>())
            }
            Self::PowerLaw { exponent, time } => Some((t / time).powf(-exponent)),
            Self::ModifiedPowerLaw {
                relaxed,
                exponent,
                time,
            } => {
                let falling = (-exponent * (t / time).ln_1p()).exp();
                Some(relaxed + (1.0 - relaxed) * falling)
            }
            Self::FractionalZener { .. } => None,
        }
    }

    /// Returns the strain at a time `t` (s) after a step of the stress by `E_ref`: the creep
    /// compliance in units of `1/E_ref`.
    ///
    /// It obeys `int_0^t phi(t-t') dJ(t') = 1`. That of a power law is
    /// `(t/time)^exponent sin(pi exponent)/(pi exponent)`; the others are sums of exponentials,
    /// to 1e-12, as the unit tests of `exponentials` measure.
    ///
    /// # Errors
    /// As [`Relaxation::modulus`].
    pub fn creep(&self, t: f64) -> Result<f64, Error> {
        self.check()?;
        time_of_a_step(t)?;
        Ok(match self {
            Self::PowerLaw { exponent, time } => {
                (t / time).powf(*exponent) * (PI * exponent).sin() / (PI * exponent)
            }
            _ if t == 0.0 => 1.0,
            _ => {
                // The compliance at t depends on the moduli at shorter times, less and less.
                Exponentials::new(self, [1e-6 * t, t], TOLERANCE)
                    .creep()
                    .value(t)
            }
        })
    }

    /// Returns storage and loss modulus over `E_ref` at an angular frequency `omega` (rad/s).
    ///
    /// That of a power law is `Gamma(1-exponent) (i omega time)^exponent`.
    ///
    /// # Errors
    /// As [`Relaxation::check`]; [`interp::Error::InvalidArgument`] unless `omega` is positive and finite.
    pub fn complex(&self, omega: f64) -> Result<[f64; 2], Error> {
        self.check()?;
        let holds = omega > 0.0 && omega.is_finite();
        interp::Error::argument(holds, "omega", omega, "> 0 and finite, in rad/s")?;
        Ok(match *self {
            Self::PowerLaw { exponent, time } => {
                let size = libm::tgamma(1.0 - exponent) * (omega * time).powf(exponent);
                let (sin, cos) = (0.5 * PI * exponent).sin_cos();
                [size * cos, size * sin]
            }
            Self::FractionalZener {
                relaxed,
                exponent,
                time,
            } => {
                // z/(1+z) with z = (i omega time)^exponent
                let size = (omega * time).powf(exponent);
                let (sin, cos) = (0.5 * PI * exponent).sin_cos();
                let square = 1.0 + 2.0 * size * cos + size * size;
                let rest = 1.0 - relaxed;
                [
                    relaxed + rest * size * (cos + size) / square,
                    rest * size * sin / square,
                ]
            }
            Self::Prony { .. } | Self::ModifiedPowerLaw { .. } => {
                let times = [1.0 / omega, 1e8 / omega];
                Exponentials::new(self, times, TOLERANCE).complex(omega)
            }
        })
    }
}

/// Accepts the time since a step.
fn time_of_a_step(t: f64) -> Result<(), interp::Error> {
    let holds = t >= 0.0 && t.is_finite();
    interp::Error::argument(holds, "time", t, ">= 0 and finite, in s")
}
