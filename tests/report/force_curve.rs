//! The force curve of a page: compared with `tabulate curve` and with the library.

use acceptance::{assert_names, low_rank, shipped, table};
use interp::Table;
use serde_json::Value;

use crate::setting::settings;
use crate::shown::{assert_load, assert_shows, number};
use crate::{FOUR_AXES, GAMMA_ALONE, RIGID_SPHERE, embedded_universal};

/// A rigid sphere with adhesion, without `delta0`: enough for load against contact radius.
const NO_PENETRATION: &str = "
    title      = 'Rigid sphere and substrate'
    tolerance  = 1e-6
    quantities = ['pi0', 'eeq', 'gamma']
    a_over_t   = { from = 1e-2, to = 30 }
    e1_over_e2 = 0
    nu1        = 0.4
    e0_over_e2 = inf
";

#[test]
fn a_page_of_the_embedded_table_shows_what_the_program_prints() {
    let table = Table::read(embedded_universal()).expect("the embedded table");
    let settings = "
        paraboloid 1e-6 3.5e6 0.5   2e11   0.25 1e-3 2e6  0.04 # the paper
        paraboloid 1e-5 3.5e6 0.5   2e11   0.25 1e-3 2e6  0.04
        paraboloid 1e-4 1e5   0.499 7e10   0.25 1e-3 2e6  0.04
        paraboloid 5e-8 2e9   0.35  1.3e11 0.25 2e-6 7e10 0.1  # an atomic force microscope
        paraboloid 1e-6 3.5e6 0.5   2e11   0.25 1e-3 2e6  0
        paraboloid 1e-4 3.5e6 0.5   2e11   0.25 0.5  2e6  0.04 # larger than any lens
        paraboloid 1e-8 3.5e6 0.5   2e11   0.25 1e-3 2e6  0.04 # pull-off beyond the table's a/t
        sphere     1e-6 3.5e6 0.5   2e11   0.25 1e-5 2e6  0.04 # contact radii up to 0.4 R
        sphere     1e-6 3.5e6 0.5   2e11   0.25 1e-5 2e6  0.2  # contact radii up to 0.55 R, the largest
        sphere     1e-7 1e5   0.499 2e11   0.25 1e-5 2e6  0.04
        sphere     5e-8 2e9   0.35  1.3e11 0.25 2e-6 7e10 0.1
        sphere     1e-8 3.5e6 0.5   2e11   0.25 1e-3 2e6  0.4  # high powers of the smallest a/R are 0
        flat-punch 1e-6 3.5e6 0.5   2e11   0.25 1e-5 2e6  0.04
        paraboloid 1e-3 5e6   0     2e6    0.25 1e-2 1e6  5    # all parameters matter
        ";
    let names = "film_thickness film_modulus film_poisson_ratio substrate_modulus \
                 substrate_poisson_ratio sphere_modulus sphere_radius work_of_adhesion";
    assert_shows(&table, settings, names);
}

#[test]
fn a_page_with_all_axes_shows_what_the_program_prints() {
    let settings = "
        paraboloid 1e-6 3.5e6 0.5 1e9 0.2 1e-3 2e6 0.04
        paraboloid 1e-8 3.5e6 0.5 1e9 0.2 1e-3 2e6 0.04 # pull-off beyond the table's a/t
        sphere     1e-6 3.5e6 0.5 1e9 0.2 1e-5 2e6 0.04 # four quantities that the table holds
        sphere     1e-6 3.5e6 0.5 1e9 0.2 1e-5 2e6 0    # without adhesion the curve ends at 0.1 R
        flat-punch 1e-6 3.5e6 0.5 1e9 0.2 1e-5 2e6 0.04
        paraboloid 1e-3 4e6   0.3 4e7 0.2 1e-2 2e6 5    # all parameters matter
        ";
    let names = "film_thickness film_modulus film_poisson_ratio substrate_modulus sphere_modulus \
                 sphere_radius work_of_adhesion";
    let Some(seen) = assert_shows(&table(FOUR_AXES), settings, names) else {
        return;
    };
    let beyond = &seen["looks"][1];
    assert_names(
        beyond["messages"].as_str().expect("text"),
        "The curve ends at a = 1.000 µm, where the table’s a/t ends: 100",
    );
    assert_eq!(beyond["states"]["pull-off-load"]["load"], Value::Null);
}

