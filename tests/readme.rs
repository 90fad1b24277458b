//! The README's program is the example that is compiled and run, and its numbers are those of the files.

#![forbid(unsafe_code)]

#[path = "../crates/interp/examples/force.rs"]
mod force;

use interp::Table;

fn read(path: &str) -> String {
    let path = format!("{}/../{path}", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{path}: {e}"))
}

#[test]
fn shows_the_example_and_the_example_runs() {
    let example = read("crates/interp/examples/force.rs");
    let program = example.strip_prefix("//! The README's program.\n").expect("the example begins with its title");
    assert!(read("README.md").contains(&format!("```rust{program}```")), "the README shows another program than examples/force.rs");
    std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/..")).expect("the workspace's folder");
    force::main().expect("the program of the README runs in the workspace's folder");
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
