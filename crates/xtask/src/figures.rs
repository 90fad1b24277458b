//! The figures and the numbers of the documentation: measured, drawn and quoted, or compared with
//! those in the repository.
//!
//! `tables/figures/` holds all figures, and the rows of each `tabulate cost` as CSV. The Markdown
//! files quote the summaries of these rows between `<!-- tabulate cost NAME -->` and
//! `<!-- end -->`. `crates/fit/data` and `crates/fit/figures` hold synthetic measurements and the
//! figures of their fits.

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

/// The measurements of `crates/fit/EXPERIMENTS.md`: the name of data and figure, the arguments of
/// `tabulate simulate` and those of `tabulate fit`.
const FITS: [(&str, &str, &str); 7] = [
    (
        "lens",
        "--specimen paper --kind load-radius --film-thickness 3e-5 --from 4.2e-5 --to 1.3e-4 --noise 2e-6 \
         --value load-offset=3e-5 --seed 1",
        "--sphere-radius 1mm --film-thickness 30um --film-modulus 3.5MPa --film-poisson-ratio 0.5 \
         --substrate-modulus 200GPa --substrate-poisson-ratio 0.25 --noise 2uN \
         --free sphere-modulus,work-of-adhesion,load-offset",
    ),
    (
        "gel",
        "--specimen paper --kind force-height --sphere-radius 1e-5 --sphere-modulus inf --film-thickness 2e-5 \
         --film-modulus 5e3 --substrate-modulus 7e10 --work-of-adhesion 5e-5 --stiffness 0.1 \
         --from 1e-6 --to -2e-7 --points 120 --noise 5e-11 --value contact-point=2e-7 \
         --value baseline=1e-9 --seed 1",
        "--sphere-radius 10um --sphere-modulus inf --film-thickness 20um --film-poisson-ratio 0.5 \
         --substrate-modulus 70GPa --substrate-poisson-ratio 0.25 --stiffness 0.1N/m",
    ),
    (
        "relaxing",
        "--kind force-height --sphere-radius 1e-5 --sphere-modulus inf --film-thickness 8e-6 --film-modulus 2e3 \
         --film-poisson-ratio 0.5 --substrate-modulus 7e10 --substrate-poisson-ratio 0.25 \
         --relaxation power-law --relaxation-exponent 0.2 --sample-interval 0.01 --hold 0.5 --stiffness 0.05 \
         --from 2e-7 --to -6e-7 --points 100 --noise 3e-11 --value contact-point=3e-8 \
         --value baseline=1e-10 --seed 1",
        "--sphere-radius 10um --sphere-modulus inf --film-thickness 8um --film-poisson-ratio 0.5 \
         --substrate-modulus 70GPa --substrate-poisson-ratio 0.25 --stiffness 0.05N/m --relaxation power-law",
    ),
    (
        "coating",
        "--kind load-penetration --sphere-radius 1e-5 --sphere-modulus inf --film-thickness 5e-7 \
         --film-modulus 7e10 --film-poisson-ratio 0.2 --substrate-modulus 2.4e9 \
         --substrate-poisson-ratio 0.38 --work-of-adhesion 0 --segments approach --from -2e-8 \
         --to 4e-8 --points 61 --noise 2e-7 --value contact-point=3e-9 --seed 1",
        "--sphere-radius 1e-5 --sphere-modulus inf --film-thickness 5e-7 --film-poisson-ratio 0.2 \
         --substrate-modulus 2.4e9 --substrate-poisson-ratio 0.38 --work-of-adhesion 0 \
         --free film-modulus,contact-point",
    ),
    (
        "primer",
        "--specimen paper --kind load-radius --stack crates/fit/data/primer.toml --from 2e-5 --to 1e-4 --noise 1e-6 \
         --value primer.modulus=5e5 --seed 1",
        "--sphere-radius 1mm --stack crates/fit/data/primer.toml --noise 1uN \
         --free sphere-modulus,primer.modulus,work-of-adhesion",
    ),
    (
        "silicon",
        "--kind stiffness-depth --half-space --film-modulus 1.7e11 --film-poisson-ratio 0.28 \
         --sphere-modulus 1.147e12 --beta 1.034 --hardness 1.15e10 --tip-rounding 6e-9 \
         --from 4e-8 --to 2.5e-7 --noise 1% --seed 1",
        "--kind stiffness-depth --half-space --film-modulus 170GPa --film-poisson-ratio 0.28 \
         --sphere-modulus 1147GPa --beta 1.034 --free tip-rounding",
    ),
    (
        "oxide",
        "--kind stiffness-depth --film-thickness 5e-7 --film-modulus 7.2e10 --film-poisson-ratio 0.17 \
         --substrate-modulus 1.7e11 --substrate-poisson-ratio 0.28 --sphere-modulus 1.147e12 \
         --beta 1.034 --hardness 1e10 --tip-rounding 6e-9 --from 4e-8 --to 2.5e-7 --noise 1% --seed 2",
        "--kind stiffness-depth --film-thickness 500nm --film-poisson-ratio 0.17 \
         --substrate-modulus 170GPa --substrate-poisson-ratio 0.28 --sphere-modulus 1147GPa \
         --beta 1.034 --reference crates/fit/data/silicon.csv --free film-modulus,tip-rounding",
    ),
];

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
    for (stem, simulate, fit) in FITS {
        let [data, figure] = fit_files(stem);
        write(&data, &simulated(simulate)?)?;
        draw_fit(fit, &data, &figure)?;
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
    for (stem, simulate, fit) in FITS {
        let [data, figure] = fit_files(stem);
        let [new_data, new_figure] =
            ["csv", "svg"].map(|ending| drawn.join(stem).with_extension(ending));
        write(&new_data, &simulated(simulate)?)?;
        compare(&data, &new_data, TOLERANCE)?;
        draw_fit(fit, &data, &new_figure)?;
        compare(&figure, &new_figure, ROUNDING)?;
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

/// Returns the data and the figure of a fit.
fn fit_files(stem: &str) -> [PathBuf; 2] {
    let folder = workspace::root().join("crates/fit");
    [
        folder.join(format!("data/{stem}.csv")),
        folder.join(format!("figures/{stem}.svg")),
    ]
}

/// Returns synthetic data.
fn simulated(arguments: &str) -> Result<String, String> {
    let arguments: Vec<&str> = arguments.split_whitespace().collect();
    tabulate::text(&[&["simulate"], &arguments[..]].concat())
}

fn draw_fit(arguments: &str, data: &Path, figure: &Path) -> Result<String, String> {
    let [data, figure] = [data, figure].map(|path| path.display().to_string());
    let arguments: Vec<&str> = arguments.split_whitespace().collect();
    tabulate::text(&[&["fit", &data, "--plot", &figure], &arguments[..]].concat())
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

/// Returns true if two texts differ by no more than their numbers may.
fn alike(a: &str, b: &str, difference: Difference) -> bool {
    let tokens = |text: &str| {
        text.split([' ', ',', '"', '<', '>', '\n'])
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
