//! The page, filled from its template.

use std::fmt::Write;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::form;
use super::form::Setting;
use crate::Error;
use crate::chart::Figure;
use crate::picture::Format;

/// The digits of the numbers that a page shows: as many as its pictures need.
pub const DIGITS: usize = 4;

/// A figure of a page with its caption.
#[derive(Debug)]
pub struct Illustration {
    /// One or two sentences about the figure.
    pub caption: &'static str,
    /// The figure.
    pub figure: Figure,
}

/// The texts and numbers of a page about a table. Texts may hold any characters.
#[derive(Debug)]
pub struct Page<'a> {
    /// The title of the table.
    pub title: String,
    /// The rows of the table of parameters.
    pub parameters: Vec<Parameter>,
    /// The quantities that the table answers.
    pub quantities: String,
    /// The modulus that normalises the quantities.
    pub normalisation: &'a str,
    /// The program that made the table.
    pub created_by: String,
    /// The text of the scene.
    pub scene: String,
    /// The names and values of the certificate.
    pub certificate: Vec<(&'static str, String)>,
    /// What the page computes with; or the reason why it computes nothing.
    pub numbers: Result<Numbers, &'static str>,
    /// The figures.
    pub illustrations: &'a [Illustration],
    /// The contact radius over the radius of the probe from which on the page shows `large_contact`.
    pub warning_a_over_r: f64,
    /// The warning of wide contacts.
    pub large_contact: &'a str,
    /// The name of the probe with which the page opens.
    pub probe: &'static str,
}

/// What a page computes force curves with.
#[derive(Debug)]
pub struct Numbers {
    /// The settings of its form.
    pub settings: Vec<Setting>,
    /// The names and texts of the probes between which its user chooses.
    pub probes: Vec<(&'static str, &'static str)>,
    /// The symbols of the numbers of a state, the columns of its tables.
    pub columns: Vec<&'static str>,
    /// The table without its integers, as entries of an object of JavaScript.
    pub table: String,
    /// The integers of the tensor trains, separated by commas, with nothing in place of a zero.
    pub integers: String,
    /// The largest relative difference of the quantities from those of the table, and the number of random points.
    pub difference: (f64, usize),
}

/// A parameter of a table.
#[derive(Debug)]
pub struct Parameter {
    /// Its symbol.
    pub symbol: &'static str,
    /// What it is.
    pub meaning: &'static str,
    /// Its value, or its first and last value and the number of nodes, or what stands in place of it.
    pub range: Range,
}

/// The values of a parameter, as they are shown.
#[derive(Debug)]
pub enum Range {
    /// One value.
    Fixed(String),
    /// From, to, and the number of nodes, or what stands in place of it.
    FromTo(String, String, String),
}

impl Page<'_> {
    /// Returns the page. Equal contents give equal pages, byte for byte.
    ///
    /// # Errors
    /// Those of drawing the illustrations.
    pub fn html(&self) -> Result<String, Error> {
        let (section, script, integers) = match &self.numbers {
            Ok(numbers) => (
                curves(numbers),
                self.script(numbers),
                numbers.integers.as_str(),
            ),
            Err(reason) => (
                format!("<div id=\"message\" role=\"status\"><p>{reason}</p></div>"),
                String::new(),
                "",
            ),
        };
        let certificate = self
            .certificate
            .iter()
            .map(|(name, value)| format!("<dt>{name}</dt><dd>{value}</dd>\n"));
        let parts = [
            ("title", escape(&self.title)),
            ("style", include_str!("style.css").to_owned()),
            ("axes", self.parameters.iter().map(row).collect()),
            ("quantities", self.quantities.clone()),
            ("normalisation", self.normalisation.to_owned()),
            ("created_by", escape(&self.created_by)),
            ("scene", escape(&self.scene)),
            ("certificate", certificate.collect()),
            ("curves", section),
            ("figures", figures(self.illustrations)?),
            ("integers", integers.to_owned()),
            ("script", script),
        ];
        Ok(fill(include_str!("page.html"), &parts))
    }

    fn script(&self, numbers: &Numbers) -> String {
        let constants = format!(
            "const WARNING_A_OVER_R = {:?}, LARGE_CONTACT = {:?}, PROBE = {:?}, DIGITS = {DIGITS};\n\
             const SETTINGS = {};\nconst TABLE = {{ {},\nhash: {} }};\n",
            self.warning_a_over_r,
            self.large_contact,
            self.probe,
            form::script(&numbers.settings),
            numbers.table,
            hash(&numbers.integers),
        );
        let script = [
            &constants,
            include_str!("table.js"),
            include_str!("grid.js"),
            include_str!("material.js"),
            include_str!("contact.js"),
            include_str!("chart.js"),
            include_str!("page.js"),
        ];
        script.concat()
    }
}

