//! The figures and the numbers of the documentation: measured, drawn and quoted, or compared with
//! those in the repository.
//!
//! `tables/figures/` holds all figures, and the rows of each `tabulate cost` as CSV. The Markdown
//! files quote the summaries of these rows between `<!-- tabulate cost NAME -->` and
//! `<!-- end -->`. `crates/fit/data` holds synthetic measurements, each with the command that makes it in its second
//! line, and `crates/fit/figures` the figures of the fits whose commands `crates/fit/EXPERIMENTS.md` shows.

use std::fs;
use std::path::{Path, PathBuf};

use crate::tabulate;
use crate::workspace::{self, read};

/// The measurements of `tabulate cost`.
const COSTS: [&str; 5] = ["solve", "table", "lookup", "effects", "history"];

/// The tightest tolerances of `tabulate cost table`: to be quoted, or only to be compared.
const TIGHTEST: [&str; 2] = ["1e-8", "1e-4"];

/// The figures of `tabulate plot`, and the measurement that each is drawn from.
const FIGURES: [(&str, Option<&str>); 14] = [
    ("fig2", None),
    ("fig3", None),
    ("fig4", None),
    ("force-displacement", None),
    ("pull-off", None),
    ("contact-stiffness", None),
    ("friction", None),
    ("interface", None),
    ("relaxation", None),
    ("error-map", None),
    ("work-precision", Some("solve")),
    ("table-cost", Some("table")),
    ("lookup-cost", Some("lookup")),
    ("effects", Some("effects")),
];

/// The measurement and the figure that take the packed table of the default scene. Each would make it first.
const OF_DEFAULT_TABLE: [&str; 2] = ["lookup", "error-map"];

/// The files that quote measurements. A file without a quotation stays as it is.
const DOCUMENTS: [&str; 2] = ["crates/tabulate/COST.md", "tables/README.md"];
const END: &str = "<!-- end -->\n";

/// The largest differences between the numbers of a file and those of one that is made now.
struct Difference {
    absolute: f64,
    /// As a share of the number.
    relative: f64,
}

/// Of a coordinate between two drawings of one figure, in tenths of a pixel: processors round differently.
const ROUNDING: Difference = Difference {
    absolute: 1.5,
    relative: 0.0,
};

/// Of a number between two simulations of one measurement, in SI units. Loads come from solves to a stated
/// tolerance, so their last digits change with the method and with the processor; where a load is the
/// difference of two larger ones, its share is larger than the tolerance.
const TOLERANCE: Difference = Difference {
    absolute: 1e-15,
    relative: 1e-8,
};

/// Measures, draws and quotes everything anew.
pub fn figures() -> Result<(), String> {
    let folder = workspace::make(&folder())?;
    let table = default_table(&made()?)?;
    for cost in COSTS {
        measure(
            cost,
            &table,
            &["-o", &name(&folder, cost, "csv")],
            TIGHTEST[0],
        )?;
    }
    for (figure, cost) in FIGURES {
        draw(figure, cost, &table, &name(&folder, figure, "svg"))?;
    }
    for (data, command) in simulations()? {
        write(&data, &run(&command)?)?;
    }
    for (figure, command) in fits()? {
        run(&command.replace(&figure, &format!("crates/fit/figures/{figure}")))?;
    }
    for document in DOCUMENTS {
        let path = workspace::root().join(document);
        let text = read(&path)?;
        write(&path, &quoted(&text)?)?;
    }
    Ok(())
}

/// Compares the repository with new measurements and drawings. Fails if an error or a size differs, if
/// a figure differs, or if a document quotes another summary. Times are not compared.
pub fn check() -> Result<(), String> {
    let folder = folder();
    for document in DOCUMENTS {
        let text = read(&workspace::root().join(document))?;
        if quoted(&text)? != text {
            return Err(format!(
                "{document} differs from the summaries of tables/figures/*.csv; `cargo xtask figures` writes it anew"
            ));
        }
    }
    let drawn = made()?;
    let table = default_table(&drawn)?;
    for cost in COSTS {
        measure(
            cost,
            &table,
            &["--compare", &name(&folder, cost, "csv")],
            TIGHTEST[1],
        )?;
    }
    for (figure, cost) in FIGURES {
        let (before, now) = (name(&folder, figure, "svg"), name(&drawn, figure, "svg"));
        draw(figure, cost, &table, &now)?;
        compare(Path::new(&before), Path::new(&now), ROUNDING)?;
    }
    for (data, command) in simulations()? {
        let now = drawn.join(data.file_name().expect("a file has a name"));
        write(&now, &run(&command)?)?;
        compare(&data, &now, TOLERANCE)?;
    }
    for (figure, command) in fits()? {
        let now = drawn.join(&figure);
        run(&command.replace(&figure, &now.display().to_string()))?;
        let before = workspace::root().join("crates/fit/figures").join(figure);
        compare(&before, &now, ROUNDING)?;
    }
    Ok(())
}

/// Fails where a file of the repository differs from one that is made now.
fn compare(before: &Path, now: &Path, difference: Difference) -> Result<(), String> {
    if alike(&read(before)?, &read(now)?, difference) {
        return Ok(());
    }
    let (before, now) = (before.display(), now.display());
    Err(format!(
        "{before} differs from {now}, which is made now; `cargo xtask figures` makes it anew"
    ))
}

