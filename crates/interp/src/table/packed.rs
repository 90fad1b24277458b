//! The packed table: one self-describing binary file that loads fast and loses nothing.
//!
//! ```text
//! offset  size  content (little-endian)
//! 0       8     magic, "COATTBL\n"
//! 8       4     format version, u32
//! 12      8     length of the payload, u64
//! 20      4     CRC-32 of the payload
//! 24      -     payload: header (bincode, fixed-width integers), then the content
//! ```
//!
//! The content of a dense table is its values as f64, quantity by quantity. The content of a
//! low-rank table is a list of its tiles: their nodes, the order of the cores, the numbers of their
//! polynomials, the weights and the step (bincode, integers of variable width), and the integers of
//! the cores in the code of `low_rank`. The header holds the lengths of the pieces of a
//! curve, which the first lookup would otherwise have to choose.
//!
//! A forged length cannot allocate much memory. The length of the header is limited. The number of
//! values must match the number of bytes. An integer of a core has 8 bytes in memory, and a byte of
//! the file holds at most six. serde reads a list, and reserves at most a megabyte before it has
//! read the numbers. What the first lookup may need follows from the size of the form (`demand`).

use std::fmt::Display;
use std::fs;
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::table::stored_tiles::CodedTile;
#[cfg(feature = "embedded")]
use crate::table::stored_tiles::StoredTiles;
use crate::{Description, Error, Parameter, Quantity, Table};

/// The first bytes of a packed table.
const MAGIC: [u8; 8] = *b"COATTBL\n";
/// The first bytes of an HDF5 file.
const HDF5_SIGNATURE: [u8; 8] = *b"\x89HDF\r\n\x1a\n";
/// The only version of the packed form that is written and read.
const VERSION: u32 = 4;
/// The number of bytes before the payload.
const PREFIX: usize = 24;
/// The largest header, many times that of any real table.
const HEADER_LIMIT: usize = 1 << 20;

/// The part of the payload before the content.
#[derive(Serialize, Deserialize)]
struct Header {
    description: Description,
    axes: [(Parameter, Vec<f64>); 4],
    quantities: Vec<Quantity>,
    form: Form,
    /// The binary logarithm of the number of pieces in each octave of `a/t`.
    pieces: Vec<u32>,
}

/// The form of the content.
#[derive(Serialize, Deserialize)]
enum Form {
    Dense,
    LowRank,
}

/// The bincode configuration of the header.
fn configuration() -> impl bincode::config::Config {
    bincode::config::standard()
        .with_little_endian()
        .with_fixed_int_encoding()
        .with_limit::<HEADER_LIMIT>()
}

/// The bincode configuration of the content of a low-rank table.
fn content_configuration() -> impl bincode::config::Config {
    bincode::config::standard()
}

/// Returns whether the bytes begin like a packed table of any version.
pub fn is_packed(bytes: &[u8]) -> bool {
    bytes.starts_with(&MAGIC)
}

impl Table {
    /// Reads a packed table from a file. An HDF5 table is read by `Table::open` (feature `hdf5`).
    ///
    /// # Errors
    /// [`Error::Io`] if the file cannot be read; [`Error::InFile`] with the path and one of the errors
    /// of [`Table::from_packed`].
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        let bytes = fs::read(path).map_err(|source| Error::Io {
            path: path.to_owned(),
            source,
        })?;
        Self::from_packed(&bytes).map_err(|error| error.in_file(path))
    }

    /// Returns the packed form, from which [`Table::from_packed`] restores this table bit for bit.
    ///
    /// # Errors
    /// [`Error::Malformed`] if title, scene and axes exceed a megabyte.
    pub fn to_packed(&self) -> Result<Vec<u8>, Error> {
        let form = if self.low_rank().is_some() {
            Form::LowRank
        } else {
            Form::Dense
        };
        let header = Header {
            description: self.description().clone(),
            axes: self.axes(),
            quantities: self.quantities(),
            form,
            pieces: self.pieces().to_vec(),
        };
        let mut payload =
            bincode::serde::encode_to_vec(&header, configuration()).map_err(malformed)?;
        if payload.len() > HEADER_LIMIT {
            return Err(Error::Malformed(format!(
                "its header has {} bytes, at most {HEADER_LIMIT} are allowed",
                payload.len()
            )));
        }
        if matches!(header.form, Form::Dense) {
            for quantity in header.quantities {
                let values = self.values(quantity).into_iter().flatten();
                payload.extend(values.flat_map(|value| value.to_le_bytes()));
            }
        }
        if let Some(tiles) = self.low_rank() {
            let tiles: Vec<CodedTile> = tiles.iter().map(CodedTile::new).collect();
            payload.extend(
                bincode::serde::encode_to_vec(&tiles, content_configuration())
                    .map_err(malformed)?,
            );
        }
        let mut bytes = Vec::with_capacity(PREFIX + payload.len());
        bytes.extend(MAGIC);
        bytes.extend(VERSION.to_le_bytes());
        bytes.extend((payload.len() as u64).to_le_bytes());
        bytes.extend(crc32fast::hash(&payload).to_le_bytes());
        bytes.extend(payload);
        Ok(bytes)
    }

    /// Reads a packed table from bytes, for instance from those of `include_bytes!`.
    ///
    /// # Errors
    /// [`Error::Foreign`] for bytes of an HDF5 table or of anything else; [`Error::Version`] for
    /// another version; [`Error::Length`] for missing or trailing bytes; [`Error::Checksum`] for
    /// changed bytes; [`Error::Malformed`] for a forged content; [`Error::LowRankTooLarge`] for a
    /// form whose first lookup would need too much.
    ///
    /// Whatever the bytes, reading takes at most 52 bytes of memory for each of them and 1.1 MB.
    /// The first lookup takes at most 850 and 37 MB in a low-rank table, 50 and 27 MB in a dense
    /// one (measured at their worst by `tests/hostile/packed.rs`). [`Table::from_low_rank`] states
    /// the work.
    pub fn from_packed(bytes: &[u8]) -> Result<Self, Error> {
        let (header, content) = split(bytes)?;
        match header.form {
            Form::Dense => dense(header, content),
            Form::LowRank => low_rank(header, content),
        }
    }

    /// Reads a packed table in low-rank form from bytes that [`Table::from_packed`] accepts, and
    /// decodes each tile at the first lookup in it.
    ///
    /// # Errors
    /// Those of [`Table::from_packed`], except for errors in the code of the integers, which are a
    /// panic at the first lookup.
    #[cfg(feature = "embedded")]
    pub(crate) fn from_sound_code(bytes: &[u8]) -> Result<Self, Error> {
        let (header, content) = split(bytes)?;
        let tiles = StoredTiles::of_code(header.quantities, coded_tiles(content)?);
        Self::of_tiles(header.description, header.axes, tiles)?.with_pieces(header.pieces)
    }
}

