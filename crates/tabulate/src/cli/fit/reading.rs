//! Reading the files, with what to type where one cannot be read.

use std::path::Path;

use ::fit::data::{Format, Named, Notes, Reading, Remedy, read};
use anyhow::anyhow;

/// Reads a file. An error says which flag helps.
pub fn measured(path: &Path, format: &Format) -> anyhow::Result<Reading> {
    read(path, format).map_err(|error| match error.remedy() {
        Some(remedy) => anyhow!("{error}; {}", typed(&remedy)),
        None => error.into(),
    })
}

/// Returns the error of a fit, with the doubts about signs that may explain it.
pub fn doubted(error: ::fit::Error, notes: &[Notes]) -> anyhow::Error {
    let error = match error {
        ::fit::Error::LeftOut { .. } => anyhow!("{error}: --allow left-out"),
        ::fit::Error::NoTimes { .. } => {
            anyhow!(
                "{error}: name the column, --column \"time=Time [s]\", or type --sample-interval S"
            )
        }
        ::fit::Error::History(contact::HistoryError::UnlikeBodies { .. })
        | ::fit::Error::DifferentBodies { .. } => {
            anyhow!("{error}; if sphere and substrate relax like the film: --all-relax")
        }
        error => error.into(),
    };
    let doubts: String = notes
        .iter()
        .filter_map(|notes| notes.doubt.as_ref())
        .map(|doubt| format!("; {doubt}: if so, {}", typed(&doubt.remedy())))
        .collect();
    if doubts.is_empty() {
        return error;
    }
    anyhow!("{error:#}{doubts}")
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
