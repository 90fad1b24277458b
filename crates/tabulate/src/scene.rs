//! Scenes: what to tabulate, as a TOML file of data.
//!
//! Each parameter is a range, which becomes an axis of the table, or a number, which is settled and costs nothing.

use std::f64::consts::LN_10;
use std::fmt;
use std::path::Path;

use interp::schema::Parameter;
use interp::{Material, Quantity};
use serde::de::{Error as _, MapAccess, Visitor};
use serde::{Deserialize, Deserializer};

use crate::Error;
use crate::solve::{A_OVER_T, E0_OVER_E2, E1_OVER_E2};

/// A scene as it is written.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Text {
    title: String,
    #[serde(default = "default_tolerance")]
    tolerance: f64,
    #[serde(default = "all_quantities")]
    quantities: Vec<Quantity>,
    a_over_t: Values,
    e1_over_e2: Values,
    nu1: Values,
    e0_over_e2: Values,
    #[serde(default = "default_nu0")]
    nu0: f64,
}

fn default_tolerance() -> f64 {
    1e-5
}

fn all_quantities() -> Vec<Quantity> {
    Quantity::ALL.to_vec()
}

fn default_nu0() -> f64 {
    0.25
}

/// What a scene says of one parameter.
#[derive(Clone, Debug)]
enum Values {
    Fixed(f64),
    Range(Range),
}

/// A range, with the number of its nodes where the scene states it.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Range {
    from: f64,
    to: f64,
    nodes: Option<usize>,
    nodes_per_decade: Option<f64>,
}

impl<'de> Deserialize<'de> for Values {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Either;
        impl<'de> Visitor<'de> for Either {
            type Value = Values;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number or a range { from = .., to = .. }")
            }
            fn visit_f64<E>(self, value: f64) -> Result<Values, E> {
                Ok(Values::Fixed(value))
            }
            fn visit_i64<E>(self, value: i64) -> Result<Values, E> {
                Ok(Values::Fixed(value as f64))
            }
            fn visit_map<M: MapAccess<'de>>(self, map: M) -> Result<Values, M::Error> {
                Range::deserialize(serde::de::value::MapAccessDeserializer::new(map)).map(Values::Range).map_err(M::Error::custom)
            }
        }
        deserializer.deserialize_any(Either)
    }
}

/// A checked scene with its nodes.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The scene's title.
    pub title: String,
    /// The relative tolerance that the finished table is to keep between its nodes.
    pub tolerance: f64,
    /// What is tabulated, in the order of [`Quantity::ALL`].
    pub quantities: Vec<Quantity>,
    /// The nodes of the four parameters, ascending, one for a fixed parameter.
    pub axes: [Vec<f64>; 4],
    /// The substrate's Poisson ratio.
    pub nu0: f64,
    /// The TOML text.
    pub text: String,
}

/// The tolerances that a table can be asked for.
pub(crate) const TOLERANCE: [f64; 2] = [1e-10, 1e-1];
/// More nodes on an axis, or values in a table, are taken for a mistake.
const MOST_NODES: usize = 10_000;
const MOST_VALUES: usize = 200_000_000;

impl Scene {
    /// Reads a scene file. `tolerance` replaces the scene's own.
    ///
    /// # Errors
    /// [`Error::Read`] if the file cannot be read; [`Error::Scene`] naming file, key, value and range.
    pub fn read(path: &Path, tolerance: Option<f64>) -> Result<Self, Error> {
        let text = std::fs::read_to_string(path).map_err(|source| Error::Read { path: path.to_owned(), source })?;
        Self::parse(&text, tolerance).map_err(|what| Error::Scene { path: path.to_owned(), what })
    }

    /// Parses a scene; the error is in words.
    ///
    /// # Errors
    /// What is wrong, with key, value and range.
    pub fn parse(text: &str, tolerance: Option<f64>) -> Result<Self, String> {
        let scene: Text = toml::from_str(text).map_err(|e| e.to_string().trim_end().to_owned())?;
        let tolerance = tolerance.unwrap_or(scene.tolerance);
        within("tolerance", tolerance, TOLERANCE)?;
        let mut quantities = scene.quantities;
        quantities.sort();
        if quantities.is_empty() || quantities.windows(2).any(|pair| pair[0] == pair[1]) {
            return Err(format!("quantities must name one to four of {}, each once", Quantity::ALL.map(Quantity::name).join(", ")));
        }
        let mut axes = [const { Vec::new() }; 4];
        let given = [scene.a_over_t, scene.e1_over_e2, scene.nu1, scene.e0_over_e2];
        for ((axis, parameter), values) in axes.iter_mut().zip(Parameter::ALL).zip(given) {
            *axis = nodes(parameter, &values, tolerance)?;
        }
        let values = axes.iter().map(Vec::len).product::<usize>() * quantities.len();
        if values > MOST_VALUES {
            return Err(format!("the table would hold {values} values, more than {MOST_VALUES}; ask for fewer nodes"));
        }
        // The corners of the box stand for all of it: every bound is on one parameter alone.
        for corner in [0, usize::MAX] {
            let at = |axis: &[f64]| axis[corner.min(axis.len() - 1)];
            Material::new(at(&axes[1]), at(&axes[2]), at(&axes[3]), scene.nu0).map_err(|e| e.to_string())?;
        }
        Ok(Self { title: scene.title, tolerance, quantities, axes, nu0: scene.nu0, text: text.to_owned() })
    }

