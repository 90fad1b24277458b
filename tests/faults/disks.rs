//! Disks and folders that cannot be written.

use std::fs;

use acceptance::assert_names;

use crate::generation::{JOURNAL, RESUME, WHOLE, assert_equal, assert_finished, workdir};

/// A limit on the size of files stands for a full disk where nothing may be mounted.
#[test]
fn a_full_disk_is_an_error_and_what_is_finished_is_safe() {
    let workdir = workdir();
    workdir.write("table.h5", "what was there");
    // In units of 512 bytes: first the journal does not fit, then, as it is longer than the table,
    // neither does.
    for limit in [1, 40, 300] {
        let run = workdir.script(&format!(
            "trap '' XFSZ; ulimit -f {limit}; exec $0 generate scene.toml -o table.h5 --certificate-points 300 --resume"
        ));
        assert_eq!(run.status, 1, "{run:?}");
        assert_names(&run.stderr, &["cannot write", "too large"]);
        let is_told = run.stderr.contains("with --resume goes on");
        assert_eq!(is_told, limit > 1, "{run:?}");
        assert_eq!(workdir.read("table.h5"), b"what was there");
    }
    assert!(workdir.read(JOURNAL).len() > 40 * 512);
    workdir.succeed(RESUME);
    assert_finished(&workdir);
}

/// A disk of a few hundred kilobytes, where this process may mount one.
#[test]
fn a_small_disk_that_fills_up_in_any_stage_is_an_error() {
    let mounted = "mkdir disk && mount -t tmpfs -o size=64k none disk";
    let workdir = workdir();
    if workdir
        .script(&format!("unshare -m sh -c '{mounted}'; rmdir disk"))
        .stderr
        .is_empty()
    {
        let script = format!(
            "{mounted} && cp scene.toml disk && cd disk &&
             for size in 64k 200k 400k 600k 700k 2m; do
                 mount -o remount,size=$size none . && $0 generate scene.toml --certificate-points 300 --resume; echo status $?
             done; ls -a; cp scene.h5 ../table.h5"
        );
        let run = workdir.script(&format!("unshare -m sh -c '{script}' $0"));
        let lines = run.stdout.lines();
        let mut statuses = lines.filter_map(|line| line.strip_prefix("status "));
        assert!(statuses.any(|status| status == "1"), "{run:?}");
        assert_eq!(statuses.next_back(), Some("0"), "{run:?}");
        for message in run.stderr.lines() {
            assert_names(message, &["cannot write", "No space left"]);
        }
        assert_equal(&workdir.read("table.h5"), &WHOLE);
    } else {
        println!("nothing may be mounted here: the limit on files' size stands for it");
    }
}

/// The chunks of large tables are written one by one, and closing the file writes none of them.
#[test]
fn a_disk_that_fills_up_within_a_quantity_of_a_large_table_is_an_error() {
    let workdir = acceptance::workdir!();
    let run = workdir.script("trap '' XFSZ; ulimit -f 1000; exec $0 unpack embedded -o u.h5");
    assert_eq!(run.status, 1, "{run:?}");
    assert_names(&run.stderr, &["cannot write u.h5", "too large"]);
    assert!(!workdir.path("u.h5").exists());
}

#[test]
fn a_name_that_the_library_does_not_take_is_an_error_before_any_solving() {
    let workdir = workdir();
    let run = workdir.script("exec $0 generate scene.toml -o \"$(printf 'n\\377.h5')\"");
    assert_eq!(run.status, 1, "{run:?}");
    assert_names(&run.stderr, &["cannot write", "UTF-8"]);
    // The journal's name is as long as names may be.
    let name = format!("{}.h5", "x".repeat(241));
    workdir.succeed(format!(
        "generate scene.toml -o {name} --certificate-points 20"
    ));
    workdir.fail(1, format!("generate scene.toml -o x{name}"));
    assert_eq!(workdir.files(), ["scene.toml", name.as_str()]);
}

#[test]
fn a_read_only_folder_is_an_error_before_any_solving() {
    let workdir = workdir();
    fs::create_dir(workdir.path("folder")).expect("a new folder");
    // Permissions do not bind the superuser, a read-only file system does.
    let run = workdir.script(
        "if [ $(id -u) = 0 ]; then
             exec unshare -m sh -c 'mount -t tmpfs -o ro none folder && exec $0 generate scene.toml -o folder/table.h5' $0
         else
             chmod a-w folder; exec $0 generate scene.toml -o folder/table.h5
         fi",
    );
    println!("{run:?}");
    assert_eq!(run.status, 1);
    let is_told = run.stderr.contains("cannot write folder/table.h5");
    assert!(is_told || run.stderr.contains("mount"), "{run:?}");
    let entries = fs::read_dir(workdir.path("folder"));
    assert_eq!(entries.expect("a folder").count(), 0);
}
