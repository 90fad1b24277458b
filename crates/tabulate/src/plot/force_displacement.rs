//! Load against penetration for the paper's system with films of several thicknesses, with imposed
//! penetration and with imposed load, under any probe. Arrows are the jumps at the ends of
//! stability.

use std::ops::RangeInclusive;

use contact::{Contact, Control, ForceDisplacement, Jump, State};
use interp::Probe;
use solve::stack::Interface;

use super::paper::{self, WORK_OF_ADHESION};
use crate::Error;
use figures::axis::Axis;
use figures::chart::{BLUE, Figure, GREEN, GREY, Panel, Point, Side, VERMILION};

/// The film thicknesses, m.
pub const THICKNESSES: [f64; 3] = [1e-6, 30e-6, 300e-6];

/// The largest imposed load over that of the strongest separation.
const HEAVIEST: f64 = 2.0;

/// The number of states on each branch.
const POINTS: usize = 200;

/// The data of one film.
#[derive(Clone, Debug)]
pub struct Film {
    /// The thickness, m.
    pub thickness: f64,
    /// The curve with imposed penetration.
    pub displacement: ForceDisplacement,
    /// The curve with imposed load.
    pub load: ForceDisplacement,
}

/// Computes the data of the paper's system under a `probe` from direct solves, for each of
/// [`THICKNESSES`], with an `interface` between film and substrate. All curves reach the same load, twice the largest one at a separation, or the
/// largest penetration under it.
///
/// # Errors
/// Those of [`paper::contact`] and of
/// [`contact::Equilibria::force_displacement`].
pub fn data(probe: &Probe, interface: Interface) -> Result<Vec<Film>, Error> {
    let contacts: Vec<Contact> = THICKNESSES
        .iter()
        .map(|&thickness| paper::contact(probe, thickness, interface))
        .collect::<Result<_, _>>()?;
    let courses = |control, most: f64| {
        let course = |contact: &Contact| {
            let equilibria = contact.equilibria(WORK_OF_ADHESION, control)?;
            equilibria.force_displacement(most, POINTS)
        };
        contacts.iter().map(course).collect::<Result<Vec<_>, _>>()
    };
    let mut strongest = 0.0_f64;
    for contact in &contacts {
        let separation = contact.pull_off(WORK_OF_ADHESION, Control::Load)?;
        strongest = strongest.max(-separation.load);
    }
    let load = courses(Control::Load, HEAVIEST * strongest)?;
    let displacement = courses(Control::Displacement, deepest(&load))?;
    Ok(THICKNESSES
        .iter()
        .zip(displacement.into_iter().zip(load))
        .map(|(&thickness, (displacement, load))| Film {
            thickness,
            displacement,
            load,
        })
        .collect())
}

/// Returns the largest penetration of some curves.
fn deepest<'a>(courses: impl IntoIterator<Item = &'a ForceDisplacement>) -> f64 {
    let branches = courses.into_iter().flat_map(|course| &course.loading);
    branches
        .flatten()
        .fold(0.0, |most, state| most.max(state.penetration))
}

/// The axes of both panels.
struct Axes {
    /// The ends of the penetrations and of the loads.
    ends: [[f64; 2]; 2],
    /// The units, m and N with a prefix, and their sizes.
    units: [(String, f64); 2],
}

impl Axes {
    /// Chooses axes with a margin beyond the separations.
    fn new(films: &[Film]) -> Self {
        /// The lengths of the axes below zero over the largest values at a separation.
        const BELOW: [f64; 2] = [2.6, 1.25];
        /// The least length of the axis of penetration below zero, over that above: for labels.
        const FOR_LABELS: f64 = 0.4;
        let separations = |value: fn(&State) -> f64| {
            let jumps = films
                .iter()
                .flat_map(|film| film.displacement.jumps.iter().chain(&film.load.jumps));
            jumps.fold(0.0_f64, |most, jump| most.max(-value(&jump.from)))
        };
        let apart = separations(|state| state.penetration);
        let pulled = separations(|state| state.load);
        let deepest = deepest(films.iter().map(|film| &film.load));
        let ends = [
            [-(BELOW[0] * apart).max(FOR_LABELS * deepest), deepest],
            [-BELOW[1] * pulled, HEAVIEST * pulled],
        ];
        let units = [unit(deepest, "m"), unit(pulled, "N")];
        let ends = [0, 1].map(|i| ends[i].map(|end| end / units[i].1));
        Self { ends, units }
    }

