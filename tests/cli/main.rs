//! The command line program, its figures, and its measurements of its own cost.

#![forbid(unsafe_code)]

mod afm_curves;
mod contact_stiffness;
mod cost;
mod cost_effects;
mod cost_effects_rows;
mod cost_lookup;
mod cost_solve;
mod cost_table;
mod curve;
mod embedded;
mod first_calls;
mod fit;
mod fit_doubts;
mod fit_files;
mod fit_plots;
mod fit_shapes;
mod friction;
mod half_space;
mod help;
mod history;
mod hostile_text;
mod info;
mod interfaces;
mod limits;
mod line_speed;
mod magnitudes;
mod outputs;
mod paths;
mod pipes;
mod plan;
mod plot;
mod points;
mod pull_off;
mod readme;
mod relaxing;
mod simulate;
mod specimen;
mod stacks;
mod streams;
mod units;

use std::fs;
use std::path::Path;

use acceptance::{Workdir, shipped};
use interp::Material;
use solve::{Solution, solve};

/// A small scene with two of the four quantities.
const TWO_QUANTITIES: &str = "
    title      = 'Two quantities'
    tolerance  = 1e-2
    quantities = ['delta0', 'eeq']
    a_over_t   = { from = 0.1, to = 10, nodes = 9 }
    e1_over_e2 = { from = 1, to = 2, nodes = 4 }
    nu1        = 0.5
    e0_over_e2 = inf
    nu0        = 0.1
";

fn solved(x: f64, material: &Material, tolerance: f64) -> Solution {
    solve(x, material, tolerance).expect("moderate contrasts converge")
}

/// Returns the path of the shipped table, as an argument.
fn paper_table() -> String {
    shipped("paper.bin")
        .to_str()
        .expect("a path in UTF-8")
        .to_owned()
}

/// Copies the files of folders of the repository to the same places in a work folder.
fn copy_folders(workdir: &Workdir, folders: &[&str]) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    for folder in folders {
        fs::create_dir_all(workdir.path(folder)).expect("made");
        for entry in fs::read_dir(root.join(folder)).expect("it is there") {
            let path = entry.expect("an entry").path();
            if path.is_file() {
                let name = path.file_name().expect("a name");
                fs::copy(&path, workdir.path(folder).join(name)).expect("copied");
            }
        }
    }
}
