//! The elastic contact without adhesion as a function of the penetration: load, stiffness and
//! contact radius on pieces.
//!
//! On each piece the load is the cubic polynomial with the loads and the stiffnesses of its ends,
//! because the stiffness is the slope of the load. Near the first touch the load is nearly a power
//! of the penetration, and the pieces grow with the distance from there. A piece is halved until a
//! contact within it agrees with the polynomial.

use std::convert::Infallible;

use crate::{Contact, Error, root};
use interp::check::finite_result;

/// A contact radius with its elastic state.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Node {
    /// Contact radius, m.
    pub radius: f64,
    /// Penetration, m.
    pub penetration: f64,
    /// Load, N.
    pub load: f64,
    /// Stiffness `dF/d delta`, N/m.
    pub stiffness: f64,
    /// `d delta/da`.
    slope: f64,
}

/// The elastic contact up to a penetration.
#[derive(Clone, Debug)]
pub(super) struct ElasticCurve {
    /// From the first touch, where penetration and load are 0, to the largest contact.
    pub nodes: Vec<Node>,
    /// Whether the radius of a piece is a polynomial of the penetration, rather than the
    /// penetration one of the radius.
    inverted: Vec<bool>,
    /// The largest error of the load on the first piece, N.
    pub first_error: f64,
}

/// The part of the tolerance that the load of the smallest contact may have.
const FIRST: f64 = 0.1;
/// The factor of [`FIRST`] for each further halving.
const FINER: f64 = 0.1;
/// The error of the load on the first piece, on which it is taken to be a cubic polynomial, over the
/// load at its end, at most: 0.04 for a power of 3/2.
const BEND: f64 = 0.1;
/// The smallest largest load (N) that is followed: the loads of smaller contacts do not underflow.
const SMALLEST_LOAD: f64 = 1e-200;
/// The most halvings of a piece.
const DEPTH: u32 = 40;
/// The error in the middle of a piece over the largest one, at least.
const MIDDLE: f64 = 0.5;
/// A piece whose radii have a larger ratio is halved at the geometric mean, whatever its middle says.
const WIDE: f64 = 2.5;

/// The number of elements before any refinement.
const ELEMENTS: usize = 50;

/// The most steps of Newton's method on a piece, and the change of the place on it after which the
/// next one would be below rounding.
const NEWTON: usize = 8;
const CONVERGED: f64 = 1e-9;

/// Returns the value at `x` in `[0, 1]` of the cubic polynomial with values and slopes at the ends.
pub(super) fn hermite([f0, f1]: [f64; 2], [d0, d1]: [f64; 2], x: f64) -> f64 {
    let y = 1.0 - x;
    y * y * (f0 * (1.0 + 2.0 * x) + d0 * x) + x * x * (f1 * (1.0 + 2.0 * y) - d1 * y)
}

/// Returns the slope of [`hermite`].
fn hermite_slope([f0, f1]: [f64; 2], [d0, d1]: [f64; 2], x: f64) -> f64 {
    let y = 1.0 - x;
    6.0 * x * y * (f1 - f0) + d0 * y * (1.0 - 3.0 * x) + d1 * x * (1.0 - 3.0 * y)
}

impl ElasticCurve {
    /// Follows the elastic contact up to the contact radius `most` (m) with a tolerance relative to
    /// the largest load and radius, and halves each piece so found `halvings` more times, each of which leaves a
    /// sixteenth of its error.
    pub fn up_to(
        contact: &Contact,
        most: f64,
        tolerance: f64,
        halvings: u32,
    ) -> Result<Self, Error> {
        let last = node(contact, most)?;
        if last.load.is_nan() || last.load <= SMALLEST_LOAD {
            return Err(contact.outside("penetration", last.penetration));
        }
        let [least, _] = contact.search_range()?;
        let touch = first_touch(contact)?;
        let mut own = Self {
            nodes: vec![touch],
            inverted: Vec::new(),
            first_error: 0.0,
        };
        if touch.radius == 0.0 {
            let mut second = last;
            let part = FIRST * tolerance * FINER.powi(halvings as i32);
            while BEND * second.load > part * last.load && second.radius > least {
                second = node(contact, (0.25 * second.radius).max(least))?;
            }
            own.inverted.push(true);
            own.first_error = BEND * second.load;
            own.nodes.push(second);
        }
        own.refine(contact, last, &last, tolerance, [DEPTH, halvings])?;
        Ok(own)
    }

    /// Follows the elastic contact up to a penetration (m).
    pub fn to_penetration(
        contact: &Contact,
        penetration: f64,
        tolerance: f64,
        halvings: u32,
    ) -> Result<Self, Error> {
        let radius = radius_of(contact, "penetration", penetration, |node| node.penetration)?;
        Self::up_to(contact, radius, tolerance, halvings)
    }

