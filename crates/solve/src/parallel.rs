//! Work on all cores, also in the child of a fork.
//!
//! A child of fork has one thread. The threads of rayon's global pool are those of its parent: work
//! that a child gives them is never done. So a child makes threads of its own.

use std::error::Error;
use std::mem;
use std::process;
use std::sync::atomic::{AtomicU32, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, TryLockError};
use std::thread;

use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};

/// The process that has the threads of rayon's global pool; 0 before their first use.
static FIRST: AtomicU32 = AtomicU32::new(0);

/// Threads, with the process that has them.
type OfProcess = Option<(u32, Arc<ThreadPool>)>;

/// The threads of a child. Those of another process are never used nor dropped.
static OF_CHILD: Mutex<OfProcess> = Mutex::new(None);

/// The number of times that a thread asks for the lock of [`OF_CHILD`], which is held for a copy of
/// the `Arc` only. A lock that stays closed was held during a fork, by a thread that the child does
/// not have.
const MOST_ATTEMPTS: usize = 1000;

/// Makes what the crates below make once in cells of the standard library, before any thread can
/// be making it: the detection of the processor's vector instructions, and the collector of rayon's
/// queues.
///
/// A child of fork whose parent was just making one of them would wait for it for ever. A host whose
/// processes may fork at any time, as Python's, calls this when it loads the library. It starts no
/// thread.
pub fn prepare_for_forks() {
    let _ = fearless_simd::Level::new();
    drop(crossbeam_epoch::pin());
}

/// Runs `work`, whose parallel iterators of rayon then have threads in this process: those of the
/// caller's pool, those of rayon's global pool, or in the child of a fork its own.
///
/// # Panics
/// Where the operating system does not give the threads.
pub fn on_all_cores<R: Send>(work: impl FnOnce() -> R + Send) -> R {
    let own = process::id();
    let first = FIRST.compare_exchange(0, own, Ordering::Relaxed, Ordering::Relaxed);
    let has_pool = rayon::current_thread_index().is_some();
    if first.is_ok()
        && !has_pool
        && let Err(error) = ThreadPoolBuilder::new().build_global()
        // Without a source it says that they have been made.
        && error.source().is_some()
    {
        without_threads(&error);
    }
    if first.is_ok() || first == Err(own) || has_pool {
        return work();
    }
    threads_of_child(own).install(work)
}

fn without_threads(error: &ThreadPoolBuildError) -> ! {
    panic!(
        "the operating system does not give the threads ({error}): set the environment variable RAYON_NUM_THREADS to a \
         smaller number"
    )
}

/// Returns the threads of the process `own`, the child of a fork. The first call makes them.
fn threads_of_child(own: u32) -> Arc<ThreadPool> {
    if let Some(held) = of_child()
        && let Some((process, threads)) = &*held
        && *process == own
    {
        return Arc::clone(threads);
    }
    let made = ThreadPoolBuilder::new().build();
    let made = Arc::new(made.unwrap_or_else(|error| without_threads(&error)));
    let Some(mut held) = of_child() else {
        return made;
    };
    match &*held {
        // Another thread of this process was faster.
        Some((process, threads)) if *process == own => Arc::clone(threads),
        _ => {
            // To drop the threads of the parent would be to wait for them.
            mem::forget(held.replace((own, Arc::clone(&made))));
            made
        }
    }
}

/// Locks [`OF_CHILD`]; `None` if the lock stays closed.
fn of_child() -> Option<MutexGuard<'static, OfProcess>> {
    for _ in 0..MOST_ATTEMPTS {
        match OF_CHILD.try_lock() {
            Ok(held) => return Some(held),
            Err(TryLockError::Poisoned(held)) => return Some(held.into_inner()),
            Err(TryLockError::WouldBlock) => thread::yield_now(),
        }
    }
    None
}

/// Applies `function` to every item on all cores and returns the results in the order of the items.
///
/// Items that follow a failed one may be left out.
///
/// # Errors
/// The error of the first item that fails, in the order of the items. It does not depend on timing,
/// unlike the error that rayon's own `collect` into a `Result` returns.
pub fn try_map<I, T, E>(
    items: I,
    function: impl Fn(I::Item) -> Result<T, E> + Send + Sync,
) -> Result<Vec<T>, E>
where
    I: IntoParallelIterator<Iter: IndexedParallelIterator> + Send,
    T: Send,
    E: Send,
{
    let first_failure = AtomicUsize::new(usize::MAX);
    let apply = |(index, item)| {
        // An item before the first failure is never left out.
        if index > first_failure.load(Ordering::Relaxed) {
            return None;
        }
        let result = function(item);
        if result.is_err() {
            first_failure.fetch_min(index, Ordering::Relaxed);
        }
        Some(result)
    };
    let results: Vec<Option<Result<T, E>>> =
        on_all_cores(|| items.into_par_iter().enumerate().map(apply).collect());
    results.into_iter().flatten().collect()
}

#[cfg(test)]
mod tests {
    use std::thread;

    use super::*;

    #[test]
    fn results_are_in_the_order_of_the_items() {
        let squares = try_map(0..1000_usize, |i| Ok::<_, ()>(i * i));
        assert_eq!(squares, Ok((0..1000).map(|i| i * i).collect()));
    }

    /// Item 100 fails late, after many of the items that follow.
    #[test]
    fn of_several_errors_the_first_is_returned() {
        for _ in 0..20 {
            let result = try_map(0..1000_usize, |i| {
                if i == 100 {
                    (0..100).for_each(|_| thread::yield_now());
                }
                if i < 100 { Ok(i) } else { Err(i) }
            });
            assert_eq!(result, Err(100));
        }
    }
}
