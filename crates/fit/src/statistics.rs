//! Statistics of samples.

use std::convert::Infallible;

use contact::root;

/// The median of the absolute value of a normal number.
pub(crate) const MEDIAN: f64 = 0.674_49;

/// The largest excess of a sum of squares, or lack of runs, that chance explains, in standard
/// deviations: one fit in 300,000 exceeds it.
pub(crate) const BEYOND_CHANCE: f64 = 4.5;

/// The numbers from which on sums of squares overflow.
pub(crate) const LARGEST: f64 = 1e150;

/// Returns the median; 0 of no values.
pub(crate) fn median(mut values: Vec<f64>) -> f64 {
    if values.is_empty() {
        return 0.0;
    }
    let (count, middle) = (values.len(), values.len() / 2);
    let (below, upper, _) = values.select_nth_unstable_by(middle, f64::total_cmp);
    let upper = *upper;
    if count % 2 == 1 {
        return upper;
    }
    let lower = below.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    0.5 * (lower + upper)
}

/// Returns the differences of neighbours.
pub(crate) fn differences_of(numbers: &[f64]) -> Vec<f64> {
    numbers.windows(2).map(|pair| pair[1] - pair[0]).collect()
}

/// Returns the least and the largest of numbers; infinity and negative infinity of none.
pub(crate) fn extremes(numbers: impl Iterator<Item = f64>) -> [f64; 2] {
    numbers.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], x| {
        [least.min(x), most.max(x)]
    })
}

/// Returns the largest of numbers less the least.
pub(crate) fn range(numbers: impl Iterator<Item = f64>) -> f64 {
    let [least, most] = extremes(numbers);
    most - least
}

/// Returns the standard deviation of normal numbers by the median of their sizes, which bears outliers.
pub(crate) fn robust_deviation(numbers: impl Iterator<Item = f64>) -> f64 {
    median(numbers.map(f64::abs).collect()) / MEDIAN
}

/// Returns the standard deviation of independent noise from the fourth differences of numbers over a distance, which have 70
/// times its variance. A smooth course has few, and a jump or a bend changes the median little.
pub(crate) fn noise_over(distance: usize, numbers: &[f64]) -> f64 {
    let differences = numbers.windows(4 * distance + 1).map(|part| {
        let at = |i: usize| part[i * distance];
        at(0) - 4.0 * at(1) + 6.0 * at(2) - 4.0 * at(3) + at(4)
    });
    robust_deviation(differences) / 70.0_f64.sqrt()
}

/// Returns the zero of a function between two numbers.
pub(crate) fn zero(of: impl Fn(f64) -> f64, from: f64, to: f64) -> f64 {
    let Ok(found) = root(|x| Ok::<_, Infallible>(of(x)), from, to);
    found
}

/// Returns the value from which on half of the weights are, of values with their weights; 0 of none.
pub(crate) fn weighted_median(values: &mut [[f64; 2]]) -> f64 {
    values.sort_unstable_by(|one, other| one[0].total_cmp(&other[0]));
    let half = 0.5 * values.iter().map(|[_, weight]| weight).sum::<f64>();
    let mut below = 0.0;
    let middle = values.iter().find(|[_, weight]| {
        below += weight;
        below >= half
    });
    middle.map_or(0.0, |[value, _]| *value)
}

/// Returns by how many standard deviations `chi_squared` exceeds its expectation. Its cube root is
/// nearly normal (Wilson and Hilferty, Proc. Natl. Acad. Sci. 17, 684, 1931).
pub(crate) fn excess(chi_squared: f64, degrees_of_freedom: f64) -> f64 {
    let spread = 2.0 / (9.0 * degrees_of_freedom);
    ((chi_squared / degrees_of_freedom).cbrt() - (1.0 - spread)) / spread.sqrt()
}

/// The residual over the robust standard deviation of all from which on it is far.
const FAR: f64 = 3.0;

/// Returns the size from which on residuals of these `sizes` are far from the others; infinity where most are 0.
pub(crate) fn far(sizes: impl Iterator<Item = f64>) -> f64 {
    let scale = robust_deviation(sizes);
    if scale > 0.0 {
        FAR * scale
    } else {
        f64::INFINITY
    }
}

