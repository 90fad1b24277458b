//! One solve: the error asked for against the error achieved and the time it takes, beside the
//! solver that people would write ([`Nystrom`]).
//!
//! Errors are against `solve_contacts.csv` beside this file, which holds the quantities in
//! quadruple precision to 17 digits and more; it says from where.

use std::sync::LazyLock;

use interp::{Material, Quantities};
use serde::{Deserialize, Serialize};

use super::clock;
use super::deviation::deviation;
use super::nystrom::Nystrom;
use crate::Error;
use crate::solve::solve;

/// A contact, with its quantities from elsewhere.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Contact {
    /// What it is called; contacts of one material have one name.
    pub contact: String,
    /// Contact radius over film thickness.
    pub a_over_t: f64,
    /// `E1/E2*`, or 0 for a rigid sphere.
    pub e1_over_e2: f64,
    /// The film's Poisson ratio.
    pub nu1: f64,
    /// `E0/E2*`, or `E0/E1` under a rigid sphere.
    pub e0_over_e2: f64,
    /// The substrate's Poisson ratio.
    pub nu0: f64,
    /// The true `Pi0`.
    pub pi0: f64,
    /// The true `Eeq`.
    pub eeq: f64,
    /// The true `Gamma`.
    pub gamma: f64,
    /// The true `Delta0`.
    pub delta0: f64,
}

impl Contact {
    /// The material.
    ///
    /// # Panics
    /// If it is not physical, which none of [`contacts`] is.
    pub fn material(&self) -> Material {
        Material::new(self.e1_over_e2, self.nu1, self.e0_over_e2, self.nu0)
            .expect("the contacts are physical")
    }

    /// The true quantities, correctly rounded.
    pub const fn truth(&self) -> Quantities {
        Quantities {
            pi0: self.pi0,
            eeq: self.eeq,
            gamma: self.gamma,
            delta0: self.delta0,
        }
    }
}

/// The contacts that are measured: the paper's material from thick to thin films, then harder ones.
pub fn contacts() -> &'static [Contact] {
    static CONTACTS: LazyLock<Vec<Contact>> = LazyLock::new(|| {
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .from_reader(include_str!("solve_contacts.csv").as_bytes());
        reader
            .deserialize()
            .collect::<Result<_, _>>()
            .expect("the file is sound")
    });
    &CONTACTS
}

/// One solve of one contact.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// What the contact is called.
    pub contact: String,
    /// Contact radius over film thickness.
    pub a_over_t: f64,
    /// `E1/E2*`, or 0 for a rigid sphere.
    pub e1_over_e2: f64,
    /// The film's Poisson ratio.
    pub nu1: f64,
    /// `E0/E2*`, or `E0/E1` under a rigid sphere.
    pub e0_over_e2: f64,
    /// The substrate's Poisson ratio.
    pub nu0: f64,
    /// The method by which [`solve`] answered, [`REFUSED`], or [`NYSTROM`].
    pub method: String,
    /// The relative tolerance asked for; of Nyström's method, that of its kernel.
    pub tolerance: f64,
    /// The size of the system: modes, unknowns or nodes; 0 where refused.
    pub size: u64,
    /// The largest relative error of the four quantities as the solve estimates it, or as it says
    /// that it would be where refused. Nyström's method says nothing.
    pub error_estimated: Option<f64>,
    /// The largest relative error of the four quantities, rounding to a double included; none where
    /// refused.
    pub error: Option<f64>,
    /// The time on one core: a median.
    pub seconds: f64,
}

/// What contacts of the paper's material are called.
pub const PAPER: &str = "the paper's material";
/// The method of rows without an answer.
pub const REFUSED: &str = "refused";
/// The method of rows by [`Nystrom`].
pub const NYSTROM: &str = "Nystrom";

/// The relative tolerances asked for.
pub const TOLERANCES: [f64; 12] = [
    1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13,
];

/// The numbers of nodes given to Nyström's method.
const SIZES: [usize; 16] = [
    4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256, 384, 512, 768,
];
/// Its kernel is `t/a` wide, and more nodes than some for each width and some for the rest add
/// nothing but time.
const RESOLVED: (f64, f64) = (64.0, 8.0);
/// Beyond this `a/t` that takes seconds.
const NYSTROM_REACH: f64 = 100.0;
/// Tolerances of its kernel, the tightest first.
const KERNEL: [f64; 7] = [1e-14, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2];
/// How much a looser kernel may add to the error.
const SPOILT: f64 = 1.5;
/// Errors below this are rounding, which differs between processors.
const ROUNDING: f64 = 1e-14;

