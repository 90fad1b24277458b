//! `tabulate fit`: files that need a word of the user, and what heads of files tell.

use acceptance::{
    Workdir, assert_cases, assert_close, assert_estimate, assert_names, assert_near, estimate,
    number, workdir,
};
use serde_json::Value;

/// The flags of a sphere on a half-space.
const GEL: &str = "--half-space --sphere-modulus inf --sphere-radius 1e-5 --film-modulus 5e3 \
     --film-poisson-ratio 0.5";

/// The flags of a lens on a film on silicon.
const LENS: &str = "--film-thickness 1e-5 --sphere-radius 1e-3 --sphere-modulus 2e6 --film-modulus 3.5e6 \
     --film-poisson-ratio 0.5 --substrate-modulus 2e11 --substrate-poisson-ratio 0.25 \
     --work-of-adhesion 0.04";

fn fit(file: &str, more: &str) -> String {
    format!("fit {file} {GEL} {more}")
}

#[test]
fn a_message_says_what_is_missing_what_is_there_and_what_to_type() {
    let workdir = workdir!();
    let files = r"
        two.csv | Tiefe (nm);Kraft (mN);t (s)\n1;0;0\n2;1;1\n3;4;2\n
        one.csv | Depth (nm);Kraft (mN)\n1;0\n2;1\n
        both.csv | Depth [nm],Load [mN],Piezo [nm]\n1,2,3\n2,3,4\n
        bare.csv | 1,2\n2,3\n
        volts.csv | z [nm],defl [V]\n3,0\n2,1\n
        unit.csv | Radius,Load [mN]\n1,2\n2,3\n
        phase.csv | height,force,phase\n1,2,sideways\n2,3,sideways\n
        separation.csv | Separation (nm),Force (nN)\n1,2\n2,1\n
        gap.csv | Gap (nm),Force (nN)\n1,2\n2,1\n
        hc.csv | hc (nm),Load (mN),Stiffness [N/m]\n1,2,3\n2,3,4\n
        durchmesser.csv | Kontaktdurchmesser (mm);Kraft (mN)\n0,1;2\n0,2;3\n
        area.csv | contact area [um^2];F [mN]\n1;2\n2;3\n
        csm.csv | Depth [nm];Load [mN];Stiffness [N/m]\n1;2;3\n2;3;4\n
        diameter.csv | contact diameter [um];F [mN]\n1;2\n2;3\n
        head.csv | Spring constant: 1,000 mN/m\nz [nm];defl [nm]\n3;0\n2;1\n
        ";
    workdir.write_files(files);
    let cases = r#"
        two.csv |  | "Tiefe (nm)" (a length), "Kraft (mN)" (a force), "t (s)"; load-radius lacks contact_radius (a length) and load (a force);
        two.csv |  | type --kind load-radius --column "contact_radius=Tiefe (nm)" --column "load=Kraft (mN)", or
        two.csv |  | , or --kind load-penetration --column "penetration=Tiefe (nm)" --column "load=Kraft (mN)"
        two.csv | --kind load-penetration | type --column "penetration=Tiefe (nm)" --column "load=Kraft (mN)"
        one.csv |  | load-penetration lacks load (a force); "Depth (nm)" (penetration), "Kraft (mN)" (a force); type --kind load-penetration --column "load=Kraft (mN)"
        both.csv |  | type --kind load-penetration|force-height
        bare.csv |  | such as "um" of contact_radius; type --column "contact_radius=1 [UNIT]" --column "load=2 [UNIT]", with the unit of the numbers in place of UNIT, such as mN or um
        volts.csv |  | type --stiffness N/m --sensitivity m/V
        unit.csv |  | no unit; name its unit, such as "um"; type --column "contact_radius=Radius [UNIT]", with the unit of the numbers
        separation.csv |  | "Separation (nm)"; is the height and the deflection together; type --stiffness N/m
        gap.csv |  | (a separation: the height and the deflection together); type --kind force-height --column "separation=Gap (nm)" --stiffness N/m
        hc.csv | --kind stiffness-depth | (a contact depth, which is less than the penetration); type --column "penetration=hc (nm)" --epsilon 0
        durchmesser.csv |  | "Kontaktdurchmesser (mm)" (a length, to be converted); and name the quantity and its unit in the heading
        phase.csv |  | sideways; type --segments split
        area.csv |  | type --kind load-radius --column "contact_area=contact area [um^2]"
        csm.csv |  | type --kind load-penetration|stiffness-load|stiffness-depth
        diameter.csv |  | "contact diameter [um]" (a length, to be converted); and name the quantity and its unit in the heading
        head.csv |  | line 1 has "1,000", whose comma may part thousands; type --stiffness N/m
        "#;
    assert_cases(cases, |[file, more, _]| {
        let message = workdir.fail(1, fit(file, more));
        assert_eq!(message.lines().count(), 1, "{message}");
        message
    });
    // What is to be filled in is no unit.
    let open = fit("unit.csv", "--column 'contact_radius=Radius [UNIT]'");
    let words = "the unit of the numbers in its place, such as [um]";
    workdir.refuses(format!("2 | {open} | {words}"));
    let typed = "--column 'penetration=Tiefe (nm)' --column 'load=Kraft (mN)'";
    let run = workdir.run(fit("two.csv", &format!("{typed} --kind load-penetration")));
    assert!(!run.stderr.contains("type --"), "{run:?}");
}

