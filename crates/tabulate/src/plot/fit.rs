//! A fit: the data, the fit, the curve without the film, and the residuals, or the reduced JKR
//! plot.

use fit::report::{JkrPlotPoint, jkr_plot};
use fit::{
    Branch, Direction, Experiment, Fit, FittedExperiment, FittedPoint, Kind, Point as Measured,
};

use figures::axis::Axis;
use figures::chart::{
    BLACK, BLUE, Colour, Figure, GREEN, GREY, Marker, ORANGE, PURPLE, Panel, Point, Side, VERMILION,
};
use figures::picture::legible;

/// The colours of the experiments.
pub(super) const COLOURS: [Colour; 5] = [BLUE, VERMILION, GREEN, PURPLE, ORANGE];

/// The colour of the retract of an experiment that is drawn alone.
pub(super) const RETRACT: Colour = VERMILION;

/// The most points in use, and the most of the others, that are drawn of an experiment: more cannot be told apart.
pub(super) const MOST: usize = 1500;

/// The most points that are drawn large.
const MOST_LARGE: usize = 100;

/// The most experiments that are named in the figure.
pub(super) const MOST_NAMES: usize = 5;

/// Describes the figure of a fit: for each kind of measurement the data and the residuals.
pub fn figure(fit: &Fit, experiments: &[Experiment]) -> Figure {
    let mut rows = Vec::new();
    for kind in Kind::ALL {
        let members: Vec<Drawn<'_>> = (fit.experiments.iter().zip(experiments).enumerate())
            .filter(|(_, (_, experiment))| experiment.measurement.kind == kind)
            .map(|(i, (fitted, experiment))| Drawn::as_measured(i, fitted, experiment))
            .collect();
        if !members.is_empty() {
            rows.push(panels(kind, &members, without_what(experiments)));
        }
    }
    Figure::grid(400 * rows.len() as u32, rows)
}

/// Describes the reduced JKR plot of a fit, in which the contact without a film is a straight line.
pub fn jkr_figure(fit: &Fit, experiments: &[Experiment]) -> Result<Figure, ::fit::Error> {
    let members = (fit.experiments.iter().zip(experiments).enumerate())
        .map(|(i, (fitted, experiment))| {
            let places = jkr_plot(fit, experiment, i)?;
            Ok(Drawn::of_jkr(i, fitted, experiment, &places))
        })
        .collect::<Result<Vec<_>, ::fit::Error>>()?;
    let values = |value: fn(&Mark) -> Option<f64>| {
        let marks = members.iter().flat_map(|one| &one.marks);
        marks.filter_map(value)
    };
    let x = Scale::power("a^{3/2} / (√π R)", "m^{1/2}", values(|mark| Some(mark.x)));
    let ordinates = values(|mark| Some(mark.y))
        .chain(values(|mark| mark.fit))
        .chain(values(|mark| mark.without_film));
    let y = Scale::power("F / (√6π a^{3/2})", "N m^{−3/2}", ordinates);
    let what = without_what(experiments);
    let panel = data_panel("Reduced JKR plot: data and fit", &x, &y, &members, what);
    Ok(Figure::new(440, [panel]))
}

/// Says without what the dashed curves are.
fn without_what(experiments: &[Experiment]) -> &'static str {
    // A bare reference sample has no layers.
    let has_layers = |one: &Experiment| one.bodies.are_layered() && !one.bodies.layers.is_empty();
    if experiments.iter().any(has_layers) {
        "without layers"
    } else {
        "without film"
    }
}

/// An experiment, as drawn.
struct Drawn<'a> {
    number: usize,
    name: &'a str,
    marks: Vec<Mark>,
}

/// A measured point, as drawn.
struct Mark {
    x: f64,
    y: f64,
    fit: Option<f64>,
    without_film: Option<f64>,
    deviation: f64,
    branch: Branch,
    retract: bool,
    used: bool,
}

impl<'a> Drawn<'a> {
    /// Takes the points as they were measured.
    fn as_measured(number: usize, fitted: &'a FittedExperiment, experiment: &Experiment) -> Self {
        let mark = |(point, measured): (&FittedPoint, &Measured)| Mark {
            x: point.abscissa,
            y: point.ordinate,
            fit: point.fit,
            without_film: point.without_film,
            deviation: point.deviation,
            branch: point.branch,
            retract: is_retract(point, measured),
            used: point.fit.is_some() && !point.outlier,
        };
        let points = fitted.points.iter().zip(&experiment.measurement.points);
        Self {
            number,
            name: &fitted.name,
            marks: points.map(mark).collect(),
        }
    }

