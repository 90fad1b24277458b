//! Tables as programs and instruments write them. The numbers are invented.

use fit::data::{Format, Remedy, Segments};
use fit::{Direction, Kind};

use crate::{assert_values, directions, named, of_kind, sound, values, with};

/// Two points with a radius of 50 and 60 um and a load of -0.1 and 0.2 mN.
const TWO: [[f64; 2]; 2] = [[50e-6, -0.1e-3], [60e-6, 0.2e-3]];

#[test]
fn delimiters_decimal_marks_quotes_comments_and_ends_of_line() {
    for text in [
        "contact_radius,load\n5e-5,-1e-4\n6e-5,2e-4\n",
        "load,contact_radius\n-1e-4,5e-5\n2e-4,6e-5",
        "Radius (um),Force [mN]\n50,-0.1\n60,0.2\n",
        "\u{feff}Radius [µm];Kraft;Force [mN]\r\n50,0;7;-0,1\r\n60,0;7;0,2\r\n",
        "Radius_um\tForce_mN\n50\t-0,1\n60\t0,2\n",
        "Force [mN]   Radius [um]\n  -0.1   50\n   0.2   60\n",
        "Force [mN]   Radius [um]\n  -0,1   50\n   0,2   60\n",
        "\"Contact radius / um\",\"Normal load / mN\"\n\"50,0\",\"-0,1\"\n\"60,0\",\"0,2\"\n",
        "# a lens\n\n% on a film\n# Radius [um], Load [mN]\n50, -0.1\n// a pause\n60, 0.2\n\n# end\n",
        "Radius,Load\num,mN\n50,-0.1\n60,0.2\n",
        "Radius;Load;Time\n[um];[mN];[s]\n50;-0.1;0\n60;0.2;1\n",
        "Instrument: lens 7\nDate;1;12;2024\n\nRadius [um];Load [mN];Date;X\n50;-0.1;a;b\n60;0.2;a;b\n",
        "Radius [um];Load [mN]\n50;-0.1;\n60;0.2;\n",
        "a/um;F/mN\n50;-0.1\n60;0.2\n",
        "radius {micrometres},force in Newton (mN)\n50,-0.1\n60,0.2\n",
    ] {
        let text = text.replace("force in Newton", "force");
        let reading = sound(&text, &Format::default());
        assert_eq!(reading.measurement.kind, Kind::LoadRadius, "{text}");
        assert_values(&values(&reading), &TWO);
    }
}

#[test]
fn lines_of_points_are_kept() {
    let text = "# lens\nRadius [um]\tLoad [mN]\n\n50\t-0.1\n# note\n60\t0.2\n";
    let reading = sound(text, &Format::default());
    assert_values(&values(&reading), &TWO);
    let lines: Vec<u64> = reading.measurement.points.iter().map(|p| p.line).collect();
    assert_eq!(lines, [4, 6]);
    assert_eq!(reading.measurement.name, "file");
}

#[test]
fn kinds_are_told_by_the_columns_or_by_the_user() {
    let curve = "contact_radius,load,penetration,jkr_abscissa\n1,2,3,4\n2,3,4,5\n";
    for (kind, first) in [
        (Kind::LoadRadius, [1.0, 2.0]),
        (Kind::PenetrationRadius, [1.0, 3.0]),
        (Kind::LoadPenetration, [3.0, 2.0]),
    ] {
        let reading = sound(curve, &of_kind(kind));
        assert_eq!(reading.measurement.kind, kind);
        assert_eq!(values(&reading)[0], first);
    }
    for (header, kind) in [
        ("Indentation (nm),Load (uN)", Kind::LoadPenetration),
        ("contact_radius,penetration", Kind::PenetrationRadius),
        ("Piezo/nm,Force/nN", Kind::ForceHeight),
        (
            "Height (Measured) [m],Vertical deflection [N]",
            Kind::ForceHeight,
        ),
        ("force,height (measured)", Kind::ForceHeight),
        ("z_nm,vDeflection_V", Kind::ForceHeight),
    ] {
        let reading = sound(&format!("{header}\n1,2\n2,1\n"), &with(1.0, Some(1.0)));
        assert_eq!(reading.measurement.kind, kind, "{header}");
    }
}