#[test]
fn a_column_named_by_its_number_is_told_by_its_number() {
    let workdir = workdir!();
    workdir.write("bare.csv", "42,0.1\n50,0.2\n61,0.35\n70,0.5\n81,0.75\n");
    let columns = "--column 'contact_radius=1 [um]' --column 'load=2 [mN]'";
    let run = workdir.run(format!("fit bare.csv {LENS} {columns}"));
    assert_names(
        &run.stdout,
        "contact_radius from column 1; load from column 2",
    );
}

#[test]
fn doubts_about_a_file_are_told_with_the_fit_and_with_its_errors() {
    let workdir = workdir!();
    let simulate =
        "simulate --kind load-radius --from 42um --to 130um --noise 2uN --points 20 --seed 1";
    let lens = workdir.succeed(format!("{simulate} {LENS}"));
    let is_row = |row: &&str| row.starts_with(|c: char| c.is_ascii_digit());
    let rows: Vec<&str> = lens.lines().filter(is_row).collect();
    let twice = format!("contact_radius,load\n{0}\n\n{0}\n", rows.join("\n"));
    workdir.write("twice.csv", &twice);
    workdir.write("once.csv", &lens);
    // Micronewtons, of which a comma parts thousands.
    let commas = "a [um];F [uN]\n100;1,249\n110;1,732\n120;2,310\n130;3,005\n";
    workdir.write("commas.csv", commas);
    workdir.write("diameters.csv", commas.replace("uN", "MN"));
    workdir.write("pull.csv", format!("{lens}0,-1e-3\n"));
    let errors = rows.iter().enumerate();
    let errors = errors.map(|(i, row)| format!("{row},{}\n", if i == 3 { "0" } else { "1e-7" }));
    let headings = "contact_radius,load,contact_radius_error";
    workdir.write(
        "exact.csv",
        format!("{headings}\n{}", errors.collect::<String>()),
    );
    let object = |files: &str| workdir.json(format!("fit {files} {LENS} --json"));
    let doubts = r#"
        twice.csv | several-curves | "contact_radius" turns back 2 times
        commas.csv | commas | 1,249 is 1.249
        pull.csv | pull-off | it is -0.001 N, below those of all contacts
        exact.csv | exact | 1 of 20 standard deviations of the contact radius are 0
        once.csv once.csv | same-points | its 20 points are those of once.csv
        "#;
    assert_cases(doubts, |[files, kind, _]| {
        let object = object(files);
        let mut warnings = object["warnings"].as_array().expect("a list").iter();
        let of_kind = warnings.find(|warning| warning["kind"] == kind);
        let text = of_kind.and_then(|warning| warning["text"].as_str());
        text.unwrap_or_default().to_owned()
    });
    let report = workdir.succeed(format!("fit twice.csv {LENS}"));
    let words = "warning: twice.csv: \"contact_radius\" turns back 2 times";
    assert_names(&report, words);
    let sound = object("once.csv").to_string();
    for kind in ["several-curves", "directions", "commas", "same-points"] {
        assert!(!sound.contains(kind), "{kind}: {sound}");
    }
    let words = "taken for N; if the commas part thousands";
    workdir.refuses(format!("1 | fit diameters.csv {LENS} | {words}"));
}

/// Simulates heights and forces with a cantilever of a stiffness, N/m.
fn curve(workdir: &Workdir, stiffness: &str) -> String {
    workdir.simulate(format!(
        "--kind force-height {GEL} --work-of-adhesion 5e-5 --stiffness {stiffness} --from 1e-6 --to=-1e-6 --noise 2e-11 \
         --seed 1"
    ))
}

