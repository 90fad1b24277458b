//! The finished pieces of a generation, in a file beside its output, so that an interrupted one can
//! go on.
//!
//! ```text
//! magic, "COATJRN\n"
//! records: number (u64), length (u64), CRC-32 (u32) of the bytes, bytes
//! ```
//!
//! All integers are little-endian. A [`Header`], as TOML, is followed by the pieces of its sweep,
//! with their numbers, as f64. A refined plan has a header of its own, and the pieces before that
//! header are void. A torn record at the end, of a process that was killed, is dropped. The file is
//! locked while the generation runs, and removed when the table is complete.
//!
//! Whatever kills the process, the pieces that were added stay. A loss of power costs those since
//! the last flush to the disk, [`LOST`] bytes at most.
//!
//! Every failure is an [`Error::Write`] with the path of the journal.

use std::collections::HashMap;
use std::fs::{self, File, Metadata, OpenOptions, TryLockError};
use std::io::{self, BufReader, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::table::plan::Plan;
use crate::{Error, output};

const MAGIC: [u8; 8] = *b"COATJRN\n";
/// The bytes of number, length and checksum.
const PREFIX: usize = 20;
/// The largest number of bytes of pieces that are not flushed to the disk: those of 32,000 contacts
/// with four quantities, a second of solves. A flush of every piece takes longer than small pieces.
const LOST: u64 = 1 << 20;
/// What to do with something else in the place of a journal.
const ELSEWHERE: &str = "move it, or write the table elsewhere";
/// The number of the header's record, which no piece has.
const HEADER: u64 = u64::MAX;

/// The generation that the finished pieces belong to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Header {
    /// Program and version.
    pub created_by: String,
    /// The build of the program and the processor's features, on which the last digits depend.
    pub build: String,
    /// The scene's text.
    pub scene: String,
    /// The tolerance of the table.
    pub tolerance: f64,
    /// The number of points of the certificate. A refined plan depends on them.
    pub certificate_points: usize,
    /// The bits of the seed of these points. TOML has no unsigned integers.
    pub seed: i64,
    /// The number of times the plan was refined.
    pub round: usize,
    /// The nodes.
    pub plan: Plan,
}

/// The finished pieces of a generation. Dropping the journal leaves the file for another
/// generation.
pub struct Journal {
    path: PathBuf,
    file: File,
    header: Option<Header>,
    /// Whether there is a header that is damaged or of another version.
    unreadable: bool,
    /// The offset and the number of the bytes of each finished piece.
    pieces: HashMap<usize, (u64, u64)>,
    /// The end of the last whole record.
    end: u64,
    /// The number of bytes that are flushed to the disk.
    flushed: u64,
}

impl Journal {
    /// Returns the path of the journal of a table.
    pub fn path(table: &Path) -> PathBuf {
        let mut name = table.as_os_str().to_owned();
        name.push(".unfinished");
        name.into()
    }