#[test]
fn columns_are_named_by_heading_by_number_and_with_a_minus() {
    let text = "R,Cell [mN],Spare [mN]\n50,0.1,0\n60,-0.2,0\n";
    for columns in [
        ["contact_radius=R [um]", "load=-Cell [mN]"],
        ["contact_radius=r [um]", "load=-cell"],
        ["contact_radius=1 [um]", "load=-2"],
    ] {
        assert_values(&values(&sound(text, &named(&columns))), &TWO);
    }
    let bare = "50;-0,1\n60;0,2\n";
    let numbers = ["contact_radius=1 [um]", "load=2 [mN]"];
    assert_values(&values(&sound(bare, &named(&numbers))), &TWO);
    // A heading may hold the sign behind the role.
    let text = "h,P,S=dP/dh\n1,2,3\n2,3,4\n";
    let columns = [
        "penetration=h [nm]",
        "load=P [mN]",
        "contact_stiffness=S=dP/dh [N/m]",
    ];
    let format = Format {
        kind: Some(Kind::StiffnessDepth),
        ..named(&columns)
    };
    assert_values(&values(&sound(text, &format)), &[[1e-9, 3.0], [2e-9, 4.0]]);
    // A column that is named decides the kind.
    let text = "contact_radius,load,penetration\n1,2,3\n2,3,4\n";
    let reading = sound(text, &named(&["load=load", "penetration=penetration"]));
    assert_eq!(reading.measurement.kind, Kind::LoadPenetration);
}

#[test]
fn segments_come_from_a_column_from_comments_from_headings_or_from_the_course() {
    let by_column = "height,force,segment\n2,0,approach\n1,1,Extend\n1,1,pause\n2,0,RETRACT\n";
    let by_number = "height,force,phase\n2,0,0\n1,1,False\n2,0,1\n";
    let unknown = "height,force,phase\n2,0,5\n1,1,6\n2,0,7\n";
    let by_comment = "# segment: extend\n# columns: height force\n# units: m N\n2 0\n1 1\n\n\
                      # segment: retract\n# columns: height force\n# units: m N\n1 0.9\n2 0\n";
    let by_heading = "Extend Z(nm),Extend Force(nN),Retract Z(nm),Retract Force(nN)\n\
                      2,0,1,0.9\n1,1,2,-0.5\n,,3,0\n";
    let none = "height,force\n2,0\n1,1\n1.5,0.2\n2,0\n";
    let lens = "contact_radius,load\n1,0\n2,1\n1.5,0.2\n1,0\n";
    // The directions, whether they were split, and the number of rows that were left out.
    for (text, segments, only, expected) in [
        (by_column, Segments::Auto, None, "aar 1"),
        (by_column, Segments::Auto, Some(Direction::Retract), "r 3"),
        (by_number, Segments::Auto, None, "aar 0"),
        (unknown, Segments::Split, None, "aar split 0"),
        (by_comment, Segments::Auto, None, "aarr 0"),
        (by_heading, Segments::Auto, None, "aarrr 0"),
        (none, Segments::Auto, None, "aarr split 0"),
        (none, Segments::File, None, "---- 0"),
        (lens, Segments::Auto, None, "---- 0"),
        (lens, Segments::Split, None, "aarr split 0"),
    ] {
        let format = Format {
            segments,
            only,
            ..Format::default()
        };
        let reading = sound(text, &format);
        let split = reading.notes.split.map_or("", |_| " split");
        let left_out = reading.notes.pauses + reading.notes.other_segments;
        let found = format!("{}{split} {left_out}", directions(&reading));
        assert_eq!(found, expected, "{text}");
    }
    // The rows of a pause go on in their way where a history needs them.
    let kept = Format {
        keep_pauses: true,
        ..Format::default()
    };
    assert_eq!(directions(&sound(by_column, &kept)), "aaar");
    // A heading may hold a direction itself.
    let format = Format {
        segments: Segments::File,
        ..named(&["segment=extend or retract"])
    };
    let text = by_column.replace("segment", "extend or retract");
    assert_eq!(directions(&sound(&text, &format)), "aar");
}

