//! The README shows the examples that are compiled, and the certificate of the table that is shipped.

#![forbid(unsafe_code)]

use interp::Table;

fn read(path: &str) -> String {
    let path = format!("{}/../{path}", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{path}: {e}"))
}

#[test]
fn shows_the_examples() {
    for path in ["crates/interp/examples/force.rs", "crates/tabulate/examples/curve.rs"] {
        let example = read(path);
        let (title, program) = example.split_once('\n').expect("the example begins with its title");
        assert!(title.starts_with("//! The README's program"), "{title}");
        assert!(read("README.md").contains(&format!("```rust\n{program}```")), "the README shows another program than {path}");
    }
}

#[test]
fn quotes_the_certificate_of_the_shipped_table() {
    let table = Table::read(concat!(env!("CARGO_MANIFEST_DIR"), "/../tables/paper.bin")).expect("the shipped table");
    let certificate = table.description().certificate;
    let quoted = format!("{:.1e} ({:.1e})", certificate.max_error, certificate.median_error);
    for file in ["README.md", "tables/README.md"] {
        assert!(read(file).contains(&quoted), "{file} does not quote {quoted}");
    }
}
