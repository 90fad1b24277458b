//! The contact of any shape on a film, from the field of the flat punch.
//!
//! With the [field](super::field) and the [transform](super::transform) `b` of the shape,
//!
//! ```text
//! delta0' = (es/Gamma) [b'(a) - int_0^a b'(s) (dg1/ds)/Gamma ds]
//!         = (es/Gamma) [b'(0) g1(0)/Gamma + int_0^a b''(s) g1/Gamma ds]
//! ```
//!
//! (the second line is the form of `curve/even_powers/mod.rs`, the first one is that integrated by
//! parts). The first line is used where `Gamma` grows, the second one where it falls: so all terms
//! are positive. On the first interval of the second line the integral is that of `g1` less its
//! value where the contact begins, at the tip or at the edge of a flat end, because `b''` is
//! infinite there. The results are stored as
//!
//! ```text
//! delta0 = (es/Gamma) b + J          J' = delta0' - [(es/Gamma) b]'
//! F0 = S delta0 - 2 E* M             M' = Gamma^2/es delta0
//! ```
//!
//! with `J` and `M` as polynomials on panels: both are smoother than the shape. At the radius of a
//! knot of the shape they behave like powers of `sqrt(a - m)`. A panel that begins there is a
//! polynomial in this root, and the following ones grow from there by doubling. Under a power law
//! `b = s^n` the polynomials are those of `J/a^n` and `M/a^(n+1)`, and the powers are integrated
//! exactly, so that a large exponent costs no accuracy.

use std::sync::{Arc, OnceLock};

use super::field::Field;
use super::medium::Medium;
use super::polynomial::{CHEBYSHEV, GAUSS, POINTS, Polynomial, evaluate};
use super::transform::Transform;
use interp::{Curve, Error, Parameter};

/// The departure of `ln Gamma` from its limit at which a film begins to count.
const BEGINS_TO_COUNT: f64 = 0.1;
/// Intervals shorter than this part of the contact radius need fewer points.
const SHORT: f64 = 0.02;
/// The part of the contact radius up to which a power that is no whole number is integrated over the
/// root of the radius.
const TIP: f64 = 0.05;
/// The step of the differences for derivatives. Their error is of the order of its square.
const STEP: f64 = 1e-4;
/// The number of derivatives: with respect to the four parameters of the material, and the size of
/// the shape.
const DERIVATIVES: usize = 5;
/// The number of the derivative with respect to the size of the shape.
pub(super) const SIZE: usize = 4;

/// A shape on a film. Lengths are in units of the film's thickness.
#[derive(Clone, Debug)]
pub(crate) struct Solved {
    own: Solution,
    /// The factor of the shape.
    factor: f64,
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
        let (transform, factor) = transform.normalised();
        Ok(Self {
            own: Solution::new(field.clone(), transform, scale(&field)?)?,
            factor,
            changed: Arc::default(),
        })
    }

    /// Returns the largest contact radius.
    pub(super) fn last(&self) -> f64 {
        self.own.field.last
    }

    /// Returns the transform of the shape over its factor.
    pub(super) const fn transform(&self) -> &Transform {
        &self.own.transform
    }

    pub(super) fn values(&self, x: f64) -> Result<Values, Error> {
        let Values {
            penetration,
            slope,
            load,
        } = self.own.values(x)?;
        Ok(Values {
            penetration: self.factor * penetration,
            slope: self.factor * slope,
            load: self.factor * load,
        })
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
        let factor = self.factor / (2.0 * STEP);
        Ok([
            factor * (more.penetration - less.penetration),
            factor * (more.load - less.load),
        ])
    }
}

/// The solution of one shape on one material.
#[derive(Clone, Debug)]
struct Solution {
    field: Arc<Field>,
    transform: Transform,
    /// [`Transform::order`].
    order: f64,
    /// The contact radius at which the film begins to count.
    scale: f64,
    panels: Vec<Panel>,
}

