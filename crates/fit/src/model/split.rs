//! Where contact and baseline meet in a way between the largest contact and none.

use super::corner::level_after_corner;
use crate::statistics::{MEDIAN, median};

/// Steps and levels count if they exceed the noise by this factor.
const SIGNIFICANT: f64 = 6.0;
/// Readings nearer to the baseline than this factor of the noise may lie on it.
const NEAR: f64 = 5.0;
/// The part of the last readings from which a baseline without a jump is read.
const TAIL: f64 = 0.2;
/// The scatter of the last readings, over the noise of neighbours, from which on a contact may be among them, and a corner is
/// sought. Few readings scatter as much by chance.
const UNEVEN: f64 = 1.2;
/// The rise of the last readings above a level, over the noise, that is more than chance: the standard deviation of
/// their median is 0.6 to 0.8 noises.
const RISE: f64 = 2.0;
/// Ways with fewer readings are all in contact.
pub(super) const FEWEST: usize = 5;
/// How many of the largest steps may be the jump.
const MOST_JUMPS: usize = 16;
/// The readings whose median tells on which side of a step they are, so that a spike is no jump. A retract with one
/// or two points in tension may have no jump by this; its flat end then tells where the contact ends.
const SIDE: usize = 5;

/// What is known of the baseline before the fit.
#[derive(Clone, Copy, Debug)]
pub(super) struct KnownBaseline {
    /// The level, if it is not free.
    pub level: f64,
    /// Whether the fit may change the level.
    pub level_is_free: bool,
    /// The noise of a reading.
    pub noise: f64,
    /// Whether the slope is free: one that is read a little wrong makes corners of a baseline.
    pub slope_is_free: bool,
}

impl KnownBaseline {
    /// Returns how many `readings` are in contact, and the number of the first one on the baseline. The readings
    /// go from the largest contact to none.
    pub fn split(&self, readings: &[f64]) -> [usize; 2] {
        self.jump(readings)
            .unwrap_or_else(|| self.flat_end(readings))
    }

    /// Returns by how much `readings` fall below the baseline before they jump to it, if they do by more than chance.
    pub fn pull(&self, readings: &[f64]) -> Option<f64> {
        let [contact_ends, baseline_begins] = self.jump(readings)?;
        let level = median(readings[baseline_begins..].to_vec());
        let lowest = readings[..contact_ends].iter().copied();
        Some(level - lowest.fold(level, f64::min))
    }

    /// Returns the level of `readings` if they may be the baseline, and their noise, which is more than that of
    /// neighbours where it lasts for some readings.
    fn level(&self, readings: &[f64]) -> Option<[f64; 2]> {
        let level = median(readings.to_vec());
        let scatter = median(readings.iter().map(|y| (y - level).abs()).collect());
        let is_known = (level - self.level).abs() <= SIGNIFICANT * self.noise;
        if readings.len() < 3 {
            return is_known.then_some([level, self.noise]);
        }
        let is_flat = scatter <= SIGNIFICANT * self.noise;
        let is_baseline = is_flat && (is_known || self.level_is_free);
        is_baseline.then_some([level, self.noise.max(scatter / MEDIAN)])
    }

    /// Returns where a way with a jump is split. An adhesive contact ends, and begins, in tension, with a step from below
    /// the reading without a contact to it.
    fn jump(&self, readings: &[f64]) -> Option<[usize; 2]> {
        let step = |i: usize| readings[i + 1] - readings[i];
        let end = |length: usize| median(readings[readings.len() - length..].to_vec());
        // Most of the usual end may be a contact in tension.
        let free = end(tail(readings.len())).max(end(FEWEST));
        let mut jumps: Vec<usize> = (0..readings.len() - 1)
            .filter(|&i| readings[i] < free && step(i) > SIGNIFICANT * self.noise)
            .collect();
        jumps.sort_by(|&i, &j| step(j).total_cmp(&step(i)));
        jumps.into_iter().take(MOST_JUMPS).find_map(|jump| {
            let (before, after) = readings.split_at(jump + 1);
            let [level, noise] = self.level(after)?;
            let middle = |side: &[f64]| median(side.to_vec());
            let off = |side: &[f64]| (middle(side) - level).abs();
            let below = &before[before.len().saturating_sub(SIDE)..];
            let above = &after[..SIDE.min(after.len())];
            // After the jump the readings are on the baseline, or a tether holds them in between.
            let stays_up = off(above) <= (NEAR * noise).max(0.5 * step(jump))
                || middle(above) - middle(below) > 0.5 * step(jump);
            let is_jump = step(jump) > SIGNIFICANT * noise && off(below) > NEAR * noise && stays_up;
            if !is_jump {
                return None;
            }
            let mut ends = jump;
            while ends > 0 && step(ends - 1) > 0.5 * step(jump) {
                ends -= 1;
            }
            let lands = after.iter().position(|y| (y - level).abs() <= NEAR * noise);
            Some([ends + 1, jump + 1 + lands.unwrap_or(0)])
        })
    }

