//! Numbers with a decimal point or a decimal comma.

/// The decimal mark of a file. The first number that has one decides.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DecimalMark(Option<Mark>);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Mark {
    Point,
    Comma,
}

/// A cell of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cell {
    /// A finite number.
    Number(f64),
    /// Nothing, or NaN.
    Missing,
    /// An infinity, or a number too large for f64.
    Infinite,
    /// A number whose decimal mark is not that of the numbers before.
    OtherMark,
    /// Neither.
    Text,
}

impl DecimalMark {
    /// Reads a cell.
    pub fn read(&mut self, text: &str) -> Cell {
        let text = text.trim();
        if text.is_empty() || text.eq_ignore_ascii_case("nan") || text == "-" || text == "--" {
            return Cell::Missing;
        }
        let (points, commas) = text.bytes().fold((0, 0), |(points, commas), byte| {
            (
                points + usize::from(byte == b'.'),
                commas + usize::from(byte == b','),
            )
        });
        let (value, mark) = match (points, commas) {
            (0, 1) => (text.replacen(',', ".", 1).parse(), Some(Mark::Comma)),
            (1, 0) => (text.parse(), Some(Mark::Point)),
            _ => (text.parse(), None),
        };
        let Ok(value): Result<f64, _> = value else {
            return Cell::Text;
        };
        if let Some(mark) = mark
            && *self.0.get_or_insert(mark) != mark
        {
            return Cell::OtherMark;
        }
        if value.is_finite() {
            Cell::Number(value)
        } else {
            Cell::Infinite
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_decimal_mark_decides() {
        let mut mark = DecimalMark::default();
        assert_eq!(mark.read("12"), Cell::Number(12.0));
        assert_eq!(mark.read(" -1,5e-3 "), Cell::Number(-1.5e-3));
        assert_eq!(mark.read("1.5"), Cell::OtherMark);
        assert_eq!(mark.read("1,5"), Cell::Number(1.5));
        let mut point = DecimalMark::default();
        assert_eq!(point.read(".5"), Cell::Number(0.5));
        assert_eq!(point.read("1,5"), Cell::OtherMark);
    }

    #[test]
    fn what_is_no_number_is_told_apart() {
        let read = |text| DecimalMark::default().read(text);
        for text in ["", " ", "NaN", "nan", "-", "--"] {
            assert_eq!(read(text), Cell::Missing, "{text:?}");
        }
        for text in ["inf", "-Infinity", "1e999"] {
            assert_eq!(read(text), Cell::Infinite, "{text:?}");
        }
        for text in [
            "1.234,5", "1,234,5", "1 2", "0x1", "retract", "1.2.3", "5 nm",
        ] {
            assert_eq!(read(text), Cell::Text, "{text:?}");
        }
    }
}
