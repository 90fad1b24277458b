//! The class of Python for each error of the Rust crates, with what the class tells of it.

use interp::Error;

use super::Failure;

/// Returns the functions that help after an error, if there are some.
fn advice(error: &Error) -> Option<&'static str> {
    match error {
        Error::OutsideTable { .. } | Error::Extrapolation { .. } | Error::Equivalent { .. } => {
            Some("`generate` makes tables, and `solve` needs none")
        }
        Error::Normalisation { .. } => Some("the embedded table is `Table.embedded`"),
        Error::Foreign(_) => Some("`Table.open` reads HDF5, and `Table.read` packed tables"),
        Error::Version { .. } => Some("`generate` makes tables"),
        _ => None,
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        let mut failure = Self::new("ContactError", &error);
        if let Some(advice) = advice(&error) {
            failure.message = format!("{}; {advice}", failure.message);
        }
        let of = |class| Self { class, ..failure };
        match error {
            Error::Unphysical {
                name,
                value,
                allowed,
            } => of("InputError").about(name, value).allowed(allowed),
            Error::InvalidArgument {
                name,
                value,
                allowed,
            } => of("InputError").about(name, value).allowed(&allowed),
            Error::BeyondSphere {
                contact_radius,
                sphere_radius,
            } => of("InputError")
                .about("contact radius", contact_radius)
                .range(0.0, sphere_radius),
            Error::BeyondProbe {
                contact_radius,
                allowed,
                limit,
                ..
            } => of("InputError")
                .about("contact radius", contact_radius)
                .allowed(&format!("{allowed} {limit:?} m")),
            Error::OtherProbe { .. } => of("InputError"),
            Error::Profile { row, .. } => of("InputError").about("row", row as f64),
            Error::OutsideTable {
                axis,
                value,
                from,
                to,
            } => of("OutsideTableError").about(axis, value).range(from, to),
            Error::Extrapolation { value, edge, .. } => {
                let ends_above = value < edge;
                of("OutsideTableError").about("a_over_t", value).range(
                    if ends_above { edge } else { 0.0 },
                    if ends_above { f64::INFINITY } else { edge },
                )
            }
            Error::Equivalent { nu0, cause, .. } => Self {
                cause: Some(Box::new((*cause).into())),
                ..of("OutsideTableError").about("nu0", nu0)
            },
            Error::Normalisation { .. } => of("OutsideTableError"),
            Error::OfStack => of("OutsideTableError").saying(
                "the table is of one stack of layers, and the system has one film: give a \
                 StackSystem with the stack of the table, `table.stack`; for a film use a table of \
                 films, such as `Table.embedded()`",
            ),
            Error::NotOfStack => of("OutsideTableError").saying(
                "the table is of films on substrates, and the system has a stack of layers: make \
                 the table of a scene with a stack by `generate`, or solve the stack with \
                 `Stack.contact`",
            ),
            Error::MissingQuantity(_) | Error::BeginsTooLate { .. } => of("OutsideTableError"),
            Error::FixedParameter(name) => Self {
                axis: Some(name.to_owned()),
                ..of("InputError")
            },
            Error::NoGradient => of("InputError").saying(
                "the contact has no derivatives with respect to the material, as those of a stack \
                 and of a SolvedCurve: take differences, or for a film the contact of a table of \
                 films",
            ),
            Error::Foreign(_)
            | Error::Version { .. }
            | Error::Length { .. }
            | Error::Checksum { .. }
            | Error::Malformed(_)
            | Error::LowRankTooLarge { .. } => of("TableError"),
            Error::InFile { path, error } => {
                let failure = Self::from(*error);
                let message = format!("{}: {}", path.display(), failure.message);
                Self { message, ..failure }
            }
            Error::Io { path, source } => of("OSError").about_file(&path, &source),
            _ => of("ContactError"),
        }
    }
}