    fn of_jkr(
        number: usize,
        fitted: &'a FittedExperiment,
        experiment: &Experiment,
        places: &[Option<JkrPlotPoint>],
    ) -> Self {
        let mut drawn = Self::as_measured(number, fitted, experiment);
        let marks = drawn.marks.into_iter().zip(places);
        drawn.marks = marks
            .filter_map(|(mark, place)| {
                let place = (*place)?;
                Some(Mark {
                    x: place.abscissa,
                    y: place.measured,
                    fit: place.fit,
                    without_film: place.without_film,
                    ..mark
                })
            })
            .collect();
        drawn
    }

    /// Returns the marks that are drawn. Of many in use some stand for all; the few others are what a reader looks for.
    fn drawn(&self) -> impl Iterator<Item = &Mark> {
        [true, false].into_iter().flat_map(|used| {
            let of = move |mark: &&Mark| mark.used == used;
            let count = self.marks.iter().filter(of).count();
            let every = count.div_ceil(MOST).max(1);
            self.marks.iter().filter(of).step_by(every)
        })
    }
}

/// Tells whether a point was measured on retract.
fn is_retract(point: &FittedPoint, measured: &Measured) -> bool {
    match measured.direction {
        Some(direction) => direction == Direction::Retract,
        None => point.branch == Branch::Receding,
    }
}

