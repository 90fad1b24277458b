//! CSV files. Messages name the line that an editor shows, whatever ends the lines of the file.

use std::io::{self, Read};

use crate::input::{invalid, not_utf8};

/// A CSV file with a header and comments after `#`.
pub struct CsvFile<R> {
    reader: csv::Reader<LineFeeds<R>>,
}

impl<R: Read> CsvFile<R> {
    pub fn new(bytes: R) -> Self {
        let reader = csv::ReaderBuilder::new()
            .trim(csv::Trim::Headers)
            .comment(Some(b'#'))
            .from_reader(LineFeeds {
                bytes,
                last: b'\n',
                has_ended: false,
            });
        Self { reader }
    }

    /// Returns the names of the columns.
    pub fn header(&mut self) -> io::Result<csv::StringRecord> {
        let header = self.reader.headers().cloned();
        let header = header.map_err(|error| located(error, self.reader.position().line() - 1))?;
        if header.len() == 1 && header[0].contains([';', '\t']) {
            return Err(invalid(
                "the header has semicolons or tabs: separate the columns by commas, and write decimal points".to_owned(),
            ));
        }
        Ok(header)
    }

    /// Reads the next row. Returns the line on which it begins, none at the end of the file.
    pub fn read(&mut self, row: &mut csv::StringRecord) -> io::Result<Option<u64>> {
        let is_row = self.reader.read_record(row);
        // The position of the row itself is before the comments and blank lines that precede it. The reader is
        // behind the line feed that ends it, or at the end of the file within a quotation.
        let end = self.reader.position().line() + u64::from(self.reader.get_ref().has_ended);
        let inside = row
            .iter()
            .map(|cell| cell.matches('\n').count())
            .sum::<usize>();
        let line = (end - 1).saturating_sub(inside as u64);
        row.trim();
        match is_row {
            Ok(is_row) => Ok(is_row.then_some(line)),
            Err(error) => Err(located(error, line)),
        }
    }

    /// Returns the number of bytes up to the end of the last row.
    pub fn position(&self) -> u64 {
        self.reader.position().byte()
    }
}

pub fn located(error: csv::Error, line: u64) -> io::Error {
    let text = error.to_string();
    let why = match error.into_kind() {
        csv::ErrorKind::Io(error) => return error,
        csv::ErrorKind::Utf8 { .. } => not_utf8().to_string(),
        csv::ErrorKind::UnequalLengths {
            expected_len, len, ..
        } => format!("it has {len} cells, and the header {expected_len}"),
        csv::ErrorKind::Deserialize { err, .. } => {
            match err.kind().to_string().strip_prefix("missing field ") {
                Some(column) => {
                    format!(
                        "there is no column {column}: give the CSV of the command that writes it"
                    )
                }
                None => err.to_string(),
            }
        }
        _ => text,
    };
    invalid(format!("line {line}: {why}"))
}

/// A text whose lines all end in a line feed.
struct LineFeeds<R> {
    bytes: R,
    /// The last byte read.
    last: u8,
    has_ended: bool,
}

impl<R: Read> Read for LineFeeds<R> {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        if out.is_empty() {
            return Ok(0);
        }
        let mut kept = 0;
        while kept == 0 {
            let read = self.bytes.read(out)?;
            if read == 0 {
                let is_open = self.last != b'\n' && self.last != b'\r';
                self.has_ended = !is_open;
                out[0] = b'\n';
                self.last = b'\n';
                return Ok(usize::from(is_open));
            }
            for i in 0..read {
                let byte = out[i];
                if byte == 0 {
                    return Err(not_utf8());
                }
                // A carriage return stands for a line feed, and a line feed after it for nothing.
                if !(byte == b'\n' && self.last == b'\r') {
                    out[kept] = if byte == b'\r' { b'\n' } else { byte };
                    kept += 1;
                }
                self.last = byte;
            }
        }
        Ok(kept)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A reader that gives few bytes at a time.
    struct Slow<'a>(&'a [u8], usize);

    impl Read for Slow<'_> {
        fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
            let most = self.1.min(out.len());
            self.0.read(&mut out[..most])
        }
    }

    #[test]
    fn each_row_has_the_line_that_an_editor_shows() {
        let text = "# head\n\na,b\n1,2\n\n# note\n\n3,4\n5,6\n\n# end\n7,8";
        for end in ["\n", "\r\n", "\r"] {
            for last in ["", end, &end.repeat(2)] {
                let text = text.replace('\n', end) + last;
                for step in [1, 2, 3, 1000] {
                    let mut file = CsvFile::new(Slow(text.as_bytes(), step));
                    assert_eq!(file.header().expect("a header"), vec!["a", "b"]);
                    let mut row = csv::StringRecord::new();
                    let mut rows = Vec::new();
                    while let Some(line) = file.read(&mut row).expect("a row") {
                        rows.push((line, row[0].to_owned()));
                    }
                    let expected = [(4, "1"), (8, "3"), (9, "5"), (12, "7")];
                    let expected = expected.map(|(line, cell)| (line, cell.to_owned()));
                    assert_eq!(rows, expected, "{text:?} in steps of {step}");
                }
            }
        }
    }

    #[test]
    fn a_row_of_several_lines_has_the_first() {
        // The last quotation is not closed.
        let mut file = CsvFile::new(&b"a,b\n\n\"1\n\",2\n# note\n3,\"4\n5,6\n7,8\n"[..]);
        let mut row = csv::StringRecord::new();
        for (line, cell) in [(3, "1"), (6, "3")] {
            assert_eq!(file.read(&mut row).expect("a row"), Some(line));
            assert_eq!(&row[0], cell);
        }
        assert_eq!(file.read(&mut row).expect("the end"), None);
    }

    #[test]
    fn errors_of_rows_have_the_line_too() {
        for end in ["\n", "\r\n"] {
            for (cells, why) in [(&b"1"[..], "it has 1 cells"), (b"1,\xe9", "UTF-8")] {
                let start = "a,b\n1,2\n\n# note\n".replace('\n', end);
                let bytes = [start.as_bytes(), cells, end.as_bytes()].concat();
                let mut file = CsvFile::new(&bytes[..]);
                let mut row = csv::StringRecord::new();
                file.read(&mut row).expect("a row");
                let error = file.read(&mut row).expect_err("refused").to_string();
                assert!(error.contains("line 5: ") && error.contains(why), "{error}");
            }
        }
    }

    #[test]
    fn another_encoding_is_refused() {
        let bytes: Vec<u8> = "a,b\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
        let error = CsvFile::new(&bytes[..]).header().expect_err("refused");
        assert!(error.to_string().contains("UTF-8"), "{error}");
    }
}
