//! The ways in which contacts are made.

use std::mem::discriminant;
use std::sync::Arc;

use contact::Contact;
use interp::{Curve, Probe, System, Table};
use solve::stack::{MOST_A_OVER_TOP, Stack};
use solve::stick::{MOST_OF_TIP, StickCurves, Sticking};
use solve::{A_OVER_T, stack_curve};

use super::{Bodies, Kind, Measurement};
use crate::Error;
use crate::statistics::extremes;

/// The relative tolerance of the quantities that are solved for. Differences of contacts, which stand
/// for derivatives, need a smaller one than a fit alone.
const TOLERANCE: f64 = 1e-8;

/// Where solved curves begin: the contact radius over the thickness of the top layer. It is so small
/// that no measured point is below.
const BEGIN: f64 = 1e-4;

/// The contact radius over the thickness of the top layer up to which curves go that may end earlier.
/// Wider contacts take much longer.
const OVER_TOP: f64 = 300.0;

/// The factor by which the largest contact radius at a measured radius is exceeded, so that the
/// slopes there are known.
const MARGIN: f64 = 1.2;

/// How far the curve of a shape that is integrated over it reaches, over the largest contact radius.
const BEYOND: f64 = 1.5;

/// The contact radius over `sqrt(R D)` that no contact is expected to exceed on the way `D`, the
/// range of the penetrations or heights. Of a thin incompressible layer on a rigid base without
/// adhesion it is 2; JKR's contact at the end of a pull to the pull-off has 1.5.
const WIDEST: f64 = 3.0;

/// Up to which contact radii the contacts on layers are needed, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    /// Contacts as wide as this one are needed.
    pub needed: f64,
    /// No contact is expected to be wider than this one. Contacts are computed so far where that
    /// takes no long time.
    pub expected: f64,
}

impl Reach {
    /// Returns the reach up to a contact radius, m.
    pub(crate) const fn up_to(needed: f64) -> Self {
        let expected = needed;
        Self { needed, expected }
    }

    /// Returns the reach that a measurement needs under a probe.
    ///
    /// At measured contact radii it is a little more than the largest of them. Against penetrations
    /// or heights it is estimated from their range and from the radius of the probe.
    /// A flat punch has one contact radius.
    pub fn of(measurement: &Measurement, probe: &Probe) -> Self {
        if let Probe::FlatPunch { radius } = probe {
            return Self::up_to(MARGIN * radius);
        }
        let [least, most] = extremes(measurement.points.iter().map(|point| point.abscissa));
        let largest = probe.radius().unwrap_or(f64::INFINITY);
        match measurement.kind {
            Kind::LoadRadius | Kind::PenetrationRadius | Kind::StiffnessRadius => {
                Self::up_to((MARGIN * most).min(largest))
            }
            // What they need depends on the hardness and the area function: see
            // `Experiment::reach_contacts`.
            Kind::StiffnessLoad | Kind::StiffnessDepth => Self::up_to(0.0),
            Kind::LoadPenetration | Kind::ForceHeight => Self {
                needed: 0.0,
                expected: (WIDEST * (largest * (most - least)).sqrt()).min(largest),
            },
        }
    }
}

/// How contacts are made.
///
/// ```
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// use fit::{Bodies, Experiment, Free, Kind, Measurement, NamedLayer, Numbering, Parameter, Point};
/// use interp::{Elastic, HalfSpace, Probe, Table};
/// use solve::stack::Layer;
///
/// // Radii (m) of a contact, and loads (N) that are to be fitted.
/// let radii = [5e-5, 7e-5, 9e-5, 1.1e-4, 1.3e-4];
/// let loads = [-1.825e-4, 3.92e-5, 6.480e-4, 1.7797e-3, 3.5612e-3];
/// let point = |(abscissa, ordinate)| Point { line: 0, abscissa, ordinate, direction: None };
/// let measurement = Measurement {
///     name: "lens.csv".into(),
///     kind: Kind::LoadRadius,
///     numbering: Numbering::Lines,
///     points: radii.into_iter().zip(loads).map(point).collect(),
/// };
/// let layer = |name: &str, modulus: f64, thickness: f64| {
///     let layer = Layer::bonded(Elastic::new(modulus, 0.5)?, thickness);
///     Ok::<_, fit::Error>(NamedLayer { name: Some(name.parse()?), layer })
/// };
/// let probe = Probe::Paraboloid { radius: 1e-3 };
/// let base = HalfSpace { probe, sphere_modulus: 2e6, solid: Elastic::new(2e11, 0.25)? };
/// let bodies = Bodies {
///     layers: vec![layer("primer", 5e5, 2.5e-6)?, layer("film", 3.5e6, 7.5e-6)?],
///     ..Bodies::bare(&measurement, base)
/// };
/// let free: [Parameter; 2] = ["sphere-modulus".parse()?, "work-of-adhesion".parse()?];
/// let found = fit::fit(
///     Table::embedded(), // no contact on layers needs it
///     &[Experiment::new(measurement, bodies)],
///     &free.map(Free::new),
///     &fit::Options::default(),
/// )?;
/// let modulus = found.estimate(Parameter::SphereModulus).expect("it is free");
/// assert!((modulus.value / 2e6 - 1.0).abs() < 0.01);
/// # Ok(()) }
/// ```
///
#[derive(Clone, Debug)]
pub enum Solver {
    /// By lookups in the table of the fit, with exact derivatives: a film that is bonded to its substrate.
    Film,
    /// In closed form, with exact derivatives: a half-space, which has the parameters of a film.
    HalfSpace,
    /// By direct solves of layers without friction; without layers as a half-space.
    ///
    /// The quantities are within 1e-8, from contact radii of 1e-4 of the thickness of the top layer to
    /// the expected reach of the contacts, or to 300 times the thickness of the top layer where that is
    /// less, but at least to the reach that is needed.
    Direct,
    /// By direct solves of a sphere that sticks to the layers with full friction. A film is a single
    /// layer without a name.
    ///
    /// Points stick when they are touched. The work of adhesion of the experiment is the one with which
    /// the contact recedes; it has grown with `advancing` times this work, and a fit that finds the work
    /// keeps the ratio. The quantities are within 1e-8, up to contact radii of 30 times the thickness of
    /// the top layer. Dundurs' beta of sphere and top layer must be 0:
    /// [`Sticking::grown`](solve::stick::Sticking::grown).
    Stick {
        /// The Poisson ratio of the sphere; a rigid sphere needs none.
        sphere_poisson_ratio: f64,
        /// The work of adhesion with which the contact has grown over that with which it recedes, 0 to
        /// 1: 1 is a contact with one work of adhesion, 0 one that was pressed on without attraction.
        /// Below 1 the states are those of a contact that recedes, and no approach is described.
        advancing: f64,
    },
    /// By lookups in a table of these layers, which cannot vary. `tabulate::table::stack_of` tells the
    /// stack of a table; that both belong together is not checked here.
    Table {
        /// The layers of the table.
        stack: Stack,
        /// The table.
        table: Arc<Table>,
    },
}

