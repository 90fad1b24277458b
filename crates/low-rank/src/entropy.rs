//! The coding of the integers of a train in few bits: an adaptive binary range coder
//! (G. N. N. Martin, *Range encoding*, 1979; in the form of P. Deutsch's and I. Pavlov's LZMA).
//!
//! An integer is written as the length of its absolute value in bits, one binary decision for each
//! bit, then the bits after the leading one, and the sign. The probabilities of the decisions adapt
//! to those before. They depend on a *context*: the sizes of the neighbours before, along the bond
//! before, the degree of the polynomial, and the next bond.
//!
//! Reading is linear in the number of integers, of which a byte holds at most [`MOST_IN_A_BYTE`].

use crate::Malformed;

/// The largest number of integers for each byte. It limits what a forged file can claim. Where
/// fewer bytes would do, zeros follow.
pub(crate) const MOST_IN_A_BYTE: usize = 6;
/// The longest integer, in bits: 2^53 has 54.
const MOST_BITS: usize = 54;
/// The number of contexts: two bits after the leading one of a sum of sizes below 2^30.
const CONTEXTS: usize = 4 * 30;
/// The largest size of a neighbour that counts.
const LARGEST_NEIGHBOUR: u64 = 1 << 26;
/// The range below which a byte is written or read.
const SMALL: u32 = 1 << 24;

/// Two estimates of the probability that a decision is "no", in units of 2^-16. One follows the
/// last decisions fast, the other slowly. Their mean is used.
#[derive(Clone, Copy)]
struct Probability([u16; 2]);

impl Probability {
    /// The binary logarithms of the number of decisions that each estimate remembers.
    const RATES: [u32; 2] = [4, 7];

    fn mean(self) -> u32 {
        let [fast, slow] = self.0.map(u32::from);
        (fast + slow) / 2
    }

    fn update(&mut self, decision: bool) {
        for (estimate, rate) in self.0.iter_mut().zip(Self::RATES) {
            if decision {
                *estimate -= *estimate >> rate;
            } else {
                *estimate += (u16::MAX - *estimate) >> rate;
            }
        }
    }
}

const EVEN: Probability = Probability([1 << 15; 2]);

/// One end of the channel: it writes decisions, or finds those that were written.
trait Coder {
    /// Codes a decision with an adaptive probability. A reader ignores `decision`; both return it.
    fn adaptive(&mut self, probability: &mut Probability, decision: bool) -> bool;
    /// Codes a decision of even chances.
    fn even(&mut self, decision: bool) -> bool;
}

/// Writes decisions.
struct Encoder {
    bytes: Vec<u8>,
    low: u64,
    range: u32,
    /// The last byte that may still change by a carry, and the number of bytes of 255 after it.
    pending: Option<u8>,
    full: usize,
}

impl Encoder {
    fn new() -> Self {
        Self {
            bytes: Vec::new(),
            low: 0,
            range: u32::MAX,
            pending: None,
            full: 0,
        }
    }

    fn narrow(&mut self, bound: u32, decision: bool) {
        if decision {
            self.low += u64::from(bound);
            self.range -= bound;
        } else {
            self.range = bound;
        }
        while self.range < SMALL {
            self.range <<= 8;
            self.shift();
        }
    }

    /// Moves the highest byte of `low` to the output, when no carry can reach it any more.
    fn shift(&mut self) {
        let (carry, byte) = ((self.low >> 32) as u8, (self.low >> 24) as u8);
        if carry == 1 || byte != 0xff {
            if let Some(pending) = self.pending {
                self.bytes.push(pending.wrapping_add(carry));
            }
            let full = 0xff_u8.wrapping_add(carry);
            self.bytes.extend(std::iter::repeat_n(full, self.full));
            (self.pending, self.full) = (Some(byte), 0);
        } else {
            self.full += 1;
        }
        self.low = (self.low & 0x00ff_ffff) << 8;
    }

    fn finish(mut self) -> Vec<u8> {
        (0..5).for_each(|_| self.shift());
        self.bytes
    }
}

impl Coder for Encoder {
    fn adaptive(&mut self, probability: &mut Probability, decision: bool) -> bool {
        self.narrow((self.range >> 16) * probability.mean(), decision);
        probability.update(decision);
        decision
    }

    fn even(&mut self, decision: bool) -> bool {
        self.narrow(self.range >> 1, decision);
        decision
    }
}

/// Reads decisions.
struct Decoder<'a> {
    bytes: &'a [u8],
    /// The number of bytes read, which may exceed those that there are.
    at: usize,
    code: u32,
    range: u32,
}

