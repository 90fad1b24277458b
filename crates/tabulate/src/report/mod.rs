//! The page about a table, with its texts and numbers from the table.
//!
//! [`report`] collects what the page of the crate `figures` shows: the range of the table, its certificate (the
//! largest error at sampled points), the figures of [`figures()`], and the packed low-rank form of
//! the table, with which the page computes.

mod illustrations;

use contact::Validity;
use figures::page::{self, Illustration, Page, Range};
use interp::{Description, Parameter, Probe, Quantity, SubstratePoissonRatio, Table};

pub use illustrations::{figures, steps};

use crate::Error;
use crate::large_contact::LARGE_CONTACT;
use crate::printable;
use crate::table::{compress, random_points};

/// The largest relative difference, at the nodes, between the quantities of the form in a page and
/// those of its table. Between the nodes the difference is larger: 1.4 times in a table of many
/// nodes, 2.4 to 4.3 times in tables of few. It stays below 1e-6.
const TRUNCATION: f64 = 2e-7;
/// The number of random points at which the two forms are compared.
const COMPARED: usize = 2000;
/// The seed of these points.
const SEED: u64 = 1;

/// Returns the HTML page of a table: its range, its certificate, force curves that the page
/// computes, and the `illustrations`, which are those of [`figures()`].
///
/// The page opens with the `probe`, a paraboloid, a sphere or a flat punch, between which its user
/// chooses if the table answers all quantities.
///
/// A dense table is embedded in low-rank form. Its quantities differ from those of the table by at
/// most 1e-6, relative (`tests/report` measures it). The page states the largest difference at
/// random points. A table in low-rank form is embedded unchanged. Equal tables give equal pages,
/// byte for byte.
///
/// # Errors
/// [`Error::PageProbe`] for a probe that the page does not compute; [`interp::Error::OfStack`] for
/// a table of a stack of layers; those of [`compress`], of [`Table::to_packed`], of the lookup and of
/// the drawing.
pub fn report(
    table: &Table,
    illustrations: &[Illustration],
    probe: &Probe,
) -> Result<String, Error> {
    if table.is_of_stack() {
        return Err(interp::Error::OfStack.into());
    }
    let opening = opening(table, probe)?;
    let embedded = embedded(table)?;
    let packed = embedded.to_packed()?;
    let description = table.description();
    let normalisation = match table.unit() {
        "E2*" => "E₂*, the sphere’s reduced modulus E₂/(1 − ν₂²)",
        "E1*" => "E₁*, the film’s reduced modulus E₁/(1 − ν₁²), because the sphere is rigid",
        _ => "Es*, the compound modulus of sphere and film, 1/Es* = 1/E₁* + 1/E₂*",
    };
    let quantities: Vec<String> = table
        .answers()
        .into_iter()
        .map(|q| match table.holds(q) {
            true => format!("{} ({})", q.name(), q.long_name()),
            false => format!("{} ({}, follows from gamma)", q.name(), q.long_name()),
        })
        .collect();
    let difference = if table.low_rank().is_some() {
        "the table itself, in low-rank form".to_owned()
    } else {
        format!(
            "a low-rank form of the table, whose quantities differ from those of the table by at most {:.1e} \
             (relative, at {COMPARED} random points)",
            largest_difference(table, &embedded)?
        )
    };
    let page = Page {
        title: printable::line(&description.title),
        parameters: parameters(table),
        quantities: quantities.join(", "),
        normalisation,
        created_by: printable::line(&description.created_by),
        scene: printable::lines(description.scene.trim_end()),
        certificate: certificate(table),
        difference,
        packed: &packed,
        illustrations,
        warning_a_over_r: Validity::WARNING_A_OVER_R,
        large_contact: LARGE_CONTACT,
        probe: opening,
    };
    Ok(page.html()?)
}

/// Returns the name and the radius of the probe with which the page opens.
fn opening(table: &Table, probe: &Probe) -> Result<(&'static str, f64), Error> {
    let refused = |reason| Error::PageProbe {
        probe: probe.name(),
        reason,
    };
    let (name, radius) = match *probe {
        Probe::Paraboloid { radius } => ("paraboloid", radius),
        Probe::Sphere { radius } => ("sphere", radius),
        Probe::FlatPunch { radius } => ("flat-punch", radius),
        _ => {
            return Err(refused(
                "it has the paraboloid, the sphere and the flat punch",
            ));
        }
    };
    let answered = table.answers();
    if name != "paraboloid" && answered != Quantity::ALL {
        return Err(refused("it needs pi0, eeq, gamma and delta0"));
    }
    Ok((name, radius))
}

/// Returns the low-rank form that goes into the page.
fn embedded(table: &Table) -> Result<Table, Error> {
    if table.low_rank().is_some() {
        return Ok(table.clone());
    }
    let form = compress(table, TRUNCATION)?;
    Ok(Table::from_low_rank(
        table.description().clone(),
        table.axes(),
        table.quantities(),
        form,
    )?)
}

