//! The contact line in slow motion: where a load or a penetration, changed slowly, takes it.

use crate::{Contact, CrackTip, Error, crack_tip};

/// The ratio of successive radii in the search for the next place of rest.
const STRIDE: f64 = 1.02;
/// The ratio of radii over which is searched at most.
const FAR: f64 = 1e9;
/// Golden sections that take an interval of a few [`STRIDE`]s to the root of rounding, which is as well as a minimum can be known.
const SECTIONS: usize = 40;

/// What the machine imposes on the sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Imposed {
    /// A load, N.
    Load(f64),
    /// A penetration, m.
    Penetration(f64),
}

/// A contact whose line may move: its state includes the energy release rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineState {
    /// Contact radius `a`, m.
    pub contact_radius: f64,
    /// Load `F`, N, positive in compression.
    pub load: f64,
    /// Penetration `delta`, m, positive when the sphere moves in.
    pub penetration: f64,
    /// Energy release rate `G`, J/m^2.
    pub energy_release_rate: f64,
}

/// A contact and where its line is, which is moved by a load or a penetration according to a [`CrackTip`] law.
///
/// [`ContactLine::impose`] moves it so slowly that the line is at rest all the time; `ContactLine::ramp` (feature `dynamics`) in a given
/// time.
///
/// ```
/// # #[cfg(feature = "embedded")]
/// # fn main() -> Result<(), interp::Error> {
/// use interp::{Elastic, Hysteresis, Imposed, System, Table};
///
/// let film = Elastic::new(3.5e6, 0.5)?;
/// let substrate = Elastic::new(2e11, 0.25)?;
/// let system = System { sphere_radius: 1e-3, sphere_modulus: 2e6, film, film_thickness: 1e-6, substrate };
/// let contact = Table::embedded().contact(&system)?;
/// let mut line = contact.line(Hysteresis::new(0.03, 0.05)?, 50e-6)?;
/// let loaded = line.impose(Imposed::Load(1e-3))?.expect("in contact");
/// let unloaded = line.impose(Imposed::Load(0.8e-3))?.expect("in contact");
/// assert_eq!(unloaded.contact_radius, loaded.contact_radius); // pinned
/// assert_eq!(line.impose(Imposed::Load(-0.3e-3))?, None); // pulled off
/// # Ok(()) }
/// # #[cfg(not(feature = "embedded"))]
/// # fn main() {}
/// ```
#[derive(Clone, Debug)]
pub struct ContactLine<'a, L> {
    pub(crate) contact: &'a Contact,
    pub(crate) law: L,
    /// None once the contact has parted.
    pub(crate) state: Option<LineState>,
}

impl Contact {
    /// The line of a contact that has slowly grown to radius `a` (m).
    ///
    /// # Errors
    /// [`Error::OutsideTable`] where the curve does not cover `a/t`; [`Error::Unphysical`] for `a <= 0` or NaN, and for a law whose energies
    /// at rest are negative, infinite or in the wrong order; [`Error::MissingQuantity`] without all four.
    pub fn line<L: CrackTip>(&self, law: L, a: f64) -> Result<ContactLine<'_, L>, Error> {
        let [advancing, _] = crack_tip::checked(law.at_rest())?;
        let (load, penetration) = self.load_and_penetration(a, advancing)?;
        let state = LineState { contact_radius: a, load, penetration, energy_release_rate: advancing };
        Ok(ContactLine { contact: self, law, state: Some(state) })
    }
}

impl<L: CrackTip> ContactLine<'_, L> {
    /// The contact as it is; `None` once it has parted.
    pub const fn state(&self) -> Option<LineState> {
        self.state
    }

    /// Brings the load or the penetration slowly to a value. Gives the new state; `None` once the contact has parted, which is for good.
    ///
    /// The line stays where it is while the energy release rate is between the two energies of the [law at rest](CrackTip::at_rest).
    /// Beyond them it goes to the nearest radius where `G` is the energy again, in a jump if need be, whose kinetic energy is lost. Where
    /// there is none, the contact parts. All at once or in steps, if they do not change their direction, makes no difference.
    ///
    /// # Errors
    /// [`Error::OutsideTable`] where the line leaves the curve; [`Error::Unphysical`] for a value that is not finite. The line then stays
    /// where it was.
    pub fn impose(&mut self, imposed: Imposed) -> Result<Option<LineState>, Error> {
        let Some(state) = self.state else { return Ok(None) };
        let start = state.contact_radius;
        let rate = |a| imposed.energy_release_rate(self.contact, a);
        let ([advancing, receding], here) = (self.law.at_rest(), rate(start)?);
        let [least, most] = self.contact.contact_radius_range();
        let range @ [least, most] = [least.max(start / FAR), most.min(start * FAR)];
        let rest = if here > receding {
            let root = first_root(start, least, |a| Ok(rate(a)? - receding))?;
            if root.is_none() && !parts(least, rate)? {
                return Err(outside(least.next_down(), range));
            }
            root.map(|a| (a, receding))
        } else if here < advancing {
            let root = first_root(start, most, |a| Ok(advancing - rate(a)?))?;
            Some((root.ok_or_else(|| outside(most.next_up(), range))?, advancing))
        } else {
            Some((start, here))
        };
        self.state = rest.map(|(a, energy)| imposed.state(self.contact, a, energy)).transpose()?;
        Ok(self.state)
    }
}