impl From<::contact::Error> for Failure {
    fn from(error: ::contact::Error) -> Self {
        use ::contact::Error;
        let failure = Self::new("ContactError", &error);
        let solved_by_cohesive = failure
            .message
            .replace("by a direct solve", "with `Cohesive`");
        let of = |class| Self { class, ..failure };
        match error {
            Error::Table(error) => error.into(),
            Error::Sticks { .. }
            | Error::Refused(_)
            | Error::NotOneDisc { .. }
            | Error::GrowsAgain { .. }
            | Error::Unreached { .. }
            | Error::UnlikeBodies { .. } => of("InputError"),
            Error::LongZone {
                zone, length, most, ..
            } => of("InputError")
                .about("zone", zone)
                .range(0.0, most * length)
                .saying(&solved_by_cohesive),
            Error::Tension {
                tension,
                stress,
                most,
            } => of("InputError")
                .about("stress", stress)
                .range(tension / most, f64::INFINITY)
                .saying(&solved_by_cohesive),
            Error::OutsideRadii {
                name,
                value,
                from,
                to,
                ..
            } => of("NoContactError").about(name, value).allowed(&format!(
                "such that the contact radius is from {from:?} m to {to:?} m"
            )),
            Error::NoContact { name, value, least } => of("NoContactError")
                .about(name, value)
                .range(least, f64::INFINITY),
            Error::NoWorkOfAdhesion { load, .. } => {
                of("NoContactError").about("pull-off load", load)
            }
            _ => of("ContactError"),
        }
    }
}

impl From<::solve::Error> for Failure {
    fn from(error: ::solve::Error) -> Self {
        use ::solve::Error;
        let failure = Self::new("ContactError", &error);
        let of = |class| Self { class, ..failure };
        match error {
            Error::Contact(error) => error.into(),
            Error::Domain {
                name,
                value,
                from,
                to,
            } => of("SolveError").about(name, value).range(from, to),
            Error::NotConverged {
                tolerance, reached, ..
            } => of("SolveError")
                .about("tolerance", tolerance)
                .range(reached, f64::INFINITY),
            Error::Coupled { beta, .. } => of("InputError").about("beta", beta),
            Error::StackReach {
                a_over_t, reach, ..
            } => of("SolveError")
                .about("a_over_t", a_over_t)
                .range(0.0, reach),
            Error::NoLayers => of("InputError"),
            Error::Layer { layer, .. } => of("InputError").about("layer", layer as f64),
            Error::NotAContact { contact_radius, .. } => {
                of("NoContactError").about("contact radius", contact_radius)
            }
            Error::NarrowAnnulus { range, .. } => {
                of("NoContactError").about("interaction range", range)
            }
            Error::AnnulusReach {
                contact_radius,
                reach,
            } => of("SolveError")
                .about("contact radius", contact_radius)
                .range(0.0, reach),
            Error::PullOffReach { .. } => of("SolveError"),
            Error::OnlyParaboloid { .. } => of("InputError"),
            _ => of("ContactError"),
        }
    }
}

impl From<tabulate::Error> for Failure {
    fn from(error: tabulate::Error) -> Self {
        use tabulate::Error;
        let failure = Self::new("ContactError", &error);
        let of = |class| Self { class, ..failure };
        match error {
            Error::Table(error) => error.into(),
            Error::Contact(error) => error.into(),
            Error::Solve(error) => error.into(),
            Error::StackFile { .. } => of("InputError"),
            Error::Read { path, source } | Error::Write { path, source } => {
                of("OSError").about_file(&path, &source)
            }
            Error::Busy { .. } => of("OSError"),
            Error::OtherRun { .. }
            | Error::Scene { .. }
            | Error::Nodes(_)
            | Error::Kept { .. }
            | Error::Piece(_) => of("TableError"),
            _ => of("ContactError"),
        }
    }
}

impl From<fit::Error> for Failure {
    fn from(error: fit::Error) -> Self {
        use fit::Error;
        let of = Self::new("FitError", &error);
        match error {
            Error::Contact(::contact::Error::UnlikeBodies { .. }) => of.saying(&format!(
                "{error}; if probe and substrate relax like the film, give all_relax=True"
            )),
            Error::Contact(error) => error.into(),
            Error::Point {
                name,
                value,
                allowed,
                ..
            } => of.about(name, value).allowed(allowed),
            Error::Constant { name, value, .. } => of.about(name, value),
            Error::Setting {
                name,
                value,
                allowed,
            } => of.about(&name, value).allowed(&allowed),
            Error::Layers(error) => error.into(),
            Error::Layer { .. } | Error::OtherLayers(_) | Error::Interrupted => {
                Self::new("InputError", &error)
            }
            Error::Times { time, .. } => of.about("time", time),
            Error::NoTimes { .. } => of.saying(&format!("{error}, in s, as Experiment(time=...)")),
            Error::LeftOut(_) => of.saying(&format!("{error}: allow=(\"left-out\",)")),
            Error::DifferentBodies { .. } => of.saying(&format!(
                "{error}: all_relax=True states that all bodies relax"
            )),
            Error::Start { cause, .. } => Self {
                cause: Some(Box::new((*cause).into())),
                ..of
            },
            _ => of,
        }
    }
}
