//! The table that is compiled into the crate (feature `embedded`).

use std::sync::LazyLock;

use crate::Table;

/// The table of the scene `tables/default.toml`, packed by `tabulate pack --tolerance`.
static DEFAULT: LazyLock<Table> = LazyLock::new(|| {
    let bytes = include_bytes!("../../embedded/default.bin");
    Table::from_packed(bytes).expect("the bytes are compiled in, and tested")
});

impl Table {
    /// Returns the table that is compiled into the crate (feature `embedded`, on by default).
    ///
    /// It holds all four quantities for compliant spheres on films on a substrate at least as stiff
    /// as the sphere: `a/t` and `E1/E2*` from 1e-3 to 1e3, `nu1` from 0 to 0.5, `E0/E2*` from 1 to
    /// 1e6, `nu0 = 0.25` ([`Table::curve`] explains other `nu0`). It is in low-rank form to a
    /// tolerance of 1e-7. Its [`certificate`](crate::Description::certificate) states the largest
    /// error at sampled points.
    ///
    /// The first call decodes the table in some 20 to 40 milliseconds.
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
        &DEFAULT
    }
}
