//! A fit of adhesion that depends on the speed of the contact line: the energy release rate over the speed.

use contact::{Hysteresis, RateDependent};
use fit::report::line_plot;
use fit::{Error, Experiment, Fit};

use figures::axis::Axis;
use figures::chart::{BLACK, Figure, Marker, Panel, Point, Side};

use super::fit::{COLOURS, MOST, MOST_NAMES, RETRACT, label, short_names};

/// The number of points of a line of the law.
const POINTS: i32 = 60;

/// Describes the figure: full markers and the lower line where the contact grows, open ones and the upper line where it
/// shrinks.
pub fn figure(fit: &Fit, experiments: &[Experiment]) -> Result<Figure, Error> {
    let plots: Vec<_> = (experiments.iter().enumerate())
        .map(|(i, experiment)| line_plot(fit, experiment, i))
        .collect::<Result<_, _>>()?;
    // A speed of 0, and an energy that is not positive, have no place on a logarithmic axis.
    let places = |i: usize, recedes: bool| -> Vec<Point> {
        let own = plots[i].points.iter();
        let own = own.filter(|[speed, _]| (*speed > 0.0) == recedes);
        let own = own.filter(|[speed, energy]| *speed != 0.0 && *energy > 0.0);
        own.map(|[speed, energy]| [speed.abs(), *energy]).collect()
    };
    let all: Vec<Point> = (0..plots.len())
        .flat_map(|i| [places(i, false), places(i, true)].concat())
        .collect();
    let speeds = Axis::decades(
        "speed of the contact line (m/s)",
        all.iter().map(|at| at[0]),
    );
    let [least, most] = speeds.range();
    let lines: Vec<[Vec<Point>; 2]> = plots
        .iter()
        .map(|plot| [-1.0, 1.0].map(|sign| line(&plot.law, sign, [least, most])))
        .collect();
    let energies = all
        .iter()
        .chain(lines.iter().flatten().flatten())
        .map(|at| at[1]);
    let energies = Axis::decades("energy release rate (J/m²)", energies);
    // Half of the number at the last decade is outside the axes.
    let mut panel = Panel::new("Adhesion over speed: data and fit", speeds, energies).margin(24);
    let names = short_names(experiments.iter().map(|one| &*one.measurement.name));
    // Of many points some stand for all.
    let drawn = |i: usize, recedes: bool| -> Vec<Point> {
        let all = places(i, recedes);
        let every = all.len().div_ceil(MOST).max(1);
        all.into_iter().step_by(every).collect()
    };
    for (i, of_law) in lines.into_iter().enumerate() {
        let own = COLOURS[i % COLOURS.len()];
        let alone = plots.len() == 1;
        let receding = if alone { RETRACT } else { own };
        panel.markers(drawn(i, false), own, Marker::Full);
        panel.markers(drawn(i, true), receding, Marker::Hollow);
        let [below, above] = of_law;
        panel.line(below, BLACK).line(above.clone(), BLACK);
        if alone {
            label(&mut panel, drawn(i, false), "advancing", own, Side::Below);
            label(
                &mut panel,
                drawn(i, true),
                "receding",
                receding,
                Side::Below,
            );
            label(&mut panel, above, "fit", BLACK, Side::AboveLeft);
        } else if i < MOST_NAMES {
            label(&mut panel, drawn(i, true), &names[i], own, Side::Right);
        }
    }
    Ok(Figure::new(440, [panel]))
}

/// Returns the line of a law for speeds of a sign.
fn line(law: &RateDependent<Hysteresis>, sign: f64, [least, most]: [f64; 2]) -> Vec<Point> {
    let speeds =
        (0..=POINTS).map(|i| least * (most / least).powf(f64::from(i) / f64::from(POINTS)));
    let point = |speed: f64| Some([speed, law.energy_release_rate(sign * speed).ok()?]);
    speeds.filter_map(point).collect()
}
