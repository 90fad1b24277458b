//! Work that Ctrl-C ends: another thread does it, and the thread of Python looks at signals.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use pyo3::prelude::*;

/// The time between two looks at signals.
pub const TICK: Duration = Duration::from_millis(50);

/// Does `work` with the interpreter's lock released. After a signal whose handler raises, such as
/// that of Ctrl-C, it sets `interrupted`, which `work` reads between its parts, waits for the end of
/// `work`, and raises.
pub fn interruptible<T: Send>(
    py: Python<'_>,
    interrupted: &AtomicBool,
    work: impl FnOnce() -> T + Send,
) -> PyResult<T> {
    let (end, ended) = channel::<()>();
    let ended = Mutex::new(ended);
    thread::scope(|scope| {
        let worker = scope.spawn(move || {
            // Dropped at the end, also at that of a panic.
            let _end = end;
            work()
        });
        let goes_on = || {
            let ended = ended.lock().unwrap_or_else(PoisonError::into_inner);
            ended.recv_timeout(TICK) == Err(RecvTimeoutError::Timeout)
        };
        let mut heard = Ok(());
        while heard.is_ok() && py.detach(goes_on) {
            heard = py.check_signals();
        }
        if heard.is_err() {
            interrupted.store(true, Ordering::Relaxed);
        }
        let done = py.detach(|| worker.join());
        heard?;
        Ok(done.unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
    })
}
