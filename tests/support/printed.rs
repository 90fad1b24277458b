//! Numbers that the program prints: as JSON, as CSV, and as lines `name = value`.

use serde_json::Value;

use crate::{Data, Workdir};

impl Workdir {
    /// Runs the program, which must succeed as [`Workdir::succeed`] says, and returns what it prints,
    /// which must be one line of JSON.
    pub fn json(&self, args: impl AsRef<str>) -> Value {
        let text = self.succeed(args);
        assert_eq!(text.lines().count(), 1, "{text}");
        json(&text)
    }

    /// Runs a fit as [`Workdir::json`] does, and returns its object without the command.
    pub fn found(&self, args: impl AsRef<str>) -> Value {
        let mut found = self.json(args);
        let fields = found.as_object_mut().expect("an object");
        fields.remove("command").expect("the command of a fit");
        found
    }

    /// Runs the program, which must succeed as [`Workdir::succeed`] says, and returns what it prints, which
    /// must be CSV.
    pub fn csv(&self, args: impl AsRef<str>) -> Data {
        Data::parse("standard output", &self.succeed(args))
    }
}

/// Reads JSON.
#[track_caller]
pub fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap_or_else(|error| panic!("{error}: {text}"))
}

/// Returns the number at a path such as `parameters/film_modulus/value`.
#[track_caller]
pub fn number(object: &Value, path: &str) -> f64 {
    let found = object.pointer(&format!("/{path}")).and_then(Value::as_f64);
    found.unwrap_or_else(|| panic!("no number at {path}: {object}"))
}

/// Returns value and standard error of a parameter of a fit.
#[track_caller]
pub fn estimate(fit: &Value, name: &str) -> [f64; 2] {
    ["value", "stderr"].map(|key| number(fit, &format!("parameters/{name}/{key}")))
}

/// Asserts that a fit finds a parameter within 4 standard errors, which are each less than `largest`.
#[track_caller]
pub fn assert_estimate(fit: &Value, name: &str, truth: f64, largest: f64) {
    let [value, error] = estimate(fit, name);
    assert!(
        (value - truth).abs() < 4.0 * error && error < largest,
        "{name}: {value} +- {error}, not {truth}: {fit}"
    );
}

/// Returns the kinds of the warnings of a fit.
#[track_caller]
pub fn kinds(fit: &Value) -> Vec<&str> {
    let warnings = fit["warnings"].as_array().expect("a list").iter();
    let kinds = warnings.map(|warning| warning["kind"].as_str().expect("text"));
    kinds.collect()
}

/// Returns the value of a line `name = value`.
#[track_caller]
pub fn value(text: &str, name: &str) -> f64 {
    let mut lines = text.lines().filter_map(|line| line.split_once('='));
    let line = lines.find(|(key, _)| key.trim() == name);
    let value = line.and_then(|(_, value)| value.trim().parse().ok());
    value.unwrap_or_else(|| panic!("no number {name} in: {text}"))
}
