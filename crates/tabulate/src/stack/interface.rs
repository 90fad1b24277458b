//! The key `interface` of a layer in TOML.

use solve::stack::Interface;

/// The keys of springs.
const TANGENTIAL: &str = "tangential_stiffness";
const NORMAL: &str = "normal_stiffness";

/// Reads the value of the key. An error is a sentence with the value and what is allowed.
pub fn read(value: &toml::Value) -> Result<Interface, String> {
    match value {
        toml::Value::String(word) => match word.as_str() {
            "bonded" => Ok(Interface::Bonded),
            "sliding" => Ok(Interface::Sliding),
            _ => Err(format!("interface = {word:?} is none: {}", allowed())),
        },
        toml::Value::Table(springs) => {
            if let Some(key) = springs
                .keys()
                .find(|key| ![TANGENTIAL, NORMAL].contains(&key.as_str()))
            {
                return Err(format!("interface: unknown key {key:?}: {}", allowed()));
            }
            let stiffness = |key: &str| match springs.get(key) {
                None => Ok(None),
                Some(toml::Value::Float(stiffness)) => Ok(Some(*stiffness)),
                Some(toml::Value::Integer(stiffness)) => Ok(Some(*stiffness as f64)),
                Some(other) => Err(format!(
                    "interface: {key} = {other} is no number: give it in Pa/m, such as 2e11"
                )),
            };
            let tangential = stiffness(TANGENTIAL)?.ok_or_else(|| {
                format!(
                    "interface: {TANGENTIAL} is missing: give it in Pa/m; it is 0 of a layer that \
                     slides, and inf of one that does not"
                )
            })?;
            Ok(Interface::Springs {
                tangential,
                normal: stiffness(NORMAL)?.unwrap_or(f64::INFINITY),
            })
        }
        other => Err(format!("interface = {other} is none: {}", allowed())),
    }
}

/// Says what an interface may be.
fn allowed() -> String {
    format!(
        "write \"bonded\", \"sliding\", or springs, {{ {TANGENTIAL} = .., {NORMAL} = .. }} in Pa/m, \
         without {NORMAL} if it is inf"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(value: &str) -> Result<Interface, String> {
        let table: toml::Table = format!("interface = {value}").parse().expect("TOML");
        read(&table["interface"])
    }

    #[test]
    fn the_words_and_the_springs_are_read() {
        let springs = |tangential, normal| Ok(Interface::Springs { tangential, normal });
        assert_eq!(parse("\"bonded\""), Ok(Interface::Bonded));
        assert_eq!(parse("\"sliding\""), Ok(Interface::Sliding));
        let both = "{ tangential_stiffness = 2e11, normal_stiffness = 5 }";
        assert_eq!(parse(both), springs(2e11, 5.0));
        let infinity = f64::INFINITY;
        assert_eq!(
            parse("{ tangential_stiffness = 0 }"),
            springs(0.0, infinity)
        );
        assert_eq!(
            parse("{ tangential_stiffness = inf }"),
            springs(infinity, infinity)
        );
    }

    #[test]
    fn what_is_no_interface_is_refused_by_name() {
        let cases = [
            (
                "\"slidding\"",
                "\"slidding\" is none: write \"bonded\", \"sliding\"",
            ),
            ("\"Sliding\"", "write \"bonded\""),
            ("2e11", "interface = 2"),
            ("true", "interface = true is none"),
            ("{ }", "tangential_stiffness is missing"),
            (
                "{ normal_stiffness = 1 }",
                "tangential_stiffness is missing",
            ),
            ("{ tangential = 1 }", "unknown key \"tangential\""),
            ("{ tangential_stiffness = \"2e11\" }", "is no number"),
            (
                "{ tangential_stiffness = 1, normal_stiffness = [1] }",
                "normal_stiffness = [1] is no number",
            ),
        ];
        for (value, part) in cases {
            let message = parse(value).expect_err("refused");
            assert!(message.contains(part), "{message:?} lacks {part:?}");
        }
    }
}
