//! Calls of a person who does not know the program yet: what must not pass silently, and thick films,
//! wide spheres and full friction beside the table and beside differences.

use acceptance::{Data, assert_close, assert_names, assert_near, shipped, workdir};

#[test]
fn what_has_no_effect_or_another_meaning_is_refused() {
    let workdir = workdir!();
    let lens = shipped("../crates/fit/data/lens.csv");
    let lens = lens.display();
    let fit = format!("fit {lens} --specimen paper");
    let film = format!("{fit} --film-thickness 30um");
    for (name, headings) in [
        ("twice", "r [um],z [nm]\nmeasured,measured"),
        ("steep", "r [um],z"),
        ("wide", "r,z"),
        ("swapped", "z [um],r [um]"),
        ("tall", "height [um],radius [um]"),
        ("diameter", "diameter [um],height [um]"),
        ("contact", "contact_radius [um],penetration [um]"),
        ("cells", "r,z\n0um,0um"),
    ] {
        let points = "0,0\n0.5,12.5\n1,50\n2,200\n3,450\n";
        workdir.write(&format!("{name}.csv"), format!("{headings}\n{points}"));
    }
    let bodies = "--sphere-radius 1mm --film-thickness 30um --film-poisson-ratio 0.5 --substrate-modulus 2e11 \
                  --substrate-poisson-ratio 0.25";
    let without = format!("fit {lens} {bodies} --sphere-modulus 2MPa --film-modulus 3.5MPa");
    let sliding =
        format!("fit {lens} {bodies} --interface sliding --free film.modulus,work-of-adhesion");
    let depths = "simulate --specimen paper --kind stiffness-depth --from 40nm --to 300nm --noise 1% --hardness 1GPa";
    let loads = "load,contact_stiffness\n1e-3,100\n2e-3,140\n4e-3,200\n";
    workdir.write("loads.csv", loads);
    let heights = "height [nm],deflection [nm]\n300,0\n200,1\n100,5\n0,9\n";
    workdir.write("heights.csv", heights);
    workdir.write("latin.csv", b"r [\xb5m],z [\xb5m]\n0,0\n1,1\n");
    workdir.write("raised.csv", "r [um],z [um]\n1,5\n2,6\n3,8\n");
    workdir.refuses(format!(
        "
        1 | pull-off --stiffness 0.1N/m | --control spring
        2 | curve --film-modulus 5 | 5kPa; 5MPa; 5Pa
        1 | curve --film-thickness nan --from 10um | film_thickness = NaN; > 0
        2 | curve --film-thickness 1parsec | parsec; um, mN, kPa
        2 | pull-off --load -2uN,-3uN | several values; call the command once for each
        2 | fit heights.csv --specimen paper --stiffness 0.05 --sensitivity 50 | 50.0 m/V; 1e-10 to 1e-4 m/V; 50nm/V
        2 | curve --sphere-modulus 210 | 210GPa
        1 | curve --probe cone --half-angle 70 --sphere-radius 1um | no --sphere-radius; rounded-cone
        2 | curve --probe cone --half-angle 1.2 | 1.2rad; degrees; 68.7549; 1.2deg
        2 | curve --probe cone --half-angle 70um | 70um; length; degrees
        1 | curve --probe pyramid --half-angle 20 | --probe cone --half-angle 23.08; 20 degrees
        1 | curve --probe pyramid --half-angle 89.999 | --half-angle 89.99915; 89.999 degrees
        1 | curve --probe pyramid --half-angle 89.99999999999999 | --probe cone; 89.99999999999999 degrees
        1 | curve --probe power-law --coefficient 0.01 --exponent 3 | coefficient of the power law = 0.01; 3e-6; are in um, it is 1e10
        1 | curve --probe power-law --coefficient 1e300 --exponent 3 | coefficient of the power law = 1e300; steeper; --allow magnitudes
        1 | pull-off --control spring --stiffness 1e-12 | the stiffness = 1e-12 N/m; 1e-6 to 1e9; unit
        1 | curve --probe berkovich | --probe cone --half-angle 70.3
        1 | curve --probe flat-punch --from 1um --to 5um | --sphere-radius; leave out --from
        1 | curve --from 200um | --from; 0.0002; --to, which is not given
        1 | curve --sphere-radius 5nm --film-thickness 1cm | contact radius 1.5e-9 m; 1e-8 m; --half-space
        1 | curve --probe flat-punch --sphere-radius 1nm --film-thickness 1cm | contact radius 1e-9 m; 1e-8 m; --half-space
        1 | curve -o table.h5 | table.h5; another name
        1 | curve --film-thickness inf | film thickness; inf; 0.1 m
        1 | curve --interaction-range 0 | interaction range = 0.0; JKR
        1 | curve --interaction-range 5 | 5.0 m; 0.001 m; unit
        1 | curve --interaction-range 5nm --work-of-adhesion 0 | leave out --interaction-range
        1 | curve --interaction-range 5nm --to 120um | 0.00012 m; smaller contact radius
        1 | pull-off --probe profile --profile steep.csv | largest z of the profile over its largest r = 1.5e8; units of r and z
        1 | pull-off --probe profile --profile twice.csv | line 2; not two numbers; r [um],z [um]
        1 | pull-off --probe profile --profile cells.csv | line 2; not two numbers; r [um],z [um]
        1 | pull-off --probe profile --profile swapped.csv | line 1; z [um]; r [um]; exchange
        1 | pull-off --probe profile --profile tall.csv | line 1; height [um]; exchange
        1 | pull-off --probe profile --profile diameter.csv | line 1; diameter [um]; half of a diameter; r [um],z [um]
        1 | pull-off --probe profile --profile contact.csv | line 1; penetration [um]; lowest point; r [um],z [um]
        1 | pull-off --probe profile --profile latin.csv | latin.csv; UTF-8; save it
        1 | pull-off --probe profile --profile raised.csv | line 3; lowest point
        1 | pull-off --probe profile --profile wide.csv | largest r of the profile = 3 m; 3 um
        1 | solve --a-over-t 1 --e1-over-e2 1 --nu1 0.3 --e0-over-e2 1 --sphere-modulus 2MPa | --sphere-modulus; --stack
        1 | simulate --specimen paper --kind force-height --from=-1um --to=1um --noise 1nN --stiffness 0.1 | moves away; the height is smaller
        1 | simulate --specimen paper --kind load-penetration --from=1um --to=-1um --noise 1nN | moves away; the penetration is larger
        1 | simulate --specimen paper --kind force-height --from=1um --to=-1um --noise 1nN | --stiffness; 0.1N/m
        1 | history --probe flat-punch --relaxation power-law -n 0.2 --all-relax -p 'penetration 0:0 1:1um' | flat-punch; another --probe
        1 | history --relaxation power-law -n 0.2 -p 'penetration 0:0 1:1um' | --all-relax; --sphere-modulus inf
        1 | history --relaxation prony --relaxed-fraction 1 --relaxation-time 1 -p 'penetration 0:0 1:1um' | --relaxed-fraction 1; below 1
        1 | report embedded --sphere-radius 5 -o page.html | 5 m; 0.1 m; 5 mm
        1 | pull-off --sphere-modulus inf --friction stick --work-of-adhesion-receding 200 --allow magnitudes | --friction stick; radii
        2 | {fit} --half-space --film-thickness 30um | --half-space; --film-thickness
        1 | {film} --stiffness 0.1 | --stiffness; cantilever
        1 | fit heights.csv --specimen paper --stiffness 0.05 --sensitivity 50nm/V | --sensitivity; deflections in V
        1 | {film} --units film-modulus=MPa | --units film-modulus; free
        1 | {film} --units sphere-modulus=MPa --units sphere-modulus=kPa | --units sphere-modulus; twice
        1 | {film} --value load-offset=1uN --value load-offset=2uN | --value load-offset; twice
        1 | {film} --prior sphere-modulus=1MPa+-1kPa --prior sphere-modulus=5MPa+-1kPa | --prior sphere-modulus; twice
        1 | {film} --own sphere-modulus --shared sphere-modulus | --own sphere-modulus and --shared sphere-modulus
        1 | {film} --value contact-point=1um | --value contact-point has no effect; leave it out
        1 | {film} --value hardness=1MPa | --value hardness has no effect; leave it out
        1 | {film} --interface sliding --known film.thickness=100um+-10um | --film-thickness; film.thickness; two values
        1 | {sliding} --sphere-modulus inf | --film-modulus; guess
        1 | {sliding} --sphere-modulus inf --value film.modulus=10kPa --known film.thickness=1um+-1nm | two values
        1 | {film} --friction stick --work-of-adhesion-receding 0.2 --value work-of-adhesion=0.1 | --value work-of-adhesion; as a flag
        1 | {film} --friction stick --work-of-adhesion-receding 0.2 --known work-of-adhesion=0.1+-0.01 | --known work-of-adhesion; as a flag
        1 | {without} --friction stick --work-of-adhesion-receding 0.2 | --work-of-adhesion is missing; has grown
        1 | {film} --friction stick --known film-poisson-ratio=0.5+-0.01 | film-poisson-ratio; can vary
        1 | {depths} --probe cone --half-angle 45 | --half-angle 45.0; area function; --area 3.141593
        1 | {depths} --sphere-radius 1um | --sphere-radius; area function
        1 | {depths} --value sphere-radius=1um | --value sphere-radius; area function; leave it out
        2 | simulate --specimen paper --kind stiffness-radius --from 20um --to 100um --noise 1% --loss-tangent 0.1 --json | --loss-tangent; --json
        1 | {film} --probe flat-punch | --probe flat-punch; give penetrations and loads
        1 | {film} --free sphere-modulus,sphere-modulus | sphere-modulus is free twice
        1 | simulate --specimen paper --kind load-penetration --segments retract --hold 1s --sample-interval 0.1s --from -1um --to 1um --noise 1uN | --hold; --segments cycle
        1 | simulate --specimen paper --kind load-radius --value work-of-adhesion-receding=0.1 --from 40um --to 130um --noise 20uN | work-of-adhesion-receding; --segments cycle
        1 | {film} --column penetration=depth[nm] | no column is; depth[nm]; penetration
        1 | {depths} --half-space --thinning 0.333 | --thinning; half-space
        1 | {film} --between 1mN..5mN | force; length; m
        1 | simulate --specimen paper --kind load-radius --from 40um --to 130um --noise 5uN --value load-offset=1uN --value load-offset=2uN | twice
        1 | fit heights.csv --specimen paper --stiffness 0.05 --known stiffness=0.1+-0.01 | --stiffness 0.05; --known stiffness=0.1
        1 | {film} --sphere-modulus inf --known sphere-modulus=inf+-1MPa | sphere-modulus; finite
        1 | fit loads.csv --specimen paper --between 1mm..5mm | length; force
        1 | {film} --known film-thickness=2e-5+-1e-6 | 3e-5; 2e-5; two values
        2 | {film} --value sphere-modulus=2 | 2MPa; 2Pa
        2 | {film} --known substrate-modulus=70+-1 | 70GPa
        1 | simulate --specimen paper --kind load-radius --from 40um --to 130um --noise 5uN --expect --units film-thickness=um | --units film-thickness; free
        1 | {film} --relaxation power-law | load-radius; leave out --relaxation
        "
    ));
    let profiles = [
        "cells", "contact", "diameter", "heights", "latin", "loads", "raised", "steep", "swapped",
        "tall", "twice", "wide",
    ];
    assert_eq!(workdir.files(), profiles.map(|name| format!("{name}.csv")));
}

