//! The tables of the scenes in `tables/` and `tables/stacks/`, and the rows of `tables/README.md`
//! about them.

use std::io::{Write, stdout};
use std::path::Path;

use serde_json::Value;

use crate::{tabulate, workspace};

/// The names of the axes of a table, those of a table over ratios of reduced moduli, and those of a
/// stack of layers, with the symbols that their ranges need.
const PARAMETERS: [[(&str, &str); 4]; 3] = [
    [
        ("a_over_t", ""),
        ("e1_over_e2", ""),
        ("nu1", ""),
        ("e0_over_e2", ""),
    ],
    [
        ("a_over_t", ""),
        ("e1s_over_einfs", "E1\\*/E∞\\*: "),
        ("nu1", ""),
        ("e0s_over_e2s", "E0\\*/E2\\*: "),
    ],
    [
        ("a_over_t", ""),
        ("e1_over_e2", ""),
        ("nu1", ""),
        ("e0_over_e1", "E0/E1: "),
    ],
];

const HEADER: &str = "\
| scene | a/t | E1/E2\\* | nu1 | E0/E2\\* | nu0 | tolerance | nodes | solves | seconds | peak memory | .h5 \
| certified error, max (median) | .bin | certified error | made by |";

/// Makes and packs the table of every scene in the target directory, and prints a row of Markdown
/// for each.
pub fn tables() -> Result<(), String> {
    let (scenes, made) = (
        workspace::root().join("tables"),
        workspace::target()?.join("tables"),
    );
    print(HEADER)?;
    print(&format!("|{}", "---|".repeat(16)))?;
    for folder in ["", "stacks/"] {
        for name in scene_names(&scenes, folder)? {
            print(&row(&name, &scenes, &made)?)?;
        }
    }
    Ok(())
}

/// Returns the names of the scenes in a folder of `scenes`, in alphabetical order: its TOML files
/// that state an `a_over_t`, which a file of a stack does not. A name begins with the folder.
fn scene_names(scenes: &Path, folder: &str) -> Result<Vec<String>, String> {
    let mut names = Vec::new();
    for path in workspace::files(&scenes.join(folder), "toml")? {
        let text = workspace::read(&path)?;
        if text.lines().any(|line| line.starts_with("a_over_t")) {
            let name = path.file_stem().unwrap_or_default().display();
            names.push(format!("{folder}{name}"));
        }
    }
    Ok(names)
}

/// Prints a line; a closed standard output is an error, not a panic.
fn print(line: &str) -> Result<(), String> {
    writeln!(stdout(), "{line}").map_err(|e| format!("cannot print: {e}"))
}

/// Makes and packs the table of a scene, and returns its row.
fn row(name: &str, scenes: &Path, made: &Path) -> Result<String, String> {
    let path = |folder: &Path, ending| {
        folder
            .join(format!("{name}.{ending}"))
            .display()
            .to_string()
    };
    let (scene, file, packed) = (path(scenes, "toml"), path(made, "h5"), path(made, "bin"));
    if let Some(folder) = Path::new(&file).parent() {
        workspace::make(folder)?;
    }
    let table = Object(tabulate::json(&["generate", &scene, "-o", &file])?);
    let tolerance = table.number("/tolerance")?.to_string();
    let pack = ["pack", &file, "-o", &packed, "--tolerance", &tolerance];
    let packed = Object(tabulate::json(&pack)?);

    let has =
        |(parameter, _): &(&str, &str)| table.0.pointer(&format!("/axes/{parameter}")).is_some();
    let parameters = PARAMETERS
        .into_iter()
        .find(|parameters| parameters.iter().all(has))
        .ok_or_else(|| format!("the axes of {file} have names that no row is made for"))?;
    let ranges = parameters.map(|(parameter, symbol)| {
        let [from, to] = ["from", "to"].map(|end| table.text(&format!("/axes/{parameter}/{end}")));
        let (from, to) = (from?, to?);
        Ok(if from == to {
            format!("{symbol}{from}")
        } else {
            format!("{symbol}{from} … {to}")
        })
    });
    let nodes = parameters.map(|(parameter, _)| table.number(&format!("/axes/{parameter}/nodes")));
    let nodes = nodes.into_iter().collect::<Result<Vec<_>, String>>()?;
    let axes: Vec<String> = nodes
        .iter()
        .filter(|nodes| **nodes > 1.0)
        .map(f64::to_string)
        .collect();
    let cells = [
        format!("[`{name}`]({name}.toml)"),
        ranges
            .into_iter()
            .collect::<Result<Vec<_>, String>>()?
            .join(" | "),
        table.text("/nu0")?,
        table.text("/tolerance")?,
        axes.join(" × "),
        thousands(&table.number("/points_solved")?.to_string()),
        format!("{:.1}", table.number("/seconds")?),
        format!("{:.0} MB", 1e-6 * table.number("/peak_memory_bytes")?),
        size(table.number("/bytes")?),
        format!(
            "{:.1e} ({:.1e})",
            table.number("/certificate/max_error")?,
            table.number("/certificate/median_error")?
        ),
        size(packed.number("/bytes")?),
        format!("{:.1e}", packed.number("/certificate/max_error")?),
        format!("`cargo xtask table tables/{name}.toml`"),
    ];
    Ok(format!("| {} |", cells.join(" | ")))
}

/// The JSON object of a table. `tabulate info --help` lists its fields; a field is named by its
/// JSON pointer.
struct Object(Value);

impl Object {
    fn number(&self, field: &str) -> Result<f64, String> {
        let number = self.0.pointer(field).and_then(Value::as_f64);
        number.ok_or_else(|| format!("tabulate prints no number {field}: {}", self.0))
    }

    /// Returns a number in its short form: powers of ten and at most four digits far from 1; "inf"
    /// for a rigid substrate.
    fn text(&self, field: &str) -> Result<String, String> {
        if let Some(text) = self.0.pointer(field).and_then(Value::as_str) {
            return Ok(text.to_owned());
        }
        let value = self.number(field)?;
        Ok(if value == 0.0 || (0.1..100.0).contains(&value) {
            value.to_string()
        } else {
            let (exact, rounded) = (format!("{value:e}"), format!("{value:.3e}"));
            if exact.len() > rounded.len() {
                rounded
            } else {
                exact
            }
        })
    }
}

/// Separates digits in groups of three.
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

/// Formats a size in bytes.
fn size(bytes: f64) -> String {
    if bytes < 1e6 {
        format!("{:.0} kB", 1e-3 * bytes)
    } else {
        format!("{:.1} MB", 1e-6 * bytes)
    }
}
