//! The contact of any shape on a film, from the field of the flat punch.
//!
//! With the [field](super::field) and the [transform](super::transform) `b` of the shape,
//!
//! ```text
//! delta0' = (es/Gamma) [b'(a) - int_0^a b'(s) (dg1/ds)/Gamma ds]
//! ```
//!
//! (the form of `curve/even_powers/mod.rs`, integrated by parts). The results are stored as
//!
//! ```text
//! delta0 = (es/Gamma) b + J          J' = (es/Gamma) [W b - int_0^a b' (dg1/ds)/Gamma ds]
//! F0 = S delta0 - 2 E* M             M' = Gamma^2/es delta0
//! ```
//!
//! with `J` and `M` as polynomials on panels: both are smoother than the shape. At the radius of a
//! knot of the shape they behave like powers of `sqrt(a - m)`. A panel that begins there is a
//! polynomial in this root, and the following ones grow from there by doubling.

use std::sync::{Arc, OnceLock};

use super::field::Field;
use super::medium::{At, Medium};
use super::polynomial::{CHEBYSHEV, GAUSS, POINTS, Polynomial, evaluate};
use super::transform::Transform;
use crate::{Curve, Error, Parameter};

/// The departure of `ln Gamma` from its limit at which a film begins to count.
const BEGINS_TO_COUNT: f64 = 0.1;
/// Intervals shorter than this part of the contact radius need fewer points.
const SHORT: f64 = 0.02;
/// The step of the differences for derivatives. Their error is of the order of its square.
const STEP: f64 = 1e-4;
/// The number of derivatives: with respect to the four parameters of the material, and the size of
/// the shape.
const DERIVATIVES: usize = 5;
/// The number of the derivative with respect to the size of the shape.
pub(super) const SIZE: usize = 4;

/// A shape on a film. Lengths are in units of the film's thickness.
#[derive(Clone, Debug)]
pub(in crate::contact) struct Solved {
    own: Solution,
    /// The shapes or materials with a little more and a little less of a parameter, made when they
    /// are needed.
    changed: Arc<[OnceLock<[Solution; 2]>; DERIVATIVES]>,
}

/// Penetration `delta0/t`, its derivative, and load `F0/(Es* t^2)`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Values {
    pub penetration: f64,
    pub slope: f64,
    pub load: f64,
}

impl Solved {
    /// Solves for contact radii up to `most`.
    pub(super) fn new(curve: &Curve, transform: Transform, most: f64) -> Result<Self, Error> {
        curve.accept_integrals("the contact of this probe")?;
        let field = Arc::new(Field::new(Medium::new(curve, None)?, most)?);
        Ok(Self {
            own: Solution::new(field.clone(), transform, scale(&field)?)?,
            changed: Arc::default(),
        })
    }

    /// Returns the largest contact radius.
    pub(super) fn last(&self) -> f64 {
        self.own.field.last
    }

    pub(super) fn values(&self, x: f64) -> Result<Values, Error> {
        self.own.values(x)
    }

    /// Returns the derivatives of penetration and load with respect to a parameter by number: those
    /// of the material as in `QuantityGradient::relative`, or [`SIZE`].
    pub(super) fn by(&self, curve: &Curve, parameter: usize, x: f64) -> Result<[f64; 2], Error> {
        let cell = &self.changed[parameter];
        if cell.get().is_none() {
            let Solution {
                field,
                transform,
                scale,
                ..
            } = &self.own;
            let change = |step: f64| {
                if parameter == SIZE {
                    return Solution::new(field.clone(), transform.scaled(1.0 + step), *scale);
                }
                let medium = Medium::new(curve, Some((parameter, step)))?;
                let field = field.with_medium(medium)?;
                Solution::new(Arc::new(field), transform.clone(), *scale)
            };
            let both = [change(STEP)?, change(-STEP)?];
            // Another thread may have been faster; its solutions are the same.
            let _ = cell.set(both);
        }
        let [more, less] = cell.get().expect("it has just been made");
        let (more, less) = (more.values(x)?, less.values(x)?);
        Ok([
            (more.penetration - less.penetration) / (2.0 * STEP),
            (more.load - less.load) / (2.0 * STEP),
        ])
    }
}

/// The solution of one shape on one material.
#[derive(Clone, Debug)]
struct Solution {
    field: Arc<Field>,
    transform: Transform,
    /// The contact radius at which the film begins to count.
    scale: f64,
    panels: Vec<Panel>,
}

/// `J` and `M` on an interval of contact radii.
#[derive(Clone, Copy, Debug)]
struct Panel {
    from: f64,
    to: f64,
    /// Whether the polynomials are in the root of the distance from the beginning.
    root: bool,
    penetration: Polynomial,
    load: Polynomial,
}

