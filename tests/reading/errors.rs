//! Tables that cannot be read: each error names the place and the next step. `habits.rs` has others.

use acceptance::Refused;
use fit::Kind;
use fit::data::{Format, Remedy};

use crate::{named, of_kind, read, rows, sound, with};

/// Asserts that a text is refused with these words.
#[track_caller]
fn refused(text: &str, format: &Format, words: &str) {
    read(text, format).refused(words);
}

#[test]
fn an_error_names_line_column_value_and_next_step() {
    // A wrong row above three sound ones is not taken for a line before the headings.
    let cases = r#"
        contact_radius,load\n1,x\n1,2\n2,3\n3,4\n | line 2; "x"
        contact_radius,load\nx,y\n1,2\n2,3\n3,4\n | line 2; "x"
        1,2\n3,4\n | line 1; 2 cells; by their numbers
        # lens\n\n1,2\n3,4\n | line 3; headings
        contact_radius,load\n1,2\n2,3\n3,x\n | line 4, column 2 "load"; "x"; not a number; #
        contact_radius,load\n1,2\nNaN,3\n | line 3, column 1; missing; #
        contact_radius,load\n1,2\n2,1e999\n | line 3, column 2; 1e999
        contact_radius,load\n1,2\n-2,3\n | line 3, column 1; -2; below 0
        contact_radius,load\n1,2\n2,3\n4,5,6\n | line 4; 3 cells; 2; decimal
        contact_radius,load\n1,2\n2,3\n4\n | line 4; 1 cell
        contact_radius,load\n1,5,2,5\n1,6,2,7\n1,8,2,9\n | line 2; 4 cells; 2 headings; semicolons or tabs; decimal points
        contact_radius,load,segment\n1,5,2,5,approach\n1,6,2,7,approach\n1,8,2,9,approach\n | line 2; 5 cells; 3 headings; a heading
        contact_radius,load\n1,2\n1,3\n | column 1; all 2 values are 1.0
        contact_radius,load\n1,2\n2,2\n | column 2; all 2 values are 2.0
        a [nm];F [uN]\n60,000;-413.6\n | line 2, column 2; "-413.6"; if ',' parts thousands, remove it
        a [um];F [uN]\n242,1;1.919\n | "1.919"; if '.' parts thousands, remove it
        Radius,Load [mN]\n1,2\n2,3\n | column 1 "Radius"; no unit; contact_radius; "um"
        Radius [um],Load [mm]\n1,2\n2,3\n | load-radius lacks load (a force); penetration-radius lacks penetration (a length); "Radius [um]" (contact_radius), "Load [mm]" (a length)
        Radius [um],Load [mN],Load [uN]\n1,2,3\n2,3,4\n | columns 2 and 3; load; number
        Radius [um],Load [mN],Depth [nm]\n1,2,3\n2,3,4\n | more than one kind; load-radius, penetration-radius, load-penetration
        x,y\n1,2\n2,3\n | no kind; "x", "y"; force-height lacks height (a length) and load (a force)
        z [nm],defl [nm]\n1,2\n2,1\n | column 2; stiffness
        Depth [nm],Load [mN],Stiffness [N/m]\n1,2,3\n2,3,4\n | more than one kind; load-penetration, stiffness-load, stiffness-depth
        contact diameter [um],F [mN]\n1,2\n2,3\n | lacks contact_radius; "contact diameter [um]" (a length, to be converted); convert the numbers
        a [um],Force (x10 nN)\n1,2\n2,3\n | lacks load; "Force (x10 nN)" ("x10 nN" is not a known unit); convert the numbers
        No,a [um],F [mN]\n1,1,2\n2,2,3\n3,3,5\nMean,2,3.3\n | line 5, column 1 "No"; "Mean"; only numbers above; #
        a [um],Load (cor)\n1,2\n2,3\n | lacks load (a force); "a [um]" (contact_radius), "Load (cor)"
        No,a [um],F [mN]\n,1,2\n2,2,3\n3,3,5\n4,4,6\nMean,2,3.3\n5,5,7\n | line 6, column 1 "No"; "Mean"
        a [um],F [mN]\n1.2x10^-3,1\n2.2x10^-3,2\n | "a [um],F [mN]" are headings; "1.2x10^-3,1", in which "1.2x10^-3" is not a number; 1.5e-3
        a [um];F [mN]\n40 um;0.1 mN\n | "40 um;0.1 mN", in which "40 um" is not a number
        a [um];F [mN]\n40\n50\n | below is "40", which holds fewer than two numbers
        height,force,direction\n3,0,1\n2,1,1\n3,0,-1\n | line 4, column 3; "-1" is not a segment; split
        height,force,phase\n1,2,approach\n1,3,sideways\n | line 3, column 3; sideways; approach; split
        contact_radius,load\n,2,\n1,2\n2,3\n | line 2
        height,force,phase\n1,2,pause\n1,3,pause\n | 2 rows; no point
        "#;
    for [text, words] in rows(cases) {
        refused(&text, &Format::default(), &words);
    }
}