/// Seconds for the time of a row.
const BUDGET: f64 = 0.01;
/// As often each row is timed, in turns with all others of its contact; the fastest median counts,
/// as machines are busy at times.
const ROUNDS: usize = 3;

/// Measures all rows, contact by contact; `progress` is called after each.
///
/// Nyström's method is given its sizes and with each the loosest kernel that does not spoil its
/// error, found with knowledge of the answer.
pub fn measure(progress: &dyn Fn()) -> Vec<Row> {
    let rows = contacts().iter().map(|contact| {
        let largest = if contact.a_over_t <= NYSTROM_REACH {
            RESOLVED.0 + RESOLVED.1 * contact.a_over_t
        } else {
            0.0
        };
        let sizes = SIZES.into_iter().filter(|&size| size as f64 <= largest);
        let own = TOLERANCES
            .into_iter()
            .map(|tolerance| row(contact, tolerance));
        let mut rows: Vec<Row> = own
            .chain(sizes.map(|size| nystrom_row(contact, size)))
            .collect();
        for _ in 0..ROUNDS {
            rows.iter_mut()
                .for_each(|row| row.seconds = row.seconds.min(seconds(contact, row)));
        }
        progress();
        rows
    });
    rows.flatten().collect()
}

/// The median time of what a row tells of.
fn seconds(contact: &Contact, row: &Row) -> f64 {
    let (x, material, tolerance) = (contact.a_over_t, contact.material(), row.tolerance);
    if row.method == NYSTROM {
        let nystrom = Nystrom::new(row.size as usize);
        clock::seconds(BUDGET, || nystrom.solve(x, &material, tolerance))
    } else {
        clock::seconds(BUDGET, || solve(x, &material, tolerance))
    }
}

/// What [`solve`] answers.
fn row(contact: &Contact, tolerance: f64) -> Row {
    let (x, material) = (contact.a_over_t, contact.material());
    let row = |method: &str| Row {
        method: method.to_owned(),
        tolerance,
        ..blank(contact)
    };
    match solve(x, &material, tolerance) {
        Ok(solution) => Row {
            size: solution.modes as u64,
            error_estimated: Some(solution.error),
            error: Some(deviation(&solution.quantities, &contact.truth())),
            ..row(solution.method.name())
        },
        Err(Error::NotConverged { reached, .. }) => Row {
            error_estimated: Some(reached),
            ..row(REFUSED)
        },
        Err(_) => row(REFUSED),
    }
}

/// What [`Nystrom`] answers with `size` nodes.
fn nystrom_row(contact: &Contact, size: usize) -> Row {
    let (x, material) = (contact.a_over_t, contact.material());
    let nystrom = Nystrom::new(size);
    let error =
        |tolerance: f64| deviation(&nystrom.solve(x, &material, tolerance), &contact.truth());
    let smallest = error(KERNEL[0]);
    let kernels = KERNEL
        .iter()
        .map(|&tolerance| (tolerance, error(tolerance)));
    let (tolerance, error) = kernels
        .take_while(|(_, error)| *error <= SPOILT * smallest.max(ROUNDING))
        .last()
        .unwrap_or((KERNEL[0], smallest));
    Row {
        method: NYSTROM.to_owned(),
        tolerance,
        size: size as u64,
        error: Some(error),
        ..blank(contact)
    }
}

/// The row of a contact before anything is known.
fn blank(contact: &Contact) -> Row {
    Row {
        contact: contact.contact.clone(),
        a_over_t: contact.a_over_t,
        e1_over_e2: contact.e1_over_e2,
        nu1: contact.nu1,
        e0_over_e2: contact.e0_over_e2,
        nu0: contact.nu0,
        method: String::new(),
        tolerance: f64::NAN,
        size: 0,
        error_estimated: None,
        error: None,
        seconds: f64::INFINITY,
    }
}

/// The rows of each contact.
pub fn by_contact(rows: &[Row]) -> impl Iterator<Item = &[Row]> {
    rows.chunk_by(|a, b| a.contact == b.contact && a.a_over_t == b.a_over_t)
}

/// The fastest of the rows with an error of at most `error` and a method that is `wanted`.
pub fn fastest(rows: &[Row], error: f64, wanted: impl Fn(&str) -> bool) -> Option<&Row> {
    let enough = rows
        .iter()
        .filter(|row| wanted(&row.method) && row.error.is_some_and(|reached| reached <= error));
    enough.min_by(|a, b| a.seconds.total_cmp(&b.seconds))
}

