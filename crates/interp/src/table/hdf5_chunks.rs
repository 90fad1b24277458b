//! Reads the numbers of a dataset of an HDF5 table, in the one layout in which they are written.
//!
//! They are in chunks of a fixed shape, listed in a version-1 B-tree. A chunk of an axis has a
//! Fletcher checksum; a chunk of values is shuffled, deflated, and then has one. Everything else is
//! refused before it is read, because a reader of every layout that HDF5 knows is many times as
//! long as this one, and its errors are the reader's as well.

use std::io::Read;

use flate2::read::ZlibDecoder;
use hdf5_pure::{ChunkIndex, Dataset, Layout, Source, make_f64_type};

use crate::Error;

/// The numbers of the filters in HDF5.
const DEFLATE: u16 = 1;
const SHUFFLE: u16 = 2;
const FLETCHER32: u16 = 3;

/// The largest size of a chunk. Files are written with 256 kB, or one axis.
const MOST_BYTES_OF_CHUNK: u64 = 1 << 24;
/// The number of bytes that deflate and the checksum may add to a chunk.
const ADDED: u64 = 1 << 10;

/// Reads the f64 of `dataset`, which is called `path` and must have `shape`, from the bytes of its
/// file. The caller has checked that the memory for the shape may be used.
///
/// # Errors
/// [`Error::Malformed`] for another type, shape or layout; for a chunk that is missing or there
/// twice, or has another size or checksum than its own.
pub(crate) fn read(
    dataset: &Dataset,
    bytes: &impl Source,
    path: &str,
    shape: &[u64],
) -> Result<Vec<f64>, Error> {
    let malformed = |what: String| Error::Malformed(format!("{path} {what}"));
    let hdf5 = |error: hdf5_pure::Error| malformed(format!("cannot be read: {error}"));
    if dataset.datatype().map_err(hdf5)? != make_f64_type() {
        return Err(malformed("holds no little-endian f64".into()));
    }
    let filters: Vec<u16> = dataset.filters();
    let deflated = filters == [SHUFFLE, DEFLATE, FLETCHER32];
    let chunk = match dataset.layout().map_err(hdf5)? {
        Layout::Chunked {
            chunk_shape,
            index: ChunkIndex::BTreeV1,
        } if deflated || filters == [FLETCHER32] => chunk_shape,
        _ => {
            return Err(malformed(
                "is not stored as tables are, in chunks listed in a version-1 B-tree, with a Fletcher checksum: another program may \
                 have written the file anew, and then the original file is needed"
                    .into(),
            ));
        }
    };
    let size = chunk
        .iter()
        .try_fold(8_u64, |size, &length| size.checked_mul(length));
    let size = size.filter(|size| (8..=MOST_BYTES_OF_CHUNK).contains(size));
    let fits = chunk.len() == shape.len() && chunk.iter().zip(shape).all(|(a, b)| a <= b);
    let (Some(size), true) = (size, fits) else {
        return Err(malformed(format!(
            "has chunks of the shape {chunk:?}, its own is {shape:?}"
        )));
    };

    let count = shape.iter().zip(&chunk).map(|(a, b)| a.div_ceil(*b));
    let count = usize::try_from(count.product::<u64>()).unwrap_or(usize::MAX);
    let chunks = dataset.chunks().map_err(hdf5)?;
    if chunks.len() != count {
        return Err(malformed(format!(
            "has {} chunks, its shape {shape:?} needs {count}",
            chunks.len()
        )));
    }
    let mut values = vec![f64::NAN; shape.iter().product::<u64>() as usize];
    for stored in chunks {
        let place = &stored.offset;
        // HDF5 leaves out deflate, the second filter, where it does not shrink a chunk.
        let left_out = deflated && stored.filter_mask == 2;
        let sound = (left_out || stored.filter_mask == 0)
            && (stored.storage_size <= size + size / 8 + ADDED)
            && place.len() == shape.len()
            && (0..shape.len()).all(|i| place[i] < shape[i] && place[i] % chunk[i] == 0);
        if !sound {
            return Err(malformed(format!(
                "has a chunk of {} bytes at {place:?}, which is none of its shape",
                stored.storage_size
            )));
        }
        let bytes = bytes
            .read_exact_at(stored.address, stored.storage_size as usize)
            .map_err(|error| malformed(format!("cannot be read: {error}")))?;
        let numbers = decode(bytes, deflated, left_out, size as usize)
            .map_err(|what| malformed(format!("has a chunk at {place:?} that {what}")))?;
        // Two chunks at one place leave another without numbers.
        copy(&numbers, &chunk, place, shape, &mut values);
    }
    Ok(values)
}

