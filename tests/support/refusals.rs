//! Refusals: tables of them as text, one case a line, and the words of their messages.

use std::fmt::Display;

use crate::Workdir;

/// Words that a message must contain: a list, or a line in which `; ` parts them.
pub trait Words {
    /// Returns the list.
    fn list(&self) -> Vec<&str>;
}

impl Words for str {
    fn list(&self) -> Vec<&str> {
        self.split("; ").collect()
    }
}

impl Words for String {
    fn list(&self) -> Vec<&str> {
        self.as_str().list()
    }
}

impl<T: AsRef<str>> Words for [T] {
    fn list(&self) -> Vec<&str> {
        self.iter().map(AsRef::as_ref).collect()
    }
}

impl<T: AsRef<str>, const N: usize> Words for [T; N] {
    fn list(&self) -> Vec<&str> {
        self.as_slice().list()
    }
}

impl<T: AsRef<str>> Words for Vec<T> {
    fn list(&self) -> Vec<&str> {
        self.as_slice().list()
    }
}

/// Returns the words that `message` lacks.
fn missing<'a>(message: &str, words: &'a (impl Words + ?Sized)) -> Vec<&'a str> {
    let words = words.list();
    assert!(!words.is_empty(), "no words");
    assert!(words.iter().all(|word| !word.is_empty()), "an empty word");
    let lacks = |word: &&str| !message.contains(word);
    words.into_iter().filter(lacks).collect()
}

/// Asserts that `message` contains each of the words.
#[track_caller]
pub fn assert_names(message: &str, words: &(impl Words + ?Sized)) {
    let missing = missing(message, words);
    assert!(missing.is_empty(), "{missing:?} not in: {message}");
}

/// A result that is to be an error.
pub trait Refused {
    /// Asserts that it is an error, whose message is one line, names no flag of the program, and
    /// contains each of the words.
    fn refused(self, words: &(impl Words + ?Sized));
}

impl<T, E: Display> Refused for Result<T, E> {
    #[track_caller]
    fn refused(self, words: &(impl Words + ?Sized)) {
        let Err(error) = self else {
            panic!("not refused: {:?}", words.list())
        };
        let message = error.to_string();
        assert_names(&message, words);
        let is_one_line = message.lines().count() == 1;
        assert!(is_one_line && !message.contains("--"), "{message}");
    }
}

/// Asserts that a value has the shape of a pattern, which may have a condition.
#[macro_export]
macro_rules! assert_matches {
    ($found:expr, $($pattern:tt)+) => {
        match $found {
            $($pattern)+ => (),
            ref found => panic!("{found:?} is not {}", stringify!($($pattern)+)),
        }
    };
}

/// Returns the cells of a table as text: one row a line, its cells parted by ` | `. Blanks around a
/// cell do not count, nor do empty lines.
#[track_caller]
pub fn rows<'a, const N: usize>(table: &'a str) -> Vec<[&'a str; N]> {
    let lines = table.lines().filter(|line| !line.trim().is_empty());
    let cells = |line: &'a str| line.split(" |").map(str::trim).collect();
    let row = |cells: Vec<&'a str>| {
        <[&str; N]>::try_from(cells).unwrap_or_else(|cells| panic!("not {N} cells: {cells:?}"))
    };
    let rows: Vec<_> = lines.map(cells).map(row).collect();
    assert!(!rows.is_empty(), "a table without rows");
    rows
}

/// Asserts that each case of a table, which [`rows`] reads, is refused with its words, which are the
/// last cell. `message` returns the message of a case.
#[track_caller]
pub fn assert_cases<const N: usize>(table: &str, mut message: impl FnMut([&str; N]) -> String) {
    let mut wrong = Vec::new();
    for row in rows::<N>(table) {
        let message = message(row);
        let missing = missing(&message, row[N - 1]);
        if !missing.is_empty() {
            wrong.push(format!("{row:?}: {missing:?} not in: {message}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

impl Workdir {
    /// Makes each call of a table, which [`rows`] reads: its exit status, its arguments, and words of
    /// its message. Each must fail, as [`Workdir::fail`] says.
    #[track_caller]
    pub fn refuses(&self, table: impl AsRef<str>) {
        let mut wrong = Vec::new();
        for [status, call, words] in rows(table.as_ref()) {
            let run = self.run(call);
            let missing = missing(&run.stderr, words);
            if !run.fails(status.parse().expect("an exit status")) || !missing.is_empty() {
                wrong.push(format!("{status} | {call}: {missing:?} not in {run:?}"));
            }
        }
        assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[should_panic(expected = "not 3 cells")]
    fn a_line_of_other_cells_is_no_row() {
        rows::<3>("1 | solve | Usage\n2 | solve");
    }

    #[test]
    #[should_panic(expected = "a table without rows")]
    fn a_table_has_rows() {
        rows::<3>("\n    \n");
    }

    #[test]
    #[should_panic(expected = "[\"b\", \"second\"]: [\"second\"] not in: a first")]
    fn a_case_that_is_not_refused_as_it_says_is_named() {
        assert_cases("a | a; first\nb | second", |[_, _]| "a first".to_owned());
    }

    #[test]
    #[should_panic(expected = "not refused: [\"0.5\"]")]
    fn a_result_is_not_refused() {
        "1".parse::<f64>().refused("0.5");
    }
}
