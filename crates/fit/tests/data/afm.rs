//! All text files among the test data of the Python package afmformats (MIT), which `cargo xtask
//! test` fetches: which are read, which are refused, and why.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

use fit::data::{Cantilever, Format, Reading, read};
use fit::{Direction, Kind};

/// What is given, and what becomes of a file.
struct Row {
    /// The file, as its end; a name that ends in a slash is that of an archive, all of whose texts
    /// are meant.
    file: &'static str,
    kind: Option<Kind>,
    columns: &'static [&'static str],
    cantilever: Cantilever,
    outcome: Outcome,
}

enum Outcome {
    /// It has as many points of approach, of retract and without a direction, as a count of its lines
    /// gives, and its head names this stiffness (N/m).
    Read([usize; 3], Option<f64>),
    /// The message names all the words.
    Refused(&'static [&'static str]),
}

use Outcome::{Read, Refused};

const NONE: Cantilever = Cantilever {
    stiffness: None,
    sensitivity: None,
};

/// Invented, for the files that tell nothing of the cantilever.
const GIVEN: Cantilever = Cantilever {
    stiffness: Some(0.1),
    sensitivity: Some(5e-8),
};

const FORCE_HEIGHT: Option<Kind> = Some(Kind::ForceHeight);

const fn row(file: &'static str, cantilever: Cantilever, outcome: Outcome) -> Row {
    Row {
        file,
        kind: None,
        columns: &[],
        cantilever,
        outcome,
    }
}

const NO_CANTILEVER: Outcome =
    Refused(&["T-B(V)", "stiffness", "sensitivity", "does not name both"]);
const NT_MDT: &str = "Curve_DFL_Height_51.txt";
const CHIARO: &str = "AEBP1_Indentation_002.txt";

/// Two rows for a file show what is missing, and that it is read with it.
const ROWS: [Row; 15] = [
    // AFM Workshop: heights in nm that grow towards the sample, and forces or volts.
    row(
        "fd_single_2020-02-14_13.41.25.csv",
        NONE,
        Read([1015, 1015, 0], None),
    ),
    row(
        "fd_single_2021-10-22_14.16.csv",
        NONE,
        Read([1217, 1217, 0], None),
    ),
    row("fd_single_2018-08-01_13.06.09.csv", NONE, NO_CANTILEVER),
    row(
        "fd_single_2018-08-01_13.06.09.csv",
        GIVEN,
        Read([570, 570, 0], None),
    ),
    row(
        "fd_single_2021-01-15.csv",
        NONE,
        Refused(&["T-B(V)", "line 10 has 1", "not calibrated"]),
    ),
    row(
        "fd_single_2021-01-15.csv",
        GIVEN,
        Read([3369, 3369, 0], None),
    ),
    row("fd_mapping_16_2018-08-01_13.07.zip/", NONE, NO_CANTILEVER),
    row(
        "fd_mapping_16_2018-08-01_13.07.zip/",
        GIVEN,
        Read([391, 391, 0], None),
    ),
    // Optics11 writes penetrations and heights; one line ends in LF CR.
    row(
        CHIARO,
        NONE,
        Refused(&["more than one kind", "load-penetration, force-height"]),
    ),
    Row {
        kind: FORCE_HEIGHT,
        ..row(CHIARO, NONE, Read([12664, 1163, 0], Some(0.019)))
    },
    Row {
        kind: Some(Kind::LoadPenetration),
        ..row(CHIARO, NONE, Read([0, 0, 13827], None))
    },
    // NT-MDT: three columns, no heading, no head.
    row(
        NT_MDT,
        GIVEN,
        Refused(&["line 1", "no line of 3 headings", "by their numbers"]),
    ),
    Row {
        columns: &[
            "height=1 [nm]",
            "deflection=2 extend [V]",
            "deflection=3 retract [V]",
        ],
        ..row(NT_MDT, GIVEN, Read([1000, 1000, 0], None))
    },
    // afmformats itself: the first row stands on the line of headings.
    row(
        "fmt-tab-fd_version_0.13.3.tab",
        NONE,
        Read([3147, 882, 0], Some(0.02230065831827453)),
    ),
    // The texts in archives of JPK are properties, not columns.
    row(".properties", NONE, Refused(&["no line holds two numbers"])),
];

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
    for row in &ROWS {
        let mut count = 0;
        for (i, (name, path)) in texts.iter().enumerate() {
            let of_archive = row.file.ends_with('/') && name.contains(row.file);
            if !of_archive && !name.ends_with(row.file) {
                continue;
            }
            (met[i], count) = (true, count + 1);
            check(row, name, path);
        }
        assert!(count > 0, "there is no {}", row.file);
    }
    let left: Vec<&String> = texts
        .keys()
        .zip(met)
        .filter_map(|(name, met)| (!met).then_some(name))
        .collect();
    assert!(left.is_empty(), "not in the table: {left:?}");
}

fn check(row: &Row, name: &str, path: &Path) {
    let format = Format {
        kind: row.kind,
        columns: row
            .columns
            .iter()
            .map(|text| text.parse().expect("a column"))
            .collect(),
        cantilever: row.cantilever,
        ..Format::default()
    };
    match (&row.outcome, read(path, &format)) {
        (
            Read(counts, stiffness),
            Ok(Reading {
                measurement, notes, ..
            }),
        ) => {
            let count = |direction| {
                let points = measurement.points.iter();
                points.filter(|point| point.direction == direction).count()
            };
            let [approach, retract] = Direction::ALL.map(Some);
            let found = [approach, retract, None].map(count);
            let named = notes.from_head().first().map(|value| value.named.value);
            assert_eq!((found, named), (*counts, *stiffness), "{name}");
            if measurement.kind == Kind::ForceHeight && row.columns.is_empty() {
                assert_eq!(notes.doubt, None, "{name}");
            }
        }
        (Refused(words), Err(error)) => {
            let message = error.to_string();
            assert_eq!(message.lines().count(), 1, "{message}");
            for word in *words {
                assert!(message.contains(word), "{word:?} is not in: {message}");
            }
        }
        (_, found) => panic!("{name}: {found:?}"),
    }
}
