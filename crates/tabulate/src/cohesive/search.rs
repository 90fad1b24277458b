//! Minima of functions that may fail.

use crate::Error;

/// A point and the value there.
type Point = (f64, f64);

/// Goes downhill from `start` in steps of `step` until the values rise again, and returns three
/// points with the lowest value in the middle; none if there is no minimum before `end`.
pub fn bracket(
    f: &mut impl FnMut(f64) -> Result<f64, Error>,
    start: f64,
    step: f64,
    end: f64,
) -> Result<Option<[Point; 3]>, Error> {
    let mut point = |x: f64| Ok::<Point, Error>((x, f(x)?));
    let (mut before, mut middle) = (point(start)?, point(start + step)?);
    if middle.1 > before.1 {
        return Ok(None);
    }
    while (middle.0 - end) * step < 0.0 {
        let next = point(middle.0 + step)?;
        if next.1 > middle.1 {
            return Ok(Some([before, middle, next]));
        }
        (before, middle) = (middle, next);
    }
    Ok(None)
}

/// Finds the minimum between the outer of three points to about 1e-7 of their distance; the value
/// there is accurate to rounding.
///
/// Each step goes to the lowest point of the parabola through the three, or divides the wider side by
/// the golden section where that does not shrink the interval.
pub fn minimum(
    f: &mut impl FnMut(f64) -> Result<f64, Error>,
    [mut low, mut middle, mut high]: [Point; 3],
) -> Result<Point, Error> {
    const GOLDEN: f64 = 0.381_966_011_250_105;
    const MOST_STEPS: usize = 60;
    let width = (high.0 - low.0).abs();
    let mut last = width;
    for step in 0..MOST_STEPS {
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
        let golden = step % 3 == 2 || !inside || (parabola - middle.0).abs() > 0.5 * last;
        let mut x = if golden {
            middle.0 + GOLDEN * (wider - middle.0)
        } else {
            parabola
        };
        last = (x - middle.0).abs();
        let least = 1e-8 * width;
        if last < least {
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
            let bracket = bracket(&mut f, at - 0.7, 0.4, 10.0)
                .expect("no failure")
                .expect("a minimum");
            let (x, value) = minimum(&mut f, bracket).expect("no failure");
            println!("{power}: {x}, {value}, {calls} calls");
            assert!((value - 1.0).abs() < 1e-14, "{value}");
            assert!(calls < most, "{calls}");
        }
    }
}
