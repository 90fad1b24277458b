//! The values of the bodies as a fit takes them, and what it asks where one is missing.

use ::fit::{Fixed, LayerQuantity, Parameter};

use crate::cli::interface::FILM;
use crate::cli::system::Value;

/// Returns the value of a fit that one of the bodies is, which has the same name. A film with an
/// interface is a layer.
pub fn fixed(value: Value, film_is_layer: bool) -> Fixed {
    let name = match value.name().strip_prefix("film-") {
        Some(what) if film_is_layer => format!("{FILM}.{what}"),
        _ => value.name().to_owned(),
    };
    Fixed::parse(&name).expect("a fit has the values of the bodies")
}

/// Returns the question that the value answers.
const fn question(value: Value) -> &'static str {
    match value {
        Value::SphereRadius => {
            "what is the radius of the sphere, or of the end of the probe? For example 1mm"
        }
        Value::SphereModulus => {
            "how stiff is the sphere? Its reduced modulus E/(1 - nu^2), for example 2MPa, or inf \
             if it is rigid beside the sample"
        }
        Value::FilmThickness => "how thick is the film? For example 30um",
        Value::FilmModulus => "what is Young's modulus of the film? For example 3.5MPa",
        Value::FilmPoissonRatio => {
            "what is the Poisson ratio of the film? Some 0.5 for elastomers and gels, 0.2 to 0.4 \
             for other solids"
        }
        Value::SubstrateModulus => {
            "what is Young's modulus of the substrate? For example 70GPa, or inf if it is rigid \
             beside the film"
        }
        Value::SubstratePoissonRatio => {
            "what is the Poisson ratio of the substrate? Some 0.25 for glass and silicon"
        }
        Value::WorkOfAdhesion => {
            "what is the work of adhesion? For example 40mJ/m^2, or 0 without adhesion"
        }
    }
}

/// Lists what is missing, with a question for each. `guessed` tells whether a guess will do, because
/// the fit only starts from the value. A `half_space` is known to have no film.
pub fn questions(
    missing: &[Value],
    film_is_layer: bool,
    guessed: impl Fn(Value) -> bool,
    half_space: bool,
) -> Vec<String> {
    let question = |&value: &Value| {
        let further = match fixed(value, film_is_layer).parameter() {
            _ if guessed(value) => {
                ". It is free, and the fit starts from it: a guess will do".into()
            }
            Some(
                modulus @ (Parameter::FilmModulus | Parameter::Layer(_, LayerQuantity::Modulus)),
            ) => {
                format!(". If the data are to tell it, name {modulus} in --free")
            }
            _ => String::new(),
        };
        format!("{} is missing: {}{further}", value.flag(), question(value))
    };
    let mut lines: Vec<String> = missing.iter().map(question).collect();
    if !half_space && missing.iter().any(|value| value.is_of_sample()) {
        lines
            .push("without a film give --half-space, for several layers --stack STACK.toml".into());
    }
    if !missing.is_empty() {
        lines.push(
            "a value that the data are to tell is found by --free; --specimen paper takes all values \
             that are not given from the paper's example"
                .into(),
        );
    }
    lines
}