/// Simulates a force curve, and writes it in the style of JPK, with a pause of more columns.
fn export(workdir: &Workdir) {
    let curve = curve(workdir, "0.05");
    let rows = |segment: &str| -> String {
        let rows = curve.lines().filter_map(|row| row.strip_suffix(segment));
        let rows = rows.map(|row| row.trim_end_matches(',').replace(',', " "));
        rows.collect::<Vec<_>>().join("\n")
    };
    let head = "# columns: height vDeflection\n# springConstant: 0.05\n# sensitivity: 5e-8\n# units: m N\n";
    let text = format!(
        "# TEXT EXPORT\n# segment: extend\n{head}{}\n\n# segment: pause\n\
         # columns: height vDeflection a b c time\n# units: m N m m m s\n1 1 1 1 1 1\n2 1 1 1 1 2\n\n\
         # segment: retract\n{head}{}\n",
        rows("approach"),
        rows("retract")
    );
    workdir.write("jpk.txt", &text);
}

#[test]
fn the_stiffness_of_the_head_is_used_unless_another_is_given() {
    let workdir = workdir!();
    export(&workdir);
    let free = "--free film-modulus,work-of-adhesion,contact-point";
    let report = workdir.succeed(fit("jpk.txt", free));
    let words = "stiffness 0.05 N/m from line 4, \"springConstant\"; 2 rows of a pause left out; 2 times headings";
    assert_names(&report, words);
    let object = |more: &str| workdir.json(fit("jpk.txt", &format!("{free} --json {more}")));
    let told = object("");
    assert_estimate(&told, "film_modulus", 5e3, f64::INFINITY);
    let read = |found: &Value| found["read"][0].as_str().expect("a line").to_owned();
    assert_names(&read(&told), "from line 4");
    let given = object("--stiffness 0.05");
    assert_eq!(given["parameters"], told["parameters"]);
    let other = object("--stiffness 0.06");
    assert_ne!(other["parameters"], told["parameters"]);
    assert_names(&read(&other), "0.06 N/m as given, and line 4; 0.05");
    let of_stiffness = |found: &Value| {
        let warnings = found["warnings"].as_array().expect("a list").iter();
        let mut warnings = warnings.filter(|one| one["kind"] == "stiffness");
        warnings.next().map(|one| one["text"].to_string())
    };
    let doubt =
        of_stiffness(&other).expect("forces in newtons were made with the stiffness of the file");
    assert_names(&doubt, "line 4; 0.05; 0.06; 1.2; give the deflection");
    assert_eq!(of_stiffness(&given), None);
}

/// A separation is the height again where the deflection is taken off.
#[test]
fn separations_are_fitted_as_heights() {
    let workdir = workdir!();
    let curve = curve(&workdir, "0.1");
    workdir.write("height.csv", &curve);
    let mut rows = String::from("Tip-Sample Separation (nm);Force (nN)\n");
    for row in curve.lines() {
        let numbers: Vec<f64> = row.split(',').map_while(|cell| cell.parse().ok()).collect();
        if let [height, force, ..] = numbers[..] {
            rows += &format!("{:?};{:?}\n", 1e9 * (height + force / 0.1), 1e9 * force);
        }
    }
    workdir.write("separation.csv", &rows);
    workdir.write("gap.csv", rows.replace("Tip-Sample Separation", "Gap"));
    let of = |name: &str, more: &str| {
        let flags = format!("--stiffness 0.1 --segments split --json {more}");
        workdir.json(fit(name, &flags))
    };
    let heights = of("height.csv", "");
    let named = "--kind force-height --column 'separation=Gap (nm)'";
    for found in [of("separation.csv", ""), of("gap.csv", named)] {
        for name in ["film_modulus", "contact_point"] {
            let [[value, error], [own, _]] = [&heights, &found].map(|one| estimate(one, name));
            assert!(
                (own - value).abs() < 1e-3 * error,
                "{name}: {own}, not {value}"
            );
        }
    }
}

/// The doubt says which flag turns the sign, whether the fit fails or not, and the flag does.
#[test]
fn a_doubt_about_a_sign_says_what_to_type() {
    let workdir = workdir!();
    let curve = curve(&workdir, "0.1");
    // Heights that grow towards the sample.
    let rows = curve.lines().filter_map(|row| {
        let mut cells = row.split(',');
        let height: f64 = cells.next()?.parse().ok()?;
        Some(format!("{:?};{}\n", -1e9 * height, cells.next()?))
    });
    let text: String = rows.collect();
    workdir.write("z.csv", format!("Piezo (nm);Force (N)\n{text}"));
    let stiffness = "--stiffness 0.1 --work-of-adhesion 5e-5";
    let run = workdir.run(fit("z.csv", stiffness));
    let text = format!("{}{}", run.stdout, run.stderr);
    let words = "opposite sense; type --column \"height=-Piezo (nm)\"";
    assert_names(&text, words);
    let turned = format!("{stiffness} --column 'height=-Piezo (nm)'");
    let report = workdir.succeed(fit("z.csv", &turned));
    assert!(!report.contains("opposite sense"), "{report}");
    assert_names(&report, "height from \"Piezo (nm)\" with a minus");
}

