//! All artefacts of a release in one folder, each tried where nothing else of the project is.
//!
//! `artefacts` makes them. `metadata` checks what describes the release, `zig` compiles for every Linux, `trial` tries the
//! artefacts, `bom` lists what is compiled into them.

mod artefacts;
mod bom;
mod metadata;
mod trial;
mod zig;

use artefacts::{C, OLD_LINUX, STATIC, VERSION, at, here};
pub use artefacts::{check, dist};
