//! The contacts that are solved, and the rows that are measured of them.

use std::sync::LazyLock;

use interp::{Material, Quantities};
use serde::{Deserialize, Serialize};
use solve::solve;

use crate::Measurement;
use crate::clock::Timing;
use crate::deviation::deviation;
use crate::nystrom::Nystrom;

/// A contact and its four quantities, computed independently.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Contact {
    /// Its name; contacts of one material have one name.
    pub contact: String,
    /// Contact radius over film thickness.
    pub a_over_t: f64,
    /// `E1/E2*`; 0 for a rigid sphere.
    pub e1_over_e2: f64,
    /// The film's Poisson ratio.
    pub nu1: f64,
    /// `E0/E2*`; `E0/E1` under a rigid sphere.
    pub e0_over_e2: f64,
    /// The substrate's Poisson ratio.
    pub nu0: f64,
    /// `Pi0`, correctly rounded.
    pub pi0: f64,
    /// `Eeq`, correctly rounded.
    pub eeq: f64,
    /// `Gamma`, correctly rounded.
    pub gamma: f64,
    /// `Delta0`, correctly rounded.
    pub delta0: f64,
}

impl Contact {
    /// Returns the material.
    ///
    /// # Panics
    /// If it is not physical. All [`contacts`] are.
    pub fn material(&self) -> Material {
        Material::new(self.e1_over_e2, self.nu1, self.e0_over_e2, self.nu0)
            .expect("the contacts are physical")
    }

    /// Returns the four true quantities.
    pub const fn truth(&self) -> Quantities {
        Quantities {
            pi0: self.pi0,
            eeq: self.eeq,
            gamma: self.gamma,
            delta0: self.delta0,
        }
    }
}

/// Returns the contacts that are measured: the paper's material from thick to thin films, then
/// harder ones.
pub fn contacts() -> &'static [Contact] {
    static CONTACTS: LazyLock<Vec<Contact>> = LazyLock::new(|| {
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .from_reader(include_str!("contacts.csv").as_bytes());
        reader
            .deserialize()
            .collect::<Result<_, _>>()
            .expect("contacts.csv has a contact on each line")
    });
    &CONTACTS
}

/// One solve of one contact.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// The contact's name.
    pub contact: String,
    /// Contact radius over film thickness.
    pub a_over_t: f64,
    /// `E1/E2*`; 0 for a rigid sphere.
    pub e1_over_e2: f64,
    /// The film's Poisson ratio.
    pub nu1: f64,
    /// `E0/E2*`; `E0/E1` under a rigid sphere.
    pub e0_over_e2: f64,
    /// The substrate's Poisson ratio.
    pub nu0: f64,
    /// The method that [`solve()`] chose, [`REFUSED`], or [`NYSTROM`].
    pub method: String,
    /// The relative tolerance of the solve; for Nyström's method, that of its kernel.
    pub tolerance: f64,
    /// The size of the system: modes, unknowns or nodes; 0 where refused.
    pub size: u64,
    /// The largest relative error of the four quantities by the solve's own estimate, also where it
    /// refused. Nyström's method has no estimate.
    pub error_estimated: Option<f64>,
    /// The largest relative error of the four quantities, at least half a unit of rounding; none
    /// where refused.
    pub error: Option<f64>,
    /// The time on one core: a median.
    pub seconds: f64,
}

impl Measurement for Row {}

/// The name of the contacts of the paper's material.
pub const PAPER: &str = "the paper's material";
/// The method in rows of solves that were refused.
pub const REFUSED: &str = "refused";
/// The method in rows of [`Nystrom`].
pub const NYSTROM: &str = "Nystrom";

/// The relative tolerances of the solves.
pub const TOLERANCES: [f64; 12] = [
    1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13,
];

/// The numbers of nodes of Nyström's method.
const SIZES: [usize; 16] = [
    4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256, 384, 512, 768,
];
/// The most nodes: a number, and another for each `a/t`, as the kernel is `t/a` wide. More nodes
/// take more time and lower no error.
const RESOLVED: (f64, f64) = (64.0, 8.0);
/// The largest `a/t` of Nyström's method. Beyond it one solve takes seconds.
pub(super) const NYSTROM_REACH: f64 = 100.0;
/// The tolerances of its kernel, from the tightest on.
const KERNEL: [f64; 7] = [1e-14, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2];
/// The factor by which a looser kernel may raise the error.
const SPOILT: f64 = 1.5;
/// Errors below this are rounding, and differ between processors.
const ROUNDING: f64 = 1e-14;

/// The seconds spent on timing a row once.
const BUDGET: f64 = 0.01;
/// The number of times that each row is timed, in turns with the other rows of its contact. The
/// fastest median counts, as other programs slow the machine down at times.
const ROUNDS: usize = 3;

/// Measures all rows, contact by contact, and calls `progress` after each contact.
///
/// Nyström's method has a row for each number of nodes. Its kernel has the loosest tolerance that
/// does not raise the error, which is found by comparison with the true quantities.
pub fn measure(timing: Timing, progress: &dyn Fn()) -> Vec<Row> {
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
        for _ in 0..timing.rounds(ROUNDS) {
            rows.iter_mut()
                .for_each(|row| row.seconds = row.seconds.min(seconds(timing, contact, row)));
        }
        progress();
        rows
    });
    rows.flatten().collect()
}

/// Returns the time of the solve of a row.
fn seconds(timing: Timing, contact: &Contact, row: &Row) -> f64 {
    let (x, material, tolerance) = (contact.a_over_t, contact.material(), row.tolerance);
    if row.method == NYSTROM {
        let nystrom = Nystrom::new(row.size as usize);
        timing.seconds(BUDGET, || nystrom.solve(x, &material, tolerance))
    } else {
        timing.seconds(BUDGET, || solve(x, &material, tolerance))
    }
}

/// Returns the row of [`solve()`] at a tolerance, without its time.
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
        Err(solve::Error::NotConverged { reached, .. }) => Row {
            error_estimated: Some(reached),
            ..row(REFUSED)
        },
        Err(_) => row(REFUSED),
    }
}

/// Returns the row of [`Nystrom`] with `size` nodes, without its time.
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

/// Returns the row of a contact before anything is measured.
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

/// Returns the rows of each contact.
pub fn by_contact(rows: &[Row]) -> impl Iterator<Item = &[Row]> {
    rows.chunk_by(|a, b| a.contact == b.contact && a.a_over_t == b.a_over_t)
}

/// Returns the fastest of the rows whose method is `wanted` and whose error is at most `error`.
pub fn fastest(rows: &[Row], error: f64, wanted: impl Fn(&str) -> bool) -> Option<&Row> {
    let enough = rows
        .iter()
        .filter(|row| wanted(&row.method) && row.error.is_some_and(|reached| reached <= error));
    enough.min_by(|a, b| a.seconds.total_cmp(&b.seconds))
}

/// Returns the rows that have a smaller error than every faster row, from the fastest on. Only
/// methods that are `wanted` count.
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
