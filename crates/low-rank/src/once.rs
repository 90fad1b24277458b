//! Values that are made at their first use, also in the child of a fork.
//!
//! A thread that needs the value of a [`std::sync::OnceLock`] waits while another thread makes it.
//! The child of a fork has only the thread that called `fork`: it would wait for a thread of its
//! parent for ever. Here it makes the value itself.

use std::ops::Deref;
use std::process;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU32, Ordering};
use std::thread;
use std::time::Duration;

/// The time between two looks at a value that another thread makes.
const TICK: Duration = Duration::from_micros(50);

/// A value that is made once in a process.
#[derive(Debug)]
pub struct Once<T> {
    value: OnceLock<T>,
    /// The process whose thread makes the value; 0 where none does.
    maker: AtomicU32,
}

impl<T> Once<T> {
    /// Makes a cell without a value.
    pub const fn new() -> Self {
        Self {
            value: OnceLock::new(),
            maker: AtomicU32::new(0),
        }
    }

    /// Returns the value if it is made.
    #[inline]
    pub fn get(&self) -> Option<&T> {
        self.value.get()
    }

    /// Returns the value. The first call makes it; calls in other threads of this process wait.
    #[inline]
    pub fn get_or_init(&self, make: impl FnOnce() -> T) -> &T {
        self.get().unwrap_or_else(|| self.make(make))
    }

    /// Makes the value, or waits for it.
    #[cold]
    fn make(&self, make: impl FnOnce() -> T) -> &T {
        loop {
            if let Some(value) = self.value.get() {
                return value;
            }
            let (own, maker) = (this_process(), self.maker.load(Ordering::Acquire));
            if maker == own {
                thread::sleep(TICK);
                continue;
            }
            let taken =
                self.maker
                    .compare_exchange(maker, own, Ordering::AcqRel, Ordering::Relaxed);
            if taken.is_ok() {
                let _end = End(&self.maker);
                // Another thread may have made it since the first look.
                if let Some(value) = self.value.get() {
                    return value;
                }
                let made = make();
                return self.value.get_or_init(|| made);
            }
        }
    }
}

impl<T> From<T> for Once<T> {
    fn from(value: T) -> Self {
        Self {
            value: OnceLock::from(value),
            maker: AtomicU32::new(0),
        }
    }
}

/// A copy has the value if there is one.
impl<T: Clone> Clone for Once<T> {
    fn clone(&self) -> Self {
        Self {
            value: self.value.clone(),
            maker: AtomicU32::new(0),
        }
    }
}

impl<T> Default for Once<T> {
    fn default() -> Self {
        Self::new()
    }
}

/// Lets another thread make the value when it is dropped, which matters after a panic.
struct End<'a>(&'a AtomicU32);

impl Drop for End<'_> {
    fn drop(&mut self) {
        self.0.store(0, Ordering::Release);
    }
}

/// Returns a number that is not 0 and that a process does not share with its parent.
fn this_process() -> u32 {
    if cfg!(target_family = "wasm") {
        1
    } else {
        process::id()
    }
}

/// A static value that is made at its first use.
#[derive(Debug)]
pub struct Lazy<T> {
    once: Once<T>,
    make: fn() -> T,
}

impl<T> Lazy<T> {
    /// Takes what makes the value.
    pub const fn new(make: fn() -> T) -> Self {
        Self {
            once: Once::new(),
            make,
        }
    }
}

impl<T> Deref for Lazy<T> {
    type Target = T;

    fn deref(&self) -> &T {
        self.once.get_or_init(self.make)
    }
}

#[cfg(test)]
mod tests {
    use std::panic::{AssertUnwindSafe, catch_unwind};
    use std::sync::atomic::AtomicUsize;

    use super::*;

    #[test]
    fn a_value_is_made_once_by_many_threads() {
        let (once, made) = (Once::new(), AtomicUsize::new(0));
        thread::scope(|scope| {
            for _ in 0..32 {
                scope.spawn(|| {
                    let value = once.get_or_init(|| {
                        thread::yield_now();
                        made.fetch_add(1, Ordering::Relaxed)
                    });
                    assert_eq!(*value, 0);
                });
            }
        });
        assert_eq!(made.into_inner(), 1);
    }

    #[test]
    fn after_a_panic_the_value_can_still_be_made() {
        let once = Once::new();
        let failed = catch_unwind(AssertUnwindSafe(|| once.get_or_init(|| panic!("no value"))));
        assert!(failed.is_err());
        assert_eq!(*once.get_or_init(|| 7), 7);
    }

    /// The maker is a process that does not exist here, as in the child of a fork.
    #[test]
    fn a_value_that_a_thread_of_the_parent_was_making_is_made_again() {
        let once = Once::new();
        once.maker.store(u32::MAX, Ordering::Relaxed);
        assert_eq!(*once.get_or_init(|| 7), 7);
    }
}
