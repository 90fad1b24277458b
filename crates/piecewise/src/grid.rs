//! The pieces of a range of `x`, found by the bits of `x`.
//!
//! Let `y` be `x` times a constant factor. Every octave of `y` is cut into `2^bits` pieces of equal
//! length, with `bits` chosen for each octave. The exponent of `y` and the first `bits` of its
//! mantissa are then the number of the piece. The rest of the mantissa is the position on the
//! piece. Neither a logarithm nor a search is needed.

/// The number of bits of the mantissa of an f64.
const MANTISSA_BITS: u32 = 52;
/// The mask of these bits.
const MANTISSA: u64 = (1 << MANTISSA_BITS) - 1;
/// The bits of `1.0`.
const ONE: u64 = 1.0_f64.to_bits();

/// The pieces of a range of `x`.
///
/// An `x` outside the range has no position: its functions panic, or return that of another `x`.
#[derive(Clone, Debug)]
pub struct Grid {
    range: [f64; 2],
    /// The factor `y/x`, with which `y` begins between 1 and 2.
    ///
    /// It is chosen such that the range covers as much as possible of the first and the last piece:
    /// a polynomial on a piece that extends far out of the range has large coefficients, and large
    /// rounding.
    factor: f64,
    /// The octaves of `y`: from 1 to 2, from 2 to 4, ...
    octaves: Vec<Octave>,
    /// The number of pieces of the range.
    count: usize,
}

/// The pieces of an octave.
#[derive(Clone, Copy, Debug)]
struct Octave {
    /// The binary logarithm of the number of pieces.
    bits: u32,
    /// The number of the first piece.
    first: usize,
}

/// A position on a piece.
#[derive(Clone, Copy, Debug)]
pub struct Position {
    /// The number of the piece.
    pub piece: usize,
    /// The position on the piece, from -1 to 1.
    pub t: f64,
}

impl Grid {
    /// Returns the largest number of octaves that a range may need; it need not cover the whole of
    /// the first and the last.
    pub fn most_octaves([from, to]: [f64; 2]) -> usize {
        (to / from).log2() as usize + 2
    }

    /// Cuts a range of `x`, between 1e-30 and 1e30, into `2^bits[i]` pieces in octave `i`. The last
    /// octave of `bits` may not be needed.
    ///
    /// # Panics
    /// If `bits` has fewer octaves than the range, as may happen below [`Grid::most_octaves`].
    pub fn over([from, to]: [f64; 2], bits: &[u32]) -> Self {
        const STEPS: i32 = 16;
        let length = |octave: usize| 0.5_f64.powi(bits[octave] as i32);
        // The first piece begins `before` times its length before the range. A factor with which
        // the range would end within rounding of the end of a piece is not chosen.
        let candidates = (1..STEPS).map(|step| {
            let before = f64::from(step) / f64::from(STEPS);
            let factor = (1.0 + before * length(0)) / from;
            let (last, mantissa) = split(to * factor);
            let covered = (mantissa - 1.0) / length(last) % 1.0;
            (
                if covered > 0.99 {
                    0.0
                } else {
                    covered.min(1.0 - before)
                },
                factor,
            )
        });
        let best = candidates.reduce(|best, other| if other.0 > best.0 { other } else { best });
        let (_, factor) = best.expect("there are candidates");
        let mut first = 0;
        let octaves = bits[..=split(to * factor).0].iter().map(|&bits| {
            let octave = Octave { bits, first };
            first += 1 << bits;
            octave
        });
        let mut grid = Self {
            range: [from, to],
            factor,
            octaves: octaves.collect(),
            count: 0,
        };
        grid.count = grid.pieces().count();
        grid
    }

    /// Returns the number of pieces.
    #[inline]
    pub const fn count(&self) -> usize {
        self.count
    }

    /// Returns the range of `x`.
    #[inline]
    pub const fn range(&self) -> [f64; 2] {
        self.range
    }

    /// Returns the factor `y/x`, with which `y` begins between 1 and 2.
    #[inline]
    pub const fn factor(&self) -> f64 {
        self.factor
    }