/// Simulates a force curve, and returns its heights and forces without their segments, of which the
/// baseline is tilted by `slope` (N/m).
fn without_segments(workdir: &Workdir, more: &str, slope: f64) -> String {
    let curve = workdir.simulate(format!("--kind force-height {GEL} --seed 1 {more}"));
    let rows = curve.lines().filter_map(|row| {
        let mut cells = row.split(',').map(str::parse::<f64>);
        let (height, load) = (cells.next()?.ok()?, cells.next()?.ok()?);
        Some(format!("{height:e},{:e}\n", load + slope * height))
    });
    format!("height,load\n{}", rows.collect::<String>())
}

/// A tilted baseline is no wrong sign: the slope is to be free, and then there is no doubt.
#[test]
fn a_tilted_baseline_says_what_to_free() {
    let workdir = workdir!();
    let known = "--work-of-adhesion 0 --stiffness 0.1";
    let plan = format!("{known} --from 3e-6 --to=-1e-7 --noise 1e-11");
    workdir.write("tilted.csv", without_segments(&workdir, &plan, 5e-4));
    let message = workdir.fail(1, fit("tilted.csv", known));
    let words = "the baseline may be tilted; type --free ...,baseline-slope";
    assert_names(&message, words);
    assert!(!message.contains("opposite sense"), "{message}");
    let free = "--free film-modulus,contact-point,baseline,baseline-slope";
    let found = workdir.json(fit("tilted.csv", &format!("{known} {free} --json")));
    assert_estimate(&found, "film_modulus", 5e3, 200.0);
    assert!(!found.to_string().contains("may be tilted"), "{found}");
}

#[test]
fn a_report_says_which_modulus_is_young_s_and_which_is_reduced() {
    let workdir = workdir!();
    let simulate = "simulate --kind load-radius --from 4.2e-5 --to 1.3e-4 --noise 2e-6 --seed 1";
    let lens = workdir.succeed(format!("{simulate} {LENS}"));
    workdir.write("lens.csv", &lens);
    let fit = format!("fit lens.csv {LENS}");
    let with = |more: &str| format!("{fit} {more}");
    let report = workdir.succeed(with(""));
    let words =
        "Pa, reduced modulus E2*\n; 200 GPa, Young's modulus E0\n; 3.5 MPa, Young's modulus E1\n";
    assert_names(&report, words);
    assert!(!report.contains("nu2"), "{report}");
    let report = workdir.succeed(with("--sphere-poisson-ratio 0.5"));
    let words = "MPa, Young's modulus E2 = E2* (1 - nu2^2), nu2 = 0.5\n";
    assert_names(&report, words);
    let object = workdir.json(with("--sphere-poisson-ratio 0.5 --json"));
    let [value, error] = ["value", "stderr"].map(|key| {
        let young = number(&object, &format!("sphere_young_modulus/{key}"));
        let reduced = number(&object, &format!("parameters/sphere_modulus/{key}"));
        assert_close(young, 0.75 * reduced, 1e-14);
        young
    });
    assert_near(value, 0.75 * 2e6, 4.0 * error);
    workdir.refuses(format!(
        "
        2 | {fit} --sphere-poisson-ratio 0.6 | 0.6; above -1 and up to 0.5
        1 | {fit} --sphere-poisson-ratio 0.5 --free film-modulus | reduced modulus; --free sphere-modulus
        "
    ));
}

