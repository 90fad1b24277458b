//! The texts and numbers of the page about a table.

use contact::Validity;
use figures::page::{self, Illustration, Numbers, Page, Range};
use interp::{Description, Parameter, Probe, Quantity, SubstratePoissonRatio, Table};

use super::numbers::coarse;
use super::symbols::{number, symbol};
use super::{numbers, settings};
use crate::large_contact::LARGE_CONTACT;
use crate::{Error, printable};

/// Returns the HTML page of a table: its range, its certificate, force curves that the page
/// computes, and the `illustrations`, which are those of [`figures`](super::figures()).
///
/// The page opens with the `probe`, a paraboloid, a sphere or a flat punch, between which its user
/// chooses if the table answers all quantities.
///
/// The page computes with a low-rank form of the table, whose quantities differ from those of the
/// table by at most 2e-4, relative (`tests/report` measures it). The page states the largest difference
/// at random points, and shows numbers with four digits. Equal tables give equal pages, byte for byte.
///
/// # Errors
/// [`Error::Refused`] for a probe that the page does not compute; [`interp::Error::OfStack`] for
/// a table of a stack of layers; those of [`compress`](crate::table::compress), of the lookup and of the
/// drawing.
pub fn report(
    table: &Table,
    illustrations: &[Illustration],
    probe: &Probe,
) -> Result<String, Error> {
    if table.is_of_stack() {
        return Err(interp::Error::OfStack.into());
    }
    let (probe, radius) = opening(&numbers::quantities(table), probe)?;
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
    let page = Page {
        title: printable::line(&description.title),
        parameters: parameters(table),
        quantities: quantities.join(", "),
        normalisation,
        created_by: printable::line(&description.created_by),
        scene: printable::lines(description.scene.trim_end()),
        certificate: certificate(table),
        numbers: match without_curves(table) {
            Some(reason) => Err(reason),
            None => Ok(numbers(table, radius)?),
        },
        illustrations,
        warning_a_over_r: Validity::WARNING_A_OVER_R,
        large_contact: LARGE_CONTACT,
        probe,
    };
    Ok(page.html()?)
}

/// Returns the name and the radius of the probe with which the page opens.
fn opening(quantities: &[Quantity], probe: &Probe) -> Result<(&'static str, f64), Error> {
    let refused = |reason| {
        let probe = probe.name();
        Error::Refused(format!(
            "the page of this table computes no {probe}: {reason}; `tabulate curve` prints the force curve of every probe"
        ))
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
    if name != "paraboloid" && quantities != Quantity::ALL {
        return Err(refused("it needs pi0, eeq, gamma and delta0"));
    }
    Ok((name, radius))
}

/// Returns why the page has no curves; none if it has.
fn without_curves(table: &Table) -> Option<&'static str> {
    if table.axis(Parameter::AOverT).len() == 1 {
        Some("The table holds a single a/t: there is no curve.")
    } else if numbers::quantities(table).contains(&Quantity::Pi0) {
        None
    } else if table.answers().contains(&Quantity::Pi0) {
        Some("The table begins at too large an a/t: the page cannot derive the load from gamma.")
    } else {
        Some("The table does not hold pi0, from which the load is computed.")
    }
}

/// Returns what the page computes with, of a probe with this `radius`.
fn numbers(table: &Table, radius: f64) -> Result<Numbers, Error> {
    let quantities = numbers::quantities(table);
    let materials = settings::Materials::new(table);
    let coarse = coarse(table)?;
    let mut probes = vec![("paraboloid", "paraboloid r²/(2R)")];
    if quantities == Quantity::ALL {
        probes.extend([("sphere", "sphere itself"), ("flat-punch", "flat punch")]);
    }
    let mut columns = vec!["F", "δ", "a", "a/t"];
    columns.retain(|&symbol| symbol != "δ" || quantities.contains(&Quantity::Delta0));
    Ok(Numbers {
        settings: materials.settings(&quantities, radius),
        probes,
        columns,
        table: format!(
            "{},\n{}",
            materials.script(),
            numbers::script(&coarse.table)
        ),
        integers: numbers::integers(&coarse.table),
        difference: (coarse.difference, numbers::COMPARED),
    })
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
                let [first, last] = table.range(parameter).map(|end| value(parameter, end));
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
