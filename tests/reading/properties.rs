//! Whatever the style of a table, its numbers come back; whatever the bytes, there is no panic.

use fit::Kind;
use fit::data::{Column, Format, read_from};
use proptest::prelude::*;

use crate::{assert_values, sound, values};

/// A style of writing a table.
#[derive(Clone, Debug)]
struct Style {
    delimiter: &'static str,
    decimal_comma: bool,
    end: &'static str,
    mark: bool,
    comments: bool,
    load_first: bool,
    spare: bool,
    units: (&'static str, f64, &'static str, f64),
    brackets: (&'static str, &'static str),
}

fn style() -> impl Strategy<Value = Style> {
    let delimiters = prop::sample::select(vec!["\t", ";", ",", " ", "   "]);
    let ends = prop::sample::select(vec!["\n", "\r\n"]);
    let units = prop::sample::select(vec![
        ("m", 1.0, "N", 1.0),
        ("um", 1e-6, "mN", 1e-3),
        ("µm", 1e-6, "uN", 1e-6),
        ("nm", 1e-9, "nN", 1e-9),
        ("mm", 1e-3, "pN", 1e-12),
    ]);
    let brackets = prop::sample::select(vec![(" [", "]"), ("(", ")"), ("_", ""), ("/", "")]);
    (delimiters, any::<[bool; 5]>(), ends, units, brackets).prop_map(
        |(delimiter, [decimal_comma, mark, comments, load_first, spare], end, units, brackets)| {
            Style {
                delimiter,
                decimal_comma: decimal_comma && delimiter != ",",
                end,
                mark,
                comments,
                load_first,
                spare,
                units,
                brackets,
            }
        },
    )
}

impl Style {
    fn row(&self, [radius, load]: [&str; 2], spare: &str) -> String {
        let mut cells = if self.load_first {
            vec![load, radius]
        } else {
            vec![radius, load]
        };
        if self.spare {
            cells.insert(1, spare);
        }
        cells.join(self.delimiter) + self.end
    }

    fn write(&self, points: &[[f64; 2]]) -> String {
        let (open, close) = self.brackets;
        let (length, _, force, _) = self.units;
        let mut text = String::new();
        if self.mark {
            text.push('\u{feff}');
        }
        if self.comments {
            text += &format!("# a lens, 1, 2, 3{0}{0}", self.end);
        }
        let radius = format!("radius{open}{length}{close}");
        let load = format!("force{open}{force}{close}");
        text += &self.row([&radius, &load], "note");
        for (i, point) in points.iter().enumerate() {
            let [radius, load] = point.map(|value| {
                let text = format!("{value:?}");
                if self.decimal_comma {
                    text.replace('.', ",")
                } else {
                    text
                }
            });
            if self.comments && i % 7 == 3 {
                text += &format!("% half way{}", self.end);
            }
            text += &self.row([&radius, &load], "good");
        }
        text
    }
}

fn point() -> impl Strategy<Value = [f64; 2]> {
    (1e-9..1e9_f64, -1e9..1e9_f64).prop_map(|(radius, load)| [radius, load])
}

proptest! {
    #[test]
    fn numbers_come_back_from_any_style(
        style in style(),
        points in prop::collection::vec(point(), 1..40),
    ) {
        let text = style.write(&points);
        let reading = sound(&text, &Format::default());
        let (_, length, _, force) = style.units;
        let expected: Vec<_> = points.iter().map(|[a, f]| [a * length, f * force]).collect();
        assert_values(&values(&reading), &expected);
    }

    #[test]
    fn any_bytes_are_read_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        let _ = read_from(&bytes[..], "bytes", &Format::default());
    }

    #[test]
    fn any_text_of_a_table_is_read_or_refused(
        text in "([-a-zé0-9.,;\t \"#%\\[\\]()/_\r\n]|load|radius|\\[um\\]|\\[mN\\]|nan|inf){0,80}",
        column in "[a-z_]{0,6}=-?[0-9a-z \\[\\]]{0,6}",
        kind in prop::sample::select(vec![None, Some(Kind::LoadRadius), Some(Kind::ForceHeight)]),
    ) {
        let format = Format {
            kind,
            columns: column.parse::<Column>().into_iter().collect(),
            ..Format::default()
        };
        if let Ok(reading) = read_from(text.as_bytes(), "text", &format) {
            let points = reading.measurement.points;
            prop_assert!(!points.is_empty());
            for point in points {
                prop_assert!(point.abscissa.is_finite() && point.ordinate.is_finite());
            }
        }
    }
}
