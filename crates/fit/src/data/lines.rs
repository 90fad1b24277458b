//! The lines of a text file, with their numbers, in bounded memory.

use std::borrow::Cow;
use std::io::{BufRead, Chain, Cursor, Read};

use super::failure::DataError;

/// What files that are not text begin with, and their names in messages.
const BINARY: [(&[u8], &str); 5] = [
    (
        b"\x89HDF\r\n\x1a\n",
        "an HDF5 file, such as a table of contacts",
    ),
    (
        b"PK\x03\x04",
        "a zip archive, such as a spreadsheet or a JPK file",
    ),
    (b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1", "a spreadsheet (xls)"),
    (b"\x1f\x8b", "a compressed file (gzip)"),
    (b"%PDF-", "a PDF"),
];

/// The longest line, in bytes. A longer one is not a row of a measurement.
const LONGEST: usize = 1 << 16;

/// The number of bytes that tell the kind of a file.
const START: u64 = 8;

/// What other files that are not text are called.
const BINARY_DATA: &str = "binary data";

/// How bytes stand for characters.
#[derive(Clone, Copy, Debug)]
enum Encoding {
    /// UTF-8, or Latin-1 in lines that are not UTF-8.
    Bytes,
    /// UTF-16, as spreadsheets save "Unicode text", with the function that joins two bytes.
    Utf16(fn([u8; 2]) -> u16),
}

/// Reads one line after another.
#[derive(Debug)]
pub struct Lines<R> {
    source: Chain<Cursor<Vec<u8>>, R>,
    encoding: Encoding,
    buffer: Vec<u8>,
    number: u64,
    /// Whether the last line has ended in CR, so that LF directly after it ends no line.
    after_return: bool,
}

impl<R: BufRead> Lines<R> {
    /// Looks at the first bytes, and leaves a byte order mark out.
    pub fn new(mut source: R) -> Result<Self, DataError> {
        let mut start = Vec::new();
        (&mut source).take(START).read_to_end(&mut start)?;
        if let Some((_, what)) = BINARY.iter().find(|(bytes, _)| start.starts_with(bytes)) {
            return Err(no_text(what));
        }
        let (encoding, mark): (_, &[u8]) = match &start[..] {
            [0xff, 0xfe, ..] => (Encoding::Utf16(u16::from_le_bytes), b"\xff\xfe"),
            [0xfe, 0xff, ..] => (Encoding::Utf16(u16::from_be_bytes), b"\xfe\xff"),
            [0xef, 0xbb, 0xbf, ..] => (Encoding::Bytes, b"\xef\xbb\xbf"),
            _ => (Encoding::Bytes, b""),
        };
        start.drain(..mark.len());
        Ok(Self {
            source: Cursor::new(start).chain(source),
            encoding,
            buffer: Vec::new(),
            number: 0,
            after_return: false,
        })
    }

    /// The number of the last line, from 1.
    pub const fn number(&self) -> u64 {
        self.number
    }

    /// Returns the next line without its end, which is LF, CR LF or CR. A line that is not UTF-8 is
    /// read as Latin-1, in which older programs write the sign of micro.
    pub fn next(&mut self) -> Result<Option<Cow<'_, str>>, DataError> {
        self.buffer.clear();
        self.number += 1;
        let found = match self.encoding {
            Encoding::Bytes => self.bytes()?,
            Encoding::Utf16(join) => self.utf16(join)?,
        };
        if self.buffer.contains(&0) {
            return Err(no_text(BINARY_DATA));
        }
        if !found {
            return Ok(None);
        }
        Ok(Some(match str::from_utf8(&self.buffer) {
            Ok(text) => Cow::Borrowed(text),
            Err(_) => Cow::Owned(self.buffer.iter().copied().map(char::from).collect()),
        }))
    }

    /// Adds the bytes up to the end of the line to the buffer. Returns false at the end of the file.
    fn bytes(&mut self) -> Result<bool, DataError> {
        let mut any = false;
        loop {
            let mut available = self.source.fill_buf()?;
            if available.is_empty() {
                return Ok(any);
            }
            if self.after_return {
                self.after_return = false;
                if available[0] == b'\n' {
                    self.source.consume(1);
                    continue;
                }
            }
            any = true;
            let end = available.iter().position(|byte| b"\n\r".contains(byte));
            if let Some(end) = end {
                self.after_return = available[end] == b'\r';
                available = &available[..end];
            }
            let length = available.len();
            if self.buffer.len() + length > LONGEST {
                // Binary data have long lines, too: they are told by the caller.
                let room = LONGEST - self.buffer.len();
                let binary = available[..room].contains(&0) || self.buffer.contains(&0);
                return Err(if binary {
                    no_text(BINARY_DATA)
                } else {
                    self.too_long()
                });
            }
            self.buffer.extend_from_slice(available);
            self.source.consume(length + usize::from(end.is_some()));
            if end.is_some() {
                return Ok(true);
            }
        }
    }

    /// Adds the line to the buffer as UTF-8. Returns false at the end of the file.
    fn utf16(&mut self, join: fn([u8; 2]) -> u16) -> Result<bool, DataError> {
        let mut units = Vec::new();
        let mut any = false;
        loop {
            let mut pair = Vec::new();
            (&mut self.source).take(2).read_to_end(&mut pair)?;
            let Ok(pair) = <[u8; 2]>::try_from(pair) else {
                break;
            };
            let unit = join(pair);
            let after_return = std::mem::take(&mut self.after_return);
            if unit == u16::from(b'\n') && after_return {
                continue;
            }
            any = true;
            self.after_return = unit == u16::from(b'\r');
            if self.after_return || unit == u16::from(b'\n') {
                break;
            }
            if units.len() == LONGEST {
                return Err(self.too_long());
            }
            units.push(unit);
        }
        self.buffer
            .extend(String::from_utf16_lossy(&units).into_bytes());
        Ok(any)
    }

    fn too_long(&self) -> DataError {
        DataError::new(format!(
            "the line is longer than {LONGEST} bytes; save one row of numbers to a line"
        ))
        .in_line(self.number)
    }
}