impl PartialEq for Solver {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (
                Self::Stick {
                    sphere_poisson_ratio,
                    advancing,
                },
                Self::Stick {
                    sphere_poisson_ratio: of,
                    advancing: other,
                },
            ) => (sphere_poisson_ratio, advancing) == (of, other),
            (
                Self::Table { stack, table },
                Self::Table {
                    stack: of,
                    table: other,
                },
            ) => stack == of && Arc::ptr_eq(table, other),
            _ => discriminant(self) == discriminant(other),
        }
    }
}

impl Solver {
    /// Returns why no modulus or thickness of a layer can be free, if none can.
    pub(crate) const fn why_layers_are_fixed(&self) -> Option<&'static str> {
        match self {
            Self::Table { .. } => Some(ONE_STACK),
            _ => None,
        }
    }
}

/// Why the layers of a table cannot vary.
const ONE_STACK: &str = "its table is of one stack. To vary a layer, do without the table: name a stack \
    file, or solve the layers directly";

/// Makes the contact of a probe on layers.
pub(super) fn on_layers(bodies: &Bodies) -> Result<Contact, Error> {
    let stack = stack_of(bodies)?;
    let system = System {
        probe: bodies.probe.clone(),
        ..stack.system(1.0, bodies.sphere_modulus)
    };
    Ok(Contact::new(&system, curve(bodies, &stack)?)?)
}

fn curve(bodies: &Bodies, stack: &Stack) -> Result<Curve, Error> {
    let (thickness, top) = (stack.thickness(), stack.shape().top);
    let Reach { needed, expected } = bodies.reach;
    Ok(match &bodies.solver {
        Solver::Direct => {
            let probe = &bodies.probe;
            let is_integrated = !probe.is_paraboloid() && !probe.is_flat_punch();
            let beyond = if is_integrated { BEYOND } else { 1.0 };
            let reach = |over_top: f64| stack.reach(over_top) * thickness / beyond;
            let [usual, most] = [OVER_TOP, MOST_A_OVER_TOP].map(reach);
            // What is needed holds a margin, which need not be solved.
            let end = needed
                .min(most.max(needed / MARGIN))
                .max(expected.min(usual));
            let range = [
                (BEGIN * stack.top().thickness / thickness).max(A_OVER_T[0]),
                beyond * end / thickness,
            ];
            stack_curve(stack, bodies.sphere_modulus, range, TOLERANCE)?
        }
        &Solver::Stick {
            sphere_poisson_ratio,
            advancing,
        } => {
            let (widest, most) = (needed / MARGIN, MOST_OF_TIP * top * thickness);
            if widest > most {
                return Err(Error::NotFitted(format!(
                    "contact radii reach {widest:.4e} m, and with full friction contacts are solved up to {MOST_OF_TIP} times \
                     the thickness of the film or top layer, {most:.4e} m: leave out wider contacts, or take contacts without \
                     friction"
                )));
            }
            let end = (needed.max(expected) / thickness).min(MOST_OF_TIP * top);
            let sticking = Sticking::on_stack(stack, bodies.sphere_modulus, sphere_poisson_ratio)?;
            let range = [(BEGIN * top).min(0.1 * end), end];
            StickCurves::new(&sticking, range, TOLERANCE)?.receding(advancing)?
        }
        Solver::Table { stack: of, table } => {
            if of != stack {
                return Err(Error::OtherLayers(ONE_STACK));
            }
            stack.curve_in(table, bodies.sphere_modulus)?
        }
        Solver::Film | Solver::HalfSpace => {
            return Err(Error::NotFitted(
                "the layers are not one bonded film without a name, which the table of a fit has: solve them directly"
                    .into(),
            ));
        }
    })
}

/// Returns the layers as a stack. An error has the name of the layer.
fn stack_of(bodies: &Bodies) -> Result<Stack, Error> {
    bodies.stack().map_err(|error| match error {
        solve::Error::Layer {
            layer, ref what, ..
        } => match bodies.layers[layer - 1].name {
            Some(name) => Error::Layer {
                name,
                what: what.clone(),
            },
            None => error.into(),
        },
        error => error.into(),
    })
}
