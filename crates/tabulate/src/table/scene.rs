//! Scenes: the box of parameters to tabulate, as a TOML file of data.
//!
//! A range of a parameter becomes an axis of the table. A single number is held fixed and adds no
//! cost. A scene with a `[stack]` is of these layers under spheres of any modulus: its axes are
//! `a_over_t`, over the thickness of all layers, and `e1_over_e2` of the top layer. `scene_text`
//! has the keys of a scene, and `stack_scene` reads the `[stack]`.

use std::path::Path;

use interp::{
    Certificate, Description, Material, Parameter, Quantity, SubstratePoissonRatio, Table,
};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use crate::stack::NamedStack;
use crate::table::extent::{Bounds, Extent};
use crate::table::scene_text::{Text, checked, within};
use crate::table::stack_scene;
use crate::{Error, input};

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

/// The smallest and the largest tolerance of a table.
pub(crate) const TOLERANCE: [f64; 2] = [1e-10, 1e-1];

/// Returns the box of films on substrates.
fn box_of_films(scene: &Text) -> Result<Bounds, String> {
    let (parameters, [film, substrate]) = match (
        [&scene.e1_over_e2, &scene.e0_over_e2],
        [&scene.e1s_over_einfs, &scene.e0s_over_e2s],
    ) {
        ([Some(film), Some(substrate)], [None, None]) => (Parameter::ALL, [film, substrate]),
        ([None, None], [Some(film), Some(substrate)]) => (Parameter::REDUCED, [film, substrate]),
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
    Ok(Bounds {
        parameters,
        extents,
        nu0,
        stack: None,
    })
}

impl Scene {
    /// Reads a scene file. `tolerance` replaces the scene's own.
    ///
    /// # Errors
    /// [`Error::Read`] if the file cannot be read; [`Error::Scene`] with file, key, value and
    /// range.
    pub fn read(path: &Path, tolerance: Option<f64>) -> Result<Self, Error> {
        Self::parse(&input::text(path)?, tolerance).map_err(|what| Error::Scene {
            path: path.to_owned(),
            what,
        })
    }

    /// Parses the text of a scene. `tolerance` replaces the scene's own.
    ///
    /// # Errors
    /// A sentence with key, value and range.
    pub fn parse(text: &str, tolerance: Option<f64>) -> Result<Self, String> {
        let scene: Text =
            toml::from_str(text).map_err(|error| stack_scene::explained(text, &error))?;
        if scene.title.contains('\0') {
            return Err("title holds the character U+0000, which HDF5 cannot store".into());
        }
        let tolerance = tolerance.unwrap_or(scene.tolerance);
        within("tolerance", tolerance, TOLERANCE)?;
        let mut quantities = scene.quantities.clone();
        quantities.sort();
        if quantities.is_empty() || quantities.windows(2).any(|pair| pair[0] == pair[1]) {
            return Err(format!(
                "quantities must name one or more of {}, each once",
                Quantity::ALL.map(Quantity::name).join(", ")
            ));
        }
        let Bounds {
            parameters,
            extents,
            nu0,
            stack,
        } = match scene.stack.clone() {
            Some(stack) => stack_scene::bounds(&scene, stack)?,
            None => box_of_films(&scene)?,
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
        if let Some(named) = &scene.stack {
            stack_scene::check(&named.stack, &scene.extents)?;
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
    pub fn description(&self) -> Description {
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
        random_places(self.parameters, ends, count, seed)
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

/// Returns `count` random points of a table's box, each an `a/t` and a material, evenly distributed in the coordinates of the
/// axes.
pub fn random_points(table: &Table, count: usize, seed: u64) -> Vec<(f64, Material)> {
    let (parameters, nu0) = (table.parameters(), table.description().nu0);
    let ends = parameters.map(|parameter| table.range(parameter));
    let point = |[x, values @ ..]: [f64; 4]| {
        let material = material(parameters, nu0, values);
        (x, material.expect("the table's box is physical"))
    };
    let places = random_places(parameters, ends, count, seed);
    places.into_iter().map(point).collect()
}

/// Returns `count` random points of a box, evenly distributed in the axes' coordinates.
fn random_places(
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
        const WORDS: &str = "nan|inf|-inf|-|0|1e-30|1e308|9223372036854775807|\"paired\"|e1s_over_einfs|\
             e0s_over_e2s|[|]]|{|\"|\\u0000|\u{1b}|\n|nodes = 10000|[stack]|1.0000000001";
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
            each_damaged(sound.as_bytes(), WORDS, 3, &mut try_out);
        }
        println!("{refused} refused, {accepted} accepted, {planned} planned");
        assert!(refused > 0 && planned > 0);
    }
}
