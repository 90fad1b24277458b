//! The interactive page about a table: one HTML file that works without a network.
//!
//! [`Page::html`] fills the template `page.html`, and `form` makes the rows of its settings. In the
//! browser `table.js` evaluates the tensor trains of the page, `grid.js` integrates the other
//! quantities from `Gamma` alone and those of the sphere itself, `material.js` finds the place of a
//! material in the table, `contact.js` computes eqs. 2 to 9, `chart.js` draws, and `page.js` connects
//! the sliders and fields with them.

mod form;
mod html;

pub use self::html::{DIGITS, Illustration, Numbers, Page, Parameter, Range};
pub use form::{SetBy, Setting, list, number};