/// `J/a^n` and `M/a^(n+1)` on an interval of contact radii, with the [order](Transform::order) `n`;
/// `J` and `M` if it is 0.
#[derive(Clone, Copy, Debug)]
struct Panel {
    from: f64,
    to: f64,
    /// Whether the polynomials are in the root of the distance from the beginning.
    root: bool,
    penetration: Polynomial,
    /// `J'/a^(n-1)` or `J'`. The derivative of the polynomial of `J` would lose its digits where a
    /// panel begins in a root.
    rate: Polynomial,
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

    /// Returns the integral of `x^(degree - 1)` times a rate, from its value at the beginning: over
    /// `x^degree` at the points, as a polynomial, and at the end. The `nodes` are the contact radius,
    /// its derivative with respect to the position, and the rate. If the degree is 0, the rate has
    /// no factor.
    fn integrated(
        &self,
        degree: f64,
        start: f64,
        nodes: &[[f64; 3]; POINTS],
    ) -> ([f64; POINTS], Polynomial, f64) {
        let points = &*CHEBYSHEV;
        let sum = |weights: &[f64; POINTS], factor: f64| {
            let terms = weights.iter().zip(nodes);
            terms
                .map(|(weight, [_, speed, rate])| {
                    weight * rate * if degree > 0.0 { factor } else { *speed }
                })
                .sum::<f64>()
        };
        let (values, last): ([f64; POINTS], f64);
        if degree > 0.0 {
            let weights = points.weighted([self.from, self.to], degree - 1.0);
            let at = |x: f64, weights| start * (self.from / x).powf(degree) + sum(weights, 1.0 / x);
            values = std::array::from_fn(|k| at(nodes[k][0], &weights[k]));
            last = at(self.to, &weights[POINTS]);
        } else {
            values = points
                .integrals
                .each_ref()
                .map(|weights| start + sum(weights, 1.0));
            last = start + sum(&points.whole, 1.0);
        }
        let mut polynomial = points.through(&values);
        if degree == 0.0 {
            // The polynomial begins exactly with the value at the end of the last panel.
            let [value, _] = evaluate(&polynomial, -1.0);
            polynomial[0] += start - value;
        }
        (values, polynomial, last)
    }
}

/// What is needed at a point of a panel.
#[derive(Clone, Copy, Debug, Default)]
struct Node {
    /// The contact radius, and its derivative with respect to the position.
    x: f64,
    speed: f64,
    /// `Gamma/es`.
    gamma: f64,
    /// `b/x^n`, and `J'/x^(n-1)` or `J'`.
    b: f64,
    rate: f64,
}

