//! The values to be found, and the coordinates in which the method moves them.

use contact::LawParameter;

use crate::model::has_no_start;
use crate::{Error, Experiment, Free, LayerQuantity, NamedLayer, Parameter, Prior, Scope};

/// The part of the distance between two bounds by which a start keeps away from them.
const INSIDE: f64 = 0.02;
/// The part of the distance between two bounds within which a value is at a bound.
const AT_BOUND: f64 = 1e-3;

/// The bounds of the exponent of a relaxation function.
const EXPONENTS: [f64; 2] = [1e-3, 0.99];

/// One value to be found.
#[derive(Clone, Debug)]
pub(crate) struct Slot {
    pub parameter: Parameter,
    /// The experiment to which it belongs; `None` if all share it.
    pub experiment: Option<usize>,
    /// Whether the start was given, and is not sought in the data.
    pub is_given: bool,
    pub prior: Option<Prior>,
    /// The bounds that were given.
    pub bounds: Option<[f64; 2]>,
    pub coordinate: Coordinate,
}

/// The coordinate of a value. It is 0 at the start, or an angle between bounds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Coordinate {
    /// Whether the logarithm of the value is fitted.
    positive: bool,
    /// The value at 0, and the change of the value (of its logarithm, 1) by a coordinate of 1.
    start: f64,
    unit: f64,
    bounds: Option<[f64; 2]>,
}

impl Slot {
    /// Tells whether it is a value of `experiment`, which has the number `e`, and has an effect on it.
    pub fn is_of(&self, e: usize, experiment: &Experiment) -> bool {
        self.experiment.is_none_or(|own| own == e)
            && experiment.why_without_effect(self.parameter).is_none()
    }

    /// Returns the slot without bounds and prior, starting from a value.
    pub fn without_limits(&self, start: f64) -> Self {
        Self {
            prior: None,
            bounds: None,
            coordinate: self.coordinate.without_bounds().starting_from(start),
            ..self.clone()
        }
    }
}

impl Coordinate {
    /// Returns a value, or its logarithm if it is positive.
    fn scaled(&self, value: f64) -> f64 {
        if self.positive { value.ln() } else { value }
    }

    /// Returns the part of the way between two bounds at which a value is.
    fn part(&self, value: f64, bounds: [f64; 2]) -> f64 {
        let [least, most] = bounds.map(|bound| self.scaled(bound));
        (self.scaled(value) - least) / (most - least)
    }

    /// Returns the same coordinate with another start.
    pub fn starting_from(self, start: f64) -> Self {
        Self { start, ..self }
    }

    /// Returns the same coordinate without bounds.
    pub fn without_bounds(self) -> Self {
        Self {
            bounds: None,
            ..self
        }
    }

    /// Returns the same coordinate with another unit, if its value may be negative.
    pub fn with_unit(self, unit: f64) -> Self {
        let unit = if self.positive { 1.0 } else { unit };
        Self { unit, ..self }
    }

    /// Returns the coordinate of the start.
    pub fn first(&self) -> f64 {
        self.of(self.start)
    }

    /// Returns the coordinate of a value. One near a bound, or beyond it, is moved between the
    /// bounds.
    pub fn of(&self, value: f64) -> f64 {
        match (self.bounds, self.positive) {
            (Some(bounds), _) => {
                let part = self.part(value, bounds).clamp(INSIDE, 1.0 - INSIDE);
                (2.0 * part - 1.0).asin()
            }
            (None, true) => (value / self.start).ln(),
            (None, false) => (value - self.start) / self.unit,
        }
    }

    /// Returns the value at a coordinate.
    pub fn value(&self, x: f64) -> f64 {
        match (self.bounds, self.positive) {
            (Some(bounds), positive) => {
                let [least, most] = bounds.map(|bound| self.scaled(bound));
                let scaled = least + (most - least) * 0.5 * (1.0 + x.sin());
                let value = if positive { scaled.exp() } else { scaled };
                // Rounding may lead out of the bounds.
                value.clamp(bounds[0], bounds[1])
            }
            (None, true) => self.start * x.exp(),
            (None, false) => self.start + x * self.unit,
        }
    }

