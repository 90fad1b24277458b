//! Reading the files, with what to type where one cannot be read.

use std::path::Path;

use ::fit::Experiment;
use ::fit::data::{Doubt, Format, Named, Notes, Reading, Reduced, Remedy, read};
use anyhow::anyhow;

/// Reads a file. An error says which flag helps.
pub fn measured(path: &Path, format: &Format) -> anyhow::Result<Reading> {
    read(path, format).map_err(|error| match &error.remedy {
        Some(remedy) => anyhow!("{error}; {}", typed(remedy)),
        None => error.into(),
    })
}

/// Returns the error of a fit, with the doubts about the files that may explain it.
pub fn doubted(error: ::fit::Error, files: &[Experiment], notes: &[Notes]) -> anyhow::Error {
    let error = match error {
        ::fit::Error::LeftOut(_) => anyhow!("{error}: --allow left-out"),
        ::fit::Error::NoTimes { .. } => {
            let untimed = notes.iter().find_map(|notes| notes.untimed);
            let mut columns: Vec<String> = notes
                .iter()
                .flat_map(|notes| &notes.unused_times)
                .map(|heading| format!("--column \"time={heading}\""))
                .collect();
            columns.sort_unstable();
            columns.dedup();
            let columns = columns.join(" or ");
            anyhow!(
                "{error}{}, or type --sample-interval S",
                match untimed {
                    Some(line) => format!(": complete line {line}, which has no number of a time"),
                    None if columns.is_empty() =>
                        ": no column is in a unit of time; add one".to_owned(),
                    None if columns.contains("[UNIT]") => format!(
                        ": type {columns}, with the unit of the numbers in place of UNIT, such as s"
                    ),
                    None => format!(": type {columns}"),
                }
            )
        }
        ::fit::Error::Times { .. } => anyhow!(
            "{error}; if they start again in each segment and the points follow at equal intervals, type --sample-interval S"
        ),
        ::fit::Error::Contact(contact::Error::UnlikeBodies { .. })
        | ::fit::Error::DifferentBodies { .. } => {
            anyhow!("{error}; if sphere and substrate relax like the film: --all-relax")
        }
        error => error.into(),
    };
    with_doubts(error, files, notes)
}

/// Returns an error, with the doubts about the files that may explain it.
pub fn with_doubts(error: anyhow::Error, files: &[Experiment], notes: &[Notes]) -> anyhow::Error {
    let doubts = told(files, notes).map(|(_, text)| format!("; {text}"));
    match doubts.collect::<String>() {
        none if none.is_empty() => error,
        doubts => anyhow!("{error:#}{doubts}"),
    }
}

/// Returns the doubts about the files: the name of the file, the doubt, and what to type if it is right.
pub fn told<'a>(
    files: &'a [Experiment],
    notes: &'a [Notes],
) -> impl Iterator<Item = (&'a Doubt, String)> {
    files.iter().zip(notes).flat_map(|(file, notes)| {
        let name = &file.measurement.name;
        notes.doubts.iter().map(move |doubt| {
            let mut text = format!("{name}: {}", doubt.text);
            if let Some(remedy) = &doubt.remedy {
                text += &format!("; if so, {}", typed(remedy));
            }
            (doubt, text)
        })
    })
}

/// Returns what to type.
pub fn typed(remedy: &Remedy) -> String {
    match remedy {
        Remedy::Columns(ways) => {
            let way = |named: &Named| {
                let Named { kind, columns, .. } = named;
                let kind = kind.map(|kind| format!(" --kind {}", kind.name()));
                let columns = columns
                    .iter()
                    .map(|(role, heading)| format!(" --column \"{}={heading}\"", role.name()));
                let reduced = named.reduced.map(|reduced| match reduced {
                    Reduced::ContactDepth => " --epsilon 0".to_owned(),
                    Reduced::Separation => " --stiffness N/m".to_owned(),
                });
                let all = kind.into_iter().chain(columns).chain(reduced);
                all.collect::<String>()
            };
            let ways: Vec<String> = ways.iter().map(way).collect();
            let typed = format!("type{}", ways.join(", or"));
            match remedy.to_fill_in() {
                Some(open) => format!("{typed}, {open}"),
                None => typed,
            }
        }
        Remedy::Kind(kinds) => {
            let names: Vec<&str> = kinds.iter().map(|kind| kind.name()).collect();
            format!("type --kind {}", names.join("|"))
        }
        Remedy::Cantilever { sensitivity } => {
            let sensitivity = if *sensitivity {
                " --sensitivity m/V"
            } else {
                ""
            };
            format!("type --stiffness N/m{sensitivity}")
        }
        Remedy::Split => "type --segments split".to_owned(),
        Remedy::BaselineSlope => "type --free ...,baseline-slope".to_owned(),
    }
}
