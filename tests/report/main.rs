//! The HTML report: the file, and its page in a browser.
//!
//! The tests in `file` read the HTML. The tests in `damage`, `force_curve`, `inputs` and
//! `layout` need
//! Chromium, which the environment variable `CHROMIUM` names. Without it each of them prints a line
//! that says that it is skipped. `browser` runs Chromium. `setting` has the settings of a page, and
//! `shown` compares what it shows with the program and the library.

#![forbid(unsafe_code)]

mod browser;
mod damage;
mod file;
mod force_curve;
mod inputs;
mod layout;
mod setting;
mod shown;
mod texts;

use std::path::{Path, PathBuf};

use interp::Probe;

/// The largest relative difference between the quantities in a page and those of its table, as the
/// documentation of `tabulate::report` states it.
const DIFFERENCE: f64 = 2e-4;
/// The largest relative error of what a page shows: what a picture needs.
const PICTURE: f64 = 1e-3;

/// The probe with which a page opens.
const SPHERE: Probe = Probe::Paraboloid { radius: 1e-3 };

const FOUR_AXES: &str = "
    title      = 'Ångström & <Söhne>'
    tolerance  = 1e-6
    a_over_t   = { from = 1e-2, to = 1e2 }
    e1_over_e2 = { from = 0.3, to = 3 }
    nu1        = { from = 0.3, to = 0.5 }
    e0_over_e2 = { from = 10, to = 1000 }
    nu0        = 0.2
";
/// `Gamma` alone, for any sphere and substrate. The nodes are few: the page must agree with the
/// table, and not with the solver.
const GAMMA_ALONE: &str = "
    title          = 'Gamma alone'
    tolerance      = 1e-6
    quantities     = ['gamma']
    a_over_t       = { from = 1e-3, to = 1e2, nodes = 48 }
    e1s_over_einfs = { from = 0, to = 1e6, nodes = 46 }
    nu1            = { from = 0.3, to = 0.5, nodes = 11 }
    e0s_over_e2s   = { from = 0, to = inf, nodes = 18 }
    nu0            = 'paired'
";
/// A rigid sphere without adhesion.
const RIGID_SPHERE: &str = "
    title      = 'Rigid sphere, no adhesion'
    tolerance  = 1e-6
    quantities = ['pi0', 'delta0']
    a_over_t   = { from = 1e-2, to = 10 }
    e1_over_e2 = 0
    nu1        = { from = 0.2, to = 0.45 }
    e0_over_e2 = { from = 1, to = 1e4 }
    nu0        = 0.25
";

fn embedded_universal() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates/interp/embedded/universal.bin")
}
