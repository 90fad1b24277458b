//! Tables, contacts, and what a contact answers.

use std::ffi::{CStr, c_char};
use std::fs::File;
use std::io::Read;
use std::mem::MaybeUninit;
use std::ptr;

use contact::{Contact, Control, Error, Input};
use interp::{Table, is_packed};

use crate::guard::{CcStatus, Failure, array, given, guarded};
use crate::system::{CcState, CcSystem};

/// A table of contacts.
pub struct CcTable(Table);

/// A probe on a film on a substrate, looked up.
pub struct CcContact(Contact);

/// Reads a table, in HDF5 or packed, from the file of a `path` in UTF-8.
///
/// Free the table by `cc_table_free` after the last contact in it is made. A contact keeps no table.
///
/// # Safety
/// `path` is null or a text that ends with a zero byte.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cc_table_read(
    path: *const c_char,
    table: Option<&mut MaybeUninit<Box<CcTable>>>,
) -> CcStatus {
    guarded(|| {
        given((!path.is_null()).then_some(()), "path")?;
        // SAFETY: it is not null, and ends with a zero byte.
        let path = unsafe { CStr::from_ptr(path) }.to_str();
        let path = path.map_err(|_| Failure::argument("path is not in UTF-8"))?;
        let table = given(table, "table")?;
        let mut start = [0; 8];
        let started = File::open(path).and_then(|mut file| file.read_exact(&mut start));
        let read = if started.is_ok() && is_packed(&start) {
            Table::read(path)
        } else {
            Table::open(path)
        };
        table.write(Box::new(CcTable(read?)));
        Ok(())
    })
}

/// Frees a table. A null pointer is ignored.
#[unsafe(no_mangle)]
pub extern "C" fn cc_table_free(table: Option<Box<CcTable>>) {
    drop(table);
}

/// Looks a system up in a table; a null `table` is the one that is compiled in. To 1e-6 it holds contact radii from
/// 1e-3 to 1e3 film thicknesses, Poisson ratios from 0 to 0.5, probes and substrates of any modulus, and films up to 1e10
/// times as stiff as both together. Smaller and larger contacts are answered by expansions where these are as accurate.
///
/// Free the contact by `cc_contact_free`.
#[unsafe(no_mangle)]
pub extern "C" fn cc_contact_new(
    table: Option<&CcTable>,
    system: Option<&CcSystem>,
    contact: Option<&mut MaybeUninit<Box<CcContact>>>,
) -> CcStatus {
    guarded(|| {
        let table = match table {
            Some(CcTable(table)) => table,
            None => Table::embedded(),
        };
        let system = given(system, "system")?.read()?;
        let room = given(contact, "contact")?;
        let made = Contact::in_table_with_gradient(table, &system)?;
        room.write(Box::new(CcContact(made)));
        Ok(())
    })
}

/// Frees a contact. A null pointer is ignored.
#[unsafe(no_mangle)]
pub extern "C" fn cc_contact_free(contact: Option<Box<CcContact>>) {
    drop(contact);
}

/// Computes one number for each of `count` contact radii, and writes them if none fails.
///
/// # Safety
/// As [`cc_load`].
unsafe fn at_each(
    contact: Option<&CcContact>,
    (radii, count, results): (*const f64, usize, *mut f64),
    number: impl Fn(&Contact, f64) -> Result<f64, Error>,
) -> CcStatus {
    guarded(|| {
        let contact = &given(contact, "contact")?.0;
        array(radii, count, "contact_radii")?;
        array(results, count, "the array of the results")?;
        // SAFETY: there are `count` radii, as stated at `cc_load`.
        let found = (0..count).map(|i| number(contact, unsafe { *radii.add(i) }));
        let found: Vec<f64> = found.collect::<Result<_, _>>()?;
        // SAFETY: the results have room, as stated at `cc_load`.
        unsafe { ptr::copy(found.as_ptr(), results, count) };
        Ok(())
    })
}