/// Returns by how many standard deviations a mean of squares exceeds another one, of the same normal numbers,
/// with these degrees of freedom each: Wilson and Hilferty's cube root in both (Paulson, Ann. Math. Stat. 13,
/// 233, 1942).
pub(crate) fn ratio_of_squares([one, other]: [f64; 2], [of_one, of_other]: [f64; 2]) -> f64 {
    let [above, below] = [of_one, of_other].map(|freedom| 2.0 / (9.0 * freedom));
    let [one, other] = [one, other].map(f64::cbrt);
    let spread = below.mul_add(one * one, above * other * other).sqrt();
    ((1.0 - below) * one - (1.0 - above) * other) / spread
}

/// The square from which on residuals count alike in [`clipped`].
const CLIP: f64 = 4.0;
/// The mean and the standard deviation of the smaller of `r^2` and 4, for a normal `r`.
pub(crate) const CLIPPED: [f64; 2] = [0.920_5, 1.110_2];
/// The part of points that may be outliers for [`clipped`].
const OUTLIERS: f64 = 0.1;

/// Returns the mean of the squares of residuals, of which none counts more than 4, and by how many
/// standard deviations it exceeds that of normal noise, and that of normal noise with one outlier
/// in ten points.
pub(crate) fn clipped(residuals: &[f64], degrees_of_freedom: f64) -> (f64, [f64; 2]) {
    let count = residuals.len() as f64;
    let scale = count / degrees_of_freedom.max(1.0);
    let squares = residuals.iter().map(|r| (r * r * scale).min(CLIP));
    let mean = squares.sum::<f64>() / count;
    let [expected, deviation] = CLIPPED;
    let excess = |part: f64| {
        let with_outliers = expected + part * (CLIP - expected);
        (mean - with_outliers) * count.sqrt() / deviation
    };
    (mean, [excess(0.0), excess(OUTLIERS)])
}

/// Returns the variance of a sum of values times weights, from the differences of neighbours: half
/// the mean square of a difference is the variance of a value (von Neumann, Ann. Math. Stat. 12,
/// 367, 1941), whatever smooth course the values have.
pub(crate) fn scatter_of_differences(weighted: &[(f64, f64)]) -> f64 {
    let count = weighted.len() as f64;
    let part = |pair: &[(f64, f64)]| {
        let [(one, weight), (other, next)] = [pair[0], pair[1]];
        0.5 * weight * next * (one - other).powi(2)
    };
    count / (count - 1.0) * weighted.windows(2).map(part).sum::<f64>()
}

/// Returns by how many standard deviations neighbours differ less than independent residuals do, and
/// the mean square of the residuals over half that of the differences (von Neumann, Ann. Math. Stat.
/// 12, 367, 1941); `None` below three.
pub(crate) fn likeness_of_neighbours(residuals: &[f64]) -> Option<[f64; 2]> {
    let n = residuals.len() as f64;
    let squares: f64 = residuals.iter().map(|r| r * r).sum();
    let differences = residuals.windows(2).map(|pair| (pair[1] - pair[0]).powi(2));
    let halves = 0.5 * differences.sum::<f64>();
    let deviations = (1.0 - halves / squares) * ((n * n - 1.0) / (n - 2.0)).sqrt();
    (n >= 3.0 && squares > 0.0).then_some([deviations, (squares / n) / (halves / (n - 1.0))])
}

/// The runs from which on their means tell something.
const FEWEST_RUNS: f64 = 8.0;

/// Returns by how many standard deviations the means of runs of `length` residuals of all ways scatter
/// more than those of independent residuals, whose variance the differences of neighbours tell, and
/// the ratio of both variances; `None` for fewer than [`FEWEST_RUNS`] runs. A slow wave below the noise
/// is seen here, and not between neighbours.
pub(crate) fn likeness_of_runs(ways: &[Vec<f64>], length: usize) -> Option<[f64; 2]> {
    let [mut squares, mut runs, mut differences, mut pairs] = [0.0; 4];
    for way in ways.iter().filter(|way| way.len() >= length) {
        let of_pairs = way.windows(2).map(|pair| 0.5 * (pair[1] - pair[0]).powi(2));
        differences += of_pairs.sum::<f64>();
        pairs += (way.len() - 1) as f64;
        for run in way.chunks_exact(length) {
            squares += run.iter().sum::<f64>().powi(2) / length as f64;
            runs += 1.0;
        }
    }
    let variances = [squares / runs, differences / pairs];
    // A variance from differences has two thirds of the degrees of freedom of one from residuals.
    let freedom = [runs, pairs / 1.5];
    (runs >= FEWEST_RUNS && differences > 0.0).then(|| {
        let deviations = ratio_of_squares(variances, freedom);
        [deviations, variances[0] / variances[1]]
    })
}

