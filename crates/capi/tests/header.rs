//! The header is the one that cbindgen makes of the source.

use std::env;
use std::fs;
use std::path::Path;

#[test]
fn the_header_is_that_of_the_source() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let config = cbindgen::Config::from_file(folder.join("cbindgen.toml")).expect("a sound file");
    let sources = ["system", "guard", "contact"];
    let mut builder = cbindgen::Builder::new().with_config(config);
    for source in sources {
        builder = builder.with_src(folder.join(format!("src/{source}.rs")));
    }
    let mut made = Vec::new();
    builder.generate().expect("bindings").write(&mut made);
    let path = folder.join("include/coated_contact.h");
    if env::var_os("WRITE_HEADER").is_some() {
        fs::write(&path, &made).expect("written");
    }
    let stored = fs::read(&path).expect("a header");
    assert_eq!(
        String::from_utf8_lossy(&made),
        String::from_utf8_lossy(&stored),
        "run the test with WRITE_HEADER=1"
    );
}
