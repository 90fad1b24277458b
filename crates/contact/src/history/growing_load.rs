//! A load that grows or is held: the contact radius is that of the elastic contact under the load
//! `int J(t-t') dF`, with the creep compliance `J`.

use super::elastic::ElasticLoads;
use super::exponentials::Creep;
use super::moments::one_less_mean;
use super::program::Program;
use super::{HistoryError, Phase, TimedContact};
use crate::{Contact, State};

/// The part of the largest load by which one that is held may fall from rounding.
const HELD: f64 = 1e-14;

/// Returns whether the load never falls.
pub(super) fn grows(program: &Program) -> bool {
    let slack = HELD * program.largest();
    let mut pairs = program.values.windows(2);
    pairs.all(|pair| pair[0] <= pair[1] + slack)
}

/// Returns the elastic loads (N, in units of the modulus at `E_ref`) at the times of the points and
/// those asked for.
pub(super) fn elastic_loads(creep: &Creep, program: &Program, asked: &[f64]) -> Vec<(f64, f64)> {
    let all = program.with(asked);
    // int (1 - exp(-rate (t-t'))) dF of each term, which loses no digits at short times.
    let mut memories = vec![0.0; creep.rates.len()];
    let mut flowed = 0.0;
    let mut loads = vec![(all[0].time, 0.0)];
    for pair in all.windows(2) {
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
        loads.push((pair[1].time, load));
    }
    loads
}

/// Returns the states at the times asked for, and the error of the smallest ones in parts of the largest.
///
/// Each is sought on the elastic contact itself: an interpolated one loses digits at small loads,
/// where the penetration rises steeply with the load.
pub(super) fn states(
    contact: &Contact,
    loads: &[(f64, f64)],
    program: &Program,
    asked: &[f64],
) -> Result<(Vec<TimedContact>, f64), HistoryError> {
    let all = program.with(asked);
    let most = loads.iter().map(|load| load.1).fold(0.0, f64::max);
    let contacts = ElasticLoads::up_to(contact, most)?;
    let mut wanted = asked.iter().copied().peekable();
    let mut states = Vec::with_capacity(asked.len());
    let mut largest_error: f64 = 0.0;
    let mut before = 0.0;
    for (i, (at, &(_, elastic))) in all.iter().zip(loads).enumerate() {
        let grows = i > 0 && elastic > loads[i - 1].1;
        while wanted.next_if_eq(&at.time).is_some() {
            if elastic <= 0.0 {
                states.push(TimedContact::separated(at.time, 0.0));
                continue;
            }
            let [contact_radius, penetration, error] = contacts.state(elastic, before)?;
            before = contact_radius;
            largest_error = largest_error.max(error);
            let phase = if grows {
                Phase::Advancing
            } else {
                Phase::Resting
            };
            let state = State {
                contact_radius,
                load: at.value,
                penetration,
            };
            states.push(TimedContact {
                time: at.time,
                phase,
                state,
            });
        }
    }
    Ok((states, largest_error))
}
