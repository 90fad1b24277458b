//! `tabulate generate --plan`: nodes, and an estimate of the time, the memory and the file.

use std::time::Instant;

use interp::Parameter;
use serde_json::json;

use super::info::{self, row};
use super::json;
use crate::table::{Extent, Plan, Scene, sweep};

/// Prints the nodes of the table of a scene, and an estimate of its cost.
pub fn print(scene: &Scene, certificate_points: usize, as_json: bool) -> anyhow::Result<()> {
    let plan = Plan::new(scene)?;
    let (axes, points) = (plan.axes(scene), plan.points());
    let per_point = seconds_per_point(scene, &axes)?;
    let certificate = (per_point + SECONDS_PER_CURVE / rayon::current_num_threads() as f64)
        * certificate_points as f64;
    let seconds = per_point * points as f64 + certificate;
    let values = (8 * points * scene.quantities.len()) as f64;
    let memory = TABLE_MEMORY * values + PROGRAM;
    let size =
        COMPRESSED * values + FILE_OVERHEAD + DATASET_OVERHEAD * scene.quantities.len() as f64;
    if as_json {
        return json::print(&json!({
            "axes": json::axes(scene.parameters, |parameter| &axes[parameter.dimension()].1),
            "points": points,
            "certificate_points": certificate_points,
            "seconds": seconds,
            "memory_bytes": memory as u64,
            "bytes": size as u64,
        }));
    }
    let mut text: String = axes
        .iter()
        .map(|(parameter, nodes)| info::describe_axis(*parameter, nodes))
        .collect();
    let size = if size < 1e6 {
        format!("{:.0} kB", size / 1e3)
    } else {
        format!("{:.1} MB", size / 1e6)
    };
    text += &row("nodes", points);
    let solves = format_args!("{points} and {certificate_points} for the certificate");
    text += &row("solves", solves);
    text += &row("time", format_args!("about {seconds:.1} s"));
    text += &row("memory", format_args!("about {:.0} MB", memory / 1e6));
    text += &row("size", format_args!("about {size}"));
    let is_planned = |extent: &Extent| matches!(extent, Extent::Range { .. });
    if scene.extents.iter().any(is_planned) {
        text += &row("if missed", MADE_AGAIN);
    }
    super::print(text.as_bytes())
}

/// What follows where the first table misses the tolerance.
const MADE_AGAIN: &str =
    "a table that misses its tolerance is made again with more nodes, and takes more of all that";
/// The part of the values' bytes that deflate leaves.
const COMPRESSED: f64 = 0.65;
/// Bytes of a file without its datasets of values: HDF5's own structures, the attributes and the
/// axes.
const FILE_OVERHEAD: f64 = 18e3;
/// Bytes of a dataset of values besides the values: its header, attributes and index of chunks.
const DATASET_OVERHEAD: f64 = 5e3;
/// Memory of a table, its values and its splines, over the values.
const TABLE_MEMORY: f64 = 2.3;
/// Memory besides that of the table: the sum is within a quarter of the memory measured
/// (`benches/scale.rs`), but for the table of all films, spheres and substrates, whose largest solves
/// take more.
const PROGRAM: f64 = 30e6;
/// Time to make the curve of a material, on one thread.
const SECONDS_PER_CURVE: f64 = 3e-4;

/// Returns the time for a point of the sweep on all threads, measured on a few nodes of each axis.
fn seconds_per_point(scene: &Scene, axes: &[(Parameter, Vec<f64>); 4]) -> anyhow::Result<f64> {
    const FEW: usize = 8;
    let axes = axes.each_ref().map(|(parameter, nodes)| {
        let few = nodes.iter().copied().step_by(nodes.len().div_ceil(FEW));
        (*parameter, few.collect::<Vec<f64>>())
    });
    let points: usize = axes.iter().map(|(_, nodes)| nodes.len()).product();
    // The first sweep also computes the constants of the solver, once. It is not timed.
    sweep(scene, &axes, &|_| ())?;
    let start = Instant::now();
    sweep(scene, &axes, &|_| ())?;
    Ok(start.elapsed().as_secs_f64() / points as f64)
}
