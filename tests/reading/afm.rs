//! All text files among the test data of the Python package afmformats (MIT), which `cargo xtask
//! test` fetches: which are read, which are refused, and why.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

use fit::data::{Cantilever, Format, Reading, read};
use fit::{Direction, Kind};

use crate::rows;

/// Invented, for the files that tell nothing of the cantilever.
const GIVEN: Cantilever = Cantilever {
    stiffness: Some(0.1),
    sensitivity: Some(5e-8),
};

/// The file, as its end; a name that ends in a slash is that of an archive, all of whose texts are
/// meant. Then the cantilever, `given` or not; the kind or the columns that are asked for; and what
/// becomes of it: the points of approach, of retract and without a direction, as a count of its lines
/// gives, with the stiffness (N/m) that its head names, or the words of the message.
///
/// Two rows for a file show what is missing, and that it is read with it. Heights of AFM Workshop are
/// in nm and grow towards the sample, with forces or volts. Optics11 writes penetrations and heights;
/// one line ends in LF CR. NT-MDT has three columns, no heading, no head. The table of afmformats
/// itself has its first row on the line of headings. The texts in archives of JPK are properties, not
/// columns.
const ROWS: &str = "
    fd_single_2020-02-14_13.41.25.csv |  |  | read | 1015 1015 0
    fd_single_2021-10-22_14.16.csv |  |  | read | 1217 1217 0
    fd_single_2018-08-01_13.06.09.csv |  |  | refused | T-B(V); stiffness; sensitivity; does not name both
    fd_single_2018-08-01_13.06.09.csv | given |  | read | 570 570 0
    fd_single_2021-01-15.csv |  |  | refused | T-B(V); line 10 has 1; not calibrated
    fd_single_2021-01-15.csv | given |  | read | 3369 3369 0
    fd_mapping_16_2018-08-01_13.07.zip/ |  |  | refused | T-B(V); stiffness; sensitivity; does not name both
    fd_mapping_16_2018-08-01_13.07.zip/ | given |  | read | 391 391 0
    AEBP1_Indentation_002.txt |  |  | refused | more than one kind; load-penetration, force-height
    AEBP1_Indentation_002.txt |  | force-height | read | 12664 1163 0 0.019
    AEBP1_Indentation_002.txt |  | load-penetration | read | 0 0 13827
    Curve_DFL_Height_51.txt | given |  | refused | line 1; no line of 3 headings; by their numbers
    Curve_DFL_Height_51.txt | given | height=1 [nm]; deflection=2 extend [V]; deflection=3 retract [V] | read | 1000 1000 0
    fmt-tab-fd_version_0.13.3.tab |  |  | read | 3147 882 0 0.02230065831827453
    .properties |  |  | refused | no line holds two numbers
";

/// Returns the files of text, those in archives, too, by their names. The channels of JPK (`.dat`) are
/// binary numbers, some without a zero byte.
fn texts(folder: &Path) -> BTreeMap<String, PathBuf> {
    let mut found = BTreeMap::new();
    let entries = std::fs::read_dir(folder).expect("a folder");
    for path in entries.map(|entry| entry.expect("an entry").path()) {
        let name = path
            .file_name()
            .expect("a name")
            .to_string_lossy()
            .into_owned();
        if path.is_dir() {
            let inside = texts(&path).into_iter();
            found.extend(inside.map(|(inner, path)| (format!("{name}/{inner}"), path)));
            continue;
        }
        let bytes = std::fs::read(&path).expect("a file");
        if bytes.starts_with(b"PK") {
            let unpacked =
                Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("afmformats/{name}"));
            let status = Command::new("python3")
                .args(["-m", "zipfile", "-e"])
                .args([&path, &unpacked])
                .status();
            assert!(status.expect("python3 runs").success(), "{name}");
            let inside = texts(&unpacked).into_iter();
            found.extend(inside.map(|(inner, path)| (format!("{name}/{inner}"), path)));
        } else if !name.ends_with(".dat") && !bytes.contains(&0) {
            found.insert(name, path);
        }
    }
    found
}

#[test]
fn all_texts_of_afmformats_are_read_or_refused_with_the_reason() {
    let Some(source) = std::env::var_os("AFMFORMATS_SOURCE") else {
        println!("skipped: `cargo xtask test` fetches the data of afmformats");
        return;
    };
    let texts = texts(&Path::new(&source).join("tests/data"));
    let mut met = vec![false; texts.len()];
    for row in rows::<5>(ROWS) {
        let file = &*row[0];
        let mut count = 0;
        for (i, (name, path)) in texts.iter().enumerate() {
            let of_archive = file.ends_with('/') && name.contains(file);
            if !of_archive && !name.ends_with(file) {
                continue;
            }
            (met[i], count) = (true, count + 1);
            check(&row, name, path);
        }
        assert!(count > 0, "there is no {file}");
    }
    let left: Vec<&String> = texts
        .keys()
        .zip(met)
        .filter_map(|(name, met)| (!met).then_some(name))
        .collect();
    assert!(left.is_empty(), "not in the table: {left:?}");
}

fn check([_, cantilever, asked, outcome, what]: &[String; 5], name: &str, path: &Path) {
    let mut format = Format {
        kind: Kind::of_name(asked),
        ..Format::default()
    };
    if cantilever == "given" {
        format.cantilever = GIVEN;
    }
    if format.kind.is_none() {
        let columns = asked.split("; ").filter(|column| !column.is_empty());
        format.columns = columns
            .map(|text| text.parse().expect("a column"))
            .collect();
    }
    let found = read(path, &format);
    if outcome == "refused" {
        let message = found.expect_err(name).to_string();
        let lacks = |word: &&str| !message.contains(word);
        let missing: Vec<&str> = what.split("; ").filter(lacks).collect();
        assert!(
            missing.is_empty() && message.lines().count() == 1,
            "{missing:?}: {message}"
        );
        return;
    }
    let Reading {
        measurement, notes, ..
    } = found.unwrap_or_else(|error| panic!("{name}: {error}"));
    let count = |direction| {
        let points = measurement.points.iter();
        points.filter(|point| point.direction == direction).count() as f64
    };
    let [approach, retract] = Direction::ALL.map(Some);
    let mut found = [approach, retract, None].map(count).to_vec();
    if !notes.from_head().is_empty() {
        found.extend(notes.head.stiffness.as_ref().map(|named| named.value));
    }
    let numbers = what.split(' ');
    let expected: Vec<f64> = numbers
        .map(|text| text.parse().expect("a number"))
        .collect();
    assert_eq!(found, expected, "{name}");
    if measurement.kind == Kind::ForceHeight && format.columns.is_empty() {
        assert_eq!(notes.doubts, [], "{name}");
    }
}
