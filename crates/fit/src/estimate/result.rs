//! The result of a fit.

use crate::{Branch, FixedValue, Loss, LossAngle, Parameter, Prior};

/// The result of a fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// Whether the method found a minimum. If not, the numbers are those of its last step. One that ended by more than 10
    /// standard errors before the minimum, because no contact is known beyond, has not found it.
    pub converged: bool,
    /// The number of times that the model was evaluated at all points.
    pub evaluations: usize,
    /// The parameters found: in the order of the [`Free`](crate::Free), one for each experiment
    /// where it has its own.
    pub estimates: Vec<Estimate>,
    /// The correlation matrix of the estimates, in their order.
    pub correlation: Vec<Vec<f64>>,
    /// The sum of the squared residuals of the points that count, and of the priors, in units of
    /// the noise.
    pub chi_squared: f64,
    /// The number of points that count, and of priors, less that of the parameters.
    pub degrees_of_freedom: usize,
    /// `chi_squared` over the degrees of freedom; `None` if the noise of an experiment was
    /// estimated from the residuals, because then it tells nothing.
    pub reduced_chi_squared: Option<f64>,
    /// The experiments, in the order given.
    pub experiments: Vec<FittedExperiment>,
    /// The same data without the film; `None` on a half-space, where the data have no fit without
    /// it, or where it is not [asked for](crate::Options::without_film).
    pub without_film: Option<WithoutFilm>,
    /// The combinations of parameters that the data do not determine.
    pub undetermined: Vec<Combination>,
    /// What the values taken as given do to the result: those with a known error, and all if
    /// [`Options::fixed_values`](crate::Options::fixed_values) asks for them.
    pub fixed_values: Vec<FixedValue>,
    /// The loss that was made least.
    pub loss: Loss,
    /// The doubts about the result: what the data say, then what the model leaves out.
    pub warnings: Vec<Warning>,
}

impl Fit {
    /// Returns the estimate of a parameter, of the first experiment if each has its own.
    pub fn estimate(&self, parameter: Parameter) -> Option<&Estimate> {
        self.estimates
            .iter()
            .find(|estimate| estimate.parameter == parameter)
    }

    /// Returns the value of a parameter of the experiment `number`, if the fit finds it.
    pub(crate) fn value_of(
        estimates: &[Estimate],
        parameter: Parameter,
        number: usize,
    ) -> Option<f64> {
        let own = |one: &&Estimate| {
            one.parameter == parameter && one.experiment.is_none_or(|i| i == number)
        };
        estimates.iter().find(own).map(|one| one.value)
    }

    /// Tells whether the values are more than those of a last step: a minimum, or the end of the contacts that are known.
    pub fn found_values(&self) -> bool {
        self.converged || self.warns_of(WarningKind::EndOfTable)
    }

    /// Tells whether there is a warning of a kind.
    pub fn warns_of(&self, kind: WarningKind) -> bool {
        self.warnings.iter().any(|warning| warning.kind == kind)
    }
}

/// A parameter found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The parameter.
    pub parameter: Parameter,
    /// The number of the experiment to which the value belongs; `None` if it is shared.
    pub experiment: Option<usize>,
    /// The value, in SI units.
    pub value: f64,
    /// The standard error, in SI units, from the derivatives of the model at the minimum, with what
    /// the errors of [`Known`](crate::Known) values add.
    pub standard_error: f64,
    /// The interval at [`Options::profile_level`](crate::Options::profile_level), if asked for. It
    /// contains the value, and that of a smaller level. An end is infinite, or 0 for a positive
    /// parameter, where the data set no limit within 40 standard errors or, for a positive
    /// parameter, a factor of 1e6; it is NaN where a fit of the other values failed on the way. A
    /// warning gives the reason: [`WarningKind::OpenInterval`], or [`WarningKind::AtBound`] of a work of
    /// adhesion that ended at 0.
    pub profile: Option<[f64; 2]>,
    /// The prior that was given.
    pub prior: Option<Prior>,
    /// The bounds that were given.
    pub bounds: Option<[f64; 2]>,
}