impl Solution {
    fn new(field: Arc<Field>, transform: Transform, scale: f64) -> Result<Self, Error> {
        let order = transform.order();
        let mut solution = Self {
            field,
            transform,
            order,
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
            let power = first.powf(order);
            penetration = (thick.penetration - solution.transform.value(first) / at.gamma) / power;
            load = (first * at.eeq * thick.penetration - 0.5 * thick.load) / (power * first);
            if order == 0.0 {
                load *= first;
            }
        }
        let mut breaks = Vec::new();
        for pair in ends.windows(2) {
            let mut panel = Panel {
                from: pair[0].0,
                to: pair[1].0,
                root: pair[0].1,
                penetration: [0.0; POINTS],
                rate: [0.0; POINTS],
                load: [0.0; POINTS],
            };
            let mut nodes = [Node::default(); POINTS];
            for (node, &t) in nodes.iter_mut().zip(&CHEBYSHEV.at) {
                let [x, speed] = panel.radius(t);
                let (at, b) = (solution.field.medium.at(x)?, solution.transform.value(x));
                let flux = solution.flux(x, &mut breaks) - solution.transform.slope(x);
                let rate = (flux + at.growth * b) / at.gamma;
                *node = Node {
                    x,
                    speed,
                    gamma: at.gamma,
                    b: b / x.powf(order),
                    rate: rate / x.powf((order - 1.0).max(0.0)),
                };
            }
            panel.rate = CHEBYSHEV.through(&nodes.map(|node| node.rate));
            let own;
            (own, panel.penetration, penetration) = panel.integrated(
                order,
                penetration,
                &nodes.map(|node| [node.x, node.speed, node.rate]),
            );
            let rate = |k: usize| {
                let Node {
                    x, speed, gamma, b, ..
                } = nodes[k];
                [x, speed, gamma * (b + gamma * own[k])]
            };
            let degree = if order > 0.0 { order + 1.0 } else { 0.0 };
            (_, panel.load, load) = panel.integrated(degree, load, &std::array::from_fn(rate));
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
        let [[own, _], [rate, _], [load, _]] =
            [panel.penetration, panel.rate, panel.load].map(|of| evaluate(&of, t));
        let power = x.powf(self.order);
        let rate = if self.order > 0.0 {
            power / x * rate
        } else {
            rate
        };
        let penetration = b / at.gamma + power * own;
        let load = if self.order > 0.0 { power * x } else { 1.0 } * load;
        Ok(Values {
            penetration,
            slope: (slope - at.growth * b) / at.gamma + rate,
            load: 2.0 * (x * at.eeq * penetration - load),
        })
    }

    /// Returns `Gamma/es delta0'` at contact radius `a`. `ends` is a place for the ends of the
    /// intervals.
    fn flux(&self, a: f64, ends: &mut Vec<f64>) -> f64 {
        let Self {
            field, transform, ..
        } = self;
        let knots = transform.knots();
        let begins = knots.first().map_or(0.0, |knot| knot.radius);
        let inside = |s: &f64| *s > begins && *s < a;
        ends.clear();
        ends.extend([begins, a]);
        // Where blocks begin in `a - s` and in `a + s`, and the bends of the shape.
        let of_blocks = field.ends().iter().flat_map(|end| [a - end, end - a]);
        ends.extend(of_blocks.filter(inside));
        ends.extend(knots.iter().map(|knot| knot.radius).filter(inside));
        ends.sort_by(f64::total_cmp);
        let mut sum = if field.falls { 0.0 } else { transform.slope(a) };
        let (mut knot, mut next_knot) = (0.0, 0);
        for pair in ends.windows(2) {
            let [mut from, to] = [pair[0], pair[1]];
            if to - from <= 1e-15 * a {
                continue;
            }
            while next_knot < knots.len() && knots[next_knot].radius <= from {
                knot = knots[next_knot].radius;
                next_knot += 1;
            }
            let graded = knot > 0.0 || !transform.is_analytic();
            while from < to {
                let root = graded && from == knot;
                // From a knot on, the intervals grow with the distance from it.
                let end = match (root, graded) {
                    (_, false) => to,
                    (true, _) if knot == 0.0 => to.min(TIP * a),
                    (true, _) => to.min(2.0 * knot),
                    (false, _) => to.min(2.0 * from - knot),
                };
                let end = if to - end <= 1e-9 * a { to } else { end };
                // The integrand is infinite where the contact begins unless `g1` there is taken off.
                let mut taken = 0.0;
                if field.falls && from == begins {
                    taken = field.at(a, begins);
                    sum += transform.slope(end) * taken;
                }
                let rule = &GAUSS[usize::from(root || end - from > SHORT * a)];
                for &[t, weight] in rule {
                    let part = 0.5 * (t + 1.0);
                    let length = end - from;
                    let (s, weight) = if root {
                        (from + length * part * part, weight * length * part)
                    } else {
                        (from + length * part, 0.5 * weight * length)
                    };
                    if field.falls {
                        let curvature = transform.curvature(s);
                        if curvature != 0.0 {
                            sum += weight * curvature * (field.at(a, s) - taken);
                        }
                    } else {
                        sum -= weight * transform.slope(s) * field.at(a, s);
                    }
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
