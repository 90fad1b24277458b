//! Parameters and numbers as the page writes them.

use interp::{Parameter, Table};

/// Returns the symbol of a parameter and its meaning.
pub(super) fn symbol(parameter: Parameter, table: &Table) -> (&'static str, &'static str) {
    match parameter {
        Parameter::AOverT => ("a/t", "contact radius over film thickness"),
        Parameter::E1OverE2 => (
            "E₁/E₂*",
            "film’s Young’s modulus over the sphere’s reduced modulus",
        ),
        Parameter::Nu1 => ("ν₁", "film’s Poisson ratio"),
        Parameter::E0OverE2 if table.unit() == "E1*" => (
            "E₀/E₁",
            "substrate’s Young’s modulus over the film’s Young’s modulus",
        ),
        Parameter::E0OverE2 => (
            "E₀/E₂*",
            "substrate’s Young’s modulus over the sphere’s reduced modulus",
        ),
        Parameter::E1sOverEinfs => (
            "E₁*/E∞*",
            "film’s reduced modulus over that of sphere and substrate, 1/E∞* = 1/E₂* + 1/E₀*",
        ),
        Parameter::E0sOverE2s => (
            "E₀*/E₂*",
            "substrate’s reduced modulus over the sphere’s reduced modulus",
        ),
        Parameter::E0OverE1 => ("E₀/E₁", "base’s Young’s modulus over that of the top layer"),
    }
}

/// Returns the text of a number: with an exponent only where the text is long without it.
pub(super) fn number(value: f64) -> String {
    let [plain, exponential] = [format!("{value}"), format!("{value:e}")];
    if plain.len() <= exponential.len().max(6) {
        plain
    } else {
        exponential.replace('-', "−")
    }
}
