//! Scenes: the box of parameters to tabulate, as a TOML file of data.
//!
//! A range of a parameter becomes an axis of the table. A single number is held fixed and adds no
//! cost. A scene with a `[stack]` is of these layers under spheres of any modulus: its axes are
//! `a_over_t`, over the thickness of all layers, and `e1_over_e2` of the top layer.

use std::fmt;
use std::io::Read;
use std::path::Path;

use interp::{Certificate, Description, Material, Parameter, Quantity, SubstratePoissonRatio};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use serde::de::{Error as _, MapAccess, Visitor};
use serde::{Deserialize, Deserializer};

use crate::solve::{A_OVER_T, check_reach};
use crate::stack::{NamedStack, text};
use crate::{Error, input};

/// The keys of a scene, before they are checked.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Text {
    title: String,
    #[serde(default = "default_tolerance")]
    tolerance: f64,
    #[serde(default = "all_quantities")]
    quantities: Vec<Quantity>,
    a_over_t: Values,
    e1_over_e2: Option<Values>,
    e1s_over_einfs: Option<Values>,
    nu1: Option<Values>,
    e0_over_e2: Option<Values>,
    e0s_over_e2s: Option<Values>,
    nu0: Option<Nu0>,
    stack: Option<text::Text>,
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
enum Nu0 {
    Number(f64),
    Word(Word),
}

/// The only word that `nu0` may be.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Word {
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
enum Values {
    Fixed(f64),
    Range(Range),
}

/// A range, with the number of its nodes if the scene states it.
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
                Range::deserialize(serde::de::value::MapAccessDeserializer::new(map))
                    .map(Values::Range)
                    .map_err(M::Error::custom)
            }
        }
        deserializer.deserialize_any(Either)
    }
}

/// The values of one parameter in a checked scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Extent {
    /// One number. The parameter is held fixed and adds no cost.
    Fixed(f64),
    /// A range. The planner chooses its nodes.
    Range {
        /// The smallest value.
        from: f64,
        /// The largest value.
        to: f64,
    },
    /// A range with a stated number of nodes, evenly spaced in the parameter's coordinate.
    Even {
        /// The smallest value.
        from: f64,
        /// The largest value.
        to: f64,
        /// The number of nodes, two or more.
        nodes: usize,
    },
}

impl Extent {
    /// Returns the smallest and the largest value.
    pub const fn ends(&self) -> [f64; 2] {
        match *self {
            Self::Fixed(value) => [value; 2],
            Self::Range { from, to } | Self::Even { from, to, .. } => [from, to],
        }
    }
}

/// A checked scene.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The scene's title.
    pub title: String,
    /// The largest relative error that is allowed between the nodes of the table.
    pub tolerance: f64,
    /// The quantities of the table, in the order of [`Quantity::ALL`].
    pub quantities: Vec<Quantity>,
    /// The parameters of the table: [`Parameter::ALL`], [`Parameter::REDUCED`] or
    /// [`Parameter::STACK`].
    pub parameters: [Parameter; 4],
    /// The values of the parameters, in their order.
    pub extents: [Extent; 4],
    /// The substrate's Poisson ratio.
    pub nu0: SubstratePoissonRatio,
    /// The stack of layers, if the parameters are those of a stack.
    pub stack: Option<NamedStack>,
    /// The TOML text.
    pub text: String,
}

/// The box of a scene, and what it is of.
struct Bounds {
    parameters: [Parameter; 4],
    extents: [Extent; 4],
    nu0: SubstratePoissonRatio,
    stack: Option<NamedStack>,
}

