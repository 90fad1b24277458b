//! Work that Ctrl-C ends: another thread does it, and the thread of Python looks at signals.

use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::Duration;

use pyo3::prelude::*;

/// The time between two looks at signals.
pub const TICK: Duration = Duration::from_millis(50);

/// A call of Python, for the thread that alone may run it.
type Call<'a> = Box<dyn FnOnce(Python<'_>) -> PyResult<()> + Send + 'a>;

/// Calls of Python that the work asks the thread of the caller to make.
pub struct Calls<'a>(Sender<Call<'a>>);

impl<'a> Calls<'a> {
    /// Waits until the call is made, and returns its result; none if Python has raised, here or before.
    pub fn ask<T: Send + 'a>(
        &self,
        call: impl FnOnce(Python<'_>) -> PyResult<T> + Send + 'a,
    ) -> Option<T> {
        let (reply, answer) = channel();
        let made = move |py: Python<'_>| {
            // The work waits for it.
            let _ = reply.send(call(py)?);
            Ok(())
        };
        self.0.send(Box::new(made)).ok()?;
        answer.recv().ok()
    }
}

/// Does `work` with the interpreter's lock released. After a signal whose handler raises, such as
/// that of Ctrl-C, it sets `interrupted`, which `work` reads between its parts, waits for the end of
/// `work`, and raises.
pub fn interruptible<T: Send>(
    py: Python<'_>,
    interrupted: &AtomicBool,
    work: impl FnOnce() -> T + Send,
) -> PyResult<T> {
    attended(py, interrupted, || Ok(()), |_| work())
}

/// Does `work` as [`interruptible`] does, with `look` at every look at signals, before every call, and at the end. If
/// one of these raises, it is as after a signal. Raises `OSError` where the system gives no thread.
pub fn attended<'a, T: Send>(
    py: Python<'_>,
    interrupted: &AtomicBool,
    mut look: impl FnMut() -> PyResult<()>,
    work: impl FnOnce(Calls<'a>) -> T + Send,
) -> PyResult<T> {
    let (sender, mut calls) = channel::<Call<'a>>();
    thread::scope(|scope| {
        // The calls end with the work, also by a panic.
        let worker = thread::Builder::new().spawn_scoped(scope, move || work(Calls(sender)))?;
        let mut heard = Ok(());
        let mut goes_on = true;
        while goes_on {
            let calls = &mut calls;
            let asked = py.detach(move || calls.recv_timeout(TICK));
            goes_on = !matches!(asked, Err(RecvTimeoutError::Disconnected));
            let raised = |_: &PyErr| interrupted.store(true, Ordering::Relaxed);
            heard = heard.and_then(|()| {
                py.check_signals()?;
                look()
            });
            // Before the call is dropped, which lets the work go on.
            heard = heard.inspect_err(raised);
            heard = heard.and_then(|()| asked.map_or(Ok(()), |call| call(py)));
            heard = heard.inspect_err(raised);
        }
        let done = py.detach(|| worker.join());
        heard?;
        Ok(done.unwrap_or_else(|panic| resume_unwind(panic)))
    })
}
