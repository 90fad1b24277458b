//! The flags of the parameters that a fit finds.

use ::fit::{Experiment, Free, Kind, Parameter, Scope};
use anyhow::{bail, ensure};

use super::relaxing;
use super::setting::{Pair, Values, bounds, prior};
use crate::cli::system::{SystemArguments, Value};

/// The flags of free parameters.
#[derive(clap::Args)]
pub struct FreeArguments {
    /// The parameters to be found: sphere-modulus (reduced, E2*), film-modulus (Young's, E1),
    /// film-poisson-ratio, film-thickness, work-of-adhesion, work-of-adhesion-receding, doubling-speed, speed-exponent,
    /// load-offset, contact-point, baseline, baseline-slope, stiffness; of a contact stiffness also hardness,
    /// tip-rounding, frame-compliance; with --stack, LAYER.modulus (Young's), LAYER.thickness and
    /// LAYER.interface-stiffness (tangential, of the interface below, Pa/m) of a layer by its name in
    /// the file take the place of those of the film; with --interface the film is the layer `film`
    ///
    /// A list takes the place of the default, which is: the work of adhesion, unless --work-of-adhesion 0 says that there is none; the modulus of the sphere, or of the film or top layer under
    /// a rigid sphere, if loads are measured; the contact point with penetrations or heights; the
    /// baseline with heights; of a contact stiffness the modulus of the film or top layer; with
    /// --relaxation the modulus of the film or top layer, the numbers of the law, the contact point and
    /// with heights the baseline. The numbers of a law are relaxed-fraction, relaxation-exponent,
    /// relaxation-time and, of prony:M, relaxation-time.2, relaxation-weight.2, ...
    #[arg(long, value_name = "NAME,...", value_delimiter = ',')]
    pub free: Vec<Parameter>,
    /// Smallest and largest value of a free parameter: film-modulus=0.1MPa..100MPa
    #[arg(long, value_name = "NAME=LEAST..MOST", value_parser = bounds)]
    pub bounds: Vec<Pair>,
    /// Mean and standard error of a free parameter that are known from elsewhere:
    /// film-thickness=1um+-50nm. They count as one more measured point
    #[arg(long, value_name = "NAME=MEAN+-ERROR", value_parser = prior)]
    pub prior: Vec<Pair>,
    /// Free parameters of which each file has its own value. Offset, contact point and baseline
    /// are each file's own anyway
    #[arg(long, value_name = "NAME,...", value_delimiter = ',')]
    pub own: Vec<Parameter>,
    /// Free parameters of which all files have one value
    #[arg(long, value_name = "NAME,...", value_delimiter = ',')]
    pub shared: Vec<Parameter>,
}

impl FreeArguments {
    /// Tells whether no flag is given.
    pub const fn is_empty(&self) -> bool {
        self.free.is_empty()
            && self.bounds.is_empty()
            && self.prior.is_empty()
            && self.own.is_empty()
            && self.shared.is_empty()
    }

    /// Returns the free parameters of experiments.
    pub fn of(
        &self,
        experiments: &[Experiment],
        values: &[Values],
        given: &SystemArguments,
    ) -> anyhow::Result<Vec<Free>> {
        let names = if self.free.is_empty() {
            let mut names = usual(experiments);
            // It is no place to start from, but that there is no adhesion.
            if given.given(Value::WorkOfAdhesion) == Some(0.0)
                && experiments.iter().all(|one| one.work_of_adhesion == 0.0)
            {
                names.retain(|&name| name != Parameter::WorkOfAdhesion);
            }
            names
        } else {
            self.free.clone()
        };
        /// The flags of lists of parameters, which exclude each other.
        const SCOPES: [&str; 2] = ["--own", "--shared"];
        let lists = [(SCOPES[0], &self.own), (SCOPES[1], &self.shared)];
        let settings = self.bounds.iter().map(|set| ("--bounds", set.0));
        let settings = settings.chain(self.prior.iter().map(|set| ("--prior", set.0)));
        let listed = lists
            .iter()
            .flat_map(|(flag, list)| list.iter().map(move |name| (*flag, *name)));
        let settings: Vec<_> = settings.chain(listed).collect();
        for (i, &(flag, parameter)) in settings.iter().enumerate() {
            let mut before = settings[..i].iter();
            if let Some((other, _)) = before.find(|&&(other, name)| {
                name == parameter
                    && (other == flag || SCOPES.contains(&other) && SCOPES.contains(&flag))
            }) {
                ensure!(
                    *other != flag,
                    "{flag} {parameter} is given twice: leave one out"
                );
                bail!("{other} {parameter} and {flag} {parameter}: give one of them");
            }
            if !names.contains(&parameter) {
                let names = Parameter::names(names.iter().copied());
                bail!("{flag} {parameter}: it is not free; free are {names}");
            }
        }
        let free = |&parameter: &Parameter| {
            let mut free = Free::new(parameter);
            if let Some(set) = values
                .iter()
                .rfind(|set| set.quantity.parameter() == Some(parameter))
                && let [start] = set.values[..]
            {
                free = free.starting_from(start);
            }
            let of = |set: &&Pair| set.0 == parameter;
            for (_, [least, most]) in self.bounds.iter().filter(of) {
                free = free.within(*least, *most);
            }
            for (_, [mean, error]) in self.prior.iter().filter(of) {
                free = free.with_prior(*mean, *error);
            }
            for (list, scope) in [(&self.own, Scope::Own), (&self.shared, Scope::Shared)] {
                if list.contains(&parameter) {
                    free = free.with_scope(scope);
                }
            }
            free
        };
        Ok(names.iter().map(free).collect())
    }
}

/// Returns the parameters that are free unless others are named.
fn usual(experiments: &[Experiment]) -> Vec<Parameter> {
    let any = |kinds: &[Kind]| {
        experiments
            .iter()
            .any(|experiment| kinds.contains(&experiment.measurement.kind))
    };
    let is_rigid =
        |experiment: &Experiment| experiment.get(Parameter::SphereModulus) == Some(f64::INFINITY);
    // A contact stiffness tells the film.
    if experiments
        .iter()
        .all(|one| one.measurement.kind.is_stiffness())
    {
        return vec![experiments[0].bodies.modulus_of_top()];
    }
    let modulus = if experiments.iter().any(is_rigid) {
        experiments[0].bodies.modulus_of_top()
    } else {
        Parameter::SphereModulus
    };
    if let Some(free) = relaxing::usual(experiments, experiments[0].bodies.modulus_of_top()) {
        return free;
    }
    let mut free = Vec::new();
    // Without a load the data tell the ratio of adhesion and modulus only.
    if any(&[Kind::LoadRadius, Kind::LoadPenetration, Kind::ForceHeight]) {
        free.push(modulus);
    }
    free.push(Parameter::WorkOfAdhesion);
    if any(&[
        Kind::PenetrationRadius,
        Kind::LoadPenetration,
        Kind::ForceHeight,
    ]) {
        free.push(Parameter::ContactPoint);
    }
    if any(&[Kind::ForceHeight]) {
        free.push(Parameter::Baseline);
    }
    free
}
