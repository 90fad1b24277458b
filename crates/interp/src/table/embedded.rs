//! The table that comes with the crate (feature `embedded`).

use std::sync::LazyLock;

use crate::Table;

/// `tabulate pack --tolerance` of `tables/default.toml`.
static DEFAULT: LazyLock<Table> = LazyLock::new(|| {
    let bytes = include_bytes!("../../embedded/default.bin");
    Table::from_packed(bytes).expect("the bytes are compiled in, and tested")
});

impl Table {
    /// The table that is compiled into the crate (feature `embedded`, on by default): any sphere
    /// but a rigid one on any film on a substrate at least as stiff as the sphere, `a/t` and
    /// `E1/E2` from 1e-3 to 1e3, `nu1` from 0 to 0.5, `E0/E2` from 1 to 1e6, `nu0 = 0.25` (others
    /// as [`Table::curve`] says), all four quantities, in low-rank form to 1e-7. What accuracy it
    /// has been measured to have is its [`certificate`](crate::Description::certificate).
    ///
    /// The first call decodes it, which takes some 20 to 40 milliseconds.
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
