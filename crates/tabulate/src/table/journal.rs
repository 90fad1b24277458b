//! What a generation has finished so far, in a file beside its output, so that a killed one can go
//! on.
//!
//! ```text
//! magic, "COATJRN\n"
//! records: number (u64), length (u64), CRC-32 (u32) of the bytes, bytes
//! ```
//!
//! All integers are little-endian. A [`Header`], as TOML, is followed by the pieces of its sweep,
//! by their number, as f64; a refined plan has a header of its own, after which the pieces before
//! it count no more. Each record is flushed to the disk before the next is begun, and a torn one at
//! the end, of a process that was killed, is dropped. The file is locked as long as the generation
//! runs, and removed when the table is complete.

use std::collections::HashMap;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, BufReader, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::table::plan::Plan;
use crate::{Error, output};

const MAGIC: [u8; 8] = *b"COATJRN\n";
/// Number, length and checksum.
const PREFIX: usize = 20;
/// The number of the header's record, which no piece has.
const HEADER: u64 = u64::MAX;

/// What the finished pieces belong to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Header {
    /// Program and version.
    pub created_by: String,
    /// The scene's text.
    pub scene: String,
    /// The tolerance that is asked for.
    pub tolerance: f64,
    /// How many points the certificate rests on: a refined plan depends on them.
    pub certificate_points: usize,
    /// The bits of their seed: TOML has no larger integers.
    pub seed: i64,
    /// How often the plan was refined.
    pub round: usize,
    /// The nodes.
    pub plan: Plan,
}

/// The finished pieces of a generation. Dropping it leaves them for another to go on.
pub struct Journal {
    path: PathBuf,
    file: File,
    header: Option<Header>,
    /// Whether there is a header, and it is damaged or another version's.
    unreadable: bool,
    /// Where the bytes of each finished piece begin, and how many there are.
    pieces: HashMap<usize, (u64, u64)>,
    /// The end of the last whole record.
    end: u64,
}

impl Journal {
    /// Where the journal of a table is.
    pub fn path(table: &Path) -> PathBuf {
        beside(table, "unfinished")
    }

    /// Opens the journal of a table and locks it.
    ///
    /// # Errors
    /// [`Error::Busy`] if another process holds it; [`Error::Write`] naming it if it cannot be
    /// made, or is no journal.
    pub fn open(table: &Path) -> Result<Self, Error> {
        let path = Self::path(table);
        let write = |source| Error::Write {
            path: path.clone(),
            source,
        };
        loop {
            let file = OpenOptions::new()
                .read(true)
                .write(true)
                .create(true)
                .truncate(false)
                .open(&path)
                .map_err(write)?;
            match file.try_lock() {
                Ok(()) => {}
                Err(TryLockError::WouldBlock) => {
                    return Err(Error::Busy {
                        path: table.to_owned(),
                    });
                }
                Err(TryLockError::Error(source)) => return Err(write(source)),
            }
            // Its owner may have finished, and removed it, between the two steps.
            if is_same(&file, &path) {
                let mut journal = Self {
                    path: path.clone(),
                    file,
                    header: None,
                    unreadable: false,
                    pieces: HashMap::new(),
                    end: 0,
                };
                journal.recover().map_err(write)?;
                return Ok(journal);
            }
        }
    }

    /// Reads every whole record.
    fn recover(&mut self) -> io::Result<()> {
        let length = self.file.metadata()?.len();
        let mut reader = BufReader::new(&self.file);
        let mut magic = Vec::new();
        reader
            .by_ref()
            .take(MAGIC.len() as u64)
            .read_to_end(&mut magic)?;
        if !MAGIC.starts_with(&magic) {
            return Err(io::Error::other(
                "it exists and is not the journal of an unfinished table",
            ));
        }
        let mut end = magic.len() as u64;
        while let Some((number, bytes)) = record(&mut reader, length - end)? {
            // A damaged first header is all there is to know; of a later one, as of a piece, those
            // before it are left.
            self.unreadable = number == HEADER && self.header.is_none();
            let Some(bytes) = bytes else { break };
            let start = end + PREFIX as u64;
            end = start + bytes.len() as u64;
            if number == HEADER {
                let Ok(header) = toml::from_slice(&bytes) else {
                    break;
                };
                (self.header, self.unreadable) = (Some(header), false);
                self.pieces.clear();
            } else if self.header.is_some() {
                self.pieces
                    .insert(number as usize, (start, bytes.len() as u64));
            } else {
                break;
            }
            self.end = end;
        }
        Ok(())
    }

    /// What the finished pieces belong to, if anything was begun.
    pub fn header(&self) -> Option<&Header> {
        self.header.as_ref()
    }

    /// Whether there is a header that says nothing: it is damaged, or another version's.
    pub fn is_unreadable(&self) -> bool {
        self.unreadable
    }

    /// Drops what is no piece of a sweep with so many pieces of so many values.
    pub fn keep(&mut self, pieces: usize, values: usize) {
        self.pieces
            .retain(|&piece, &mut (_, length)| piece < pieces && length == 8 * values as u64);
    }

    /// How many pieces are finished.
    pub fn finished(&self) -> usize {
        self.pieces.len()
    }

