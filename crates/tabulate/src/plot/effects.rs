//! Each effect of a scene: its cost, and the error of the load without it.

use cost::effects::{Effect, Row};
use figures::Error;
use figures::axis::Axis;
use figures::chart::{BLUE, Figure, GREY, Marker, Panel, Side, VERMILION};

/// Draws the errors on the left and the costs on the right.
///
/// # Errors
/// [`Error`] if there is no row of the whole scene, or if an effect saves more than the
/// whole.
pub fn figure(rows: &[Row]) -> Result<Figure, Error> {
    let mut effects: Vec<(Effect, &Row)> = rows
        .iter()
        .filter_map(|row| Some((row.without?, row)))
        .collect();
    effects.sort_by(|(_, a), (_, b)| b.worst_error.total_cmp(&a.worst_error));
    let whole = rows.iter().find(|row| row.without.is_none());
    let whole = whole.ok_or_else(|| Error("there is no row of the whole scene".to_owned()))?;
    let is_part = |row: &Row| {
        row.saved_solves as f64 <= whole.solves as f64
            && row.saved_seconds.unwrap_or(0.0) <= whole.seconds
    };
    if whole.solves == 0 || whole.seconds == 0.0 || !rows.iter().all(is_part) {
        return Err(Error(
            "each row must save at most the solves and the seconds of the whole scene, which are \
             not 0"
                .to_owned(),
        ));
    }
    Ok(Figure::new(
        120 + 50 * effects.len() as u32,
        [errors(&effects), costs(&effects, whole)],
    ))
}

/// Draws a line from the median error to the worst error of each effect, the worst effect on top.
fn errors(effects: &[(Effect, &Row)]) -> Panel {
    let values = effects
        .iter()
        .flat_map(|(_, row)| [row.median_error, row.worst_error]);
    let x = Axis::decades("error relative to the adhesionless load", values);
    let [smallest, _] = x.range();
    let names = effects.iter().map(|(effect, _)| effect.name());
    let mut panel = Panel::new(
        "Error of the load without the effect",
        x,
        Axis::names(names),
    )
    .share(1.1);
    for (i, (_, row)) in effects.iter().enumerate() {
        let y = i as f64 + 0.5;
        if row.worst_error == 0.0 {
            panel.label([smallest, y], "none", VERMILION, Side::Right);
            continue;
        }
        let [median, worst] =
            [row.median_error, row.worst_error].map(|error| [error.max(smallest), y]);
        panel
            .line([median, worst], VERMILION)
            .markers([median], VERMILION, Marker::Full);
        panel.markers([worst], VERMILION, Marker::Hollow);
        if i == 0 {
            panel.label(median, "median", VERMILION, Side::Above).label(
                worst,
                "worst",
                VERMILION,
                Side::Above,
            );
        }
    }
    panel
}

/// Draws the share of each effect in the solves of the whole scene, above, and in its time, below.
///
/// A time that is not measurable or negative is drawn as 0.
fn costs(effects: &[(Effect, &Row)], whole: &Row) -> Panel {
    let [solves, seconds] = [whole.solves as f64, whole.seconds];
    let shares = |row: &Row| {
        [
            100.0 * row.saved_solves as f64 / solves,
            100.0 * row.saved_seconds.unwrap_or(0.0) / seconds,
        ]
        .map(|share| share.max(0.0))
    };
    let mut panel = Panel::new(
        "Cost of the effect",
        Axis::linear("part of the whole scene (%)", [0.0, 100.0]),
        Axis::names(effects.iter().map(|_| "")),
    )
    .margin(176);
    for (i, (_, row)) in effects.iter().enumerate() {
        let [solves, seconds, bytes] = row.saved();
        let texts = [format!("{solves} solves, {bytes}"), seconds];
        for (k, (share, (text, colour))) in shares(row)
            .into_iter()
            .zip(texts.into_iter().zip([BLUE, GREY]))
            .enumerate()
        {
            let middle = i as f64 + [0.3, 0.7][k];
            panel
                .cell([0.0, share], [middle - 0.14, middle + 0.14], colour)
                .label([share, middle], text, colour, Side::Right);
        }
    }
    panel
}
