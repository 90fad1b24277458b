//! Contacts on layers by direct solves.

use contact::Contact;
use interp::{HalfSpace, System};
use solve::stack::{MOST_A_OVER_TOP, Stack};
use solve::{A_OVER_T, Error, stack_curve};

use super::layered::{Cause, Layered, LayeredSolver, MARGIN, Reach};

/// The relative tolerance of the quantities. Differences of contacts, which stand for derivatives,
/// need a smaller one than a fit alone.
const TOLERANCE: f64 = 1e-8;

/// Where curves begin: the contact radius over the thickness of the top layer. It is so small that
/// no measured point is below.
const BEGIN: f64 = 1e-4;

/// The contact radius over the thickness of the top layer up to which curves go that may end
/// earlier. Wider contacts take much longer.
const OVER_TOP: f64 = 300.0;

/// Makes the contact of a probe on layers from direct solves: a `solver` of [`Layered`].
///
/// The quantities are within 1e-8, from contact radii of 1e-4 of the thickness of the top layer to
/// the expected reach of the contacts, or to 300 times the thickness of the top layer where that is
/// less, but at least to the reach that is needed.
///
/// ```
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// use std::sync::Arc;
///
/// use fit::{Bodies, Experiment, Free, Kind, Layered, Measurement, NamedLayer, Parameter, Point};
/// use fit::Reach;
/// use interp::{Elastic, Probe, Table};
/// use solve::stack::Layer;
///
/// // Radii (m) of a contact, and loads (N) that are to be fitted.
/// let radii = [5e-5, 7e-5, 9e-5, 1.1e-4, 1.3e-4];
/// let loads = [-1.825e-4, 3.92e-5, 6.480e-4, 1.7797e-3, 3.5612e-3];
/// let point = |(abscissa, ordinate)| Point { line: 0, abscissa, ordinate, direction: None };
/// let measurement = Measurement {
///     name: "lens.csv".into(),
///     kind: Kind::LoadRadius,
///     points: radii.into_iter().zip(loads).map(point).collect(),
/// };
/// let layer = |name: &str, modulus: f64, thickness: f64| {
///     let layer = Layer::bonded(Elastic::new(modulus, 0.5)?, thickness);
///     Ok::<_, fit::Error>(NamedLayer { name: Some(name.parse()?), layer })
/// };
/// let probe = Probe::Paraboloid { radius: 1e-3 };
/// let bodies = Bodies::Layered(Layered {
///     reach: Reach::of(&measurement, &probe),
///     probe,
///     sphere_modulus: 2e6,
///     base: Elastic::new(2e11, 0.25)?,
///     layers: vec![layer("primer", 5e5, 2.5e-6)?, layer("film", 3.5e6, 7.5e-6)?],
///     solver: Arc::new(fit::DirectSolver),
/// });
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
/// # Errors
/// Those of [`Stack::new`], with the name of the layer, of [`stack_curve`] and of
/// [`Contact::new`](contact::Contact::new).
#[derive(Clone, Copy, Debug)]
pub struct DirectSolver;

impl LayeredSolver for DirectSolver {
    fn contact(&self, layered: &Layered) -> Result<Contact, Cause> {
        if layered.layers.is_empty() {
            // The base alone, as a reference sample.
            return Ok(Contact::half_space(&HalfSpace {
                probe: layered.probe.clone(),
                sphere_modulus: layered.sphere_modulus,
                solid: layered.base,
            })?);
        }
        let stack = stack_of(layered)?;
        let (thickness, top) = (stack.thickness(), stack.top().thickness);
        let Reach { needed, expected } = layered.reach;
        let [usual, most] = [OVER_TOP, MOST_A_OVER_TOP].map(|over| stack.reach(over) * thickness);
        // What is needed holds a margin, which need not be solved.
        let end = needed
            .min(most.max(needed / MARGIN))
            .max(expected.min(usual));
        let begin = (BEGIN * top / thickness).max(A_OVER_T[0]);
        let range = [begin, end / thickness];
        let curve = stack_curve(&stack, layered.sphere_modulus, range, TOLERANCE)?;
        Ok(Contact::new(&system_on(layered, &stack), curve)?)
    }
}

/// Returns the layers as a stack.
///
/// # Errors
/// Those of [`Stack::new`], with the name of the layer.
pub fn stack_of(layered: &Layered) -> Result<Stack, Cause> {
    layered.stack().map_err(|error| named(layered, error))
}

/// Returns the probe on the layers as a system.
pub fn system_on(layered: &Layered, stack: &Stack) -> System {
    System {
        probe: layered.probe.clone(),
        ..stack.system(1.0, layered.sphere_modulus)
    }
}

/// Adds the name of the layer to the error of a layer.
fn named(layered: &Layered, error: Error) -> Cause {
    match error {
        Error::Layer {
            layer, ref what, ..
        } => match layered.layers[layer - 1].name {
            Some(name) => format!("layer {name}: {what}").into(),
            None => error.into(),
        },
        error => error.into(),
    }
}
