//! The points of a fit as CSV.

use ::fit::data::{Role, roles};
use ::fit::report::line_speeds;
use ::fit::{Direction, Experiment, Fit};

use crate::cli::points::number;

/// Returns one row for each point, in SI units. A missing number is an empty field.
pub fn csv(fit: &Fit, experiments: &[Experiment]) -> anyhow::Result<Vec<u8>> {
    let kind = experiments[0].measurement.kind;
    let same = experiments.iter().all(|one| one.measurement.kind == kind);
    let [abscissa, ordinate] = if same {
        roles(kind).map(Role::name)
    } else {
        ["abscissa", "ordinate"]
    };
    let mut writer = csv::Writer::from_writer(Vec::new());
    let has_speeds = fit.experiments.iter().any(|one| line_speeds(one).is_some());
    let of_line = has_speeds.then_some(["line_speed", "energy_release_rate"]);
    let columns = [
        "file",
        "line",
        "segment",
        abscissa,
        ordinate,
        "fit",
        "residual",
        "branch",
        "outlier",
        "without_film",
    ];
    writer.write_record(columns.into_iter().chain(of_line.into_iter().flatten()))?;
    for (fitted, experiment) in fit.experiments.iter().zip(experiments) {
        let points = fitted.points.iter().zip(&experiment.measurement.points);
        for (point, measured) in points {
            let or_empty = |value: Option<f64>| value.map(number).unwrap_or_default();
            let cells = [
                fitted.name.clone(),
                point.line.to_string(),
                measured
                    .direction
                    .map(Direction::name)
                    .unwrap_or_default()
                    .to_owned(),
                number(point.abscissa),
                number(point.ordinate),
                or_empty(point.fit),
                or_empty(point.residual()),
                point.branch.name().to_owned(),
                point.outlier.to_string(),
                or_empty(point.without_film),
            ];
            let of_line =
                of_line.map(|_| [point.line_speed, point.energy_release_rate].map(or_empty));
            writer.write_record(cells.into_iter().chain(of_line.into_iter().flatten()))?;
        }
    }
    Ok(writer.into_inner()?)
}