    /// Returns the derivative of the value at a coordinate.
    pub fn slope(&self, x: f64) -> f64 {
        let slope = match self
            .bounds
            .map(|bounds| bounds.map(|bound| self.scaled(bound)))
        {
            Some([least, most]) => (most - least) * 0.5 * x.cos(),
            None => self.unit,
        };
        if self.positive {
            self.value(x) * slope
        } else {
            slope
        }
    }

    /// Returns the size in which a change of a value is measured: the value itself if it is
    /// positive, else the unit.
    pub fn size(&self, value: f64) -> f64 {
        if self.positive { value } else { self.unit }
    }

    pub fn is_at_bound(&self, value: f64) -> bool {
        let inside = AT_BOUND..=1.0 - AT_BOUND;
        self.bounds
            .is_some_and(|bounds| !inside.contains(&self.part(value, bounds)))
    }
}

/// Returns the numbers of the slots that are of an experiment, which has the number `e`.
pub(crate) fn slots_of(slots: &[Slot], e: usize, experiment: &Experiment) -> Vec<usize> {
    let is_of_it = |&slot: &usize| slots[slot].is_of(e, experiment);
    (0..slots.len()).filter(is_of_it).collect()
}

/// Accepts what is free, and lists the values to be found. The coordinates start from the values of
/// the experiments.
pub(crate) fn slots(experiments: &[Experiment], free: &[Free]) -> Result<Vec<Slot>, Error> {
    if experiments.is_empty() {
        return Err(Error::nothing("experiment"));
    }
    if free.is_empty() {
        return Err(Error::nothing("free parameter"));
    }
    accept_together(experiments, free)?;
    let mut slots = Vec::new();
    for one in free {
        slots.extend(slots_of_parameter(experiments, free, one)?);
    }
    Ok(slots)
}

/// Refuses what is free twice, by one name or by two.
fn accept_together(experiments: &[Experiment], free: &[Free]) -> Result<(), Error> {
    for (i, one) in free.iter().enumerate() {
        accept(one)?;
        for other in &free[..i] {
            let both = [one.parameter, other.parameter];
            let one_level = both.contains(&Parameter::LoadOffset)
                && both.contains(&Parameter::Baseline)
                && experiments
                    .iter()
                    .all(|experiment| experiment.why_without_effect(Parameter::Baseline).is_none());
            let [parameter, before] = both;
            if parameter == before {
                return Err(Error::NotFitted(format!(
                    "{parameter} is free twice: name it once"
                )));
            }
            if one_level {
                return Err(Error::NotFitted(format!(
                    "{parameter} and {before} are one number: free one of them"
                )));
            }
        }
    }
    Ok(())
}

/// Lists the values of `one` of the `free` parameters that are to be found.
fn slots_of_parameter(
    experiments: &[Experiment],
    free: &[Free],
    one: &Free,
) -> Result<Vec<Slot>, Error> {
    let mut slots = Vec::new();
    let applies = |experiment: &Experiment| experiment.why_without_effect(one.parameter);
    let members: Vec<usize> = (0..experiments.len())
        .filter(|&e| applies(&experiments[e]).is_none())
        .collect();
    if members.is_empty()
        && let Some(first) = experiments.first()
        && let Some(reason) = applies(first)
    {
        return Err(first.not_applicable(one.parameter, reason));
    }
    let start_of = |e: usize| {
        let own = experiments[e].get(one.parameter);
        one.start.or(own).or(match one.parameter {
            Parameter::WorkOfAdhesionReceding => Some(experiments[e].work_of_adhesion),
            Parameter::DoublingSpeed | Parameter::SpeedExponent => Some(1.0),
            Parameter::Hardness => experiments[e].hardness_to_start_from(has_no_start(free)),
            Parameter::Layer(name, LayerQuantity::InterfaceStiffness) => experiments[e]
                .bodies
                .layer(name)
                .map(NamedLayer::own_stiffness),
            _ => None,
        })
    };
    let slot = |experiment: Option<usize>, start: f64| Slot {
        parameter: one.parameter,
        experiment,
        is_given: one.start.is_some(),
        prior: one.prior,
        bounds: one.bounds,
        coordinate: Coordinate {
            positive: one.parameter.is_positive(),
            start,
            unit: 1.0,
            bounds: one.bounds.or(match one.parameter {
                Parameter::FilmPoissonRatio => Some([0.0, 0.5]),
                Parameter::Law(LawParameter::RelaxedFraction) => Some([0.0, 1.0]),
                Parameter::Law(LawParameter::Exponent) => Some(EXPONENTS),
                Parameter::Layer(name, LayerQuantity::InterfaceStiffness) => experiments
                    [members[0]]
                    .bodies
                    .layer(name)
                    .map(|layer| interface_bounds(layer, start)),
                _ => None,
            }),
        },
    };
    let missing = |e: usize| {
        let reason = "it has no value to start from; give one";
        experiments[e].not_applicable(one.parameter, reason)
    };
    let is_own = one.scope == Scope::Own && experiments.len() > 1;
    // The experiments of each value.
    for group in members.chunks(if is_own { 1 } else { members.len() }) {
        let first = group[0];
        let start = start_of(first).ok_or_else(|| missing(first))?;
        for &e in &group[1..] {
            let other = start_of(e).ok_or_else(|| missing(e))?;
            if other != start {
                let [name, own] = [first, e].map(|i| &experiments[i].measurement.name);
                let name = if name == own { "the first one" } else { name };
                let allowed = format!(
                    "{start:?}, that of {name}, because one value is fitted for all: give all of them one \
                     value, or the fit one start, or fit a value for each"
                );
                return Err(experiments[e].wrong_setting(one.parameter, other, allowed));
            }
        }
        slots.push(slot(is_own.then_some(first), start));
    }
    Ok(slots)
}