    /// Returns the position of `x`.
    #[inline]
    pub fn locate(&self, x: f64) -> Position {
        let y = x * self.factor;
        let Octave { bits, first } = self.octaves[split(y).0];
        let piece = first + ((y.to_bits() & MANTISSA) >> (MANTISSA_BITS - bits)) as usize;
        let from_1_to_2 = f64::from_bits(((y.to_bits() << bits) & MANTISSA) | ONE);
        Position {
            piece,
            t: 2.0 * from_1_to_2 - 3.0,
        }
    }

    /// Returns `x dt/dx`; NaN if the range is a single point, which does not tell how a function grows.
    #[inline]
    pub fn logarithmic_speed(&self, x: f64) -> f64 {
        if self.range[0] == self.range[1] {
            return f64::NAN;
        }
        let (octave, mantissa) = split(x * self.factor);
        2.0 * mantissa * (1_u64 << self.octaves[octave].bits) as f64
    }

    /// Returns the pieces of the range: their octaves, and their ends in `y`.
    pub fn pieces(&self) -> impl Iterator<Item = (usize, [f64; 2])> + '_ {
        let pieces = self.octaves.iter().enumerate().flat_map(|(i, octave)| {
            let (start, length) = (
                2.0_f64.powi(i as i32),
                2.0_f64.powi(i as i32 - octave.bits as i32),
            );
            (0..1_u64 << octave.bits)
                .map(move |piece| (i, [piece, piece + 1].map(|end| start + length * end as f64)))
        });
        let last = self.range[1] * self.factor;
        pieces.take_while(move |(_, [start, _])| *start <= last)
    }
}

/// Splits `y`, which must be 1 or larger, into its octave and its mantissa from 1 to 2.
#[inline]
fn split(y: f64) -> (usize, f64) {
    let bits = y.to_bits();
    (
        (bits >> MANTISSA_BITS).wrapping_sub(ONE >> MANTISSA_BITS) as usize,
        f64::from_bits(bits & MANTISSA | ONE),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_x_is_on_its_piece() {
        let cases: [([f64; 2], &[u32]); 5] = [
            ([1e-3, 1e3], &[0, 1, 2, 3, 4]),
            ([0.7, 0.71], &[7, 7]),
            ([1e-30, 1e30], &[3, 0]),
            ([1.0, 2.0], &[4, 2, 3]),
            ([3.0, 3.0], &[0, 0]),
        ];
        for (range, bits) in cases {
            let bits: Vec<u32> = (0..Grid::most_octaves(range))
                .map(|octave| bits[octave % bits.len()])
                .collect();
            let grid = Grid::over(range, &bits);
            let pieces: Vec<[f64; 2]> = grid.pieces().map(|(_, ends)| ends).collect();
            let [first, last] = [pieces[0], pieces[pieces.len() - 1]];
            // A piece much longer than the first one cannot be covered better by moving that.
            if range[0] < range[1]
                && grid.octaves[0].bits <= grid.octaves[grid.octaves.len() - 1].bits
            {
                assert!((first[1] - range[0] * grid.factor) / (first[1] - first[0]) > 0.25);
                assert!((range[1] * grid.factor - last[0]) / (last[1] - last[0]) > 0.25);
            }
            for i in 0..=1000 {
                let x = (range[0] * (range[1] / range[0]).powf(f64::from(i) / 1000.0))
                    .clamp(range[0], range[1]);
                let Position { piece, t } = grid.locate(x);
                assert!(
                    piece < pieces.len() && (-1.0..1.0).contains(&t),
                    "{x}: piece {piece} of {}, t = {t}",
                    pieces.len()
                );
                let [from, to] = pieces[piece];
                let y = x * grid.factor;
                assert!((from..to).contains(&y), "{y} in {from} .. {to}");
                let back = from.midpoint(to) + 0.5 * (to - from) * t;
                assert!((back / y - 1.0).abs() < 1e-15, "{x}: {back}");
                let speed = grid.logarithmic_speed(x);
                let is_right = (speed * (to - from) / (2.0 * y) - 1.0).abs() < 1e-15;
                assert!(is_right || range[0] == range[1] && speed.is_nan(), "{x}");
            }
        }
    }
}
