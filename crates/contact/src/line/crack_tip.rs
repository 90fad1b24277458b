//! Crack-tip laws: how fast the contact line moves at a given energy release rate. Eq. 8 is the
//! simplest of them.

use crate::Error;
use interp::check::{finite_input, positive};

/// A law for the motion of the contact line at an energy release rate `G`.
///
/// Barthel's eq. 8, `G = w`, is "not an intrinsic part" of his model. It is the law of a plain
/// number: `0.04` is a constant work of adhesion of 0.04 J/m^2, as in
/// [`Contact::load_and_penetration`](crate::Contact::load_and_penetration). Under another law, give
/// such functions the `G` at which the line moves in place of the work of adhesion.
///
/// A law states the two values of `G` between which the line rests; [slow
/// motion](crate::ContactLine) needs no more. A law that depends on time also states the speed of
/// the line outside these two values.
pub trait CrackTip {
    /// Returns the two energy release rates (J/m^2), not negative and ascending, between which the
    /// line is at rest. The line advances below the first and recedes above the second.
    fn at_rest(&self) -> [f64; 2];

    /// Returns the speed `v = -da/dt` (m/s, positive when the line recedes) at an
    /// `energy_release_rate` of any sign (J/m^2).
    ///
    /// An implementation must not decrease with `energy_release_rate`. The default one is infinite
    /// wherever the line is not at rest.
    fn speed(&self, energy_release_rate: f64) -> f64 {
        let [advancing, receding] = self.at_rest();
        if energy_release_rate > receding {
            f64::INFINITY
        } else if energy_release_rate < advancing {
            f64::NEG_INFINITY
        } else {
            0.0 * energy_release_rate // NaN for NaN
        }
    }
}

/// The law of a constant work of adhesion, J/m^2.
impl CrackTip for f64 {
    fn at_rest(&self) -> [f64; 2] {
        [*self; 2]
    }
}

/// The law in a box, for a law that is chosen at run time.
impl<L: CrackTip + ?Sized> CrackTip for Box<L> {
    fn at_rest(&self) -> [f64; 2] {
        (**self).at_rest()
    }

    fn speed(&self, energy_release_rate: f64) -> f64 {
        (**self).speed(energy_release_rate)
    }
}

/// The law with one energy for a line that advances and another for one that recedes. The line is
/// pinned while `G` is between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hysteresis {
    energies: [f64; 2],
}

impl Hysteresis {
    /// Takes the energy that an `advancing` line gains and the energy that a `receding` line costs,
    /// J/m^2.
    ///
    /// # Errors
    /// [`interp::Error::Unphysical`] unless `0 <= advancing <= receding`, both finite.
    pub fn new(advancing: f64, receding: f64) -> Result<Self, Error> {
        energies_in_order([advancing, receding]).map(|energies| Self { energies })
    }
}

impl CrackTip for Hysteresis {
    fn at_rest(&self) -> [f64; 2] {
        self.energies
    }
}

/// The law `slow`, with energies that depend on the speed `v` of the line.
///
/// Where `slow` has the energies `w`, the line recedes at `G = w (1 + (v/v0)^n)` and advances at
/// `G = w / (1 + (|v|/v0)^n)`.
///
/// The first equation is the power law for elastomers, with `n` between 0.1 and 0.8 (Gent and
/// Schultz, J. Adhes. 3, 281 (1972); Maugis and Barquins, J. Phys. D 11, 1989 (1978); Greenwood and
/// Johnson, Phil. Mag. A 43, 697 (1981)). The second is a convention: a closing crack divides by
/// the factor by which an opening crack multiplies, because viscoelasticity lowers the energy that
/// a closing crack gains (Greenwood, J. Phys. D 37, 2557 (2004)). It keeps `G > 0` at any speed: a
/// line that advances infinitely fast is that of the contact without adhesion.
///
/// ```
/// # fn main() -> Result<(), contact::Error> {
/// use contact::{CrackTip, Hysteresis, RateDependent};
///
/// let law = RateDependent::new(0.04, 1e-6, 0.6)?; // J/m^2, m/s
/// assert!((law.energy_release_rate(1e-6)? - 0.08).abs() < 1e-15);
/// assert!((law.speed(0.08) - 1e-6).abs() < 1e-20);
/// assert!((law.energy_release_rate(-1e-6)? - 0.02).abs() < 1e-15);
///
/// let pinned = RateDependent::new(Hysteresis::new(0.03, 0.05)?, 1e-6, 0.6)?;
/// assert_eq!(pinned.speed(0.04), 0.0);
/// # Ok(()) }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RateDependent<L = f64> {
    slow: L,
    v0: f64,
    n: f64,
}

impl<L: CrackTip> RateDependent<L> {
    /// Takes the law of a `slow` line, the speed `v0` (m/s) at which the energy is doubled or
    /// halved, and the exponent `n`. The speeds that `slow` states are not used.
    ///
    /// # Errors
    /// [`interp::Error::Unphysical`] unless `v0` and `n` are positive and finite, and the energies of
    /// `slow` are in order, the receding one positive.
    pub fn new(slow: L, v0: f64, n: f64) -> Result<Self, Error> {
        let [_, receding] = energies_in_order(slow.at_rest())?;
        positive("receding energy", receding)?;
        positive("v0", v0)?;
        positive("exponent n", n)?;
        Ok(Self { slow, v0, n })
    }

    /// Returns the energy release rate (J/m^2) at which the line moves with `speed` (m/s, positive
    /// when it recedes). At 0 it is that at which the line begins to recede.
    ///
    /// # Errors
    /// [`interp::Error::Unphysical`] for NaN, an infinite `speed`, or one whose energy release rate
    /// overflows an f64.
    pub fn energy_release_rate(&self, speed: f64) -> Result<f64, Error> {
        finite_input("speed", speed)?;
        let [advancing, receding] = self.slow.at_rest();
        let factor = 1.0 + (speed.abs() / self.v0).powf(self.n);
        let energy = if speed < 0.0 {
            advancing / factor
        } else {
            receding * factor
        };
        interp::Error::unless(
            energy.is_finite(),
            "speed",
            speed,
            "such that the energy release rate does not overflow an f64",
        )?;
        Ok(energy)
    }
}

impl<L: CrackTip> CrackTip for RateDependent<L> {
    fn at_rest(&self) -> [f64; 2] {
        self.slow.at_rest()
    }

    fn speed(&self, energy_release_rate: f64) -> f64 {
        let [advancing, receding] = self.slow.at_rest();
        let speed = |excess: f64| self.v0 * excess.powf(1.0 / self.n);
        if energy_release_rate > receding {
            speed((energy_release_rate - receding) / receding)
        } else if energy_release_rate < advancing {
            -speed((advancing - energy_release_rate) / energy_release_rate.max(0.0))
        } else {
            0.0 * energy_release_rate // NaN for NaN
        }
    }
}

/// Returns the energies of a law at rest if they are finite, not negative and ascending.
pub(crate) fn energies_in_order(at_rest: [f64; 2]) -> Result<[f64; 2], Error> {
    let [advancing, receding] = at_rest;
    interp::Error::unless(
        (0.0..f64::INFINITY).contains(&advancing),
        "advancing energy",
        advancing,
        ">= 0 and finite",
    )?;
    interp::Error::unless(
        (advancing..f64::INFINITY).contains(&receding),
        "receding energy",
        receding,
        "finite and no less than the advancing one",
    )?;
    Ok(at_rest)
}