impl Estimate {
    /// Returns the parameters of estimates, each once.
    pub fn parameters(estimates: &[Self]) -> Vec<Parameter> {
        each_once(estimates.iter().map(|one| one.parameter))
    }

    /// Returns Young's modulus of the sphere from this estimate of its reduced modulus, with its
    /// errors: `E2 = E2* (1 - nu2^2)`, with the Poisson ratio `nu2` taken as exact.
    pub fn young_of_sphere(&self, poisson_ratio: f64) -> Self {
        let factor = 1.0 - poisson_ratio * poisson_ratio;
        Self {
            value: factor * self.value,
            standard_error: factor * self.standard_error,
            profile: self.profile.map(|ends| ends.map(|end| factor * end)),
            prior: None,
            bounds: None,
            ..*self
        }
    }

    /// Returns the interval of `deviations` standard errors on both sides: `value +- z error`, or
    /// for a positive parameter the same on its logarithm, `value exp(+- z error/value)`.
    pub fn interval(&self, deviations: f64) -> [f64; 2] {
        [-deviations, deviations].map(|z| {
            if self.parameter.is_positive() {
                self.value * (z * self.standard_error / self.value).exp()
            } else {
                self.value + z * self.standard_error
            }
        })
    }
}

/// An experiment, as fitted.
#[derive(Clone, Debug, PartialEq)]
pub struct FittedExperiment {
    /// The name of the measurement.
    pub name: String,
    /// The standard deviation of an ordinate, in N or m, and of a contact stiffness relative to it;
    /// the median of those given for each point.
    pub noise: f64,
    /// Whether the noise was estimated from the residuals.
    pub noise_is_estimated: bool,
    /// The standard deviation of an abscissa, m; 0 if they are exact, and the median of those given
    /// for each point.
    pub abscissa_noise: f64,
    /// The points, in the order measured.
    pub points: Vec<FittedPoint>,
    /// The loss angle of the film or top layer, where phases are measured. Then its modulus is the
    /// absolute value of the complex one.
    pub loss: Option<LossAngle>,
    /// The points that were left out, by reason.
    pub left_out: Vec<LeftOut>,
    /// What the relaxation does, where the bodies relax.
    pub relaxation: Option<FittedRelaxation>,
}

/// The relaxation of an experiment, as fitted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FittedRelaxation {
    /// Young's modulus of the film, of the half-space or of the top layer (Pa) at three times (s)
    /// after a step of the strain: the shortest interval between points, half of the duration, and
    /// the duration.
    pub moduli: [[f64; 2]; 3],
    /// The largest change (m) of an abscissa that took its noise off the penetrations or heights, and made
    /// them rise to the largest one and fall from there.
    pub made_monotone: f64,
    /// The bound of the error by bodies that do not relax, in parts of the largest load.
    pub unlike_bodies: f64,
    /// The estimated largest error of the loads by the steps in time, in parts of the largest load.
    pub steps_error: f64,
}

/// Points that were left out for one reason.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LeftOut {
    /// Why.
    pub reason: LeftOutReason,
    /// How many there are.
    pub points: usize,
    /// The first and the last of their numbers.
    pub lines: [u64; 2],
}

named! {
    /// Why points are left out.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
    #[non_exhaustive]
    pub enum LeftOutReason {
        /// They are between contact and baseline: in a jump, or where the data do not tell.
        Jump = "jump",
        /// They have a contact radius of 0, at which a penetration tells nothing.
        NoContact = "no-contact",
        /// They are near the largest radius of a cycle, where the line may not have moved yet.
        Turn = "turn",
        /// They are at the end of a way, or at a sudden step of the load or penetration, where the speed of the contact line is
        /// not known, and adhesion depends on it.
        UnknownSpeed = "unknown-speed",
        /// They are in contact, but within 4 standard errors of the end of the fitted branch. No more than a tenth of the
        /// points in contact is left out for this.
        NearEnd = "near-end",
        /// They are in contact, but the fitted branch ends before them.
        BeyondEnd = "beyond-end",
    }
}