#[test]
fn bytes_that_are_not_text_are_refused() {
    for (bytes, words) in [
        (&b"a,b\n1,\0\n"[..], "file; binary data"),
        (&[b'1'; 70_000], "file; line 1: the line is longer than"),
    ] {
        fit::data::read_from(bytes, "file", &Format::default()).refused(words);
    }
    let missing = fit::data::read("no/such/file".as_ref(), &Format::default());
    missing.refused("no/such/file");
}

#[test]
fn a_column_that_is_not_there_is_refused() {
    let three = "Radius [um],Load [mN],Load (mN)\n1,2,3\n2,3,4\n";
    let cases = r#"
        load=Kraft [mN] | Kraft; load; Radius [um]
        load=4 | "4"; the columns are
        load=Load | columns 2 and 3
        load=Radius [um] | "Radius [um]" is named as load; a force
        load=2, load=3, contact_radius=1 | columns 2 and 3 could both be load
        "#;
    for [columns, words] in rows(cases) {
        let columns: Vec<&str> = columns.split(", ").collect();
        refused(three, &named(&columns), &words);
    }
    // Numbers of which one has no decimals would be others by their places.
    let by_places = named(&["contact_radius=1 [um]", "load=2 [mN]"]);
    let commas = "radius [um],load [mN]\n42,0,1\n50,0,2\n61,0,35\n70,0,5\n";
    refused(commas, &by_places, "line 2; 3 cells; 2 headings; a heading");
    let text = "a [um],Force (x10 nN)\n1,2\n2,3\n";
    let unknown = named(&["load=Force (x10 nN)"]);
    refused(text, &unknown, "\"x10 nN\", which is not a known unit; mN");
    let format = of_kind(Kind::LoadPenetration);
    let text = "Radius [um],Load [mN]\n1,2\n2,3\n";
    let words = "load-penetration lacks penetration (a length); \"Radius [um]\" (contact_radius), \"Load [mN]\" (load)";
    refused(text, &format, words);
}

