//! The error by bodies that do not relax beside a film that does.
//!
//! All bodies are followed as if they relaxed by the law of the film, `phi`. Let `chi` be the relative rise of the
//! elastic load when the other bodies are made rigid. To first order in `chi`, Lee and Radok's integrals with two laws
//! differ from those with one by
//!
//! ```text
//! chi (int phi(t-s) dF(s) - F(t))          of the load F, where a penetration or a spring is imposed
//! chi ((F - F_e)/S - (delta - delta_e))    of the penetration delta, where F is imposed
//! ```
//!
//! with the load `F_e`, the penetration `delta_e` and the stiffness `S` of the elastic contact of the same radius. The
//! exact difference of the loads is the first one convolved with a positive kernel whose integral is at most 1.

use super::exponentials::Exponentials;
use super::measured::MeasuredHistory;
use super::{History, TimedContact, UNLIKE, elastic};
use crate::{Contact, Control, Error, State};

/// The tolerance of the law.
const DIGITS: f64 = 1e-4;

impl History<'_> {
    /// Returns the bound of the error by bodies that do not relax in a measured history, in parts of
    /// the largest load; 0 unless [`History::beside`] is told of them. Contact radii may be wrong by more.
    ///
    /// # Errors
    /// [`Error::UnlikeBodies`] above 2e-2; [`Error::Refused`] if the rigid bodies are
    /// not those of this history; [`Error::OutsideRadii`] where the
    /// curve of the rigid bodies does not hold the contact.
    pub fn unlike_bodies(&self, measured: &MeasuredHistory) -> Result<f64, Error> {
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
    ) -> Result<f64, Error> {
        if !rigid.bodies.are_rigid_beside(&self.contact.bodies) {
            return Error::refused(
                "the contact between rigid bodies is not that of this history: it must have the same film, thickness and probe, with a \
                 rigid sphere and a rigid base; the layers of a stack relax all by one law, and so must the other bodies",
            );
        }
        let deepest = largest(states.iter().map(|at| at.state.penetration));
        if deepest <= 0.0 {
            return Ok(0.0);
        }
        let load = |contact: &Contact| -> Result<f64, Error> {
            let a = elastic::radius_of(contact, "penetration", deepest, |node| node.penetration)?;
            contact.load(a, 0.0)
        };
        let chi = load(rigid)? / load(self.contact)? - 1.0;
        if chi <= 0.0 {
            return Ok(0.0);
        }
        let (what, unit, departure) = if control == Control::Load {
            let departures = states.iter().map(|at| self.departure(&at.state));
            let departures: Result<Vec<f64>, _> = departures.collect();
            ("penetration", deepest, largest(departures?))
        } else {
            let loads: Vec<f64> = states.iter().map(|at| at.state.load).collect();
            let pairs = self.relaxed_again(&loads, states).into_iter().zip(&loads);
            let departure = largest(pairs.map(|(relaxed, load)| (relaxed - load).abs()));
            (
                "load",
                largest(loads.iter().map(|load| load.abs())),
                departure,
            )
        };
        let bound = if departure == 0.0 {
            0.0
        } else {
            chi * departure / unit
        };
        if bound <= UNLIKE {
            Ok(bound)
        } else {
            Err(Error::UnlikeBodies { what, bound, chi })
        }
    }

    /// Returns by how much (m) the penetration is not that of a body that rests under its load; that of a dent without
    /// contact.
    fn departure(&self, state: &State) -> Result<f64, Error> {
        let a = state.contact_radius;
        if a == 0.0 {
            return Ok(state.penetration.max(0.0));
        }
        let (load, penetration) = self.contact.load_and_penetration(a, 0.0)?;
        let of_load = (state.load - load) / self.contact.stiffness(a)?;
        Ok((of_load - (state.penetration - penetration)).abs())
    }

    /// Returns `int phi(t-s) dF(s)` at the times of the states, between which the loads `F` are straight.
    fn relaxed_again(&self, loads: &[f64], states: &[TimedContact]) -> Vec<f64> {
        let steps = states.windows(2).map(|pair| pair[1].time - pair[0].time);
        let shortest = steps.fold(f64::INFINITY, f64::min);
        let duration = states[states.len() - 1].time - states[0].time;
        let law = Exponentials::of_steps(&self.relaxation, [shortest, duration], DIGITS);
        let mut memory = vec![0.0; law.len()];
        let mut relaxed = vec![0.0];
        for (pair, at) in loads.windows(2).zip(states.windows(2)) {
            let step = at[1].time - at[0].time;
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

/// Returns the largest number and at least 0; NaN if there is one. An order of all floats would put a NaN with a minus
/// sign first, and lose it.
fn largest(numbers: impl IntoIterator<Item = f64>) -> f64 {
    let larger = |a: f64, b: f64| if b > a || b.is_nan() { b } else { a };
    numbers.into_iter().fold(0.0, larger)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_that_is_none_is_the_largest_wherever_it_stands() {
        assert_eq!(largest([]), 0.0);
        assert_eq!(largest([-2.0, 3.0, 1.0]), 3.0);
        for nan in [f64::NAN, -f64::NAN] {
            for place in 0..3 {
                let mut numbers = [1.0, f64::INFINITY, 2.0];
                numbers[place] = nan;
                assert!(largest(numbers).is_nan(), "{nan:?} at {place}");
            }
        }
    }

    /// `int_0^t (t-s)^-n ds = t^(1-n)/(1-n)`. Of a steep law most of it is before the shortest time that the sum of
    /// exponentials resolves.
    #[test]
    fn loads_that_rise_evenly_relax_in_closed_form() {
        let contact = Contact::half_space(&interp::HalfSpace {
            probe: interp::Probe::Paraboloid { radius: 1.0 },
            sphere_modulus: f64::INFINITY,
            solid: interp::Elastic::new(1.0, 0.5).expect("physical"),
        });
        let contact = contact.expect("physical");
        for exponent in [0.2, 0.9] {
            let law = crate::Relaxation::PowerLaw {
                exponent,
                time: 1.0,
            };
            let history = contact.history(&law).expect("a law");
            let times: Vec<f64> = (0..=20).map(|i| 0.05 * f64::from(i)).collect();
            let states: Vec<TimedContact> = times
                .iter()
                .map(|&time| TimedContact::separated(time, 0.0))
                .collect();
            let relaxed = history.relaxed_again(&times, &states);
            for (time, relaxed) in times.iter().zip(relaxed).skip(1) {
                let expected = time.powf(1.0 - exponent) / (1.0 - exponent);
                let error = relaxed / expected - 1.0;
                assert!(error.abs() < 1e-5, "{exponent} {time}: {error:e}");
            }
        }
    }
}
