//! Files in the style of instruments' programs. The numbers are invented; the headings are those of
//! exports.

use acceptance::Refused;
use fit::Kind;
use fit::data::{DoubtKind, Format, Segments};

use crate::{assert_values, directions, named, read, rows, sound, values, with};

/// Headings, the kind that is asked for, and what one row of numbers gives in SI units.
#[test]
fn headings_of_instruments_are_recognised() {
    let given = with(2.0, Some(50e-9));
    // The writer, the file, whether it holds penetrations or heights, and the point. Signals in volts
    // are no length and no force. The sensors of Asylum Research and AFM Workshop and the piezo of
    // Optics11 grow towards the sample, the piezos of others need not.
    let cases = r"
        MTS, Agilent, Keysight, KLA | Displacement Into Surface,Load On Sample,Time On Sample\nnm,mN,s\n1,2,3 | depth | 1e-9 | 2e-3
        the same, units in brackets | Displacement Into Surface (nm);Load On Sample (mN);Raw Load (mN);Raw Displacement (nm)\n1;2;3;4 | depth | 1e-9 | 2e-3
        the same, in capitals | Time [s]\tDEPTH [nm]\tLOAD [mN]\n0\t1\t2 | depth | 1e-9 | 2e-3
        Hysitron, other signals in V | Depth (nm)\tLoad (µN)\tTime (s)\tDepth (V)\tLoad (V)\n1\t2\t3\t4\t5 | depth | 1e-9 | 2e-6
        Anton Paar | Time [s];Pd [nm];Fn [mN]\n0;1;2 | depth | 1e-9 | 2e-3
        FemtoTools and others | Force (uN),Displacement (um)\n2,1 | depth | 1e-6 | 2e-6
        JPK | Height (measured & smoothed) [m]\tVertical deflection [N]\tHeight [m]\n1\t2\t3 | height | 1.0 | 2.0
        JPK | strainGaugeHeight [m],vDeflection [N],height [m]\n1,2,3 | height | 1.0 | 2.0
        JPK | smoothedCapacitiveSensorHeight_m,vDeflection_V\n1,2 | height | 1.0 | 2e-7
        Bruker | Height_Sensor_nm_Ex\tDefl_pN_Ex\n1\t2 | height | 1e-9 | 2e-12
        Bruker | Calc_Ramp_Ex_nm Defl_nm_Ex\n1 2 | height | 1e-9 | 4e-9
        Asylum Research | ZSnsr_m,Defl_m\n1,2 | height | -1.0 | 4.0
        AFM Workshop | Extend Z-Sense(nm),Extend T-B(V)\n1,2 | height | -1e-9 | 2e-7
        Nanosurf | Z-Axis Sensor [m];Deflection [N]\n1;2 | height | 1.0 | 2.0
        Park | Z Detector(um)\tForce(nN)\n1\t2 | height | 1e-6 | 2e-9
        Optics11 | Piezo (nm)\tLoad (uN)\tCantilever (nm)\n1\t2\t3 | height | -1e-9 | 2e-6
        ";
    for [writer, text, abscissa, x, y] in rows(cases) {
        let reading = sound(&text, &given);
        let kind = match &*abscissa {
            "depth" => Kind::LoadPenetration,
            "height" => Kind::ForceHeight,
            other => panic!("{other}"),
        };
        assert_eq!(reading.measurement.kind, kind, "{writer}: {text}");
        let [x, y] = [x, y].map(|cell| cell.parse().expect("a number"));
        assert_values(&values(&reading), &[[x, y]]);
    }
}

/// Each segment has its own columns; a pause is left out, whatever its columns are.
const JPK: &str = "# springConstant: 0.05\n#\n\
    # segment: extend\n# columns: height vDeflection strainGaugeHeight\n\
    # fancyNames: \"Height\" \"Vertical deflection\" \"Height (measured)\"\n\
    # sensitivity: 5.0E-8\n# springConstant: 0.05\n# units: m N m\n#\n\
    9 0 3\n9 1 2\n9 2 1\n\n\
    # segment: pause\n# columns: height vDeflection strainGaugeHeight seriesTime time x\n\
    # units: m N m s s m\n#\n9 2 1 1 1 1\n9 2 1 2 2 2\n\n\
    # segment: retract\n# columns: vDeflection strainGaugeHeight\n# springConstant: 0.05\n\
    # units: N m\n#\n2 1.5\n1 2.5\n";

