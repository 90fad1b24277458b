//! The tables of the scenes in `tables/`, and what `tables/README.md` says of them.
//!
//! Every number comes from what `tabulate` prints or from the size of a file.

use std::fs;
use std::path::Path;

use crate::tabulate::tabulate;
use crate::workspace;

const PARAMETERS: [&str; 4] = ["a_over_t", "e1_over_e2", "nu1", "e0_over_e2"];

/// Makes and packs the table of every scene in the target directory, and prints a row of markdown
/// on each.
pub fn tables() -> Result<(), String> {
    let (scenes, made) = (
        workspace::root().join("tables"),
        workspace::target()?.join("tables"),
    );
    fs::create_dir_all(&made).map_err(|e| format!("cannot make {}: {e}", made.display()))?;
    let entries =
        fs::read_dir(&scenes).map_err(|e| format!("cannot read {}: {e}", scenes.display()))?;
    let files = entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    let mut names: Vec<String> = files
        .filter_map(|file| Some(file.strip_suffix(".toml")?.to_owned()))
        .collect();
    names.sort();
    println!(
        "| scene | a/t | E1/E2 | nu1 | E0/E2 | nu0 | tolerance | nodes | solves | seconds | peak memory | .h5 | \
         certified error, max (median) | .bin | certified error | made by |"
    );
    println!("|{}", "---|".repeat(16));
    for name in names {
        println!("{}", row(&name, &scenes, &made)?);
    }
    Ok(())
}

/// Makes and packs the table of a scene, and tells what that took.
fn row(name: &str, scenes: &Path, made: &Path) -> Result<String, String> {
    let path = |folder: &Path, ending| {
        folder
            .join(format!("{name}.{ending}"))
            .display()
            .to_string()
    };
    let (scene, table, packed) = (path(scenes, "toml"), path(made, "h5"), path(made, "bin"));
    let said = Said(tabulate(&["generate", &scene, "-o", &table])?);
    let tolerance = said.of("tolerance")?;
    let said_of_packed = Said(tabulate(&[
        "pack",
        &table,
        "-o",
        &packed,
        "--tolerance",
        tolerance,
    ])?);

    let axes = PARAMETERS
        .iter()
        .map(|parameter| said.of(parameter))
        .collect::<Result<Vec<_>, _>>()?;
    let ranges: Vec<String> = axes.iter().map(|axis| range(axis)).collect();
    let nodes: Vec<&str> = axes
        .iter()
        .filter_map(|axis| axis.split_once(", ")?.1.split_once(" nodes"))
        .map(|nodes| nodes.0)
        .collect();
    let (solved, error, packed_error) = (
        said.of("solved")?,
        said.of("certified error")?,
        said_of_packed.of("certified error")?,
    );
    let cells = [
        format!("[`{name}`]({name}.toml)"),
        ranges.join(" | "),
        said.of("nu0")?.to_owned(),
        tolerance.to_owned(),
        nodes.join(" × "),
        thousands(between(solved, "", " points")?),
        between(solved, " s, ", " s with the certificate")?.to_owned(),
        between(said.of("memory")?, "", " at most")?.to_owned(),
        size(&table)?,
        format!(
            "{} ({})",
            between(error, "max ", ",")?,
            between(error, "median ", " ")?
        ),
        size(&packed)?,
        between(packed_error, "max ", ",")?.to_owned(),
        format!("`cargo xtask table tables/{name}.toml`"),
    ];
    Ok(format!("| {} |", cells.join(" | ")))
}

/// The lines that `tabulate generate` or `pack` prints, each of which begins with the name of what
/// it tells.
struct Said(String);

impl Said {
    fn of(&self, name: &str) -> Result<&str, String> {
        let mut lines = self.0.lines();
        let found = lines.find_map(|line| line.strip_prefix(name)?.strip_prefix(' '));
        found
            .map(str::trim_start)
            .ok_or_else(|| format!("tabulate does not print its {name}:\n{}", self.0))
    }
}

/// What stands after one phrase and before the next.
fn between<'a>(text: &'a str, before: &str, after: &str) -> Result<&'a str, String> {
    let rest = text.split_once(before).map(|parts| parts.1);
    let found = rest.and_then(|rest| Some(rest.split_once(after)?.0));
    found.ok_or_else(|| format!("{text:?} has nothing between {before:?} and {after:?}"))
}

/// "0.001 to 1000, 70 nodes (logarithmic)" and "0.5" without what is said of nodes, and with powers
/// of ten.
fn range(axis: &str) -> String {
    let ends = axis.split_once(", ").map_or(axis, |parts| parts.0);
    ends.split(" to ")
        .map(short)
        .collect::<Vec<_>>()
        .join(" … ")
}

/// A number as people write it.
fn short(number: &str) -> String {
    match number.parse::<f64>() {
        Ok(value) if value.is_finite() && value != 0.0 && !(0.1..100.0).contains(&value) => {
            format!("{value:e}")
        }
        _ => number.to_owned(),
    }
}

/// Digits in groups of three.
fn thousands(digits: &str) -> String {
    let comma = |i: usize| {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            ","
        } else {
            ""
        }
    };
    digits
        .chars()
        .enumerate()
        .map(|(i, digit)| format!("{}{digit}", comma(i)))
        .collect()
}

/// The size of a file.
fn size(path: &str) -> Result<String, String> {
    let bytes = fs::metadata(path)
        .map_err(|e| format!("cannot read {path}: {e}"))?
        .len() as f64;
    Ok(if bytes < 1e6 {
        format!("{:.0} kB", 1e-3 * bytes)
    } else {
        format!("{:.1} MB", 1e-6 * bytes)
    })
}
