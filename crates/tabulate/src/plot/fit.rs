//! A fit: the data, the fit, the curve without the film, and the residuals.

use fit::{Bodies, Branch, Experiment, Fit, FittedExperiment, FittedPoint, Kind};

use super::axis::Axis;
use super::chart::{
    BLACK, BLUE, Colour, Figure, GREEN, GREY, Marker, ORANGE, PURPLE, Panel, Point, Side, VERMILION,
};
use super::picture::legible;

/// The colours of the experiments.
const COLOURS: [Colour; 5] = [BLUE, VERMILION, GREEN, PURPLE, ORANGE];

/// The most points that are drawn of an experiment: more cannot be told apart.
const MOST: usize = 1500;

/// The most points that are drawn large.
const MOST_LARGE: usize = 100;

/// The most experiments that are named in the figure.
const MOST_NAMES: usize = 5;

/// Describes the figure of a fit: for each kind of measurement the data and the residuals.
pub fn figure(fit: &Fit, experiments: &[Experiment]) -> Figure {
    let kind = |i: usize| experiments[i].measurement.kind;
    let has_layers = |one: &Experiment| matches!(one.bodies, Bodies::Layered(_));
    let without = if experiments.iter().any(has_layers) {
        "without layers"
    } else {
        "without film"
    };
    let mut rows = Vec::new();
    for one in Kind::ALL {
        let members: Vec<(usize, &FittedExperiment)> = fit
            .experiments
            .iter()
            .enumerate()
            .filter(|(i, _)| kind(*i) == one)
            .collect();
        if !members.is_empty() {
            rows.push(panels(one, &members, without));
        }
    }
    Figure::grid(400 * rows.len() as u32, rows)
}

/// Describes the panels of the experiments of one kind, each with its number. `without` says
/// without what the dashed curves are.
fn panels(kind: Kind, members: &[(usize, &FittedExperiment)], without: &str) -> Vec<Panel> {
    let [abscissa, ordinate] = kind.names();
    let unit = if kind == Kind::PenetrationRadius {
        'm'
    } else {
        'N'
    };
    let points = || members.iter().flat_map(|(_, one)| &one.points);
    let x = Scale::new(abscissa, 'm', points().map(|point| point.abscissa));
    let values = |point: &FittedPoint| [Some(point.ordinate), point.fit].into_iter().flatten();
    let y = Scale::new(ordinate, unit, points().flat_map(values));
    let mut data = Panel::new("Data and fit", x.axis(), y.axis());

    let residual = |point: &FittedPoint| Some(point.residual()? / point.deviation);
    let residuals = members
        .iter()
        .flat_map(|(_, one)| one.points.iter().filter_map(residual));
    let largest = residuals.fold(3.0_f64, |most, residual| most.max(residual.abs()));
    let rest = Axis::linear("residual / noise", [-1.1 * largest, 1.1 * largest]);
    let without_film = points().any(|point| point.without_film.is_some());
    let title = if without_film {
        format!("Residuals (dashed: {without})")
    } else {
        "Residuals".to_owned()
    };
    let mut left = Panel::new(title, x.axis(), rest);
    let [from, to] = x.axis().range();
    left.line([[from, 0.0], [to, 0.0]], GREY);

    for (i, one) in members {
        let colour = COLOURS[i % COLOURS.len()];
        let every = one.points.len().div_ceil(MOST);
        let drawn = || one.points.iter().step_by(every);
        for point in drawn() {
            let used = point.fit.is_some() && !point.outlier;
            let shade = if used { colour } else { GREY };
            let marker = match used {
                true if one.points.len() > MOST_LARGE => Marker::Small,
                true => Marker::Full,
                false => Marker::Hollow,
            };
            data.markers(
                [[x.at(point.abscissa), y.at(point.ordinate)]],
                shade,
                marker,
            );
            if let Some(residual) = residual(point) {
                left.markers([[x.at(point.abscissa), residual]], shade, marker);
            }
        }
        let curves = |value: &dyn Fn(&FittedPoint) -> Option<f64>| {
            branches(&one.points, every, |point| {
                Some([x.at(point.abscissa), value(point)?])
            })
        };
        for curve in curves(&|point| Some(y.at(point.without_film?))) {
            data.dashed(curve, GREY);
        }
        for curve in curves(&|point| Some(y.at(point.fit?))) {
            data.line(curve, BLACK);
        }
        for curve in curves(&|point| Some((point.without_film? - point.fit?) / point.deviation)) {
            left.dashed(curve, GREY);
        }
        if members.len() > 1 && *i < MOST_NAMES {
            let place = drawn().map(|point| [x.at(point.abscissa), y.at(point.ordinate)]);
            let file = one.name.rsplit(['/', '\\']).next().unwrap_or(&one.name);
            label(
                &mut data,
                place.collect(),
                &legible(file),
                colour,
                Side::Right,
            );
        }
    }
    let first = || members[0].1.points.iter();
    let place = |point: &FittedPoint, value: f64| [x.at(point.abscissa), y.at(value)];
    if without_film {
        let places = first().filter_map(|point| Some(place(point, point.without_film?)));
        label(&mut data, places.collect(), without, GREY, Side::Right);
    }
    let fitted = first().filter_map(|point| Some(place(point, point.fit?)));
    label(&mut data, fitted.collect(), "fit", BLACK, Side::Left);
    vec![data.share(1.25), left]
}

/// Writes a text beside one of the points, if there are any. Of many points some are tried, because
/// all would take long.
fn label(panel: &mut Panel, points: Vec<Point>, text: &str, colour: Colour, side: Side) {
    let every = points.len().div_ceil(20).max(1);
    let places: Vec<Point> = points.into_iter().step_by(every).collect();
    if !places.is_empty() {
        panel.label_along(places, text, colour, side);
    }
}

/// Returns the curves through the points of each branch, along the abscissa.
fn branches(
    points: &[FittedPoint],
    every: usize,
    at: impl Fn(&FittedPoint) -> Option<Point>,
) -> Vec<Vec<Point>> {
    let mut curves = Vec::new();
    let mut current: Option<(Branch, Vec<Point>)> = None;
    for point in points
        .iter()
        .filter(|point| point.branch != Branch::LeftOut)
    {
        let Some(place) = at(point) else { continue };
        match &mut current {
            Some((branch, curve)) if *branch == point.branch => curve.push(place),
            _ => curves.extend(
                current
                    .replace((point.branch, vec![place]))
                    .map(|(_, curve)| curve),
            ),
        }
    }
    curves.extend(current.map(|(_, curve)| curve));
    for curve in &mut curves {
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
    fn new(name: &str, unit: char, values: impl Iterator<Item = f64>) -> Self {
        let [least, most] = values
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
                [low.min(value), high.max(value)]
            });
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
        let margin = 0.04 * (most - least);
        Self {
            label: format!("{name} ({prefix}{unit})"),
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
