//! The forms that hold over the whole box of a table: tables, direct solves, and half-spaces of
//! some modulus.

use std::hint::black_box;

use interp::Parameter;
use interp::{
    Contact, Curve, Elastic, Material, Normalisation, Quantities, Quantity, System, Table,
};

use super::linear::{Linear, Multilinear};
use super::{FURTHER, Family, NEW, Point, Row, SECONDS, SOLVED, ends};
use crate::Error;
use crate::cost::approximations::{bulk_jkr, film_jkr, gao, hay_crawford};
use crate::cost::clock;
use crate::cost::deviation::{median_and_largest, tightest};
use crate::parallel::try_map;
use crate::solve::solve;

/// The tolerances of the direct solves.
const TOLERANCES: [f64; 4] = [1e-2, 1e-4, 1e-6, 1e-9];

/// The pieces of the cubic spline of one curve.
const PIECES: usize = 600;

pub(super) const fn solves(points: usize) -> usize {
    points + TOLERANCES.len() * if points < SOLVED { points } else { SOLVED }
}

/// Measures all forms at these points of a table's box.
pub(super) fn measure(
    table: &Table,
    points: &[Point],
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Vec<Row>, Error> {
    let truth = solve_all(points, progress, |(x, material)| {
        tightest(*x, material).map(|solution| solution.quantities)
    })?;
    let scene = Scene {
        scope: scope(table),
        truth: loads(points, &truth),
        points,
    };
    let mut rows = Vec::new();
    if table.low_rank().is_some() {
        rows.extend(scene.table("packed table", table)?);
    }
    let dense = table.expand()?;
    rows.extend(scene.table("dense table", &dense)?);
    rows.push(scene.multilinear(&dense));
    rows.extend(scene.along_curves(&dense)?);
    for tolerance in TOLERANCES {
        rows.push(scene.solve(tolerance, progress)?);
    }
    rows.extend(scene.closed_forms()?);
    Ok(rows)
}

/// Solves every point, on all cores.
fn solve_all(
    points: &[Point],
    progress: &(dyn Fn(usize) + Sync),
    solve: impl Fn(&Point) -> Result<Quantities, Error> + Sync,
) -> Result<Vec<Quantities>, Error> {
    try_map(points, |point| {
        let solved = solve(point);
        progress(1);
        solved
    })
}

/// The box of a table, in words.
fn scope(table: &Table) -> String {
    let range = |parameter: Parameter, name: &str| {
        let [from, to] = ends(table, parameter);
        let number = |value: f64| {
            if parameter == Parameter::Nu1 {
                format!("{value}")
            } else {
                format!("{value:e}")
            }
        };
        if from == to {
            format!("{name} {}", number(from))
        } else {
            format!("{name} {} to {}", number(from), number(to))
        }
    };
    let names = ["a/t", "E1/E2", "nu1", "E0/E2"];
    let ranges: Vec<String> = Parameter::ALL
        .into_iter()
        .zip(names)
        .map(|(parameter, name)| range(parameter, name))
        .collect();
    ranges.join(", ")
}

/// The two terms of the load of eq. 9 at a contact radius, each but for a factor that no form
/// changes.
#[derive(Clone, Copy)]
struct Load {
    /// `Pi0`: the load without adhesion.
    press: f64,
    /// `sqrt(es) Eeq/Gamma`: what adhesion takes away.
    pull: f64,
}

impl Load {
    fn new(q: &Quantities, material: &Material) -> Self {
        Self {
            press: q.pi0,
            pull: material.sphere_film_modulus().sqrt() * q.eeq / q.gamma,
        }
    }

    /// Of JKR, whose crack tip has the modulus of all else.
    fn of_half_space(modulus: f64) -> Self {
        Self {
            press: Quantities::homogeneous(modulus).pi0,
            pull: modulus.sqrt(),
        }
    }
}

fn loads(points: &[Point], quantities: &[Quantities]) -> Vec<Load> {
    points
        .iter()
        .zip(quantities)
        .map(|((_, material), quantities)| Load::new(quantities, material))
        .collect()
}

/// What is said of the errors at all points.
pub(super) struct Errors {
    points: usize,
    median: f64,
    largest: f64,
    factor: f64,
    adhesive: Option<[f64; 2]>,
}

impl Errors {
    /// Of loads over the true ones.
    pub(super) fn of_ratios(ratios: Vec<f64>) -> Self {
        let factor = largest(
            ratios
                .iter()
                .map(|&ratio| if ratio < 1.0 { 1.0 / ratio } else { ratio }),
        );
        let [median, largest] = sizes(ratios.iter().map(|ratio| ratio - 1.0));
        Self {
            points: ratios.len(),
            median,
            largest,
            factor,
            adhesive: None,
        }
    }

    fn of_loads(found: &[Load], truth: &[Load]) -> Self {
        let ratios: Vec<[f64; 2]> = found
            .iter()
            .zip(truth)
            .map(|(f, t)| [f.press / t.press, f.pull / t.pull])
            .collect();
        // `(press - pull/2)/(1 - 1/2)`, as the work of adhesion is what takes half of the true load
        // away.
        let adhesive = sizes(ratios.iter().map(|[press, pull]| 2.0 * press - pull - 1.0));
        Self {
            adhesive: Some(adhesive),
            ..Self::of_ratios(ratios.into_iter().map(|[press, _]| press).collect())
        }
    }

    pub(super) fn row(
        &self,
        family: Family,
        form: &str,
        what: &str,
        seconds: f64,
        scope: &str,
        at: &str,
    ) -> Row {
        Row {
            family,
            form: form.to_owned(),
            what: what.to_owned(),
            seconds,
            scope: scope.to_owned(),
            points: self.points as u64,
            at: at.to_owned(),
            median_error: self.median,
            max_error: self.largest,
            max_factor: self.factor,
            adhesive_median_error: self.adhesive.map(|errors| errors[0]),
            adhesive_max_error: self.adhesive.map(|errors| errors[1]),
        }
    }
}

/// Of the sizes of these; what is less than half a unit of rounding counts as that.
fn sizes(errors: impl Iterator<Item = f64>) -> [f64; 2] {
    let size = |error: f64| {
        if error.abs() < 0.5 * f64::EPSILON {
            0.5 * f64::EPSILON
        } else {
            error.abs()
        }
    };
    median_and_largest(errors.map(size).collect())
}

fn largest(numbers: impl Iterator<Item = f64>) -> f64 {
    numbers.max_by(f64::total_cmp).expect("there are points")
}

/// The mean time of the work on one of these, which takes nanoseconds: so would it to store a whole
/// [`Result`] with its error.
pub(super) fn per_one<T>(cases: &[T], work: impl Fn(&T) -> f64) -> f64 {
    let all = || {
        for case in cases {
            black_box(work(black_box(case)));
        }
    };
    clock::seconds(SECONDS, all) / cases.len() as f64
}

/// The mean time of solves, which differ by a factor of a thousand, over some of them. Each is
/// timed by itself, as a machine that has other work interrupts long runs.
fn of_solves<T, R>(cases: &[T], work: impl Fn(&T) -> R) -> f64 {
    let seconds = |case: &T| clock::seconds(SECONDS / SOLVED as f64, || work(black_box(case)));
    cases.iter().map(seconds).sum::<f64>() / cases.len() as f64
}

/// The median time of what is faster the second time, and is done with another one each time.
fn of_new_ones<T, R>(cases: &[T], work: impl Fn(&T) -> R) -> f64 {
    let mut cases = cases.iter().cycle();
    clock::seconds(SECONDS, || {
        work(black_box(cases.next().expect("there are points")))
    })
}

/// Points with their true loads.
struct Scene<'a> {
    scope: String,
    points: &'a [Point],
    truth: Vec<Load>,
}