/// Returns the normal number that is exceeded as often as `t` by Student's distribution with
/// `freedom` degrees of freedom (Wallace, Ann. Math. Stat. 30, 1124, 1959).
pub(crate) fn normal_of_t(t: f64, freedom: f64) -> f64 {
    (8.0 * freedom + 1.0) / (8.0 * freedom + 3.0) * (freedom * (t * t / freedom).ln_1p()).sqrt()
}

/// Returns how many standard deviations a normal number stays within with probability `level`.
pub(crate) fn deviations(level: f64) -> f64 {
    /// No f64 is a probability to be farther away.
    const FARTHEST: f64 = 40.0;
    let outside = |z: f64| libm::erfc(z * std::f64::consts::FRAC_1_SQRT_2);
    zero(|z| outside(z) - (1.0 - level), 0.0, FARTHEST)
}

/// The degrees of freedom from which on Student's distribution is taken for the normal one: its
/// quantiles differ by less than one part in a thousand.
const MANY: usize = 5000;

/// Returns within how many standard errors, estimated with `freedom >= 1` degrees of freedom, a number
/// stays with probability `level`: the quantile of Student's distribution.
pub(crate) fn student_deviations(level: f64, freedom: usize) -> f64 {
    if freedom > MANY {
        return deviations(level);
    }
    // The angle whose tangent is `t/sqrt(freedom)`.
    let excess = |angle| student_within(angle, freedom) - level;
    let angle = zero(excess, 0.0, std::f64::consts::FRAC_PI_2);
    (freedom as f64).sqrt() * angle.tan()
}