/// Returns the largest relative difference of the quantities of two tables, held or derived, at
/// random points of their box.
fn largest_difference(table: &Table, other: &Table) -> Result<f64, Error> {
    let mut largest = 0.0_f64;
    for (x, material) in random_points(table, COMPARED, SEED) {
        let curves = [table.curve(&material)?, other.curve(&material)?];
        for quantity in Quantity::ALL {
            if let [Ok(value), Ok(other)] =
                curves.each_ref().map(|curve| curve.quantity(quantity, x))
            {
                largest = largest.max((other / value - 1.0).abs());
            }
        }
    }
    Ok(largest)
}

/// Returns the symbol of a parameter and its meaning.
fn symbol(parameter: Parameter, table: &Table) -> (&'static str, &'static str) {
    match parameter {
        Parameter::AOverT => ("a/t", "contact radius over film thickness"),
        Parameter::E1OverE2 => (
            "E₁/E₂*",
            "film’s Young’s modulus over the sphere’s reduced modulus",
        ),
        Parameter::Nu1 => ("ν₁", "film’s Poisson ratio"),
        Parameter::E0OverE2 if table.unit() == "E1*" => (
            "E₀/E₁",
            "substrate’s Young’s modulus over the film’s Young’s modulus",
        ),
        Parameter::E0OverE2 => (
            "E₀/E₂*",
            "substrate’s Young’s modulus over the sphere’s reduced modulus",
        ),
        Parameter::E1sOverEinfs => (
            "E₁*/E∞*",
            "film’s reduced modulus over that of sphere and substrate, 1/E∞* = 1/E₂* + 1/E₀*",
        ),
        Parameter::E0sOverE2s => (
            "E₀*/E₂*",
            "substrate’s reduced modulus over the sphere’s reduced modulus",
        ),
        Parameter::E0OverE1 => ("E₀/E₁", "base’s Young’s modulus over that of the top layer"),
    }
}

/// Returns the text of a fixed value of a parameter.
fn value(parameter: Parameter, value: f64) -> String {
    match parameter {
        Parameter::E1OverE2 | Parameter::E0sOverE2s if value == 0.0 => {
            "0 (rigid sphere)".to_owned()
        }
        Parameter::E1sOverEinfs if value == 0.0 => "0 (rigid sphere and substrate)".to_owned(),
        Parameter::E0OverE2 | Parameter::E0sOverE2s if value == f64::INFINITY => {
            "∞ (rigid substrate)".to_owned()
        }
        _ => number(value),
    }
}

/// Returns the text of a number: with an exponent only where the text is long without it.
fn number(value: f64) -> String {
    let [plain, exponential] = [format!("{value}"), format!("{value:e}")];
    if plain.len() <= exponential.len().max(6) {
        plain
    } else {
        exponential.replace('-', "−")
    }
}

/// Rounds a number to six digits.
fn short(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

/// Returns what the page shows of the parameters.
fn parameters(table: &Table) -> Vec<page::Parameter> {
    let of_axis = |parameter| {
        let (symbol, meaning) = symbol(parameter, table);
        let range = match table.axis(parameter) {
            [only] => Range::Fixed(value(parameter, *only)),
            nodes => {
                let [first, last] =
                    [nodes[0], nodes[nodes.len() - 1]].map(|end| value(parameter, end));
                Range::FromTo(first, last, nodes.len().to_string())
            }
        };
        page::Parameter {
            symbol,
            meaning,
            range,
        }
    };
    let (meaning, range) = match table.description().nu0 {
        SubstratePoissonRatio::Fixed(nu0) => {
            ("substrate’s Poisson ratio", Range::Fixed(nu0.to_string()))
        }
        SubstratePoissonRatio::Paired => (
            "substrate’s Poisson ratio; film and substrate are replaced by an equivalent whose ν₀ \
             follows from its ν₁",
            Range::FromTo("0".to_owned(), "0.5".to_owned(), "paired".to_owned()),
        ),
    };
    let substrate = page::Parameter {
        symbol: "ν₀",
        meaning,
        range,
    };
    table
        .parameters()
        .into_iter()
        .map(of_axis)
        .chain([substrate])
        .collect()
}

/// Returns the names and values of the certificate.
fn certificate(table: &Table) -> Vec<(&'static str, String)> {
    let Description {
        tolerance,
        certificate,
        ..
    } = table.description();
    let place = table.parameters().into_iter().zip(certificate.worst_point);
    let place = place.map(|(parameter, place)| {
        format!(
            "{} = {}",
            symbol(parameter, table).0,
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
    let names = [
        "Γ² = es (x Eeq)′",
        "F₀′ = S δ₀′",
        "δ₀′ = (2/R) S/S′",
        "F₀′ = (2/R) S²/S′",
    ];
    let broken = names
        .iter()
        .zip(certificate.identity_errors)
        .filter_map(|(name, error)| Some(format!("{name}: {:.1e}", error?)));
    let broken: Vec<String> = broken.collect();
    if !broken.is_empty() {
        items.push((
            "identities",
            format!("largest relative errors of {}", broken.join(", ")),
        ));
    }
    items
}