impl Bounds {
    /// Returns the box of films on substrates.
    fn of_films(scene: &Text) -> Result<Self, String> {
        let (parameters, [film, substrate]) = match (
            [&scene.e1_over_e2, &scene.e0_over_e2],
            [&scene.e1s_over_einfs, &scene.e0s_over_e2s],
        ) {
            ([Some(film), Some(substrate)], [None, None]) => (Parameter::ALL, [film, substrate]),
            ([None, None], [Some(film), Some(substrate)]) => {
                (Parameter::REDUCED, [film, substrate])
            }
            _ => {
                return Err(
                    "the moduli must be given by e1_over_e2 and e0_over_e2 (Young's moduli over \
                     E2*), or by e1s_over_einfs and e0s_over_e2s (ratios of reduced moduli)"
                        .into(),
                );
            }
        };
        let Some(nu1) = &scene.nu1 else {
            return Err("nu1 is missing: give a number or a range in (-1, 0.5]".into());
        };
        let mut extents = [Extent::Fixed(0.0); 4];
        let given = [&scene.a_over_t, film, nu1, substrate];
        for ((extent, parameter), values) in extents.iter_mut().zip(parameters).zip(given) {
            *extent = checked(parameter, values)?;
        }
        let nu0 = scene.nu0.clone().unwrap_or_default().into();
        // The pairs of Poisson ratios are those of film and substrate with 0 to 0.5.
        if nu0 == SubstratePoissonRatio::Paired && extents[2].ends()[0] < 0.0 {
            return Err(format!(
                "nu1 = {:?} has no pair: with nu0 = \"paired\", nu1 must be in 0 to 0.5",
                extents[2].ends()[0]
            ));
        }
        Ok(Self {
            parameters,
            extents,
            nu0,
            stack: None,
        })
    }

    /// Returns the box of a stack of layers.
    fn of_stack(scene: &Text, stack: text::Text) -> Result<Self, String> {
        let settled = [
            ("nu1", scene.nu1.is_some()),
            ("nu0", scene.nu0.is_some()),
            ("e0_over_e2", scene.e0_over_e2.is_some()),
            ("e1s_over_einfs", scene.e1s_over_einfs.is_some()),
            ("e0s_over_e2s", scene.e0s_over_e2s.is_some()),
        ];
        if let Some((key, _)) = settled.iter().find(|(_, given)| *given) {
            return Err(format!(
                "{key} does not go with [stack], whose layers and base have their moduli and Poisson \
                 ratios: leave it out"
            ));
        }
        let Some(spheres) = &scene.e1_over_e2 else {
            return Err(
                "e1_over_e2 is missing: give a number or a range, Young's modulus of the top \
                 layer over the sphere's reduced modulus E2* (0: rigid sphere)"
                    .into(),
            );
        };
        let named = stack.stack().map_err(|what| format!("stack: {what}"))?;
        let (top, base) = (named.stack.surface(), named.stack.base());
        Ok(Self {
            parameters: Parameter::STACK,
            extents: [
                checked(Parameter::AOverT, &scene.a_over_t)?,
                checked(Parameter::E1OverE2, spheres)?,
                Extent::Fixed(top.poisson()),
                Extent::Fixed(base.young() / top.young()),
            ],
            nu0: SubstratePoissonRatio::Fixed(base.poisson()),
            stack: Some(named),
        })
    }
}

/// The Poisson ratio of the substrate where none is stated.
pub const DEFAULT_NU0: f64 = 0.25;
/// The smallest and the largest tolerance of a table.
pub(crate) const TOLERANCE: [f64; 2] = [1e-10, 1e-1];
/// The ratios of moduli of a table, besides 0 and infinity.
const MODULI: [f64; 2] = [1e-30, 1e30];
/// The largest number of bytes of a scene file. A larger one is taken for a mistake.
const LONGEST: u64 = 1 << 20;
/// The largest number of nodes on an axis. A larger one is taken for a mistake.
pub(crate) const MOST_NODES: usize = 10_000;

impl Scene {
    /// Reads a scene file. `tolerance` replaces the scene's own.
    ///
    /// # Errors
    /// [`Error::Read`] if the file cannot be read; [`Error::Scene`] with file, key, value and
    /// range.
    pub fn read(path: &Path, tolerance: Option<f64>) -> Result<Self, Error> {
        let mut text = String::new();
        input::open(path, LONGEST)
            .and_then(|(mut file, _)| file.read_to_string(&mut text))
            .map_err(|source| Error::Read {
                path: path.to_owned(),
                source,
            })?;
        Self::parse(&text, tolerance).map_err(|what| Error::Scene {
            path: path.to_owned(),
            what,
        })
    }

