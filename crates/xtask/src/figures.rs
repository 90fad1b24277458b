//! The figures and the numbers of the documentation: measured, drawn and quoted, or compared with
//! those in the repository.
//!
//! `tables/figures/` holds all figures, and the rows of each `tabulate cost` as CSV. The Markdown
//! files quote the summaries of these rows between `<!-- tabulate cost NAME -->` and
//! `<!-- end -->`.

use std::fs;
use std::path::{Path, PathBuf};

use crate::tabulate;
use crate::workspace;

/// The measurements of `tabulate cost`.
const COSTS: [&str; 4] = ["solve", "table", "lookup", "effects"];

/// The tightest tolerances of `tabulate cost table`: to be quoted, or only to be compared.
const TIGHTEST: [&str; 2] = ["1e-8", "1e-4"];

/// The figures of `tabulate plot`, and the measurement that each is drawn from.
const FIGURES: [(&str, Option<&str>); 9] = [
    ("fig2", None),
    ("fig3", None),
    ("fig4", None),
    ("force-displacement", None),
    ("error-map", None),
    ("work-precision", Some("solve")),
    ("table-cost", Some("table")),
    ("lookup-cost", Some("lookup")),
    ("effects", Some("effects")),
];

/// The files that quote measurements. A file without a quotation stays as it is.
const DOCUMENTS: [&str; 2] = ["crates/tabulate/COST.md", "tables/README.md"];
const END: &str = "<!-- end -->\n";

/// The largest difference of a coordinate between two drawings of one figure, in tenths of a pixel:
/// processors round differently.
const ROUNDING: f64 = 1.5;

/// Measures, draws and quotes everything anew.
pub fn figures() -> Result<(), String> {
    let folder = folder();
    fs::create_dir_all(&folder).map_err(|e| format!("cannot make {}: {e}", folder.display()))?;
    for cost in COSTS {
        measure(cost, &["-o", &name(&folder, cost, "csv")], TIGHTEST[0])?;
    }
    for (figure, cost) in FIGURES {
        draw(figure, cost, &name(&folder, figure, "svg"))?;
    }
    for document in DOCUMENTS {
        let path = workspace::root().join(document);
        let text = read(&path)?;
        fs::write(&path, quoted(&text)?)
            .map_err(|e| format!("cannot write {}: {e}", path.display()))?;
    }
    Ok(())
}

/// Compares the repository with new measurements and drawings. Fails if an error or a size differs,
/// if a time differs by more than machines do, if a figure differs, or if a document quotes another
/// summary.
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
    for cost in COSTS {
        measure(
            cost,
            &["--compare", &name(&folder, cost, "csv")],
            TIGHTEST[1],
        )?;
    }
    let drawn = workspace::target()?.join("figures");
    fs::create_dir_all(&drawn).map_err(|e| format!("cannot make {}: {e}", drawn.display()))?;
    for (figure, cost) in FIGURES {
        let (before, now) = (name(&folder, figure, "svg"), name(&drawn, figure, "svg"));
        draw(figure, cost, &now)?;
        if !alike(&read(Path::new(&before))?, &read(Path::new(&now))?) {
            return Err(format!(
                "{before} differs from {now}, which is drawn now; `cargo xtask figures` draws it anew"
            ));
        }
    }
    Ok(())
}

fn folder() -> PathBuf {
    workspace::root().join("tables/figures")
}

fn name(folder: &Path, stem: &str, ending: &str) -> String {
    folder
        .join(format!("{stem}.{ending}"))
        .display()
        .to_string()
}

fn read(path: &Path) -> Result<String, String> {
    fs::read_to_string(path).map_err(|e| format!("cannot read {}: {e}", path.display()))
}

fn measure(cost: &str, arguments: &[&str], tightest: &str) -> Result<String, String> {
    let to: &[&str] = if cost == "table" {
        &["--to", tightest]
    } else {
        &[]
    };
    tabulate::text(&[&["cost", cost], arguments, to].concat())
}

/// Draws a figure, from the rows of its measurement if it has one.
fn draw(figure: &str, cost: Option<&str>, picture: &str) -> Result<String, String> {
    let data = cost.map(|cost| name(&folder(), cost, "csv"));
    let data = data.as_ref().map_or(vec![], |data| vec!["--data", data]);
    tabulate::text(&[&["plot", figure, "-o", picture], &data[..]].concat())
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

/// Returns true if two pictures differ by no more than rounding.
fn alike(a: &str, b: &str) -> bool {
    let tokens = |text: &str| {
        text.split([' ', ',', '"', '<', '>'])
            .map(str::to_owned)
            .collect::<Vec<_>>()
    };
    let (a, b) = (tokens(a), tokens(b));
    let number = |token: &str| token.parse::<f64>().ok();
    a.len() == b.len()
        && a.iter().zip(&b).all(|(a, b)| {
            a == b
                || number(a)
                    .zip(number(b))
                    .is_some_and(|(a, b)| (a - b).abs() <= ROUNDING)
        })
}
