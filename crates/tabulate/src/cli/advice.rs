//! The next step of a user of the program after an error of a library, which knows no commands.

use interp::{Error, Parameter};

/// Returns the commands that help after an error, if there are some.
pub fn advice(error: &anyhow::Error) -> Option<&'static str> {
    error.chain().find_map(|cause| {
        if let Some(contact::HistoryError::UnlikeBodies { .. }) = cause.downcast_ref() {
            return Some(
                "if all bodies relax by the law, give --all-relax; bodies that are rigid beside the film have \
                 --sphere-modulus inf and --substrate-modulus inf",
            );
        }
        let own = cause.downcast_ref::<contact::Error>();
        let of_program = cause.downcast_ref().and_then(|error| match error {
            crate::Error::Contact(error) => Some(error),
            _ => None,
        });
        let of_solve = cause.downcast_ref().and_then(|error| match error {
            ::solve::Error::Contact(error) => Some(error),
            _ => None,
        });
        #[cfg(feature = "fit")]
        let of_fit = cause.downcast_ref().and_then(|error| match error {
            ::fit::Error::Contact(error) => Some(error),
            _ => None,
        });
        #[cfg(not(feature = "fit"))]
        let of_fit = None;
        let of_history = cause.downcast_ref().and_then(|error| match error {
            contact::HistoryError::Contact(error) => Some(error),
            _ => None,
        });
        let found = own.or(of_program).or(of_solve).or(of_fit).or(of_history);
        let of_table = match (found, cause.downcast_ref()) {
            (Some(contact::Error::LongZone { .. }), _) => {
                return Some("`tabulate pull-off --interaction-range` solves it");
            }
            (Some(contact::Error::Table(error)), _) | (_, Some(crate::Error::Table(error))) => {
                Some(error)
            }
            _ => cause.downcast_ref(),
        };
        of_table.and_then(commands)
    })
}

/// Returns the commands that help after an error of a table.
fn commands(error: &Error) -> Option<&'static str> {
    match error {
        Error::OutsideTable { axis, .. } if *axis == Parameter::E1sOverEinfs.name() => Some(
            "e1s_over_einfs is the reduced modulus of the film times the sum of the reciprocals of those of sphere and substrate; `tabulate \
             generate` makes tables, and `tabulate solve` solves without a table",
        ),
        Error::OutsideTable { .. } | Error::Extrapolation { .. } | Error::Equivalent { .. } => {
            Some("`tabulate generate` makes tables, and `tabulate solve` solves without a table")
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
