//! One solve: the tolerance, the error achieved and the time, beside a plain dense solver
//! ([`Nystrom`](crate::nystrom::Nystrom)).
//!
//! Errors are deviations from the quantities in `contacts.csv` beside this file. They were computed
//! in quadruple precision and are printed to 17 digits and more; the head of the file names the
//! program.

mod rows;
mod summary;

pub use self::rows::{
    Contact, NYSTROM, PAPER, REFUSED, Row, TOLERANCES, by_contact, contacts, fastest, front,
    measure,
};
pub use self::summary::markdown;
