//! The minors of the solutions that the base of a layer admits, at several wave numbers.

use fearless_simd::prelude::*;

/// The minors `(d, c11, c12, c22, D)` at several wave numbers, or their derivatives.
pub type Minors<S> = [<S as Simd>::f64s; 5];

/// Returns `a + factor b`.
#[inline(always)]
pub fn sum<S: Simd>(mut a: Minors<S>, factor: S::f64s, b: Minors<S>) -> Minors<S> {
    for (a, b) in a.iter_mut().zip(b) {
        *a = factor.mul_add(b, *a);
    }
    a
}

/// Returns `factor a`.
#[inline(always)]
pub fn scaled<S: Simd>(factor: S::f64s, mut a: Minors<S>) -> Minors<S> {
    for a in &mut a {
        *a *= factor;
    }
    a
}
