//! Numbers with a decimal point or a decimal comma.

/// The decimal mark of a file. The first number that has one decides.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DecimalMark {
    /// A point or a comma.
    mark: Option<char>,
    /// Whether a mark stands where none parts thousands.
    surely_decimal: bool,
}

/// The decimal marks of numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Marks {
    /// Points, or none.
    #[default]
    Points,
    /// Commas.
    Commas,
    /// Commas, of which each could part thousands: `41,250`.
    UnclearCommas,
    /// Points, of which each could part thousands: `41.250`.
    UnclearPoints,
}

/// A cell of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cell {
    /// A finite number.
    Number(f64),
    /// Nothing, NaN, an error of a spreadsheet, or a number that stands for a missing value.
    Missing,
    /// An infinity, or a number too large for f64.
    Infinite,
    /// A number whose decimal mark is not that of the numbers before.
    OtherMark,
    /// A number with a separator of thousands.
    Thousands,
    /// Neither.
    Text,
}

/// Words for a value that is missing, in lower case: of programs, spreadsheets and the C library of
/// Windows.
const MISSING: [&str; 17] = [
    "", "-", "--", "nan", "+nan", "-nan", "n/a", "na", "null", "none", "#n/a", "#div/0!",
    "#value!", "#num!", "1.#qnan", "1.#ind", "-1.#ind",
];

/// A number of this size or above stands for a missing value: programs of nanoindenters write the
/// largest number of their type, such as 1.797e308.
const PLACEHOLDER: f64 = 1e300;

/// What programs write in place of a minus, and Fortran in place of the letter of an exponent.
const UNUSUAL: [char; 4] = ['\u{2212}', '\u{2013}', 'D', 'd'];

impl DecimalMark {
    /// Returns the decimal marks of the numbers that were read.
    pub fn marks(self) -> Marks {
        match self.mark {
            Some(',') if self.surely_decimal => Marks::Commas,
            Some(',') => Marks::UnclearCommas,
            Some(_) if !self.surely_decimal => Marks::UnclearPoints,
            _ => Marks::Points,
        }
    }

    /// Returns the mark that may part thousands, where a number has another one than those before it.
    pub fn thousands(self, text: &str) -> Option<char> {
        let before = self.mark.unwrap_or('.');
        let other = if before == ',' { '.' } else { ',' };
        (!self.surely_decimal)
            .then_some(before)
            .or(has_groups(text).then_some(other))
    }

    pub fn read(&mut self, text: &str) -> Cell {
        let text = text.trim();
        if MISSING.iter().any(|word| text.eq_ignore_ascii_case(word)) {
            return Cell::Missing;
        }
        let owned;
        let text = if text.contains(UNUSUAL) {
            owned = text
                .replace(['\u{2212}', '\u{2013}'], "-")
                .replace(['D', 'd'], "e");
            &owned
        } else {
            text
        };
        let count = |mark: u8| text.bytes().filter(|byte| *byte == mark).count();
        let (value, mark) = match (count(b'.'), count(b',')) {
            (0, 1) => (text.replacen(',', ".", 1).parse(), Some(',')),
            (1, 0) => (text.parse(), Some('.')),
            _ => (text.parse(), None),
        };
        let Ok(value): Result<f64, _> = value else {
            return if has_thousands(text) {
                Cell::Thousands
            } else {
                Cell::Text
            };
        };
        if let Some(mark) = mark
            && *self.mark.get_or_insert(mark) != mark
        {
            return Cell::OtherMark;
        }
        self.surely_decimal |= mark.is_some() && !has_groups(text);
        // 15 digits of the largest number are above it.
        let is_largest = || text.to_ascii_lowercase().ends_with("308");
        if value.is_infinite() && !is_largest() {
            Cell::Infinite
        } else if value.abs() >= PLACEHOLDER {
            Cell::Missing
        } else {
            Cell::Number(value)
        }
    }
}

