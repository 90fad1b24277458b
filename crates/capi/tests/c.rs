//! The example in C, compiled with the library and run: its numbers are those of Rust.

use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;

use contact::{Contact, Control, Input};
use interp::{Elastic, Probe, System, Table};

/// The folder of the compiled library: that of this test's program, without `deps`.
fn library() -> PathBuf {
    let test = env::current_exe().expect("this program has a path");
    let deps = test.parent().expect("in a folder");
    deps.to_owned()
}

/// Compiles the example into a folder, and returns its path.
fn compiled(folder: &Path) -> PathBuf {
    let crate_folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let program = folder.join("force");
    let library = library();
    let archive = ["libcoated_contact.a", "../libcoated_contact.a"]
        .map(|name| library.join(name))
        .into_iter()
        .find(|path| path.exists());
    let archive = archive.expect("cargo builds the static library with the tests");
    let mut compiler = Command::new(env::var_os("CC").unwrap_or_else(|| "cc".into()));
    compiler
        .args(["-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic", "-o"])
        .arg(&program)
        .arg(crate_folder.join("examples/force.c"))
        .arg("-I")
        .arg(crate_folder.join("include"))
        .arg(archive)
        .args(["-lpthread", "-ldl", "-lm"]);
    let status = compiler.status().expect("there is a C compiler");
    assert!(status.success(), "{compiler:?}");
    program
}

#[test]
fn the_example_prints_the_numbers_of_rust() {
    let folder = env::temp_dir().join(format!("coated-contact-c-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let program = compiled(&folder);
    let system = System {
        probe: Probe::Paraboloid { radius: 1e-3 },
        sphere_modulus: 2e6,
        film: Elastic::new(3.5e6, 0.5).expect("physical"),
        film_thickness: 1e-6,
        substrate: Elastic::new(2e11, 0.25).expect("physical"),
    };
    let contact = Contact::in_table_with_gradient(Table::embedded(), &system).expect("a contact");
    let mut expected = String::new();
    for a in [40e-6, 65e-6, 90e-6] {
        let load = contact.load(a, 0.04).expect("in range");
        expected += &format!("{a:?} {load:?}\n");
    }
    let last = contact.pull_off(0.04, Control::Load).expect("a pull-off");
    let derivative = contact
        .gradient(65e-6, 0.04)
        .and_then(|of| of.by(Input::FilmModulus));
    expected += &format!(
        "pull-off {:?} {:?} {:?}\ndF/dE1 {:?}\n",
        last.contact_radius,
        last.load,
        last.penetration,
        derivative.expect("known").load
    );
    // Of numbers, their values.
    let words = |text: &str| -> Vec<String> {
        let of = |word: &str| {
            word.parse::<f64>()
                .map_or(word.to_owned(), |x| format!("{x:?}"))
        };
        text.split_whitespace().map(of).collect()
    };
    let table = Path::new(env!("CARGO_MANIFEST_DIR")).join("../interp/embedded/universal.bin");
    for arguments in [vec![], vec![table]] {
        let run = Command::new(&program)
            .args(&arguments)
            .output()
            .expect("it runs");
        let printed = String::from_utf8(run.stdout).expect("text");
        assert!(
            run.status.success(),
            "{}",
            String::from_utf8_lossy(&run.stderr)
        );
        let (numbers, error) = printed.trim_end().rsplit_once('\n').expect("an error last");
        assert_eq!(words(numbers), words(&expected), "{arguments:?}");
        assert!(
            error.contains("65.0 m") && error.contains("0.001 m"),
            "{error}"
        );
    }
    let run = Command::new(&program)
        .arg("missing.h5")
        .output()
        .expect("it runs");
    let error = String::from_utf8_lossy(&run.stderr).into_owned();
    assert!(
        run.status.code() == Some(1) && error.contains("missing.h5"),
        "{error}"
    );
    std::fs::remove_dir_all(&folder).expect("removed");
}
