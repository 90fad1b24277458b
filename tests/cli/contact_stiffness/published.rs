//! Published measurements of coatings by nanoindenters, which are not part of the repository: where they are not
//! beside it, the tests say so.

use std::path::Path;

use acceptance::{assert_names, assert_near, workdir};

use super::{found, with};

/// Returns the paths of these files, if they are there.
fn files<const N: usize>(names: [&str; N]) -> Option<[String; N]> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/real");
    if names.iter().all(|name| folder.join(name).exists()) {
        return Some(names.map(|name| folder.join(name).to_str().expect("UTF-8").to_owned()));
    }
    eprintln!("skipped: {names:?} are not in {}", folder.display());
    None
}

/// Published CSM data of 500 nm of thermal oxide on silicon (the files name the source): another
/// program finds 80.7 GPa with Oliver and Pharr's depth and the tip rounding of bare silicon, and
/// 71.3 +- 1.4 GPa with one hardness. The data are not part of the repository.
#[test]
fn published_measurements_of_an_oxide_give_their_moduli() {
    let Some([oxide, silicon]) = files(["mts_sio2_si.csv", "mts_si.csv"]) else {
        return;
    };
    let workdir = workdir!();
    let plain = "--noise 1% --abscissa-noise 0";
    let depth = "--kind stiffness-depth --between 60nm..250nm";
    let bare = format!(
        "fit {silicon} --half-space --sphere-modulus 1146.6GPa --beta 1.034 --film-modulus \
         170GPa --film-poisson-ratio 0.28 --free tip-rounding {depth}"
    );
    let [rounding, _] = found(&workdir, &bare, "tip_rounding");
    assert!((rounding - 6.0e-9).abs() < 0.1e-9, "{rounding}");
    let rounding = format!("{rounding}");
    let fixed = format!("{depth} {plain} --tip-rounding {rounding}");
    let of_oxide = |more: &str| with(&format!("fit {oxide}"), more);
    let [by_depth, _] = found(&workdir, &of_oxide(&fixed), "film_modulus");
    assert!((by_depth / 1e9 - 80.7).abs() < 1.0, "{by_depth}");
    // Both files in one fit.
    let free = format!("--reference {silicon} --free film-modulus,tip-rounding");
    let both = format!("{depth} {plain} {free}");
    let [together, _] = found(&workdir, &of_oxide(&both), "film_modulus");
    assert!((together / 1e9 - 80.7).abs() < 1.0, "{together}");
    // The loads of these depths.
    let load = "--kind stiffness-load --between 0.7mN..10mN --free film-modulus,hardness";
    let load = format!("{load} --abscissa-noise 0");
    let file_noise = with(&format!("fit {oxide} --noise 0.74%"), &load);
    let [by_load, error] = found(&workdir, &file_noise, "film_modulus");
    assert!((by_load / 1e9 - 71.3).abs() < 1.0, "{by_load}");
    assert!((error / 1e9 - 1.4).abs() < 0.3, "{error}");
}

/// The metals of the same source: the definition of the contact depth moves their moduli by some 30 %, and the
/// contact is plastic. Another program finds the moduli below, those by Loubet's depth with 2.0 nm for the tip.
#[test]
fn published_measurements_of_metals_are_doubted() {
    let Some([aluminium, gold]) = files(["mts_al_sio2_si.csv", "mts_au_ti_sio2_si.csv"]) else {
        return;
    };
    let workdir = workdir!();
    let layer = |name: &str, modulus: f64, poisson_ratio: f64| {
        format!(
            "[[layers]]\nname = '{name}'\nyoung_modulus = {modulus}\npoisson_ratio = {poisson_ratio}\n\
             thickness = 500e-9\n"
        )
    };
    let base = "[base]\nyoung_modulus = 170e9\npoisson_ratio = 0.28\n".to_owned();
    let oxide = base + &layer("oxide", 72e9, 0.17);
    let titanium = oxide.clone() + &layer("titanium", 120e9, 0.34);
    workdir.write("aluminium.toml", oxide + &layer("aluminium", 70e9, 0.345));
    workdir.write("gold.toml", titanium + &layer("gold", 79e9, 0.42));
    for (metal, file, by_pharr, by_loubet) in [
        ("aluminium", &aluminium, 66.5, 48.8),
        ("gold", &gold, 112.8, 86.0),
    ] {
        let stack = format!("{metal}.toml");
        let modulus = format!("{metal}.modulus");
        let free = format!("--stack {stack} --free {modulus}");
        let args = format!(
            "fit {file} --kind stiffness-depth --between 60nm..250nm --sphere-modulus \
             1146.6GPa --beta 1.034 --noise 1% --abscissa-noise 0 {free}"
        );
        let depths = [
            ("oliver-pharr", "6nm", by_pharr),
            ("loubet", "2nm", by_loubet),
        ];
        for (depth, rounding, expected) in depths {
            let known = format!("--contact-depth {depth} --tip-rounding {rounding}");
            let args = format!("{args} {known}");
            let [found, _] = found(&workdir, &args, &modulus);
            assert_near(found / 1e9, expected, 0.15);
            let words = format!("oliver-pharr; loubet; plastic; pile up; {modulus}");
            assert_names(&workdir.succeed(&args), &words);
        }
    }
}