/// What a length in another word is offered as: the kinds and columns of the remedy, and what is to be
/// given beside them.
#[test]
fn a_length_is_offered_only_as_what_it_can_be() {
    let none = Format::default();
    let depths = of_kind(Kind::StiffnessDepth);
    let cases = r"
        Tip-Sample Separation (nm),Force (nN) | the stiffness
        Separation (nm),Deflection (nN) | the stiffness
        Abstand [nm],Kraft [nN] | separation=Abstand [nm] load=Kraft [nN] Separation
        gap [nm],force | separation=gap [nm] Separation
        Piezo distance (nm),Force (nN) | contact_radius=Piezo distance (nm), penetration=Piezo distance (nm), height=Piezo distance (nm)
        Contact Depth (nm),Load (mN),Stiffness [N/m] | penetration=Contact Depth (nm) ContactDepth
        hc [nm],Load (mN),Stiffness [N/m] | penetration=hc [nm] ContactDepth
        Kontakttiefe (nm),Load (mN) | contact_radius=HEADING [UNIT], penetration=HEADING [UNIT], height=HEADING [UNIT]
        Kontaktdurchmesser (mm),Kraft (mN) |
        Durchmesser (mm),Force (mN) |
        Aire de contact (mm²),Force (mN) |
        Surface (mm2),Force (mN) |
        接触直径 (mm),F (mN) |
        面积 (um^2),F (mN) |
        Radius,Load [mN] | contact_radius=Radius [UNIT]
        ";
    for [heads, expected] in rows(cases) {
        let format = if heads.contains("Stiffness") {
            &depths
        } else {
            &none
        };
        let row = "1,2,3".split(',').take(heads.split(',').count());
        let row = row.collect::<Vec<_>>().join(",");
        let error = read(&format!("{heads}\n{row}\n{row}\n"), format).expect_err(&heads);
        let ways = match error.remedy.as_deref() {
            Some(Remedy::Columns(ways)) => ways.as_slice(),
            Some(Remedy::Cantilever { sensitivity: false }) if expected == "the stiffness" => {
                continue;
            }
            None => &[],
            Some(other) => panic!("{heads}: {other:?}"),
        };
        let ways = ways.iter().map(|way| {
            let columns = way.columns.iter();
            let columns = columns.map(|(role, heading)| format!("{}={heading}", role.name()));
            let reduced = way.reduced.map(|reduced| format!("{reduced:?}"));
            columns.chain(reduced).collect::<Vec<_>>().join(" ")
        });
        assert_eq!(ways.collect::<Vec<_>>().join(", "), expected, "{error}");
    }
}

/// A name does not make a radius of a diameter, nor a load of what its heading says to be a load over a radius.
#[test]
fn a_column_is_not_what_its_heading_denies() {
    let text = "contact diameter 2a (um),F/R (mN/m),Area\n1,2,3\n2,3,4\n";
    for (column, words) in [
        (
            "contact_radius=contact diameter 2a (um)",
            "diameter; not the contact radius; half",
        ),
        ("contact_radius=1", "diameter; not the contact radius; half"),
        (
            "load=F/R (mN/m)",
            "F/R (mN/m); not a force; times the radius",
        ),
        (
            "load=F/R (mN/m) [mN]",
            "F/R (mN/m); not a force; times the radius",
        ),
        ("load=F/R [mN]", "F/R (mN/m); not a force; times the radius"),
        ("load=2 [mN]", "F/R (mN/m); not a force; times the radius"),
        ("contact_radius=Area [um]", "Area; not the contact radius"),
    ] {
        refused(text, &named(&[column]), words);
    }
    sound(
        "Area,Load (mN)\n1,2\n2,3\n",
        &named(&["contact_area=Area [um^2]"]),
    );
}

#[test]
fn a_cantilever_that_makes_no_force_is_named() {
    let text = "height [m],deflection [V]\n1e-6,1\n2e-6,2\n3e-6,4\n";
    for (stiffness, sensitivity) in [
        (f64::NAN, 1e-7),
        (-0.1, 1e-7),
        (f64::INFINITY, 1e-7),
        (0.1, 0.0),
        (0.1, f64::NAN),
        (1e-300, 1e-300),
    ] {
        let words = "turns no deflection into a force; positive and finite";
        refused(text, &with(stiffness, Some(sensitivity)), words);
    }
    // A separation has the deflection in it.
    let text = "separation [m],force [N]\n1e-6,1\n2e-6,2\n3e-6,4\n";
    for stiffness in [0.0, -0.1, f64::NAN, f64::INFINITY] {
        refused(text, &with(stiffness, None), "positive and finite");
    }
}