#[test]
fn a_deflection_becomes_a_force_by_stiffness_and_sensitivity() {
    for (text, sensitivity) in [
        ("z [um],defl [nm]\n2,0\n1,30\n", None),
        ("z [um],defl [V]\n2,0\n1,0.5\n", Some(60e-9)),
        // A force is preferred to a deflection.
        ("z [um],defl [nm],force [nN]\n2,0,0\n1,99,3\n", None),
    ] {
        let found = values(&sound(text, &with(0.1, sensitivity)));
        assert_values(&found, &[[2e-6, 0.0], [1e-6, 3e-9]]);
    }
}

#[test]
fn rows_without_values_are_left_out_and_counted() {
    let text = "contact_radius,load,note\n1,2,a\n,,b\nnan,NaN,c\n2,3,d\n";
    let reading = sound(text, &Format::default());
    assert_values(&values(&reading), &[[1.0, 2.0], [2.0, 3.0]]);
    assert_eq!(reading.notes.missing, 2);
    assert_eq!(reading.notes.unused, ["note"]);
}

/// Times that are not those of all points tell nothing: the first line without one is told.
#[test]
fn times_are_those_of_all_points_or_of_none() {
    let read = |head: &str, last: &str| {
        let text = format!("{head}\n1,2,0\n2,3,0.5\n3,5,{last}\n");
        let reading = sound(&text, &Format::default());
        (reading.times, reading.notes.untimed)
    };
    let minutes = "penetration,load,Time [min]";
    assert_eq!(read(minutes, "1"), (vec![0.0, 30.0, 60.0], None));
    assert_eq!(read("penetration,load,t [h]", "1").0, [0.0, 1800.0, 3600.0]);
    assert_eq!(read(minutes, "nan"), (vec![], Some(4)));
    assert_eq!(read(minutes, "00:01:00"), (vec![], Some(4)));
}

/// A contact area gives the radius where the user says so.
#[test]
fn a_contact_area_gives_the_radius_of_a_kind_that_is_asked_for() {
    let [small, large] = [50.0, 60.0].map(|radius| std::f64::consts::PI * radius * radius);
    let text = format!("contact area [um^2];F [mN]\n{small};-0.1\n{large};0.2\n");
    let reading = sound(&text, &of_kind(Kind::LoadRadius));
    assert_values(&values(&reading), &TWO);
    // A column that is named asks for it.
    let text = format!("A [um^2];Height [nm];F [mN]\n{small};9;-0.1\n{large};8;0.2\n");
    let reading = sound(&text, &named(&["contact_area=A"]));
    assert_values(&values(&reading), &TWO);
}

/// Loads of Hertz at depths from where the bodies are apart, at an even distance: `0` to `4`, with the
/// first touch at 2. `row` makes a row of depth and load.
fn rising(heading: &str, row: impl Fn(f64, f64) -> [f64; 2]) -> String {
    let rows = (0..=20).map(|i| {
        let depth = 0.2 * f64::from(i);
        let [abscissa, ordinate] = row(depth, (depth - 2.0).max(0.0).powf(1.5));
        format!("{abscissa:?},{ordinate:?}\n")
    });
    format!("{heading}\n{}", rows.collect::<String>())
}

