//! The parameters of fits and what is known of them, by their names in Python.

use fit::{Fixed, Free, LayerQuantity, Parameter, Scope};
use pyo3::prelude::*;

use crate::error::{Failure, OrRaise as _};

/// A free parameter, as the attributes of the Python class.
#[derive(FromPyObject)]
pub struct GivenFree {
    parameter: String,
    start: Option<f64>,
    bounds: Option<[f64; 2]>,
    prior: Option<[f64; 2]>,
    own: Option<bool>,
}

/// Makes the free parameters.
pub fn frees(py: Python<'_>, given: Vec<GivenFree>) -> PyResult<Vec<Free>> {
    let one = |given: GivenFree| {
        let parameter = parameter(&given.parameter)?;
        let mut free = Free {
            start: given.start,
            bounds: given.bounds,
            ..Free::new(parameter)
        };
        if let Some([mean, width]) = given.prior {
            free = free.with_prior(mean, width);
        }
        if let Some(own) = given.own {
            free = free.with_scope(if own { Scope::Own } else { Scope::Shared });
        }
        Ok(free)
    };
    let all: Result<_, fit::Error> = given.into_iter().map(one).collect();
    all.or_raise(py)
}

/// Returns the value taken as given that has a name in Python. A layer keeps its name as it is.
pub fn fixed(py: Python<'_>, name: &str) -> PyResult<Fixed> {
    let plain = Fixed::parse(&name.replace('_', "-"));
    let plain =
        plain.filter(|one| !matches!(one, Fixed::Parameter(_) | Fixed::NamedPoissonRatio(_)));
    let of_layer = || {
        let layer = name.strip_suffix(".poisson_ratio")?.parse().ok()?;
        Some(Fixed::NamedPoissonRatio(layer))
    };
    let found = plain
        .or_else(|| parameter(name).ok().map(Fixed::Parameter))
        .or_else(of_layer);
    found.ok_or_else(|| {
        let text = format!(
            "{name:?} is no value of a fit: give sphere_radius, half_angle, substrate_modulus, substrate_poisson_ratio, beta, \
             contact_radius, penetration, height, load or contact_stiffness for the scale of what is read, or a parameter \
             that is not free, such as film_thickness"
        );
        Failure::of_words("FitError", &text).raise(py)
    })
}

/// Returns the SI unit of the parameter of a name in Python; none of other words.
#[pyfunction]
pub fn unit_of(name: &str) -> Option<&'static str> {
    let found = parameter(name).ok()?;
    // Names of the program have hyphens, and a layer has the name that it was given.
    let is_name = match found {
        Parameter::Layer(..) => found.identifier() == name,
        _ => !name.contains('-'),
    };
    is_name.then(|| found.unit())
}

/// Returns the parameter of a name in Python. That of a layer has the name of the layer as it is.
pub fn parameter(name: &str) -> Result<Parameter, fit::Error> {
    let plain = name.replace('_', "-").parse();
    if matches!(plain, Ok(parameter) if !matches!(parameter, Parameter::Layer(..))) {
        return plain;
    }
    match name.strip_suffix(".interface_stiffness") {
        Some(layer) => Ok(Parameter::Layer(
            layer.parse()?,
            LayerQuantity::InterfaceStiffness,
        )),
        None => name.parse(),
    }
}