/// Two spheres of different radii, one a wide contact on layers, and each value of the bodies that a file may have of
/// its own.
#[test]
fn each_file_may_have_a_sphere_and_a_substrate_of_its_own() {
    let workdir = workdir!();
    let film = "--film-thickness 1um --film-modulus 3.5MPa --film-poisson-ratio 0.5 --sphere-modulus 2MPa \
         --work-of-adhesion 40mJ/m^2 --substrate-poisson-ratio 0.25";
    for (file, radius, substrate) in [("small.csv", "1mm", "70GPa"), ("large.csv", "3mm", "3MPa")] {
        workdir.succeed(format!(
            "simulate {film} --sphere-radius {radius} --substrate-modulus {substrate} --kind load-radius --from 10um \
             --to 60um --noise 10nN -o {file}"
        ));
    }
    let both =
        format!("fit small.csv large.csv {film} --free sphere-modulus,work-of-adhesion --value");
    let own = "sphere-radius=1mm,3mm --value substrate-modulus=70GPa,3MPa";
    let found = workdir.json(format!("{both} {own} --json"));
    assert_estimate(&found, "sphere_modulus", 2e6, 1e4);
    assert_estimate(&found, "work_of_adhesion", 0.04, 1e-3);
    let report = workdir.succeed(format!("{both} {own}"));
    assert_names(&report, "sphere-radius             1 mm, 3 mm");

    // A rigid substrate needs no Poisson ratio, and shows none, in any order of the flags.
    let film = film.replace(" --substrate-poisson-ratio 0.25", "");
    let rigid = "--value substrate-modulus=inf,3MPa";
    let ratios = "--value substrate-poisson-ratio=0.2,0.25";
    let of_two = format!(
        "fit small.csv large.csv {film} --free sphere-modulus --value sphere-radius=1mm,3mm"
    );
    for flags in [
        format!("{rigid} {ratios}"),
        format!("{ratios} {rigid}"),
        format!("--substrate-poisson-ratio 0.25 {rigid}"),
    ] {
        let report = workdir.succeed(format!("{of_two} {flags}"));
        assert_names(
            &report,
            "substrate-poisson-ratio   0.25; substrate-modulus         +1 %",
        );
        assert!(!report.contains("NaN"), "{report}");
    }
    let alone = format!("fit small.csv {film} --sphere-radius 1mm --free sphere-modulus --value");
    let report = workdir.succeed(format!("{alone} substrate-modulus=inf"));
    assert!(!report.contains("poisson-ratio   0.25"), "{report}");
    workdir.refuses(format!(
        "1 | {of_two} --substrate-modulus inf {rigid} | --substrate-poisson-ratio is missing
         1 | {alone} substrate-modulus=70GPa | --substrate-poisson-ratio is missing
         2 | {alone} sphere_radius=1mm | the parameters are; --value also takes sphere-radius, half-angle, substrate-modulus
         1 | fit small.csv --half-space --specimen paper --value substrate-modulus=1MPa | a half-space has no substrate"
    ));

    let common = format!("{both} substrate-modulus=70GPa,3MPa");
    workdir.refuses(format!(
        "2 | {both} sphere-radius=1mN,3mm | a length is wanted
         2 | {both} load-offset=0 --sphere-radius 1mm,3mm | several values; --value NAME=VALUE,VALUE
         2 | {both} load-offset=0 --sphere-radius 1e-3,3e-3 | several values
         2 | {both} load-offset=0 --sphere-radius 1,5mm | the decimal mark is a point
         2 | {both} sphere-radii=1mm,3mm | is not a parameter
         1 | {common} --value sphere-radius=1mm,2mm,3mm | --value sphere-radius: 3 values for 2 files; give one
         1 | {common} --value sphere-radius=1mm,-3mm | sphere-radius of large.csv = -0.003; above 0
         1 | {common} --value sphere-radius=1,3 | 1 mm, 1 um or 1 nm was probably meant
         1 | {common} --value sphere-radius=1mm,3mm --value sphere-radius=1mm | given twice
         1 | {common} --value sphere-radius=1mm,3mm --known sphere-radius=1mm+-1um | one quantity twice
         1 | {common} --value sphere-radius=1mm,3mm --probe cone --half-angle 70 | left out: the probe has no radius"
    ));

    // The contact is wider than the sphere of the paper's example, which stands in before the value is read.
    workdir.write(
        "gel.toml",
        "base = { young_modulus = 70e9, poisson_ratio = 0.25 }\n[[layers]]\nname = \"gel\"\nyoung_modulus = 3.5e6\n\
         poisson_ratio = 0.5\nthickness = 1e-3\n",
    );
    let gel = "--stack gel.toml --sphere-modulus inf --work-of-adhesion 50mJ/m^2";
    workdir.run(format!(
        "simulate {gel} --sphere-radius 20mm --kind load-radius --from 200um --to 2mm --noise 1uN -o wide.csv"
    ));
    for radius in [
        "--value sphere-radius=20mm",
        "--known sphere-radius=20mm+-1nm",
    ] {
        let found = workdir.json(format!(
            "fit wide.csv {gel} --free gel.modulus {radius} --json"
        ));
        assert_estimate(&found, "gel.modulus", 3.5e6, 1e4);
    }
}