/// The bend of the curve tells which column it is, and the remedy turns it.
#[test]
fn a_sign_that_counts_in_the_opposite_sense_is_doubted() {
    let (height, depth, radius) = ("height,force", "penetration,load", "contact_radius,load");
    let both_of_height = "height=-height load=-force";
    let both_of_depth = "penetration=-penetration load=-load";
    let pulled = |x: f64, y: f64| if x < 2.0 { -0.1 * x } else { y - 0.2 };
    let attracted = |x: f64, y: f64| if x < 2.0 { 0.0 } else { y - 9.0 };
    let mut spike = rising(height, |depth, load| [-depth, load]);
    spike = spike.replace("-0.4,0.0", "-0.4,-500.0");
    // The approach stays apart up to the deepest point, and the retract still pulls there.
    let apart =
        rising("height,force,segment", |depth, _| [-depth, 0.0]).replace(".0\n", ".0,approach\n");
    let cycle = rising("", |depth, load| [-depth, load - 9.0]);
    let cycle = cycle.lines().skip(1).map(|row| format!("{row},retract\n"));
    let cycle = apart + &cycle.collect::<String>();
    for (text, opposite) in [
        (cycle, ""),
        (rising(height, |x, y| [-x, y]), ""),
        (rising(height, |x, y| [9.0 - x, y + 7.0]), ""),
        (spike, ""),
        (rising(height, |x, y| [x, y]), "height=-height"),
        (rising(height, |x, y| [-x, -y]), "load=-force"),
        (rising(height, |x, y| [x, -y]), "height=-height load=-force"),
        (rising(height, |x, y| [x, 1.0 - y]), both_of_height),
        (rising(depth, |x, y| [x, y]), ""),
        // A contact that still pulls at its deepest, after the jump into it.
        (rising(depth, |x, y| [x, attracted(x, y)]), ""),
        (rising(height, |x, y| [-x, attracted(x, y)]), ""),
        // The drag of a liquid follows the root of the depth.
        (rising(depth, |x, _| [x, x.sqrt()]), ""),
        (rising(depth, |x, y| [-x, y]), "penetration=-penetration"),
        (rising(depth, |x, y| [x, -y]), "load=-load"),
        (rising(depth, |x, y| [-x, -y]), both_of_depth),
        // Without points apart.
        (rising(depth, |x, _| [-x, -x.powf(1.5)]), both_of_depth),
        (rising(radius, |x, y| [x, y]), ""),
        (rising(radius, |x, y| [x, pulled(x, y)]), ""),
        // Drift lowers a load by little.
        (
            rising(depth, |x, _| [x, if x == 2.0 { 1.0 } else { -0.025 * x }]),
            "",
        ),
        // Up to the largest pull of a contact.
        (rising(radius, |x, _| [x, (x - 4.0).powi(2)]), ""),
        (rising(radius, |x, y| [x, -y]), "load=-load"),
        ("height,force\n3,0\n2,0\n1,1\n".into(), ""),
        ("height,force\n1,0\n2,0\n3,1\n".into(), "height=-height"),
        ("height,force\n3,0\n2,0\n1,-1\n".into(), "load=-force"),
        // A straight line does not tell, nor one that hardly bends.
        ("height,force\n3,2\n2,1.01\n1,0\n".into(), "height=-height"),
        ("contact_radius,load\n1,-1\n2,-1.2\n3,1\n".into(), ""),
        (
            "contact_radius,load\n1,0\n2,-0.2\n3,-1\n".into(),
            "load=-load",
        ),
    ] {
        let doubts = sound(&text, &Format::default()).notes.doubts;
        let found = doubts.first().map(|doubt| {
            assert!(doubt.text.contains("opposite sense"), "{}", doubt.text);
            let Some(Remedy::Columns(ways)) = &doubt.remedy else {
                panic!("no columns: {}", doubt.text);
            };
            let columns = ways[0].columns.iter();
            let columns = columns.map(|(role, heading)| format!("{}={heading}", role.name()));
            columns.collect::<Vec<String>>().join(" ")
        });
        assert_eq!(found.unwrap_or_default(), opposite, "{text}");
    }
}

