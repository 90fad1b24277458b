//! Damaged files, for tests of everything that reads a file.
//!
//! The environment variable `HOSTILE_CASES` sets the number of cases of each test.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// The number of cases of a test where the environment does not set it.
const CASES: usize = 2000;

/// Calls a function with many damaged copies of sound bytes, with their numbers. `words`,
/// between `|`, are inserted here and there.
pub fn each_damaged(sound: &[u8], words: &str, seed: u64, mut read: impl FnMut(usize, &[u8])) {
    let cases =
        std::env::var("HOSTILE_CASES").map_or(CASES, |text| text.parse().expect("a number"));
    let words: Vec<&str> = words.split('|').collect();
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    for case in 0..cases {
        let mut bytes = sound.to_vec();
        for _ in 0..random.random_range(1..4) {
            damage(&mut bytes, &words, &mut random);
        }
        read(case, &bytes);
    }
}

fn damage(bytes: &mut Vec<u8>, words: &[&str], random: &mut Pcg64Mcg) {
    let at = random.random_range(0..bytes.len() + 1);
    let end = (at + random.random_range(0..30)).min(bytes.len());
    match random.random_range(0..7) {
        0 => bytes.truncate(at),
        1 => drop(bytes.drain(at..end)),
        2 => {
            let piece = bytes[at..end].to_vec();
            let to = random.random_range(0..bytes.len() + 1);
            bytes.splice(to..to, piece);
        }
        3 | 4 => {
            let word = words[random.random_range(0..words.len())];
            bytes.splice(at..end.min(at + random.random_range(0..9)), word.bytes());
        }
        5 if at < bytes.len() => bytes[at] ^= 1 << random.random_range(0..8),
        _ if at < bytes.len() => bytes[at] = random.random_range(0..=255),
        _ => {}
    }
}