impl<'a> Decoder<'a> {
    fn new(bytes: &'a [u8]) -> Self {
        let mut decoder = Self {
            bytes,
            at: 0,
            code: 0,
            range: u32::MAX,
        };
        (0..4).for_each(|_| decoder.shift());
        decoder
    }

    fn shift(&mut self) {
        let byte = self.bytes.get(self.at).copied().unwrap_or(0);
        self.code = self.code << 8 | u32::from(byte);
        self.at += 1;
    }

    fn narrow(&mut self, bound: u32) -> bool {
        let decision = self.code >= bound;
        if decision {
            self.code -= bound;
            self.range -= bound;
        } else {
            self.range = bound;
        }
        while self.range < SMALL {
            self.range <<= 8;
            self.shift();
        }
        decision
    }
}

impl Coder for Decoder<'_> {
    fn adaptive(&mut self, probability: &mut Probability, _: bool) -> bool {
        let decision = self.narrow((self.range >> 16) * probability.mean());
        probability.update(decision);
        decision
    }

    fn even(&mut self, _: bool) -> bool {
        self.narrow(self.range >> 1)
    }
}

/// The probabilities of all decisions.
struct Model {
    /// Whether an integer is longer than so many bits, in each context.
    longer: Vec<[Probability; MOST_BITS]>,
    /// The two bits after the leading one, for each length: the first, and the second after either.
    next: [[Probability; 3]; MOST_BITS + 1],
}

impl Model {
    fn new() -> Self {
        Self {
            longer: vec![[EVEN; MOST_BITS]; CONTEXTS],
            next: [[EVEN; 3]; MOST_BITS + 1],
        }
    }

    /// Writes an integer, or reads the one that was written.
    fn integer(&mut self, coder: &mut impl Coder, context: usize, integer: i64) -> i64 {
        let size = integer.unsigned_abs();
        let length = (u64::BITS - size.leading_zeros()) as usize;
        let longer = &mut self.longer[context];
        let mut bits = 0;
        while bits < MOST_BITS && coder.adaptive(&mut longer[bits], length > bits) {
            bits += 1;
        }
        if bits == 0 {
            return 0;
        }
        let next = &mut self.next[bits];
        let mut found = 1_u64;
        for place in (0..bits - 1).rev() {
            let bit = size >> place & 1 == 1;
            let bit = match bits - 2 - place {
                0 => coder.adaptive(&mut next[0], bit),
                1 => coder.adaptive(&mut next[1 + (found & 1) as usize], bit),
                _ => coder.even(bit),
            };
            found = found << 1 | u64::from(bit);
        }
        let found = found as i64;
        if coder.even(integer < 0) {
            -found
        } else {
            found
        }
    }

    /// Writes the integers of a core with `shape`, or reads those that were written: row-major over
    /// the bond before, the degree, and the next bond.
    fn core(&mut self, coder: &mut impl Coder, [_, terms, after]: [usize; 3], core: &mut [i64]) {
        for i in 0..core.len() {
            let (b, k, a) = (i % after, i / after % terms, i / (after * terms));
            let size = |back: usize| core[i - back].unsigned_abs().min(LARGEST_NEIGHBOUR);
            // The nearest neighbours count twice, and along the degree so does the next.
            let mut sum = 0;
            for (place, stride, far) in [(b, 1, 1), (k, after, 2), (a, after * terms, 1)] {
                if place > 0 {
                    sum += 2 * size(stride);
                }
                if place > 1 {
                    sum += far * size(2 * stride);
                }
            }
            core[i] = self.integer(coder, context(sum), core[i]);
        }
    }
}

/// Returns the context of a sum of sizes: its length in bits and the two bits after the leading
/// one.
fn context(sum: u64) -> usize {
    let sum = sum + 2;
    let length = sum.ilog2() as usize;
    4 * (length - 1) + ((sum << 2 >> length) & 3) as usize
}

/// Writes the integers of cores: row-major over the three numbers of each shape.
pub(crate) fn encode(shapes: [[usize; 3]; 4], cores: &[Vec<i64>; 4]) -> Vec<u8> {
    let (mut encoder, mut model) = (Encoder::new(), Model::new());
    for (shape, core) in shapes.into_iter().zip(cores) {
        model.core(&mut encoder, shape, &mut core.clone());
    }
    let mut bytes = encoder.finish();
    let least = cores
        .iter()
        .map(Vec::len)
        .sum::<usize>()
        .div_ceil(MOST_IN_A_BYTE);
    bytes.resize(bytes.len().max(least), 0);
    bytes
}