/// A file can hold several curves, rows in no order, directions that are wrong, and commas that part thousands.
#[test]
fn a_course_or_commas_that_are_doubtful_are_told() {
    let up = || 1..=20;
    let down = || (1..=20).rev();
    let text = |heights: &mut dyn Iterator<Item = i32>, segment: &str| -> String {
        let row = |height| format!("{height},{}{segment}\n", 20 - height);
        heights.map(row).collect()
    };
    let doubts = |head: &str, rows: &str| -> Vec<String> {
        let reading = sound(&format!("{head}\n{rows}"), &Format::default());
        let doubts = reading.notes.doubts.iter();
        doubts.map(|doubt| doubt.text.clone()).collect()
    };
    let cycle = |segment| text(&mut down().chain(up()), segment);
    let [bare, named] = ["height,force", "height,force,segment"];
    let none: [&str; 0] = [];
    assert_eq!(doubts(bare, &cycle("")), none);
    let both = text(&mut down(), ",1_extend") + &text(&mut up(), ",2_retract");
    assert_eq!(doubts(named, &both), none);
    let mixed = |segment| text(&mut (0..40).map(|i| i * 17 % 40), segment);
    assert_eq!(doubts(named, &mixed(",extend")), none);
    for (head, rows, words) in [
        (bare, cycle("").repeat(2), "\"height\" turns back 2 times"),
        (bare, mixed(""), "\"height\" jumps to and fro"),
        (
            bare,
            text(&mut down(), "").repeat(2),
            "\"height\" turns back 2 times",
        ),
        (named, both.repeat(2), "\"height\" turns back 2 times"),
        (
            named,
            cycle(",retract"),
            "there and back in the rows that are read as retract",
        ),
        (
            "contact_radius;load",
            "1,100;2,300\n2,100;3,300\n".to_owned(),
            "1,249 is 1.249; if the commas part thousands, take",
        ),
        (
            "contact_radius;load",
            "1.100;2.300\n242;3.300\n".to_owned(),
            "1.249 is not 1249; if these marks part thousands, take",
        ),
    ] {
        let doubts = doubts(head, &rows);
        assert_eq!(doubts.len(), 1, "{head} {words}: {doubts:?}");
        assert!(doubts[0].contains(words), "{doubts:?}");
    }
}

/// Heights and forces of Nanoscope have a column for each direction.
#[test]
fn both_columns_of_a_sign_are_named() {
    let row = |i: i32| format!("{0},{0},{1:e},{1:e}\n", i, f64::from((i - 10).max(0)));
    let rows: String = (0..20).map(row).collect();
    let text = format!("Ramp_nm_Ex,Ramp_nm_Rt,Defl_nN_Ex,Defl_nN_Rt\n{rows}");
    let heights = ["height=Ramp_nm_Ex", "height=Ramp_nm_Rt"];
    let reading = sound(&text, &named(&heights));
    let Some(Remedy::Columns(ways)) = &reading.notes.doubts[0].remedy else {
        panic!("no columns: {:?}", reading.notes.doubts);
    };
    let columns = ways[0].columns.iter();
    let headings: Vec<&str> = columns.map(|(_, heading)| &**heading).collect();
    assert_eq!(headings, ["-Ramp_nm_Ex", "-Ramp_nm_Rt"]);
}

/// Times that are not read, as the user can name them.
#[test]
fn columns_that_can_be_times_are_told() {
    for (heads, times) in [
        (
            "Zeit [min];Segment Time (s);Temp [C]",
            "Zeit [min], Segment Time (s)",
        ),
        ("Time;no;x", "Time [UNIT]"),
        ("Index;no;x", ""),
    ] {
        let text = format!("penetration;load;{heads}\n1;2;3;4;5\n2;3;4;5;6\n");
        let found = sound(&text, &Format::default()).notes.unused_times;
        assert_eq!(found.join(", "), times, "{heads}");
    }
}

/// Unsorted rows and equal rows are a measurement like any other.
#[test]
fn the_order_of_rows_is_kept() {
    let text = "contact_radius,load\n3,1\n1,0\n1,0\n2,5\n";
    let expected = [[3.0, 1.0], [1.0, 0.0], [1.0, 0.0], [2.0, 5.0]];
    assert_values(&values(&sound(text, &Format::default())), &expected);
}

/// 60 um is 5.9999999999999995e-5 m as a product of two numbers, and 6e-5 m as a number with a unit.
#[test]
fn ends_that_are_rounded_otherwise_hold_their_points() {
    let ends = ["60um", "70um"].map(|end| end.parse().expect("a length"));
    let format = Format {
        between: Some(ends),
        ..Format::default()
    };
    let reading = sound("Radius [um],Load [mN]\n50,-0.1\n60,0.2\n", &format);
    assert_values(&values(&reading), &TWO[1..]);
}
