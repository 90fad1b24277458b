//! An axis of a panel: the positions of values on it, and the values that are written along it.

use std::ops::Range;

use plotters::coord::ranged1d::{
    KeyPointHint, KeyPointWeight, NoDefaultFormatting, Ranged, ValueFormatter,
};

/// An axis with its label, which includes the unit.
#[derive(Clone, Debug)]
pub struct Axis {
    label: String,
    range: [f64; 2],
    scale: Scale,
}

#[derive(Clone, Debug)]
enum Scale {
    Linear,
    Logarithmic,
    Names(Vec<String>),
}

/// The approximate number of intervals between the numbers along a linear axis. A logarithmic axis
/// has at most twice this number.
const INTERVALS: f64 = 5.0;

impl Axis {
    /// Makes a linear axis from one value to another.
    pub fn linear(label: impl Into<String>, range: [f64; 2]) -> Self {
        Self {
            label: label.into(),
            range,
            scale: Scale::Linear,
        }
    }

    /// Makes a logarithmic axis from one positive value to another.
    pub fn logarithmic(label: impl Into<String>, range: [f64; 2]) -> Self {
        Self {
            label: label.into(),
            range,
            scale: Scale::Logarithmic,
        }
    }

    /// Makes a logarithmic axis of the decades that hold all positive, finite `values`. Other
    /// values are ignored.
    pub fn decades(label: impl Into<String>, values: impl IntoIterator<Item = f64>) -> Self {
        let exponents = values
            .into_iter()
            .filter(|value| *value > 0.0 && value.is_finite())
            .map(f64::log10);
        let ends = exponents.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], e| {
            [low.min(e), high.max(e)]
        });
        let [low, high] = if ends[0] <= ends[1] {
            [ends[0].floor(), ends[1].ceil()]
        } else {
            [0.0, 1.0]
        };
        Self::logarithmic(label, [low, high.max(low + 1.0)].map(|e| 10_f64.powf(e)))
    }

    /// Makes a vertical axis with names along it: name number `i` at the value `i + 0.5`, the first
    /// on top.
    pub fn names<T: Into<String>>(names: impl IntoIterator<Item = T>) -> Self {
        let names: Vec<String> = names.into_iter().map(Into::into).collect();
        Self {
            label: String::new(),
            range: [names.len() as f64, 0.0],
            scale: Scale::Names(names),
        }
    }

    /// Makes an axis from 0 to 1 with nothing written along it.
    pub fn hidden() -> Self {
        Self {
            label: String::new(),
            range: [0.0, 1.0],
            scale: Scale::Names(Vec::new()),
        }
    }

    /// Returns the label.
    pub fn label(&self) -> &str {
        &self.label
    }

    /// Returns the values at the ends.
    pub fn range(&self) -> [f64; 2] {
        self.range
    }

    /// Returns the position of a value: 0 at the beginning of the axis and 1 at its end. It is not
    /// finite for a value that a logarithmic axis cannot show.
    pub fn position(&self, value: f64) -> f64 {
        let [from, to] = self.range;
        match self.scale {
            Scale::Logarithmic => (value / from).ln() / (to / from).ln(),
            Scale::Linear | Scale::Names(_) => (value - from) / (to - from),
        }
    }

    /// Returns the value at a position: the inverse of [`Axis::position`].
    pub fn value(&self, position: f64) -> f64 {
        let [from, to] = self.range;
        match self.scale {
            Scale::Logarithmic => from * (to / from).powf(position),
            Scale::Linear | Scale::Names(_) => from + (to - from) * position,
        }
    }

    /// Returns the values that are written along the axis, with their texts.
    pub fn ticks(&self) -> Vec<(f64, String)> {
        let [from, to] = self.range;
        match &self.scale {
            Scale::Names(names) => (0_u32..)
                .zip(names)
                .map(|(i, name)| (f64::from(i) + 0.5, name.clone()))
                .collect(),
            Scale::Linear => {
                let step = step((to - from).abs() / INTERVALS);
                let decimals = (-step.log10().floor()).max(0.0) as usize;
                let inside = (from.min(to) / step - 1e-9).ceil() as i64
                    ..=(from.max(to) / step + 1e-9).floor() as i64;
                inside
                    .map(|i| {
                        (
                            i as f64 * step,
                            format!("{:.decimals$}", i as f64 * step).replace('-', "−"),
                        )
                    })
                    .collect()
            }
            Scale::Logarithmic => {
                let [low, high] = self.exponents();
                let every = (f64::from(high - low) / (2.0 * INTERVALS)).ceil().max(1.0) as usize;
                let digits: &[f64] = if (to / from).log10() < 1.5 {
                    &[1.0, 2.0, 5.0]
                } else {
                    &[1.0]
                };
                let values = (low..=high).step_by(every).flat_map(|e| {
                    digits
                        .iter()
                        .map(move |digit| (digit * power(e), *digit, e))
                });
                let name =
                    |digit: f64, e: i32| match (low.min(high) >= -2 && high <= 3, digit == 1.0) {
                        (true, _) => (digit * power(e)).to_string(),
                        (false, true) => power_of_ten(e),
                        (false, false) => format!("{digit}·{}", power_of_ten(e)),
                    };
                values
                    .filter(|(value, ..)| self.holds(*value))
                    .map(|(value, digit, e)| (value, name(digit, e)))
                    .collect()
            }
        }
    }

    /// Returns the values of the fine grid lines of a logarithmic axis.
    fn minor_ticks(&self) -> Vec<f64> {
        let [low, high] = self.exponents();
        match self.scale {
            Scale::Logarithmic if high - low <= 4 => {
                let values = (low - 1..=high)
                    .flat_map(|e| (2..10).map(move |digit| f64::from(digit) * power(e)));
                values.filter(|value| self.holds(*value)).collect()
            }
            _ => Vec::new(),
        }
    }

    fn holds(&self, value: f64) -> bool {
        (-1e-9..=1.0 + 1e-9).contains(&self.position(value))
    }

    /// Returns the exponents of the powers of ten at the ends of the axis or just beyond. They are
    /// those of an f64 even if the ends are 0 or infinite.
    fn exponents(&self) -> [i32; 2] {
        [
            (self.range[0].log10() + 1e-9).floor(),
            (self.range[1].log10() - 1e-9).ceil(),
        ]
        .map(|exponent| exponent.clamp(-324.0, 308.0) as i32)
    }
}