/// Reads the integers of cores that [`encode`] wrote.
///
/// # Errors
/// [`Malformed`] if the cores have more integers than the bytes can hold, or if bytes follow them
/// that [`encode`] does not write.
pub(crate) fn decode(shapes: [[usize; 3]; 4], bytes: &[u8]) -> Result<[Vec<i64>; 4], Malformed> {
    let counts = shapes.map(|shape| {
        let product = shape.into_iter().try_fold(1_usize, usize::checked_mul);
        product.unwrap_or(usize::MAX)
    });
    let all = counts.into_iter().fold(0, usize::saturating_add);
    let most = bytes.len().saturating_mul(MOST_IN_A_BYTE);
    if all > most {
        return Err(Malformed(format!(
            "its cores of the shapes {shapes:?} have {all} integers: {} bytes hold {most} at most",
            bytes.len()
        )));
    }
    let (mut decoder, mut model) = (Decoder::new(bytes), Model::new());
    let cores = std::array::from_fn(|i| {
        let mut core = vec![0; counts[i]];
        model.core(&mut decoder, shapes[i], &mut core);
        core
    });
    let expected = decoder.at.max(all.div_ceil(MOST_IN_A_BYTE));
    if expected != bytes.len() || bytes[decoder.at..].iter().any(|&byte| byte != 0) {
        return Err(Malformed(format!(
            "the integers of its cores take {expected} bytes, but there are {}, or the last ones are \
             not zeros",
            bytes.len()
        )));
    }
    Ok(cores)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns pseudorandom numbers from a fixed seed (xorshift).
    fn random() -> impl FnMut() -> u64 {
        let mut state = 0x9e37_79b9_7f4a_7c15_u64;
        move || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            state
        }
    }

    #[test]
    fn what_is_read_is_what_was_written() {
        let mut next = random();
        let shapes = [[1, 7, 5], [5, 1, 9], [9, 30, 4], [4, 2, 1]];
        for bits in 0..=53 {
            let mut core = |shape: [usize; 3]| -> Vec<i64> {
                let mut integer = |_| {
                    let size =
                        (next() & ((1 << bits) - 1)) as i64 + (1 << bits) * (next() & 1) as i64;
                    let size = size.min(1 << 53) >> (next() % (bits + 1));
                    if next() & 1 == 0 { size } else { -size }
                };
                (0..shape.iter().product()).map(&mut integer).collect()
            };
            let cores = shapes.map(&mut core);
            let bytes = encode(shapes, &cores);
            assert_eq!(
                decode(shapes, &bytes).expect("as written"),
                cores,
                "{bits} bits"
            );
            for wrong in [&bytes[..bytes.len() - 1], &[&bytes[..], &[0]].concat()] {
                assert!(matches!(decode(shapes, wrong), Err(Malformed(_))));
            }
        }
    }

    /// The entropy of integers of a known distribution is what no coder can go below.
    #[test]
    fn integers_take_little_more_than_their_entropy() {
        let mut next = random();
        // The absolute value is `n` with the probability 2^-(n+1); the sign is one more bit.
        let shape = [1, 1, 100_000];
        let core: Vec<i64> = (0..shape[2])
            .map(|_| {
                let size = i64::from(next().trailing_zeros());
                if next() & 1 == 0 { size } else { -size }
            })
            .collect();
        let entropy = (2.0 + 0.5) * core.len() as f64;
        let empty = [1, 1, 1];
        let bytes = encode(
            [shape, empty, empty, empty],
            &[core, vec![0], vec![0], vec![0]],
        );
        let bits = 8.0 * bytes.len() as f64;
        println!("{:.3} of the entropy", bits / entropy);
        assert!(bits > entropy && bits < 1.05 * entropy);
    }

    #[test]
    fn more_integers_than_the_bytes_can_hold_are_refused_before_memory_is_taken() {
        let one = [1, 1, 1];
        for shape in [[1, 1, 100], [1 << 20, 1 << 20, 1 << 20], [usize::MAX, 2, 1]] {
            let result = decode([shape, one, one, one], &[0; 10]);
            assert!(matches!(result, Err(Malformed(_))), "{result:?}");
        }
        // Zeros take next to no bits.
        let zeros = [vec![0; 6000], vec![0], vec![0], vec![0]];
        let shapes = [[1, 1, 6000], one, one, one];
        let bytes = encode(shapes, &zeros);
        assert_eq!(bytes.len(), 6003_usize.div_ceil(MOST_IN_A_BYTE));
        assert_eq!(decode(shapes, &bytes).expect("as written"), zeros);
        let last = [&bytes[..bytes.len() - 1], &[1]].concat();
        assert!(matches!(decode(shapes, &last), Err(Malformed(_))));
    }
}
