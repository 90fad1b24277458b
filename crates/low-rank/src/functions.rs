//! The functions in which a core is expanded on an interval of its axis.

use std::f64::consts::PI;

/// The largest number of functions on an interval.
pub(crate) const MOST_FUNCTIONS: usize = 8;

/// The functions whose sum is a core on an interval.
///
/// They are the Chebyshev polynomials `T0`, `T1`, `T2 - T0`, `T3 - T1`, `T4 - T0` and so on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Functions {
    /// The ends of the interval.
    pub(crate) ends: [f64; 2],
    /// The number of functions.
    pub(crate) count: usize,
}

impl Functions {
    /// The number of functions that do not vanish at both ends; they are the first.
    pub(crate) const AT_ENDS: usize = 2;

    /// Evaluates the functions and their slopes at `u`.
    #[inline(always)]
    pub(crate) fn evaluate(&self, u: f64) -> ([f64; MOST_FUNCTIONS], [f64; MOST_FUNCTIONS]) {
        if self.count == 1 {
            // An axis of one node has no length: its only function is 1.
            let mut values = [0.0; MOST_FUNCTIONS];
            values[0] = 1.0;
            return (values, [0.0; MOST_FUNCTIONS]);
        }
        let [from, to] = self.ends;
        let length = to - from;
        let (values, slopes) = chebyshev((u - from - (to - u)) / length);
        (values, slopes.map(|slope| 2.0 / length * slope))
    }

    /// Returns the matrix from the coefficients of some polynomials to those of the functions: a
    /// row for each function. `polynomials` evaluates them.
    ///
    /// The functions go through the values at the points where the last of them is largest, the
    /// ends among them, so that the intervals meet.
    pub(crate) fn transform(&self, polynomials: impl Fn(f64) -> Vec<f64>) -> Vec<Vec<f64>> {
        let [from, to] = self.ends;
        let last = self.count - 1;
        if last == 0 {
            return vec![polynomials(from)];
        }
        let mut transform = vec![Vec::new(); self.count];
        for point in 0..=last {
            let angle = |function: usize| PI * (function * point) as f64 / last as f64;
            let s = 0.5 - 0.5 * angle(1).cos();
            let values = polynomials(to - (to - from) * s);
            let at_end = if point == 0 || point == last {
                0.5
            } else {
                1.0
            };
            for (function, row) in transform.iter_mut().enumerate() {
                row.resize(values.len(), 0.0);
                let halved = if function == 0 || function == last {
                    0.5
                } else {
                    1.0
                };
                let share = 2.0 / last as f64 * at_end * halved * angle(function).cos();
                row.iter_mut()
                    .zip(&values)
                    .for_each(|(entry, value)| *entry += share * value);
            }
        }
        // From the Chebyshev polynomials to their differences from the first two.
        for function in 2..self.count {
            let (firsts, row) = transform.split_at_mut(function);
            firsts[function % 2]
                .iter_mut()
                .zip(&row[0])
                .for_each(|(first, entry)| *first += entry);
        }
        transform
    }
}

/// Evaluates `T0`, `T1`, `T2 - T0`, `T3 - T1`, `T4 - T0` and so on, and their derivatives, at `t`.
#[inline(always)]
fn chebyshev(t: f64) -> ([f64; MOST_FUNCTIONS], [f64; MOST_FUNCTIONS]) {
    let (mut values, mut slopes) = ([1.0; MOST_FUNCTIONS], [0.0; MOST_FUNCTIONS]);
    (values[1], slopes[1]) = (t, 1.0);
    for k in 2..MOST_FUNCTIONS {
        values[k] = 2.0 * t * values[k - 1] - values[k - 2];
        slopes[k] = 2.0 * (values[k - 1] + t * slopes[k - 1]) - slopes[k - 2];
    }
    for k in 2..MOST_FUNCTIONS {
        values[k] -= values[k % 2];
        slopes[k] -= slopes[k % 2];
    }
    (values, slopes)
}
