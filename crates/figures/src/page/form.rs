//! The settings of a page: the rows of its form, and what its script knows of them.

use std::fmt::Write;

/// A number that the user of a page sets, or that its table fixes.
#[derive(Debug)]
pub struct Setting {
    /// The name of the option of `tabulate curve`, with underscores.
    pub key: &'static str,
    /// What it is.
    pub name: &'static str,
    /// Its symbol.
    pub symbol: &'static str,
    /// The unit in which it is shown.
    pub unit: &'static str,
    /// The size of the unit, in SI units.
    pub scale: f64,
    /// The value with which the page opens, in SI units.
    pub usual: f64,
    /// The ends of its slider.
    pub ends: [f64; 2],
    /// The smallest and the largest value that the program takes without a doubt.
    pub undoubted: [f64; 2],
    /// The smallest and the largest value allowed, and these in words.
    pub valid: ([f64; 2], &'static str),
    /// Who sets it.
    pub set_by: SetBy,
}

/// Who sets a setting.
#[derive(Clone, Debug, PartialEq)]
pub enum SetBy {
    /// The user.
    User,
    /// The user, who may make the body rigid.
    UserOrRigid,
    /// The table, with a remark.
    Table(&'static str),
    /// The table, by a ratio to another modulus, with a remark.
    Ratio(String),
}

impl Setting {
    /// Returns the row of the form in HTML.
    fn row(&self) -> String {
        let Self {
            key,
            name,
            symbol,
            unit,
            set_by,
            ..
        } = self;
        let slider = |or_rigid| {
            format!(
                "<label for=\"{key}\"><span>{name}</span> <i>{symbol}</i>{or_rigid}</label>\
                 <input type=\"range\" id=\"{key}\" min=\"0\" max=\"1000\" step=\"1\"><span class=\"field\">\
                 <input type=\"text\" inputmode=\"decimal\" id=\"{key}-number\" spellcheck=\"false\" autocomplete=\"off\">\
                 <span>{unit}</span></span>"
            )
        };
        let fixed =
            |remark| format!("<span>{name} {symbol}{remark}</span><output id=\"{key}\"></output>");
        match set_by {
            SetBy::User => slider(""),
            SetBy::UserOrRigid => slider(", or rigid"),
            SetBy::Table(remark) => fixed(*remark),
            SetBy::Ratio(remark) => fixed(remark),
        }
    }

    /// Returns the setting as an entry of an object of JavaScript.
    fn script(&self) -> String {
        let Self {
            key,
            name,
            unit,
            scale,
            usual,
            ends,
            undoubted,
            valid: (valid, must),
            set_by,
            ..
        } = self;
        format!(
            "{key}: {{ name: {name:?}, unit: {unit:?}, scale: {}, usual: {}, sensible: {}, undoubted: {}, valid: {}, must: {must:?}, \
             free: {}, mayBeRigid: {}, follows: {} }},\n",
            number(*scale),
            number(*usual),
            list(ends),
            list(undoubted),
            list(valid),
            matches!(set_by, SetBy::User | SetBy::UserOrRigid),
            *set_by == SetBy::UserOrRigid,
            matches!(set_by, SetBy::Ratio(_)),
        )
    }
}

/// Returns the rows of the form in HTML: the choice of the probe, if there are several, and the
/// settings.
pub(super) fn form(settings: &[Setting], probes: &[(&str, &str)]) -> String {
    let mut form = String::new();
    if probes.len() > 1 {
        let option =
            |(name, text): &(&str, &str)| format!("<option value=\"{name}\">{text}</option>");
        let options: String = probes.iter().map(option).collect();
        let _ = writeln!(
            form,
            "<div class=\"control\"><label for=\"probe\">probe</label><select id=\"probe\">{options}</select></div>"
        );
    }
    for setting in settings {
        let _ = writeln!(form, "<div class=\"control\">{}</div>", setting.row());
    }
    form
}

/// Returns the settings as an object of JavaScript.
pub(super) fn script(settings: &[Setting]) -> String {
    let entries: String = settings.iter().map(Setting::script).collect();
    format!("{{\n{entries}}}")
}

/// Returns a number as JavaScript writes it.
pub fn number(number: f64) -> String {
    format!("{number:?}").replace("inf", "Infinity")
}

/// Returns numbers as a list of JavaScript.
pub fn list(numbers: &[f64]) -> String {
    let numbers: Vec<String> = numbers.iter().map(|&value| number(value)).collect();
    format!("[{}]", numbers.join(", "))
}