/// Computes the load (N) at each of `count` contact radii (m) for a work of adhesion (J/m^2).
///
/// # Safety
/// `contact_radii` is null or holds `count` numbers; `loads` is null or has room for as many, and may be
/// the same array.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cc_load(
    contact: Option<&CcContact>,
    contact_radii: *const f64,
    count: usize,
    work_of_adhesion: f64,
    loads: *mut f64,
) -> CcStatus {
    let load = |contact: &Contact, a| contact.load(a, work_of_adhesion);
    // SAFETY: as stated above.
    unsafe { at_each(contact, (contact_radii, count, loads), load) }
}

/// Computes the penetration (m) at each of `count` contact radii (m) for a work of adhesion (J/m^2).
///
/// # Safety
/// As `cc_load`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cc_penetration(
    contact: Option<&CcContact>,
    contact_radii: *const f64,
    count: usize,
    work_of_adhesion: f64,
    penetrations: *mut f64,
) -> CcStatus {
    let both = |contact: &Contact, a| contact.load_and_penetration(a, work_of_adhesion);
    let penetration = |contact: &Contact, a| both(contact, a).map(|(_, penetration)| penetration);
    // SAFETY: as stated above.
    unsafe { at_each(contact, (contact_radii, count, penetrations), penetration) }
}

/// Computes the contact stiffness dF/d delta (N/m) of a pinned contact line at each of `count` contact
/// radii (m).
///
/// # Safety
/// As `cc_load`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cc_stiffness(
    contact: Option<&CcContact>,
    contact_radii: *const f64,
    count: usize,
    stiffnesses: *mut f64,
) -> CcStatus {
    // SAFETY: as stated above.
    unsafe {
        at_each(
            contact,
            (contact_radii, count, stiffnesses),
            Contact::stiffness,
        )
    }
}

/// Finds the last stable state of a separation by a machine of the stiffness `machine_stiffness` (N/m):
/// 0 is a dead weight, infinity a rigid machine, and a cantilever lies between.
#[unsafe(no_mangle)]
pub extern "C" fn cc_pull_off(
    contact: Option<&CcContact>,
    work_of_adhesion: f64,
    machine_stiffness: f64,
    state: Option<&mut MaybeUninit<CcState>>,
) -> CcStatus {
    guarded(|| {
        let (contact, state) = (given(contact, "contact")?, given(state, "state")?);
        let control = match machine_stiffness {
            0.0 => Control::Load,
            f64::INFINITY => Control::Displacement,
            stiffness => Control::Spring { stiffness },
        };
        let last = contact.0.pull_off(work_of_adhesion, control)?;
        state.write(CcState {
            contact_radius: last.contact_radius,
            load: last.load,
            penetration: last.penetration,
        });
        Ok(())
    })
}

/// Computes the derivatives of the load at a contact radius (m) and a work of adhesion (J/m^2) with
/// respect to nine inputs, in N per unit of the input: contact radius, work of adhesion, probe radius,
/// probe modulus (reduced), film thickness, film modulus, film Poisson ratio, substrate modulus,
/// substrate Poisson ratio. A derivative that is not known, such as that by the radius of a cone, is NaN.
///
/// # Safety
/// `derivatives` is null or has room for nine numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cc_gradient(
    contact: Option<&CcContact>,
    contact_radius: f64,
    work_of_adhesion: f64,
    derivatives: *mut f64,
) -> CcStatus {
    guarded(|| {
        let contact = given(contact, "contact")?;
        let gradient = contact.0.gradient(contact_radius, work_of_adhesion)?;
        let by = |input| gradient.by(input).map_or(f64::NAN, |by| by.load);
        let found = Input::ALL.map(by);
        array(derivatives, found.len(), "derivatives")?;
        // SAFETY: there is room, as stated above.
        unsafe { ptr::copy(found.as_ptr(), derivatives, found.len()) };
        Ok(())
    })
}
