//! Work on all cores that may fail.

use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

/// Applies `function` to every item on all cores and returns the results in the order of the items.
///
/// Items that follow a failed one may be left out.
///
/// # Errors
/// The error of the first item that fails, in the order of the items. It does not depend on timing,
/// unlike the error that rayon's own `collect` into a `Result` returns.
pub(crate) fn try_map<I, T, E>(
    items: I,
    function: impl Fn(I::Item) -> Result<T, E> + Send + Sync,
) -> Result<Vec<T>, E>
where
    I: IntoParallelIterator<Iter: IndexedParallelIterator>,
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
    let results: Vec<Option<Result<T, E>>> = items.into_par_iter().enumerate().map(apply).collect();
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
