//! Times of lookups and of solves, for one of many points.

use std::hint::black_box;

use super::rows::SOLVED;
use crate::clock::Timing;

/// The seconds spent on measuring each time.
const SECONDS: f64 = 0.05;

impl Timing {
    /// Returns the mean time of `work` on one of `cases`. It returns a number, as storing a whole
    /// [`Result`] with its error takes nanoseconds, too.
    pub(super) fn per_one<T>(self, cases: &[T], work: impl Fn(&T) -> f64) -> f64 {
        let all = || {
            for case in cases {
                black_box(work(black_box(case)));
            }
        };
        self.seconds(SECONDS, all) / cases.len() as f64
    }

    /// Returns the mean time of solves, which differ by a factor of a thousand. Each is timed by
    /// itself, as other programs interrupt long runs.
    pub(super) fn of_solves<T, R>(self, cases: &[T], work: impl Fn(&T) -> R) -> f64 {
        let seconds = |case: &T| self.seconds(SECONDS / SOLVED as f64, || work(black_box(case)));
        cases.iter().map(seconds).sum::<f64>() / cases.len() as f64
    }

    /// Returns the median time of work that is faster when it is repeated: each call has the next
    /// case.
    pub(super) fn of_new_ones<T, R>(self, cases: &[T], work: impl Fn(&T) -> R) -> f64 {
        let mut cases = cases.iter().cycle();
        self.seconds(SECONDS, || {
            work(black_box(cases.next().expect("there are points")))
        })
    }
}
