//! A load that grows or is held: the contact radius is that of the elastic contact under the load
//! `int J(t-t') dF`, with the creep compliance `J`.

use super::exponentials::Creep;
use super::moments::one_less_mean;
use super::program::{Instant, Program};
use super::{Phase, TimedContact, elastic};
use crate::{Contact, Control, Error, State};

/// The part of the largest load by which one that is held may fall from rounding.
const HELD: f64 = 1e-14;
/// The error of radius and penetration of contacts smaller than those of the curve over those of the contact, at most: a curve
/// of a film that begins at a/t = 0.5 gives 0.13.
const BELOW: f64 = 0.3;

/// Returns whether the load never falls.
pub(super) fn grows(program: &Program) -> bool {
    let slack = HELD * program.largest();
    let mut pairs = program.values.windows(2);
    pairs.all(|pair| pair[0] <= pair[1] + slack)
}

/// Returns the elastic loads (N, in units of the modulus at `E_ref`) at instants.
pub(super) fn elastic_loads(creep: &Creep, instants: &[Instant]) -> Vec<f64> {
    // int (1 - exp(-rate (t-t'))) dF of each term, which loses no digits at short times.
    let mut memories = vec![0.0; creep.rates.len()];
    let mut flowed = 0.0;
    let mut loads = vec![0.0];
    for pair in instants.windows(2) {
        let [from, to] = [pair[0], pair[1]];
        let [before, after] = [from.value.max(0.0), to.value.max(0.0)];
        // The load begins where it passes 0, and nothing is remembered before.
        let part = if from.value < 0.0 && after > 0.0 {
            after / (after - from.value)
        } else {
            1.0
        };
        let (h, rise) = (part * (to.time - from.time), after - before);
        flowed += 0.5 * h * (before + after);
        let mut load = creep.instantaneous * after + creep.flow * flowed;
        for ((memory, amplitude), rate) in
            memories.iter_mut().zip(&creep.amplitudes).zip(&creep.rates)
        {
            let z = rate * h;
            let grown = -(-z).exp_m1();
            *memory += grown * (before - *memory) + rise * one_less_mean(z);
            load += amplitude * *memory;
        }
        loads.push(load);
    }
    loads
}

/// Returns the states under the elastic loads at instants, and the error of the smallest ones in parts of the largest.
///
/// Each is sought on the elastic contact itself: an interpolated one loses digits at small loads,
/// where the penetration rises steeply with the load.
pub(super) fn states(
    contact: &Contact,
    loads: &[f64],
    instants: &[Instant],
) -> Result<(Vec<TimedContact>, f64), Error> {
    let most = loads.iter().copied().fold(0.0, f64::max);
    elastic::has_flat_end(contact)?;
    let largest = elastic::radius_of(contact, "load", most, |node| node.load)?;
    let [least, _] = contact.search_range()?;
    let smallest = elastic::node(contact, least)?;
    let mut states = Vec::with_capacity(instants.len());
    let mut largest_error: f64 = 0.0;
    let mut before = least;
    for (i, (at, &elastic)) in instants.iter().zip(loads).enumerate() {
        if elastic <= 0.0 {
            states.push(at.apart(Control::Load));
            continue;
        }
        let found = if elastic < smallest.load {
            let found = elastic::smaller_under(&smallest, elastic);
            largest_error = largest_error.max(BELOW * found.radius / largest);
            found
        } else {
            // The load grows, and with it the contact.
            before = elastic::radius_within(contact, [before, largest], elastic, |node| node.load)?;
            elastic::node(contact, before)?
        };
        states.push(TimedContact {
            time: at.time,
            phase: if i > 0 && elastic > loads[i - 1] {
                Phase::Advancing
            } else {
                Phase::Resting
            },
            state: State {
                contact_radius: found.radius,
                load: at.value,
                penetration: found.penetration,
            },
        });
    }
    Ok((states, largest_error))
}
