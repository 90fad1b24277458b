//! What the user of the page can set, and what its script needs to know of the table for that.

use contact::magnitude::{LARGEST_WORK, LENGTHS, MODULI};
use figures::page::{SetBy, Setting, list, number};
use interp::{Parameter, Quantity, SubstratePoissonRatio, Table};

use super::symbols::{self, symbol};

const FILM_MODULUS: &str = "film_modulus";
const FILM_POISSON_RATIO: &str = "film_poisson_ratio";
const SUBSTRATE_MODULUS: &str = "substrate_modulus";
const SUBSTRATE_POISSON_RATIO: &str = "substrate_poisson_ratio";
const SPHERE_MODULUS: &str = "sphere_modulus";
const SPHERE_RADIUS: &str = "sphere_radius";
const WORK_OF_ADHESION: &str = "work_of_adhesion";
const POISSON_RATIOS: [f64; 2] = [0.0, 0.5];
const SOLIDS: [f64; 2] = [1e3, 1e12];

/// A setting by its key, name, symbol and unit, the size of the unit, the value in Barthel's paper, and
/// the ends of its slider.
type Entry = ([&'static str; 4], f64, f64, [f64; 2]);

/// The settings, by the names of `tabulate curve`'s options.
#[rustfmt::skip]
const SETTINGS: [Entry; 8] = [
    (["film_thickness", "film thickness", "t", "µm"], 1e-6, 1e-6, [1e-9, 1e-3]),
    ([FILM_MODULUS, "film modulus", "E₁", "MPa"], 1e6, 3.5e6, SOLIDS),
    ([FILM_POISSON_RATIO, "film Poisson ratio", "ν₁", ""], 1.0, 0.5, POISSON_RATIOS),
    ([SUBSTRATE_MODULUS, "substrate modulus", "E₀", "MPa"], 1e6, 2e11, SOLIDS),
    ([SUBSTRATE_POISSON_RATIO, "substrate Poisson ratio", "ν₀", ""], 1.0, 0.25, POISSON_RATIOS),
    ([SPHERE_MODULUS, "sphere reduced modulus", "E₂*", "MPa"], 1e6, 2e6, SOLIDS),
    ([SPHERE_RADIUS, "sphere radius", "R", "µm"], 1e-6, 1e-3, [1e-8, 0.1]),
    ([WORK_OF_ADHESION, "work of adhesion", "w", "mJ/m²"], 1e-3, 0.04, [1e-4, 10.0]),
];

/// The materials of a table, as settings describe them.
pub struct Materials<'a> {
    table: &'a Table,
    /// The parameters of the modulus of the film, its Poisson ratio, and the modulus of the substrate.
    parameters: [Parameter; 3],
    /// The axes are those of reduced moduli.
    reduced: bool,
    /// The sphere is rigid, and the axes are those of Young's moduli.
    rigid_sphere: bool,
    /// Film and substrate are replaced by their equivalent with paired Poisson ratios.
    paired: bool,
}

impl<'a> Materials<'a> {
    pub fn new(table: &'a Table) -> Self {
        let [_, film, nu1, substrate] = table.parameters();
        let is_paired = table.description().nu0 == SubstratePoissonRatio::Paired;
        Self {
            table,
            parameters: [film, nu1, substrate],
            reduced: substrate == Parameter::E0sOverE2s,
            rigid_sphere: table.unit() == "E1*",
            paired: is_paired && table.axis(nu1).len() > 1,
        }
    }

    /// Returns whether the body with a modulus is rigid in all materials, and in some.
    fn rigid(&self, key: &str) -> [bool; 2] {
        let [film, _, substrate] = self.parameters.map(|parameter| self.table.range(parameter));
        let both = self.reduced && film[1] == 0.0;
        match key {
            SPHERE_MODULUS => [
                both || self.rigid_sphere || self.reduced && substrate[1] == 0.0,
                self.reduced && substrate[0] == 0.0,
            ],
            SUBSTRATE_MODULUS => [
                both || substrate[0] == f64::INFINITY,
                self.reduced && substrate[1] == f64::INFINITY,
            ],
            _ => [false, false],
        }
    }

    /// Returns who sets a setting. `adhesive` is whether the table answers what adhesion needs.
    fn set_by(&self, key: &str, adhesive: bool) -> SetBy {
        let [film, nu1, substrate] = self.parameters;
        let by_ratio = |parameter: Parameter, of: &str| {
            let [from, to] = self.table.range(parameter);
            // A ratio of 0 is that of any film between rigid bodies, and of any substrate under a
            // rigid sphere.
            let is_one = from == to && from != 0.0;
            is_one.then(|| SetBy::Ratio(format!(" = {} {of}", symbols::number(from))))
        };
        let unit = if self.rigid_sphere { "E₁" } else { "E₂*" };
        let ratio = match key {
            FILM_MODULUS => by_ratio(film, if self.reduced { "E∞*" } else { unit }),
            SUBSTRATE_MODULUS => by_ratio(substrate, unit),
            _ => None,
        };
        let is_fixed = match key {
            FILM_POISSON_RATIO => self.table.axis(nu1).len() == 1,
            SUBSTRATE_POISSON_RATIO => !self.paired,
            _ => false,
        };
        match (self.rigid(key), ratio) {
            ([true, _], _) => SetBy::Table(""),
            (_, Some(ratio)) => ratio,
            _ if is_fixed => SetBy::Table(""),
            _ if key == WORK_OF_ADHESION && !adhesive => {
                SetBy::Table(": the table lacks eeq or gamma")
            }
            ([_, true], _) => SetBy::UserOrRigid,
            _ => SetBy::User,
        }
    }

    /// Returns the settings of a page that opens with a probe of this `radius`, in m.
    pub fn settings(&self, quantities: &[Quantity], radius: f64) -> Vec<Setting> {
        let adhesive = [Quantity::Eeq, Quantity::Gamma]
            .iter()
            .all(|quantity| quantities.contains(quantity));
        let nu1 = match self.paired {
            true => POISSON_RATIOS,
            false => self.table.range(self.parameters[1]),
        };
        let setting = |([key, name, symbol, unit], scale, usual, ends): Entry| {
            let set_by = self.set_by(key, adhesive);
            let usual = match key {
                SPHERE_RADIUS => radius,
                FILM_POISSON_RATIO => f64::clamp(usual, nu1[0], nu1[1]),
                SUBSTRATE_POISSON_RATIO if !self.paired => {
                    self.table.description().nu0.under(nu1[0])
                }
                WORK_OF_ADHESION if !adhesive => 0.0,
                _ if self.rigid(key)[0] => f64::INFINITY,
                _ => usual,
            };
            let positive = f64::MIN_POSITIVE;
            let valid = match key {
                // The range of the table is another condition.
                FILM_POISSON_RATIO if !self.paired => ([f64::MIN, f64::MAX], "a number"),
                FILM_POISSON_RATIO | SUBSTRATE_POISSON_RATIO => {
                    (POISSON_RATIOS, "a number from 0 to 0.5")
                }
                WORK_OF_ADHESION => ([0.0, f64::MAX], "a number that is 0 or larger"),
                _ if set_by == SetBy::UserOrRigid => {
                    ([positive, f64::INFINITY], "a number above 0, or “rigid”")
                }
                _ => ([positive, f64::MAX], "a number above 0"),
            };
            let undoubted = match key {
                FILM_MODULUS | SUBSTRATE_MODULUS | SPHERE_MODULUS => MODULI,
                FILM_POISSON_RATIO | SUBSTRATE_POISSON_RATIO => POISSON_RATIOS,
                WORK_OF_ADHESION => [0.0, LARGEST_WORK],
                _ => LENGTHS,
            };
            let ends = if key == FILM_POISSON_RATIO { nu1 } else { ends };
            Setting {
                key,
                name,
                symbol,
                unit,
                scale,
                usual,
                ends,
                undoubted,
                valid,
                set_by,
            }
        };
        SETTINGS.into_iter().map(setting).collect()
    }

    /// Returns what the script needs to know of the materials, as entries of an object of JavaScript.
    pub fn script(&self) -> String {
        let nu0 = match self.table.description().nu0 {
            SubstratePoissonRatio::Fixed(nu0) => number(nu0),
            SubstratePoissonRatio::Paired => "null".to_owned(),
        };
        let unit = if self.rigid_sphere {
            FILM_MODULUS
        } else {
            SPHERE_MODULUS
        };
        let entry = |parameter: Parameter| {
            let (mut name, _) = symbol(parameter, self.table);
            let keys: &[&str] = match parameter {
                Parameter::Nu1 if self.paired => {
                    name = "ν₁ of the equivalent film";
                    &[FILM_POISSON_RATIO, SUBSTRATE_POISSON_RATIO]
                }
                Parameter::Nu1 => &[FILM_POISSON_RATIO],
                Parameter::E1OverE2 => &[FILM_MODULUS, unit],
                Parameter::E1sOverEinfs => &[FILM_MODULUS, SUBSTRATE_MODULUS, SPHERE_MODULUS],
                Parameter::E0sOverE2s => &[SUBSTRATE_MODULUS, SPHERE_MODULUS],
                _ => &[SUBSTRATE_MODULUS, unit],
            };
            format!(
                "{{ name: {:?}, symbol: {name:?}, ends: {}, keys: {keys:?} }}",
                parameter.name(),
                list(&self.table.range(parameter))
            )
        };
        format!(
            "nu0: {nu0}, reduced: {}, rigidSphere: {}, unit: {unit:?},\nparameters: [{}]",
            self.reduced,
            self.rigid_sphere,
            self.parameters.map(entry).join(", ")
        )
    }
}
