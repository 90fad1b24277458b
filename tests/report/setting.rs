//! The settings of a page: its address, and the contact that they describe.

use acceptance::{solid, system_of};
use contact::Contact;
use interp::{Probe, Quantity, SubstratePoissonRatio, Table};

/// The settings of a page, in SI units. `film` and `substrate` are Young's modulus and Poisson
/// ratio.
#[derive(Clone, Copy)]
pub struct Setting {
    /// The value of --probe.
    pub probe: &'static str,
    pub thickness: f64,
    pub film: [f64; 2],
    pub substrate: [f64; 2],
    pub radius: f64,
    pub sphere: f64,
    pub adhesion: f64,
}

/// Reads settings, one a line: the probe, the thickness, modulus and Poisson ratio of the film, those
/// of the substrate, radius and modulus of the sphere, the work of adhesion, and a note after `#`.
pub fn settings(table: &'static str) -> Vec<Setting> {
    let setting = |line: &'static str| {
        let (cells, _) = line.split_once('#').unwrap_or((line, ""));
        let cells: Vec<&str> = cells.split_whitespace().collect();
        let [probe, numbers @ ..] = &cells[..] else {
            panic!("an empty line")
        };
        let numbers: Vec<f64> = numbers
            .iter()
            .map(|cell| cell.parse().expect(line))
            .collect();
        let [thickness, e1, nu1, e0, nu0, radius, sphere, adhesion] = numbers[..] else {
            panic!("not eight numbers: {line}")
        };
        Setting {
            probe,
            thickness,
            film: [e1, nu1],
            substrate: [e0, nu0],
            radius,
            sphere,
            adhesion,
        }
    };
    let lines = table.lines().filter(|line| !line.trim().is_empty());
    let settings: Vec<_> = lines.map(setting).collect();
    assert!(!settings.is_empty(), "a table without settings");
    settings
}

impl Setting {
    /// Returns the address that sets the parameters that the table leaves free.
    pub fn address(&self, table: &Table) -> String {
        let [_, film, nu1, substrate] = table.parameters();
        let free = |parameter| table.axis(parameter).len() > 1;
        let rigid_sphere = table.unit() == "E1*";
        let settings = [
            (true, "film_thickness", self.thickness),
            (rigid_sphere || free(film), "film_modulus", self.film[0]),
            (free(nu1), "film_poisson_ratio", self.film[1]),
            (free(substrate), "substrate_modulus", self.substrate[0]),
            (
                table.description().nu0 == SubstratePoissonRatio::Paired,
                "substrate_poisson_ratio",
                self.substrate[1],
            ),
            (true, "sphere_radius", self.radius),
            (!rigid_sphere, "sphere_modulus", self.sphere),
            (
                table.answers().contains(&Quantity::Gamma),
                "work_of_adhesion",
                self.adhesion,
            ),
        ];
        let free = settings
            .iter()
            .filter(|(free, ..)| *free)
            .map(|(_, name, value)| format!("{name}={value:e}"));
        let probe = (self.probe != "paraboloid").then(|| format!("probe={}", self.probe));
        probe.into_iter().chain(free).collect::<Vec<_>>().join("&")
    }

    pub fn contact(&self, table: &Table) -> Contact {
        let solid = |[young, poisson]: [f64; 2]| solid(young, poisson);
        let radius = self.radius;
        let system = system_of(
            match self.probe {
                "paraboloid" => Probe::Paraboloid { radius },
                "sphere" => Probe::Sphere { radius },
                "flat-punch" => Probe::FlatPunch { radius },
                other => panic!("{other}"),
            },
            self.sphere,
            solid(self.film),
            self.thickness,
            solid(self.substrate),
        );
        Contact::in_table(table, &system).expect("in the table")
    }
}
