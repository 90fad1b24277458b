//! What people hand over: other files, other encodings, spreadsheets, files put together.

use acceptance::Refused;
use fit::data::{Format, read_from};

use crate::{assert_values, rows, values};

/// Two points, in um and mN.
const POINTS: [[f64; 2]; 2] = [[50.0, -0.1], [60.0, 0.2]];

/// What the file is, its text, and what becomes of it: it is read as the two points, once or twice, or refused
/// with these words.
///
/// A row without any value is left out, a row with one of two is not. A column that is not read may hold
/// anything.
const TEXTS: &str = r#"
    nothing |  | the file is empty
    blank lines | \n \n\t\n | the file is empty
    headings only | # a lens\nRadius [um],Load [mN]\n | "Radius [um],Load [mN]" are headings; no row of numbers
    a scene | title = "thin"\n[a_over_t]\nfrom = 1e-3\nto = 1e3\n | no line holds two numbers; begins with "title = \"thin\""
    a PDF | %PDF-1.7\n1 2\n | a PDF
    a flag | a [um],Load [mN],flag\n50,-0.1,1\n60,0.2,1\n50,-0.1,1\n60,0.2,Err\n | twice
    a minus of typography | Radius [um],Load [mN]\n50,−0.1\n60,0.2\n | once
    thousands with a comma | Radius [um]\tLoad [mN]\n1,050.5\t-0.1\n1,060.5\t0.2\n | line 2, column 1; "1,050.5"; thousands
    thousands with a point | Radius [um];Load [mN]\n1.050,5;-0,1\n1.060,5;0,2\n | line 2, column 1; "1.050,5"; thousands
    thousands in quotes | "Radius [um]","Load [mN]"\n"1,050.5","-0.1"\n"1,060.5","0.2"\n | "1,050.5"; thousands
    two decimal marks | Radius [um];Load [mN]\n50.5;-0,1\n | line 2, column 2; decimal mark
    headings that are units | V,N,Radius [um],Load [mN]\n1,2,50,-0.1\n1,2,60,0.2\n | once
    errors of some points | a [um],Load [mN],std\n50,-0.1,0.01\n60,0.2,0.02\n\na [um],Load [mN]\n50,-0.1\n60,0.2\n | standard deviations of load; others have none
    an exponent of Fortran | contact_radius,load\n0.5D-04,-1.0D-04\n0.6d-04,2.0d-04\n | once
    names in one word | contactRadius [um],P in mN\n50,-0.1\n60,0.2\n | once
    time stamps | stamp;a [um];F [mN]\n2024-01-01 12:30:01;50;-0.1\n2024-01-01 12:30:02;60;0.2\n | once
    remarks | no,a [um],F [mN],remark\n1,50,-0.1,5 nm step\n2,60,0.2,"1/2/2024, 12:00 PM"\n | once
    empty and missing cells | Radius [um],Load [mN],t\n50,-0.1,\n,,\nnan,NaN,3\n#N/A,#N/A,4\n60,0.2,\n | once
    placeholders | Radius [um],Load [mN]\n50,-0.1\n1.797e308,1.1e308\n60,0.2\n | once
    one placeholder | Radius [um],Load [mN]\n50,-0.1\n60,1.79769313486232E+308\n | line 3, column 2; missing; 1e300
    infinity | Radius [um],Load [mN]\n50,-0.1\n60,inf\n | line 3, column 2; not finite
    quotes | "Radius [um]";"Load [mN]"\r\n"50";"-0,1"\r\n"60";"0,2"\r\n | once
    empty columns | Radius [um],Load [mN],,\n50,-0.1,,\n60,0.2,,\n | once
    the file twice | Radius [um],Load [mN]\n50,-0.1\n60,0.2\nRadius [um],Load [mN]\n50,-0.1\n60,0.2\n | twice
    headings repeated in a comment | # Radius [um],Load [mN]\n50,-0.1\n60,0.2\n# Radius [um],Load [mN]\n50,-0.1\n60,0.2\n | twice
    two heads | Sample: gel\nDate: 1,2,3,4\nRadius [um],Load [mN],t\n50,-0.1,1\n60,0.2,2\nSample: gel\nDate: 1,2,3,4\nRadius [um],Load [mN],t\n50,-0.1,1\n60,0.2,2\n | twice
    other columns and units | Radius [um],Load [mN]\n50,-0.1\n60,0.2\n\nLoad [uN],t [s],Radius [nm]\n-100,1,50000\n200,2,60000\n | twice
    no headings at the second segment | Radius [um],Load [mN]\n50,-0.1\n60,0.2\n\n1,50,-0.1\n2,60,0.2\n | line 5; 3 cells; 2
    words between rows | Radius [um],Load [mN]\n50,-0.1\nbad,row\n60,0.2\n | line 3, column 1; "bad"; not a number
    words at the end | Radius [um],Load [mN]\n50,-0.1\n60,0.2\nend of test\n | line 4; 1 cells; complete the row
"#;

/// A table as UTF-16 with a byte order mark, as spreadsheets save "Unicode text".
fn utf16(text: &str, join: fn(u16) -> [u8; 2]) -> Vec<u8> {
    let text = format!("\u{feff}{text}");
    text.encode_utf16().flat_map(join).collect()
}

/// Asserts that bytes are read or refused as a case of [`TEXTS`] says.
fn check(name: &str, bytes: &[u8], outcome: &str) {
    println!("{name}");
    let found = read_from(bytes, "file", &Format::default());
    let times = match outcome {
        "once" => 1,
        "twice" => 2,
        words => return found.refused(words),
    };
    let reading = found.unwrap_or_else(|error| panic!("{name}: {error}"));
    let si = POINTS.map(|[a, f]| [a * 1e-6, f * 1e-3]);
    assert_values(&values(&reading), &si.repeat(times));
}

#[test]
fn what_people_hand_over_is_read_or_refused_with_the_reason() {
    for [name, text, outcome] in rows(TEXTS) {
        check(&name, text.as_bytes(), &outcome);
    }
}

#[test]
fn other_bytes_than_utf_8_are_read_or_refused_with_the_reason() {
    let table = "Radius [µm]\tLoad [mN]\r\n50\t-0,1\r\n60\t0,2\r\n";
    let latin = b"Radius [\xb5m];Load [mN]\n50;-0,1\n60;0,2\n";
    let little_endian = utf16(table, u16::to_le_bytes);
    let big_endian = utf16(table, u16::to_be_bytes);
    for (name, bytes, outcome) in [
        (
            "an HDF5 table",
            &b"\x89HDF\r\n\x1a\n\0\0\0"[..],
            "an HDF5 file",
        ),
        (
            "a spreadsheet",
            b"PK\x03\x04\x14\0\x06\0",
            "a zip archive; spreadsheet",
        ),
        (
            "an old spreadsheet",
            b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1",
            "(xls)",
        ),
        ("other bytes", b"\x01\0\x02\0", "binary data"),
        ("UTF-16 LE", &little_endian, "once"),
        ("UTF-16 BE", &big_endian, "once"),
        ("Latin-1", latin, "once"),
    ] {
        check(name, bytes, outcome);
    }
}