    /// Returns penetration and load in the units of the axes.
    fn point(&self, state: &State) -> Point {
        [
            state.penetration / self.units[0].1,
            state.load / self.units[1].1,
        ]
    }
}

/// Returns the unit, with its prefix, in which a value is from 0.3 to 300, and its size.
fn unit(value: f64, symbol: &str) -> (String, f64) {
    const PREFIXES: [(&str, f64); 5] = [
        ("", 1.0),
        ("m", 1e-3),
        ("μ", 1e-6),
        ("n", 1e-9),
        ("p", 1e-12),
    ];
    let fits = |(_, size): &(&str, f64)| value >= 0.3 * size;
    let (prefix, size) = PREFIXES.into_iter().find(fits).unwrap_or(PREFIXES[4]);
    (format!("{prefix}{symbol}"), size)
}

/// Draws imposed penetration on the left and imposed load on the right.
pub fn figure(films: &[Film], probe: &Probe, interface: Interface) -> Figure {
    let axes = Axes::new(films);
    let joined = match interface {
        Interface::Bonded => "",
        Interface::Sliding => ", sliding films",
        Interface::Springs { .. } => ", films on springs",
    };
    let panel = |imposed: &str, course| {
        let title = format!("Imposed {imposed}: {}{joined}", probe.name());
        panel(title, films, &axes, course)
    };
    let panels = [
        panel("penetration", |film| &film.displacement),
        panel("load", |film| &film.load),
    ];
    Figure::new(460, panels)
}

/// The part of the axis of penetrations in which the name of a film has room on the right of its curve where this rises.
const ROOM: RangeInclusive<f64> = 0.45..=0.77;

fn panel(
    title: String,
    films: &[Film],
    axes: &Axes,
    course: fn(&Film) -> &ForceDisplacement,
) -> Panel {
    let [(metres, _), (newtons, _)] = &axes.units;
    let leftmost = axes.ends[0][0];
    let mut panel = Panel::new(
        title,
        Axis::linear(format!("penetration ({metres})"), axes.ends[0]),
        Axis::linear(format!("load ({newtons})"), axes.ends[1]),
    );
    panel.line([[leftmost, 0.0], [0.0, 0.0]], GREY).label(
        [0.6 * leftmost, 0.0],
        "no contact",
        GREY,
        Side::Above,
    );
    for (film, (colour, side)) in films.iter().zip([
        (BLUE, Side::Left),
        (GREEN, Side::Below),
        (VERMILION, Side::Right),
    ]) {
        let course = course(film);
        let branches = course.loading.iter().chain(&course.unloading);
        for branch in branches.clone() {
            let points: Vec<Point> = branch.iter().map(|state| axes.point(state)).collect();
            panel.line(points, colour);
        }
        for jump in &course.jumps {
            let (from, to) = arrow(jump, axes);
            panel.arrow(from, to, colour);
        }
        // The label is beside the curve above zero load, where there is room on the right, or below its lowest point.
        let [from, to] = axes.ends[0];
        let height = |state: &&State| {
            let [penetration, load] = axes.point(state);
            match side {
                Side::Below => load,
                Side::Right if !ROOM.contains(&((penetration - from) / (to - from))) => {
                    f64::INFINITY
                }
                _ => (load - 0.15 * axes.ends[1][1]).abs(),
            }
        };
        let named = branches
            .flatten()
            .min_by(|a, b| height(a).total_cmp(&height(b)));
        if let Some(state) = named {
            panel.label(
                axes.point(state),
                format!("{:.0} μm film", 1e6 * film.thickness),
                colour,
                side,
            );
        }
    }
    // The jumps of the thickest film are the longest.
    let jumps = films.last().map_or(&[][..], |film| &course(film).jumps);
    if let [touch, .., separation] = jumps {
        for (jump, name) in [(touch, "touch"), (separation, "separation")] {
            let (from, to) = arrow(jump, axes);
            let middle = [0, 1].map(|i| 0.5 * (from[i] + to[i]));
            let side = if from[0] == to[0] {
                Side::Left
            } else {
                Side::Above
            };
            panel.label(middle, name, GREY, side);
        }
    }
    panel
}

/// Returns the ends of the arrow of a jump. After a separation without equilibrium it leads to the
/// edge of the figure.
fn arrow(jump: &Jump, axes: &Axes) -> (Point, Point) {
    let from = axes.point(&jump.from);
    let gone = [axes.ends[0][0], from[1]];
    let to = jump.to.as_ref().map_or(gone, |state| axes.point(state));
    (from, to)
}