/// Noise that hides the data was probably given in another unit: the data are made, with a note.
#[test]
fn a_noise_in_the_wrong_unit_is_noted() {
    let workdir = workdir!();
    let noted = |noise: &str| {
        let radii = "simulate --specimen paper --kind load-radius --from 40um --to 80um";
        workdir.answer(format!("{radii} --noise {noise}")).stderr
    };
    assert_names(&noted("5"), "--noise 5.0; range of the load; 1nN");
    assert!(!noted("5uN").contains("--noise"));
}

/// The usual radii of a curve end within the points of a profile, whose headings may have several words or be missing.
#[test]
fn a_profile_needs_no_other_flag() {
    let workdir = workdir!();
    let curve = "curve --probe profile --profile tip.csv --points 3 --film-modulus 1GPa";
    let points = "0,0\n1,0.05\n2,0.2\n3,0.45\n";
    for headings in [
        "r [um],z [um]",
        "\u{feff}\"Radius (um)\",\"Height (um)\"",
        "x_um,depth_um",
    ] {
        workdir.write("tip.csv", format!("{headings}\n{points}"));
        assert_eq!(workdir.csv(curve).last().get("contact_radius"), 2.7e-6);
    }
    workdir.write("tip.csv", "0,0\n1e-6,5e-8\n2e-6,2e-7\n3e-6,4.5e-7\n");
    assert_eq!(workdir.csv(curve).last().get("contact_radius"), 2.7e-6);
}