/// Splits a packed table into its header and its content.
fn split(bytes: &[u8]) -> Result<(Header, &[u8]), Error> {
    if !is_packed(bytes) {
        let what = if bytes.starts_with(&HDF5_SIGNATURE) {
            "it begins like an HDF5 table; read it as HDF5, or pack it"
        } else {
            "it does not begin like a packed table"
        };
        return Err(Error::Foreign(what.into()));
    }
    let Some((prefix, payload)) = bytes.split_at_checked(PREFIX) else {
        return Err(Error::Length {
            expected: PREFIX as u64,
            found: bytes.len() as u64,
        });
    };
    let word = |at: usize| {
        u32::from_le_bytes([prefix[at], prefix[at + 1], prefix[at + 2], prefix[at + 3]])
    };
    let version = word(8);
    if version != VERSION {
        return Err(Error::Version {
            found: version,
            supported: VERSION,
        });
    }
    let length = u64::from(word(12)) | u64::from(word(16)) << 32;
    if length != payload.len() as u64 {
        return Err(Error::Length {
            expected: length,
            found: payload.len() as u64,
        });
    }
    let (stored, found) = (word(20), crc32fast::hash(payload));
    if stored != found {
        return Err(Error::Checksum { stored, found });
    }

    let limited = &payload[..payload.len().min(HEADER_LIMIT)];
    let (header, used): (Header, usize) =
        bincode::serde::decode_from_slice(limited, configuration()).map_err(malformed)?;
    Ok((header, &payload[used..]))
}

/// An error of bincode inside a packed table.
fn malformed(error: impl Display) -> Error {
    Error::Malformed(error.to_string())
}

/// Reads the content of a dense table.
fn dense(header: Header, content: &[u8]) -> Result<Table, Error> {
    let count = header
        .axes
        .iter()
        .try_fold(8_usize, |bytes, (_, nodes)| bytes.checked_mul(nodes.len()));
    let expected = count.and_then(|count| count.checked_mul(header.quantities.len()));
    if expected != Some(content.len()) || !header.quantities.is_sorted_by(|a, b| a < b) {
        return Err(Error::Malformed(format!(
            "it has {} bytes of values for {:?} at its nodes, which must be ascending and need {}",
            content.len(),
            header.quantities,
            expected.map_or("more than fit in memory".into(), |bytes| bytes.to_string())
        )));
    }
    let mut quantities = [const { None }; 4];
    // Without nodes there are no bytes to split, and `Table::new` names the empty axis.
    for (quantity, bytes) in header
        .quantities
        .iter()
        .zip(content.chunks_exact(count.unwrap_or(0).max(1)))
    {
        let numbers = bytes
            .as_chunks()
            .0
            .iter()
            .map(|bytes| f64::from_le_bytes(*bytes));
        quantities[*quantity as usize] = Some(numbers.collect());
    }
    Table::new(header.description, header.axes, quantities)?.with_pieces(header.pieces)
}

/// Reads the content of a low-rank table.
fn low_rank(header: Header, content: &[u8]) -> Result<Table, Error> {
    let tiles = coded_tiles(content)?.into_iter();
    let tiles = tiles.map(|tile| tile.decode(&header.quantities));
    let tiles = tiles.collect::<Result<_, _>>()?;
    Table::from_low_rank(header.description, header.axes, header.quantities, tiles)?
        .with_pieces(header.pieces)
}

/// Reads the tiles of a low-rank table.
fn coded_tiles(content: &[u8]) -> Result<Vec<CodedTile>, Error> {
    let (tiles, used) =
        bincode::serde::decode_from_slice(content, content_configuration()).map_err(malformed)?;
    if used != content.len() {
        return Err(Error::Malformed(format!(
            "its low-rank form has {used} bytes, but its content has {}",
            content.len()
        )));
    }
    Ok(tiles)
}