/// Tells whether the comma of a number may part thousands: `41,250`, and not `0,250`.
pub fn may_part_thousands(text: &str) -> bool {
    text.contains(',') && has_groups(text)
}

/// Tells whether a number has groups of three digits, and does not begin with a 0.
fn has_groups(text: &str) -> bool {
    let digits = text.trim_start_matches(['+', '-']);
    has_thousands(text) && !digits.starts_with('0')
}

/// Tells whether a text that is no number is one with a separator of thousands: `1,234.5`, `1.234,5`,
/// `1 234`, `1'234`.
fn has_thousands(text: &str) -> bool {
    let digits = text.trim_start_matches(['+', '-']);
    let whole = digits.split_once(|c: char| !c.is_ascii_digit());
    let Some((first, rest)) = whole else {
        return false;
    };
    let Some(separator) = digits[first.len()..].chars().next() else {
        return false;
    };
    if !(1..=3).contains(&first.len()) || !" ,.'\u{2019}\u{a0}\u{202f}".contains(separator) {
        return false;
    }
    let are_digits = |text: &str| text.bytes().all(|b| b.is_ascii_digit());
    let is_group = |group: &str| group.len() == 3 && are_digits(group);
    let (before, last) = match rest.rsplit_once(separator) {
        Some((before, last)) => (Some(before), last),
        None => (None, rest),
    };
    // Decimals after the last group.
    let (last, decimals) = last.split_at(last.find(['.', ',']).unwrap_or(last.len()));
    before.is_none_or(|before| before.split(separator).all(is_group))
        && is_group(last)
        && are_digits(decimals.trim_start_matches(['.', ',']))
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
        assert_eq!(mark.marks(), Marks::Commas);
        let mut unclear = DecimalMark::default();
        assert_eq!(unclear.read("-41,250"), Cell::Number(-41.25));
        assert_eq!(unclear.marks(), Marks::UnclearCommas);
        assert_eq!(unclear.read("0,250"), Cell::Number(0.25));
        assert_eq!(unclear.marks(), Marks::Commas);
        let mut point = DecimalMark::default();
        assert_eq!(point.read(".5"), Cell::Number(0.5));
        assert_eq!(point.marks(), Marks::Points);
        assert_eq!(point.read("1,5"), Cell::OtherMark);
        assert_eq!(point.thousands("1,5"), None);
        assert_eq!(point.thousands("1,500"), Some(','));
        let mut unclear = DecimalMark::default();
        assert_eq!(unclear.read("-41.250"), Cell::Number(-41.25));
        assert_eq!(unclear.marks(), Marks::UnclearPoints);
        assert_eq!(unclear.thousands("1,5"), Some('.'));
        assert_eq!(unclear.read("0.250"), Cell::Number(0.25));
        assert_eq!(unclear.marks(), Marks::Points);
    }

    #[test]
    fn what_is_no_number_is_told_apart() {
        let read = |text| DecimalMark::default().read(text);
        let missing = "| |NaN|nan|-|--|#N/A|#DIV/0!|n/a|-1.#IND|1.797e308|1,1E+308|\
                       -1.7976931348623157e308|1.79769313486232E+308";
        for text in missing.split('|') {
            assert_eq!(read(text), Cell::Missing, "{text:?}");
        }
        for text in "1.234,5|1,234.5|1,234,567|-1 234|1'234.50|12\u{a0}345,6".split('|') {
            assert_eq!(read(text), Cell::Thousands, "{text:?}");
        }
        for text in "\u{2212}1.5e\u{2212}3|\u{2013}1.5E-03|-1.5D-03|-1,5d-3".split('|') {
            assert_eq!(read(text), Cell::Number(-1.5e-3), "{text:?}");
        }
        for text in ["inf", "-Infinity", "1e999"] {
            assert_eq!(read(text), Cell::Infinite, "{text:?}");
        }
        for text in ["1,234,5", "1 2", "0x1", "retract", "1.2.3", "5 nm"] {
            assert_eq!(read(text), Cell::Text, "{text:?}");
        }
    }
}