/// The usual radii of a curve end where an attraction of a short range is solved.
#[test]
fn a_range_of_the_attraction_needs_no_other_flag() {
    let workdir = workdir!();
    let curve = workdir.csv("curve --specimen paper --interaction-range 5nm --points 3");
    assert!(curve.last().get("contact_radius") > 1e-4);
}

/// A work of adhesion of 0 is no start of a fit: there is none.
#[test]
fn a_fit_without_adhesion() {
    let workdir = workdir!();
    workdir.succeed("simulate --specimen paper --work-of-adhesion 0 --kind load-radius --film-thickness 30um --from 42um \
                     --to 130um --noise 2uN -o lens.csv");
    let found = workdir
        .json("fit lens.csv --specimen paper --film-thickness 30um --work-of-adhesion 0 --json");
    let found = found["parameters"].as_object().expect("an object");
    let names: Vec<_> = found.keys().collect();
    assert_eq!(names, ["sphere_modulus"]);
}

#[test]
fn a_contact_that_is_wide_beside_the_sphere_is_told() {
    let workdir = workdir!();
    let bodies = "--specimen paper --sphere-radius 5um --film-thickness 20um --sphere-modulus inf";
    for call in [
        format!("pull-off {bodies} --film-modulus 5kPa --work-of-adhesion 5mJ/m^2"),
        format!(
            "history {bodies} --all-relax --relaxation power-law -n 0.2 -p 'penetration 0:0 1:4um'"
        ),
        format!("curve {bodies} --to 4um --points 3"),
    ] {
        assert_names(&workdir.answer(&call).stderr, "0.3 R; --probe sphere");
    }
}

