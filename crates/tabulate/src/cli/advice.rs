//! The next step of a user of the program after an error of a library, which knows no commands.

use std::env;
use std::io;

#[cfg(feature = "figures")]
use ::fit::Undetermined;
use interp::{Error, Parameter};

/// Returns the commands that help after an error, if there are some.
pub fn advice(error: &anyhow::Error) -> Option<&'static str> {
    error.chain().find_map(of_cause)
}

/// Returns the commands that help after one cause of an error.
fn of_cause(cause: &(dyn std::error::Error + 'static)) -> Option<&'static str> {
    let of_system = cause.downcast_ref::<io::Error>();
    #[cfg(feature = "figures")]
    let of_system = match cause.downcast_ref() {
        Some(::fit::data::DataError { of_system, .. }) => of_system.as_ref(),
        None => of_system,
    };
    if of_system.is_some_and(|error| error.kind() == io::ErrorKind::NotFound)
        && env::args_os().any(|word| word == "-")
    {
        return Some("standard input is /dev/stdin");
    }
    #[cfg(feature = "figures")]
    if let Some(::fit::Error::Start { cause, .. }) = cause.downcast_ref() {
        return of_cause(cause.as_ref());
    }
    #[cfg(feature = "figures")]
    if let Some(::fit::Error::NotDetermined { why, .. }) = cause.downcast_ref() {
        match why {
            Undetermined::PullOffOnly => {
                return Some(
                    "give --work-of-adhesion 1J/m^2, say, and --free film-modulus,contact-point without a work of adhesion, at \
                     heights also baseline; then `tabulate pull-off --load -2uN`, with the load of the pull-off and --film-modulus, finds it",
                );
            }
            Undetermined::NothingRecedes => {
                return Some(
                    "a column of directions has the heading `segment` and the words approach and retract; --segments split \
                     parts points in the order measured where they turn",
                );
            }
            Undetermined::Insensitive => {}
        }
    }
    let of_table = match (of_contact(cause), cause.downcast_ref()) {
        (Some(contact::Error::UnlikeBodies { .. }), _) => {
            return Some(
                "if all bodies relax by the law, give --all-relax; bodies that are rigid beside the film have \
                 --sphere-modulus inf and, where there is a substrate, --substrate-modulus inf",
            );
        }
        (Some(contact::Error::LongZone { .. } | contact::Error::Tension { .. }), _) => {
            return Some("`tabulate pull-off --interaction-range` solves it");
        }
        (Some(contact::Error::Table(error)), _) | (_, Some(crate::Error::Table(error))) => {
            Some(error)
        }
        _ => cause.downcast_ref(),
    };
    of_table.and_then(commands)
}

/// Returns the error of a contact that a cause is, or holds.
fn of_contact<'a>(cause: &'a (dyn std::error::Error + 'static)) -> Option<&'a contact::Error> {
    match cause.downcast_ref() {
        Some(crate::Error::Contact(error)) => return Some(error),
        Some(crate::Error::Solve(error)) => return of_contact(error),
        _ => {}
    }
    if let Some(::solve::Error::Contact(error)) = cause.downcast_ref() {
        return Some(error);
    }
    #[cfg(feature = "figures")]
    match cause.downcast_ref() {
        Some(::fit::Error::Contact(error)) => return Some(error),
        Some(::fit::Error::Layers(error)) => return of_contact(error),
        _ => {}
    }
    cause.downcast_ref()
}

/// Returns the commands that help after an error of a table.
fn commands(error: &Error) -> Option<&'static str> {
    match error {
        Error::OutsideTable { axis, .. } if *axis == Parameter::E1sOverEinfs.name() => Some(
            "e1s_over_einfs is the reduced modulus of the film times the sum of the reciprocals of those of sphere and substrate; `tabulate \
             generate` makes tables, and `tabulate solve`, `curve`, `pull-off` and `history` solve without a table",
        ),
        Error::Extrapolation { value, .. } if *value > 1.0 => Some(
            "check first the units of film thickness and contact radius: a contact is rarely that wide beside its film; `tabulate \
             generate` makes tables, and `tabulate solve`, `curve`, `pull-off` and `history` solve without a table",
        ),
        Error::OutsideTable { .. } | Error::Extrapolation { .. } | Error::Equivalent { .. } => {
            Some(
                "`tabulate generate` makes tables, and `tabulate solve`, `curve`, `pull-off` and `history` solve without a table",
            )
        }
        Error::OfStack => Some(
            "give the table to `tabulate curve`, `pull-off` or `fit` as --stack, and look points up with `tabulate query`",
        ),
        Error::NotOfStack => Some(
            "`tabulate generate` makes the table of a scene with a [stack], and `tabulate solve --stack` needs none",
        ),
        Error::Version { .. } => Some("the commands are `tabulate generate`, `unpack` and `pack`"),
        Error::Foreign(_) => Some(
            "`tabulate pack TABLE.h5 -o TABLE.bin` packs a table, and `tabulate generate SCENE.toml -o TABLE.h5` makes one",
        ),
        Error::InFile { error, .. } => commands(error),
        _ => None,
    }
}