impl LeftOutReason {
    /// Returns the reason in words, as after "12 points".
    pub const fn text(self) -> &'static str {
        match self {
            Self::Jump => "between contact and baseline",
            Self::NoContact => "without a contact",
            Self::Turn => "at the turn, where the contact line may not have moved",
            Self::UnknownSpeed => {
                "at the end of a way or at a sudden step, where the speed of the contact line is not known"
            }
            Self::NearEnd => "within 4 standard errors of the end of the fitted branch",
            Self::BeyondEnd => "in contact beyond the end of the fitted branch",
        }
    }

    /// Tells whether such points are in contact according to the data.
    pub const fn is_of_contact(self) -> bool {
        matches!(self, Self::NearEnd | Self::BeyondEnd)
    }
}

/// A measured point, as fitted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FittedPoint {
    /// The line of the file that the point comes from.
    pub line: u64,
    /// The measured abscissa.
    pub abscissa: f64,
    /// The measured ordinate.
    pub ordinate: f64,
    /// The ordinate of the fit; `None` for a point that was left out.
    pub fit: Option<f64>,
    /// The standard deviation of the residual, in N or m: that of the ordinate, with what an error
    /// of the abscissa adds.
    pub deviation: f64,
    /// The contact radius of the fit (m); `None` without a contact.
    pub contact_radius: Option<f64>,
    /// The ordinate of the fit without the film; `None` where there is none.
    pub without_film: Option<f64>,
    /// The branch.
    pub branch: Branch,
    /// The speed of the contact line, m/s, positive where it recedes; `None` where adhesion does not depend on it, or it is
    /// not known.
    pub line_speed: Option<f64>,
    /// The energy release rate that the measured load or penetration tells, J/m^2, where there is such a speed.
    pub energy_release_rate: Option<f64>,
    /// Whether the residual is more than 5 times its standard deviation.
    pub outlier: bool,
}

impl FittedPoint {
    /// Returns the ordinate measured less that of the fit.
    pub fn residual(&self) -> Option<f64> {
        self.fit.map(|fit| self.ordinate - fit)
    }
}

/// The same data, fitted without the film by JKR, or by Hertz without adhesion.
///
/// If the modulus of the sphere is free, the sphere is taken to touch the bare substrate.
/// Otherwise, if the modulus of the film, or of the top layer of a stack, is free, it is taken to
/// touch a half-space of film. Without the layers of a stack it touches the base in all other cases.
#[derive(Clone, Debug, PartialEq)]
pub struct WithoutFilm {
    /// The parameters found.
    pub estimates: Vec<Estimate>,
    /// The sum of the squared residuals, in units of the noise of the fit with the film.
    pub chi_squared: f64,
    /// The modulus without the film beside that with it; `None` if no modulus is free.
    pub modulus: Option<ModulusBias>,
}

/// The error of a modulus that is fitted without the film.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModulusBias {
    /// The modulus compared.
    pub parameter: Parameter,
    /// The error relative to the modulus with the film: 0.041 is +4.1 %.
    pub relative: f64,
    /// The error in standard errors of the modulus with the film.
    pub standard_errors: f64,
}

impl ModulusBias {
    /// The number of standard errors from which the film matters.
    pub const SIGNIFICANT: f64 = 3.0;

    /// Tells whether the film matters: whether the modulus without it is off by more than
    /// [`ModulusBias::SIGNIFICANT`] standard errors.
    pub fn matters(&self) -> bool {
        self.standard_errors.abs() > Self::SIGNIFICANT
    }
}

/// A combination of parameters that the data do not determine: all may change together in these
/// proportions while no ordinate changes by more than its noise.
#[derive(Clone, Debug, PartialEq)]
pub struct Combination {
    /// The estimates by number, and the weight of each: a change of its logarithm if the parameter
    /// is positive, else of its value in units of the data. The squares of the weights sum to 1.
    pub weights: Vec<(usize, f64)>,
    /// The combination in words, such as `sphere-modulus and work-of-adhesion`.
    pub text: String,
}

