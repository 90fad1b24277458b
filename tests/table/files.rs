//! The HDF5 file and the packed file of a table: each keeps every number, and a damaged or foreign
//! file is an error. `tests/hostile/packed.rs` damages the packed file at every byte.

use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use acceptance::{
    Workdir, all_bits, assert_names, nothing_starts, table, with_payload, workdir, write_hdf5,
};
use hdf5::types::VarLenUnicode;
use interp::{Certificate, Error, Parameter, Quantity, Table};

const BOX: &str = "
    title      = 'Four axes: µm'
    tolerance  = 1e-1
    quantities = ['pi0', 'gamma', 'delta0']
    a_over_t   = { from = 0.1, to = 10, nodes = 5 }
    e1_over_e2 = { from = 0.3, to = 3, nodes = 4 }
    nu1        = { from = 0.3, to = 0.5, nodes = 3 }
    e0_over_e2 = { from = 10, to = 100, nodes = 2 }
    nu0        = 0.2
";

const RIGID: &str = "
    title      = 'Rigid sphere and substrate'
    tolerance  = 1e-3
    a_over_t   = { from = 0.1, to = 10, nodes = 9 }
    e1_over_e2 = 0
    nu1        = 0.3
    e0_over_e2 = inf
";

pub static TABLE: LazyLock<Table> = LazyLock::new(|| table(BOX));

static PACKED: LazyLock<Vec<u8>> = LazyLock::new(|| TABLE.to_packed().expect("a small table"));

pub fn with_table() -> Workdir {
    let workdir = workdir!();
    write_hdf5(&TABLE, &workdir.path("table.h5"));
    workdir
}

pub fn assert_same(found: &Table, expected: &Table) {
    assert_eq!(found.description(), expected.description());
    assert_eq!(all_bits(found), all_bits(expected));
}

/// Returns the bits of axes and values, as the C library reads them.
fn bits_by_c_library(path: &Path) -> Vec<Option<Vec<u64>>> {
    let file = hdf5::File::open(path).expect("a sound file");
    let names = Parameter::ALL
        .map(|p| format!("axes/{}", p.name()))
        .into_iter()
        .chain(Quantity::ALL.map(|q| format!("values/{}", q.name())));
    let bits = |name: String| {
        file.dataset(&name)
            .ok()
            .map(|dataset| dataset.read_raw::<f64>().expect("numbers"))
    };
    names
        .map(|name| bits(name).map(|values| values.into_iter().map(f64::to_bits).collect()))
        .collect()
}

/// Copies the table's file to the file `name`, changes it by `alter` and returns its path.
pub fn altered(
    workdir: &Workdir,
    name: &str,
    alter: impl FnOnce(&hdf5::File) -> hdf5::Result<()>,
) -> PathBuf {
    let path = workdir.write(name, workdir.read("table.h5"));
    // The file is locked while it is open.
    let _guard = nothing_starts();
    alter(&hdf5::File::open_rw(&path).expect("a sound file"))
        .unwrap_or_else(|e| panic!("{name}: {e}"));
    path
}

#[test]
fn every_form_and_reader_gives_the_same_bits() {
    for (scene, points) in [
        (BOX, "1,1,0.4,30\n0.1,0.3,0.3,10\n7,2.9,0.45,99\n"),
        (RIGID, "1,0,0.3,inf\n0.123,0,0.3,inf\n"),
    ] {
        let (table, workdir) = (table(scene), workdir!());
        write_hdf5(&table, &workdir.path("table.h5"));
        assert_eq!(workdir.succeed("pack table.h5 -o table.bin"), "");
        assert_same(&workdir.table("table.h5"), &table);
        let read = bits_by_c_library(&workdir.path("table.h5"));
        assert_eq!(read, all_bits(&table));
        assert_same(&workdir.table("table.bin"), &table);
        let packed = table.to_packed().expect("a small table");
        assert_eq!(workdir.read("table.bin"), packed);
        workdir.write_points(points);
        // A note says why the fields of a quantity that is not held are empty.
        let query = |table: &str| workdir.run(format!("query {table} --points points.csv"));
        let query = |table: &str| query(table).stdout;
        let answer = query("table.h5");
        assert_eq!(answer.lines().count(), points.lines().count() + 1);
        assert_eq!(answer, query("table.bin"));
    }
}

#[test]
fn a_certificate_is_kept_in_every_form() {
    let measured = TABLE.description().certificate;
    // One quantity is not held, so that no identity is measured.
    assert_eq!(measured.identity_errors, [None; 4]);
    let known = table(RIGID).description().certificate;
    assert!(known.identity_errors.iter().all(Option::is_some));
    let half_known = Certificate {
        identity_errors: [None, Some(1e-3), None, Some(2e-3)],
        ..measured
    };
    for certificate in [measured, known, half_known] {
        let (workdir, mut table) = (with_table(), TABLE.clone());
        table.set_certificate(certificate);
        write_hdf5(&table, &workdir.path("table.h5"));
        assert_same(&workdir.table("table.h5"), &table);
        let packed = table.to_packed().expect("a small table");
        assert_same(&Table::from_packed(&packed).expect("a sound table"), &table);
        workdir.succeed("pack table.h5 -o table.bin");
        assert_eq!(workdir.read("table.bin"), packed);
        workdir.succeed("unpack table.bin -o again.h5");
        assert_eq!(workdir.read("again.h5"), workdir.read("table.h5"));
    }
}