impl Panel {
    /// Returns the position of a contact radius, from -1 to 1.
    fn position(&self, x: f64) -> f64 {
        let part = ((x - self.from) / (self.to - self.from)).max(0.0);
        2.0 * if self.root { part.sqrt() } else { part } - 1.0
    }

    /// Returns the contact radius of a position, and its derivative.
    fn radius(&self, t: f64) -> [f64; 2] {
        let length = self.to - self.from;
        let part = 0.5 * (t + 1.0);
        if self.root {
            [self.from + length * part * part, length * part]
        } else {
            [self.from + length * part, 0.5 * length]
        }
    }
}

impl Solution {
    fn new(field: Arc<Field>, transform: Transform, scale: f64) -> Result<Self, Error> {
        let mut solution = Self {
            field,
            transform,
            scale,
            panels: Vec::new(),
        };
        let ends = solution.ends();
        let first = ends[0].0;
        if first >= solution.field.last && ends[0].1 {
            return Err(Error::OutsideTable {
                axis: Parameter::AOverT.name(),
                value: first,
                from: 0.0,
                to: solution.field.last,
            });
        }
        // A flat end begins without load and penetration, a tip as on a thick film.
        let (mut penetration, mut load) = (0.0, 0.0);
        if first <= solution.field.first() {
            let (at, thick) = (solution.field.medium.at(first)?, solution.thick(first));
            penetration = thick.penetration - solution.transform.value(first) / at.gamma;
            load = first * at.eeq * thick.penetration - 0.5 * thick.load;
        }
        for pair in ends.windows(2) {
            let mut panel = Panel {
                from: pair[0].0,
                to: pair[1].0,
                root: pair[0].1,
                penetration: [0.0; POINTS],
                load: [0.0; POINTS],
            };
            let mut rates = [0.0; POINTS];
            let mut points = [(
                At {
                    gamma: 1.0,
                    growth: 0.0,
                    eeq: 1.0,
                },
                0.0,
                0.0,
            ); POINTS];
            for (k, &t) in CHEBYSHEV.at.iter().enumerate() {
                let [x, speed] = panel.radius(t);
                let (at, b) = (solution.field.medium.at(x)?, solution.transform.value(x));
                rates[k] = speed * (at.growth * b - solution.integral(x)) / at.gamma;
                points[k] = (at, b, speed);
            }
            let own = integrated(penetration, &rates);
            panel.penetration = continued(penetration, CHEBYSHEV.through(&own));
            let rates_of_load = std::array::from_fn(|k| {
                let (at, b, speed) = points[k];
                speed * at.gamma * (b + at.gamma * own[k])
            });
            let own = CHEBYSHEV.through(&integrated(load, &rates_of_load));
            panel.load = continued(load, own);
            let whole = |rates: &[f64; POINTS]| -> f64 {
                CHEBYSHEV
                    .whole
                    .iter()
                    .zip(rates)
                    .map(|(own, rate)| own * rate)
                    .sum()
            };
            penetration += whole(&rates);
            load += whole(&rates_of_load);
            solution.panels.push(panel);
        }
        Ok(solution)
    }

    /// Returns the ends of the panels, and whether a knot of the shape is there.
    fn ends(&self) -> Vec<(f64, bool)> {
        let field = &self.field;
        let knots = self.transform.knots().iter().map(|knot| knot.radius);
        let flat_end = self
            .transform
            .knots()
            .first()
            .map_or(0.0, |knot| knot.radius);
        let start = field.first().max(flat_end);
        let inside = |end: &f64| *end > start && *end < field.last;
        let mut ends = vec![(start, flat_end >= start), (field.last, false)];
        ends.extend(knots.filter(inside).map(|knot| (knot, true)));
        ends.extend(
            field
                .ends()
                .iter()
                .copied()
                .filter(inside)
                .map(|end| (end, false)),
        );
        // Of ends that are nearly equal the knot stays.
        ends.sort_by(|a, b| a.0.total_cmp(&b.0));
        ends.dedup_by(|next, last| {
            let equal = next.0 <= last.0 * (1.0 + 1e-6);
            if equal && next.1 && !last.1 {
                *last = *next;
            }
            equal
        });
        // From a knot on, the panels grow with the distance from it.
        let mut graded = Vec::with_capacity(2 * ends.len());
        let mut knot = None;
        for pair in ends.windows(2) {
            let ([(mut from, at_knot), (to, _)], mut root) = ([pair[0], pair[1]], pair[0].1);
            if at_knot {
                knot = Some(from);
            }
            while from < to {
                graded.push((from, root));
                from = match knot {
                    Some(knot) if root => to.min(knot + self.scale.min(knot)),
                    Some(knot) => to.min(2.0 * from - knot),
                    None => to,
                };
                root = false;
            }
        }
        graded.extend(ends.last());
        graded
    }