    /// Parses the text of a scene. `tolerance` replaces the scene's own.
    ///
    /// # Errors
    /// A sentence with key, value and range.
    pub fn parse(text: &str, tolerance: Option<f64>) -> Result<Self, String> {
        let scene: Text = toml::from_str(text).map_err(|error| explained(text, &error))?;
        if scene.title.contains('\0') {
            return Err("title holds the character U+0000, which HDF5 cannot store".into());
        }
        let tolerance = tolerance.unwrap_or(scene.tolerance);
        within("tolerance", tolerance, TOLERANCE)?;
        let mut quantities = scene.quantities.clone();
        quantities.sort();
        if quantities.is_empty() || quantities.windows(2).any(|pair| pair[0] == pair[1]) {
            return Err(format!(
                "quantities must name one to four of {}, each once",
                Quantity::ALL.map(Quantity::name).join(", ")
            ));
        }
        let Bounds {
            parameters,
            extents,
            nu0,
            stack,
        } = match scene.stack.clone() {
            Some(stack) => Bounds::of_stack(&scene, stack)?,
            None => Bounds::of_films(&scene)?,
        };
        let scene = Self {
            title: scene.title,
            tolerance,
            quantities,
            parameters,
            extents,
            nu0,
            stack,
            text: text.to_owned(),
        };
        // Every bound is on one parameter alone, so that two corners stand for the whole box.
        for corner in [0, 1] {
            let [_, values @ ..] = extents.map(|extent| extent.ends()[corner]);
            scene.material(values).map_err(|e| e.to_string())?;
        }
        if let Some(NamedStack { stack, .. }) = &scene.stack {
            check_reach(stack, extents[0].ends()[1]).map_err(|e| e.to_string())?;
            let young = stack.surface().young();
            let [softest, stiffest] = extents[1].ends();
            if !(young / stiffest >= f64::MIN_POSITIVE && young / softest < f64::INFINITY)
                && stiffest > 0.0
            {
                return Err(format!(
                    "e1_over_e2 = {softest:?} to {stiffest:?} with a top layer of {young:?} Pa are spheres \
                     beyond double precision: give the moduli of the stack in Pa"
                ));
            }
        }
        Ok(scene)
    }

    /// Returns the number of ranges, which is that of the table's axes.
    pub fn axes(&self) -> usize {
        self.extents
            .iter()
            .filter(|extent| !matches!(extent, Extent::Fixed(_)))
            .count()
    }

    /// Returns the description of the scene's table before its certificate is measured.
    pub(crate) fn description(&self) -> Description {
        Description {
            title: self.title.clone(),
            scene: self.text.clone(),
            nu0: self.nu0,
            tolerance: self.tolerance,
            created_by: created_by(),
            certificate: Certificate::UNMEASURED,
        }
    }

    /// Returns `count` random points of the box, evenly distributed in the axes' coordinates.
    pub fn random_points(&self, count: usize, seed: u64) -> Vec<[f64; 4]> {
        let ends = self.extents.each_ref().map(Extent::ends);
        random_points(self.parameters, ends, count, seed)
    }

    /// Returns the material with these values of the scene's second to fourth parameter.
    ///
    /// # Errors
    /// [`Error::Table`] for parameters that are not physical. Those of the scene are.
    pub fn material(&self, values: [f64; 3]) -> Result<Material, Error> {
        material(self.parameters, self.nu0, values)
    }
}

/// Returns the name and the version of the program.
pub(crate) fn created_by() -> String {
    format!("tabulate {}", env!("CARGO_PKG_VERSION"))
}

/// Returns the material with these values of the second to fourth parameter of a scene or table.
///
/// # Errors
/// [`Error::Table`] for parameters that are not physical.
pub(crate) fn material(
    parameters: [Parameter; 4],
    nu0: SubstratePoissonRatio,
    [film, nu1, substrate]: [f64; 3],
) -> Result<Material, Error> {
    let nu0 = nu0.under(nu1);
    Ok(match parameters[3] {
        Parameter::E0sOverE2s => Material::of_reduced_moduli(film, nu1, substrate, nu0)?,
        // Under a rigid sphere a material holds `E0/E1` itself.
        Parameter::E0OverE1 if film > 0.0 => Material::new(film, nu1, film * substrate, nu0)?,
        _ => Material::new(film, nu1, substrate, nu0)?,
    })
}

/// Returns `count` random points of a box, evenly distributed in the axes' coordinates.
pub(crate) fn random_points(
    parameters: [Parameter; 4],
    ends: [[f64; 2]; 4],
    count: usize,
    seed: u64,
) -> Vec<[f64; 4]> {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut value = |parameter: Parameter| {
        let [from, to] = ends[parameter.dimension()];
        if from == to {
            return from;
        }
        let (first, last) = (parameter.coordinate(from), parameter.coordinate(to));
        parameter
            .value(random.random_range(first..last))
            .clamp(from, to)
    };
    (0..count).map(|_| parameters.map(&mut value)).collect()
}

