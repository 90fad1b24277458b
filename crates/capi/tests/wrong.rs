//! What callers get wrong: null pointers, other numbers, other systems.

use std::ffi::CStr;
use std::mem::MaybeUninit;
use std::ptr::{null, null_mut};

use contact::Contact;
use interp::{Elastic, Probe, System, Table};

use coated_contact::{
    CcContact, CcProbe, CcState, CcStatus, CcSystem, cc_contact_free, cc_contact_new, cc_error,
    cc_gradient, cc_load, cc_pull_off, cc_stiffness, cc_table_free, cc_table_read,
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

/// Asserts that a call fails with a status, and says some words, which `; ` parts.
#[track_caller]
fn refused(found: CcStatus, expected: CcStatus, words: &str) {
    let text = error();
    assert_eq!(found, expected, "{text}");
    for word in words.split("; ") {
        assert!(text.contains(word), "{text:?} has no {word:?}");
    }
}

/// Asserts that an argument of a call is refused.
#[track_caller]
fn no_argument(found: CcStatus, words: &str) {
    refused(found, CcStatus::Argument, words);
}

/// Asserts that no contact has the numbers of a call.
#[track_caller]
fn no_contact(found: CcStatus, words: &str) {
    refused(found, CcStatus::Contact, words);
}

fn made(system: &CcSystem) -> Result<Box<CcContact>, CcStatus> {
    let mut contact = MaybeUninit::uninit();
    match cc_contact_new(None, Some(system), Some(&mut contact)) {
        // SAFETY: the call has succeeded, and written.
        CcStatus::Ok => Ok(unsafe { contact.assume_init() }),
        status => Err(status),
    }
}

#[test]
fn systems_that_cannot_be_are_refused() {
    let with = |change: fn(&mut CcSystem)| {
        let mut system = LENS;
        change(&mut system);
        made(&system).err().expect("refused")
    };
    no_argument(with(|s| s.probe = 9), "probe = 9; 0 to 5");
    no_argument(with(|s| s.probe = -1), "probe = -1");
    no_contact(with(|s| s.film_poisson_ratio = 0.7), "film: ; 0.7");
    no_contact(
        with(|s| s.substrate_poisson_ratio = 0.7),
        "substrate: ; 0.7",
    );
    no_contact(with(|s| s.film_thickness = f64::NAN), "NaN");
    no_contact(with(|s| s.probe = CcProbe::Cone as i32), "half angle");
}

#[test]
fn null_pointers_are_refused_and_nothing_is_written() {
    let contact = made(&LENS).expect("a contact");
    let some = Some(&*contact);
    let (radii, mut loads) = ([65e-6, 2.0], [7.0; 9]);
    let (from, to) = (radii.as_ptr(), loads.as_mut_ptr());
    let unchanged = CcState {
        contact_radius: 7.0,
        load: 7.0,
        penetration: 7.0,
    };
    let mut state = MaybeUninit::new(unchanged);
    no_argument(cc_contact_new(None, None, None), "system");
    no_argument(cc_contact_new(None, Some(&LENS), None), "contact");
    no_argument(cc_pull_off(None, 0.04, 0.0, Some(&mut state)), "contact");
    no_argument(cc_pull_off(some, 0.04, 0.0, None), "state");
    for stiffness in [-1.0, f64::NEG_INFINITY, f64::NAN] {
        let found = cc_pull_off(some, 0.04, stiffness, Some(&mut state));
        no_contact(found, &format!("{stiffness:?}"));
    }
    // SAFETY: each pointer is null, or that of a text or an array of the length given.
    unsafe {
        assert_eq!(state.assume_init(), unchanged);
        no_argument(cc_load(None, from, 1, 0.04, to), "contact");
        no_argument(cc_load(some, null(), 2, 0.04, to), "contact_radii; 2");
        no_argument(cc_load(some, from, 1, 0.04, null_mut()), "results");
        no_argument(cc_load(some, from, usize::MAX, 0.04, to), "fit in memory");
        assert_eq!(cc_load(some, null(), 0, 0.04, null_mut()), CcStatus::Ok);
        // The second radius is beyond the sphere: the first load is not written, either.
        no_contact(cc_load(some, from, 2, 0.04, to), "2.0 m");
        no_contact(cc_stiffness(some, &f64::NAN, 1, to), "NaN");
        no_argument(cc_gradient(None, 65e-6, 0.04, to), "contact");
        no_argument(cc_gradient(some, 65e-6, 0.04, null_mut()), "derivatives; 9");
        no_contact(cc_gradient(some, -1.0, 0.04, to), "-1.0");
        let mut table = MaybeUninit::uninit();
        no_argument(cc_table_read(null(), Some(&mut table)), "path");
        no_argument(cc_table_read(c"Cargo.toml".as_ptr(), None), "table");
        for missing in [c"no such.h5", c"Cargo.toml"] {
            let found = cc_table_read(missing.as_ptr(), Some(&mut table));
            no_contact(found, missing.to_str().expect("UTF-8"));
        }
        no_argument(cc_table_read(c"\xff".as_ptr(), Some(&mut table)), "UTF-8");
    }
    assert_eq!(loads, [7.0; 9]);
    cc_contact_free(Some(contact));
    cc_contact_free(None);
    cc_table_free(None);
}

/// A machine of the stiffness 0 is a dead weight, and a stiff one is nearly as rigid as an infinite one.
#[test]
fn the_stiffness_of_the_machine_leads_from_a_dead_weight_to_a_rigid_one() {
    let contact = made(&LENS).expect("a contact");
    let radius = |stiffness| {
        let mut state = MaybeUninit::uninit();
        let found = cc_pull_off(Some(&contact), 0.04, stiffness, Some(&mut state));
        assert_eq!(found, CcStatus::Ok, "{}", error());
        // SAFETY: the call has succeeded, and written.
        unsafe { state.assume_init() }.contact_radius
    };
    let [dead, soft, stiff, rigid] = [0.0, 1e-3, 1e12, f64::INFINITY].map(radius);
    assert!(rigid < 0.9 * dead, "{rigid} {dead}");
    assert!((soft / dead - 1.0).abs() < 1e-4, "{soft} {dead}");
    assert!((stiff / rigid - 1.0).abs() < 1e-4, "{stiff} {rigid}");
}

/// A cone has no radius, and its load no derivative by one.
#[test]
fn each_shape_is_that_of_rust_and_a_derivative_without_its_input_is_none() {
    let (radius, half_angle) = (1e-5, 1.2);
    let shapes = [
        (CcProbe::Paraboloid, Probe::Paraboloid { radius }),
        (CcProbe::Sphere, Probe::Sphere { radius }),
        (CcProbe::Cone, Probe::Cone { half_angle }),
        (
            CcProbe::RoundedCone,
            Probe::RoundedCone { radius, half_angle },
        ),
        (CcProbe::FlatPunch, Probe::FlatPunch { radius }),
        (
            CcProbe::FlatEndedCone,
            Probe::FlatEndedCone { radius, half_angle },
        ),
    ];
    for (number, probe) in shapes {
        let system = System {
            probe,
            sphere_modulus: 2e6,
            film: Elastic::new(3.5e6, 0.5).expect("physical"),
            film_thickness: 1e-6,
            substrate: Elastic::new(2e11, 0.25).expect("physical"),
        };
        let contact = Contact::in_table_with_gradient(Table::embedded(), &system);
        let contact = contact.expect("a contact");
        let a = match number {
            CcProbe::FlatPunch => radius,
            CcProbe::Paraboloid | CcProbe::Sphere => 0.5 * radius,
            // On the flank.
            _ => 1.2 * radius,
        };
        let own = made(&CcSystem {
            probe: number as i32,
            probe_radius: radius,
            half_angle,
            ..LENS
        });
        let own = own.expect("a contact");
        let (mut load, mut derivatives) = (0.0, [0.0; 9]);
        // SAFETY: the pointers are those of one number, and of nine.
        unsafe {
            assert_eq!(
                cc_load(Some(&own), &a, 1, 0.04, &mut load),
                CcStatus::Ok,
                "{}",
                error()
            );
            let found = cc_gradient(Some(&own), a, 0.04, derivatives.as_mut_ptr());
            assert_eq!(found, CcStatus::Ok, "{}", error());
        }
        assert_eq!(load, contact.load(a, 0.04).expect("in range"), "{number:?}");
        let has_radius = number != CcProbe::Cone;
        assert_eq!(
            derivatives[2].is_nan(),
            !has_radius,
            "{number:?}: {derivatives:?}"
        );
    }
}
