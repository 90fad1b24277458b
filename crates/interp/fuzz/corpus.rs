//! Writes the inputs to begin with into `corpus/`: a small table of each form, and for every
//! function arguments that it answers.

use std::{fs, io};

use functions::FUNCTIONS;
use tables::PREFIX;

#[path = "../tests/hostile/functions.rs"]
mod functions;
#[allow(dead_code, reason = "of the tables, the test makes more use")]
#[path = "../tests/hostile/tables.rs"]
mod tables;

fn main() -> io::Result<()> {
    for folder in ["corpus/packed", "corpus/numbers"] {
        fs::create_dir_all(folder)?;
    }
    for (name, table) in [("dense", tables::dense()), ("low_rank", tables::low_rank())] {
        let packed = table.to_packed().expect("a small table");
        fs::write(format!("corpus/packed/{name}"), &packed[PREFIX..])?;
    }
    for (chosen, (_, sound, _)) in FUNCTIONS.iter().enumerate() {
        let numbers = sound.iter().flat_map(|number| number.to_le_bytes());
        fs::write(format!("corpus/numbers/{chosen}"), [chosen as u8].into_iter().chain(numbers).collect::<Vec<u8>>())?;
    }
    Ok(())
}
