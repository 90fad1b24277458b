//! Random contacts.

use std::f64::consts::PI;

use interp::{Material, Parameter, Table};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use crate::{ends, material};

/// An endless, reproducible stream of random numbers and contacts.
#[derive(Clone, Debug)]
pub struct Contacts {
    generator: Pcg64Mcg,
}

impl Contacts {
    /// Starts the stream that belongs to `seed`.
    pub fn new(seed: u64) -> Self {
        Self {
            generator: Pcg64Mcg::seed_from_u64(seed),
        }
    }

    /// Draws a number, uniform in `[from, to)`.
    pub fn uniform(&mut self, from: f64, to: f64) -> f64 {
        self.generator.random_range(from..to)
    }

    /// Draws a number whose logarithm is uniform in `[ln from, ln to)`.
    pub fn log_uniform(&mut self, from: f64, to: f64) -> f64 {
        self.uniform(from.ln(), to.ln()).exp()
    }

    /// Draws a number of the standard normal distribution (Box and Muller).
    pub fn normal(&mut self) -> f64 {
        let radius = (-2.0 * self.uniform(f64::MIN_POSITIVE, 1.0).ln()).sqrt();
        radius * (2.0 * PI * self.uniform(0.0, 1.0)).cos()
    }

    /// Draws a Poisson ratio in `(-0.5, 0.5]`: exactly 0.5 with probability 1/4, logarithmically
    /// close to 0.5 with probability 1/4, otherwise uniform.
    pub fn poisson_ratio(&mut self) -> f64 {
        match self.generator.random_range(0..4) {
            0 => 0.5,
            1 => 0.5 - self.log_uniform(1e-9, 1e-2),
            _ => self.uniform(-0.5, 0.5),
        }
    }

    /// Draws a point of a table's box, `a/t` and a material, uniform in the coordinates of the
    /// axes.
    pub fn point_of(&mut self, table: &Table) -> (f64, Material) {
        let [x, film, nu1, substrate] = table.parameters().map(|parameter| {
            let (first, last) = ends(table, parameter);
            if first == last {
                return first;
            }
            let coordinate = self.uniform(parameter.coordinate(first), parameter.coordinate(last));
            parameter.value(coordinate).clamp(first, last)
        });
        let nu0 = table.description().nu0.under(nu1);
        let material = if table.parameters() == Parameter::REDUCED {
            Material::of_reduced_moduli(film, nu1, substrate, nu0)
        } else {
            Material::new(film, nu1, substrate, nu0)
        };
        (x, material.expect("the box of a table is physical"))
    }

    /// Draws a material with moduli between the given bounds, logarithmically uniform. Its
    /// substrate is rigid with probability 1/6.
    pub fn material(&mut self, e1_over_e2: [f64; 2], e0_over_e2: [f64; 2]) -> Material {
        let e1 = self.log_uniform(e1_over_e2[0], e1_over_e2[1]);
        let e0 = self.log_uniform(e0_over_e2[0], e0_over_e2[1]);
        let e0 = if self.generator.random_range(0..6) == 0 {
            f64::INFINITY
        } else {
            e0
        };
        material([e1, self.poisson_ratio(), e0, self.poisson_ratio()])
    }
}