impl Scene<'_> {
    fn row(&self, family: Family, form: &str, what: &str, seconds: f64, errors: &Errors) -> Row {
        errors.row(family, form, what, seconds, &self.scope, "contact radius")
    }

    /// All that is done with a table's own splines.
    fn table(&self, form: &str, table: &Table) -> Result<Vec<Row>, Error> {
        let found = self
            .points
            .iter()
            .map(|(x, material)| table.curve(material)?.quantities(*x));
        let found = found.collect::<Result<Vec<_>, _>>()?;
        let errors = Errors::of_loads(&loads(self.points, &found), &self.truth);

        let (_, material) = self.points[0];
        let curve = table.curve(&material)?;
        let radii: Vec<f64> = self.points.iter().map(|point| point.0).collect();
        let contact = contact(curve.clone())?;
        let w = work_of_adhesion(&contact, radii[0])?;
        let slice = |work: &dyn Fn(&mut [f64])| {
            let mut values = vec![0.0; radii.len()];
            clock::seconds(SECONDS, || work(black_box(&mut values))) / radii.len() as f64
        };
        let times = [
            (
                "a new material's curve",
                of_new_ones(self.points, |(_, material)| table.curve(material)),
            ),
            (
                NEW,
                of_new_ones(self.points, |(x, material)| {
                    table
                        .curve(material)
                        .and_then(|curve| curve.quantity(Quantity::Pi0, *x))
                }),
            ),
            (
                FURTHER,
                per_one(&radii, |&x| {
                    curve.quantity(Quantity::Pi0, x).unwrap_or(f64::NAN)
                }),
            ),
            (
                "a further point, all four",
                per_one(&radii, |&x| {
                    curve
                        .quantities(x)
                        .map_or(f64::NAN, |four| four.to_array().iter().sum())
                }),
            ),
            (
                "a further point, load",
                per_one(&radii, |&x| contact.load(x, w).unwrap_or(f64::NAN)),
            ),
            (
                "a point of a slice",
                slice(&|values| {
                    curve
                        .quantity_at_all(Quantity::Pi0, &radii, values)
                        .expect("they are on the curve")
                }),
            ),
            (
                "a point of a slice, load",
                slice(&|values| {
                    contact
                        .load_at_all(&radii, w, values)
                        .expect("they are on the curve")
                }),
            ),
        ];
        Ok(times
            .map(|(what, seconds)| self.row(Family::Table, form, what, seconds, &errors))
            .into())
    }

    /// Linear interpolation between the nodes in all parameters at once.
    fn multilinear(&self, table: &Table) -> Row {
        let grids = Quantity::ALL.map(|quantity| Multilinear::new(table, quantity));
        let found: Vec<Quantities> = self
            .points
            .iter()
            .map(|(x, material)| {
                Quantities::from_array(grids.each_ref().map(|grid| grid.at(*x, material)))
            })
            .collect();
        let errors = Errors::of_loads(&loads(self.points, &found), &self.truth);
        let seconds = per_one(self.points, |(x, material)| grids[0].at(*x, material));
        self.row(
            Family::Table,
            "linear in 4-D, same nodes",
            NEW,
            seconds,
            &errors,
        )
    }

    /// Other interpolation along the curve of one material, of which a table with one `a/t` has
    /// none.
    fn along_curves(&self, table: &Table) -> Result<Vec<Row>, Error> {
        let nodes = table.axis(Parameter::AOverT);
        if nodes.len() == 1 {
            return Ok(Vec::new());
        }
        let (mut linear, mut cubic) = (Vec::new(), Vec::new());
        for (x, material) in self.points {
            let curve = table.curve(material)?;
            let (mut by_linear, mut by_cubic) = ([0.0; 4], [0.0; 4]);
            for quantity in Quantity::ALL {
                by_linear[quantity as usize] = Linear::new(&curve, quantity, nodes)?.at(*x);
                by_cubic[quantity as usize] = spline(&curve, quantity)?(*x);
            }
            linear.push(Quantities::from_array(by_linear));
            cubic.push(Quantities::from_array(by_cubic));
        }
        let row = |form: &str, found: &[Quantities], at: &dyn Fn(f64) -> f64| {
            let errors = Errors::of_loads(&loads(self.points, found), &self.truth);
            self.row(
                Family::Table,
                form,
                FURTHER,
                per_one(self.points, |(x, _)| at(*x)),
                &errors,
            )
        };
        let curve = table.curve(&self.points[0].1)?;
        let (line, cubics) = (
            Linear::new(&curve, Quantity::Pi0, nodes)?,
            spline(&curve, Quantity::Pi0)?,
        );
        Ok(vec![
            row("linear along a curve, same nodes", &linear, &|x| line.at(x)),
            row(
                &format!("cubic along a curve, {PIECES} pieces"),
                &cubic,
                &cubics,
            ),
        ])
    }

    /// Solves to a tolerance.
    fn solve(&self, tolerance: f64, progress: &(dyn Fn(usize) + Sync)) -> Result<Row, Error> {
        let points = &self.points[..self.points.len().min(SOLVED)];
        let solve = |(x, material): &Point| {
            solve(*x, material, tolerance).map(|solution| solution.quantities)
        };
        let found = solve_all(points, progress, solve)?;
        let errors = Errors::of_loads(&loads(points, &found), &self.truth[..points.len()]);
        let form = format!("direct solve to {tolerance:e}");
        Ok(self.row(Family::Solve, &form, NEW, of_solves(points, solve), &errors))
    }

    /// Half-spaces of some modulus.
    fn closed_forms(&self) -> Result<Vec<Row>, Error> {
        type Form = (&'static str, fn(f64, &Material) -> Result<f64, Error>);
        const FORMS: [Form; 4] = [
            ("bulk JKR, film ignored", |_, material| {
                Ok(bulk_jkr(material))
            }),
            ("film JKR, substrate ignored", |_, material| {
                Ok(film_jkr(material))
            }),
            ("Gao 1992", gao),
            ("Hay and Crawford 2011", hay_crawford),
        ];
        let mut rows = Vec::new();
        for (name, form) in FORMS {
            let found = self
                .points
                .iter()
                .map(|(x, material)| form(*x, material).map(Load::of_half_space));
            let found = found.collect::<Result<Vec<_>, _>>()?;
            // Between rigid bodies, some are no answer at all.
            if found.iter().all(|load| load.press.is_finite()) {
                let errors = Errors::of_loads(&found, &self.truth);
                let seconds = per_one(self.points, |(x, material)| {
                    form(*x, material).unwrap_or(f64::NAN)
                });
                rows.push(self.row(Family::ClosedForm, name, NEW, seconds, &errors));
            }
        }
        Ok(rows)
    }
}

/// A quantity by the cubic spline of a curve.
fn spline(curve: &Curve, quantity: Quantity) -> Result<impl Fn(f64) -> f64, Error> {
    let spline = curve.spline(quantity, PIECES)?;
    Ok(move |x: f64| {
        spline
            .clamped_sample(Parameter::AOverT.coordinate(x))
            .expect("it has keys")
    })
}

/// The contact of a curve, under a film of 1 m.
fn contact(curve: Curve) -> Result<Contact, Error> {
    let material = *curve.material();
    let rigid = material.normalisation() == Normalisation::Film;
    let film = if rigid { 1.0 } else { material.e1_over_e2() };
    let system = System {
        sphere_radius: 1.0,
        sphere_modulus: if rigid { f64::INFINITY } else { 1.0 },
        film: Elastic::new(film, material.nu1())?,
        film_thickness: 1.0,
        substrate: Elastic::new(material.e0_over_e2(), material.nu0())?,
    };
    Ok(Contact::new(&system, curve)?)
}

/// Some work of adhesion.
fn work_of_adhesion(contact: &Contact, a: f64) -> Result<f64, Error> {
    Ok(contact.load(a, 0.0)? * 0.01 / a)
}