/// Describes the panels of the experiments of one kind: data and residuals. `without` says without
/// what the dashed curves are.
fn panels(kind: Kind, members: &[Drawn<'_>], without: &str) -> Vec<Panel> {
    let [abscissa, ordinate] = kind.names();
    let [of_abscissa, unit] = kind.units();
    let marks = || members.iter().flat_map(|one| &one.marks);
    let x = Scale::new(abscissa, of_abscissa, marks().map(|mark| mark.x));
    let values = |mark: &Mark| [Some(mark.y), mark.fit].into_iter().flatten();
    // A contact stiffness begins at 0, with the contact.
    let origin = kind.is_stiffness().then_some(0.0);
    let y = Scale::new(ordinate, unit, marks().flat_map(values).chain(origin));
    let data = data_panel("Data and fit", &x, &y, members, without);

    let residual = |mark: &Mark| Some((mark.y - mark.fit?) / mark.deviation);
    let residuals = marks().filter_map(residual);
    let largest = residuals.fold(3.0_f64, |most, residual| most.max(residual.abs()));
    let rest = Axis::linear("residual / noise", [-1.1 * largest, 1.1 * largest]);
    let title = if marks().any(|mark| mark.without_film.is_some()) {
        format!("Residuals (dashed: {without})")
    } else {
        "Residuals".to_owned()
    };
    let mut left = Panel::new(title, x.axis(), rest);
    let [from, to] = x.axis().range();
    left.line([[from, 0.0], [to, 0.0]], GREY);
    for one in members {
        for mark in one.drawn() {
            if let Some(residual) = residual(mark) {
                let (colour, marker) = style(one, mark, members.len());
                left.markers([[x.at(mark.x), residual]], colour, marker);
            }
        }
        for curve in branches(&one.marks, |mark| {
            Some([
                x.at(mark.x),
                (mark.without_film? - mark.fit?) / mark.deviation,
            ])
        }) {
            left.dashed(curve, GREY);
        }
    }
    vec![data.share(1.25), left]
}

/// Returns colour and marker of a point of one of several experiments.
fn style(one: &Drawn<'_>, mark: &Mark, experiments: usize) -> (Colour, Marker) {
    let own = COLOURS[one.number % COLOURS.len()];
    let few = one.marks.len() <= MOST_LARGE;
    match (mark.used, mark.retract) {
        (false, _) => (GREY, Marker::Hollow),
        (true, false) if few => (own, Marker::Full),
        (true, false) => (own, Marker::Small),
        (true, true) if experiments > 1 => (own, Marker::Hollow),
        (true, true) if few => (RETRACT, Marker::Hollow),
        (true, true) => (RETRACT, Marker::Small),
    }
}

/// Describes the panel with the data, the fit, and the dashed fit `without` film or layers.
fn data_panel(title: &str, x: &Scale, y: &Scale, members: &[Drawn<'_>], without: &str) -> Panel {
    let mut data = Panel::new(title, x.axis(), y.axis());
    let place = |mark: &Mark, value: f64| [x.at(mark.x), y.at(value)];
    let names = short_names(members.iter().map(|one| one.name));
    for (one, file) in members.iter().zip(&names) {
        for mark in one.drawn() {
            let (colour, marker) = style(one, mark, members.len());
            data.markers([place(mark, mark.y)], colour, marker);
        }
        let curves = |value: fn(&Mark) -> Option<f64>| {
            branches(&one.marks, |mark| Some(place(mark, value(mark)?)))
        };
        for curve in curves(|mark| mark.without_film) {
            data.dashed(curve, GREY);
        }
        for curve in curves(|mark| mark.fit) {
            data.line(curve, BLACK);
        }
        if members.len() > 1 && one.number < MOST_NAMES {
            let places = one.marks.iter().map(|mark| place(mark, mark.y));
            let colour = COLOURS[one.number % COLOURS.len()];
            label(&mut data, places.collect(), file, colour, Side::Right);
        }
    }
    let first = &members[0];
    let mut name = |is: &dyn Fn(&Mark) -> Option<f64>, text: &str, colour, side| {
        let marks = first.marks.iter();
        let places = marks.filter_map(|mark| Some(place(mark, is(mark)?)));
        label(&mut data, places.collect(), text, colour, side);
    };
    name(&|mark| mark.without_film, without, GREY, Side::Right);
    name(&|mark| mark.fit, "fit", BLACK, Side::Left);
    let directions = [false, true].map(|retract| {
        let is = move |mark: &&Mark| mark.used && mark.retract == retract;
        first.marks.iter().any(|mark| is(&mark))
    });
    let texts = match directions {
        [true, true] => ["approach", "retract"],
        _ => ["data", "data"],
    };
    for (retract, text) in [false, true].into_iter().zip(texts) {
        let of = |mark: &&Mark| mark.used && mark.retract == retract;
        // Of several experiments each has its name.
        if let Some(mark) = first.marks.iter().find(of)
            && (members.len() == 1 || text != "data")
        {
            let (colour, _) = style(first, mark, members.len());
            let is = |mark: &Mark| of(&mark).then_some(mark.y);
            name(&is, text, colour, Side::Below);
        }
    }
    let unused = |mark: &Mark| (!mark.used).then_some(mark.y);
    name(&unused, "left out or far off", GREY, Side::Right);
    data
}

/// Returns the names of files. Of long ones the words that all have at their begin or end are left out, and of what is then
/// still long the begin, if the names still differ.
pub(super) fn short_names<'a>(paths: impl Iterator<Item = &'a str>) -> Vec<String> {
    const LONG: usize = 24;
    let is_long = |name: &str| name.chars().count() > LONG;
    let files = paths.map(|path| path.rsplit(['/', '\\']).next());
    let files: Vec<String> = files
        .map(|file| legible(file.unwrap_or_default()))
        .collect();
    if !files.iter().any(|file| is_long(file)) {
        return files;
    }
    let words = |file: &'_ String| -> Vec<String> {
        let words = file.split_inclusive([' ', '_', '-', ',', '.']);
        words.map(str::to_owned).collect()
    };
    let all: Vec<Vec<String>> = files.iter().map(words).collect();
    let fewest = all.iter().map(Vec::len).min().unwrap_or(0);
    let alike = |place: &dyn Fn(&Vec<String>) -> usize| {
        let first = &all[0][place(&all[0])];
        all.iter().all(|own| own[place(own)] == *first)
    };
    let most = |taken: usize| fewest.saturating_sub(1 + taken);
    let first = (0..most(0)).take_while(|&i| alike(&|_| i)).count();
    let last = (0..most(first))
        .take_while(|&i| alike(&|own| own.len() - 1 - i))
        .count();
    let name = |own: &Vec<String>| {
        let kept = own[first..own.len() - last].concat();
        let kept = kept.trim_end_matches([' ', '_', '-', ',', '.']);
        let skipped = kept.chars().count().saturating_sub(LONG - 1);
        match is_long(kept) {
            true => ['…']
                .into_iter()
                .chain(kept.chars().skip(skipped))
                .collect(),
            false => kept.to_owned(),
        }
    };
    let names: Vec<String> = all.iter().map(name).collect();
    let is_new = |i: usize| !names[i].is_empty() && !names[..i].contains(&names[i]);
    if (0..names.len()).all(is_new) {
        names
    } else {
        files
    }
}

/// Writes a text beside one of the points, if there are any. Of many points some are tried, because
/// all would take long.
pub(super) fn label(panel: &mut Panel, points: Vec<Point>, text: &str, colour: Colour, side: Side) {
    let every = points.len().div_ceil(20).max(1);
    let places: Vec<Point> = points.into_iter().step_by(every).collect();
    if !places.is_empty() {
        panel.label_along(places, text, colour, side);
    }
}

