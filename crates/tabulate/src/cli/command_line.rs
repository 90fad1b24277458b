//! The command that made a result: with it, the result can be made again.

use std::env;

use crate::printable;

/// Returns the command as a shell reads it back, in one line.
pub fn command_line() -> String {
    let words = env::args_os().skip(1);
    let words: Vec<String> = words
        .map(|word| quoted(word.display().to_string()))
        .collect();
    printable::line(&format!("tabulate {}", words.join(" ")))
}

/// Returns a word of a command as a shell reads it back.
fn quoted(word: String) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "-_./=:,+@%^".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        word
    } else {
        format!("'{}'", word.replace('\'', "'\\''"))
    }
}
