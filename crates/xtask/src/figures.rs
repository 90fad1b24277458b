//! The figures and the numbers of the documentation: measured, drawn and quoted, or compared with
//! what is there.
//!
//! `tables/figures/` holds all figures, and what each `tabulate cost` measured as CSV. The Markdown
//! files quote the summaries of these measurements between `<!-- tabulate cost NAME -->` and
//! `<!-- end -->`.

use std::fs;
use std::path::{Path, PathBuf};

use crate::tabulate::tabulate;
use crate::workspace;

/// What `tabulate cost` measures.
const COSTS: [&str; 4] = ["solve", "table", "lookup", "effects"];

/// For how many seconds tables are made, to be quoted or only to be compared.
const BUDGETS: [&str; 2] = ["400", "20"];

/// What `tabulate plot` draws, and of which measurement.
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

/// Where the measurements are quoted.
const DOCUMENTS: [&str; 2] = ["README.md", "tables/README.md"];
const END: &str = "<!-- end -->\n";

/// How far apart the coordinates of the same picture may be that two processors draw, in tenths of
/// a pixel.
const ROUNDING: f64 = 1.5;

/// Measures, draws and quotes everything anew.
pub fn figures() -> Result<(), String> {
    let folder = folder();
    fs::create_dir_all(&folder).map_err(|e| format!("cannot make {}: {e}", folder.display()))?;
    for cost in COSTS {
        measure(cost, &["-o", &name(&folder, cost, "csv")], BUDGETS[0])?;
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

/// Measures again and fails if errors or sizes differ from those kept, or times by more than
/// machines do; draws again and fails if a figure differs; and fails if a document quotes another
/// summary.
pub fn check() -> Result<(), String> {
    let folder = folder();
    for document in DOCUMENTS {
        let text = read(&workspace::root().join(document))?;
        if quoted(&text)? != text {
            return Err(format!(
                "{document} quotes something else than tables/figures/*.csv; `cargo xtask figures` writes it anew"
            ));
        }
    }
    for cost in COSTS {
        measure(
            cost,
            &["--compare", &name(&folder, cost, "csv")],
            BUDGETS[1],
        )?;
    }
    let drawn = workspace::target()?.join("figures");
    fs::create_dir_all(&drawn).map_err(|e| format!("cannot make {}: {e}", drawn.display()))?;
    for (figure, cost) in FIGURES {
        let (before, now) = (name(&folder, figure, "svg"), name(&drawn, figure, "svg"));
        draw(figure, cost, &now)?;
        if !alike(&read(Path::new(&before))?, &read(Path::new(&now))?) {
            return Err(format!(
                "{before} is not what is drawn now, {now}; `cargo xtask figures` draws it anew"
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

fn measure(cost: &str, arguments: &[&str], budget: &str) -> Result<String, String> {
    let budget: &[&str] = if cost == "table" {
        &["--budget", budget]
    } else {
        &[]
    };
    tabulate(&[&["cost", cost], arguments, budget].concat())
}

/// Draws a figure of what was measured, if it was.
fn draw(figure: &str, cost: Option<&str>, picture: &str) -> Result<String, String> {
    let data = cost.map(|cost| name(&folder(), cost, "csv"));
    let data = data.as_ref().map_or(vec![], |data| vec!["--data", data]);
    tabulate(&[&["plot", figure, "-o", picture], &data[..]].concat())
}

/// A document with the summary of each measurement that it quotes.
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
        let summary = tabulate(&["cost", cost, "--data", &name(&folder(), cost, "csv")])?;
        quoted += &format!("{before}<!-- tabulate cost {cost} -->\n{summary}{END}");
        rest = after;
    }
    Ok(quoted + rest)
}

/// Whether two pictures are the same but for rounding.
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
