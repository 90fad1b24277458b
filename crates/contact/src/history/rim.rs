//! The rim of the contact between two elements, and the load within it.
//!
//! Where the contact grows the gap outside is smooth, and the stress inside is a power of the distance from the rim.
//! Where it recedes the moments of release are smooth.

use super::elements::Elements;
use super::memory::{Memory, Step};

/// The number of elements next to the rim between which the stress is a power of the distance.
const NEAR: usize = 16;

impl Elements<'_> {
    /// Returns load (N), an estimate of the stiffness (N/m) and contact radius (m) at a penetration (m).
    pub(super) fn load(
        &self,
        memory: &Memory,
        step: &Step<'_>,
        penetration: f64,
    ) -> (f64, f64, f64) {
        let k = self.nodes.len();
        let (held, touching) = self.inside(memory, step, penetration);
        let n = held + touching.len();
        if n == 0 {
            return (0.0, 0.0, 0.0);
        }
        let inside = |i: usize| {
            let touches = i.checked_sub(held).map(|i| touching[i]);
            touches.unwrap_or_else(|| self.stress(memory, step, i, penetration))
        };
        let radius = self.rim(memory, step, penetration, n, &inside);
        // Below the radius of a flat end all elements are one.
        let mut load = inside(0) * self.nodes[0].stiffness;
        let summed = n.saturating_sub(NEAR).min(held.saturating_sub(1));
        let stiffness = self.nodes[summed].stiffness - self.nodes[0].stiffness;
        load += step.w * (penetration * stiffness - memory.sums[summed]);
        for i in summed..n - 1 {
            let rise = self.nodes[i + 1].stiffness - self.nodes[i].stiffness;
            let [far, near] = [i, i + 1].map(|i| radius - self.nodes[i].radius);
            let ends = [inside(i), inside(i + 1)];
            load += rise
                * if i + NEAR < n {
                    0.5 * (ends[0] + ends[1])
                } else {
                    mean_of_power(ends, [far, near])
                };
        }
        let mut stiffness = self.nodes[n - 1].stiffness;
        if n < k {
            let [last, next] = [&self.nodes[n - 1], &self.nodes[n]];
            let part = (radius - last.radius) / (next.radius - last.radius);
            let rise = part * (next.stiffness - last.stiffness);
            let exponent = if n > 1 {
                let distances = [n - 2, n - 1].map(|i| radius - self.nodes[i].radius);
                power([inside(n - 2), inside(n - 1)], distances).clamp(0.0, 3.0)
            } else {
                1.0
            };
            load += rise * inside(n - 1) / (1.0 + exponent);
            stiffness += rise;
        }
        (load, step.w * stiffness, radius)
    }

    /// Returns the contact radius (m), where the stress falls to 0 (a contact that recedes) or the gap outside ends
    /// (a contact that grows). `inside` has the stresses of the first `n` elements, which are in contact.
    fn rim(
        &self,
        memory: &Memory,
        step: &Step<'_>,
        penetration: f64,
        n: usize,
        inside: &impl Fn(usize) -> f64,
    ) -> f64 {
        let k = self.nodes.len();
        if n == k {
            return self.nodes[k - 1].radius;
        }
        let gap = |i: usize| self.nodes[i].penetration + memory.free[i] - penetration;
        let before = memory.psi[n] + self.nodes[n].penetration - memory.penetration;
        let grows = memory.stress[n] == 0.0 && gap(n) < before;
        let points: Vec<[f64; 2]> = if grows {
            // Beyond the last element as if the dent were as deep there, which is exact where there has been no contact.
            let last = n.min(k - 3);
            let deeper = gap(n) - self.nodes[n].penetration;
            (0..3)
                .map(|j| {
                    let i = last + j;
                    let own = &self.nodes[i];
                    [
                        own.radius,
                        if i < n {
                            own.penetration + deeper
                        } else {
                            gap(i)
                        },
                    ]
                })
                .collect()
        } else if n == 1 {
            vec![
                [self.nodes[0].radius, inside(0)],
                [self.nodes[1].radius, -step.w * gap(1)],
            ]
        } else {
            (n.saturating_sub(3)..n)
                .rev()
                .map(|i| [self.nodes[i].radius, inside(i)])
                .collect()
        };
        let ends = [self.nodes[n - 1].radius, self.nodes[n].radius];
        let receding = if grows {
            None
        } else {
            self.receding(memory, step, penetration, n, inside)
        };
        receding
            .unwrap_or_else(|| zero(&points))
            .clamp(ends[0], ends[1])
    }

    /// Returns the contact radius (m) at the end of a step at which the contact recedes, from the moments at which the
    /// outermost elements will be released if the step goes on; `None` if they will not be.
    fn receding(
        &self,
        memory: &Memory,
        step: &Step<'_>,
        penetration: f64,
        n: usize,
        inside: &impl Fn(usize) -> f64,
    ) -> Option<f64> {
        let first = n.checked_sub(3)?;
        let mut points = [[0.0; 2]; 3];
        for (point, i) in points.iter_mut().zip((first..n).rev()) {
            if memory.stress[i] <= 0.0 {
                return None;
            }
            let after = self.imposed(memory, step, i, penetration);
            *point = [
                self.nodes[i].radius,
                release_after(|part| after(part).0, [memory.stress[i], inside(i)])? - 1.0,
            ];
        }
        let rises = points[0][1] < points[1][1] && points[1][1] < points[2][1];
        rises.then(|| zero(&points))
    }
}

