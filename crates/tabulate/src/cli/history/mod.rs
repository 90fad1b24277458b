//! `tabulate history`

mod history;
mod program;
mod relaxation;

pub use self::history::{Arguments, run};
