//! The transforms of the fields of a sticking contact, `p_n` and `q_n` of `coulomb.rs`, at many
//! arguments, and the sums of their products.
//!
//! One pass over the arguments keeps the `g_n` of all modes and sums the products with the first two
//! of them, up to twice the number of modes: `lattice.rs` makes the matrix of them.

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch, f64x8};

use crate::stick::coulomb::{Coulomb, Functions, LANES};

/// The factors of the products, at all arguments.
#[derive(Clone, Copy, Debug)]
pub struct Factors<'a> {
    /// Of two normal, a normal and a tangential, and two tangential transforms.
    pub products: [&'a [f64]; 3],
    /// For `eps = 0`, two factors each of a single even and of a single odd `g_n`.
    pub single: [[&'a [f64]; 2]; 2],
}

/// The transforms at many arguments, and their products with the first two.
#[derive(Clone, Debug)]
pub struct Transforms {
    /// For every group of arguments, `g_n` of all orders below the number of modes, first of
    /// `eta = -eps` and then, unless it is the same, of `eta = eps`.
    functions: Vec<[f64; LANES]>,
    /// The sums of products: for every order, those of `lattice.rs`.
    pub sums: Vec<Sums>,
}

/// The sums of one order. For `eps = 0`, the products with the first two functions, then those with
/// [`Factors::single`]; else the products with the first two of both signs of `eta`.
pub type Sums = [f64; 8];

/// `M` factors of each of `N` functions, of even and of odd order.
type Beside<S, const N: usize, const M: usize> = [[[f64x8<S>; M]; N]; 2];

/// The number of groups of arguments whose products are summed at once, so that sums are seldom
/// loaded and stored.
const AT_ONCE: usize = 4;

impl Transforms {
    /// Returns the transforms at positive, ascending arguments `z`, a multiple of [`LANES`], and
    /// the sums of their products.
    pub fn new(coulomb: &Coulomb, z: &[f64], factors: &Factors<'_>) -> Self {
        let signs = if coulomb.eps == 0.0 { 1 } else { 2 };
        let mut transforms = Self {
            functions: Vec::with_capacity(signs * coulomb.modes * z.len() / LANES),
            sums: Vec::new(),
        };
        dispatch!(Level::new(), simd => if coulomb.eps == 0.0 {
            transforms.fill(simd, coulomb, z, factors, beside_uncoupled);
        } else {
            transforms.fill(simd, coulomb, z, factors, beside_coupled);
        });
        transforms
    }

    /// Returns `sum c_n p_n` and `sum c_n q_n` at all arguments.
    pub fn fields(&self, coulomb: &Coulomb, c: &[f64]) -> [Vec<f64>; 2] {
        let factors: Vec<f64> = c.iter().zip(&coulomb.scale).map(|(c, s)| c * s).collect();
        let mut fields = [Vec::new(), Vec::new()];
        dispatch!(Level::new(), simd => if coulomb.eps == 0.0 {
            add_up::<_, 1>(simd, &self.functions, &factors, &mut fields);
        } else {
            add_up::<_, 2>(simd, &self.functions, &factors, &mut fields);
        });
        fields
    }

    #[inline(always)]
    fn fill<S: Simd, const N: usize, const M: usize>(
        &mut self,
        simd: S,
        coulomb: &Coulomb,
        arguments: &[f64],
        factors: &Factors<'_>,
        beside: impl Fn(S, &Factors<'_>, usize, [Functions<S, N>; 2]) -> Beside<S, N, M>,
    ) {
        let zero = f64x8::splat(simd, 0.0);
        let orders = 2 * coulomb.modes;
        let mut sums = vec![zero; M * N * orders];
        let sums = sums.as_chunks_mut::<M>().0.as_chunks_mut::<N>().0;
        let mut g = vec![zero; N * AT_ONCE * orders];
        let g = g.as_chunks_mut::<N>().0.as_chunks_mut::<AT_ONCE>().0;
        let mut of_groups = [[[[zero; M]; N]; 2]; AT_ONCE];
        for (i, arguments) in arguments.chunks(AT_ONCE * LANES).enumerate() {
            let groups = arguments.as_chunks::<LANES>().0;
            // Places without a group add nothing.
            of_groups[groups.len()..].fill([[[zero; M]; N]; 2]);
            for (j, z) in groups.iter().enumerate() {
                coulomb.functions(simd, z, g, j);
                of_groups[j] = beside(simd, factors, (i * AT_ONCE + j) * LANES, [g[0][j], g[1][j]]);
                for i in 0..N {
                    let values = g[..coulomb.modes]
                        .iter()
                        .map(|g| <[f64; LANES]>::from(g[j][i]));
                    self.functions.extend(values);
                }
            }
            for (n, (sums, g)) in sums.iter_mut().zip(&*g).enumerate() {
                for (k, sums) in sums.iter_mut().enumerate() {
                    let mut sum = *sums;
                    for (g, beside) in g.iter().zip(&of_groups) {
                        for (sum, beside) in sum.iter_mut().zip(&beside[n % 2][k]) {
                            *sum = g[k].mul_add(*beside, *sum);
                        }
                    }
                    *sums = sum;
                }
            }
        }
        let reduce = |sums: &[[f64x8<S>; M]; N]| -> Sums {
            let mut reduced = [0.0; 8];
            for (reduced, lanes) in reduced.iter_mut().zip(sums.as_flattened()) {
                *reduced = lanes.iter().sum();
            }
            reduced
        };
        self.sums = sums.iter().map(reduce).collect();
    }
}

/// Returns the factors of even and odd functions for `eps = 0`, where an even one is normal and an
/// odd one is tangential.
#[inline(always)]
fn beside_uncoupled<S: Simd>(
    simd: S,
    factors: &Factors<'_>,
    at: usize,
    [[even], [odd]]: [Functions<S, 1>; 2],
) -> Beside<S, 1, 5> {
    let load = |values: &[f64]| f64x8::from_slice(simd, &values[at..][..LANES]);
    let [normal, mixed, shear] = factors.products.map(load);
    let [of_even, of_odd] = factors.single.map(|pair| pair.map(load));
    [
        [[
            even * normal,
            odd * mixed,
            even * shear,
            of_even[0],
            of_even[1],
        ]],
        [[
            even * mixed,
            odd * normal,
            odd * shear,
            of_odd[0],
            of_odd[1],
        ]],
    ]
}

/// Returns the factors of the functions of both signs of `eta`.
#[inline(always)]
fn beside_coupled<S: Simd>(
    simd: S,
    factors: &Factors<'_>,
    at: usize,
    [zeroth, first]: [Functions<S, 2>; 2],
) -> Beside<S, 2, 4> {
    let load = |values: &[f64]| f64x8::from_slice(simd, &values[at..][..LANES]);
    let [normal, mixed, shear] = factors.products.map(load);
    let (sum, unlike) = (normal + shear, normal - shear);
    let like = [mixed.mul_add(2.0, sum), mixed.mul_add(-2.0, sum)];
    let of = |own: usize| {
        let other = 1 - own;
        [
            zeroth[own] * like[own],
            first[own] * like[own],
            zeroth[other] * unlike,
            first[other] * unlike,
        ]
    };
    [[of(0), of(1)]; 2]
}

/// Extends the `fields` by the sums of `p_n` and `q_n`, with the `factors` of their `functions`.
#[inline(always)]
fn add_up<S: Simd, const N: usize>(
    simd: S,
    functions: &[[f64; LANES]],
    factors: &[f64],
    [p, q]: &mut [Vec<f64>; 2],
) {
    let zero = f64x8::splat(simd, 0.0);
    for group in functions.chunks_exact(N * factors.len()) {
        let mut sums = [[zero; 2]; N];
        for (sums, functions) in sums.iter_mut().zip(group.chunks_exact(factors.len())) {
            let pairs = functions
                .as_chunks::<2>()
                .0
                .iter()
                .zip(factors.as_chunks::<2>().0);
            for (values, factors) in pairs {
                for i in 0..2 {
                    sums[i] = f64x8::simd_from(simd, values[i]).mul_add(factors[i], sums[i]);
                }
            }
        }
        // For `eps = 0` both signs of `eta` are one function.
        let ([even, odd], [even_of_minus, odd_of_minus]) = (sums[0], sums[N - 1]);
        let (plus, minus) = (even + odd, even_of_minus - odd_of_minus);
        p.extend_from_slice((plus + minus).as_slice());
        q.extend_from_slice((plus - minus).as_slice());
    }
}