/// Returns the bounds of the stiffness of an interface that has none of its own. Beyond them the layer
/// slides, or is bonded, to all that data tell, and the way to 0 or to infinity would not end.
fn interface_bounds(layer: &NamedLayer, start: f64) -> [f64; 2] {
    /// The bounds over the stiffness of the layer itself, and the least distance from the start.
    const REACH: f64 = 1e5;
    const ROOM: f64 = 10.0;
    let own = layer.own_stiffness();
    [
        (own / REACH).min(start / ROOM),
        (own * REACH).max(start * ROOM),
    ]
}

/// Accepts the start, bounds and prior of a free parameter.
fn accept(free: &Free) -> Result<(), Error> {
    let parameter = free.parameter;
    let setting = |what: &str, value: f64, allowed: &str| {
        Error::setting(format!("{what} of {parameter}"), value, allowed)
    };
    let is_possible = |value: f64| value.is_finite() && (!parameter.is_positive() || value > 0.0);
    let possible = if parameter.is_positive() {
        "positive and finite"
    } else {
        "finite"
    };
    if let Some(start) = free.start.filter(|&start| !is_possible(start)) {
        return Err(setting("the start", start, possible));
    }
    if let Some([least, most]) = free.bounds {
        for bound in [least, most] {
            if !is_possible(bound) {
                let has_small = parameter.is_positive() && most.is_finite() && most > 0.0;
                let allowed = if bound == 0.0 && has_small {
                    format!(
                        "{possible}, since its logarithm is fitted; a small bound in place of 0 is {:e} {}",
                        most / 1e3,
                        parameter.unit()
                    )
                } else {
                    possible.to_owned()
                };
                return Err(setting("a bound", bound, &allowed));
            }
        }
        if least >= most {
            let allowed = format!("above the lower one, {least:?}");
            return Err(setting("the upper bound", most, &allowed));
        }
        if parameter == Parameter::FilmPoissonRatio && (least <= -1.0 || most > 0.5) {
            let wrong = if most > 0.5 { most } else { least };
            return Err(setting("a bound", wrong, "in (-1, 0.5]"));
        }
        if let Some(start) = free.start.filter(|start| !(least..=most).contains(start)) {
            let allowed = format!("between the bounds, {least:?} and {most:?}");
            return Err(setting("the start", start, &allowed));
        }
    }
    if let Some(Prior { mean, width }) = free.prior {
        if !mean.is_finite() {
            return Err(setting("the prior mean", mean, "finite"));
        }
        if !(width > 0.0 && width.is_finite()) {
            return Err(setting("the prior width", width, "positive and finite"));
        }
    }
    Ok(())
}