impl Combination {
    /// Returns the words of several combinations, each once: the same parameters may change in several proportions.
    pub fn texts<'a>(combinations: impl IntoIterator<Item = &'a Self>) -> Vec<&'a str> {
        each_once(combinations.into_iter().map(|one| &*one.text))
    }
}

/// Returns items, each once.
pub(super) fn each_once<T: PartialEq>(items: impl Iterator<Item = T>) -> Vec<T> {
    let mut all = Vec::new();
    for one in items {
        if !all.contains(&one) {
            all.push(one);
        }
    }
    all
}

named! {
    /// What a warning is about.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    #[non_exhaustive]
    pub enum WarningKind {
        /// The method did not find a minimum.
        NotConverged = "not-converged",
        /// An experiment with the points of another one.
        SamePoints = "same-points",
        /// A parameter whose standard error is above half its value (of the range of the data for an
        /// offset).
        Undetermined = "undetermined",
        /// A parameter that ended at one of its bounds.
        AtBound = "at-bound",
        /// A modulus, a work of adhesion, a length or a loss tangent that no experiment has: a wrong unit or sign.
        Implausible = "implausible",
        /// Residuals larger than the given noise explains.
        PoorFit = "poor-fit",
        /// Residuals smaller than the given noise explains.
        LargeNoise = "large-noise",
        /// A noise of the ordinates that the data hardly tell: by few points, or beside errors of the abscissae.
        NoiseNotSeen = "noise-not-seen",
        /// An estimated noise that is larger in contact than off contact, or at large ordinates than at small ones.
        UnequalNoise = "unequal-noise",
        /// Residuals that are more likely errors of the contact radii than one noise of the ordinates.
        RadiusNoise = "radius-noise",
        /// Penetrations with the noise of the loads, which make moduli too small.
        SharedNoise = "shared-noise",
        /// A prior far from what the data tell.
        Prior = "prior",
        /// Readings at the end of the range of the detector.
        Saturated = "saturated",
        /// Readings in steps that are coarse beside the noise.
        CoarseSteps = "coarse-steps",
        /// Adhesion that is left out, and with which the model would describe the data better.
        AdhesionWanted = "adhesion-wanted",
        /// A zero of the instrument that is not fitted, and with which the model would describe the data better.
        OffsetWanted = "offset-wanted",
        /// A spring in series with the contact, of the frame or of a cantilever of another stiffness, with which the model
        /// would describe the data better.
        SpringWanted = "spring-wanted",
        /// A zero of the instrument that is not fitted, at which the data hint, and that would change a value by many of
        /// its standard errors.
        OffsetHinted = "offset-hinted",
        /// No point is off contact, and the work of adhesion depends on the zero of the load.
        ZeroNotSeen = "zero-not-seen",
        /// A work of adhesion is found, and no point shows the pull that it would have.
        PullNotSeen = "pull-not-seen",
        /// Approach and retract do not have one work of adhesion.
        MixedBranches = "mixed-branches",
        /// Contact radii that stay while the load changes.
        PinnedLine = "pinned-line",
        /// A loop between loading and unloading that the model does not make.
        Hysteresis = "hysteresis",
        /// A load that falls while penetration or height is held.
        Relaxes = "relaxes",
        /// A depth that remains after unloading.
        Plasticity = "plasticity",
        /// Residuals that are more like their neighbours than chance makes them, or whose means over several
        /// neighbours are farther from 0.
        StructuredResiduals = "structured-residuals",
        /// Points far from the fit.
        Outliers = "outliers",
        /// Points that the fit leaves out.
        LeftOut = "left-out",
        /// A contact that is large beside the sphere, or at whose edge the probe is steep.
        LargeContact = "large-contact",
        /// An attraction whose range is not small: Tabor's parameter is below 5.
        LongRange = "long-range",
        /// Bodies so soft and contacts so small that surface tension, which the model leaves out, may change the loads.
        SurfaceTension = "surface-tension",
        /// A film that is compressed by a large part of its thickness.
        LargeStrain = "large-strain",
        /// A film stiffer than its substrate that is bent by a large part of its thickness.
        Bending = "bending",
        /// A film so much stiffer than its substrate that the contact may be no disc.
        NoDisc = "no-disc",
        /// Friction, which may change the modulus by more than its standard error.
        Friction = "friction",
        /// Contacts so small or so large beside the film that they hardly tell it.
        FilmNotSeen = "film-not-seen",
        /// The definition of the contact depth changes a modulus by more than its standard error.
        ContactDepth = "contact-depth",
        /// One hardness for all loads, on which a modulus depends by more than its standard error.
        OneHardness = "one-hardness",
        /// An indenter in more than half of its film.
        DeepContact = "deep-contact",
        /// A stiffness of an interface that the data do not tell from 0 (it slides) or from infinity (it
        /// is bonded).
        InterfaceNotSeen = "interface-not-seen",
        /// A modulus that takes a film as bonded, and would be another one by more than its standard
        /// error if the film slid.
        AssumesBonding = "assumes-bonding",
        /// A value that changes by more than a tenth with 1 % of a value taken as given or of a calibration, or with
        /// readings that move by 0.5 % of the largest.
        Calibration = "calibration",
        /// The fit was stopped by the end of the table.
        EndOfTable = "end-of-table",
        /// A table whose error is not small beside the noise.
        TableError = "table-error",
        /// There is another minimum, whose sum of squares is larger by no more than chance explains.
        SeveralMinima = "several-minima",
        /// A standard error that says too little, because the model is far from linear within it.
        NonlinearError = "nonlinear-error",
        /// An interval of the profile likelihood without an end on one side.
        OpenInterval = "open-interval",
        /// A relaxation time that is shorter than two intervals between points, or longer than the
        /// measurement.
        RelaxationTime = "relaxation-time",
        /// A free thickness beside a free modulus of a film that relaxes.
        FreeThickness = "free-thickness",
        /// A gel whose relaxation is that of contacts of one size, and may be flow of its solvent.
        OneSize = "one-size",
        /// Bodies that deform and do not relax.
        UnlikeBodies = "unlike-bodies",
        /// A film that is stiffer than a substrate that relaxes with it, and may pull inside the contact.
        TensileInside = "tensile-inside",
        /// Penetrations or heights in time that scatter, or go back and forth, by more than a hundredth of
        /// their range.
        NotMonotone = "not-monotone",
        /// Steps in time whose error is seen beside the noise.
        Steps = "steps",
    }
}

