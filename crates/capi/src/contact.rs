//! Contacts, and what they answer.

use contact::{Contact, Input};
use interp::{Error, Table};

use crate::bodies::{CcState, CcSystem, control};
use crate::guard::{CcStatus, Failure, free, give, guarded, numbers, shared, write};
use crate::table::CcTable;

/// A probe on a film on a substrate, looked up.
pub struct CcContact(Contact);

/// Looks a system up in a table; a null `table` is the one that is compiled in, which holds every
/// probe, film and substrate with Poisson ratios from 0 to 0.5, to 1e-6.
///
/// With a `with_gradient` other than 0 the contact answers `cc_gradient`; the look-up then takes
/// longer. Free the contact by `cc_contact_free`.
///
/// # Safety
/// `table` is null or comes from `cc_table_read`; `system` is null or points at a system; `contact` is
/// null or has room for a pointer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cc_contact_new(
    table: *const CcTable,
    system: *const CcSystem,
    with_gradient: i32,
    contact: *mut *mut CcContact,
) -> CcStatus {
    guarded(|| {
        // SAFETY: the pointers are as stated above.
        let (table, system) = unsafe { (table.as_ref(), shared(system, "system")?) };
        let table = table.map_or_else(Table::embedded, |table| &table.0);
        let system = system.read()?;
        let made = if with_gradient == 0 {
            Contact::in_table(table, &system)?
        } else {
            Contact::in_table_with_gradient(table, &system)?
        };
        // SAFETY: `contact` is as stated above.
        unsafe { give(CcContact(made), contact) }
    })
}

/// Frees a contact. A null pointer is ignored.
///
/// # Safety
/// `contact` is null, or comes from `cc_contact_new` and has not been freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cc_contact_free(contact: *mut CcContact) {
    // SAFETY: as stated above.
    unsafe { free(contact) };
}

/// Computes one number for each of `count` contact radii, and writes them if none fails.
///
/// # Safety
/// As [`cc_load`].
unsafe fn at_all(
    contact: *const CcContact,
    [radii, results]: [*const f64; 2],
    count: usize,
    one: impl Fn(&Contact, f64) -> Result<f64, Error>,
) -> CcStatus {
    guarded(|| {
        // SAFETY: the pointers are those of `cc_load`.
        let (contact, radii) = unsafe {
            (
                shared(contact, "contact")?,
                numbers(radii, count, "contact_radii")?,
            )
        };
        let found = radii.iter().map(|&a| one(&contact.0, a));
        let found: Vec<f64> = found.collect::<Result<_, _>>()?;
        // SAFETY: the results have room, as stated at `cc_load`.
        unsafe { write(&found, results.cast_mut(), "the array of the results") }
    })
}

/// Computes the load (N) at each of `count` contact radii (m) for a work of adhesion (J/m^2).
///
/// # Safety
/// `contact` is null or comes from `cc_contact_new`; `contact_radii` holds `count` numbers; `loads` has
/// room for as many, and may be the same array.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cc_load(
    contact: *const CcContact,
    contact_radii: *const f64,
    count: usize,
    work_of_adhesion: f64,
    loads: *mut f64,
) -> CcStatus {
    let load = |contact: &Contact, a| contact.load(a, work_of_adhesion);
    // SAFETY: as stated above.
    unsafe { at_all(contact, [contact_radii, loads], count, load) }
}

/// Computes the penetration (m) at each of `count` contact radii (m) for a work of adhesion (J/m^2).
///
/// # Safety
/// As `cc_load`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cc_penetration(
    contact: *const CcContact,
    contact_radii: *const f64,
    count: usize,
    work_of_adhesion: f64,
    penetrations: *mut f64,
) -> CcStatus {
    let penetration = |contact: &Contact, a| {
        let both = contact.load_and_penetration(a, work_of_adhesion);
        both.map(|(_, penetration)| penetration)
    };
    // SAFETY: as stated above.
    unsafe { at_all(contact, [contact_radii, penetrations], count, penetration) }
}

/// Computes the contact stiffness dF/d delta (N/m) of a pinned contact line at each of `count` contact
/// radii (m).
///
/// # Safety
/// As `cc_load`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cc_stiffness(
    contact: *const CcContact,
    contact_radii: *const f64,
    count: usize,
    stiffnesses: *mut f64,
) -> CcStatus {
    // SAFETY: as stated above.
    unsafe {
        at_all(
            contact,
            [contact_radii, stiffnesses],
            count,
            Contact::stiffness,
        )
    }
}

/// Finds the last stable state of a separation. `control` is a value of `CcControl`;
/// `spring_stiffness` (N/m) is read for `CC_CONTROL_SPRING` alone.
///
/// # Safety
/// `contact` is null or comes from `cc_contact_new`; `state` is null or has room for a state.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cc_pull_off(
    contact: *const CcContact,
    work_of_adhesion: f64,
    control: i32,
    spring_stiffness: f64,
    state: *mut CcState,
) -> CcStatus {
    guarded(|| {
        // SAFETY: it is as stated above.
        let contact = unsafe { shared(contact, "contact")? };
        let control = self::control(control, spring_stiffness)?;
        let found = contact.0.pull_off(work_of_adhesion, control)?;
        if state.is_null() {
            return Err(Failure::argument(
                "state is a null pointer: give room for one",
            ));
        }
        // SAFETY: it is not null, and has room for a state.
        unsafe { state.write(found.into()) };
        Ok(())
    })
}

/// Computes the derivatives of the load at a contact radius (m) and a work of adhesion (J/m^2) with
/// respect to nine inputs, in N per unit of the input: contact radius, work of adhesion, probe radius,
/// probe modulus (reduced), film thickness, film modulus, film Poisson ratio, substrate modulus,
/// substrate Poisson ratio. A derivative that is not known, such as that by the radius of a cone, is NaN.
///
/// # Safety
/// `contact` is null or comes from `cc_contact_new` with a gradient; `derivatives` is null or has room
/// for nine numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cc_gradient(
    contact: *const CcContact,
    contact_radius: f64,
    work_of_adhesion: f64,
    derivatives: *mut f64,
) -> CcStatus {
    guarded(|| {
        // SAFETY: it is as stated above.
        let contact = unsafe { shared(contact, "contact")? };
        let gradient = contact.0.gradient(contact_radius, work_of_adhesion)?;
        let by = |input| gradient.by(input).map_or(f64::NAN, |by| by.load);
        // SAFETY: it is as stated above.
        unsafe { write(&Input::ALL.map(by), derivatives, "derivatives") }
    })
}
