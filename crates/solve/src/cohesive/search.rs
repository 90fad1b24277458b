//! Minima of functions that may fail.

use crate::Error;

/// A point and the value there.
pub type Point = (f64, f64);

/// Goes downhill from two points until the values rise again, and returns three points with the
/// lowest value in the middle; none if there is no minimum before `end`. Each step is half as long
/// again as the one before, up to a longest one.
pub fn bracket(
    f: &mut impl FnMut(f64) -> Result<f64, Error>,
    [mut before, mut middle]: [Point; 2],
    end: f64,
) -> Result<Option<[Point; 3]>, Error> {
    const GROWTH: f64 = 1.5;
    const LONGEST: f64 = 0.35;
    if middle.1 > before.1 {
        return Ok(None);
    }
    let mut step = middle.0 - before.0;
    while (middle.0 - end) * step < 0.0 {
        step *= GROWTH.min(LONGEST / step.abs()).max(1.0);
        let next = (middle.0 + step, f(middle.0 + step)?);
        if next.1 > middle.1 {
            return Ok(Some([before, middle, next]));
        }
        (before, middle) = (middle, next);
    }
    Ok(None)
}

/// Goes downhill from two points, of which the second is above the first, to either side, as [`bracket`].
pub fn bracket_from(
    f: &mut impl FnMut(f64) -> Result<f64, Error>,
    [here, above]: [Point; 2],
    [smallest, largest]: [f64; 2],
) -> Result<Option<[Point; 3]>, Error> {
    if above.1 >= here.1 {
        bracket(f, [above, here], smallest)
    } else {
        bracket(f, [here, above], largest)
    }
}

/// Finds the minimum between the outer of three points to about 1e-7 of their distance; the value
/// there is accurate to rounding.
///
/// Each step goes to the lowest point of the parabola through the three. It divides the wider side
/// by the golden section where that point is outside or the step is more than half of the one
/// before the last (Brent, Algorithms for Minimization without Derivatives, 1973, chapter 5).
pub fn minimum(
    f: &mut impl FnMut(f64) -> Result<f64, Error>,
    [mut low, mut middle, mut high]: [Point; 3],
) -> Result<Point, Error> {
    const GOLDEN: f64 = 0.381_966_011_250_105;
    const MOST_STEPS: usize = 60;
    let width = (high.0 - low.0).abs();
    // The last step and the one before it.
    let mut steps = [width; 2];
    for _ in 0..MOST_STEPS {
        let (left, right) = (middle.0 - low.0, middle.0 - high.0);
        let (fall, rise) = (middle.1 - high.1, middle.1 - low.1);
        let parabola = middle.0
            - 0.5 * (left * left * fall - right * right * rise) / (left * fall - right * rise);
        let wider = if left.abs() > right.abs() {
            low.0
        } else {
            high.0
        };
        let inside = (parabola - low.0) * (parabola - high.0) < 0.0;
        let golden = !inside || (parabola - middle.0).abs() > 0.5 * steps[1];
        let mut x = if golden {
            middle.0 + GOLDEN * (wider - middle.0)
        } else {
            parabola
        };
        steps = [(x - middle.0).abs(), steps[0]];
        let least = 1e-7 * width;
        if steps[0] < least {
            if !golden {
                return Ok(middle);
            }
            x = middle.0 + least.copysign(wider - middle.0);
        }
        let next = (x, f(x)?);
        let beyond_middle = (next.0 - middle.0) * (high.0 - middle.0) > 0.0;
        if next.1 <= middle.1 {
            *if beyond_middle { &mut low } else { &mut high } = middle;
            middle = next;
        } else {
            *if beyond_middle { &mut high } else { &mut low } = next;
        }
    }
    Ok(middle)
}

/// Finds the point between `low` and `high` at which `f` passes from negative to positive values,
/// for an almost linear `f` of positive arguments.
///
/// Each step is that of the secant through the last two points, or halves the interval where that
/// leaves it. The error of a secant is of the order of the product of the last two steps.
pub fn crossing(mut f: impl FnMut(f64) -> f64, mut low: Point, mut high: Point) -> f64 {
    const MOST_STEPS: usize = 100;
    /// The largest relative error.
    const ACCURACY: f64 = 1e-16;
    let (mut old, mut new) = (low, high);
    for step in 0..MOST_STEPS {
        let secant = new.0 - new.1 * (new.0 - old.0) / (new.1 - old.1);
        let inside = secant > low.0 && secant < high.0;
        let change = (secant - new.0) * (new.0 - old.0);
        if inside && change.abs() <= ACCURACY * secant * secant {
            return secant;
        }
        let halve = !inside || step % 8 == 7;
        let x = if halve {
            0.5 * (low.0 + high.0)
        } else {
            secant
        };
        let next = (x, f(x));
        if next.1 == 0.0 || high.0 - low.0 <= 2.0 * f64::EPSILON * x {
            return x;
        }
        *if next.1 < 0.0 { &mut low } else { &mut high } = next;
        (old, new) = (new, next);
    }
    new.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn minima_are_found_in_few_steps() {
        // The flat minimum of a fourth power takes all the steps allowed.
        for (at, power, most) in [(0.3, 2, 30), (-1.7, 4, 70), (2.2, 2, 30)] {
            let mut calls = 0;
            let mut f = |x: f64| {
                calls += 1;
                Ok((x - at).powi(power) + 0.3 * (x - at).powi(3 * power / 2 + 1) + 1.0)
            };
            let start = [at - 0.7, at - 0.3];
            let start = start.map(|x| (x, f(x).expect("no failure")));
            let bracket = bracket(&mut f, start, 10.0)
                .expect("no failure")
                .expect("a minimum");
            let (x, value) = minimum(&mut f, bracket).expect("no failure");
            println!("{power}: {x}, {value}, {calls} calls");
            assert!((value - 1.0).abs() < 1e-14, "{value}");
            assert!(calls < most, "{calls}");
        }
        let flat = [0.0, 1.0, 2.0].map(|x| (x, 1.0));
        let (x, _) = minimum(&mut |_| Ok(1.0), flat).expect("no failure");
        assert!((0.0..=2.0).contains(&x), "{x}");
    }

    #[test]
    fn crossings_are_found_in_few_steps() {
        type Function = fn(f64) -> f64;
        let functions: [(Function, f64, usize); 3] = [
            (|x| x * (1.0 + 0.3 * x) - 1.3, 1.0, 7),
            (|x| x.powi(5) - 32.0, 2.0, 12),
            (|x| (x - 0.5).max(0.0) - 1.5, 2.0, 12),
        ];
        for (f, at, most) in functions {
            let mut calls = 0;
            let count = |x: f64| {
                calls += 1;
                f(x)
            };
            let x = crossing(count, (0.4, f(0.4)), (2.6, f(2.6)));
            println!("{x}, {calls} calls");
            assert!((x / at - 1.0).abs() < 1e-15 && calls < most, "{x}, {calls}");
        }
    }
}
