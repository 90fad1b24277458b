//! CSV data: the reference files in `tests/data` and the outputs of the program.

use std::fs;
use std::path::Path;

use csv::{ReaderBuilder, StringRecord};
use interp::{Material, Quantities};

use crate::material;

/// CSV data with named columns and one case in each row. Lines that begin with `#` are comments.
#[derive(Clone, Debug)]
pub struct Data {
    columns: StringRecord,
    rows: Vec<StringRecord>,
}

/// One row of a [`Data`].
#[derive(Clone, Copy, Debug)]
pub struct Case<'a> {
    columns: &'a StringRecord,
    row: &'a StringRecord,
}

impl Data {
    /// Reads `tests/data/<name>.csv`.
    pub fn read(name: &str) -> Self {
        let path = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("data")
            .join(format!("{name}.csv"));
        let text = fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        Self::parse(name, &text)
    }

    /// Parses CSV text. Messages call it `name`.
    pub fn parse(name: &str, text: &str) -> Self {
        let mut reader = ReaderBuilder::new()
            .comment(Some(b'#'))
            .from_reader(text.as_bytes());
        let columns = reader
            .headers()
            .unwrap_or_else(|e| panic!("{name}: {e}"))
            .clone();
        let rows: Vec<StringRecord> = reader
            .records()
            .collect::<Result<_, _>>()
            .unwrap_or_else(|e| panic!("{name}: {e}"));
        assert!(!rows.is_empty(), "{name} holds no case");
        Self { columns, rows }
    }

    /// Returns the names of the columns, in the order of the file.
    pub fn columns(&self) -> Vec<&str> {
        self.columns.iter().collect()
    }

    /// Returns the numbers of a column, in the order of the file.
    pub fn column(&self, name: &str) -> Vec<f64> {
        self.cases().map(|case| case.get(name)).collect()
    }

    /// Returns the first case.
    pub fn first(&self) -> Case<'_> {
        self.cases().next().expect("a file holds a case")
    }

    /// Returns the last case.
    pub fn last(&self) -> Case<'_> {
        self.cases().last().expect("a file holds a case")
    }

    /// Returns the cases, in the order of the file.
    pub fn cases(&self) -> impl Iterator<Item = Case<'_>> {
        self.rows.iter().map(|row| Case {
            columns: &self.columns,
            row,
        })
    }
}

impl<'a> Case<'a> {
    /// Returns the text in the column `column`.
    pub fn text(&self, column: &str) -> &'a str {
        let index = self.columns.iter().position(|name| name == column);
        &self.row[index.unwrap_or_else(|| panic!("there is no column {column:?}"))]
    }

    /// Returns the number in the column `column`.
    pub fn get(&self, column: &str) -> f64 {
        let text = self.text(column);
        text.parse()
            .unwrap_or_else(|_| panic!("{column}: {text:?} is not a number"))
    }

    /// Returns the material in the columns `e1_over_e2`, `nu1`, `e0_over_e2` and `nu0`.
    pub fn material(&self) -> Material {
        material(["e1_over_e2", "nu1", "e0_over_e2", "nu0"].map(|name| self.get(name)))
    }

    /// Returns the quantities in the columns `pi0`, `eeq`, `gamma` and `delta0`.
    pub fn quantities(&self) -> Quantities {
        Quantities::from_array(["pi0", "eeq", "gamma", "delta0"].map(|name| self.get(name)))
    }
}