/// Returns the curves through the points of each branch, along the abscissa.
fn branches(marks: &[Mark], at: impl Fn(&Mark) -> Option<Point>) -> Vec<Vec<Point>> {
    let every = marks.len().div_ceil(MOST);
    let mut curves = Vec::new();
    let mut current: Option<(Branch, Vec<Point>)> = None;
    for mark in marks.iter().filter(|mark| mark.branch != Branch::LeftOut) {
        let Some(place) = at(mark) else { continue };
        match &mut current {
            Some((branch, curve)) if *branch == mark.branch => curve.push(place),
            _ => curves.extend(
                current
                    .replace((mark.branch, vec![place]))
                    .map(|(_, curve)| curve),
            ),
        }
    }
    curves.extend(current.map(|(_, curve)| curve));
    for curve in &mut curves {
        // Points at one place, those of a hold, stay beside the points before and after them in time.
        if curve[0][0] > curve[curve.len() - 1][0] {
            curve.reverse();
        }
        curve.sort_by(|a, b| a[0].total_cmp(&b[0]));
        // The ends of a branch are drawn in any case.
        let last = curve.len() - 1;
        let mut index = 0;
        curve.retain(|_| {
            index += 1;
            (index - 1) % every == 0 || index - 1 == last
        });
    }
    curves
}

/// An axis in a unit with a prefix.
struct Scale {
    label: String,
    size: f64,
    range: [f64; 2],
}

impl Scale {
    /// Makes the axis that shows all values, with a margin.
    fn new(name: &str, unit: &str, values: impl Iterator<Item = f64>) -> Self {
        let [least, most] = ends(values);
        let largest = least.abs().max(most.abs());
        const PREFIXES: [(&str, f64); 7] = [
            ("k", 1e3),
            ("", 1.0),
            ("m", 1e-3),
            ("μ", 1e-6),
            ("n", 1e-9),
            ("p", 1e-12),
            ("f", 1e-15),
        ];
        let found = PREFIXES.iter().find(|(_, size)| largest >= 2.0 * size);
        let (prefix, size) = *found.unwrap_or(&PREFIXES[PREFIXES.len() - 1]);
        Self::of(
            format!("{name} ({prefix}{unit})"),
            size,
            [least, most],
            0.04,
        )
    }

    /// Makes the axis that shows all values, with a margin, in a power of ten of the `unit`.
    fn power(name: &str, unit: &str, values: impl Iterator<Item = f64>) -> Self {
        let [least, most] = ends(values);
        let exponent = least.abs().max(most.abs()).log10().floor();
        // Numbers from 0.1 to 9999 are written as they are.
        let (size, power) = if (-1.0..4.0).contains(&exponent) || !exponent.is_finite() {
            (1.0, String::new())
        } else {
            let power = format!("10^{{{exponent}}} ").replace('-', "−");
            (10_f64.powf(exponent), power)
        };
        // The curves begin and end at corners, where labels need room.
        Self::of(
            format!("{name}  ({power}{unit})"),
            size,
            [least, most],
            0.12,
        )
    }

    /// Makes the axis of values between two, with a margin of a part of them on both sides.
    fn of(label: String, size: f64, [least, most]: [f64; 2], margin: f64) -> Self {
        let margin = margin * (most - least);
        Self {
            label,
            size,
            range: [(least - margin) / size, (most + margin) / size],
        }
    }

    fn axis(&self) -> Axis {
        Axis::linear(self.label.as_str(), self.range)
    }

    fn at(&self, value: f64) -> f64 {
        value / self.size
    }
}

/// Returns the smallest and the largest value.
fn ends(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
        [low.min(value), high.max(value)]
    })
}

#[cfg(test)]
mod tests {
    use super::short_names;

    #[test]
    fn long_names_keep_what_differs() {
        let of = |names: &[&str]| short_names(names.iter().copied()).join("; ");
        assert_eq!(of(&["data/a.csv", "b.csv"]), "a.csv; b.csv");
        let film = |film: &str| format!("2026-11-29_sampleB_film{film}_spot3.csv");
        let films = ["3um", "30um"].map(film);
        assert_eq!(of(&[&films[0], &films[1]]), "film3um; film30um");
        let dots = [
            "measurement.of.the.sample.number.1.csv",
            "measurement.of.the.sample.number.2.csv",
        ];
        assert_eq!(of(&dots), "1; 2");
        let words = ["abcdefghijklmnopqrstuvwxyz1", "abcdefghijklmnopqrstuvwxyz2"];
        assert_eq!(
            of(&words),
            "…efghijklmnopqrstuvwxyz1; …efghijklmnopqrstuvwxyz2"
        );
        // What differs may be empty, or cut away.
        let equal = ["1abcdefghijklmnopqrstuvwxyz", "2abcdefghijklmnopqrstuvwxyz"];
        assert_eq!(of(&equal), equal.join("; "));
    }
}