/// Undoes the filters of a chunk of `size` bytes: its checksum; deflate, unless it was left out, and
/// the shuffle if it is one of `values`.
///
/// # Errors
/// What is wrong with the chunk.
fn decode(
    mut bytes: Vec<u8>,
    values: bool,
    left_out: bool,
    size: usize,
) -> Result<Vec<f64>, &'static str> {
    let stored = bytes
        .len()
        .checked_sub(4)
        .map(|length| bytes.split_off(length));
    if stored.as_deref() != Some(&fletcher32(&bytes).to_le_bytes()) {
        return Err("has another checksum than is stored");
    }
    if values && !left_out {
        // One byte more would show a chunk that is too long.
        let mut inflated = Vec::with_capacity(size + 1);
        ZlibDecoder::new(&bytes[..])
            .take(size as u64 + 1)
            .read_to_end(&mut inflated)
            .map_err(|_| "is not deflated")?;
        bytes = inflated;
    }
    if bytes.len() != size {
        return Err("is not as long as its shape");
    }
    // Shuffled, the first bytes of all numbers come first.
    let count = size / 8;
    let byte = |i: usize, k: usize| bytes[if values { k * count + i } else { 8 * i + k }];
    let number = |i: usize| f64::from_le_bytes(std::array::from_fn(|k| byte(i, k)));
    Ok((0..count).map(number).collect())
}

/// Copies the numbers of the chunk at `place` that are within `shape` into `values`, row by row.
fn copy(numbers: &[f64], chunk: &[u64], place: &[u64], shape: &[u64], values: &mut [f64]) {
    let last = shape.len() - 1;
    let width = chunk[last].min(shape[last] - place[last]) as usize;
    for (row, numbers) in numbers.chunks_exact(chunk[last] as usize).enumerate() {
        // The indices of the row, from the last but one dimension to the first.
        let (mut rest, mut at, mut stride) = (row as u64, place[last], shape[last]);
        let mut inside = true;
        for i in (0..last).rev() {
            let index = place[i] + rest % chunk[i];
            inside &= index < shape[i];
            at += index * stride;
            rest /= chunk[i];
            stride *= shape[i];
        }
        if !inside {
            continue;
        }
        values[at as usize..][..width].copy_from_slice(&numbers[..width]);
    }
}

/// The checksum of HDF5: Fletcher's of 32 bits, over big-endian words of two bytes.
fn fletcher32(bytes: &[u8]) -> u32 {
    // So many sums of words fit into 32 bits.
    const WORDS: usize = 360;
    let fold = |sum: u32| (sum & 0xffff) + (sum >> 16);
    let (mut first, mut second) = (0_u32, 0_u32);
    for block in bytes.chunks(2 * WORDS) {
        for pair in block.chunks(2) {
            let low = pair.get(1).copied().unwrap_or(0);
            first += u32::from(pair[0]) << 8 | u32::from(low);
            second += first;
        }
        (first, second) = (fold(first), fold(second));
    }
    fold(second) << 16 | fold(first)
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use allocation_counter::measure;
    use flate2::Compression;
    use flate2::write::ZlibEncoder;

    use super::*;

    /// Returns a chunk of values as it is stored.
    fn stored(bytes: &[u8]) -> Vec<u8> {
        let mut encoder = ZlibEncoder::new(Vec::new(), Compression::best());
        encoder.write_all(bytes).expect("in memory");
        let mut stored = encoder.finish().expect("in memory");
        stored.extend(fletcher32(&stored).to_le_bytes());
        stored
    }

    #[test]
    fn a_chunk_that_inflates_to_more_than_its_size_takes_no_more_memory() {
        const SIZE: usize = 800;
        assert_eq!(
            decode(stored(&[0; SIZE]), true, false, SIZE),
            Ok(vec![0.0; SIZE / 8])
        );
        let bomb = stored(&vec![0; 100_000_000]);
        println!("{} bytes", bomb.len());
        let mut result = None;
        let used = measure(|| result = Some(decode(bomb, true, false, SIZE)));
        assert_eq!(result, Some(Err("is not as long as its shape")));
        assert!(used.bytes_max < 100_000, "{} bytes", used.bytes_max);
    }

    #[test]
    fn the_checksum_is_fletchers() {
        let words = |count: u16| -> Vec<u8> { (1..=count).flat_map(u16::to_be_bytes).collect() };
        // Sums of the words, and sums of these sums, modulo 65535.
        for count in [1_u16, 2, 359, 360, 361, 5000] {
            let (mut first, mut second) = (0_u64, 0_u64);
            for word in 1..=u64::from(count) {
                first += word;
                second += first;
            }
            let expected = ((second % 65535) << 16) + first % 65535;
            assert_eq!(u64::from(fletcher32(&words(count))), expected, "{count}");
        }
    }
}