    /// The number of points to solve.
    pub fn points(&self) -> usize {
        self.axes.iter().map(Vec::len).product()
    }
}

/// The nodes of one parameter: evenly spaced in its coordinate, ends exact.
fn nodes(parameter: Parameter, values: &Values, tolerance: f64) -> Result<Vec<f64>, String> {
    let name = parameter.name();
    let range = match values {
        Values::Fixed(value) => {
            let rigid = match parameter {
                Parameter::E1OverE2 => *value == 0.0,
                Parameter::E0OverE2 => *value == f64::INFINITY,
                Parameter::AOverT | Parameter::Nu1 => false,
            };
            if !rigid {
                in_domain(parameter, name, *value)?;
            }
            return Ok(vec![*value]);
        }
        Values::Range(range) => range,
    };
    in_domain(parameter, &format!("{name}.from"), range.from)?;
    in_domain(parameter, &format!("{name}.to"), range.to)?;
    if range.from >= range.to {
        return Err(format!("{name} is an empty range: from = {} is not below to = {}", range.from, range.to));
    }
    let (first, last) = (parameter.coordinate(range.from), parameter.coordinate(range.to));
    let logarithmic = parameter != Parameter::Nu1;
    let intervals = match (range.nodes, range.nodes_per_decade) {
        (Some(_), Some(_)) => return Err(format!("{name} has both nodes and nodes_per_decade")),
        (Some(nodes), None) => nodes as f64 - 1.0,
        (None, Some(_)) if !logarithmic => return Err(format!("{name} is not logarithmic: give nodes, not nodes_per_decade")),
        (None, Some(per_decade)) => {
            within(&format!("{name}.nodes_per_decade"), per_decade, [1.0, 1000.0])?;
            per_decade * (last - first) / LN_10
        }
        (None, None) => default_density(parameter, tolerance) * (last - first),
    };
    // A hair below, so that a whole number of decades has a whole number of intervals.
    let intervals = (intervals - 1e-9).ceil();
    if !(1.0..MOST_NODES as f64).contains(&intervals) {
        return Err(format!("{name} has {} nodes; 2 to {MOST_NODES} are allowed", intervals + 1.0));
    }
    let node = |i: usize| parameter.value(first + (last - first) * (i as f64 / intervals));
    let mut nodes: Vec<f64> = (0..=intervals as usize).map(node).collect();
    nodes[0] = range.from;
    let count = nodes.len();
    nodes[count - 1] = range.to;
    Ok(nodes)
}

/// Nodes per unit of coordinate that keep the quintic splines within `tolerance`, from a measurement over the default box.
///
/// The film's and the substrate's moduli have the same density, so that their ratios repeat and the sweep can share work.
fn default_density(parameter: Parameter, tolerance: f64) -> f64 {
    let refinement = (1e-5 / tolerance).powf(1.0 / 6.0);
    refinement
        * match parameter {
            Parameter::AOverT => 11.0 / LN_10,
            Parameter::E1OverE2 | Parameter::E0OverE2 => 7.5 / LN_10,
            Parameter::Nu1 => 74.0,
        }
}

/// Accepts a value that can be solved.
fn in_domain(parameter: Parameter, key: &str, value: f64) -> Result<(), String> {
    match parameter {
        Parameter::AOverT => within(key, value, A_OVER_T),
        Parameter::E1OverE2 => within(key, value, E1_OVER_E2),
        Parameter::Nu1 if value > -1.0 && value <= 0.5 => Ok(()),
        Parameter::Nu1 => Err(format!("{key} = {value:?} is outside (-1, 0.5]")),
        Parameter::E0OverE2 => within(key, value, E0_OVER_E2),
    }
}

fn within(key: &str, value: f64, [from, to]: [f64; 2]) -> Result<(), String> {
    if value >= from && value <= to { Ok(()) } else { Err(format!("{key} = {value:?} is outside {from:e} to {to:e}")) }
}