#[test]
fn a_file_of_something_else_is_foreign_to_every_reader() {
    let workdir = with_table();
    let other = hdf5::File::create(workdir.path("other.h5")).expect("a new file");
    other
        .new_dataset::<f64>()
        .shape([3])
        .create("values")
        .expect("a dataset");
    other.close().expect("written");
    workdir.write("empty", "");
    workdir.write("text", "a_over_t,e1_over_e2,nu1,e0_over_e2\n1,1,0.5,inf\n");
    workdir.write("image", b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR");
    workdir.write("signature", b"\x89HDF\r\n\x1a\n");
    altered(&workdir, "named.h5", |file| named(file, "format", "other"));
    for name in "empty text image signature other.h5 named.h5".split(' ') {
        let path = workdir.path(name);
        for result in [Table::open(&path), Table::read(&path)] {
            let error = result.expect_err("no table");
            assert_names(&error.to_string(), &[&path.display().to_string()]);
            assert!(matches!(error.without_file(), Error::Foreign(_)), "{name}");
        }
        let message = workdir.fail(1, format!("info {name}"));
        assert_names(&message, &[name, "not a coated-contact table"]);
    }
    // Each form is foreign to the reader of the other one, and the message names the right reader.
    // A missing file is not foreign.
    let packed = workdir.write("table.bin", &*PACKED);
    for (result, words) in [
        (
            Table::open(&packed),
            "packed table; read it as a packed table",
        ),
        (
            Table::read(workdir.path("table.h5")),
            "HDF5 table; read it as HDF5",
        ),
        (
            Table::from_packed(&workdir.read("table.h5")),
            "HDF5 table; read it as HDF5",
        ),
    ] {
        let error = result.expect_err(words);
        assert_names(&error.to_string(), words);
        assert!(matches!(error.without_file(), Error::Foreign(_)));
    }
    let missing = workdir.path("missing");
    for result in [Table::read(&missing), Table::open(&missing)] {
        assert!(matches!(result, Err(Error::Io { path, .. }) if path == missing));
    }
    assert_names(&workdir.fail(1, "info missing"), "missing; No such file");
}

#[test]
fn every_error_of_a_files_content_carries_its_path() {
    let workdir = with_table();
    let end = PACKED.len() - 1;
    let changed = [&PACKED[..end], &[!PACKED[end]]].concat();
    let version = [&PACKED[..8], &[9], &PACKED[9..]].concat();
    let foreign = b"notes of mine".to_vec();
    let cases = [
        ("checksum.bin", changed, "corrupt: checksum"),
        ("length.bin", PACKED[..end].to_vec(), "truncated"),
        ("version.bin", version, "format version 9"),
        ("forged.bin", with_payload(&PACKED, &[0; 40]), "malformed"),
        ("foreign.bin", foreign, "not a coated-contact table"),
    ];
    for (name, bytes, words) in cases {
        let path = workdir.write(name, &bytes);
        let error = Table::read(&path).expect_err(name);
        let message = error.to_string();
        assert_names(&message, &[words]);
        // Bytes have no path.
        let own = Table::from_packed(&bytes).expect_err(name).to_string();
        assert_eq!(message, format!("{}: {own}", path.display()));
        // The program prints the path once.
        let printed = workdir.fail(1, format!("info {name}"));
        assert_eq!(printed.matches(name).count(), 1, "{printed}");
    }
}

#[test]
fn another_version_is_an_error_that_names_both() {
    let workdir = with_table();
    for (form, version, supported) in [
        ("bin", 0_u32, 4),
        ("bin", 3, 4),
        ("bin", 5, 4),
        ("h5", 2, 3),
        ("h5", 4, 3),
    ] {
        let name = format!("other.{form}");
        let result = if form == "bin" {
            let packed = [&PACKED[..8], &version.to_le_bytes(), &PACKED[12..]].concat();
            Table::read(workdir.write(&name, packed))
        } else {
            let version = |file: &hdf5::File| file.attr("format_version")?.write_scalar(&version);
            Table::open(altered(&workdir, &name, version))
        };
        let error = result.expect_err("another version").without_file();
        let expected = Error::Version {
            found: version,
            supported,
        };
        assert_eq!(error.to_string(), expected.to_string());
        let words = format!("{name}; format version {version}; version {supported}");
        let message = workdir.fail(1, format!("info {name}"));
        assert_names(&message, &format!("{words}; make the table again"));
    }
}

/// Changes a text of the file.
pub fn named(file: &hdf5::File, attribute: &str, text: &str) -> hdf5::Result<()> {
    let text = text.parse::<VarLenUnicode>().expect("text");
    file.attr(attribute)?.write_scalar(&text)
}