/// Returns the probability that Student's number is between `-t` and `t` with
/// `t = sqrt(freedom) tan(angle)` (Abramowitz and Stegun, 26.7.3 and 26.7.4).
fn student_within(angle: f64, freedom: usize) -> f64 {
    let (sine, cosine) = angle.sin_cos();
    let is_odd = freedom % 2 == 1;
    let mut term = if is_odd { cosine } else { 1.0 };
    let mut sum = if freedom == 1 { 0.0 } else { term };
    let mut power = if is_odd { 1 } else { 0 };
    while power + 2 + 2 <= freedom {
        power += 2;
        term *= cosine * cosine * (power - 1) as f64 / power as f64;
        sum += term;
    }
    if is_odd {
        std::f64::consts::FRAC_2_PI * (angle + sine * sum)
    } else {
        sine * sum
    }
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg64Mcg;

    use super::*;

    /// One ratio in a thousand is larger than these, of tables of Fisher's distribution; 3.090 standard deviations.
    #[test]
    fn ratios_of_squares_are_those_of_fishers_distribution() {
        for (freedom, ratio) in [
            ([10.0, 10.0], 8.754),
            ([10.0, 20.0], 5.075),
            ([20.0, 10.0], 7.804),
            ([20.0, 20.0], 4.290),
            ([10.0, 120.0], 3.237),
            ([120.0, 10.0], 6.944),
        ] {
            let found = ratio_of_squares([ratio, 1.0], freedom);
            assert!((3.0..3.1).contains(&found), "{freedom:?}: {found}");
        }
    }

    /// One set in a thousand is beyond 3.09 standard deviations: white noise of several short ways, too.
    #[test]
    fn runs_of_white_noise_are_rarely_alike() {
        const SETS: usize = 2000;
        let mut random = Pcg64Mcg::seed_from_u64(1);
        let mut normal = || {
            let radius = (-2.0 * random.random_range(f64::MIN_POSITIVE..1.0_f64).ln()).sqrt();
            radius * random.random_range(0.0..std::f64::consts::TAU).cos()
        };
        for [ways, points] in [[1, 64], [4, 16], [2, 300]] {
            let beyond = |_: &usize| {
                let ways: Vec<Vec<f64>> = (0..ways)
                    .map(|_| (0..points).map(|_| normal()).collect())
                    .collect();
                let [deviations, _] = likeness_of_runs(&ways, 8).expect("eight runs");
                deviations > 3.09
            };
            let count = (0..SETS).filter(beyond).count();
            assert!(
                count <= SETS / 200,
                "{count} of {SETS}: {ways} ways of {points}"
            );
        }
    }

    #[test]
    fn medians_are_in_the_middle() {
        assert_eq!(median(vec![3.0, 1.0, 2.0]), 2.0);
        assert_eq!(median(vec![4.0, 1.0, 2.0, 3.0]), 2.5);
        assert_eq!(median(Vec::new()), 0.0);
        assert_eq!(
            weighted_median(&mut [[3.0, 1.0], [1.0, 1.0], [2.0, 1.0]]),
            2.0
        );
        assert_eq!(
            weighted_median(&mut [[3.0, 5.0], [1.0, 1.0], [2.0, 1.0]]),
            3.0
        );
        assert_eq!(weighted_median(&mut []), 0.0);
    }

    #[test]
    fn student_numbers_are_those_of_tables() {
        // Two-sided 5 % and 0.1 %: 1.960 and 3.291 of a normal number.
        for (freedom, t, normal) in [
            (10.0, 2.228, 1.960),
            (30.0, 2.042, 1.960),
            (10.0, 4.587, 3.291),
            (30.0, 3.646, 3.291),
        ] {
            assert!((normal_of_t(t, freedom) - normal).abs() < 0.01, "{freedom}");
        }
    }

    #[test]
    fn differences_show_the_noise_beside_a_smooth_course() {
        // Signs that alternate: each difference is 2, half of its square 2.
        let values: Vec<(f64, f64)> = (0..101_i32)
            .map(|i| (f64::from(1 - 2 * (i % 2)), 0.1))
            .collect();
        let expected = 0.01 * 2.0 * 101.0;
        assert!((scatter_of_differences(&values) / expected - 1.0).abs() < 1e-12);
        let smooth: Vec<(f64, f64)> = (0..101_i32).map(|i| (f64::from(i), 1.0)).collect();
        assert!(scatter_of_differences(&smooth) < 51.0);
    }

    #[test]
    fn neighbours_that_are_alike_are_told_from_independent_ones() {
        // Half the sum of squared differences of a saw of 1 and -1 is 2 per pair.
        let saw: Vec<f64> = (0..100_i32).map(|i| f64::from(1 - 2 * (i % 2))).collect();
        let [deviations, ratio] = likeness_of_neighbours(&saw).expect("many");
        assert!(deviations < -9.0 && (ratio - 0.5).abs() < 1e-12);
        let slope: Vec<f64> = (0..100_i32).map(|i| f64::from(2 * i - 99)).collect();
        let [deviations, ratio] = likeness_of_neighbours(&slope).expect("many");
        assert!(deviations > 9.0 && ratio > 1000.0, "{deviations}, {ratio}");
        assert_eq!(likeness_of_neighbours(&[1.0, 2.0]), None);
    }

    #[test]
    fn student_quantiles_are_those_of_tables() {
        for (freedom, level, expected) in [
            (1, 0.95, 12.706_205),
            (2, 0.95, 4.302_653),
            (3, 0.95, 3.182_446),
            (4, 0.95, 2.776_445),
            (5, 0.99, 4.032_143),
            (10, 0.5, 0.699_812),
            (30, 0.95, 2.042_272),
            (121, 0.99, 2.616_879),
        ] {
            let found = student_deviations(level, freedom);
            assert!((found - expected).abs() < 2e-4, "{freedom}: {found}");
        }
        let ends = [MANY, MANY + 1].map(|freedom| student_deviations(0.95, freedom));
        assert!((ends[0] / ends[1] - 1.0).abs() < 1e-3, "{ends:?}");
    }

    /// Two values that are found make residuals of five points smaller.
    #[test]
    fn clipped_squares_are_those_of_the_degrees_of_freedom() {
        let (mean, _) = clipped(&[0.0, 0.6, -0.6, 1.2, 9.0], 3.0);
        let expected = (2.0 * 0.6 + 2.4 + 4.0) / 5.0;
        assert!((mean - expected).abs() < 1e-14, "{mean}");
    }

    #[test]
    fn quantiles_are_those_of_tables() {
        for (level, expected) in [(0.6827, 1.0), (0.95, 1.959_964), (0.99, 2.575_829)] {
            assert!((deviations(level) - expected).abs() < 1e-4, "{level}");
        }
    }
}
