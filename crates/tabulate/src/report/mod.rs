//! The report of a table: one HTML file that holds all it shows, and fetches nothing.
//!
//! The page computes force curves from the packed low-rank table in it: `report/table.js` reads and
//! splines it, `report/contact.js` has eqs. 2 to 9, `report/chart.js` draws, `report/page.js` has
//! the sliders.

mod figures;

use std::fmt::Write;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use interp::Parameter;
use interp::{Description, Normalisation, Table};

pub use figures::{Illustration, figures, steps};

use crate::Error;
use crate::cost::lookup::random_points;
use crate::plot::picture::Format;
use crate::table::compress;

/// By how much the quantities of the form in a page may differ from the table's at its nodes,
/// relative. The splines through these differences are larger between the nodes, 1.4 times in the
/// default table and 2.4 times in one of few nodes: 1e-6 is kept.
const TRUNCATION: f64 = 4e-7;
/// At how many random points, of this seed, a page says how large the difference is.
const COMPARED: usize = 2000;
const SEED: u64 = 1;

/// The page of a table: what it covers, its certificate, force curves that are computed in the
/// page, and [`figures()`].
///
/// A dense table is embedded in low-rank form, whose quantities differ from it by 1e-6 or less; one
/// in low-rank form as it is. The same table gives the same page.
///
/// # Errors
/// Those of [`compress`], [`Table::to_packed`], of looking up and of drawing.
pub fn report(table: &Table, illustrations: &[Illustration]) -> Result<String, Error> {
    let embedded = embedded(table)?;
    let packed = embedded.to_packed()?;
    let description = table.description();
    let normalisation = match description.normalisation {
        Normalisation::Sphere => "E₂*, the sphere’s reduced modulus E₂/(1 − ν₂²)",
        Normalisation::Film => "E₁*, the film’s reduced modulus E₁/(1 − ν₁²): the sphere is rigid",
    };
    let script = [
        include_str!("table.js"),
        include_str!("contact.js"),
        include_str!("chart.js"),
        include_str!("page.js"),
    ];
    let parts = [
        ("title", escape(&description.title)),
        ("style", include_str!("style.css").to_owned()),
        ("axes", axes(table)),
        (
            "quantities",
            table
                .quantities()
                .into_iter()
                .map(|q| format!("{} ({})", q.name(), q.long_name()))
                .collect::<Vec<_>>()
                .join(", "),
        ),
        ("normalisation", normalisation.to_owned()),
        ("created_by", escape(&description.created_by)),
        ("scene", escape(description.scene.trim_end())),
        ("certificate", certificate(table)),
        ("bytes", packed.len().div_ceil(1000).to_string()),
        (
            "difference",
            format!("{:.1e}", largest_difference(table, &embedded)?),
        ),
        ("compared", COMPARED.to_string()),
        ("figures", section(illustrations)?),
        ("packed", STANDARD.encode(&packed)),
        ("script", script.concat()),
    ];
    Ok(fill(include_str!("page.html"), &parts))
}

/// The low-rank form that goes into the page.
fn embedded(table: &Table) -> Result<Table, Error> {
    if table.low_rank().is_some() {
        return Ok(table.clone());
    }
    let form = compress(table, TRUNCATION)?;
    let axes = Parameter::ALL.map(|parameter| table.axis(parameter).to_vec());
    Ok(Table::from_low_rank(
        table.description().clone(),
        axes,
        form,
    )?)
}

/// The largest relative difference of two tables' quantities at random points of their box.
fn largest_difference(table: &Table, other: &Table) -> Result<f64, Error> {
    let mut largest = 0.0_f64;
    for (x, material) in random_points(table, COMPARED, SEED) {
        let curves = [table.curve(&material)?, other.curve(&material)?];
        for quantity in table.quantities() {
            let [value, other] = [
                curves[0].quantity(quantity, x)?,
                curves[1].quantity(quantity, x)?,
            ];
            largest = largest.max((other / value - 1.0).abs());
        }
    }
    Ok(largest)
}

/// The section of the figures: nothing without any. They are pictures by themselves, so that their
/// names do not meet.
fn section(illustrations: &[Illustration]) -> Result<String, Error> {
    let mut section = String::new();
    for Illustration { caption, figure } in illustrations {
        let svg = STANDARD.encode(figure.picture()?.encode(Format::Svg)?);
        let _ = writeln!(
            section,
            "<figure><img alt=\"{caption}\" src=\"data:image/svg+xml;base64,{svg}\"><figcaption>{caption}</figcaption></figure>"
        );
    }
    if section.is_empty() {
        return Ok(section);
    }
    Ok(format!(
        "<section class=\"wide figures\" aria-labelledby=\"figures\">\n\
         <h2 id=\"figures\">Figures</h2>\n\
         {section}</section>"
    ))
}