/// Returns the form, and the places of the curves and numbers, in HTML.
fn curves(numbers: &Numbers) -> String {
    let head = |symbol: &&str| format!("<th scope=\"col\">{symbol}</th>");
    let (difference, compared) = numbers.difference;
    let parts = [
        ("form", form::form(&numbers.settings, &numbers.probes)),
        ("columns", numbers.columns.iter().map(head).collect()),
        ("bytes", numbers.integers.len().div_ceil(1000).to_string()),
        ("difference", format!("{difference:.0e}")),
        ("compared", compared.to_string()),
        ("digits", DIGITS.to_string()),
    ];
    fill(include_str!("curves.html"), &parts)
}

/// Returns the hash of Fowler, Noll and Vo (FNV-1a) of a text, by which the page finds damage.
fn hash(text: &str) -> u32 {
    text.bytes().fold(2_166_136_261, |hash, byte| {
        (hash ^ u32::from(byte)).wrapping_mul(16_777_619)
    })
}

/// Returns a row of the table of parameters in HTML.
fn row(parameter: &Parameter) -> String {
    let Parameter {
        symbol,
        meaning,
        range,
    } = parameter;
    let cells = match range {
        Range::Fixed(value) => format!("<td colspan=\"2\">{value}</td><td>fixed</td>"),
        Range::FromTo(from, to, nodes) => {
            format!("<td>{from}</td><td>{to}</td><td>{nodes}</td>")
        }
    };
    format!("<tr><th scope=\"row\">{symbol} <small>{meaning}</small></th>{cells}</tr>\n")
}

/// Returns the section of the figures: empty if there are none. Each figure is an image of its own,
/// because the names inside two SVG figures are equal.
fn figures(illustrations: &[Illustration]) -> Result<String, Error> {
    let mut section = String::new();
    for Illustration { caption, figure } in illustrations {
        let svg = STANDARD.encode(figure.picture()?.encode(Format::Svg)?);
        let _ = writeln!(
            section,
            "<figure><img alt=\"{caption}\" src=\"data:image/svg+xml;base64,{svg}\"><figcaption>{caption} \
             <label class=\"enlarge\"><input type=\"checkbox\"> full size</label></figcaption></figure>"
        );
    }
    if section.is_empty() {
        return Ok(section);
    }
    Ok(format!(
        "<section class=\"wide figures\" aria-labelledby=\"figures\">\n\
         <h2 id=\"figures\">Figures</h2>\n\
         {section}</section>"
    ))
}

/// Returns the template with each `{{name}}` replaced by the part of this name. Braces inside the
/// parts stay.
fn fill(template: &str, parts: &[(&str, String)]) -> String {
    let mut pieces = template.split("{{");
    let mut page = pieces.next().unwrap_or_default().to_owned();
    for piece in pieces {
        let (name, rest) = piece
            .split_once("}}")
            .expect("every name in the template is closed");
        let (_, part) = parts
            .iter()
            .find(|(part, _)| *part == name)
            .expect("every name in the template has a part");
        page += part;
        page += rest;
    }
    page
}

/// Escapes text for HTML.
fn escape(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}
