//! Reading the files, with what to type where one cannot be read.

use std::path::Path;

use ::fit::Experiment;
use ::fit::data::{Doubt, Format, Named, Notes, Reading, Remedy, read};
use anyhow::anyhow;

/// Reads a file. An error says which flag helps.
pub fn measured(path: &Path, format: &Format) -> anyhow::Result<Reading> {
    read(path, format).map_err(|error| match error.remedy() {
        Some(remedy) => anyhow!("{error}; {}", typed(&remedy)),
        None => error.into(),
    })
}

/// Returns the error of a fit, with the doubts about the files that may explain it.
pub fn doubted(error: ::fit::Error, files: &[Experiment], notes: &[Notes]) -> anyhow::Error {
    let error = match error {
        ::fit::Error::LeftOut { .. } => anyhow!("{error}: --allow left-out"),
        ::fit::Error::NoTimes { .. } => {
            let untimed = notes.iter().find_map(|notes| notes.untimed);
            let line = untimed.map(|line| format!(" (line {line} has no number of a time)"));
            anyhow!(
                "{error}{}: name the column, --column \"time=Time [s]\", or type --sample-interval S",
                line.unwrap_or_default()
            )
        }
        ::fit::Error::History(contact::HistoryError::UnlikeBodies { .. })
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
            let text = match doubt.remedy() {
                Some(remedy) => format!("{name}: {doubt}; if so, {}", typed(&remedy)),
                None => format!("{name}: {doubt}"),
            };
            (doubt, text)
        })
    })
}

/// Returns what to type.
pub fn typed(remedy: &Remedy) -> String {
    match remedy {
        Remedy::Columns(ways) => {
            let way = |Named { kind, columns }: &Named| {
                let kind = kind.map(|kind| format!(" --kind {}", kind.name()));
                let columns = columns
                    .iter()
                    .map(|(role, heading)| format!(" --column \"{}={heading}\"", role.name()));
                kind.into_iter().chain(columns).collect::<String>()
            };
            let ways: Vec<String> = ways.iter().map(way).collect();
            format!("type{}", ways.join(", or"))
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
    }
}
