//! What people hand over: other files, other encodings, spreadsheets, files put together.

use fit::data::{Format, read_from};

use crate::{assert_values, values};

/// What becomes of a file.
enum Outcome {
    /// It is read as these points, in um and mN.
    Read(&'static [[f64; 2]]),
    /// It is refused, and the message names all the words.
    Refused(&'static [&'static str]),
}

use Outcome::{Read, Refused};

const POINTS: &[[f64; 2]] = &[[50.0, -0.1], [60.0, 0.2]];
const TWICE: &[[f64; 2]] = &[[50.0, -0.1], [60.0, 0.2], [50.0, -0.1], [60.0, 0.2]];

/// A table as UTF-16 with a byte order mark, as spreadsheets save "Unicode text".
fn utf16(text: &str, join: fn(u16) -> [u8; 2]) -> Vec<u8> {
    let text = format!("\u{feff}{text}");
    text.encode_utf16().flat_map(join).collect()
}

#[test]
fn what_people_hand_over_is_read_or_refused_with_the_reason() {
    let table = "Radius [µm]\tLoad [mN]\r\n50\t-0,1\r\n60\t0,2\r\n";
    let csv = "Radius [um],Load [mN]\n50,-0.1\n60,0.2\n";
    let cases: Vec<(&str, Vec<u8>, Outcome)> = vec![
        // Other files.
        ("nothing", b"".into(), Refused(&["the file is empty"])),
        ("blank lines", b"\n \n\t\n".into(), Refused(&["the file is empty"])),
        (
            "headings only",
            b"# a lens\nRadius [um],Load [mN]\n".into(),
            Refused(&["\"Radius [um],Load [mN]\" are headings", "no row of numbers"]),
        ),
        (
            "a scene",
            b"title = \"thin\"\n[a_over_t]\nfrom = 1e-3\nto = 1e3\n".into(),
            Refused(&["no line holds two numbers", "begins with \"title = \\\"thin\\\"\""]),
        ),
        ("an HDF5 table", b"\x89HDF\r\n\x1a\n\0\0\0".into(), Refused(&["an HDF5 file"])),
        ("a spreadsheet", b"PK\x03\x04\x14\0\x06\0".into(), Refused(&["a zip archive", "spreadsheet"])),
        ("an old spreadsheet", b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1".into(), Refused(&["(xls)"])),
        ("a PDF", b"%PDF-1.7\n1 2\n".into(), Refused(&["a PDF"])),
        ("other bytes", b"\x01\0\x02\0".into(), Refused(&["binary data"])),
        // Encodings.
        ("UTF-16 LE", utf16(table, u16::to_le_bytes), Read(POINTS)),
        ("UTF-16 BE", utf16(table, u16::to_be_bytes), Read(POINTS)),
        ("Latin-1", b"Radius [\xb5m];Load [mN]\n50;-0,1\n60;0,2\n".into(), Read(POINTS)),
        // A remark in a column that is not read.
        (
            "a flag",
            b"a [um],Load [mN],flag\n50,-0.1,1\n60,0.2,1\n50,-0.1,1\n60,0.2,Err\n".into(),
            Read(TWICE),
        ),
        // Numbers.
        ("a minus of typography", "Radius [um],Load [mN]\n50,−0.1\n60,0.2\n".into(), Read(POINTS)),
        (
            "thousands with a comma",
            b"Radius [um]\tLoad [mN]\n1,050.5\t-0.1\n1,060.5\t0.2\n".into(),
            Refused(&["line 2, column 1", "\"1,050.5\"", "thousands"]),
        ),
        (
            "thousands with a point",
            b"Radius [um];Load [mN]\n1.050,5;-0,1\n1.060,5;0,2\n".into(),
            Refused(&["line 2, column 1", "\"1.050,5\"", "thousands"]),
        ),
        (
            "thousands in quotes",
            b"\"Radius [um]\",\"Load [mN]\"\n\"1,050.5\",\"-0.1\"\n\"1,060.5\",\"0.2\"\n".into(),
            Refused(&["\"1,050.5\"", "thousands"]),
        ),
        (
            "two decimal marks",
            b"Radius [um];Load [mN]\n50.5;-0,1\n".into(),
            Refused(&["line 2, column 2", "decimal mark"]),
        ),
        (
            "an exponent of Fortran",
            b"contact_radius,load\n0.5D-04,-1.0D-04\n0.6d-04,2.0d-04\n".into(),
            Read(POINTS),
        ),
        ("names in one word", b"contactRadius [um],P in mN\n50,-0.1\n60,0.2\n".into(), Read(POINTS)),
        // Columns that are not read.
        (
            "time stamps",
            b"stamp;a [um];F [mN]\n2024-01-01 12:30:01;50;-0.1\n2024-01-01 12:30:02;60;0.2\n".into(),
            Read(POINTS),
        ),
        (
            "remarks",
            b"no,a [um],F [mN],remark\n1,50,-0.1,5 nm step\n2,60,0.2,\"1/2/2024, 12:00 PM\"\n".into(),
            Read(POINTS),
        ),
        // Missing values: a row without any is left out, a row with one of two is not.
        (
            "empty and missing cells",
            b"Radius [um],Load [mN],t\n50,-0.1,\n,,\nnan,NaN,3\n#N/A,#N/A,4\n60,0.2,\n".into(),
            Read(POINTS),
        ),
        (
            "placeholders",
            b"Radius [um],Load [mN]\n50,-0.1\n1.797e308,1.1e308\n60,0.2\n".into(),
            Read(POINTS),
        ),
        (
            "one placeholder",
            b"Radius [um],Load [mN]\n50,-0.1\n60,1.79769313486232E+308\n".into(),
            Refused(&["line 3, column 2", "missing", "1e300"]),
        ),
        (
            "infinity",
            b"Radius [um],Load [mN]\n50,-0.1\n60,inf\n".into(),
            Refused(&["line 3, column 2", "not finite"]),
        ),
        // Spreadsheets.
        (
            "quotes",
            b"\"Radius [um]\";\"Load [mN]\"\r\n\"50\";\"-0,1\"\r\n\"60\";\"0,2\"\r\n".into(),
            Read(POINTS),
        ),
        ("empty columns", b"Radius [um],Load [mN],,\n50,-0.1,,\n60,0.2,,\n".into(), Read(POINTS)),
        // Files put together.
        ("the file twice", csv.repeat(2).into(), Read(TWICE)),
        (
            "headings repeated in a comment",
            b"# Radius [um],Load [mN]\n50,-0.1\n60,0.2\n# Radius [um],Load [mN]\n50,-0.1\n60,0.2\n".into(),
            Read(TWICE),
        ),
        (
            "two heads",
            "Sample: gel\nDate: 1,2,3,4\nRadius [um],Load [mN],t\n50,-0.1,1\n60,0.2,2\n".repeat(2).into(),
            Read(TWICE),
        ),
        (
            "two segments with other columns and units",
            b"Radius [um],Load [mN]\n50,-0.1\n60,0.2\n\nLoad [uN],t [s],Radius [nm]\n-100,1,50000\n200,2,60000\n".into(),
            Read(TWICE),
        ),
        (
            "a second segment without headings",
            b"Radius [um],Load [mN]\n50,-0.1\n60,0.2\n\n1,50,-0.1\n2,60,0.2\n".into(),
            Refused(&["line 5", "3 cells", "2"]),
        ),
        (
            "words between rows",
            b"Radius [um],Load [mN]\n50,-0.1\nbad,row\n60,0.2\n".into(),
            Refused(&["line 3, column 1", "\"bad\"", "not a number"]),
        ),
        (
            "words at the end",
            b"Radius [um],Load [mN]\n50,-0.1\n60,0.2\nend of test\n".into(),
            Refused(&["line 4", "1 cells"]),
        ),
    ];
    for (name, bytes, outcome) in cases {
        let found = read_from(&bytes[..], "file", &Format::default());
        match outcome {
            Read(points) => {
                let reading = found.unwrap_or_else(|error| panic!("{name}: {error}"));
                let si: Vec<_> = points.iter().map(|[a, f]| [a * 1e-6, f * 1e-3]).collect();
                println!("{name}");
                assert_values(&values(&reading), &si);
            }
            Refused(words) => {
                let error = found.expect_err(name).to_string();
                assert_eq!(error.lines().count(), 1, "{name}: {error}");
                for word in words {
                    assert!(error.contains(word), "{name}: {word:?} is not in: {error}");
                }
            }
        }
    }
}
