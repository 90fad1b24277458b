//! The heading of a column in a file of the user's: `time (s)`, `r [um]`, `penetration_nm`.

use anyhow::Context;
use units::{Dimension, Unit};

/// Returns the name in a heading, in lower case, and the size of its unit in the SI unit of `dimension`, 1 without
/// a unit. The unit is in brackets, or the last word.
pub fn named(heading: &str, dimension: Dimension) -> anyhow::Result<(String, f64)> {
    let size = |symbol: &str| {
        let unit = Unit::parse(symbol).filter(|unit| unit.dimension == dimension);
        unit.map(|unit| unit.size)
    };
    if let Some((name, rest)) = heading.split_once(['[', '(']) {
        let symbol = rest.trim_end_matches([']', ')']).trim();
        let size = size(symbol).with_context(|| {
            format!(
                "{heading:?}: {symbol:?} is no unit of {dimension}, such as {}",
                dimension.unit()
            )
        })?;
        return Ok((name.trim().to_lowercase(), size));
    }
    let last = heading.rsplit_once(['_', '/', ' ', '-', ':']);
    let with_unit = last.and_then(|(name, symbol)| Some((name, size(symbol)?)));
    let (name, size) = with_unit.unwrap_or((heading, 1.0));
    Ok((name.trim().to_lowercase(), size))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_in_brackets_or_in_the_last_word() {
        for (heading, name, size) in [
            ("r [um]", "r", 1e-6),
            ("z (nm)", "z", 1e-9),
            ("Z", "z", 1.0),
            ("r_um", "r", 1e-6),
            ("z/nm", "z", 1e-9),
            ("r um", "r", 1e-6),
            ("r_m", "r", 1.0),
            ("radius", "radius", 1.0),
        ] {
            let found = named(heading, Dimension::Length).expect("a length");
            assert_eq!(found.0, name, "{heading}");
            assert!((found.1 / size - 1.0).abs() < 1e-12, "{heading}");
        }
        let (name, size) = named("time [ms]", Dimension::Time).expect("a time");
        assert_eq!((name.as_str(), size), ("time", 1e-3));
        assert!(named("z [mN]", Dimension::Length).is_err());
    }
}