    /// Adds the pieces from the last node to `end`, after at most `depth` halvings, and then `more`.
    fn refine(
        &mut self,
        contact: &Contact,
        end: Node,
        last: &Node,
        tolerance: f64,
        [depth, more]: [u32; 2],
    ) -> Result<(), Error> {
        let begin = self.nodes[self.nodes.len() - 1];
        if begin.radius >= end.radius {
            return Ok(());
        }
        let wide = begin.radius > 0.0 && end.radius > WIDE * begin.radius;
        let middle = if wide {
            (begin.radius * end.radius).sqrt()
        } else {
            0.5 * (begin.radius + end.radius)
        };
        let middle = node(contact, middle)?;
        let piece = [begin, end];
        let load = load_on(&piece, middle.penetration).0;
        let load_error = (load - middle.load).abs() / (MIDDLE * last.load);
        let radii = [false, true].map(|inverted| {
            let error = (radius_on(&piece, inverted, middle.penetration) - middle.radius).abs();
            if error.is_nan() {
                f64::INFINITY
            } else {
                error / (MIDDLE * last.radius)
            }
        });
        let inverted = radii[1] < radii[0];
        let radius_error = radii[0].min(radii[1]);
        if depth > 0 && (wide || load_error > tolerance || radius_error > tolerance) {
            self.refine(contact, middle, last, tolerance, [depth - 1, more])?;
            return self.refine(contact, end, last, tolerance, [depth - 1, more]);
        }
        if more > 0 {
            self.refine(contact, middle, last, f64::INFINITY, [0, more - 1])?;
            return self.refine(contact, end, last, f64::INFINITY, [0, more - 1]);
        }
        self.inverted.push(inverted);
        self.nodes.push(end);
        Ok(())
    }

    /// Returns the largest contact.
    pub fn last(&self) -> &Node {
        &self.nodes[self.nodes.len() - 1]
    }

    /// Returns the number of the piece that holds a penetration; the first or last one for a
    /// penetration outside.
    pub fn piece(&self, penetration: f64) -> usize {
        let above = self
            .nodes
            .partition_point(|node| node.penetration <= penetration);
        above.clamp(1, self.nodes.len() - 1) - 1
    }

    /// Returns load (N) and stiffness (N/m) at a penetration (m) on a piece; 0 before the first touch.
    pub fn load(&self, piece: usize, penetration: f64) -> (f64, f64) {
        if penetration < 0.0 {
            return (0.0, 0.0);
        }
        load_on(&[self.nodes[piece], self.nodes[piece + 1]], penetration)
    }

    /// Returns the second derivative of the load, N/m^2, at a penetration (m) on a piece; 0 before the
    /// first touch.
    pub fn bend(&self, piece: usize, penetration: f64) -> f64 {
        if penetration <= 0.0 {
            return 0.0;
        }
        let [begin, end] = [self.nodes[piece], self.nodes[piece + 1]];
        let length = end.penetration - begin.penetration;
        let x = (penetration - begin.penetration) / length;
        let rise = (end.load - begin.load) / length;
        ((6.0 - 12.0 * x) * rise
            - (4.0 - 6.0 * x) * begin.stiffness
            - (2.0 - 6.0 * x) * end.stiffness)
            / length
    }

    /// Returns the contact radius (m) at a penetration (m); 0 before the first touch.
    pub fn radius(&self, penetration: f64) -> f64 {
        if penetration <= 0.0 {
            return 0.0;
        }
        let piece = self.piece(penetration);
        let nodes = [self.nodes[piece], self.nodes[piece + 1]];
        if piece == 0 && nodes[0].radius == 0.0 {
            // The smallest contacts follow a power law.
            let power = nodes[1].penetration / (nodes[1].slope * nodes[1].radius);
            return nodes[1].radius * (penetration / nodes[1].penetration).powf(power);
        }
        radius_on(&nodes, self.inverted[piece], penetration)
    }
}

/// Returns load and stiffness on a piece.
fn load_on([begin, end]: &[Node; 2], penetration: f64) -> (f64, f64) {
    let length = end.penetration - begin.penetration;
    let x = (penetration - begin.penetration) / length;
    let loads = [begin.load, end.load];
    let slopes = [begin.stiffness * length, end.stiffness * length];
    (
        hermite(loads, slopes, x),
        hermite_slope(loads, slopes, x) / length,
    )
}

/// Returns the contact radius on a piece.
fn radius_on([begin, end]: &[Node; 2], inverted: bool, penetration: f64) -> f64 {
    let values = [begin.penetration, end.penetration];
    let length = end.radius - begin.radius;
    if inverted {
        let width = values[1] - values[0];
        let x = (penetration - values[0]) / width;
        return hermite(
            [begin.radius, end.radius],
            [width / begin.slope, width / end.slope],
            x,
        );
    }
    let slopes = [begin.slope * length, end.slope * length];
    let mut x = (penetration - values[0]) / (values[1] - values[0]);
    for _ in 0..NEWTON {
        let change = (hermite(values, slopes, x) - penetration) / hermite_slope(values, slopes, x);
        x -= change;
        if change.abs() < CONVERGED {
            return begin.radius + x * length;
        }
    }
    let f = |x: f64| Ok::<_, Infallible>(hermite(values, slopes, x) - penetration);
    let Ok(x) = root(f, 0.0, 1.0);
    begin.radius + x * length
}