impl Imposed {
    /// The energy release rate (J/m^2) at contact radius `a` (m).
    pub(crate) fn energy_release_rate(self, contact: &Contact, a: f64) -> Result<f64, Error> {
        match self {
            Self::Load(load) => contact.energy_release_rate_at_load(a, load),
            Self::Penetration(penetration) => contact.energy_release_rate_at_penetration(a, penetration),
        }
    }

    /// The state at contact radius `a` (m), whose energy release rate is known.
    pub(crate) fn state(self, contact: &Contact, a: f64, energy_release_rate: f64) -> Result<LineState, Error> {
        let (mut load, mut penetration) = contact.load_and_penetration(a, energy_release_rate.abs())?;
        if energy_release_rate < 0.0 {
            // The edge presses: the flat punch is added, not taken away.
            let (load_0, penetration_0) = contact.load_and_penetration(a, 0.0)?;
            (load, penetration) = (2.0 * load_0 - load, 2.0 * penetration_0 - penetration);
        }
        match self {
            Self::Load(imposed) => load = imposed,
            Self::Penetration(imposed) => penetration = imposed,
        }
        Ok(LineState { contact_radius: a, load, penetration, energy_release_rate })
    }
}

/// The first root of `f` from `start` towards `end`; `f` is positive at `start`.
fn first_root(start: f64, end: f64, f: impl Fn(f64) -> Result<f64, Error>) -> Result<Option<f64>, Error> {
    let point = |a: f64| Ok((a, f(a)?));
    let mut back = [point(start)?; 2];
    while back[1].0 != end {
        let next = point(if end > start { end.min(back[1].0 * STRIDE) } else { end.max(back[1].0 / STRIDE) })?;
        if next.1 <= 0.0 {
            return bisect(back[1].0, next.0, f).map(Some);
        }
        if back[1].1 <= back[0].1 && back[1].1 <= next.1 {
            // Two roots that almost coincide would be between the steps: the line is about to jump.
            let (a, least) = minimum(back[0].0, next.0, &f)?;
            if least <= 0.0 {
                return bisect(back[0].0, a, f).map(Some);
            }
        }
        back = [back[1], next];
    }
    Ok(None)
}

/// The minimum of `f` between two places, and where it is.
fn minimum(mut from: f64, mut to: f64, f: impl Fn(f64) -> Result<f64, Error>) -> Result<(f64, f64), Error> {
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    for _ in 0..SECTIONS {
        let (left, right) = (to - golden * (to - from), from + golden * (to - from));
        if f(left)? < f(right)? { to = right } else { from = left }
    }
    let middle = 0.5 * (from + to);
    Ok((middle, f(middle)?))
}

/// The root of `f`, positive at the first place and not at the second.
fn bisect(mut positive: f64, mut negative: f64, f: impl Fn(f64) -> Result<f64, Error>) -> Result<f64, Error> {
    loop {
        let middle = 0.5 * (positive + negative);
        if middle == positive || middle == negative {
            return Ok(negative);
        }
        if f(middle)? > 0.0 { positive = middle } else { negative = middle }
    }
}

/// Whether a contact that shrinks to radius `a` will part: the smaller it is, the larger its energy release rate.
pub(crate) fn parts(a: f64, rate: impl Fn(f64) -> Result<f64, Error>) -> Result<bool, Error> {
    Ok(rate(a)? > rate(a * STRIDE)?)
}

/// A contact line that goes to a radius (m) outside those where it can be followed.
pub(crate) fn outside(value: f64, [from, to]: [f64; 2]) -> Error {
    Error::OutsideTable { axis: "radius that the contact line goes to (m)", value, from, to }
}
