//! The bytes of an HDF5 file for the crate `hdf5-pure`, of which it may read a limited number.
//!
//! A forged file may refer to the same bytes again and again, and so make a reader allocate without
//! end. What `hdf5-pure` holds of the structure of a file it has read from here. The limit on what
//! it reads therefore bounds its memory and its time.

use std::fs::File;
use std::sync::atomic::{AtomicU64, Ordering};

use hdf5_pure::{FormatError, ReadSeekSource, Source};

/// The largest number of bytes that may be read for the structure of a file: attributes, axes and
/// chunks by name, without their numbers. `tables/paper.h5` needs 47 kB, and 70,000 chunks of
/// values, 18 GB, need all.
const MOST_BYTES: u64 = 1 << 22;
/// The number of bytes for which a shorter read counts.
const LEAST_BYTES: u64 = 32;

/// The structure of an HDF5 file.
pub(crate) struct Structure {
    source: ReadSeekSource<File>,
    left: AtomicU64,
}

impl Structure {
    /// Makes the source of the structure of `file`.
    ///
    /// # Errors
    /// That of a file which has no length.
    pub(crate) fn new(file: File) -> Result<Self, FormatError> {
        Ok(Self {
            source: ReadSeekSource::new(file)?,
            left: AtomicU64::new(MOST_BYTES),
        })
    }

    /// Accepts a read of `length` bytes, before memory is reserved for it.
    fn spend(&self, length: usize) -> Result<(), FormatError> {
        let length = (length as u64).max(LEAST_BYTES);
        let spend = |left: u64| left.checked_sub(length);
        match self
            .left
            .fetch_update(Ordering::Relaxed, Ordering::Relaxed, spend)
        {
            Ok(_) => Ok(()),
            Err(_) => Err(FormatError::Source(format!(
                "its attributes and its lists of chunks have more than {MOST_BYTES} bytes"
            ))),
        }
    }
}

impl Source for Structure {
    fn len(&self) -> u64 {
        self.source.len()
    }

    fn read_at(&self, offset: u64, buffer: &mut [u8]) -> Result<(), FormatError> {
        self.spend(buffer.len())?;
        self.source.read_at(offset, buffer)
    }

    fn read_exact_at(&self, offset: u64, length: usize) -> Result<Vec<u8>, FormatError> {
        self.spend(length)?;
        self.source.read_exact_at(offset, length)
    }
}
