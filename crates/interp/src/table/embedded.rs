//! The table that is compiled into the crate (feature `embedded`).

use low_rank::once::Lazy;

use crate::Table;

/// The table of the scene `tables/universal.toml`, packed by `tabulate pack --tolerance`.
static UNIVERSAL: Lazy<Table> = Lazy::new(|| {
    let bytes = include_bytes!("../../embedded/universal.bin");
    Table::from_sound_code(bytes).expect("the bytes are compiled in, and tested")
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
    /// The table consists of seven tiles, each for other moduli. The first lookup in a tile decodes it.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Material;

    /// What is decoded tile by tile is what is decoded, and checked, at once.
    #[test]
    fn the_bytes_that_are_compiled_in_are_sound() {
        let bytes = include_bytes!("../../embedded/universal.bin");
        let checked = Table::from_packed(bytes).expect("sound");
        assert_eq!(checked.to_packed().expect("small"), bytes);
        // A material in each tile, and the paper's.
        for [e1, nu1, e0] in [
            [1.75, 0.5, 1e5],
            [1e-3, 0.3, 1e-9],
            [1e8, 0.2, 0.1],
            [1e-8, 0.45, 1e3],
            [300.0, 0.0, 1.0],
        ] {
            let material = Material::new(e1, nu1, e0, 0.25).expect("physical");
            let curves = [Table::embedded(), &checked].map(|table| table.curve(&material));
            let [one, other] = curves.map(|curve| curve.expect("in the table"));
            for x in [1e-3, 0.1, 1.0, 30.0, 1e3] {
                let values = [&one, &other].map(|curve| curve.quantities(x).expect("in the range"));
                assert_eq!(values[0], values[1], "{material:?}, {x}");
            }
        }
    }
}
