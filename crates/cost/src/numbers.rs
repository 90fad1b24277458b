//! Numbers as text: bytes and counts. `clock` has times.

/// Returns a number of evaluations, rounded; infinity is "never".
pub fn human_count(count: f64) -> String {
    match count {
        f64::INFINITY => "never".into(),
        1e6.. => format!("{:.1} million", 1e-6 * count),
        1e3.. => grouped((1e-3 * count).round() as u64 * 1000),
        _ => format!("{count:.0}"),
    }
}

/// Returns a number of bytes with its unit.
pub fn human_bytes(bytes: u64) -> String {
    match bytes as f64 {
        bytes @ ..1e3 => format!("{bytes} bytes"),
        bytes @ ..1e4 => format!("{:.1} kB", 1e-3 * bytes),
        bytes @ ..1e6 => format!("{:.0} kB", 1e-3 * bytes),
        bytes => format!("{:.1} MB", 1e-6 * bytes),
    }
}

/// Returns a whole number in groups of three digits.
pub fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let groups: Vec<&str> = digits
        .as_bytes()
        .rchunks(3)
        .rev()
        .map(|group| std::str::from_utf8(group).unwrap_or_default())
        .collect();
    groups.join(",")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_and_bytes_are_rounded_for_people() {
        let counts = [41.6, 25_432.0, 2.54e6, f64::INFINITY].map(human_count);
        assert_eq!(counts, ["42", "25,000", "2.5 million", "never"]);
        let bytes = [999, 1540, 25_432, 2_540_000].map(human_bytes);
        assert_eq!(bytes, ["999 bytes", "1.5 kB", "25 kB", "2.5 MB"]);
    }
}
