//! Files that are read a little at a time, and no more of them than expected.
//!
//! A device or a broken file may have no end.

use std::cell::Cell;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;
use std::rc::Rc;

use crate::Error;

/// The number of bytes that may still be read.
pub type Room = Rc<Cell<u64>>;

/// A file of which only some bytes may be read. One more is an error.
pub struct Limited {
    file: File,
    room: Room,
    /// For the message.
    most: u64,
}

/// Opens a file to read at most `most` bytes of it, or more where the room is made larger.
pub fn open(path: &Path, most: u64) -> io::Result<(Limited, Room)> {
    let room = Rc::new(Cell::new(most));
    let limited = Limited {
        file: File::open(path)?,
        room: Rc::clone(&room),
        most,
    };
    Ok((limited, room))
}

/// Reads the text of a scene or of a stack. More than a megabyte is taken for a mistake.
pub fn text(path: &Path) -> Result<String, Error> {
    const LONGEST: u64 = 1 << 20;
    let mut text = String::new();
    open(path, LONGEST)
        .and_then(|(mut file, _)| file.read_to_string(&mut text))
        .map_err(|error| match error.kind() {
            io::ErrorKind::InvalidData => not_utf8(),
            _ => error,
        })
        .map_err(|source| Error::Read {
            path: path.to_owned(),
            source,
        })?;
    Ok(text)
}

/// Makes the error of a file in another encoding.
pub fn not_utf8() -> io::Error {
    invalid("it is no text in UTF-8; save it with this encoding".to_owned())
}

/// Makes the error of what a file holds.
pub fn invalid(why: String) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, why)
}

impl Limited {
    /// Returns the length of the file, 0 of a pipe.
    #[cfg(feature = "cli")]
    pub fn length(&self) -> u64 {
        self.file.metadata().map_or(0, |data| data.len())
    }
}

impl Read for Limited {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        let read = self.file.read(bytes)?;
        let left = self.room.get().checked_sub(read as u64);
        self.room.set(left.ok_or_else(|| {
            io::Error::other(format!(
                "a row or the file is longer than {} bytes, which is taken for a mistake",
                self.most
            ))
        })?);
        Ok(read)
    }
}