/// Returns the part of a step, 1 or more, after which a falling function is 0, from its values at the begin and the end.
fn release_after(f: impl Fn(f64) -> f64, [begin, end]: [f64; 2]) -> Option<f64> {
    /// The most steps of the secant method, and the longest time, in steps, that is looked ahead.
    const MOST: usize = 30;
    const FARTHEST: f64 = 1e3;
    const CLOSE: f64 = 1e-9;
    let (mut before, mut here) = ([0.0, begin], [1.0, end]);
    for _ in 0..MOST {
        let slope = (here[1] - before[1]) / (here[0] - before[0]);
        let next = here[0] - here[1] / slope;
        if slope >= 0.0 || !(0.0..=FARTHEST).contains(&next) {
            return None;
        }
        if (next - here[0]).abs() <= CLOSE * next {
            return Some(next);
        }
        (before, here) = (here, [next, f(next)]);
    }
    None
}

/// Returns the exponent of the power of the distance from the rim that has two values.
fn power([a, b]: [f64; 2], [far, near]: [f64; 2]) -> f64 {
    (a / b).ln() / (far / near).ln()
}

/// Returns the mean of this power between the two distances.
fn mean_of_power(values: [f64; 2], distances: [f64; 2]) -> f64 {
    /// The exponents for which it is one. Others are those of values that do not fall towards the rim.
    const POWERS: std::ops::RangeInclusive<f64> = 0.0..=3.0;
    let [[a, b], [far, near]] = [values, distances];
    let power = power(values, distances);
    if POWERS.contains(&power) {
        (a * far - b * near) / ((1.0 + power) * (far - near))
    } else {
        0.5 * (a + b)
    }
}

/// Returns the zero next to the first of two or three points of the polynomial through them.
fn zero(points: &[[f64; 2]]) -> f64 {
    let slope = |a: [f64; 2], b: [f64; 2]| (b[1] - a[1]) / (b[0] - a[0]);
    let first = slope(points[0], points[1]);
    let bend = points.get(2).map_or(0.0, |third| {
        (slope(points[1], *third) - first) / (third[0] - points[0][0])
    });
    let [[x0, y0], [x1, _]] = [points[0], points[1]];
    // y0 + b u + bend u^2 with u = x - x0
    let b = first + bend * (x0 - x1);
    let root = (b * b - 4.0 * bend * y0).max(0.0).sqrt();
    x0 - 2.0 * y0 / (b + root.copysign(b))
}
