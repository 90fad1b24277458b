//! Times: how they are measured and how they are printed.

use std::hint::black_box;
use std::time::Instant;

/// How carefully times are measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Timing {
    /// For publication: medians of many calls, and several rounds.
    Thorough,
    /// For a comparison by [`compare`](super::compare), which leaves times out: one call.
    Brief,
}

impl Timing {
    /// Returns the time of a call in seconds: [`seconds`] if thorough.
    pub fn seconds<T>(self, budget: f64, call: impl FnMut() -> T) -> f64 {
        match self {
            Self::Thorough => seconds(budget, call),
            Self::Brief => seconds(0.0, call),
        }
    }

    /// Returns the number of rounds: `thorough` or 1.
    pub const fn rounds(self, thorough: usize) -> usize {
        match self {
            Self::Thorough => thorough,
            Self::Brief => 1,
        }
    }

    /// Returns the time of one call over that of another. Both are made with each of `items` in
    /// turn, for 0.02 s a round, in turns with each other, and the fastest of ten rounds count.
    /// Before that, each is made once with every item.
    ///
    /// # Errors
    /// Those of the calls.
    pub fn ratio<I, A, B, EA, EB, E>(
        self,
        items: &[I],
        mut one: impl FnMut(&I) -> Result<A, EA>,
        mut other: impl FnMut(&I) -> Result<B, EB>,
    ) -> Result<f64, E>
    where
        E: From<EA> + From<EB>,
    {
        const SECONDS: f64 = 0.02;
        const ROUNDS: usize = 10;
        for item in items {
            one(item)?;
            other(item)?;
        }
        let [mut ones, mut others] = [Times::default(), Times::default()];
        for _ in 0..self.rounds(ROUNDS) {
            let mut next = items.iter().cycle();
            ones.add(self.seconds(SECONDS, || one(next.next()?).ok()));
            let mut next = items.iter().cycle();
            others.add(self.seconds(SECONDS, || other(next.next()?).ok()));
        }
        Ok(ones.fastest() / others.fastest())
    }
}

/// Returns the median time of a call in seconds.
///
/// Calls for about `budget` seconds, once at least. Calls that are shorter than the clock resolves
/// are timed several at a time.
pub fn seconds<T>(budget: f64, mut call: impl FnMut() -> T) -> f64 {
    /// A clock's tick is less than a hundredth of this.
    const RESOLVED: f64 = 1e-5;
    /// More samples do not change a median any more.
    const SAMPLES: f64 = 201.0;
    let mut sample = |calls: u32| {
        let start = Instant::now();
        for _ in 0..calls {
            black_box(call());
        }
        start.elapsed().as_secs_f64()
    };
    let mut calls = 1;
    let mut first = sample(calls);
    while first < RESOLVED {
        calls *= 2;
        first = sample(calls);
    }
    let samples = (budget / first).clamp(1.0, SAMPLES) as usize;
    let times = if samples == 1 {
        vec![first]
    } else {
        (0..samples).map(|_| sample(calls)).collect()
    };
    median(times) / f64::from(calls)
}

/// The times of several runs of one piece of work, in seconds.
#[derive(Clone, Debug, Default)]
pub struct Times(Vec<f64>);

impl Times {
    /// Adds the time of one more run.
    pub fn add(&mut self, seconds: f64) {
        self.0.push(seconds);
    }

    /// Returns the shortest time; infinity if there is no run.
    pub fn fastest(&self) -> f64 {
        self.0.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// Returns the noise: the longest time less the shortest, infinity if there are fewer than two
    /// runs.
    pub fn noise(&self) -> f64 {
        if self.0.len() < 2 {
            f64::INFINITY
        } else {
            self.0.iter().copied().fold(0.0, f64::max) - self.fastest()
        }
    }

    /// Returns the shortest time less the shortest time of `other`, which may be negative; none if
    /// the difference is not above the noise of both together.
    pub fn longer_than(&self, other: &Self) -> Option<f64> {
        let difference = self.fastest() - other.fastest();
        (difference.abs() > self.noise() + other.noise()).then_some(difference)
    }
}

impl FromIterator<f64> for Times {
    fn from_iter<I: IntoIterator<Item = f64>>(seconds: I) -> Self {
        Self(seconds.into_iter().collect())
    }
}

/// Returns the median of at least one number, of an even number of them the upper one.
///
/// # Panics
/// If there is none.
pub fn median(mut numbers: Vec<f64>) -> f64 {
    numbers.sort_by(f64::total_cmp);
    numbers[numbers.len() / 2]
}

/// Returns a time with its unit.
pub fn human(seconds: f64) -> String {
    match seconds {
        ..1e-8 => format!("{:.1} ns", 1e9 * seconds),
        ..1e-6 => format!("{:.0} ns", 1e9 * seconds),
        ..1e-3 => format!("{:.0} µs", 1e6 * seconds),
        ..1e-2 => format!("{:.1} ms", 1e3 * seconds),
        ..1.0 => format!("{:.0} ms", 1e3 * seconds),
        ..100.0 => format!("{seconds:.1} s"),
        _ => format!("{seconds:.0} s"),
    }
}
