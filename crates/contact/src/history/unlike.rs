//! The error by bodies that do not relax beside a film that does.
//!
//! All bodies are followed as if they relaxed by the law of the film, `phi`. Let `chi` be the relative rise of the
//! elastic load when the other bodies are made rigid. To first order in `chi`, Lee and Radok's integrals with two laws
//! differ from those with one by
//!
//! ```text
//! chi (int phi(t-s) dF(s) - F(t))        of the load F, where a penetration or a spring is imposed
//! chi (F_e(t) - F(t))                    of the elastic load F_e at the contact radius, where F is imposed
//! ```
//!
//! The terms of higher order make the difference smaller. A modulus far from `E_ref` counts, whenever it relaxes:
//! after a relaxation that is over within the first step, and at times far from the reference time of a power law, too.

use super::exponentials::Exponentials;
use super::measured::MeasuredHistory;
use super::{History, HistoryError, TimedContact, UNLIKE, elastic};
use crate::{Contact, Control, CrackTip};

/// The tolerance of the law.
const DIGITS: f64 = 1e-4;

impl<L: CrackTip> History<'_, L> {
    /// Returns the bound of the error by bodies that do not relax in a measured history, in parts of
    /// the largest load; 0 unless [`History::beside`] is told of them.
    ///
    /// # Errors
    /// [`HistoryError::UnlikeBodies`] above 2e-2; [`HistoryError::OtherBodies`] if the rigid bodies are
    /// not those of this history; [`contact::Error::OutsideRadii`](crate::Error::OutsideRadii) where the
    /// curve of the rigid bodies does not hold the contact.
    pub fn unlike_bodies(&self, measured: &MeasuredHistory) -> Result<f64, HistoryError> {
        match self.rigid {
            Some(rigid) => self.unlike(rigid, Control::Displacement, &measured.states),
            None => Ok(0.0),
        }
    }

    /// Returns the bound of the error by bodies that do not relax, in parts of the largest load, or of the largest
    /// penetration where loads are imposed.
    pub(super) fn unlike(
        &self,
        rigid: &Contact,
        control: Control,
        states: &[TimedContact],
    ) -> Result<f64, HistoryError> {
        if !rigid.bodies.are_rigid_beside(&self.contact.bodies) {
            return Err(HistoryError::OtherBodies);
        }
        let largest = |numbers: &mut dyn Iterator<Item = f64>| numbers.fold(0.0, f64::max);
        let deepest = largest(&mut states.iter().map(|at| at.state.penetration));
        if deepest == 0.0 {
            return Ok(0.0);
        }
        let load = |contact: &Contact| -> Result<f64, HistoryError> {
            let a = elastic::radius_of(contact, "penetration", deepest, |node| node.penetration)?;
            Ok(contact.load(a, 0.0)?)
        };
        let chi = (load(rigid)? / load(self.contact)? - 1.0).max(0.0);
        let loads: Vec<f64> = states.iter().map(|at| at.state.load).collect();
        let (what, others) = if control == Control::Load {
            let elastic = |at: &TimedContact| match at.state.contact_radius {
                0.0 => Ok(0.0),
                a => self.contact.load(a, 0.0),
            };
            let elastic: Result<Vec<f64>, _> = states.iter().map(elastic).collect();
            ("penetration", elastic?)
        } else {
            ("load", self.relaxed_again(&loads, states))
        };
        let unit = match control {
            Control::Load => largest(&mut others.iter().copied()),
            _ => largest(&mut loads.iter().map(|load| load.abs())),
        };
        let pairs = loads.iter().zip(&others);
        let departure = largest(&mut pairs.map(|(load, other)| (other - load).abs()));
        let bound = if departure > 0.0 {
            chi * departure / unit
        } else {
            0.0
        };
        if bound > UNLIKE {
            return Err(HistoryError::UnlikeBodies { what, bound, chi });
        }
        Ok(bound)
    }

    /// Returns `int phi(t-s) dF(s)` at the times of the states, between which the loads `F` are straight.
    fn relaxed_again(&self, loads: &[f64], states: &[TimedContact]) -> Vec<f64> {
        let steps = states.windows(2).map(|pair| pair[1].time - pair[0].time);
        let shortest = steps
            .filter(|step| *step > 0.0)
            .fold(f64::INFINITY, f64::min);
        let duration = states[states.len() - 1].time - states[0].time;
        let law = Exponentials::of_steps(&self.relaxation, [shortest, duration], DIGITS);
        let mut memory = vec![0.0; law.len()];
        let mut relaxed = vec![law.value(shortest) * loads[0]];
        for (pair, at) in loads.windows(2).zip(states.windows(2)) {
            let step = at[1].time - at[0].time;
            if step == 0.0 {
                relaxed.push(relaxed[relaxed.len() - 1]);
                continue;
            }
            let rate = (pair[1] - pair[0]) / step;
            let terms = law.weights.iter().zip(&law.rates);
            let mut sum = law.constant * pair[1] + law.impulse * rate;
            for ((weight, fall), memory) in terms.zip(&mut memory) {
                let left = (-fall * step).exp();
                *memory = *memory * left - rate * (-fall * step).exp_m1() / fall;
                sum += weight * *memory;
            }
            relaxed.push(sum);
        }
        relaxed
    }
}
