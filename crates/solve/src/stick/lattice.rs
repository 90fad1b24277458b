//! The matrix of the products of two transforms, from the products with the first two.
//!
//! Both transforms of a product obey a recurrence with the same `1/z`. Without it, the products
//! `I_mn = int Y g_m g_n dz` of functions `g` of `coulomb.rs` obey one with any factor `Y(z)`,
//!
//! ```text
//! [I_{m-1,n} + I_{m+1,n}]/a_m - eta/(m(m+1)) I_mn = [I_{m,n-1} + I_{m,n+1}]/a_n - eta'/(n(n+1)) I_mn,        a_n = (2n+1) rho_n/rho_{n-1}
//! ```
//!
//! From the rows `m = 0` and 1, up to twice the number of modes, it is run to larger `m <= n`, where
//! it is stable: errors travel like waves and do not grow. (With Legendre polynomials, Hale and
//! Townsend, SIAM J. Sci. Comput. 36, A1207, 2014.) The cost is that of a few rows instead of all.
//!
//! # Wide contacts
//!
//! For `eps = 0` the unit matrix is `(2/pi) int J_m J_n dz`, and the elements of a wide contact with
//! a thin incompressible film nearly cancel it. They do not if the compliance itself is integrated
//! up to the end `Z` of the panels, where it is 1, and the rest is that of the unit matrix, for
//! `m + n` even
//!
//! ```text
//! int_Z^inf j_m j_n dz = Z^2 (j_m j_n' - j_m' j_n)/(m(m+1) - n(n+1))                    m /= n
//! int_Z^inf j_0^2 dz = sin^2 Z/Z + int_2Z^inf sin t/t dt        3 int_Z^inf j_1^2 dz = int_Z^inf j_0^2 dz + Z (j_0^2 + j_1^2)
//! ```

use std::f64::consts::FRAC_2_PI;

use faer::Mat;
use fearless_simd::{Level, dispatch};

use crate::stick::coulomb::{ASYMPTOTIC, Coulomb};
use crate::stick::transforms::Sums;

/// The rows `m = 0` and 1 of products.
type Rows = [Vec<f64>; 2];

/// Returns the lower triangle of the matrix of `p` and `q`, from sums of products. For `eps = 0`,
/// `rest` is added to the products of two normal and of two tangential transforms.
pub fn matrix(coulomb: &Coulomb, sums: &[Sums], rest: Option<Rows>) -> Mat<f64> {
    let modes = coulomb.modes;
    let row = |i: usize| -> Vec<f64> { sums.iter().map(|sums| sums[i]).collect() };
    let scale = &coulomb.scale;
    if coulomb.eps == 0.0 {
        let mut normal = [row(0), row(1)];
        let mut shear = [row(2), row(2)];
        for (m, row) in shear.iter_mut().enumerate() {
            row.iter_mut()
                .skip(1 - m)
                .step_by(2)
                .for_each(|value| *value = 0.0);
        }
        for (m, rest) in rest.iter().flatten().enumerate() {
            for row in [&mut normal[m], &mut shear[m]] {
                row.iter_mut()
                    .zip(rest)
                    .for_each(|(sum, rest)| *sum += rest);
            }
        }
        let mut matrix = products(coulomb, normal, [0.0; 2]);
        let shear = products(coulomb, shear, [0.0; 2]);
        for m in 0..modes {
            for n in m..modes {
                if m % 2 == 1 && n % 2 == 1 {
                    matrix[(n, m)] = shear[(n, m)];
                }
                matrix[(n, m)] *= 4.0 * scale[m] * scale[n];
            }
        }
        return matrix;
    }
    let mut matrix = products(coulomb, [row(0), row(1)], [-1.0; 2]);
    let others = [
        products(coulomb, [row(4), row(5)], [1.0; 2]),
        products(coulomb, [row(6), row(7)], [-1.0, 1.0]),
        products(coulomb, [row(2), row(3)], [1.0, -1.0]),
    ];
    // `(-1)^n` times the scale.
    let alternating: Vec<f64> = scale
        .iter()
        .enumerate()
        .map(|(n, scale)| if n % 2 == 0 { *scale } else { -scale })
        .collect();
    for m in 0..modes {
        let [like, unlike, mirrored] = others.each_ref().map(|other| &other.col_as_slice(m)[m..]);
        let column = &mut matrix.col_as_slice_mut(m)[m..];
        for (i, value) in column.iter_mut().enumerate() {
            let [n_th, n_alternating] = [scale[m + i], alternating[m + i]];
            *value = scale[m] * (n_th * *value + n_alternating * unlike[i])
                + alternating[m] * (n_alternating * like[i] + n_th * mirrored[i]);
        }
    }
    matrix
}