/// The template with `{{name}}` replaced by the part of this name. What the parts hold is not
/// searched.
fn fill(template: &str, parts: &[(&str, String)]) -> String {
    let mut pieces = template.split("{{");
    let mut page = pieces.next().unwrap_or_default().to_owned();
    for piece in pieces {
        let (name, rest) = piece
            .split_once("}}")
            .expect("the template closes its names");
        let (_, part) = parts
            .iter()
            .find(|(part, _)| *part == name)
            .expect("the template names parts that there are");
        page += part;
        page += rest;
    }
    page
}

/// Text as HTML.
fn escape(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

/// How a parameter is written in formulas, and what it is.
fn symbol(parameter: Parameter, normalisation: Normalisation) -> (&'static str, &'static str) {
    match (parameter, normalisation) {
        (Parameter::AOverT, _) => ("a/t", "contact radius over film thickness"),
        (Parameter::E1OverE2, _) => (
            "E₁/E₂*",
            "film’s Young’s modulus over the sphere’s reduced one",
        ),
        (Parameter::Nu1, _) => ("ν₁", "film’s Poisson ratio"),
        (Parameter::E0OverE2, Normalisation::Sphere) => (
            "E₀/E₂*",
            "substrate’s Young’s modulus over the sphere’s reduced one",
        ),
        (Parameter::E0OverE2, Normalisation::Film) => {
            ("E₀/E₁", "substrate’s Young’s modulus over the film’s")
        }
    }
}

/// What a fixed value means.
fn value(parameter: Parameter, value: f64) -> String {
    match parameter {
        Parameter::E1OverE2 if value == 0.0 => "0 (rigid sphere)".to_owned(),
        Parameter::E0OverE2 if value == f64::INFINITY => "∞ (rigid substrate)".to_owned(),
        _ => number(value),
    }
}

/// A number as people write it: without an exponent where it is short.
fn number(value: f64) -> String {
    let [plain, exponential] = [format!("{value}"), format!("{value:e}")];
    if plain.len() <= exponential.len().max(6) {
        plain
    } else {
        exponential.replace('-', "−")
    }
}

/// A number to six digits.
fn short(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

/// A row for each parameter.
fn axes(table: &Table) -> String {
    let description = table.description();
    let mut rows = String::new();
    let mut row = |name: &str, meaning: &str, cells: &str| {
        let _ = writeln!(
            rows,
            "<tr><th scope=\"row\">{name} <small>{meaning}</small></th>{cells}</tr>"
        );
    };
    for parameter in Parameter::ALL {
        let nodes = table.axis(parameter);
        let cells = match nodes {
            [only] => format!(
                "<td colspan=\"2\">{}</td><td>fixed</td>",
                value(parameter, *only)
            ),
            [first, .., last] => format!(
                "<td>{}</td><td>{}</td><td>{}</td>",
                number(*first),
                number(*last),
                nodes.len()
            ),
            [] => String::new(),
        };
        let (name, meaning) = symbol(parameter, description.normalisation);
        row(name, meaning, &cells);
    }
    let cells = format!("<td colspan=\"2\">{}</td><td>fixed</td>", description.nu0);
    row("ν₀", "substrate’s Poisson ratio", &cells);
    rows
}

/// What the certificate says, a pair of `dt` and `dd` for each thing.
fn certificate(table: &Table) -> String {
    let Description {
        tolerance,
        normalisation,
        certificate,
        ..
    } = table.description();
    let place = Parameter::ALL.into_iter().zip(certificate.worst_point);
    let place = place.map(|(parameter, place)| {
        format!(
            "{} = {}",
            symbol(parameter, *normalisation).0,
            value(parameter, short(place))
        )
    });
    let place: Vec<String> = place.collect();
    let mut items = vec![
        ("tolerance", format!("{tolerance:e}")),
        ("largest error", format!("{:.1e}", certificate.max_error)),
        ("99.9 % below", format!("{:.1e}", certificate.p999_error)),
        ("median error", format!("{:.1e}", certificate.median_error)),
        (
            "points",
            format!(
                "{} direct solves, seed {}",
                certificate.points, certificate.seed
            ),
        ),
        (
            "worst point",
            format!(
                "{} at {}",
                certificate.worst_quantity.name(),
                place.join(", ")
            ),
        ),
    ];
    let names = ["Γ² = es (x Eeq)′", "F₀′ = S δ₀′"];
    let broken = names
        .iter()
        .zip(certificate.identity_errors)
        .filter_map(|(name, error)| Some(format!("{name}: {:.1e}", error?)));
    let broken: Vec<String> = broken.collect();
    if !broken.is_empty() {
        items.push((
            "identities",
            format!("{} (relative, largest)", broken.join(", ")),
        ));
    }
    items.iter().fold(String::new(), |text, (name, value)| {
        text + &format!("<dt>{name}</dt><dd>{value}</dd>\n")
    })
}
