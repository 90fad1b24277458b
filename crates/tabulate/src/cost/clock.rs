//! Times: how they are measured and how they are printed.

use std::hint::black_box;
use std::time::Instant;

/// The median time of a call in seconds. Of about `budget` seconds of calls, one at least; what a
/// clock cannot resolve is called many times between two looks at it.
pub fn seconds<T>(budget: f64, mut call: impl FnMut() -> T) -> f64 {
    /// A clock's tick is less than a hundredth of this.
    const RESOLVED: f64 = 1e-5;
    /// More samples change a median no more.
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

/// The middle one of at least one time.
///
/// # Panics
/// If there is none.
pub fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// A time with its unit.
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