/// Runs the recurrence from the first two rows. Column `m` of the lower triangle is row `m`. The
/// functions of both factors have `eta = sign * eps` with the two `signs`.
fn products(coulomb: &Coulomb, rows: Rows, signs: [f64; 2]) -> Mat<f64> {
    dispatch!(Level::new(), _ => recurrence(coulomb, rows, signs))
}

#[inline(always)]
fn recurrence(coulomb: &Coulomb, [mut before, mut now]: Rows, signs: [f64; 2]) -> Mat<f64> {
    let modes = coulomb.modes;
    let steps = &coulomb.steps[..2 * modes];
    let per_a: Vec<f64> = steps.iter().map(|step| 1.0 / step.per_z).collect();
    let charge: Vec<f64> = steps
        .iter()
        .zip(&per_a)
        .map(|(step, per_a)| step.charge * per_a)
        .collect();
    let mut products = Mat::zeros(modes, modes);
    products
        .col_as_slice_mut(0)
        .copy_from_slice(&before[..modes]);
    products.col_as_slice_mut(1)[1..].copy_from_slice(&now[1..modes]);
    for m in 1..modes - 1 {
        // Each row needs its two neighbours in the row before.
        let count = 2 * modes - 2 - 2 * m;
        let factor = steps[m].per_z;
        let own = signs[0] * charge[m];
        let values = before[m + 1..][..count]
            .iter_mut()
            .zip(&now[m..][..count])
            .zip(&now[m + 1..][..count])
            .zip(&now[m + 2..][..count])
            .zip(&per_a[m + 1..][..count])
            .zip(&charge[m + 1..][..count]);
        for (((((value, left), middle), right), per_a), charge) in values {
            let sum = (left + right) * per_a + (own - signs[1] * charge) * middle;
            *value = factor * sum - *value;
        }
        std::mem::swap(&mut before, &mut now);
        products.col_as_slice_mut(m + 1)[m + 1..].copy_from_slice(&now[m + 1..modes]);
    }
    products
}

/// Returns the rows of the unit matrix beyond `z`, which is at least [`ASYMPTOTIC`].
pub fn beyond(coulomb: &Coulomb, z: f64) -> Rows {
    debug_assert!(z >= ASYMPTOTIC);
    let j = coulomb.functions_at(z);
    // int_y^inf sin t/t dt = f cos y + g sin y, with the asymptotic series of f and g.
    let y = 2.0 * z;
    let (mut f, mut g) = (0.0, 0.0);
    let (mut of_f, mut of_g) = (1.0 / y, 1.0 / (y * y));
    for k in 0..12 {
        f += of_f;
        g += of_g;
        let k = f64::from(2 * k);
        of_f *= -(k + 1.0) * (k + 2.0) / (y * y);
        of_g *= -(k + 2.0) * (k + 3.0) / (y * y);
    }
    let zeroth = z * j[0] * j[0] + f * y.cos() + g * y.sin();
    let first = (zeroth + z * (j[0] * j[0] + j[1] * j[1])) / 3.0;
    let slope = |n: usize| match n {
        0 => -j[1],
        _ => j[n - 1] - (n + 1) as f64 / z * j[n],
    };
    [0, 1].map(|m: usize| {
        let element = |n: usize| {
            if n % 2 != m {
                0.0
            } else if n == m {
                FRAC_2_PI * [zeroth, first][m]
            } else {
                let square = |n: usize| (n * (n + 1)) as f64;
                let wronskian = j[m] * slope(n) - slope(m) * j[n];
                FRAC_2_PI * z * z * wronskian / (square(m) - square(n))
            }
        };
        (0..j.len()).map(element).collect()
    })
}
