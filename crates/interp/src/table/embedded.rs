//! The table that is compiled into the crate (feature `embedded`).

use crate::Table;
use crate::once::Lazy;

/// The table of the scene `tables/universal.toml`, packed by `tabulate pack --tolerance`.
static UNIVERSAL: Lazy<Table> = Lazy::new(|| {
    let bytes = include_bytes!("../../embedded/universal.bin");
    Table::from_packed(bytes).expect("the bytes are compiled in, and tested")
});

impl Table {
    /// Returns the table that is compiled into the crate (feature `embedded`, on by default).
    ///
    /// It answers every sphere, film and substrate with Poisson ratios from 0 to 1/2: a compliant
    /// or rigid sphere, a compliant or rigid substrate, and a film softer than both or stiffer, up
    /// to `E1*/E2* + E1*/E0* = 1e10`. `a/t` is from 1e-3 to 1e3, and beyond where the expansions
    /// about the limits are accurate. It holds `Gamma` alone, from which the other quantities
    /// follow along `a/t`, in low-rank form to a tolerance of 1e-6. Its
    /// [`certificate`](crate::Description::certificate) states the largest error of all four at
    /// sampled points.
    ///
    /// The first call decodes the table, and the first lookup prepares it: the next ones are faster.
    ///
    /// ```
    /// # fn main() -> Result<(), interp::Error> {
    /// let table = interp::Table::embedded();
    /// let curve = table.curve(&interp::Material::new(1.75, 0.5, 1e5, 0.25)?)?;
    /// let error = table.description().certificate.max_error;
    /// assert!((curve.quantities(1e-3)?.eeq / 0.7 - 1.0).abs() < 1e-3 + error); // nearly a half-space of film, eq. 7
    /// # Ok(()) }
    /// ```
    pub fn embedded() -> &'static Self {
        &UNIVERSAL
    }
}
