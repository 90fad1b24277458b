//! What a journal keeps: damaged, forged, of another scene, or of no use.

use std::fs;

use acceptance::{Contacts, assert_names};

use crate::generation::{GENERATE, JOURNAL, RESUME, SCENE, assert_finished, unfinished, workdir};

#[test]
fn a_torn_or_damaged_end_of_the_journal_is_solved_again() {
    let workdir = unfinished(8);
    let journal = workdir.read(JOURNAL);
    let mut random = Contacts::new(72);
    for i in 0..16 {
        let mut torn = journal.clone();
        let at = random.uniform(0.0, journal.len() as f64) as usize;
        match i % 4 {
            0 => torn.truncate(at),
            1 => torn.extend(vec![0xff; at % 100 + 1]),
            // A loss of power may leave zeros.
            2 => torn.extend(vec![0; at % 5000 + 1]),
            // Damage to the header, in the first bytes, is an error; see below.
            _ => torn[at.max(1500)] ^= 0x10,
        }
        workdir.write(JOURNAL, &torn);
        workdir.succeed(RESUME);
        assert_finished(&workdir);
    }
}

/// A record of the journal.
fn record(number: u64, bytes: &[u8]) -> Vec<u8> {
    [
        &number.to_le_bytes()[..],
        &(bytes.len() as u64).to_le_bytes(),
        &crc32fast::hash(bytes).to_le_bytes(),
        bytes,
    ]
    .concat()
}

/// The bytes of a journal with another header.
pub fn with_header(journal: &[u8], change: impl Fn(&str) -> String) -> Vec<u8> {
    let length = u64::from_le_bytes(journal[16..24].try_into().expect("eight bytes")) as usize;
    let (header, pieces) = journal[28..].split_at(length);
    let header = change(std::str::from_utf8(header).expect("UTF-8"));
    [&journal[..8], &record(u64::MAX, header.as_bytes()), pieces].concat()
}

#[test]
fn a_sound_record_that_is_no_piece_is_dropped() {
    let workdir = unfinished(8);
    let journal = workdir.read(JOURNAL);
    for forged in [
        record(0, b"short"),
        record(1, &[0; 8]),
        record(1_000_000, &[1; 16]),
        record(u64::MAX, b"a second header"),
    ] {
        workdir.write(JOURNAL, [&journal[..], &forged].concat());
        workdir.succeed(RESUME);
        assert_finished(&workdir);
    }
}

#[test]
fn a_header_that_is_damaged_or_of_other_nodes_is_an_error_and_nothing_is_lost() {
    let workdir = unfinished(8);
    let journal = workdir.read(JOURNAL);
    let with = |from: &str, to: &str| with_header(&journal, |header| header.replacen(from, to, 1));
    let text = String::from_utf8_lossy(&journal);
    let mut lines = text.lines();
    let nodes = lines
        .find(|line| line.starts_with("nodes = "))
        .expect("the first axis");
    let mut damaged = journal.clone();
    damaged[100] ^= 1;
    let more = with_header(&journal, |header| format!("{header}more = 1\n"));
    let mut cases = vec![(damaged, "cannot be read"), (more, "cannot be read")];
    let (_, others) = nodes.split_once(',').expect("four axes");
    for wrong in ["0", "1", "20000", "100000000000", "9223372036854775807"] {
        let forged = with(nodes, &format!("nodes = [{wrong},{others}"));
        cases.push((forged, "not the scene's"));
    }
    cases.push((
        with("evenness = [", "evenness = [-1.0, "),
        "not the scene's",
    ));
    for (forged, words) in cases {
        workdir.write(JOURNAL, &forged);
        workdir.refuses(format!(
            "1 | {RESUME} | cannot resume; {JOURNAL}; {words}; remove this file"
        ));
        assert!(workdir.read(JOURNAL) == forged, "the journal has changed");
    }
    fs::remove_file(workdir.path(JOURNAL)).expect("removed");
    workdir.succeed(GENERATE);
    assert_finished(&workdir);
}

#[test]
fn a_file_in_the_place_of_the_journal_is_not_touched() {
    let workdir = workdir();
    workdir.write(JOURNAL, "notes of mine");
    for args in [GENERATE, RESUME] {
        assert_names(&workdir.fail(1, args), &[JOURNAL, "is not the journal"]);
    }
    assert_eq!(workdir.read(JOURNAL), b"notes of mine");
}

#[test]
fn without_resume_a_run_refuses_to_drop_kept_pieces() {
    let workdir = unfinished(8);
    let journal = workdir.read(JOURNAL);
    let unreadable = [&journal[..28], b"?", &journal[29..]].concat();
    for (kept, what) in [(journal, "keeps 8 finished pieces"), (unreadable, "header")] {
        workdir.write(JOURNAL, &kept);
        let message = workdir.fail(1, GENERATE);
        assert_names(&message, &[JOURNAL, what, "--resume", "remove this file"]);
        assert!(workdir.read(JOURNAL) == kept, "the journal has changed");
        assert_eq!(workdir.files(), ["scene.toml", JOURNAL]);
    }
    fs::remove_file(workdir.path(JOURNAL)).expect("removed");
    workdir.succeed(GENERATE);
    assert_finished(&workdir);
}

#[test]
fn a_scene_that_has_changed_is_not_resumed_and_nothing_is_lost() {
    let workdir = unfinished(8);
    let journal = workdir.read(JOURNAL);
    workdir.write("scene.toml", SCENE.replace("to = 1e4 ", "to = 2e4 "));
    workdir.refuses(format!(
        "1 | {RESUME} | cannot resume; {JOURNAL}; another text of the scene"
    ));
    workdir.write("scene.toml", SCENE);
    let words = "cannot resume; tolerance = 1e-6; 0.0001";
    workdir.refuses(format!("1 | {RESUME} --tolerance 1e-4 | {words}"));
    assert!(workdir.read(JOURNAL) == journal, "the journal has changed");
    workdir.succeed(RESUME);
    assert_finished(&workdir);
}
