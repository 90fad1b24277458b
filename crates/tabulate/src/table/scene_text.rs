//! The keys of a scene, and the ranges of their values.

use std::fmt;

use interp::{Parameter, Quantity, SubstratePoissonRatio};
use serde::de::{Error as _, MapAccess, Visitor};
use serde::{Deserialize, Deserializer};

use crate::stack;
use crate::table::extent::{Extent, MOST_NODES};
use solve::A_OVER_T;

/// The Poisson ratio of the substrate where none is stated.
pub const DEFAULT_NU0: f64 = 0.25;
/// The ratios of moduli of a table, besides 0 and infinity.
const MODULI: [f64; 2] = [1e-30, 1e30];

/// The keys of a scene, before they are checked.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Text {
    pub(super) title: String,
    #[serde(default = "default_tolerance")]
    pub(super) tolerance: f64,
    #[serde(default = "all_quantities")]
    pub(super) quantities: Vec<Quantity>,
    pub(super) a_over_t: Values,
    pub(super) e1_over_e2: Option<Values>,
    pub(super) e1s_over_einfs: Option<Values>,
    pub(super) nu1: Option<Values>,
    pub(super) e0_over_e2: Option<Values>,
    pub(super) e0s_over_e2s: Option<Values>,
    pub(super) nu0: Option<Nu0>,
    pub(super) stack: Option<stack::Text>,
}

fn default_tolerance() -> f64 {
    1e-5
}

fn all_quantities() -> Vec<Quantity> {
    Quantity::ALL.to_vec()
}

/// The value of the key `nu0`.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged, expecting = "nu0 must be a number or \"paired\"")]
pub(super) enum Nu0 {
    Number(f64),
    Word(Word),
}

/// The only word that `nu0` may be.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Word {
    Paired,
}

impl Default for Nu0 {
    fn default() -> Self {
        Self::Number(DEFAULT_NU0)
    }
}

impl From<Nu0> for SubstratePoissonRatio {
    fn from(nu0: Nu0) -> Self {
        match nu0 {
            Nu0::Number(nu0) => Self::Fixed(nu0),
            Nu0::Word(Word::Paired) => Self::Paired,
        }
    }
}

/// The value of one parameter's key.
#[derive(Clone, Debug)]
pub(super) enum Values {
    Fixed(f64),
    Range(Range),
}

/// A range, with the number of its nodes if the scene states it.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Range {
    from: f64,
    to: f64,
    nodes: Option<f64>,
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
                Range::deserialize(serde::de::value::MapAccessDeserializer::new(map))
                    .map(Values::Range)
                    .map_err(M::Error::custom)
            }
        }
        deserializer.deserialize_any(Either)
    }
}

/// Returns the values of one parameter, if they can be solved.
pub(super) fn checked(parameter: Parameter, values: &Values) -> Result<Extent, String> {
    let name = parameter.name();
    let range = match values {
        Values::Fixed(value) => {
            let is_limit = match parameter {
                Parameter::E1OverE2 => *value == 0.0,
                Parameter::E0OverE2 => *value == f64::INFINITY,
                _ => false,
            };
            if !is_limit {
                in_domain(parameter, name, *value)?;
            }
            return Ok(Extent::Fixed(*value));
        }
        Values::Range(range) => range,
    };
    in_domain(parameter, &format!("{name}.from"), range.from)?;
    in_domain(parameter, &format!("{name}.to"), range.to)?;
    if range.from >= range.to {
        return Err(format!(
            "{name} is an empty range: from = {} is not below to = {}",
            range.from, range.to
        ));
    }
    let (from, to) = (range.from, range.to);
    let intervals = match (range.nodes, range.nodes_per_decade) {
        (Some(_), Some(_)) => return Err(format!("{name} has both nodes and nodes_per_decade")),
        (Some(nodes), None) => nodes - 1.0,
        (None, Some(_)) if parameter.scale() != "logarithmic" => {
            return Err(format!(
                "{name} is not logarithmic: give nodes, not nodes_per_decade"
            ));
        }
        (None, Some(per_decade)) => {
            within(
                &format!("{name}.nodes_per_decade"),
                per_decade,
                [1.0, 1000.0],
            )?;
            // A hair below, so that a whole number of decades has a whole number of intervals.
            (per_decade * (to / from).log10() - 1e-9).ceil()
        }
        (None, None) => return Ok(Extent::Range { from, to }),
    };
    if !(1.0..MOST_NODES as f64).contains(&intervals) || intervals.fract() != 0.0 {
        return Err(format!(
            "{name} has {} nodes; whole numbers from 2 to {MOST_NODES} are allowed",
            intervals + 1.0
        ));
    }
    Ok(Extent::Even {
        from,
        to,
        nodes: intervals as usize + 1,
    })
}

/// Accepts the value of a key if it can be solved.
fn in_domain(parameter: Parameter, key: &str, value: f64) -> Result<(), String> {
    match parameter {
        Parameter::AOverT => within(key, value, A_OVER_T),
        Parameter::Nu1 if value > -1.0 && value <= 0.5 => Ok(()),
        Parameter::Nu1 => Err(format!("{key} = {value:?} is outside (-1, 0.5]")),
        Parameter::E1sOverEinfs if value == 0.0 => Ok(()),
        Parameter::E0sOverE2s if value == 0.0 || value == f64::INFINITY => Ok(()),
        _ => within(key, value, MODULI).map_err(|message| message + limit(parameter)),
    }
}

/// Returns how a scene states the limit of a rigid body, which no range of a ratio reaches.
fn limit(parameter: Parameter) -> &'static str {
    match parameter {
        Parameter::E1OverE2 => {
            "; for a rigid sphere give e1_over_e2 = 0, or the axes e1s_over_einfs and e0s_over_e2s"
        }
        Parameter::E0OverE2 => {
            "; for a rigid substrate give e0_over_e2 = inf, or the axes e1s_over_einfs and e0s_over_e2s"
        }
        _ => "",
    }
}

/// Accepts the value of a key if it is in a range.
pub(super) fn within(key: &str, value: f64, [from, to]: [f64; 2]) -> Result<(), String> {
    if value >= from && value <= to {
        Ok(())
    } else {
        Err(format!("{key} = {value:?} is outside {from:e} to {to:e}"))
    }
}