/// The rows with an error that no faster one comes below, of the methods that are `wanted`: the
/// fastest first.
pub fn front(rows: &[Row], wanted: impl Fn(&str) -> bool) -> Vec<&Row> {
    let mut answered: Vec<&Row> = rows
        .iter()
        .filter(|row| wanted(&row.method) && row.error.is_some())
        .collect();
    answered.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    let mut front: Vec<&Row> = Vec::new();
    for row in answered {
        if front.last().is_none_or(|best| row.error < best.error) {
            front.push(row);
        }
    }
    front
}

/// The rows in short, as Markdown: the paper's material, harder contacts, and Nyström's method
/// against the solve.
pub fn markdown(rows: &[Row]) -> String {
    let (paper, harder): (Vec<&[Row]>, Vec<&[Row]>) =
        by_contact(rows).partition(|rows| rows[0].contact == PAPER);
    [
        paper_table(&paper),
        harder_table(&harder),
        nystrom_table(by_contact(rows)),
    ]
    .concat()
}

/// Time and error achieved at some tolerances.
fn paper_table(contacts: &[&[Row]]) -> String {
    let row = |rows: &&[Row]| {
        let cells = [1e-4, 1e-6, 1e-8, 1e-10, 1e-12].map(|tolerance| {
            solved(rows, tolerance, |row, error| {
                format!("{} ({error:.0e})", clock::human(row.seconds))
            })
        });
        let method = solved(rows, 1e-10, |row, _| row.method.clone());
        format!("| {} |{}{method}\n", rows[0].a_over_t, cells.concat())
    };
    let rows: String = contacts.iter().map(row).collect();
    format!(
        "The paper's material: time (error achieved) by tolerance\n\n\
         | a/t | 1e-4 | 1e-6 | 1e-8 | 1e-10 | 1e-12 | method at 1e-10 |\n|---|---|---|---|---|---|---|\n{rows}"
    )
}

/// Method, size, time and both errors at some tolerances.
fn harder_table(contacts: &[&[Row]]) -> String {
    let row = |rows: &&[Row]| {
        let cells = [1e-6, 1e-8, 1e-10].map(|tolerance| {
            solved(rows, tolerance, |row, error| {
                let (time, estimated) = (
                    clock::human(row.seconds),
                    row.error_estimated.unwrap_or(f64::NAN),
                );
                format!(
                    "{} {}, {time} ({estimated:.0e}, {error:.0e})",
                    row.method, row.size
                )
            })
        });
        format!(
            "| {} | {} |{}\n",
            rows[0].contact,
            rows[0].a_over_t,
            cells.concat()
        )
    };
    let rows: String = contacts.iter().map(row).collect();
    format!(
        "\nHarder contacts: method and size of the system, time (error stated, achieved) by tolerance\n\n\
         | contact | a/t | 1e-6 | 1e-8 | 1e-10 |\n|---|---|---|---|---|\n{rows}"
    )
}

/// A cell of a table about the solve to one tolerance.
fn solved(rows: &[Row], tolerance: f64, cell: impl Fn(&Row, f64) -> String) -> String {
    let row = rows
        .iter()
        .find(|row| row.tolerance == tolerance && row.method != NYSTROM);
    let text = row.map(|row| {
        row.error
            .map_or_else(|| REFUSED.to_owned(), |error| cell(row, error))
    });
    format!(" {} |", text.unwrap_or_default())
}

/// What Nyström's method takes for some errors, and how many times that is what the solve takes.
fn nystrom_table<'a>(contacts: impl Iterator<Item = &'a [Row]>) -> String {
    let row = |rows: &[Row]| {
        let cells = [1e-2, 1e-4, 1e-6, 1e-8, 1e-10].map(|error| {
            let pair = (
                fastest(rows, error, |method| method == NYSTROM),
                fastest(rows, error, |method| method != NYSTROM),
            );
            match pair {
                (Some(nystrom), Some(own)) => {
                    let ratio = nystrom.seconds / own.seconds;
                    format!(
                        " {} nodes, {} ({ratio:.0}) |",
                        nystrom.size,
                        clock::human(nystrom.seconds)
                    )
                }
                _ => " not reached |".to_owned(),
            }
        });
        format!(
            "| {} | {} |{}\n",
            rows[0].contact,
            rows[0].a_over_t,
            cells.concat()
        )
    };
    let rows: String = contacts
        .filter(|rows| rows.iter().any(|row| row.method == NYSTROM))
        .map(row)
        .collect();
    format!(
        "\nNyström's method: nodes, time (times that of the solve) by error achieved\n\n\
         | contact | a/t | 1e-2 | 1e-4 | 1e-6 | 1e-8 | 1e-10 |\n|---|---|---|---|---|---|---|\n{rows}"
    )
}
