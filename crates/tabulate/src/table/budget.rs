//! The time that a generation may take, on a clock that can be replaced.

use std::sync::LazyLock;
use std::time::{Duration, Instant};

/// A function that returns the time since some moment, and never less than before.
pub type Clock<'a> = &'a (dyn Fn() -> Duration + Sync);

/// The time that work may take, on one clock.
///
/// [`Budget::of`] reads the machine's clock. [`Budget::on`] takes any other: a clock that counts
/// finished points makes a budget of points, which does not depend on the speed of the machine.
#[derive(Clone, Copy)]
pub struct Budget<'a> {
    clock: Clock<'a>,
    began: Duration,
    whole: Duration,
}

impl Budget<'static> {
    /// Allows `time` from now on the machine's clock.
    pub fn of(time: Duration) -> Self {
        Self::on(&since_start, time)
    }
}

impl<'a> Budget<'a> {
    /// Allows `time` from now on the given clock.
    pub fn on(clock: Clock<'a>, time: Duration) -> Self {
        Self {
            clock,
            began: clock(),
            whole: time,
        }
    }

    /// Returns the time on the clock.
    pub(crate) fn now(&self) -> Duration {
        (self.clock)()
    }

    /// Returns the time left; 0 when the budget is spent.
    pub(crate) fn left(&self) -> Duration {
        let spent = self.now().saturating_sub(self.began);
        self.whole.saturating_sub(spent)
    }

    /// Returns the time allowed from the beginning.
    #[cfg(feature = "figures")]
    pub(crate) fn whole(&self) -> Duration {
        self.whole
    }

    /// Returns true when no time is left.
    pub(crate) fn is_spent(&self) -> bool {
        self.left().is_zero()
    }
}

/// Returns the time since the first call of this function.
fn since_start() -> Duration {
    static START: LazyLock<Instant> = LazyLock::new(Instant::now);
    START.elapsed()
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicU64, Ordering};

    use super::*;

    #[test]
    fn a_budget_is_spent_when_its_clock_has_reached_the_end() {
        let seconds = AtomicU64::new(7);
        let clock = || Duration::from_secs(seconds.load(Ordering::Relaxed));
        let budget = Budget::on(&clock, Duration::from_secs(3));
        for (now, left) in [(7, 3), (9, 1), (10, 0), (11, 0)] {
            seconds.store(now, Ordering::Relaxed);
            assert_eq!(budget.left(), Duration::from_secs(left));
            assert_eq!(budget.is_spent(), left == 0);
        }
    }
}