/// Returns the synthetic measurements with the commands that make them.
fn simulations() -> Result<Vec<(PathBuf, String)>, String> {
    let files = workspace::files(&workspace::root().join("crates/fit/data"), "csv")?;
    let simulation = |path: PathBuf| {
        let text = read(&path)?;
        let command = text
            .lines()
            .find_map(|line| line.strip_prefix("# tabulate"));
        let missing = || format!("{} does not say what made it", path.display());
        let command = command.ok_or_else(missing)?.to_owned();
        Ok((path, command))
    };
    files.into_iter().map(simulation).collect()
}

/// Returns the names of the figures of fits with the commands that draw them.
fn fits() -> Result<Vec<(String, String)>, String> {
    let page = read(&workspace::root().join("crates/fit/EXPERIMENTS.md"))?;
    let commands = page.split("\n\n    tabulate fit").skip(1);
    let fits = commands.filter_map(|block| {
        let (command, _) = block.split_once("\n\n")?;
        let (_, figure) = command.split_once("--plot ")?;
        Some((
            figure.to_owned(),
            format!("fit{}", command.replace('\\', "")),
        ))
    });
    Ok(fits.collect())
}

/// Runs `tabulate`, whose paths are those from the root of the workspace.
fn run(arguments: &str) -> Result<String, String> {
    tabulate::text(&arguments.split_whitespace().collect::<Vec<_>>())
}

fn write(path: &Path, text: &str) -> Result<(), String> {
    fs::write(path, text).map_err(|e| format!("cannot write {}: {e}", path.display()))
}

fn folder() -> PathBuf {
    workspace::root().join("tables/figures")
}

/// Returns the folder of what is made to be compared, or on the way.
fn made() -> Result<PathBuf, String> {
    workspace::make(&workspace::target()?.join("figures"))
}

/// Makes the table that `tabulate` takes for [`OF_DEFAULT_TABLE`] where none is named, to the tolerances of
/// `default_table.rs` there. Returns its path.
fn default_table(folder: &Path) -> Result<String, String> {
    let scene = workspace::root().join("tables/default.toml");
    let scene = scene.display().to_string();
    let [table, packed] = ["h5", "bin"].map(|ending| name(folder, "default", ending));
    tabulate::text(&["generate", &scene, "-o", &table, "--tolerance", "2e-7"])?;
    tabulate::text(&["pack", &table, "-o", &packed, "--tolerance", "1e-6"])?;
    Ok(packed)
}

fn name(folder: &Path, stem: &str, ending: &str) -> String {
    folder
        .join(format!("{stem}.{ending}"))
        .display()
        .to_string()
}

fn measure(cost: &str, table: &str, arguments: &[&str], tightest: &str) -> Result<String, String> {
    let to: &[&str] = if cost == "table" {
        &["--to", tightest]
    } else {
        of_default(cost, &table)
    };
    tabulate::text(&[&["cost", cost], to, arguments].concat())
}

/// Returns the argument of a measurement or a figure that names the table.
fn of_default<'a>(name: &str, table: &'a &str) -> &'a [&'a str] {
    if OF_DEFAULT_TABLE.contains(&name) {
        std::slice::from_ref(table)
    } else {
        &[]
    }
}

/// Draws a figure, from the rows of its measurement if it has one.
fn draw(figure: &str, cost: Option<&str>, table: &str, picture: &str) -> Result<String, String> {
    let data = cost.map(|cost| name(&folder(), cost, "csv"));
    let data = data.as_ref().map_or(vec![], |data| vec!["--data", data]);
    let table = of_default(figure, &table);
    tabulate::text(&[&["plot", figure, "-o", picture], table, &data[..]].concat())
}

/// Returns the text of a document with the present summary in each quotation.
fn quoted(text: &str) -> Result<String, String> {
    let mut quoted = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once("<!-- tabulate cost ") {
        let (cost, after) = after
            .split_once(" -->\n")
            .ok_or("a quotation has no name")?;
        let (_, after) = after
            .split_once(END)
            .ok_or_else(|| format!("the quotation of tabulate cost {cost} does not end"))?;
        let summary = tabulate::text(&["cost", cost, "--data", &name(&folder(), cost, "csv")])?;
        quoted += &format!("{before}<!-- tabulate cost {cost} -->\n{summary}{END}");
        rest = after;
    }
    Ok(quoted + rest)
}

/// Returns true if two texts differ by no more than their numbers may, and in comments, which name the version.
fn alike(a: &str, b: &str, difference: Difference) -> bool {
    let tokens = |text: &str| {
        let lines = text.lines().filter(|line| !line.starts_with('#'));
        lines
            .flat_map(|line| line.split([' ', ',', '"', '<', '>']))
            .map(str::to_owned)
            .collect::<Vec<_>>()
    };
    let (a, b) = (tokens(a), tokens(b));
    let number = |token: &str| token.parse::<f64>().ok();
    a.len() == b.len()
        && a.iter().zip(&b).all(|(a, b)| {
            a == b
                || number(a).zip(number(b)).is_some_and(|(a, b)| {
                    (a - b).abs() <= difference.absolute + difference.relative * b.abs()
                })
        })
}
