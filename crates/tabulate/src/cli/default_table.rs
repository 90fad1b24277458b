//! The table that a command takes where none is named: that of the default scene.

use std::borrow::Cow;

use interp::Table;

use super::generate::read_scene;
use super::progress::Bars;
use super::table_name::TableName;
use crate::measure::Made;
use crate::table::low_rank;

/// The tolerance of the packed table of the default scene.
const TOLERANCE: f64 = 1e-6;
/// The tolerance of the table that is packed, which leaves room for the truncation.
const OWN_TOLERANCE: f64 = 2e-7;

/// The help of an argument that names such a table.
pub const HELP: &str = "[default: the packed table of the default scene, made first]";

/// Reads the table, or makes the packed table of the default scene.
pub fn read_or_make(name: Option<&TableName>) -> anyhow::Result<Cow<'static, Table>> {
    if let Some(name) = name {
        return name.read();
    }
    let scene = read_scene(None, Some(OWN_TOLERANCE))?;
    let bars = Bars::new();
    let made = Made::new(&scene, None, &bars)?;
    let packed = low_rank(&made.table, TOLERANCE, None, None, &bars)?;
    Ok(Cow::Owned(packed))
}
