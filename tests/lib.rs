//! What the acceptance tests beside this file share: reading `data/*.csv`, random materials, and how errors are measured.

#![forbid(unsafe_code)]

use std::fs;
use std::path::Path;

use interp::{Material, Quantities};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// A data file: one row of numbers per case, with named columns. Lines that begin with `#` are comments.
#[derive(Clone, Debug)]
pub struct Data {
    columns: Vec<String>,
    rows: Vec<Vec<f64>>,
}

/// One case of a [`Data`] file.
#[derive(Clone, Copy, Debug)]
pub struct Case<'a> {
    data: &'a Data,
    row: &'a [f64],
}

impl Data {
    /// Reads `data/<name>.csv`.
    ///
    /// # Panics
    /// If the file is missing, holds no case or a field that is no number.
    pub fn read(name: &str) -> Self {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("data").join(format!("{name}.csv"));
        let text = fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        let mut lines = text.lines().filter(|line| !line.starts_with('#') && !line.is_empty());
        let columns: Vec<String> = lines.next().expect("a header line").split(',').map(str::to_owned).collect();
        let number = |field: &str| field.parse().unwrap_or_else(|_| panic!("{name}.csv: {field:?} is no number"));
        let rows: Vec<Vec<f64>> = lines.map(|line| line.split(',').map(number).collect()).collect();
        assert!(!rows.is_empty(), "{name}.csv holds no case");
        assert!(rows.iter().all(|row| row.len() == columns.len()), "{name}.csv has rows of different lengths");
        Self { columns, rows }
    }

    /// The cases, in the order of the file.
    pub fn cases(&self) -> impl Iterator<Item = Case<'_>> {
        self.rows.iter().map(|row| Case { data: self, row })
    }
}

impl Case<'_> {
    /// The value in a named column.
    ///
    /// # Panics
    /// If there is no such column.
    pub fn get(&self, column: &str) -> f64 {
        let index = self.data.columns.iter().position(|name| name == column);
        self.row[index.unwrap_or_else(|| panic!("no column {column:?}"))]
    }

    /// The material of the columns `e1_over_e2`, `nu1`, `e0_over_e2`, `nu0`.
    ///
    /// # Panics
    /// If it is not physical.
    pub fn material(&self) -> Material {
        material([self.get("e1_over_e2"), self.get("nu1"), self.get("e0_over_e2"), self.get("nu0")])
    }

    /// The quantities of the columns `pi0`, `eeq`, `gamma`, `delta0`.
    pub fn quantities(&self) -> Quantities {
        Quantities::from_array(["pi0", "eeq", "gamma", "delta0"].map(|name| self.get(name)))
    }
}

/// The material `[e1_over_e2, nu1, e0_over_e2, nu0]`.
///
/// # Panics
/// If it is not physical.
pub fn material([e1_over_e2, nu1, e0_over_e2, nu0]: [f64; 4]) -> Material {
    Material::new(e1_over_e2, nu1, e0_over_e2, nu0).expect("the tests' materials are physical")
}

/// The largest relative deviation of the four quantities from those of `truth`.
pub fn relative_error(quantities: &Quantities, truth: &Quantities) -> f64 {
    relative_errors(quantities, truth).into_iter().fold(0.0, larger)
}

/// The relative deviation of each of the four quantities from that of `truth`.
pub fn relative_errors(quantities: &Quantities, truth: &Quantities) -> [f64; 4] {
    let (values, truths) = (quantities.to_array(), truth.to_array());
    std::array::from_fn(|i| (values[i] / truths[i] - 1.0).abs())
}

/// The larger of two errors, NaN if either is: a NaN must not pass for a small error.
pub fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

/// An endless, reproducible stream of random contacts.
#[derive(Clone, Debug)]
pub struct Contacts {
    generator: Pcg64Mcg,
}

impl Contacts {
    /// The stream of one seed.
    pub fn new(seed: u64) -> Self {
        Self { generator: Pcg64Mcg::seed_from_u64(seed) }
    }

    /// A number uniform in `[from, to)`.
    pub fn uniform(&mut self, from: f64, to: f64) -> f64 {
        self.generator.random_range(from..to)
    }

    /// A number whose logarithm is uniform in `[ln from, ln to)`.
    pub fn log_uniform(&mut self, from: f64, to: f64) -> f64 {
        self.uniform(from.ln(), to.ln()).exp()
    }

    /// A Poisson ratio of `(-0.5, 0.5]`: one in four exactly 0.5, one in four logarithmically close to it, the rest uniform.
    pub fn poisson_ratio(&mut self) -> f64 {
        match self.generator.random_range(0..4) {
            0 => 0.5,
            1 => 0.5 - self.log_uniform(1e-9, 1e-2),
            _ => self.uniform(-0.5, 0.5),
        }
    }

    /// A material with film and substrate moduli between the given bounds; one in six has a rigid substrate.
    pub fn material(&mut self, e1_over_e2: [f64; 2], e0_over_e2: [f64; 2]) -> Material {
        let e1 = self.log_uniform(e1_over_e2[0], e1_over_e2[1]);
        let e0 = self.log_uniform(e0_over_e2[0], e0_over_e2[1]);
        let e0 = if self.generator.random_range(0..6) == 0 { f64::INFINITY } else { e0 };
        material([e1, self.poisson_ratio(), e0, self.poisson_ratio()])
    }
}
