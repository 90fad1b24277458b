//! The root of a function between two points at which its signs differ.

/// The largest number of steps: after as many bisections an interval is narrower than rounding.
const MOST_STEPS: usize = 300;

/// Finds, to rounding, the point between `a` and `b` at which `f` changes its sign.
///
/// Chandrupatla's method (Adv. Eng. Software 28, 145, 1997) interpolates by an inverse quadratic
/// function where that is safe, and bisects elsewhere. Without a change of sign the result is one
/// of the ends.
///
/// # Errors
/// Those of `f`.
pub fn root<E>(f: impl Fn(f64) -> Result<f64, E>, a: f64, b: f64) -> Result<f64, E> {
    // The ends of the interval as `(x, f(x))`; `new` is the one computed last.
    let (mut old, mut new) = ((a, f(a)?), (b, f(b)?));
    let mut part: f64 = 0.5;
    for _ in 0..MOST_STEPS {
        let best = if new.1.abs() < old.1.abs() { new } else { old };
        let least = 2.0 * f64::EPSILON * best.0.abs() / (old.0 - new.0).abs();
        // An interval without length gives NaN, which is not wide.
        let wide = least < 0.5;
        if !wide || best.1 == 0.0 || (new.1 < 0.0) == (old.1 < 0.0) {
            return Ok(best.0);
        }
        let x = new.0 + part.clamp(least, 1.0 - least) * (old.0 - new.0);
        let point = (x, f(x)?);
        // The end that the new point replaces.
        let third = if (point.1 < 0.0) == (new.1 < 0.0) {
            new
        } else {
            std::mem::replace(&mut old, new)
        };
        new = point;
        // Is `x`, as a quadratic function of `f` through the three points, monotonic? Infinite
        // values give NaN, for which the comparisons are false.
        let (xi, phi) = (
            (new.0 - old.0) / (third.0 - old.0),
            (new.1 - old.1) / (third.1 - old.1),
        );
        part = if phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi {
            new.1 / (old.1 - new.1) * third.1 / (old.1 - third.1)
                + (third.0 - new.0) / (old.0 - new.0) * new.1 / (third.1 - new.1) * old.1
                    / (third.1 - old.1)
        } else {
            0.5
        };
    }
    Ok(new.0)
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;
    use std::convert::Infallible;

    use super::root;

    /// Returns the root and the number of evaluations.
    fn count(f: impl Fn(f64) -> f64, a: f64, b: f64) -> (f64, usize) {
        let count = Cell::new(0);
        let counted = |x| {
            count.set(count.get() + 1);
            Ok::<f64, Infallible>(f(x))
        };
        (
            root(counted, a, b).expect("no error to pass on"),
            count.get(),
        )
    }

    #[test]
    fn roots_are_found_to_rounding_in_few_steps() {
        let check = |f: fn(f64) -> f64, a, b, expected: f64, most| {
            for (a, b) in [(a, b), (b, a)] {
                let (found, count) = count(f, a, b);
                println!("{found} after {count} evaluations");
                assert!(
                    (found - expected).abs() <= 4.0 * f64::EPSILON * expected.abs(),
                    "{found}, not {expected}"
                );
                assert!(count <= most, "{expected} after {count} evaluations");
            }
        };
        check(|x| x * x - 2.0, 0.0, 2.0, std::f64::consts::SQRT_2, 12);
        check(f64::cos, 1.0, 2.0, std::f64::consts::FRAC_PI_2, 9);
        check(|x| (x - 1.0).powi(3), 0.0, 3.5, 1.0, 160);
        check(
            |x| x.exp() - 1e-100,
            -700.0,
            700.0,
            -100.0 * std::f64::consts::LN_10,
            40,
        );
        check(
            |x| if x < 1.0 / 3.0 { -1.0 } else { 1e300 },
            -1.0,
            1.0,
            1.0 / 3.0,
            70,
        );
        check(
            |x| {
                if x < 5.0 {
                    f64::NEG_INFINITY
                } else {
                    f64::INFINITY
                }
            },
            -1e3,
            1e3,
            5.0,
            70,
        );
    }

    #[test]
    fn an_end_is_a_root_or_the_result_without_a_change_of_sign() {
        assert_eq!(count(|x| x, 0.0, 1.0).0, 0.0);
        assert_eq!(count(|x| x, -1.0, 0.0).0, 0.0);
        assert_eq!(count(|x| x + 1.0, 1.0, 2.0), (1.0, 2));
        assert_eq!(count(|x| x, 3.0, 3.0), (3.0, 2));
        assert!(count(|_| f64::NAN, 1.0, 2.0).1 <= 2);
    }
}
