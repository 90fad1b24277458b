//! A finished picture: SVG whose text is outlines, or PNG.
//!
//! The font is in the program, not of the system. Equal pictures are equal bytes on every machine.

use std::path::Path;
use std::sync::{Arc, LazyLock};

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{self, Options, Tree, WriteOptions, fontdb::Database};

use crate::Error;

/// The number of pixels of a PNG, along each side, for a pixel of the picture.
pub const PNG_SCALE: u32 = 2;

/// DejaVu Sans, reduced to [`CHARACTERS`]; see the README of the folder.
const FONT: &[u8] = include_bytes!("font/DejaVuSans-subset.ttf");
const CHARACTERS: &str = include_str!("font/characters.txt");

/// A format of the file of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Vectors, text included.
    Svg,
    /// Pixels: [`PNG_SCALE`] along each side for a pixel of the picture.
    Png,
}

impl Format {
    /// Returns the format for the ending of the name of a file, `.svg` or `.png`; none for any other.
    pub fn of(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()? {
            "svg" => Some(Self::Svg),
            "png" => Some(Self::Png),
            _ => None,
        }
    }
}

/// A picture without text: outlines only.
#[derive(Debug)]
pub struct Picture(Tree);

impl Picture {
    /// Reads SVG with text, in which `_{...}` is a subscript and `^{...}` a superscript.
    ///
    /// # Errors
    /// [`Error`] if the text is not SVG, or holds a character that the font lacks.
    pub fn from_svg(svg: &str) -> Result<Self, Error> {
        if let Some(missing) = svg.chars().find(|&c| c != '\n' && !CHARACTERS.contains(c)) {
            return Err(Error(format!("the font has no {missing:?}")));
        }
        static OPTIONS: LazyLock<Options<'_>> = LazyLock::new(|| {
            let mut fonts = Database::new();
            fonts.load_font_data(FONT.to_vec());
            let family = fonts
                .faces()
                .next()
                .and_then(|face| face.families.first())
                .map(|(name, _)| name.clone());
            fonts.set_sans_serif_family(family.expect("the embedded font has a name"));
            Options {
                fontdb: Arc::new(fonts),
                ..Options::default()
            }
        });
        Tree::from_str(&raised_and_lowered(svg), &OPTIONS)
            .map(Self)
            .map_err(|e| Error(e.to_string()))
    }

    /// Returns width and height in pixels.
    pub fn size(&self) -> [f32; 2] {
        [self.0.size().width(), self.0.size().height()]
    }

    /// Returns the bytes of a file.
    ///
    /// # Errors
    /// [`Error`] if the picture is too large for a PNG.
    pub fn encode(&self, format: Format) -> Result<Vec<u8>, Error> {
        match format {
            Format::Svg => {
                let options = WriteOptions {
                    coordinates_precision: 1,
                    transforms_precision: 4,
                    indent: usvg::Indent::None,
                    ..Default::default()
                };
                Ok(self.0.to_string(&options).into_bytes())
            }
            Format::Png => {
                let [width, height] = self
                    .size()
                    .map(|length| (length * PNG_SCALE as f32).ceil() as u32);
                let mut pixels = Pixmap::new(width, height)
                    .ok_or_else(|| Error(format!("{width} by {height} pixels are too many")))?;
                resvg::render(
                    &self.0,
                    Transform::from_scale(PNG_SCALE as f32, PNG_SCALE as f32),
                    &mut pixels.as_mut(),
                );
                pixels.encode_png().map_err(|e| Error(e.to_string()))
            }
        }
    }
}

/// Replaces the characters that the font lacks, and the braces of sub- and superscripts, by
/// question marks.
pub fn legible(text: &str) -> String {
    text.chars()
        .map(|c| {
            if CHARACTERS.contains(c) && !"{}".contains(c) {
                c
            } else {
                '?'
            }
        })
        .collect()
}

/// Returns the width of a text of size 1.
///
/// # Errors
/// As [`Picture::from_svg`].
pub fn text_width(text: &str) -> Result<f64, Error> {
    let text = text.replace('&', "&amp;").replace('<', "&lt;");
    let svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"1\" height=\"1\"><text font-family=\"sans-serif\" font-size=\"100\">{text}</text></svg>"
    );
    Ok(f64::from(Picture::from_svg(&svg)?.0.root().bounding_box().width()) / 100.0)
}

/// Replaces `_{...}` and `^{...}` by the subscripts and superscripts of SVG.
fn raised_and_lowered(svg: &str) -> String {
    let mut out = String::with_capacity(svg.len());
    let mut rest = svg;
    while let Some(at) = rest.find("_{").into_iter().chain(rest.find("^{")).min() {
        let (before, inner) = rest.split_at(at);
        let shift = if inner.starts_with('_') {
            "-22%"
        } else {
            "38%"
        };
        let Some((inner, after)) = inner[2..].split_once('}') else {
            break;
        };
        out +=
            &format!("{before}<tspan baseline-shift=\"{shift}\" font-size=\"72%\">{inner}</tspan>");
        rest = after;
    }
    out + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the SVG of a character.
    fn outlines(text: char) -> String {
        let svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"9\" height=\"9\"><text font-family=\"sans-serif\">&#{};</text></svg>",
            u32::from(text)
        );
        String::from_utf8(
            Picture::from_svg(&svg)
                .unwrap()
                .encode(Format::Svg)
                .unwrap(),
        )
        .unwrap()
    }

    #[test]
    fn the_font_draws_every_character_of_its_list() {
        // A character without a glyph must draw nothing, not even a box.
        assert!(!outlines('☃').contains("<path"));
        for character in CHARACTERS.chars() {
            let drawn = outlines(character);
            assert_eq!(
                drawn.contains("<path"),
                !character.is_whitespace(),
                "{character:?}: {drawn}"
            );
        }
    }

    #[test]
    fn a_character_without_a_glyph_is_an_error() {
        let error = text_width("a☃").unwrap_err().to_string();
        assert!(error.contains('☃'), "{error}");
    }

    #[test]
    fn subscripts_are_told_from_what_is_not() {
        assert_eq!(
            raised_and_lowered("a_{b}c"),
            "a<tspan baseline-shift=\"-22%\" font-size=\"72%\">b</tspan>c"
        );
        for plain in ["a_b", "a}", "_{a", "{a}"] {
            assert_eq!(raised_and_lowered(plain), plain);
        }
    }
}