    /// Opens the journal of a table and locks it.
    ///
    /// # Errors
    /// [`Error::Busy`] if another process has locked it; [`Error::Write`] with its path if it
    /// cannot be made, or is no journal.
    pub fn open(table: &Path) -> Result<Self, Error> {
        let path = Self::path(table);
        let write = |source| Error::Write {
            path: path.clone(),
            source,
        };
        // Reading a pipe may block, and what a link leads to is not ours.
        let is_other = |data: Metadata| !data.is_file();
        loop {
            if fs::symlink_metadata(&path).is_ok_and(is_other) {
                return Err(write(io::Error::other(format!(
                    "it is no file; {ELSEWHERE}"
                ))));
            }
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
            // Its owner may have removed the file between the two steps.
            if output::is_at(&file, &path) {
                let mut journal = Self {
                    path: path.clone(),
                    file,
                    header: None,
                    unreadable: false,
                    pieces: HashMap::new(),
                    end: 0,
                    flushed: 0,
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
            return Err(io::Error::other(format!(
                "it exists and is not the journal of an unfinished table; {ELSEWHERE}"
            )));
        }
        let mut end = magic.len() as u64;
        while let Some((number, bytes)) = record(&mut reader, length - end)? {
            // Behind a damaged first header nothing can be used. A damaged later header, or a
            // damaged piece, leaves the records before it.
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

    /// Returns the generation that the finished pieces belong to, if one was begun.
    pub fn header(&self) -> Option<&Header> {
        self.header.as_ref()
    }

    /// Returns true if there is a header that is damaged or of another version.
    pub fn is_unreadable(&self) -> bool {
        self.unreadable
    }

    /// Drops records that are no pieces of a sweep with `pieces` pieces of `values` values each.
    pub fn keep(&mut self, pieces: usize, values: usize) {
        self.pieces
            .retain(|&piece, &mut (_, length)| piece < pieces && length == 8 * values as u64);
    }

    /// Returns the number of finished pieces.
    pub fn finished(&self) -> usize {
        self.pieces.len()
    }

    /// Drops all records and begins anew.
    pub fn begin(&mut self, header: Header) -> Result<(), Error> {
        let emptied = self.file.set_len(0).and_then(|()| {
            self.file.seek(SeekFrom::Start(0))?;
            self.file.write_all(&MAGIC)?;
            // Without this, the file's name may not survive a loss of power.
            output::sync_folder(&self.path)
        });
        self.named(emptied)?;
        self.end = MAGIC.len() as u64;
        self.flushed = 0;
        self.go_on(header)
    }

    /// Goes on with another header, to which no piece belongs yet. Until it is written, the pieces
    /// of the last header stay.
    pub fn go_on(&mut self, header: Header) -> Result<(), Error> {
        let appended = toml::to_string(&header)
            .map_err(io::Error::other)
            .and_then(|text| self.append(HEADER, text.as_bytes()))
            .and_then(|()| self.flush());
        self.named(appended)?;
        (self.header, self.unreadable) = (Some(header), false);
        self.pieces.clear();
        Ok(())
    }

    /// Adds a finished piece. If that fails, because the disk is full for instance, the pieces
    /// before it are safe.
    pub fn add(&mut self, piece: usize, values: &[f64]) -> Result<(), Error> {
        let bytes: Vec<[u8; 8]> = values.iter().map(|value| value.to_le_bytes()).collect();
        let bytes = bytes.into_flattened();
        let start = self.end + PREFIX as u64;
        let mut added = self.append(piece as u64, &bytes);
        if added.is_ok() && self.end - self.flushed > LOST {
            added = self.flush();
        }
        self.named(added)?;
        self.pieces.insert(piece, (start, bytes.len() as u64));
        Ok(())
    }

    /// Returns true if a piece is finished.
    pub fn holds(&self, piece: usize) -> bool {
        self.pieces.contains_key(&piece)
    }

    /// Reads the `count` values of a finished piece.
    ///
    /// # Errors
    /// [`Error::Write`] with the path of the journal if it does not hold them.
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

    /// Removes the journal, when the table is complete or nothing is finished. Another program may have removed it.
    pub fn remove(self) -> Result<(), Error> {
        match fs::remove_file(&self.path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
            removed => self.named(removed),
        }
    }

    fn append(&mut self, number: u64, bytes: &[u8]) -> io::Result<()> {
        self.file.seek(SeekFrom::Start(self.end))?;
        let mut record = Vec::with_capacity(PREFIX + bytes.len());
        record.extend(number.to_le_bytes());
        record.extend((bytes.len() as u64).to_le_bytes());
        record.extend(crc32fast::hash(bytes).to_le_bytes());
        record.extend(bytes);
        self.file.write_all(&record)?;
        self.end += record.len() as u64;
        Ok(())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.sync_data()?;
        self.flushed = self.end;
        Ok(())
    }

    fn named<T>(&self, outcome: io::Result<T>) -> Result<T, Error> {
        outcome.map_err(|source| Error::Write {
            path: self.path.clone(),
            source,
        })
    }
}

/// Reads the next record of at most `room` bytes. Returns its number, and its bytes if they are
/// undamaged; none if there is no whole record.
fn record(reader: &mut impl Read, room: u64) -> io::Result<Option<(u64, Option<Vec<u8>>)>> {
    let mut prefix = [0; PREFIX];
    if room < PREFIX as u64 {
        return Ok(None);
    }
    reader.read_exact(&mut prefix)?;
    let word = |at: usize| u64::from_le_bytes(std::array::from_fn(|i| prefix[at + i]));
    let (number, length) = (word(0), word(8));
    let stored = u32::from_le_bytes(std::array::from_fn(|i| prefix[16 + i]));
    // A loss of power may leave zeros at the end of a file. They are no empty records.
    if length == 0 || length > room - PREFIX as u64 {
        return Ok(None);
    }
    let mut bytes = vec![0; length as usize];
    reader.read_exact(&mut bytes)?;
    let undamaged = crc32fast::hash(&bytes) == stored;
    Ok(Some((number, undamaged.then_some(bytes))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hostile::each_damaged;
    use crate::table::scene::Scene;

    #[test]
    fn pieces_are_flushed_by_their_bytes() {
        const PIECES: usize = 10_000;
        let folder = tempfile::tempdir().expect("a temporary folder");
        let table = folder.path().join("table.h5");
        for values in [4, 400, 400_000] {
            let mut journal = Journal::open(&table).expect("a new journal");
            journal.begin(header()).expect("written");
            let piece = vec![1.0; values];
            let count = PIECES.min(4_000_000 / values);
            let (mut flushes, mut flushed) = (0, journal.flushed);
            assert_eq!(flushed, journal.end);
            for number in 0..count {
                journal.add(number, &piece).expect("written");
                assert!(journal.end - journal.flushed <= LOST);
                flushes += usize::from(journal.flushed > flushed);
                flushed = journal.flushed;
            }
            let bytes = (count * (8 * values + PREFIX)) as u64;
            assert!(
                flushes as u64 <= bytes / LOST,
                "{flushes} of {count} pieces"
            );
            assert_eq!(journal.finished(), count);
            journal.remove().expect("removed");
        }
    }

    /// Any bytes give an error, or pieces that are there. The records of every second case have
    /// sound checksums.
    #[test]
    fn a_damaged_journal_is_read_or_refused() {
        const WORDS: &str = "\0\0\0\0\0\0\0\0|COATJRN\n|nodes = [1, |nodes = [9223372036854775807, |\
             evenness = [-1.0, |round = 7|\n";
        let folder = tempfile::tempdir().expect("a temporary folder");
        let table = folder.path().join("table.h5");
        let mut journal = Journal::open(&table).expect("a new journal");
        journal.begin(header()).expect("written");
        for piece in 0..3 {
            journal.add(piece, &[1.0, 2.0]).expect("written");
        }
        let path = Journal::path(&table);
        let sound = fs::read(&path).expect("there");
        let text = toml::to_string(&header()).expect("TOML");
        drop(journal);
        let scene = scene();
        let (mut refused, mut fits, mut held) = (0, 0, 0);
        let mut read = |bytes: &[u8]| {
            // Some file systems wait for the disk where a file is written over.
            let _ = fs::remove_file(&path);
            fs::write(&path, bytes).expect("written");
            let Ok(mut journal) = Journal::open(&table) else {
                refused += 1;
                return;
            };
            if let Some(header) = journal.header() {
                fits += usize::from(header.plan.fits(&scene));
            }
            assert!(journal.finished() * (PREFIX + 1) <= bytes.len());
            journal.keep(3, 2);
            for piece in 0..4 {
                let values = journal.values(piece, 2);
                assert_eq!(values.is_ok(), journal.holds(piece));
                held += usize::from(values.is_ok_and(|values| values == [1.0, 2.0]));
            }
        };
        each_damaged(&sound, WORDS, 1, |_, bytes| read(bytes));
        let start = MAGIC.len() + PREFIX + text.len();
        each_damaged(text.as_bytes(), WORDS, 2, |_, header| {
            let mut bytes = [&MAGIC[..], &HEADER.to_le_bytes()].concat();
            bytes.extend((header.len() as u64).to_le_bytes());
            bytes.extend(crc32fast::hash(header).to_le_bytes());
            bytes.extend(header);
            bytes.extend(&sound[start..]);
            read(&bytes);
        });
        println!("{refused} refused, {fits} plans fit, {held} pieces held");
        assert!(fits > 0 && held > 0);
    }

    fn scene() -> Scene {
        Scene::parse(
            "title = 'x'\na_over_t = { from = 1, to = 2, nodes = 3 }\ne1_over_e2 = 1\nnu1 = 0.5\n\
             e0_over_e2 = inf\nquantities = ['pi0', 'eeq']\n",
            None,
        )
        .expect("a sound scene")
    }

    fn header() -> Header {
        let scene = scene();
        Header {
            created_by: String::new(),
            build: String::new(),
            tolerance: scene.tolerance,
            certificate_points: 1,
            seed: 1,
            round: 0,
            plan: Plan::new(&scene).expect("stated nodes"),
            scene: scene.text,
        }
    }
}