/// The error of a file that is not text.
fn no_text(what: &str) -> DataError {
    DataError::new(format!(
        "this is {what}, not text; save or export the measurement as columns of text first"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(bytes: &[u8]) -> Result<Vec<String>, DataError> {
        let mut lines = Lines::new(bytes)?;
        let mut all = Vec::new();
        while let Some(line) = lines.next()? {
            all.push(line.into_owned());
        }
        Ok(all)
    }

    #[test]
    fn ends_marks_and_encodings_are_left_out() {
        let abc = || Some(vec!["a".into(), "b".into(), String::new(), "c".into()]);
        assert_eq!(lines(b"\xef\xbb\xbfa\r\nb\n\nc").ok(), abc());
        assert_eq!(lines(b"a\rb\n\rc\r").ok(), abc());
        assert_eq!(lines(b"a\rb\r\rc\r\n").ok(), abc());
        assert_eq!(lines(b"\xb5m\n").ok(), Some(vec!["µm".into()]));
        for join in [u16::to_le_bytes, u16::to_be_bytes] {
            let units = "\u{feff}a\r\nb\n\nc".encode_utf16();
            let bytes: Vec<u8> = units.flat_map(join).collect();
            assert_eq!(lines(&bytes).ok(), abc());
        }
    }

    #[test]
    fn a_line_that_is_too_long_is_refused() {
        let refused = lines(&[b'1'; LONGEST + 1]).expect_err("too long");
        assert!(refused.what.contains("longer than 65536 bytes"));
        assert!(lines(&[b'1'; LONGEST]).is_ok());
        let utf16 = |count: usize| lines(&[&b"\xff\xfe"[..], &b"1\0".repeat(count)].concat());
        assert!(utf16(LONGEST + 1).is_err());
        assert!(utf16(LONGEST).is_ok());
    }
}
