//! The lines of a text file, with their numbers, in bounded memory.

use std::borrow::Cow;
use std::io::{BufRead, Read};

use super::failure::Problem;

/// The longest line, in bytes. A longer one is not a row of a measurement.
pub const LONGEST: usize = 1 << 16;

/// Reads one line after another.
#[derive(Debug)]
pub struct Lines<R> {
    source: R,
    buffer: Vec<u8>,
    number: u64,
}

impl<R: BufRead> Lines<R> {
    pub const fn new(source: R) -> Self {
        Self {
            source,
            buffer: Vec::new(),
            number: 0,
        }
    }

    /// The number of the last line, from 1.
    pub const fn number(&self) -> u64 {
        self.number
    }

    /// Returns the next line without its end. A byte order mark is left out, and a line that is not
    /// UTF-8 is read as Latin-1, in which older programs write the sign of micro.
    pub fn next(&mut self) -> Result<Option<Cow<'_, str>>, Problem> {
        self.buffer.clear();
        self.number += 1;
        let limit = LONGEST as u64 + 1;
        let read = (&mut self.source)
            .take(limit)
            .read_until(b'\n', &mut self.buffer)?;
        if read == 0 {
            return Ok(None);
        }
        let mut line = self.buffer.as_slice();
        if self.number == 1 {
            if line.starts_with(&[0xff, 0xfe]) || line.starts_with(&[0xfe, 0xff]) {
                return Err(Problem::Utf16);
            }
            line = line.strip_prefix(b"\xef\xbb\xbf").unwrap_or(line);
        }
        if line.contains(&0) {
            return Err(Problem::Binary);
        }
        if read > LONGEST {
            return Err(Problem::LongLine);
        }
        line = line.strip_suffix(b"\n").unwrap_or(line);
        line = line.strip_suffix(b"\r").unwrap_or(line);
        if line.contains(&b'\r') {
            return Err(Problem::CarriageReturn);
        }
        Ok(Some(match str::from_utf8(line) {
            Ok(text) => Cow::Borrowed(text),
            Err(_) => Cow::Owned(line.iter().copied().map(char::from).collect()),
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(bytes: &[u8]) -> Result<Vec<String>, Problem> {
        let mut lines = Lines::new(bytes);
        let mut all = Vec::new();
        while let Some(line) = lines.next()? {
            all.push(line.into_owned());
        }
        Ok(all)
    }

    #[test]
    fn ends_marks_and_encodings_are_left_out() {
        assert_eq!(
            lines(b"\xef\xbb\xbfa\r\nb\n\nc").ok(),
            Some(vec!["a".into(), "b".into(), String::new(), "c".into()])
        );
        assert_eq!(lines(b"\xb5m\n").ok(), Some(vec!["µm".into()]));
        assert!(matches!(lines(b"\xff\xfea\0"), Err(Problem::Utf16)));
        assert!(matches!(lines(b"\x89HDF\0\n"), Err(Problem::Binary)));
        assert!(matches!(lines(b"1,2\r3,4\r"), Err(Problem::CarriageReturn)));
        assert!(matches!(
            lines(&[b'1'; LONGEST + 1]),
            Err(Problem::LongLine)
        ));
        assert!(lines(&[b'1'; LONGEST]).is_ok());
    }
}
