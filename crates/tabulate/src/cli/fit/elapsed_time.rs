//! The time for which a fit has gone on.

use std::time::Duration;

use indicatif::{ProgressBar, ProgressFinish, ProgressStyle};

/// Shows the time on a terminal, and nowhere else, until the value that is returned is dropped.
pub fn elapsed_time() -> ProgressBar {
    let style = ProgressStyle::with_template("fitting   {elapsed_precise}");
    let shown = ProgressBar::new_spinner()
        .with_style(style.expect("the template is valid"))
        .with_finish(ProgressFinish::AndClear);
    shown.enable_steady_tick(Duration::from_secs(1));
    shown
}
