//! The packed table: one self-describing binary file, quick to load, from which nothing is lost.
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
//! The content of a dense table is its values as f64, quantity after quantity; that of a low-rank
//! one the weights, the functions, and the steps and integers of its cores (bincode, integers of
//! variable width: one byte for most).
//!
//! Nothing is allocated on the word of the file: the header is limited, the values' number must
//! match the bytes there are, and an integer of a core, 8 bytes in memory, has a byte of its own.
//! (A list is read by serde, which reserves a megabyte at most before it has seen the numbers.)

use std::fmt::Display;
use std::fs;
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::Parameter;
use crate::{Description, Error, LowRank, Quantity, Table};

const MAGIC: [u8; 8] = *b"COATTBL\n";
/// The one version of the packed form that is written and read.
const VERSION: u32 = 1;
const PREFIX: usize = 24;
/// Axes, scene and description fit many times over.
const HEADER_LIMIT: usize = 1 << 20;

#[derive(Serialize, Deserialize)]
struct Header {
    description: Description,
    axes: [Vec<f64>; 4],
    quantities: Vec<Quantity>,
    form: Form,
}

#[derive(Serialize, Deserialize)]
enum Form {
    Dense,
    LowRank,
}

/// The content of a low-rank table.
#[derive(Serialize, Deserialize)]
struct Content {
    weights: [Vec<f64>; 3],
    functions: [Vec<f64>; 4],
    steps: [f64; 4],
    cores: [Vec<i64>; 4],
}

fn configuration() -> impl bincode::config::Config {
    bincode::config::standard()
        .with_little_endian()
        .with_fixed_int_encoding()
        .with_limit::<HEADER_LIMIT>()
}

fn content_configuration() -> impl bincode::config::Config {
    bincode::config::standard()
}

/// True if the bytes begin like a packed table of any version.
pub fn is_packed(bytes: &[u8]) -> bool {
    bytes.starts_with(&MAGIC)
}

impl Table {
    /// Reads a packed table from a file.
    ///
    /// # Errors
    /// [`Error::Io`], and those of [`Table::from_packed`].
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        Self::from_packed(&fs::read(path).map_err(|source| Error::Io {
            path: path.to_owned(),
            source,
        })?)
    }

    /// The packed form, which [`Table::from_packed`] turns back into the same table, bit for bit.
    ///
    /// # Errors
    /// [`Error::Malformed`] if title, scene and axes exceed a megabyte; those of [`Table::expand`].
    pub fn to_packed(&self) -> Result<Vec<u8>, Error> {
        let axes = Parameter::ALL.map(|parameter| self.axis(parameter).to_vec());
        let form = if self.low_rank().is_some() {
            Form::LowRank
        } else {
            Form::Dense
        };
        let header = Header {
            description: self.description().clone(),
            axes,
            quantities: self.quantities(),
            form,
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
            let dense = self.expand()?;
            for quantity in header.quantities {
                let values = dense.values(quantity).into_iter().flatten();
                payload.extend(values.flat_map(|value| value.to_le_bytes()));
            }
        }
        if let Some(form) = self.low_rank() {
            let (steps, cores) = form.rounded();
            let content = Content {
                weights: form.weights().clone(),
                functions: form.functions().clone(),
                steps,
                cores,
            };
            payload.extend(
                bincode::serde::encode_to_vec(&content, content_configuration())
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

    /// Reads a packed table from bytes, `include_bytes!` for instance.
    ///
    /// # Errors
    /// [`Error::Foreign`] without the magic bytes, [`Error::Version`] for another version,
    /// [`Error::Length`] for missing or trailing bytes, [`Error::Checksum`] for changed ones,
    /// [`Error::Malformed`] for a forged content.
    pub fn from_packed(bytes: &[u8]) -> Result<Self, Error> {
        if !is_packed(bytes) {
            return Err(Error::Foreign(
                "it does not begin with the magic bytes of a packed table".into(),
            ));
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
        let content = &payload[used..];
        match header.form {
            Form::Dense => dense(header, content),
            Form::LowRank => low_rank(header, content),
        }
    }
}

fn malformed(error: impl Display) -> Error {
    Error::Malformed(error.to_string())
}

fn dense(header: Header, content: &[u8]) -> Result<Table, Error> {
    let count = header
        .axes
        .iter()
        .try_fold(8_usize, |bytes, nodes| bytes.checked_mul(nodes.len()));
    let expected = count.and_then(|count| count.checked_mul(header.quantities.len()));
    if expected != Some(content.len()) || !header.quantities.is_sorted_by(|a, b| a < b) {
        return Err(Error::Malformed(format!(
            "{} bytes of values for {:?}",
            content.len(),
            header.quantities
        )));
    }
    let mut quantities = [const { None }; 4];
    // Without nodes there is nothing to split; `Table::new` then names the empty axis.
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
    Table::new(header.description, header.axes, quantities)
}

fn low_rank(header: Header, content: &[u8]) -> Result<Table, Error> {
    let (
        Content {
            weights,
            functions,
            steps,
            cores,
        },
        used,
    ) = bincode::serde::decode_from_slice(content, content_configuration()).map_err(malformed)?;
    if used != content.len() {
        return Err(Error::Malformed(format!(
            "a low-rank form of {used} bytes in {}",
            content.len()
        )));
    }
    let form = LowRank::new(
        header.quantities,
        weights,
        functions,
        steps,
        cores.each_ref().map(Vec::as_slice),
    )?;
    Table::from_low_rank(header.description, header.axes, form)
}