#[test]
fn segments_may_have_columns_of_their_own() {
    let reading = sound(JPK, &Format::default());
    let expected = [[3.0, 0.0], [2.0, 1.0], [1.0, 2.0], [1.5, 2.0], [2.5, 1.0]];
    assert_values(&values(&reading), &expected);
    assert_eq!(directions(&reading), "aaarr");
    let notes = &reading.notes;
    assert_eq!(
        [notes.pauses, notes.blocks, notes.other_segments],
        [2, 2, 0]
    );
    // A segment whose columns cannot be read is an error, not rows under the headings before.
    let columns = "vDeflection strainGaugeHeight\n# spring";
    let text = JPK.replace(columns, "error time\n# spring");
    let read = read(&text, &Format::default());
    read.refused("line 26: force-height lacks height");
}

#[test]
fn a_head_tells_the_cantilever_unless_it_is_given() {
    let reading = sound(JPK, &Format::default());
    let from_head = reading.notes.from_head();
    assert_eq!(from_head.len(), 1, "a force needs no sensitivity");
    let words = "stiffness 0.05 N/m from line 1, \"springConstant\"";
    assert_eq!(from_head[0], words);
    // A deflection in volts needs both.
    let volts = JPK
        .replace("# units: m N m\n", "# units: m V m\n")
        .replace("# units: N m", "# units: V m");
    let reading = sound(&volts, &Format::default());
    assert_values(&values(&reading)[1..3], &[[2.0, 2.5e-9], [1.0, 5e-9]]);
    assert_eq!(reading.notes.from_head().len(), 2);
    let given = with(0.1, None);
    let reading = sound(&volts, &given);
    assert_values(&values(&reading)[1..3], &[[2.0, 5e-9], [1.0, 1e-8]]);
    let text = &reading.notes.from_head()[0];
    assert!(text.contains("0.1 N/m as given"), "{text}");
    assert!(text.contains("0.05"), "{text}");
    // Two heads that differ.
    let of_retract = "strainGaugeHeight\n# springConstant: 0.0";
    let two = JPK.replace(&format!("{of_retract}5"), &format!("{of_retract}501"));
    let found = read(&two, &Format::default());
    found.refused("0.05 in line 1 and 0.0501 in line 23");
    assert!(read(&two, &given).is_ok(), "the one given holds");
    // Forces were made with the stiffness of the head. A rigid cantilever stands for heights without the deflection.
    for (stiffness, doubted) in [(0.05, false), (0.1, true), (49.0, true), (50.0, false)] {
        let doubts = sound(JPK, &with(stiffness, None)).notes.doubts;
        let of_stiffness = doubts
            .iter()
            .any(|doubt| doubt.kind == DoubtKind::Stiffness);
        assert_eq!(of_stiffness, doubted, "{stiffness} N/m");
    }
}

/// The instrument writes 1 where nobody has calibrated it.
#[test]
fn a_cantilever_that_is_not_calibrated_is_not_used() {
    let text = "Force-Distance Curve\nLight Lever Gain, mV/nm:\t1.000000\n\
                Force Constant, nN/nm:\t1.000000\n\nExtend Z-Sense(nm),Extend T-B(V)\n1,2\n2,3\n";
    let found = read(text, &Format::default());
    found.refused("line 2 has 1; not calibrated");
    let text = text.replace("1.000000", "0.500000");
    let reading = sound(&text, &Format::default());
    let expected = [[-1e-9, 2.0 * 0.5 * 2e-6], [-2e-9, 3.0 * 0.5 * 2e-6]];
    assert_values(&values(&reading), &expected);
}

/// One return alone among other ends of lines.
#[test]
fn mixed_ends_of_lines_are_read() {
    let text =
        "Date\t1\n\rk (N/m)\t0.019\r\nTime (s)\tLoad (uN)\tPiezo (nm)\r\n0\t1\t2\n1\t2\t3\r2\t3\t4";
    let format = Format {
        segments: Segments::File,
        ..Format::default()
    };
    let reading = sound(text, &format);
    let expected = [[2e-9, 1e-6], [3e-9, 2e-6], [4e-9, 3e-6]];
    assert_values(&values(&reading), &expected);
    assert_eq!(reading.notes.cantilever.stiffness, Some(0.019));
    let lines: Vec<u64> = reading.measurement.points.iter().map(|p| p.line).collect();
    assert_eq!(lines, [5, 6, 7]);
}

/// Programs of nanoindenters name the segment where it begins only.
#[test]
fn segments_of_nanoindenters_are_read() {
    let text = "Segment,Displacement Into Surface (nm),Load On Sample (mN)\n\
                Load Segment Type,1,1\n,2,3\nHold Segment Type,2,3\n,2,3\n\
                Unload From Peak Segment Type,1.5,2\n,1,0\n";
    let reading = sound(text, &Format::default());
    assert_eq!(directions(&reading), "aarr");
    assert_eq!(reading.notes.pauses, 2);
}

