//! The time for which a fit has gone on.

use std::thread;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressFinish, ProgressStyle};

/// The time after which somebody waits.
const WAITS: Duration = Duration::from_secs(2);

/// Shows the time on a terminal, and nowhere else, of a fit that takes longer than two seconds, until the value that is
/// returned is dropped.
pub fn elapsed_time() -> ProgressBar {
    let style = ProgressStyle::with_template("fitting   {elapsed_precise}");
    let shown = ProgressBar::new_spinner()
        .with_style(style.expect("the template is valid"))
        .with_finish(ProgressFinish::AndClear);
    let later = shown.downgrade();
    // Without a thread the fit goes on, and shows no time.
    let _ = thread::Builder::new().spawn(move || {
        thread::sleep(WAITS);
        if let Some(shown) = later.upgrade() {
            shown.enable_steady_tick(Duration::from_secs(1));
        }
    });
    shown
}