/// Returns the elastic state at a contact radius (m).
pub(super) fn node(contact: &Contact, radius: f64) -> Result<Node, Error> {
    contact.mechanics().check_radius(radius)?;
    let (state, slopes) = contact.adhesionless_and_slopes(radius)?;
    Ok(Node {
        radius,
        penetration: finite_result(radius, state.penetration)?,
        load: finite_result(radius, state.load)?,
        stiffness: contact.stiffness(radius)?,
        slope: slopes.penetration / radius,
    })
}

/// Returns the contact radius (m) at which a quantity of the elastic state has a value.
pub(super) fn radius_of(
    contact: &Contact,
    name: &'static str,
    value: f64,
    quantity: impl Fn(&Node) -> f64,
) -> Result<f64, Error> {
    let range = contact.search_range()?;
    if quantity(&node(contact, range[1])?) < value {
        return Err(contact.outside(name, value));
    }
    radius_within(contact, range, value, quantity)
}

/// Returns the radius (m) between two others at which a quantity has a value.
pub(super) fn radius_within(
    contact: &Contact,
    [from, to]: [f64; 2],
    value: f64,
    quantity: impl Fn(&Node) -> f64,
) -> Result<f64, Error> {
    let f =
        |u: f64| Ok::<_, Error>(quantity(&node(contact, u.exp().clamp(from, to))?) / value - 1.0);
    let u = root(f, from.ln(), to.ln())?;
    Ok(u.exp().clamp(from, to))
}

/// Returns the radius (m) of the largest contact that a spring can make whose base is imposed, from the largest load (N) and
/// the largest penetration (m). Both bound the contact radius, and one may be out of range where the other is not.
pub(super) fn radius_on_spring(
    contact: &Contact,
    load: f64,
    penetration: f64,
) -> Result<f64, Error> {
    let by_load = radius_of(contact, "load", load, |node| node.load);
    let by_depth = radius_of(contact, "position of the spring", penetration, |node| {
        node.penetration
    });
    match (by_load, by_depth) {
        (Ok(a), Ok(b)) => Ok(a.min(b)),
        (Ok(a), Err(_)) => Ok(a),
        (Err(_), by_depth) => by_depth,
    }
}

/// Returns whether the probe has a flat end.
///
/// # Errors
/// [`Error::OutsideRadii`] if the end is narrower than the contacts of the curve.
pub(super) fn has_flat_end(contact: &Contact) -> Result<bool, Error> {
    let flat = contact.has_flat_end();
    if flat && !contact.begins_at_flat_end() {
        return Err(contact.outside("penetration", 0.0));
    }
    Ok(flat)
}

/// Returns the first touch: that of a flat end has the radius of the end.
fn first_touch(contact: &Contact) -> Result<Node, Error> {
    let [radius, _] = contact.search_range()?;
    if !has_flat_end(contact)? {
        return Ok(Node::default());
    }
    Ok(Node {
        penetration: 0.0,
        load: 0.0,
        ..node(contact, radius)?
    })
}

/// Returns the elastic states of elements from the first touch up to `most` (m), `refined` times as many as at first.
///
/// Their radii are equally spaced. Behind the rim of a flat end the penetration grows with the root of the distance from
/// there, and so does the number of the element.
pub(super) fn elements(contact: &Contact, most: f64, refined: usize) -> Result<Vec<Node>, Error> {
    let [smallest, _] = contact.search_range()?;
    let touch = first_touch(contact)?;
    let begin = touch.radius;
    let count = ELEMENTS * refined;
    let mut nodes = Vec::with_capacity(count + 1);
    nodes.push(touch);
    for i in 1..=count {
        let x = i as f64 / count as f64;
        let part = if begin > 0.0 { x * x } else { x };
        let radius = begin + (most - begin) * part;
        nodes.push(if radius >= smallest {
            node(contact, radius.min(most))?
        } else {
            smaller(&node(contact, smallest)?, radius / smallest)
        });
    }
    Ok(nodes)
}

/// Returns the elastic state at a part `x` of the radius of the smallest contact of a curve. Smaller contacts follow
/// a power law.
fn smaller(first: &Node, x: f64) -> Node {
    let power = first.slope * first.radius / first.penetration;
    let penetration = x.powf(power);
    Node {
        radius: first.radius * x,
        penetration: first.penetration * penetration,
        load: first.load * penetration * x,
        stiffness: first.stiffness * x,
        slope: first.slope * penetration / x,
    }
}

/// Returns the elastic state under a load (N) smaller than that of the smallest contact of a curve.
pub(super) fn smaller_under(first: &Node, load: f64) -> Node {
    let power = 1.0 + first.slope * first.radius / first.penetration;
    smaller(first, (load / first.load).powf(1.0 / power))
}
