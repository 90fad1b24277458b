//! Text from files, as it is shown to a person.
//!
//! A terminal obeys control characters: a title could forge further lines, or change the colours.

use std::fmt::Write;
use std::path::Path;

/// Returns true for characters that a terminal obeys instead of showing: control characters, and
/// those that hide text or change its direction.
fn is_obeyed(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{ad}' | '\u{61c}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}'
            | '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{e0000}'..='\u{e007f}')
}

/// Returns a text of one line with every character that a terminal would obey as `\u{1b}`.
pub fn line(text: &str) -> String {
    escaped(text, |c, shown| write!(shown, "{}", c.escape_unicode()))
}

/// Returns a text of several lines, whose ends and tabs stay, with other such characters as
/// [`line`] shows them.
#[cfg(feature = "cli")]
pub fn lines(text: &str) -> String {
    text.split_inclusive(['\n', '\t'])
        .map(|part| match part.char_indices().next_back() {
            Some((end, last @ ('\n' | '\t'))) => format!("{}{last}", line(&part[..end])),
            _ => line(part),
        })
        .collect()
}

/// Returns a path as [`line`] shows it.
pub fn path(path: &Path) -> String {
    line(&path.display().to_string())
}

/// Returns JSON on one line whose texts hold such characters as `\u001b`, which is the same JSON.
#[cfg(feature = "cli")]
pub fn json(text: &str) -> String {
    escaped(text, |c, shown| {
        let mut units = [0; 2];
        c.encode_utf16(&mut units)
            .iter()
            .try_for_each(|unit| write!(shown, "\\u{unit:04x}"))
    })
}

fn escaped(text: &str, escape: impl Fn(char, &mut String) -> std::fmt::Result) -> String {
    let mut shown = String::with_capacity(text.len());
    for c in text.chars() {
        if is_obeyed(c) {
            escape(c, &mut shown).expect("writing to memory does not fail");
        } else {
            shown.push(c);
        }
    }
    shown
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_terminal_obeys_is_escaped_and_all_else_is_left() {
        let plain = "Ångström & <Söhne> 'µ' \"\\u{1b}\" e\u{301} 接触 👩";
        for text in [plain, "a\nb", "\n", "\ta\n\n", ""] {
            assert_eq!(lines(text), text);
        }
        assert_eq!(line(plain), plain);
        assert_eq!(
            line("\u{1b}]0;x\u{7}\n\r\t\0\u{7f}\u{9b}1m\u{202e}"),
            "\\u{1b}]0;x\\u{7}\\u{a}\\u{d}\\u{9}\\u{0}\\u{7f}\\u{9b}1m\\u{202e}"
        );
    }

    #[test]
    fn json_keeps_its_meaning() {
        let text = "\u{1b}\u{9b}\u{7f}\u{e0001}é\"\\";
        let written = serde_json::to_string(text).expect("text");
        let shown = json(&written);
        assert!(!shown.chars().any(is_obeyed), "{shown}");
        assert_eq!(serde_json::from_str::<String>(&shown).expect("JSON"), text);
    }
}
