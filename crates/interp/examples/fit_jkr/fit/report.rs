//! A fit as text.

use std::fmt::{self, Display};
use std::io::{ErrorKind, Write};

use super::Fit;

/// Writes a text and flushes. A reader that has closed its end of the pipe, such as `head`, is no
/// error.
pub fn print(mut out: impl Write, text: &impl Display) -> Result<(), String> {
    match write!(out, "{text}").and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(format!("cannot write the output: {error}"))
        }
        _ => Ok(()),
    }
}

impl Display for Fit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let jkr = &self.homogeneous;
        writeln!(f, "{} points, load against {}", self.points, self.against)?;
        writeln!(
            f,
            "without a film (JKR): E* = {:.4e} Pa, w = {:.4e} J/m^2\n",
            jkr.modulus, jkr.work_of_adhesion
        )?;
        for estimate in &self.estimates {
            let (name, unit) = (
                estimate.parameter.name(),
                estimate.parameter.unit(self.against),
            );
            let digits = (estimate.value.abs().log10().floor() - estimate.error.log10().floor()
                + 1.0)
                .clamp(0.0, 15.0) as usize;
            writeln!(
                f,
                "{name:<17} {:.digits$e} +- {:.1e} {unit}",
                estimate.value, estimate.error
            )?;
        }
        writeln!(f, "\ncorrelation")?;
        for (i, estimate) in self.estimates.iter().enumerate() {
            let row: String = (0..=i)
                .map(|j| format!(" {:>6.3}", self.correlation[(i, j)]))
                .collect();
            writeln!(f, "{:<17}{row}", estimate.parameter.name())?;
        }
        match self.reduced_chi_squared {
            Some(value) => writeln!(
                f,
                "\nreduced chi^2 {value:.2} with a noise of {:.1e} N",
                self.noise
            )?,
            None => writeln!(
                f,
                "\nnoise {:.1e} N, estimated from the residuals",
                self.noise
            )?,
        }
        self.warnings
            .iter()
            .try_for_each(|warning| writeln!(f, "warning: {warning}"))
    }
}