/// Returns the message of the TOML reader, or a better one for layers outside of a stack.
fn explained(text: &str, error: &toml::de::Error) -> String {
    let keys = text.parse::<toml::Table>().unwrap_or_default();
    match keys.keys().find(|key| key.starts_with("layer")) {
        Some(key) => format!(
            "{key}: the layers of a scene are in its table [stack]: write [stack] with base = {{ .. }}, then a \
             [[stack.layers]] for each layer, after the keys title, tolerance, quantities, a_over_t and e1_over_e2"
        ),
        None => error.to_string().trim_end().to_owned(),
    }
}

/// Returns the values of one parameter, if they can be solved.
fn checked(parameter: Parameter, values: &Values) -> Result<Extent, String> {
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
        (Some(nodes), None) => nodes as f64 - 1.0,
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
    if !(1.0..MOST_NODES as f64).contains(&intervals) {
        return Err(format!(
            "{name} has {} nodes; 2 to {MOST_NODES} are allowed",
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
        _ => within(key, value, MODULI),
    }
}

/// Accepts the value of a key if it is in a range.
fn within(key: &str, value: f64, [from, to]: [f64; 2]) -> Result<(), String> {
    if value >= from && value <= to {
        Ok(())
    } else {
        Err(format!("{key} = {value:?} is outside {from:e} to {to:e}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hostile::each_damaged;
    use crate::table::Plan;

    #[test]
    fn a_damaged_scene_is_refused_or_sound() {
        const SOUND: &str = "title = \"x\"\ntolerance = 1e-2\nquantities = [\"pi0\", \"eeq\"]\n\
             a_over_t = { from = 1e-1, to = 10, nodes = 5 }\ne1_over_e2 = { from = 0.3, to = 3, nodes = 4 }\n\
             nu1 = 0.5\ne0_over_e2 = { from = 10, to = 100, nodes_per_decade = 3 }\nnu0 = 0.25\n";
        const OF_STACK: &str = "title = \"x\"\na_over_t = { from = 1e-1, to = 10, nodes = 5 }\n\
             e1_over_e2 = { from = 0.3, to = 3, nodes = 4 }\n[stack]\nbase = { young_modulus = inf }\n\
             [[stack.layers]]\nyoung_modulus = 5e5\npoisson_ratio = 0.5\nthickness = 2e-6\n\
             [[stack.layers]]\nyoung_modulus = 3e6\npoisson_ratio = 0.3\nthickness = 7e-6\n";
        const WORDS: [&str; 21] = [
            "nan",
            "inf",
            "-inf",
            "-",
            "0",
            "1e-30",
            "1e308",
            "9223372036854775807",
            "\"paired\"",
            "e1s_over_einfs",
            "e0s_over_e2s",
            "[",
            "]]",
            "{",
            "\"",
            "\\u0000",
            "\u{1b}",
            "\n",
            "nodes = 10000",
            "[stack]",
            "1.0000000001",
        ];
        let (mut refused, mut accepted, mut planned) = (0, 0, 0);
        let mut try_out = |_: usize, bytes: &[u8]| {
            let Ok(text) = std::str::from_utf8(bytes) else {
                return;
            };
            let Ok(scene) = Scene::parse(text, None) else {
                refused += 1;
                return;
            };
            accepted += 1;
            assert!(TOLERANCE[0] <= scene.tolerance && scene.tolerance <= TOLERANCE[1]);
            for point in scene.random_points(2, 1) {
                let [_, values @ ..] = point;
                assert!(scene.material(values).is_ok(), "{text}");
            }
            // Planning a range takes solves; stated nodes need none.
            let is_stated = |extent: &Extent| !matches!(extent, Extent::Range { .. });
            if scene.extents.iter().all(is_stated) && scene.title.len() % 8 == 1 {
                planned += usize::from(Plan::new(&scene).is_ok());
            }
        };
        for sound in [SOUND, OF_STACK] {
            each_damaged(sound.as_bytes(), &WORDS, 3, &mut try_out);
        }
        println!("{refused} refused, {accepted} accepted, {planned} planned");
        assert!(refused > 0 && planned > 0);
    }
}
