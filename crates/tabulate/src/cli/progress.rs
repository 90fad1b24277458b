//! Progress bars, on a terminal only.

use std::sync::{Mutex, MutexGuard, PoisonError};

use indicatif::{ProgressBar, ProgressStyle};

use super::note;
use crate::table::Observer;

/// Returns a bar of `length` steps, which is drawn on a terminal and nowhere else.
pub fn progress_bar(length: usize, name: &str) -> ProgressBar {
    let style = ProgressStyle::with_template(
        "{msg:9} {wide_bar} {human_pos}/{human_len} {elapsed_precise} eta {eta_precise}",
    )
    .expect("the template is valid");
    ProgressBar::new(length as u64)
        .with_style(style)
        .with_message(name.to_owned())
}

/// The bar of the present stage of a longer work.
pub struct Bars {
    bar: Mutex<ProgressBar>,
    /// The number of points that are kept on the disk, and of all.
    kept: Mutex<[usize; 2]>,
}

impl Bars {
    pub fn new() -> Self {
        Self {
            bar: Mutex::new(ProgressBar::hidden()),
            kept: Mutex::new([0; 2]),
        }
    }

    fn bar(&self) -> MutexGuard<'_, ProgressBar> {
        self.bar.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Returns the number of points that are kept on the disk, and of all.
    pub fn kept_points(&self) -> [usize; 2] {
        *self.kept.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub fn clear(&self) {
        self.bar().finish_and_clear();
    }
}

impl Observer for Bars {
    fn begin(&self, what: &'static str, points: usize, finished: usize) {
        self.clear();
        let bar = progress_bar(points, what);
        bar.inc(finished as u64);
        *self.bar() = bar;
    }

    fn advance(&self, points: usize) {
        self.bar().inc(points as u64);
    }

    fn kept(&self, kept: usize, points: usize) {
        *self.kept.lock().unwrap_or_else(PoisonError::into_inner) = [kept, points];
    }

    fn note(&self, text: &str) {
        note(text);
    }
}