/// Loads that are taken off again, without a column of segments: neither their depth nor their load tells the contact radius.
#[test]
fn a_contact_stiffness_of_unloading_is_doubted() {
    let row = |load: f64, depth: f64| format!("{depth},{load},{}\n", 1e4 * load.sqrt());
    let loading = |load: u32| row(f64::from(load), 100.0 * f64::from(load).sqrt());
    // The depth hardly falls where most of it is plastic.
    let unloading = |load: u32| row(f64::from(load), 380.0 + 4.0 * f64::from(load));
    let rows = |ways: &[&dyn Fn(u32) -> String; 2], last: u32| {
        let there = (1..=20).map(ways[0]);
        let back = (last..20).rev().map(ways[1]);
        there.chain(back).collect::<String>()
    };
    for (headings, last, is_doubted) in [
        ("penetration [nm],load [mN],contact_stiffness", 2, true),
        ("x,load [mN],contact_stiffness", 2, true),
        ("penetration [nm],load [mN],contact_stiffness", 20, false),
    ] {
        let text = format!("{headings}\n{}", rows(&[&loading, &unloading], last));
        let kind = if headings.starts_with('x') {
            Kind::StiffnessLoad
        } else {
            Kind::StiffnessDepth
        };
        let format = Format {
            kind: Some(kind),
            ..Format::default()
        };
        let doubts = sound(&text, &format).notes.doubts;
        let is_said = doubts
            .iter()
            .any(|doubt| doubt.kind == DoubtKind::Directions);
        assert_eq!(is_said, is_doubted, "{headings} {last}: {doubts:?}");
        let split = Format {
            segments: Segments::Split,
            ..format
        };
        let reading = sound(&text, &split);
        assert_eq!(reading.measurement.points.len(), 20, "{headings}");
        assert!(reading.notes.doubts.is_empty(), "{headings}");
    }
}

/// Columns without headings, as those of NT-MDT: the user names the direction beside the number.
#[test]
fn a_column_without_a_heading_can_have_a_direction() {
    let columns = ["height=1 [nm]", "load=2 extend [nN]", "load=3 retract [nN]"];
    let reading = sound("-7,9\t1,5\t1,4\n-7,8\t1,6\t1,5\n", &named(&columns));
    let nm_and_nn = [[-7.9, 1.5], [-7.8, 1.6], [-7.9, 1.4], [-7.8, 1.5]];
    let expected = nm_and_nn.map(|point| point.map(|value| 1e-9 * value));
    assert_values(&values(&reading), &expected);
    assert_eq!(directions(&reading), "aarr");
}

/// A version of afmformats wrote no end of the line between headings and the first row.
#[test]
fn a_first_row_on_the_line_of_headings_is_read() {
    let text = "# END METADATA\n#\n# force\theight (measured)\tsegment\ttime-1e-9\t5e-6\tFalse\t1.5\n\
                0\t4e-6\tFalse\t1.6\n1e-9\t3e-6\tTrue\t1.7\n";
    let reading = sound(text, &Format::default());
    let expected = [[5e-6, -1e-9], [4e-6, 0.0], [3e-6, 1e-9]];
    assert_values(&values(&reading), &expected);
    assert_eq!(directions(&reading), "aar");
}

#[test]
fn standard_deviations_of_a_column_with_a_minus_are_positive() {
    let text = "R [um],Cell [mN],std\n50,0.1,0.01\n60,-0.2,0.02\n";
    let reading = sound(text, &named(&["contact_radius=R [um]", "load=-Cell [mN]"]));
    assert_eq!(reading.measurement.points[1].ordinate, 2e-4);
    for (found, expected) in reading.errors.ordinate.iter().zip([1e-5, 2e-5]) {
        assert!((found / expected - 1.0).abs() < 1e-14, "{found}");
    }
    assert_eq!(reading.errors.ordinate.len(), 2);
}

#[test]
fn storage_and_loss_give_the_phase() {
    let text = "contact radius [nm],storage stiffness [N/m],loss stiffness [N/m]\n\
                100,1000,1000\n200,3000,1732.0508075688772\n";
    let reading = sound(text, &Format::default());
    for (found, degrees) in reading.phases.iter().zip([45.0_f64, 30.0]) {
        let error = found / degrees.to_radians() - 1.0;
        assert!(error.abs() < 1e-14, "{found}");
    }
    assert_eq!(reading.phases.len(), 2);
    // The phase itself counts first.
    let both = "contact radius [nm],storage stiffness [N/m],loss stiffness [N/m],phase shift [rad]\n\
                100,1000,1000,0.5\n200,3000,1000,0.25\n";
    assert_eq!(sound(both, &Format::default()).phases, [0.5, 0.25]);
}