    /// Returns penetration and load of a thick film, in which the mean of the contact moves only.
    fn thick(&self, x: f64) -> Values {
        let (b, slope) = (self.transform.value(x), self.transform.slope(x));
        let mean = self.transform.integral(x) / x;
        let departure = self.field.medium.departure(x);
        let alpha = 1.0 + departure;
        Values {
            penetration: b + departure * (b - mean),
            // `delta0' = F0'/S`, and the load is that of a half-space.
            slope: slope * alpha,
            load: 2.0 * x * (b - mean),
        }
    }

    /// Returns penetration and load at a contact radius.
    fn values(&self, x: f64) -> Result<Values, Error> {
        let Some(first) = self.panels.first() else {
            return Ok(self.thick(x));
        };
        if x < first.from && first.from <= self.field.first() {
            return Ok(self.thick(x));
        }
        let beyond = self.panels.partition_point(|panel| panel.from <= x);
        let panel = &self.panels[beyond.max(1) - 1];
        let at = self.field.medium.at(x)?;
        let (b, slope) = (self.transform.value(x), self.transform.slope(x));
        let t = panel.position(x);
        let [own, rate] = evaluate(&panel.penetration, t);
        let [load, _] = evaluate(&panel.load, t);
        let [_, speed] = panel.radius(t);
        let penetration = b / at.gamma + own;
        let rate = if speed > 0.0 { rate / speed } else { 0.0 };
        Ok(Values {
            penetration,
            slope: (slope - at.growth * b) / at.gamma + rate,
            load: 2.0 * (x * at.eeq * penetration - load),
        })
    }

    /// Returns `int_0^a b' (dg1/ds)/Gamma ds` at contact radius `a`.
    fn integral(&self, a: f64) -> f64 {
        let field = &self.field;
        let blocks = field.ends();
        // Where blocks, or the slopes of the shape, begin.
        let mut ends = vec![0.0, a];
        ends.extend(
            blocks
                .iter()
                .map(|end| a - end)
                .filter(|&s| s > 0.0 && s < a),
        );
        ends.extend(
            blocks
                .iter()
                .map(|end| end - a)
                .filter(|&s| s > 0.0 && s < a),
        );
        let knots: Vec<f64> = self
            .transform
            .knots()
            .iter()
            .map(|knot| knot.radius)
            .collect();
        ends.extend(knots.iter().copied().filter(|&knot| knot > 0.0 && knot < a));
        ends.sort_by(f64::total_cmp);
        let begins = knots.first().copied().unwrap_or(0.0);
        let (mut sum, mut knot) = (0.0, 0.0);
        for pair in ends.windows(2) {
            let [mut from, to] = [pair[0], pair[1]];
            if from < begins || to - from <= 1e-15 * a {
                continue;
            }
            let is_knot = knots.contains(&from);
            if is_knot {
                knot = from;
            }
            while from < to {
                let first = from == knot && knot > 0.0;
                // From a knot on, the intervals grow with the distance from it.
                let distance = if first { knot } else { from - knot };
                let end = if knot == 0.0 && self.transform.is_analytic() {
                    to
                } else if from == 0.0 {
                    // A power that is no whole number: graded towards the tip.
                    to.min(a * 1e-6)
                } else {
                    to.min(from + distance)
                };
                let end = if to - end <= 1e-9 * a { to } else { end };
                let rule = &GAUSS[usize::from(first || end - from > SHORT * a)];
                for &[t, weight] in rule {
                    let part = 0.5 * (t + 1.0);
                    let length = end - from;
                    let (s, weight) = if first {
                        (from + length * part * part, weight * length * part)
                    } else {
                        (from + length * part, 0.5 * weight * length)
                    };
                    sum += weight * self.transform.slope(s) * field.slope(a, s);
                }
                from = end;
            }
        }
        sum
    }
}

/// Returns the contact radius at which the film begins to count; the largest one if it never does.
fn scale(field: &Field) -> Result<f64, Error> {
    for &end in &field.ends()[1..] {
        if end < field.last && field.medium.at(end)?.gamma.ln().abs() > BEGINS_TO_COUNT {
            return Ok(end);
        }
    }
    Ok(field.last)
}

/// Shifts the polynomial of a panel such that it begins with the value at the end of the last one.
fn continued(start: f64, mut polynomial: Polynomial) -> Polynomial {
    let [value, _] = evaluate(&polynomial, -1.0);
    polynomial[0] += start - value;
    polynomial
}

/// Returns the integral at the points of a panel, from its value at the beginning.
fn integrated(start: f64, rates: &[f64; POINTS]) -> [f64; POINTS] {
    CHEBYSHEV.integrals.map(|weights| {
        let sum: f64 = weights
            .iter()
            .zip(rates)
            .map(|(own, rate)| own * rate)
            .sum();
        start + sum
    })
}
