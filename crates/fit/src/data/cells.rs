//! The cells of a row.

/// What stands between the cells of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Delimiter {
    Tab,
    Semicolon,
    /// A comma; then numbers have a decimal point.
    Comma,
    /// One or more spaces or tabs.
    Spaces,
}

impl Delimiter {
    /// All, the one that is least often part of a number first.
    pub const ALL: [Self; 4] = [Self::Tab, Self::Semicolon, Self::Comma, Self::Spaces];

    /// Returns the cells of a line, without the spaces and the quotes around them. A delimiter
    /// between quotes separates nothing.
    pub fn split(self, line: &str) -> impl Iterator<Item = &str> {
        let mut quoted = false;
        line.split(move |c: char| {
            quoted ^= c == '"';
            !quoted
                && match self {
                    Self::Tab => c == '\t',
                    Self::Semicolon => c == ';',
                    Self::Comma => c == ',',
                    Self::Spaces => c.is_whitespace(),
                }
        })
        .map(|cell| cell.trim().trim_matches('"').trim())
        .filter(move |cell| self != Self::Spaces || !cell.is_empty())
    }

    /// Returns the cells of a line of headings: as [`Delimiter::split`], but a unit in brackets
    /// belongs to the word before it where spaces separate cells.
    pub fn split_headings(self, line: &str) -> Vec<String> {
        let mut cells: Vec<String> = Vec::new();
        for cell in self.split(line) {
            match cells.last_mut() {
                Some(last) if self == Self::Spaces && cell.starts_with(['[', '(', '{']) => {
                    last.push(' ');
                    last.push_str(cell);
                }
                _ => cells.push(cell.to_owned()),
            }
        }
        cells
    }
}

/// Errors of a spreadsheet, with which a row may begin.
const ERRORS: [&str; 7] = [
    "#N/A", "#DIV/0!", "#VALUE!", "#NUM!", "#REF!", "#NAME?", "#NULL!",
];

/// Returns the text of a comment line without its mark.
pub fn comment(line: &str) -> Option<&str> {
    let line = line.trim();
    if ERRORS.iter().any(|error| line.starts_with(error)) {
        return None;
    }
    ["#", "%", "//"]
        .iter()
        .find_map(|mark| line.strip_prefix(mark))
        .map(|text| text.trim_start_matches(['#', '%', '/']).trim())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quotes_keep_a_cell_together() {
        let cells = |delimiter: Delimiter, line| delimiter.split(line).collect::<Vec<_>>();
        assert_eq!(
            cells(Delimiter::Comma, "1.5, \"2,5\" ,\"\""),
            ["1.5", "2,5", ""]
        );
        assert_eq!(cells(Delimiter::Spaces, "  1,5\t 2,5  "), ["1,5", "2,5"]);
        assert_eq!(cells(Delimiter::Semicolon, "1,5;;"), ["1,5", "", ""]);
        assert_eq!(cells(Delimiter::Tab, "a b\tc"), ["a b", "c"]);
        assert_eq!(
            Delimiter::Spaces.split_headings("Force [mN]  \"Contact radius\" (um) z"),
            ["Force [mN]", "Contact radius (um)", "z"]
        );
        assert_eq!(comment("  ## a # b"), Some("a # b"));
        assert_eq!(comment("a # b"), None);
        assert_eq!(comment("#N/A,1"), None);
    }
}
