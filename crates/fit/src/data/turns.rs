//! How often a list of numbers turns back, and whether it is in an order at all.

use crate::statistics::{median, range};

/// The part of the range by which the numbers go back where they turn.
const BACK: f64 = 0.5;
/// The largest mean step between ranks, over their number, of numbers in an order. In no order it is a
/// third; two curves of ten points have three turns of the range in twenty steps.
const LARGEST_STEP: f64 = 1.0 / 6.0;
/// The number of neighbours of which the middle one is taken: two numbers that stand out are no turn.
const NEIGHBOURS: usize = 5;

/// Returns how often the numbers turn back; 0 where they have no order.
pub fn turns(numbers: &[f64]) -> usize {
    if numbers.len() < NEIGHBOURS || !have_order(numbers) {
        return 0;
    }
    let middles = numbers
        .windows(NEIGHBOURS)
        .map(|some| median(some.to_vec()));
    let numbers: Vec<f64> = middles.collect();
    let back = BACK * range(numbers.iter().copied());
    let mut turns = 0;
    // The least and the largest number since the last turn, and whether the numbers grow.
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    let mut grows = None;
    for &number in &numbers {
        (low, high) = (low.min(number), high.max(number));
        let now = if number - low > back {
            true
        } else if high - number > back {
            false
        } else {
            continue;
        };
        turns += usize::from(grows.is_some_and(|before| before != now));
        grows = Some(now);
        if now { low = number } else { high = number }
    }
    turns
}

/// Tells whether numbers are in no order: they jump to and fro by much of their range, where those of a rest hardly change.
pub fn jumps(numbers: &[f64]) -> bool {
    /// The ranks of fewer differ by much from one to the next in any order.
    const FEWEST: usize = 20;
    let range = range(numbers.iter().copied());
    let steps = numbers.windows(2).map(|two| (two[1] - two[0]).abs());
    let mean = steps.sum::<f64>() / numbers.len() as f64;
    numbers.len() >= FEWEST && mean > LARGEST_STEP * range && !have_order(numbers)
}

/// Tells whether neighbours have similar ranks.
fn have_order(numbers: &[f64]) -> bool {
    let mut by_size: Vec<usize> = (0..numbers.len()).collect();
    by_size.sort_by(|&a, &b| numbers[a].total_cmp(&numbers[b]));
    let mut ranks = vec![0.0; numbers.len()];
    for (rank, index) in (0_u32..).zip(by_size) {
        ranks[index] = f64::from(rank);
    }
    let steps = ranks.windows(2).map(|two| (two[1] - two[0]).abs());
    let count = numbers.len() as f64;
    steps.sum::<f64>() <= LARGEST_STEP * count * (count - 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_turn_and_points_in_no_order_do_not() {
        let up = |n: i32| (0..n).map(f64::from);
        let noisy = |(i, x): (usize, f64)| x + 3.0 * ((i * 7919) % 11) as f64 / 11.0;
        let rest = || (0..200).map(|i| 0.1 * (f64::from(i * 7919 % 101) / 101.0));
        let mut spike: Vec<f64> = up(40).collect();
        spike[10..12].fill(1e3);
        // Ways up, down, and at rest.
        let ways = |ways: &str| -> Vec<f64> {
            let way = |way: char| match way {
                'u' => up(20).collect::<Vec<f64>>(),
                'd' => up(20).rev().collect(),
                _ => rest().collect(),
            };
            ways.chars().flat_map(way).collect()
        };
        for (name, numbers, expected) in [
            ("no points", vec![], 0),
            ("one number", vec![1.0; 40], 0),
            ("up", up(40).collect(), 0),
            ("up with noise", up(40).enumerate().map(noisy).collect(), 0),
            ("up with a spike", spike, 0),
            ("down and up", ways("du"), 1),
            ("up twice", ways("uu"), 2),
            ("down twice", ways("dd"), 2),
            ("two cycles", ways("udud"), 3),
            ("up three times", ways("uuu"), 4),
            ("no order", up(40).map(|i| (i * 17.0) % 40.0).collect(), 0),
            ("a long rest", ways("dru"), 0),
        ] {
            assert_eq!(turns(&numbers), expected, "{name}");
            assert_eq!(jumps(&numbers), name == "no order", "{name}");
        }
    }
}