/// Returns 1, 2 or 5 times a power of ten: the smallest such number above `least / 1.2`.
fn step(least: f64) -> f64 {
    let decade = 10_f64.powf(least.log10().floor());
    let digit = [1.0, 2.0, 5.0]
        .into_iter()
        .find(|digit| least <= 1.2 * digit * decade)
        .unwrap_or(10.0);
    digit * decade
}

/// Returns a power of ten, correctly rounded, which `powi` is not.
fn power(exponent: i32) -> f64 {
    format!("1e{exponent}").parse().expect("it is a number")
}

/// Returns the text of a power of ten, such as `10^{−3}`, with a minus sign instead of a hyphen.
pub fn power_of_ten(exponent: i32) -> String {
    format!("10^{{{exponent}}}").replace('-', "−")
}

impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, (from, to): (i32, i32)) -> i32 {
        (f64::from(from) + self.position(*value) * f64::from(to - from)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        match hint.weight() {
            KeyPointWeight::Bold => self.ticks().into_iter().map(|(value, _)| value).collect(),
            KeyPointWeight::Any => self.minor_ticks(),
        }
    }

    fn range(&self) -> Range<f64> {
        self.range[0]..self.range[1]
    }
}

impl ValueFormatter<f64> for Axis {
    fn format_ext(&self, value: &f64) -> String {
        self.ticks()
            .into_iter()
            .find(|(tick, _)| tick == value)
            .map(|(_, name)| name)
            .unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_round_and_inside() {
        let written = |axis: Axis| -> Vec<String> {
            axis.ticks().into_iter().map(|(_, name)| name).collect()
        };
        let linear = |range| written(Axis::linear("", range)).join(" ");
        assert_eq!(linear([0.0, 1.0]), "0.0 0.2 0.4 0.6 0.8 1.0");
        assert_eq!(linear([-0.5, 0.25]), "−0.4 −0.2 0.0 0.2");
        assert_eq!(linear([55.0, 80.0]), "55 60 65 70 75 80");
        let logarithmic = |range| written(Axis::logarithmic("", range));
        assert_eq!(logarithmic([1e-3, 1e3])[..2], ["10^{−3}", "10^{−2}"]);
        assert_eq!(logarithmic([0.3, 4.0]), ["0.5", "1", "2"]);
        let decades = ["0.01", "0.1", "1", "10", "100"];
        assert_eq!(logarithmic([0.01, 100.0]), decades);
        assert_eq!(logarithmic([1e-15, 1e-1]).len(), 8);
    }

    #[test]
    fn minor_ticks_are_at_every_digit() {
        let ticks = Axis::logarithmic("", [1.0, 100.0]).minor_ticks();
        let expected = [1.0, 10.0]
            .map(|decade| [2, 3, 4, 5, 6, 7, 8, 9].map(|digit| f64::from(digit) * decade));
        assert_eq!(ticks, expected.concat());
    }

    #[test]
    fn decades_hold_the_values() {
        assert_eq!(
            Axis::decades("", [3e-7, 0.02, 0.0, f64::INFINITY]).range(),
            [1e-7, 0.1]
        );
        assert_eq!(Axis::decades("", [10.0]).range(), [10.0, 100.0]);
        assert_eq!(Axis::decades("", []).range(), [1.0, 10.0]);
    }

    #[test]
    fn names_run_downwards() {
        let axis = Axis::names(["a", "b"]);
        assert_eq!(axis.ticks(), [(0.5, "a".to_owned()), (1.5, "b".to_owned())]);
        assert_eq!([axis.position(0.5), axis.position(1.5)], [0.75, 0.25]);
        assert!(Axis::hidden().ticks().is_empty());
    }
}
