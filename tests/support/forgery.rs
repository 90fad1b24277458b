//! Forged files of tables: their lengths and checksums are right, so that readers look at what is within.

use rand::RngExt;
use rand_pcg::Pcg64Mcg;

/// Replaces the payload of the packed table that begins with `packed`, with its length and checksum.
pub fn with_payload(packed: &[u8], payload: &[u8]) -> Vec<u8> {
    [
        &packed[..12],
        &(payload.len() as u64).to_le_bytes(),
        &crc32fast::hash(payload).to_le_bytes(),
        payload,
    ]
    .concat()
}

/// Changes bytes from a place on: a bit, by one, to a number of one to eight bytes, or to a copy of others.
pub fn change(bytes: &mut [u8], at: usize, random: &mut Pcg64Mcg) {
    let length = bytes.len();
    let width = [1, 2, 4, 8][random.random_range(0..4)].min(length - at);
    let number = match random.random_range(0..9) {
        0 => 0,
        1 => u64::MAX,
        2 => 1 << random.random_range(0..64),
        3 => length as u64,
        4 => random.random_range(0..2 * length as u64),
        5 => u64::from(bytes[at]) ^ 1 << random.random_range(0..8),
        6 => u64::from(bytes[at])
            .wrapping_add(random.random_range(0..3))
            .wrapping_sub(1),
        7 => random.random(),
        _ => {
            let from = random.random_range(0..=length - width);
            bytes.copy_within(from..from + width, at);
            return;
        }
    };
    bytes[at..at + width].copy_from_slice(&number.to_le_bytes()[..width]);
}

/// A part of an HDF5 file with a checksum of its structure.
#[derive(Clone, Copy, Debug)]
pub struct Checked {
    /// The part of the file, without the checksum if that follows.
    pub from: usize,
    /// Its end.
    pub to: usize,
    /// The place of the checksum. Within the part it counts as four zeros.
    pub checksum: usize,
}

impl Checked {
    /// Finds the parts of a sound file that have checksums. The checksums of raw data are others.
    pub fn all(bytes: &[u8]) -> Vec<Self> {
        const FOLLOWED: [&[u8]; 10] = [
            b"\x89HDF", b"OHDR", b"OCHK", b"FRHP", b"FHIB", b"BTHD", b"BTLF", b"BTIN", b"EAHD",
            b"EAIB",
        ];
        let starts = |signature: &'static [u8]| {
            let places = bytes.windows(4).enumerate();
            places.filter_map(move |(at, found)| (found == signature).then_some(at))
        };
        let is_sound = |checked: &Self| {
            checked.checksum + 4 <= bytes.len()
                && bytes[checked.checksum..][..4] == checked.of(bytes).to_le_bytes()
        };
        let followed = FOLLOWED.into_iter().flat_map(starts).filter_map(|from| {
            let ends = (from + 8)..(from + 4096).min(bytes.len().saturating_sub(3));
            let of = |to| Self {
                from,
                to,
                checksum: to,
            };
            ends.map(of).find(is_sound)
        });
        // A direct block of a fractal heap has its checksum in its header.
        let blocks = starts(b"FHDB").filter_map(|from| {
            let sizes = (9..17).map(|bits| from + (1 << bits));
            let of = |to| {
                (13..24).map(move |at| Self {
                    from,
                    to,
                    checksum: from + at,
                })
            };
            sizes
                .filter(|&to| to <= bytes.len())
                .flat_map(of)
                .find(is_sound)
        });
        followed.chain(blocks).collect()
    }

    /// Computes the checksum of this part.
    fn of(&self, bytes: &[u8]) -> u32 {
        let mut part = bytes[self.from..self.to].to_vec();
        if self.checksum < self.to {
            part[self.checksum - self.from..][..4].fill(0);
        }
        lookup3(&part)
    }

    /// Stores the right checksum.
    pub fn repair(&self, bytes: &mut [u8]) {
        let checksum = self.of(bytes).to_le_bytes();
        bytes[self.checksum..][..4].copy_from_slice(&checksum);
    }
}

/// Computes B. Jenkins' checksum `lookup3`, that of the structures of HDF5.
fn lookup3(bytes: &[u8]) -> u32 {
    let start = 0xdead_beef_u32.wrapping_add(bytes.len() as u32);
    // The numbers change in turn, each by the one before it.
    let mut sums = [start; 3];
    let blocks = bytes.chunks(12).enumerate();
    for (number, block) in blocks {
        let is_last = 12 * number + block.len() == bytes.len();
        let mut padded = [0; 12];
        padded[..block.len()].copy_from_slice(block);
        for (sum, word) in sums.iter_mut().zip(padded.chunks_exact(4)) {
            *sum = sum.wrapping_add(u32::from_le_bytes(std::array::from_fn(|k| word[k])));
        }
        if is_last {
            for (i, turn) in [14, 11, 25, 16, 4, 14, 24].into_iter().enumerate() {
                let [own, before] = [(i + 2) % 3, (i + 1) % 3];
                sums[own] = (sums[own] ^ sums[before]).wrapping_sub(sums[before].rotate_left(turn));
            }
        } else {
            for (i, turn) in [4, 6, 8, 16, 19, 4].into_iter().enumerate() {
                let [own, next, before] = [i % 3, (i + 1) % 3, (i + 2) % 3];
                sums[own] = sums[own].wrapping_sub(sums[before]) ^ sums[before].rotate_left(turn);
                sums[before] = sums[before].wrapping_add(sums[next]);
            }
        }
    }
    sums[2]
}
