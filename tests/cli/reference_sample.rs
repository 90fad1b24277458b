//! `tabulate fit --reference`: a bare sample beside a film.

use acceptance::workdir;

const OXIDE: &str = "--sphere-modulus 1146.6GPa --film-modulus 72GPa --film-poisson-ratio 0.17 \
     --film-thickness 500nm --substrate-modulus 170GPa --substrate-poisson-ratio 0.28 --beta 1.034 \
     --kind stiffness-depth";

/// Writes a film, and a film so thick that it is a bare reference.
fn film_and_reference(workdir: &acceptance::Workdir, more: &str) {
    let plan = "simulate --from 40nm --to 220nm --noise 0.01% --hardness 10GPa --tip-rounding 6nm";
    workdir.succeed(format!("{plan} {OXIDE} {more} -o film.csv"));
    let bare = OXIDE
        .replace(
            "--film-modulus 72GPa --film-poisson-ratio 0.17",
            "--film-modulus 170GPa --film-poisson-ratio 0.28",
        )
        .replace("500nm", "1mm");
    workdir.succeed(format!("{plan} {bare} --seed 2 -o bare.csv"));
}

#[test]
fn a_reference_has_the_poisson_ratio_of_the_substrate() {
    let workdir = workdir!();
    film_and_reference(&workdir, "");
    let found = |more: &str| {
        workdir.json(format!(
            "fit film.csv --reference bare.csv {OXIDE} --free film-modulus,tip-rounding --json {more}"
        ))
    };
    assert_eq!(
        found(""),
        found("--reference-modulus 170GPa --reference-poisson-ratio 0.28")
    );
    assert_ne!(found(""), found("--reference-poisson-ratio 0.4"));
}
