//! Writes the first inputs of the fuzzer into `corpus/`: a small table of each form, and for every
//! function one list of valid arguments.

use std::{fs, io};

use functions::FUNCTIONS;
use tables::PREFIX;

#[path = "../../../tests/hostile/calls.rs"]
mod calls;
#[path = "../../../tests/hostile/functions.rs"]
mod functions;
#[allow(dead_code, reason = "the test uses more of these tables")]
#[path = "../../../tests/hostile/tables.rs"]
mod tables;

fn main() -> io::Result<()> {
    for folder in ["corpus/packed", "corpus/numbers"] {
        fs::create_dir_all(folder)?;
    }
    for (name, table) in [
        ("dense", tables::dense()),
        ("low_rank", tables::low_rank()),
        ("tiles", tables::low_rank_in_tiles()),
    ] {
        let packed = table.to_packed().expect("a small table");
        fs::write(format!("corpus/packed/{name}"), &packed[PREFIX..])?;
    }
    for (chosen, (_, valid, _)) in FUNCTIONS.iter().enumerate() {
        let numbers = valid.iter().flat_map(|number| number.to_le_bytes());
        fs::write(
            format!("corpus/numbers/{chosen}"),
            [chosen as u8]
                .into_iter()
                .chain(numbers)
                .collect::<Vec<u8>>(),
        )?;
    }
    Ok(())
}
