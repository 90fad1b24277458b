//! Forged packed tables: their length and checksum are right, so that readers look at the payload.

/// The number of bytes before the payload of a packed table.
pub const PREFIX: usize = 24;

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