impl WarningKind {
    /// Returns the warning of this kind with a text.
    pub(super) const fn with(self, text: String) -> Warning {
        Warning { kind: self, text }
    }

    /// Tells whether the warning is about the bodies and what the model leaves out of them, and not about the data.
    pub const fn is_of_model(self) -> bool {
        matches!(
            self,
            Self::AssumesBonding
                | Self::LargeContact
                | Self::SurfaceTension
                | Self::OneSize
                | Self::LargeStrain
                | Self::Bending
                | Self::NoDisc
                | Self::Friction
                | Self::LongRange
        )
    }
}

/// A doubt about the result.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// What it is about.
    pub kind: WarningKind,
    /// The doubt in one sentence, with the numbers and the next step.
    pub text: String,
}

/// What an experiment would tell, before it is made.
#[derive(Clone, Debug, PartialEq)]
pub struct Forecast {
    /// The parameters at their true values, with the standard errors expected.
    pub estimates: Vec<Estimate>,
    /// Their expected correlation matrix.
    pub correlation: Vec<Vec<f64>>,
    /// What the values that are not free would do, if they are not quite the true ones.
    pub fixed_values: Vec<FixedValue>,
    /// The combinations that the experiment would not determine.
    pub undetermined: Vec<Combination>,
    /// The assumptions of the model that its contacts would leave.
    pub warnings: Vec<Warning>,
}
