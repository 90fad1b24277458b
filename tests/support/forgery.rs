//! Forged packed tables: their length and checksum are right, so that readers look at the payload.

/// Computes the CRC-32 of zip and PNG, bit by bit.
pub fn checksum(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0_u32, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| {
            if crc & 1 == 1 {
                crc >> 1 ^ 0xedb8_8320
            } else {
                crc >> 1
            }
        })
    })
}

/// Replaces the payload of the packed table `packed`, with its length and checksum.
pub fn with_payload(packed: &[u8], payload: &[u8]) -> Vec<u8> {
    [
        &packed[..12],
        &(payload.len() as u64).to_le_bytes(),
        &checksum(payload).to_le_bytes(),
        payload,
    ]
    .concat()
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
    let [mut a, mut b, mut c] = [start; 3];
    let mut rest = bytes;
    loop {
        let mut block = [0; 12];
        let count = rest.len().min(12);
        block[..count].copy_from_slice(&rest[..count]);
        let word = |i: usize| u32::from_le_bytes(std::array::from_fn(|k| block[4 * i + k]));
        if count == 0 {
            return c;
        }
        a = a.wrapping_add(word(0));
        b = b.wrapping_add(word(1));
        c = c.wrapping_add(word(2));
        if rest.len() <= 12 {
            break;
        }
        rest = &rest[12..];
        a = a.wrapping_sub(c) ^ c.rotate_left(4);
        c = c.wrapping_add(b);
        b = b.wrapping_sub(a) ^ a.rotate_left(6);
        a = a.wrapping_add(c);
        c = c.wrapping_sub(b) ^ b.rotate_left(8);
        b = b.wrapping_add(a);
        a = a.wrapping_sub(c) ^ c.rotate_left(16);
        c = c.wrapping_add(b);
        b = b.wrapping_sub(a) ^ a.rotate_left(19);
        a = a.wrapping_add(c);
        c = c.wrapping_sub(b) ^ b.rotate_left(4);
        b = b.wrapping_add(a);
    }
    c = (c ^ b).wrapping_sub(b.rotate_left(14));
    a = (a ^ c).wrapping_sub(c.rotate_left(11));
    b = (b ^ a).wrapping_sub(a.rotate_left(25));
    c = (c ^ b).wrapping_sub(b.rotate_left(16));
    a = (a ^ c).wrapping_sub(c.rotate_left(4));
    b = (b ^ a).wrapping_sub(a.rotate_left(14));
    (c ^ b).wrapping_sub(b.rotate_left(24))
}