    /// Returns where a way with a flat end is split.
    ///
    /// The first contact is where two neighbours leave the baseline. Between it and the contact point a force rises from
    /// the noise: it takes as far again until it is 3 times as large. A tension that is nowhere so large ends by a jump
    /// that the noise hides, or as slowly as it has fallen from its largest value.
    pub fn flat_end(&self, readings: &[f64]) -> [usize; 2] {
        let count = readings.len();
        // The level, its noise, and how many of the last readings have it in any case.
        let end = |length: usize, certain: usize| {
            let [level, noise] = self.level(&readings[count - length..])?;
            Some((level, noise, certain))
        };
        let usual = || end(tail(count), 0);
        let short = || {
            if self.slope_is_free {
                return None;
            }
            let level = level_after_corner(readings, self.noise)?;
            end(level, level / 2)
        };
        let found = usual()
            .filter(|(_, noise, _)| *noise <= UNEVEN * self.noise)
            .or_else(short)
            .or_else(usual);
        let Some((level, noise, certain)) = found else {
            return [count; 2];
        };
        let off = |i: usize, by: f64| (readings[i] - level).abs() > by * noise;
        let leaves = |by: f64| {
            let found = (1..count).rev().find(|&i| off(i, by) && off(i - 1, by));
            found.map_or(0, |i| i + 1)
        };
        let (contact_ends, clear) = (leaves(NEAR), leaves(3.0 * NEAR));
        let is_pressed = |end: usize| end == 0 || readings[end - 1] > level;
        let margin = if is_pressed(clear) && !is_pressed(contact_ends) {
            let lowest = (clear..contact_ends).min_by(|&i, &j| readings[i].total_cmp(&readings[j]));
            SIDE.max(contact_ends - lowest.unwrap_or(contact_ends))
        } else {
            2 * contact_ends.saturating_sub(clear) + 1
        };
        let baseline_begins = (contact_ends + margin).min(count - certain);
        // A retract that ends in contact, after its largest tension, is flat there, and rises behind it.
        let last = SIDE.min(tail(count) / 2);
        let rise = median(readings[count - last..].to_vec()) - level;
        if self.level_is_free && rise > RISE * self.noise && baseline_begins + FEWEST > count {
            return [count; 2];
        }
        [contact_ends, baseline_begins.max(contact_ends)]
    }
}

/// Returns the number of the last of `count` readings that are compared with the others.
pub(super) fn tail(count: usize) -> usize {
    ((TAIL * count as f64) as usize).clamp(FEWEST, count)
}

#[cfg(test)]
mod tests {
    use super::KnownBaseline;

    /// A baseline of which only the noise is known.
    fn baseline(noise: f64) -> KnownBaseline {
        KnownBaseline {
            level: 0.0,
            level_is_free: true,
            noise,
            slope_is_free: false,
        }
    }

    /// A pull-off of 8 noises, in which no step is more than 6, leaves the baseline behind it.
    #[test]
    fn a_jump_in_the_noise_does_not_take_the_baseline() {
        let contact = (0..100).map(|i| 80.0 - 0.8 * f64::from(i));
        let tension = [-2.0, -5.0, -7.0, -8.0, -8.0, -5.5];
        let readings: Vec<f64> = contact.chain(tension).chain([0.0; 100]).collect();
        let baseline = baseline(1.0);
        assert_eq!(baseline.split(&readings), [106, 111]);
    }

    /// A reading in the middle of a jump is of neither side.
    #[test]
    fn a_jump_may_have_two_steps() {
        let contact = (0..100).map(|i| 80.0 - 0.8 * f64::from(i));
        let tension = [-2.0, -5.0, -7.0, -8.0, -8.0, -5.0];
        let readings: Vec<f64> = contact.chain(tension).chain([0.0; 100]).collect();
        assert_eq!(baseline(0.1).split(&readings), [105, 106]);
    }

    /// A tether that holds 45 % of the pull-off force is no contact.
    #[test]
    fn a_tether_is_no_contact() {
        let contact = (0..200).map(f64::from);
        let contact = contact.map(|i| 8.0 * (1.0 - i / 199.0).powf(1.5) - (i / 25.0).min(1.0));
        let readings: Vec<f64> = contact.chain([-0.45; 30]).chain([0.0; 100]).collect();
        let baseline = baseline(0.01);
        assert_eq!(baseline.split(&readings), [200, 230]);
    }

    /// The largest tension of a retract that ends in contact is flat, as a baseline is.
    #[test]
    fn a_largest_tension_is_no_baseline() {
        let parabola = (0..80).map(|i| 0.25 * f64::from(i - 72).powi(2));
        let readings: Vec<f64> = parabola.collect();
        let baseline = baseline(1.0);
        assert_eq!(baseline.split(&readings), [80; 2]);
        // Of few readings, too.
        let few = (0..20).map(|i| 3.0 * f64::from(i - 16).powi(2));
        assert_eq!(baseline.split(&few.collect::<Vec<f64>>()), [20; 2]);
        // Held where it is largest, it cannot be told from one.
        let held: Vec<f64> = readings[..73].iter().copied().chain([0.0; 7]).collect();
        assert_ne!(baseline.split(&held)[0], 80);
    }
}