/// Solves of a film so thick that contacts are small beside it, and of a film of the material of its
/// substrate under a wide sphere, beside the embedded table.
#[test]
fn thick_films_and_wide_spheres_are_solved_as_they_are_looked_up() {
    let workdir = workdir!();
    let thick = "--specimen paper --film-thickness 2mm --points 5";
    let alike = "--film-modulus 1MPa --film-poisson-ratio 0.3 --substrate-modulus 1MPa \
                 --substrate-poisson-ratio 0.3 --sphere-modulus inf --sphere-radius 1mm --film-thickness 10um \
                 --work-of-adhesion 0 --from 5um --to 540um --points 9";
    for call in [
        format!("{thick} --probe sphere"),
        format!("{thick} --probe cone --half-angle 70"),
        format!("{thick} --probe rounded-cone --half-angle 70 --sphere-radius 1um"),
        format!("{alike} --probe sphere"),
    ] {
        let [direct, looked_up] = ["", "embedded"].map(|table| {
            let run = workdir.answer(format!("curve {table} {call}"));
            Data::parse("curve", &run.stdout)
        });
        for column in ["load", "penetration"] {
            let [direct, looked_up] = [&direct, &looked_up].map(|data| data.column(column));
            let sizes = direct.iter().map(|value| value.abs());
            let largest = sizes.fold(0.0, f64::max);
            for (direct, looked_up) in direct.into_iter().zip(looked_up) {
                assert_near(direct, looked_up, 1e-6 * largest);
            }
        }
    }
    // A history in the same thick film knows its smallest contacts.
    workdir.answer(
        "history --specimen paper --film-thickness 10mm --probe cone --half-angle 70 --relaxation power-law \
         -n 0.2 --all-relax --tolerance 1e-4 -p 'penetration 0:0 1:1um'",
    );
}

/// The slope of the force curve under full friction, by differences of its own rows.
#[test]
fn the_moving_stiffness_with_stick_is_the_slope_of_the_curve() {
    let workdir = workdir!();
    for work in ["0", "40mJ/m^2"] {
        let data = workdir.csv(format!(
            "curve --specimen paper --film-thickness 10um --sphere-modulus inf --friction stick --work-of-adhesion {work} \
             --from 39.9um --to 40.1um --points 3"
        ));
        let [load, penetration, stiffness] =
            ["load", "penetration", "moving_stiffness"].map(|name| data.column(name));
        let slope = (load[2] - load[0]) / (penetration[2] - penetration[0]);
        assert_close(stiffness[1], slope, 1e-4);
    }
}
