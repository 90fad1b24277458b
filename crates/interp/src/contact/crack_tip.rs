//! Crack-tip laws: what the edge of the contact makes of the energy release rate. Eq. 8 is the
//! simplest of them.

use crate::Error;

/// How the contact line answers to the energy release rate `G`.
///
/// Barthel's eq. 8, `G = w`, is "not an intrinsic part" of his model. It is the law of a plain
/// number: `0.04` is a constant work of adhesion of 0.04 J/m^2, as in
/// [`Contact::load_and_penetration`](crate::Contact::load_and_penetration). With another law, give
/// those functions the `G` at which the line moves.
///
/// A law states between which `G` the line rests, which is all that [slow
/// motion](crate::ContactLine) needs, and, if it knows of time, how fast the line is beyond them.
pub trait CrackTip {
    /// The energy release rates (J/m^2), not negative and ascending, between which the line is at
    /// rest: below the first it advances, above the second it recedes.
    fn at_rest(&self) -> [f64; 2];

    /// The speed `v = -da/dt` (m/s, positive when the line recedes) at an energy release rate of
    /// any sign (J/m^2). It does not fall with `energy_release_rate`. Unless a law says otherwise,
    /// it is infinite wherever the line is not at rest.
    fn speed(&self, energy_release_rate: f64) -> f64 {
        let [advancing, receding] = self.at_rest();
        if energy_release_rate > receding {
            f64::INFINITY
        } else if energy_release_rate < advancing {
            f64::NEG_INFINITY
        } else {
            0.0 * energy_release_rate // NaN of NaN
        }
    }
}

/// A constant work of adhesion, J/m^2.
impl CrackTip for f64 {
    fn at_rest(&self) -> [f64; 2] {
        [*self; 2]
    }
}

/// A law chosen when the program runs is passed by reference, or in a box.
impl<L: CrackTip + ?Sized> CrackTip for &L {
    fn at_rest(&self) -> [f64; 2] {
        (**self).at_rest()
    }

    fn speed(&self, energy_release_rate: f64) -> f64 {
        (**self).speed(energy_release_rate)
    }
}

impl<L: CrackTip + ?Sized> CrackTip for Box<L> {
    fn at_rest(&self) -> [f64; 2] {
        (**self).at_rest()
    }

    fn speed(&self, energy_release_rate: f64) -> f64 {
        (**self).speed(energy_release_rate)
    }
}

/// Different energies for a line that advances and one that recedes; it is pinned while `G` is
/// between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hysteresis {
    energies: [f64; 2],
}

impl Hysteresis {
    /// From the energies (J/m^2) that an advancing line gains and a receding one costs.
    ///
    /// # Errors
    /// [`Error::Unphysical`] unless `0 <= advancing <= receding`, both finite.
    pub fn new(advancing: f64, receding: f64) -> Result<Self, Error> {
        checked([advancing, receding]).map(|energies| Self { energies })
    }
}

impl CrackTip for Hysteresis {
    fn at_rest(&self) -> [f64; 2] {
        self.energies
    }
}

/// A law `slow` made dependent on the speed: with its energies `w`, the line recedes at
/// `G = w (1 + (v/v0)^n)` and advances at `G = w / (1 + (|v|/v0)^n)`.
///
/// The first is the power law for elastomers (Gent and Schultz, J. Adhes. 3, 281 (1972); Maugis and
/// Barquins, J. Phys. D 11, 1989 (1978); Greenwood and Johnson, Phil. Mag. A 43, 697 (1981)), `n`
/// between 0.1 and 0.8. The second is a convention: the same factor, which a closing crack divides
/// by, as viscoelasticity lowers the energy that it gains (Greenwood, J. Phys. D 37, 2557 (2004)).
/// It keeps `G > 0` at any speed: a line that advances infinitely fast is that of the contact
/// without adhesion.
///
/// ```
/// # fn main() -> Result<(), interp::Error> {
/// use interp::{CrackTip, Hysteresis, RateDependent};
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
    /// From the law of a slow line, whose own speeds are not looked at, the speed `v0` (m/s) at
    /// which the energy is doubled or halved, and the exponent `n`.
    ///
    /// # Errors
    /// [`Error::Unphysical`] unless `v0` and `n` are positive and finite, and the energies of
    /// `slow` are in order, the receding one positive.
    pub fn new(slow: L, v0: f64, n: f64) -> Result<Self, Error> {
        let [_, receding] = checked(slow.at_rest())?;
        Error::unless(
            receding > 0.0,
            "receding energy",
            receding,
            "> 0 and finite",
        )?;
        Error::unless(v0 > 0.0 && v0.is_finite(), "v0", v0, "> 0 and finite")?;
        Error::unless(n > 0.0 && n.is_finite(), "exponent n", n, "> 0 and finite")?;
        Ok(Self { slow, v0, n })
    }

    /// The energy release rate (J/m^2) at which the line moves with `speed` (m/s, positive when it
    /// recedes); at 0, that at which it begins to recede.
    ///
    /// # Errors
    /// [`Error::Unphysical`] for NaN, an infinite speed, or one whose energy release rate is too
    /// large for f64.
    pub fn energy_release_rate(&self, speed: f64) -> Result<f64, Error> {
        Error::unless(speed.is_finite(), "speed", speed, "finite")?;
        let [advancing, receding] = self.slow.at_rest();
        let factor = 1.0 + (speed.abs() / self.v0).powf(self.n);
        let energy = if speed < 0.0 {
            advancing / factor
        } else {
            receding * factor
        };
        Error::unless(
            energy.is_finite(),
            "speed",
            speed,
            "such that f64 holds the energy release rate",
        )
        .map(|()| energy)
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
            0.0 * energy_release_rate // NaN of NaN
        }
    }
}

/// The energies of a law at rest, if they are in order.
pub(crate) fn checked(at_rest: [f64; 2]) -> Result<[f64; 2], Error> {
    let [advancing, receding] = at_rest;
    Error::unless(
        (0.0..f64::INFINITY).contains(&advancing),
        "advancing energy",
        advancing,
        ">= 0 and finite",
    )?;
    Error::unless(
        (advancing..f64::INFINITY).contains(&receding),
        "receding energy",
        receding,
        "finite and no less than the advancing one",
    )?;
    Ok(at_rest)
}