#[test]
fn a_page_of_gamma_alone_shows_every_kind_of_contact() {
    // In low-rank form, which is in the page unchanged.
    let table = low_rank(&table(GAMMA_ALONE), 1e-6);
    let tiles = table.low_rank().map(<[_]>::len);
    assert_eq!(tiles, Some(5), "the settings are in several tiles");
    let settings = "
        paraboloid 1e-5 1e6  0.49 7e10 0.22 1e-3 7e10 0.04 # a soft film on glass under glass
        paraboloid 1e-4 1e6  0.49 7e10 0.22 1e-3 2e6  0.04 # a soft sphere, and a thicker film
        paraboloid 1e-5 1e6  0.49 7e10 0.22 1e-3 inf  0.04
        paraboloid 1e-5 1e6  0.49 3e12 0.22 1e-3 inf  0.04 # stiffer than any solid
        paraboloid 1e-5 1e6  0.49 inf  0.3  1e-3 7e10 0.04
        paraboloid 1e-5 1e6  0.5  inf  0.3  1e-2 inf  0
        paraboloid 1e-5 1e10 0.4  1e7  0.3  1e-3 inf  0.04
        paraboloid 1e-5 1e9  0.35 2e7  0.3  1e-3 1e9  0.06 # stiffer than the substrate: all parameters matter
        ";
    let names = "film_thickness film_modulus film_poisson_ratio substrate_modulus \
                 substrate_poisson_ratio sphere_modulus sphere_radius work_of_adhesion";
    assert_shows(&table, settings, names);
}

#[test]
fn a_page_of_the_papers_table_shows_what_the_program_prints() {
    let table = Table::open(shipped("paper.h5")).expect("the shipped table");
    let settings = "
        paraboloid 1e-6 3.5e6 0.5 2e11 0.25 1e-3 2e6 0.04
        paraboloid 1e-4 3.5e6 0.5 2e11 0.25 1e-3 2e6 0.04
        paraboloid 1e-6 1e8   0.5 2e11 0.25 1e-2 2e6 0.4
        ";
    let names = "film_thickness film_modulus sphere_modulus sphere_radius work_of_adhesion";
    assert_shows(&table, settings, names);
}

#[test]
fn a_rigid_sphere_without_adhesion_has_no_sliders_for_either() {
    let settings = "
        paraboloid 1e-6 5e8 0.2 1e9 0.25 1e-3 inf 0
        paraboloid 3e-5 1e6 0.4 3e6 0.25 1e-3 inf 0
        ";
    let names = "film_thickness film_modulus film_poisson_ratio substrate_modulus sphere_radius";
    assert_shows(&table(RIGID_SPHERE), settings, names);
}

#[test]
fn without_penetration_there_is_load_against_contact_radius() {
    const LINE: &str = "paraboloid 1e-5 1e6 0.4 inf 0.25 1e-3 inf 0.04";
    let (table, setting) = (table(NO_PENETRATION), settings(LINE)[0]);
    let names = "film_thickness film_modulus sphere_radius work_of_adhesion";
    let Some(seen) = assert_shows(&table, LINE, names) else {
        return;
    };
    // `tabulate curve` prints penetrations.
    assert_eq!(seen["looks"][0]["command"], "");
    let states = &seen["looks"][0]["states"];
    assert_eq!(states.as_object().map(serde_json::Map::len), Some(2));
    // The least load; the library has no call for it without penetrations.
    let contact = setting.contact(&table);
    let pull_off = &states["pull-off-load"];
    let (a, load) = (
        number(&pull_off["contact_radius"]),
        number(&pull_off["load"]),
    );
    assert_load(&contact, setting.adhesion, a, load, "pull-off");
    for nearby in [0.9 * a, 0.99 * a, 1.01 * a, 1.1 * a] {
        assert!(
            contact
                .load(nearby, setting.adhesion)
                .expect("in the table")
                > load
        );
    }
}