    /// Drops what there is and begins anew.
    ///
    /// # Errors
    /// [`Error::Write`] naming the journal.
    pub fn begin(&mut self, header: Header) -> Result<(), Error> {
        let emptied = self.file.set_len(0).and_then(|()| {
            self.file.seek(SeekFrom::Start(0))?;
            self.file.write_all(&MAGIC)?;
            // Without this a loss of power may take the file's name.
            output::sync_folder(&self.path)
        });
        self.named(emptied)?;
        self.end = MAGIC.len() as u64;
        self.go_on(header)
    }

    /// Goes on with another header, to which no piece belongs yet. Until it is written, those
    /// before it stay.
    ///
    /// # Errors
    /// [`Error::Write`] naming the journal.
    pub fn go_on(&mut self, header: Header) -> Result<(), Error> {
        let appended = toml::to_string(&header)
            .map_err(io::Error::other)
            .and_then(|text| self.append(HEADER, text.as_bytes()));
        self.named(appended)?;
        (self.header, self.unreadable) = (Some(header), false);
        self.pieces.clear();
        Ok(())
    }

    /// Adds a finished piece. If that fails, for want of room on the disk for instance, those
    /// before it are safe.
    ///
    /// # Errors
    /// [`Error::Write`] naming the journal.
    pub fn add(&mut self, piece: usize, values: &[f64]) -> Result<(), Error> {
        let bytes: Vec<u8> = values
            .iter()
            .flat_map(|value| value.to_le_bytes())
            .collect();
        let start = self.end + PREFIX as u64;
        let added = self.append(piece as u64, &bytes);
        self.named(added)?;
        self.pieces.insert(piece, (start, bytes.len() as u64));
        Ok(())
    }

    /// Whether a piece is finished.
    pub fn holds(&self, piece: usize) -> bool {
        self.pieces.contains_key(&piece)
    }

    /// The `count` values of a finished piece.
    ///
    /// # Errors
    /// [`Error::Write`] naming the journal if it does not hold them.
    pub fn values(&mut self, piece: usize, count: usize) -> Result<Vec<f64>, Error> {
        let mut bytes = vec![0; 8 * count];
        let read = match self.pieces.get(&piece) {
            Some(&(start, length)) if length == bytes.len() as u64 => self
                .file
                .seek(SeekFrom::Start(start))
                .and_then(|_| self.file.read_exact(&mut bytes)),
            _ => Err(io::Error::other(format!(
                "it does not hold the {count} values of piece {piece}"
            ))),
        };
        self.named(read)?;
        Ok(bytes
            .as_chunks()
            .0
            .iter()
            .map(|bytes| f64::from_le_bytes(*bytes))
            .collect())
    }

    /// Removes the journal: the table is complete, or never will be.
    ///
    /// # Errors
    /// [`Error::Write`] naming the journal.
    pub fn remove(self) -> Result<(), Error> {
        self.named(fs::remove_file(&self.path))
    }

    fn append(&mut self, number: u64, bytes: &[u8]) -> io::Result<()> {
        self.file.seek(SeekFrom::Start(self.end))?;
        let mut record = Vec::with_capacity(PREFIX + bytes.len());
        record.extend(number.to_le_bytes());
        record.extend((bytes.len() as u64).to_le_bytes());
        record.extend(crc32fast::hash(bytes).to_le_bytes());
        record.extend(bytes);
        self.file.write_all(&record)?;
        self.file.sync_data()?;
        self.end += record.len() as u64;
        Ok(())
    }

    fn named<T>(&self, outcome: io::Result<T>) -> Result<T, Error> {
        outcome.map_err(|source| Error::Write {
            path: self.path.clone(),
            source,
        })
    }
}

/// The number of the next whole record of at most `room` bytes, if there is one, and its bytes if
/// they are undamaged.
fn record(reader: &mut impl Read, room: u64) -> io::Result<Option<(u64, Option<Vec<u8>>)>> {
    let mut prefix = [0; PREFIX];
    if room < PREFIX as u64 {
        return Ok(None);
    }
    reader.read_exact(&mut prefix)?;
    let word = |at: usize| u64::from_le_bytes(std::array::from_fn(|i| prefix[at + i]));
    let (number, length) = (word(0), word(8));
    let stored = u32::from_le_bytes(std::array::from_fn(|i| prefix[16 + i]));
    // A loss of power may leave zeros at the end of a file: they are no empty records.
    if length == 0 || length > room - PREFIX as u64 {
        return Ok(None);
    }
    let mut bytes = vec![0; length as usize];
    reader.read_exact(&mut bytes)?;
    let undamaged = crc32fast::hash(&bytes) == stored;
    Ok(Some((number, undamaged.then_some(bytes))))
}

/// A file name with one more ending.
pub(crate) fn beside(path: &Path, ending: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(".");
    name.push(ending);
    name.into()
}

/// Whether an open file is still the one at the path.
#[cfg(unix)]
fn is_same(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let identity = |data: io::Result<fs::Metadata>| data.map(|data| (data.dev(), data.ino())).ok();
    identity(file.metadata()).is_some_and(|open| Some(open) == identity(fs::metadata(path)))
}

/// Elsewhere an open file cannot be removed.
#[cfg(not(unix))]
fn is_same(_: &File, _: &Path) -> bool {
    true
}
