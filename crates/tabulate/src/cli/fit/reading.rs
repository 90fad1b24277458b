//! Reading the files, with what to type where one cannot be read.

use std::path::Path;

use ::fit::data::{Format, Reading, Remedy, read};
use anyhow::anyhow;

/// Reads a file. An error says which flag helps.
pub fn measured(path: &Path, format: &Format) -> anyhow::Result<Reading> {
    read(path, format).map_err(|error| match error.remedy() {
        Some(remedy) => anyhow!("{error}; {}", typed(&remedy)),
        None => error.into(),
    })
}

/// Returns what to type.
pub fn typed(remedy: &Remedy) -> String {
    match remedy {
        Remedy::Columns { kind, columns } => {
            let kind = kind.map(|kind| format!(" --kind {}", kind.name()));
            let columns: String = columns
                .iter()
                .map(|(role, heading)| format!(" --column \"{}={heading}\"", role.name()))
                .collect();
            format!("type{}{columns}", kind.unwrap_or_default())
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
