//! What callers get wrong: null pointers, other numbers, other systems.

use std::ffi::CStr;
use std::ptr::{null, null_mut};

use coated_contact::{
    CcContact, CcControl, CcProbe, CcState, CcStatus, CcSystem, cc_contact_free, cc_contact_new,
    cc_error, cc_gradient, cc_load, cc_pull_off, cc_stiffness, cc_table_free, cc_table_read,
};

const LENS: CcSystem = CcSystem {
    probe: CcProbe::Paraboloid as i32,
    probe_radius: 1e-3,
    half_angle: 0.0,
    probe_modulus: 2e6,
    film_modulus: 3.5e6,
    film_poisson_ratio: 0.5,
    film_thickness: 1e-6,
    substrate_modulus: 2e11,
    substrate_poisson_ratio: 0.25,
};

fn error() -> String {
    // SAFETY: it is a text that ends with a zero byte.
    let text = unsafe { CStr::from_ptr(cc_error()) };
    text.to_str().expect("UTF-8").to_owned()
}

/// Asserts that a call fails with a status, and says some words.
fn refused(found: CcStatus, expected: CcStatus, words: &[&str]) {
    let text = error();
    assert_eq!(found, expected, "{text}");
    for word in words {
        assert!(text.contains(word), "{text:?} has no {word:?}");
    }
}

fn made(system: &CcSystem) -> Result<*mut CcContact, CcStatus> {
    let mut contact = null_mut();
    // SAFETY: the pointers are those of objects.
    match unsafe { cc_contact_new(null(), system, 0, &raw mut contact) } {
        CcStatus::Ok => Ok(contact),
        status => Err(status),
    }
}

#[test]
fn systems_that_cannot_be_are_refused() {
    use CcStatus::{Argument, Contact};
    let cases: [(CcSystem, CcStatus, &[&str]); 5] = [
        (
            CcSystem { probe: 9, ..LENS },
            Argument,
            &["probe = 9", "0 to 5"],
        ),
        (CcSystem { probe: -1, ..LENS }, Argument, &["probe = -1"]),
        (
            CcSystem {
                film_poisson_ratio: 0.7,
                ..LENS
            },
            Contact,
            &["0.7"],
        ),
        (
            CcSystem {
                film_thickness: f64::NAN,
                ..LENS
            },
            Contact,
            &["NaN"],
        ),
        (
            CcSystem {
                probe: CcProbe::Cone as i32,
                ..LENS
            },
            Contact,
            &["half angle"],
        ),
    ];
    for (system, status, words) in cases {
        refused(made(&system).expect_err("refused"), status, words);
    }
}

#[test]
fn null_pointers_are_refused_and_nothing_is_written() {
    use CcStatus::{Argument, Contact, Ok};
    let contact = made(&LENS).expect("a contact");
    let (radii, mut loads) = ([65e-6, 2.0], [7.0; 9]);
    // SAFETY: each pointer is null, or that of an object or an array of the length given.
    unsafe {
        refused(
            cc_contact_new(null(), null(), 0, &mut null_mut()),
            Argument,
            &["system"],
        );
        refused(
            cc_contact_new(null(), &LENS, 0, null_mut()),
            Argument,
            &["result"],
        );
        refused(
            cc_load(null(), radii.as_ptr(), 1, 0.04, loads.as_mut_ptr()),
            Argument,
            &["contact"],
        );
        refused(
            cc_load(contact, null(), 2, 0.04, loads.as_mut_ptr()),
            Argument,
            &["contact_radii", "2"],
        );
        refused(
            cc_load(contact, radii.as_ptr(), 1, 0.04, null_mut()),
            Argument,
            &["results"],
        );
        refused(
            cc_load(
                contact,
                radii.as_ptr(),
                usize::MAX,
                0.04,
                loads.as_mut_ptr(),
            ),
            Argument,
            &["fit in memory"],
        );
        assert_eq!(cc_load(contact, null(), 0, 0.04, null_mut()), Ok);
        // The second radius is beyond the sphere: the first load is not written, either.
        refused(
            cc_load(contact, radii.as_ptr(), 2, 0.04, loads.as_mut_ptr()),
            Contact,
            &["2.0 m"],
        );
        refused(
            cc_stiffness(contact, &f64::NAN, 1, loads.as_mut_ptr()),
            Contact,
            &["NaN"],
        );
        refused(
            cc_gradient(contact, 65e-6, 0.04, loads.as_mut_ptr()),
            Contact,
            &["derivatives"],
        );
        let mut state = CcState::default();
        refused(
            cc_pull_off(contact, 0.04, 3, 0.0, &mut state),
            Argument,
            &["control = 3"],
        );
        let spring = CcControl::Spring as i32;
        refused(
            cc_pull_off(contact, 0.04, spring, -1.0, &mut state),
            Contact,
            &["-1.0"],
        );
        refused(
            cc_pull_off(contact, 0.04, 0, 0.0, null_mut()),
            Argument,
            &["state"],
        );
        refused(cc_table_read(null(), &mut null_mut()), Argument, &["path"]);
        refused(
            cc_table_read(c"no such.h5".as_ptr(), &mut null_mut()),
            Contact,
            &["no such.h5"],
        );
        refused(
            cc_table_read(c"Cargo.toml".as_ptr(), &mut null_mut()),
            Contact,
            &["Cargo.toml"],
        );
        assert_eq!((loads, state), ([7.0; 9], CcState::default()));
        cc_contact_free(contact);
        cc_contact_free(null_mut());
        cc_table_free(null_mut());
    }
}
